#!/usr/bin/env python3
"""What makes the truth never links what finds it: the simulated machine shares quantity/ only.

truth_is_apart.py SOURCE_DIR   checks every #include and every linked target of tools/axiscal-simulate
truth_is_apart.py --self-test  proves that planted violations are seen
"""
import pathlib
import posixpath
import re
import sys

HOME = "tools/axiscal-simulate"
HOUSE = ("analysis/", "config/", "drivers/", "acquisition/", "tools/", "tests/")
TARGETS = {"axiscal_options", "axiscal_quantity", "axiscal_simulated", "axiscal_describe"}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.M)


def complaints(path, text):
    """path: inside the tree, with forward slashes."""
    if path.endswith("CMakeLists.txt"):
        links = " ".join(re.findall(r"target_link_libraries\(([^)]*)\)", text))
        for target in re.findall(r"\baxiscal_\w+", links):
            if target not in TARGETS:
                yield f"{path}: links {target}"
        return
    for included in INCLUDE.findall(text):
        beside = posixpath.normpath(posixpath.join(posixpath.dirname(path), included))
        reached = beside if included.startswith(".") else included
        if reached.startswith(("analysis/quantity/", "tools/describe/", HOME + "/")):
            continue
        if reached.startswith(HOUSE) or ".." in reached or reached.startswith("/"):
            yield f"{path}: includes {included}"


def self_test():
    planted = {
        HOME + "/a.cpp": '#include "analysis/air/air_refraction.hpp"\n',
        HOME + "/b.cpp": '#  include <drivers/sample.hpp>\n',
        HOME + "/wire/c.cpp": '#include "../../../config/settings.hpp"\n',
        HOME + "/d.hpp": '#include "acquisition/program/part_program.hpp"\n',
        HOME + "/CMakeLists.txt": "target_link_libraries(x PUBLIC axiscal_quantity axiscal_drivers)\n",
    }
    missed = [path for path, text in planted.items() if not list(complaints(path, text))]
    fine = list(complaints(HOME + "/e.cpp", '#include "analysis/quantity/result.hpp"\n#include "wire/pty.hpp"\n'))
    fine += complaints(HOME + "/CMakeLists.txt", "target_link_libraries(x PUBLIC axiscal_quantity)\n")
    print("missed:", missed, "false alarms:", fine)
    return 1 if missed or fine else 0


def main():
    if sys.argv[1] == "--self-test":
        return self_test()
    root = pathlib.Path(sys.argv[1])
    files = [f for f in sorted((root / HOME).rglob("*")) if f.suffix in (".hpp", ".cpp") or f.name == "CMakeLists.txt"]
    found = [c for f in files for c in complaints(f.relative_to(root).as_posix(), f.read_text(encoding="utf-8"))]
    print("\n".join(found) or f"{len(files)} files keep the truth apart")
    return 1 if found or len(files) < 20 else 0


sys.exit(main())
