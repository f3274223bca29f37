"""Power cuts. The station's state lies on a disk that forgets what was not flushed (lossy_disk.py); one
run is recorded write by write, with each acknowledge that the CNC got standing among the writes. Then the
disk is put together as cuts at random moments would have left it, mounted by the kernel, and looked at.

    AXISCAL_CUTS  so many cuts;  AXISCAL_SEED  which ones
"""

import contextlib
import json
import mmap
import os
import socket
import sqlite3
import struct
import sys
import threading
from pathlib import Path

from guest import SHARE, SOURCE, check, expect, load_modules, run, run_checks, wait_until

sys.path.insert(0, str(SOURCE / "tests/simulation"))
import bench  # noqa: E402  (the bench of the whole-run tests, here with its state on another disk)

CUTS = int(os.environ.get("AXISCAL_CUTS", "10"))
STATE = Path("/mnt/state")
POINTS = 20
ANOTHER_BOOT = "The datum is lost: the computer was restarted since."
DISK, NOTES, AFTER = "/dev/vda", "/dev/vdb", "/dev/vdc"
NOTE, ORDER, ANSWER, ANSWER_BYTES = 0, 4096, 8192, 4096  # as lossy_disk.py has them
READ_REGISTERS, ACK_SEQ = 3, 18  # docs/trigger.md, sequence-block


class Notes:
    """The door to the host's record: a write here stands among those of the other disk."""

    def __init__(self):
        self.file = os.open(NOTES, os.O_RDWR | os.O_DIRECT)
        self.page = mmap.mmap(-1, ANSWER_BYTES)  # O_DIRECT wants whole pages

    def put(self, at, text):
        self.page[:] = text.encode().ljust(ANSWER_BYTES, b"\0")
        os.pwritev(self.file, [memoryview(self.page)[:512]], at)

    def order(self, text):
        self.put(ORDER, text)
        os.preadv(self.file, [self.page], ANSWER)
        return json.loads(self.page[:].split(b"\0")[0])


class Wire:
    """Between the CNC and the station: whatever the station acknowledges is on record before the CNC
    reads it."""

    def __init__(self, notes, station_port):
        self.notes, self.station_port, self.done = notes, station_port, None
        self.door = socket.create_server(("127.0.0.1", 0))
        self.port = self.door.getsockname()[1]
        threading.Thread(target=self.welcome, daemon=True).start()

    def welcome(self):
        while True:
            cnc, _ = self.door.accept()
            threading.Thread(target=self.carry, args=(cnc,), daemon=True).start()

    def carry(self, cnc):
        try:
            with cnc, wait_until("the station listens", self.reach_station, 120) as station:
                for wire in (cnc, station):
                    wire.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                while True:
                    request = self.frame(cnc)
                    station.sendall(request)
                    reply = self.frame(station)
                    self.look(request, reply)
                    cnc.sendall(reply)
        except (OSError, AssertionError):
            return  # one of them is gone; the CNC connects anew

    def reach_station(self):
        with contextlib.suppress(ConnectionRefusedError):
            return socket.create_connection(("127.0.0.1", self.station_port))

    @staticmethod
    def frame(wire):
        """One Modbus TCP frame: six bytes, of which the last two say how many follow."""
        data = b""
        while len(data) < 6 or len(data) < 6 + struct.unpack(">H", data[4:6])[0]:
            piece = wire.recv(6 - len(data) if len(data) < 6 else 6 + struct.unpack(">H", data[4:6])[0] - len(data))
            if not piece:
                raise ConnectionError
            data += piece
        return data

    def look(self, request, reply):
        if request[7] != READ_REGISTERS or reply[7] != READ_REGISTERS:
            return
        first, count = struct.unpack(">HH", request[8:12])
        if not first <= ACK_SEQ < first + count:
            return
        at = 9 + 2 * (ACK_SEQ - first)
        done = struct.unpack(">H", reply[at : at + 2])[0]
        if 0 < done <= POINTS and done != self.done:
            self.notes.put(NOTE, f"done {done}")
            self.done = done


class LossyStation(bench.Bench):
    """A short run, its state on the disk under test, its CNC behind the wire."""

    def __init__(self):
        super().__init__()
        self.notes = Notes()
        self.station["station"]["state_directory"] = str(STATE)
        self.station["capture"]["timeout"] = "15 s"
        self.wire = Wire(self.notes, self.station["trigger"]["port"])
        self.scenario["cnc"]["port"] = self.wire.port
        self.rows = {}  # of the whole run: {sequence: (step, link, hash)}

    def mount(self, disk):
        STATE.mkdir(parents=True, exist_ok=True)
        run("mount", "-t", "ext4", disk, STATE)

    def unmount(self):
        run("umount", STATE)

    def run_files(self):
        return sorted((STATE / "runs").glob("*.axiscal"))

    def verified(self, path):
        told = json.loads(self.axiscal("verify", path, "--json"))
        expect(told["intact"], f"{told}")
        return told

    def log_file(self, name):
        """On the host from the first line on."""
        return SHARE / f"{name}.{len(list(SHARE.glob('*.*.log')))}.log"

    def __exit__(self, kind, error, trace):
        for process in self.processes.values():
            process.kill()
            process.wait()


