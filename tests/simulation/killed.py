"""kill -9 before every single write step of a run: nothing acknowledged is lost, nothing is doubled,
and the result has the same bits as that of a run which nobody disturbed.

A step is told by what it does and to which file, and by its number among its like: a slower run writes a
page of its log more, and with one number for all of them the steps after it would be missed.

A run that was not killed proves nothing: it is done again with an earlier step, and is no pass.

    AXISCAL_ALL=1      every step, and every step of a recovery; else every tenth, and a seeded sample
    AXISCAL_ABREAST=N  so many stations at a time (8)
"""

import collections
import concurrent.futures
import ctypes
import json
import os
import random
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time

import bench
from bench import expect, sentence
from steps import Steps, label_of

POINTS = 30
UNREACHED = "nothing was killed"
TRIES = 3  # a faster run may have fewer page writes than the undisturbed one
SEED = 20261124
PATIENCE_S = 100.0
RUN_S = 200


def quiet(b):
    """A machine that shows the same number whenever one looks: bits can be compared. Short ways."""
    errors, air, thermal = b.scenario["errors"], b.scenario["air"], b.scenario["thermal"]
    for key in ("approach_noise_um", "noise_um", "vibration_um", "drift_um_per_hour"):
        errors[key] = 0.0
    air["temperature"] = {"start": 23.4}
    air["pressure_pa"] = {"start": 100250.0}
    air["humidity_percent"] = {"start": 46.0}
    thermal["material"] = {"start": 23.0}
    b.station["axis"]["travel_high"] = "65 mm"
    b.station["cycle"].update(interval="12 mm", target_count=5, first_target="7 mm", approaches=3)
    b.hurry(0.1)
    b.station["capture"]["window"] = "0.05 s"
    b.station["capture"]["timeout"] = "15 s"  # the CNC holds while the daemon is away


