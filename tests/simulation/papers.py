"""After the run: the same figures from the file, the same bytes of paper, one copy on the share."""

import hashlib
import json
import shutil
import sqlite3
import subprocess
import sys
from contextlib import closing
from pathlib import Path

import bench
from bench import expect, sentence


def numbers(document):
    return {key: document[key] for key in ("parameters", "positions")}


def digests(folder):
    return {
        path.name: hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(Path(folder).rglob("*"))
        if path.is_file()
    }


def publish(b, code=0):
    done = subprocess.run(
        [b.program("axiscal-publish"), "--config", b.folder / "station.toml", "--once", "--json"],
        capture_output=True, text=True, timeout=60, check=False,
    )
    expect(done.returncode == code, f"exit {done.returncode}: {done.stdout}{done.stderr}")
    return [json.loads(line) for line in done.stdout.splitlines()]


@sentence("RunFileGivesTheCertificateAgainBitByBit")
def recompute(b):
    b.begin_run()
    certificate = b.finish()
    run_file = b.run()["file"]
    b.end("axiscald")  # everything below needs no daemon
    elsewhere = shutil.copy(run_file, b.folder / "mailed.axiscal")
    again = json.loads(b.axiscal("analyze", elsewhere))
    expect(numbers(again) == numbers(certificate), "other figures than on the certificate")
    # Equal numbers may hide other digits: the printed shortest forms must be the same, too.
    printed = [json.dumps(numbers(one)) for one in (again, certificate)]
    expect(printed[0] == printed[1], "the figures print differently")
    expect(len(again["positions"]) == 5 and again["compensation"]["state"], "the document")

    folders = [b.folder / name for name in ("first", "second")]
    for folder in folders:
        folder.mkdir()
        b.axiscal("export", run_file, "--out", folder)
    first, second = (digests(folder) for folder in folders)
    expect(first == second, f"the second export differs: {first} {second}")
    expect({Path(name).suffix for name in first} >= {".json", ".csv", ".pdf"}, f"{list(first)}")


@sentence("CertificateIsPublishedOnceWithAReceipt")
def published(b):
    b.begin_run()
    b.finish()
    run_id, entry = b.run()["id"], Path(b.run()["certificate"])
    written = digests(entry)
    events = publish(b)
    expect([e["event"] for e in events] == ["published"], f"{events}")
    receipt = events[0]
    copied = digests(b.share / run_id)
    expect(copied.items() >= written.items(), f"{copied} is not {written}")
    named = {one["name"]: one["sha256"] for one in receipt["files"]}
    expect(named.items() >= written.items(), f"the receipt: {receipt}")
    expect(publish(b) == [], "nothing is left to publish")
    expect(digests(b.share / run_id) == copied, "the second pass changed the copy")
    expect(not list(b.share.glob(".*")), "temporary files are left on the share")


@sentence("RunRewrittenWholeIsToldByItsSignatureAndItsReceipt")
def rewritten(b):
    b.begin_run()
    b.finish()
    run_id, run_file = b.run()["id"], b.run()["file"]
    publish(b)
    state = Path(run_file).parent.parent
    proofs = ["--public-key", state / "public-keys.pem", "--receipt", state / "published" / run_id / "receipt.json"]

    def judged(path, code):
        done = subprocess.run([b.program("axiscal"), "verify", path, "--json", *proofs], capture_output=True,
                              text=True, timeout=60, check=False)
        expect(done.returncode == code, f"exit {done.returncode}: {done.stdout}{done.stderr}")
        told = json.loads(done.stdout)
        return told["signature"], told["anchor"]

    expect((state / "signing.key").stat().st_mode & 0o777 == 0o600, "the key is its owner's alone")
    expect(judged(run_file, 0) == ("good", "match"), "the run as it was closed")
    expect(judged(state / "published" / run_id / Path(run_file).name, 0) == ("good", "match"), "and as published")

    sys.path.insert(0, str(Path(__file__).parent.parent / "cli"))
    import run_files  # the chain a second time, from the page alone

    forged = shutil.copy(run_file, b.folder / "forged.axiscal")
    with closing(sqlite3.connect(forged)) as base, base:
        base.execute("UPDATE point SET reading_m=reading_m+0.000001 WHERE step=3")
        base.execute("DELETE FROM result")
        run_files.chain_anew(base)
    expect(judged(forged, 8) == ("bad", "differs"), "a chain that fits, around another reading")


@sentence("ShareThatIsAwayKeepsTheResultWaiting")
def share_away(b):
    b.begin_run()
    b.finish()
    run_id = b.run()["id"]
    b.share.rmdir()
    events = publish(b, code=1)
    expect([e["event"] for e in events] == ["waiting"], f"{events}")
    expect(b.status()["outbox_entries"] == 1, "the result waits in the outbox")
    b.share.mkdir()
    publish(b)
    expect((b.share / run_id / "certificate.pdf").is_file(), "it is published later")


@sentence("CertificateThatCannotBeWrittenIsToldAndCanBeExportedLater")
def no_room_for_the_certificate(b):
    b.begin_run()
    outbox = b.folder / "state/outbox"
    outbox.rmdir()
    outbox.write_text("no folder")
    b.axiscal("watch", "--until-published", code=1)
    run = b.run()
    expect(run["state"] == "complete" and run["step"] == 20, f"{run}")
    expect(run["certificate"] == "" and "outbox" in run["sentence"], f"{run}")
    b.axiscal("export", run["file"], "--out", b.folder)
    expect(list(b.folder.rglob("certificate.pdf")), "nothing is lost")


def pull_the_cable_at_a_request(b):
    """Until the CNC stands at a target with a request that the station has not heard."""
    lines = Path(b.plan["file"]).read_text().splitlines()

    def standing():
        return lines[b.sim("status")["line"] - 1].startswith("M66")

    for attempt in range(3, 15):
        b.wait_for_points(attempt)
        b.sim(f"connect 127.0.0.1 {bench.free_port()}")
        bench.wait_until("the CNC waits for an answer", standing, 10)
        bench.wait_until("nothing is under way", lambda: b.run()["state"] == "armed", 10)
        if b.sim("status")["requests"] == b.run()["done"] + 1:
            return
        b.plug_the_cable_in()
    raise AssertionError("each request was heard before the cable was out")


@sentence("ManualTriggerIsMarkedOnTheCertificateAndTheCncGoesOn")
def manual(b):
    b.station["capture"]["timeout"] = "20 s"  # the CNC waits for its answer as long
    b.begin_run()
    pull_the_cable_at_a_request(b)
    done = b.run()["done"]
    b.axiscal("trigger")
    bench.wait_until("the point is durable", lambda: b.run()["done"] == done + 1, 10)
    b.plug_the_cable_in()  # its request is the last durable one: done is published again
    certificate = b.finish()
    expect(b.run()["step"] == 20, f"{b.run()}")
    remarks = " ".join(certificate["run"]["remarks"])
    expect(f"1 of 20 points were captured by hand (steps {done + 1})" in remarks, remarks)


if __name__ == "__main__":
    bench.main()
