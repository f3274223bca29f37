#!/usr/bin/env python3
"""What numpy does on the circles of circle_bench.cpp: an algebraic circle by lstsq, an orthogonal one by steps of Gauss and
Newton, and a sort, which any n log n method for the minimum zone pays first."""
import json
import re
import sys
import time

try:
    import numpy
except ImportError:
    print(json.dumps({"peer": "numpy", "not_run": "python3-numpy is not installed"}))
    sys.exit(0)


def circle(count, arc_deg):
    random = numpy.random.default_rng(17)
    t = 0.3 + numpy.arange(count) / count * numpy.radians(arc_deg)
    r = 100 + 0.004 * numpy.cos(2 * t) + 0.002 * numpy.cos(3 * t + 1) + random.normal(0, 0.0005, count)
    return 3 + r * numpy.cos(t), -2 + r * numpy.sin(t)


def fastest(work, *points):
    best, until = float("inf"), time.perf_counter() + 1
    while time.perf_counter() < until:
        begin = time.perf_counter()
        work(*points)
        best = min(best, time.perf_counter() - begin)
    return best * 1e9


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
    peer = "numpy " + numpy.__version__
    for row, what, work, count, arc in (
            ("least squares circle, algebraic, 1e6", "lstsq", algebraic, 10 ** 6, 360),
            ("least squares circle, orthogonal, 1e6", "three lstsq", orthogonal, 10 ** 6, 360),
            *((f"minimum zone, {arc} deg, 1e{power}", "sort of x alone", lambda x, _: numpy.sort(x), 10 ** power, arc)
              for power in (6, 5, 3) for arc in (360, 220))):
        if wanted.search(row):
            print(json.dumps({"row": row, "peer": f"{peer} {what}", "ns": fastest(work, *circle(count, arc))}))


main()
