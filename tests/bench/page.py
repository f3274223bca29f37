#!/usr/bin/python3
"""Rows of tools/bench: the page at the machine, and what a client of its events costs the daemon.

page.py PROGRAM-FOLDER

The station measures on the simulated machine of tests/simulation; the CNC holds in mid-run, the laser goes on. "First screen" is all that
a browser asks for before the first value stands there, with the heads of HTTP, against the station's own status alone. The cost of a
client is the daemon's processor time with ten that read GET /v1/events?stream=200 (at most 20 frames a second each), less that without any,
a tenth of it; in the same run, one after the other. What twenty such clients do to the CNC is the round trip of a request on its Modbus port: of a few
thousand the median and the one that 99 of 100 do not exceed, beside the twenty and without them, in turns. The page itself runs in Debian's Chromium: its heap after a collection at the
beginning and at the end of some minutes, and the processor time of all its processes: AXISCAL_BENCH_PAGE_SECONDS says how many seconds, 28800 for a
night. Of what lasts longer than ten minutes every ten are told on standard error, so that a night that is cut short has shown something.
AXISCAL_BENCH_PAGE_TIMES=N runs the page's clock and timers N times as fast and gives it each status N times, so that the growth of the heap over a
night is seen in an Nth of it. The browser draws no faster: then the heap alone is judged.
"""
import contextlib
import os
import socket
import statistics
import struct
import sys
import threading
import time
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
os.environ.setdefault("AXISCAL_SOURCE", str(SOURCE))
os.environ["AXISCAL_PATH"] = str(Path(sys.argv[1]).resolve())
sys.path[:0] = [str(SOURCE / "tests/browser")]
from page_bench import EVERY_SCREEN_IS_MADE, REPEATING, Browser, bench, in_mid_run

CLIENTS, WATCH_S = 10, float(os.environ.get("AXISCAL_BENCH_CLIENT_SECONDS", "20"))
PAGE_S = float(os.environ.get("AXISCAL_BENCH_PAGE_SECONDS", "300"))
TIMES = int(os.environ.get("AXISCAL_BENCH_PAGE_TIMES", "1"))
TOLD_S = 600
PAGES, ROUNDS, REQUESTS, MOST_SLOWER = 20, 5, 1000, 1.25
READ = struct.pack(">HHHBBHH", 1, 0, 6, 1, 3, 0, 33)  # the whole register map of the sequence-block
READ_ANSWER = 9 + 66
MOST_BYTES, MOST_FIRST_MS, MOST_CLIENT_PERCENT, MOST_PAGE_PERCENT, MOST_GROWTH_KIB = 150_000, 1000, 0.5, 10, 512
TICKS = os.sysconf("SC_CLK_TCK")


def spent_s(pids):
    """Processor time of these processes, of all their threads."""
    total = 0
    for pid in pids:
        try:
            fields = Path(f"/proc/{pid}/stat").read_text(encoding="utf-8").rsplit(")", 1)[1].split()
        except FileNotFoundError:
            continue  # ended meanwhile
        total += int(fields[11]) + int(fields[12])
    return total / TICKS


def percent_of_a_core(pids, seconds):
    before, began = spent_s(pids), time.monotonic()
    time.sleep(seconds)
    return 100 * (spent_s(pids) - before) / (time.monotonic() - began)


class Listener(threading.Thread):
    """Reads the events of the station as fast as they come."""

    def __init__(self, port):
        super().__init__(daemon=True)
        self.wire = socket.create_connection(("127.0.0.1", port))
        self.wire.sendall(b"GET /v1/events?stream=200 HTTP/1.1\r\nHost: localhost\r\n\r\n")
        self.frames = 0

    def run(self):
        with contextlib.suppress(ConnectionResetError):  # hung up on in mid-frame
            while data := self.wire.recv(1 << 16):
                self.frames += data.count(b"event: ")


def cost_of_a_client(b, port):
    """(percent of a core for each client, frames a second of one)."""
    daemon = [b.processes["axiscald"].pid]
    alone = percent_of_a_core(daemon, WATCH_S)
    listeners = [Listener(port) for _ in range(CLIENTS)]
    for one in listeners:
        one.start()
    time.sleep(1)
    before = sum(one.frames for one in listeners)
    heard = percent_of_a_core(daemon, WATCH_S)
    frames = (sum(one.frames for one in listeners) - before) / CLIENTS / WATCH_S
    for one in listeners:
        one.wire.shutdown(socket.SHUT_RDWR)
    return (heard - alone) / CLIENTS, frames


def round_trips_us(port):
    """Of requests of the CNC, one after the other, at the pace of a quick one."""
    with socket.create_connection(("127.0.0.1", port), timeout=10) as wire:
        wire.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        taken = []
        for _ in range(REQUESTS):
            began = time.perf_counter()
            wire.sendall(READ)
            rest = READ_ANSWER
            while rest > 0:
                rest -= len(wire.recv(rest)) or sys.exit("the station has hung up on the CNC")
            taken.append(1e6 * (time.perf_counter() - began))
            time.sleep(0.001)
    return taken


def beside_pages(b, port):
    """(median, 99 of 100) in us with so many clients, and the same without any."""
    alone, beside = [], []
    for _ in range(ROUNDS):
        alone += round_trips_us(b.station["trigger"]["port"])
        listeners = [Listener(port) for _ in range(PAGES)]
        for one in listeners:
            one.start()
        beside += round_trips_us(b.station["trigger"]["port"])
        for one in listeners:
            one.wire.shutdown(socket.SHUT_RDWR)
            one.join()
    return [(statistics.median(some), statistics.quantiles(some, n=100)[98]) for some in (beside, alone)]


