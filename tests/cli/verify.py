#!/usr/bin/env python3
"""`axiscal verify` names each row that was changed, taken out or put in, whatever its table.

verify.py AXISCAL SOURCE

The chain is computed here a second time, from docs/run-file.md alone, so that files can be forged as
well as a person with the document could do it.
"""
import contextlib
import hashlib
import json
import os
import shutil
import sqlite3
import struct
import subprocess
import sys
import tempfile
import unittest

AXISCAL, SOURCE = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
RUN = os.path.join(SOURCE, "tests", "reference", "fifty_points.axiscal")  # of format 1
SCHEMAS = [os.path.join(SOURCE, "acquisition", "journal", f"schema_{name}.sql")
           for name in ("2", "3_streams", "3", "3_beside", "4")]
TABLES = ["run", "plan", "plan_target", "plan_point", "laser", "material", "air", "uncertainty",
          "uncertainty_target", "statement", "instrument", "channel", "datum", "point", "environment",
          "synchronisation", "event", "closing"]  # in the order in which a header is written


def canonical(table, values):
    def text(tag, data):
        return tag + struct.pack("<Q", len(data)) + data

    out = text(b"t", table.encode())
    for value in values:
        if value is None:
            out += b"n"
        elif isinstance(value, int):
            out += b"i" + struct.pack("<q", value)
        elif isinstance(value, float):
            out += b"r" + struct.pack("<d", value)
        elif isinstance(value, str):
            out += text(b"t", value.encode())
        else:
            out += text(b"b", value)
    return out


def columns_of(base, table):
    return [row[1] for row in base.execute(f"PRAGMA table_info({table})")
            if row[1] not in ("link", "hash")]


def rows_of(base):
    """{link: (table, values)} of the whole chain."""
    rows = {}
    for table in tables_of(base):
        columns = ", ".join(columns_of(base, table))
        for link, *values in base.execute(f"SELECT link, {columns} FROM {table}"):
            rows[link] = (table, values)
    return rows


def tables_of(base):
    there = {row[0] for row in base.execute("SELECT name FROM sqlite_schema")}
    return [table for table in TABLES if table in there]


def chain_anew(base, only=None):
    """Gives every row the hash it needs now; with `only` that row alone."""
    before = bytes(32)
    for link, (table, values) in sorted(rows_of(base).items()):
        right = hashlib.sha256(before + canonical(table, values)).digest()
        if only in (None, link):
            base.execute(f"UPDATE {table} SET hash=? WHERE link=?", (right, link))
        before = base.execute(f"SELECT hash FROM {table} WHERE link=?", (link,)).fetchone()[0]


def make_room(base, link, count=1):
    """Moves every row from `link` on to later numbers."""
    for table in tables_of(base):
        base.execute(f"UPDATE {table} SET link=-(link+?) WHERE link>=?", (count, link))
        base.execute(f"UPDATE {table} SET link=-link WHERE link<0")


def other(value):
    """Another value of the same type; a word that an enumeration knows stays one character off."""
    if value is None:
        return 1.5
    if isinstance(value, int):
        return value + 1
    if isinstance(value, float):
        return value + 0.5
    return value + "x" if isinstance(value, str) else value[:-1] + bytes([value[-1] ^ 1]) if value else b"x"


