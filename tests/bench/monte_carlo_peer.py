#!/usr/bin/env python3
"""The session of monte_carlo_bench.cpp simulated with numpy, blocks of 2000: nanoseconds a trial, best of 5.

monte_carlo_peer.py [TRIALS]
"""
import sys
import time

import numpy

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
    trials = int(sys.argv[1]) if len(sys.argv) > 1 else 20000
    generator = numpy.random.default_rng(1)
    best = float("inf")
    for _ in range(5):
        begin = time.process_time()
        simulate(generator, trials)
        best = min(best, time.process_time() - begin)
    print(f"monte_carlo/peer/numpy_{numpy.__version__} {best / trials * 1e9:.0f} ns_per_trial")


main()
