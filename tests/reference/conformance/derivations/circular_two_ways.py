#!/usr/bin/env python3
"""A noisy circular test on an arc, evaluated by other methods than a product would choose.

circular_two_ways.py CASE.json    prints {pointer: value}

Causes: dense least squares by singular values (numpy). Least squares circle: Newton's method on the sum of squared
distances, its derivatives by hand. Narrowest ring: nested interval search for its centre, with no use of its theory.
Local features of the residual: numpy's polyfit with its covariance, and means over plain selections.
"""
import json
import pathlib
import sys

import numpy as np

NAMES = ["center_ccw_mm/0", "center_ccw_mm/1", "center_cw_mm/0", "center_cw_mm/1", "scale_x", "scale_y", "squareness_rad",
         "servo_lag_difference_s", "backlash_x_mm", "backlash_y_mm", "lateral_play_x_mm", "lateral_play_y_mm",
         "straightness_x_mm", "straightness_y_mm"]


def columns(trace, R, F):
    theta = np.array(trace["angle_rad"])
    c, s, sg = np.cos(theta), np.sin(theta), 1 if trace["sense"] == "ccw" else -1
    sx, sy, none = -sg * np.sign(s), sg * np.sign(c), np.zeros_like(theta)
    centre = [c, s, none, none] if sg > 0 else [none, none, c, s]
    return np.column_stack([*centre, R * c * c, R * s * s, -R * s * c, sg * F * s * c, -sx * c / 2, -sy * s / 2,
                            -sx * s / 2, -sy * c / 2, s ** 3, c ** 3])


def least_squares_circle(x, y, R):
    """Newton on f(a, b) = sum (d - mean d)^2 from the nominal centre; radius = mean d."""
    a = b = 0.0
    for _ in range(60):
        d = np.hypot(x - a, y - b)
        ux, uy = (x - a) / d, (y - b) / d
        e = d - d.mean()
        gradient = -2 * np.array([(e * ux).sum(), (e * uy).sum()])
        vx, vy = ux - ux.mean(), uy - uy.mean()
        k = e / d
        hessian = 2 * np.array([[(vx * vx + k * uy * uy).sum(), (vx * vy - k * ux * uy).sum()],
                                [(vx * vy - k * ux * uy).sum(), (vy * vy + k * ux * ux).sum()]])
        step = np.linalg.solve(hessian, gradient)
        a, b = a - step[0], b - step[1]
    return a, b, np.hypot(x - a, y - b).mean()


def narrowest(width, low, high):
    """Smallest value of a function of one variable that falls, then rises: interval search by thirds of gold."""
    ratio = (5 ** 0.5 - 1) / 2
    p, q = high - ratio * (high - low), low + ratio * (high - low)
    at_p, at_q = width(p), width(q)
    for _ in range(80):
        if at_p < at_q:
            high, q, at_q = q, p, at_p
            p = high - ratio * (high - low)
            at_p = width(p)
        else:
            low, p, at_p = p, q, at_q
            q = low + ratio * (high - low)
            at_q = width(q)
    return min(at_p, at_q)


def ring(x, y, reach):
    def width(a, b):
        d = np.hypot(x - a, y - b)
        return d.max() - d.min()
    return narrowest(lambda a: narrowest(lambda b: width(a, b), -reach, reach), -reach, reach)


def local_step(past, residual):
    """Height at 0 between the lines through [-12, -2] and [2, 12] deg, and its standard uncertainty."""
    height, share, scatter, freedom = 0.0, 0.0, 0.0, -4
    for side in (-1, 1):
        chosen = (side * past >= 2 - 1e-6) & (side * past <= 12 + 1e-6)
        if chosen.sum() < 3:
            return None
        line, covariance = np.polyfit(past[chosen], residual[chosen], 1, cov="unscaled")
        height += side * line[1]
        share += covariance[1, 1]
        scatter += ((residual[chosen] - np.polyval(line, past[chosen])) ** 2).sum()
        freedom += chosen.sum()
    return height, (scatter / freedom * share) ** 0.5


