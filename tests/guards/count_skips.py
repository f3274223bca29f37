#!/usr/bin/env python3
"""Counts what ran and what was skipped, and why; fails on a skip that nobody allowed.

count_skips.py REPORT.xml BUILD MAY_SKIP   REPORT: of `ctest --output-junit`; MAY_SKIP: labels, with commas between
count_skips.py --labels BUILD              fails for a test that may end as skipped and has no label to name it by
count_skips.py --self-test                 proves that planted skips are judged rightly

CMake 3.25 writes no labels into its report, so `ctest --show-only` of the build folder tells them.
"""
import json
import os
import subprocess
import sys
import xml.etree.ElementTree as xml


def listed(build):
    shown = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], check=True, capture_output=True, text=True)
    return json.loads(shown.stdout)["tests"]


def properties(test):
    return {one["name"]: one["value"] for one in test.get("properties", [])}


def labels_of(tests):
    """Name of each test, with its labels."""
    return {test["name"]: properties(test).get("LABELS", []) for test in tests}


def unlabelled(tests):
    """Tests that may say "skipped" (those of GoogleTest all may, by a word of theirs, and are not meant)."""
    return [test["name"] for test in tests
            if "SKIP_RETURN_CODE" in properties(test) and not properties(test).get("LABELS")]


def is_skipped(case):
    return case.get("status") in ("notrun", "disabled") or case.find("skipped") is not None


def reason(case):
    """The test's own last words, or the sentence of GTEST_SKIP; where it never began, ctest's."""
    note = case.find("skipped")
    word = (note.get("message") if note is not None else "") or case.get("status")
    said = [line.strip() for line in (case.findtext("system-out") or "").splitlines() if line.strip()]
    if not said or not word.startswith("SKIP_"):
        return word
    for line, next_line in zip(said, said[1:]):
        if line.endswith(": Skipped"):
            return next_line
    return said[-1]


def judge(cases, labels, allowed):
    """The lines to print, the one with the counts first, and how many skips nobody allowed."""
    skipped = [case for case in cases if is_skipped(case)]
    lines, forbidden = [], 0
    for case in skipped:
        own = labels.get(case.get("name"), [])
        may = bool(set(own) & allowed)
        forbidden += not may
        lines.append(f"  {case.get('name')} ({', '.join(own) or 'no label'}): {reason(case)}"
                     + ("" if may else " - NOT ALLOWED"))
    count = f"ran {len(cases) - len(skipped)} tests, skipped {len(skipped)}"
    if forbidden:
        count += f", of which {forbidden} may not be skipped (AXISCAL_MAY_SKIP=LABEL,... allows it)"
    return [count + (":" if lines else ""), *lines], forbidden


def count(report, build, may_skip):
    if not os.path.exists(report):
        print(f"ran no test: ctest wrote no {report}")
        return 1
    cases = xml.parse(report).getroot().findall("testcase")
    allowed = {label.strip() for label in may_skip.split(",") if label.strip()}
    lines, forbidden = judge(cases, labels_of(listed(build)), allowed)
    print("\n".join(lines))
    return 1 if forbidden or len(cases) == sum(map(is_skipped, cases)) else 0


