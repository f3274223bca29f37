"""LinuxCNC, axiscald and the simulated instruments on one bench: what the tests beside it share.

A missing LinuxCNC, or socat where a test needs it, is a failure unless AXISCAL_MAY_SKIP names
linuxcnc (then exit 77)."""
import json
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

PATIENCE_S = 30  # only ends a failing test
RUN_LIMIT_S = 300
OTHERS_LIMIT_S = 250  # another bench may have LinuxCNC just now
PACKAGES = {"linuxcnc": "linuxcnc-uspace", "socat": "socat"}
FIVE_TARGETS = {  # of demo.d/station.toml.in: a short run of ten points, each target once from each side
    'travel_high = "1035 mm"': 'travel_high = "400 mm"',
    'interval = "96 mm"\ntarget_count = 11\nfirst_target = "34 mm"':
    'interval = "80 mm"\ntarget_count = 5\nfirst_target = "28 mm"\napproaches = 1',
}
OVER_TCP = '\ntransport = "tcp"\nhost = "127.0.0.1"\nport = @PORT@\n'  # in each station file


def until(condition, what, alive, patience_s=PATIENCE_S):
    end = time.monotonic() + patience_s
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
        self.scenario = source / "tests/peers/linuxcnc/quiet-axis.toml"
        self.station = source / "tools/demo.d/station.toml.in"
        self.scratch = pathlib.Path(tempfile.mkdtemp(prefix="axiscal-peer-"))
        self.scratch.chmod(0o711)  # LinuxCNC's real-time part is another user
        self.port = free_port()
        self.wire = ["--port", self.port]  # of run_linuxcnc.sh
        self.changes = {}  # of the station file's text
        self.stream = []  # to the simulator: which value of LinuxCNC's stream is what
        self.programs = {"axiscald": build / "bin/axiscald",
                         "axiscal": build / "bin/axiscal",
                         "simulate": build / "bin/axiscal-simulate"}
        self.environment = {**os.environ, "TMPDIR": str(self.scratch), "AXISCAL_PAGE_PATH": "",
                            "AXISCAL_SOCKET": str(self.scratch / "axiscald.sock"),
                            "AXISCAL_PROFILE_PATH": str(source / "config/profiles")}
        self.running = []

    def __enter__(self):
        return self

    def __exit__(self, failure, *_):
        for process in reversed(self.running):
            process.terminate()
            try:
                process.wait(PATIENCE_S)
            except subprocess.TimeoutExpired:
                process.kill()
        for log in sorted(self.scratch.glob("*.log")) if failure else []:
            print(f"--- {log.name}\n{log.read_text(errors='replace')[-4000:]}")
        shutil.rmtree(self.scratch)

    def start(self, *words):
        with open(self.scratch / f"{pathlib.Path(words[0]).stem}.log", "w") as log:
            process = subprocess.Popen([str(word) for word in words], cwd=self.scratch, stdout=log,
                                       stdin=subprocess.DEVNULL, stderr=subprocess.STDOUT,
                                       env=self.environment)
        self.running.append(process)
        return process

    def ask(self, *words, limit_s=PATIENCE_S):
        return subprocess.run([self.programs["axiscal"], *map(str, words)], cwd=self.scratch,
                              stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              timeout=limit_s, env=self.environment)

    def axiscal(self, *words, limit_s=PATIENCE_S):
        done = self.ask(*words, limit_s=limit_s)
        assert done.returncode == 0, f"axiscal {words}: {done.stdout}{done.stderr}"
        return done.stdout

    def said(self, name, words):
        file = self.scratch / name
        return file.exists() and words in file.read_text(errors="replace")

    def write_station(self):
        text = self.station.read_text()
        for words, others in self.changes.items():
            assert words in text, f"{self.station} does not say {words}"
            text = text.replace(words, others)
        for key, value in {"SCRATCH": self.scratch, "SHARE": self.scratch / "share",
                           "SHAPE": self.shape, "PORT": self.port}.items():
            text = text.replace(f"@{key}@", str(value))
        station = self.scratch / "station.toml"
        station.write_text(text)
        return station

    def lay_serial_line(self):
        """The trigger on Modbus RTU instead of TCP: a pseudo terminal at each end, socat between.
        It keeps both open itself, so that it stays, as a cable does, when the station leaves it."""
        ends = [self.scratch / name for name in ("station.tty", "cnc.tty")]
        socat = self.start("socat", *(f"pty,raw,echo=0,link={end}" for end in ends))
        until(lambda: all(end.exists() for end in ends), "the serial line", [socat])
        self.changes[OVER_TCP] = f'\ntransport = "rtu"\nserial_port = "{ends[0]}"\nbaud = 115200\n'
        self.wire = ["--serial", ends[1].name]  # LinuxCNC lives in the scratch folder

    def start_station(self, station):
        daemon = self.start(self.programs["axiscald"], "--config", station)
        until(lambda: self.said("axiscald.log", "ready"), "axiscald", [daemon])
        return daemon

    def start_cnc(self, program, pipe):
        """@returns LinuxCNC, waiting at the datum."""
        cnc = self.start(self.source / "tools/linuxcnc/run_linuxcnc.sh", "--program", program,
                         "--shape", self.shape, *self.wire, "--positions", pipe,
                         "--scratch", self.scratch)
        until(lambda: self.said("cnc.events", "waiting"), "the program at its datum", self.running,
              OTHERS_LIMIT_S)
        return cnc

    def may_arm(self, run="whole"):
        return subprocess.run([self.programs["axiscal"], "preflight", "--pass", run], env=self.environment,
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode == 0

    def arm(self, alive, *words, run="whole"):
        """As a person does who is told to wait: a busy computer may break the readings between the checks and the order."""
        def armed():
            if not self.may_arm(run):
                return False
            done = self.ask("arm", *words)
            if done.returncode != 0:
                print(done.stderr + done.stdout)
            return done.returncode == 0

        until(armed, "every pre-flight check to hold, and the run to be armed", alive)

    def make_ready(self, name="X-whole.ngc", *words):
        """Everything before `axiscal arm`; `words` go to `axiscal program`, too. @returns axiscald, LinuxCNC
        and the part program."""
        station = self.write_station()
        self.axiscal("program", "--config", station, "--out", self.scratch, *words)
        program = self.scratch / name
        pipe = self.scratch / "positions"
        os.mkfifo(pipe)
        simulator = self.start(self.programs["simulate"], "--scenario", self.scenario,
                               "--positions", pipe, *self.stream)
        until(lambda: self.said("axiscal-simulate.log", '"ready"'), "instruments", [simulator])
        daemon = self.start_station(station)
        return daemon, self.start_cnc(program, pipe), program

    def begin_run(self, name="X-whole.ngc", *words):
        """Everything up to `axiscal arm`, which gets the `words`, too. @returns axiscald, LinuxCNC and the
        part program."""
        daemon, cnc, program = self.make_ready(name, *words)
        self.arm([daemon, cnc], "--program", program, *words)
        return daemon, cnc, program

    def reach_the_end(self, cnc):
        """LinuxCNC's program ends and the certificate is published; nothing is left of LinuxCNC. @returns the
        folder of the certificate."""
        assert cnc.wait(RUN_LIMIT_S) == 0, f"LinuxCNC: {(self.scratch / 'cnc.events').read_text()}"
        print(*self.axiscal("watch", "--until-published", limit_s=PATIENCE_S).splitlines()[-1:])
        left = leftovers(self.scratch)
        assert not left, f"left behind: {left}"
        return next((self.scratch / "state/outbox").iterdir())

    def status(self):
        return json.loads(self.axiscal("status", "--json"))

    def truth(self, program):
        file = self.scratch / "truth.json"
        subprocess.run([self.programs["simulate"], "truth", "--scenario", self.scenario,
                        "--program", program, "--truth", file], check=True, timeout=PATIENCE_S)
        return json.loads(file.read_text())["parameters"]


def leftovers(scratch):
    """What LinuxCNC may not leave: programs, and the folder of its socket."""
    names = "rtapi_app,milltask,linuxcncsvr,mb2hal,halsampler,linuxcnc"
    programs = subprocess.run(["ps", "-C", names, "-o", "args="], capture_output=True, text=True).stdout
    return [*programs.splitlines(), *map(str, scratch.glob("axiscal-cnc.*"))]


def run_in_bench(test, *needed):
    """For main(): test(bench) with the arguments SOURCE_DIR BUILD_DIR SHAPE. @returns exit code.

    `needed` are programs besides LinuxCNC."""
    source, build, shape = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3]
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    missing = [name for name in ("linuxcnc", *needed) if not shutil.which(name)]
    if missing:
        print(f"not installed: {missing[0]} (apt-get install {PACKAGES[missing[0]]})")
        return 77 if "linuxcnc" in os.environ.get("AXISCAL_MAY_SKIP", "").split(",") else 1
    with Bench(source, build, shape) as bench:
        test(bench)
    return 0
