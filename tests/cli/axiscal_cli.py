#!/usr/bin/env python3
"""The command line as a shell sees it: exit codes, help, refusals, doors.

axiscal_cli.py BIN_FOLDER SOURCE_FOLDER   writes only into a scratch folder of its own
"""
import codecs
import json
import math
import os
import pty
import re
import select
import shutil
import signal
import socket
import statistics
import subprocess
import sys
import tempfile
import termios
import threading
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import run_files  # noqa: E402

BIN, SOURCE = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
EXAMPLE = os.path.join(SOURCE, "config", "station.example.toml")
RUN = os.path.join(SOURCE, "tests", "reference", "fifty_points.axiscal")
COMMANDS = {"devices": ["--drivers", "--as", "--config"], "arm": ["--datum", "--program", "--seed", "--pass", "--override"],
            "preflight": ["--override"], "retake": ["--target", "--direction", "--cycle", "--reason"],
            "exclude": ["--target", "--direction", "--cycle", "--reason"],
            "import": ["FILE", "--map", "--out", "--certificate"], "judge": ["CASE", "REPORT"],
            "answer": ["FINDING", "TEXT", "--by"], "pair": ["NAME", "--list", "--end", "--end-all", "--socket"],
            "status": ["--socket"], "watch": ["--until-published"], "trigger": ["--token-file"], "reading": ["--arcsec"],
            "abort": ["--reason"], "analyze": ["FILE"], "case": ["KIND", "--csv"], "result": ["RUN", "--config", "--tolerances", "--travel"], "budget": ["RUN", "--config"], "program": ["--dialect", "--out", "--retake"],
            "export": ["RUN", "--out", "--format"], "station": ["ACTION", "--axis", "--instrument", "--set", "--out"], "check-config": ["FILE"], "verify": ["RUN", "--certificate"],
            "doctor": ["STATION", "--socket"], "selftest": ["--state-directory", "--port", "--count"],
            "record": ["--instrument", "--raw", "--baud", "--out", "--for", "--who"], "tape": ["ACTION", "TAPE", "--name"],
            "replay": ["TAPE", "--link", "--port", "--fast", "--expect", "--rebuild", "--block"],
            "conformance": ["--against", "--cases", "--only", "--timeout", "--brief"]}
CASE = {"analysis": "positioning", "standard": "ISO 230-2:2014", "axis": {"name": "X", "kind": "linear"},
        "unit": "mm", "readings": "positions", "targets": [0, 100, 200, 300, 400],
        "forward": [[t + 0.001, t + 0.003] for t in (0, 100, 200, 300, 400)],
        "backward": [[t - 0.001, t + 0.001] for t in (0, 100, 200, 300, 400)]}


def example_text():
    """The example, its profile found in the clone instead of /usr/share."""
    with open(EXAMPLE, encoding="utf-8") as source:
        text = source.read()
    profile = os.path.join(SOURCE, "config", "profiles", "tm-th8.toml")
    assert os.path.exists(profile)
    return text.replace('profile = "tm-th8"', f'profile = "{profile}"')


def dwelling_text():
    """The example as a station without a wire, for Marlin: the axis stands still."""
    text = example_text().replace('shape = "sequence-block"', 'shape = "dwell"')
    text = text.replace('transport = "tcp"\n', 'transport = "none"\nwindow = "0.5 mm"\nstability_range = "2 um"\nhysteresis = "0.2 mm"\n')
    return re.sub(r"^(host = \"127|port = 1502).*$", "", text, flags=re.M)


def run(*words, text=None, env=None):
    return subprocess.run([os.path.join(BIN, "axiscal"), *words], input=text, text=True,
                          capture_output=True, timeout=60, env={**os.environ, **(env or {})})


class Scratch(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="axiscal-cli-")
        self.addCleanup(shutil.rmtree, self.folder, True)

    def file(self, name, text=""):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as out:
            out.write(text)
        return path

    def expect(self, code, *words, **more):
        got = run(*words, **more)
        self.assertEqual(got.returncode, code, f"{words}: {got.stdout}{got.stderr}")
        return got


class Help(Scratch):
    def test_every_command_names_its_arguments(self):
        listed = self.expect(0, "--help").stdout
        for command, arguments in COMMANDS.items():
            self.assertIn(command, listed)
            told = self.expect(0, command, "--help").stdout
            for argument in arguments + ["--json"]:
                self.assertIn(argument, told, command)

    def test_exit_codes_are_told(self):
        told = self.expect(0, "--help").stdout
        for code in range(10):
            self.assertRegex(told, rf"\b{code} ")

    def commands(self):
        """Every one that `axiscal --help` lists, also those that this file knows nothing of."""
        listed = self.expect(0, "--help").stdout.split("Subcommands:")[1].split("A run, from start")[0]
        found = re.findall(r"^  (\S+)", listed, re.M)
        self.assertLessEqual(set(COMMANDS), set(found))
        return found

    def test_every_command_teaches_by_an_example_and_its_exit_codes(self):
        whole = " ".join(self.expect(0, "--help").stdout.split("Exit codes:")[1].split())
        for command in self.commands():
            told = self.expect(0, command, "--help").stdout
            self.assertRegex(told, rf"(?m)^[^\n]*Examples?[^\n]*:\n(  sudo [^\n]*\n)?  axiscal {command}( |$)", command)
            [codes] = re.findall(r"^Exit codes: (.*)\Z", told.strip(), re.M | re.S)
            meanings = re.split(r"; (?=\d )", " ".join(codes.split()).rstrip("."))
            self.assertEqual(meanings[0], "0 done", command)
            self.assertIn("2 wrong usage", meanings, command)
            for meaning in meanings:
                self.assertIn(meaning, whole, f"{command} has another word than axiscal --help")

    def test_codes_of_a_daemon_are_told_by_those_that_ask_it(self):
        for command in ("arm", "status", "watch", "trigger", "abort", "retake", "exclude", "answer", "pair"):
            self.assertIn("5 axiscald does not answer", self.expect(0, command, "--help").stdout, command)
        for command in ("analyze", "program", "export", "check-config", "verify"):
            told = self.expect(0, command, "--help").stdout
            self.assertIn("3 input refused", told, command)
            self.assertNotIn("axiscald does not answer", told, command)

    def test_wrong_usage_is_2_with_a_hint(self):
        self.assertIn("did you mean 'status'", self.expect(2, "statsu").stderr)
        self.expect(2)
        self.expect(2, "analyze")
        self.expect(2, "status", "--no-such-option")
        self.expect(2, "arm", "--state-that", "no equals sign")


class SelfTest(Scratch):
    def test_it_measures_and_says_what_it_means(self):
        told = json.loads(self.expect(0, "selftest", "--state-directory", self.folder, "--count", "20",
                                      "--port", "/dev/null-and-void", "--json").stdout)
        for what in ("commit", "timer", "serial"):
            self.assertGreaterEqual(told[what]["worst_us"], told[what]["median_us"])
            self.assertGreater(told[what]["median_us"], 0)
            self.assertGreater(len(told[what]["means"]), 40)
        self.assertIn("/dev/null-and-void cannot be used", told["ports"][0]["means"])
        self.assertEqual(os.listdir(self.folder), [])
        words = self.expect(0, "selftest", "--state-directory", self.folder, "--count", "20").stdout
        for line in ("disk ", "timer ", "serial "):
            self.assertIn(line, words)

    def test_a_folder_that_cannot_be_written_is_named(self):
        got = self.expect(1, "selftest", "--state-directory", os.path.join(self.folder, "nothing"))
        self.assertIn("nothing", got.stderr)


