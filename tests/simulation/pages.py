"""The page at the machine is a guest: twenty that listen change no capture, and five hundred at once, well-behaved or not, are
turned away in words while the run goes on."""

import asyncio
import collections
import contextlib
import json
import re
import socket
import sqlite3
import sys
import threading
import time

import bench
from abuse import open_files
from bench import SOURCE, expect, sentence
from unread_log import LOSSES

sys.path.insert(0, str(SOURCE / "tests/support"))
from run_file_window import unpacked  # noqa: E402

PAGES = 20
PLACES = 32  # of GET /v1/events
SEATS = 64  # of the TCP door, beside them
LASER_RATE_HZ = 1000.0
SILENT = 2 / 20  # of a window: so long the laser may be silent in it (twice the mean spacing of capture.minimum_samples)
ODD_IDS = ["x", "-", "ffffffffffffffffffff-1-1", "1-2-" + "9" * 4000, "18c2f0a5b1d3e000-2-17"]  # none of them was ever given


def with_page(b):
    b.station["console"]["port"] = bench.free_port()
    return b.station["console"]["port"]


def request(path, fields="", method="GET", body=""):
    length = f"Content-Length: {len(body)}\r\n" if method == "POST" else ""
    return f"{method} {path} HTTP/1.1\r\nHost: localhost\r\n{fields}{length}\r\n{body}".encode("latin-1")


# --- twenty pages ------------------------------------------------------------------------------


class Pages(threading.Thread):
    """So many readers of the events, in one loop beside the test."""

    def __init__(self, port, many):
        super().__init__(daemon=True)
        self.port = port
        self.heard = [collections.Counter() for _ in range(many)]  # events of each topic
        self.points = [{} for _ in range(many)]  # run: how many of its points are known
        self.loop = asyncio.new_event_loop()

    def run(self):
        with contextlib.suppress(asyncio.CancelledError):
            self.loop.run_until_complete(self.all())

    async def all(self):
        self.task = asyncio.current_task()
        await asyncio.gather(*(self.read(nth) for nth in range(len(self.heard))))

    async def read(self, nth):
        reader, writer = await asyncio.open_connection("127.0.0.1", self.port, limit=1 << 22)
        with contextlib.closing(writer):
            writer.write(request("/v1/events?stream=200"))
            topic = (await reader.readuntil(b"\r\n\r\n")).split(b"\r\n")[0].decode()  # until there is one
            while line := await reader.readline():
                name, _, value = line.decode().rstrip("\n").partition(": ")
                topic = value if name == "event" else topic
                if name == "data":
                    self.take(nth, topic, value)

    def take(self, nth, topic, data):
        self.heard[nth][topic] += 1
        if topic == "points":
            told = json.loads(data)
            self.points[nth][told["run"]] = told["count"]

    def all_hear(self, *topics):
        return all(one[topic] > 0 for one in self.heard for topic in topics)

    def all_know(self, run, count):
        return all(one.get(run) == count for one in self.points)

    def __enter__(self):
        self.start()
        return self

    def __exit__(self, *_):
        self.loop.call_soon_threadsafe(self.task.cancel)
        self.join()


def captures_of(file):
    """What of each point does not go by chance: its place in the plan, and the length of its window (ns). Each window is whole: as many
    samples as the laser makes, one behind the other by the laser's own numbers. The simulated laser shares this computer, and what it sends
    late is missing at an end of the window: by no more than the station allows."""
    with contextlib.closing(sqlite3.connect(f"file:{file}?mode=ro", uri=True)) as base:
        rows = base.execute("SELECT step, planned_step, target_index, direction, approach, window_end_ns - window_begin_ns, n, samples "
                            "FROM point ORDER BY step").fetchall()
    for step, *_, length_ns, n, samples in rows:
        numbers = [number for _, _, number in unpacked(samples)]
        expect(len(numbers) == n and numbers == list(range(numbers[0], numbers[0] + n)), f"step {step}: samples {numbers}")
        due = length_ns * 1e-9 * LASER_RATE_HZ
        expect(abs(n - due) <= 2 + SILENT * due, f"step {step}: {n} samples in {length_ns} ns")
    return [row[:6] for row in rows]


