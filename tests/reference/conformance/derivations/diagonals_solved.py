#!/usr/bin/env python3
"""Diagonals by a general solver instead of the closed solution.

diagonals_solved.py CASE.json   prints {pointer: value}

The linear model of the lengths is built as a matrix, one row a diagonal, and solved by singular values;
the step-diagonal test as one system of all moves of all diagonals. E, B, R by numpy from the definition.
"""
import json
import sys

import numpy as np

PAIRS = {"xy": (0, 1), "xz": (0, 2), "yz": (1, 2)}


def rows(diagonal, side):
    if "deviations" in diagonal:
        return np.array([[value] for value in diagonal["deviations"]]) if side == "forward" else None
    return np.array(diagonal[side]) if side in diagonal else None


def positioning(diagonal):
    """ISO 230-2 of one diagonal, zero at its start: parameters, slope, middle curve, figures of each target."""
    sides = {side: rows(diagonal, side) for side in ("forward", "backward")}
    sides = {side: readings for side, readings in sides.items() if readings is not None}
    start = np.mean([readings[0].mean() for readings in sides.values()])
    sides = {side: readings - start for side, readings in sides.items()}
    means = {side: readings.mean(axis=1) for side, readings in sides.items()}
    at = {"mean_" + side: mean for side, mean in means.items()}
    figures = {"E_" + side: np.ptp(mean) for side, mean in means.items()}
    at["mean"] = centre = np.mean(list(means.values()), axis=0)
    figures["E"] = np.ptp(list(means.values()))
    if len(means) == 2:
        figures["M"] = np.ptp(centre)
        at["B"] = means["forward"] - means["backward"]
        figures["B"], figures["B_mean"] = np.max(np.abs(at["B"])), np.mean(at["B"])
    if sides["forward"].shape[1] > 1:
        spreads(sides, means, at, figures)
    slope = np.polyfit(diagonal["targets"], centre, 1)[0]
    return figures, slope, centre, at


def spreads(sides, means, at, figures):
    s = {side: readings.std(axis=1, ddof=1) for side, readings in sides.items()}
    for side in sides:
        at["s_" + side], at["R_" + side] = s[side], 4 * s[side]
        figures["R_" + side] = np.max(4 * s[side])
        figures["A_" + side] = np.max(means[side] + 2 * s[side]) - np.min(means[side] - 2 * s[side])
    if len(sides) == 2:
        both = 2 * s["forward"] + 2 * s["backward"] + np.abs(at["B"])
        at["R"] = np.max([both, at["R_forward"], at["R_backward"]], axis=0)
        figures["R"] = np.max(at["R"])
        figures["A"] = np.max([means[side] + 2 * s[side] for side in sides]) \
            - np.min([means[side] - 2 * s[side] for side in sides])


def displacement(case, found):
    box = np.array([case["box"][axis] for axis in "xyz"])
    results = [positioning(diagonal) for diagonal in case["diagonals"]]
    signs = np.array([diagonal["signs"] for diagonal in case["diagonals"]])
    lengths = np.sqrt((np.abs(signs) * box ** 2).sum(axis=1))
    for i, (figures, slope, centre, at) in enumerate(results):
        targets = case["diagonals"][i]["targets"]
        found[f"/diagonals/{i}/length"] = lengths[i]
        found[f"/diagonals/{i}/length_error"] = slope * lengths[i]
        found[f"/diagonals/{i}/slope_least_squares"] = slope
        found[f"/diagonals/{i}/slope_end_points"] = (centre[-1] - centre[0]) / (targets[-1] - targets[0])
        for key, value in figures.items():
            found[f"/diagonals/{i}/parameters/{key}/value"] = value
        for key, values in at.items():
            found.update({f"/diagonals/{i}/positions/{k}/{key}": value for k, value in enumerate(values)})
    for kind, mask in (("body", np.all(signs != 0, axis=1)), ("faces", np.any(signs == 0, axis=1))):
        chosen = [results[i] for i in np.flatnonzero(mask)]
        if chosen:
            for key in ("E", "B", "R"):
                if key in chosen[0][0]:
                    found[f"/{kind}/{key}_d"] = max(one[0][key] for one in chosen)
            found[f"/{kind}/slope_spread"] = max(one[1] for one in chosen) - min(one[1] for one in chosen)
    errors = np.array([slope for _, slope, _, _ in results]) * lengths
    solve("/from_body_diagonals", np.all(signs != 0, axis=1), list(PAIRS), box, signs, lengths, errors, found)
    for pair, (i, j) in PAIRS.items():
        on_face = (signs[:, i] != 0) & (signs[:, j] != 0) & np.any(signs == 0, axis=1)
        solve("/from_face_diagonals/" + pair, on_face, [pair], box, signs, lengths, errors, found)


