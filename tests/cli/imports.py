#!/usr/bin/env python3
"""Files of other programs become cases whose figures are those of ISO 230-2, computed here by themselves.

imports.py BIN_FOLDER SOURCE_FOLDER [SUITE]   writes only into scratch folders of its own
"""
import hashlib
import io
import json
import os
import random
import resource
import signal
import statistics
import subprocess
import sys
import unittest
import zipfile

import run_files
from axiscal_cli import BIN, RUN, SOURCE, Scratch

TARGETS = [0.0, 47.5, 101.25, 150.0, 204.75]
CYCLES = 5


def deviations(seed):
    """um, [target][cycle] of both directions: a slope, play and scatter."""
    chance = random.Random(seed)
    rows = {"forward": [], "backward": []}
    for target in TARGETS:
        for way, play in (("forward", 0.0), ("backward", -2.2)):
            rows[way].append([round(0.021 * target + play + chance.gauss(0, 0.6), 3) for _ in range(CYCLES)])
    return rows


def figures(forward, backward):
    """ISO 230-2:2014, clause 3, of deviations of both directions."""
    mean_f, mean_b = [statistics.fmean(r) for r in forward], [statistics.fmean(r) for r in backward]
    s_f, s_b = [statistics.stdev(r) for r in forward], [statistics.stdev(r) for r in backward]
    reversal = [f - b for f, b in zip(mean_f, mean_b)]
    middle = [(f + b) / 2 for f, b in zip(mean_f, mean_b)]
    ends = [m + sign * 2 * s for m, s in zip(mean_f + mean_b, s_f + s_b) for sign in (1, -1)]
    both = [max(2 * f + 2 * b + abs(r), 4 * f, 4 * b) for f, b, r in zip(s_f, s_b, reversal)]
    return {"A": max(ends) - min(ends), "E": max(mean_f + mean_b) - min(mean_f + mean_b), "M": max(middle) - min(middle),
            "B": max(abs(r) for r in reversal), "B_mean": statistics.fmean(reversal), "R": max(both),
            "R_forward": max(4 * s for s in s_f), "R_backward": max(4 * s for s in s_b),
            "E_forward": max(mean_f) - min(mean_f), "E_backward": max(mean_b) - min(mean_b)}


def passes(rows):
    """Every reading in the order in which it was taken: (pass from 1, target from 1, cycle, um)."""
    for cycle in range(CYCLES):
        for target in range(len(TARGETS)):
            yield 2 * cycle + 1, target + 1, "up", rows["forward"][target][cycle]
        for target in reversed(range(len(TARGETS))):
            yield 2 * cycle + 2, target + 1, "down", rows["backward"][target][cycle]


def rtl(rows):
    lines = ["HEADER::", "File type  : rtl", "Owner      : Linear", "Version no : V20.02.02", "", "TARGET DATA::",
             "Filetype  : ISO", f"Target-count: {len(TARGETS)}", "Targets :", *(f"  {t:.6f}" for t in TARGETS), "Flags: 0 0 2 0", "",
             "USER-TEXT::", "Machine:中国机床", "Axis:Y", "", "RUNS::", f"Run-count:{2 * CYCLES}", "", "DEVIATIONS::",
             "Run Target Data:", *(f"{run}   {target}   {um:.3f}" for run, target, _, um in passes(rows)), "EOF::", ""]
    return "\r\n".join(lines)


def table(rows):
    lines = ["Maschine;BAZ 4", "", "Lauf;Soll;Fehler;Richtung"]
    lines += [f"{(run + 1) // 2};{TARGETS[target - 1]};{um:.3f};{way}".replace(".", ",") for run, target, way, um in passes(rows)]
    return "\n".join(lines) + "\n"


TABLE_MAP = """kind = "table"
readings = "deviations"
unit = "um"
target_unit = "mm"
axis = "Z"
[columns]
target = "Soll"
reading = "Fehler"
run = "Lauf"
direction = "Richtung"
[direction]
forward = ["up"]
backward = ["down"]
"""


