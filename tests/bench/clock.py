#!/usr/bin/python3
"""Rows of tools/bench: the time of a sample on this computer while all of its processors are kept busy.

clock.py PROGRAM-FOLDER

Records with known times go through a pseudo terminal, the serial link, the loop and the clock of the drivers (loaded_clock.cpp). Told are
the scatter about a constant, the largest distance from it, that constant (the delay that no fit finds; u(t) holds it), and the share of all
samples whose truth lies within 2 u(t). Nothing is pinned: the busy processors are what is tried.
"""
import json
import os
import subprocess
import sys
from pathlib import Path

import stall

SECONDS = os.environ.get("AXISCAL_BENCH_CLOCK_SECONDS", "20")
COVERED = 0.95
# case: most rms, most of all; us
GOALS = {"serial line, 1 kHz": (10, 20), "stream of 10 kHz over USB frames": (10, 20),
         "1 kHz over USB frames, after two beats": (15, None)}


def tell(found):
    """One line; True: the goal is met."""
    rms, worst = GOALS[found["case"]]
    met = found["rms_us"] < rms and (worst is None or found["worst_us"] < worst) and found["covered"] >= COVERED
    goal = f"< {rms} us rms" + (f", < {worst} us" if worst else "") + f", >= {COVERED:.0%} within 2 u(t)"
    print(f"time fit, loaded machine: {found['case']} | {found['rms_us']:.2f} us rms, {found['worst_us']:.2f} us at most | - | "
          f"bias {found['bias_us']:.1f} us, u(t) {found['u_us']:.1f} us, {found['covered']:.1%} within 2 u(t) | - | "
          f"{goal}{'' if met else '  MISSED'}")
    return met


def main():
    with stall.told(stall.last_processor(), "time fit, on all processors: "):
        ran = subprocess.run([Path(sys.argv[1]) / "axiscal_bench_clock", SECONDS], capture_output=True, text=True, timeout=600, check=False)
    found = [json.loads(line) for line in ran.stdout.splitlines()]
    if ran.returncode != 0 or [one["case"] for one in found] != list(GOALS):
        print(f"time fit, loaded machine: ended with {ran.returncode}: {ran.stderr.strip()}")
        return 1
    return 0 if all([tell(one) for one in found]) else 1


if __name__ == "__main__":
    sys.exit(main())
