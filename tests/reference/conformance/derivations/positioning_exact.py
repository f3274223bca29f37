#!/usr/bin/env python3
"""ISO 230-2 from the definitions, in rational numbers: no rounding but the last one of each figure.

positioning_exact.py CASE.json   prints {pointer: value}

The decimal numbers of the case are read as the fractions they are printed as; means, reversals and
sums of squares are exact; a root is taken to 60 digits. No sum is re-based, no order of operations
matters, so the method shares nothing with a program that works in doubles.
"""
import json
import sys
from decimal import Decimal, localcontext
from fractions import Fraction

COVER = {"ISO 230-2:1988": 3, "ISO 230-2:1997": 2, "ISO 230-2:2006": 2, "ISO 230-2:2014": 2}


def root(value):
    """The square root of a fraction, wrong by less than one part in 1e60."""
    with localcontext() as context:
        context.prec = 70
        return Fraction((Decimal(value.numerator) / Decimal(value.denominator)).sqrt())


def mean(row):
    return sum(row) / len(row)


def deviation(row):
    centre = mean(row)
    return root(sum((x - centre) ** 2 for x in row) / (len(row) - 1))


def deviations(case, side):
    rows = case.get(side, [])
    if case["readings"] == "positions":
        return [[x - target for x in row] for target, row in zip(case["targets"], rows)]
    return rows


def table(case):
    """One dictionary a target, with the names of the result."""
    up, down, k = deviations(case, "forward"), deviations(case, "backward"), COVER[case["standard"]]
    rows = []
    for i, forward in enumerate(up):
        row = {"mean_forward": mean(forward)}
        if down:
            row["mean_backward"] = mean(down[i])
            row["mean"] = (row["mean_forward"] + row["mean_backward"]) / 2
            row["B"] = row["mean_forward"] - row["mean_backward"]
        if len(forward) > 1:
            row["s_forward"] = deviation(forward)
            row["R_forward"] = 2 * k * row["s_forward"]
        if down and len(forward) > 1:
            row["s_backward"] = deviation(down[i])
            row["R_backward"] = 2 * k * row["s_backward"]
            row["R"] = max(k * row["s_forward"] + k * row["s_backward"] + abs(row["B"]),
                           row["R_forward"], row["R_backward"])
        rows.append(row)
    return rows, k


def band(rows, sides, k):
    """Width of all mean +- k s of these sides."""
    high = [row["mean_" + side] + k * row.get("s_" + side, 0) for row in rows for side in sides]
    low = [row["mean_" + side] - k * row.get("s_" + side, 0) for row in rows for side in sides]
    return max(high) - min(low)


def axis(rows, k):
    sides = [side for side in ("forward", "backward") if "mean_" + side in rows[0]]
    spread = "s_forward" in rows[0]
    figures = {}
    for side in sides:
        figures["E_" + side] = band(rows, [side], 0)
        if spread:
            figures["A_" + side] = band(rows, [side], k)
            figures["R_" + side] = max(row["R_" + side] for row in rows)
    if len(sides) == 2:
        figures["E"] = band(rows, sides, 0)
        figures["M"] = max(row["mean"] for row in rows) - min(row["mean"] for row in rows)
        figures["B"] = max(abs(row["B"]) for row in rows)
        figures["B_mean"] = mean([row["B"] for row in rows])
        if spread:
            figures["A"] = band(rows, sides, k)
            figures["R"] = max(row["R"] for row in rows)
    return figures


def main():
    with open(sys.argv[1], encoding="utf-8") as source:
        case = json.load(source, parse_float=Fraction, parse_int=Fraction)["case"]
    rows, k = table(case)
    found = {f"/parameters/{name}/value": float(value) for name, value in axis(rows, k).items()}
    for i, row in enumerate(rows):
        found.update({f"/positions/{i}/{name}": float(value) for name, value in row.items()})
    print(json.dumps(found))


main()
