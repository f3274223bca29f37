#!/usr/bin/env python3
"""Evaluations beside ISO 230-2, slopes and artefacts, from the definitions in rational numbers.

positioning_styles.py CASE.json   prints {pointer: value}

Numbers of the case are the fractions they are printed as; only roots are rounded, at 60 digits.
"""
import json
import sys
from decimal import Decimal, localcontext
from fractions import Fraction

COVER = {"ISO 230-2:1988": 3, "GB 10931-89": 3, "BS 4656-16 style": 3, "BS 3800 style": 3}
ARCSEC = {"arcsec": Fraction(1), "deg": Fraction(1, 3600)}


def root(value):
    with localcontext() as context:
        context.prec = 70
        return Fraction((Decimal(value.numerator) / Decimal(value.denominator)).sqrt())


def mean(row):
    return sum(row) / len(row)


def deviation(row):
    return root(sum((x - mean(row)) ** 2 for x in row) / (len(row) - 1))


def span(values):
    return max(values) - min(values)


def without_artefact(case, rows):
    """x = reading - face, each with its sense, in the unit of the case."""
    for key, deviations, numbers in (("polygon", "face_deviation_arcsec", "face_of_target"),
                                     ("indexing_table", "index_deviation_arcsec", "index_of_target")):
        if key not in case:
            continue
        stated = case[key]
        turn = -1 if stated.get("reading_sense") == "against_axis" else 1
        face = -1 if stated["certificate_sense"] == "against_axis" else 1
        rows = [[turn * x - face * stated[deviations][int(number) - 1] * ARCSEC[case["unit"]] for x in row]
                for row, number in zip(rows, stated[numbers])]
    return rows


def deviations_of(case, side):
    rows = case.get(side, [])
    if case["readings"] == "positions":
        return [[x - target for x in row] for target, row in zip(case["targets"], rows)]
    return without_artefact(case, rows)


def iso(up, down, k):
    both = [("forward", up)] + ([("backward", down)] if down else [])
    figures, sides = {}, dict(both)
    repeated = len(up[0]) > 1
    ends = {name: [(mean(row) - k * deviation(row), mean(row) + k * deviation(row)) for row in rows]
            for name, rows in both} if repeated else {}
    for name, rows in both:
        figures["E_" + name] = span([mean(row) for row in rows])
        if repeated:
            figures["A_" + name] = max(high for _, high in ends[name]) - min(low for low, _ in ends[name])
            figures["R_" + name] = max(2 * k * deviation(row) for row in rows)
    if down:
        signed = [mean(a) - mean(b) for a, b in zip(up, down)]
        figures["E"] = span([mean(row) for rows in sides.values() for row in rows])
        figures["M"] = span([(mean(a) + mean(b)) / 2 for a, b in zip(up, down)])
        figures["B"], figures["B_mean"] = max(map(abs, signed)), mean(signed)
        if repeated:
            all_ends = ends["forward"] + ends["backward"]
            figures["A"] = max(high for _, high in all_ends) - min(low for low, _ in all_ends)
            figures["R"] = max(max(k * deviation(a) + k * deviation(b) + abs(step), 2 * k * deviation(a),
                                   2 * k * deviation(b)) for a, b, step in zip(up, down, signed))
    return figures


def vdi(up, down):
    middle = [(mean(a) + mean(b)) / 2 for a, b in zip(up, down)]
    reversal = [abs(mean(a) - mean(b)) for a, b in zip(up, down)]
    scatter = [3 * (deviation(a) + deviation(b)) for a, b in zip(up, down)]
    return {"Pa": span(middle), "U_max": max(reversal), "U_mean": mean(reversal), "Ps_max": max(scatter),
            "Ps_mean": mean(scatter),
            "P": max(x + (u + s) / 2 for x, u, s in zip(middle, reversal, scatter))
            - min(x - (u + s) / 2 for x, u, s in zip(middle, reversal, scatter))}


def raw(up, down):
    figures = {"A_raw_forward": span(sum(up, [])), "R_raw_forward": max(map(span, up))}
    if down:
        figures.update({"A_raw_backward": span(sum(down, [])), "R_raw_backward": max(map(span, down)),
                        "A_raw": span(sum(up + down, [])), "R_raw": max(span(a + b) for a, b in zip(up, down))})
    return figures


