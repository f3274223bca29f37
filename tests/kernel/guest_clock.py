"""The guest's clock of the day, set to and fro while a run is made, and what the run may not show of it.

CLOCK_MONOTONIC goes on through all of it. Both clocks are read once, before anything is set: UTC at any moment is then
known from the monotonic clock alone, without a look at what the station wrote."""

import contextlib
import csv
import ctypes
import datetime
import os
import sqlite3
import sys
import time
from pathlib import Path

from guest import expect, run, wait_until

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import run_file_window

SECOND_NS = 1_000_000_000
DAY_NS = 86_400 * SECOND_NS
HOUR_S = 3600.0
ZONE, ZONE_OFFSET = "Pacific/Kiritimati", "+1400"  # another date than UTC for most of the day
ADJ_STATUS, STA_INS, STA_UNSYNC = 0x0010, 0x0010, 0x0040  # adjtimex(2)
WRITTEN_S = 1.0  # papers tell whole seconds
TIED_S = 0.5  # two readings of both clocks agree by far better; a leap is one second


class Timex(ctypes.Structure):
    """The head of struct timex, and room for the rest of it."""

    _fields_ = [("modes", ctypes.c_uint), ("offset", ctypes.c_long), ("freq", ctypes.c_long), ("maxerror", ctypes.c_long),
                ("esterror", ctypes.c_long), ("status", ctypes.c_int), ("rest", ctypes.c_long * 32)]


def tell_kernel(status):
    order = Timex(modes=ADJ_STATUS, status=status)
    done = ctypes.CDLL(None, use_errno=True).adjtimex(ctypes.byref(order))
    expect(done >= 0, f"adjtimex: {os.strerror(ctypes.get_errno())}")


