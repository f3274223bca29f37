"""Run files as a person with docs/run-file.md could write them: rows, their chain, one file of each kind.

A run is a list of (table, values) in the order of the chain; nothing of the product is used.
"""
import contextlib
import glob
import hashlib
import os
import re
import sqlite3
import struct

IDENTITY, FORMAT = 0x4158434C, 1
NAMES_OF_COLUMNS = "record_columns.hpp", "setups/*.cpp"


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


def texts_of(source, pattern):
    """{name: text} of files of acquisition/runfile, sorted."""
    home = os.path.join(source, "acquisition", "runfile")
    texts = {}
    for path in sorted(glob.glob(os.path.join(home, pattern))):
        with open(path, encoding="utf-8") as file:
            texts[os.path.relpath(path, home)] = file.read()
    return texts


def schema_of(source):
    """schema.sql with the tables of each kind where it names their file, else at its end."""
    (schema,) = texts_of(source, "schema.sql").values()
    for name, tables in texts_of(source, "setups/*.sql").items():
        line = f"-- {name}\n"
        schema = schema.replace(line, tables) if line in schema else schema + tables
    return schema


def new_file(path, source):
    """An empty run file, with every table."""
    base = sqlite3.connect(path)
    base.executescript("\n".join(l for l in schema_of(source).splitlines() if not l.startswith("--")))
    base.execute(f"PRAGMA application_id={IDENTITY}")
    base.execute(f"PRAGMA user_version={FORMAT}")
    return base


def columns_of(base, table):
    return [row[1] for row in base.execute(f"PRAGMA table_info({table})")
            if row[1] not in ("link", "hash")]


def tables_of(base):
    """The tables of the chain, as the file itself has them."""
    names = [row[0] for row in base.execute("SELECT name FROM sqlite_schema WHERE type='table' ORDER BY rowid")]
    return [name for name in names
            if {"link", "hash"} <= {row[1] for row in base.execute(f"PRAGMA table_info({name})")}]


def tables_of_program(source):
    """The tables of the chain, as the program knows them."""
    return [name for pattern in NAMES_OF_COLUMNS for text in texts_of(source, pattern).values()
            for name in re.findall(r'\bTable\{"(\w+)"', text)]


def rows_of(base):
    """{link: (table, values)} of the whole chain."""
    rows = {}
    for table in tables_of(base):
        columns = ", ".join(columns_of(base, table))
        for link, *values in base.execute(f"SELECT link, {columns} FROM {table}"):
            rows[link] = (table, values)
    return rows


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


def write(path, source, rows):
    with contextlib.closing(new_file(path, source)) as base, base:
        before = bytes(32)
        for link, (table, values) in enumerate(rows, 1):
            before = hashlib.sha256(before + canonical(table, values)).digest()
            marks = ", ".join("?" * (len(values) + 2))
            base.execute(f"INSERT INTO {table} VALUES({marks})", (link, *values, before))


def read(path):
    """The rows of the reference run."""
    with contextlib.closing(sqlite3.connect(path)) as base:
        return [row for _, row in sorted(rows_of(base).items())]


def put_behind(rows, table, more):
    """Behind the last row of that table."""
    last = max(i for i, row in enumerate(rows) if row[0] == table)
    rows[last + 1:last + 1] = more


def with_synchronisation(rows):
    """Each datum and point with what its uncertain time of 40 us adds."""
    out = []
    for table, values in rows:
        values = list(values)
        if table == "datum":
            values[10:12] = [40000, abs(values[6]) * 40e-6]
        if table == "point":
            values[17:19] = [40000, abs(values[12]) * 40e-6]
        out.append((table, values))
    return out


