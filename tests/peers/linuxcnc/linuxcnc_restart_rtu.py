#!/usr/bin/python3
"""axiscald is killed in mid-program, with its LinuxCNC on a serial line:
linuxcnc_restart_rtu.py SOURCE_DIR BUILD_DIR SHAPE

As linuxcnc_restart.py, but nobody touches mb2hal: a line has no connection that could die with the
station. A short program of 10 points; with AXISCAL_ALL the whole calibration, 110 of 110 points and
E as injected."""
import os
import sys

from linuxcnc_bench import FIVE_TARGETS, run_in_bench
from linuxcnc_figures import judge_certificate, judge_points
from linuxcnc_restart import kill_in_mid_program, reach_the_end

SHORT_POINTS = 10
SHORT = FIVE_TARGETS | {  # with short halts
    'dwell = "0.3 s"': 'dwell = "0.15 s"',
    '[capture]\nwindow = "0.3 s"': '[capture]\nwindow = "0.15 s"',
}


def judge_recipe(bench):
    """What docs/trigger.md shows of mb2hal on a serial line is what ran, but for the name of the line."""
    shown = (bench.source / "docs/trigger.md").read_text().split("\nLINK_TYPE=serial\n")[1].split("```\n")[0]
    lines = ["LINK_TYPE=serial", *(line for line in shown.splitlines() if not line.startswith("SERIAL_PORT="))]
    ran = (bench.scratch / "mb2hal.ini").read_text().splitlines()
    assert len(lines) == 6 and set(lines) < set(ran), f"docs/trigger.md shows {lines}; this ran: {ran}"
    assert not [line for line in ran if line.startswith("TCP_")], ran


def restart(bench):
    whole = bool(os.environ.get("AXISCAL_ALL"))
    if not whole:
        bench.changes |= SHORT
    bench.lay_serial_line()
    daemon, cnc, program = bench.begin_run()
    port = bench.status()["trigger"]["port"]
    assert "Modbus RTU" in port, port
    before = kill_in_mid_program(bench, daemon, cnc)
    folder = reach_the_end(bench, cnc, before)
    judge_recipe(bench)
    if whole:
        judge_certificate(folder, bench.truth(program))
    else:
        judge_points(next(folder.glob("*.axiscal")), SHORT_POINTS)
        print(f"{SHORT_POINTS} of {SHORT_POINTS} points in order")


sys.exit(run_in_bench(restart, "socat"))
