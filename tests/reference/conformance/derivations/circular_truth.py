#!/usr/bin/env python3
"""Circular tests whose readings are made from a truth: what they were made from is what must be found.

circular_truth.py CASE.json    prints {pointer: value}, after having made the readings anew and held them against the case

Signs: theta counter-clockwise from the first + axis, c = cos, s = sin; sg = +1 counter-clockwise, -1 clockwise;
sx = -sg sign(s), sy = sg sign(c) are the directions of motion. dr, outward positive:

  a c + b s; R (ex c^2 + ey s^2); -beta R s c; sg F tau s c; -(Bx/2) sx c; -(By/2) sy s; -(Px/2) sx s; -(Py/2) sy c;
  Sx s^3; Sy c^3; A c cos(2 pi R c / p + phi)
"""
import json
import math
import pathlib
import sys

KEYS = {"squareness": "squareness_rad", "scale_x": "scale_x", "scale_y": "scale_y", "servo": "servo_lag_difference_s",
        "backlash_x": "backlash_x_mm", "backlash_y": "backlash_y_mm", "lateral_x": "lateral_play_x_mm",
        "lateral_y": "lateral_play_y_mm", "straight_x": "straightness_x_mm", "straight_y": "straightness_y_mm"}
R, F = 150.0, 12.5


def sign(value):
    return (value > 0) - (value < 0)


def deviation(truth, theta, sg):
    t, c, s = truth.get, math.cos(theta), math.sin(theta)
    sx, sy = -sg * sign(s), sg * sign(c)
    a, b = t("center_ccw" if sg > 0 else "center_cw", (0.0, 0.0))
    dr = a * c + b * s
    dr += R * (t("scale_x", 0) * c * c + t("scale_y", 0) * s * s)
    dr += -t("squareness", 0) * R * s * c + sg * F * t("servo", 0) * s * c
    dr += -t("backlash_x", 0) / 2 * sx * c - t("backlash_y", 0) / 2 * sy * s
    dr += -t("lateral_x", 0) / 2 * sx * s - t("lateral_y", 0) / 2 * sy * c
    dr += t("straight_x", 0) * s ** 3 + t("straight_y", 0) * c ** 3
    if "lobes" in truth:  # k lobes of amplitude a
        k, amplitude = truth["lobes"]
        dr += amplitude * math.cos(k * theta)
    if "cyclic" in truth:
        axis, amplitude, pitch, phase = truth["cyclic"]
        w = c if axis == "X" else s
        dr += amplitude * w * math.cos(2 * math.pi * R * w / pitch + phase)
    if "circle" in truth:  # a true circle of radius R + growth about (x, y), met by the ray at theta
        x, y, growth = truth["circle"]
        along, across = x * c + y * s, x * s - y * c
        radius = R + growth
        # sqrt(radius^2 - across^2) - radius by the difference of the squares
        dr += along + growth - across * across / (radius + math.sqrt(radius * radius - across * across))
    if "spike" in truth:  # inward triangle of 3 deg after the crossing of one reversal, in one sense
        sense, at, height = truth["spike"]
        past = (sg * (math.degrees(theta) - at) + 180) % 360 - 180
        if sg == sense and 0 < past < 3:
            dr += height * (1 - abs(past - 1.5) / 1.5)
    return dr


def full(step):
    return [(k * step) for k in range(round(360 / step))]


def arc(first, last, step):
    return [first + k * step for k in range(round((last - first) / step) + 1)]


MIXED = {"squareness": -3e-5, "servo": 4e-4, "backlash_x": 0.005, "backlash_y": 0.002, "lateral_x": -0.001,
         "lateral_y": 0.003, "straight_x": 0.004, "straight_y": -0.006, "scale_x": 1e-5, "scale_y": 2.5e-5,
         "center_ccw": (0.003, 0.001), "center_cw": (0.002, -0.002)}