class Station:
    """One run from the datum to the certificate; a daemon that dies is started again. `again`: it dies before so
    many steps, of whatever kind, once more; 0: it does not."""

    def __init__(self, b, label, nth, tear, again=0):
        quiet(b)
        self.b, self.steps, self.again = b, Steps(b), again
        self.steps.kill_before(label, nth, tear)
        self.deaths = self.died_at = self.recovery = 0
        self.runs = b.folder / "state" / "runs"
        self.seen = None  # what the CNC had seen done, and what was on disk, when the daemon died
        self.armed_before = False

    def died(self):
        return self.b.processes["axiscald"].poll() is not None

    def look_at_the_dead(self):
        code = self.b.processes.pop("axiscald").wait()
        expect(code == -signal.SIGKILL, f"axiscald ended with {code}")
        self.deaths += 1
        expect(self.deaths <= (2 if self.again else 1), f"it died {self.deaths} times")
        before, self.seen = self.seen, {"done": self.b.sim("status")["done"], "rows": self.rows_on_disk()}
        for name, rows in before["rows"].items() if before else []:
            kept = self.seen["rows"].get(name, {})
            expect(all(kept.get(sequence) == row for sequence, row in rows.items()), f"{rows} became {kept}")
        self.died_at = self.steps["count"]
        self.steps.kill_before("", self.again if self.deaths == 1 else 0, 0)
        self.steps["first_program"] = 0

    def rows_on_disk(self):
        """{file: {sequence: (step, link, hash)}}, read from a copy: looking must not mend anything."""
        rows = {}
        with tempfile.TemporaryDirectory() as copy:
            for path in self.runs.glob("*.axiscal*") if self.runs.exists() else []:
                shutil.copy(path, copy)
            for name in sorted(os.listdir(copy)):
                if not name.endswith(".axiscal"):
                    continue
                base = sqlite3.connect(os.path.join(copy, name))
                rows[name] = {
                    sequence: rest
                    for sequence, *rest in base.execute("SELECT sequence, step, link, hash FROM point")
                }
                base.close()
        return rows

    def start_daemon(self):
        while True:
            try:
                self.b.start_daemon()
                self.recovery = self.steps["count"] - self.died_at if self.deaths == 1 else self.recovery
                return
            except AssertionError:
                if not self.died():
                    raise
                self.look_at_the_dead()

    def keep_until(self, what, probe):
        """Waits for probe() and brings the daemon back when it dies meanwhile."""
        end = time.monotonic() + PATIENCE_S
        while True:
            if self.died():
                self.look_at_the_dead()
                self.start_daemon()
            try:
                found = probe()
                if found:
                    return found
            except OSError:
                found = None  # it is dying
            expect(time.monotonic() < end, f"after {PATIENCE_S:g} s still not: {what}")
            time.sleep(bench.LOOK_S)

    def good(self):
        return self.b.channels_are_good()

    def try_to_arm(self):
        if not self.good():
            return False
        run = self.b.run()
        if run and self.b.status()["run_open"]:
            if run["state"] != "idle":
                return True
            self.b.axiscal("abort", "--reason", "never armed")  # died before the datum was on disk
            return False
        try:
            self.b.arm()
            return True
        except AssertionError as refusal:
            if "exists already" not in str(refusal):  # two runs within one second
                bench.wait_until(f"the daemon is dead; it said: {refusal}", self.died, 5)
            return False

    def finished(self):
        status = self.b.sim("status")
        expect(status["program"] in ("running", "done"), f"the part program: {status}")
        entries = list((self.b.folder / "state" / "outbox").glob("[!.]*/certificate.json"))
        return status["program"] == "done" and entries and entries[0]

    def go(self):
        b = self.b
        b.start_simulator()
        b.write_station()
        self.start_daemon()
        b.write_program()
        b.go_to_datum()
        self.keep_until("every sensor gives a value", self.good)
        self.keep_until("the run is armed", self.try_to_arm)
        certificate = json.loads(self.keep_until("the certificate", self.finished).read_text())
        b.end("axiscald")
        return self.judge(certificate)

    def judge(self, certificate):
        name = certificate["run"]["id"] + ".axiscal"
        state = self.b.folder / "state"
        told = json.loads(self.b.axiscal("verify", self.runs / name, "--json", "--public-key",
                                         state / "public-keys.pem"))
        expect(told["signature"] == "good", told["signature_sentence"])
        given = [line.split("\t") for line in (state / "certificate-numbers").read_text().splitlines()]
        expect(len({number for *_, number in given}) == len(given), f"a number was given twice: {given}")
        mine = [certificate["run"]["id"], certificate["certificate"]["number"]]
        expect(mine in [paper[2:] for paper in given], f"{mine} is none of {given}")
        rows = self.rows_on_disk()
        expect(sum(len(points) for points in rows.values()) == POINTS, f"points: {rows}")
        points = rows[name]
        expect(sorted(points) == list(range(1, POINTS + 1)), f"sequences: {sorted(points)}")
        expect(sorted(step for step, _, _ in points.values()) == list(range(POINTS)), f"steps: {points}")
        remarks = " ".join(certificate["run"]["remarks"])
        phase = UNREACHED
        if self.deaths == (2 if self.again else 1):
            phase = self.judge_the_dead(name, points, remarks)
        return {"digest": told["result_digest"], "steps": self.steps["count"], "phase": phase,
                "log": self.steps.log(), "remarks": remarks, "recovery": self.recovery}

    def judge_the_dead(self, name, points, remarks):
        before = self.seen["rows"].get(name, {})
        done = self.seen["done"] or 0
        if done != 65535:  # "never armed"
            for sequence in range(1, done + 1):
                expect(sequence in before, f"{sequence} was acknowledged and is not on disk: {before}")
        for sequence, row in before.items():
            expect(points[sequence] == row, f"{sequence} was on disk as {row} and is {points[sequence]}")
        if not before:
            return "before the first point"
        if len(before) == POINTS:
            return "after the last point"
        expect("The station recorded nothing for" in remarks, f"no word of the interruption: {remarks}")
        return "between the points"


def run_one(_deed, label, nth, tear, again):
    """One run from its beginning; gives back what happened, or why it failed."""
    ctypes.CDLL(None).prctl(bench.DIE_WITH_PARENT, signal.SIGKILL)
    signal.signal(signal.SIGALRM, lambda *_: sys.exit(f"not through after {RUN_S} s"))
    signal.alarm(RUN_S)
    b = bench.Bench()
    try:
        began = time.monotonic()
        outcome = Station(b, label, nth, tear, again).go()
        outcome["seconds"] = time.monotonic() - began
        return outcome
    except BaseException as error:  # pylint: disable=broad-except
        b.print_logs()
        return {"error": f"{type(error).__name__}: {error}"}
    finally:
        signal.alarm(0)
        for process in b.processes.values():
            process.kill()
            process.wait()
        shutil.rmtree(b.folder, ignore_errors=True)


