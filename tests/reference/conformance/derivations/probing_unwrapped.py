"""Probing delay a second way: the saw-tooth is unwrapped touch by touch (steps shorter than a tooth), not searched.

probing_unwrapped.py CASE.json
"""
import json
import sys

import numpy as np

from separation_pinv import places


def unwrapped(approach, trigger):
    """Period, its standard uncertainty, slope and rms of the residuals; None where no tooth is to be unwrapped."""
    order = np.argsort(approach)
    a, x = np.array(approach, float)[order], np.array(trigger, float)[order]
    if len(a) < 5 or np.ptp(a) == 0:
        return None
    slope = 1 if np.median(np.sign(np.diff(x) * np.diff(a))) > 0 else -1
    y = x - slope * a
    jumps = np.abs(np.diff(y)) > np.ptp(x) / 2
    n = np.concatenate([[0], np.cumsum(jumps)])
    (step, start), total = np.polyfit(n, y, 1), np.sum((n - n.mean()) ** 2)
    residual = y - start - step * n
    return abs(step), np.sqrt(np.sum(residual**2) / (len(a) - 2) / total), slope, np.sqrt(np.mean(residual**2))


def evaluated(case):
    per_ms, found = case["feed_mm_per_min"] / 60 / 1000, []
    for series in case["series"]:
        unit = np.array(series["direction"], float) / np.linalg.norm(series["direction"])
        x = np.array(series["trigger_mm"]) if "trigger_mm" in series else np.array(series["trigger_points_mm"]) @ unit
        out = {"direction": unit.tolist(), "touches": len(x), "variation_mm": np.ptp(x), "variation_ms": np.ptp(x) / per_ms}
        if len(x) > 1:
            out["standard_deviation_mm"] = np.std(x, ddof=1)
        tooth = None if series.get("reference") else unwrapped(series["approach_mm"], x)
        if tooth:
            out.update(period_ms=tooth[0] / per_ms, period_standard_uncertainty_ms=tooth[1] / per_ms, tooth_slope=tooth[2],
                       tooth_residual_mm=tooth[3])
        found.append((out, unit, bool(series.get("reference"))))
    for out, unit, reference in found:
        still = [other["variation_mm"] for other, its, is_reference in found if is_reference and its @ unit > 1 - 1e-9]
        if still and not reference:
            out["reference_repeatability_mm"] = max(still)
            out["net_variation_mm"] = np.sqrt(out["variation_mm"] ** 2 - max(still) ** 2)
    return {"feed_mm_per_ms": per_ms, "series": [out for out, _, _ in found]}


if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8") as text:
        document = json.load(text)
    asked = {wanted["at"] for wanted in document["expect"]}
    print(json.dumps({at: value for at, value in places(evaluated(document["case"])) if at in asked}))