def rows_of(path):
    base = sqlite3.connect(path)
    try:
        return {sequence: rest for sequence, *rest in base.execute("SELECT sequence, step, link, hash FROM point")}
    finally:
        base.close()


@check("RunIsRecordedWriteByWrite")
def recorded(station):
    station.mount(DISK)
    station.notes.put(NOTE, "done none")
    station.begin_run()
    station.finish()
    station.end("axiscald")
    (path,) = station.run_files()
    told = station.verified(path)
    station.rows = rows_of(path)
    expect(told["complete"] and sorted(station.rows) == list(range(1, POINTS + 1)), f"{told}, {sorted(station.rows)}")
    expect(station.wire.done == POINTS, f"the wire saw {station.wire.done} acknowledged")
    station.unmount()


def look_at(station, told):
    """After a cut: the file system mounts, every run file is whole, what was acknowledged is there with
    the bits of the undisturbed run. @returns points found"""
    done = told["done"] or 0
    station.mount(AFTER)
    try:
        found = {}
        for path in station.run_files():
            station.verified(path)
            found.update(rows_of(path))
        for entry in STATE.glob("outbox/[!.]*"):  # has its name: it is whole
            json.loads((entry / "certificate.json").read_text())
    finally:
        station.unmount()
    lost = [number for number in range(1, done + 1) if number not in found]
    expect(not lost, f"acknowledged and lost: {lost}; {told}")
    changed = [number for number, row in found.items() if row != station.rows[number]]
    expect(not changed, f"not the points that were taken: {changed}; {told}")
    return len(found)


@check("PowerLostAtAnyMomentLosesNoAcknowledgedPoint")
def cut(station):
    ways = {"lost": 0, "torn": 0, "points": 0}
    for number in range(CUTS):
        told = station.notes.order(f"cut {number}")
        try:
            found = look_at(station, told)
        except AssertionError:
            print(f"cut {number}: {told}", run("dmesg")[-2000:])
            raise
        print(f"{told}: {found} points")
        for way in ("lost", "torn"):
            ways[way] += told[way]
        ways["points"] += told["done"] or 0
    print(f"{CUTS} cuts, {ways['lost']} writes lost, {ways['torn']} torn, {ways['points']} acknowledged points, all there")
    expect(ways["lost"] + ways["torn"] > 0, "no cut lost anything: nothing was shown")


@check("DiskThatLiesAboutItsFlushIsFoundOut")
def lie(station):
    """That the check above can fail: a flush that did nothing costs the last acknowledged point."""
    for number in (5, 11, POINTS - 2):
        told = station.notes.order(f"lie {number}")
        try:
            look_at(station, told)
        except AssertionError as found_out:
            expect(f"acknowledged and lost: [{number}]" in str(found_out), f"{found_out}")
            continue
        raise AssertionError(f"the point {number} was lost and nobody saw it: {told}")


@check("DaemonAfterAPowerCutClosesTheRunWithItsReason")
def again(station):
    """The computer was switched on again: another boot, so the laser's zero is not known any more."""
    boot = Path("/run/boot_id")
    boot.write_text("00000000-0000-4000-8000-00000000abcd\n")
    run("mount", "--bind", boot, "/proc/sys/kernel/random/boot_id")
    told = station.notes.order("lie 11")  # in mid-run for certain; ten points are there
    print(told)
    station.mount(AFTER)
    station.start_daemon()
    bench.wait_until("the run of before is closed",
                     lambda: any("closed as incomplete" in note for note in station.status()["notes"]), 60)
    notes = station.status()["notes"]
    print(notes)
    station.end("axiscald")
    (path,) = station.run_files()
    expect(any(note.endswith(f"is closed as incomplete: {ANOTHER_BOOT}") for note in notes), f"{notes}")
    with contextlib.closing(sqlite3.connect(f"file:{path}?immutable=1", uri=True)) as file:
        told = file.execute("SELECT complete, reason FROM closing").fetchall()
    expect(told == [(0, ANOTHER_BOOT)], f"the file says {told}")
    expect(not station.verified(path)["complete"], "an interrupted run calls itself complete")
    expect(sorted(rows_of(path)) == list(range(1, 11)), f"{sorted(rows_of(path))}")
    station.unmount()


def main():
    load_modules("virtio_blk", "ext4")
    with LossyStation() as station:
        return run_checks(station)


sys.exit(main())