class Analyze(Scratch):
    def test_a_case_from_a_file_and_from_stdin(self):
        text = json.dumps(CASE)
        one = json.loads(self.expect(0, "analyze", self.file("case.json", text)).stdout)
        two = json.loads(self.expect(0, "analyze", "-", text=text).stdout)
        self.assertEqual(one, two)
        # Forward mean 2 um, backward mean 0: B = 2 um; s = sqrt(2) um each, R = 4 sqrt(2) + ... by hand:
        self.assertTrue(math.isclose(one["parameters"]["B"]["value"], 0.002, abs_tol=1e-12))
        self.assertTrue(math.isclose(one["parameters"]["R_forward"]["value"], 4e-3 * math.sqrt(2),
                                     abs_tol=1e-12))

    def test_an_array_keeps_its_length_and_names_the_refused(self):
        bad = {**CASE, "targets": [0, 100, 100, 300, 400]}
        got = self.expect(3, "analyze", "-", text=json.dumps([CASE, bad, CASE]))
        answers = json.loads(got.stdout)
        self.assertEqual(len(answers), 3)
        self.assertIn("field", answers[1]["refused"])
        self.assertEqual(answers[0], answers[2])

    def test_refused_and_missing_input(self):
        for text in ("", "{", "[1]", '{"analysis":"positioning"}', json.dumps({**CASE, "forward": [[float("nan")]]})):
            got = self.expect(3, "analyze", "-", text=text)
            self.assertEqual(len(got.stderr.strip().splitlines()), 1, text)
        self.expect(1, "analyze", os.path.join(self.folder, "nothing"))
        self.expect(1, "analyze", self.folder)

    def test_a_new_table_is_taken_as_it_is_and_overwrites_nothing(self):
        for kind in ("positioning", "circular", "workpiece"):
            path = os.path.join(self.folder, f"{kind} readings.csv")
            self.assertIn("axiscal analyze", self.expect(0, "case", "new", kind, "--csv", path).stdout)
            self.assertEqual(json.loads(self.expect(0, "analyze", path).stdout)["format"], "axiscal.result/1")
            with open(path, encoding="utf-8") as table:
                text = table.read()
            self.assertIn("there already", self.expect(3, "case", "new", kind, "--csv", path).stderr)
            with open(path, encoding="utf-8") as table:
                self.assertEqual(table.read(), text)
        self.expect(2, "case", "new", "spherical", "--csv", os.path.join(self.folder, "x.csv"))
        self.expect(1, "case", "new", "circular", "--csv", os.path.join(self.folder, "nowhere", "x.csv"))

    def test_a_run_file_is_known_by_content(self):
        renamed = os.path.join(self.folder, "looks-like-a-case.json")
        shutil.copy(RUN, renamed)
        document = json.loads(self.expect(0, "analyze", renamed).stdout)
        self.assertIn("run", document)
        self.assertEqual(json.loads(self.expect(0, "analyze", RUN).stdout)["parameters"], document["parameters"])


def figures_of(targets):
    """ISO 230-2 with k = 2 over [(up, down)], lists of deviations; spread needs two readings in each."""
    up, down = [[statistics.mean(side[k]) for side in targets] for k in (0, 1)]
    gaps, means = [u - d for u, d in zip(up, down)], [(u + d) / 2 for u, d in zip(up, down)]
    figures = {"E": max(up + down) - min(up + down), "E_forward": max(up) - min(up),
               "E_backward": max(down) - min(down), "M": max(means) - min(means),
               "B": max(map(abs, gaps)), "B_mean": statistics.mean(gaps)}
    if min(len(readings) for side in targets for readings in side) < 2:
        return figures
    s = [[2 * statistics.stdev(side[k]) for side in targets] for k in (0, 1)]
    high, low = [[m + d for m, d in zip((up, down)[k], s[k])] for k in (0, 1)], \
                [[m - d for m, d in zip((up, down)[k], s[k])] for k in (0, 1)]
    return {**figures, "R_forward": 2 * max(s[0]), "R_backward": 2 * max(s[1]),
            "R": max(max(a + b + abs(g), 2 * a, 2 * b) for a, b, g in zip(*s, gaps)),
            "A_forward": max(high[0]) - min(low[0]), "A_backward": max(high[1]) - min(low[1]),
            "A": max(high[0] + high[1]) - min(low[0] + low[1])}


