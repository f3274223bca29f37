#!/usr/bin/env python3
"""Differential expansion and interferometer in rational numbers from the conditions, not the formulas.

expansion_exact.py CASE.json   prints {pointer: value}

Scale and laser: the length at 20 degC is what the machine's strain takes out of the length that the
instrument, longer by its own strain, has read. Interferometer: the displacement that changes the
optical path n (L_d + D) by the counted waves, found by solving that equation; angles by series.
"""
import json
import sys
from fractions import Fraction as F


def strain(body):
    t = body["temperature_degC"]
    t = sum(t) / len(t) if isinstance(t, list) else t
    return body["expansion_per_K"] * (t - 20)


def of_temperatures(case, found):
    """The mean of a body's sensors, and how many they are."""
    for body in ("machine", "instrument"):
        if body in case:
            sensors = aslist(case[body]["temperature_degC"])
            found[f"/{body}/temperature_degC"] = sum(sensors) / len(sensors)
            found[f"/{body}/sensors"] = len(sensors)


def cosine(angle):
    term, total = F(1), F(1)
    for k in range(1, 12):
        term *= -angle * angle / ((2 * k - 1) * (2 * k))
        total += term
    return total


def tangent(angle):
    term = total = angle
    for k in range(1, 12):
        term *= -angle * angle / ((2 * k) * (2 * k + 1))
        total += term
    return total / cosine(angle)


def aslist(value):
    return value if isinstance(value, list) else [value]


def of_readings(case, found):
    machine = strain(case["machine"])
    scale = strain(case["instrument"]) if "instrument" in case else F(0)
    for i, (length, x) in enumerate(zip(aslist(case["distance"]), aslist(case["deviation"]))):
        now = (length + x) * (1 + scale)
        found[f"/points/{i}/exact"] = now / (1 + machine) - length
        found[f"/points/{i}/first_order"] = x - length * (machine - scale)
        chosen = "exact" if case.get("form") == "exact" else "first_order"
        found[f"/points/{i}/at_20C"] = found[f"/points/{i}/{chosen}"]
        found[f"/points/{i}/exact_minus_first_order"] = found[f"/points/{i}/exact"] - found[f"/points/{i}/first_order"]
    found["/machine/strain"] = machine
    found["/instrument/strain"] = scale
    of_temperatures(case, found)


def beam_cosine(case):
    """cos of the beam's angle; of a walk through the square of it, to 60 digits."""
    if "beam_walk_mm" not in case:
        return cosine(case.get("beam_angle_rad", F(0)))
    square = 1 / (1 + (case["beam_walk_mm"] / (2 * case["beam_walk_travel_mm"])) ** 2)
    return F(int_root(square.numerator * square.denominator * 10 ** 80), square.denominator * 10 ** 40)


def beam_angle(case):
    """Of a walk e over L by the series of arctan(e / (2 L))."""
    if "beam_walk_mm" not in case:
        return case.get("beam_angle_rad", F(0))
    t = case["beam_walk_mm"] / (2 * case["beam_walk_travel_mm"])
    return sum((-1) ** k * t ** (2 * k + 1) / (2 * k + 1) for k in range(12))


def int_root(n):
    x = 1 << ((n.bit_length() + 1) // 2)
    while True:
        y = (x + n // x) // 2
        if y >= x:
            return x
        x = y


def of_counts(case, found):
    wave = case["vacuum_wavelength_nm"] / 10 ** 6
    dead, n0 = case.get("dead_path_mm", F(0)), 1 + case.get("n_minus_1_at_zero", F(0))
    refractivities = aslist(case["n_minus_1"])
    counts = aslist(case["counts"])
    for i, count in enumerate(counts):
        n = 1 + (refractivities[i] if len(refractivities) > 1 else refractivities[0])
        # passes * (n (dead + D) - n0 dead) = count * wave
        along_beam = (count * wave / case.get("passes", 2) + n0 * dead) / n - dead
        along_axis = along_beam / beam_cosine(case)
        found[f"/points/{i}/vacuum_mm"] = count * wave / case.get("passes", 2)
        found[f"/points/{i}/in_air_mm"] = along_beam
        found[f"/points/{i}/cosine_mm"] = along_axis - along_beam
        found[f"/points/{i}/along_axis_mm"] = along_axis
        if "machine" in case:
            found[f"/points/{i}/exact_mm"] = along_axis / (1 + strain(case["machine"]))
            found[f"/points/{i}/first_order_mm"] = along_axis * (1 - strain(case["machine"]))
            found[f"/points/{i}/exact_minus_first_order_mm"] = \
                found[f"/points/{i}/exact_mm"] - found[f"/points/{i}/first_order_mm"]
            chosen = "exact_mm" if case.get("form") == "exact" else "first_order_mm"
            found[f"/points/{i}/at_20C_mm"] = found[f"/points/{i}/{chosen}"]
    found["/beam_angle_rad"] = beam_angle(case)
    of_temperatures(case, found)
    if "abbe" in case:
        found["/abbe_mm"] = case["abbe"]["offset_mm"] * tangent(case["abbe"]["angle_rad"])


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        case = json.load(file, parse_float=F, parse_int=F)["case"]
    found = {}
    (of_counts if case["kind"] == "interferometer" else of_readings)(case, found)
    print(json.dumps({key: float(value) for key, value in found.items()}))


main()
