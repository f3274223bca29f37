"""The pass mark: what the station reports against what the simulated machine hid.

E, M, B, B_mean (and one-way E) within the bound of the truth file, whose formula stands in it; R
and A within the middle 99.9 % of 10 000 seeded draws of the injected process.
"""

import json
import tomllib

import bench
from bench import expect, sentence

BOUNDED = ("E", "E_forward", "E_backward", "M", "B", "B_mean")
DRAWN = ("R", "R_forward", "R_backward", "A", "A_forward", "A_backward")


def one_metre(b, scenario, seed):
    """Eleven targets on one metre, five times from each side."""
    path = bench.SOURCE / f"tools/axiscal-simulate/scenarios/{scenario}.toml"
    b.scenario = tomllib.loads(path.read_text()) | {"seed": seed}
    b.station["axis"]["travel_high"] = "1035 mm"
    b.station["cycle"].update(
        interval="96 mm", target_count=11, first_target="34 mm", approaches=5
    )
    b.hurry()
    b.scenario["truth"]["duration_s"] = 120.0
    b.trigger("sequence-block", "tcp")


def compare(truth, reported):
    """Prints every parameter beside its truth; gives back the names of those that miss it."""
    missed = []
    print(f"{'':11} {'reported':>9} {'truth':>9}   allowed (um)")
    for name in BOUNDED + DRAWN:
        true, value = truth["parameters"][name], reported["parameters"][name]["value"]
        if name in BOUNDED:
            low, high = true["value"] - true["bound"], true["value"] + true["bound"]
        else:
            low, high = true["low"], true["high"]
        right = low <= value <= high
        missed += [] if right else [name]
        print(
            f"{name:11} {value * 1e3:9.3f} {true['value'] * 1e3:9.3f}"
            f"   {low * 1e3:.3f} .. {high * 1e3:.3f}{'' if right else '   MISSED'}"
        )
    return missed


def truth_is_found(b, scenario, seed):
    one_metre(b, scenario, seed)
    b.begin_run()
    certificate = b.finish()
    b.sim("truth truth.json")
    truth = json.loads((b.folder / "truth.json").read_text())
    expect(truth["approaches"] == 5 and len(truth["targets"]) == 11, "the truth's plan")
    missed = compare(truth, certificate)
    expect(not missed, f"outside of the truth: {', '.join(missed)}")
    expect(b.run()["step"] == 110, "110 points")
    done = certificate["compensation"]
    print(f"material {done['material_first_degC']:.2f} degC, largest corrections (mm):"
          f" material {done['largest_material_correction']:.4f},"
          f" air {done['largest_air_correction']:.4f}")


@sentence("FindsTheTruthWithTheMaterialAt17Degrees")
def cold(b):
    truth_is_found(b, "cold", seed=17)


@sentence("FindsTheTruthWithTheMaterialAt20Degrees")
def neutral(b):
    truth_is_found(b, "neutral", seed=20)


@sentence("FindsTheTruthWithTheMaterialAt26Degrees")
def hot(b):
    truth_is_found(b, "hot", seed=26)


if __name__ == "__main__":
    bench.main()
