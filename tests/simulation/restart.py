"""A daemon that dies in mid-run goes on where it was, or says why it cannot."""

import contextlib
import json
import signal
import sqlite3
import subprocess
from pathlib import Path

import bench
from bench import expect, sentence


def interrupt(b, sign, code, points=5):
    b.begin_run()
    b.wait_for_points(points)
    expect(b.end("axiscald", sign) == code, "the exit code of axiscald")


def goes_on(b):
    """Every point once, in the order of the plan; the certificate tells of the interruption."""
    run_id = b.start_daemon_again()
    certificate = b.finish()
    run = b.run()
    expect(run["id"] == run_id and run["step"] == run["steps"] == 20, f"the run: {run}")
    rows = certificate["run"]["deviations"]
    expect([len(row) for row in rows["forward"] + rows["backward"]] == [2] * 10, f"{rows}")
    remarks = " ".join(certificate["run"]["remarks"])
    print(remarks)
    expect("The run was interrupted at" in remarks, remarks)
    expect("The station recorded nothing for" in remarks, remarks)
    expect("The laser counted on during the interruption" in remarks, remarks)
    expect("The run was resumed at" in remarks, remarks)
    printed = pdf_words(Path(run["certificate"]) / "certificate.pdf")
    for words in ("The run was interrupted at", "The station recorded nothing for"):
        expect(words in printed, f"the PDF does not tell of the interruption: {printed}")
    return remarks


def pdf_words(path):
    done = subprocess.run(["pdftotext", "-layout", path, "-"], capture_output=True, text=True, check=True)
    return " ".join(done.stdout.split())


def closed_because(b, words):
    """The next daemon closes the run as incomplete, says why, and the file says it too."""
    b.start_daemon()
    notes = bench.wait_until(
        "the run is closed",
        lambda: [n for n in b.status()["notes"] if "closed as incomplete" in n],
        30,
    )
    expect(words in notes[-1], notes[-1])
    expect(b.run() is None, "no run is open")
    files = list((b.folder / "state" / "runs").glob("*.axiscal"))
    told = json.loads(b.axiscal("verify", files[0], "--json"))
    expect(told["closed"] and not told["complete"] and told["rows"]["point"] >= 5, f"{told}")
    with contextlib.closing(sqlite3.connect(files[0])) as base:
        reason = base.execute("SELECT reason FROM closing").fetchone()[0]
    expect(words in reason, reason)


@sentence("KilledDaemonGoesOnWithTheRunOverTcp")
def killed_tcp(b):
    interrupt(b, signal.SIGKILL, -signal.SIGKILL)
    goes_on(b)


@sentence("KilledDaemonGoesOnWithTheRunOverRtu")
def killed_rtu(b):
    b.trigger("sequence-block", "rtu")
    interrupt(b, signal.SIGKILL, -signal.SIGKILL)
    goes_on(b)


@sentence("KilledDaemonGoesOnWithTheRunOnASingleRegister")
def killed_single_register(b):
    b.trigger("single-register", "tcp")
    interrupt(b, signal.SIGKILL, -signal.SIGKILL)
    goes_on(b)


@sentence("KilledDaemonGoesOnWithTheRunOnCoilAndIndex")
def killed_coil_and_index(b):
    b.trigger("coil-and-index", "tcp")
    interrupt(b, signal.SIGKILL, -signal.SIGKILL)
    goes_on(b)


@sentence("StoppedDaemonGoesOnWithTheRun")
def stopped(b):
    interrupt(b, signal.SIGTERM, 0)
    remarks = goes_on(b)
    expect("The daemon was stopped; the run stays open" in remarks, remarks)


@sentence("RequestThatChangedMeanwhileEndsTheRunAsSequenceLost")
def advanced_by_hand(b):
    interrupt(b, signal.SIGKILL, -signal.SIGKILL)
    b.sim("stop")
    b.sim(f"connect 127.0.0.1 {bench.free_port()}")  # the CNC's cable is pulled
    b.start_daemon_again()
    b.foreign_request(15)
    bench.wait_until("the run is closed", lambda: not b.status()["run_open"], 10)
    b.axiscal("watch", code=6)
    run = b.run()
    expect(run["state"] == "incomplete" and run["fault"] == "sequence_lost", f"{run}")
    expect("Request 15 came, but" in run["sentence"], run["sentence"])


@sentence("LaserThatWasSwitchedOffMeanwhileEndsTheRunAsDatumLost")
def counter_restarted(b):
    interrupt(b, signal.SIGKILL, -signal.SIGKILL)
    b.sim("restart-counter")
    closed_because(b, "The datum is lost: its number advanced by")


@sentence("StationFileThatWasChangedMeanwhileEndsTheRun")
def config_changed(b):
    interrupt(b, signal.SIGKILL, -signal.SIGKILL)
    b.station["certificate"]["place"] = "another hall"
    b.write_station()
    closed_because(b, "The station file was changed since the run was opened.")


if __name__ == "__main__":
    bench.main()
