#!/usr/bin/env python3
"""Counts what ran and what was skipped; fails on a skip that nobody allowed.

count_skips.py REPORT.xml MAY_SKIP   (MAY_SKIP: comma-separated words found in test names)
"""
import sys
import xml.etree.ElementTree as xml


def main():
    report, allowed = sys.argv[1], [word for word in sys.argv[2].split(",") if word]
    cases = xml.parse(report).getroot().findall("testcase")
    skipped = [case for case in cases if case.get("status") in ("notrun", "disabled") or case.find("skipped") is not None]
    forbidden = []
    for case in skipped:
        name = case.get("name")
        note = case.find("skipped")
        reason = (note.get("message") if note is not None else "") or "not run"
        may = any(word.lower() in name.lower() for word in allowed)
        print(f"skipped{'' if may else ' (NOT ALLOWED)'}: {name}: {reason}")
        if not may:
            forbidden.append(name)
    print(f"ran {len(cases) - len(skipped)} tests, skipped {len(skipped)}"
          + (f", of which {len(forbidden)} may not be skipped" if forbidden else ""))
    return 1 if forbidden or not cases else 0


sys.exit(main())
