#!/usr/bin/env python3
"""`axiscal station new`: what it asks for, what it finds plugged in, and what it writes.

new_station.py BIN_FOLDER SOURCE_FOLDER   writes only into scratch folders of its own
"""
import fcntl
import os
import pty
import subprocess
import sys
import termios
import tomllib
import unittest

from axiscal_cli import BIN, SOURCE, Plugged

ANSWERS = {"axis": "X", "travel-low": "0 mm", "travel-high": "1000 mm", "sign": "-1", "dead-path": "120 mm", "expansion": "11.5 um/(m*K)",
           "expansion-uncertainty": "0.5 um/(m*K)",
           "overrun": "2 mm", "feed": "1000 mm/min", "shape": "sequence-block", "transport": "tcp", "client": "192.168.10.20"}
PROFILES = {"AXISCAL_PROFILE_PATH": os.path.join(SOURCE, "config", "profiles")}


def lines_of(text):
    return [line for line in text.splitlines() if line.strip() and not line.startswith("#")]


class NewStation(Plugged):
    def setUp(self):
        super().setUp()
        self.plug("1-1", "16c0", "0483", "7391231", "ttyACM0", "usb-Teensyduino_7391231-if00", "cdc_acm")
        self.plug("1-2", "289b", "0505", "E24638", "ttyACM1", "usb-Dracal_E24638-if00", "cdc_acm")
        self.plug("1-4", "0403", "6001", "A600AXIS", "ttyUSB0", "usb-FTDI_A600AXIS-if00-port0", "ftdi_sio")
        self.out = os.path.join(self.folder, "new.toml")

    def words(self, *more, **changed):
        words = ["station", "new", "--sysfs", self.sys, "--dev", self.dev, "--out", self.out]
        for option, answer in (ANSWERS | {name.replace("_", "-"): value for name, value in changed.items()}).items():
            if answer is not None:
                words += ["--" + option, answer]
        return [*words, *more]

    def new(self, code, *more, **changed):
        return self.expect(code, *self.words(*more, **changed), env=PROFILES)

    def written(self):
        with open(self.out, encoding="utf-8") as file:
            return file.read()

    def test_thirty_lines_that_check_config_accepts(self):
        told = self.new(0, *self.modbus()).stdout
        text = self.written()
        lines = lines_of(text)
        self.assertLessEqual(len(lines), 30, text)
        self.assertLessEqual(lines.index("[[instrument]]"), 15, text)
        accepted = self.expect(0, "check-config", self.out, env=PROFILES).stdout
        for line in ("axis.laser: laser/axis 1\n", "axis.material.temperature: material/contact 1, material/contact 2\n"):
            self.assertIn(line, accepted)
        self.assertIn("Look at these lines, they hold examples", told)
        self.assertIn("wavelength", told)

    def modbus(self):
        """Laser and air are found by their USB numbers; what is behind the adapter is named."""
        return ("--instrument", os.path.join(self.dev, "ttyUSB0") + "=modbus", "--set", "material.profile=tm-th8")

    def test_each_answer_stands_where_it_belongs(self):
        self.new(0, *self.modbus())
        made = tomllib.loads(self.written())
        self.assertEqual(made["axis"], {"name": "X", "travel_low": "0 mm", "travel_high": "1000 mm", "sign": -1, "dead_path": "120 mm",
                                        "material": {"coefficient": "11.5 um/(m*K)", "standard_uncertainty": "0.5 um/(m*K)"}})
        self.assertEqual(made["cycle"], {"overrun": "2 mm", "feed": "1000 mm/min"})
        self.assertEqual(made["trigger"], {"shape": "sequence-block", "transport": "tcp", "allowed_clients": ["192.168.10.20"]})
        by_driver = {one["driver"]: one for one in made["instrument"]}
        self.assertEqual(by_driver["umd"]["link"], f"serial:{self.dev}/serial/by-id/usb-Teensyduino_7391231-if00")
        self.assertEqual(by_driver["modbus"]["profile"], "tm-th8")
        self.assertEqual(len({one["name"] for one in made["instrument"]}), len(made["instrument"]))

    def test_what_is_missing_is_told_at_once_and_nothing_is_written(self):
        told = self.new(2, overrun=None, sign=None, feed=None).stderr
        for option in ("--overrun", "--sign", "--feed"):
            self.assertIn(option, told)
        self.assertNotIn("--axis", told)
        self.assertFalse(os.path.exists(self.out))
        self.assertIn("--serial-port", self.new(2, transport="rtu", client=None).stderr)

    def test_a_wrong_answer_is_refused_in_the_words_of_the_station_file(self):
        for changed, words in (({"overrun": "2"}, "--overrun: "), ({"travel_high": "-5 mm"}, "must lie above travel_low"),
                               ({"client": "the cnc"}, "is no address"), ({"shape": "dwel"}, "did you mean"),
                               ({"sign": "0"}, "rises as the axis moves"), ({"sign": "up"}, "--sign: ")):
            told = self.new(2, **changed).stderr
            self.assertIn(words, told, changed)
            self.assertFalse(os.path.exists(self.out))

    def test_a_device_is_named_by_its_link_too(self):
        link = os.path.join(self.dev, "serial", "by-id", "usb-FTDI_A600AXIS-if00-port0")
        told = self.new(0, "--instrument", link + "=modbus", "--set", "material.profile=tm-th8")
        self.assertNotIn("Left out", told.stdout)
        self.assertEqual([one["driver"] for one in tomllib.loads(self.written())["instrument"]].count("modbus"), 1)

    def test_a_file_that_is_there_is_kept(self):
        with open(self.out, "w", encoding="utf-8") as file:
            file.write("# mine\n")
        os.chmod(self.out, 0o640)
        self.assertIn("--force", self.new(3, *self.modbus()).stderr)
        self.assertEqual(self.written(), "# mine\n")
        self.new(0, "--force", *self.modbus())
        with open(self.out + ".before", encoding="utf-8") as file:
            self.assertEqual(file.read(), "# mine\n")
        self.assertEqual(os.stat(self.out).st_mode & 0o777, 0o640, "as readable for the service as before")

    def test_a_device_that_could_be_several_is_left_out_and_told(self):
        told = self.new(3)  # no material sensor then
        self.assertIn("Left out", told.stdout)
        self.assertIn("--instrument /dev/ttyUSB0=DRIVER".replace("/dev", self.dev), told.stdout)
        self.assertIn("axis.material.temperature", told.stderr)
        self.assertTrue(os.path.exists(self.out))

    def test_other_triggers_have_their_own_keys(self):
        self.new(0, *self.modbus(), shape="single-register", transport="rtu", client=None, serial_port="/dev/ttyS0")
        self.assertEqual(tomllib.loads(self.written())["trigger"]["serial_port"], "/dev/ttyS0")
        os.remove(self.out)
        self.new(0, *self.modbus(), shape="dwell", transport=None, client=None, window="0.5 mm", stability_range="2 um", hysteresis="0.2 mm")
        self.assertNotIn("transport", tomllib.loads(self.written())["trigger"])
        os.remove(self.out)
        self.new(0, *self.modbus(), client="none")
        self.assertNotIn("allowed_clients", self.written())

    def test_an_instrument_on_a_network_is_named(self):
        self.new(0, *self.modbus(), "--instrument", "tcp:192.168.0.20:502=modbus", "--set", "material-2.profile=labjack-t7-thermocouple")
        links = [one.get("link") for one in tomllib.loads(self.written())["instrument"]]
        self.assertIn("tcp:192.168.0.20:502", links)

    def test_what_is_set_is_a_number_only_where_it_is_one(self):
        self.new(0, *self.modbus(), "--set", "material.unit_id=3", "--set", "material.serial=4411", "--set", "material.due_on=2027-01-20",
                 "--set", "laser.serial=7391230")
        by_name = {one["name"]: one for one in tomllib.loads(self.written())["instrument"]}
        self.assertEqual(by_name["material"]["unit_id"], 3)
        self.assertEqual((by_name["material"]["serial"], by_name["material"]["due_on"]), ("4411", "2027-01-20"))
        self.assertEqual(by_name["laser"]["serial"], "7391230")

    def test_two_sensors_that_could_be_one_part_are_asked_for(self):
        told = self.new(3, *self.modbus(), "--instrument", "tcp:192.168.0.20:502=modbus", "--set", "material-2.profile=comet-t7510").stderr
        self.assertIn('axis.air.temperature is not named, and several channels could be it: "air/air temperature", "material-2/air temperature"', told)

    def test_on_a_terminal_it_asks_and_asks_again(self):
        master, slave = pty.openpty()
        attributes = termios.tcgetattr(slave)
        attributes[3] &= ~termios.ECHO
        termios.tcsetattr(slave, termios.TCSANOW, attributes)
        asked = subprocess.Popen([os.path.join(BIN, "axiscal"), *self.words(*self.modbus(), overrun=None, feed=None)], stdin=slave,
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=os.environ | PROFILES,
                                 preexec_fn=lambda: (os.setsid(), fcntl.ioctl(slave, termios.TIOCSCTTY, 0)))
        os.close(slave)
        os.write(master, b"2\n2 mm\n1000 mm/min\n\n\n")
        told, wrong = asked.communicate(timeout=60)
        os.close(master)
        self.assertEqual(asked.returncode, 0, told + wrong)
        self.assertEqual(wrong.count("how far the axis goes beyond"), 2, wrong)
        self.assertEqual(tomllib.loads(self.written())["cycle"], {"overrun": "2 mm", "feed": "1000 mm/min"})


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]] + sys.argv[3:])
