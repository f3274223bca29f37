#!/usr/bin/env python3
"""The fit of chebyshev_bench.cpp by numpy's chebfit."""
import json
import re
import sys
import time

try:
    import numpy
    from numpy.polynomial import chebyshev
except ImportError:
    print(json.dumps({"peer": "numpy", "not_run": "python3-numpy is not installed"}))
    sys.exit(0)

ROW, POINTS = "Chebyshev fit, 1e6 points, degree 12", 10 ** 6


def main():
    if not re.search(sys.argv[1], ROW):
        return
    generator = numpy.random.default_rng(1)
    x = generator.uniform(0, 80, POINTS)
    y = 4 * numpy.sin(x / 9) + generator.normal(0, 0.3, POINTS)
    best = float("inf")
    for _ in range(5):
        begin = time.perf_counter()
        chebyshev.chebfit((2 * x - 80) / 80, y, 12)
        best = min(best, time.perf_counter() - begin)
    print(json.dumps({"row": ROW, "peer": f"numpy {numpy.__version__} chebfit", "ns": best * 1e9}))


main()
