#!/usr/bin/env python3
"""Refractivity of air from the papers' formulas in 50 decimal digits.

air_formulas.py CASE.json   prints {pointer: value}

The formulas are written down once more, in the papers' order of terms and in decimal numbers: what a
program in doubles loses by rounding shows as the difference. The constants of Boensch and Potulski are
from memory of the paper in both places, so that case proves the arithmetic and not the constants.
"""
import json
import sys
from decimal import Decimal as D
from decimal import getcontext

getcontext().prec = 50
ZERO_C = D("273.15")


def water(kelvins):
    """IAPWS-IF97 region 4, Pa."""
    k = [None] + [D(text) for text in (
        "1167.05214528", "-724213.167032", "-17.0738469401", "12020.8247025", "-3232555.03223",
        "14.9151086135", "-4823.26573616", "405113.405421", "-0.238555575678", "650.175348448")]
    w = kelvins + k[9] / (kelvins - k[10])
    a = w * w + k[1] * w + k[2]
    b = k[3] * w * w + k[4] * w + k[5]
    c = k[6] * w * w + k[7] * w + k[8]
    return D(10) ** 6 * (2 * c / (-b + (b * b - 4 * a * c).sqrt())) ** 4


def ciddor(t, p, pv, s, co2):
    kelvins = t + ZERO_C
    xv = (D("1.00062") + D("3.14e-8") * p + D("5.60e-7") * t * t) * pv / p

    def z(p, t, xv):
        kelvins = t + ZERO_C
        inner = (D("1.58123e-6") + D("-2.9331e-8") * t + D("1.1043e-10") * t * t
                 + (D("5.707e-6") + D("-2.051e-8") * t) * xv + (D("1.9898e-4") + D("-2.376e-6") * t) * xv * xv)
        return 1 - p / kelvins * inner + (p / kelvins) ** 2 * (D("1.83e-11") + D("-0.765e-8") * xv * xv)

    standard = D("1e-8") * (D(5792105) / (D("238.0185") - s) + D(167917) / (D("57.362") - s))
    axs = standard * (1 + D("5.34e-7") * (co2 - 450))
    ws = D("1.022e-8") * (D("295.235") + D("2.6422") * s - D("0.03238") * s ** 2 + D("0.004028") * s ** 3)
    ma = D("0.0289635") + D("1.2011e-8") * (co2 - 400)
    r, mv = D("8.314472"), D("0.018015")
    rho_axs = D(101325) * ma / (D("0.9995922115") * r * D("288.15"))
    moles = p / (z(p, t, xv) * r * kelvins)
    return (1 - xv) * moles * ma / rho_axs * axs + xv * moles * mv / D("0.00985938") * ws


def edlen_like(t, p, s, constants, factor, divisor):
    a, b, c = constants
    standard = D("1e-8") * (a + b / (130 - s) + c / (D("38.9") - s))
    x = (1 + D("1e-8") * (factor[0] - factor[1] * t) * p) / (1 + D("0.003661") * t)
    return p * standard * x / divisor


def birch_downs_dry(t, p, s):
    return edlen_like(t, p, s, (D("8342.54"), D(2406147), D(15998)), (D("0.601"), D("0.00972")), D("96095.43"))


def n_minus_1(model, t, p, pv, s, co2):
    if model == "ciddor":
        return ciddor(t, p, pv, s, D(450) if co2 is None else co2)
    if model == "bonsch_potulski":
        dry = edlen_like(t, p, s, (D("8091.37"), D(2333983), D(15518)), (D("0.5953"), D("0.009876")), D("93214.60"))
        co2 = D(400) if co2 is None else co2
        return dry * (1 + D("0.5327e-6") * (co2 - 400)) - D("1e-10") * (D("3.8020") - D("0.0384") * s) * pv
    scale = D("292.75") / (t + ZERO_C) if model == "edlen_nist" else 1
    return birch_downs_dry(t, p, s) - D("1e-10") * scale * (D("3.7345") - D("0.0401") * s) * pv


# Where the equations are stated to hold (degC; Pa; %; nm; umol/mol). Temperatures: Ciddor 1996; NIST's page on
# the shop-floor form; room air of both others.
TEMPERATURES = {"ciddor": (-40, 100), "edlen_nist": (0, 40), "birch_downs": (15, 25), "bonsch_potulski": (15, 25)}
RANGES = {"pressure": (60000, 120000), "relative_humidity": (0, 100), "vacuum_wavelength": (350, 1600)}


def validity(model):
    ranges = dict(RANGES, temperature=TEMPERATURES[model])
    if model in ("ciddor", "bonsch_potulski"):
        ranges["co2"] = (0, 2000)
    return {f"/validity/{name}/{end}": limits[end] for name, limits in ranges.items() for end in (0, 1)}


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        case = json.load(file, parse_float=D, parse_int=D)["case"]
    t, p = case["temperature_degC"], case["pressure_Pa"]
    pv = case.get("vapour_pressure_Pa")
    if pv is None:
        pv = case["relative_humidity_percent"] / 100 * water(t + ZERO_C)
    s = (1000 / case["vacuum_wavelength_nm"]) ** 2
    found = n_minus_1(case["model"], t, p, pv, s, case.get("co2_ppm"))
    usual = {"ciddor": 450, "bonsch_potulski": 400}.get(case["model"])
    co2 = case.get("co2_ppm", usual)
    print(json.dumps({"/n_minus_1": float(found), "/vapour_pressure_Pa": float(pv), "/co2_ppm": co2 and float(co2),
                      **validity(case["model"])}))


main()
