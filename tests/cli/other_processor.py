#!/usr/bin/env python3
"""What one processor wrote another verifies. glibc's sine, arc sine and exponential take another path where
there is no fused multiply-add; GLIBC_TUNABLES makes this processor one without.

other_processor.py AXISCAL SOURCE_FOLDER

A linear axis gives the same bits. A figure behind such a function agrees to 1e-8 of its unit and 1e-10 of
itself (acquisition/documents/figure_agreement.hpp); on a processor without it nothing differs at all.
"""
import hashlib
import json
import os
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import unittest

import measured_files
import run_files

AXISCAL, SOURCE = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
RUN = os.path.join(SOURCE, "tests", "reference", "fifty_points.axiscal")
CASES = os.path.join(SOURCE, "tests", "reference", "conformance")
HERE = {key: value for key, value in os.environ.items() if key != "GLIBC_TUNABLES"}
OTHER = HERE | {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-FMA,-AVX2,-FMA4,-AVX512F"}
ABSOLUTE, RELATIVE = 1e-8, 1e-10
CHANGED = 1e-6  # a figure that a person changed; a thousandth of a micrometre
FIGURES = ("parameters", "positions")


def run(environment, *words, code=0):
    done = subprocess.run([AXISCAL, *words], env=environment, capture_output=True, text=True, timeout=100, check=False)
    if done.returncode != code:
        raise AssertionError(f"{words} ended with {done.returncode}:\n{done.stdout[-2000:]}{done.stderr}")
    return done.stdout


def leaves(value, place=""):
    """(place, leaf) of a document, in order."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from leaves(inner, f"{place}/{key}")
    elif isinstance(value, list):
        for number, inner in enumerate(value):
            yield from leaves(inner, f"{place}/{number}")
    else:
        yield place, value


def figures_of(certificate):
    """What the first evaluation stores: of each parameter no uncertainty, which no file here states."""
    return {part: certificate[part] for part in FIGURES if part in certificate}


class OtherProcessor(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="axiscal-processor-")
        self.addCleanup(shutil.rmtree, self.folder, True)
        self.path = os.path.join(self.folder, "run.axiscal")
        self.certificate = os.path.join(self.folder, "certificate.json")

    def write_here(self, rows):
        """The run file with its first result, and its certificate, as this processor gives them."""
        run_files.write(self.path, SOURCE, rows)
        first = json.loads(run(HERE, "analyze", self.path))
        digest, document = first["run"]["result_digest"], json.dumps(figures_of(first))
        base = sqlite3.connect(self.path)
        base.execute("INSERT INTO result(digest, document, hash) VALUES(?, ?, ?)",
                     (digest, document, hashlib.sha256(f"{digest}\n{document}".encode()).digest()))
        base.commit()
        base.close()
        certificate = json.loads(run(HERE, "analyze", self.path))
        self.write_certificate(certificate)
        return certificate

    def write_certificate(self, certificate):
        with open(self.certificate, "w", encoding="utf-8") as file:
            json.dump(certificate, file)

    def verify(self, environment, code=0):
        words = ("verify", self.path, "--certificate", self.certificate, "--json")
        return json.loads(run(environment, *words, code=code))

    def agree(self, here, there):
        pairs = list(zip(leaves(here), leaves(there), strict=True))
        differing = 0
        for (place, mine), (same_place, yours) in pairs:
            self.assertEqual(place, same_place)
            if isinstance(mine, float) and isinstance(yours, float):
                self.assertLessEqual(abs(mine - yours), ABSOLUTE + RELATIVE * max(abs(mine), abs(yours)), place)
            else:
                self.assertEqual(mine, yours, place)
            differing += mine != yours
        return differing

    def check(self, rows):
        """Both processors verify the file, agree on its figures, show one digest and name a changed figure."""
        certificate = self.write_here(rows)
        there = json.loads(run(OTHER, "analyze", self.path))
        differing = self.agree(figures_of(certificate), figures_of(there))
        print(f"{self.id()}: {differing} figures differ in their last bits")
        self.assertEqual(there["run"]["result_digest"], certificate["run"]["result_digest"])
        for environment in (HERE, OTHER):
            self.assertTrue(self.verify(environment)["intact"])
        key = next(iter(certificate["parameters"]))
        certificate["parameters"][key]["value"] += CHANGED
        self.write_certificate(certificate)
        for environment in (HERE, OTHER):
            found = self.verify(environment, code=8)["certificate_findings"]
            self.assertEqual([one["place"] for one in found], [f"/parameters/{key}/value"])

    def test_a_linear_axis_has_the_same_bits(self):
        for rows in (run_files.with_synchronisation(run_files.read(RUN)), run_files.scale(RUN)):
            if os.path.exists(self.path):
                os.unlink(self.path)
            self.write_here(rows)
            self.assertEqual(run(HERE, "analyze", self.path), run(OTHER, "analyze", self.path))
            for environment in (HERE, OTHER):
                self.assertTrue(self.verify(environment)["intact"])

    def test_the_least_change_of_a_linear_figure_is_named(self):
        certificate = self.write_here(run_files.with_synchronisation(run_files.read(RUN)))
        certificate["parameters"]["A"]["value"] += 1e-15
        self.write_certificate(certificate)
        self.assertEqual([one["place"] for one in self.verify(OTHER, code=8)["certificate_findings"]],
                         ["/parameters/A/value"])

    def test_a_linear_axis_in_freezing_air_agrees(self):
        self.check(measured_files.freezing(RUN))

    def test_a_rotary_axis_behind_an_indexing_table_agrees(self):
        self.check(measured_files.rotary(RUN))

    def test_a_circular_test_agrees(self):
        self.check(measured_files.circular(RUN))

    def test_a_figure_that_the_file_was_not_evaluated_to_is_refused(self):
        """Digest and stored figure changed, their hash made to fit: another digest alone proves nothing."""
        self.write_here(measured_files.rotary(RUN))
        base = sqlite3.connect(self.path)
        document = json.loads(base.execute("SELECT document FROM result").fetchone()[0])
        document["parameters"]["E"]["value"] += CHANGED
        digest, text = "0" * 64, json.dumps(document)
        base.execute("UPDATE result SET digest=?, document=?, hash=?",
                     (digest, text, hashlib.sha256(f"{digest}\n{text}".encode()).digest()))
        base.commit()
        base.close()
        for environment in (HERE, OTHER):
            run(environment, "analyze", self.path, code=3)

    def test_every_case_of_the_kit_agrees(self):
        for environment in (HERE, OTHER):
            run(environment, "conformance", "--brief", "--cases", CASES)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]] + sys.argv[3:])
