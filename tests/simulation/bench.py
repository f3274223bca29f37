"""The bench of the simulation tests: unmodified programs, wired to the simulated machine.

A Bench is one station in a scratch folder: axiscal-simulate with its ptys and ports, a station
file, axiscald. Everything is waited for by condition and deadline; whatever was started is ended
and the folder removed, also when the test fails (then the logs are printed first).

    AXISCAL_PATH  folder of the programs, AXISCAL_SOURCE  the source tree (CMake sets both)
"""

import contextlib
import ctypes
import http.client
import json
import os
import random
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time
import tomllib
import traceback
from pathlib import Path

SOURCE = Path(os.environ["AXISCAL_SOURCE"])
LOOK_S = 0.05  # pause between two looks at a condition
START_S = 30.0  # a program is ready within this, on a machine that builds beside it
DIE_WITH_PARENT = 1  # PR_SET_PDEATHSIG of prctl(2)
ANOTHER_SEED = 1000  # added to the scenario's

_tests = {}


def sentence(name):
    """Registers a test under the sentence that ctest shows."""

    def register(function):
        _tests[name] = function
        return function

    return register


class MissedByChance(AssertionError):
    """Values that a right station, too, shows once in a thousand runs each (truth.py)."""


class TooBusy(AssertionError):
    """The simulator has thrown away, and counted, what the station did not read within 1.5 s (pty.hpp)."""


class StallWatch(threading.Thread):
    """For how long nothing ran on this computer: a virtual one is stopped now and then, for seconds. The simulated
    instruments then send all at once what their wires cannot carry."""

    LONG_S = 1.0

    def __init__(self):
        super().__init__(daemon=True)
        self.longest_s = 0.0

    def run(self):
        while True:
            before = time.monotonic()
            time.sleep(0.02)
            self.longest_s = max(self.longest_s, time.monotonic() - before - 0.02)


def main():
    """Runs the test named on the command line. Exit: 0 passed, 1 failed."""
    test = _tests[sys.argv[1]]
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("ended by SIGTERM"))
    # Before ctest kills us without a word: clean up and tell.
    signal.signal(signal.SIGALRM, lambda *_: sys.exit("ran longer than its limit"))
    signal.alarm(int(os.environ.get("AXISCAL_LIMIT_S", "120")))
    watch = StallWatch()
    watch.start()
    try:
        run(test)
    except MissedByChance as missed:
        print(f"{missed}; all must be right with another seed", flush=True)
        run(test, ANOTHER_SEED)
    except TooBusy as busy:
        print(f"{busy}\nThis computer is too busy: all must be right the second time", flush=True)
        run(test)
    except Exception as failed:  # a stall ends a test in any way: in a library of a browser, too
        if watch.longest_s < StallWatch.LONG_S:
            sys.exit(1)
        print(f"{failed}\nNothing ran on this computer for {watch.longest_s:.1f} s meanwhile: all must be right the "
              "second time", flush=True)
        run(test)


def run(test, seed_added=0):
    with Bench() as bench:
        bench.seed_added = seed_added
        test(bench)


def expect(condition, message):
    if not condition:
        raise AssertionError(message)


def wait_until(what, probe, limit_s):
    """Polls until probe() is true and returns it; AssertionError after the deadline."""
    end = time.monotonic() + limit_s
    while True:
        found = probe()
        if found:
            return found
        expect(time.monotonic() < end, f"after {limit_s:g} s still not: {what}")
        time.sleep(LOOK_S)


GIVEN_PORTS = set()


def free_port():
    """A TCP port that nobody listens on, and that was not given before, below the range that the kernel gives to clients."""
    while True:
        port = random.SystemRandom().randint(12000, 32000)
        if port in GIVEN_PORTS:
            continue
        GIVEN_PORTS.add(port)
        with socket.socket() as probe, contextlib.suppress(OSError):
            probe.bind(("127.0.0.1", port))
            return port


def to_toml(document):
    """Text of a document of tables, arrays of tables and plain values."""

    def plain(value):
        return json.dumps(value, ensure_ascii=False)

    def write(table, path, lines):
        later = []
        for key, value in table.items():
            of_tables = isinstance(value, list) and value and isinstance(value[0], dict)
            if isinstance(value, dict) or of_tables:
                later.append((path + [key], value, of_tables))
            else:
                lines.append(f"{key} = {plain(value)}")
        for name, value, of_tables in later:
            for entry in value if of_tables else [value]:
                lines.append(("[[{}]]" if of_tables else "[{}]").format(".".join(name)))
                write(entry, name, lines)
        return lines

    return "\n".join(write(document, [], [])) + "\n"


