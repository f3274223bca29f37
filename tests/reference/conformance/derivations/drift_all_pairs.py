#!/usr/bin/env python3
"""Drift by trying all pairs of samples, in rational numbers.

drift_all_pairs.py CASE.json   prints {pointer: value}

A window's range is the largest difference of two samples no further apart than the window: no queue, no
rounding. Slopes by the sums of a line fit over every window, settling by trying every sample in turn.
"""
import json
import sys
from fractions import Fraction as F
from math import sqrt


def pairs(times, window):
    for i in range(len(times)):
        for j in range(i, len(times)):
            if times[j] - times[i] <= window:
                yield i, j


def change_at(times, x, minute):
    for i in range(len(times) - 1):
        if times[i] <= minute <= times[i + 1]:
            share = (minute - times[i]) / (times[i + 1] - times[i])
            return x[i] + share * (x[i + 1] - x[i]) - x[0]
    return None


def of_series(found, place, times, x, case):
    window = case.get("window_min", F(60))
    largest = max(abs(x[j] - x[i]) for i, j in pairs(times, window))
    last = min(j for i, j in pairs(times, window) if abs(x[j] - x[i]) == largest)
    first = min(i for i, j in pairs(times, window) if j == last)
    found[place + "/total/range"] = max(x) - min(x)
    found[place + "/total/from_min"], found[place + "/total/to_min"] = times[0], times[-1]
    found[place + "/total/u_EVE"] = (max(x) - min(x)) / F(2 * sqrt(3))
    found[place + "/window/range"] = largest
    found[place + "/window/from_min"], found[place + "/window/to_min"] = times[first], times[last]
    found[place + "/window/u_EVE"] = largest / F(2 * sqrt(3))
    found[place + "/end/at_min"], found[place + "/end/change"] = times[-1], x[-1] - x[0]
    for k, minute in enumerate(case.get("at_min", [F(60)])):
        change = change_at(times, x, minute)
        if change is not None:
            found[f"{place}/changes/{k}/at_min"], found[f"{place}/changes/{k}/change"] = minute, change


def slope(times, x):
    n, t, y = len(times), sum(times), sum(x)
    return (n * sum(a * b for a, b in zip(times, x)) - t * y) / (n * sum(a * a for a in times) - t * t)


def windows(times, x, window):
    """(first index, last index, slope) of every window that lies whole in the record."""
    for last in range(len(times)):
        if times[last] - times[0] >= window:
            first = next(i for i in range(len(times)) if times[last] - times[i] <= window)
            if last > first:
                yield first, last, slope(times[first:last + 1], x[first:last + 1])


def of_temperature(found, place, times, x, channel):
    window = channel.get("slope_window_min", F(60))
    slopes = list(windows(times, x, window))
    found[place + "/range"] = max(x) - min(x)
    if slopes:
        first, last, steepest = max(slopes, key=lambda one: abs(one[2]))
        found[place + "/gradient/K_per_h"] = 60 * steepest
        found[place + "/gradient/from_min"], found[place + "/gradient/to_min"] = times[first], times[last]
    for k in range(len(times)):
        band = "settled_band_K" not in channel or max(x[k:]) - min(x[k:]) <= channel["settled_band_K"]
        flat = "settled_slope_K_per_h" not in channel or (slopes and all(
            abs(60 * s) <= channel["settled_slope_K_per_h"] for first, _, s in slopes if first >= k)
            and any(first >= k for first, _, _ in slopes))
        if band and flat and times[-1] - times[k] >= window:
            found[place + "/settled_from_min"] = times[k]
            break


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        case = json.load(file, parse_float=F, parse_int=F)["case"]
    found, series = {}, {}
    for i, channel in enumerate(case.get("channels", [])):
        times = channel.get("time_min", case.get("time_min"))
        series[channel["name"]] = times, channel["readings"]
        of_series(found, f"/channels/{i}", times, channel["readings"], case)
    mm = {"mm": F(1), "um": F(1, 1000), "nm": F(1, 10 ** 6)}[case.get("unit", "um")]
    for i, tilt in enumerate(case.get("tilts", [])):
        (times, one), (_, other) = (series[name] for name in tilt["channels"])
        of_series(found, f"/tilts/{i}", times, [(a - b) * mm / tilt["distance_mm"] for a, b in zip(one, other)], case)
    for i, channel in enumerate(case.get("temperatures", [])):
        times = channel.get("time_min", case.get("time_min"))
        of_temperature(found, f"/temperatures/{i}", times, channel["readings"], channel)
    print(json.dumps({key: float(value) for key, value in found.items()}))


main()
