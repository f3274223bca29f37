#!/usr/bin/python3
"""A calibration with LinuxCNC as the machine: linuxcnc_measures.py SOURCE_DIR BUILD_DIR SHAPE

axiscal's part program runs on LinuxCNC; its 1 kHz motor position drives the simulated laser
through the injected error; mb2hal asks for the points. SHAPE: single-register | coil-and-index."""
import sys

from linuxcnc_bench import PATIENCE_S, RUN_LIMIT_S, leftovers, run_in_bench
from linuxcnc_figures import judge_certificate


def judge_recipe(source, shape, program):
    """What docs/trigger.md shows of a point is what ran."""
    text = (source / "docs/trigger.md").read_text()
    shown = text.split(f"### LinuxCNC, {shape}\n")[1].split("```\n")[1]
    assert shown in program.read_text(), f"docs/trigger.md shows another program:\n{shown}"


def measure(bench):
    _, cnc, program = bench.begin_run()
    assert cnc.wait(RUN_LIMIT_S) == 0, f"LinuxCNC: {(bench.scratch / 'cnc.events').read_text()}"
    print(bench.axiscal("watch", "--until-published", limit_s=PATIENCE_S).splitlines()[-1])
    judge_recipe(bench.source, bench.shape, program)
    judge_certificate(next((bench.scratch / "state/outbox").iterdir()), bench.truth(program))
    left = leftovers(bench.scratch)
    assert not left, f"left behind: {left}"


sys.exit(run_in_bench(measure))
