#!/usr/bin/env python3
"""A run file of a simulated axis, sealed when it was first evaluated: every later evaluation gives
the same bits, and a figure that was changed meanwhile is refused.

next_year.py AXISCAL SOURCE_FOLDER
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

AXISCAL = os.path.abspath(sys.argv[1])
RUN = os.path.join(os.path.abspath(sys.argv[2]), "tests", "reference", "fifty_points.axiscal")


def analyze(path):
    return subprocess.run([AXISCAL, "analyze", path], capture_output=True, text=True, timeout=60)


class NextYear(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="axiscal-next-year-")
        self.addCleanup(shutil.rmtree, self.folder, True)
        self.copy = os.path.join(self.folder, "run.axiscal")
        shutil.copy(RUN, self.copy)
        with sqlite3.connect(self.copy) as file:
            self.digest, self.document = file.execute("SELECT digest, document FROM result").fetchone()

    def store(self, digest, document, honest_hash):
        with sqlite3.connect(self.copy) as file:
            file.execute("UPDATE result SET digest=?, document=?", (digest, document))
            if honest_hash:
                file.execute("UPDATE result SET hash=?",
                             (hashlib.sha256(f"{digest}\n{document}".encode()).digest(),))

    def test_the_same_bits_come_out(self):
        got = analyze(self.copy)
        self.assertEqual(got.returncode, 0, got.stderr)
        now, then = json.loads(got.stdout), json.loads(self.document)
        self.assertIn(self.digest, got.stdout)
        for part in ("parameters", "positions"):  # shortest exact doubles: equal texts, equal bits
            self.assertEqual(json.dumps(now[part]), json.dumps(then[part]))

    def test_a_changed_figure_is_refused(self):
        figure = repr(json.loads(self.document)["parameters"]["E"]["value"])
        self.assertIn(figure, self.document)
        other = figure[:-1] + ("1" if figure[-1] != "1" else "2")
        self.store(self.digest, self.document.replace(figure, other, 1), honest_hash=False)
        self.assertEqual(analyze(self.copy).returncode, 3)

    def test_another_digest_is_refused_although_its_seal_fits(self):
        self.store(("0" if self.digest[0] != "0" else "1") + self.digest[1:], self.document, honest_hash=True)
        got = analyze(self.copy)
        self.assertEqual(got.returncode, 3, got.stdout[:300])
        self.assertEqual(len(got.stderr.strip().splitlines()), 1)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]] + sys.argv[3:])
