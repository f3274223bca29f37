#!/usr/bin/python3
"""How straight an axis moves that LinuxCNC drives: linuxcnc_straightness.py SOURCE_DIR BUILD_DIR SHAPE

axiscal's X-straightness runs on LinuxCNC; X's 1 kHz motor position moves a simulated Wollaston prism along a bow that
the machine hides. Ten of ten points in order; each figure within the bound that the simulator states."""
import json
import sys

from linuxcnc_bench import FIVE_TARGETS, run_in_bench
from linuxcnc_figures import judge_points

POINTS = 10
HIDDEN = """
[straightness]
factor = 36.0

[straightness.across]
linear_um_per_m = 30.0
quadratic_um_per_m2 = 250.0
reversal_um = 1.5
approach_noise_um = 0.02
noise_um = 0.05
"""
STATED = """[straightness]
across = "Y"
sign = 1
factor = 36
factor_uncertainty = "0.5 %"
mirror_limit = 0.15
eve = "0.2 um"
resolution = "0.01 nm"
interval = "80 mm"
approaches = 1

[straightness.optics]
serial = "simulated"
certificate_number = "simulated"
due_on = "2099-12-31"

[cycle]
"""
FIGURES = [f"straightness_{line}{side}" for line in ("end_points", "least_squares", "minimum_zone")
           for side in ("", "_forward", "_backward")]


def judge_figures(document, truth):
    told = []
    for name in FIGURES:
        found_um = document["parameters"][name]["value"]
        hidden_um, bound_um = truth[name]["value"] * 1e3, truth[name]["bound"] * 1e3
        assert bound_um < hidden_um / 3, f"{name}: the bound {bound_um} um leaves nothing to find of {hidden_um} um"
        assert abs(found_um - hidden_um) <= bound_um, f"{name}: {found_um} um, hidden {hidden_um}, allowed {bound_um}"
        told.append(f"{name} {found_um:.3f} (hidden {hidden_um:.3f}, allowed {bound_um:.3f})")
    print("um:", "; ".join(told))


def measure(bench):
    scenario = bench.scratch / "straightness.toml"
    scenario.write_text(bench.scenario.read_text() + HIDDEN)
    bench.scenario = scenario
    bench.changes = {**FIVE_TARGETS, "[cycle]\n": STATED}
    daemon, cnc, program = bench.make_ready("X-straightness.ngc")
    bench.arm([daemon, cnc], "--program", program, run="straightness")
    folder = bench.reach_the_end(cnc)
    judge_points(next(folder.glob("*.axiscal")), POINTS)
    print(f"{POINTS} of {POINTS} points in order")
    document = json.loads((folder / "certificate.json").read_text())
    assert document["symbol"] == "E_YX" and document["missing"] == [], document["missing"]
    judge_figures(document, bench.truth(program))


sys.exit(run_in_bench(measure))