class UnixHttp(http.client.HTTPConnection):
    def __init__(self, path):
        super().__init__("localhost", timeout=10)
        self.path = path

    def connect(self):
        self.sock = socket.socket(socket.AF_UNIX)
        self.sock.settimeout(self.timeout)
        self.sock.connect(self.path)


class Bench:
    """`scenario` and `station` are plain documents; a test changes them before start()."""

    def __init__(self):
        self.folder = Path(tempfile.mkdtemp(prefix="axiscal-"))
        self.processes = {}
        self.environment = {"AXISCAL_PAGE_PATH": ""}  # of the daemon, and of what it starts: the page beside them, whatever the shell has
        self.daemon_stderr = subprocess.STDOUT  # its log; or a descriptor of the test's own
        self.logs = []
        self.share = self.folder / "share"
        self.share.mkdir()
        self.seed_added = 0
        self.scenario = tomllib.loads(
            (SOURCE / "tools/axiscal-simulate/scenarios/demo.toml").read_text()
        )
        self.station = self._station_of_template()
        self.shorten()

    def _station_of_template(self):
        text = (SOURCE / "tests/simulation/station.toml.in").read_text()
        for place, value in {
            "@SCRATCH@": str(self.folder),
            "@SHARE@": str(self.share),
            "@PROFILES@": str(SOURCE / "config/profiles"),
        }.items():
            text = text.replace(place, value)
        return tomllib.loads(text)

    def shorten(self):
        """Five targets on 0.4 m, twice from each side: 20 points in about 15 s."""
        self.station["axis"]["travel_high"] = "400 mm"
        self.station["cycle"].update(
            interval="80 mm", target_count=5, first_target="28 mm", approaches=2
        )
        self.hurry()
        self.trigger("sequence-block", "tcp")

    def hurry(self, window_s=0.15):
        """Feeds just below what the simulated head can follow (0.48 m/s), short halts."""
        self.scenario["axis"].update(rapid_mm_per_min=25000.0, acceleration_mm_per_s2=8000.0)
        self.scenario["truth"]["window_s"] = window_s
        self.station["cycle"].update(feed="25000 mm/min", dwell=f"{window_s} s")
        self.station["capture"].update(window=f"{window_s} s", timeout="3 s")

    def trigger(self, shape, transport):
        """One shape on one wire, on both sides. Ports are chosen by start()."""
        self.station["trigger"] = {"shape": shape, "transport": transport}
        cnc = {"shape": shape}
        if transport == "tcp":
            port = free_port()
            self.station["trigger"]["port"] = port
            cnc["port"] = port
        elif transport == "rtu":
            line = str(self.folder / "cnc.tty")
            self.station["trigger"].update(serial_port=line, baud=115200)
            cnc.update(transport="rtu", path=line, baud=115200)
        elif transport == "tcp-mirrored":
            self.station["trigger"].update(host="127.0.0.1", poll_interval="20 ms")
            cnc.update(transport="server", port=0)
        self.scenario["cnc"] = cnc

    def inject(self, kind, request, **more):
        self.scenario["cnc"].setdefault("fault", []).append(
            {"kind": kind, "request": request, **more}
        )

    # --- programs ------------------------------------------------------------------------------

    def program(self, name):
        found = shutil.which(name, path=os.environ["AXISCAL_PATH"])
        expect(found, f"{name} is not in {os.environ['AXISCAL_PATH']}")
        return found

    def preloadable(self, library):
        """A name of the library that LD_PRELOAD takes: a space in it, as in that of a checkout, would divide it in two."""
        link = self.folder / Path(library).name
        link.unlink(missing_ok=True)
        link.symlink_to(library)
        return str(link)

    def log_file(self, name):
        """Where the next program writes what it says."""
        return self.folder / f"{name}.{len(self.logs)}.log"

    def spawn(self, name, *words):
        log = self.log_file(name)
        self.logs.append(log)
        lib = ctypes.CDLL(None)
        with open(log, "wb") as out:
            process = subprocess.Popen(
                [self.program(name), *map(str, words)],
                cwd=self.folder,
                env={**os.environ, **(self.environment if name == "axiscald" else {})},
                stdin=subprocess.DEVNULL,
                stdout=out,
                stderr=self.daemon_stderr if name == "axiscald" else subprocess.STDOUT,
                preexec_fn=lambda: lib.prctl(DIE_WITH_PARENT, signal.SIGKILL),
            )
        self.processes[name] = process
        return log

    def axiscal(self, *words, code=0):
        """Runs the command line; its exit code must be `code`. Gives back what it printed."""
        try:
            done = subprocess.run(
                [self.program("axiscal"), *map(str, words)],
                cwd=self.folder,
                env={**os.environ, "AXISCAL_SOCKET": self.socket},
                stdin=subprocess.DEVNULL,
                capture_output=True,
                text=True,
                timeout=100,
                check=False,
            )
        except subprocess.TimeoutExpired as late:
            raise AssertionError(f"axiscal {' '.join(map(str, words))}: not done after {late.timeout} s") from late
        shown = f"axiscal {' '.join(map(str, words))}: exit {done.returncode}, not {code}\n"
        expect(done.returncode == code, shown + done.stdout + done.stderr)
        self.complaint = done.stderr
        return done.stdout

    @property
    def socket(self):
        return str(self.folder / "axiscald.sock")

    def start_simulator(self):
        path = self.folder / "scenario.json"
        seed = self.scenario.get("seed", 1) + self.seed_added
        path.write_text(json.dumps(self.scenario | {"seed": seed}))
        log = self.spawn(
            "axiscal-simulate", "--scenario", path, "--control", self.folder / "sim.sock"
        )
        line = self.wait_for_line("axiscal-simulate", log, '"ready":true')
        self.places = json.loads(line)
        if self.scenario["cnc"].get("transport") == "server":
            self.station["trigger"]["port"] = self.places["cnc"]["port"]

    def write_station(self):
        path = self.folder / "station.toml"
        path.write_text(to_toml(self.station))
        self.axiscal("check-config", path)

    def start_daemon(self):
        log = self.spawn("axiscald", "--config", self.folder / "station.toml")
        self.wait_for_line("axiscald", log, "ready")

    def start_daemon_again(self):
        """After its death in mid-run; gives back the id of the run that goes on."""
        self.start_daemon()
        return wait_until("the open run goes on", self.run, START_S)["id"]

    def wait_for_line(self, name, log, words):
        def look():
            expect(self.processes[name].poll() is None, f"{name} ended: {log.read_text()}")
            lines = log.read_text(errors="replace").split("\n")[:-1]  # whole ones
            return next((line for line in lines if words in line), None)

        return wait_until(f"{name} says {words}", look, START_S)

    def end(self, name, sign=signal.SIGTERM):
        """Ends a program and waits for it; gives back its exit code."""
        process = self.processes.pop(name)
        process.send_signal(sign)
        return process.wait(timeout=START_S)

    # --- talking -------------------------------------------------------------------------------

    def sim(self, command):
        """One command to the simulator."""
        with socket.socket(socket.AF_UNIX) as wire:
            wire.settimeout(10)
            wire.connect(str(self.folder / "sim.sock"))
            wire.sendall((command + "\n").encode())
            answer = json.loads(wire.makefile().readline())
        expect(answer.get("ok", True), f"simulator, {command}: {answer}")
        return answer

    def truth(self):
        """What the simulator hid: the parameters that the run must find, with their bounds."""
        self.sim("truth truth.json")
        return json.loads((self.folder / "truth.json").read_text())

    def status(self):
        door = UnixHttp(self.socket)
        try:
            door.request("GET", "/v1/status")
            return json.load(door.getresponse())
        finally:
            door.close()

    def run(self):
        return self.status()["run"]

    def instrument(self, name):
        return next(one for one in self.status()["instruments"] if one["name"] == name)

    def plug_the_cable_in(self):
        """The CNC is again a client of the station's Modbus TCP port."""
        self.sim(f"connect 127.0.0.1 {self.station['trigger']['port']}")

    def foreign_request(self, sequence):
        """Another Modbus client writes CMD = capture and this CMD_SEQ into the sequence-block."""
        pdu = struct.pack(">BHHBHH", 16, 1, 2, 4, 2, sequence)
        with socket.create_connection(
            ("127.0.0.1", self.station["trigger"]["port"]), timeout=10
        ) as wire:
            wire.sendall(struct.pack(">HHHB", 7, 0, len(pdu) + 1, 1) + pdu)
            answer = wire.recv(64)
        expect(answer[7:8] == b"\x10", f"the station answered {answer.hex()}")

    def channels_are_good(self):
        """Whether every channel that the station file names for the axis has a value: its laser or
        scale, and of material and air what it names; without an axis the ballbar."""
        shown = {f"{c['instrument']}/{c['channel']}": c["value"] for c in self.status()["channels"]}
        axis = self.station.get("axis") or {"laser": self.station["ballbar"]["sensor"]}
        scale = axis.get("scale")
        wanted = [scale["channel"], *scale["temperature"]] if scale else [axis["laser"]]
        wanted += axis.get("material", {}).get("temperature", [])
        if air := axis.get("air"):
            wanted += [air[key] for key in ("temperature", "pressure", "humidity")]
        return all(shown.get(name) is not None for name in wanted)

    # --- a whole run ---------------------------------------------------------------------------

    def start(self):
        self.start_simulator()
        self.write_station()
        self.start_daemon()
        wait_until("every sensor gives a value", self.channels_are_good, START_S)

    def write_program(self, *words):
        """Gives back the plan that `axiscal program --json` prints for the first pass."""
        shown = self.axiscal(
            "program", "--json", "--config", self.folder / "station.toml", "--out", self.folder,
            *words,
        )
        self.plan = json.loads(shown)["programs"][0]
        return self.plan

    def go_to_datum(self):
        """Starts the part program; it waits at the datum for the station."""
        self.sim(f"run {self.plan['file']}")
        lines = Path(self.plan["file"]).read_text().splitlines()

        def waiting():
            status = self.sim("status")
            expect(status["program"] == "running", f"the part program: {status}")
            return lines[status["line"] - 1].startswith("M66")

        wait_until("the part program waits at its datum", waiting, 60)

    def drift_test(self, *words):
        """A drift test without a gap, as `axiscal drift --wait --json` tells it. On a busy computer the simulated laser
        may be late, and an interval without its reading is told as missing, as it must be: then another test is made."""
        for _ in range(3):
            ended = json.loads(self.axiscal("drift", *words, "--wait", "--json"))
            expect(ended["state"] == "complete" and ended["taken"] + ended["missing"] == ended["planned"], f"{ended}")
            if ended["missing"] == 0:
                return ended
            print(f"{ended['missing']} readings came too late: once more", flush=True)
        raise AssertionError(f"{ended}")

    def arm(self, *words):
        self.axiscal("arm", "--program", self.plan["file"], *words)

    def begin_run(self, hold_after=None):
        """The CNC stands still after so many requests, until it is told to `go`: what is then done to
        the station happens in mid-run, however slow this computer is."""
        self.start()
        self.write_program()
        self.go_to_datum()
        if hold_after:
            self.sim(f"hold {hold_after}")
        self.arm()

    def wait_for_points(self, count, limit_s=60):
        def enough():
            run = self.run()
            expect(run["sentence"] == "", f"refused on the way: {run['sentence']}")
            return run["step"] >= count

        wait_until(f"{count} points are durable", enough, limit_s)

    def finish(self):
        """Waits for the certificate; gives it back."""
        self.axiscal("watch", "--until-published")
        return self.certificate()

    def certificate(self):
        return json.loads((Path(self.run()["certificate"]) / "certificate.json").read_text())

    def wait_for_refusal(self, fault, limit_s=30):
        """Waits until the station names this fault; gives back run as the CLI shows it."""

        def named():
            run = self.run()
            return run["fault"] if run["fault"] else None

        seen = wait_until("a fault is named", named, limit_s)
        run = json.loads(self.axiscal("status", "--json"))["run"]
        expect(seen == fault, f"named {seen}, not {fault}: {run['sentence']}")
        return run

    def __enter__(self):
        return self

    def __exit__(self, kind, error, trace):
        for process in self.processes.values():
            process.kill()
        for process in self.processes.values():
            process.wait()
        if error is not None:
            traceback.print_exception(kind, error, trace)
            self.print_logs()
        shutil.rmtree(self.folder, ignore_errors=True)

    def print_logs(self):
        for log in self.logs:
            lines = log.read_text(errors="replace").splitlines()
            print(f"--- {log.name}, last of {len(lines)} lines")
            print("\n".join(lines[-60:]), flush=True)