class GuestClock:
    def __init__(self):
        before, utc, after = time.monotonic_ns(), time.time_ns(), time.monotonic_ns()
        self.utc_at_zero_ns = utc - (before + after) // 2

    def utc_ns(self, monotonic_ns):
        """What a clock that nobody sets tells at that moment."""
        return self.utc_at_zero_ns + monotonic_ns

    def ahead_s(self):
        return (time.time_ns() - self.utc_ns(time.monotonic_ns())) / SECOND_NS

    def put_ahead(self, by_s):
        time.clock_settime_ns(time.CLOCK_REALTIME, self.utc_ns(time.monotonic_ns()) + round(by_s * SECOND_NS))
        expect(abs(self.ahead_s() - by_s) < TIED_S, f"the clock is {self.ahead_s():.3f} s ahead, not {by_s:.3f} s")

    def an_hour_forward(self):
        self.put_ahead(HOUR_S)

    def an_hour_back(self):
        self.put_ahead(-HOUR_S)

    def through_a_leap_second(self):
        """To 3 s before a midnight of UTC whose last minute the kernel is told to make 61 s long."""
        now_ns = self.utc_ns(time.monotonic_ns())
        ahead_s = ((now_ns // DAY_NS + 1) * DAY_NS - now_ns) / SECOND_NS - 3
        self.put_ahead(ahead_s)
        tell_kernel(STA_INS)
        wait_until("the kernel inserts the leap second", lambda: self.ahead_s() < ahead_s - TIED_S)
        stepped_s = self.ahead_s() - ahead_s
        expect(abs(stepped_s + 1) < TIED_S, f"a leap second puts the clock back by 1 s, not by {-stepped_s:.3f} s")
        tell_kernel(STA_UNSYNC)

    def back(self):
        self.put_ahead(0)

    @staticmethod
    def to_another_zone():
        """For whatever asks /etc/localtime: the station's unit has no TZ. It stays until the guest's end."""
        beside = Path("/etc/localtime.new")
        beside.symlink_to(Path("/usr/share/zoneinfo") / ZONE)
        beside.replace("/etc/localtime")
        told = run("env", "-u", "TZ", "date", "+%z").strip()
        expect(told == ZONE_OFFSET, f"programs see the zone {told}")

    @contextlib.contextmanager
    def right_at_the_end(self):
        try:
            yield
        finally:
            tell_kernel(STA_UNSYNC)
            self.back()


def read_run(file):
    """(opened, closed, points): two clock ties as (monotonic, UTC), and the points in their order. ns."""
    with contextlib.closing(sqlite3.connect(f"file:{file}?mode=ro", uri=True)) as base:
        base.row_factory = sqlite3.Row
        opened = base.execute("SELECT (opened_before_ns + opened_after_ns) / 2, opened_utc_ns FROM run").fetchall()
        closed = base.execute("SELECT (closed_before_ns + closed_after_ns) / 2, closed_utc_ns FROM closing").fetchall()
        points = base.execute("SELECT step, triggered_ns, window_begin_ns, window_end_ns, samples FROM point"
                              " ORDER BY link").fetchall()
    expect((len(opened), len(closed)) == (1, 1), f"{file} was opened {len(opened)} and closed {len(closed)} times")
    return tuple(opened[0]), tuple(closed[0]), points


def judge_samples(points):
    """No sample is missing in a window, and none stands before an earlier one of the run."""
    last_ns = 0
    for point in points:
        samples = run_file_window.unpacked(point["samples"])
        numbers = [number for _, _, number in samples]
        expect(samples, f"step {point['step']} has no samples")
        whole = list(range(numbers[0], numbers[0] + len(numbers)))
        expect(numbers == whole, f"step {point['step']} misses samples: {numbers}")
        for at_ns, _, _ in samples:
            expect(at_ns > last_ns, f"step {point['step']}: a sample at {at_ns} ns, after one at {last_ns} ns")
            last_ns = at_ns


def judge_points(points, taken):
    """`taken`: of some steps the monotonic times between which they were asked for and became durable."""
    by_step = {point["step"]: point for point in points}
    for step, (began_ns, ended_ns) in taken.items():
        times_ns = [by_step[step][name] for name in ("triggered_ns", "window_begin_ns", "window_end_ns")]
        within = all(began_ns <= at_ns <= ended_ns for at_ns in times_ns)
        expect(within, f"step {step} was taken between {began_ns} and {ended_ns} ns; its file says {times_ns}")


def judge_ties(clock, opened, closed, closed_ahead_s):
    """The file keeps what the clock said: right at the opening, so much ahead of UTC at the closing."""
    for name, (monotonic_ns, utc_ns), ahead_s in (("opened", opened, 0), ("closed", closed, closed_ahead_s)):
        off_s = (utc_ns - clock.utc_ns(monotonic_ns)) / SECOND_NS
        expect(abs(off_s - ahead_s) < TIED_S, f"the run was {name} {off_s:.3f} s beside UTC by its clock tie, not {ahead_s} s")


def utc_ns_of(written):
    expect(written.endswith("Z"), f"{written} is no UTC")
    return round(datetime.datetime.fromisoformat(written).timestamp()) * SECOND_NS


def judge_papers(clock, opened, closed, points, certificate, table):
    """The UTC of each moment on paper against the monotonic time of the file, by the clock of the test."""
    told = certificate["run"]
    pairs = [("started", told["started"], opened[0]), ("finished", told["finished"], closed[0])]
    head, *rows = csv.reader(line for line in table.splitlines() if not line.startswith("#"))
    expect(len(rows) == len(points), f"{len(rows)} rows on paper, {len(points)} points in the file")
    for row, point in zip(rows, points):
        middle_ns = (point["window_begin_ns"] + point["window_end_ns"]) // 2
        pairs.append((f"step {point['step']}", row[head.index("time")], middle_ns))
    for name, written, monotonic_ns in pairs:
        off_s = (utc_ns_of(written) - clock.utc_ns(monotonic_ns)) / SECOND_NS
        expect(-WRITTEN_S - TIED_S < off_s < TIED_S, f"{name} is told as {written}, {off_s:.3f} s beside UTC")
    events = [event["time"] for event in told["events"]]
    within = all(told["started"] <= at <= told["finished"] for at in events)
    expect(within, f"events at {events} in a run from {told['started']} to {told['finished']}")
