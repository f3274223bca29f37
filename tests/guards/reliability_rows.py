#!/usr/bin/env python3
"""Every row of the promises in docs/reliability.md names tests that there are and one command that runs them all.

reliability_rows.py SOURCE_FOLDER | reliability_rows.py --self-test

The names are taken from the sources as CMake and GoogleTest take them. A name may hold `*`. The first command of
a row is `ctest ... -R 'EXPRESSION'`, in which a bar is written `\\|`: the table's own sign. Checks of a boot of the
kernel that a row counts, "serial 28", are as many as the boot has.
"""
import fnmatch
import glob
import os
import re
import sys
import tempfile

PAGE = os.path.join("docs", "reliability.md")
TEST_NAME = re.compile(r"`((?:[A-Za-z]\w*/)?[A-Za-z*]\w*(?:\.[\w*]+)+)`")
COMMAND = re.compile(r"`ctest --test-dir build/check -R '([^']+)'(?: -V)?`")
BOOTS = re.compile(r"(\d+) checks in \w+ boots \(([^)]*)\)")
OWN_LANES = {"tools/test threads": "^Threads\\."}  # a preset of its own, which holds nothing else


def text_of(path):
    with open(path, encoding="utf-8") as source:
        return source.read()


def names_of_units(root):
    names = set()
    for path in glob.glob(os.path.join(root, "tests", "**", "*.cpp"), recursive=True):
        text = text_of(path)
        sets = re.findall(r"^INSTANTIATE_TEST_SUITE_P\(\s*(\w+),\s*(\w+)", text, re.M)
        for kind, suite, name in re.findall(r"^TEST(_F|_P)?\(\s*(\w+),\s*(\w+)\s*\)", text, re.M):
            if kind == "_P":
                names |= {f"{prefix}/{suite}.{name}/0" for prefix, of in sets if of == suite}
            else:
                names.add(f"{suite}.{name}")
    return names


def marked(root, pattern, mark):
    """Names in lines @mark("...") of the files."""
    lines = "".join(text_of(path) for path in glob.glob(os.path.join(root, "tests", *pattern)))
    return re.findall(rf'^@{mark}\("(.*)"\)$', lines, re.M)


def names_of_scripts(root):
    names = set()
    for path in glob.glob(os.path.join(root, "tests", "**", "CMakeLists.txt"), recursive=True):
        text = text_of(path)
        names |= set(re.findall(r"add_test\(NAME ([\w.]+)\s", text))
        names |= {f"Peers.{name}" for name in re.findall(r"^axiscal_linuxcnc_test\((\w+)", text, re.M)}
        names |= {f"Kernel.Boot.{name}" for name in re.findall(r"^ *axiscal_kernel_boot\((\w+)\)", text, re.M)}
        names |= {f"Fuzz.{name}ReplaysItsCorpus" for name in re.findall(r"^axiscal_fuzz\((\w+)", text, re.M)}
        for each, words, body in re.findall(r"^foreach\((\w+) ([^)]*)\)(.*?)^endforeach", text, re.M | re.S):
            for name in re.findall(rf"add_test\(NAME ([\w.]+)\${{{each}}}\s", body):
                names |= {name + word for word in words.split()}
    names |= {f"Simulation.{name}" for name in marked(root, ("simulation", "*.py"), "sentence")}
    names |= {f"Browser.{name}" for name in marked(root, ("browser", "*.py"), "sentence")}
    names |= {f"Peers.Samba.{name}" for name in marked(root, ("peers", "samba", "*.py"), "sentence")}
    names |= {f"FirstHour.{name}" for name in marked(root, ("first_hour", "first_hour.py"), "(?:long_)?check")}
    return names | {f"Kernel.{name}" for name in marked(root, ("kernel", "boot_*.py"), "check")}


def checks_of_boots(root):
    """{"serial": 28, ...}"""
    files = glob.glob(os.path.join(root, "tests", "kernel", "boot_*.py"))
    boots = {os.path.basename(path)[len("boot_"):-len(".py")] for path in files}
    return {boot: len(marked(root, ("kernel", f"boot_{boot}.py"), "check")) for boot in boots}


def judge_counts(page, boots):
    problems = []
    for whole, parts in BOOTS.findall(page):
        told = {boot: int(count) for boot, count in re.findall(r"(\w+) (\d+)", parts)}
        problems += [f"{PAGE}: the boot {boot} has {boots.get(boot, 0)} checks, not {count}"
                     for boot, count in told.items() if boots.get(boot) != count]
        if sum(told.values()) != int(whole):
            problems.append(f"{PAGE}: {parts} are {sum(told.values())} checks, not {whole}")
    return problems