class Result(Scratch):
    """Of the reference run, five targets and five approaches each way, and of what is left when it was aborted."""

    def aborted(self, taken, complete=False):
        """The first `taken` points alone, closed as incomplete."""
        rows, points = [], 0
        for table, values in run_files.linear(RUN):
            values = list(values)
            if table == "point":
                points += 1
                if points > taken:
                    continue
            if table == "closing":
                values[0], values[1] = int(complete), "" if complete else "aborted by the operator: a chip"
            rows.append((table, values))
        os.makedirs(os.path.join(self.folder, "runs"), exist_ok=True)
        path = os.path.join(self.folder, "runs", f"cut-{taken}.axiscal")
        run_files.write(path, SOURCE, rows)
        return path

    def readings(self):
        """{(target, direction): deviations} of the whole run, at 20 degC."""
        deviations = json.loads(self.expect(0, "analyze", RUN).stdout)["run"]["deviations"]
        return {(i, k): rows[i] for k, rows in enumerate((deviations["forward"], deviations["backward"]))
                for i in range(5)}

    def left_of(self, taken):
        """The same of the first points: the standard cycle goes up over the targets, then down."""
        left = {place: [] for place in self.readings()}
        order = [(i if k == 0 else 4 - i, k, j) for j in range(5) for k in (0, 1) for i in range(5)]
        for i, k, j in order[:taken]:
            left[i, k].append(self.readings()[i, k][j])
        return left

    def check(self, taken, targets):
        left = self.left_of(taken)
        summary = json.loads(self.expect(0, "result", self.aborted(taken), "--json").stdout)
        due = figures_of([(left[i, 0], left[i, 1]) for i in targets])
        self.assertEqual(set(summary["parameters"]), set(due))
        for key, figure in due.items():
            self.assertAlmostEqual(summary["parameters"][key]["value"], figure, delta=1e-12, msg=key)
            self.assertIsNone(summary["parameters"][key]["verdict"])
        known = summary["completeness"]
        self.assertEqual((known["status"], known["expected"]), ("partial", 50))
        self.assertEqual(known["used"], sum(len(left[i, k]) for i in targets for k in (0, 1)))
        self.assertEqual(known["used"] + sum(entry["count"] for entry in known["left_out"]), 50)
        return summary

    def test_an_aborted_run_counts_with_the_readings_that_it_has(self):
        summary = self.check(33, range(5))
        self.assertEqual(summary["unit"], "mm")
        self.assertEqual(summary["completeness"]["left_out"][0], {
            "target": 0, "position": summary["completeness"]["left_out"][0]["position"], "direction": "positive",
            "approaches": [4], "count": 1, "why": "not measured: aborted by the operator: a chip",
            "target_omitted": False})

    def test_a_target_from_one_side_alone_is_named_and_one_reading_gives_no_spread(self):
        summary = self.check(8, [2, 3, 4])
        omitted = {entry["target"] for entry in summary["completeness"]["left_out"] if entry["target_omitted"]}
        self.assertEqual(omitted, {0, 1})
        self.assertIn("one reading", summary["not_evaluated"]["R"])
        self.assertEqual(self.check(12, range(5))["not_evaluated"].keys(),
                         {"A", "A_forward", "A_backward", "R", "R_forward", "R_backward"})

    def test_a_whole_run_has_the_figures_of_its_certificate_each_with_its_uncertainty(self):
        path = self.aborted(50, complete=True)
        summary = json.loads(self.expect(0, "result", path, "--json").stdout)
        document = json.loads(self.expect(0, "analyze", path).stdout)
        self.assertEqual(summary["completeness"],
                         {"status": "complete", "expected": 50, "used": 50, "left_out": []})
        self.assertEqual(document["completeness"], summary["completeness"])
        for key, parameter in document["parameters"].items():
            self.assertEqual(summary["parameters"][key]["value"], parameter["value"])
            self.assertEqual(summary["parameters"][key]["U"], parameter["expanded_uncertainty"]["value"])

    def test_the_budget_of_a_run_says_where_each_input_comes_from(self):
        path = self.aborted(50, complete=True)
        budget = json.loads(self.expect(0, "budget", path, "--json").stdout)
        figures = json.loads(self.expect(0, "result", path, "--json").stdout)["parameters"]
        self.assertEqual((budget["unit"], budget["k"], budget["missing"]), ("um", 2, []))
        for key, figure in budget["parameters"].items():
            self.assertAlmostEqual(figure["U"], figures[key]["U"] * 1e3, delta=1e-9, msg=key)
        certificate = json.loads(self.expect(0, "analyze", path).stdout)["parameters"]
        for key, figure in budget["parameters"].items():
            for um, mm in zip(figure["true_value_95"], certificate[key]["true_value_95"], strict=True):
                self.assertAlmostEqual(um, mm * 1e3, delta=1e-9, msg=key)
        origins = {(one["term"], one["quantity"]): one["origin"] for one in budget["inputs"]}
        self.assertEqual(origins["machine_expansion", "largest distance from 20 degC"], "readings")
        self.assertEqual(origins["environment", "E_VE"], "drift_test")
        text = self.expect(0, "budget", path).stdout
        self.assertIn("typed: uncertainty.", text)
        self.assertIn("from drift test ", text)
        self.assertIn("true value (95 %) from ", text)

    def test_limits_give_verdicts_and_a_partial_result_has_none(self):
        limits = self.file("limits.json", json.dumps({"name": "agreed", "source": "order 17", "unit": "um", "rule": "guard-U", "limits": [
            {"parameter": "A", "limit": 1e6}, {"parameter": "B", "limit": 0.001}]}))
        whole = self.expect(0, "result", self.aborted(50, complete=True), "--tolerances", limits, "--json")
        parameters = json.loads(whole.stdout)["parameters"]
        self.assertEqual(parameters["A"]["verdict"], "pass")
        self.assertIn(parameters["B"]["verdict"], ("fail", "not_provable"))
        self.assertIsNone(parameters["E"]["verdict"])
        partial = self.expect(0, "result", self.aborted(33), "--tolerances", limits, "--json")
        self.assertTrue(all(figure["verdict"] is None for figure in json.loads(partial.stdout)["parameters"].values()))

    def test_limits_may_stand_in_toml_as_the_station_file_has_them(self):
        run = self.aborted(50, complete=True)
        head = 'source = "order 17"\nrule = "simple"\n'
        wide = self.file("wide.toml", head + 'limits = [{ parameter = "A", limit = "500 mm" }]')
        told = json.loads(self.expect(0, "result", run, "--tolerances", wide, "--json").stdout)
        self.assertEqual((told["verdict"], told["tolerances"]["rule"]), ("pass", "simple"))
        self.assertEqual(told["verdicts"][0]["limit"], 500)
        circles = self.file("circles.toml", head + 'limits = [{ parameter = "G_b", limit = "9 um" }]')
        refused = self.expect(3, "result", run, "--tolerances", circles)
        self.assertIn("has no limit of a positioning run", refused.stderr)

    def test_it_fits_a_terminal_and_says_partial(self):
        for taken in (8, 33, 50):
            told = self.expect(0, "result", self.aborted(taken, complete=taken == 50)).stdout
            self.assertEqual("PARTIAL" in told, taken != 50, told)
            for line in told.splitlines():
                self.assertLessEqual(len(line), 80, line)

    def test_without_a_run_it_is_the_newest_of_the_station_and_3_without_any(self):
        config = self.file("station.toml", re.sub(r'# state_directory = "[^"]*"', f'state_directory = "{self.folder}"',
                                                  example_text()))
        self.assertIn("no run was measured yet", self.expect(3, "result", "--config", config).stderr)
        self.aborted(33)
        for words in ([], ["cut-33"]):
            got = self.expect(0, "result", *words, "--config", config, "--json")
            self.assertEqual(json.loads(got.stdout)["completeness"]["used"], 33)
        self.assertIn("cut-34", self.expect(3, "result", "cut-34", "--config", config).stderr)
        self.assertIn("no reading", self.expect(3, "result", self.aborted(0)).stderr)

    def test_a_partial_result_on_paper_has_no_number(self):
        path = self.aborted(33)
        papers = json.loads(self.expect(0, "export", path, "--out", self.folder, "--json").stdout)
        with open(papers["json"], encoding="utf-8") as file:
            document = json.load(file)
        self.assertEqual(document["completeness"]["status"], "partial")
        self.assertIsNone(document["run"]["statements"]["certificate_number"])
        self.assertIsNone(document["run"]["next_calibration_due"])
        self.assertFalse(any("target_uncertainty" in figure for figure in document["parameters"].values()))
        self.assertEqual(self.expect(0, "verify", path, "--certificate", papers["json"]).returncode, 0)
        with open(papers["csv"], encoding="utf-8") as file:
            self.assertIn("# completeness,partial,used 33,of 50", file.read())


class StationFile(Scratch):
    def test_the_example_is_accepted(self):
        path = self.file("station.toml", example_text())
        self.assertIn("110 points", self.expect(0, "check-config", path).stdout)
        self.assertEqual(json.loads(self.expect(0, "check-config", path, "--json").stdout)["refusals"], [])

    def test_five_mistakes_are_named_at_once_with_their_lines(self):
        text = example_text()
        planted = [('kind = "linear"', 'kind = "linaer"'), ('sign = 1', 'sgin = 1'),
                   ('overrun = "2 mm"', 'overrun = "2 s"'), ('spread_limit = "2 um"', 'spread_limit = 2'),
                   ('driver = "umd"', 'driver = "udm"')]
        for right, wrong in planted:
            self.assertEqual(len(re.findall(rf"^{re.escape(right)}$", text, re.M)), 1, right)
            text = re.sub(rf"^{re.escape(right)}$", wrong, text, flags=re.M)
        path = self.file("station.toml", text)
        lines = text.splitlines()
        told = self.expect(3, "check-config", path).stderr
        for _, wrong in planted:
            line = lines.index(wrong) + 1
            self.assertRegex(told, rf"{re.escape(path)}:{line}\b", f"{wrong}\n{told}")
        for hint in ("linear", "sign", "umd"):
            self.assertIn(hint, told)
        refusals = json.loads(run("check-config", path, "--json").stdout)["refusals"]
        # sgin is no key and sign is missing; nothing that is right is complained of beside them
        self.assertEqual(sorted(refusal["key"] for refusal in refusals),
                         ["axis.kind", "axis.sgin", "axis.sign", "capture.spread_limit", "cycle.overrun",
                          'instrument "laser".driver'], refusals)

    def test_a_missing_file_is_refused(self):
        self.expect(3, "check-config", os.path.join(self.folder, "nothing.toml"))


