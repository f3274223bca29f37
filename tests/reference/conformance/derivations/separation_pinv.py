"""Error separation of three axes a second way: U_k as the derivative of T_{k+1}, numpy's SVD for rank and
least norm, leave-one-out by leaving one out, orders by trying all with lstsq, the dropped subspace from the SVD.

separation_pinv.py CASE.json
"""
import itertools
import json
import sys

import numpy as np
from numpy.polynomial import chebyshev

EPSILON = np.finfo(float).eps
AXES = "xyz"


def second_kind(order, t):
    """U_k(t) = T'_{k+1}(t) / (k + 1), k = 0 .. order."""
    return np.array([chebyshev.chebval(t, chebyshev.chebder(np.eye(k + 2)[k + 1])) / (k + 1) for k in range(order + 1)])


def normalised(case, axis, q):
    low, high = case["ranges_mm"][AXES[axis]]
    return (2 * np.asarray(q, float) - low - high) / (high - low)


def orders_of(case):
    order = case.get("order", 5)
    if isinstance(order, int):
        return [[order] * 3] * 3
    return order if isinstance(order[0], list) else [order] * 3


def design(case, row, orders, points):
    """Columns of one row, and for each (axis, k); axis None: the free constant."""
    signs = case.get("signs", [[1, 1, -1]] * 3)[row]
    columns, names = [], []
    for axis in range(3):
        here = second_kind(orders[axis], normalised(case, axis, points[:, axis]))
        there = second_kind(orders[axis], normalised(case, axis, case["reference_mm"][axis]))
        for k in range(orders[axis] + 1):
            if case.get("constant") == "paper":
                columns.append(signs[axis] * here[k])
            elif k > 0:
                columns.append(signs[axis] * (here[k] - there[k]))
            else:
                continue
            names.append((axis, k))
    if case.get("constant") == "free_row":
        columns.append(np.ones(len(points)))
        names.append((None, 0))
    return np.array(columns).T, names


def curve(case, axis, terms, q):
    here = second_kind(len(terms), normalised(case, axis, q))
    there = second_kind(len(terms), normalised(case, axis, case["reference_mm"][axis]))
    return sum(terms[k] * (here[k + 1] - there[k + 1]) for k in range(len(terms)))


def data_of(case):
    points, deviation = np.array(case["points_mm"], float), np.array(case["deviation_um"], float)
    deviation = deviation - np.array(case.get("reference_deviation_um", [0, 0, 0]), float)
    known = case.get("quasi_static")
    if known:
        signs = case.get("signs", [[1, 1, -1]] * 3)
        place = {**case, **{key: known[key] for key in ("ranges_mm", "reference_mm") if key in known}}
        for name, terms in known["terms"].items():
            a, b = AXES.index(name[0]), AXES.index(name[1])
            deviation[:, a] -= signs[a][b] * curve(place, b, terms, points[:, b])
    return points, deviation


def chosen_orders(case, row, points, values):
    """Least AICc; of equals (to 1e-6) the fewest columns."""
    best, least = None, np.inf
    grid = sorted(itertools.product(range(case.get("max_order", 5) + 1), repeat=3), key=sum)
    for orders in grid[1:]:
        matrix, _ = design(case, row, orders, points)
        solved, _, rank, _ = np.linalg.lstsq(matrix, values, rcond=EPSILON * max(matrix.shape))
        m, p = len(values), rank + 1
        rss = max(np.sum((values - matrix @ solved) ** 2), m * (1e-13 * np.max(np.abs(values))) ** 2)
        if m - p - 1 > 0:
            value = m * np.log(rss / m) + 2 * p + 2 * p * (p + 1) / (m - p - 1)
            if value < least - 1e-6:
                best, least = orders, value
    return list(best)


def null_space(matrix):
    _, s, vt = np.linalg.svd(matrix, full_matrices=True)
    rank = int(np.sum(s > max(matrix.shape) * EPSILON * s[0]))
    return vt[rank:].T, s, rank


def touched(vectors, names, axis):
    part = vectors[[i for i, (b, k) in enumerate(names) if b == axis and k > 0]]
    return np.linalg.norm(part, 2) if part.size else 0.0


