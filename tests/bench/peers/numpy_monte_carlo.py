#!/usr/bin/env python3
"""The sessions of monte_carlo_bench.cpp simulated with numpy, in blocks of 2000, of which a cache holds most."""
import json
import re
import sys
import time

try:
    import numpy
except ImportError:
    print(json.dumps({"peer": "numpy", "not_run": "python3-numpy is not installed"}))
    sys.exit(0)

ROW, SESSIONS, MEASURED = "Monte Carlo, 1e6 sessions 11x5x2, normal", 10 ** 6, 20000
BLOCK, M, N, K = 2000, 11, 5, 2
TARGET, APPROACH = numpy.meshgrid(numpy.arange(M), numpy.arange(N), indexing="ij")
FORWARD = 2e-3 * TARGET + 1e-3 * numpy.sin(1.7 * TARGET + 2.3 * APPROACH)
BACKWARD = 2e-3 * TARGET + 1e-3 * numpy.sin(2.1 * TARGET + 1.1 * APPROACH) - 3e-3


def figures(up, down):
    mean_up, mean_down = up.mean(axis=2), down.mean(axis=2)
    up_s, down_s = K * up.std(axis=2, ddof=1), K * down.std(axis=2, ddof=1)
    means = numpy.concatenate([mean_up, mean_down], axis=1)
    spreads = numpy.concatenate([up_s, down_s], axis=1)
    reversal, r_up, r_down = mean_up - mean_down, 2 * up_s.max(axis=1), 2 * down_s.max(axis=1)
    both = (up_s + down_s + abs(reversal)).max(axis=1)
    return [(means + spreads).max(axis=1) - (means - spreads).min(axis=1),
            (mean_up + up_s).max(axis=1) - (mean_up - up_s).min(axis=1),
            (mean_down + down_s).max(axis=1) - (mean_down - down_s).min(axis=1),
            numpy.ptp(means, axis=1), numpy.ptp(mean_up, axis=1), numpy.ptp(mean_down, axis=1),
            numpy.ptp((mean_up + mean_down) / 2, axis=1), numpy.maximum(both, numpy.maximum(r_up, r_down)),
            r_up, r_down, abs(reversal).max(axis=1), reversal.mean(axis=1)]


def simulate(generator, trials):
    gathered = []
    share = (numpy.arange(M) / (M - 1))[None, :, None]
    for _ in range(trials // BLOCK):
        common = 5e-4 * generator.standard_normal((BLOCK, 7)).sum(axis=1)[:, None, None] * share
        up = FORWARD + common + 5e-4 * generator.standard_normal((BLOCK, M, N))
        down = BACKWARD + common + 5e-4 * generator.standard_normal((BLOCK, M, N))
        gathered.append(figures(up, down))
    samples = numpy.concatenate(gathered, axis=1)
    return samples.std(axis=1, ddof=1), numpy.quantile(samples, [0.025, 0.975], axis=1)


def main():
    if not re.search(sys.argv[1], ROW):
        return
    generator = numpy.random.default_rng(1)
    best = float("inf")
    for _ in range(9):
        begin = time.perf_counter()
        simulate(generator, MEASURED)
        best = min(best, time.perf_counter() - begin)
    print(json.dumps({"row": ROW, "peer": f"numpy {numpy.__version__}, of {MEASURED} sessions",
                      "ns": best * SESSIONS / MEASURED * 1e9}))


main()
