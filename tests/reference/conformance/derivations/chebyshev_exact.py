"""Chebyshev fit in rational numbers: normal equations of T_k, and apart from them of U_k, solved exactly.

chebyshev_exact.py CASE.json      (the condition of the Gram matrix: numpy's singular values of its root, squared)
"""
import json
import sys
from fractions import Fraction as F

import numpy as np
from numpy.polynomial import chebyshev

from separation_pinv import places


def basis(t, degree, second_kind):
    """T_k (or U_k) of a rational number, k = 0 .. degree."""
    values = [F(1), 2 * t if second_kind else t]
    while len(values) <= degree:
        values.append(2 * t * values[-1] - values[-2])
    return values[:degree + 1]


def solved(rows, values):
    n = len(rows[0])
    system = [[sum(row[i] * row[j] for row in rows) for j in range(n)] + [sum(row[i] * y for row, y in zip(rows, values))]
              for i in range(n)]
    for i in range(n):  # Gauss; the matrix is positive, every pivot is
        for j in range(i + 1, n):
            factor = system[j][i] / system[i][i]
            system[j] = [a - factor * b for a, b in zip(system[j], system[i])]
    for i in reversed(range(n)):
        system[i][n] = (system[i][n] - sum(system[i][k] * system[k][n] for k in range(i + 1, n))) / system[i][i]
    return [row[n] for row in system]


def fitted(case):
    x, y, degree = [F(v) for v in case["x"]], [F(v) for v in case["y"]], case["degree"]
    low, high = (F(v) for v in case.get("range", [min(case["x"]), max(case["x"])]))
    t = [(2 * v - low - high) / (high - low) for v in x]
    first = [basis(v, degree, False) for v in t]
    terms = solved(first, y)
    squares = sum((v - sum(a * b for a, b in zip(terms, row))) ** 2 for v, row in zip(y, first))
    condition = np.linalg.cond(chebyshev.chebvander(np.array([float(v) for v in t]), degree)) ** 2
    second = solved([basis(v, degree, True) for v in t], y)
    return {"first_kind": [float(v) for v in terms], "second_kind": [float(v) for v in second], "gram_condition": condition,
            "rank": degree + 1, "method": "moments" if condition <= 1e6 else "qr",
            "residual_rms": float(np.sqrt(float(squares / len(y))))}


if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8") as text:
        document = json.load(text)
    asked = {wanted["at"] for wanted in document["expect"]}
    print(json.dumps({at: value for at, value in places(fitted(document["case"])) if at in asked}))
