#!/usr/bin/env python3
"""The schemas of docs/schema, held against every example of the pages, every conformance case and every result.

schemas.py AXISCAL SOURCE_FOLDER
"""
import copy
import json
import pathlib
import re
import subprocess
import sys
import unittest

import jsonschema

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from analysis_page import BLOCK, pages_of  # noqa: E402

AXISCAL, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
SCHEMAS = {path.name: json.loads(path.read_text(encoding="utf-8"))
           for path in sorted((SOURCE / "docs/schema").glob("*.schema.json"))}
REMARKS = ("comment", "customer", "date", "description", "id", "instrument", "machine",
           "name", "note", "operator", "place", "run", "source", "title")


def examples():
    """(where, case) of every evaluated example of the pages."""
    for page in pages_of(SOURCE / "docs"):
        for kind, _, text in BLOCK.findall(page.read_text(encoding="utf-8")):
            if kind == "case":
                read = json.loads(text)
                yield from ((page.name, one) for one in (read if isinstance(read, list) else [read]))


def conformance_files():
    for path in sorted((SOURCE / "tests/reference/conformance").glob("*.json")):
        yield path.name, json.loads(path.read_text(encoding="utf-8"))


def cases():
    yield from examples()
    for where, document in conformance_files():
        yield where, document["case"]


def schema_of(case):
    name = str(case.get("analysis")) + ".case.schema.json"
    return jsonschema.Draft202012Validator(SCHEMAS[name]) if name in SCHEMAS else None


def first_problem(validator, document):
    error = jsonschema.exceptions.best_match(validator.iter_errors(document))
    return None if error is None else f"{error.json_path}: {error.message[:200]}"


class Schemas(unittest.TestCase):
    def test_each_is_itself_a_schema(self):
        self.assertGreaterEqual(len(SCHEMAS), 3)
        for name, schema in SCHEMAS.items():
            jsonschema.Draft202012Validator.check_schema(schema)
            self.assertEqual(schema.get("$id"), name)

    def test_every_analysis_has_a_schema_and_a_conformance_case(self):
        asked = subprocess.run([AXISCAL, "analyze", "-"], input='{"analysis":"?"}', text=True, capture_output=True,
                               timeout=60, check=False).stderr
        known = re.findall(r'"([^"]+)"', asked)
        self.assertIn("positioning", known, asked)
        tested = {document["case"].get("analysis") for _, document in conformance_files()}
        for name in known:
            self.assertIn(name + ".case.schema.json", SCHEMAS, name)
            self.assertIn(name, tested, "no conformance case")

    def test_every_example_and_every_conformance_case_fits(self):
        for where, case in cases():
            validator = schema_of(case)
            self.assertIsNotNone(validator, f"{where}: no schema for {case.get('analysis')}")
            self.assertIsNone(first_problem(validator, case), where)

    def test_what_the_door_refuses_as_unknown_the_schema_refuses_too(self):
        seen = set()
        for where, case in cases():
            name = case.get("analysis")
            if name in seen:
                continue
            seen.add(name)
            planted = copy.deepcopy(case)
            planted["unheard_of"] = 1
            self.assertIsNotNone(first_problem(schema_of(case), planted), where)
            for key in REMARKS:
                if key not in case:
                    self.assertIsNone(first_problem(schema_of(case), {**case, key: "words"}), f"{name}: remark {key}")

    def test_every_conformance_file_fits(self):
        validator = jsonschema.Draft202012Validator(SCHEMAS["conformance-case.schema.json"])
        for where, document in conformance_files():
            self.assertIsNone(first_problem(validator, document), where)
            self.assertIsNotNone(first_problem(validator, {**document, "expect": []}), where)
            self.assertIsNotNone(first_problem(validator, {**document, "unheard_of": 1}), where)

    def test_every_result_fits(self):
        validator = jsonschema.Draft202012Validator(SCHEMAS["result.schema.json"])
        for where, case in cases():
            ran = subprocess.run([AXISCAL, "analyze", "-"], input=json.dumps(case), text=True, capture_output=True,
                                 timeout=120, check=False)
            self.assertEqual(ran.returncode, 0, f"{where}: {ran.stderr}")
            self.assertIsNone(first_problem(validator, json.loads(ran.stdout)), where)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
