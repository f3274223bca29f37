#!/usr/bin/env python3
"""Each profile of a sensor and each driver opens with its document and the revision that was read.

A driver is a file of drivers/ that defines an Appearance (one row of the registry). Its opening
comment, and that of each file of config/profiles, names a "Document:" (or "Documents:") and after
it a revision: a version, a state, a kernel, or the words "revision not stated".

documents_named.py SOURCE_DIR     checks the sources
documents_named.py --self-test    proves that planted openings are judged rightly
"""
import pathlib
import re
import sys

DRIVER = re.compile(r"^const Appearance \w+_appearance\{", re.M)
DOCUMENT = re.compile(r"\bDocuments?:(?P<rest>.*)", re.S)
REVISION = re.compile(r"\b(?:revisions? (?:not stated|read|\d)|Rev [A-Z]?\d|version \d|V\d|state of|kernel \d|firmware \w+_V\d)")


def opening(text, mark):
    """The comment that a file begins with, in one line."""
    lines = []
    for line in text.splitlines():
        if not line.startswith(mark):
            break
        lines.append(line[len(mark):].strip())
    return " ".join(lines)


def complaint(name, text):
    """What is wrong with the file's opening, or nothing."""
    named = DOCUMENT.search(opening(text, "#" if name.endswith(".toml") else "//"))
    if not named:
        return f'{name} does not open with "Document: maker, title, revision" of what it was written from'
    if not REVISION.search(named.group("rest")):
        return f'{name} names a document without its revision: add it, or the words "revision not stated"'
    return None


def self_test():
    planted = [
        ("a.toml", "# Sensor.\n# Document: Maker, manual, Rev A1.1\nmaker = 1\n", True),
        ("a.toml", "# Sensor.\n# Documents: Maker, manual, revision\n# not stated; another.\n", True),
        ("a.toml", "# Sensor.\n# Document: Maker, manual.\n", False),
        ("a.toml", "# Sensor, Rev A1.\n# Document: Maker, manual.\n", False),
        ("a.toml", "# Sensor.\nmaker = 1\n# Document: Maker, manual, Rev A1\n", False),
        ("a.cpp", "// Sensor.\n//\n// Document: Maker, sample (state of 2025).\n", True),
        ("a.cpp", '// Sensor.\n#include "a.hpp"\n', False),
    ]
    wrong = [nth for nth, (name, text, good) in enumerate(planted) if (complaint(name, text) is None) != good]
    for nth in wrong:
        print(f"planted sample {nth} is judged wrongly")
    return 1 if wrong else 0


def main():
    if sys.argv[1] == "--self-test":
        return self_test()
    root = pathlib.Path(sys.argv[1])
    profiles = {path: path.read_text(encoding="utf-8") for path in sorted((root / "config/profiles").glob("*.toml"))}
    sources = {path: path.read_text(encoding="utf-8") for path in sorted((root / "drivers").rglob("*.cpp"))}
    drivers = {path: text for path, text in sources.items() if DRIVER.search(text)}
    found = [wrong for path, text in {**profiles, **drivers}.items() if (wrong := complaint(str(path.relative_to(root)), text))]
    print("\n".join(found + [f"{len(profiles)} profiles, {len(drivers)} drivers"]))
    return 1 if found or not profiles or not drivers else 0


sys.exit(main())