def run_apart(order, script=__file__):
    """The run in a program of its own, that ends within its time or is ended: one that hangs fails by
    its name and holds nothing up. What it started dies with it."""
    words = [sys.executable, "-B", script, *map(str, order)]
    try:
        done = subprocess.run(words, stdout=subprocess.PIPE, text=True, timeout=RUN_S + 30, check=False)
    except subprocess.TimeoutExpired:
        return order, {"error": f"hung; ended after {RUN_S + 30} s"}
    logs, _, outcome = done.stdout.rstrip().rpartition("\n")
    print(logs, end="\n" if logs else "", flush=True)
    return order, json.loads(outcome) if done.returncode == 0 else {"error": f"exit {done.returncode}: {outcome}"}


def undisturbed():
    _, outcome = run_apart(("run", "", 0, 0, 0))
    expect("error" not in outcome, f"nothing was killed: {outcome}")
    return outcome


def kinds_of(log):
    counted = collections.Counter(kind for kind, _, _ in log)
    return ", ".join(f"{count} {kind}" for kind, count in sorted(counted.items()))


def orders_of(log, every):
    """[(deed, label, number among its like, torn, again)] of every so many steps; of all of them some are torn, too."""
    met, steps = collections.Counter(), []
    for step in log:
        label = label_of(step)
        met[label] += 1
        steps.append((label, met[label]))
    orders = [("run", *step, 0, 0) for step in steps[::every]]
    return orders + [("run", *step, 1, 0) for step in steps[4::10]] if every == 1 else orders


def second_deaths(orders, everything):
    """The same with a second death while it recovers: a recovery has some ten steps, and what follows until the
    next point is done is as good."""
    longest = 20
    if everything:
        return [(*order[:4], again) for order in orders[::30] for again in range(1, longest + 1)]
    dice = random.Random(SEED)
    return [(*order[:4], dice.randint(1, longest)) for order in dice.sample(orders, 6)]


def run_until_killed(order, script=__file__):
    """Steps are met in every run but for the pages written: the last ones may never come."""
    for _ in range(TRIES):
        _, outcome = run_apart(order, script)
        if outcome.get("phase") != UNREACHED:
            break
        deed, label, nth, tear, again = order
        had = sum(label_of(step) == label for step in outcome["log"])
        order = (deed, label, max(1, min(had, int(0.9 * nth))), tear, max(1, again // 2) if again else 0)
    return order, outcome


def judge(order, outcome, right):
    expect("error" not in outcome, outcome.get("error"))
    expect(outcome["digest"] == right["digest"], f"other result bits {outcome['digest']}")
    expect(outcome["phase"] != UNREACHED, f"it was not killed in {TRIES} tries: not done")


def kill_all(orders, right, script=__file__):
    """Runs every order, some at a time; the first failure is told with its logs."""
    phases, failures = collections.Counter(), []
    abreast = int(os.environ.get("AXISCAL_ABREAST", "8"))
    with concurrent.futures.ThreadPoolExecutor(abreast) as pool:
        for order, outcome in pool.map(lambda order: run_until_killed(order, script), orders):
            try:
                judge(order, outcome, right)
                phases[outcome["phase"]] += 1
            except AssertionError as wrong:
                failures.append(f"{order[0]} killed before {order[1]}, number {order[2]}, torn {order[3]}, again {order[4]}: {wrong}")
                print(failures[-1], flush=True)
    print("; ".join(f"{count} {phase}" for phase, count in sorted(phases.items())))
    expect(not failures, f"{len(failures)} of {len(orders)} failed: {failures[:5]}")


@sentence("RunKilledBeforeAnyWriteStepLosesNothing")
def killed_everywhere(_):
    right = undisturbed()
    print(f"{right['steps']} write steps in one run: {kinds_of(right['log'])}")
    expect(right["steps"] > 300, f"only {right['steps']} steps")
    expect(right["steps"] == len(right["log"]), "the log of the steps is cut")
    everything = bool(os.environ.get("AXISCAL_ALL"))
    orders = orders_of(right["log"], 1 if everything else 10)
    twice = second_deaths(orders, everything)
    print(f"{len(orders)} runs, each killed before another step; {len(twice)} more, killed again while they recover")
    kill_all(orders + twice, right)
    print(f"0 points lost, 0 doubled, every result {right['digest']}")


if __name__ == "__main__":
    if len(sys.argv) == 6:
        print(json.dumps(run_one(*sys.argv[1:3], *map(int, sys.argv[3:]))))
    else:
        bench.main()
