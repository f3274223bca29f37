#!/usr/bin/env python3
"""Where the command line meets its surroundings: outputs that are full, disks, names and addresses, patience, encodings.

edges.py BIN_FOLDER SOURCE_FOLDER [SUITE]   writes only into scratch folders of its own
"""
import json
import os
import re
import resource
import signal
import socket
import stat
import subprocess
import sys
import threading
import unittest

import run_files
from axiscal_cli import BIN, CASE, RUN, SOURCE, Daemon, OneAnswer, Scratch, dwelling_text, example_text, station_status

AXISCAL = os.path.join(BIN, "axiscal")
FULL = "No space left on device"


def written_to(path, *words, program="axiscal"):
    """Exit code and standard error of a program whose standard output is `path`."""
    with open(path, "wb", buffering=0) as out:
        got = subprocess.run([os.path.join(BIN, program), *words], stdout=out, stderr=subprocess.PIPE, text=True, timeout=60)
    return got.returncode, got.stderr


class Output(Scratch):
    """What cannot be written to standard output is told, and exit 0 means that it was."""

    def check_full(self, *words, codes=(1,), program="axiscal"):
        code, told = written_to("/dev/full", *words, program=program)
        self.assertIn(code, codes, f"{words}: {told}")
        self.assertIn(f"{program}: could not write all of its output to standard output: {FULL}", told, words)

    def test_every_command_without_a_daemon_tells_a_full_output(self):
        station, case = self.file("station.toml", example_text()), self.file("case.json", json.dumps(CASE))
        for words in (["analyze", RUN], ["analyze", RUN, "--json"], ["analyze", case], ["result", RUN], ["result", RUN, "--json"],
                      ["check-config", station], ["check-config", station, "--json"], ["program", "--config", station, "--out", self.folder],
                      ["verify", RUN], ["devices", "--drivers"], ["export", RUN, "--out", os.path.join(self.folder, "papers")],
                      ["--help"], ["--version"], ["arm", "--help"], ["--describe"]):
            self.check_full(*words)
        self.check_full("doctor", station, codes=(1, 9))  # its own findings go before
        self.check_full("doctor", station, "--json", codes=(1, 9))

    def test_the_programs_beside_it_tell_a_full_output(self):
        self.check_full(RUN, "--to", self.folder, program="axiscal-report")
        scenario = os.path.join(SOURCE, "tools", "axiscal-simulate", "scenarios")
        first = sorted(name for name in os.listdir(scenario) if name.endswith(".toml"))[0]
        self.check_full("truth", "--scenario", os.path.join(scenario, first), "--targets", "0,100,200", program="axiscal-simulate")

    def test_the_code_of_a_refusal_stays(self):
        code, _ = written_to("/dev/full", "check-config", self.file("station.toml", "x = 1\n"), "--json")
        self.assertEqual(code, 3)

    def test_a_reader_that_has_heard_enough_is_no_alarm(self):
        for ignored, expected in ((False, -signal.SIGPIPE), (True, 1)):  # a shell's child, a service's child
            ends, mouth = os.pipe()
            os.close(ends)
            setting = signal.SIG_IGN if ignored else signal.SIG_DFL
            got = subprocess.run([AXISCAL, "analyze", RUN], stdout=mouth, stderr=subprocess.PIPE, text=True, timeout=60,
                                 restore_signals=False, preexec_fn=lambda: signal.signal(signal.SIGPIPE, setting))
            os.close(mouth)
            self.assertEqual((got.returncode, got.stderr), (expected, ""))

    def test_the_whole_result_reaches_a_file_and_a_pipe(self):
        path = self.file("whole")
        self.assertEqual(written_to(path, "analyze", RUN), (0, ""))
        with open(path, encoding="utf-8") as file:
            self.assertEqual(file.read(), self.expect(0, "analyze", RUN).stdout)


