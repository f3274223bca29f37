#!/usr/bin/env python3
"""How tools/demo ends, with a planted result: demo_ends.py SOURCE_FOLDER

The real script with paper programs: nothing is measured. Each stand-in is this file under another name; the published figure and
its bound are planted.
"""
import json
import os
import shutil
import socket
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

NAMES = ("axiscal", "axiscald", "axiscal-simulate", "axiscal-publish")
RUN = f"planted-{os.getpid()}"
BOUND_MM = 0.001


def after(word):
    return Path(sys.argv[sys.argv.index(word) + 1])


def simulate():
    """Truth of one figure; or the CNC, which has reached its datum."""
    if sys.argv[1] == "truth":
        after("--truth").write_text(json.dumps({"parameters": {"E": {"value": 0.015, "bound": BOUND_MM}}}))
        return
    with socket.socket(socket.AF_UNIX) as door:
        door.bind(str(after("--control")))
        door.listen()
        print('{"ready":true}', flush=True)
        while True:
            client, _ = door.accept()
            with client:
                client.recv(100)
                client.sendall(b'{"ok":true,"drive_mm":-4.5}\n')


def stand_in(name):
    if name == "axiscal-simulate":
        simulate()
    elif name == "axiscald":
        runs = after("--config").parent / "state/runs"
        runs.mkdir(parents=True)
        (runs / f"{os.environ['PLANTED_RUN']}.axiscal").touch()
    elif name == "axiscal-publish":
        folder = after("--to") / os.environ["PLANTED_RUN"]
        folder.mkdir()
        (folder / "certificate.json").write_text(os.environ["PLANTED_CERTIFICATE"])
    elif sys.argv[1] == "program":
        (after("--out") / "X-whole.ngc").write_text("G1 X-4.5 F20000\n")
    return 0


class DemoEnds(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="axiscal-demo-ends-"))
        self.addCleanup(shutil.rmtree, self.folder, True)
        (self.folder / "bin").mkdir()
        for name in NAMES:
            (self.folder / "bin" / name).symlink_to(Path(__file__).resolve())
        self.papers = SOURCE / "demo-share" / RUN
        self.addCleanup(shutil.rmtree, self.papers, True)

    def demo(self, certificate, *words):
        environment = {**os.environ, "AXISCAL_BUILD": str(self.folder), "TMPDIR": str(self.folder), "PLANTED_RUN": RUN,
                       "PLANTED_CERTIFICATE": certificate, "PYTHONDONTWRITEBYTECODE": "1"}
        return subprocess.run([SOURCE / "tools/demo", *words], env=environment, capture_output=True, text=True, timeout=60, check=False)

    def planted(self, deviation_mm, *words):
        return self.demo(json.dumps({"parameters": {"E": {"value": 0.015 + deviation_mm}}}), *words)

    def test_a_figure_within_its_bound_ends_with_0(self):
        done = self.planted(0.9 * BOUND_MM)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"Certificate: {self.papers}/certificate.pdf\n", done.stdout)

    def test_a_figure_outside_ends_with_1_after_the_certificate_is_told(self):
        done = self.planted(1.1 * BOUND_MM)
        self.assertEqual(done.returncode, 1)
        self.assertIn("OUTSIDE", done.stdout)
        self.assertIn("Outside what the injected noise explains: E", done.stderr)
        self.assertIn(f"Certificate: {self.papers}/certificate.pdf\n", done.stdout)

    def test_a_figure_outside_still_gives_programs_their_one_line(self):
        done = self.planted(1.1 * BOUND_MM, "--json")
        self.assertEqual((done.returncode, done.stdout), (1, f"{self.papers}/certificate-with-truth.json\n"))
        told = json.loads((self.papers / "certificate-with-truth.json").read_text())
        self.assertEqual(told["truth"]["parameters"]["E"]["bound"], BOUND_MM)

    def test_a_certificate_that_is_none_stops_the_demo_without_a_path(self):
        done = self.demo("{", "--json")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("The demo stopped: the truth could not be laid beside", done.stderr)


if __name__ == "__main__":
    if Path(sys.argv[0]).name in NAMES:
        sys.exit(stand_in(Path(sys.argv[0]).name))
    SOURCE = Path(sys.argv[1]).resolve()
    unittest.main(argv=[sys.argv[0]])