# id: truth, angles in degrees, senses, what else stands in the case. Angles that a sign turns on (0, 90, 180, 270) are
# avoided where something turns on it.
CASES = {
    "circular-squareness": ({"squareness": 5e-5}, full(2.5), "both", {}),
    "circular-servo-lag": ({"servo": 6e-4}, full(2.5), "both", {}),
    "circular-scale": ({"scale_x": 4e-5, "scale_y": -2e-5}, full(2.5), "both", {}),
    "circular-scale-warm": ({"scale_x": 4e-5, "scale_y": -2e-5}, full(2.5), "both",
                            {"temperature": {"bar_degC": 25, "machine_degC": 23, "bar_expansion_per_K": 1.2e-6,
                                             "machine_expansion_per_K": 11.5e-6, "bar_length_mm": 150.01}}),
    "circular-backlash": ({"backlash_x": 0.008, "backlash_y": -0.003}, [a + 1.25 for a in full(2.5)], "both", {}),
    "circular-lateral-play": ({"lateral_x": 0.006, "lateral_y": -0.002}, [a + 1.25 for a in full(2.5)], "both", {}),
    "circular-straightness": ({"straight_x": 0.01, "straight_y": -0.004}, full(2.5), "both", {}),
    "circular-mixed": (MIXED, [a + 1.25 for a in full(2.5)], "both", {}),
    "circular-mixed-arc": (MIXED, arc(-19.25, 200.75, 1), "both", {}),
    "circular-lobes-3": ({"lobes": (3, 0.004)}, full(2.5), "both", {}),
    "circular-off-centre": ({"circle": (0.3, -0.2, 0.005)}, full(2.5), "both", {}),
    "circular-lobes-5": ({"lobes": (5, 0.003)}, full(2), "both", {}),
    "circular-common-lag": ({"scale_x": -2e-6, "scale_y": -2e-6}, full(2.5), "both", {}),
    "circular-one-sense-ellipse": ({"squareness": 5e-5}, full(2.5), "ccw", {}),
    "circular-one-sense": ({"lobes": (4, 0.003)}, full(2.5), "cw", {}),
    "circular-feedback": ({"squareness": 5e-5}, full(2.5), "both", {"source": "feedback"}),
    "circular-cyclic": ({"cyclic": ("X", 0.002, 20.0, 0.5), "squareness": 3e-5}, [a + 0.25 for a in full(0.5)], "both", {}),
    "circular-spike": ({"spike": (1, 90.0, -0.006), "backlash_x": 0.004}, [a + 0.25 for a in full(0.5)], "both", {}),
}


def traces(name):
    truth, degrees, senses, _ = CASES[name]
    for sense, sg in (("ccw", 1), ("cw", -1)):
        if senses in ("both", sense):
            angles = [math.radians(a) for a in (degrees if sg > 0 else degrees[::-1])]
            yield {"sense": sense, "angle_rad": angles, "radial_deviation_mm": [deviation(truth, a, sg) for a in angles]}


def causes(truth):
    """The truth under the keys of the result."""
    found = {"/diagnosis/" + key: truth.get(name, 0.0) for name, key in KEYS.items()}
    for sense in ("ccw", "cw"):
        for place in (0, 1):
            found[f"/diagnosis/center_{sense}_mm/{place}"] = truth.get("center_" + sense, (0.0, 0.0))[place]
    return found


def ellipse_figures(amplitude, mean, at_20=0.0):
    """dr = mean + amplitude cos 2 (theta - ...): crests and troughs interlace around the nominal centre, which therefore
    is the centre of the narrowest ring and, by symmetry, of the least squares circle."""
    found = {"/parameters/D/value": mean + at_20}
    for name in ("G_ccw", "G_cw", "G_b"):
        found[f"/parameters/{name}/value"] = found[f"/parameters/{name}/least_squares"] = 2 * abs(amplitude)
    for sense in ("ccw", "cw"):
        found[f"/parameters/F_max_{sense}/value"] = mean + abs(amplitude) + at_20
        found[f"/parameters/F_min_{sense}/value"] = mean - abs(amplitude) + at_20
    return found


def figures(name, case):
    truth = CASES[name][0]
    if name in ("circular-squareness", "circular-servo-lag", "circular-one-sense-ellipse"):
        return ellipse_figures((R * truth.get("squareness", 0) + F * truth.get("servo", 0)) / 2, 0.0)
    if name.startswith("circular-scale") or name == "circular-common-lag":
        ex, ey = truth["scale_x"], truth["scale_y"]
        warm = case.get("temperature")
        shift = 0.0
        if warm:  # dr_20 = dr + L alpha_B (theta_B - 20) - R alpha_M (theta_M - 20)
            shift = warm["bar_length_mm"] * warm["bar_expansion_per_K"] * (warm["bar_degC"] - 20) \
                - R * warm["machine_expansion_per_K"] * (warm["machine_degC"] - 20)
        found = ellipse_figures(R * (ex - ey) / 2, R * (ex + ey) / 2, shift)
        found |= {"/correction_to_20C_mm": shift, "/diagnosis/scale_x_at_20C": ex + shift / R,
                  "/diagnosis/scale_y_at_20C": ey + shift / R, "/diagnosis/common_lag/radius_change_mm": R * (ex + ey) / 2}
        if ex + ey < 0:  # R (F tau / R)^2 / 2
            found["/diagnosis/common_lag/lag_s_if_nothing_else"] = math.sqrt(-(ex + ey)) * R / F
        return found
    if "lobes" in truth:  # crests and troughs interlace, as above
        return ellipse_figures(truth["lobes"][1], 0.0)
    if "circle" in truth:  # every reading lies on one circle
        return ellipse_figures(0.0, truth["circle"][2])
    if name == "circular-feedback":
        return {f"/parameters/G_f_{which}/value": R * truth["squareness"] for which in ("ccw", "cw", "b")}
    if name == "circular-mixed-arc":  # about the set-up centre F is the largest and smallest reading
        return {f"/parameters/F_{which}_{trace['sense']}/value": pick(trace["radial_deviation_mm"])
                for trace in traces(name) for which, pick in (("max", max), ("min", min))}
    return {}


