#!/usr/bin/env python3
"""Draws whole sessions with numpy and evaluates each: a second way to the uncertainty of every parameter.

uncertainty_simulated.py CASE.json   prints {pointer: value}

Another generator, another normal distribution, ISO 230-2 written anew in arrays; intervals by sorting.
Readings are off by the environment, each by itself; device, misalignment, temperature and expansion are
drawn once a session and grow with the distance from the lowest target, to the whole at the length L.
"""
import json
import sys

import numpy

TRIALS, BLOCK = 1000000, 50000


def draw(generator, width, shape):
    return (generator.random(shape) - 0.5) * width


def common_errors(generator, m, trials):
    """Per session, in um (arcsec) at the length L."""
    length = m.get("length_m", 0)
    total = numpy.zeros(trials)
    if "device_U" in m:
        total += generator.standard_normal(trials) * m["device_U"] / m["k"]
    if "device_width" in m:
        total += draw(generator, m["device_width"], trials)
    if "misalignment_mm" in m:
        total += draw(generator, m["misalignment_mm"] ** 2 / (2 * length), trials)
    if "temperature_width_K" in m:
        total += 1e6 * m["expansion_per_K"] * length * draw(generator, m["temperature_width_K"], trials)
    if "expansion_width_per_K" in m:
        total += length * m["temperature_offset_K"] * draw(generator, 1e6 * m["expansion_width_per_K"], trials)
    return total


def figures_of(up, down, k):
    """up, down: [trial][target][approach]. ISO 230-2, one array operation a figure."""
    mean = {"forward": up.mean(axis=2), "backward": down.mean(axis=2)}
    ks = {"forward": k * up.std(axis=2, ddof=1), "backward": k * down.std(axis=2, ddof=1)}
    both = numpy.concatenate([mean["forward"], mean["backward"]], axis=1)
    high = numpy.concatenate([mean[d] + ks[d] for d in mean], axis=1)
    low = numpy.concatenate([mean[d] - ks[d] for d in mean], axis=1)
    reversal = mean["forward"] - mean["backward"]
    out = {"A": high.max(axis=1) - low.min(axis=1), "E": numpy.ptp(both, axis=1),
           "M": numpy.ptp((mean["forward"] + mean["backward"]) / 2, axis=1),
           "B": abs(reversal).max(axis=1), "B_mean": reversal.mean(axis=1)}
    for d in mean:
        out["A_" + d] = (mean[d] + ks[d]).max(axis=1) - (mean[d] - ks[d]).min(axis=1)
        out["E_" + d] = numpy.ptp(mean[d], axis=1)
        out["R_" + d] = 2 * ks[d].max(axis=1)
    one_by_one = (ks["forward"] + ks["backward"] + abs(reversal)).max(axis=1)
    out["R"] = numpy.maximum(one_by_one, numpy.maximum(out["R_forward"], out["R_backward"]))
    return out


def simulate(case, m, per_unit):
    generator = numpy.random.Generator(numpy.random.PCG64(20230))
    targets = numpy.array(case["targets"], float)
    um_per_m = 1e6
    length = m["length_m"] * um_per_m / per_unit if "length_m" in m else numpy.ptp(targets)
    share = ((targets - targets.min()) / length)[None, :, None]
    k = 3 if case["standard"].endswith("1988") else 2
    gathered = []
    for _ in range(TRIALS // BLOCK):
        common = common_errors(generator, m, BLOCK)[:, None, None] / per_unit * share
        sides = [numpy.array(case[side])[None] + common
                 + draw(generator, m.get("eve", 0) / per_unit, (BLOCK,) + numpy.shape(case[side]))
                 for side in ("forward", "backward")]
        gathered.append(figures_of(*sides, k))
    return {name: numpy.sort(numpy.concatenate([block[name] for block in gathered])) for name in gathered[0]}


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        case = json.load(file)["case"]
    m = {key.replace("_arcsec", "").replace("eve_um", "eve").replace("device_U_um", "device_U")
         .replace("device_width_um", "device_width"): value for key, value in case["uncertainty"].items()}
    per_unit = {"mm": 1e3, "um": 1.0, "m": 1e6, "deg": 3600.0}[case["unit"]]
    if "length_m" not in m and case["axis"]["kind"] == "linear":
        m["length_m"] = numpy.ptp(case["targets"]) * per_unit / 1e6
    found = {}
    for name, sample in simulate(case, m, per_unit).items():
        at = f"/parameters/{name}/monte_carlo/"
        found[at + "u"] = sample.std(ddof=1)
        found[at + "mean"] = sample.mean()
        count = round(0.95 * TRIALS)
        first = (TRIALS - count) // 2
        found[at + "interval_95/0"], found[at + "interval_95/1"] = sample[first], sample[first + count]
        least = (sample[count:] - sample[:TRIALS - count]).argmin()
        found[at + "shortest_95/0"], found[at + "shortest_95/1"] = sample[least], sample[least + count]
    print(json.dumps({pointer: float(value) for pointer, value in found.items()}))


main()
