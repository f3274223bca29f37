#!/usr/bin/python3
"""Rows of tools/bench: from the closed run file to the certificate in the outbox, beside an export of the same run in the same run.

closing.py PROGRAM-FOLDER

"this" is the station's own report, from the start of axiscal-report to its end: the run file read and checked, the figures computed
(budget and Monte Carlo among them), the result stored, JSON, CSV and PDF drawn, all of it synced, the entry renamed into the outbox.
The limit is an export of a run that has its result: it reads, computes and draws once, and stores nothing. So the ratio shows how often
the first report does what is needed once. A run of 50 points with everything that its header can hold, and a ballbar on two circles.
Interleaved, pinned to one processor; the fastest of each counts.
"""
import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import stall

SOURCE = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "tests/cli"))
import measured_files
import run_files

REFERENCE = SOURCE / "tests/reference/fifty_points.axiscal"
GOAL, ROUNDS = 1.15, int(os.environ.get("AXISCAL_BENCH_ROUNDS", "15"))


def timed(words):
    began = time.perf_counter()
    subprocess.run(words, stdout=subprocess.DEVNULL, check=True)
    return (time.perf_counter() - began) * 1e3


def one_round(program, closed, folder):
    """(first report, export) in ms, of a copy of the closed run."""
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "state/outbox").mkdir(parents=True)
    (folder / "export").mkdir()
    run = folder / "run.axiscal"
    shutil.copy(closed, run)
    return (timed([program, run, "--outbox", folder / "state/outbox"]), timed([program, run, "--to", folder / "export"]))


def print_row(program, name, rows):
    """@returns whether its goal is met."""
    with tempfile.TemporaryDirectory(prefix="axiscal-closing-") as scratch:
        folder = Path(scratch)
        closed = folder / "closed.axiscal"
        run_files.write(closed, SOURCE, rows)
        rounds = [one_round(program, closed, folder / "round") for _ in range(ROUNDS)]
    first, export = (min(times) for times in zip(*rounds))
    ratio = first / export
    print(f"closing to certificate in the outbox, {name} | {first:.0f} ms | {export:.0f} ms (export) | - | {ratio:.2f} | "
          f"<= {GOAL} x{'' if ratio <= GOAL else '  MISSED'}")
    return ratio <= GOAL


def main():
    program = Path(sys.argv[1]) / "axiscal-report"
    os.sched_setaffinity(0, {stall.last_processor()})
    with stall.told(stall.last_processor(), "closing: "):
        met = [print_row(program, "50 points", run_files.linear(REFERENCE)),
               print_row(program, "ballbar, two circles", measured_files.circular(REFERENCE))]
    return 0 if all(met) else 1


if __name__ == "__main__":
    sys.exit(main())