class Program(Scratch):
    def test_both_dialects(self):
        for dialect, word in (("linuxcnc", "M66"), ("marlin", "G4 P")):
            text = example_text().replace('shape = "sequence-block"', 'shape = "single-register"')
            if dialect == "marlin":
                text = dwelling_text()
            config = self.file(dialect + ".toml", text)
            got = run("program", "--config", config, "--dialect", dialect, "--out", self.folder,
                      "--seed", "5", "--json")
            self.assertEqual(got.returncode, 0, got.stdout + got.stderr)
            written = json.loads(got.stdout)["programs"][0]
            self.assertEqual(written["seed"], 5)
            with open(written["file"], encoding="utf-8") as source:
                self.assertIn(word, source.read())
        self.expect(2, "program", "--config", config, "--dialect", "klingon", "--out", self.folder)


class Export(Scratch):
    def test_a_run_file_becomes_papers(self):
        told = self.expect(0, "export", RUN, "--out", self.folder).stdout
        [entry] = [entry.path for entry in os.scandir(self.folder)]
        files = sorted(os.listdir(entry))
        first, *listed = [line.strip() for line in told.splitlines()]
        self.assertIn(entry, first)
        for ending in (".json", ".csv", ".pdf", ".axiscal"):
            self.assertTrue(any(name.endswith(ending) for name in listed), told)
        self.assertLessEqual(set(listed), set(files))

    def test_json_names_the_papers(self):
        papers = json.loads(self.expect(0, "export", RUN, "--out", self.folder, "--json").stdout)
        self.assertEqual(list(papers), ["entry", "json", "csv", "pdf", "run_file"])
        for path in papers.values():
            self.assertTrue(os.path.exists(path), path)

    def test_a_circular_case_becomes_papers(self):
        case = self.file("circle.json", json.dumps({
            "analysis": "circular", "nominal_radius_mm": 150, "feed_mm_per_min": 750,
            "traces": [{"sense": "ccw", "angle_rad": [0, 1, 2, 3, 4, 5, 6],
                        "radial_deviation_mm": [0, 0.001, 0, 0.001, 0, 0.001, 0]}]}))
        papers = json.loads(self.expect(0, "export", case, "--out", self.folder, "--json").stdout)
        self.assertEqual(list(papers), ["entry", "json", "csv", "pdf", "case"])
        with open(papers["json"], encoding="utf-8") as file:
            certificate = json.load(file)
        told = json.loads(self.expect(0, "analyze", case).stdout)
        self.assertEqual(certificate["parameters"], told["parameters"])

    def test_what_is_no_run_is_refused_with_a_sentence(self):
        for words in ([], ["--json"]):
            got = self.expect(3, "export", self.file("x.axiscal", "no run"), "--out", self.folder, *words)
            self.assertEqual(got.stdout, "")
            self.assertIn("x.axiscal", got.stderr)


class Daemon(Scratch):
    """A real axiscald whose instruments are not there."""

    def setUp(self):
        super().setUp()
        text = example_text()
        with socket.socket() as probe:  # free now; nothing else asks for it in the next second
            probe.bind(("127.0.0.1", 0))
            self.port = probe.getsockname()[1]
        self.socket = os.path.join(self.folder, "d.sock")
        text = text.replace('# state_directory = "/var/lib/axiscal"', f'state_directory = "{self.folder}/state"')
        text = text.replace("[console]\n", f'[console]\nsocket = "{self.socket}"\ngroup = ""\nport = {self.port}\n')
        text = re.sub(r"^port = 1502$", f"port = {self.free_port()}", text, flags=re.M)
        config = self.file("station.toml", text)
        self.log = open(os.path.join(self.folder, "log"), "w", encoding="utf-8")
        self.daemon = subprocess.Popen([os.path.join(BIN, "axiscald"), "--config", config],
                                       stderr=self.log, stdout=self.log)
        self.addCleanup(self.end)
        for _ in range(200):
            if os.path.exists(self.socket) and run("status", "--socket", self.socket).returncode == 0:
                return
            self.assertIsNone(self.daemon.poll(), "axiscald ended")
            time.sleep(0.05)
        self.fail("axiscald does not answer")

    @staticmethod
    def free_port():
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            return probe.getsockname()[1]

    def end(self):
        self.daemon.terminate()
        self.assertEqual(self.daemon.wait(20), 0)
        self.log.close()

    def test_doors_and_rights(self):
        local, tcp = ["--socket", self.socket], ["--host", f"127.0.0.1:{self.port}"]
        shown = self.expect(0, "status", *local).stdout
        self.assertIn("- - -", shown)
        self.assertNotIn(" 0.00 °C", shown)
        self.expect(0, "devices", *tcp)
        self.expect(0, "watch", *tcp)
        self.assertEqual(json.loads(self.expect(0, "status", "--json", *tcp).stdout)["protocol"], "axiscal/1")
        without = self.expect(4, "arm", *tcp)
        self.assertIn("token", without.stderr)
        token = ["--token-file", os.path.join(self.folder, "state", "token")]
        within = self.expect(4, "arm", *tcp, *token)  # reaches the station: nothing is plugged in
        self.assertNotIn("token", within.stderr)
        self.assertEqual(within.stderr, self.expect(4, "arm", *local).stderr)
        self.expect(4, "trigger", *local)
        self.expect(4, "abort", *local)
        self.expect(3, "arm", "--program", self.file("other.ngc", "(nothing)\n"), *local)
        self.expect(3, "arm", "--program", self.file("odd.ngc", "(seed=x pass=whole)\n"), *local)

    def test_a_second_daemon_is_refused(self):
        second = subprocess.run([os.path.join(BIN, "axiscald"), "--config", os.path.join(self.folder, "station.toml")],
                                capture_output=True, text=True, timeout=20)
        self.assertEqual(second.returncode, 1)
        self.assertIn("another axiscald", second.stderr)


class NoDaemon(Scratch):
    def test_it_is_said_where_it_was_looked_for(self):
        nowhere = os.path.join(self.folder, "none.sock")
        for words in (["status"], ["watch"], ["arm"], ["trigger"], ["abort"]):
            self.assertIn(nowhere, self.expect(5, *words, "--socket", nowhere).stderr)
        self.expect(5, "status", env={"AXISCAL_SOCKET": nowhere})
        self.expect(0, "devices", "--drivers")
        self.assertIn(nowhere, self.expect(0, "devices", "--socket", nowhere).stdout)
        self.expect(5, "devices", "--host", "127.0.0.1:1")


