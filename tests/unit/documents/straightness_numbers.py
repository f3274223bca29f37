"""The numbers of straightness_document_test.cpp, computed a second time: exact fractions, every pair of points.

straightness_numbers.py
"""
import math
from fractions import Fraction

X_MM = [0, 100, 200, 300, 400]
FORWARD = [["0.0", "0.2"], ["3.0", "3.4"], ["5.0", "5.2"], ["4.4", "4.0"], ["2.2", "2.0"]]
BACKWARD = [["-0.4", "-0.2"], ["2.6", "2.2"], ["4.4", "4.6"], ["3.4", "3.6"], ["1.4", "1.6"]]
U_FACTOR, MIRROR_LIMIT, FACTOR, COUNT_UM, EVE_UM = 0.0025, 0.15, 36, 1e-4, 0.4


def exact(rows):
    return [[Fraction(value) for value in row] for row in rows]


def mean(values):
    return sum(values) / len(values)


def variance(values):
    return sum((value - mean(values)) ** 2 for value in values) / (len(values) - 1)


def span(values):
    return max(values) - min(values)


def through_ends(y):
    slope = (y[-1] - y[0]) / (X_MM[-1] - X_MM[0])
    return slope, [v - y[0] - slope * (x - X_MM[0]) for x, v in zip(X_MM, y)]


def fitted(y):
    xm, ym = mean([Fraction(x) for x in X_MM]), mean(y)
    slope = sum((x - xm) * (v - ym) for x, v in zip(X_MM, y)) / sum((x - xm) ** 2 for x in X_MM)
    return slope, [v - ym - slope * (x - xm) for x, v in zip(X_MM, y)]


def narrowest(y):
    found = []
    for i in range(len(X_MM)):
        for j in range(i + 1, len(X_MM)):
            slope = (y[j] - y[i]) / (X_MM[j] - X_MM[i])
            height = span([v - slope * x for x, v in zip(X_MM, y)])
            found.append(float(height) / math.hypot(1, float(slope) / 1000))
    return min(found)


def fitted_weights(y):
    _, residuals = fitted(y)
    high, low = residuals.index(max(residuals)), residuals.index(min(residuals))
    xm = mean(X_MM)
    share = (X_MM[high] - X_MM[low]) / sum((x - xm) ** 2 for x in X_MM)
    return [(i == high) - (i == low) - share * (x - xm) for i, x in enumerate(X_MM)]


def expanded(y, scatter, readings):
    straightness = float(span(fitted(y)[1]))
    reach = math.sqrt(sum(w * w for w in fitted_weights(y)))
    one = max(EVE_UM / (2 * math.sqrt(3)), scatter)
    terms = [straightness * U_FACTOR, MIRROR_LIMIT * 0.4 ** 2 / math.sqrt(3),
             FACTOR * COUNT_UM / (2 * math.sqrt(3)) * reach, one / math.sqrt(readings) * reach]
    return terms, 2 * math.sqrt(sum(term * term for term in terms))


def main():
    forward, backward = exact(FORWARD), exact(BACKWARD)
    up, down = [mean(row) for row in forward], [mean(row) for row in backward]
    both = [(u + d) / 2 for u, d in zip(up, down)]
    variances = [variance(row) for row in forward + backward]
    scatter = math.sqrt(mean(variances))
    for name, y, readings in (("mean", both, 4), ("forward", up, 2), ("backward", down, 2)):
        terms, bounds = expanded(y, scatter, readings)
        print(name, "ends", float(span(through_ends(y)[1])), "fit", float(span(fitted(y)[1])), "zone", narrowest(y))
        print("  slope um/m", float(fitted(y)[0]) * 1000, "residuals", [float(r) for r in fitted(y)[1]])
        print("  terms", terms, "U", bounds)
    reversals = [u - d for u, d in zip(up, down)]
    spread = [(math.sqrt(variance(f)), math.sqrt(variance(b))) for f, b in zip(forward, backward)]
    repeatability = max(max(2 * f + 2 * b + abs(float(r)), 4 * f, 4 * b) for (f, b), r in zip(spread, reversals))
    print("B", max(float(abs(r)) for r in reversals), "B_mean", float(mean(reversals)), "R", repeatability)
    print("s", scatter)


if __name__ == "__main__":
    main()
