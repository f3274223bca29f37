"""The numbers of squareness_document_test.cpp, computed a second time: exact fractions, every pair of points.

squareness_numbers.py
"""
import math
from fractions import Fraction

ARCSEC = math.pi / 648000
# axis: positions in mm, means forward and backward in um
FIRST = ([0, 150, 300, 450], ["0.0", "2.0", "3.0", "7.0"], ["-1.0", "1.0", "4.0", "6.0"])
SECOND = ([0, 100, 200, 300, 400], ["0.1", "3.2", "5.1", "4.2", "2.1"], ["-0.3", "2.4", "4.5", "3.5", "1.5"])
OTHER_FIRST = ([0, 150, 300, 450], ["0.0", "1.0", "0.4", "2.2"], ["-0.4", "0.6", "0.8", "1.8"])
OTHER_SECOND = ([0, 100, 200, 300, 400], ["0.0", "2.0", "3.0", "1.4", "-1.6"], ["0.2", "1.6", "2.6", "1.0", "-2.0"])
# every reading of the second axis, as straightness_run.hpp has them
READINGS = [["0.0", "0.2"], ["3.0", "3.4"], ["5.0", "5.2"], ["4.4", "4.0"], ["2.2", "2.0"],
            ["-0.4", "-0.2"], ["2.6", "2.2"], ["4.4", "4.6"], ["3.4", "3.6"], ["1.4", "1.6"]]
U_FACTOR, MIRROR_LIMIT, FACTOR, COUNT_UM, EVE_UM = 0.0025, 0.15, 36, 1e-4, 0.4
SCATTER_RECORDED_UM, READINGS_A_MEAN = 0.1, 4
ERROR, U_ERROR, MOUNT = 2 * ARCSEC, ARCSEC / 2, 0.5 * ARCSEC


def mean(values):
    return sum(values) / len(values)


def line(recorded):
    x, forward, backward = recorded
    return x, [(Fraction(f) + Fraction(b)) / 2 for f, b in zip(forward, backward)]


def fitted(x, y):
    xm, ym = mean([Fraction(v) for v in x]), mean(y)
    return sum((a - xm) * (v - ym) for a, v in zip(x, y)) / sum((a - xm) ** 2 for a in x)


def through_ends(x, y):
    return (y[-1] - y[0]) / (x[-1] - x[0])


def narrowest(x, y):
    """Slope of the pair of parallel lines that are least apart, one of them through two points."""
    found = []
    for i in range(len(x)):
        for j in range(i + 1, len(x)):
            slope = (y[j] - y[i]) / (x[j] - x[i])
            rest = [v - slope * a for a, v in zip(x, y)]
            found.append((float(max(rest) - min(rest)) / math.hypot(1, float(slope) / 1000), slope))
    return min(found)[1]


METHODS = {"end_points": through_ends, "least_squares": fitted, "minimum_zone": narrowest}


def apparent(first, second):
    """rad: slopes are um in a mm."""
    return {name: -math.atan(float(slope(*line(first))) / 1000) - math.atan(float(slope(*line(second))) / 1000)
            for name, slope in METHODS.items()}


def reach(recorded, scatter_um):
    """What one line adds: squares of mirror, resolution and environment, rad."""
    x = [value * 1e3 for value in recorded[0]]  # um
    xm = mean(x)
    q = sum((a - xm) ** 2 for a in x)
    length_m = (x[-1] - x[0]) / 1e6
    mirror = MIRROR_LIMIT * length_m ** 2 * sum(abs(a - xm) for a in x) / q / math.sqrt(3)
    resolution = FACTOR * COUNT_UM / (2 * math.sqrt(3)) / math.sqrt(q)
    one = max(EVE_UM / (2 * math.sqrt(3)), scatter_um)
    return mirror ** 2, resolution ** 2, one ** 2 / READINGS_A_MEAN / q


def budget(lines, seen, square, mount):
    """By reversal four lines count by half each; the mirror shows the same form to both lines of an axis, so not it."""
    share = 1 if len(lines) == 2 else 0.5
    mirror = math.sqrt(sum(reach(*one)[0] for one in lines[:2]))
    resolution, environment = (math.sqrt(sum(reach(*one)[part] for one in lines)) * share for part in (1, 2))
    terms = [abs(seen) * U_FACTOR, mirror, square, mount, resolution, environment]
    return [term * 1e6 for term in terms], 2 * math.sqrt(sum(term * term for term in terms)) * 1e6


def main():
    exact = [[Fraction(value) for value in row] for row in READINGS]
    own = math.sqrt(mean([sum((v - mean(row)) ** 2 for v in row) for row in exact]))
    print("scatter um", own, "means", [float(mean(row)) for row in exact])
    for name, recorded in (("first", FIRST), ("second", SECOND), ("other first", OTHER_FIRST),
                           ("other second", OTHER_SECOND)):
        x, y = line(recorded)
        slope = fitted(x, y)
        rest = [v - slope * a for a, v in zip(x, y)]
        print(name, {key: float(of(x, y)) * 1000 for key, of in METHODS.items()}, "um/m, straightness",
              float(max(rest) - min(rest)))
    seen, other = apparent(FIRST, SECOND), apparent(OTHER_FIRST, OTHER_SECOND)
    pair = [(FIRST, SCATTER_RECORDED_UM), (SECOND, own)]
    four = pair + [(OTHER_FIRST, SCATTER_RECORDED_UM), (OTHER_SECOND, SCATTER_RECORDED_UM)]
    print("apparent um/m", {key: value * 1e6 for key, value in seen.items()})
    for name, sign in (("stated, normal", 1), ("stated, turned", -1)):
        found = {key: (value + sign * ERROR) * 1e6 for key, value in seen.items()}
        print(name, found, "spread", max(found.values()) - min(found.values()))
        print("  arcsec", found["least_squares"] / 1e6 / ARCSEC)
    print("  terms", *budget(pair, seen["least_squares"], U_ERROR, MOUNT / math.sqrt(3)))
    both = {key: (seen[key] + other[key]) / 2 for key in seen}
    print("reversal", {key: value * 1e6 for key, value in both.items()}, "error um/m",
          (other["least_squares"] - seen["least_squares"]) / 2 * 1e6)
    print("  terms", *budget(four, both["least_squares"], 0, MOUNT / math.sqrt(3) / math.sqrt(2)))


if __name__ == "__main__":
    main()
