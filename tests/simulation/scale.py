"""A linear scale measures the axis: a homodyne counter on its lines, a sensor on its body, no air.

The machine hides an error curve and lost motion; machine and scale are warm, each by another amount
and of another material. What is reported must be the axis at 20 degC.
"""

import contextlib
import sqlite3

import bench
from bench import expect, sentence
from truth import BOUNDED, compare, expect_found

SCALE_PER_K = 8.5  # um/(m K): glass
WARMER_K = 2.5  # than the machine at 24 degC


def with_scale(b, stated_per_k=SCALE_PER_K):
    """Five targets on 0.4 m, counted by tenths of a micrometre; the station has no air sensor."""
    b.scenario["thermal"].update(
        material={"start": 24.0, "rate_per_hour": 0.1}, scale_warmer_k=WARMER_K,
        sensor_difference_k=[0.0],  # one on the machine; the next input is the scale's
    )
    b.scenario["laser"].update(
        kind="umd2-homodyne", counts_per_cycle=4, resolution_um=0.1,
        scale_expansion_um_per_m_k=SCALE_PER_K, dead_path_mm=0.0,
    )
    axis, instruments = b.station["axis"], b.station["instrument"]
    del axis["laser"], axis["dead_path"], axis["air"]
    axis["scale"] = {
        "channel": "scale/axis 1", "coefficient": f"{stated_per_k} um/(m*K)",
        "standard_uncertainty": "0.5 um/(m*K)", "temperature": ["material/contact 2"],
    }
    axis["material"]["temperature"] = ["material/contact 1"]
    counter, _, material = instruments
    del counter["wavelength"], counter["fold"]
    counter.update(name="scale", resolution="0.1 um")
    material["channel"][1]["place"] = "body of the scale"
    b.station["instrument"] = [counter, material]


def measured(b):
    """(truth, certificate) of a whole run."""
    b.begin_run()
    certificate = b.finish()
    return b.truth(), certificate


@sentence("LinearScaleFindsTheTruthWithoutAirSensors")
def truth_is_found(b):
    with_scale(b)
    truth, certificate = measured(b)
    missed = compare(truth, certificate)
    expect_found(missed)
    # The scale's growth alone is 8.5e-6 / K * 6.5 K * 320 mm = 17.7 um: far beyond the bound.
    bound = truth["parameters"]["E"]["bound"]
    expect(bound < 3e-3, f"the bound of E: {bound * 1e3:.2f} um")
    done = certificate["compensation"]
    expect(done["reference"] == "linear scale", f"{done}")
    expect(abs(done["scale_first_degC"] - 26.5) < 0.06, f"{done['scale_first_degC']} degC")
    expect("air_formula" not in done and "refractive_index_minus_1_first" not in done, "air is told")
    media = {one["medium"] for one in certificate["environment"]["channels"]}
    expect(media == {"material"}, f"recorded of the environment: {media}")
    expect(certificate["run"]["scale"]["temperatures"] == ["contact 2"], "its sensor")
    with contextlib.closing(sqlite3.connect(f"file:{b.run()['file']}?mode=ro", uri=True)) as file:
        rows = file.execute("SELECT resolution_m, coefficient_per_K FROM linear_scale").fetchall()
    expect(len(rows) == 1 and abs(rows[0][0] - 1e-7) < 1e-15, f"linear_scale: {rows}")
    expect(abs(rows[0][1] - 8.5e-6) < 1e-12, f"linear_scale: {rows}")


@sentence("LinearScaleOfAnotherMaterialThanStatedMissesTheTruth")
def scale_taken_for_steel(b):
    with_scale(b, stated_per_k=11.5)
    truth, certificate = measured(b)
    # 3e-6 / K * 6.5 K * 320 mm = 6.2 um of slope; both directions at one place have the same share.
    missed = [name for name in BOUNDED if name in compare(truth, certificate)]
    expect("E" in missed and "B" not in missed and "B_mean" not in missed, f"{missed}")


if __name__ == "__main__":
    bench.main()