REPORT = """<testsuite name="planted" tests="6">
<testcase name="Peers.Runs" status="run"><properties/><system-out>linuxcnc is not installed</system-out></testcase>
<testcase name="Peers.Breaks" status="fail"><failure message=""/><properties/><system-out>no</system-out></testcase>
<testcase name="Peers.Rs274ReadsIt" status="notrun"><skipped message="SKIP_RETURN_CODE=77"/><properties/>
<system-out>looking
rs274 is not installed (apt-get install linuxcnc-uspace)
</system-out></testcase>
<testcase name="Simulation.ADiskNamedLinuxcnc" status="notrun"><skipped message="SKIP_RETURN_CODE=77"/><properties/>
<system-out>no disk can be mounted here
</system-out></testcase>
<testcase name="Program.ReadByRs274" status="notrun"><skipped message="SKIP_REGULAR_EXPRESSION_MATCHED"/><properties/>
<system-out>[ RUN      ] Program.ReadByRs274
/tests/program_test.cpp:12: Skipped
rs274 is missing

[  SKIPPED ] Program.ReadByRs274 (0 ms)
[  SKIPPED ] 1 test, listed below:
[  SKIPPED ] Program.ReadByRs274
</system-out></testcase>
<testcase name="Unit.NeverBuilt" status="notrun"><skipped message="Unable to find executable"/><properties/>
<system-out>looked here and there
</system-out></testcase>
</testsuite>"""
LISTED = [{"name": "Peers.Runs", "properties": [{"name": "SKIP_RETURN_CODE", "value": 77}]},
          {"name": "Peers.Breaks"},
          {"name": "Peers.Rs274ReadsIt", "properties": [{"name": "LABELS", "value": ["linuxcnc"]},
                                                        {"name": "SKIP_RETURN_CODE", "value": 77}]},
          {"name": "Simulation.ADiskNamedLinuxcnc", "properties": [{"name": "LABELS", "value": ["mount", "simulation"]}]},
          {"name": "Program.ReadByRs274", "properties": [{"name": "LABELS", "value": ["linuxcnc"]},
                                                         {"name": "SKIP_REGULAR_EXPRESSION", "value": ["SKIPPED"]}]},
          {"name": "Unit.NeverBuilt", "properties": [{"name": "SKIP_REGULAR_EXPRESSION", "value": ["SKIPPED"]}]}]
RS274 = "  Peers.Rs274ReadsIt (linuxcnc): rs274 is not installed (apt-get install linuxcnc-uspace)"
DISK = "  Simulation.ADiskNamedLinuxcnc (mount, simulation): no disk can be mounted here"
UNIT = "  Program.ReadByRs274 (linuxcnc): rs274 is missing"
UNBUILT = "  Unit.NeverBuilt (no label): Unable to find executable"
NO = " - NOT ALLOWED"
REFUSED = "ran 2 tests, skipped 4, of which %d may not be skipped (AXISCAL_MAY_SKIP=LABEL,... allows it):"


def self_test():
    cases, labels = xml.fromstring(REPORT).findall("testcase"), labels_of(LISTED)
    checks = {
        "nothing may be skipped": judge(cases, labels, set())
        == ([REFUSED % 4, RS274 + NO, DISK + NO, UNIT + NO, UNBUILT + NO], 4),
        "a label is not looked for in names": judge(cases, labels, {"linuxcnc"})
        == ([REFUSED % 2, RS274, DISK + NO, UNIT, UNBUILT + NO], 2),
        "one label of two is enough": judge(cases[:4], labels, {"linuxcnc", "mount"})
        == (["ran 2 tests, skipped 2:", RS274, DISK], 0),
        "part of a label allows nothing": judge(cases[2:3], labels, {"linux"})[1] == 1,
        "a disabled test is a skipped one": judge(
            [xml.fromstring('<testcase name="Peers.Breaks" status="disabled"><system-out/></testcase>')], labels, set())[0][1]
        == "  Peers.Breaks (no label): disabled" + NO,
        "nothing skipped": judge(cases[:2], labels, set()) == (["ran 2 tests, skipped 0"], 0),
        "a test without a label is named": unlabelled(LISTED) == ["Peers.Runs"],
    }
    wrong = [what for what, right in checks.items() if not right]
    print("\n".join(f"judged wrongly: {what}" for what in wrong) or "each planted skip is judged rightly")
    return 1 if wrong else 0


def main():
    if sys.argv[1] == "--self-test":
        return self_test()
    if sys.argv[1] == "--labels":
        tests = listed(sys.argv[2])
        found = unlabelled(tests)
        print("\n".join(f"{name} may be skipped and has no label for AXISCAL_MAY_SKIP" for name in found)
              or "every test that may be skipped has a label")
        return 1 if found or not tests else 0
    return count(*sys.argv[1:4])


sys.exit(main())
