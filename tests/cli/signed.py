#!/usr/bin/env python3
"""`axiscal verify` tells who signed a run and whether it is the one that was published.

signed.py AXISCAL SOURCE

Runs, signatures and forgeries are made here from docs/run-file.md alone, with OpenSSL's Ed25519: what the
product calls good was signed by another program, and what a person with the document could forge is forged.
"""
import contextlib
import hashlib
import json
import os
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import unittest

import run_files
from run_files import canonical, chain_anew

AXISCAL, SOURCE = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
RUN = os.path.join(SOURCE, "tests", "reference", "fifty_points.axiscal")


def openssl(*words, data=None):
    done = subprocess.run(["openssl", *words], input=data, capture_output=True, timeout=60, check=False)
    if done.returncode:
        raise AssertionError(done.stderr.decode())
    return done.stdout


class Key:
    def __init__(self, folder, name):
        self.folder, self.secret = folder, os.path.join(folder, name + ".key")
        self.public = os.path.join(folder, name + ".pem")
        openssl("genpkey", "-algorithm", "ed25519", "-out", self.secret)
        openssl("pkey", "-in", self.secret, "-pubout", "-out", self.public)
        self.raw = openssl("pkey", "-in", self.secret, "-pubout", "-outform", "DER")[-32:]

    def sign(self, message):
        path = os.path.join(self.folder, "message")
        with open(path, "wb") as out:
            out.write(message)
        return openssl("pkeyutl", "-sign", "-inkey", self.secret, "-rawin", "-in", path)


def run_id_of(base):
    return base.execute("SELECT run_id FROM run").fetchone()[0]


def sign(base, key, closing, result):
    """The signature of that closing (from 1), and of that result (from 1) or none."""
    closing_hash = base.execute("SELECT hash FROM closing ORDER BY link LIMIT 1 OFFSET ?", (closing - 1,)).fetchone()[0]
    result_hash = None
    if result:
        result_hash = base.execute("SELECT hash FROM result ORDER BY id LIMIT 1 OFFSET ?", (result - 1,)).fetchone()[0]
    message = canonical("signature", [run_id_of(base), closing, closing_hash, result_hash])
    base.execute("INSERT INTO signature(closing, closing_hash, result_hash, public_key, signature) VALUES(?,?,?,?,?)",
                 (closing, closing_hash, result_hash, key.raw, key.sign(message)))


def store(base, digest, document="{}"):
    base.execute("INSERT INTO result(digest, document, hash) VALUES(?, ?, ?)",
                 (digest, document, hashlib.sha256(f"{digest}\n{document}".encode()).digest()))


def forge_a_reading(base):
    """Rewrites the whole chain around another reading, and leaves all else as it would be in a whole file."""
    base.execute("UPDATE point SET reading_m=reading_m+0.000001 WHERE step=7")
    chain_anew(base)
    base.execute("DELETE FROM result")