def stream(rows):
    """Between two captures the axis drives and rests; the reference reads the other way round, from 150 mm."""
    lines, clock = [], 0

    def add(name, value):
        nonlocal clock
        clock += 100_000
        second = clock // 1_000_000
        lines.append(f"{name:30} 2026-04-06 {10 + second // 3600:02d}:{second // 60 % 60:02d}:{second % 60:02d}.{clock % 1_000_000:06d} {value}")

    add("IOC:Test", 0)
    for run, target, way, um in passes(rows):
        add("AXIS:Cmd", TARGETS[target - 1])
        for rest in (3.0, 0.4, 0.0):
            add("IOC:Laser", repr(150 - (TARGETS[target - 1] + um * 1e-3 + rest)))
        add("AXIS:Act", f"{TARGETS[target - 1]} LOLO MAJOR")
        add("IOC:Test", f"{1 if way == 'up' else 2}{(run + 1) // 2}{target:02d}")
    return "\n".join(lines) + "\n"


STREAM_MAP = """kind = "stream"
unit = "mm"
[reading]
signal = "IOC:Laser"
scale = -1
offset = 150
take = "last"
[target]
signal = "AXIS:Cmd"
[capture]
signal = "IOC:Test"
digits = "dcpp"
forward = 1
backward = 2
"""


COUNTS_PER_MM = 100_000


def whole_counts(rows):
    return {way: [[round(um, 2) for um in row] for row in found] for way, found in rows.items()}


def umd_log(rows):
    """200 Hz; the axis rests 1 s at each target, and passes the last one and the first one by 3 mm where it turns."""
    lines, at_mm, number = ["", "Sample Frequency = 200.00 Hz", ""], -6.0, 4_000_000_000

    def sample(position_mm):
        nonlocal number
        lines.append(f"D:{round((position_mm + 6) * COUNTS_PER_MM) + 123_456_789} N:{number}")
        number = (number + 1) % 2**32

    def go(to_mm):
        nonlocal at_mm
        while abs(to_mm - at_mm) > 0.4:
            at_mm += 0.4 if to_mm > at_mm else -0.4
            sample(at_mm)
        at_mm = to_mm

    def stand(samples):
        for _ in range(samples):
            sample(at_mm)

    stand(200)
    last = None
    for run, target, way, um in passes(rows):
        if run != last:
            go(TARGETS[0] - 3 if way == "up" else TARGETS[-1] + 3)
            last = run
        go(TARGETS[target - 1] + um * 1e-3)
        stand(200)
    go(-6)
    return "\r\n".join(lines) + "\r\n"


UMD_MAP = """kind = "umd"
axis = "X"
[counts]
wavelength = "640 nm"
per_wavelength = 64
index = 1
[standstill]
targets = [%s]
cycle = "standard"
approaches = 5
bidirectional = true
overrun = "2 mm"
datum = "-6 mm"
window = "0.5 s"
spread_limit = "1 um"
""" % ", ".join(f'"{target} mm"' for target in TARGETS)


