#!/usr/bin/env python3
"""No two types have one full name: the linker would silently take one's functions for both.

one_definition.py SOURCE_DIR   every type of the tree outside anonymous namespaces
one_definition.py --self-test  proves that a planted twin is seen
"""
import collections
import pathlib
import re
import sys

FOLDERS = ("acquisition", "analysis", "config", "drivers", "tools", "tests")
NOISE = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'', re.S)
TOKEN = re.compile(
    r"\bnamespace\s+(?P<space>[\w:]*)\s*(?:\[\[.*?\]\]\s*)?{"
    r"|(?<!enum )\b(?:struct|class|union|enum(?: class)?)\s+(?:\[\[.*?\]\]\s*)?(?P<type>[\w:]+)(?:\s+final)?\s*(?::[^;{}()]*)?{"
    r"|(?P<open>{)|(?P<close>})")


def types_of(text):
    """Full names of what is defined in a namespace; a function's own types have no linkage."""
    scopes = []  # a name, "" of a namespace without one, None of a body
    for token in TOKEN.finditer(NOISE.sub('""', text)):
        if token["close"]:
            if scopes:
                scopes.pop()
        elif token["space"] is not None:
            scopes.append(token["space"])
        elif token["type"] and None not in scopes and "" not in scopes:
            yield "::".join([*scopes, token["type"]])
            scopes.append(token["type"])
        else:
            scopes.append(None)


def twins(texts):
    homes = collections.defaultdict(set)
    for path, text in texts.items():
        for name in types_of(text):
            homes[name].add(path)
    return [f"{name} is defined in {' and in '.join(sorted(paths))}" for name, paths in sorted(homes.items()) if len(paths) > 1]


def self_test():
    twin = twins({"a.hpp": "namespace a {\nenum class E : int { x };\nstruct B final : A<int> {\n};\n}",
                  "b.hpp": "namespace a { // {\nvoid f() { const char* s = \"}\"; }\nstruct B {}; }"})
    fine = twins({"a.cpp": "namespace a { namespace { struct B {}; } void f() { struct C {}; } struct D; }",
                  "b.cpp": "namespace a { namespace { struct B {}; } } namespace b { struct B {}; struct D { }; }",
                  "c.cpp": "namespace a { struct F { struct B {}; }; struct D {}; void g() { struct C {}; } }"})
    print("seen:", twin, "false alarms:", fine)
    return 1 if len(twin) != 1 or fine else 0


def main():
    if sys.argv[1] == "--self-test":
        return self_test()
    root = pathlib.Path(sys.argv[1])
    files = [f for folder in FOLDERS for f in sorted((root / folder).rglob("*.[ch]pp"))]
    found = twins({f.relative_to(root).as_posix(): f.read_text(encoding="utf-8") for f in files})
    print("\n".join(found) or f"{len(files)} files, no type has a twin")
    return 1 if found or len(files) < 200 else 0


sys.exit(main())
