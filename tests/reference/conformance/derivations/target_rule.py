#!/usr/bin/env python3
"""Target rule of ISO 230-2: counts by table, the random part by trying every grid that can be best.

target_rule.py CASE.json   prints {pointer: value}

The largest |r| / p of the best begin is (max - min of P_i q - i) / 2 with q = 1 / p. It is convex and
piecewise linear in q, so its least value lies where two of the lines P_i q - i cross. In fractions.
"""
import json
import sys
from fractions import Fraction
from itertools import combinations
from math import ceil

TO_BASE = {"mm": Fraction(1), "um": Fraction(1, 1000), "m": Fraction(1000), "deg": Fraction(1),
           "arcsec": Fraction(1, 3600)}


def width(targets, q):
    values = [target * q - i for i, target in enumerate(targets)]
    return max(values) - min(values)


def best_grid(targets):
    crossings = {Fraction(j - i) / (b - a) for (i, a), (j, b) in combinations(enumerate(targets), 2)}
    q = min(crossings, key=lambda q: width(targets, q))
    return width(targets, q) / 2, 1 / q


def rule(kind, travel):
    """least targets, largest mean interval (None), approaches"""
    if kind == "linear":
        return (2, 250, 1) if travel > 2000 else (max(5, ceil(5 * travel / 1000)), None, 5)
    if travel > 360:
        return 2, 45, 1
    return (3 if travel <= 90 else 5 if travel <= 180 else 8), 45, 5


def main():
    with open(sys.argv[1], encoding="utf-8") as source:
        case = json.load(source, parse_float=Fraction, parse_int=Fraction)["case"]
    base = TO_BASE[case.get("target_unit", case["unit"])]
    targets = sorted(target * base for target in case["targets"])
    reach = targets[-1] - targets[0]
    travel = case["travel"] * base if "travel" in case else reach
    least, widest, approaches = rule(case["axis"]["kind"], travel)
    mean_interval = reach / (len(targets) - 1)
    made = len(case["forward"][0]) if "forward" in case else int(case.get("approaches", 5))
    if "interval" in case:
        share, interval = width(targets, 1 / (case["interval"] * base)) / 2, case["interval"] * base
    else:
        share, interval = best_grid(targets)
    kept = len(targets) >= least and share <= Fraction(3, 10) and made >= approaches and \
        (widest is None or mean_interval <= widest)
    found = {"kept": kept, "travel": float(travel), "least_targets": least, "least_approaches": approaches,
             "mean_interval": float(mean_interval), "random_share": float(share), "interval": float(interval)}
    if widest is not None:
        found["largest_mean_interval"] = widest
    print(json.dumps({"/target_rule/" + key: value for key, value in found.items()}))


if __name__ == "__main__":
    main()
