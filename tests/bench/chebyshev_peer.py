#!/usr/bin/env python3
"""The fit of chebyshev_bench.cpp with numpy's chebfit: milliseconds, best of 3.

chebyshev_peer.py [POINTS]
"""
import sys
import time

import numpy
from numpy.polynomial import chebyshev


def main():
    points = int(float(sys.argv[1])) if len(sys.argv) > 1 else 1_000_000
    generator = numpy.random.default_rng(1)
    x = generator.uniform(0, 80, points)
    y = 4 * numpy.sin(x / 9) + generator.normal(0, 0.3, points)
    best = float("inf")
    for _ in range(3):
        begin = time.process_time()
        chebyshev.chebfit((2 * x - 80) / 80, y, 12)
        best = min(best, time.process_time() - begin)
    print(f"chebyshev/peer/numpy_{numpy.__version__}_chebfit {best * 1e3:.1f} ms")


main()
