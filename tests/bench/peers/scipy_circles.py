#!/usr/bin/env python3
"""scipy (of the root that peer_root.sh made) on the circles of circle_bench.cpp: the zone by Nelder and Mead over its width,
without a certificate, and by a linear programme of HiGHS linearised three times; the orthogonal circle by least_squares."""
import json
import os
import pathlib
import re
import sys
import time

import bench_circles

ROOT = pathlib.Path(os.environ.get("AXISCAL_PEER_ROOT", "build/peers")).resolve()
LIBRARIES = ROOT / "usr/lib/x86_64-linux-gnu"
if ROOT.exists() and str(LIBRARIES) not in os.environ.get("LD_LIBRARY_PATH", ""):
    folders = [LIBRARIES, LIBRARIES / "lapack", LIBRARIES / "blas"]
    os.environ["LD_LIBRARY_PATH"] = ":".join(map(str, folders))
    os.execv(sys.executable, [sys.executable, "-B", *sys.argv])
sys.path.append(str(ROOT / "usr/lib/python3/dist-packages"))
try:
    import numpy
    import scipy
    from scipy import optimize
except ImportError as error:
    print(json.dumps({"peer": "scipy", "not_run": str(error)}))
    sys.exit(0)

PEER = "scipy " + scipy.__version__


def by_simplex(x, y):
    def width(centre):
        d = numpy.hypot(x - centre[0], y - centre[1])
        return d.max() - d.min()
    return optimize.minimize(width, [x.mean(), y.mean()], method="Nelder-Mead", options={"xatol": 1e-10, "fatol": 1e-10})


def by_programme(x, y):
    """min R - r with r <= distance <= R, linear about the last centre."""
    a, b = x.mean(), y.mean()
    for _ in range(3):
        dx, dy = x - a, y - b
        d = numpy.hypot(dx, dy)
        one, none = numpy.ones_like(d), numpy.zeros_like(d)
        inside = numpy.column_stack([-dx / d, -dy / d, -one, none])
        outside = numpy.column_stack([dx / d, dy / d, none, one])
        solved = optimize.linprog([0, 0, 1, -1], A_ub=numpy.vstack([inside, outside]), b_ub=numpy.concatenate([-d, d]),
                                  bounds=[(None, None)] * 4, method="highs")
        a, b = a + solved.x[0], b + solved.x[1]


def orthogonal(x, y):
    def residual(p):
        return numpy.hypot(x - p[0], y - p[1]) - p[2]

    def jacobian(p):
        d = numpy.hypot(x - p[0], y - p[1])
        return numpy.column_stack([(p[0] - x) / d, (p[1] - y) / d, -numpy.ones_like(d)])
    return optimize.least_squares(residual, [x.mean(), y.mean(), 100], jac=jacobian, method="lm")


def fastest(work, x, y):
    best, until = float("inf"), time.perf_counter() + 1
    while time.perf_counter() < until:
        begin = time.perf_counter()
        work(x, y)
        best = min(best, time.perf_counter() - begin)
    return best * 1e9


def main():
    wanted = re.compile(sys.argv[1])
    jobs = [(row, count, arc, "Nelder-Mead, no certificate", by_simplex) for row, count, arc in bench_circles.ZONES]
    jobs += [(row, count, arc, "HiGHS, 3 linearisations", by_programme) for row, count, arc in bench_circles.ZONES if count < 10 ** 6]
    jobs.append(("least squares circle, orthogonal, 1e6", 10 ** 6, 360, "least_squares", orthogonal))
    for row, count, arc, what, work in jobs:
        if wanted.search(row):
            x, y = numpy.array(bench_circles.circle(count, arc)).T.copy()
            print(json.dumps({"row": row, "peer": f"{PEER} {what}", "ns": fastest(work, x, y)}), flush=True)


main()
