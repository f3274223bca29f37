#!/usr/bin/python3
"""A whole calibration by the page at the machine alone: linuxcnc_page.py SOURCE_DIR BUILD_DIR SHAPE

LinuxCNC runs the part program and waits at its datum. A real browser is paired, arms the run, sees each point come and
names the certificate; the figures are judged as those of a run that was armed at a terminal."""
import json
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "support"))
from browser import Browser
from linuxcnc_bench import FIVE_TARGETS, free_port, run_in_bench, until
from linuxcnc_figures import judge_E, judge_points
from page_hands import arm, code_of, pair, points_drawn

def calibrate(bench):
    port = free_port()
    bench.changes.update(FIVE_TARGETS)
    bench.changes['group = ""\nport = 0\n'] = f'group = ""\nport = {port}\n'
    daemon, cnc, program = bench.make_ready()
    until(bench.may_arm, "every pre-flight check to hold", [daemon, cnc])
    plan = json.loads(bench.axiscal("program", "--json", "--config", bench.scratch / "station.toml", "--out", bench.scratch / "again"))
    with Browser() as page:
        page.open(f"http://127.0.0.1:{port}/")
        page.wait("the page shows the station", lambda: page.text("#now_reading"))
        pair(page, code_of(bench.axiscal("pair", "panel")))
        arm(page, plan["programs"][0]["datum_mm"])
        page.wait_for_text("#run_so_far", "10 of 10", 240)
        page.wait_for_text("#run_so_far", "certificate", 60)
        page.wait("ten points are drawn", lambda: points_drawn(page, "run") == 10)
        assert not page.complaints(), "the console of the browser is not silent"
    folder = bench.reach_the_end(cnc)
    assert "armed by page panel" in "\n".join(bench.status()["notes"]), bench.status()["notes"]
    judge_points(next(folder.glob("*.axiscal")), 10)
    print(judge_E(json.loads((folder / "certificate.json").read_text()), bench.truth(program)))


sys.exit(run_in_bench(calibrate))