def linear(reference):
    """The reference run, with all that a header can hold of a positioning run."""
    rows = with_synchronisation(read(reference))
    put_behind(rows, "air", [("uncertainty", [None, None, 2.0, 2e-6, 1e-6, 0.001, None, 1.0, 2e-6, 1.7e-6, "mean"]),
                             ("uncertainty_target", ["A", 0.000005]),
                             ("uncertainty_target", ["B_mean", 0.000005]),
                             ("tolerance_set", ["agreed", "order 17", "um", "guard-U", 0]),
                             ("tolerance_limit", ["A", 500.0, 20.0]), ("tolerance_limit", ["B", None, 6.0]),
                             ("standard", ["ISO 230-2:2014"]), ("standard", ["VDI/DGQ 3441"])])
    put_behind(rows, "channel", [
        ("channel_calibration", [1, "C-1", "2026-01-01", "2027-01-01", 0.1, None, 2.0]),
        ("channel_calibration", [4, "C-4", "2026-01-01", "2027-01-01", 0.1, None, 2.0]),
        ("channel_correction", [4, 15.0, 0.01]), ("channel_correction", [4, 20.0, 0.02]),
        ("channel_correction", [4, 25.0, 0.01]),
        ("alignment", [10**18, 10**18 + 6 * 10**10, "laser", "S-1", 0.4, 0.39, 600, 2, 0, 0.39, 3e-6, 1e-6,
                       2e-7, 12, 1, None]),
        ("alignment_place", [0.0, 0.2, 300, 70.0, 80.0, 75.0]),
        ("alignment_place", [0.2, 0.4, 300, 60.0, 75.0, 70.0]),
        ("eve_source", ["drift-20261120T100000Z-X"])])
    armed = next(i for i, row in enumerate(rows) if row[0] == "datum")
    rows[armed:armed] = [("preflight", [name, 1, 0, "Held.", ""])
                         for name in ("instruments", "soak", "agreement", "strength", "certificates")]
    rows[armed:armed] = [("ordered", ["arm", "", 10**9, 10**18, "socket", 1000, "jo", "Jo Miller"]),
                         ("ordered", ["override", "soak", 10**9, 10**18, "token", None, "", ""])]
    return rows


def revised(reference):
    """That run, closed, then two points taken again and two readings left out, and closed again, twice."""
    rows = linear(reference)
    closing = rows[-1]
    at_ns, utc_ns = closing[1][2] + 10**10, closing[1][3] + 10**10
    old = {values[0]: values for table, values in rows if table == "point"}

    def closed(minutes):
        return ("closing", [1, "Every planned point is durable."] + [t + minutes * 6 * 10**10 for t in closing[1][2:]])

    def taken(steps, first, minutes):
        points = [("point", [first + i, old[step][1] + 50, *old[step][2:7],
                             *(t + minutes * 6 * 10**10 for t in old[step][7:10]), *old[step][10:]])
                  for i, step in enumerate(steps)]
        order = [("retake_point", [first + i, step]) for i, step in enumerate(steps)]
        return order, with_synchronisation(points)

    order, points = taken([3, 6, 13], 50, 1)
    rows += [("retake", [1, at_ns, utc_ns, "coolant on the mirror"]), *order,
             ("ordered", ["retake", "1", at_ns, utc_ns, "socket", 1000, "jo", ""]),
             ("exclusion", [20, at_ns, utc_ns, "a door was open"]),
             ("exclusion", [22, at_ns, utc_ns, "a door was open"]), *points, closed(1)]
    order, points = taken([16], 53, 2)
    rows += [("retake", [2, at_ns, utc_ns, "once more"]), *order, *points, closed(2)]
    rows += [("exclusion", [24, at_ns, utc_ns, "a door was open"]), closed(3)]
    rows += [("answer", ["growth", at_ns, utc_ns, "the door stood open in cycle 2"]), closed(4)]
    return rows


def header_without_plan(reference, kind):
    """Of a run that positions nothing: no targets and no planned points."""
    kept = ("run", "test", "plan", "laser", "material", "air", "statement", "instrument", "channel")
    rows = [(table, list(values)) for table, values in read(reference) if table in kept]
    next(values for table, values in rows if table == "test")[0] = kind
    return rows


def closing_of(reference):
    return read(reference)[-1]


def some_air(reference, count=12):
    return [row for row in read(reference) if row[0] == "environment"][:count]


def circular(reference):
    """Two circles recorded in two streams, eight blocks of four samples each."""
    rows = header_without_plan(reference, "circular")
    rows.append(("eve_source", ["ballbar-20261120T100000Z-XY-ballbar-drift"]))
    air = some_air(reference)
    rows += [("event", ["armed", 10**9, 10**18, "Armed.", "none", 0]),
             ("circular", ["XY", 40.0, 100.0, "ccw cw", 1, 0, 0.0, 360.0, 180.0, 0.5, 0, 0.0, 0.0, 0.0, "T1",
                           "G54", 1000.0, None, 1, "feed_step", 0.0]),
             ("circular_bar", ["laser", 1, 40.0, None, None, None]),
             ("circular_uncertainty", [0.1, 0.2, 2.0, 0.1, 0.1, None, None, None, None, None, 1]),
             ("stream", [0, 0, "axis 1", "m", 1000.0]), ("stream", [1, 1, "air temperature", "degC", 1.0])]
    for block in range(8):
        for stream in (0, 1):
            begin_ns = (block + 2) * 10**9
            rows.append(("stream_block", [stream, block, 4 * block, 4, 0, "", begin_ns, begin_ns + 3 * 10**6, 0.0,
                                          0.001, 40000, bytes(range(16))]))
        rows.append(air[block])
        rows.append(("event", ["note", begin_ns, 10**18 + begin_ns, f"Circle {block}.", "none", block]))
    return rows + [closing_of(reference)]


