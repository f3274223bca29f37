"""A rotary axis with a polygon on it, an autocollimator on the wire that the station reads by itself.

The machine hides an angle error curve and lost motion, the polygon has deviations of its own, which
its certificate states. Of the axis a millimetre stands for a degree, a micrometre of the scenario
for a thousandth of it.
"""

import math

import bench
from bench import expect, sentence
from truth import BOUNDED, compare, expect_found

FACES = 8
ASKED_EVERY_S = 0.02
POINTS = 2 * 2 * FACES  # from each side twice


def face_arcsec():
    """Deviations of the faces, that of face 0 first: seven seconds of arc over the turn."""
    return [round(3 * math.sin(2 * math.pi * k / FACES) + 0.5 * (-1) ** k - 0.5, 2) for k in range(FACES)]


def polygon(b, known_faces=True):
    """Eight faces over a turn, twice from each side, by the autocollimator."""
    b.scenario["axis"] = {
        "name": "A", "letter": "A", "start_mm": -2.0, "travel_low_mm": -3.0, "travel_high_mm": 318.0,
        "rapid_mm_per_min": 20000.0, "acceleration_mm_per_s2": 4000.0,
    }
    # 18 seconds of arc of error, 7.2 of lost motion, 0.36 of noise in each answer, 0.1 at a stop
    b.scenario["errors"] = {
        "table": [[-3, 0.0], [60, 2.5], [150, -1.0], [240, -2.5], [318, 1.5]],
        "reversal_um": -2.0, "approach_noise_um": 0.03, "noise_um": 0.1,
        "drift_um_per_hour": 0.05,
    }
    b.scenario["thermal"] = {"material": {"start": 24.0, "rate_per_hour": 0.2}}
    b.scenario["polygon"] = {
        "faces": FACES, "range_arcsec": 900.0, "deviation_arcsec": face_arcsec(), "poll_s": ASKED_EVERY_S,
    }
    b.scenario["truth"].update(window_s=0.6, duration_s=180.0)
    b.scenario["sensor"] = [{"name": "collimator", "kind": "elcomat", "path": "collimator.tty"}]
    b.station["instrument"] = [{
        "name": "collimator", "driver": "ascii-gauge", "model": "elcomat-x",
        "link": f"serial:{b.folder}/collimator.tty", "poll_period": f"{ASKED_EVERY_S} s",
        "serial": "E-1", "certificate_number": "simulated", "due_on": "2099-12-31",
    }]
    axis = b.station["axis"]
    for key in ("material", "air", "laser", "dead_path", "feedback_pitch"):
        axis.pop(key, None)
    axis.update(name="A", kind="rotary", travel_low="-3 deg", travel_high="318 deg")
    axis["angle"] = {
        "method": "polygon", "faces": FACES, "range": "800 arcsec", "autocollimator": "collimator/angle",
        "serial": "P-1", "certificate_number": "W-2", "due_on": "2099-12-31",
    }
    if known_faces:
        axis["angle"].update(
            deviations=[f"{d} arcsec" for d in face_arcsec()], certificate_sense="with_axis"
        )
    cycle = b.station["cycle"]
    for key in ("interval", "target_count", "first_target", "seed"):
        cycle.pop(key, None)
    cycle.update(
        targets=[f"{45 * face} deg" for face in range(FACES)], overrun="2 deg",
        near_tolerance="0.2 deg", datum="-2 deg", feed="18000 deg/min", approaches=2, dwell="0.6 s",
    )
    b.station["capture"].update(
        window="0.6 s", timeout="15 s", spread_limit="4 arcsec", slope_limit="20 arcsec/s",
        fastest="400 deg/s",
    )
    b.trigger("sequence-block", "tcp")
    b.scenario["cnc"]["counts_per_unit"] = 100000.0  # 0.00001 degree
    # Between two faces it has no reading, and answers all the same.
    b.channels_are_good = lambda: b.instrument("collimator")["state"] in ("available", "faulty")


@sentence("RotaryAxisIsFoundByAPolygonAndAnAutocollimator")
def truth_is_found(b):
    polygon(b)
    b.station["certificate"]["run_out"] = "8 um"
    b.begin_run()
    certificate = b.finish()
    expect(b.run()["step"] == POINTS, f"{b.run()}")
    expect(certificate["unit"] == "deg", certificate["unit"])
    truth = b.truth()
    missed = compare(truth, certificate)
    expect_found(missed)
    # Seven seconds of arc of the polygon and 18 of the axis are far above what the bound allows.
    for name in ("E", "M", "B"):
        bound = truth["parameters"][name]["bound"]
        expect(bound < 0.4e-3, f"the bound of {name}: {bound * 3600:.2f} arcsec")
    rotary = certificate["run"]["rotary"]
    expect(rotary["run_out"] == "8 um" and rotary["method"] == "polygon", f"{rotary}")
    names = [one["name"] for one in certificate["run"]["instruments"]]
    expect("collimator" in names and "polygon" in names, f"{names}")


@sentence("RotaryAxisByAPolygonOfUnknownDeviationsShowsThemInItsErrors")
def faces_taken_as_exact(b):
    polygon(b, known_faces=False)
    b.begin_run()
    certificate = b.finish()
    # B cancels the faces, for both directions see the same one; M does not.
    wrong = [name for name in BOUNDED if name in compare(b.truth(), certificate)]
    expect("M" in wrong and "B" not in wrong and "B_mean" not in wrong, f"{wrong}")


@sentence("RotaryPointIsRefusedInTimeWhereTheAutocollimatorFallsSilentAndItIsFoundAgain")
def silent(b):
    polygon(b)
    b.station["capture"]["timeout"] = "3 s"
    b.begin_run(hold_after=4)
    b.wait_for_points(4)
    b.sim("sensor collimator off")
    b.sim("go")
    run = b.wait_for_refusal("not_still")
    expect("autocollimator shows no still face" in run["sentence"], run["sentence"])
    expect(run["step"] == 4, f"{run}")
    bench.wait_until("it is missed", lambda: b.instrument("collimator")["state"] == "unavailable", 30)
    b.sim("sensor collimator on")
    bench.wait_until("it is found again", b.channels_are_good, 30)


if __name__ == "__main__":
    bench.main()