def asme(up, down):
    signed = [mean(a) - mean(b) for a, b in zip(up, down)]
    return {**raw(up, down), "B": max(map(abs, signed)), "B_mean": mean(signed)}


def nmtba(up, down, with_offset):
    offset = 0 if with_offset else mean([mean(row) for row in up + down])
    figures = {}
    for name, rows in (("forward", up), ("backward", down)):
        figures["repeatability_" + name] = max(3 * deviation(row) for row in rows)
        figures["accuracy_" + name] = max(abs(mean(row) - offset) + 3 * deviation(row) for row in rows)
    halves = [3 * max(deviation(a), deviation(b)) + abs(mean(a) - mean(b)) / 2 for a, b in zip(up, down)]
    figures["repeatability"] = max(halves)
    figures["accuracy"] = max(abs((mean(a) + mean(b)) / 2 - offset) + half for a, b, half in zip(up, down, halves))
    return figures


def jis(targets, up, down):
    ends = [targets.index(min(targets)), targets.index(max(targets))]
    centre = (min(targets) + max(targets)) / 2
    inner = sorted((i for i in range(len(targets)) if i not in ends), key=lambda i: targets[i])
    places = ends + [min(inner, key=lambda i: abs(targets[i] - centre))]
    figures = {"positioning": span([row[0] for row in up]),
               "repeatability_forward": max(span(up[i]) for i in places) / 2,
               "repeatability_backward": max(span(down[i]) for i in places) / 2,
               "lost_motion": max(abs(mean(up[i]) - mean(down[i])) for i in places)}
    figures["repeatability"] = max(figures["repeatability_forward"], figures["repeatability_backward"])
    return figures


def slopes(targets, up, down):
    x = [(mean(a) + mean(b)) / 2 for a, b in zip(up, down)] if down else [mean(a) for a in up]
    n, first, last = len(x), targets.index(min(targets)), targets.index(max(targets))
    # the textbook form, exact in fractions
    top = n * sum(p * y for p, y in zip(targets, x)) - sum(targets) * sum(x)
    return {"least_squares": top / (n * sum(p * p for p in targets) - sum(targets) ** 2),
            "end_points": (x[last] - x[first]) / (targets[last] - targets[first])}


def figures_of(case, up, down):
    name = case["standard"]
    if name == "VDI/DGQ 3441":
        return vdi(up, down)
    if name == "raw ranges":
        return raw(up, down)
    if name == "ASME B5.54-1992 style":
        return asme(up, down)
    if name.startswith("NMTBA"):
        return nmtba(up, down, name.endswith(", with offset"))
    if name.startswith("JIS B 6330") or name.startswith("JIS B 6201"):
        return jis(case["targets"], up, down)
    return iso(up, down, COVER.get(name, 2))


def main():
    with open(sys.argv[1], encoding="utf-8") as source:
        case = json.load(source, parse_float=Fraction, parse_int=Fraction)["case"]
    up, down = deviations_of(case, "forward"), deviations_of(case, "backward")
    figures = figures_of(case, up, down)
    found = {f"/parameters/{key}/value": float(value) for key, value in figures.items()}
    if len(up) > 1:
        found.update({f"/slope/{key}": float(value) for key, value in slopes(case["targets"], up, down).items()})
    for i, row in enumerate(up):
        found[f"/positions/{i}/mean_forward"] = float(mean(row))
        if down:
            found[f"/positions/{i}/B"] = float(mean(row) - mean(down[i]))
            if case["standard"] == "VDI/DGQ 3441":
                found[f"/positions/{i}/U"] = float(abs(mean(row) - mean(down[i])))
                found[f"/positions/{i}/s"] = float((deviation(row) + deviation(down[i])) / 2)
                found[f"/positions/{i}/Ps"] = float(3 * (deviation(row) + deviation(down[i])))
        if "R_raw_forward" in figures:
            found[f"/positions/{i}/R_raw_forward"] = float(span(row))
            if down:
                found[f"/positions/{i}/R_raw_backward"] = float(span(down[i]))
                found[f"/positions/{i}/R_raw"] = float(span(row + down[i]))
    print(json.dumps(found))


if __name__ == "__main__":
    main()
