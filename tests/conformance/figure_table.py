#!/usr/bin/env python3
"""Every figure of analysis/README.md has a clause, a function, a case, and the origin it claims.

figure_table.py SOURCE_FOLDER            checks the tables whose first column is called Figure
figure_table.py SOURCE_FOLDER AXISCAL    and that every number of every case's result stands in such a table, or in
                                         a paragraph that begins with "Told back:"
figure_table.py --self-test              proves that planted mistakes are seen
"""
import json
import pathlib
import re
import subprocess
import sys

HEAD = ["Figure", "Clause", "Function", "Cases", "Weakest origin"]
ORIGINS = ["published", "third_party_program", "closed_form", "two_ways"]  # in falling order


def cells_of(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def rows_of(page):
    """(line number, cells) of every row below a head as above."""
    inside, rows = False, []
    for number, line in enumerate(page.splitlines(), 1):
        if not line.startswith("|"):
            inside = False
        elif cells_of(line)[0] == HEAD[0]:
            if cells_of(line) != HEAD:
                raise ValueError(f"line {number}: the head must be {' | '.join(HEAD)}")
            inside = True
        elif inside and not set(line) <= set("|-: "):
            rows.append((number, cells_of(line)))
    return rows


def quoted(cell):
    return re.findall(r"`([^`]+)`", cell)


def matches(pattern, pointer):
    """`*` stands for exactly one step; a figure may hold more below it."""
    want, have = pattern.split("/"), pointer.split("/")
    return len(want) == len(have) and all(w in ("*", h) for w, h in zip(want, have))


def row_complaints(cells, cases, sources):
    """cases: id -> document; sources: the text of analysis/."""
    if len(cells) != len(HEAD):
        return [f"has {len(cells)} cells instead of {len(HEAD)}"]
    found = [f"'{name}' is empty" for name, cell in zip(HEAD, cells) if cell in ("", "-")]
    figures, functions, ids = quoted(cells[0]), quoted(cells[2]), quoted(cells[3])
    places = [figure for figure in figures if figure.startswith("/")]
    if not places:
        found.append("names no place in the result, as `/parameters/E/value`")
    if not functions or not ids:
        found.append("needs function and case in backticks")
    for function in functions:
        if not re.search(rf"\b{re.escape(function.split('::')[-1])}\s*[(<]", sources):
            found.append(f"there is no function {function} in analysis/")
    missing = [name for name in ids if name not in cases]
    found += [f"there is no case {name}" for name in missing]
    known = [cases[name] for name in ids if name in cases]
    for place in places:
        if not any(matches(place, want["at"]) for case in known for want in case["expect"]):
            found.append(f"no case of the row expects {place}")
    if known and not missing:
        weakest = max((case["origin"] for case in known), key=ORIGINS.index)
        if cells[4] != weakest:
            found.append(f"claims {cells[4]}, its cases are at weakest {weakest}")
    return found


def complaints(page, cases, sources):
    rows = rows_of(page)
    found = [f"line {number}: {text}" for number, cells in rows for text in row_complaints(cells, cases, sources)]
    return found + ([] if rows else ["there is no table of figures"])


def numbers_of(value, place=""):
    """The place of every number below `value`."""
    steps = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for step, below in steps:
        yield from numbers_of(below, f"{place}/{str(step).replace('~', '~0').replace('/', '~1')}")
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        yield place


def known_places(page):
    cells = [cells[0] for _, cells in rows_of(page)]
    told_back = re.findall(r"^Told back:.*?(?=^\s*$|\Z)", page, re.S | re.M)
    return [place for text in cells + told_back for place in quoted(text) if place.startswith("/")]


def unknown_numbers(page, results):
    """results: id -> document; each unknown place once, indices as `*`."""
    known, found = known_places(page), {}
    for name, result in results.items():
        for place in numbers_of(result):
            if not any(matches(pattern, place) for pattern in known):
                found.setdefault(re.sub(r"/\d+(?=/|$)", "/*", place), name)
    return [f"{place} (as in {name}) stands in no row" for place, name in sorted(found.items())]


def results_of(axiscal, cases):
    results = {}
    for name, case in cases.items():
        ran = subprocess.run([axiscal, "analyze", "-"], input=json.dumps(case["case"]), text=True,
                             capture_output=True, timeout=120, check=True)
        results[name] = json.loads(ran.stdout)
    return results


def load(root):
    folder = root / "tests/reference/conformance"
    cases = {path.stem: json.loads(path.read_text(encoding="utf-8")) for path in sorted(folder.glob("*.json"))}
    files = [path for path in sorted((root / "analysis").rglob("*.[ch]pp"))]
    return ((root / "analysis/README.md").read_text(encoding="utf-8"), cases,
            "\n".join(path.read_text(encoding="utf-8") for path in files))


def self_test():
    head = f"| {' | '.join(HEAD)} |\n|---|---|---|---|---|\n"
    cases = {"one": {"origin": "published", "expect": [{"at": "/a/0/b"}]},
             "two": {"origin": "two_ways", "expect": [{"at": "/c"}]}}
    right = "| b `/a/*/b`, c `/c` | 1 | `make` | `one`, `two` | two_ways |"
    planted = {"empty": right.replace("| 1 |", "|  |"), "origin": right.replace("| two_ways", "| published"),
               "function": right.replace("make", "bake"), "case": right.replace("`two`", "`three`"),
               "place": right.replace("`/c`", "`/d`"), "short": "| b `/a/*/b` | 1 | `make` |", "none": "no table at all",
               "deeper": right.replace("/a/*/b", "/a/*"), "nowhere": right.replace("`/a/*/b`", "").replace("`/c`", "")}
    seen = {name: complaints(head + row if name != "none" else row, cases, "int make(int x);")
            for name, row in planted.items()}
    missed = [name for name, found in seen.items() if not found]
    missed += complaints(head + right, cases, "int make(int x);")
    page, result = head + right + "\n\nTold back: `/t`,\n`/u/*`.\n\nnot `/v`\n", {"t": 1, "u": [2, 3], "a": [{"b": 4}]}
    missed += unknown_numbers(page, {"x": {**result, "c": 5, "text": "6", "flag": True}})
    seen = unknown_numbers(page, {"x": {**result, "v": 7, "a": [{"b": 4, "q": 8}, {"b": 4, "q": 8}]}})
    missed += [] if [text.split()[0] for text in seen] == ["/a/*/q", "/v"] else [f"numbers: {seen}"]
    print("missed:", missed)
    return missed


def main():
    if sys.argv[1] == "--self-test":
        return 1 if self_test() else 0
    page, cases, sources = load(pathlib.Path(sys.argv[1]))
    found = complaints(page, cases, sources)
    if len(sys.argv) > 2:
        found += unknown_numbers(page, results_of(sys.argv[2], cases))
    print("\n".join(found) or f"{len(rows_of(page))} rows hold: figure, clause, function, case, origin")
    return 1 if found else 0


sys.exit(main())