class Answers(OneAnswer):
    """The same with a door that answers, and one that takes its time."""

    def ask(self, *words, **more):
        return subprocess.Popen([AXISCAL, *words, "--socket", self.path], stderr=subprocess.PIPE, text=True, **more)

    def question(self):
        self.door.settimeout(20)
        client, _ = self.door.accept()
        self.addCleanup(client.close)
        return client, client.recv(65536)

    def test_a_full_output_is_told_of_an_answer_and_ends_watching(self):
        body = json.dumps({"run_open": True, "run": None}).encode()
        for words in (["status", "--json"], ["watch", "--json"]):
            with open("/dev/full", "wb", buffering=0) as full:
                child = self.ask(*words, stdout=full)
            client, _ = self.question()
            client.sendall(b"HTTP/1.1 200 OK\r\nContent-Length: %d\r\nConnection: close\r\n\r\n%s" % (len(body), body))
            _, told = child.communicate(timeout=20)
            self.assertEqual(child.returncode, 1, words)
            self.assertIn(FULL, told)

    def test_a_daemon_of_another_version_is_named(self):
        axis = {"name": "X", "position_mm": None, "deviation_um": None, "spread_um": None, "strength_percent": None, "still": False}
        status = station_status(axis, {"state": "complete"})
        self.assertIn("axiscald is version 0.0.9", self.shown(status | {"version": "0.0.9"}, "status")[1])
        self.assertNotIn("version", self.shown(status, "status")[1])

    def test_closed_descriptors_are_taken_by_nothing_else(self):
        child = subprocess.Popen(["/bin/sh", "-c", 'exec "$@" <&- >&- 2>&-', "sh", AXISCAL, "status", "--socket", self.path])
        client, _ = self.question()
        for number in range(3):
            self.assertEqual(os.readlink(f"/proc/{child.pid}/fd/{number}"), "/dev/null")
        client.close()
        self.assertEqual(child.wait(20), 5)

    def test_a_slow_order_is_not_told_as_a_station_that_is_not_started(self):
        for words, way in ((["arm"], "the station may still be arming; axiscal watch"), (["retake", "--reason", "x"], "axiscal status")):
            child = self.ask(*words, "--timeout", "1", stdout=subprocess.DEVNULL)
            self.question()
            _, told = child.communicate(timeout=20)
            self.assertEqual(child.returncode, 5)
            self.assertIn("no answer after 1 s", told)
            self.assertIn(way, told)
            self.assertNotIn("start it", told)

    def test_arming_waits_and_says_so_and_ctrl_c_hangs_up(self):
        child = self.ask("arm", stdout=subprocess.DEVNULL)
        client, _ = self.question()
        self.assertIn("still at work", child.stderr.readline())  # after ten seconds
        child.send_signal(signal.SIGINT)
        client.settimeout(20)
        self.assertEqual(client.recv(1), b"")
        child.communicate(timeout=20)
        self.assertNotEqual(child.returncode, 0)

    def test_a_connection_that_ends_is_told_as_such(self):
        child = self.ask("arm", stdout=subprocess.DEVNULL)
        self.question()[0].close()
        _, told = child.communicate(timeout=20)
        self.assertEqual(child.returncode, 5)
        self.assertIn("ended without an answer", told)
        self.assertNotIn("start it", told)


