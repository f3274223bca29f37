#!/usr/bin/env python3
"""Cairo and Pango live in the short-lived report process: no other program may load them, directly or through another library.

one_drawing_program.py BUILD_DIR | one_drawing_program.py --self-test
"""
import pathlib
import re
import subprocess
import sys

MAY = {"axiscal-report", "report_tests"}
MUST = "axiscal-report"   # else this guard would see nothing
HELD = "axiscald"         # the program that the rule is about
LIBRARY = re.compile(r"libcairo|libpango")


def complaints(loads):
    """loads: program -> what ldd says of it."""
    found = [f"{name} loads {LIBRARY.search(said).group()}: drawing belongs to {MUST}, a process of its own"
             for name, said in sorted(loads.items()) if name not in MAY and LIBRARY.search(said)]
    if not LIBRARY.search(loads.get(MUST, "")):
        found.append(f"{MUST} does not load Cairo: this guard would see nothing")
    if "libc.so" not in loads.get(HELD, ""):
        found.append(f"{HELD} is not there, or ldd tells nothing of it: build it first")
    return found


def loads_of(folder):
    loads = {}
    for file in folder.iterdir():
        if file.is_file() and file.read_bytes()[:4] == b"\x7fELF":
            loads[file.name] = subprocess.run(["ldd", file], capture_output=True, text=True, check=False).stdout
    return loads


def self_test():
    plain = "libc.so.6 => /lib/libc.so.6\n"
    cairo, pango = plain + "libcairo.so.2 => /lib/libcairo.so.2\n", plain + "libpango-1.0.so.0 => /lib/libpango-1.0.so.0\n"
    cases = [({MUST: cairo, HELD: plain}, 0), ({MUST: cairo, HELD: cairo}, 1), ({MUST: cairo, HELD: pango}, 1),
             ({MUST: cairo, HELD: plain, "axiscal-publish": pango}, 1), ({MUST: plain, HELD: plain}, 1),
             ({MUST: cairo}, 1), ({MUST: cairo, HELD: "not a dynamic executable"}, 1), ({}, 2)]
    return [f"{loads}: {complaints(loads)}" for loads, wanted in cases if len(complaints(loads)) != wanted]


def main():
    if sys.argv[1] == "--self-test":
        found = self_test()
    else:
        loads = loads_of(pathlib.Path(sys.argv[1]) / "bin")
        found = complaints(loads)
        print(f"{len(loads)} programs looked at")
    print("\n".join(found) or "one program draws")
    return 1 if found else 0


sys.exit(main())
