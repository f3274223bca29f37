#!/usr/bin/env python3
"""One table of what tests/bench measured, in one run: name, this, limit, best peer, ratio, goal.

table.py BENCH_PROGRAM CPU SECONDS PEERS_FOLDER|- [FILTER]

Everything is pinned to one processor. Of interleaved repetitions the fastest counts: on a computer that others use, too, it
is the one least disturbed. A peer is a program in PEERS_FOLDER that is given FILTER and prints a JSON line a figure:
{"row": name, "peer": what, "ns": number}, with "part": true where it does but part of the job, or
{"peer": what, "not_run": reason}.
"""
import json
import os
import pathlib
import platform
import re
import subprocess
import sys
import time

REPETITIONS = 9


def machine():
    """What the numbers are of: no name, no date."""
    fields = {}
    for line in pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
        key, _, value = line.partition(":")
        fields.setdefault(key.strip(), value.strip())
    compiler = subprocess.run(["g++", "-dumpfullversion"], capture_output=True, text=True, check=False).stdout.strip()
    return (f"{fields.get('model name', platform.machine())}, {fields.get('cache size', '?')} cache, {os.cpu_count()} processors, "
            f"kernel {platform.release().split('-')[0]}, g++ {compiler}")


def run_ours(program, cpu, seconds, wanted):
    command = ["taskset", "-c", cpu, program, "--benchmark_format=json", f"--benchmark_min_time={seconds}",
               f"--benchmark_repetitions={REPETITIONS}", "--benchmark_enable_random_interleaving=true",
               f"--benchmark_filter={wanted}"]
    ran = subprocess.run(command, capture_output=True, text=True, check=False)
    if ran.returncode != 0:
        sys.exit(f"{program} ended with {ran.returncode}: {ran.stderr.strip()}")
    rows = {}
    for one in sorted(json.loads(ran.stdout)["benchmarks"], key=lambda one: one["family_index"]):
        if one["run_type"] != "iteration":
            continue
        name, kind = one["run_name"].removesuffix("/manual_time").rsplit("/", 1)
        row = rows.setdefault(name, {"peers": [], "parts": []})
        row[kind] = min(row.get(kind, float("inf")), one["real_time"])
        row[kind + " label"] = one.get("label", "")
        row.update({key: one[key] for key in ("goal_ratio", "goal_ms", "goal_numpy", "goal_peer")})
    for row in rows.values():
        if "peer" in row:
            row["peers"].append((row["peer"], row["peer label"]))
    return rows


def run_peers(folder, cpu, wanted, rows):
    """Every peer joins its row; what did not run is told."""
    told = []
    for script in sorted(set(folder.glob("*.py")) - set(folder.glob("bench_*.py"))):
        ran = subprocess.run(["taskset", "-c", cpu, "/usr/bin/python3", "-B", script, wanted], capture_output=True, text=True, check=False)
        if ran.returncode != 0:
            told.append(f"{script.name} did not run: {ran.stderr.strip().splitlines()[-1:]}")
        for line in ran.stdout.splitlines():
            found = json.loads(line)
            if "not_run" in found:
                told.append(f"{found['peer']} did not run: {found['not_run']}")
            elif found["row"] in rows:
                rows[found["row"]]["parts" if found.get("part") else "peers"].append((found["ns"], found["peer"]))
    return told


def idle_stall_ns(cpu):
    """How late a sleep of 1 ms ended at worst in two seconds: what this computer adds to any figure by itself."""
    affinity = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {int(cpu)})
    worst, end = 0, time.monotonic_ns() + 2_000_000_000
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


def goals_of(row):
    """(what, whether it is met; None: not measured)"""
    ours = row["this"]
    if row["goal_ratio"]:
        yield f"<= {row['goal_ratio']:g} x limit", ours <= row["goal_ratio"] * row["limit"]
    if row["goal_ms"]:
        yield f"<= {row['goal_ms']:g} ms", ours <= row["goal_ms"] * 1e6
    if row["goal_numpy"]:
        numpy = min((ns for ns, peer in row["peers"] if peer.startswith("numpy")), default=None)
        yield f">= {row['goal_numpy']:g} x numpy", None if numpy is None else numpy >= row["goal_numpy"] * ours
    if row["goal_peer"]:
        yield f"not slower than {row['peer label']}", ours <= row["peer"]


def cells(name, row):
    ours, limit, peer = row["this"], row.get("limit"), min(row["peers"], default=None)
    words = {True: "", False: " MISSED", None: " (not measured)"}
    return [name, time_text(ours), f"{time_text(limit)} ({row['limit label']})" if limit else "-",
            f"{time_text(peer[0])} ({peer[1]}), {peer[0] / ours:.3g} x" if peer else "-",
            f"{ours / limit:.2f}" if limit else "-", ", ".join(goal + words[met] for goal, met in goals_of(row)) or "-"]


def other_peers(rows):
    """Those behind the best one, and those that do but a part of the job."""
    return [f"{name}: {peer} {time_text(ns)}, {ns / row['this']:.3g} x"
            for name, row in rows.items() for ns, peer in sorted(row["peers"])[1:] + sorted(row["parts"])]


def main():
    program, cpu, seconds, peers = sys.argv[1:5]
    wanted = sys.argv[5] if len(sys.argv) > 5 else "."
    print(f"{machine()}; pinned to processor {cpu}, fastest of {REPETITIONS} interleaved repetitions")
    begin, stalls = os.getloadavg()[0], [idle_stall_ns(cpu)]
    rows = run_ours(program, cpu, seconds, wanted)
    told = run_peers(pathlib.Path(peers), cpu, wanted, rows) if peers != "-" else ["peers did not run: tools/bench --peers"]
    stalls.append(idle_stall_ns(cpu))
    print(f"load of the computer (1 min): {begin:.1f} before, {os.getloadavg()[0]:.1f} after; its own stall: a sleep of 1 ms ended "
          f"{time_text(stalls[0])} late at worst before, {time_text(stalls[1])} after")
    head = ["name", "this", "limit", "best peer", "ratio", "goal"]
    table = [head, ["---"] * len(head), *(cells(name, row) for name, row in rows.items())]
    widths = [max(map(len, column)) for column in zip(*table)]
    for line in table:
        print("| " + " | ".join(cell.ljust(width) for cell, width in zip(line, widths)) + " |")
    print("\n".join([*other_peers(rows), *told]))
    return 1 if any("MISSED" in line[-1] for line in table) else 0


sys.exit(main())
