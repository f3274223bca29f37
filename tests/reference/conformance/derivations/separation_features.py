"""Workpiece 1 a second way: all curves of a direction in one joint least squares, not one after the other.

separation_features.py CASE.json      tables are read by Python's csv
"""
import csv
import io
import json
import sys

import numpy as np

from separation_pinv import AXES, normalised, orders_of, places, second_kind


def features_of(case):
    if "measurements_csv" not in case:
        return case["features"]
    groups = {}
    for row in csv.DictReader(io.StringIO(case["measurements_csv"])):
        groups.setdefault(row["feature"], []).append(row)
    features = []
    for name, rows in groups.items():
        positions = {axis: [float(row[f"nominal_{axis}"]) for row in rows] for axis in AXES if f"nominal_{axis}" in rows[0]}
        moving = [axis for axis, list_ in positions.items() if len(set(list_)) > 1]
        for axis in AXES:
            if rows[0].get(f"cmm_{axis}"):
                features.append({"feature": name, "axis": moving[0] if len(moving) == 1 else None, "direction": axis,
                                 "nominal_mm": positions[axis], "positions_mm": positions,
                                 "on_machine_mm": [float(row[f"on_machine_{axis}"]) for row in rows],
                                 "cmm_mm": [float(row[f"cmm_{axis}"]) for row in rows]})
    return features


def deviations(feature):
    nominal, seen, total = (np.array(feature[key], float) for key in ("nominal_mm", "on_machine_mm", "cmm_mm"))
    return {"dynamic_um": 1000 * (seen - nominal), "total_um": 1000 * (total - nominal), "quasi_static_um": 1000 * (total - seen)}


def joint_fit(case, features, kind, direction):
    """Curves of one direction: columns of every curve that moved, one constant a feature."""
    mine = [feature for feature in features if feature["direction"] == AXES[direction] and feature["axis"]]
    signs, orders = case.get("signs", [[1, 1, -1]] * 3)[direction], orders_of(case)[direction]
    curves = sorted({AXES.index(feature["axis"]) for feature in mine})
    rows, values = [], []
    for number, feature in enumerate(mine):
        value = deviations(feature)[kind]
        for i in range(len(value)):
            row = []
            for axis in curves:
                held = feature.get("positions_mm", {}).get(AXES[axis])
                if held is None and feature["axis"] == feature["direction"] == AXES[axis]:
                    held = feature["nominal_mm"]
                if held is None:
                    row += [0.0] * orders[axis]
                    continue
                there = second_kind(orders[axis], normalised(case, axis, case["reference_mm"][axis]))
                row += (signs[axis] * (second_kind(orders[axis], normalised(case, axis, held[i])) - there)[1:]).tolist()
            rows.append(row + [float(number == other) for other in range(len(mine))])
            values.append(value[i])
    matrix, values = np.array(rows), np.array(values)
    solved = np.linalg.lstsq(matrix, values, rcond=None)[0]
    residual = values - matrix @ solved
    freedom = len(values) - matrix.shape[1]
    spread = np.sqrt(np.diag(np.linalg.inv(matrix.T @ matrix)) * np.sum(residual**2) / max(freedom, 1))
    at, found = 0, {}
    for axis in curves:
        owners = [number for number, feature in enumerate(mine) if feature["axis"] == AXES[axis]]
        own = [i for i in range(len(values)) if any(rows[i][len(rows[i]) - len(mine) + number] for number in owners)]
        found[AXES[direction] + AXES[axis]] = (solved[at:at + orders[axis]].tolist(), spread[at:at + orders[axis]].tolist(),
                                               float(np.sqrt(np.mean(residual[own] ** 2))), len(own))
        at += orders[axis]
    return found


def solved(case):
    features = features_of(case)
    out = {"features": [{key: value.tolist() for key, value in deviations(feature).items()} for feature in features]}
    if "ranges_mm" not in case:
        return out
    for kind in ("dynamic", "quasi_static"):
        out[kind] = {"terms": {}, "standard_uncertainty_um": {}, "residual_rms_um": {}, "readings": {}}
        for direction in range(3):
            if not any(feature["direction"] == AXES[direction] and feature["axis"] for feature in features):
                continue
            for name, figures in joint_fit(case, features, kind + "_um", direction).items():
                for key, figure in zip(out[kind], figures):
                    out[kind][key][name] = figure
    return out


if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8") as text:
        document = json.load(text)
    asked = {wanted["at"] for wanted in document["expect"]}
    print(json.dumps({at: value for at, value in places(solved(document["case"])) if at in asked}))