def features(name):
    """Ranking, period, spike."""
    truth, found = CASES[name][0], {}
    if name == "circular-cyclic":
        _, amplitude, pitch, phase = truth["cyclic"]
        found = {"/diagnosis/cyclic/0/pitch_mm": pitch, "/diagnosis/cyclic/0/amplitude_mm": amplitude,
                 "/diagnosis/cyclic/0/phase_rad": phase, "/diagnosis/cyclic/0/peak_to_valley_mm": 2 * amplitude}
    if name == "circular-spike":  # the highest reading of the triangle: 0.25 deg off its tip, of 1.5
        height = truth["spike"][2]
        readings = [deviation({"spike": truth["spike"]}, trace, 1) for trace in
                    (math.radians(90 + 0.25 + 0.5 * k) for k in range(6))]
        found = {"/diagnosis/reversals/1/spike_mm": min(readings) if height < 0 else max(readings),
                 "/diagnosis/reversals/0/step_mm": truth["backlash_x"], "/diagnosis/reversals/2/step_mm": truth["backlash_x"],
                 # four readings stand above half the highest, each for one step
                 "/diagnosis/reversals/1/spike_width_deg": 4 * 0.5,
                 "/diagnosis/reversals/1/spike_width_ms": math.radians(4 * 0.5) * R / F * 1000}
    if name == "circular-squareness":  # the only cause: its own ellipse is G
        found = {"/diagnosis/ranking/0/G_mm": R * truth["squareness"], "/diagnosis/ranking/0/G_b_mm": R * truth["squareness"],
                 "/diagnosis/ranking/0/peak_to_valley_mm": R * truth["squareness"]}
        # centre and radius of even steps: normal matrix n diag(1/2, 1/2, 1); the widest gap is one step
        found |= {"/parameters/D/condition": 2.0, "/traces/0/arc_deg": 357.5, "/traces/1/arc_deg": 357.5}
        # no narrower ring exists
        found |= {f"/parameters/{which}/gap": 0.0 for which in ("G_ccw", "G_cw", "G_b")}
    if name == "circular-mixed-arc":
        found = {"/traces/0/arc_deg": 220.0}
    if name == "circular-feedback":
        found = {f"/parameters/G_f_{which}/least_squares": R * truth["squareness"] for which in ("ccw", "cw", "b")}
        found |= {f"/parameters/G_f_{which}/gap": 0.0 for which in ("ccw", "cw", "b")}
    if name == "circular-lobes-5":  # alike in both senses and above the third harmonic: at right angles to every cause
        found = {"/diagnosis/lobes/amplitude_mm": truth["lobes"][1], "/diagnosis/lobes/per_turn": 5}
    if name == "circular-one-sense-ellipse":  # what the two causes make together is the ellipse
        found = {"/diagnosis/not_separable/0/peak_to_valley_mm": R * truth["squareness"]}
    return found


def main():
    document = json.loads(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))
    name, case = document["id"], document["case"]
    assert case["nominal_radius_mm"] == R and case["feed_mm_per_min"] == 60 * F
    made = list(traces(name))
    assert [trace["sense"] for trace in made] == [trace["sense"] for trace in case["traces"]]
    for mine, theirs in zip(made, case["traces"]):
        for key, unit in (("angle_rad", 1.0), ("radial_deviation_mm", 1.0)):
            assert len(mine[key]) == len(theirs[key])
            worst = max(abs(a - b) for a, b in zip(mine[key], theirs[key]))
            assert worst <= 1e-13 * unit, f"{key} is not made from the truth: {worst}"
    known = figures(name, case) | features(name)
    if CASES[name][2] == "both":  # one sense does not tell them all
        known |= causes(CASES[name][0])
    print(json.dumps({wanted["at"]: known[wanted["at"]] for wanted in document["expect"] if wanted["at"] in known}))


if __name__ == "__main__":
    main()
