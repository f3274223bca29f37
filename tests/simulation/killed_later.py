"""kill -9 before write steps of what comes after a run or beside one: a reading left out, a point taken again, a drift test,
circles, the copy on the share and its receipt. Nothing that was told done is lost, nothing stands twice, the result has the bits
of one that nobody disturbed. How a step is told: killed.py.

    AXISCAL_ALL=1  every step; else a seeded sample of each deed
"""

import contextlib
import json
import os
import random
import shutil
import signal
import sqlite3
import subprocess
import sys
from pathlib import Path

import bench
import circles
import killed
import papers
from bench import expect, sentence
from killed import UNREACHED, Station
from steps import Steps, label_of

SAMPLE = 8  # orders of each deed


class Deed(Station):
    """A station that does what is asked of it, once it is asked() for, however often its daemon dies on the way."""

    def __init__(self, b, *order):
        super().__init__(b, "", 0, 0)
        self.order = order

    def armed_to_kill(self):
        """From here on steps count."""
        self.first_step = self.steps["count"]
        self.steps.kill_before(*self.order)

    def look_at_the_dead(self):
        code = self.b.processes.pop("axiscald").wait()
        expect(code == -signal.SIGKILL, f"axiscald ended with {code}")
        self.deaths += 1
        expect(self.deaths == 1, f"it died {self.deaths} times")
        self.steps.kill_before("", 0, 0)
        self.steps["first_program"] = 0

    def begin(self):
        self.b.start_simulator()
        self.b.write_station()
        self.start_daemon()
        self.keep_until("every sensor gives a value", self.good)

    def order_until(self, done, *words):
        """Orders it, and again when the daemon died before it was done."""

        def ordered():
            if done():
                return True
            try:
                self.b.axiscal(*words)
                return True
            except AssertionError as refusal:
                bench.wait_until(f"the daemon is dead; it said: {refusal}", lambda: self.died() or done(), 10)
                return False

        self.keep_until(f"axiscal {words[0]} is done", ordered)

    def written(self, pattern):
        """The certificate's document of that name in the outbox, once it is whole."""
        found = list((self.b.folder / "state" / "outbox").glob(f"[!.]*{pattern}/certificate.json"))
        return json.loads(found[0].read_text()) if found else None

    def rows(self, table):
        """Of the only run file, from a copy: looking must not mend anything. A copy of a file that was written meanwhile is
        made anew."""
        for _ in range(20):
            with contextlib.suppress(sqlite3.DatabaseError):
                return self.rows_of_a_copy(table)
        return self.rows_of_a_copy(table)

    def rows_of_a_copy(self, table):
        copy = self.b.folder / "looked-at"
        shutil.rmtree(copy, ignore_errors=True)
        copy.mkdir()
        for path in self.runs.glob("*.axiscal*"):
            with contextlib.suppress(FileNotFoundError):  # a log that has just gone
                shutil.copy(path, copy)
        file = next(copy.glob("*.axiscal"))
        with contextlib.closing(sqlite3.connect(file)) as base:
            base.row_factory = sqlite3.Row
            return base.execute(f"SELECT * FROM {table}").fetchall()

    def outcome(self, digest):
        return {"digest": digest, "phase": "killed" if self.deaths else UNREACHED,
                "log": self.steps.log()[self.first_step:]}

    def verified(self):
        file = next(self.runs.glob("*.axiscal"))
        told = json.loads(self.b.axiscal("verify", file, "--json"))
        expect(told["intact"] and told["findings"] == [], f"{told}")
        return told["result_digest"]


def axes_run(deed):
    """Thirty points, closed and certified, that nobody disturbs."""
    b = deed.b
    deed.begin()
    b.write_program()
    b.go_to_datum()
    b.arm()
    deed.keep_until("the certificate", deed.finished)


class Revised(Deed):
    """A reading is left out, then taken again."""

    point = ("--target", 1, "--direction", "up", "--cycle", 1)

    def go(self):
        b = self.b
        axes_run(self)
        self.armed_to_kill()
        self.order_until(lambda: self.rows("exclusion"), "exclude", *self.point, "--reason", "leaned on the table")
        self.keep_until("the second certificate", lambda: self.written("-r2"))
        self.order_until(lambda: self.rows("retake"), "retake", *self.point, "--reason", "once more")
        shown = b.axiscal("program", "--json", "--retake", next(self.runs.glob("*.axiscal")), "--config",
                          b.folder / "station.toml", "--out", b.folder)
        b.sim(f"run {json.loads(shown)['programs'][0]['file']}")
        third = self.keep_until("the third certificate", lambda: self.written("-r3"))
        b.end("axiscald")
        expect(len(self.rows("exclusion")) == 1 and len(self.rows("retake")) == 1, "each stands once")
        forward = third["run"]["deviations"]["forward"]
        expect([len(row) for row in forward] == [3] * 5, f"{forward}")
        expect(len(self.rows("point")) == killed.POINTS + 1, "thirty points and one")
        return self.outcome(self.verified())


