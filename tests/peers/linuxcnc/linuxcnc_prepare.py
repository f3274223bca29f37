#!/usr/bin/python3
"""The CNC's prepare with LinuxCNC as the machine: linuxcnc_prepare.py SOURCE_DIR BUILD_DIR SHAPE

`axiscal arm --datum-by-cnc` opens the run and ties nothing. The program's CMD and NOMINAL_POS reach the
station's sequence-block through mb2hal, and the station ties the reading to the datum by request 1. Then
10 of 10 points in order by requests 2 to 11, each where the injected curve is as seen from the datum, and
E as injected. SHAPE: sequence-block, the one that knows commands."""
import contextlib
import json
import math
import re
import sqlite3
import sys
import tomllib

from linuxcnc_bench import FIVE_TARGETS, run_in_bench
from linuxcnc_figures import judge_E, judge_points, judge_recipe

POINTS = 10


def datum_of(program):
    """The coordinate to which the program drives first, mm; its prepare must claim the same."""
    text = program.read_text()
    driven, claimed = (re.search(words, text, re.DOTALL)[1]
                       for words in (r"^.*?\nG1 X(\S+)\n", r"\n\(datum\)\n.*?\nM68 E3 Q(\S+)\n"))
    assert driven == claimed and "\nM68 E7 Q1\n" in text, f"{driven} mm, claimed {claimed}"
    return float(driven)


def judge_datum(run_file, datum_mm):
    """One, tied by the CNC's request 1; `axiscal arm` would have left request 0."""
    with contextlib.closing(sqlite3.connect(f"file:{run_file}?mode=ro", uri=True)) as run:
        rows = run.execute("SELECT sequence, coordinate_m FROM datum").fetchall()
    assert len(rows) == 1 and rows[0][0] == 1, f"datums: {rows}"
    assert abs(rows[0][1] * 1e3 - datum_mm) < 1e-6, f"datums: {rows}, the program's at {datum_mm} mm"


def injected_um(errors, position_mm, direction):
    """At 20 degC, after an approach from below (direction 1) or from above (-1)."""
    x_m = (position_mm - errors["centre_mm"]) * 1e-3
    smooth = x_m * (errors["linear_um_per_m"] + x_m * (
        errors["quadratic_um_per_m2"] + x_m * errors["cubic_um_per_m3"]))
    waves = sum(wave["amplitude_um"] * math.sin(
        2 * math.pi * (position_mm / wave["period_mm"] + wave["phase_deg"] / 360))
        for wave in errors["periodic"])
    reversal = errors["reversal_um"] + errors["reversal_slope_um_per_m"] * x_m
    return smooth + waves + direction * reversal / 2


def judge_each_point(document, scenario, datum_mm, bound_um):
    """Each deviation less the injected one at the datum, which was reached from below.

    The bound is that of E. A point less the datum has the noise of two captures, sqrt(2) z sigma, and E
    of two means of one capture each 2 z sigma, z of ten of them (axiscal-simulate truth): 13 nm less. What
    is systematic grows with the way, which is longer by the 4 mm before the first target: 0.3 nm."""
    errors = tomllib.loads(scenario.read_text())["errors"]
    zero_um = injected_um(errors, datum_mm, 1)
    targets = [position["target"] for position in document["positions"]]
    worst_um = 0.0
    for way, direction in (("forward", 1), ("backward", -1)):
        rows = document["run"]["deviations"][way]
        assert [len(row) for row in rows] == [1] * len(targets) == [1] * (POINTS // 2), rows
        for target, (found_mm,) in zip(targets, rows):
            off_um = found_mm * 1e3 - (injected_um(errors, target, direction) - zero_um)
            assert abs(off_um) <= bound_um, f"{way} at {target} mm: off by {off_um:.3f} um of {bound_um:.3f}"
            worst_um = max(worst_um, abs(off_um))
    return f"each point within {worst_um:.3f} um of the curve, {bound_um:.3f} um allowed"


def prepare(bench):
    bench.changes |= FIVE_TARGETS
    _, cnc, program = bench.begin_run("X-whole.ngc", "--datum-by-cnc")
    folder = bench.reach_the_end(cnc)
    judge_recipe(bench.source, bench.shape, program)
    datum_mm, run_file, truth = datum_of(program), next(folder.glob("*.axiscal")), bench.truth(program)
    judge_datum(run_file, datum_mm)
    judge_points(run_file, POINTS, first_request=2)
    document = json.loads((folder / "certificate.json").read_text())
    print(f"{POINTS} of {POINTS} points in order; {judge_E(document, truth)}")
    print(judge_each_point(document, bench.scenario, datum_mm, truth["E"]["bound"] * 1e3))


sys.exit(run_in_bench(prepare))
