#!/usr/bin/env python3
"""A browser is paired with a real axiscald, orders, and is ended: `axiscal pair` and what the pages ask.

pairing.py BIN_FOLDER SOURCE_FOLDER   writes only into a scratch folder of its own
"""
import http.client
import json
import os
import stat
import sys
import unittest

from one_daemon import OneDaemon


class Pairing(OneDaemon):
    def setUp(self):
        super().setUp()
        self.own = f"http://localhost:{self.port}"

    def begin(self, port=None):
        self.begin_with(self.station_file(port))

    def pair(self, *words):
        return self.expect(0, "pair", *words, "--socket", self.socket)

    def ask(self, method, path, body=None, cookie=None, origin=None):
        """Status, JSON and Set-Cookie of the answer, as a browser gets them."""
        door = http.client.HTTPConnection("localhost", self.port, timeout=30)
        try:
            headers = {name: value for name, value in (("Cookie", cookie), ("Origin", origin)) if value}
            door.request(method, path, None if body is None else json.dumps(body), headers)
            answer = door.getresponse()
            return answer.status, json.loads(answer.read()), answer.headers.get("Set-Cookie", "")
        finally:
            door.close()

    def paired(self, name):
        """Cookie of a browser that is paired now."""
        code = json.loads(self.pair(name, "--json").stdout)["code"]
        status, told, cookie = self.ask("POST", "/v1/session", {"code": code}, origin=self.own)
        self.assertEqual((status, told["name"]), (200, name), told)
        return cookie.split(";")[0]

    def test_from_the_code_to_the_end(self):
        self.begin()
        shown = self.pair("tablet 2").stdout
        self.assertRegex(shown, r"(?m)^Code:  \d{4} \d{4} ")
        self.assertIn(f"http://127.0.0.1:{self.port}/", shown)
        self.assertIn('"tablet 2"', shown)
        self.assertIn("No browser is paired", self.pair("--list").stdout)
        cookie = self.paired("tablet 2")

        def abort(**more):
            return self.ask("POST", "/v1/run/abort", {}, **more)[0]
        own_answer = self.expect(4, "abort", "--socket", self.socket).stderr
        self.assertEqual(abort(origin=self.own), 401)
        self.assertEqual(abort(cookie=cookie), 403)
        self.assertEqual(abort(cookie=cookie, origin="http://evil.example"), 403)
        self.assertEqual(abort(cookie=cookie, origin="http://localhost"), 403, "another program's page at port 80")
        status, told, _ = self.ask("POST", "/v1/run/abort", {}, cookie, self.own)
        self.assertIn(status, (404, 409))
        self.assertEqual(told["error"]["sentence"], own_answer.strip())
        self.until_logged("page tablet 2: POST /v1/run/abort")
        self.assertRegex(self.pair("--list").stdout, r"tablet 2: since \S+Z, last order \S+Z")
        self.assertIn("1 pairing is ended", self.pair("--end", "tablet 2").stdout)
        self.assertEqual(abort(cookie=cookie, origin=self.own), 401)
        self.assertIn("--list", self.expect(4, "pair", "--end", "tablet 2", "--socket", self.socket).stderr)

    def test_a_restart_unpairs_nobody_and_a_damaged_file_everybody(self):
        self.begin()
        cookie = self.paired("tablet 2")
        path = os.path.join(self.state, "paired-browsers")
        self.assertEqual(stat.S_IMODE(os.stat(path).st_mode), 0o600)
        with open(path, encoding="utf-8") as kept:
            self.assertNotIn(cookie.split("=")[1], kept.read())
        self.end()
        self.begin()
        self.assertEqual(self.ask("GET", "/v1/session", cookie=cookie)[1]["name"], "tablet 2")
        self.end()
        with open(path, "a", encoding="utf-8") as kept:
            kept.write("spoilt")
        self.begin()
        self.until_logged("paired-browsers is damaged: line 3")
        self.assertIs(self.ask("GET", "/v1/session", cookie=cookie)[1]["paired"], False)
        self.paired("tablet 3")
        self.assertIn("1 pairing is ended", self.pair("--end-all").stdout)

    def test_only_the_station_itself_pairs(self):
        self.begin()
        tcp = ["--host", f"127.0.0.1:{self.port}"]
        token = ["--token-file", os.path.join(self.state, "token")]
        for words in ([], ["--list"], ["--end-all"]):
            self.assertIn("Unix socket", self.expect(4, "pair", *words, *tcp, *token).stderr)
        self.expect(2, "pair", "tablet", "--list", "--socket", self.socket)
        self.expect(2, "pair", "--end", "a", "--end-all", "--socket", self.socket)

    def test_a_shut_door_is_told(self):
        self.begin(port=0)
        self.assertIn("[console]", self.pair().stdout)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
