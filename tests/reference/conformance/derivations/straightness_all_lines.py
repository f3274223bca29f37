#!/usr/bin/env python3
"""Straightness, squareness and angles from the definitions, in rational numbers.

straightness_all_lines.py CASE.json   prints {pointer: value}

Minimum zone: the least perpendicular width over the lines through every pair of points, as the width of
a point set is always taken on a line through two of them: no hull, no callipers. Least squares by the
normal equations over the rationals.
"""
import json
import sys
from decimal import Decimal, localcontext
from fractions import Fraction as F
from math import atan, pi

LENGTH = {"um": F(1, 10 ** 6), "mm": F(1, 1000), "m": F(1)}
ANGLE = {"rad": F(1), "urad": F(1, 10 ** 6), "um/m": F(1, 10 ** 6), "arcsec": F(pi) / 648000, "deg": F(pi) / 180}


def root(value):
    with localcontext() as context:
        context.prec = 60
        return F((Decimal(value.numerator) / Decimal(value.denominator)).sqrt())


def mean(row):
    return sum(row) / len(row)


def means(side, single):
    if single in side:
        return side[single]
    up = [mean(row) for row in side["forward"]]
    if "backward" not in side:
        return up
    return [(a + mean(row)) / 2 for a, row in zip(up, side["backward"])]


def line_of(side, case):
    factor = LENGTH[case.get("target_unit", case["unit"])] / LENGTH[case["unit"]]
    if "angle_unit" not in side:
        return [x * factor for x in side["targets"]], means(side, "deviations")
    xs, ys = [side.get("start", F(0)) * factor], [F(0)]
    for angle in means(side, "angles"):
        xs.append(xs[-1] + side["base"] * factor)
        ys.append(ys[-1] + side["base"] * factor * angle * ANGLE[side["angle_unit"]])
    return xs, ys


def residual_range(xs, ys, slope):
    beside = [y - slope * x for x, y in zip(xs, ys)]
    return max(beside) - min(beside), (max(beside) + min(beside)) / 2


def end_points(xs, ys):
    slope = (ys[-1] - ys[0]) / (xs[-1] - xs[0])
    return slope, ys[0] - slope * xs[0], residual_range(xs, ys, slope)[0]


def least_squares(xs, ys):
    n, sx, sy = len(xs), sum(xs), sum(ys)
    slope = (n * sum(x * y for x, y in zip(xs, ys)) - sx * sy) / (n * sum(x * x for x in xs) - sx * sx)
    return slope, (sy - slope * sx) / n, residual_range(xs, ys, slope)[0]


def minimum_zone(xs, ys):
    """Compared by squares of the width, which are rational."""
    best = None
    for i in range(len(xs)):
        for j in range(i):
            slope = (ys[i] - ys[j]) / (xs[i] - xs[j])
            width, middle = residual_range(xs, ys, slope)
            square = width * width / (1 + slope * slope)
            if best is None or square < best[0]:
                best = square, slope, middle
    return best[1], best[2], root(best[0])


METHODS = {"end_points": end_points, "least_squares": least_squares, "minimum_zone": minimum_zone}


def straightness(case, found):
    xs, ys = line_of(case, case)
    for name, method in METHODS.items():
        slope, offset, width = method(xs, ys)
        found[f"/{name}/slope"], found[f"/{name}/offset"], found[f"/{name}/straightness"] = slope, offset, width
        for i, (x, y) in enumerate(zip(xs, ys)):
            steepness = root(1 + slope * slope) if name == "minimum_zone" else 1  # square to the line, as its width
            found[f"/{name}/residuals/{i}"] = (y - offset - slope * x) / steepness
    for i, y in enumerate(ys):
        found[f"/line/{i}"] = y
    if "backward" in case:
        found["/B"] = max(abs(mean(up) - mean(down)) for up, down in zip(case["forward"], case["backward"]))


def squareness(case, found):
    for name, method in METHODS.items():
        opened = float(case.get("optical_square_error_urad", 0)) * 1e-6
        for side in (case["first"], case["second"]):
            slope = method(*line_of(side, case))[0]
            opened -= atan(float(slope * side.get("positive_towards_other", 1)))
        found[f"/{name}/squareness_rad"] = opened
        found[f"/{name}/squareness_um_per_m"] = opened * 1e6
        found[f"/{name}/squareness_arcsec"] = opened * 648000 / pi
    found["/squareness_rad"] = found["/least_squares/squareness_rad"]
    found["/squareness_um_per_m"] = found["/squareness_rad"] * 1e6
    found["/squareness_arcsec"] = found["/squareness_rad"] * 648000 / pi
    values = [found[f"/{name}/squareness_rad"] for name in METHODS]
    found["/method_spread_rad"] = max(values) - min(values)


def spread(row):
    centre = mean(row)
    return root(sum((x - centre) ** 2 for x in row) / (len(row) - 1))


def angular(case, found):
    up, down = case["forward"], case["backward"]
    centres = [[mean(row) for row in rows] for rows in (up, down)]
    reversal = [a - b for a, b in zip(*centres)]
    r = [max(2 * spread(a) + 2 * spread(b) + abs(d), 4 * spread(a), 4 * spread(b))
         for a, b, d in zip(up, down, reversal)]
    flat = centres[0] + centres[1]
    high = [mean(row) + 2 * spread(row) for row in up + down]
    low = [mean(row) - 2 * spread(row) for row in up + down]
    for key, value in {"E": max(flat) - min(flat), "B": max(map(abs, reversal)), "R": max(r), "A": max(high) - min(low),
                       "B_mean": mean(reversal)}.items():
        found[f"/parameters/{key}/value"] = value
    found["/rad_per_unit"] = ANGLE[case["unit"]]


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        case = json.load(file, parse_float=F, parse_int=F)["case"]
    found = {}
    {"straightness": straightness, "squareness": squareness, "angular": angular}[case["analysis"]](case, found)
    print(json.dumps({key: float(value) for key, value in found.items()}))


main()