class Plugged(Scratch):
    """Folders laid out as /sys and /dev are."""

    def plug(self, port, vendor, product, serial="", tty="", by_id="", driver="", its_class="00"):
        device = os.path.join(self.sys, "devices/pci0000:00/usb1", port)
        interface = os.path.join(device, port + ":1.0")
        os.makedirs(interface)
        number = len(os.listdir(os.path.dirname(device)))
        for name, text in (("idVendor", vendor), ("idProduct", product), ("serial", serial), ("busnum", "1"),
                           ("bDeviceClass", its_class), ("devnum", str(number))):
            if text:
                with open(os.path.join(device, name), "w", encoding="ascii") as out:
                    out.write(text + "\n")
        self.link(os.path.join(self.sys, "bus/usb/devices", port), device)
        self.touch(os.path.join(self.dev, f"bus/usb/001/{number:03d}"))
        if tty:
            folder = os.path.join(interface, "tty", tty)
            os.makedirs(folder)
            os.symlink(interface, os.path.join(folder, "device"))
            self.link(os.path.join(interface, "driver"), os.path.join(self.sys, "bus/usb/drivers", driver))
            self.link(os.path.join(self.sys, "class/tty", tty), folder)
            self.touch(os.path.join(self.dev, tty))
            self.link(os.path.join(self.dev, "serial/by-id", by_id), os.path.join(self.dev, tty))

    @staticmethod
    def link(name, target):
        os.makedirs(os.path.dirname(name), exist_ok=True)
        os.symlink(target, name)

    @staticmethod
    def touch(path):
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="ascii"):
            pass

    def setUp(self):
        super().setUp()
        self.sys, self.dev = os.path.join(self.folder, "sys"), os.path.join(self.folder, "dev")


class Devices(Plugged):
    """What is plugged in, without a daemon."""

    def setUp(self):
        super().setUp()
        self.plug("1-1", "16c0", "0483", "7391231", "ttyACM0", "usb-Teensyduino_7391231-if00", "cdc_acm")
        self.plug("1-2", "289b", "0505", "E24638", "ttyACM1", "usb-Dracal_E24638-if00", "cdc_acm")
        self.plug("1-3", "0cd5", "0006")  # a U6 tells its number only when it is opened
        self.plug("1-4", "0403", "6001", "A600AXIS", "ttyUSB0", "usb-FTDI_A600AXIS-if00-port0", "ftdi_sio")
        for name in ("w1_bus_master1", "28-0000075b3c2a"):
            self.link(os.path.join(self.sys, "bus/w1/devices", name), os.path.join(self.sys, "devices", name))

    def devices(self, *words):
        return self.expect(0, "devices", "--sysfs", self.sys, "--dev", self.dev, "--socket",
                           os.path.join(self.folder, "none.sock"), *words).stdout

    def test_every_block_is_accepted_by_check_config(self):
        station = self.file("station.toml", example_text())
        found = json.loads(self.devices("--config", station, "--json"))["plugged"]
        blocks = {one["driver"]: one["block"] for device in found for one in device["could_be"]}
        self.assertEqual(set(blocks), {"umd", "dracal-vcp", "labjack-u6", "vaisala", "ascii-gauge", "modbus", "ds18b20"})
        for driver, block in blocks.items():
            self.assertIn(f'driver = "{driver}"', block)
            profile = os.path.join(SOURCE, "config", "profiles")
            path = self.file(driver + ".toml", example_text() + "\n" + block)
            self.expect(0, "check-config", path, env={"AXISCAL_PROFILE_PATH": profile})

    def test_a_block_that_was_added_makes_the_device_known(self):
        station = self.file("station.toml", example_text())
        [stick] = [one for one in json.loads(self.devices("--as", "dracal-vcp", "--config", station, "--json"))["plugged"]]
        self.assertIsNone(stick["in_station"])
        self.assertEqual(stick["usb"]["serial"], "E24638")
        with open(station, "a", encoding="utf-8") as out:
            out.write("\n" + stick["could_be"][0]["block"])
        shown = self.devices("--config", station)
        self.assertIn('in the station file as "air-2"', shown)

    def test_people_read_what_it_could_be_and_the_lines_to_add(self):
        shown = self.devices("--config", os.path.join(self.folder, "nothing.toml"))
        self.assertIn("There is no station file", shown)
        self.assertIn("LabJack U6", shown)
        self.assertIn('        link = "usb-port:1-3"', shown)
        self.assertIn("axiscal devices --as DRIVER", shown)  # four could sit behind the adapter
        self.assertIn('        model = "ptu300"', self.devices("--as", "vaisala"))
        self.assertIn("did you mean \"vaisala\"", self.expect(2, "devices", "--as", "vaisalla").stderr)

    def test_a_device_that_tells_its_number_only_when_opened_may_be_the_one_that_is_meant(self):
        station = self.file("station.toml", example_text() + '\n[[instrument]]\nname = "ballbar"\ndriver = "labjack-u6"\n'
                            'link = "usb:470012345"\nscale_length = "1 mm"\n')
        [bar] = json.loads(self.devices("--as", "labjack-u6", "--config", station, "--json"))["plugged"]
        self.assertEqual((bar["in_station"], bar["may_be"]), (None, ["ballbar"]))
        self.assertIn('    may be "ballbar" of the station file: its serial number', self.devices("--config", station))


