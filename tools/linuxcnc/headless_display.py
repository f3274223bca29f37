#!/usr/bin/python3
"""LinuxCNC's "display" without a screen: starts the position stream, homes, runs [DISPLAY]OPEN_FILE
and ends; LinuxCNC then shuts down. Exit 0: the program came to its end without a word of error.

What happened is appended to the file [BENCH]EVENTS, a line each: homed, waiting X (the program
waits for `axiscal arm` at its datum), message TEXT (the program's), error TEXT, ended. SIGTERM stops
the axis and ends."""
import errno
import fcntl
import os
import signal
import subprocess
import sys
import time

import linuxcnc  # of the package; only the system's own Python has it

START_LIMIT_S = 20  # of each step before the program runs
REPEAT_S = 1
POLL_S = 0.005


class Cnc:
    def __init__(self, settings):
        self.events = open(settings.find("BENCH", "EVENTS"), "a", buffering=1)
        self.command = linuxcnc.command()
        self.status = linuxcnc.stat()
        self.complaints = linuxcnc.error_channel()
        self.failed = False

    def tell(self, words):
        self.events.write(words + "\n")

    def look(self):
        self.status.poll()
        while complaint := self.complaints.poll():
            kind, text = complaint
            wrong = kind in (linuxcnc.NML_ERROR, linuxcnc.OPERATOR_ERROR)
            self.tell(f"{'error' if wrong else 'message'} {text.strip()}")
            self.failed = self.failed or wrong

    def order(self, command, reached, what):
        """Gives a command, again each second: a busy computer may drop one."""
        end = time.monotonic() + START_LIMIT_S
        again = 0
        while not reached(self.status):
            now = time.monotonic()
            if now > end:
                self.tell(f"error never came: {what}")
                sys.exit(1)
            if now > again:
                command()
                again = now + REPEAT_S
            time.sleep(POLL_S)
            self.look()

    def make_ready(self):
        give = self.command
        self.look()
        self.order(lambda: give.state(linuxcnc.STATE_ESTOP_RESET),
                   lambda s: s.task_state in (linuxcnc.STATE_ESTOP_RESET, linuxcnc.STATE_OFF,
                                              linuxcnc.STATE_ON), "emergency stop released")
        self.order(lambda: give.state(linuxcnc.STATE_ON),
                   lambda s: s.task_state == linuxcnc.STATE_ON, "machine on")
        self.order(lambda: give.mode(linuxcnc.MODE_MANUAL),
                   lambda s: s.task_mode == linuxcnc.MODE_MANUAL, "manual mode")
        self.order(lambda: give.home(-1), lambda s: all(s.homed[:s.joints]), "homed")
        self.tell("homed")

    def run(self, program):
        give = self.command
        self.order(lambda: give.mode(linuxcnc.MODE_AUTO),
                   lambda s: s.task_mode == linuxcnc.MODE_AUTO, "automatic mode")
        self.order(lambda: give.program_open(program), lambda s: s.file == program, "program loaded")
        give.auto(linuxcnc.AUTO_RUN, 0)  # never twice: it would run again
        self.order(lambda: None, lambda s: s.interp_state != linuxcnc.INTERP_IDLE, "program started")
        waited = False
        while self.status.interp_state != linuxcnc.INTERP_IDLE and not self.failed:
            if self.status.input_timeout and not waited:  # the first M66
                waited = True
                self.tell(f"waiting {self.status.joint_actual_position[0]:.4f}")
            time.sleep(POLL_S)
            self.look()
        self.tell("ended")


def start_stream(path):
    """halsampler writes its lines into the named pipe; line buffered, else they come in lumps."""
    try:
        pipe = os.open(path, os.O_WRONLY | os.O_NONBLOCK)
    except OSError as problem:
        if problem.errno == errno.ENXIO:
            sys.exit(f"nobody reads the positions: start the simulator with --positions {path} first")
        raise
    fcntl.fcntl(pipe, fcntl.F_SETFL, fcntl.fcntl(pipe, fcntl.F_GETFL) & ~os.O_NONBLOCK)
    sampler = subprocess.Popen(["stdbuf", "-oL", "halsampler", "-t"], stdin=subprocess.DEVNULL,
                               stdout=pipe)
    os.close(pipe)
    return sampler


def main():
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    settings = linuxcnc.ini(sys.argv[sys.argv.index("-ini") + 1])
    with open(settings.find("BENCH", "PID"), "w") as file:
        file.write(f"{os.getpid()}\n")
    cnc = Cnc(settings)
    positions = settings.find("BENCH", "POSITIONS")
    sampler = start_stream(positions) if positions else None
    try:
        cnc.make_ready()
        cnc.run(settings.find("DISPLAY", "OPEN_FILE"))
    finally:
        cnc.command.abort()
        if sampler:
            sampler.terminate()
            sampler.wait()
    return 1 if cnc.failed else 0


sys.exit(main())