def left_out(matrix, values):
    errors = []
    for i in range(len(values)):
        keep = np.arange(len(values)) != i
        solved = np.linalg.pinv(matrix[keep], rcond=EPSILON * max(matrix.shape)) @ values[keep]
        errors.append(values[i] - matrix[i] @ solved)
    return float(np.sqrt(np.mean(np.square(errors))))


def add_row(case, row, orders, points, values, out):
    matrix, names = design(case, row, orders, points)
    vectors, s, rank = null_space(matrix)
    inverse = np.linalg.pinv(matrix, rcond=EPSILON * max(matrix.shape))
    solved = inverse @ values
    residual = values - matrix @ solved
    out["columns"].append(matrix.shape[1])
    out["rank"].append(rank)
    out["condition"].append(s[0] / s[rank - 1])
    out["residual_rms_um"].append(np.sqrt(np.mean(residual**2)))
    out["leave_one_out_rms_um"].append(left_out(matrix, values))
    covariance = inverse @ inverse.T * np.sum(residual**2) / (len(values) - rank)
    with_one = np.column_stack([matrix, np.ones(len(values))])
    without_reference = null_space(with_one)[0]
    for axis in range(3):
        name = AXES[row] + AXES[axis]
        at = [i for i, (b, k) in enumerate(names) if b == axis and k > 0]
        out["terms"][name] = solved[at].tolist()
        out["standard_uncertainty_um"][name] = np.sqrt(np.diag(covariance)[at]).tolist()
        if case.get("constant") == "paper":
            out["constants"][name] = solved[names.index((axis, 0))]
        if touched(vectors, names, axis) > 0.1:
            out["not_separable"].append(name)
            continue
        if case.get("constant", "reference") == "reference" and touched(without_reference, names, axis) > 0.1:
            out["rests_on_reference"].append(name)
        q = np.linspace(*case["ranges_mm"][AXES[axis]], 21)
        weights = (second_kind(orders[axis], normalised(case, axis, q)).T -
                   second_kind(orders[axis], normalised(case, axis, case["reference_mm"][axis])))[:, 1:]
        out["curves"][name] = {
            "position_mm": q.tolist(), "value_um": (weights @ solved[at]).tolist(),
            "standard_uncertainty_um": np.sqrt(np.einsum("ij,jk,ik->i", weights, covariance[np.ix_(at, at)], weights)).tolist()}
    if case.get("constant") == "free_row":
        out["constants"][AXES[row]] = solved[-1]
    if vectors.shape[1] == 1:  # more than one has no fixed basis
        vector = vectors[:, 0] * np.sign(vectors[np.argmax(np.abs(vectors)), 0])
        direction = {AXES[row] + AXES[axis]: [vector[i] for i, (b, _) in enumerate(names) if b == axis] for axis in range(3)}
        if case.get("constant") == "free_row":
            direction["constant"] = vector[-1]
        out["dropped_subspace"].append({"row": AXES[row], "singular_value": s[rank] if rank < len(s) else 0.0, "direction": direction})


def separated(case):
    points, deviation = data_of(case)
    out = {key: [] for key in ("columns", "rank", "condition", "residual_rms_um", "leave_one_out_rms_um",
                               "not_separable", "rests_on_reference", "dropped_subspace", "order")}
    out.update({key: {} for key in ("terms", "constants", "standard_uncertainty_um", "curves")})
    for row in range(3):
        orders = chosen_orders(case, row, points, deviation[:, row]) if case.get("order") == "auto" else orders_of(case)[row]
        out["order"].append(list(orders))
        add_row(case, row, orders, points, deviation[:, row], out)
    out["points"] = len(points)
    return out


def places(value, place=""):
    steps = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for step, below in steps:
        yield from places(below, f"{place}/{step}")
    if not isinstance(value, (dict, list)):
        yield place, value.item() if isinstance(value, np.generic) else value


if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8") as text:
        document = json.load(text)
    asked = {wanted["at"] for wanted in document["expect"]}
    print(json.dumps({at: value for at, value in places(separated(document["case"])) if at in asked}))