class Doctor(Scratch):
    def setUp(self):
        super().setUp()
        self.share = os.path.join(self.folder, "share")
        self.state = os.path.join(self.folder, "state")
        os.makedirs(self.share)
        os.makedirs(self.state)
        text = example_text().replace('# state_directory = "/var/lib/axiscal"', f'state_directory = "{self.state}"')
        text = text.replace("[console]\n", f'[console]\nsocket = "{self.folder}/none.sock"\ngroup = ""\nport = 0\n')
        text = text.replace('"/mnt/quality/axiscal"', f'"{self.share}"')
        text = text.replace('due_on = "2027', 'due_on = "2099')  # the laser's and the air sensor's are in March
        self.port = Daemon.free_port()
        text = re.sub(r"^port = 1502$", f"port = {self.port}", text, flags=re.M)
        for name in ("laser", "air", "material"):  # no terminals, but they are there
            self.file(name)
        lines = iter(("laser", "air", "material"))
        text = re.sub(r'^link = "serial:.*"$', lambda _: f'link = "serial:{self.folder}/{next(lines)}"', text, flags=re.M)
        self.text = text

    def doctor(self, code, text, *words):
        path = self.file("station.toml", text)
        told = json.loads(self.expect(code, "doctor", path, "--json", *words).stdout)
        self.assertEqual(told["broken"], sum(one["health"] == "broken" for one in told["findings"]))
        for one in told["findings"]:
            self.assertNotIn("\n", one["mend"])
        return [(one["area"], one["what"]) for one in told["findings"] if one["health"] == "broken"]

    def healthy(self):
        """What is broken here although the station is right: a scratch folder may lie in memory."""
        path = self.file("station.toml", self.text)
        got = run("doctor", path, "--json")
        broken = [one for one in json.loads(got.stdout)["findings"] if one["health"] == "broken"]
        self.assertEqual([one for one in broken if "tmpfs" not in one["what"]], [], got.stdout)
        return len(broken)

    def broken_by(self, change, area, words):
        """One change makes one finding more, and exit 9."""
        before = self.healthy()
        broken = self.doctor(9, change(self.text))
        self.assertEqual(len(broken), before + 1, broken)
        [what] = [what for its_area, what in broken if its_area == area and words in what]
        return what

    def test_a_station_in_order_has_nothing_broken(self):
        if self.healthy() == 0:
            shown = self.expect(0, "doctor", os.path.join(self.folder, "station.toml")).stdout
            self.assertIn("Nothing is broken", shown)
            for area in ("rights", "wire", "certificate", "clock", "disk", "share", "port", "kernel", "papers"):
                self.assertIn(area, shown)
        self.assertEqual(os.listdir(self.state), [], "the trial commit left something behind")

    def test_an_instrument_that_is_not_plugged_in(self):
        self.broken_by(lambda text: text.replace(f"{self.folder}/air", f"{self.folder}/nothing"), "wire", '"air"')

    def test_a_tape_in_the_place_of_an_instrument(self):
        tape = os.path.join(SOURCE, "tests", "traces", "dracal-vcp-pth450.tape")
        driver = 'driver = "dracal-vcp"\n'
        self.broken_by(lambda text: text.replace(driver, f'{driver}tape = "{tape}"\n'), "station", '"air" plays the tape')

    def test_a_certificate_that_ended(self):
        self.broken_by(lambda text: text.replace("2099-02-10", "2026-03-01"), "certificate", '"laser"')

    def test_a_share_that_is_not_there(self):
        self.broken_by(lambda text: text.replace(self.share, self.share + "/gone"), "share", "gone")

    def test_a_port_that_another_program_holds(self):
        before = self.healthy()
        with socket.socket() as other:
            other.bind(("127.0.0.1", self.port))
            other.listen(1)
            broken = self.doctor(9, self.text)
        self.assertEqual(len(broken), before + 1, broken)
        self.assertTrue(any(area == "port" and str(self.port) in what for area, what in broken), broken)

    def test_an_address_that_this_pc_does_not_have(self):
        # 192.0.2.0/24 is for documentation (RFC 5737)
        self.broken_by(lambda text: text.replace('host = "127.0.0.1"\n', 'host = "192.0.2.7"\nallowed_clients = ["192.0.2.8"]\n', 1),
                       "port", "192.0.2.7")

    def test_a_state_directory_that_is_gone(self):
        broken = self.doctor(9, self.text.replace(self.state, self.state + "/gone"))
        self.assertTrue(any(area == "disk" and "gone" in what for area, what in broken), broken)

    def test_a_state_directory_in_memory(self):
        memory = tempfile.mkdtemp(dir="/dev/shm")
        self.addCleanup(shutil.rmtree, memory, True)
        broken = self.doctor(9, self.text.replace(self.state, memory))
        self.assertTrue(any("tmpfs" in what for _, what in broken), broken)

    def test_a_refused_station_file_does_not_end_the_examination(self):
        broken = self.doctor(9, self.text.replace('kind = "linear"', 'kind = "linaer"'))
        self.assertTrue(any(area == "station" and "linear" in what for area, what in broken), broken)
        shown = self.expect(9, "doctor", os.path.join(self.folder, "nothing.toml")).stdout
        for area in ("station", "clock", "kernel", "papers"):
            self.assertIn(area, shown)

    def test_a_kernel_without_a_module_that_is_needed(self):
        modules = os.path.join(self.folder, "modules")
        os.makedirs(modules)
        for name, text in (("modules.dep", "kernel/drivers/usb/class/cdc-acm.ko.xz:\n"), ("modules.builtin", "")):
            with open(os.path.join(modules, name), "w", encoding="ascii") as out:
                out.write(text)
        words = ["--modules", modules, "--sysfs", os.path.join(self.folder, "sys")]
        more = '\n[[instrument]]\nname = "screw"\ndriver = "ds18b20"\nsensors = ["28-0000075b3c2a"]\n'
        broken = self.doctor(9, self.text + more, *words)
        kernel = [what for area, what in broken if area == "kernel"]
        self.assertEqual(len(kernel), 2, broken)
        self.assertTrue("ds2490" in kernel[0] and "w1_therm" in kernel[1], kernel)
        self.assertIn("Debian's stock kernel does not build", self.expect(9, "doctor", os.path.join(
            self.folder, "station.toml"), *words).stdout)


