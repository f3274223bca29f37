"""What this computer adds to any figure by itself; told beside every row of tests/bench."""
import contextlib
import os
import time


def last_processor():
    """The one that rows are pinned to: the first takes most interrupts."""
    return os.cpu_count() - 1


def idle_stall_ns(cpu, seconds=2):
    """How late a sleep of 1 ms ended at worst on this processor in so many seconds."""
    affinity = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {int(cpu)})
    worst, end = 0, time.monotonic_ns() + int(seconds * 1e9)
    while (before := time.monotonic_ns()) < end:
        time.sleep(0.001)
        worst = max(worst, time.monotonic_ns() - before - 1_000_000)
    os.sched_setaffinity(0, affinity)
    return worst


def time_text(ns):
    for size, unit in ((1e9, "s"), (1e6, "ms"), (1e3, "us")):
        if ns >= size:
            return f"{ns / size:.3g} {unit}"
    return f"{ns:.3g} ns"


@contextlib.contextmanager
def told(cpu, what="", pinned=False):
    """Prints load and stall from before and after the block, once it has ended well. Where `pinned`, this process and what it
    starts in the block run on that processor alone."""
    load, before, affinity = os.getloadavg()[0], idle_stall_ns(cpu), os.sched_getaffinity(0)
    if pinned:
        os.sched_setaffinity(0, {int(cpu)})
    try:
        yield
    finally:
        os.sched_setaffinity(0, affinity)
    print(f"{what}load of the computer (1 min): {load:.1f} before, {os.getloadavg()[0]:.1f} after; its own stall: a sleep of 1 ms ended "
          f"{time_text(before)} late at worst before, {time_text(idle_stall_ns(cpu))} after")
