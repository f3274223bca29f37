#!/usr/bin/env python3
"""The convex hull of the circles of circle_bench.cpp by qhull: the first half of any exact minimum zone by Voronoi diagrams.
Its own count of CPU seconds, without the reading of the points."""
import json
import random
import math
import re
import shutil
import subprocess
import sys


def circle(count, arc_deg):
    noise = random.Random(17)
    for i in range(count):
        t = 0.3 + i / count * math.radians(arc_deg)
        r = 100 + 0.004 * math.cos(2 * t) + 0.002 * math.cos(3 * t + 1) + noise.gauss(0, 0.0005)
        yield f"{3 + r * math.cos(t)!r} {-2 + r * math.sin(t)!r}"


def main():
    if shutil.which("qhull") is None:
        print(json.dumps({"peer": "qhull", "not_run": "qhull-bin is not installed"}))
        return
    for power in (6, 5):
        for arc in (360, 220):
            row = f"minimum zone, {arc} deg, 1e{power}"
            if not re.search(sys.argv[1], row):
                continue
            text = f"2\n{10 ** power}\n" + "\n".join(circle(10 ** power, arc)) + "\n"
            said = subprocess.run(["qhull", "s"], input=text, capture_output=True, text=True, check=True)
            seconds = re.search(r"CPU seconds to compute hull.*?: *([0-9.e+-]+)", said.stderr + said.stdout)
            print(json.dumps({"row": row, "peer": "qhull, hull alone", "ns": float(seconds[1]) * 1e9}))


main()
