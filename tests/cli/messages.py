#!/usr/bin/env python3
"""What a person typed, and the sentence that helps: one test a slip that was seen.

messages.py BIN_FOLDER SOURCE_FOLDER [SUITE]   writes only into scratch folders of its own
"""
import fcntl
import json
import os
import pty
import re
import select
import signal
import struct
import sys
import termios
import time
import unicodedata
import unittest

from axiscal_cli import BIN, CASE, Daemon, OneAnswer, Scratch, dwelling_text, example_text, run, station_status


class StationFile(Scratch):
    """`axiscal check-config` on the example with one slip in it."""

    def told(self, *changes, code=3):
        text = example_text()
        for before, after in changes:
            self.assertIn(before, text)
            text = text.replace(before, after, 1)
        return self.expect(code, "check-config", self.file("station.toml", text)).stderr

    def line_of(self, words):
        text = example_text().splitlines()
        return 1 + next(number for number, line in enumerate(text) if line.startswith(words))

    def test_an_interval_longer_than_the_axis_is_named(self):
        told = self.told(('interval = "93 mm"', 'interval = "1200 mm"'), ("target_count = 11\n", ""))
        self.assertIn("An interval of 1200 mm is too long", told)
        self.assertIn("or less", told)
        self.assertNotIn("first_target", told)

    def test_a_first_target_that_does_not_suit_the_interval_may_be_left_out(self):
        told = self.told(('interval = "93 mm"', 'interval = "190 mm"'), ("target_count = 11", "target_count = 5"))
        self.assertIn("At an interval of 190 mm the first target of 33 mm may fall to -24 mm", told)
        self.assertIn("leave first_target out", told)

    def test_a_medium_that_is_none_is_told_where_it_stands_and_nowhere_else(self):
        changes = [('medium = "material"', 'medium = "Metall"')] * 2
        told = self.told(*changes).splitlines()
        self.assertEqual(len(told), 2, told)
        for line in told:
            self.assertIn('.medium: "Metall" is not one of "air", "material"', line)
            self.assertRegex(line, r'instrument "material"\.channel "[^"]+"\.medium')  # no number

    def test_an_instrument_is_named_where_it_is_refused(self):
        told = self.told(('\nserial = ', '\nseriall = '))
        self.assertIn('instrument "laser".seriall: is not a key of this table; did you mean "serial"?', told)

    def test_a_missing_key_is_told_with_the_table_as_the_file_writes_it(self):
        told = self.told((self.link_of("modbus") + "\n", ""))
        self.assertIn('instrument "material".link: is missing: add it to its [[instrument]], for example link = "..."', told)
        self.assertNotRegex(told, r"\[[0-9]+\]")

    def test_an_instrument_without_a_name_is_not_counted_among_the_names(self):
        told = self.told(('name = "material"\n', ""))
        self.assertIn('no [[instrument]] has the name "material" (there are: laser, air)', told)

    def test_a_misspelt_choice_is_judged_as_what_was_meant(self):
        told = self.told(('kind = "linear"', 'kind = "linaer"')).splitlines()
        self.assertEqual(len(told), 1, told)
        self.assertIn('did you mean "linear"?', told[0])

    def test_a_file_of_another_encoding_is_told_how_to_be_saved(self):
        text = example_text().replace('name = "bay 3"', 'name = "Prüfplatz"')
        self.assertIn("Prüfplatz", text)
        path = self.file("station.toml")
        for encoding, words in (("latin-1", "is no UTF-8 (a letter or sign of Latin-1"), ("utf-16", "the file is UTF-16"),
                                ("utf-16-le", "the file is UTF-16"), ("utf-16-be", "the file is UTF-16")):
            with open(path, "wb") as out:
                out.write(text.encode(encoding, "replace"))
            told = self.expect(3, "check-config", path).stderr
            self.assertIn(words, told)
            self.assertIn("save the file as UTF-8 in your editor", told)
            self.assertTrue(told.startswith(path + ":"), told)
        with open(path, "wb") as out:  # the mark that Windows' editor puts before UTF-8 is no harm
            out.write(text.encode("utf-8-sig"))
        self.expect(0, "check-config", path)

    def test_curly_quotes_are_shown_in_their_line(self):
        told = self.told(('name = "laser"', "name = “laser”"))
        self.assertIn("in the line `name = “laser”`", told)
        self.assertIn('put straight quotes (") for the curly ones', told)
        self.assertIn(f'station.toml:{self.line_of("name = " + chr(34) + "laser")}:', told)

    def test_a_sign_without_its_number_is_shown_in_its_line(self):
        told = self.told(("\nsign = 1\n", "\nsign = +\n"))
        self.assertIn(f'station.toml:{self.line_of("sign = 1")}:', told)
        self.assertIn("in the line `sign = +`", told)
        self.assertIn("a number (1, -1, 0.5)", told)

    def test_a_value_with_a_unit_wants_quotes(self):
        told = self.told(('interval = "93 mm"', "interval = 93 mm"))
        self.assertIn("in the line `interval = 93 mm`", told)
        self.assertIn("a value with a unit stands in quotes", told)

    def link_of(self, driver):
        part = example_text().split(f'driver = "{driver}"')[1]
        return next(line for line in part.splitlines() if line.startswith("link = "))

    def test_a_port_by_its_windows_name_is_refused_with_the_linux_name(self):
        told = self.told((self.link_of("dracal-vcp"), 'link = "serial:COM3"'))
        self.assertIn('"COM3" is a port\'s name on Windows', told)
        self.assertIn("/dev/serial/by-id/", told)
        self.assertIn("axiscal devices", told)

    def test_two_languages_on_one_line_are_refused(self):
        told = self.told((self.link_of("modbus"), self.link_of("dracal-vcp")))
        self.assertIn('is the wire of the instrument "air"', told)
        self.assertIn("dracal-vcp and modbus cannot share it", told)

    def test_a_port_with_two_names_is_one_line(self):
        port, other = self.file("ttyUSB0"), os.path.join(self.folder, "by-id")
        os.symlink(port, other)
        told = self.told((self.link_of("modbus"), f'link = "serial:{port}"'),
                         (self.link_of("dracal-vcp"), f'link = "serial:{other}"'))
        self.assertIn("cannot share it", told)


    def test_a_recorded_modbus_line_is_tried_on_a_wire_and_not_in_the_driver(self):
        near, far = os.openpty()
        self.addCleanup(lambda: (os.close(near), os.close(far)))
        text = example_text().replace(self.link_of("modbus"), f'link = "serial:{os.ttyname(far)}"')
        tape = os.path.join(self.folder, "material.tape")
        told = self.expect(0, "record", "--config", self.file("station.toml", text), "--instrument", "material", "--out", tape,
                           "--for", "2").stdout
        self.assertIn(f'axiscal replay {tape} --link /tmp/wire, with link = "serial:/tmp/wire" in a station file', told)
        self.assertNotIn("--print", told)


