#!/usr/bin/env python3
"""The convex hull of the circles of circle_bench.cpp by qhull: the first half of any exact minimum zone by Voronoi diagrams.
Its own count of CPU seconds, without the reading of the points."""
import json
import re
import shutil
import subprocess
import sys

from bench_circles import ZONES, circle


def main():
    if shutil.which("qhull") is None:
        print(json.dumps({"peer": "qhull", "not_run": "qhull-bin is not installed"}))
        return
    for row, count, arc in ZONES:
        if count < 10 ** 5 or not re.search(sys.argv[1], row):
            continue  # its clock counts hundredths of a second
        text = f"2\n{count}\n" + "\n".join(f"{x!r} {y!r}" for x, y in circle(count, arc)) + "\n"
        said = subprocess.run(["qhull", "s"], input=text, capture_output=True, text=True, check=True)
        seconds = re.search(r"CPU seconds to compute hull.*?: *([0-9.e+-]+)", said.stderr + said.stdout)
        print(json.dumps({"row": row, "peer": "qhull, hull alone", "part": True, "ns": float(seconds[1]) * 1e9}))


main()
