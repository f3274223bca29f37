#!/usr/bin/env python3
"""A real axiscald behind a certificate, as docs/install.md has IT make one: curl, a page's events, scanners, bad files.

tls.py BIN_FOLDER SOURCE_FOLDER   writes only into a scratch folder of its own
"""
import contextlib
import json
import os
import re
import socket
import ssl
import subprocess
import sys
import time
import unittest

from axiscal_cli import BIN, run
from one_daemon import OneDaemon

HANDSHAKE_BEGINS = b"\x16\x03\x01"


def openssl(*words):
    subprocess.run(["openssl", *words], check=True, capture_output=True, timeout=60)


class Tls(OneDaemon):
    def setUp(self):
        super().setUp()
        self.certificate, self.key = os.path.join(self.folder, "fullchain.pem"), os.path.join(self.folder, "key.pem")
        self.make(self.certificate, self.key)

    @staticmethod
    def make(certificate, key, *more):
        openssl("req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-noenc", "-days", "30", "-subj", "/CN=localhost",
                "-addext", "subjectAltName=DNS:localhost,IP:127.0.0.1", "-keyout", key, "-out", certificate, *more)
        os.chmod(key, 0o600)

    def station(self, tls=True):
        return self.station_file(more=f'certificate = "{self.certificate}"\nkey = "{self.key}"\n' if tls else "")

    def begin(self, tls=True):
        self.begin_with(self.station(tls))

    def curl(self, *words, scheme="https", path="/v1/status"):
        return subprocess.run(["curl", "--silent", "--show-error", "--max-time", "30", "--cacert", self.certificate, *words,
                               f"{scheme}://localhost:{self.port}{path}"], capture_output=True, text=True, timeout=60, check=False)

    def maps(self):
        with open(f"/proc/{self.daemon.pid}/maps", encoding="utf-8") as maps:
            return maps.read()

    def connect(self):
        door = socket.create_connection(("localhost", self.port), timeout=30)
        self.addCleanup(door.close)
        return door

    def checked(self):
        return run("check-config", self.station())

    def test_curl_reads_the_status_and_the_page_address_is_https(self):
        self.begin()
        answer = self.curl("--include")
        self.assertEqual(answer.returncode, 0, answer.stderr)
        head, body = answer.stdout.split("\n\n", 1) if "\n\n" in answer.stdout else answer.stdout.split("\r\n\r\n", 1)
        self.assertEqual(json.loads(body)["protocol"], "axiscal/1")
        self.assertNotIn("strict-transport-security", head.lower())
        self.assertIn(f"https://127.0.0.1:{self.port}/", self.expect(0, "pair", "--socket", self.socket).stdout)
        self.assertIn("libssl", self.maps())
        self.assertEqual(subprocess.run(["curl", "--silent", f"https://localhost:{self.port}/"], timeout=60, check=False).returncode, 60,
                         "who does not know the certificate does not take it")

    def test_without_a_certificate_no_openssl_is_loaded(self):
        self.begin(tls=False)
        self.assertEqual(self.curl(scheme="http").returncode, 0)
        for name in ("libssl", "libcrypto", "axiscald-tls"):
            self.assertNotIn(name, self.maps())

    def test_only_tls_1_2_and_newer_is_spoken(self):
        self.begin()
        for newest in ("1.2", "1.3"):
            self.assertEqual(self.curl("--tls-max", newest).returncode, 0, newest)
        hello = b"\x03\x02" + b"r" * 32 + b"\0\0\x04\xc0\x13\x00\x2f\x01\0"  # of TLS 1.1
        door = self.connect()
        door.sendall(b"\x16\x03\x01\0" + bytes([len(hello) + 4]) + b"\x01\0\0" + bytes([len(hello)]) + hello)
        self.assertRegex(door.recv(100), re.compile(rb"^\x15\x03.\0\x02\x02\x46", re.S), "a fatal alert: protocol_version")
        plain = self.curl("--include", scheme="http").stdout
        self.assertTrue(plain.startswith("HTTP/1.1 400"), plain)
        self.assertIn("https://", plain)
        self.assertIn("https://", run("status", "--host", f"localhost:{self.port}").stderr)

    def test_scanners_fill_no_log(self):
        self.begin()
        for _ in range(20):
            door = self.connect()
            door.sendall(b"\0scan\r\n\r\n")
            try:
                self.assertEqual(door.recv(100), b"")
            except ConnectionResetError:
                pass  # hung up on before all was read
        self.until_logged("The console turned 127.0.0.1 away: what it sent was no TLS.")
        self.assertEqual(self.curl().returncode, 0)
        self.end()
        self.assertEqual(self.log().count("The console turned"), 1)

    def test_events_come_over_tls(self):
        self.begin()
        context = ssl.create_default_context(cafile=self.certificate)
        with context.wrap_socket(self.connect(), server_hostname="localhost") as door:
            door.sendall(f"GET /v1/events HTTP/1.1\r\nHost: localhost:{self.port}\r\n\r\n".encode())
            heard = b""
            while b"event: heartbeat" not in heard:
                more = door.recv(65536)
                self.assertTrue(more, heard)
                heard += more
            self.assertIn(b"event: status", heard)
            self.end()
            with contextlib.suppress(OSError):  # how it ends with the process is nobody's promise
                while door.recv(65536):
                    pass

    def test_stalled_handshakes_hold_no_place_for_ever(self):
        self.begin()
        crowd = [self.connect() for _ in range(64)]
        for door in crowd:
            door.sendall(HANDSHAKE_BEGINS)
        self.expect(0, "status", "--socket", self.socket)
        while self.curl().returncode != 0:  # ctest's limit ends it; a handshake has 10 s
            self.assertIsNone(self.daemon.poll())
            time.sleep(0.1)
        self.until_logged("its TLS handshake took too long")

    def test_bad_files_are_refused_with_a_sentence_by_the_check_and_by_the_start(self):
        other, its_key = os.path.join(self.folder, "other.pem"), os.path.join(self.folder, "other.key")
        self.make(other, its_key)
        self.assertEqual(self.checked().returncode, 0)
        for certificate, key, words in ((self.certificate, its_key, "does not belong to the first certificate of"),
                                        ("/nowhere/chain.pem", self.key, "/nowhere/chain.pem is not there"),
                                        (self.key, self.key, "holds no certificate that can be used"),
                                        (self.certificate, self.certificate, "holds no private key")):
            with self.subTest(words):
                right, self.certificate, self.key = (self.certificate, self.key), certificate, key
                refused = self.checked()
                self.assertNotEqual(refused.returncode, 0)
                self.assertRegex(refused.stdout + refused.stderr, r"station\.toml:\d+: console\.(certificate|key): ")
                self.assertIn(words, refused.stdout + refused.stderr)
                start = subprocess.run([os.path.join(BIN, "axiscald"), "--config", self.station()],
                                       capture_output=True, text=True, timeout=60, check=False)
                self.assertEqual(start.returncode, 3, start.stderr)
                self.assertIn(words, start.stderr)
                self.certificate, self.key = right

    def test_what_is_only_worth_a_note_starts(self):
        os.chmod(self.key, 0o644)
        said = self.checked()
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertIn("can be reached by everybody", said.stdout)
        self.begin()
        self.until_logged("can be reached by everybody")
        self.assertEqual(self.curl().returncode, 0)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