class Drifting(Deed):
    """A drift test; one that was interrupted is closed as incomplete and made anew."""

    readings = 8  # 2 s, each 0.25 s

    def go(self):
        b = self.b
        self.begin()
        self.armed_to_kill()
        self.keep_until("a drift test is complete", self.drifted)
        told = self.keep_until("its certificate", lambda: self.written("-drift"))
        b.end("axiscald")
        test = told["test"]  # a busy computer may leave an interval without samples
        expect(test["readings"] + test["missing"] == self.readings and test["readings"] > 1, f"{test}")
        expect(told["parameters"]["E_VE"]["value"] < 0.05, f"nothing creeps here: {told['parameters']}")
        for file in self.runs.glob("*.axiscal"):
            checked = json.loads(b.axiscal("verify", file, "--json"))
            expect(checked["intact"] and checked["findings"] == [], f"{checked}")
        expect(len(list(self.runs.glob("*.axiscal"))) <= 2, "the one that was cut, and another")
        return self.outcome("drift")

    def drifted(self):
        if not self.good():
            return False
        try:
            told = json.loads(self.b.axiscal("drift", "--duration", "2 s", "--interval", "0.25 s", "--wait", "--json"))
        except AssertionError as refusal:
            if "exists already" not in str(refusal):  # two tests within one second
                bench.wait_until(f"the daemon is dead; it said: {refusal}", self.died, 5)
            return False
        return told["state"] == "complete"


class Circling(Deed):
    """Two circles. A death within one ends the test as incomplete, with its reason, or the circle is driven again."""

    def go(self):
        b = self.b
        circles.with_ballbar(b, overshoot="90 deg")
        self.begin()
        self.keep_until("the ballbar speaks", lambda: b.instrument("ballbar")["state"] == "available")
        shown = json.loads(b.axiscal("program", "--json", "--config", b.folder / "station.toml", "--out", b.folder))
        program = next(one for one in shown["programs"] if one["pass"] == "circular")
        b.sim(f"run {program['file']}")
        lines = Path(program["file"]).read_text().splitlines()
        self.keep_until("the machine waits", lambda: lines[b.sim("status")["line"] - 1].startswith("M66"))
        self.armed_to_kill()
        self.keep_until("the test is armed", self.armed)
        self.keep_until("the test is over", self.over)
        if self.rows("closing")[-1]["complete"] == 1:  # whose figures circles.py judges
            self.keep_until("the certificate", lambda: self.written("-circle") or self.step_was_lost())
        b.end("axiscald")
        self.verified()
        numbers = [(row["stream"], row["block"]) for row in self.rows("stream_block")]
        expect(len(numbers) == len(set(numbers)), "no block stands twice")
        return self.outcome("circles")

    def armed(self):
        if self.deaths and list(self.runs.glob("*.axiscal")):
            return True
        if not self.good() or not all(one["passed"] for one in circles.checks(self.b)):
            return False
        try:
            self.b.axiscal("arm", "--pass", "circular")
            return True
        except AssertionError as refusal:
            if "exists already" not in str(refusal):
                bench.wait_until(f"the daemon is dead; it said: {refusal}", self.died, 5)
            return False

    def over(self):
        return self.rows("closing")

    def step_was_lost(self):
        """A busy computer read no sample while the bar passed the step of a feed-in or feed-out: the circle is refused, and the
        hole stands in the file."""
        status = self.b.status()
        told = [note for note in status["notes"] if "No certificate for run" in note]
        if status["run"]:  # none after a death behind the closing; then the notes say it
            told.append(status["run"]["sentence"])
        reasons = "was not seen: half of feed_in", "of path more than programmed"  # not seen, or seen too late
        refused = next((words for words in told if any(reason in words for reason in reasons)), None)
        if refused is None:
            return False
        lost = [row["missing"] for row in self.rows("stream_block") if row["before"] == "gap"]
        expect(lost, f"no sample is missing, and yet: {refused}")
        print(f"{lost} samples lost: {refused}")
        return True