class Disk(Scratch):
    """A part program is whole or is not there; the one before stays until then."""

    def program(self, *words, limit=None):
        def narrow():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
        return subprocess.run([AXISCAL, *words], capture_output=True, text=True, timeout=60, preexec_fn=narrow if limit else None)

    def read(self, name):
        with open(os.path.join(self.out, name), "rb") as file:
            return file.read()

    def setUp(self):
        super().setUp()
        self.out = os.path.join(self.folder, "out")
        self.station = self.file("station.toml", example_text())

    def check_torn(self, name, *words):
        """Written once; then with no room for more than 512 bytes: told, the good one stays, nothing beside it."""
        self.assertEqual(self.program(*words).returncode, 0)
        good, names = self.read(name), os.listdir(self.out)
        self.assertGreater(len(good), 512)
        got = self.program(*words, limit=512)
        self.assertEqual(got.returncode, 1, got.stderr)
        self.assertIn(f"cannot write {os.path.join(self.out, name)} (File too large)", got.stderr)
        self.assertEqual((self.read(name), sorted(os.listdir(self.out))), (good, sorted(names)))
        os.remove(os.path.join(self.out, name))
        self.assertEqual(self.program(*words, limit=512).returncode, 1)
        self.assertFalse(os.path.exists(os.path.join(self.out, name)), "a torn program bears the name")

    def dwelling(self):
        return self.file("dwell.toml", dwelling_text())

    def test_a_whole_pass_in_each_dialect(self):
        words = ["program", "--out", self.out, "--seed", "7", "--config"]
        self.check_torn("X-whole.ngc", *words, self.station)
        self.check_torn("X-whole.gcode", *words, self.dwelling(), "--dialect", "marlin")

    def test_a_pass_whose_datum_the_cnc_ties(self):
        self.check_torn("X-whole.ngc", "program", "--config", self.station, "--out", self.out, "--seed", "7", "--datum-by-cnc")

    def test_points_to_be_taken_again(self):
        run, rows = os.path.join(self.folder, "revised.axiscal"), run_files.revised(RUN)
        ordered = next(i for i, (table, values) in enumerate(rows) if table == "ordered" and values[0] == "retake")
        run_files.write(run, SOURCE, rows[:ordered + 1])  # asked for, not taken yet
        words = ["program", "--config", self.station, "--out", self.out, "--retake", run]
        written = json.loads(self.program(*words, "--json").stdout)["programs"][0]["file"]
        self.check_torn(os.path.basename(written), *words)

    def test_a_probing_program(self):
        os.makedirs(self.out)
        self.check_torn("probe.ngc", "probing", "program", "--program", os.path.join(self.out, "probe.ngc"))

    def test_a_link_stays_a_link_also_one_that_leads_to_nothing_yet(self):
        os.makedirs(self.out)
        elsewhere = os.path.join(self.folder, "cnc.ngc")
        os.symlink(elsewhere, os.path.join(self.out, "X-whole.ngc"))
        words = ["program", "--config", self.station, "--out", self.out, "--seed", "7"]
        self.assertEqual(self.program(*words).returncode, 0)
        self.assertEqual(self.program(*words).returncode, 0)
        self.assertTrue(os.path.islink(os.path.join(self.out, "X-whole.ngc")))
        self.assertTrue(stat.S_ISREG(os.lstat(elsewhere).st_mode))
        self.assertGreater(len(self.read("X-whole.ngc")), 512)


class Doors(Scratch):
    """Names and addresses behind --host."""

    def door(self, address):
        """Answers each question; what was asked is in self.asked."""
        door = socket.socket(socket.AF_INET6 if ":" in address else socket.AF_INET)
        door.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        door.bind((address, 0))
        door.listen(4)
        self.asked = []

        def serve():
            while True:
                try:
                    client, _ = door.accept()
                except OSError:
                    return
                with client:
                    self.asked.append(client.recv(65536).decode())
                    client.sendall(b"HTTP/1.1 200 OK\r\nContent-Length: 2\r\nConnection: close\r\n\r\n{}")
        threading.Thread(target=serve, daemon=True).start()
        self.addCleanup(door.close)
        self.addCleanup(door.shutdown, socket.SHUT_RDWR)
        return door.getsockname()[1]

    @staticmethod
    def has_ipv6():
        with socket.socket(socket.AF_INET6) as probe:
            try:
                probe.bind(("::1", 0))
            except OSError:
                return False
        return True

    def two_addresses(self):
        link = os.path.join(self.folder, "two_addresses.so")  # LD_PRELOAD takes no space in a name
        os.symlink(os.path.join(BIN, "two_addresses.so"), link)
        return {"LD_PRELOAD": link, "ASAN_OPTIONS": "verify_asan_link_order=0"}

    def test_every_address_of_a_name_is_tried(self):
        environment = self.two_addresses()
        for address in ["127.0.0.1"] + ["::1"] * self.has_ipv6():
            port = self.door(address)
            self.expect(0, "status", "--json", "--host", f"localhost:{port}", env=environment)
            self.assertIn(f"\r\nHost: localhost:{port}\r\n", self.asked[0])
        told = self.expect(5, "status", "--host", f"localhost:{Daemon.free_port()}", env=environment).stderr
        self.assertIn("axiscald does not answer at localhost:", told)
        for address in ["127.0.0.1"] + ["[::1]"] * self.has_ipv6():
            self.assertRegex(told, re.escape(address) + r":\d+ \(Connection refused\)")

    def test_brackets_come_off_for_the_address_and_stay_in_the_host(self):
        if self.has_ipv6():
            port = self.door("::1")
            self.expect(0, "status", "--json", "--host", f"[::1]:{port}")
            self.assertIn(f"\r\nHost: [::1]:{port}\r\n", self.asked[0])
        told = self.expect(5, "status", "--host", f"[::1]:{Daemon.free_port()}").stderr
        self.assertIn("tried [::1]:", told)  # refused, or of no network here; never "cannot resolve"

    def test_an_address_that_is_none_is_wrong_usage_with_the_way_to_write_it(self):
        for written, hint in (("::1:8470", "[::1]:8470"), ("fe80::7:8470", "[fe80::7]:8470"), ("::1", "[::1]:8470"),
                              ("[::1]", "[::1]:8470"), ("bay3-pc", "ADDRESS:PORT")):
            for words in (["status"], ["arm"], ["devices"]):
                self.assertIn(hint, self.expect(2, *words, "--host", written).stderr, words)


