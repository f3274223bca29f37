#!/usr/bin/python3
"""Rows of tools/bench: the idle daemon beside a bare Asio acceptor, in the same run.

idle.py PROGRAM-FOLDER

The daemon as its unit starts it (a notify socket, a watchdog of 10 s), everything open: Modbus TCP, the console's socket and port with the page
in both of its forms, as installed, the state directory with 1000 closed runs. Its three instruments (laser, weather, thermistors on Modbus RTU) are those of the station file of
tests/simulation; none of them is plugged in. "ready" is from before the program is started until its READY=1, the fastest of some
rounds, every other one of which is the acceptor's; "at rest" is once nothing has woken for a moment: the runs were looked through and
the readings of nobody have grown old. All of it is pinned to one processor. Wake-ups are voluntary context switches of all threads.
"""
import os
import re
import select
import shutil
import socket
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

import stall

RUNS, ROUNDS, WATCHDOG_S = 1000, int(os.environ.get("AXISCAL_BENCH_ROUNDS", "9")), 10
WATCH_S = float(os.environ.get("AXISCAL_BENCH_IDLE_SECONDS", "60"))
QUIET_S, PATIENCE_S = 4, 120
MOST_RSS_KIB, MOST_WAKEUPS, MOST_READY_MS = 12 * 1024, 0.2, 20


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def instant(number):
    """A name's instant, a minute each, from noon of 2026-01-01 on."""
    return time.strftime("%Y%m%dT%H%M%SZ", time.gmtime(1767268800 + 60 * number))


def make_station(folder, source, runs):
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "state/runs").mkdir(parents=True)
    text = (source / "tests/simulation/station.toml.in").read_text(encoding="utf-8")
    for place, value in {"@SCRATCH@": str(folder), "@SHARE@": str(folder / "share"), "@PROFILES@": str(source / "config/profiles")}.items():
        text = text.replace(place, value)
    text = text.replace("port = 0\n", f"port = {free_port()}\n")
    text += f'\n[trigger]\nshape = "sequence-block"\ntransport = "tcp"\nhost = "127.0.0.1"\nport = {free_port()}\n'
    (folder / "station.toml").write_text(text, encoding="utf-8")
    for number in range(runs):
        shutil.copy(source / "tests/reference/fifty_points.axiscal", folder / f"state/runs/bench-{instant(number)}-X.axiscal")
    return folder / "station.toml"


class Program:
    """Started, and ready when it is made; ended with the block."""

    def __init__(self, words, notify=None):
        self.log = tempfile.TemporaryFile()
        environment = dict(os.environ)
        if notify:
            environment |= {"NOTIFY_SOCKET": notify.getsockname(), "WATCHDOG_USEC": str(WATCHDOG_S * 1_000_000)}
        began = time.perf_counter()
        self.process = subprocess.Popen(words, env=environment, stdout=subprocess.PIPE if not notify else self.log, stderr=self.log)
        if notify:
            while b"READY=1" not in notify.recv(4096).split(b"\n"):
                pass
            self.heard = threading.Event()
            self.ear = threading.Thread(target=self.hear, args=(notify,), daemon=True)
        else:
            self.process.stdout.readline()
        self.ready_ms = (time.perf_counter() - began) * 1e3
        if notify:
            self.ear.start()

    def hear(self, notify):
        """As systemd does: ten words that nobody takes stop the one who speaks."""
        while not self.heard.is_set():
            if select.select([notify], [], [], 0.2)[0]:
                notify.recv(4096)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait(20)
        if hasattr(self, "ear"):
            self.heard.set()
            self.ear.join()
        self.log.close()

    def status(self, key, task="self"):
        where = f"/proc/{self.process.pid}/status" if task == "self" else f"/proc/{self.process.pid}/task/{task}/status"
        found = re.search(rf"^{key}:\s+(\d+)", Path(where).read_text(encoding="utf-8"), re.M)
        return int(found.group(1))

    def switches(self):
        total = 0
        for task in os.listdir(f"/proc/{self.process.pid}/task"):
            try:
                total += self.status("voluntary_ctxt_switches", task)
            except FileNotFoundError:
                pass  # a thread that ended meanwhile
        return total

    def come_to_rest(self):
        """A watchdog is fed each six seconds; four without a waking are rest."""
        end = time.monotonic() + PATIENCE_S
        while True:
            before = self.switches()
            time.sleep(QUIET_S)
            if self.switches() == before:
                return True
            if time.monotonic() > end:
                return False

    def wakeups(self):
        before, began = self.switches(), time.monotonic()
        time.sleep(WATCH_S)
        return (self.switches() - before) / (time.monotonic() - began)


def rest_of(program):
    rested = program.come_to_rest()
    wakeups = program.wakeups()
    return {"rss": program.status("VmRSS"), "threads": program.status("Threads"), "wakeups": wakeups, "rested": rested}


def measure(programs, source, folder, notify):
    acceptor = [programs / "axiscal_bench_acceptor"]
    best = {}

    def keep(name, ms):
        best[name] = min(best.get(name, float("inf")), ms)

    for runs in (0, RUNS):
        daemon = [programs / "axiscald", "--config", make_station(folder / "station", source, runs)]
        for _ in range(ROUNDS):
            with Program(acceptor) as floor:
                keep("floor", floor.ready_ms)
            with Program(daemon, notify) as station:
                keep(f"ready {runs}", station.ready_ms)
    with Program(daemon, notify) as station:
        at_rest = rest_of(station)
    with Program(acceptor) as floor:
        floor_at_rest = rest_of(floor)
    return best, at_rest, floor_at_rest


def main():
    programs, source = Path(sys.argv[1]).resolve(), Path(__file__).resolve().parents[2]
    with tempfile.TemporaryDirectory(prefix="axiscal-idle-") as name, socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as notify:
        notify.bind(f"{name}/notify")
        notify.settimeout(60)
        with stall.told(stall.last_processor(), "idle, pinned: ", pinned=True):
            best, rest, floor = measure(programs, source, Path(name), notify)

    def verdict(met):
        return "" if met else "  MISSED"
    ready, mib = best[f"ready {RUNS}"], rest["rss"] / 1024
    goals = [ready <= MOST_READY_MS, rest["rss"] <= MOST_RSS_KIB, rest["wakeups"] <= MOST_WAKEUPS and rest["rested"]]
    print(f"idle daemon: ready with {RUNS} stored runs | {ready:.1f} ms | {best['floor']:.1f} ms (bare Asio acceptor) | "
          f"with none {best['ready 0']:.1f} ms | {ready / best['floor']:.1f} | <= {MOST_READY_MS} ms{verdict(goals[0])}")
    print(f"idle daemon: resident | {mib:.1f} MiB | {floor['rss'] / 1024:.1f} MiB (bare Asio acceptor) | {rest['threads']} threads | "
          f"{rest['rss'] / floor['rss']:.1f} | <= {MOST_RSS_KIB // 1024} MiB{verdict(goals[1])}")
    print(f"idle daemon: wake-ups a second, no device plugged in | {rest['wakeups']:.3f} | {floor['wakeups']:.3f} (bare Asio acceptor) | "
          f"{'at rest' if rest['rested'] else 'never at rest'}, over {WATCH_S:.0f} s | - | <= {MOST_WAKEUPS}{verdict(goals[2])}")
    return 0 if all(goals) else 1


if __name__ == "__main__":
    sys.exit(main())
