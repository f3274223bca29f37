#!/usr/bin/python3
"""A rotary axis that LinuxCNC turns: linuxcnc_rotary.py SOURCE_DIR BUILD_DIR SHAPE

axiscal's part program turns LinuxCNC's A and tells the indexing table its positions by analog output 6.
A's 1 kHz motor position and the table's go through the errors of quiet-rotary.toml to a simulated angular
interferometer. 10 of 10 points in order, and the figures of the axis as they were injected: what the table
deviates is known to the station, and must not be in them."""
import json
import math
import sys
import tomllib

from linuxcnc_bench import run_in_bench
from linuxcnc_figures import judge_points

POINTS, TARGETS = 10, 5
DRIVE_OF_A, TABLE = 4, 5  # in a line of LinuxCNC's stream
# What reaches a figure of one approach each way, of the noise of one capture.
NOISE = {"E": 2, "E_forward": 2, "E_backward": 2, "M": math.sqrt(2), "B": math.sqrt(2),
         "B_mean": math.sqrt(2 / TARGETS)}


def systematic_mdeg(hidden):
    """Between two points, thousandths of a degree. Each has a rest of half a step of the table at most:
    what air steps (half a digit of each sensor) and what two accepted formulas of air (6e-8) do to it, one
    count of the interferometer, six digits of a degree in the stream; and what it does to a rest r that
    the reflectors stood off square by a at the datum, r^2 a / 2: by less than all errors together."""
    table, errors, laser = hidden["indexing_table"], hidden["errors"], hidden["laser"]
    half_step_deg = table["step_deg"] / 2
    digit = 10.0 ** -hidden["sensor"][0]["fraction_digits"]
    air = 2 * 0.5 * (0.94e-6 * digit + 2.68e-9 * 1 + 8.5e-9 * digit) + 6e-8
    count_mm = laser["wavelength_nm"] * 1e-6 / laser["fold"] / 2 ** laser["phase_bits"]
    count_mdeg = math.degrees(count_mm / table["arm_mm"]) * 1e3
    off_square_mdeg = (max(abs(um) for _, um in errors["table"]) + abs(errors["reversal_um"])
                       + sum(wave["amplitude_um"] for wave in errors["periodic"])
                       + max(map(abs, table["deviation_arcsec"])) / 3.6)
    square = math.radians(half_step_deg) ** 2 / 2 * off_square_mdeg
    return 2 * (half_step_deg * 1e3 * air + 0.5e-3 + square) + count_mdeg


def bounds_deg(hidden):
    """bound = k z sigma + systematic, with z = sqrt(2 ln(2 m / 0.001)) for all 2 m points at 99.9 %
    (Gaussian tail and union bound) and sigma of one capture: its stop and its window's noise. Of B both
    points lie at one place; the same systematic part is more than enough."""
    errors, window_s = hidden["errors"], hidden["truth"]["window_s"]
    z = math.sqrt(2 * math.log(2 * TARGETS / 0.001))
    sigma = math.hypot(errors["approach_noise_um"],
                       errors["noise_um"] / math.sqrt(window_s * hidden["laser"]["rate_hz"]))
    return {name: (k * z * sigma + systematic_mdeg(hidden)) * 1e-3 for name, k in NOISE.items()}


def judge_figures(document, injected, bounds):
    """In degrees; a truth file's mm stand for them."""
    assert document["unit"] == "deg", document["unit"]
    told = []
    for name, bound in bounds.items():
        value, true = document["parameters"][name]["value"], injected[name]["value"]
        # A table turned the wrong way, or taken as exact, is off by far more.
        assert bound < 0.1e-3, f"the bound of {name}: {bound} deg"
        assert abs(value - true) <= bound, f"{name}: {value} deg, injected {true}, allowed {bound}"
        told.append(f"{name} {value * 3600:.2f} (injected {true * 3600:.2f}, allowed {bound * 3600:.2f})")
    print("seconds of arc:", "; ".join(told))


def turn(bench):
    bench.scenario = bench.source / "tests/peers/linuxcnc/quiet-rotary.toml"
    bench.station = bench.source / "tests/peers/linuxcnc/rotary-station.toml.in"
    hidden = tomllib.loads(bench.scenario.read_text())
    deviations = [f"{one} arcsec" for one in hidden["indexing_table"]["deviation_arcsec"]]
    sense = 'certificate_sense = "with_axis"'
    bench.changes[sense] = f"deviations = {json.dumps(deviations)}\n{sense}"
    bench.stream = ["--positions-field", DRIVE_OF_A, "--table-field", TABLE]
    _, cnc, program = bench.begin_run("A-whole.ngc")
    folder = bench.reach_the_end(cnc)
    judge_points(next(folder.glob("*.axiscal")), POINTS)
    print(f"{POINTS} of {POINTS} points in order")
    document = json.loads((folder / "certificate.json").read_text())
    assert len(document["positions"]) == TARGETS, document["positions"]
    judge_figures(document, bench.truth(program), bounds_deg(hidden))


sys.exit(run_in_bench(turn))
