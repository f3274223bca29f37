#!/usr/bin/env python3
"""A periodic error under noise: Gauss-Newton over all unknowns at once, with derivatives by differences.

circular_periodic.py CASE.json    prints {pointer: value}

The pitch is started from the best of a plain list, each with its own dense least squares fit of every cause.
"""
import json
import pathlib
import sys

import numpy as np
from circular_two_ways import columns


def main():
    document = json.loads(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))
    case = document["case"]
    R, F = case["nominal_radius_mm"], case["feed_mm_per_min"] / 60
    linear = np.vstack([columns(trace, R, F) for trace in case["traces"]])
    read = np.concatenate([trace["radial_deviation_mm"] for trace in case["traces"]])
    c = np.cos(np.concatenate([trace["angle_rad"] for trace in case["traces"]]))

    def model(p):
        return linear @ p[:14] + p[14] * c * np.cos(2 * np.pi * R * c / p[15] + p[16])

    best = None
    for pitch in np.arange(8.0, 60.0, 0.05):
        argument = 2 * np.pi * R * c / pitch
        matrix = np.column_stack([linear, c * np.cos(argument), c * np.sin(argument)])
        value = np.linalg.lstsq(matrix, read, rcond=None)[0]
        left = ((read - matrix @ value) ** 2).sum()
        if best is None or left < best[0]:
            best = left, [*value[:14], np.hypot(value[14], value[15]), pitch, np.arctan2(-value[15], value[14])]
    p = np.array(best[1])
    size = np.array([1e-3] * 4 + [1e-5] * 3 + [1e-3] * 7 + [1e-3, 1e-2, 1e-1])
    for _ in range(30):
        jacobian = np.column_stack([(model(p + h * 1e-4) - model(p - h * 1e-4)) / (2e-4 * size[k])
                                    for k, h in enumerate(np.diag(size))])
        p = p + np.linalg.lstsq(jacobian, read - model(p), rcond=None)[0]
    variance = ((read - model(p)) ** 2).sum() / (len(read) - len(p))
    scaled = jacobian * size
    u = np.sqrt(variance * np.diag(np.linalg.inv(scaled.T @ scaled))) * size
    place = "/diagnosis/cyclic/0/"
    found = {place + "amplitude_mm": p[14], place + "peak_to_valley_mm": 2 * p[14], place + "pitch_mm": p[15],
             place + "phase_rad": p[16], place + "standard_uncertainty/amplitude_mm": u[14],
             place + "standard_uncertainty/pitch_mm": u[15], "/diagnosis/squareness_rad": p[6],
             "/diagnosis/backlash_y_mm": p[9], "/diagnosis/residual_rms_mm": variance ** 0.5}
    print(json.dumps({wanted["at"]: float(found[wanted["at"]]) for wanted in document["expect"] if wanted["at"] in found}))


if __name__ == "__main__":
    main()
