#!/usr/bin/env python3
"""Executes the examples of docs/analysis.md: what the page says is what the program does.

analysis_page.py AXISCAL PAGE
"""
import json
import re
import subprocess
import sys

with open(sys.argv[2], encoding="utf-8") as page:
    blocks = re.findall(r"^```(case|expect|refused)(?: (\S+))?\n(.*?)^```", page.read(), re.S | re.M)
problems, last = [], {}
for kind, word, text in blocks:
    if kind == "expect":
        for line in text.split("\n"):
            if line:
                name, value = line.split()
                got = last["parameters"].get(name, {}).get("value")
                if got is None or abs(got - float(value)) > 1e-15:
                    problems.append(f"{name}: the page says {value}, the program {got}")
        continue
    answer = subprocess.run([sys.argv[1], "analyze", "-"], input=text, text=True, capture_output=True, timeout=60)
    if kind == "case":
        if answer.returncode != 0:
            problems.append("refused: " + answer.stderr)
        else:
            last = json.loads(answer.stdout)
    elif answer.returncode != 3 or word not in answer.stderr or answer.stderr.count("\n") != 1:
        problems.append(f"{text.strip()}: exit {answer.returncode}, {answer.stderr.strip()!r} without {word!r}")
kinds = [kind for kind, _, _ in blocks]
if kinds.count("case") < 1 or kinds.count("expect") < 1 or kinds.count("refused") < 6:
    problems.append("the page lost its examples")
print("\n".join(problems) or f"{len(blocks)} blocks agree")
sys.exit(1 if problems else 0)