def workbook(rows, comma=False, **sheets):
    """An .xlsx: the table of table(), numbers as numbers, deviations as texts with commas where they are wanted."""
    relations = "http://schemas.openxmlformats.org/officeDocument/2006/relationships/"
    texts = ["Lauf", "Soll", "Fehler", "Richtung", "up", "down"]

    def cell(place, value):
        if isinstance(value, str) and value in texts:
            return f'<c r="{place}" t="s"><v>{texts.index(value)}</v></c>'
        if isinstance(value, str):
            return f'<c r="{place}" t="inlineStr"><is><t>{value}</t></is></c>'
        return f'<c r="{place}"><f>{value}+0</f><v>{value!r}</v></c>'

    table_rows = [("Maschine", "BAZ 4"), (), tuple(texts[:4])]
    for run, target, way, um in passes(rows):
        table_rows.append(((run + 1) // 2, TARGETS[target - 1], f"{um:.3f}".replace(".", ",") if comma else um, way))
    inside = "".join(f'<row r="{i}">{"".join(cell("ABCD"[k] + str(i), v) for k, v in enumerate(row))}</row>'
                     for i, row in enumerate(table_rows, 1))
    parts = {"first": "<worksheet><sheetData>" + inside + "</sheetData></worksheet>", **sheets}
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as out:
        out.writestr("_rels/.rels", f'<Relationships><Relationship Id="w" Type="{relations}officeDocument" Target="xl/workbook.xml"/></Relationships>')
        out.writestr("xl/workbook.xml", '<workbook xmlns:r="r"><sheets>' + "".join(
            f'<sheet name="{name}" sheetId="{i}" r:id="r{i}"/>' for i, name in enumerate(parts, 1)) + "</sheets></workbook>")
        out.writestr("xl/_rels/workbook.xml.rels", "<Relationships>" + "".join(
            f'<Relationship Id="r{i}" Type="{relations}worksheet" Target="worksheets/{i}.xml"/>' for i in range(1, len(parts) + 1))
            + f'<Relationship Id="t" Type="{relations}sharedStrings" Target="sharedStrings.xml"/></Relationships>')
        out.writestr("xl/sharedStrings.xml", "<sst>" + "".join(f"<si><t>{text}</t></si>" for text in texts) + "</sst>")
        for i, xml in enumerate(parts.values(), 1):
            out.writestr(f"xl/worksheets/{i}.xml", xml)
    return data.getvalue()


class Import(Scratch):
    def raw(self, name, data):
        path = os.path.join(self.folder, name)
        with open(path, "wb") as out:
            out.write(data)
        return path

    def imported(self, path, *words):
        out = os.path.join(self.folder, "case.json")
        told = self.expect(0, "import", path, *words, "--out", out).stdout
        with open(out, encoding="utf-8") as read:
            return json.load(read), told

    def check(self, path, rows, unit_um, *words):
        case, told = self.imported(path, *words)
        result = json.loads(self.expect(0, "analyze", os.path.join(self.folder, "case.json")).stdout)
        wanted = figures(rows["forward"], rows["backward"])
        for name, um in wanted.items():
            self.assertAlmostEqual(result["parameters"][name]["value"] * unit_um, um, delta=1e-12 * unit_um, msg=name)
        self.assertIn(f"E {wanted['E']:.2f}", told)
        with open(path, "rb") as data:
            self.assertIn(hashlib.sha256(data.read()).hexdigest(), case["source"])
        self.assertIn("imported, readings by others", case["note"])
        return case

    def test_a_laser10_file_in_four_encodings(self):
        rows = deviations(1)
        for name, data in (("utf8", rtl(rows).encode()), ("utf16", rtl(rows).encode("utf-16")), ("gbk", rtl(rows).encode("gbk")),
                           ("latin1", rtl(rows).replace("中国机床", "Fräse").encode("latin-1"))):
            with self.subTest(name):
                case = self.check(self.raw(f"{name}.rtl", data), rows, 1)
                self.assertEqual(case["machine"], "Fräse" if name == "latin1" else "中国机床")
                self.assertEqual(case["axis"]["name"], "Y")
                os.remove(os.path.join(self.folder, "case.json"))

    def test_a_table_of_another_program(self):
        rows = deviations(2)
        case = self.check(self.file("z.csv", table(rows)), rows, 1, "--map", self.file("map.toml", TABLE_MAP))
        self.assertEqual(case["axis"]["name"], "Z")

    def test_a_raw_stream(self):
        rows = deviations(3)
        self.check(self.file("x.log", stream(rows)), rows, 1000, "--map", self.file("map.toml", STREAM_MAP))

    def test_a_log_of_the_umd(self):
        rows = whole_counts(deviations(10))
        log = self.file("x.log", umd_log(rows))
        case = self.check(log, rows, 1000, "--map", self.file("map.toml", UMD_MAP))
        self.assertEqual(case["targets"], TARGETS)
        self.assertIn('a map of kind "umd"', self.expect(3, "import", log).stderr)
        short = self.file("short.toml", UMD_MAP.replace('window = "0.5 s"', 'window = "2 s"'))
        self.assertIn("does not stand where the file begins", self.expect(3, "import", log, "--map", short).stderr)
        other = self.expect(3, "import", log, "--map", self.file("four.toml", UMD_MAP.replace("approaches = 5", "approaches = 4"))).stderr
        self.assertRegex(other, r"line \d+\] the axis stands at target 1 \(0 mm\) after the last point of the plan")

    def test_a_stream_without_triggers(self):
        rows, lines, clock = whole_counts(deviations(11)), [], 0
        for line in umd_log(rows).splitlines():
            if line.startswith("D:"):
                count = int(line.split()[0][2:]) - 123_456_789
                lines.append(f"LASER 2026-04-06 10:{clock // 60_000_000:02d}:{clock // 1_000_000 % 60:02d}.{clock % 1_000_000:06d} {count}")
                clock += 5000
        standstill = UMD_MAP[UMD_MAP.index("[standstill]"):].replace('datum = "-6 mm"\n', "")
        text = f'kind = "stream"\nunit = "mm"\n[reading]\nsignal = "LASER"\nscale = {1 / COUNTS_PER_MM}\noffset = -6\n{standstill}'
        self.check(self.file("x.log", "\n".join(lines) + "\n"), rows, 1000, "--map", self.file("map.toml", text))

    def test_a_workbook_gives_the_figures_of_its_table(self):
        rows, map_file = deviations(12), self.file("map.toml", TABLE_MAP)
        for name, comma in (("numbers", False), ("texts", True)):
            with self.subTest(name):
                book = self.raw(f"{name}.xlsx", workbook(rows, comma))
                case = self.check(book, rows, 1, "--map", map_file)
                os.remove(os.path.join(self.folder, "case.json"))
                text = json.loads(self.expect(0, "import", self.file(f"{name}.csv", table(rows)), "--map", map_file).stdout)
                for key in ("targets", "forward", "backward"):
                    self.assertEqual(case[key], text[key])
        book = self.raw("two.xlsx", workbook(rows, other="<worksheet><sheetData/></worksheet>"))
        for sheet, words in (("other", "no cell with a value"), ("none", 'no sheet "none". It has: first, other')):
            named = self.file(f"{sheet}.toml", f'sheet = "{sheet}"\n' + TABLE_MAP)
            self.assertIn(words, self.expect(3, "import", book, "--map", named).stderr)
        self.assertIn("--map", self.expect(3, "import", book).stderr)
        self.assertIn("is a workbook", self.expect(3, "import", book, "--map", self.file("s.toml", STREAM_MAP)).stderr)

    def test_a_workbook_that_cannot_be_read_says_what_can(self):
        rows, map_file = deviations(13), self.file("map.toml", TABLE_MAP)
        whole, old = workbook(rows), bytes.fromhex("d0cf11e0a1b11ae1") + bytes(512)
        flood = workbook(rows, first="<worksheet>" + " " * (40 << 20) + "</worksheet>")
        self.assertLess(len(flood), 1 << 20)
        for name, data, words in (("old.xls", old, "save it as .xlsx or CSV"), ("flood.xlsx", flood, "unpacks to more than 32 MiB"),
                                  ("secret.xlsx", old + "EncryptedPackage".encode("utf-16-le"), "without a password"),
                                  ("half.xlsx", whole[:len(whole) // 2], "damaged ZIP")):
            with self.subTest(name):
                self.assertIn(words, self.expect(3, "import", self.raw(name, data), "--map", map_file).stderr)

    def test_each_kind_of_file_becomes_a_certificate_in_one_command(self):
        rows, unit = whole_counts(deviations(9)), {"mm": 1000, "deg": 3600}
        averages = "Position   \tForward Directional Avg Error\n" + "".join(f"{t}\t{r[0] / 1000}\n" for t, r in zip(TARGETS, rows["forward"]))
        averages += "Position   \tReverse Directional Avg Error\n" + "".join(f"{t}\t{r[0] / 1000}\n" for t, r in zip(TARGETS, rows["backward"]))
        for name, text, more in (("a.rtl", rtl(rows), []), ("b.csv", table(rows), ["--map", self.file("t.toml", TABLE_MAP)]),
                                 ("c.log", stream(rows), ["--map", self.file("s.toml", STREAM_MAP)]), ("d.pos", averages, []),
                                 ("e.umd", umd_log(rows), ["--map", self.file("u.toml", UMD_MAP)])):
            with self.subTest(name):
                path, papers = self.file(name, text), os.path.join(self.folder, name + "-papers")
                told = json.loads(self.expect(0, "import", path, *more, "--certificate", papers, "--json").stdout)
                with open(os.path.join(told["entry"], "certificate.json"), encoding="utf-8") as read:
                    document = json.load(read)
                self.assertTrue(os.path.exists(os.path.join(told["entry"], "certificate.pdf")))
                if name == "d.pos":
                    self.assertNotIn("A", document["parameters"])
                    self.assertIn("A", document["not_evaluated"])
                else:
                    for figure, um in figures(rows["forward"], rows["backward"]).items():
                        self.assertAlmostEqual(document["parameters"][figure]["value"] * unit[document["unit"]], um, delta=1e-9, msg=figure)
                if more:
                    with open(more[1], "rb") as data:
                        self.assertIn(f"by the map {os.path.basename(more[1])}, SHA-256 {hashlib.sha256(data.read()).hexdigest()}.",
                                      document["run"]["remarks"][0])
                self.assertNotIn("expanded_uncertainty", document["parameters"]["E"])
                with open(path, "rb") as data:
                    self.assertEqual(document["run"]["imported"]["sha256"], hashlib.sha256(data.read()).hexdigest())
                self.assertIn("Imported, readings by others", document["run"]["remarks"][0])
                [run] = [f for f in os.listdir(papers) if f.endswith(".axiscal")]
                self.assertTrue(run.startswith("imported-"))
                self.assertIn("imported, readings by others", self.expect(0, "verify", os.path.join(papers, run)).stdout)
                self.assertTrue(json.loads(self.expect(0, "verify", os.path.join(papers, run), "--json").stdout)["imported"])
                del document["run"]["imported"]
                own = self.file(name + "-own.json", json.dumps(document))
                self.assertIn("/run/imported says null", self.expect(8, "verify", os.path.join(papers, run), "--certificate", own).stdout)
                self.assertIn("exists already", self.expect(3, "import", path, *more, "--certificate", papers).stderr)

    def test_a_map_for_what_needs_one_and_no_file_is_overwritten(self):
        log = self.file("x.log", stream(deviations(4)))
        self.assertIn('a map of kind "stream"', self.expect(3, "import", log).stderr)
        self.assertIn(log, self.expect(3, "import", log).stderr)
        there = self.file("there.json", "{}")
        self.assertIn("is there already", self.expect(3, "import", self.file("a.rtl", rtl(deviations(5))), "--out", there).stderr)
        self.assertIn("map.toml:1: kind", self.expect(3, "import", log, "--map", self.file("map.toml", "kind = 1\n")).stderr)
        self.expect(1, "import", os.path.join(self.folder, "none.rtl"))
        broken = self.expect(3, "import", self.file("b.rtl", rtl(deviations(5))[:200])).stderr
        self.assertIn("has no section", broken)

    def test_a_run_file_that_does_not_fit_on_the_disk_is_not_left_half_written(self):
        """A file may not grow beyond a limit: in steps of a page from below the header to beyond the whole run file."""
        source, whole = self.file("x.rtl", rtl(deviations(14))), os.path.join(self.folder, "whole")
        self.expect(0, "import", source, "--certificate", whole)
        [run] = [f for f in os.listdir(whole) if f.endswith(".axiscal")]
        size, failed = os.path.getsize(os.path.join(whole, run)), 0
        for limit in (4096, *range(size - 10 * 4096, size + 1, 2048)):
            papers = os.path.join(self.folder, str(limit))

            def small_files(limit=limit):
                signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
                resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

            told = subprocess.run([os.path.join(BIN, "axiscal"), "import", source, "--certificate", papers], capture_output=True,
                                  text=True, timeout=60, check=False, preexec_fn=small_files)
            if told.returncode != 0 and "The readings lie in" not in told.stderr:
                failed += 1
                self.assertEqual(told.returncode, 1, told.stderr)
                self.assertEqual(os.listdir(papers), [], (limit, told.stderr))
        self.assertGreater(failed, 1)

    def test_two_files_are_two_cases(self):
        one, two = self.file("a.rtl", rtl(deviations(6))), self.file("b.rtl", rtl(deviations(7)))
        cases = json.loads(self.expect(0, "import", one, two).stdout)
        self.assertEqual([case["source"].split(",")[0] for case in cases], ["a.rtl", "b.rtl"])


def targets_by_prefix(lines):
    """One public reader: keys stand at the begin of their lines, and the list ends with its flags."""
    begin = next(i for i, line in enumerate(lines) if line.startswith("Targets :"))
    end = next(i for i, line in enumerate(lines) if line.startswith("Flags:"))
    count = next(int(line.split(":")[1]) for line in lines if line.startswith("Target-count:"))
    found = [float(word) for line in lines[begin + 1:end] for word in line.split()]
    assert len(found) == count and all(line[0].isdigit() for line in lines[begin + 1:end])
    return found


def readings_by_reversal(lines, targets):
    """A second: no look at the target's number; every second run is reversed. Its line begins with a digit."""
    begin = lines.index("Run Target Data:")
    values = []
    for line in lines[begin + 1:]:
        if line.startswith("E"):
            break
        if line and line[0].isdigit():
            values.append(float(line.split()[2]))
    runs = [values[i:i + targets] for i in range(0, len(values), targets)]
    return [list(reversed(run)) if k % 2 else run for k, run in enumerate(runs)]


def readings_by_four_blanks(lines, targets):
    """A third: value behind four blanks, two blanks between targets, the target's number counts."""
    runs = {}
    for line in lines[lines.index("Run Target Data:") + 1:]:
        if "    " not in line:
            break
        place, value = line.split("    ", 1)
        run, target = place.split()
        runs.setdefault(int(run), {})[int(target)] = float(value)
    return [[runs[run][i + 1] for i in range(targets)] for run in sorted(runs)]


class Export(Scratch):
    def exported(self, form):
        told = self.expect(0, "export", RUN, "--format", form, "--out", self.folder, "--json").stdout
        document = json.loads(self.expect(0, "analyze", RUN).stdout)
        return json.loads(told)["readings"], document

    def test_laser10_text_is_read_by_our_reader_and_by_the_rules_of_three_others(self):
        path, document = self.exported("rtl")
        case = json.loads(self.expect(0, "import", path).stdout)
        with open(path, encoding="ascii", newline="") as text:
            whole = text.read()
        self.assertEqual(whole.count("\r\n"), whole.count("\n"))
        lines = whole.split("\r\n")
        targets = targets_by_prefix(lines)
        self.assertEqual(targets, case["targets"])
        runs = readings_by_four_blanks(lines, len(targets))
        self.assertEqual(runs, readings_by_reversal(lines, len(targets)))
        self.assertEqual(case["forward"], [[run[i] for run in runs[0::2]] for i in range(len(targets))])
        self.assertEqual(case["backward"], [[run[i] for run in runs[1::2]] for i in range(len(targets))])
        self.assertNotRegex(whole.split("DEVIATIONS::")[1].split("ENVIRONMENT::")[0].replace("Run Target Data:", ""), "[eE+]")
        again = json.loads(self.expect(0, "analyze", "-", text=json.dumps(case)).stdout)
        for name, figure in document["parameters"].items():
            self.assertAlmostEqual(again["parameters"][name]["value"], figure["value"] * 1000, delta=1e-5, msg=name)

    def test_a_table_is_taken_by_analyze_as_it_is(self):
        path, document = self.exported("csv")
        again = json.loads(self.expect(0, "analyze", path).stdout)
        for name, figure in document["parameters"].items():
            self.assertAlmostEqual(again["parameters"][name]["value"], figure["value"] * 1000, delta=1e-9, msg=name)

    def test_what_has_no_place_in_laser10_text_is_refused_with_the_way_out(self):
        rows = run_files.with_synchronisation(run_files.read(RUN))
        closing = [1, "again", *(t + 6 * 10**10 for t in rows[-1][1][2:])]
        rows += [("exclusion", [20, rows[-1][1][2], rows[-1][1][3], "a door was open"]), ("closing", closing)]
        revised = os.path.join(self.folder, "revised.axiscal")
        run_files.write(revised, SOURCE, rows)
        told = self.expect(3, "export", revised, "--format", "rtl", "--out", self.folder).stderr
        self.assertIn("no place for a gap; use --format csv", told)
        path = json.loads(self.expect(0, "export", revised, "--format", "csv", "--out", self.folder, "--json").stdout)["readings"]
        with open(path, encoding="utf-8") as text:
            self.assertIn("# left out, step 20\n", text.read())
        self.assertTrue(path.endswith("-r2.csv"), path)
        again = json.loads(self.expect(0, "analyze", path).stdout)
        self.assertEqual(again["completeness"]["used"], 49)
        document = json.loads(self.expect(0, "analyze", revised).stdout)
        for name, figure in document["parameters"].items():
            self.assertAlmostEqual(again["parameters"][name]["value"], figure["value"] * 1000, delta=1e-9, msg=name)


class Judge(Scratch):
    def judged(self, code, report):
        rows = deviations(8)
        case = self.file("case.json", json.dumps({"analysis": "positioning", "standard": "ISO 230-2:2014", "unit": "um", "target_unit": "mm",
                                                  "axis": {"name": "X", "kind": "linear"}, "readings": "deviations", "targets": TARGETS, **rows}))
        right = figures(rows["forward"], rows["backward"])
        text = json.dumps(report(rows, {name: round(um, 2) for name, um in right.items()}))
        return json.loads(self.expect(code, "judge", case, self.file("report.json", text)).stdout), right

    def test_a_report_that_is_right(self):
        answer, _ = self.judged(0, lambda rows, right: {"parameters": right, **rows})
        self.assertEqual(answer, {"verdict": "agrees", "findings": []})

    def test_a_report_whose_tool_computes_e_and_r_of_one_side(self):
        def report(rows, right):
            return {"parameters": right | {"E": right["E_forward"], "R": right["R_backward"], "M": right["M"] + 0.4}}
        answer, right = self.judged(8, report)
        self.assertEqual({f["parameter"]: f["code"] for f in answer["findings"]},
                         {"E": "E_ONE_SIDE", "R": "R_WITHOUT_B", "M": "UNEXPLAINED"})
        for finding in answer["findings"]:
            self.assertAlmostEqual(finding["recomputed"], right[finding["parameter"]], delta=1e-12)

    def test_a_report_with_its_directions_exchanged(self):
        def report(rows, right):
            return {"forward": rows["backward"], "backward": rows["forward"], "parameters": right | {"B_mean": -right["B_mean"]}}
        answer, _ = self.judged(8, report)
        self.assertEqual({f["parameter"]: f["code"] for f in answer["findings"]},
                         {"readings": "DIRECTIONS_SWAPPED", "B_mean": "DIRECTIONS_SWAPPED"})

    def test_what_is_no_report_is_refused_by_name(self):
        case = self.file("case.json", json.dumps({"analysis": "positioning"}))
        self.assertIn("report", self.expect(3, "judge", case, self.file("report.json", "[1]")).stderr)
        self.expect(1, "judge", case, os.path.join(self.folder, "none.json"))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
