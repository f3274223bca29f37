#!/usr/bin/env python3
"""tests/support/as_root.py against a sudo of paper: through_sudo.py SOURCE_FOLDER

The stand-in drops the environment as Debian's policy does, and runs the words or refuses. Who is root is said by the script
under test, so that these tests go the same way for root and for everybody else.
"""
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SUPPORT = Path(sys.argv[1]).resolve() / "tests/support"
PATIENCE_S = 30  # only ends a failing test
SUDO = """#!/bin/sh
[ ! -e "$0.refuses" ] || { echo "sudo: a password is required" >&2; exit 1; }
[ "$1" = -n ] || exit 98
shift
[ "$1" != -- ] || shift
exec env -i PATH=/usr/bin:/bin "$@"
"""
SCRIPT = """import os, sys, tempfile, time
sys.path.append({support!r})
import as_root
os.geteuid = lambda: 0 if as_root.CHILD in os.environ else 1000
try:
    as_root.require()
except as_root.NoRoot as why:
    sys.exit(f"told: {{why}}")
open(tempfile.mkdtemp() + "/left", "w")
try:  # before the words: whoever reads them may end it at once
    print(sys.argv[1], os.environ["AXISCAL_PLANTED"], os.environ["PATH"], tempfile.gettempdir(), flush=True)
    time.sleep({sleep_s})
finally:
    open({ended!r}, "w")
sys.exit(7)
"""


class ThroughSudo(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="axiscal-sudo-"))
        self.addCleanup(shutil.rmtree, self.folder, True)
        self.sudo, self.ended = self.folder / "sudo", self.folder / "ended"
        self.sudo.write_text(SUDO)
        self.sudo.chmod(0o755)

    def start(self, sleep_s=0):
        script = self.folder / "script.py"
        script.write_text(SCRIPT.format(support=str(SUPPORT), sleep_s=sleep_s, ended=str(self.ended)))
        self.path = f"{self.folder}:/usr/bin:/bin"
        child = subprocess.Popen([sys.executable, "-B", script, "a word"], text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                 env={"PATH": self.path, "AXISCAL_PLANTED": "two words", "TMPDIR": str(self.folder)})
        self.addCleanup(child.communicate)
        self.addCleanup(child.kill)
        return child

    def scratch_folders(self):
        return list(self.folder.glob("axiscal-root-*"))

    def test_words_environment_and_exit_code_pass_through(self):
        child = self.start()
        said, complained = child.communicate(timeout=PATIENCE_S)
        self.assertEqual(child.returncode, 7, complained)
        self.assertTrue(said.startswith(f"a word two words {self.path} {self.folder}/axiscal-root-"), said)

    def test_what_root_left_is_removed(self):
        self.start().communicate(timeout=PATIENCE_S)
        self.assertTrue(self.ended.exists())
        self.assertEqual(self.scratch_folders(), [])

    def test_a_refusal_is_told_with_its_reason_and_the_way_out(self):
        Path(f"{self.sudo}.refuses").touch()
        child = self.start()
        _, complained = child.communicate(timeout=PATIENCE_S)
        self.assertEqual(child.returncode, 1)
        for words in ("needs root", "a password is required", "run as root"):
            self.assertIn(words, complained)
        self.assertFalse(self.ended.exists())

    def test_the_child_ends_in_order_when_the_parent_is_killed(self):
        child = self.start(sleep_s=2 * PATIENCE_S)
        self.assertIn("a word", child.stdout.readline())
        child.send_signal(signal.SIGKILL)
        try:  # the child under root holds the pipes: they end with it
            child.communicate(timeout=PATIENCE_S)
        except subprocess.TimeoutExpired:
            self.fail("the child goes on without its parent")
        self.assertTrue(self.ended.exists(), "the child did not end in order")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