def faults_counted(b):
    """What counts up when a sample is lost, or when the CNC was not answered as it wished."""
    laser, trigger = b.instrument("laser"), b.status()["trigger"]
    return {**{key: laser[key] for key in LOSSES}, **{key: trigger[key] for key in ("exceptions", "refused", "hung_up")}}


@sentence("TwentyPagesBesideARunChangeNoCapture")
def twenty(b):
    port = with_page(b)
    b.begin_run()
    b.finish()
    alone, counted = captures_of(b.run()["file"]), faults_counted(b)
    expect(len(alone) == b.run()["steps"] == 20, f"{alone}")
    b.go_to_datum()
    with Pages(port, PAGES) as pages:
        bench.wait_until("every page is served", lambda: pages.all_hear("status", "points", "stream", "heartbeat"), 30)
        b.arm()
        certificate = b.finish()
        run = b.run()
        bench.wait_until("every page knows every point", lambda: pages.all_know(run["id"], 20), 30)
        heard = [sum(one.values()) for one in pages.heard]
    expect(captures_of(run["file"]) == alone, f"beside pages: {captures_of(run['file'])}\nalone: {alone}")
    expect(faults_counted(b) == counted, f"beside pages: {faults_counted(b)}; alone: {counted}")
    expect(certificate["completeness"]["status"] == "complete", f"{certificate['completeness']}")
    print(f"{PAGES} pages heard {min(heard)} to {max(heard)} events each beside a run of {len(alone)} points: nothing lost, {counted}")


# --- five hundred ------------------------------------------------------------------------------


def blunders(port):
    """kind: (how many at once, what each says, whether it reads, what it may be answered)."""
    own, foreign = f"Origin: http://localhost:{port}\r\n", "Origin: http://elsewhere.example\r\n"
    events = "/v1/events?stream=200"
    said = {
        "page": (300, request("/") + request(events), True, {"200", "503"}),
        "deaf": (20, request("/v1/events?stream=4096"), False, set()),
        "half": (20, b"GET /v1/events HT", True, set()),
        "wrong cookie": (60, request("/v1/run/abort", own + "Cookie: axiscal_session=" + "0" * 64 + "\r\n", "POST", "{}"), True, {"401"}),
        "foreign page": (40, request("/v1/run/abort", foreign, "POST", "{}") + request(events, foreign), True, {"403"}),
    }
    said["no id"] = (10, request(events, "Last-Event-ID: \x01\xff\xfe\r\n"), True, {"400"})
    return said | {f"odd id {nth}": (10, request(events, f"Last-Event-ID: {one}\r\n"), True, {"200", "503"}) for nth, one in enumerate(ODD_IDS)}


class Visitor:
    """One connection at a time. It comes again when it was answered or hung up on, as a page does."""

    AGAIN_S, KEPT = 0.2, 1 << 16

    def __init__(self, port, kind, says, reads):
        self.port, self.kind, self.says, self.reads = port, kind, says, reads
        self.wire, self.got, self.next_at = None, b"", 0.0
        self.answers = collections.Counter()

    def turn(self, now):
        if now < self.next_at:
            return
        if self.wire is None:
            self.wire = socket.socket()
            self.wire.setblocking(False)
            self.wire.connect_ex(("127.0.0.1", self.port))
            self.owed, self.got = self.says, b""
        try:
            self.owed = self.owed[self.wire.send(self.owed):] if self.owed else b""
            gone = self.reads and not self.take()
        except BlockingIOError:
            return  # nothing there yet, or the door has no hand free
        except OSError:
            gone = True
        if gone:
            self.leave(now + self.AGAIN_S)

    def take(self):
        """False when that was all: hung up on, or refused."""
        data = self.wire.recv(1 << 16)
        if len(self.got) < self.KEPT:
            self.got += data
        return bool(data) and not re.search(rb"^HTTP/1\.1 [45]", self.got, re.M)

    def leave(self, next_at=0.0):
        self.answers.update(code.decode() for code in re.findall(rb"^HTTP/1\.1 (\d{3})", self.got, re.M))
        if self.wire is not None:
            self.wire.close()
        self.wire, self.got, self.next_at = None, b"", next_at


