#!/usr/bin/env python3
"""No program throws for one byte that is no text: nlohmann's dump() does, unless it is told to replace it.

Product code writes JSON by json_text (config/json_text.hpp); another call of dump() names
error_handler_t::replace itself.

json_writers.py SOURCE_DIR     checks the sources
json_writers.py --self-test    proves that planted mistakes are seen
"""
import pathlib
import re
import sys

ROOMS = ("acquisition", "analysis", "config", "drivers", "tools/axiscal", "tools/axiscal-report")
# Asks whether a text is one: that dump() throws is its answer.
ASKS = {"tools/axiscal/cases/separation_csv.cpp"}
CALL = re.compile(r"\.dump\(([^;]*);", re.S)


def bare_calls(text):
    """Numbers of the lines that begin a dump() which throws."""
    return [text.count("\n", 0, call.start()) + 1
            for call in CALL.finditer(text) if "error_handler_t::replace" not in call.group(1)]


def main():
    if sys.argv[1] == "--self-test":
        good = "x = j.dump(-1, ' ', false,\n  Json::error_handler_t::replace) + y;"
        return 0 if bare_calls("a;\nb = j.dump();\n" + good) == [2] and not bare_calls(good) else 1
    root = pathlib.Path(sys.argv[1])
    files = [path for room in ROOMS for path in sorted((root / room).rglob("*.[ch]pp"))]
    found = [f"{name}:{line} may throw: write json_text(...)" for path in files
             for name in [str(path.relative_to(root))] if name not in ASKS
             for line in bare_calls(path.read_text(encoding="utf-8"))]
    print("\n".join(found))
    print(f"{len(files)} files read")
    return 1 if found or not files else 0


sys.exit(main())
