#!/usr/bin/python3
"""A share that is frozen while an axis is measured: samba_capture.py PROGRAM-FOLDER SENTENCE

Whole programs: simulated machine, axiscald, axiscal-publish, smbd. What this computer cannot do is a failure unless
AXISCAL_MAY_SKIP names samba (then exit 77).
"""
import json
import os
import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "simulation")]
import bench
import samba_server
from samba_server import Samba, Skip, expect, wait_until

sentences = {}


def sentence(name):
    def register(function):
        sentences[name] = function
        return function
    return register


def expect_age(text, place, youngest_s, eldest_s):
    """`axiscal status` tells how long the oldest of two waits, rounded to its unit; asked between these two ages."""
    found = re.search(r"^Outbox       2 waiting, the oldest since (\d+) (s|min|h), to (.+)$", text, re.M)
    expect(found and found[3] == place, text)
    unit_s = {"s": 1, "min": 60, "h": 3600}[found[2]]
    told_s = int(found[1]) * unit_s
    expect(youngest_s - unit_s / 2 <= told_s <= eldest_s + unit_s / 2, f"{youngest_s} s to {eldest_s} s old: {text}")


@sentence("AFrozenShareDelaysNoCapture")
def frozen(b, samba):
    account = b.folder / "account"
    account.write_text(f"username={samba_server.USER}\npassword={samba_server.PASSWORD}\n")
    account.chmod(0o600)
    b.station["publish"] = {"destination": samba.url, "credentials": str(account), "timeout": "1 s", "retry": "100 ms",
                            "alarm_age": "1 s"}
    b.begin_run()
    samba.freeze()
    b.spawn("axiscal-publish", "--config", b.folder / "station.toml")
    outbox = b.folder / "state/outbox"
    stuck = outbox / "stuck"
    stuck.mkdir()
    (stuck / "certificate.json").write_text("{}")

    def told():
        return b.status()["outbox"]["publisher"]["reason"]
    wait_until("the publisher meets the frozen server", lambda: "does not answer in time" in told())
    before = b.run()["step"]
    certificate = b.finish()
    run = b.run()
    expect(before < run["steps"], "the run had ended before the share froze")
    expect(run["step"] == run["steps"] == 20 and run["sentence"] == "", f"{run}")
    expect(len(certificate["positions"]) == 5, "the certificate is whole")

    status = json.loads(b.axiscal("status", "--json"))
    shown = status["outbox"]
    expect(shown["waiting"] == 2 and shown["publisher"]["runs"] and shown["publisher"]["destination"] == samba.url, f"{shown}")
    expect("2 results wait" in shown["alarm"] and "does not answer in time" in shown["alarm"], f"{shown}")
    text = b.axiscal("status")
    expect("ALARM: 2 results wait" in text, text)
    expect_age(text, samba.url, shown["oldest_s"], b.status()["outbox"]["oldest_s"])
    wait_until("the alarm stands in the notes", lambda: any("Alarm: " in note for note in b.status()["notes"]))
    mapped = Path(f"/proc/{b.processes['axiscald'].pid}/maps").read_text()
    expect("smbclient" not in mapped, "axiscald has libsmbclient in its memory")

    samba.thaw()
    wait_until("the queue empties", lambda: b.status()["outbox"]["waiting"] == 0)
    expect((samba.share / run["id"] / "certificate.pdf").is_file(), "the certificate is on the share")
    wait_until("the alarm is over", lambda: any("takes results again" in note for note in b.status()["notes"]))
    expect(b.status()["outbox"]["alarm"] == "", "no alarm is left")


@sentence("AQueueWithoutAPublisherIsAnAlarm")
def no_publisher(b, samba):
    b.station["publish"] = {"destination": samba.url, "alarm_count": 1}
    b.start()
    (b.folder / "state/outbox/left").mkdir()
    shown = wait_until("the result is counted", lambda: b.status()["outbox"] if b.status()["outbox"]["waiting"] else None)
    expect("1 result waits" in shown["alarm"] and "axiscal-publish does not run" in shown["alarm"], f"{shown}")
    expect("PUBLISHER NOT RUNNING" in b.axiscal("status"), "the command line says it")


def main():
    name = sys.argv[2]
    try:
        samba_server.require()
        with bench.Bench() as b:
            b.folder.chmod(0o755)
            b.share.rmdir()
            samba = Samba(b.folder)
            try:
                samba.start()
                sentences[name](b, samba)
            finally:
                if samba.process:
                    samba.thaw()
                samba.kill()
    except Skip as missing:
        print(f"cannot run here: {missing}")
        return 77 if "samba" in os.environ.get("AXISCAL_MAY_SKIP", "").split(",") else 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