class Tapes(Scratch):
    FOLDER = os.path.join(SOURCE, "tests", "traces")

    def paths(self, name):
        return os.path.join(self.FOLDER, name + ".tape"), os.path.join(self.FOLDER, name + ".expected")

    def by_driver(self):
        """Names of all tapes, under their drivers."""
        found = {}
        for name in sorted(name[:-5] for name in os.listdir(self.FOLDER) if name.endswith(".tape")):
            header = dict(line.split(" = ", 1) for line in self.text(self.paths(name)[0]).split("\n\n")[0].split("\n"))
            self.assertIn(header["origin"], ("device", "vendor-document", "simulator"), name)
            found.setdefault(header["driver"], []).append(name)
        return found

    @staticmethod
    def text(path):
        with open(path, encoding="utf-8") as source:
            return source.read()

    def test_every_tape_gives_what_is_expected(self):
        found = self.by_driver()
        self.assertGreaterEqual(len(found), 12)
        for driver in set(found) - {"modbus"}:
            for name in found[driver]:
                tape, expected = self.paths(name)
                self.expect(0, "replay", tape, "--expect", expected)

    def test_every_modbus_tape_is_played_on_a_wire_and_nowhere_else(self):
        """What the driver makes of them on such a wire: RtuTape and TcpTape of drivers_tests."""
        names = self.by_driver()["modbus"]
        self.assertGreaterEqual(len(names), 9)
        for name in names:
            tape, expected = self.paths(name)
            self.assertIn("--link", self.expect(3, "replay", tape, "--expect", expected).stderr)
            if "\nwire = tcp\n" in self.text(tape):
                child, link = self.play(name)
                _, host, port = link.split(":")
                with socket.create_connection((host, int(port)), 20) as wire:
                    self.converse(name, wire.sendall, wire.recv)
                    self.assertEqual(child.wait(30), 0, name)
            else:
                path = os.path.join(self.folder, name)
                child, _ = self.play(name, "--link", path)
                tty = os.open(path, os.O_RDWR | os.O_NOCTTY)
                self.converse(name, lambda content: os.write(tty, content), lambda size: os.read(tty, size))
                self.assertEqual(child.wait(30), 0, name)
                os.close(tty)

    def converse(self, name, write, read):
        """As the driver does: asks what stands on the tape, and hears its answers."""
        for direction, content in self.transfers(name):
            if direction == ">":
                write(content)
            while direction == "<" and content:
                heard = read(len(content))
                self.assertTrue(heard and content.startswith(heard), f"{heard} is not {content} of {name}")
                content = content[len(heard):]

    def test_the_first_difference_is_named_and_only_rebuilding_writes(self):
        tape, expected = self.paths("dracal-vcp-pth450")
        text = self.text(expected)
        first = text.split("\n")[0]
        other = self.file("other.expected", text.replace(first, "+0 something else"))
        told = self.expect(7, "replay", tape, "--expect", other).stderr
        self.assertIn("other.expected:1:", told)
        self.assertIn(first, told)
        self.assertIn("something else", self.text(other))
        self.expect(0, "replay", tape, "--rebuild", other)
        self.assertEqual(self.text(other), text)

    def test_a_tape_that_is_none_is_refused_with_its_line(self):
        self.assertIn("line 2", self.expect(3, "replay", self.file("x.tape", "origin = device\n< 5 0g\n")).stderr)
        self.expect(1, "replay", os.path.join(self.folder, "nothing.tape"))
        self.assertIn("driver", self.expect(3, "replay", "--print", self.file("y.tape", "origin = device\n")).stderr)
        tape, _ = self.paths("temper-x")
        told = self.expect(3, "replay", tape).stderr
        self.assertIn("--print", told)
        self.assertIn("--block", told)

    def test_a_tape_tells_the_block_with_which_the_daemon_plays_it(self):
        tape, _ = self.paths("temper-x")
        block = self.expect(0, "replay", os.path.relpath(tape), "--block", "stick").stdout
        station = self.file("bench.toml", example_text() + block)
        self.expect(0, "check-config", station)
        self.assertIn(f'tape = "{tape}"', block)
        self.assertIn("is the tape", self.expect(3, "record", "--config", station, "--instrument", "stick", "--out",
                                                 os.path.join(self.folder, "copy.tape")).stderr)
        self.assertIn("--link", self.expect(3, "replay", self.paths("modbus-m-7015")[0], "--block", "screw").stderr)

    def test_a_tape_that_cannot_stand_in_is_refused_with_its_line(self):
        tape, _ = self.paths("temper-x")
        block = self.expect(0, "replay", tape, "--block", "stick").stdout
        damaged = self.file("damaged.tape", "origin = device\n< 5 0g\n")
        nowhere = os.path.join(self.folder, "nowhere.tape")
        for path, word in ((damaged, "tape line 2"), (nowhere, "cannot read"), (self.folder, "cannot read"),
                           ("near.tape", "no full path"), (self.paths("umd2-homodyne")[0], 'the driver "umd"')):
            station = self.file("bench.toml", example_text() + block.replace(tape, path))
            line = next(number for number, text in enumerate(self.text(station).split("\n"), 1) if text.startswith("tape"))
            told = self.expect(3, "check-config", station)
            self.assertIn(f"bench.toml:{line}:", told.stdout + told.stderr)
            self.assertIn(word, told.stdout + told.stderr)
        modbus = example_text().replace('driver = "modbus"\n', f'driver = "modbus"\ntape = "{tape}"\n')
        told = self.expect(3, "check-config", self.file("bench.toml", modbus))
        self.assertIn("a Modbus line is shared", told.stdout + told.stderr)

    def transfers(self, name):
        """(direction, bytes) of a tape."""
        lines = [line.split() for line in self.text(self.paths(name)[0]).split("\n") if line[:2] in ("< ", "> ", "! ")]
        return [(line[0], bytes.fromhex("".join(line[2:]))) for line in lines]

    def play(self, name, *words):
        child = subprocess.Popen([os.path.join(BIN, "axiscal"), "replay", self.paths(name)[0], "--fast", "--json", *words],
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(lambda: (child.kill(), child.wait(), child.stdout.close(), child.stderr.close()))
        ready = json.loads(child.stdout.readline())
        self.assertTrue(ready["ready"])
        return child, ready["link"]

    def reopened(self, path):
        """The terminal that a link leads to once it is there again: nobody can open one whose near end is gone."""
        end = time.monotonic() + 30
        while True:
            self.assertLess(time.monotonic(), end, "the terminal is not back")
            try:
                return os.open(path, os.O_RDWR | os.O_NOCTTY)
            except OSError:
                time.sleep(0.01)

    def test_a_terminal_answers_and_is_unplugged_as_on_the_tape(self):
        path = os.path.join(self.folder, "gauge")
        child, link = self.play("gauge-nd-28x", "--link", path)
        self.assertEqual(link, "serial:" + path)
        transfers = self.transfers("gauge-nd-28x")
        self.assertEqual([direction for direction, _ in transfers].count("!"), 2)
        tty = os.open(path, os.O_RDWR | os.O_NOCTTY)
        for place, (direction, content) in enumerate(transfers):
            if direction == ">":
                os.write(tty, content)
            while direction == "<" and content:
                heard = os.read(tty, len(content))
                self.assertTrue(heard and content.startswith(heard), f"{heard} is not {content}")
                content = content[len(heard):]
            if direction == "!":
                with self.assertRaises(OSError):  # EIO: the other end is gone
                    self.assertEqual(os.read(tty, 1), b"")
                    raise OSError
                os.close(tty)
                if place + 1 < len(transfers):
                    tty = self.reopened(path)
        self.assertEqual(child.wait(30), 0)

    def test_a_port_answers_as_the_tape_does(self):
        child, link = self.play("ids3010-corrects-twice")
        _, host, port = link.split(":")
        with socket.create_connection((host, int(port)), 20) as wire:
            self.converse("ids3010-corrects-twice", wire.sendall, wire.recv)
        self.assertEqual(child.wait(30), 0)

    def test_a_program_that_writes_something_else_is_told_so(self):
        child, link = self.play("ids3010-corrects-twice")
        _, host, port = link.split(":")
        [asked] = [content for direction, content in self.transfers("ids3010-corrects-twice")[:1] if direction == ">"]
        with socket.create_connection((host, int(port)), 20) as wire:
            wire.sendall(b"?" * len(asked))
            self.assertEqual(child.wait(30), 7)
        self.assertIn("transfer 1 of the tape", child.stderr.read())


def station_status(axis, run):
    """As a station answers; of the run only what the test is about, open unless it is complete."""
    return {"station": "bay 3", "utc": "2026-11-21T10:00:00Z", "run_open": run["state"] != "complete", "channels": [],
            "instruments": [], "notes": [], "outbox_entries": 0, "outbox": {"waiting": 0, "oldest_s": None, "alarm": "", "publisher": {
                "runs": True, "destination": "", "state": "idle", "reason": "", "since_utc": ""}},
            "axis": axis, "trigger": {"port": "fake", "cnc_silent": False, "note": ""},
            "run": {"id": "r", "pass": "whole", "file": "f", "step": 3, "steps": 10, "done": 3, "next": None,
                    "last_deviation_um": None, "seconds_left": None, "fault": "", "sentence": "", "certificate": ""} | run}


class OneAnswer(Scratch):
    """A door that answers each program with the status that the test gives."""

    def setUp(self):
        super().setUp()
        self.path = os.path.join(self.folder, "fake.sock")
        self.door = socket.socket(socket.AF_UNIX)
        self.door.bind(self.path)
        self.door.listen(4)
        self.addCleanup(self.door.close)

    def shown(self, status, *words):
        """Exit code and output of `axiscal words`."""
        body = json.dumps(status).encode()
        child = subprocess.Popen([os.path.join(BIN, "axiscal"), *words, "--socket", self.path],
                                 stdout=subprocess.PIPE, text=True)
        client, _ = self.door.accept()
        client.recv(65536)
        client.sendall(b"HTTP/1.1 200 OK\r\nContent-Length: %d\r\nConnection: close\r\n\r\n%s" % (len(body), body))
        client.close()
        shown, _ = child.communicate(timeout=20)
        return child.returncode, shown


class Incomplete(OneAnswer):
    """`watch` against a door that answers with a run that was broken off."""

    def test_an_incomplete_run_ends_watch_with_6(self):
        status = {"run_open": False, "axis": {"position_mm": None, "strength_percent": None},
                  "channels": [], "run": {"id": "r", "state": "incomplete", "step": 3, "steps": 10,
                  "next": None, "last_deviation_um": None, "seconds_left": None,
                  "sentence": "broken off", "certificate": ""}}
        for words in (["watch"], ["watch", "--json"]):
            code, shown = self.shown(status, *words)
            self.assertEqual(code, 6)
            self.assertIn("broken off", shown)


class RotaryUnits(OneAnswer):
    """What the instrument of a rotary axis reads: a length, or of an autocollimator an angle."""

    def words(self, reading):
        """Of `status` and of `watch`: a spread of 0.5 and a synchronisation error of 0.002 thousandths."""
        status = station_status(
            {"name": "A", "kind": "rotary", "reading": reading, "position_mm": 45, "deviation_um": 1,
             "spread_um": 0.5, "strength_percent": None, "still": True},
            {"state": "complete", "last_deviation_um": 1, "last_synchronisation_um": 0.002})
        return self.shown(status, "status")[1] + self.shown(status, "watch")[1]

    def test_what_an_autocollimator_reads_is_shown_in_seconds_of_arc(self):
        shown = self.words("angle")  # a thousandth of a degree is 3.6 seconds of arc
        self.assertIn("spread 1.80 ″", shown)
        self.assertIn("by time 0.0072 ″", shown)
        self.assertNotIn("µm", shown)

    def test_what_an_interferometer_reads_is_a_length(self):
        shown = self.words("length")
        self.assertIn("deviation +3.60 ″   spread 0.50 µm", shown)
        self.assertIn("by time 0.0020 µm", shown)


class Screen(Scratch):
    """`watch` on a terminal, against a door whose axis moves on by 1 mm, and whose strength and time left fall by 1 % and
    1 s, with each answer; `known`: it says where the CNC goes next, and what strength and time there are."""

    CLEAR = "\x1b[H\x1b[2J"

    def setUp(self):
        super().setUp()
        self.path = os.path.join(self.folder, "fake.sock")
        self.asked, self.last, self.known = 0, None, True
        self.door = socket.socket(socket.AF_UNIX)
        self.door.bind(self.path)
        self.door.listen(4)
        answering = threading.Thread(target=self.answer)
        answering.start()
        self.addCleanup(answering.join)
        self.addCleanup(self.door.close)
        self.addCleanup(self.door.shutdown, socket.SHUT_RDWR)  # ends accept()
        self.child, self.terminal = pty.fork()
        if self.child == 0:
            os.execve(os.path.join(BIN, "axiscal"), ["axiscal", "watch", "--socket", self.path],
                      {**os.environ, "TERM": "xterm", "NO_COLOR": "1"})
        self.addCleanup(os.close, self.terminal)
        self.before = termios.tcgetattr(self.terminal)
        self.shown = ""
        self.decode = codecs.getincrementaldecoder("utf-8")().decode

    def answer(self):
        while True:
            try:
                client, _ = self.door.accept()
            except OSError:
                return
            with client:
                client.recv(65536)
                self.asked += 1
                body = json.dumps(self.status()).encode()
                client.sendall(b"HTTP/1.1 200 OK\r\nContent-Length: %d\r\nConnection: close\r\n\r\n%s" % (len(body), body))

    def status(self):
        over = self.last is not None and self.asked > self.last
        channel = {"instrument": "material", "channel": "contact 1", "name": "screw, left", "place": "nut",
                   "kind": "temperature", "medium": "material", "value": 21.5, "unit": "degC", "age_s": 0.1,
                   "quality": "good", "used": True}
        going = self.known and not over
        following = {"target": 6, "nominal_mm": 651.25, "direction": "negative", "approach": 2}
        axis = {"name": "X", "position_mm": self.asked, "deviation_um": None, "spread_um": None,
                "strength_percent": 97.4 - self.asked if self.known else None, "still": False}
        run = {"state": "complete" if over else "armed", "next": following if going else None,
               "seconds_left": 754.6 - self.asked if going else None, "certificate": "outbox/r" if over else ""}
        return station_status(axis, run) | {"channels": [channel]}

    def read_until(self, enough):
        end = time.monotonic() + 30
        while not enough():
            self.assertLess(time.monotonic(), end, repr(self.shown))
            if select.select([self.terminal], [], [], 0.2)[0]:
                try:
                    self.shown += self.decode(os.read(self.terminal, 65536))
                except OSError:  # the other end is closed
                    return

    def end(self):
        """What waitpid says, once it has ended; all that it wrote is in `shown` then."""
        self.read_until(lambda: False)  # what it wrote last stays in the terminal until it is read
        return os.waitpid(self.child, 0)[1]

    def finish(self):
        """The run is over for whoever watches it."""
        self.last = 0
        self.end()

    def test_it_redraws_and_ends_on_ctrl_c(self):
        self.read_until(lambda: self.shown.count(self.CLEAR) >= 4)
        frames = self.shown.split(self.CLEAR)
        self.assertEqual(frames[0], "", "nothing but frames")
        for number in (1, 2, 3):
            self.assertIn(f"{number}.0000 mm", frames[number])
            self.assertIn("screw, left", frames[number])
        os.write(self.terminal, b"\x03")
        status = self.end()
        self.assertTrue(os.WIFSIGNALED(status) and os.WTERMSIG(status) == signal.SIGINT, status)
        self.assertEqual(termios.tcgetattr(self.terminal), self.before)
        # Nothing that would have to be undone: no other screen, no hidden cursor; NO_COLOR: no colour.
        self.assertEqual(set(re.findall(r"\x1b\[[^A-Za-z]*[A-Za-z]", self.shown)), {"\x1b[H", "\x1b[2J"})

    def test_each_frame_tells_the_next_target_the_strength_and_the_time_left(self):
        self.read_until(lambda: self.shown.count(self.CLEAR) >= 4)
        frames = self.shown.split(self.CLEAR)
        for number, left in ((1, "12:34"), (2, "12:33"), (3, "12:32")):  # 753.6 s is 12 min 34 s
            # people count targets and approaches from 1
            self.assertRegex(frames[number], r"(?m)^Next +P7 = 651\.250 mm  ↓ from above  approach 3\r?$")
            self.assertRegex(frames[number], rf"(?m)^Strength +{97 - number} %\r?$")
            self.assertRegex(frames[number], rf"(?m)^Run +r, armed, 3 of 10 points, {left} left\r?$")
        self.finish()

    def test_status_tells_them_and_leaves_out_what_is_not_known(self):
        shown = self.expect(0, "status", "--socket", self.path).stdout
        self.assertRegex(shown, r"(?m)^Next +P7 = 651\.250 mm  ↓ from above  approach 3$")
        self.assertRegex(shown, r"(?m)^Strength +\d\d %$")
        self.assertRegex(shown, r"(?m)^Run .*, 12:\d\d left$")
        self.known = False
        shown = self.expect(0, "status", "--socket", self.path).stdout
        self.assertRegex(shown, r"(?m)^Next +none$")
        self.assertNotIn("Strength", shown)
        self.assertNotIn("left\n", shown)
        self.finish()

    def test_a_log_has_them_in_its_line(self):
        log = subprocess.Popen([os.path.join(BIN, "axiscal"), "watch", "--socket", self.path], stdout=subprocess.PIPE, text=True)
        self.addCleanup(lambda: (log.kill(), log.wait(), log.stdout.close()))
        line = log.stdout.readline()
        self.assertRegex(line, r"^  3/10  next P07 ↓ 3  x .* strength \d\d %  left 12:\d\d$")
        self.finish()
        self.assertEqual(log.wait(30), 0)

    def test_it_ends_with_the_run(self):
        self.last = 2
        status = self.end()
        self.assertTrue(os.WIFEXITED(status) and os.WEXITSTATUS(status) == 0, status)
        self.assertTrue(self.shown.rstrip().endswith("Run r is complete; certificate in outbox/r"), repr(self.shown))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]] + sys.argv[3:])