def listening(port, path="/v1/events", fields="", until=""):
    """A client of the events, and the head and the begun body of what it was answered; the body has `until` in it."""
    wire = socket.create_connection(("127.0.0.1", port), timeout=10)
    wire.sendall(request(path, fields))
    got = ""
    while "\r\n\r\n" not in got or until not in got.split("\r\n\r\n", 1)[1]:
        data = wire.recv(1 << 16)
        expect(data, f"hung up after {got}")
        got += data.decode()
    return wire, *got.split("\r\n\r\n", 1)


def take_every_place(port, points):
    """Some with an id that the station never gave: they get all points. Nobody reads on from now: the daemon must wait for none of them."""
    wires = []
    for nth in range(PLACES):
        field = f"Last-Event-ID: {ODD_IDS[nth % len(ODD_IDS)]}\r\n"
        wire, head, body = listening(port, "/v1/events?stream=4096", field, until='"targets":')
        wires.append(wire)
        told = re.search(r'^event: points$.*?^data: \{"run":"[^"]+","count":(\d+),"from":(\d+),', body, re.M | re.S)
        expect(head.startswith("HTTP/1.1 200") and told and told.groups() == (str(points), "0"), f"{field}: {head}, {body[:2000]}")
    wire, head, body = listening(port, until="}}")
    wire.close()
    expect(head.startswith("HTTP/1.1 503"), head)
    told = json.loads(body)["error"]
    expect(told["fault"] == "busy" and "places of GET /v1/events are taken" in told["sentence"], f"{told}")
    return wires


def turn_until_complete(b, crowd):
    """The technician asks once a turn, and is answered. Gives back the most descriptors that the daemon had."""
    pid, most = b.processes["axiscald"].pid, 0
    while b.run()["state"] != "complete" or not all(one.answers or not one.reads or one.kind == "half" for one in one_of_each(crowd)):
        expect(b.run()["sentence"] == "", b.run()["sentence"])
        for one in crowd:
            one.turn(time.monotonic())
        most = max(most, open_files(pid))
    return most


def one_of_each(crowd):
    """Of each kind the one that was answered most."""
    kinds = {one.kind for one in crowd}
    return [max((one for one in crowd if one.kind == kind), key=lambda one: sum(one.answers.values())) for kind in kinds]


@sentence("FiveHundredPagesAtOnceAreTurnedAwayInWordsAndTheRunGoesOn")
def five_hundred(b):
    port = with_page(b)
    b.begin_run(hold_after=3)
    b.wait_for_points(3)
    before = open_files(b.processes["axiscald"].pid)
    places = take_every_place(port, 3)
    kinds = blunders(port)
    crowd = [Visitor(port, kind, says, reads) for kind, (many, says, reads, _) in kinds.items() for _ in range(many)]
    expect(len(crowd) == 500, f"{len(crowd)} in the crowd")
    b.sim("go")
    most = turn_until_complete(b, crowd)
    for one in crowd:
        one.leave()
    for wire in places:
        wire.close()
    expect(most <= before + PLACES + SEATS + 2, f"{most} descriptors, {before} before")  # the technician, and who is turned away
    bench.wait_until("the crowd is gone", lambda: open_files(b.processes["axiscald"].pid) <= before, 40)
    answers = {kind: sum((one.answers for one in crowd if one.kind == kind), collections.Counter()) for kind in kinds}
    for kind, (_, _, _, may) in kinds.items():
        expect(set(answers[kind]) <= may, f"{kind}: {answers[kind]}")
    expect(answers["page"]["503"] > 0, f"nobody was turned away in words: {answers}")
    certificate = b.finish()
    expect(b.run()["step"] == b.run()["steps"] == 20 and len(certificate["positions"]) == 5, f"{b.run()}")
    print(f"{ {kind: dict(counted) for kind, counted in answers.items()} }; {most} descriptors at most, {before} before and after")


if __name__ == "__main__":
    bench.main()
