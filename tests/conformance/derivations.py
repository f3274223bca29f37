#!/usr/bin/env python3
"""Recomputes expected figures by the script that each case names, and holds the file against it.

derivations.py FOLDER        every case with a `derivation`, and what the scripts import
derivations.py --self-test FOLDER  proves that a planted wrong figure and a planted import are seen

A script is given a copy of the case that holds no expected figure, only the places.
"""
import ast
import copy
import json
import pathlib
import subprocess
import sys
import tempfile

FORBIDDEN_MODULES = {"subprocess", "ctypes", "importlib", "runpy", "socket", "multiprocessing", "urllib", "http", "pty"}
FORBIDDEN_CALLS = {"exec", "eval", "compile", "__import__"}
FORBIDDEN_OF_OS = ("system", "popen", "exec", "spawn", "posix_spawn", "fork")


def import_complaints(text, siblings):
    """A derivation may use the standard library, numpy, and the scripts beside it."""
    for node in ast.walk(ast.parse(text)):
        names = []
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            names = [node.module or ""]
        for name in names:
            top = name.split(".")[0]
            if top in FORBIDDEN_MODULES or top not in sys.stdlib_module_names | {"numpy"} | siblings:
                yield f"line {node.lineno}: may not import {name}"
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in FORBIDDEN_CALLS:
            yield f"line {node.lineno}: may not call {node.func.id}"
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "os" \
                and node.attr.startswith(FORBIDDEN_OF_OS):
            yield f"line {node.lineno}: may not call os.{node.attr}"


def without_answers(document):
    """What a derivation may see: the places that are expected, never the figures."""
    blind = copy.deepcopy(document)
    blind["expect"] = [{"at": wanted["at"]} for wanted in document["expect"]]
    blind.pop("notes", None)
    return blind


def derived(script, document):
    """What the script prints; a text where it fails."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, document["id"] + ".json")
        path.write_text(json.dumps(without_answers(document)), encoding="utf-8")
        ran = subprocess.run([sys.executable, "-B", str(script), str(path)], capture_output=True, text=True,
                             timeout=300, check=False)
    if ran.returncode != 0:
        return f"ended with {ran.returncode}: {ran.stderr.strip().splitlines()[-1:]}"
    try:
        return json.loads(ran.stdout)
    except ValueError as error:
        return f"prints no JSON: {error}"


def figure_complaints(document, found):
    if isinstance(found, str):
        return [found]
    complaints = []
    for wanted in document["expect"]:
        at = wanted["at"]
        if "value" in wanted:
            got = found.get(at)
            if not isinstance(got, (int, float)) or isinstance(got, bool):
                complaints.append(f"{at} is not derived")
            elif not abs(got - wanted["value"]) <= wanted["tolerance"]:
                complaints.append(f"{at}: derived {got}, the file says {wanted['value']} +- {wanted['tolerance']}")
        elif "equals" in wanted and at in found and found[at] != wanted["equals"]:
            complaints.append(f"{at}: derived {found[at]!r}, the file says {wanted['equals']!r}")
        elif wanted.get("absent") and at in found:
            complaints.append(f"{at}: derived {found[at]!r}, the file says that nothing stands there")
    return complaints


def cases_of(folder):
    documents = [json.loads(path.read_text(encoding="utf-8")) for path in sorted(folder.glob("*.json"))]
    return [document for document in documents if "derivation" in document]


def check(folder):
    scripts = sorted((folder / "derivations").glob("*.py"))
    siblings = {script.stem for script in scripts}
    problems = [f"{script.name}: {text}" for script in scripts
                for text in import_complaints(script.read_text(encoding="utf-8"), siblings)]
    if problems:  # nothing is run that may do more than compute
        return problems, 0, 0
    figures, cases = 0, cases_of(folder)
    for document in cases:
        script = folder / document["derivation"]
        if script.parent != folder / "derivations" or not script.exists():
            problems.append(f"{document['id']}: there is no {document['derivation']}")
            continue
        problems += [f"{document['id']}: {text}" for text in figure_complaints(document, derived(script, document))]
        figures += sum("value" in wanted for wanted in document["expect"])
    return problems, len(cases), figures


def self_test(folder):
    missed = []
    document = cases_of(folder)[0]
    found = derived(folder / document["derivation"], document)
    for place in range(len(document["expect"])):
        if "value" not in document["expect"][place]:
            continue
        wrong = copy.deepcopy(document)
        wrong["expect"][place]["value"] += 2 * wrong["expect"][place]["tolerance"] + 1e-9
        if len(figure_complaints(wrong, found)) != 1:
            missed.append(f"planted figure {place}")
    missed += figure_complaints(document, found)
    wrong = copy.deepcopy(document)
    wrong["expect"].append({"at": "/not/derived", "value": 1, "tolerance": 1e9})
    missed += [] if figure_complaints(wrong, found) else ["a figure without derivation"]
    missed += [] if figure_complaints(document, "ended with 1") else ["a script that fails"]
    for text in ("import axiscal", "import scipy.stats", "from subprocess import run", "import os\nos.system('axiscal')",
                 "eval('1')", "__import__('x')", "import ctypes", "from other import x"):
        missed += [] if list(import_complaints(text, {"beside"})) else [text]
    for text in ("import numpy as np\nimport numpy.linalg", "import json, math", "import os.path", "from beside import x"):
        missed += [f"false alarm: {text}"] if list(import_complaints(text, {"beside"})) else []
    missed += ["answers are shown"] if any(set(seen) != {"at"} for seen in without_answers(document)["expect"]) else []
    return missed


def main():
    if sys.argv[1] == "--self-test":
        missed = self_test(pathlib.Path(sys.argv[2]))
        print("missed:", missed)
        return 1 if missed else 0
    problems, cases, figures = check(pathlib.Path(sys.argv[1]))
    print("\n".join(problems) or f"{cases} cases, {figures} figures derived anew")
    return 1 if problems or cases == 0 else 0


sys.exit(main())