def rows_of(page):
    """(line number, cells) of the table of promises, without its head."""
    promises = page.split("\n## ")[0].split("\n")
    rows = [(number, re.split(r"(?<!\\)\|", line)[1:-1]) for number, line in enumerate(promises, 1)
            if line.startswith("|")]
    return rows[2:]


def judge_row(cells, names):
    if len(cells) != 4:
        return [f"has {len(cells)} cells, not 4: write a bar within a cell as \\|"]
    _, tests, _, command = cells
    found = COMMAND.search(command)
    expression = found.group(1).replace("\\|", "|") if found else OWN_LANES.get(command.strip().strip("`"))
    if expression is None:
        return ["its command is no `ctest --test-dir build/check -R '...'`"]
    patterns = TEST_NAME.findall(tests)
    problems = [] if patterns else ["names no test"]
    for pattern in patterns:
        meant = fnmatch.filter(names, pattern)
        if not meant:
            problems.append(f"names {pattern}, and there is no such test")
        left_out = [name for name in sorted(meant) if not re.search(expression, name)]
        if left_out:
            problems.append(f"its command does not run {left_out[0]}" +
                            (f" and {len(left_out) - 1} more of {pattern}" if left_out[1:] else ""))
    return problems


def judge(page, names):
    rows = rows_of(page)
    problems = [] if rows else [f"{PAGE}: no table of promises"]
    for number, cells in rows:
        problems += [f"{PAGE}:{number}: {problem}" for problem in judge_row(cells, names)]
    return problems


def self_test():
    names = {"Good.One", "Good.Two", "Peers.Three", "Sets/Good.Four/0"}
    head = "| Promise | Test | Last figure | Command |\n|---|---|---|---|\n"
    planted = {
        "| a | `Good.*`, `Sets/Good.*` | | `ctest --test-dir build/check -R 'Good\\.' -V` |": "",
        "| a | `Good.One`, `Peers.Three` | | `ctest --test-dir build/check -R '^Good\\.One\\|^Peers'` |": "",
        "| a | `Good.*` | | `ctest --test-dir build/check -R 'Good.One'` |": "does not run Good.Two",
        "| a | `Peers.*` | | `ctest --test-dir build/check -R '^peers'` |": "does not run Peers.Three",
        "| a | `Gone.*` | | `ctest --test-dir build/check -R 'Good'` |": "no such test",
        "| a | by hand | | `ctest --test-dir build/check -R 'Good'` |": "names no test",
        "| a | `Good.One` | | `build/check/bin/good` |": "its command is no",
        "| a | `Good.One` | | `ctest --test-dir build/check -R 'Good|Bad'` |": "5 cells",
    }
    problems = []
    for row, due in planted.items():
        found = judge(head + row + "\n", names)
        right = len(found) == 1 and due in found[0] if due else not found
        if not right:
            problems.append(f"{row}: {found}, due: {due or 'nothing'}")
    boots = {"usb": 2, "can": 1}
    for text, due in {"3 checks in two boots (usb 2, can 1)": 0, "4 checks in two boots (usb 3, can 1)": 1,
                      "4 checks in two boots (usb 2, can 1)": 1, "2 checks in one boots (pci 2)": 1}.items():
        if len(judge_counts(text, boots)) != due:
            problems.append(f"{text}: {judge_counts(text, boots)}, due: {due}")
    with tempfile.TemporaryDirectory() as root:
        os.makedirs(os.path.join(root, "tests"))
        with open(os.path.join(root, "tests", "a.cpp"), "w", encoding="utf-8") as out:
            out.write("TEST_F(Suite,\n       Name) {\nTEST_P(Many, Name) {\nINSTANTIATE_TEST_SUITE_P(\n    All, Many, 1);\n")
        with open(os.path.join(root, "tests", "CMakeLists.txt"), "w", encoding="utf-8") as out:
            out.write("foreach(one A B)\n    add_test(NAME Cli.${one} COMMAND x)\nendforeach()\nadd_test(NAME Guard.X COMMAND y)\n")
        seen = names_of_units(root) | names_of_scripts(root)
        if seen != {"Suite.Name", "All/Many.Name/0", "Cli.A", "Cli.B", "Guard.X"}:
            problems.append(f"names of the sources: {sorted(seen)}")
    return problems


def main():
    if sys.argv[1] == "--self-test":
        return self_test()
    root = sys.argv[1]
    page = text_of(os.path.join(root, PAGE))
    return judge(page, names_of_units(root) | names_of_scripts(root)) + judge_counts(page, checks_of_boots(root))


if __name__ == "__main__":
    found_problems = main()
    print("\n".join(found_problems) or "every row names its tests and runs them")
    sys.exit(1 if found_problems else 0)
