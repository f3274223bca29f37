"""Points taken again and readings left out, from the command line to the certificate."""

import contextlib
import json
import os
import signal
import sqlite3
import subprocess
from pathlib import Path

import bench
from bench import expect, sentence


def take_again(b, *words):
    """Orders it, writes its program and starts it; gives back the order."""
    order = json.loads(b.axiscal("retake", "--json", *words))
    shown = b.axiscal("program", "--json", "--retake", b.run()["file"], "--config",
                      b.folder / "station.toml", "--out", b.folder)
    program = json.loads(shown)["programs"][0]
    expect(program["points"] == len(order["points"]), f"{program} for {order}")
    expect(program["last_request"] == order["last_request"], f"{program} for {order}")
    b.sim(f"run {program['file']}")
    return order


@sentence("PointsAreTakenAgainAfterTheRunWasClosed")
def after_the_run(b):
    b.begin_run()
    first = b.finish()
    first_folder = Path(b.run()["certificate"])
    order = take_again(b, "--target", 2, "--cycle", 1, "--reason", "coolant on the mirror", "--by", "Jo Miller")
    expect(len(order["points"]) == 2 and order["last_request"] == 20, f"{order}")
    second = b.finish()
    run = b.run()
    expect(run["done"] == 22 and run["state"] == "complete", f"{run}")
    aside = second["run"]["set_aside"]
    expect([(one["target"], one["approach"], one["why"]) for one in aside]
           == [(1, 0, "superseded")] * 2, f"{aside}")
    was = first["run"]["deviations"]["forward"][1][0]
    forward = next(one for one in aside if one["direction"] == "positive")
    expect(abs(forward["deviation"] - was) < 1e-9, f"{forward} was {was}")
    expect(second["run"]["retakes"][0]["reason"] == "coolant on the mirror", "the reason is kept")
    told = [r for r in second["run"]["remarks"] if "Readings replaced" in r]
    expect(len(told) == 1 and "P2 ↑ 1" in told[0], f"{second['run']['remarks']}")
    expect(Path(run["certificate"]).name.endswith("-r2"), run["certificate"])
    expect((first_folder / "certificate.pdf").exists(), "the first certificate is not touched")
    numbers = [one["certificate"]["number"] for one in (first, second)]
    expect(numbers[0].endswith("-0001") and numbers[1].endswith("-0002"), f"one number a paper: {numbers}")
    expect(first["certificate"]["replaces"] is None, f"{first['certificate']}")
    expect(second["certificate"]["replaces"] == numbers[0], f"{second['certificate']}")
    drawn = subprocess.run(["pdftotext", "-layout", Path(run["certificate"]) / "certificate.pdf", "-"],
                           capture_output=True, text=True, timeout=60, check=True).stdout
    expect(f"Certificate No. {numbers[1]}, replaces {numbers[0]}" in drawn, drawn[:600])
    orders = [(one["order"], one["about"], one["uid"], one["by"]) for one in second["run"]["orders"]]
    expect(orders == [("arm", None, os.getuid(), None), ("retake", "1", os.getuid(), "Jo Miller")], f"{orders}")
    csv = (Path(run["certificate"]) / "certificate.csv").read_text()
    expect(csv.count("# superseded") == 2, csv[:2000])
    expect(f"# replaces,{numbers[0]}" in csv and f"# certificate_number,{numbers[1]}" in csv, csv[:600])
    checked = json.loads(b.axiscal("verify", "--json", run["file"]))
    expect(checked["intact"], f"{checked['findings']}")


@sentence("PointsAreTakenAgainAfterTheDaemonWasStartedAnew")
def after_a_restart(b):
    b.begin_run()
    b.finish()
    file = b.run()["file"]
    expect(b.end("axiscald", signal.SIGKILL) == -signal.SIGKILL, "the exit code of axiscald")
    b.start_daemon()
    bench.wait_until("good readings", b.channels_are_good, 30)
    expect(b.run() is None, "no run is shown before somebody asks for it")
    b.axiscal("retake", "--json", "--target", 2, "--cycle", 1, "--reason", "coolant on the mirror")
    expect(b.run()["file"] == file, f"{b.run()}")
    shown = b.axiscal("program", "--json", "--retake", file, "--config", b.folder / "station.toml",
                      "--out", b.folder)
    b.sim(f"run {json.loads(shown)['programs'][0]['file']}")
    certificate = b.finish()
    expect(len(certificate["run"]["set_aside"]) == 2, f"{certificate['run']['set_aside']}")
    told = " ".join(certificate["run"]["remarks"])
    for words in ("restarted after the run had been closed", "The laser counted on"):
        expect(words in told, told)


