#!/usr/bin/env python3
"""Verdicts on limits by the definitions: the figures by positioning_styles.py in rational numbers, the
uncertainty from E_VE and the device alone, the comparison of ISO 14253-1.

positioning_limits.py CASE.json   prints {pointer: value}

u_EVE = E_VE / (2 sqrt 3), u_D = U / k; u(B)^2 = 2 u_EVE^2 / n, u(E)^2 = u_D^2 + u_EVE^2 / n, U = 2 u.
"""
import json
import math
import sys
from fractions import Fraction

from positioning_styles import deviations_of, figures_of

TO_BASE = {"mm": Fraction(1), "um": Fraction(1, 1000), "m": Fraction(1000)}


def expanded(stated, n, per_um):
    """U of B and E, in the unit of the case."""
    eve = float(stated["eve_um"]) / (2 * math.sqrt(3))
    device = float(stated["device_U_um"]) / float(stated["k"])
    reversal, systematic = 2 * eve * math.sqrt(2 / n), 2 * math.sqrt(device ** 2 + eve ** 2 / n)
    return {"B": reversal * per_um, "E": systematic * per_um}


def verdict(value, limit, uncertainty):
    return "pass" if value + uncertainty <= limit else "fail" if value - uncertainty > limit else "not_provable"


def main():
    with open(sys.argv[1], encoding="utf-8") as source:
        case = json.load(source, parse_float=Fraction, parse_int=Fraction)["case"]
    up, down = deviations_of(case, "forward"), deviations_of(case, "backward")
    figures = figures_of(case, up, down)
    target_unit = case.get("target_unit", case["unit"])
    travel = (max(case["targets"]) - min(case["targets"])) * TO_BASE[target_unit]
    if "travel" in case:
        travel = case["travel"] * TO_BASE[target_unit]
    known = expanded(case["uncertainty"], len(up[0]), float(TO_BASE["um"] / TO_BASE[case["unit"]])) \
        if "uncertainty" in case else {}
    found = {}
    for name in {limit["parameter"] for limit in case["tolerances"]["limits"]}:
        bands = [limit for limit in case["tolerances"]["limits"] if limit["parameter"] == name
                 and limit.get("travel_up_to_mm", math.inf) >= travel]
        if not bands:
            found[f"/verdicts/{name}/verdict"] = "not_evaluated"
            continue
        chosen = min(bands, key=lambda limit: limit.get("travel_up_to_mm", math.inf))
        limit = chosen["limit"] * TO_BASE[case["tolerances"]["unit"]] / TO_BASE[case["unit"]]
        value = abs(figures[name])
        found[f"/verdicts/{name}/limit"] = float(limit)
        found[f"/verdicts/{name}/value"] = float(figures[name])
        if "travel_up_to_mm" in chosen:
            found[f"/verdicts/{name}/travel_up_to_mm"] = float(chosen["travel_up_to_mm"])
        found[f"/verdicts/{name}/comparison"] = "within_limit" if value <= limit else "beyond_limit"
        found[f"/verdicts/{name}/verdict"] = "not_evaluated"
        if name in known:
            found[f"/verdicts/{name}/expanded_uncertainty"] = known[name]
            found[f"/verdicts/{name}/guard_band"] = known[name]  # of the rule guard-U
            found[f"/verdicts/{name}/verdict"] = verdict(float(value), float(limit), known[name])
    print(json.dumps(found))


if __name__ == "__main__":
    main()