class Encoding(Scratch):
    """Bytes that are no text."""

    def refused(self, *words):
        got = subprocess.run([os.fsencode(AXISCAL), *(word if isinstance(word, bytes) else word.encode() for word in words)],
                             capture_output=True, timeout=60)
        self.assertEqual(got.returncode, 2, got.stderr)
        told = got.stderr.decode("utf-8")
        self.assertIn("is not UTF-8", told)
        return told

    def test_a_word_that_is_not_utf_8_is_named_with_escapes(self):
        self.assertIn(r"'operator=M\xfcller'", self.refused("arm", "--state-that", b"operator=M\xfcller"))
        self.assertIn(r"'\xe9'", self.refused("abort", "--reason", b"\xe9"))
        self.assertIn(r"'--by=J\xf6rg'", self.refused("retake", "--reason", "x", b"--by=J\xf6rg"))
        self.refused("exclude", "--reason", b"\xff")
        self.refused("drift", "--by", b"\xed\xa0\x80")  # a surrogate
        self.refused("preflight", "--override", b"soak=\xfc")
        self.refused("record", "--who", b"M\xfcller")
        self.refused(b"st\xe4tus")

    def test_a_file_that_is_there_may_be_called_so(self):
        path = os.fsencode(self.folder) + b"/M\xfcller.json"
        with open(path, "w", encoding="utf-8") as out:
            json.dump(CASE, out)
        got = subprocess.run([os.fsencode(AXISCAL), b"analyze", path], capture_output=True, timeout=60)
        self.assertEqual(got.returncode, 0, got.stderr)


class Token(Daemon):
    """The token file as an editor of Windows saves it."""

    test_doors_and_rights = test_a_second_daemon_is_refused = None  # shown by axiscal_cli.py

    def test_line_ends_blanks_and_the_mark_of_utf_8_are_no_part_of_it(self):
        with open(os.path.join(self.folder, "state", "token"), encoding="ascii") as file:
            token = file.read().strip()
        for content in (token, f"{token}\r\n", f"  {token} \t\r\n\r\n", f"\ufeff{token}\r\n"):
            told = self.expect(4, "trigger", "--host", f"127.0.0.1:{self.port}", "--token-file", self.file("t", content)).stderr
            self.assertNotIn("oken", told, repr(content))

    def test_a_token_file_that_gives_none_is_named(self):
        for path, words in ((self.file("t", " \r\n"), "is empty"), (os.path.join(self.folder, "none"), "No such file"),
                            (self.folder, "Is a directory")):
            told = self.expect(1, "trigger", "--host", f"127.0.0.1:{self.port}", "--token-file", path).stderr
            self.assertIn(f"token file {path}", told)
            self.assertIn(words, told)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]] + sys.argv[3:])
