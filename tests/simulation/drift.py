"""A drift test of a machine that creeps, and the budget of the run after it."""

import contextlib
import csv
import json
import math
import sqlite3
from pathlib import Path

import bench
from bench import expect, sentence

CREEP_UM_PER_H = 600.0  # of the axis at rest; the station is not told
DURATION_S, INTERVAL_S = 12.0, 0.5


def recorded_ranges(file):
    """{(instrument, channel): largest - smallest} of what the run file holds, as stored."""
    with contextlib.closing(sqlite3.connect(f"file:{file}?mode=ro", uri=True)) as base:
        return {(instrument, name): range_ for instrument, name, range_ in base.execute(
            "SELECT instrument, name, max(value) - min(value) FROM environment"
            " JOIN channel ON channel.id = environment.channel GROUP BY channel.id")}


def expect_every_channel(found, shown, truth_um, file):
    """Whatever the station shows is told, with a range, a slope and, of a length, its E_VE."""
    recorded = recorded_ranges(file)
    told = {(one["instrument"], one["channel"]): one for one in found["channels"]}
    expect(set(told) == {(one["instrument"], one["name"]) for one in shown}, f"{sorted(told)}")
    for one in shown:
        channel = told[one["instrument"], one["name"]]
        if one["value"] is None:
            continue
        expect(channel["readings"] > 0, f"{channel}")
        scale = {"um": 1e6, "mm": 1e3}.get(channel["unit"], 1)  # lengths are stored in metres
        wanted = recorded[one["instrument"], one["name"]] * scale
        expect(math.isclose(channel["range"]["value"], wanted, rel_tol=1e-6, abs_tol=1e-9), f"{wanted}: {channel}")
        expect(channel["readings"] < 2 or channel["slope_per_h"] is not None, f"{channel}")
        expect(("E_VE" in channel) == (channel["quantity"] == "displacement"), f"{channel}")
    laser = told["laser", "axis 1"]
    expect(found["channels"][0] == laser, "what measures the axis stands first")
    expect(abs(laser["E_VE"]["value"] - truth_um) < 0.1, f"{laser}")
    # 0.1 um over the test of 11.5 s is 31 um in an hour
    for slope in (laser["slope_per_h"], found["slope_per_h"]):
        expect(abs(slope - CREEP_UM_PER_H) < 31, f"{slope} um/h, it crept {CREEP_UM_PER_H}")


@sentence("DriftTestFindsTheCreepAndFeedsTheBudgetOfTheNextRun")
def drift(b):
    b.scenario["errors"]["drift_um_per_hour"] = CREEP_UM_PER_H
    b.station["uncertainty"] = {
        "device": "0.7 um/m", "misalignment": "1 mm", "temperature_width": "0.5 K",
        "eve_run": "latest",
    }
    b.start()
    ended = b.drift_test("--duration", f"{DURATION_S} s", "--interval", f"{INTERVAL_S} s", "--at", "0",
                         "--state-that", "operator=Shift 2")
    folder = Path(ended["certificate"])
    found = json.loads((folder / "certificate.json").read_text())
    eve = found["parameters"]["E_VE"]["value"]
    # The first reading lies one interval after the begin, the last one at the end. 0.1 um of noise
    # a sample, a hundred in a window: 0.01 um a reading, the range of 24 of them four times that;
    # air and material change by 0.02 um on 150 mm in this time.
    truth = CREEP_UM_PER_H / 3600 * (DURATION_S - INTERVAL_S)
    expect(abs(eve - truth) < 0.1, f"E_VE {eve} um, the axis crept {truth} um")
    expect(found["test"]["readings"] == DURATION_S / INTERVAL_S, f"{found['test']}")
    expect(found["run"]["statements"]["operator"] == "Shift 2", f"{found['run']['statements']}")
    expect_every_channel(found, b.status()["channels"], truth, ended["file"])
    expect(found["budget"]["takes"] == "E_VE" and "channels" in found["budget"]["informative"],
           f"{found['budget']}")
    expect((folder / "certificate.pdf").read_bytes().startswith(b"%PDF-"), "there is no PDF")
    rows = list(csv.DictReader((folder / "certificate.csv").open(newline="")))
    axis = [row for row in rows if row["channel"] == "axis at 20 degC"]
    expect(len(axis) == found["test"]["readings"], f"{len(axis)} rows")
    for channel in found["channels"]:
        name = f"{channel['instrument']}/{channel['channel']}"
        told = [row for row in rows if row["channel"] == "# range" and row["unit"] == name]
        expect(len(told) == (channel["readings"] > 0), f"{name}: {told}")
    checked = json.loads(b.axiscal("verify", ended["file"], "--certificate",
                                   folder / "certificate.json", "--json"))
    expect(checked["findings"] == [] and checked["certificate_findings"] == [], f"{checked}")
    expect(checked["result_digest"] == found["run"]["result_digest"], f"{checked}")
    expect(json.loads(b.axiscal("analyze", ended["file"]))["parameters"] == found["parameters"],
           "analyze gives other figures")

    b.write_program()
    b.go_to_datum()
    b.axiscal("arm", "--program", b.plan["file"], code=4)
    expect(f"{DURATION_S:g} s, the axis at 0 mm. The axis was too near" in b.complaint, b.complaint)
    b.arm("--override", "eve=a simulated hall")
    certificate = b.finish()
    expect(certificate["run"]["uncertainty"]["eve_um"] == eve, f"{certificate['run']}")
    expect(any(ended["id"] in remark for remark in certificate["run"]["remarks"]),
           f"{certificate['run']['remarks']}")
    # u(B) = u_EVE sqrt(2 / n) with u_EVE = E_VE / (2 sqrt 3) and n = 2; U = 2 u, in mm.
    U = certificate["parameters"]["B"]["expanded_uncertainty"]["value"]
    expect(abs(U * 1e3 - 2 * eve / (2 * 3 ** 0.5)) < 1e-6, f"U(B) = {U} mm, E_VE {eve} um")


@sentence("DriftTestIsAbortedAndArmingWithoutOneIsRefused")
def aborted(b):
    b.station["uncertainty"] = {"eve_run": "latest"}
    b.start()
    begun = json.loads(b.axiscal("drift", "--duration", "1 h", "--json"))
    bench.wait_until("readings are taken", lambda: b.status()["drift"]["taken"] > 1, 30)
    b.axiscal("arm", code=4)
    expect("is going on" in b.complaint, b.complaint)
    expect("of 3600 readings" in b.axiscal("status"), "status shows the test")
    b.axiscal("abort", "--reason", "somebody moved the table")
    bench.wait_until(
        "the test is closed", lambda: b.status()["drift"]["state"] == "incomplete", 30
    )
    expect(b.status()["drift"]["id"] == begun["run"], f"{b.status()['drift']}")
    b.axiscal("analyze", b.status()["drift"]["file"], code=3)
    expect("somebody moved the table" in b.complaint, b.complaint)
    b.axiscal("arm", code=4)
    expect("axiscal drift" in b.complaint, b.complaint)
    b.axiscal("drift", "--duration", "ten", code=2)


if __name__ == "__main__":
    bench.main()
