"""What a calibration with LinuxCNC must have found: points, certificate, and E against the injected one."""
import contextlib
import json
import sqlite3

E_MARK_MM = 0.0001  # 0.1 um, of the E that was injected
POINTS = 110        # 11 targets, 5 approaches each way
TABLES = {"certificate.json", "certificate.csv", "certificate.pdf"}
FIGURES = {"A", "A_forward", "A_backward", "E", "E_forward", "E_backward", "M",
           "R", "R_forward", "R_backward", "B", "B_mean"}


def judge_recipe(source, shape, program):
    """What docs/trigger.md shows of a program of this shape is what ran."""
    text = (source / "docs/trigger.md").read_text()
    shown = text.split(f"### LinuxCNC, {shape}\n")[1].split("```\n")[1]
    assert shown in program.read_text(), f"docs/trigger.md shows another program:\n{shown}"


def judge_points(run_file, wanted=POINTS, first_request=1):
    with contextlib.closing(sqlite3.connect(f"file:{run_file}?mode=ro", uri=True)) as run:
        points = run.execute("SELECT sequence, step, planned_step, target_index, direction, approach,"
                             " origin FROM point ORDER BY link").fetchall()
        plan = run.execute("SELECT step, target_index, direction, approach FROM plan_point"
                           " ORDER BY step").fetchall()
    requests = list(range(first_request, first_request + wanted))
    assert [point[0] for point in points] == requests, "requests in order"
    assert [(point[1], *point[3:6]) for point in points] == plan, "the points that were planned"
    assert all(point[1] == point[2] for point in points), "none out of its turn"
    assert {point[6] for point in points} == {"cnc"}, f"asked by {({p[6] for p in points})}"


def judge_E(document, truth):
    E_mm, injected = document["parameters"]["E"]["value"], truth["E"]
    assert injected["bound"] <= E_MARK_MM, f"the scenario can not hold the mark: {injected}"
    assert abs(E_mm - injected["value"]) <= E_MARK_MM, f"E {E_mm} mm, injected {injected}"
    return f"E {E_mm * 1e3:.3f} um, injected {injected['value'] * 1e3:.3f} um"


def judge_certificate(folder, truth):
    names = {file.name for file in folder.iterdir()}
    run_file = next(folder.glob("*.axiscal"))
    assert names == TABLES | {run_file.name}, names
    assert all(file.stat().st_size > 0 for file in folder.iterdir()), "an empty file"
    document = json.loads((folder / "certificate.json").read_text())
    assert set(document["parameters"]) == FIGURES, sorted(document["parameters"])
    assert "not_evaluated" not in document or not document["not_evaluated"], document["not_evaluated"]
    assert len(document["positions"]) == 11
    judge_points(run_file)
    print(f"110 of 110 points in order; {judge_E(document, truth)}")
