#!/usr/bin/env python3
"""The conformance kit pointed at other programs: what is right passes, what is wrong is named.

foreign.py AXISCAL CASES PROGRAMS
"""
import json
import os
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

AXISCAL, CASES, PROGRAMS = (os.path.abspath(word) for word in sys.argv[1:4])
RIGHT = shlex.join([sys.executable, "-B", f"{PROGRAMS}/positioning.py"])
WRONG = RIGHT + " --as-known-tools"
POSITIONING = ["positioning-hand-*", "positioning-ess-*"]
HAND = "positioning-hand-1"


def kit(*words, cases=CASES, env=None):
    return subprocess.run([AXISCAL, "conformance", *(["--cases", cases] if cases else []), *words], text=True,
                          capture_output=True, timeout=300, check=False, env={**os.environ, **(env or {})})


def verdicts(*words):
    """exit code and {case: pointers that disagree}, of the cases with any"""
    ran = kit("--json", *words)
    document = json.loads(ran.stdout)
    wrong = {case["id"]: {figure["at"] for figure in case["figures"] if not figure["agrees"]}
             for case in document["cases"]}
    return ran.returncode, {name: places for name, places in wrong.items() if places}, document


class Foreign(unittest.TestCase):
    def test_a_right_program_of_another_kind_passes_every_figure(self):
        code, wrong, document = verdicts("--against", RIGHT, "--only", *POSITIONING)
        self.assertEqual((code, wrong), (0, {}))
        self.assertGreaterEqual(len(document["cases"]), 16)
        self.assertEqual(document["program"], RIGHT)

    def test_the_known_mistakes_are_shown_and_nothing_else(self):
        code, wrong, document = verdicts("--against", WRONG, "--only", *POSITIONING)
        self.assertEqual(code, 7)
        self.assertEqual(set().union(*wrong.values()), {"/parameters/E/value", "/parameters/R/value"})
        for name in ("x", "back-x", "back-y", "gui"):
            self.assertEqual(len(wrong[f"positioning-ess-{name}-exact"]), 2, name)
        # its own published report is right but for those two, which are left out there
        self.assertFalse([name for name in wrong if name in ("positioning-ess-x", "positioning-ess-gui")])
        self.assertEqual(document["summary"]["failed"], len(wrong))

    def test_the_kit_can_be_pointed_at_axiscal_itself(self):
        here = kit("--only", HAND).stdout
        self.assertEqual(kit("--only", HAND, "--against", shlex.join([AXISCAL, "analyze", "-"])).stdout, here)

    def test_a_crash_garbage_or_a_hang_fails_that_case_and_the_next_is_run(self):
        for command, word in (("kill -SEGV $$", "Segmentation fault"), ("echo nonsense", "no result"),
                              ("echo 'no such figure' >&2; exit 4", "ended with 4: no such figure"),
                              ("true", "no result"), ("sleep 600", "500 ms")):
            limit = "0.5" if "sleep" in command else "120"
            ran = kit("--against", command, "--timeout", limit, "--only", HAND, "positioning-hand-2")
            self.assertEqual(ran.returncode, 7, command)
            for name in (HAND, "positioning-hand-2"):
                self.assertIn("FAILED  " + name, ran.stdout)
            self.assertEqual(ran.stdout.count(word), 2, ran.stdout)
            self.assertTrue(ran.stdout.splitlines()[-1].endswith("0 cases passed, 2 failed"), ran.stdout)


class Kit(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="axiscal-kit-")
        self.addCleanup(shutil.rmtree, self.folder, True)

    def copy(self, change=None):
        with open(os.path.join(CASES, HAND + ".json"), encoding="utf-8") as source:
            document = json.load(source)
        if change:
            change(document)
        with open(os.path.join(self.folder, HAND + ".json"), "w", encoding="utf-8") as out:
            json.dump(document, out)
        return document

    def test_every_figure_is_shown_with_its_digits_and_the_last_line_counts(self):
        document = self.copy()
        ran = kit(cases=self.folder)
        self.assertEqual(ran.returncode, 0, ran.stdout + ran.stderr)
        lines = ran.stdout.splitlines()
        self.assertEqual(len(lines), len(document["expect"]) + 2)
        for line in lines[1:-1]:
            self.assertRegex(line, r"^  (exact|1\d\.\d) +/")
        figures = len(document["expect"])
        self.assertEqual(lines[-1], f"1 cases (0 published, 0 third_party_program, 1 closed_form, 0 two_ways), {figures} "
                         f"figures: {figures} agree, 0 disagree; 1 cases passed, 0 failed")

    def test_a_planted_wrong_figure_is_named_with_its_tolerance_and_reason(self):
        def plant(document):
            document["expect"][0]["value"] += 1e-6
        planted = self.copy(plant)["expect"][0]
        ran = kit("--brief", cases=self.folder)
        self.assertEqual(ran.returncode, 7)
        self.assertEqual(len(ran.stdout.splitlines()), 3)
        for word in ("DISAGREES", planted["at"], "off by", "tolerance 1e-12", planted["reason"]):
            self.assertIn(word, ran.stdout.splitlines()[1])

    def test_a_refused_case_is_a_failed_one(self):
        def plant(document):
            document["case"]["targets"][1] = 0
        self.copy(plant)
        ran = kit(cases=self.folder)
        self.assertEqual(ran.returncode, 7)
        self.assertIn("targets", ran.stdout)

    def test_a_malformed_file_is_named_with_its_place_and_nothing_is_run(self):
        def plant(document):
            document["expect"][3]["tolerence"] = 1
        self.copy(plant)
        ran = kit(cases=self.folder)
        self.assertEqual((ran.returncode, ran.stdout), (3, ""))
        self.assertIn(HAND + ".json: expect[3].tolerence", ran.stderr)
        os.chmod(os.path.join(self.folder, HAND + ".json"), 0)
        if os.geteuid() != 0:
            self.assertEqual(kit(cases=self.folder).returncode, 1)

    def test_where_the_cases_are_found(self):
        self.copy()
        found = kit(cases=None, env={"AXISCAL_CONFORMANCE_PATH": "/nowhere-at-all:" + self.folder})
        self.assertTrue(found.stdout.splitlines()[-1].startswith("1 cases"), found.stdout + found.stderr)
        self.assertEqual(kit(cases=os.path.join(self.folder, "nothing")).returncode, 1)
        # the installed layout: bin/axiscal finds share/axiscal/conformance beside it
        os.makedirs(os.path.join(self.folder, "bin"))
        installed = shutil.copy(AXISCAL, os.path.join(self.folder, "bin"))
        shutil.copytree(self.folder, os.path.join(self.folder, "share/axiscal/conformance"),
                        ignore=lambda _, names: [name for name in names if not name.endswith(".json")])
        beside = subprocess.run([installed, "conformance"], text=True, capture_output=True, timeout=60, check=False)
        self.assertTrue(beside.stdout.splitlines()[-1].startswith("1 cases"), beside.stdout + beside.stderr)

    def test_wrong_usage(self):
        self.copy()
        misspelt = kit("--only", "positioning-hnad-1", cases=self.folder)
        self.assertEqual(misspelt.returncode, 2)
        self.assertIn(f"did you mean '{HAND}'", misspelt.stderr)
        self.assertEqual(kit("--timeout", "-1", cases=self.folder).returncode, 2)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
