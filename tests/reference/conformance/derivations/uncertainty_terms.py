#!/usr/bin/env python3
"""Expanded uncertainties of ISO 230-2 in 50 digits, by adding variances reading by reading.

uncertainty_terms.py CASE.json   prints {pointer: value}

No combined formula is used: each parameter is a linear combination of readings and of errors common
to the session (sensitivities written out below), so its variance is the sum of the squares. Only the
source's own rule, that the spread of one direction stands in R and A for both, is taken as it is.
"""
import json
import sys
from decimal import Decimal as D
from decimal import getcontext

getcontext().prec = 50
PARAMETERS = ["A", "A_forward", "A_backward", "E", "E_forward", "E_backward", "M", "R", "R_forward", "R_backward",
              "B", "B_mean"]
# Order in which a result lists the terms of a budget
ORDER = ["device", "misalignment", "machine_temperature", "machine_expansion", "device_temperature",
         "device_expansion", "environment"]


def cosine(angle):
    term = total = D(1)
    for k in range(1, 25):
        term *= -angle * angle / ((2 * k - 1) * (2 * k))
        total += term
    return total


def rectangular(width):
    """Standard deviation of an even distribution, as the root of the mean square of its width."""
    return (width * width / 12).sqrt()


def terms_of(m):
    length_um = m.get("length_m", D(0)) * 1000000
    out = {}
    if "device_width" in m:
        out["device"] = rectangular(m["device_width"])
    if "device_U" in m:
        out["device"] = m["device_U"] / m["k"]
    if "misalignment_rad" in m:
        out["misalignment"] = rectangular(length_um * (1 - cosine(m["misalignment_rad"])))
    if "misalignment_mm" in m:  # the sagitta of the offset, first order as the source has it
        offset_um = m["misalignment_mm"] * 1000
        out["misalignment"] = rectangular(offset_um * offset_um / length_um / 2)
    for body, temperature, expansion in (("", "machine_temperature", "machine_expansion"),
                                         ("device_", "device_temperature", "device_expansion")):
        if body + "temperature_width_K" in m:
            per_length = m[body + "expansion_per_K"] * m[body + "temperature_width_K"]
            out[temperature] = rectangular(length_um * per_length)
        if body + "expansion_width_per_K" in m:
            per_length = m[body + "expansion_width_per_K"] * abs(m[body + "temperature_offset_K"])
            out[expansion] = rectangular(length_um * per_length)
    if "eve" in m:
        out["environment"] = rectangular(m["eve"])
    return out


def variance_of_sum(weights, u):
    return sum((w * u) ** 2 for w in weights)


def variances(case, m, terms):
    n = len(case["forward"][0])
    targets = len(case["targets"])
    k = 3 if case["standard"].endswith("1988") else 2
    u = terms.get("environment", D(0))
    common = sum(terms[name] ** 2 for name in terms if name != "environment")
    difference = m.get("eve_model") == "difference"
    mean = [D(1) / n] * n  # a mean of n readings
    end = variance_of_sum(mean, u)  # and one of its two ends in a range
    middle = variance_of_sum([D(1) / (2 * n)] * (2 * n), u)
    reversal = variance_of_sum(mean + [-w for w in mean], u)
    out = {"B": reversal, "B_mean": targets * reversal / targets ** 2}
    for direction in ("", "_forward", "_backward"):
        out["E" + direction] = common + end * (2 if difference else 1)
    out["M"] = common + middle * (2 if difference else 1)
    if n > 1:
        # ds/dx_j = d_j / ((n - 1) s), and the squares of the d_j sum to (n - 1) s^2
        spread = (2 * k) ** 2 * u ** 2 / (n - 1)
        out["R_forward"] = out["R_backward"] = spread
        out["R"] = reversal + spread
        for direction in ("", "_forward", "_backward"):
            out["A" + direction] = out["E"] + spread
        out["strict R"] = 2 * D(k) ** 2 * u ** 2 / (n - 1) + reversal
    return out


def as_simulated(case, m, terms, per_unit):
    """What a simulation must find where it is linear: extremes that keep their places at the two ends of the
    length, spreads far above the environment. It counts the environment wherever it is drawn."""
    squares = variances(case, dict(m, eve_model="difference"), terms)
    squares["R"] = squares.get("strict R", D(0))
    return {f"/parameters/{name}/monte_carlo/u": float(squares[name].sqrt() / per_unit)
            for name in PARAMETERS if name in squares and not name.startswith("A")}


def of_budgets(case, m, terms, squares):
    """How each term counts in each parameter: factor^2 u^2 add up to the square of its u."""
    found, per_term = {}, {name: variances(case, m, {name: terms[name]}) for name in terms}
    for parameter in PARAMETERS:
        counting = [name for name in ORDER if name in terms and per_term[name].get(parameter, 0) > 0]
        for place, name in enumerate(counting if parameter in squares else []):
            at = f"/parameters/{parameter}/budget/terms/{place}/"
            found[at + "term"] = name
            found[at + "u"] = terms[name]
            found[at + "factor"] = (per_term[name][parameter] / terms[name] ** 2).sqrt()
    return found


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        case = json.load(file, parse_float=D, parse_int=D)["case"]
    m = {key.replace("_arcsec", "").replace("eve_um", "eve").replace("device_U_um", "device_U")
         .replace("device_width_um", "device_width"): value for key, value in case["uncertainty"].items()}
    if "length_m" not in m and case["axis"]["kind"] == "linear":
        span = max(case["targets"]) - min(case["targets"])
        m["length_m"] = span * {"mm": D("1e-3"), "um": D("1e-6"), "m": D(1)}[case["unit"]]
    per_unit = {"mm": D(1000), "um": D(1), "m": D(1000000), "deg": D(3600)}[case["unit"]]
    terms = terms_of(m)
    found = {}
    for place, name in enumerate(name for name in ORDER if name in terms):
        found[f"/budget/terms/{place}/term"] = name
        found[f"/budget/terms/{place}/u"] = float(terms[name] / per_unit)
    if "length_m" in m:
        found["/budget/length_m"] = float(m["length_m"])
    squares = variances(case, m, terms)
    for name in PARAMETERS:
        if name in squares:
            found[f"/parameters/{name}/budget/u"] = float(squares[name].sqrt() / per_unit)
            found[f"/parameters/{name}/expanded_uncertainty/value"] = float(2 * squares[name].sqrt() / per_unit)
            target = m.get("target_uncertainty", {}).get(name)
            if target is not None:
                found[f"/parameters/{name}/target_uncertainty/met"] = 2 * squares[name].sqrt() / per_unit <= target
    for at, value in of_budgets(case, m, terms, squares).items():
        found[at] = value if at.endswith("/term") else float(value / per_unit if at.endswith("/u") else value)
    if "strict R" in squares:
        found["/parameters/R/budget/strict_propagation/u"] = float(squares["strict R"].sqrt() / per_unit)
    found.update(as_simulated(case, m, terms, per_unit))
    print(json.dumps(found))


main()