DEEDS = {"revised": Revised, "drifting": Drifting, "circling": Circling}


def run_one(deed, label, nth, tear, _again):
    b = bench.Bench()
    try:
        return DEEDS[deed](b, label, nth, tear).go()
    except BaseException as error:  # pylint: disable=broad-except
        b.print_logs()
        return {"error": f"{type(error).__name__}: {error}"}
    finally:
        for process in b.processes.values():
            process.kill()
            process.wait()
        shutil.rmtree(b.folder, ignore_errors=True)


def every_step(log):
    """[(label, number among its like)]"""
    met, steps = {}, []
    for step in log:
        label = label_of(step)
        met[label] = met.get(label, 0) + 1
        steps.append((label, met[label]))
    return steps


def orders_of(deed, log):
    """Of every step, or of a sample of them."""
    orders = [(deed, *step, 0, 0) for step in every_step(log)]
    return orders if os.environ.get("AXISCAL_ALL") else random.Random(killed.SEED).sample(orders, SAMPLE)


def killed_in(deed):
    _, right = killed.run_apart((deed, "", 0, 0, 0), __file__)
    expect("error" not in right, f"nothing was killed: {right.get('error')}")
    orders = orders_of(deed, right["log"])
    print(f"{len(right['log'])} write steps; {len(orders)} runs, each killed before another one")
    killed.kill_all(orders, right, __file__)


@sentence("RevisionKilledBeforeAWriteStepIsDoneOnce")
def revision(_):
    killed_in("revised")


@sentence("DriftTestKilledBeforeAWriteStepIsClosedAndMadeAnew")
def drift(_):
    killed_in("drifting")


@sentence("CirclesKilledBeforeAWriteStepAreDrivenAgainOrClosed")
def circular(_):
    killed_in("circling")


def publish(b, code):
    done = subprocess.run([b.program("axiscal-publish"), "--config", b.folder / "station.toml", "--once"], capture_output=True,
                          text=True, timeout=60, check=False, env={**os.environ, **b.environment})
    expect(done.returncode == code, f"exit {done.returncode}, not {code}: {done.stdout}{done.stderr}")


def judge_published(b, run_id, written):
    """One whole copy, one receipt that fits it, nothing left behind."""
    copied = papers.digests(b.share / run_id)
    expect(copied.items() >= written.items(), f"{copied} is not {written}")
    expect([path.name for path in b.share.iterdir()] == [run_id], f"{list(b.share.iterdir())}")
    state = b.folder / "state"
    expect(not list((state / "outbox").glob(f"*{run_id}*")), "it waits no more")
    told = json.loads(b.axiscal("verify", b.share / run_id / f"{run_id}.axiscal", "--json", "--public-key",
                                state / "public-keys.pem", "--receipt", state / "published" / run_id / "receipt.json"))
    expect((told["signature"], told["anchor"]) == ("good", "match"), f"{told}")


@sentence("PublisherKilledBeforeAnyWriteStepLeavesOneCopyAndItsReceipt")
def published(b):
    """Each step: it takes a tenth of a second. The share counts as the state folder does."""
    killed.quiet(b)
    steps = Steps(b)
    b.begin_run()
    b.finish()
    run_id = b.run()["id"]
    written = papers.digests(b.run()["certificate"])
    b.end("axiscald")
    folders = [b.folder / "state", b.share]
    kept = [shutil.copytree(folder, b.folder / f"kept.{i}") for i, folder in enumerate(folders)]

    def begin_anew():
        for folder, copy in zip(folders, kept):
            shutil.rmtree(folder)
            shutil.copytree(copy, folder)
        steps["first_program"] = 0

    steps.watch(b.folder)
    begin_anew()
    first = steps["count"]
    publish(b, 0)
    judge_published(b, run_id, written)
    log = steps.log()[first:]
    orders = every_step(log)
    for label, nth in orders:
        begin_anew()
        steps.kill_before(label, nth, 0)
        publish(b, -signal.SIGKILL)
        steps.kill_before("", 0, 0)
        publish(b, 0)
        judge_published(b, run_id, written)
    expect(len(orders) > 20, f"only {len(orders)} steps: {log}")
    print(f"killed before each of {len(orders)} write steps: one copy and its receipt each time")


if __name__ == "__main__":
    if len(sys.argv) == 6:
        print(json.dumps(run_one(*sys.argv[1:3], *map(int, sys.argv[3:]))))
    else:
        bench.main()
