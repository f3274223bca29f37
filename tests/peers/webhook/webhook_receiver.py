#!/usr/bin/env python3
"""The shipped programs and a receiver that fails: every event arrives, signed, and once by its id."""

import json
import os
import pathlib
import signal
import subprocess
import sys
import time

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "simulation"))
sys.path.append(str(pathlib.Path(__file__).resolve().parent))
import bench
from bench import expect, sentence, wait_until
from receiver import Receiver, take

SECRET = "whsec_MfKQ9r8GKYqrTwjUPD8ILPZIo2LaLaSw"
PATH = "/hook-of-bay-3"  # may be a secret of the receiver: never in a log


def tell(b, place, **more):
    """The station's [webhook]."""
    secret = b.folder / "webhook.secret"
    secret.touch(mode=0o600)
    secret.write_text(SECRET + "\n")
    b.station["webhook"] = {"url": place + PATH, "secret_file": str(secret), **more}


def state(b):
    return pathlib.Path(b.station["station"]["state_directory"])


def waiting(b):
    return sorted(path.stem for path in (state(b) / "events/waiting").glob("*.json"))


def station_alone(b):
    """A station file without a daemon, and one event that waits as a daemon leaves it."""
    (b.folder / "station.toml").write_text(bench.to_toml(b.station))
    folder = state(b) / "events"
    for name in ("waiting", "sent"):
        (folder / name).mkdir(parents=True, exist_ok=True)
    (folder / "waiting/evt_0.json").write_text('{"id":"evt_0","kind":"fault"}')


def send_once(b):
    """One pass; gives back the exit code and what was said."""
    done = subprocess.run([b.program("axiscal-notify"), "--config", b.folder / "station.toml", "--once"],
                          capture_output=True, text=True, timeout=60, check=False)
    expect(PATH not in done.stdout + done.stderr, f"the path is told: {done.stderr}")
    return done.returncode, done.stderr


def start_sender(b):
    return b.spawn("axiscal-notify", "--config", b.folder / "station.toml")


@sentence("ACompleteRunIsToldOnceThroughFailuresAndKills")
def complete(b):
    with Receiver(SECRET, ["500", "500", "hang"]) as receiver:
        tell(b, f"http://127.0.0.1:{receiver.port}", on=["complete"])
        b.begin_run()
        certificate = b.finish()
        run = b.run()
        wait_until("one event waits", lambda: len(waiting(b)) == 1, bench.START_S)
        start_sender(b)
        wait_until("it was tried once", lambda: len(receiver.posts) == 1, bench.START_S)
        b.end("axiscal-notify", signal.SIGKILL)
        b.end("axiscald", signal.SIGKILL)
        b.start_daemon()
        start_sender(b)
        # The third is taken by the receiver, whose answer never comes: the sender cannot know.
        wait_until("it was tried again and taken", lambda: len(receiver.posts) == 3, 60)
        b.end("axiscal-notify", signal.SIGKILL)
        expect(len(waiting(b)) == 1, "what was not answered waits")
        start_sender(b)
        sender = b.processes["axiscal-notify"]
        wait_until("the sender has nothing to do and ends", lambda: sender.poll() is not None, 60)
        expect(sender.returncode == 0 and not waiting(b), f"exit {sender.returncode}, waiting: {waiting(b)}")

        names = {post["headers"]["webhook-id"] for post in receiver.posts}
        expect(len(receiver.posts) == 4 and len(names) == 1, f"{receiver.posts}")
        expect(receiver.forged == 0 and len(receiver.events) == 1, f"taken: {receiver.events}")
        event = receiver.events[0]
        known = {"id": names.pop(), "kind": "complete", "station": "bench", "run": run["id"], "test": "positioning",
                 "certificate": pathlib.Path(run["certificate"]).name}
        expect(event.items() >= known.items(), f"{event}")
        expect(set(event) <= {*known, "when", "verdict"}, f"more than is documented: {set(event)}")
        expect(not any(isinstance(value, float) for value in event.values()), f"a reading left the station: {event}")
        expect(certificate, "the certificate")
    for log in b.logs:
        expect(PATH not in log.read_text(errors="replace"), f"{log} tells the path")


@sentence("AFaultInAnOpenRunIsToldWithItsSentence")
def fault(b):
    with Receiver(SECRET) as receiver:
        tell(b, f"http://127.0.0.1:{receiver.port}", on=["fault"])
        b.begin_run(hold_after=3)
        b.wait_for_points(3)
        b.sim("beam off")
        b.sim("go")
        b.wait_for_refusal("beam_lost")
        folder = state(b) / "events/waiting"
        wait_until("it waits", lambda: any('"beam_lost"' in path.read_text() for path in folder.glob("*.json")), bench.START_S)
        code, said = send_once(b)
        expect(code == 0 and not waiting(b), f"exit {code}: {said}")
        told = [event for event in receiver.events if event["fault"] == "beam_lost"]
        expect(len(told) == 1 and told[0]["run"] == b.run()["id"] and told[0]["sentence"], f"{receiver.events}")
        expect(all(event["kind"] == "fault" for event in receiver.events), f"{receiver.events}")