def features(traces, residuals, backlash):
    found, fast, crossing, change = {}, [], 0, 0
    for trace, residual in zip(traces, residuals):
        degrees, sg = np.degrees(trace["angle_rad"]), 1 if trace["sense"] == "ccw" else -1
        for place in range(8):
            step = local_step(sg * ((degrees - 45 * place + 180) % 360 - 180), residual)
            if step is None:
                continue
            if place % 2 == 0:
                found[f"/diagnosis/reversals/{crossing}/step_mm"] = float(step[0] + backlash[place // 2 % 2])
                found[f"/diagnosis/reversals/{crossing}/step_standard_uncertainty_mm"] = float(step[1])
                crossing += 1
            else:
                found[f"/diagnosis/change_overs/{change}/step_mm"] = float(step[0])
                found[f"/diagnosis/change_overs/{change}/standard_uncertainty_mm"] = float(step[1])
                change += 1
        for angle, one in zip(degrees, residual):
            near = np.abs(degrees - angle) <= 1 + 1e-6
            if abs((angle + 45) % 90 - 45) > 10 + 1e-6 and near.sum() >= 4:
                fast.append((one - residual[near].mean()) / (1 - 1 / near.sum()) ** 0.5)
    found["/diagnosis/vibration/rms_mm"] = float(np.mean(np.square(fast)) ** 0.5)
    found["/diagnosis/vibration/peak_to_valley_mm"] = float(np.ptp(fast))
    return found


def main():
    document = json.loads(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))
    case = document["case"]
    R, F = case["nominal_radius_mm"], case["feed_mm_per_min"] / 60
    found, points = {}, {}
    for trace in case["traces"]:
        theta, dr = np.array(trace["angle_rad"]), np.array(trace["radial_deviation_mm"])
        points[trace["sense"]] = ((R + dr) * np.cos(theta), (R + dr) * np.sin(theta))
        found[f"/parameters/F_max_{trace['sense']}/value"] = float(dr.max())
        found[f"/parameters/F_min_{trace['sense']}/value"] = float(dr.min())
    points["b"] = tuple(np.concatenate([points["ccw"][i], points["cw"][i]]) for i in (0, 1))
    for name, (x, y) in points.items():
        a, b, radius = least_squares_circle(x, y, R)
        d = np.hypot(x - a, y - b)
        found[f"/parameters/G_{name}/least_squares"] = float(d.max() - d.min())
        found[f"/parameters/G_{name}/value"] = float(ring(x, y, 0.05))
        if name == "b":
            found["/parameters/D/value"] = float(radius - R)
    matrix = np.vstack([columns(trace, R, F) for trace in case["traces"]])
    read = np.concatenate([trace["radial_deviation_mm"] for trace in case["traces"]])
    value, _, rank, _ = np.linalg.lstsq(matrix, read, rcond=None)
    variance = ((read - matrix @ value) ** 2).sum() / (len(read) - rank)
    u = np.sqrt(variance * np.diag(np.linalg.inv(matrix.T @ matrix)))
    for name, one, uncertainty in zip(NAMES, value, u):
        found["/diagnosis/" + name] = float(one)
        found["/diagnosis/standard_uncertainty/" + name] = float(uncertainty)
    parts = np.split(read - matrix @ value, [len(case["traces"][0]["angle_rad"])])
    found |= features(case["traces"], parts, value[8:10])
    singular = np.linalg.svd(matrix / np.linalg.norm(matrix, axis=0), compute_uv=False)
    found |= {"/diagnosis/condition": float(singular[0] / singular[-1]), "/diagnosis/rank": int(rank),
              "/diagnosis/residual_rms_mm": float(variance ** 0.5)}
    print(json.dumps({wanted["at"]: found[wanted["at"]] for wanted in document["expect"] if wanted["at"] in found}))


if __name__ == "__main__":
    main()
