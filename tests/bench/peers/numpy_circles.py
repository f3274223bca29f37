#!/usr/bin/env python3
"""What numpy does on the circles of circle_bench.cpp: an algebraic circle by lstsq, an orthogonal one by steps of Gauss and
Newton, and a sort, which any n log n method for the minimum zone pays first."""
import json
import re
import sys
import time

import bench_circles

try:
    import numpy
except ImportError:
    print(json.dumps({"peer": "numpy", "not_run": "python3-numpy is not installed"}))
    sys.exit(0)


def fastest(work, *points):
    best, until = float("inf"), time.perf_counter() + 1
    while time.perf_counter() < until:
        begin = time.perf_counter()
        work(*points)
        best = min(best, time.perf_counter() - begin)
    return best * 1e9


def sort(x, _):
    return numpy.sort(x)


def algebraic(x, y):
    return numpy.linalg.lstsq(numpy.column_stack([2 * x, 2 * y, numpy.ones_like(x)]), x * x + y * y, rcond=None)[0]


def orthogonal(x, y):
    a, b, _ = algebraic(x, y)
    for _ in range(3):
        dx, dy = x - a, y - b
        d = numpy.hypot(dx, dy)
        step = numpy.linalg.lstsq(numpy.column_stack([-dx / d, -dy / d, -numpy.ones_like(d)]), d.mean() - d, rcond=None)[0]
        a, b = a + step[0], b + step[1]
    return a, b


def main():
    wanted = re.compile(sys.argv[1])
    jobs = [(row, count, arc, "sort of x alone", sort) for row, count, arc in bench_circles.ZONES]
    jobs.append(("least squares circle, algebraic, 1e6", 10 ** 6, 360, "lstsq", algebraic))
    jobs.append(("least squares circle, orthogonal, 1e6", 10 ** 6, 360, "three lstsq", orthogonal))
    for row, count, arc, what, work in jobs:
        if wanted.search(row):
            x, y = numpy.array(bench_circles.circle(count, arc)).T.copy()
            print(json.dumps({"row": row, "peer": f"numpy {numpy.__version__} {what}", "part": work is sort, "ns": fastest(work, x, y)}))


main()
