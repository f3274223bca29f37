#!/usr/bin/python3
"""Circles with LinuxCNC as the machine: linuxcnc_circle.py SOURCE_DIR BUILD_DIR SHAPE

axiscal's circular program runs on LinuxCNC; its 1 kHz motor positions of two axes move a simulated
ballbar through the errors of quiet-circle.toml, and these must come back in the diagnosis. The
station has a ballbar and no laser."""
import json
import math
import pathlib
import sys
import tomllib

from linuxcnc_bench import RUN_LIMIT_S, leftovers, run_in_bench, until

RADIUS_MM = 100.0
# What may part a found cause from the hidden one, besides 3.5 standard uncertainties by the scatter:
# angles. LinuxCNC drives whole servo cycles, so braking at both ends of the arc may differ by one of
# them (0.1 mm of path, half of it in the middle of the circle); the form there (15 um) shifts the steps,
# crossed at two thirds of the feed, by 22 um; the counter's clock holds 0.2 ms, 20 um: 0.1 mm in all,
# 1 mrad. Turned by it a form of 10 um twice a turn changes by 20 nm, the cyclic error (63 periods in
# the radius) by 6 % of 1.5 um, 90 nm, of which no cause of low order takes more than half. Times a
# condition of 3.
ANGLE_MM = 0.2e-3


def hidden(scenario):
    with open(scenario, "rb") as file:
        bar = tomllib.load(file)["ballbar"]
    return bar, {
        "scale_x": (bar["scale_first_um_per_m"] * 1e-6, RADIUS_MM),
        "scale_y": (bar["scale_second_um_per_m"] * 1e-6, RADIUS_MM),
        "squareness_rad": (bar["squareness_um_per_m"] * 1e-6, RADIUS_MM),
        "backlash_x_mm": (bar["backlash_first_um"] * 1e-3, 1),
        "backlash_y_mm": (bar["backlash_second_um"] * 1e-3, 1),
    }


def judge(certificate, scenario):
    diagnosis, (bar, wanted) = certificate["diagnosis"], hidden(scenario)
    told = []
    for key, (value, leverage) in wanted.items():
        off = abs(diagnosis[key] - value) * leverage
        bound = ANGLE_MM + 3.5 * diagnosis["standard_uncertainty"].get(key, 0.0) * leverage
        assert off < bound, f"{key}: {diagnosis[key]}, hidden {value}: off by {off * 1e3:.3f} um: {diagnosis}"
        told.append(f"{key} within {off * 1e3:.3f} um")
    cyclic = [one for one in diagnosis["cyclic"] if one["axis"] == "X"]
    assert cyclic, f"no cyclic error of X in {diagnosis['cyclic']}"
    pitch_mm, amplitude_mm = cyclic[0]["pitch_mm"], cyclic[0]["amplitude_mm"]
    assert abs(pitch_mm / bar["cyclic_period_mm"] - 1) < 0.01, cyclic
    spread = 3.5 * cyclic[0]["standard_uncertainty"]["amplitude_mm"]
    assert abs(amplitude_mm - bar["cyclic_first_um"] * 1e-3) < 0.1e-3 + spread, cyclic
    print("; ".join(told), f"; cyclic error {amplitude_mm * 1e3:.2f} um every {pitch_mm:.2f} mm")


def drive(bench):
    bench.scenario = bench.source / "tests/peers/linuxcnc/quiet-circle.toml"
    bench.station = bench.source / "tests/peers/linuxcnc/circle-station.toml.in"
    daemon, cnc, _ = bench.make_ready("XY-circular.ngc")
    bench.arm([daemon, cnc], "--pass", "circular", run="circular")
    assert cnc.wait(RUN_LIMIT_S) == 0, f"LinuxCNC: {(bench.scratch / 'cnc.events').read_text()}"
    until(lambda: bench.status()["run"]["certificate"] or bench.status()["run"]["sentence"],
          "the certificate", [daemon], RUN_LIMIT_S)  # its figures take a sanitizer 20 s of a processor
    run = bench.status()["run"]
    assert run["state"] == "complete" and run["step"] == 2 and run["certificate"], run
    certificate = json.loads((pathlib.Path(run["certificate"]) / "certificate.json").read_text())
    for circle in certificate["run"]["circles"]:
        assert circle["missing_readings"] == 0, circle
        # What braking at 3 m/s2 costs: at both ends of the arc v2 / 2a, of the half way in and out
        # v sqrt(s / a) - s / 2; LinuxCNC comes to rest at a corner some servo cycles (0.1 mm) later
        # than a trapezoid does, at both alike.
        braking_mm = 100.0**2 / 3000 + 2 * (100.0 * math.sqrt(1.5 / 3000) - 0.75)
        assert 0 < circle["residual_mm"] - braking_mm < 3, (circle, braking_mm)
        print(f"{circle['sense']}: residual {circle['residual_mm']:.3f} mm")
    judge(certificate, bench.scenario)
    left = leftovers(bench.scratch)
    assert not left, f"left behind: {left}"


sys.exit(run_in_bench(drive))
