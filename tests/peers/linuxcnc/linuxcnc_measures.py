#!/usr/bin/python3
"""A calibration with LinuxCNC as the machine: linuxcnc_measures.py SOURCE_DIR BUILD_DIR SHAPE

axiscal's part program runs on LinuxCNC; its 1 kHz motor position drives the simulated laser
through the injected error; mb2hal asks for the points. SHAPE: single-register | coil-and-index."""
import sys

from linuxcnc_bench import run_in_bench
from linuxcnc_figures import judge_certificate, judge_recipe


def measure(bench):
    _, cnc, program = bench.begin_run()
    folder = bench.reach_the_end(cnc)
    judge_recipe(bench.source, bench.shape, program)
    judge_certificate(folder, bench.truth(program))


sys.exit(run_in_bench(measure))
