#!/usr/bin/env python3
"""Every thread of the product stands in the table "Threads" of docs/reliability.md, with its test.

A file that makes a thread (std::thread, std::jthread, std::async, pthread_create, a thread pool, or
Asio's resolver, which has a thread of its own) must be named there; each named suite must exist in a
source that the lane `threads` builds (tests/threads/CMakeLists.txt); `Kernel.Boot.*` must be a boot.

thread_fences.py SOURCE_DIR     checks the sources
thread_fences.py --self-test    proves that planted mistakes are seen
"""
import pathlib
import re
import sys

FOLDERS = ("acquisition", "analysis", "config", "drivers", "tools")
NOISE = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.S)
MAKES_ONE = re.compile(r"\bstd::(?:thread|jthread)\b(?!\s*::)|\bstd::async\b|\bpthread_create\b"
                       r"|\bthread_pool\b|\basync_resolve\b")
SUITE = re.compile(r"\bTEST(?:_F|_P)?\(\s*(\w+)\s*,")
NAMED_FILE = re.compile(r"`([\w./-]+\.(?:cpp|hpp))`")
NAMED_TEST = re.compile(r"`([A-Z]\w*(?:\.\w+)*)(?:\.\*)?`")


def makes_thread(source):
    return MAKES_ONE.search(NOISE.sub(" ", source)) is not None


def rows_of(document):
    """The table's rows: the files of the first cell and the tests of the last."""
    section = re.search(r"^## Threads\n(.*?)(?=^## |\Z)", document, re.S | re.M)
    rows = []
    for line in section.group(1).splitlines() if section else []:
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if line.startswith("|") and NAMED_FILE.search(cells[0]):
            rows.append((NAMED_FILE.findall(cells[0]), NAMED_TEST.findall(cells[-1])))
    return rows


def complaints(owners, document, suites, boots):
    """owners: files that make a thread; suites: those of the lane; boots: names of boot_*.py."""
    rows = rows_of(document)
    named = {file for files, _ in rows for file in files}
    for file in sorted(set(owners) - named):
        yield f"{file} makes a thread that the table \"Threads\" of docs/reliability.md does not name"
    for file in sorted(named - set(owners)):
        yield f"docs/reliability.md: {file} makes no thread"
    for files, tests in rows:
        if not tests:
            yield f"docs/reliability.md: no test for the thread of {files[0]}"
        for test in tests:
            known = test[len("Kernel.Boot."):] in boots if test.startswith("Kernel.Boot.") else test in suites
            if not known:
                yield f"docs/reliability.md: the lane threads has no test {test} (thread of {files[0]})"


def suites_of_lane(root):
    folder = root / "tests/threads"
    sources = re.findall(r"[\w./]+\.cpp", (folder / "CMakeLists.txt").read_text(encoding="utf-8"))
    found = set()
    for name in sources:
        found.update(SUITE.findall((folder / name).read_text(encoding="utf-8")))
    return found


TABLE = """## Threads
| Made in | Tests |
|---|---|
| `drivers/a.cpp`, `drivers/a.hpp` | `Alone.*`, `Kernel.Boot.usb` |
## Next
| `drivers/other.cpp` | `Alone.*` |
"""
OWNERS = ["drivers/a.cpp", "drivers/a.hpp"]


def self_test():
    wrong = [
        list(complaints(OWNERS, TABLE, {"Alone"}, {"usb"})) == [],
        len(list(complaints([*OWNERS, "drivers/other.cpp"], TABLE, {"Alone"}, {"usb"}))) == 1,
        len(list(complaints(OWNERS[:1], TABLE, {"Alone"}, {"usb"}))) == 1,
        len(list(complaints(OWNERS, TABLE, set(), {"usb"}))) == 1,
        len(list(complaints(OWNERS, TABLE, {"Alone"}, set()))) == 1,
        len(list(complaints(OWNERS, TABLE.replace("`Alone.*`, `Kernel.Boot.usb`", "by hand"), {"Alone"}, {"usb"}))) == 1,
        all(map(makes_thread, ("std::thread t{[] {}};", "std::vector<std::jthread> all;", "auto x = std::async(f);",
                               "co_await resolver.async_resolve(host, port);"))),
        not any(map(makes_thread, ("// std::thread", "std::thread::id id;", "std::this_thread::sleep_for(s);",
                                   "#include <thread>", 'say("std::thread");'))),
    ]
    for nth, right in enumerate(wrong):
        if not right:
            print(f"planted sample {nth} is judged wrongly")
    return 0 if all(wrong) else 1


def main():
    if sys.argv[1] == "--self-test":
        return self_test()
    root = pathlib.Path(sys.argv[1])
    owners = [str(path.relative_to(root)) for folder in FOLDERS for path in sorted((root / folder).rglob("*.[ch]pp"))
              if makes_thread(path.read_text(encoding="utf-8"))]
    document = (root / "docs/reliability.md").read_text(encoding="utf-8")
    boots = {path.stem[len("boot_"):] for path in (root / "tests/kernel").glob("boot_*.py")}
    found = list(complaints(owners, document, suites_of_lane(root), boots))
    print("\n".join(found))
    print(f"{len(owners)} files make a thread")
    return 1 if found or not owners else 0


sys.exit(main())
