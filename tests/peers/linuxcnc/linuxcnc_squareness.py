#!/usr/bin/python3
"""The angle between two axes that LinuxCNC drives: linuxcnc_squareness.py SOURCE_DIR BUILD_DIR SHAPE

X-straightness runs on LinuxCNC, then, with the station file of the second axis, Y-squareness: X's and Y's 1 kHz motor
positions move a simulated prism before a mirror, the second time behind an optical square with a stated error. The
certificate must tell the angle that the simulator hides, within the bound that it states."""
import json
import math
import sys

from linuxcnc_bench import FIVE_TARGETS, PATIENCE_S, run_in_bench
from linuxcnc_figures import judge_points

POINTS = 10
DRIVE = {"X": 1, "Y": 2}  # in a line of LinuxCNC's stream
AXES_UM_PER_M, SQUARE_UM_PER_M, FIRST_UM_PER_M = 40.0, -12.0, 30.0
SQUARE_ARCSEC = SQUARE_UM_PER_M * 1e-6 * 648000 / math.pi
MIDDLE_MM = 162.0  # of the targets, 2 to 322 mm: a bow about it has no slope of its own
FIGURES = ["squareness_least_squares", "squareness_end_points", "squareness_minimum_zone"]


def across(slope_um_per_m):
    return f"""
[straightness]
factor = 36.0

[straightness.across]
linear_um_per_m = {slope_um_per_m}
quadratic_um_per_m2 = 60.0
centre_mm = {MIDDLE_MM}
approach_noise_um = 0.02
noise_um = 0.05
"""


HIDDEN = {"X": across(FIRST_UM_PER_M), "Y": across(0.0) + f"""
[squareness]
axes_um_per_m = {AXES_UM_PER_M}
square_um_per_m = {SQUARE_UM_PER_M}
first_um_per_m = {FIRST_UM_PER_M}
"""}


def stated(direction):
    return f"""[straightness]
across = "{direction}"
sign = 1
factor = 36
factor_uncertainty = "0.5 %"
mirror_limit = 0.15
eve = "0.2 um"
resolution = "0.01 nm"
interval = "80 mm"
approaches = 1

"""


STATED = {"X": stated("Y"), "Y": stated("X") + f"""[squareness]
square_error = "{SQUARE_ARCSEC:.9f} arcsec"
square_uncertainty = "0.2 arcsec"
mount_limit = "0.1 arcsec"

"""}


def prepare(bench, quiet, letter):
    """Station and simulator of one axis; the state directory is that of both."""
    bench.scenario = bench.scratch / f"{letter}.toml"
    bench.scenario.write_text(quiet.replace('"X"', f'"{letter}"') + HIDDEN[letter])
    bench.changes = {**FIVE_TARGETS, 'name = "X"': f'name = "{letter}"', "[cycle]\n": STATED[letter] + "[cycle]\n"}
    bench.stream = ["--positions-field", DRIVE[letter]]


def measure(bench, letter, kind):
    """@returns the certificate, and the part program."""
    daemon, cnc, program = bench.make_ready(f"{letter}-{kind}.ngc")
    bench.arm([daemon, cnc], "--program", program, run=kind)
    bench.reach_the_end(cnc)
    folder = next((bench.scratch / "state/outbox").glob(f"*-{letter}"))
    judge_points(next(folder.glob("*.axiscal")), POINTS)
    return json.loads((folder / "certificate.json").read_text()), program


def stop(bench):
    for process in reversed(bench.running):
        process.terminate()
        process.wait(PATIENCE_S)
    bench.running.clear()
    for name in ("positions", "cnc.events"):
        (bench.scratch / name).unlink()


def judge(certificate, truth):
    assert certificate["unit"] == "um/m" and certificate["missing"] == [], certificate["missing"]
    told = []
    for name in FIGURES:
        found, hidden = certificate["parameters"][name]["value"], truth[name]
        assert hidden["bound"] < AXES_UM_PER_M / 5, f"{name}: the bound leaves nothing to find: {hidden}"
        assert abs(found - hidden["value"]) <= hidden["bound"], f"{name}: {found} um/m, hidden {hidden}"
        told.append(f"{name} {found:.2f} (hidden {hidden['value']:.2f}, allowed {hidden['bound']:.2f})")
    main = certificate["parameters"][FIGURES[0]]
    off = abs(main["value"] - AXES_UM_PER_M)
    assert off <= main["expanded_uncertainty"]["value"], f"the hidden angle lies outside U: {main}"
    print("um/m:", "; ".join(told))


def two_axes(bench):
    quiet = bench.scenario.read_text()
    prepare(bench, quiet, "X")
    measure(bench, "X", "straightness")
    stop(bench)
    prepare(bench, quiet, "Y")
    certificate, program = measure(bench, "Y", "squareness")
    print(f"twice {POINTS} of {POINTS} points in order")
    judge(certificate, bench.truth(program))


sys.exit(run_in_bench(two_axes))
