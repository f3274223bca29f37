#!/usr/bin/python3
"""LinuxCNC's own interpreter reads the circular programs: rs274_circles.py SOURCE_DIR AXISCAL

For planes, senses, arcs and shapes of the handshake: every canonical way that rs274 makes of the
program is the one that was planned. The plan is worked out here anew from the station file's words.
A missing rs274 is a failure unless AXISCAL_MAY_SKIP names linuxcnc (then exit 77)."""
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

PRINTED_MM = 1.5e-4  # rs274 prints four decimals, each end and centre rounded
FULL = {"plane": "XY", "senses": ["ccw", "cw"], "start": 0, "arc": 360, "overshoot": 180, "repeats": 1,
        "warm_up": 0, "radius": 100, "feed": 2000, "feed_in": 1.5, "side": "outside",
        "centre": [0, 0, 0], "shape": "single-register", "start_from": ""}
CASES = {
    "the usual circle": {},
    "YZ from inside, beside zero": {"plane": "YZ", "start": 30, "overshoot": 90, "repeats": 2,
                                    "side": "inside", "centre": [1, 2, -3], "radius": 150},
    "an arc in ZX with warm-up, coil and index": {
        "plane": "ZX", "start": -20, "arc": 220, "overshoot": 10, "warm_up": 1, "repeats": 2,
        "centre": [10, 20, 30], "shape": "coil-and-index", "feed": 1234.5},
    "one sense of an arc": {"start": -20, "arc": 220, "overshoot": 10, "repeats": 2,
                            "senses": ["ccw"], "feed_in": 0.8},
    "words at both ends of the arc": {"start_from": "trigger", "repeats": 2},
    "one sense of a circle": {"senses": ["cw"], "repeats": 2, "overshoot": 45, "centre": [5, 0, 0]},
}


def station(source, scratch, case):
    text = (source / "tools/demo.d/station.toml.in").read_text()
    for key, value in {"SCRATCH": scratch, "SHARE": scratch, "SHAPE": case["shape"], "PORT": 1502}.items():
        text = text.replace(f"@{key}@", str(value))
    lengths = ", ".join(f'"{one} mm"' for one in case["centre"])
    senses = ", ".join(f'"{one}"' for one in case["senses"])
    return text + f"""
[[instrument]]
name = "ballbar"
driver = "labjack-u6"
link = "usb:470012345"
scale_length = "1 mm"

[ballbar]
sensor = "ballbar/ballbar"

[circular]
plane = "{case['plane']}"
senses = [{senses}]
start = "{case['start']} deg"
arc = "{case['arc']} deg"
overshoot = "{case['overshoot']} deg"
repeats = {case['repeats']}
warm_up = {case['warm_up']}
radius = "{case['radius']} mm"
feed = "{case['feed']} mm/min"
feed_in = "{case['feed_in']} mm"
feed_in_side = "{case['side']}"
{case['start_from'] and 'start_from = "trigger"'}
centre = [{lengths}]
"""


class Planned:
    """Ways of the plan: ("line", to) and ("arc", to, centre, turned degrees), requests ("ask", n)
    and numbers that change with the next way ("with motion", n)."""

    def __init__(self, case):
        self.case = case
        self.axes = ["XYZ".index(letter) for letter in case["plane"]]
        step = case["feed_in"] * (1 if case["side"] == "outside" else -1)
        self.rest, self.radius = case["radius"] + step, case["radius"]
        self.ways = []

    def at(self, radius, deg):
        centre = [self.case["centre"][axis] for axis in self.axes]
        angle = math.radians(deg)
        return centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle)

    def arc(self, radius, begin, end):
        self.ways.append(("arc", self.at(radius, end), self.at(0, 0), end - begin))

    def all(self):
        case = self.case
        low = case["start"] - case["overshoot"]
        high = case["start"] + case["arc"] + case["overshoot"]
        circles = case["senses"] * (case["warm_up"] + case["repeats"])
        here = low if circles[0] == "ccw" else high
        self.ways += [("line", self.at(self.rest, here)), ("ask", 0)]
        for number, sense in enumerate(circles, 1):
            begin, end = (low, high) if sense == "ccw" else (high, low)
            if abs(math.remainder(begin - here, 360)) > 1e-9:
                self.arc(self.rest, here, begin)
            words = 3 if case["start_from"] else 1
            first = (number - 1) * words + 1
            self.ways += [("ask", first), ("line", self.at(self.radius, begin))]
            self.ways += [("with motion", first + 1)] * (words > 1)
            self.arc(self.radius, begin, end)
            self.ways += [("with motion", first + 2)] * (words > 1)
            self.ways.append(("line", self.at(self.rest, end)))
            here = end
        self.ways.append(("ask", len(circles) * words + 1))
        return self.ways


