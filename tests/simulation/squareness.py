"""Two straightness runs and an optical square show the angle that the simulated axes hide.

The first run is of X; then the same state directory gets the station file of Y, and the simulator hides how the axes stand to each other. What the
certificate tells must be that angle, within the bound that the simulator states; turned, the square must tell its own error, too.
"""

import json
import math

import bench
from bench import expect, sentence

FACTOR = 36.0
ARCSEC_PER_UM_PER_M = 648000 / math.pi * 1e-6
MIDDLE_MM = 200.0  # of the targets: a bow about it has no slope of its own against any of the three lines
FIRST_UM_PER_M = 30.0
HIDDEN = {"axes_um_per_m": 40.0, "square_um_per_m": -12.0, "first_um_per_m": FIRST_UM_PER_M}
FIGURES = ["squareness_least_squares", "squareness_end_points", "squareness_minimum_zone"]


def motion(slope_um_per_m):
    return {
        "linear_um_per_m": slope_um_per_m, "quadratic_um_per_m2": 60.0, "centre_mm": MIDDLE_MM, "reversal_um": 0.5,
        "approach_noise_um": 0.05, "noise_um": 0.2,
    }


def with_first_axis(b):
    """Six targets on 0.4 m, twice from each side."""
    b.scenario["straightness"] = {"factor": FACTOR, "across": motion(FIRST_UM_PER_M)}
    b.station["straightness"] = {
        "across": "Y", "sign": 1, "factor": FACTOR, "factor_uncertainty": "0.5 %", "mirror_limit": 1.0, "resolution": "0.1 nm",
        "eve": "0.1 um", "targets": [f"{place} mm" for place in (25, 95, 165, 235, 305, 375)],
    }


def with_second_axis(b, **table):
    """The same prism before Y, whose own motion has no slope: the angle and the square give it one."""
    b.scenario["axis"].update(name="Y", letter="Y")
    b.scenario["straightness"]["across"] = motion(0.0)
    b.scenario["squareness"] = dict(HIDDEN)
    b.station["axis"]["name"] = "Y"
    b.station["straightness"]["across"] = "X"
    b.station["squareness"] = {"mount_limit": "0.3 arcsec", **table}


def measure(b, kind, *words):
    """A whole run, by programs that begin anew; gives back its certificate."""
    for name in ("axiscald", "axiscal-simulate"):
        if name in b.processes:
            b.end(name)
    b.start()
    shown = json.loads(b.axiscal("program", "--json", "--config", b.folder / "station.toml", "--out", b.folder))
    b.plan = next(one for one in shown["programs"] if one["pass"] == kind)
    b.go_to_datum()
    b.arm(*words)
    return b.finish()


def expect_near(what, found, hidden):
    expect(abs(found - hidden["value"]) <= hidden["bound"], f"{what}: {found}, hidden {hidden['value']}, bound {hidden['bound']}")


def expect_the_angle(b, certificate):
    truth = b.truth()
    expect(certificate["unit"] == truth["unit"] == "um/m", f"{certificate['unit']}")
    for name in FIGURES:
        expect_near(name, certificate["parameters"][name]["value"], truth["parameters"][name])
    main = truth["parameters"][FIGURES[0]]
    expect(abs(main["value"] - HIDDEN["axes_um_per_m"]) < 1e-3, f"the bow has a slope of its own: {main}")
    expect(abs(HIDDEN["square_um_per_m"]) > 2 * main["bound"], f"the bound leaves nothing to find: {main}")
    return truth


def expect_sound(b):
    checked = json.loads(b.axiscal("verify", b.run()["file"], "--json"))
    expect(checked["findings"] == [], f"{checked['findings']}")


@sentence("SquarenessOfTwoStraightnessRunsIsTheAngleOfTheAxes")
def found(b):
    with_first_axis(b)
    measure(b, "straightness")
    stated = HIDDEN["square_um_per_m"] * ARCSEC_PER_UM_PER_M
    with_second_axis(b, square_error=f"{stated:.9f} arcsec", square_uncertainty="0.4 arcsec")
    certificate = measure(b, "squareness")
    expect_the_angle(b, certificate)
    expanded = certificate["parameters"][FIGURES[0]]["expanded_uncertainty"]
    expect(expanded["value"] > 0 and expanded["k"] == 2, f"{expanded}")
    expect_sound(b)


@sentence("SquarenessByReversalPartsTheErrorOfTheSquare")
def parted(b):
    """Nobody states the error of the square: the first squareness is wrong by it, and the second one finds both."""
    with_first_axis(b)
    measure(b, "straightness")
    with_second_axis(b)
    apparent = measure(b, "squareness")["parameters"][FIGURES[0]]["value"]
    main = b.truth()["parameters"][FIGURES[0]]
    expect_near("apparent", apparent + HIDDEN["square_um_per_m"], main)
    b.scenario["squareness"]["square_turned"] = True
    certificate = measure(b, "squareness", "--option", "square=turned", "--option", "reversal_of=latest")
    truth = expect_the_angle(b, certificate)
    square = certificate["square"]
    expect(square["position"] == "turned" and square["error_by"] == "reversal", f"{square}")
    expect_near("error of the square", square["error_taken_out"]["value"], truth["parameters"]["square_error"])
    expect_sound(b)


if __name__ == "__main__":
    bench.main()