class Files(Scratch):
    """What else is read: cases, tables of features, profiles."""

    def test_a_case_of_another_encoding_is_told_how_to_be_saved(self):
        text = json.dumps(CASE | {"machine": "Fräse"}, ensure_ascii=False)
        path = self.file("case.json")
        with open(path, "wb") as out:
            out.write(text.encode("latin-1"))
        told = self.expect(3, "analyze", path).stderr
        self.assertIn("the byte 0xE4 is no UTF-8", told)
        self.assertIn("save the file as UTF-8", told)

    def test_utf_16_is_read(self):
        case, table = self.file("case.json"), self.file("features.csv")
        text = json.dumps(CASE | {"machine": "Fräse"}, ensure_ascii=False)
        rows = "feature,nominal_x,on_machine_x,cmm_x\nNut ä,1,2,3\nNut ä,2,2,3\nNut ä,3,2,4\n"
        for path, content in ((case, text), (table, rows)):
            with open(path, "wb") as out:
                out.write(content.encode("utf-16"))
            told = self.expect(0, "analyze", path).stdout
            with open(path, "wb") as out:
                out.write(content.encode("utf-8"))
            self.assertEqual(self.expect(0, "analyze", path).stdout, told)

    def test_a_table_of_another_encoding_is_told_how_to_be_saved(self):
        path = self.file("features.csv")
        table = "feature,nominal_x,on_machine_x,cmm_x\nNut ä,1,2,3\n"
        with open(path, "wb") as out:
            out.write(table.encode("latin-1"))
        self.assertIn("save the file as UTF-8", self.expect(3, "analyze", path).stderr)

    def test_a_profile_of_another_encoding_is_told_how_to_be_saved(self):
        text = example_text()
        profile = text.split('profile = "')[1].split('"')[0]
        with open(profile, encoding="utf-8") as source:
            own = self.file("own.toml")
            with open(own, "wb") as out:
                out.write(("# Fühler\n" + source.read()).encode("latin-1", "replace"))
        told = self.expect(3, "check-config", self.file("station.toml", text.replace(profile, own))).stderr
        self.assertIn(own + ":1:", told)
        self.assertIn("save the file as UTF-8", told)