def solve(place, mask, pairs, box, signs, lengths, errors, found):
    """Unknowns: the common scale, then the squareness of each pair; dL L_d = scale L_d^2 - sum s s beta L L."""
    chosen = np.flatnonzero(mask)
    if len(chosen) <= len(pairs):
        return
    matrix = np.array([[lengths[k] ** 2] + [-signs[k][i] * signs[k][j] * box[i] * box[j]
                                            for i, j in (PAIRS[pair] for pair in pairs)] for k in chosen])
    solution = np.linalg.lstsq(matrix, errors[chosen] * lengths[chosen], rcond=None)[0]
    found[place + "/common_scale"] = solution[0]
    for pair, value in zip(pairs, solution[1:]):
        found[f"{place}/squareness_rad/{pair}"] = value


def step(case, found):
    box = np.array([case["box"][axis] for axis in "xyz"])
    order = ["xyz".index(letter) for letter in case.get("order", "xyz")]
    n = len(case["diagonals"][0]["deviations"]) // 3
    length = np.sqrt((box ** 2).sum())

    def unknown(direction, axis, segment):
        return (direction * 3 + axis) * n + segment

    matrix, right = [], []
    for diagonal in case["diagonals"]:
        signs, row = diagonal["signs"], np.zeros(9 * n)
        for move, reading in enumerate(diagonal["deviations"]):
            axis, at = order[move % 3], move // 3
            segment = at if signs[axis] > 0 else n - 1 - at
            for direction in range(3):
                row[unknown(direction, axis, segment)] += signs[axis] * signs[direction] * box[direction] / length
            matrix.append(row.copy())
            right.append(reading)
    solution = np.linalg.lstsq(np.array(matrix), np.array(right), rcond=None)[0]
    closures(np.array(matrix) @ solution - np.array(right), order, case["diagonals"], found)
    ends = np.zeros((3, 3))
    for axis in range(3):
        for direction in range(3):
            curve = np.cumsum([0] + [solution[unknown(direction, axis, k)] for k in range(n)])
            ends[direction, axis] = curve[-1]
            for node, value in enumerate(curve):
                found[f"/moving/{'xyz'[axis]}/{'xyz'[direction]}/{node}"] = value
    for pair, (i, j) in PAIRS.items():
        found[f"/squareness_rad/{pair}"] = -(ends[j, i] / box[i] + ends[i, j] / box[j])


def closures(residual, order, diagonals, found):
    """What no error explains: each segment has four changes of reading and three unknowns, so what the solution leaves of
    the four is one number up to sign; the largest of an axis."""
    n = len(residual) // len(diagonals) // 3
    largest = np.zeros(3)
    for k, diagonal in enumerate(diagonals):
        changes = np.diff(residual[3 * n * k:3 * n * (k + 1)], prepend=0)
        for move, change in enumerate(changes):
            largest[order[move % 3]] = max(largest[order[move % 3]], abs(change))
    for axis in range(3):
        found[f"/moving/{'xyz'[axis]}/closure"] = largest[axis]


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        case = json.load(file)["case"]
    found = {}
    (step if case.get("kind") == "step" else displacement)(case, found)
    print(json.dumps({key: float(value) for key, value in found.items()}))


main()