def canonical(program, axes):
    """The same of what rs274 understood. It maps its tool table at $HOME/.tool.mmap, and another rs274
    cuts that file short under it."""
    done = subprocess.run(["rs274", "-g", program], cwd=program.parent, stdin=subprocess.DEVNULL,
                          env={**os.environ, "HOME": str(program.parent)}, capture_output=True, text=True,
                          timeout=60)
    assert done.returncode == 0, f"rs274: {done.stdout[-500:]}{done.stderr}"
    ways, here, settings = [], (0.0, 0.0), {}
    for line in done.stdout.splitlines():
        call = re.search(r"([A-Z_0-9]+)\((.*)\)", line)
        if not call:
            continue
        name, words = call[1], [word.strip() for word in call[2].split(",")]
        if name in ("SELECT_PLANE", "SET_MOTION_CONTROL_MODE", "USE_LENGTH_UNITS"):
            settings.setdefault(name, []).append(words[0])
        elif name == "SET_FEED_RATE" and float(words[0]):
            settings.setdefault(name, []).append(float(words[0]))
        elif name == "SET_AUX_OUTPUT_VALUE":
            ways.append(("ask", int(float(words[1]))))
        elif name == "SET_MOTION_OUTPUT_VALUE":
            ways.append(("with motion", int(float(words[1]))))
        elif name == "STRAIGHT_FEED":
            place = [float(word) for word in words]
            here = (place[axes[0]], place[axes[1]])
            ways.append(("line", here))
        elif name == "ARC_FEED":  # first and second end, first and second centre, turns (+ ccw)
            to, centre, turns = (float(words[0]), float(words[1])), (float(words[2]), float(words[3])), int(words[4])
            ways.append(("arc", to, centre, turned_deg(here, to, centre, turns)))
            here = to
        assert name not in ("STRAIGHT_TRAVERSE",), line
    return ways, settings


def turned_deg(here, to, centre, turns):
    """LinuxCNC's canonical arc: |turns| - 1 whole turns and one that is whole or in part."""
    assert turns, "an arc without a sense"
    begin = math.atan2(here[1] - centre[1], here[0] - centre[0])
    end = math.atan2(to[1] - centre[1], to[0] - centre[0])
    sense = math.copysign(1, turns)
    part = math.degrees(sense * (end - begin)) % 360
    if part < 1e-3 or part > 360 - 1e-3:
        part = 360
    return sense * (part + 360 * (abs(turns) - 1))


def near(a, b):
    return all(abs(one - other) < PRINTED_MM for one, other in zip(a, b))


def compare(case, ways, wanted):
    assert [way[0] for way in ways] == [way[0] for way in wanted], f"{ways}\nplanned: {wanted}"
    slack_deg = 3 * math.degrees(PRINTED_MM / case["radius"])
    for found, planned in zip(ways, wanted):
        if found[0] in ("ask", "with motion"):
            assert found[1] == planned[1], (found, planned)
            continue
        assert near(found[1], planned[1]), (found, planned)
        if found[0] == "arc":
            assert near(found[2], planned[2]), (found, planned)
            assert abs(found[3] - planned[3]) < slack_deg, (found, planned)


def judge(source, axiscal, name, changes):
    case = {**FULL, **changes}
    planned = Planned(case)
    with tempfile.TemporaryDirectory(prefix="axiscal-rs274-") as folder:
        scratch = pathlib.Path(folder)
        (scratch / "station.toml").write_text(station(source, scratch, case))
        subprocess.run([axiscal, "program", "--config", scratch / "station.toml", "--out", scratch],
                       check=True, capture_output=True, timeout=60,
                       env={**os.environ, "AXISCAL_PROFILE_PATH": str(source / "config/profiles")})
        ways, settings = canonical(scratch / f"{case['plane']}-circular.ngc", planned.axes)
    plane = {"XY": "CANON_PLANE_XY", "YZ": "CANON_PLANE_YZ", "ZX": "CANON_PLANE_XZ"}[case["plane"]]
    assert plane in settings["SELECT_PLANE"], settings
    assert settings["SET_MOTION_CONTROL_MODE"] == ["CANON_EXACT_PATH"], settings
    assert settings["SET_FEED_RATE"] == [case["feed"]], settings
    assert set(settings["USE_LENGTH_UNITS"]) == {"CANON_UNITS_MM"}, settings
    compare(case, ways, planned.all())
    print(f"{name}: {sum(way[0] == 'arc' for way in ways)} arcs as planned")


def main():
    if not shutil.which("rs274"):
        print("rs274 is not installed (apt-get install linuxcnc-uspace)")
        return 77 if "linuxcnc" in os.environ.get("AXISCAL_MAY_SKIP", "").split(",") else 1
    for name, changes in CASES.items():
        judge(pathlib.Path(sys.argv[1]), sys.argv[2], name, changes)
    return 0


sys.exit(main())