class Words(Scratch):
    """Commands with a slip in them."""

    def test_the_folder_of_a_program_is_made(self):
        out = os.path.join(self.folder, "re", "X")
        self.expect(0, "program", "--config", self.file("station.toml", example_text()), "--out", out)
        self.assertTrue(any(name.endswith(".ngc") for name in os.listdir(out)))

    def test_a_folder_that_cannot_be_made_is_named_with_the_reason(self):
        out = os.path.join(self.file("re"), "X")  # below a file
        told = self.expect(1, "program", "--config", self.file("station.toml", example_text()), "--out", out).stderr
        self.assertIn(f"cannot make the folder {out} of --out (Not a directory)", told)
        self.assertNotIn("operation failed", told)

    def test_a_file_that_cannot_be_read_is_named_alone(self):
        for words in (["analyze", "nothing.json"], ["verify", "nothing.axiscal"], ["arm", "--program", "nothing.ngc"]):
            got = run(*words)
            self.assertNotEqual(got.returncode, 0)
            self.assertIn("nothing.", got.stderr)
            self.assertNotIn("operation failed", got.stderr)

    def test_a_misspelt_option_is_told_with_the_nearest(self):
        told = self.expect(2, "arm", "--state-taht", "operator=Shift 2").stderr
        self.assertIn("'--state-taht' is no option of axiscal arm; did you mean '--state-that'?", told)

    def test_a_misspelt_dialect_is_told_with_the_nearest(self):
        told = self.expect(2, "program", "--config", self.file("station.toml", example_text()),
                           "--out", self.folder, "--dialect", "linuxcnv").stderr
        self.assertIn('did you mean "linuxcnc"?', told)

    def test_a_misspelt_analysis_is_told_with_the_nearest(self):
        told = self.expect(3, "analyze", self.file("case.json", json.dumps(CASE | {"analysis": "postioning"}))).stderr
        self.assertIn('did you mean "positioning"?', told)

    def test_a_program_that_waits_for_nobody_says_to_arm_before(self):
        waiting = self.expect(0, "program", "--config", self.file("station.toml", example_text()), "--out", self.folder).stdout
        self.assertIn("when the axis waits at its datum: axiscal arm --program", waiting)
        self.assertRegex(waiting, r"datum at -?[0-9.]+ mm\n")
        shown = self.expect(0, "program", "--config", self.file("dwell.toml", dwelling_text()), "--out", self.folder,
                            "--dialect", "marlin").stdout
        self.assertIn("it waits for nobody: drive the axis to its datum, then axiscal arm --program", shown)
        self.assertNotIn("when the axis waits at its datum", shown)

    def test_one_point_is_told_in_the_singular(self):
        text = example_text().replace("approaches = 5", "approaches = 1")
        shown = self.expect(0, "check-config", self.file("station.toml", text)).stdout
        self.assertNotRegex(shown, r"\b1 (points|targets|circles)\b")


