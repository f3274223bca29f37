#!/usr/bin/env python3
"""Uncertainty of the circular figures from the stated terms; rectangular terms by their full width.

circular_uncertainty.py CASE.json    prints {pointer: value}

The trials are independent of the formula; here they are expected where theory gives them without trials: every term but the
drift disturbs F and D by its own standard uncertainty exactly.
"""
import json
import math
import pathlib
import sys


def main():
    document = json.loads(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))
    case = document["case"]
    R, warm, stated = case["nominal_radius_mm"], case["temperature"], case["uncertainty"]

    def width(key):
        return stated.get(key, 0.0) / math.sqrt(12)

    n = stated.get("n", 1)
    L = warm["bar_length_mm"]
    device, repeat = width("device_width_um") * 1e-3, stated.get("repeatability_um", 0.0) * 1e-3 / math.sqrt(n)
    drift = width("eve_um") * 1e-3 / math.sqrt(n)
    terms = [stated.get("calibration_U_um", 0.0) * 1e-3 / stated.get("calibration_k", 1),
             R * warm["machine_expansion_per_K"] * width("machine_temperature_width_K"),
             L * warm["bar_expansion_per_K"] * width("bar_temperature_width_K"),
             R * abs(warm["machine_degC"] - 20) * width("machine_expansion_width_per_K"),
             L * abs(warm["bar_degC"] - 20) * width("bar_expansion_width_per_K")]
    u = {"G": math.sqrt(device ** 2 + repeat ** 2 + drift ** 2),
         "D": math.sqrt(sum(t * t for t in terms) + repeat ** 2 + drift ** 2)}
    u["F"] = math.hypot(u["D"], device)
    found = {}
    for key in ("G_ccw", "G_cw", "G_b", "F_max_ccw", "F_min_ccw", "F_max_cw", "F_min_cw", "D"):
        for place in ("value", "monte_carlo"):
            found[f"/parameters/{key}/expanded_uncertainty/{place}"] = 2 * u[key[0]]
    for place, term in enumerate([device, terms[0], repeat, *terms[1:]]):
        found[f"/budget/contributions/{place}/u_mm"] = term
    print(json.dumps({wanted["at"]: found[wanted["at"]] for wanted in document["expect"] if wanted["at"] in found}))


if __name__ == "__main__":
    main()