@sentence("PointsAreTakenAgainInAnOpenRunAndTheReplacedReadingsStay")
def in_the_open_run(b):
    b.begin_run(hold_after=5)
    b.wait_for_points(5)
    file = Path(b.run()["file"])
    first = points_of(file)
    expect(sorted(first) == [0, 1, 2, 3, 4], f"{sorted(first)}")
    order = json.loads(b.axiscal("retake", "--json", "--target", 2, "--cycle", 1, "--direction", "up",
                                 "--reason", "coolant on the mirror"))
    expect([(one["step"], one["target"]) for one in order["points"]] == [(20, 1)], f"{order}")
    run = b.run()
    expect(run["state"] != "complete" and run["retakes_left"] == 1, f"{run}")
    b.sim("go")
    b.wait_for_points(20)
    run = b.run()
    expect(run["state"] != "complete" and run["certificate"] == "", f"closed without the point: {run}")
    shown = b.axiscal("program", "--json", "--retake", file, "--config", b.folder / "station.toml",
                      "--out", b.folder)
    program = json.loads(shown)["programs"][0]
    expect(program["points"] == 1 and program["last_request"] == 20, f"{program}")
    b.sim(f"run {program['file']}")
    certificate = b.finish()
    run = b.run()
    expect(run["state"] == "complete" and run["done"] == 21, f"{run}")
    forward = certificate["run"]["deviations"]["forward"]
    expect([len(row) for row in forward] == [2] * 5, f"{forward}")
    aside = certificate["run"]["set_aside"]
    expect([(one["target"], one["approach"], one["why"]) for one in aside] == [(1, 0, "superseded")], f"{aside}")
    expect(abs(aside[0]["deviation"] - forward[1][0]) > 0, "the figures use the new reading")
    kept = points_of(file)
    expect(sorted(kept) == list(range(21)), f"{sorted(kept)}")
    expect(all(kept[step] == first[step] for step in first), "the replaced readings are kept bit for bit")
    expect(kept[20][1] == kept[1][0] == 1, f"step 20 replaces step 1: {kept[20]}")
    checked = json.loads(b.axiscal("verify", "--json", file))
    expect(checked["intact"] and checked["rows"]["closing"] == 1, f"{checked}")


def points_of(file):
    """{step: (step, planned step, target, reading in m)} of the run file; it may be open."""
    with contextlib.closing(sqlite3.connect(f"file:{file}?mode=ro", uri=True)) as base:
        rows = base.execute("SELECT step, planned_step, target_index, reading_m FROM point").fetchall()
    return {row[0]: row for row in rows}


@sentence("ReadingLeftOutIsCountedAndThePointTakenAgainCounts")
def left_out(b):
    b.station["cycle"].update(approaches=3)
    b.begin_run()
    b.wait_for_points(3)
    b.axiscal("exclude", "--target", 1, "--direction", "up", "--cycle", 1, "--reason",
              "somebody leaned on the table")
    certificate = b.finish()
    rows = certificate["run"]["deviations"]["forward"]
    expect([len(row) for row in rows] == [2, 3, 3, 3, 3], f"{rows}")
    told = " ".join(certificate["run"]["remarks"])
    for words in ("Readings excluded: 1", "somebody leaned on the table", "asks for five"):
        expect(words in told, f"'{words}' is not said: {told}")
    b.axiscal("exclude", "--target", 1, "--direction", "up", "--cycle", 2, "--reason", "more",
              code=4)
    expect("At least two" in b.complaint, b.complaint)
    take_again(b, "--target", 1, "--direction", "up", "--cycle", 1, "--reason", "once more")
    rows = b.finish()["run"]["deviations"]["forward"]
    expect([len(row) for row in rows] == [3] * 5, f"{rows}")


@sentence("ArmingShowsEveryCheckThatFailsAndPrintsTheOverride")
def preflight(b):
    b.station["preflight"]["soak_window"] = "10 min"
    b.station["instrument"][1]["due_on"] = "2020-01-01"
    b.start()
    b.write_program()
    b.go_to_datum()
    checks = json.loads(b.axiscal("preflight", "--json", code=4))["checks"]
    failing = [check["name"] for check in checks if not check["passed"]]
    expect(failing == ["soak", "certificates"], f"{checks}")
    b.axiscal("arm", "--program", b.plan["file"], code=4)
    for words in ("soak", "certificates", "--override"):
        expect(words in b.complaint, b.complaint)
    b.arm("--override", "soak=a test", "--override", "certificates=the new one is on its way")
    certificate = b.finish()
    told = " ".join(certificate["run"]["remarks"])
    for words in ("a test", "the new one is on its way", "2020-01-01"):
        expect(words in told, f"'{words}' is not said: {told}")
    expect(len(certificate["run"]["preflight"]) == 12, f"{certificate['run']['preflight']}")


if __name__ == "__main__":
    bench.main()