class Answered(OneAnswer):
    """What is printed of a daemon's answer."""

    def test_arming_has_the_order_of_the_program_header_and_of_the_readme(self):
        code, shown = self.shown({"run": "r"}, "arm")
        self.assertEqual(code, 0)
        self.assertIn("The part program that waits at its datum goes on by itself", shown)
        self.assertNotIn("Start the part program", shown)

    def test_one_restart_of_an_alignment_is_told_in_the_singular(self):
        record = {"instrument": "laser", "serial": "7", "reached_mm": 500, "travel_mm": 998, "began": "2026-11-26T08:00:00Z",
                  "far": None, "cosine": None, "cosine_by_spot": None, "places": []}
        for restarts, words in ((1, "begun anew once: the counter lost its zero"),
                                (3, "begun anew 3 times: the counter lost its zero")):
            view = {"running": False, "record": record | {"restarts": restarts}}
            self.assertIn(words, self.shown(view, "align", "show")[1])

    def test_one_reading_is_told_in_the_singular(self):
        words = ["exclude", "--target", "1", "--reason", "a chip"]
        self.assertIn("1 reading is left out of every figure; it stays", self.shown({"excluded": 1}, *words)[1])
        self.assertIn("2 readings are left out of every figure; they stay", self.shown({"excluded": 2}, *words)[1])


    def test_a_kept_answer_is_told_with_what_comes_of_it(self):
        self.assertIn("a new certificate bears it", self.shown({"answer": "kept"}, "answer", "growth", "a door")[1])


class Asked(Daemon):
    """What a daemon says of a slip. Its instruments are not there."""

    test_doors_and_rights = test_a_second_daemon_is_refused = None  # shown by axiscal_cli.py

    def test_a_misspelt_statement_is_told_with_the_nearest(self):
        told = self.expect(4, "arm", "--state-that", "oparator=Shift 2", "--socket", self.socket).stderr
        self.assertIn("[statements.oparator]", told)
        self.assertIn('is not a statement; did you mean "operator"? There are: certificate_number', told)

    def test_a_statement_that_resembles_none_is_told_in_sentences(self):
        told = self.expect(4, "arm", "--state-that", "zzzz=x", "--socket", self.socket).stderr
        self.assertIn("is not a statement. There are: certificate_number", told)

    def test_a_misspelt_check_is_told_with_the_nearest(self):
        told = self.expect(4, "preflight", "--override", "soack=the customer waits", "--socket", self.socket).stderr
        self.assertIn('did you mean "soak"?', told)


class Glass:
    """A terminal of 80×24 as it shows what a program writes: wraps at its edge, scrolls at its foot."""

    def __init__(self, columns=80, rows=24):
        self.columns, self.rows, self.wraps, self.scrolls, self.colours = columns, rows, 0, 0, []
        self.clear()

    def clear(self):
        self.lines, self.row, self.column = [""] * self.rows, 0, 0

    def down(self):
        if self.row + 1 < self.rows:
            self.row += 1
        else:
            self.lines = self.lines[1:] + [""]
            self.scrolls += 1

    @staticmethod
    def width(letter):
        return 0 if unicodedata.combining(letter) else 2 if unicodedata.east_asian_width(letter) in "WF" else 1

    def put(self, letter):
        if self.column + self.width(letter) > self.columns:
            self.wraps, self.column = self.wraps + 1, 0
            self.down()
        self.lines[self.row] += letter
        self.column += self.width(letter)

    def write(self, text):
        for part in re.findall(r"\x1b\[[^A-Za-z]*[A-Za-z]|\r|\n|.", text, re.S):
            if part == "\x1b[H":
                self.row = self.column = 0
            elif part == "\x1b[2J":
                self.clear()
            elif part.startswith("\x1b["):
                assert part.endswith("m"), repr(part)
                self.colours.append(part)
            elif part == "\r":
                self.column = 0
            elif part == "\n":
                self.down()
            else:
                assert part >= " ", f"a control character reaches the terminal: {part!r}"
                self.put(part)


LONG = "Spindelkasten hinten links, Messstelle an der Führungsbahn neben dem Späneförderer, 二番目の測定位置"
SENTENCE = ("The CNC asks for another target than the plan. Request 37 claims the target P9 = 812.250 mm from above, and "
            "the plan has P7 = 651.250 mm from above: compare program and plan, or abort and arm again. " * 3)


