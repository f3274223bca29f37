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

import stall
from stall import time_text

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


def benchmarks(program, cpu, words):
    """([figures], why it did not end well or None) of one process; no figures where it died before it had told them."""
    ran = subprocess.run(["taskset", "-c", cpu, program, *words], capture_output=True, text=True, check=False)
    said = ran.stderr.strip().splitlines()[-1:]
    died = f"ended with {ran.returncode} {' '.join(said)}".rstrip() if ran.returncode != 0 else None
    try:
        return json.loads(ran.stdout)["benchmarks"], died
    except (ValueError, KeyError):
        return [], died or "told no figures"


def names_of_rows(program, wanted):
    """Each with its works: NAME/this, NAME/limit, ..."""
    listed = subprocess.run([program, "--benchmark_list_tests=true", f"--benchmark_filter={wanted}"], capture_output=True, text=True, check=True)
    works = [line.removesuffix("/manual_time") for line in listed.stdout.splitlines() if "/" in line]
    return list(dict.fromkeys(work.rsplit("/", 1)[0] for work in works))


def run_ours(program, cpu, seconds, wanted):
    """(rows, [what did not end well]). All in one process, whose order is random; where it died in the middle each row is run in a
    process of its own, so that one row cannot take the others with it."""
    words = ["--benchmark_format=json", f"--benchmark_min_time={seconds}", f"--benchmark_repetitions={REPETITIONS}",
             "--benchmark_enable_random_interleaving=true"]
    found, died = benchmarks(program, cpu, [*words, f"--benchmark_filter={wanted}"])
    told = [f"{program} {died}"] if died else []
    if died and not found:
        for name in names_of_rows(program, wanted):
            of_row, died = benchmarks(program, cpu, [*words, f"--benchmark_filter=^{re.escape(name)}/"])
            found += of_row
            if died:
                told.append(f"{name}: {died}")
    return rows_of(found), told


def rows_of(found):
    rows = {}
    for one in sorted(found, key=lambda one: one["family_index"]):
        if one["run_type"] != "iteration":
            continue
        name, kind = one["run_name"].removesuffix("/manual_time").rsplit("/", 1)
        row = rows.setdefault(name, {"peers": [], "parts": []})
        row[kind] = one["count"] if kind == "count" else min(row.get(kind, float("inf")), one["real_time"])
        row[kind + " label"] = one.get("label", "")
        row.update({key: one[key] for key in ("goal_ratio", "goal_ms", "goal_numpy", "goal_peer", "goal_count") if key in one})
    for row in rows.values():
        if "peer" in row:
            row["peers"].append((row["peer"], row["peer label"]))
    return {name: row for name, row in rows.items() if "this" in row or "count" in row}


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


def goals_of(row):
    """(what, whether it is met; None: not measured)"""
    if "count" in row:
        yield f"<= {row['goal_count']:g} {row['count label']}", row["count"] <= row["goal_count"]
        return
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
    words = {True: "", False: " MISSED", None: " (not measured)"}
    goals = ", ".join(goal + words[met] for goal, met in goals_of(row)) or "-"
    if "count" in row:
        return [name, f"{row['count']:.3g} {row['count label']}", "-", "-", "-", goals]
    ours, limit, peer = row["this"], row.get("limit"), min(row["peers"], default=None)
    return [name, time_text(ours), f"{time_text(limit)} ({row['limit label']})" if limit else "-",
            f"{time_text(peer[0])} ({peer[1]}), {peer[0] / ours:.3g} x" if peer else "-",
            f"{ours / limit:.2f}" if limit else "-", goals]


def other_peers(rows):
    """Those behind the best one, and those that do but a part of the job."""
    return [f"{name}: {peer} {time_text(ns)}, {ns / row['this']:.3g} x"
            for name, row in rows.items() for ns, peer in sorted(row["peers"])[1:] + sorted(row["parts"])]


def main():
    program, cpu, seconds, peers = sys.argv[1:5]
    wanted = sys.argv[5] if len(sys.argv) > 5 else "."
    print(f"{machine()}; pinned to processor {cpu}, fastest of {REPETITIONS} interleaved repetitions")
    with stall.told(cpu):
        rows, died = run_ours(program, cpu, seconds, wanted)
        told = run_peers(pathlib.Path(peers), cpu, wanted, rows) if peers != "-" else ["peers did not run: tools/bench --peers"]
    head = ["name", "this", "limit", "best peer", "ratio", "goal"]
    table = [head, ["---"] * len(head), *(cells(name, row) for name, row in rows.items())]
    widths = [max(map(len, column)) for column in zip(*table)]
    for line in table:
        print("| " + " | ".join(cell.ljust(width) for cell, width in zip(line, widths)) + " |")
    print("\n".join([*other_peers(rows), *told, *died]))
    return 1 if died or any("MISSED" in line[-1] for line in table) else 0


sys.exit(main())