def rotary(reference):
    """The reference run, as of a rotary axis behind an indexing table of eight positions."""
    rows = with_synchronisation(read(reference))
    plan = next(values for table, values in rows if table == "plan")
    plan[0] = "rotary"
    put_behind(rows, "air", [("rotary", ["indexing_table", 45.0, 0.03261, 10.0, 2 * 10**8, 0, 1, "not stated"]),
                             *(("rotary_deviation", [0.5 * i]) for i in range(8))])
    return rows


def scale(reference):
    """The reference run, as of an axis that a linear scale measured; one of its sensors sits on the scale."""
    rows = with_synchronisation(read(reference))
    put_behind(rows, "air", [("linear_scale", [1e-7, 8.5e-6, 0.5e-6, None]), ("linear_scale_sensor", [5])])
    return rows


def imported(reference):
    """The reference run, as if its readings were the deviations of another program."""
    rows = with_synchronisation(read(reference))
    put_behind(rows, "air", [("imported", ["X.rtl", "Laser10 text (.rtl, .rta)", "ab" * 32, "2026-11-21 10:00", "sorted"])])
    return rows


def probing(reference):
    """Six touches, nothing else."""
    rows = header_without_plan(reference, "probing")
    rows.append(("probing", [100.0, "P-1", "radio"]))
    rows += [("probing_touch", [1.0, 0.0, 0.0, int(i == 0), 0.004, 0.001 * i, 0.0, 0.0]) for i in range(6)]
    return rows + [("event", ["note", 10**9, 10**18, "From the log of the control.", "none", 0]), closing_of(reference)]


OPTICS = ["wollaston", "Y", 1, 36.012, 1e-10, "normal", "", 0.0, 0.0, "prism on the table"]
OF_OPTICS = [0.005, None, 2.0, 0.15, None, 2.0, None, 2.0, 4e-7, None]


def across(reference, kind):
    """The reference run, as if its laser had looked through a Wollaston prism: what it counts is across the axis."""
    rows = with_synchronisation(read(reference))
    next(values for table, values in rows if table == "test")[0] = kind
    for table, values in rows:
        if table == "point":
            values[14] = 0.0  # nothing across shows from which side the axis came
    return rows


def line_at(rows, scale):
    """Target, mean forward and backward of a line that was kept, at the targets of the run."""
    targets = [values[0] for table, values in rows if table == "plan_target"]
    return [[target, scale * i * 1e-6, scale * i * 1e-6 + 5e-7] for i, target in enumerate(targets)]


def straightness(reference):
    """With what the run with the mirror in the other position gave."""
    rows = across(reference, "straightness")
    put_behind(rows, "channel", [
        ("straightness", [*OPTICS[:6], "bench-20261121T090000Z-X", *OPTICS[7:]]),
        ("straightness_uncertainty", OF_OPTICS), ("straightness_reversal", ["X", "Y", 5, 2e-7]),
        *(("straightness_reversal_row", values) for values in line_at(rows, 2))])
    return rows


def squareness(reference):
    """The second of two axes, by reversal of the square."""
    rows = across(reference, "squareness")
    first = ["bench-20261121T090000Z-Y", "Y", "X", 5, 2e-7]
    other_first = ["bench-20261121T070000Z-Y", "Y", "X", 5, 2e-7]
    other_second = ["bench-20261121T080000Z-X", "X", "Y", 5, 2e-7]
    put_behind(rows, "channel", [
        ("squareness", ["turned", *OPTICS, *first]),
        ("squareness_uncertainty", [*OF_OPTICS, None, None, 1e-6, 2.0, 5e-7]),
        *(("squareness_line_row", ["first", *values]) for values in line_at(rows, 2)),
        ("squareness_other", [*other_first, *other_second]),
        *(("squareness_line_row", ["other_first", *values]) for values in line_at(rows, 3)),
        *(("squareness_line_row", ["other_second", *values]) for values in line_at(rows, 1))])
    return rows


def drift(reference):
    """A minute of readings of an axis at rest."""
    rows = header_without_plan(reference, "drift")
    rows.append(("drift", [60 * 10**9, 10**9, 0.1, 0]))
    return rows + some_air(reference) + [closing_of(reference)]