class Watch(OneAnswer):
    """`axiscal watch` on a pseudo-terminal of 80×24 before a station with much to tell."""

    def status(self, **run_fields):
        channels = [{"instrument": f"material {n} {LONG}", "channel": f"contact {n}", "name": f"{n} {LONG}", "place": LONG,
                     "kind": "temperature", "medium": "material", "value": 21.5, "unit": "degC", "age_s": 0.1,
                     "quality": "good", "used": True} for n in range(40)]
        laser = {"instrument": "laser", "channel": "axis 1", "name": "axis 1", "place": "", "kind": "displacement", "role": "axis",
                 "medium": "none", "value": 0.1, "unit": "m", "age_s": 0.1, "quality": "good", "used": True}
        instruments = [{"name": f"{n} {LONG}", "driver": "modbus", "state": "unavailable", "model": LONG, "serial": "7",
                        "samples": 1, "gaps": 0, "bad_frames": 0, "checksum_errors": 0, "restarts": 3, "tape": "",
                        "note": f"The instrument does not answer: check cable, address and power. {LONG}"} for n in range(20)]
        axis = {"name": "X", "position_mm": 651.2534, "deviation_um": 3.4, "spread_um": 0.1, "strength_percent": 90, "still": True}
        run_fields = {"state": "stopped", "fault": "wrong_target", "sentence": SENTENCE,
                      "next": {"target": 6, "nominal_mm": 651.25, "direction": "negative", "approach": 2}} | run_fields
        notes = [f"note {n}: {LONG} \x1b[31m\x07 {LONG}" for n in range(20)]
        return station_status(axis, run_fields) | {"channels": [laser] + channels, "instruments": instruments, "notes": notes,
                                                   "run_open": True, "station": LONG}

    def first_frame(self, status, columns=80, rows=24, **environment):
        """What the terminal shows after one frame, read until the second one begins."""
        body = json.dumps(status).encode()
        child, terminal = pty.fork()
        if child == 0:
            os.execve(os.path.join(BIN, "axiscal"), ["axiscal", "watch", "--socket", self.path],
                      {"PATH": os.environ["PATH"], "TERM": "xterm"} | environment)
        fcntl.ioctl(terminal, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))
        shown = b""
        try:
            for _ in range(2):  # the second is asked for when the first is written
                client, _ = self.door.accept()
                client.recv(65536)
                client.sendall(b"HTTP/1.1 200 OK\r\nContent-Length: %d\r\nConnection: close\r\n\r\n%s" % (len(body), body))
                client.close()
            end = time.monotonic() + 30
            while shown.count(b"\x1b[2J") < 2 and time.monotonic() < end:
                if select.select([terminal], [], [], 0.2)[0]:
                    shown += os.read(terminal, 65536)
                if b"\x1b[2J" not in shown and shown.count(b"\n") > 0:
                    break  # plain lines: no second one follows without news
        finally:
            os.kill(child, signal.SIGTERM)
            os.waitpid(child, 0)
            os.close(terminal)
        return shown.decode("utf-8")

    def glass(self, status, columns=80, rows=24, **environment):
        frames = self.first_frame(status, columns, rows, **environment).split("\x1b[H\x1b[2J")
        self.assertEqual(frames[0], "")
        glass = Glass(columns, rows)
        glass.write("\x1b[H\x1b[2J" + frames[1])
        return glass

    def test_nothing_wraps_and_nothing_scrolls_however_much_there_is(self):
        for columns, rows in ((80, 24), (40, 12), (200, 60)):
            glass = self.glass(self.status(), columns, rows)
            self.assertEqual((glass.wraps, glass.scrolls), (0, 0), glass.lines)

    def test_fault_next_and_reading_stand_on_top_and_notes_last(self):
        lines = self.glass(self.status()).lines
        self.assertTrue(lines[0].startswith("FAULT        The CNC asks for another target"), lines)
        self.assertTrue(lines[1].startswith(" " * 13), lines)
        [following] = [n for n, line in enumerate(lines) if line.startswith("Next         P7 = 651.250 mm  ↓ from above")]
        self.assertLessEqual(following, 3, lines)
        self.assertRegex(lines[following + 1], r"^Axis X +651\.2534 mm   deviation \+3\.40 µm")
        notes = [n for n, line in enumerate(lines) if line.startswith("  note ")]
        self.assertEqual(notes, list(range(20, 23)), lines)  # the latest three, and the cursor's line below them
        self.assertTrue(lines[22].startswith("  note 19"), lines)

    def test_colour_follows_rank_and_leaves_nothing_behind(self):
        frame = self.first_frame(self.status()).split("\x1b[2J")[1]
        self.assertIn("\x1b[1;31mFAULT", frame)  # ECMA-48: bold, red
        self.assertIn("\x1b[1mNext", frame)
        for line in frame.split("\r\n"):
            self.assertEqual(len(re.findall(r"\x1b\[[1-9][0-9;]*m", line)), len(re.findall(r"\x1b\[0m", line)), repr(line))

    def test_no_color_is_kept(self):
        self.assertEqual(self.glass(self.status(), NO_COLOR="1").colours, [])
        self.assertNotEqual(self.glass(self.status(), NO_COLOR="").colours, [])  # no-color.org: when not empty

    def test_a_dumb_terminal_gets_plain_lines(self):
        for kind in ("dumb", ""):
            shown = self.first_frame(self.status(), TERM=kind)
            self.assertNotIn("\x1b", shown)
            self.assertRegex(shown, r"^  3/10  next P07 ↓ 3  x +651\.2534 mm")

    def test_a_pipe_gets_plain_lines(self):
        status = self.status(state="incomplete", next=None) | {"run_open": False}
        code, shown = self.shown(status, "watch")
        self.assertEqual(code, 6)
        self.assertNotIn("\x1b", shown)

    def test_an_abort_by_a_person_is_no_fault(self):
        status = self.status(state="incomplete", fault="", sentence="aborted by the operator", next=None) | {"run_open": False}
        for words in ("status", "watch"):
            shown = self.shown(status, words)[1]
            self.assertIn("aborted by the operator", shown)
            self.assertNotIn("FAULT", shown)
        self.assertRegex(self.shown(status, "status")[1], r"(?m)^Ended +aborted by the operator$")

    def test_one_of_something_is_told_in_the_singular(self):
        shown = self.shown(self.status(steps=1, step=1, retakes_asked=1, retakes_left=1), "status")[1]
        self.assertIn("1 of 1 point,", shown)
        self.assertIn("1 of 1 retake left", shown)

    def test_a_laser_that_is_silent_is_neither_moving_nor_available(self):
        status = self.status() | {"instruments": []}
        laser = status["channels"][0]
        laser |= {"quality": "stale", "value": None, "age_s": 3.2}
        status["channels"] = [laser]
        status["axis"] |= {"position_mm": None, "deviation_um": None, "spread_um": None, "still": False}
        status["instruments"] = [{"name": "laser", "driver": "umd", "state": "available", "model": "uMD1", "serial": "7",
                                  "samples": 9, "gaps": 0, "bad_frames": 0, "checksum_errors": 0, "restarts": 0, "tape": "",
                                  "note": ""}]
        shown = self.shown(status, "status")[1]
        self.assertRegex(shown, r"(?m)^Axis X .*   no reading since 3 s$")
        self.assertRegex(shown, r"(?m)^  laser +umd +no reading since 3 s")
        self.assertNotIn("moving", shown)
        laser |= {"quality": "beam_lost", "age_s": 0.1}
        self.assertRegex(self.shown(status, "status")[1], r"(?m)^Axis X .*   no good reading: beam lost$")

    def test_a_circular_test_tells_sense_run_and_the_reading_of_the_bar(self):
        bar = {"instrument": "ballbar", "channel": "length", "name": "length", "place": "", "kind": "displacement",
               "role": "ballbar", "medium": "none", "value": 0.0000123, "unit": "m", "age_s": 0.1, "quality": "good", "used": True}
        axis = {"name": "XY", "position_mm": None, "deviation_um": None, "spread_um": None, "strength_percent": None, "still": False}
        run_fields = {"pass": "circular", "state": "armed", "step": 2, "steps": 6,
                      "circle": {"number": 2, "sense": "clockwise", "repeat": 1, "warm_up": False, "begun": True}}
        status = station_status(axis, run_fields) | {"channels": [bar]}
        shown = self.shown(status, "status")[1]
        self.assertRegex(shown, r"(?m)^Run +r, armed, 2 of 6 circles$")
        self.assertRegex(shown, r"(?m)^Now +circle 2 of 6, clockwise, run 1$")
        self.assertRegex(shown, r"(?m)^Ballbar +0\.0123 mm$")
        self.assertNotIn("- - -", shown)
        self.assertNotIn("moving", shown)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]] + sys.argv[3:])