def heap_kib(page):
    page.tell("HeapProfiler.collectGarbage")
    return page.tell("Runtime.getHeapUsage")["usedSize"] / 1024


# Notes when the first digits stand there, by the page's own clock, which begins with its address.
FIRST_VALUE = """
new MutationObserver((_, watch) => {
    if (!/[0-9]/.test(document.querySelector('#now_reading .number')?.textContent ?? '')) return;
    window.first_value_ms = performance.now();
    watch.disconnect();
}).observe(document, {childList: true, subtree: true, characterData: true});
"""


# Before the page's own: what it asks for the time, and has called later, goes so many times as quick.
QUICK = REPEATING + f"""
window.times = {TIMES};
const at_first = performance.now(), date_at_first = Date.now();
const monotonic = performance.now.bind(performance), every = window.setInterval, later = window.setTimeout;
performance.now = () => at_first + (monotonic() - at_first) * {TIMES};
Date.now = () => Math.round(date_at_first + (monotonic() - at_first) * {TIMES});
window.setInterval = (call, ms) => every(call, ms / {TIMES});
window.setTimeout = (call, ms) => later(call, ms / {TIMES});
"""


def watch(page):
    """(percent of a core, KiB that the heap grew), of all that time, which is the page's."""
    first = last = heap_kib(page)
    shares, rest_s = [], PAGE_S
    while rest_s > 0:
        part_s = min(rest_s, TOLD_S)
        rest_s -= part_s
        shares.append((part_s, percent_of_a_core(page.processes(), part_s / TIMES)))
        last = heap_kib(page)
        if PAGE_S > TOLD_S:
            print(f"after {PAGE_S - rest_s:.0f} s: {shares[-1][1]:.1f} % of a core, heap {last:.0f} KiB ({first:.0f} at first)", file=sys.stderr, flush=True)
    return sum(part_s * share for part_s, share in shares) / PAGE_S, last - first


def watch_page(address):
    """(bytes of the first screen, ms until its first value, percent of a core, KiB that the heap grew)."""
    with Browser() as page:
        page.tell("Page.addScriptToEvaluateOnNewDocument", source=FIRST_VALUE + (QUICK if TIMES > 1 else ""))
        page.open(address)
        first_ms = page.wait("the first value", lambda: page.ask("window.first_value_ms"))
        loaded = page.ask("performance.getEntriesByType('resource').concat(performance.getEntriesByType('navigation'))"
                          ".filter((one) => !one.name.includes('/v1/')).reduce((sum, one) => sum + one.transferSize, 0)")
        # What is made once is made.
        page.wait("every screen is made", lambda: page.ask(EVERY_SCREEN_IS_MADE), 120)
        time.sleep(10)
        return loaded, first_ms, *watch(page)


def row(name, this, limit, beside, ratio, goal, met):
    print(f"{name} | {this} | {limit} | {beside} | {ratio} | {goal}{'' if met else '  MISSED'}")
    return met


def row_of_heap(growth):
    return row("page: growth of its heap", f"{growth:.0f} KiB", "-", f"over {PAGE_S:.0f} s" + (f", {TIMES} times as quick" if TIMES > 1 else ""), "-",
               f"<= {MOST_GROWTH_KIB} KiB", growth <= MOST_GROWTH_KIB)


def measure(b):
    address = in_mid_run(b)
    if TIMES > 1:
        return 0 if row_of_heap(watch_page(address)[-1]) else 1
    status_bytes = len(str(b.status()))
    client, frames = cost_of_a_client(b, b.station["console"]["port"])
    (median, most), (median_alone, most_alone) = beside_pages(b, b.station["console"]["port"])
    loaded, first_ms, percent, growth = watch_page(address)
    met = [
        row("page: first screen", f"{loaded / 1000:.1f} kB", f"{status_bytes / 1000:.1f} kB (one status)", "-", f"{loaded / status_bytes:.0f}",
            f"<= {MOST_BYTES // 1000} kB", loaded <= MOST_BYTES),
        row("page: until its first value", f"{first_ms:.0f} ms", "-", "-", "-", f"<= {MOST_FIRST_MS} ms", first_ms <= MOST_FIRST_MS),
        row("page: the daemon for each client of its events", f"{client:.2f} % of a core", "-", f"{frames:.1f} frames a second", "-",
            f"<= {MOST_CLIENT_PERCENT} %", client <= MOST_CLIENT_PERCENT),
        row(f"page: a request of the CNC beside {PAGES} pages", f"{median:.0f} us", f"{median_alone:.0f} us (without pages)",
            f"99 of 100: {most:.0f} against {most_alone:.0f} us", f"{median / median_alone:.2f}", f"<= {MOST_SLOWER} x without pages",
            median <= MOST_SLOWER * median_alone),
        row("page: the browser, all processes", f"{percent:.1f} % of a core", "-", f"over {PAGE_S:.0f} s", "-", f"<= {MOST_PAGE_PERCENT} %",
            percent <= MOST_PAGE_PERCENT),
        row_of_heap(growth),
    ]
    return 0 if all(met) else 1


def main():
    with bench.Bench() as b:
        return measure(b)


if __name__ == "__main__":
    sys.exit(main())
