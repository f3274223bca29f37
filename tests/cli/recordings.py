#!/usr/bin/env python3
"""A wire that nobody knows is recorded as it is; a tape says what it holds, and becomes a test.

recordings.py BIN_FOLDER SOURCE_FOLDER   writes only into scratch folders of its own
"""
import filecmp
import json
import os
import pty
import socket
import subprocess
import sys
import threading
import tty
import unittest

from axiscal_cli import BIN, SOURCE, Scratch

TRACES = os.path.join(SOURCE, "tests", "traces")
LINE = b"D:1204 N:50211\r\n"


class Recordings(Scratch):
    def recorded(self, link, say, *words, seconds=(1.5, 6, 30)):
        """Runs `record --raw` while say() speaks on the other end; its exit code, what it told, the tape's path.

        Where the computer stood still for that long nothing was heard: then once more, for longer.
        """
        path = os.path.join(self.folder, "strange.tape")
        for span in seconds:
            child = subprocess.Popen([os.path.join(BIN, "axiscal"), "record", "--raw", link, "--seconds", str(span), "--out", path,
                                      "--what", "turned by hand", *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            ended = threading.Event()
            speaker = threading.Thread(target=say, args=(ended,))
            speaker.start()
            told, complaint = child.communicate(timeout=60)
            ended.set()
            speaker.join()
            if child.returncode == 0:
                break
        return child.returncode, told + complaint, path

    def looked_into(self, path):
        return json.loads(self.expect(0, "tape", "check", path, "--json").stdout)

    def test_a_serial_line_without_a_station_file(self):
        ours, theirs = pty.openpty()
        self.addCleanup(os.close, ours)
        self.addCleanup(os.close, theirs)
        tty.setraw(theirs)
        os.set_blocking(ours, False)

        def say(ended):
            while not ended.wait(0.02):
                try:
                    os.write(ours, LINE)
                except BlockingIOError:
                    pass  # nobody reads yet

        code, told, path = self.recorded("serial:" + os.ttyname(theirs), say, "--baud", "9600", "--frame", "8N1")
        self.assertEqual(code, 0, told)
        look = self.looked_into(path)
        self.assertEqual(look["wire"], "serial")
        self.assertEqual(look["from_instrument"]["readable"], 1)
        self.assertGreaterEqual(look["from_instrument"]["lines"], 1)
        self.assertEqual(look["to_instrument"]["bytes"], 0, "it only listens")
        with open(path, encoding="utf-8") as text:
            heard = b"".join(bytes.fromhex(line.split()[2]) for line in text if line.startswith("< "))
        self.assertIn(LINE, heard)
        with open(path, encoding="utf-8") as text:
            header = text.read().split("\n\n")[0]
        self.assertIn("line = 9600 8N1", header)
        self.assertIn("what = turned by hand", header)

    def test_a_connection(self):
        with socket.create_server(("127.0.0.1", 0)) as server:
            server.settimeout(20)

            def say(ended):
                wire, _ = server.accept()
                with wire:
                    wire.sendall(bytes(range(256)))
                    ended.wait(30)

            code, told, path = self.recorded(f"tcp:127.0.0.1:{server.getsockname()[1]}", say)
        self.assertEqual(code, 0, told)
        look = self.looked_into(path)
        self.assertEqual(look["from_instrument"]["bytes"], 256)
        self.assertAlmostEqual(look["from_instrument"]["readable"], 98 / 256, delta=1e-12)

    def test_a_wire_that_says_nothing_and_words_that_are_none(self):
        with socket.create_server(("127.0.0.1", 0)) as server:
            code, told, path = self.recorded(f"tcp:127.0.0.1:{server.getsockname()[1]}", lambda ended: None, seconds=(1.5,))
        self.assertEqual(code, 1, told)
        self.assertIn("nothing came from tcp:", told)
        self.assertFalse(os.path.exists(path))
        out = os.path.join(self.folder, "x.tape")
        self.assertIn("--raw", self.expect(2, "record", "--raw", "com1", "--out", out).stderr)
        self.assertIn("8N1", self.expect(2, "record", "--raw", "serial:/dev/null", "--frame", "9Q1", "--out", out).stderr)
        self.assertIn("baud", self.expect(2, "record", "--raw", "serial:/dev/null", "--baud", "12345", "--out", out).stderr)
        self.assertIn("--instrument", self.expect(2, "record", "--out", out).stderr)
        nowhere = os.path.join(self.folder, "no-folder", "x.tape")
        self.assertIn("no file can be written", self.expect(1, "record", "--raw", "serial:/dev/null", "--out", nowhere).stderr)
        there = self.file("there.tape")
        self.assertIn("never overwritten", self.expect(2, "record", "--raw", "serial:/dev/null", "--out", there).stderr)

    def test_what_is_private_is_named_with_its_place(self):
        said = b"hello jo@example.com from 192.168.1.7 02:42:ac:11:00:02 version 1.2.3\r\n"
        asked = b"read /home/jo/settings\r\n"
        tape = self.file("private.tape", f"who = Jo Miller\nwhat = a test\norigin = device\nwire = serial\n\n< 0 {said.hex()}\n"
                                         f"> 10 {asked.hex()}\n")
        found = {(t["where"], t["what"], t["text"]) for t in self.looked_into(tape)["private"]}
        self.assertEqual(found, {("header who", "name", "Jo Miller"), ("from the instrument", "e-mail address", "jo@example.com"),
                                 ("from the instrument", "IP address", "192.168.1.7"),
                                 ("from the instrument", "hardware address", "02:42:ac:11:00:02"),
                                 ("to the instrument", "home folder", "/home/jo")})
        told = self.expect(0, "tape", "check", tape).stdout
        self.assertIn("Private? header who: name Jo Miller", told)
        self.assertIn("does not state driver", told)
        far = (b"x" * 390 + b" jo.miller@example.com\r").hex()
        tape = self.file("far.tape", f"what = a test\norigin = device\n\n< 0 {far}\n! 5\n! 9\n")
        look = self.looked_into(tape)
        self.assertEqual([t["text"] for t in look["private"]], ["jo.miller@example.com"])
        self.assertEqual(look["openings"], 1)

    def test_our_own_tapes_name_nobody(self):
        for name in sorted(os.listdir(TRACES)):
            if name.endswith(".tape"):
                private = [t for t in self.looked_into(os.path.join(TRACES, name))["private"]
                           if t["what"] != "name" and t["where"] != "header key.link"]  # an instrument's address from its manual
                self.assertEqual(private, [], name)

    def test_a_tape_becomes_a_test_by_one_command(self):
        words = ["tape", "keep", os.path.join(TRACES, "dracal-vcp-pth450.tape"), "--name", "mine", "--folder", self.folder]
        self.expect(0, *words)
        for ending in (".tape", ".expected"):
            kept = os.path.join(self.folder, "mine" + ending)
            self.assertTrue(filecmp.cmp(kept, os.path.join(TRACES, "dracal-vcp-pth450" + ending), shallow=False), kept)
        self.assertIn("is there already", self.expect(3, *words).stderr)
        raw = self.file("raw.tape", "origin = device\nwire = serial\n\n< 0 00\n")
        self.assertIn("driver", self.expect(3, "tape", "keep", raw, "--name", "strange", "--folder", self.folder).stderr)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "strange.tape")))
        self.expect(3, "tape", "check", self.file("none.tape", "hello"))
        self.expect(1, "tape", "check", os.path.join(self.folder, "nowhere.tape"))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
