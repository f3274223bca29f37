#!/usr/bin/python3
"""A calibration with LinuxCNC as the machine: linuxcnc_measures.py SOURCE_DIR BUILD_DIR SHAPE

axiscal's part program runs on LinuxCNC; its 1 kHz motor position drives the simulated laser
through the injected error; mb2hal asks for the points. SHAPE: single-register | coil-and-index.
A missing LinuxCNC is a failure unless AXISCAL_MAY_SKIP names linuxcnc (then exit 77)."""
import contextlib
import json
import os
import pathlib
import shutil
import signal
import socket
import sqlite3
import subprocess
import sys
import tempfile
import time

PATIENCE_S = 30  # only ends a failing test
RUN_LIMIT_S = 300
E_MARK_MM = 0.0001  # 0.1 um, of the E that was injected
POINTS = 110        # 11 targets, 5 approaches each way
TABLES = {"certificate.json", "certificate.csv", "certificate.pdf"}
FIGURES = {"A", "A_forward", "A_backward", "E", "E_forward", "E_backward", "M",
           "R", "R_forward", "R_backward", "B", "B_mean"}


def until(condition, what, alive):
    end = time.monotonic() + PATIENCE_S
    while not condition():
        for process in alive:
            assert process.poll() is None, f"{process.args[0]} ended with {process.returncode}"
        assert time.monotonic() < end, f"never came: {what}"
        time.sleep(0.05)


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Bench:
    """All programs of one run, in one scratch folder; leaving ends them and removes it."""

    def __init__(self, source, build, shape):
        self.source, self.shape = source, shape
        self.scratch = pathlib.Path(tempfile.mkdtemp(prefix="axiscal-peer-"))
        self.scratch.chmod(0o711)  # LinuxCNC's real-time part is another user
        self.port = free_port()
        self.programs = {"axiscald": build / "bin/axiscald",
                         "axiscal": build / "bin/axiscal",
                         "simulate": build / "bin/axiscal-simulate"}
        self.environment = {**os.environ, "TMPDIR": str(self.scratch),
                            "AXISCAL_SOCKET": str(self.scratch / "axiscald.sock"),
                            "AXISCAL_PROFILE_PATH": str(source / "config/profiles")}
        self.running = []

    def __enter__(self):
        return self

    def __exit__(self, failure, *_):
        for process in reversed(self.running):
            process.terminate()
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(PATIENCE_S)
        for log in sorted(self.scratch.glob("*.log")) if failure else []:
            print(f"--- {log.name}\n{log.read_text(errors='replace')[-4000:]}")
        shutil.rmtree(self.scratch)

    def start(self, name, *words):
        with open(self.scratch / f"{pathlib.Path(words[0]).stem}.log", "w") as log:
            process = subprocess.Popen([str(word) for word in words], cwd=self.scratch, stdout=log,
                                       stdin=subprocess.DEVNULL, stderr=subprocess.STDOUT,
                                       env=self.environment)
        process.name = name
        self.running.append(process)
        return process

    def axiscal(self, *words, limit_s=PATIENCE_S):
        done = subprocess.run([self.programs["axiscal"], *map(str, words)], cwd=self.scratch,
                              stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              timeout=limit_s, env=self.environment)
        assert done.returncode == 0, f"axiscal {words}: {done.stdout}{done.stderr}"
        return done.stdout

    def said(self, name, words):
        file = self.scratch / name
        return file.exists() and words in file.read_text(errors="replace")

    def write_station(self):
        text = (self.source / "tools/demo.d/station.toml.in").read_text()
        for key, value in {"SCRATCH": self.scratch, "SHARE": self.scratch / "share",
                           "SHAPE": self.shape, "PORT": self.port}.items():
            text = text.replace(f"@{key}@", str(value))
        station = self.scratch / "station.toml"
        station.write_text(text)
        return station

    def measure(self):
        """@returns the certificate's folder and the part program."""
        station = self.write_station()
        self.axiscal("program", "--config", station, "--out", self.scratch)
        program = self.scratch / "X-whole.ngc"
        pipe = self.scratch / "positions"
        os.mkfifo(pipe)
        simulator = self.start("simulator", self.programs["simulate"], "--scenario", scenario(self.source),
                               "--positions", pipe)
        until(lambda: self.said("axiscal-simulate.log", '"ready"'), "instruments", [simulator])
        daemon = self.start("axiscald", self.programs["axiscald"], "--config", station)
        until(lambda: self.said("axiscald.log", "ready"), "axiscald", [simulator, daemon])
        cnc = self.start("cnc", self.source / "tools/linuxcnc/run_linuxcnc.sh", "--program", program,
                         "--shape", self.shape, "--port", self.port, "--positions", pipe,
                         "--scratch", self.scratch)
        until(lambda: self.said("cnc.events", "waiting"), "the program at its datum",
              [simulator, daemon, cnc])
        until(lambda: "unavailable" not in self.axiscal("devices"), "all instruments", [daemon, cnc])
        self.axiscal("arm", "--program", program)
        assert cnc.wait(RUN_LIMIT_S) == 0, f"LinuxCNC: {(self.scratch / 'cnc.events').read_text()}"
        print(self.axiscal("watch", "--until-published").splitlines()[-1])
        return next((self.scratch / "state/outbox").iterdir()), program

    def truth(self, program):
        file = self.scratch / "truth.json"
        subprocess.run([self.programs["simulate"], "truth", "--scenario", scenario(self.source),
                        "--program", program, "--truth", file], check=True, timeout=PATIENCE_S)
        return json.loads(file.read_text())["parameters"]


