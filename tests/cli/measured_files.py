"""Run files whose readings can be evaluated: an axis in freezing air, a rotary axis behind an indexing
table, a ballbar on two circles. Written as run_files.py writes them; the same seed gives the same test.
"""
import math
import random
import struct

import run_files

SECOND = 10**9
FREEZING = {1: lambda at_s: -7.0 - 0.01 * at_s, 3: lambda at_s: 60.0 + 0.05 * at_s}  # air: degC, percent
ANGLES = [-20.3, -11.2, 6.4, 15.9, 222.7]
STEP_DEG, RANGE_DEG, ARM_M, DATUM_DEG = 45.0, 22.5, 0.03261, -3.0
RADIUS_MM, FEED_MM_PER_S, FEED_IN_MM, RATE_HZ, REST_S = 100.0, 50.0, 2.0, 200, 0.7
BLOCK = 500


def freezing(reference):
    """The reference run in cold air: its vapour pressure is that over ice."""
    rows = []
    for table, values in run_files.with_synchronisation(run_files.read(reference)):
        values = list(values)
        if table == "environment" and values[0] in FREEZING:
            values[2] = FREEZING[values[0]](values[1] / SECOND)
        rows.append((table, values))
    return rows


def rotary(reference, seed=36):
    """The reference run's order, at five angles; rests of up to 20 degrees, some seconds of arc wrong.

    Readings in whole nanometres: the file is the same whatever computes its sines.
    """
    chance = random.Random(seed)
    rows, targets = [], iter(ANGLES)
    for table, values in run_files.with_synchronisation(run_files.read(reference)):
        values = list(values)
        if table == "plan":
            values[0], values[10] = "rotary", DATUM_DEG * 1e-3
        elif table == "plan_target":
            values[0] = next(targets) * 1e-3  # a degree stands as a millimetre
        elif table == "datum":
            values[2], values[3] = DATUM_DEG * 1e-3, 0.0
        elif table == "point":
            angle = ANGLES[values[3]] + chance.gauss(0, 10) / 3600
            rest = (angle - DATUM_DEG) - STEP_DEG * round((ANGLES[values[3]] - DATUM_DEG) / STEP_DEG)
            values[10] = round(ARM_M * 1.000268 * math.sin(math.radians(rest)), 9)
        rows.append((table, values))
    run_files.put_behind(rows, "air", [("rotary", ["indexing_table", STEP_DEG, ARM_M, RANGE_DEG, 2 * SECOND, 0, 1,
                                                   "not stated"])])
    return rows


def deviation_mm(turn, degrees, chance):
    """An ellipse, three lobes, a lag and noise: no two readings of a circle are alike."""
    angle = math.radians(degrees)
    return (0.012 * math.sin(2 * angle) + 0.004 * math.cos(3 * angle) - turn * 0.002 + chance.gauss(0, 2e-4))


def driven():
    """(times in ns, values in m, [(number, ns)]) of a bar through one circle of each sense."""
    chance = random.Random(20261123)
    outside, arc_s, feed_s = -FEED_IN_MM, 2 * math.pi * RADIUS_MM / FEED_MM_PER_S, FEED_IN_MM / FEED_MM_PER_S
    times, values, marks, now = [], [], [], 0.0
    for number, turn in ((1, 1), (2, -1)):
        marks.append((number, int((5 + now) * SECOND)))
        total = 2 * REST_S + 2 * feed_s + arc_s
        for i in range(math.ceil(now * RATE_HZ), math.ceil((now + total) * RATE_HZ)):
            t = (i + 0.37) / RATE_HZ - now - REST_S
            share = min(max((t - feed_s) / arc_s, 0.0), 1.0)
            inward = min(max(1 - t / feed_s, (t - feed_s - arc_s) / feed_s, 0.0), 1.0)
            here = deviation_mm(turn, 360 * (share if turn > 0 else 1 - share), chance)
            times.append(int((5 + (i + 0.37) / RATE_HZ) * SECOND))
            values.append(round((outside * inward + here) * 1e-3, 12))  # in whole picometres: the same from any sine
        now += total
    return times, values, marks + [(99, int((5 + now) * SECOND))]


def block_data(times, values):
    """docs/run-file.md, stream_block.data; the zstd frame (RFC 8878) holds one raw block."""
    first = [b - a for a, b in zip([0] + times, times)]
    second = [b - a for a, b in zip([0] + first, first)]
    folded = [2 * d if d >= 0 else -2 * d - 1 for d in second]
    words = [struct.pack("<Q", word) for word in folded]
    content = bytes(word[plane] for plane in range(8) for word in words) + struct.pack(f"<{len(values)}d", *values)
    frame = struct.pack("<IBI", 0xFD2FB528, 0xA0, len(content))
    return b"\x01" + frame + struct.pack("<I", 1 | len(content) << 3)[:3] + content


def circular(reference):
    """A ballbar on a circle of 100 mm, driven in both senses."""
    rows = run_files.header_without_plan(reference, "circular")
    times, values, marks = driven()
    rows += [("circular", ["XY", RADIUS_MM, FEED_MM_PER_S, "ccw cw", 1, 0, 0.0, 360.0, 0.0, FEED_IN_MM, 0, 0.0, 0.0,
                           0.0, "T1", "G54", float(RATE_HZ), None, 1, "feed_step", 0.0]),
             ("circular_bar", ["laser", 1, 0.0, None, None, None]),
             ("stream", [0, 0, "ballbar", "m", float(RATE_HZ)])]
    rows += [("event", ["note", at, SECOND**2 + at, "circle", "none", number]) for number, at in marks]
    for block, at in enumerate(range(0, len(times), BLOCK)):
        t, v = times[at:at + BLOCK], values[at:at + BLOCK]
        rows.append(("stream_block", [0, block, at + 1, len(t), 0, "", t[0], t[-1], min(v), max(v), 40000,
                                      block_data(t, v)]))
    return rows + [run_files.closing_of(reference)]
