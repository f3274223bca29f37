#!/usr/bin/env python3
"""A minimal evaluation by ISO 230-2 in numpy that shares nothing with axiscal: a right program.

Reads one case from standard input, writes the result to standard output. With --as-known-tools it
makes the two mistakes that public tools are known for: E from the larger of the two smallest means,
and R as the larger unidirectional repeatability.
"""
import json
import sys

import numpy as np


def evaluate(case, mistaken):
    k = 3 if case["standard"].endswith("1988") else 2
    sides = [side for side in ("forward", "backward") if side in case]
    data = {side: np.array(case[side], dtype=float) for side in sides}
    if case["readings"] == "positions":
        data = {side: table - np.array(case["targets"], dtype=float)[:, None] for side, table in data.items()}
    figures, columns = {}, {}
    means = {side: table.mean(axis=1) for side, table in data.items()}
    spread = {side: table.std(axis=1, ddof=1) for side, table in data.items() if table.shape[1] > 1}
    for side in sides:
        columns["mean_" + side] = means[side]
        figures["E_" + side] = np.ptp(means[side])
        if side in spread:
            columns["s_" + side], columns["R_" + side] = spread[side], 2 * k * spread[side]
            figures["R_" + side] = columns["R_" + side].max()
            figures["A_" + side] = (means[side] + k * spread[side]).max() - (means[side] - k * spread[side]).min()
    if len(sides) == 2:
        both_ways(case, figures, columns, means, spread, k, mistaken)
    rows = [{"target": target, **{name: float(column[i]) for name, column in columns.items()}}
            for i, target in enumerate(case["targets"])]
    return {"format": "axiscal.result/1", "standard": case["standard"], "unit": case["unit"],
            "parameters": {name: {"value": float(value)} for name, value in figures.items()}, "positions": rows}


def both_ways(case, figures, columns, means, spread, k, mistaken):
    up, down = means["forward"], means["backward"]
    columns["mean"], columns["B"] = (up + down) / 2, up - down
    figures["B"], figures["B_mean"] = np.abs(up - down).max(), (up - down).mean()
    figures["M"] = np.ptp(columns["mean"])
    lowest = max(up.min(), down.min()) if mistaken else min(up.min(), down.min())
    figures["E"] = max(up.max(), down.max()) - lowest
    if not spread:
        return
    s_up, s_down = spread["forward"], spread["backward"]
    columns["R"] = np.maximum.reduce([k * s_up + k * s_down + np.abs(up - down), 2 * k * s_up, 2 * k * s_down])
    figures["R"] = max(figures["R_forward"], figures["R_backward"]) if mistaken else columns["R"].max()
    high, low = np.maximum(up + k * s_up, down + k * s_down), np.minimum(up - k * s_up, down - k * s_down)
    figures["A"] = high.max() - low.min()


json.dump(evaluate(json.load(sys.stdin), "--as-known-tools" in sys.argv), sys.stdout)