def scenario(source):
    return source / "tests/peers/linuxcnc/quiet-axis.toml"


def judge_points(run_file):
    with contextlib.closing(sqlite3.connect(f"file:{run_file}?mode=ro", uri=True)) as run:
        points = run.execute("SELECT sequence, step, planned_step, target_index, direction, approach,"
                             " origin FROM point ORDER BY link").fetchall()
        plan = run.execute("SELECT step, target_index, direction, approach FROM plan_point"
                           " ORDER BY step").fetchall()
    assert [point[0] for point in points] == list(range(1, POINTS + 1)), "requests in order"
    assert [(point[1], *point[3:6]) for point in points] == plan, "the points that were planned"
    assert all(point[1] == point[2] for point in points), "none out of its turn"
    assert {point[6] for point in points} == {"cnc"}, f"asked by {({p[6] for p in points})}"


def judge_certificate(folder, truth):
    names = {file.name for file in folder.iterdir()}
    run_file = next(folder.glob("*.axiscal"))
    assert names == TABLES | {run_file.name}, names
    assert all(file.stat().st_size > 0 for file in folder.iterdir()), "an empty file"
    document = json.loads((folder / "certificate.json").read_text())
    assert set(document["parameters"]) == FIGURES, sorted(document["parameters"])
    assert "not_evaluated" not in document or not document["not_evaluated"], document["not_evaluated"]
    assert len(document["positions"]) == 11
    judge_points(run_file)
    E_mm, injected = document["parameters"]["E"]["value"], truth["E"]
    assert injected["bound"] <= E_MARK_MM, f"the scenario can not hold the mark: {injected}"
    assert abs(E_mm - injected["value"]) <= E_MARK_MM, f"E {E_mm} mm, injected {injected}"
    print(f"110 of 110 points in order; E {E_mm * 1e3:.3f} um, injected {injected['value'] * 1e3:.3f} um")


def judge_recipe(source, shape, program):
    """What docs/trigger.md shows of a point is what ran."""
    text = (source / "docs/trigger.md").read_text()
    shown = text.split(f"### LinuxCNC, {shape}\n")[1].split("```\n")[1]
    assert shown in program.read_text(), f"docs/trigger.md shows another program:\n{shown}"


def leftovers(scratch):
    """What LinuxCNC may not leave: programs, and the folder of its socket."""
    names = "rtapi_app,milltask,linuxcncsvr,mb2hal,halsampler,linuxcnc"
    programs = subprocess.run(["ps", "-C", names, "-o", "args="], capture_output=True, text=True).stdout
    return [*programs.splitlines(), *map(str, scratch.glob("axiscal-cnc.*"))]


def main():
    source, build, shape = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3]
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    if not shutil.which("linuxcnc"):
        print("linuxcnc is not installed (apt-get install linuxcnc-uspace)")
        return 77 if "linuxcnc" in os.environ.get("AXISCAL_MAY_SKIP", "").split(",") else 1
    with Bench(source, build, shape) as bench:
        folder, program = bench.measure()
        judge_recipe(source, shape, program)
        judge_certificate(folder, bench.truth(program))
        left = leftovers(bench.scratch)
        assert not left, f"left behind: {left}"
    return 0


sys.exit(main())