@sentence("WhateverAReceiverDoesWrongNothingIsLost")
def wrong(b):
    words = ["reset", "garbage", "half", "400", "410", "500", f"away {PATH}-elsewhere"]
    with Receiver(SECRET, words) as receiver:
        tell(b, f"http://127.0.0.1:{receiver.port}")
        station_alone(b)
        for word in words:
            code, said = send_once(b)
            expect(code == 1 and waiting(b) == ["evt_0"], f"{word}: exit {code}: {said}")
        expect([post["answer"] for post in receiver.posts] == words, f"{receiver.posts}")
        expect({post["path"] for post in receiver.posts} == {PATH}, "a redirect was followed")
        receiver.script = ["endless"]
        code, said = send_once(b)
        expect(code == 0 and not waiting(b), f"a long answer: exit {code}: {said}")
        expect([event["id"] for event in receiver.events] == ["evt_0"], f"{receiver.events}")


@sentence("AServerThatNobodyVouchesForGetsNothing")
def encrypted(b):
    names = {"right": "IP:127.0.0.1", "other": "DNS:elsewhere.example"}
    for name, san in names.items():
        subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes",
                        "-keyout", b.folder / f"{name}.key", "-out", b.folder / f"{name}.pem", "-days", "2", "-subj",
                        "/CN=receiver", "-addext", f"subjectAltName={san}"], check=True, capture_output=True, timeout=60)
    files = {name: (b.folder / f"{name}.pem", b.folder / f"{name}.key") for name in names}
    for name, trusted, wanted in (("right", None, 1), ("other", "other", 1), ("right", "other", 1), ("right", "right", 0)):
        with Receiver(SECRET, certificate=files[name]) as receiver:
            more = {"ca_file": str(files[trusted][0])} if trusted else {}
            tell(b, f"https://127.0.0.1:{receiver.port}", **more)
            station_alone(b)
            code, said = send_once(b)
            expect(code == wanted, f"{name}, trusting {trusted}: exit {code}: {said}")
            expect(len(receiver.posts) == 1 - wanted, f"{name}, trusting {trusted}: {receiver.posts}")


@sentence("WhatIsForgedOldOrSeenIsRefusedByTheCodeOfThePage")
def page(b):
    with Receiver(SECRET) as receiver:
        tell(b, f"http://127.0.0.1:{receiver.port}")
        station_alone(b)
        expect(send_once(b)[0] == 0, "delivered")
        post = receiver.posts[0]
    now = int(post["headers"]["webhook-timestamp"])
    # Of names of headers the server keeps what was sent.
    headers, body = {key.lower(): value for key, value in post["headers"].items()}, post["body"]
    expect(take(headers, body, SECRET, set(), now), "what was sent")
    expect(take(headers, body + b" ", SECRET, set(), now) is None, "another body")
    expect(take(headers, body, "whsec_" + "A" * 32, set(), now) is None, "another secret")
    expect(take(headers, body, SECRET, set(), now + 301) is None, "an old one")
    expect(take(headers, body, SECRET, {"evt_0"}, now) is None, "one that was seen")


@sentence("ASecretThatOthersMayReadIsRefusedAndTold")
def secret(b):
    with Receiver(SECRET) as receiver:
        tell(b, f"http://127.0.0.1:{receiver.port}")
        station_alone(b)
        os.chmod(b.station["webhook"]["secret_file"], 0o644)
        code, said = send_once(b)
        expect(code == 3 and "chmod 600" in said and SECRET[6:] not in said, f"exit {code}: {said}")
        expect(not receiver.posts and waiting(b) == ["evt_0"], "it waits, unsent")
        checked = json.loads(b.axiscal("check-config", b.folder / "station.toml", "--json"))
        expect(any("webhook.secret_file" in note for note in checked["notes"]), f"{checked['notes']}")
        os.chmod(b.station["webhook"]["secret_file"], 0o600)
        expect(send_once(b)[0] == 0, "delivered once it is mended")


@sentence("ASecondSenderLeavesTheFirstAlone")
def second(b):
    with Receiver(SECRET, ["hang"]) as receiver:
        tell(b, f"http://127.0.0.1:{receiver.port}")
        station_alone(b)
        start_sender(b)
        wait_until("the first one sends", lambda: receiver.posts, bench.START_S)
        code, said = send_once(b)
        expect(code == 3 and "another axiscal-notify" in said and len(receiver.posts) == 1, f"exit {code}: {said}")
        began = time.monotonic()
        b.processes["axiscal-notify"].send_signal(signal.SIGTERM)
        expect(b.processes.pop("axiscal-notify").wait(timeout=40) == 0, "an end when asked")
        expect(time.monotonic() - began < 30, "an attempt is bounded")


if __name__ == "__main__":
    bench.main()