class Verify(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="axiscal-verify-")
        self.addCleanup(shutil.rmtree, self.folder, True)
        self.whole = os.path.join(self.folder, "whole.axiscal")
        self.make_whole(self.whole)
        self.path = os.path.join(self.folder, "run.axiscal")

    def make_whole(self, path):
        """The reference run in format 4, with rows of every kind that a positioning run has and a result."""
        shutil.copy(RUN, path)
        base = sqlite3.connect(path)
        for name in SCHEMAS:
            with open(name, encoding="utf-8") as schema:
                base.executescript("\n".join(l for l in schema.read().splitlines() if not l.startswith("--")))
        base.execute("PRAGMA user_version=4")
        place = base.execute("SELECT link FROM air").fetchone()[0] + 1
        make_room(base, place, 3)
        base.execute("INSERT INTO uncertainty VALUES(?, NULL, NULL, 2.0, 2e-6, 1e-6, 0.001, NULL, 1.0, "
                     "2e-6, 1.7e-6, 'mean', x'00')", (place,))
        for i, name in enumerate(("A", "B_mean")):
            base.execute("INSERT INTO uncertainty_target VALUES(?, ?, 0.000005, x'00')",
                         (place + 1 + i, name))
        captures = base.execute("SELECT link, -1, id, slope_um_per_s FROM datum UNION ALL "
                                "SELECT link, step, datum_id, slope_um_per_s FROM point ORDER BY link DESC")
        for link, step, datum, slope in captures.fetchall():
            make_room(base, link + 1)
            base.execute("INSERT INTO synchronisation VALUES(?, ?, ?, 40000, ?, x'00')",
                         (link + 1, step, datum, abs(slope) * 40e-6))
        base.execute("DELETE FROM result")
        chain_anew(base)
        base.commit()
        base.close()
        self.assertEqual(self.verify(path)["findings"], [])
        digest = self.verify(path)["result_digest"]
        base = sqlite3.connect(path)
        document = '{"kept": true}'
        base.execute("INSERT INTO result(digest, document, hash) VALUES(?, ?, ?)",
                     (digest, document, hashlib.sha256(f"{digest}\n{document}".encode()).digest()))
        base.commit()
        base.close()

    def verify(self, path, code=0, *words):
        done = subprocess.run([AXISCAL, "verify", path, "--json", *words], capture_output=True, text=True,
                              timeout=60, check=False)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return json.loads(done.stdout)

    def spoil(self, how, code=8):
        """A copy of the whole file, changed by how(base), and what is found in it."""
        self.spoiled(how)
        return self.verify(self.path, code)["findings"]

    def spoiled(self, how):
        shutil.copy(self.whole, self.path)
        with contextlib.closing(sqlite3.connect(self.path)) as base, base:
            how(base)

    def some_rows(self, shares=(0, 0.5, 1)):
        """(table, link, values): first, middle and last of each table."""
        base = sqlite3.connect(self.whole)
        by_table = {}
        for link, (table, values) in sorted(rows_of(base).items()):
            by_table.setdefault(table, []).append((link, values))
        base.close()
        self.assertEqual(sorted(by_table), sorted(TABLES))
        for table, rows in by_table.items():
            for place in sorted({round(share * (len(rows) - 1)) for share in shares}):
                yield (table, *rows[place])

    def test_the_whole_file_is_intact_and_says_so(self):
        told = self.verify(self.whole)
        self.assertTrue(told["intact"] and told["closed"] and told["complete"])
        self.assertEqual(told["rows"]["point"], 50)
        self.assertEqual(len(told["result_digest"]), 64)
        words = subprocess.run([AXISCAL, "verify", self.whole], capture_output=True, text=True, timeout=60,
                               check=False)
        self.assertEqual(words.returncode, 0)
        self.assertIn("each as it was written", words.stdout)

    def test_every_column_of_every_table(self):
        base = sqlite3.connect(self.whole)
        columns = {table: columns_of(base, table) for table in TABLES}
        base.close()
        tried = 0
        for table, link, values in self.some_rows([0.5]):
            for column, value in zip(columns[table] + ["hash"], values + [b"\0" * 32]):
                def change(base, value=value, column=column, table=table, link=link):
                    base.execute(f"UPDATE {table} SET {column}=? WHERE link=?", (other(value), link))

                try:
                    found = self.spoil(change)
                except sqlite3.IntegrityError:  # NULL where none may be, a name twice
                    continue
                tried += 1
                named = [(f["what"], f["table"], f["row"]) for f in found]
                self.assertEqual(named[0], ("changed", table, link), f"{column}: {named}")
                self.assertLessEqual(len(named), 1, f"{column}: {named}")
                self.assertIn(f"row {link} (table {table}", found[0]["sentence"])
        print(f"{tried} changed cells in {len(TABLES)} tables, each named")
        self.assertGreater(tried, 100)

    def test_every_missing_row(self):
        tried = 0
        for table, link, values in self.some_rows():
            found = self.spoil(lambda base: base.execute(f"DELETE FROM {table} WHERE link=?", (link,)))
            tried += 1
            self.assertEqual([(f["what"], f["row"]) for f in found], [("missing", link)])
            self.assertIn(table, found[0]["table"], f"{link}: {found}")
            if table not in ("environment", "event", "uncertainty_target", "instrument"):
                self.assertEqual(found[0]["table"], table, f"{link}: {found}")
            if table == "point":
                self.assertEqual(found[0]["about"], f"step={values[0]}")
            if table == "statement":
                self.assertEqual(found[0]["about"], f"name={values[0]}")
        print(f"{tried} missing rows, each named")

    def test_many_missing_rows_are_told_and_counted(self):
        found = self.spoil(lambda base: base.execute("DELETE FROM point"))
        self.assertEqual({f["what"] for f in found}, {"missing"})
        self.assertEqual(len(found), 50)
        self.assertEqual({f["table"] for f in found}, {"point"})

    def test_a_row_after_the_end(self):
        last = max(link for _, link, _ in self.some_rows())
        for table, link, values in self.some_rows():
            def add(base, table=table, link=link):
                names = ", ".join(c for c in columns_of(base, table))
                base.execute(f"INSERT INTO {table}(link, {names}, hash) SELECT ?, {names}, hash FROM {table} "
                             "WHERE link=?", (last + 1, link))

            try:
                found = self.spoil(add)
            except sqlite3.IntegrityError:  # a step or a name twice: the schema itself forbids it
                continue
            self.assertEqual([(f["what"], f["table"], f["row"]) for f in found], [("added", table, last + 1)])

    def test_a_second_row_of_the_same_number(self):
        for table in TABLES:
            def add(base, table=table):
                names = ", ".join(c for c in columns_of(base, table))
                taken = base.execute("SELECT link FROM point LIMIT 1 OFFSET 20").fetchone()[0]
                base.execute(f"INSERT INTO {table}(link, {names}, hash) SELECT ?, {names}, hash FROM {table} "
                             "LIMIT 1", (taken,))

            try:
                found = self.spoil(add)
            except sqlite3.IntegrityError:
                continue
            self.assertEqual([(f["what"], f["table"]) for f in found], [("added", table)])

    def test_a_row_put_in_between_with_a_hash_that_fits(self):
        def add(base):
            place = base.execute("SELECT link FROM environment ORDER BY link LIMIT 1 OFFSET 100").fetchone()[0]
            make_room(base, place)
            base.execute("INSERT INTO environment SELECT ?, channel, at_ns, value+1, hash FROM environment LIMIT 1",
                         (place,))
            chain_anew(base, place)
            self.place = place

        found = self.spoil(add)
        self.assertEqual([(f["what"], f["row"]) for f in found], [("changed", self.place + 1)])
        self.assertIn(f"row {self.place} (table environment", found[0]["sentence"])

    def test_a_changed_row_with_a_hash_that_fits(self):
        for table, link, values in self.some_rows():
            if table in ("closing", "run"):
                continue  # the last row has no one after it: that is the certificate's part; see below

            def forge(base, table=table, link=link, values=values):
                column = columns_of(base, table)[-1]
                base.execute(f"UPDATE {table} SET {column}=? WHERE link=?", (other(values[-1]), link))
                chain_anew(base, link)

            found = self.spoil(forge)
            self.assertIn(f"row {link} (table {table}", " ".join(f["sentence"] for f in found))

    def test_a_removed_end(self):
        def cut(base):
            base.execute("DELETE FROM closing")

        found = self.spoil(cut)
        self.assertEqual([(f["what"], f["table"]) for f in found], [("missing", "closing")])

    def test_a_renumbered_row(self):
        found = self.spoil(lambda base: base.execute("UPDATE point SET link=100000 WHERE step=7"))
        self.assertEqual({(f["what"], f["about"]) for f in found},
                         {("missing", "step=7"), ("added", "step=7")})

    def test_a_changed_stored_result(self):
        for column, value in (("digest", "0" * 64), ("document", "{}"), ("hash", b"\0" * 32)):
            found = self.spoil(lambda base: base.execute(f"UPDATE result SET {column}=?", (value,)))
            self.assertEqual([(f["what"], f["table"]) for f in found], [("changed", "result")])

    def test_an_added_result_of_other_figures(self):
        def add(base):
            digest, document = "1" * 64, "{}"
            base.execute("INSERT INTO result(digest, document, hash) VALUES(?, ?, ?)",
                         (digest, document, hashlib.sha256(f"{digest}\n{document}".encode()).digest()))

        self.assertEqual(self.spoil(add), [])
        told = self.verify(self.path, 8)
        self.assertIn("1" * 64, told["wrong_result"])

    def test_a_whole_chain_forged_anew_is_told_by_result_and_certificate(self):
        certificate = self.certificate()

        def forge(base):
            base.execute("UPDATE point SET reading_m=reading_m+0.000001 WHERE step=7")
            chain_anew(base)

        self.assertEqual(self.spoil(forge), [])
        told = self.verify(self.path, 8)
        self.assertIn("are not those of its first evaluation", told["wrong_result"])

        def forge_more(base):
            forge(base)
            base.execute("DELETE FROM result")

        self.spoiled(forge_more)
        os.rename(certificate, certificate + ".away")
        self.verify(self.path)  # by itself it is a run file like any other
        os.rename(certificate + ".away", certificate)
        told = self.verify(self.path, 8, "--certificate", certificate)
        places = {finding["place"] for finding in told["certificate_findings"]}
        self.assertIn("/run/run_file_sha256", places)
        self.assertIn("/run/result_digest", places)
        self.assertTrue(any(place.startswith("/parameters") for place in places), places)
        self.assertTrue(any(place.startswith("/run/deviations") for place in places), places)

    def certificate(self):
        """certificate.json of the whole file, beside it."""
        done = subprocess.run([AXISCAL, "analyze", self.whole], capture_output=True, text=True, timeout=60,
                              check=True)
        path = os.path.join(self.folder, "certificate.json")
        with open(path, "w", encoding="utf-8") as out:
            out.write(done.stdout)
        return path

    def test_the_certificate_beside_the_run_is_held_against_it(self):
        path = self.certificate()
        self.assertEqual(self.verify(self.whole)["certificate"], path)
        with open(path, encoding="utf-8") as text:
            document = json.load(text)
        document["parameters"]["A"]["value"] *= 0.9
        with open(path, "w", encoding="utf-8") as out:
            json.dump(document, out)
        told = self.verify(self.whole, 8)
        self.assertEqual([f["place"] for f in told["certificate_findings"]], ["/parameters/A/value"])

    def test_what_is_no_run_file_is_refused(self):
        for content in (b"", b"SQLite format 3\0", b"x" * 5000):
            with open(self.path, "wb") as out:
                out.write(content)
            self.assertFalse(self.verify(self.path, 3)["intact"])
        self.verify(os.path.join(self.folder, "nothing.axiscal"), 1)

    def test_damaged_and_cut_pages_are_refused(self):
        with open(self.whole, "rb") as whole:
            content = whole.read()
        for spoiled in (content[:-4096], content[:20000] + b"\xff" * 4096 + content[24096:]):
            with open(self.path, "wb") as out:
                out.write(spoiled)
            done = subprocess.run([AXISCAL, "verify", self.path], capture_output=True, text=True, timeout=60,
                                  check=False)
            self.assertIn(done.returncode, (3, 8), done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