class Signed(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="axiscal-signed-")
        self.addCleanup(shutil.rmtree, self.folder, True)
        self.path = os.path.join(self.folder, "run.axiscal")
        self.key, self.other = Key(self.folder, "station"), Key(self.folder, "other")
        run_files.write(self.path, SOURCE, run_files.linear(RUN))
        self.digest = self.verify(0)["result_digest"]

    def change(self, how):
        with contextlib.closing(sqlite3.connect(self.path)) as base, base:
            how(base)

    def sign_whole(self, key=None):
        def whole(base):
            sign(base, key or self.key, 1, None)
            store(base, self.digest)
            sign(base, key or self.key, 1, 1)

        self.change(whole)

    def verify(self, code, *words):
        done = subprocess.run([AXISCAL, "verify", self.path, "--json", *words], capture_output=True, text=True,
                              timeout=60, check=False)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return json.loads(done.stdout)

    def judged(self, code, *words):
        return self.verify(code, "--public-key", self.key.public, *words)["signature"]

    def receipt(self, **changed):
        """As the publisher writes it (docs/share.md)."""
        with contextlib.closing(sqlite3.connect(self.path)) as base:
            closing = base.execute("SELECT hash FROM closing ORDER BY link DESC LIMIT 1").fetchone()[0].hex()
            number = base.execute("SELECT count(*) FROM closing").fetchone()[0]
            results = base.execute("SELECT hash FROM result ORDER BY id DESC LIMIT 1").fetchone()
            run = run_id_of(base)
        path = os.path.join(self.folder, "receipt.json")
        with open(path, "w", encoding="utf-8") as out:
            json.dump({"format": "axiscal.receipt/1", "run_id": run, "published_utc": "2026-11-21T10:00:00.000Z",
                       "folder": "/mnt/x", "files": [],
                       "closing": {"run_id": run, "number": number, "hash": closing, "result_hash": results and results[0].hex(),
                                   **changed}}, out)
        return path

    def test_what_another_program_signed_by_the_page_is_good(self):
        self.sign_whole()
        told = self.verify(0, "--public-key", self.key.public)
        self.assertEqual((told["signature"], told["anchor"], told["intact"]), ("good", "absent", True))

    def test_without_a_key_from_outside_no_signature_is_good(self):
        self.assertEqual(self.verify(0)["signature"], "absent")
        self.sign_whole()
        self.assertEqual(self.verify(0)["signature"], "unknown_key")
        self.change(forge_a_reading)
        self.assertEqual(self.verify(0)["signature"], "unknown_key")

    def test_a_chain_rewritten_whole_is_found_by_its_signature(self):
        self.sign_whole()
        self.change(forge_a_reading)
        told = self.verify(8, "--public-key", self.key.public)
        self.assertEqual((told["findings"], told["wrong_result"]), ([], None))  # all else fits
        self.assertEqual((told["signature"], told["intact"]), ("bad", False))
        self.assertIn("closing 1", told["signature_sentence"])

    def test_a_chain_rewritten_and_signed_by_a_key_of_the_forger_is_bad(self):
        self.sign_whole()
        self.change(forge_a_reading)

        def sign_anew(base):
            base.execute("DELETE FROM signature")
            sign(base, self.other, 1, None)

        self.change(sign_anew)
        told = self.verify(8, "--public-key", self.key.public)
        self.assertEqual(told["signature"], "bad")
        self.assertIn("none of those given", told["signature_sentence"])

    def test_a_forger_who_names_the_stations_key_is_found(self):
        self.sign_whole(self.other)
        self.change(lambda base: base.execute("UPDATE signature SET public_key=?", (self.key.raw,)))
        self.assertEqual(self.judged(8), "bad")

    def test_a_run_that_bears_the_signature_of_another_is_bad(self):
        self.sign_whole()

        def rename(base):
            base.execute("UPDATE run SET run_id=run_id || 'b'")
            chain_anew(base)

        self.change(rename)
        self.assertEqual(self.judged(8), "bad")

    def test_a_run_cut_back_to_an_earlier_closing_is_good_but_differs_from_the_receipt(self):
        run_files.write(self.path + "2", SOURCE, run_files.revised(RUN))
        os.replace(self.path + "2", self.path)
        with contextlib.closing(sqlite3.connect(self.path)) as base, base:
            for closing in range(1, 6):
                sign(base, self.key, closing, None)
        self.assertEqual(self.judged(0), "good")
        receipt = self.receipt()
        self.assertEqual(self.verify(0, "--receipt", receipt)["anchor"], "match")

        def cut(base):
            third = base.execute("SELECT link FROM closing ORDER BY link LIMIT 1 OFFSET 2").fetchone()[0]
            for table in run_files.tables_of(base):
                base.execute(f"DELETE FROM {table} WHERE link>?", (third,))
            base.execute("DELETE FROM signature WHERE closing>3")

        self.change(cut)
        told = self.verify(8, "--public-key", self.key.public, "--receipt", receipt)
        self.assertEqual((told["signature"], told["anchor"]), ("good", "differs"))

    def test_each_signed_field_that_is_changed_is_found(self):
        changes = {
            "run id": "UPDATE run SET run_id=run_id || 'b'", "number": "UPDATE signature SET closing=closing+1",
            "closing hash": "UPDATE signature SET closing_hash=zeroblob(32)",
            "result hash": "UPDATE signature SET result_hash=zeroblob(32) WHERE result_hash IS NOT NULL",
            "no result": "UPDATE signature SET result_hash=NULL", "key": "UPDATE signature SET public_key=zeroblob(32)",
            "signature": "UPDATE signature SET signature=zeroblob(64)"}
        self.sign_whole()
        whole = self.path + ".whole"
        shutil.copy(self.path, whole)
        for name, sql in changes.items():
            shutil.copy(whole, self.path)

            def spoil(base, sql=sql):
                base.execute(sql)
                chain_anew(base)

            self.change(spoil)
            with self.subTest(name):
                self.assertEqual(self.judged(8), "bad")

    def test_a_changed_row_makes_a_fitting_signature_bad(self):
        self.sign_whole()
        self.change(lambda base: base.execute("UPDATE point SET reading_m=0 WHERE step=7"))
        self.assertEqual(self.judged(8), "bad")

    def test_several_keys_in_one_file_are_all_known(self):
        self.sign_whole()
        both = os.path.join(self.folder, "both.pem")
        with open(both, "w", encoding="utf-8") as out:
            for key in (self.other, self.key):
                with open(key.public, encoding="utf-8") as text:
                    out.write(text.read())
        self.assertEqual(self.verify(0, "--public-key", both)["signature"], "good")

    def test_the_receipt_is_an_anchor(self):
        self.sign_whole()
        self.assertEqual(self.verify(0, "--receipt", self.receipt())["anchor"], "match")
        for wrong in ({"hash": "0" * 64}, {"result_hash": "0" * 64}, {"number": 2}, {"run_id": "another"}):
            self.assertEqual(self.verify(8, "--receipt", self.receipt(**wrong))["anchor"], "differs", wrong)
        right = self.receipt()
        self.change(forge_a_reading)
        told = self.verify(8, "--receipt", right)
        self.assertEqual((told["anchor"], told["signature"]), ("differs", "unknown_key"))

    def test_a_receipt_of_an_older_version_names_the_file_itself(self):
        self.sign_whole()
        path = self.receipt()
        with open(path, encoding="utf-8") as text:
            receipt = json.load(text)
        del receipt["closing"]
        for whole in (True, False):
            with open(self.path, "rb") as run:
                sha256 = hashlib.sha256(run.read()).hexdigest() if whole else "0" * 64
            receipt["files"] = [{"name": "run.axiscal", "bytes": 1, "sha256": sha256}]
            with open(path, "w", encoding="utf-8") as out:
                json.dump(receipt, out)
            told = self.verify(0 if whole else 8, "--receipt", path)
            self.assertEqual(told["anchor"], "match" if whole else "differs")

    def test_words_for_people(self):
        self.sign_whole()
        for words, code, said in (([], 0, "signature of an unknown key"),
                                  (["--public-key", self.key.public], 0, "signature good"),
                                  (["--public-key", self.other.public], 8, "signature bad")):
            done = subprocess.run([AXISCAL, "verify", self.path, *words], capture_output=True, text=True, timeout=60,
                                  check=False)
            self.assertEqual(done.returncode, code, done.stdout + done.stderr)
            self.assertIn(said, done.stdout)

    def test_what_is_no_key_and_no_receipt_is_refused(self):
        for option in ("--public-key", "--receipt"):
            done = subprocess.run([AXISCAL, "verify", self.path, option, RUN], capture_output=True, text=True,
                                  timeout=60, check=False)
            self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
            self.assertIn("fifty_points.axiscal", done.stderr)
            self.verify(1, option, os.path.join(self.folder, "nothing"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
