"""What runs inside the guest: checks, and the simulated world on the guest's own kernel.

A boot file registers checks, each a sentence, and calls run_checks(). One check prints one line,
`ok NAME` or `FAILED NAME: why`; what belongs to a line follows it, indented. Everything is waited
for by condition and deadline, both by the guest's own clock, which a busy host does not hurry
(machine.py).
"""

import contextlib
import io
import json
import os
import shutil
import socket
import subprocess
import textwrap
import time
import traceback
from pathlib import Path

SOURCE = Path(os.environ["AXISCAL_SOURCE"])
PROGRAMS = Path(os.environ["AXISCAL_PATH"])
SHARE = Path("/hostshare")  # what is written here stays after the guest's end
LOOK_S = 0.1
READY_S = 30.0

_checks = []


def check(sentence):
    def register(function):
        _checks.append((sentence, function))
        return function

    return register


def run_checks(*worlds):
    """Runs every check in the order of the file, in the world that the boot made. One that fails
    does not hide the next."""
    failed = 0
    for sentence, function in _checks:
        began = time.monotonic()
        told = io.StringIO()
        try:
            with contextlib.redirect_stdout(told):
                function(*worlds)
            print(f"ok {sentence}")
        except Exception as error:
            failed += 1
            print(f"FAILED {sentence}: {' '.join(str(error).split())[:400] or type(error).__name__}")
            told.write(traceback.format_exc())
        told.write(f"{time.monotonic() - began:.1f} s")
        print(textwrap.indent(told.getvalue(), "  "))
    return 1 if failed else 0


def expect(condition, message):
    if not condition:
        raise AssertionError(message)


def wait_until(what, probe, limit_s=READY_S):
    """Polls until probe() is true and returns it; AssertionError after the deadline."""
    end = time.monotonic() + limit_s
    while True:
        found = probe()
        if found:
            return found
        expect(time.monotonic() < end, f"after {limit_s:g} s still not: {what}")
        time.sleep(LOOK_S)


def run(*words, may_fail=False, limit_s=60):
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True, timeout=limit_s)
    expect(may_fail or done.returncode == 0, f"{words[0]}: exit {done.returncode}: {done.stdout}{done.stderr}")
    return done.stdout


def load_modules(*names):
    run("dmesg", "-n", "1")  # vhci_hcd tells every transfer that is taken back
    run("modprobe", "-a", *names)


def start_udev():
    """udevd alone, with the product's rules: /dev/serial/by-id, groups, symlinks, as on a station."""
    Path("/run/udev/rules.d").mkdir(parents=True, exist_ok=True)
    shutil.copy(SOURCE / "systemd/70-axiscal.rules", "/run/udev/rules.d/")
    run("groupadd", "--system", "axiscal", may_fail=True)
    run("/lib/systemd/systemd-udevd", "--daemon")
    run("udevadm", "trigger")
    run("udevadm", "settle", "--timeout=60")


class Programs:
    """Programs of the build, each with its log in the share; all end with the with-block."""

    def __init__(self):
        self.running = {}

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for name in list(self.running):
            self.end(name)

    def start(self, name, program, *words, cwd="/run"):
        log = SHARE / f"{name}.log"
        with open(log, "ab") as out:
            self.running[name] = subprocess.Popen(
                [PROGRAMS / program, *map(str, words)], cwd=cwd, stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.STDOUT)
        return log

    def start_ready(self, name, program, *words, cwd="/run"):
        """Starts and waits for the JSON line that says ready."""
        log = self.start(name, program, *words, cwd=cwd)
        said = log.stat().st_size

        def ready():
            expect(self.running[name].poll() is None, f"{name} ended: {log.read_text()}")
            lines = log.read_text()[said:].splitlines()
            return next((json.loads(line) for line in lines if line.startswith('{') and '"ready"' in line), None)

        return wait_until(f"{name} says that it is ready", ready)

    def end(self, name):
        process = self.running.pop(name, None)
        if process is None:
            return
        process.terminate()
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(10)
        process.kill()
        process.wait()


class Commands:
    """The control channel of axiscal-simulate: a command a line, an object a line back."""

    def __init__(self, path):
        self.path = str(path)

    def ask(self, command):
        with socket.socket(socket.AF_UNIX) as channel:
            channel.settimeout(READY_S)
            channel.connect(self.path)
            channel.sendall(command.encode() + b"\n")
            answer = b""
            while not answer.endswith(b"\n"):
                piece = channel.recv(65536)
                expect(piece, f"no answer to {command}")
                answer += piece
        return json.loads(answer)

    def do(self, command):
        answer = self.ask(command)
        expect(answer.get("ok"), f"{command}: {answer}")
