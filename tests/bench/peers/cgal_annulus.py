#!/usr/bin/env python3
"""CGAL's annulus of least area about the circles of circle_bench.cpp (cgal_annulus.cpp, built by peer_root.sh)."""
import json
import os
import pathlib
import re
import subprocess
import sys

from bench_circles import ZONES, circle

PROGRAM = pathlib.Path(os.environ.get("AXISCAL_PEER_ROOT", "build/peers"), "cgal_annulus")


def main():
    if not PROGRAM.exists():
        print(json.dumps({"peer": "CGAL", "not_run": "tests/bench/peer_root.sh has not built it"}))
        return
    for row, count, arc in ZONES:
        if not re.search(sys.argv[1], row):
            continue
        text = f"{count}\n" + "\n".join(f"{x!r} {y!r}" for x, y in circle(count, arc))
        ran = subprocess.run([PROGRAM, "3"], input=text, capture_output=True, text=True, check=True)
        print(json.dumps({"row": row, "peer": "CGAL 5.5 Min_annulus_d", "ns": float(ran.stdout.split()[0]) * 1e6}))


main()
