#!/usr/bin/env python3
"""Executes the examples of docs/analysis*.md and docs/analysis/*.md: what a page says is what the program does.

analysis_page.py AXISCAL DOCS_FOLDER

  ```case            a case that must be evaluated
  ```expect          of that case, one figure a line:
                       E 0.004                                parameters.E.value, to 1e-15
                       /minimum_zone/width 0.02 1e-12         JSON pointer, value, tolerance (default 1e-15)
                       /diagnosis/rank 7                      texts, true and false must be equal
  ```refused WORD    a case that must be refused with one line that holds WORD
"""
import json
import pathlib
import re
import subprocess
import sys

BLOCK = re.compile(r"^```(case|expect|refused)(?: (\S+))?\n(.*?)^```", re.S | re.M)


def pages_of(docs):
    return [*sorted(docs.glob("analysis*.md")), *sorted(docs.glob("analysis/*.md"))]


def at(document, pointer):
    """The value at a JSON pointer, None where nothing stands."""
    for step in pointer.split("/")[1:]:
        step = step.replace("~1", "/").replace("~0", "~")
        if isinstance(document, list) and step.isdigit() and int(step) < len(document):
            document = document[int(step)]
        elif isinstance(document, dict) and step in document:
            document = document[step]
        else:
            return None
    return document


def line_problem(line, result):
    name, value, *tolerance = line.split()
    got = at(result, name if name.startswith("/") else f"/parameters/{name}/value")
    try:
        wanted = json.loads(value)
    except ValueError:
        wanted = value
    if isinstance(wanted, (str, bool)) or isinstance(got, (str, bool, type(None), list, dict)):
        good = type(got) is type(wanted) and got == wanted
    else:
        good = abs(got - wanted) <= (float(tolerance[0]) if tolerance else 1e-15)
    return None if good else f"{name}: the page says {value}, the program {got}"


def analyze(axiscal, text):
    return subprocess.run([axiscal, "analyze", "-"], input=text, text=True, capture_output=True, timeout=120, check=False)


def page_problems(axiscal, text):
    blocks, last = BLOCK.findall(text), {}
    for kind, word, block in blocks:
        if kind == "expect":
            yield from filter(None, (line_problem(line, last) for line in block.splitlines() if line.strip()))
            continue
        answer = analyze(axiscal, block)
        if kind == "case" and answer.returncode != 0:
            yield "refused: " + answer.stderr
        elif kind == "case":
            last = json.loads(answer.stdout)
        elif answer.returncode != 3 or word not in answer.stderr or answer.stderr.count("\n") != 1:
            yield f"{block.strip()}: exit {answer.returncode}, {answer.stderr.strip()!r} without {word!r}"
    kinds = {kind for kind, _, _ in blocks}
    if kinds != {"case", "expect", "refused"}:
        yield f"needs examples of case, expect and refused, and has {sorted(kinds)}"


def main():
    docs = pathlib.Path(sys.argv[2])
    pages = pages_of(docs)
    problems = [f"{page.relative_to(docs)}: {text}" for page in pages
                for text in page_problems(sys.argv[1], page.read_text(encoding="utf-8"))]
    print("\n".join(problems) or f"{len(pages)} pages agree")
    return 1 if problems or not pages else 0


if __name__ == "__main__":
    sys.exit(main())
