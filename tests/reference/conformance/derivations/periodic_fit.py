#!/usr/bin/env python3
"""Periodic error by another road: numpy's singular value decomposition for the fit, and for an unknown
pitch the least residual over a fine grid, narrowed by golden sections (no derivative, no periodogram).

periodic_fit.py CASE.json   prints {pointer: value}
"""
import json
import math
import sys

import numpy as np


def columns(x, pitch, harmonics):
    waves = [wave(2 * np.pi * h * x / pitch) for h in range(1, harmonics + 1) for wave in (np.cos, np.sin)]
    return np.column_stack([np.ones_like(x), x, *waves])


def residual(x, y, pitch, harmonics):
    model = columns(x, pitch, harmonics)
    solution = np.linalg.lstsq(model, y, rcond=None)[0]
    rest = y - model @ solution
    return float(rest @ rest), solution


def found_pitch(x, y, harmonics):
    """Residuals at 40 pitches a line width, then golden sections in the frequency."""
    span = x.max() - x.min()
    step = span / (len(np.unique(x)) - 1)
    grid = np.arange(2 / span, 1 / (4 * harmonics * step), 1 / (40 * span))
    # as defined: the peak of one wave, refined over all harmonics
    start = min(grid, key=lambda f: residual(x, y, 1 / f, 1)[0])
    low, high = start - 1 / (20 * span), start + 1 / (20 * span)
    ratio = (math.sqrt(5) - 1) / 2
    while high - low > 1e-9 * start:
        a, b = high - ratio * (high - low), low + ratio * (high - low)
        if residual(x, y, 1 / a, harmonics)[0] < residual(x, y, 1 / b, harmonics)[0]:
            high = b
        else:
            low = a
    return 2 / (low + high)


def peak_to_valley(pairs):
    """Of the sum: a million places of one period (off by less than 2e-11 of the amplitude)."""
    t = np.linspace(0, 2 * np.pi, 1_000_001)
    total = sum(c * np.cos((h + 1) * t) + s * np.sin((h + 1) * t) for h, (c, s) in enumerate(pairs))
    return float(total.max() - total.min())


def condition(x, pitch, harmonics):
    """Of the columns about the middle: largest over smallest diagonal of R."""
    middle, half = (x.max() + x.min()) / 2, (x.max() - x.min()) / 2
    model = columns(x - middle, pitch, harmonics)
    model[:, 1] /= half
    diagonal = np.abs(np.diag(np.linalg.qr(model, mode="r")))
    return float(diagonal.max() / diagonal.min())


def weight(x, y, pitch, harmonics):
    """Share of one wave at the pitch, and the false alarm over the default range of pitches."""
    line = np.column_stack([np.ones_like(x), x])
    rest = y - line @ np.linalg.lstsq(line, y, rcond=None)[0]
    share = 1 - residual(x, y, pitch, 1)[0] / float(rest @ rest)
    span = float(x.max() - x.min())
    shortest, longest = 4 * harmonics * span / (len(np.unique(x)) - 1), span / 2
    n = len(x)
    one = (1 - share) ** ((n - 4) / 2)
    # Baluev, MNRAS 385 (2008) 1279, (6) and table 1: maxima of the whole band, the variance unknown
    band = (1 / shortest - 1 / longest) * math.sqrt(4 * math.pi * float(np.var(x)))
    gamma = math.sqrt(2 / (n - 2)) * math.exp(math.lgamma((n - 2) / 2) - math.lgamma((n - 3) / 2))
    peaks = gamma * band * (1 - share) ** ((n - 5) / 2) * math.sqrt((n - 2) * share / 2)
    return {"/search/explained_share": share, "/search/pitch_range/0": shortest, "/search/pitch_range/1": longest,
            "/search/false_alarm_probability": 1 - (1 - one) * math.exp(-peaks)}


def main():
    with open(sys.argv[1], encoding="utf-8") as source:
        case = json.load(source)["case"]
    x, y = np.array(case["positions"], float), np.array(case["deviations"], float)
    harmonics = case.get("harmonics", 2)
    pitch = case["pitch"] if "pitch" in case else found_pitch(x, y, harmonics)
    squares, solution = residual(x, y, pitch, harmonics)
    pairs = [(solution[2 * h], solution[2 * h + 1]) for h in range(1, harmonics + 1)]
    fitted = 2 + 2 * harmonics + ("pitch" not in case)
    span = float(x.max() - x.min())
    found = {"/pitch": pitch, "/offset": solution[0], "/slope": solution[1],
             "/peak_to_valley": peak_to_valley(pairs), "/residual_rms": math.sqrt(squares / len(x)),
             "/residual_standard_deviation": math.sqrt(squares / (len(x) - fitted)),
             "/periods": span / pitch, "/points_per_period": pitch * (len(np.unique(x)) - 1) / span}
    found["/condition"] = condition(x, pitch, harmonics)
    if "pitch" not in case:
        found.update(weight(x, y, pitch, harmonics))
    for h, (c, s) in enumerate(pairs):
        amplitude = math.hypot(c, s)
        found.update({f"/harmonics/{h}/amplitude": amplitude, f"/harmonics/{h}/phase_rad": math.atan2(s, c),
                      f"/harmonics/{h}/peak_to_valley": 2 * amplitude})
    print(json.dumps({place: float(value) for place, value in found.items()}))


if __name__ == "__main__":
    main()
