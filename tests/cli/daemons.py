#!/usr/bin/env python3
"""axiscald beside what else is on a computer: another daemon, a terminal that is shut, an address that is not there yet.

daemons.py BIN_FOLDER SOURCE_FOLDER [SUITE]   writes only into scratch folders of its own
"""
import os
import re
import signal
import socket
import subprocess
import sys
import time
import unittest

from axiscal_cli import BIN, Scratch, example_text, run


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def program(name, *words):
    return subprocess.run([os.path.join(BIN, name), *words], capture_output=True, text=True, timeout=60, check=False)


class Neighbours(Scratch):
    def setUp(self):
        super().setUp()
        self.socket = os.path.join(self.folder, "d.sock")

    def station(self, name, host="127.0.0.1", port=0):
        text = example_text().replace('# state_directory = "/var/lib/axiscal"', f'state_directory = "{self.folder}/{name}"')
        console = f'socket = "{self.socket}"\ngroup = ""\nhost = "{host}"\nport = {port}\nallowed_clients = ["127.0.0.1"]\n'
        text = text.replace("[console]\n", "[console]\n" + console)
        return self.file(f"{name}.toml", re.sub(r"^port = 1502$", f"port = {free_port()}", text, flags=re.M))

    def begin(self, config, **more):
        daemon = subprocess.Popen([os.path.join(BIN, "axiscald"), "--config", config],
                                  **{"stderr": subprocess.PIPE, "text": True, **more})
        self.addCleanup(self.end, daemon)
        return daemon

    @staticmethod
    def end(daemon):
        if daemon.poll() is None:
            daemon.terminate()
            daemon.wait(20)
        if daemon.stderr:
            daemon.stderr.close()

    def until_it_answers(self, daemon):
        while run("status", "--socket", self.socket).returncode != 0:  # ctest's limit ends it
            self.assertIsNone(daemon.poll(), "axiscald ended")
            time.sleep(0.02)

    def until_said(self, daemon, words):
        for line in daemon.stderr:
            if words in line:
                return line
        self.fail(f"axiscald ended and never said: {words}")

    def answers(self):
        return run("status", "--socket", self.socket).returncode == 0

    def test_a_second_station_leaves_the_first_one_its_socket(self):
        first = self.begin(self.station("first"))
        self.until_it_answers(first)
        second = self.begin(self.station("second"))
        self.assertEqual(second.wait(20), 1)
        told = second.stderr.read()
        self.assertIn(self.socket, told)
        self.assertIn("another axiscald answers", told)
        self.assertTrue(self.answers(), "the socket is still the first one's")
        self.assertFalse(os.path.exists(os.path.join(self.folder, "second", "runs")), "it touched no instrument and no run")

    def test_of_many_that_begin_at_once_one_answers(self):
        daemons = [self.begin(self.station(f"s{number}"), stderr=subprocess.DEVNULL) for number in range(6)]
        while sum(daemon.poll() is None for daemon in daemons) > 1:
            time.sleep(0.02)
        alive = [daemon for daemon in daemons if daemon.poll() is None]
        self.assertEqual(len(alive), 1)
        self.until_it_answers(alive[0])

    def test_what_a_killed_daemon_left_is_no_obstacle(self):
        killed = self.begin(self.station("first"))
        self.until_it_answers(killed)
        killed.kill()
        killed.wait(20)
        self.assertTrue(os.path.exists(self.socket))
        self.until_it_answers(self.begin(self.station("first")))

    def test_a_file_at_the_path_of_the_socket_stays(self):
        self.socket = self.file("notes.txt", "feeds of bay 3\n")
        daemon = self.begin(self.station("first"))
        self.assertEqual(daemon.wait(20), 1)
        self.assertIn(self.socket, daemon.stderr.read())
        with open(self.socket, encoding="utf-8") as notes:
            self.assertEqual(notes.read(), "feeds of bay 3\n")

    def test_a_hang_up_ends_nothing(self):
        daemon = self.begin(self.station("first"))
        self.until_it_answers(daemon)
        for _ in range(2):
            daemon.send_signal(signal.SIGHUP)
            self.assertIn("station file", self.until_said(daemon, "SIGHUP"))
            self.assertTrue(self.answers())
        daemon.terminate()
        self.assertEqual(daemon.wait(20), 0)
        self.assertFalse(os.path.exists(self.socket))

    def test_a_console_address_that_is_not_there_keeps_nothing_else(self):
        # RFC 5737: no computer has this one.
        daemon = self.begin(self.station("first", "192.0.2.77", free_port()))
        self.assertIn("192.0.2.77", self.until_said(daemon, "The console"))
        self.until_said(daemon, "ready")
        self.assertIn("192.0.2.77", run("status", "--socket", self.socket).stdout)

    def test_closed_streams_leave_the_files_alone(self):
        for closed in ("2>&-", ">&- 2>&-", "<&- >&- 2>&-"):
            config = self.station("first")
            daemon = subprocess.Popen(["sh", "-c", f'exec "$0" --config "$1" {closed}', os.path.join(BIN, "axiscald"), config])
            self.addCleanup(self.end, daemon)
            self.until_it_answers(daemon)
            daemon.terminate()
            self.assertEqual(daemon.wait(20), 0)
            state = os.path.join(self.folder, "first")
            self.assertEqual(os.path.getsize(os.path.join(state, "lock")), 0, closed)
            with open(os.path.join(state, "token"), encoding="ascii") as token:
                self.assertRegex(token.read(), r"\A[0-9a-f]{64}\n\Z")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
