"""A Wollaston prism shows how straight the axis moves, and nothing of where it is.

The machine hides the motion across it, play and scatter there, and the form of the mirror. What the certificate tells must be the motion across, within
the bound that the simulator states: the form of the mirror may be in it.
"""

import json
import subprocess

import bench
from bench import expect, sentence, wait_until

FACTOR = 36.0
FIGURES = [f"straightness_{line}{side}" for line in ("end_points", "least_squares", "minimum_zone")
           for side in ("", "_forward", "_backward")]


def with_prism(b):
    """Six targets on 0.4 m, twice from each side. Across: a bow of 10 um, a slope that belongs to the set-up, play and scatter; along:
    what the template has, which must not show."""
    b.scenario["straightness"] = {
        "factor": FACTOR,
        "across": {"linear_um_per_m": 30.0, "quadratic_um_per_m2": 250.0, "reversal_um": 1.5, "approach_noise_um": 0.1, "noise_um": 0.2},
        "mirror": {"quadratic_um_per_m2": 2.0},
    }
    b.station["straightness"] = {
        "across": "Y", "sign": 1, "factor": FACTOR, "factor_uncertainty": "0.5 %", "mirror_limit": 2.0,
        "resolution": "0.1 nm", "eve": "0.2 um", "interval": "70 mm",
        "optics": {"serial": "W-7", "certificate_number": "C-9", "calibrated_on": "2026-01-31", "due_on": "2099-01-31"},
    }


def begin(b, hold_after=None):
    """As Bench.begin_run, of the program that is written beside those of the axis."""
    b.start()
    shown = json.loads(b.axiscal("program", "--json", "--config", b.folder / "station.toml", "--out", b.folder))
    b.plan = next(one for one in shown["programs"] if one["pass"] == "straightness")
    b.go_to_datum()
    if hold_after:
        b.sim(f"hold {hold_after}")
    b.arm()


def expect_the_motion_across(b, certificate):
    truth = b.truth()["parameters"]
    for name in FIGURES:
        found_um, hidden = certificate["parameters"][name]["value"], truth[name]
        off_um, bound_um = abs(found_um - hidden["value"] * 1e3), hidden["bound"] * 1e3
        expect(off_um <= bound_um, f"{name}: {found_um} um, hidden {hidden['value'] * 1e3} um, bound {bound_um} um")
    main = truth["straightness_least_squares"]
    expect(main["value"] > 3 * main["bound"], f"the bound leaves nothing to find: {main}")


@sentence("StraightnessByAWollastonPrismIsTheMotionAcross")
def found(b):
    with_prism(b)
    begin(b)
    certificate = b.finish()
    expect_the_motion_across(b, certificate)
    expanded = certificate["parameters"]["straightness_least_squares"]["expanded_uncertainty"]
    expect(expanded["value"] > 0 and expanded["k"] == 2, f"{expanded}")
    checked = json.loads(b.axiscal("verify", b.run()["file"], "--json"))
    expect(checked["findings"] == [], f"{checked['findings']}")


@sentence("StraightnessGoesOnWhereTheDaemonWasKilled")
def killed(b):
    """The counter of the laser counted on: its zero holds, and no point is lost."""
    with_prism(b)
    begin(b, hold_after=8)
    wait_until("eight points are durable", lambda: b.run()["done"] == 8, 60)
    b.end("axiscald", bench.signal.SIGKILL)
    b.start_daemon_again()
    wait_until("the run goes on", lambda: b.run()["state"] == "armed", 30)
    b.sim("go")
    certificate = b.finish()
    expect_the_motion_across(b, certificate)


def run_again(b, *words):
    """Another whole run by the programs that begin anew; gives back its certificate."""
    for name in ("axiscald", "axiscal-simulate"):
        b.end(name)
    b.start()
    b.go_to_datum()
    b.arm(*words)
    return b.finish()


def truth_without_mirror(b):
    scenario = json.loads((b.folder / "scenario.json").read_text())
    del scenario["straightness"]["mirror"]
    (b.folder / "no-mirror.json").write_text(json.dumps(scenario))
    told = b.folder / "no-mirror.truth.json"
    subprocess.run([b.program("axiscal-simulate"), "truth", "--scenario", b.folder / "no-mirror.json", "--program", b.plan["file"], "--truth", told],
                   check=True, timeout=60)
    return json.loads(told.read_text())["parameters"]


@sentence("StraightnessByReversalIsTheMotionWithoutTheMirror")
def parted(b):
    """The mirror is as crooked as the axis: each run alone is wrong by it, the mean of both by nothing but noise."""
    with_prism(b)
    b.scenario["straightness"]["mirror"] = {"quadratic_um_per_m2": 150.0, "centre_mm": 200.0}
    begin(b)
    alone = b.finish()
    b.scenario["straightness"]["mirror_reversed"] = True
    certificate = run_again(b, "--option", "mirror=reversed", "--option", "reversal_of=latest")
    truth = truth_without_mirror(b)
    for name in FIGURES:
        hidden = truth[name]
        off_um = abs(certificate["parameters"][name]["value"] - hidden["value"] * 1e3)
        expect(off_um <= hidden["bound"] * 1e3, f"{name}: {certificate['parameters'][name]}, hidden {hidden}")
    main = truth["straightness_least_squares"]
    alone_um = alone["parameters"]["straightness_least_squares"]["value"]
    expect(abs(alone_um - main["value"] * 1e3) > 3 * main["bound"] * 1e3, f"one run alone would do: {alone_um}, {main}")
    expect(certificate["mirror"]["least_squares"] > 3, f"{certificate['mirror']}")
    checked = json.loads(b.axiscal("verify", b.run()["file"], "--json"))
    expect(checked["findings"] == [], f"{checked['findings']}")


if __name__ == "__main__":
    bench.main()
