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
import subprocess
import sys
import tempfile
import unittest

import run_files
from run_files import chain_anew, columns_of, make_room, rows_of

AXISCAL, SOURCE = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
RUN = os.path.join(SOURCE, "tests", "reference", "fifty_points.axiscal")
KINDS = ("linear", "revised", "circular", "rotary", "scale", "imported", "probing", "drift",
         "straightness", "squareness")
# What the schema holds to be unique gets another value in a copied row.
NEW_NAME = {("uncertainty_target", "parameter"): "parameter || '2'", ("statement", "name"): "name || '2'",
            ("standard", "name"): "name || '2'",
            ("channel_calibration", "channel"): "channel + 100", ("linear_scale_sensor", "channel"): "channel + 100",
            ("point", "step"): "step + 1000",
            ("stream", "id"): "id + 100", ("retake", "number"): "number + 100",
            ("retake_point", "step"): "step + 1000", ("exclusion", "step"): "step + 1000"}


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
        """The reference run, with rows of every kind that a positioning run has and a result."""
        run_files.write(path, SOURCE, run_files.linear(RUN))
        told = self.verify(path)
        self.assertEqual(told["findings"], [])
        digest, document = told["result_digest"], '{"kept": true}'
        base = sqlite3.connect(path)
        base.execute("INSERT INTO result(digest, document, hash) VALUES(?, ?, ?)",
                     (digest, document, hashlib.sha256(f"{digest}\n{document}".encode()).digest()))
        base.commit()
        base.close()

    def each_kind(self):
        """(name, tables): the whole file is one of each kind; the tables of its rows."""
        for name in KINDS:
            os.unlink(self.whole)
            rows = getattr(run_files, name)(RUN)
            run_files.write(self.whole, SOURCE, rows)
            told = self.verify(self.whole)
            self.assertEqual(told["findings"], [], name)
            self.assertTrue(told["complete"], name)
            yield name, {table for table, _ in rows}

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

    def test_the_kinds_fill_every_table_of_the_chain(self):
        filled = set().union(*(tables for _, tables in self.each_kind()))
        with contextlib.closing(sqlite3.connect(self.whole)) as base:
            chained = run_files.tables_of(base)
        self.assertEqual(sorted(chained), sorted(run_files.tables_of_program(SOURCE)))
        self.assertEqual(sorted(chained), sorted(filled), "a table that no file here fills is not proved")

    def test_every_column_of_every_table(self):
        tried, done = 0, set()
        for _, tables in self.each_kind():
            with contextlib.closing(sqlite3.connect(self.whole)) as base:
                columns = {table: columns_of(base, table) for table in tables}
            for table, link, values in self.some_rows([0.5]):
                if table not in done:
                    tried += self.change_each_cell(table, link, [*zip(columns[table], values), ("hash", bytes(32))])
            done |= tables
        print(f"{tried} changed cells in {len(done)} tables, each named")
        self.assertGreater(tried, 200)

    def change_each_cell(self, table, link, cells):
        """Gives back how many of them could be changed."""
        tried = 0
        for column, value in cells:
            def change(base, value=value, column=column):
                base.execute(f"UPDATE {table} SET {column}=? WHERE link=?", (other(value), link))

            try:
                found = self.spoil(change)
            except sqlite3.IntegrityError:  # NULL where none may be, a name twice
                continue
            tried += 1
            named = [(f["what"], f["table"], f["row"]) for f in found]
            self.assertEqual(named, [("changed", table, link)], f"{column}: {found}")
            self.assertIn(f"row {link} (table {table}", found[0]["sentence"])
        self.assertGreater(tried, 0, table)
        return tried

    def test_every_missing_row(self):
        tried, done = 0, set()
        for kind, tables in self.each_kind():
            for table, link, _ in self.some_rows():
                if kind == "linear" or table not in done or (kind == "revised" and table in ("point", "closing")):
                    self.take_out(kind, table, link)
                    tried += 1
            done |= tables
        print(f"{tried} missing rows of {len(done)} tables, each named")

    def take_out(self, kind, table, link):
        with contextlib.closing(sqlite3.connect(self.whole)) as base:
            table_of = {number: name for number, (name, _) in rows_of(base).items()}
        found = self.spoil(lambda base: base.execute(f"DELETE FROM {table} WHERE link=?", (link,)))
        told = f"{kind}, {table} {link}: {found}"
        self.assertEqual([(f["what"], f["row"]) for f in found], [("missing", link)], told)
        if link + 1 not in table_of:  # the last one: the file is folded as a closed one
            self.assertEqual((table, found[0]["table"]), ("closing", "closing"), told)
            return
        self.assertIsNone(found[0]["table"], told)
        place = f"between table {table_of[link - 1]} and" if link > 1 else "before"
        self.assertEqual(found[0]["sentence"], f"row {link}, {place} table {table_of[link + 1]}, is missing", told)

    def test_rows_that_are_missing_side_by_side_are_each_named(self):
        run_files.write(self.path, SOURCE, run_files.revised(RUN))
        with contextlib.closing(sqlite3.connect(self.path)) as base, base:
            links = [row[0] for row in base.execute("SELECT link FROM retake WHERE number=1 UNION ALL "
                                                    "SELECT link FROM retake_point WHERE step=50")]
            for link in links:
                base.execute("DELETE FROM retake WHERE link=?", (link,))
                base.execute("DELETE FROM retake_point WHERE link=?", (link,))
        found = [(f["what"], f["row"]) for f in self.verify(self.path, 8)["findings"]]
        self.assertEqual(found, [("missing", link) for link in links])

    def test_many_missing_rows_are_told_and_counted(self):
        found = self.spoil(lambda base: base.execute("DELETE FROM point"))
        self.assertEqual({f["what"] for f in found}, {"missing"})
        self.assertEqual(len(found), 50)
        self.assertEqual({f["table"] for f in found}, {None})

    def test_a_row_after_the_end(self):
        proved, tables = set(), set()
        for _, of_kind in self.each_kind():
            tables |= of_kind
            last = max(link for _, link, _ in self.some_rows())
            for table, link, _ in self.some_rows([0.5]):
                if table not in proved and self.add_twin(table, link, last + 1, [last + 1]):
                    proved.add(table)
        self.assertEqual(tables - proved, set())

    def test_a_second_row_of_the_same_number(self):
        proved, tables = set(), set()
        for _, of_kind in self.each_kind():
            tables |= of_kind
            links = sorted(link for _, link, _ in self.some_rows())
            middle = links[len(links) // 2]
            for table, link, _ in self.some_rows([0.5]):
                taken = links[0] if link == middle else middle
                if table not in proved and self.add_twin(table, link, taken, None):
                    proved.add(table)
        self.assertEqual(tables - proved, set())

    def add_twin(self, table, link, place, rows):
        """Puts a copy of a row at another place; false: that number is taken, or the schema forbids it."""
        def add(base):
            columns = columns_of(base, table)
            names = ", ".join(columns)
            chosen = ", ".join(NEW_NAME.get((table, c), c) for c in columns)
            base.execute(f"INSERT INTO {table}(link, {names}, hash) SELECT ?, {chosen}, hash FROM {table} "
                         "WHERE link=?", (place, link))

        try:
            found = self.spoil(add)
        except sqlite3.IntegrityError:
            return False
        right = [("added", table)]
        if rows and table in ("retake", "exclusion", "answer"):  # they may follow the end, but continue nothing here
            right, rows = [("changed", table), ("missing", "closing")], [place, place + 1]
        self.assertEqual([(f["what"], f["table"]) for f in found], right, f"{link}: {found}")
        if rows:
            self.assertEqual([f["row"] for f in found], rows)
        return True

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
        self.assertEqual({(f["what"], f["about"]) for f in found}, {("missing", None), ("added", "step=7")})

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
        words = subprocess.run([AXISCAL, "verify", self.whole], capture_output=True, text=True, timeout=60, check=False).stdout
        self.assertIn(f"{path} does NOT say what the run file gives.", words)
        self.assertNotIn("is NOT what was written", words)

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
