#!/usr/bin/env python3
"""One table of what tests/bench measured, in one run: name, this, limit, best peer, ratio, goal.

table.py BENCH_PROGRAM CPU SECONDS PEERS_FOLDER|- [FILTER]

Everything is pinned to one processor. Of interleaved repetitions the fastest counts: on a computer that others use, too, it
is the one least disturbed. A peer is a program in PEERS_FOLDER that prints a JSON line a figure:
{"row": name, "peer": what, "ns": number} or {"peer": what, "not_run": reason}.
"""
import json
import pathlib
import re
import subprocess
import sys


def run_ours(program, cpu, seconds, wanted):
    command = ["taskset", "-c", cpu, program, "--benchmark_format=json", f"--benchmark_min_time={seconds}",
               "--benchmark_repetitions=9", "--benchmark_enable_random_interleaving=true", f"--benchmark_filter={wanted}"]
    ran = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=True)
    rows = {}
    for one in json.loads(ran.stdout)["benchmarks"]:
        if one["run_type"] != "iteration":
            continue
        name, kind = one["run_name"].rsplit("/", 1)
        row = rows.setdefault(name, {})
        row[kind] = min(row.get(kind, float("inf")), one["real_time"])
        if kind == "this":
            row.update(goal_ratio=one["goal_ratio"], goal_ms=one["goal_ms"], limit_name=one["label"])
    return rows


def run_peers(folder, cpu, wanted, rows):
    """The fastest peer joins each row; what did not run is told."""
    told = []
    for script in sorted(folder.glob("*.py")):
        ran = subprocess.run(["taskset", "-c", cpu, "/usr/bin/python3", "-B", script, wanted], capture_output=True, text=True, check=False)
        if ran.returncode != 0:
            told.append(f"{script.name} did not run: {ran.stderr.strip().splitlines()[-1:]}")
        for line in ran.stdout.splitlines():
            found = json.loads(line)
            if "not_run" in found:
                told.append(f"{found['peer']} did not run: {found['not_run']}")
            elif found["row"] in rows:
                row = rows[found["row"]]
                row["peers"] = [*row.get("peers", []), (found["ns"], found["peer"])]
    return told


def time_text(ns):
    for size, unit in ((1e9, "s"), (1e6, "ms"), (1e3, "us")):
        if ns >= size:
            return f"{ns / size:.3g} {unit}"
    return f"{ns:.3g} ns"


def cells(name, row):
    ours, limit = row["this"], row.get("limit")
    peer = min(row.get("peers", []), default=None)
    if row["goal_ratio"]:
        goal, met = f"<= {row['goal_ratio']:g} x", ours <= row["goal_ratio"] * limit
    elif row["goal_ms"]:
        goal, met = f"<= {row['goal_ms']:g} ms", ours <= row["goal_ms"] * 1e6
    else:
        goal, met = "-", True
    return [name, time_text(ours), f"{time_text(limit)} ({row['limit_name']})" if limit else "-",
            f"{time_text(peer[0])} ({peer[1]}), {peer[0] / ours:.3g} x" if peer else "-",
            f"{ours / limit:.2f}" if limit else "-", goal + ("" if met else "  MISSED")]


def main():
    program, cpu, seconds, peers = sys.argv[1:5]
    wanted = sys.argv[5] if len(sys.argv) > 5 else "."
    rows = run_ours(program, cpu, seconds, wanted)
    told = run_peers(pathlib.Path(peers), cpu, wanted, rows) if peers != "-" else ["peers did not run: tools/bench --peers"]
    table = [["name", "this", "limit", "best peer", "ratio", "goal"], *(cells(name, row) for name, row in rows.items())]
    widths = [max(map(len, column)) for column in zip(*table)]
    for line in table:
        print(" | ".join(cell.ljust(width) for cell, width in zip(line, widths)).rstrip())
    for line in told:
        print(line)
    return 1 if any(re.search("MISSED", line[-1]) for line in table) else 0


sys.exit(main())
