"""`axiscal record` on the wires of the guest's kernel: what passed over them stands on a tape, from which the driver makes the same
readings again in virtual time. The daemon, which holds the wires, is ended first."""

import json
import re
import shutil
import subprocess

from guest import READY_S, SHARE, expect
from usb_station import bench  # noqa: F401  (lays the folder of the whole-run tests on the path)
from tapes import SAMPLE

RECORDED_S = 3  # opening, and some readings of one that is asked once a second
STILL_HELD = 33  # frames of CAN that a driver may hold at the end of a recording, and the next


def record(station, names):
    """All of them at once; gives back what the command says of each."""
    if "axiscald" in station.processes:
        station.end("axiscald")
    running = {name: subprocess.Popen(
        [station.program("axiscal"), "record", "--config", str(station.folder / "station.toml"), "--instrument", name, "--out",
         str(station.folder / f"{name}.tape"), "--for", str(RECORDED_S), "--origin", "simulator", "--who", "the rig", "--json"],
        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) for name in names}
    told = {}
    try:
        for name, process in running.items():
            said, complaint = process.communicate(timeout=READY_S)
            expect(process.returncode == 0, f"axiscal record of {name}: exit {process.returncode}: {said}{complaint}")
            told[name] = json.loads(said)
    finally:
        for process in running.values():
            process.kill()
            process.wait()
        for tape in station.folder.glob("*.tape"):
            shutil.copy(tape, SHARE)
    return told


def decoded(station, name):
    """What the driver makes of the tape: the numbers of each channel in their order, and its counters."""
    numbers, counters = {}, {}
    for line in station.axiscal("replay", "--print", station.folder / f"{name}.tape").splitlines():
        found = SAMPLE.match(line)
        if found and re.match(r"-?\d", found[2]):
            numbers.setdefault(found[1], []).append(float(found[2]))
        if line.startswith("counters "):
            words = line.split()[1:]
            counters = dict(zip(words[::2], map(int, words[1::2])))
    return numbers, counters


def on_tape(station, wires, modbus=()):
    """Records each of `wires` (instrument: what its tape must call the wire) and plays it to its driver. Every number that was seen
    while recording is made again, the last one of each channel among the last of the tape, and no frame is bad.
    Gives back the last number of each channel by (instrument, channel). `modbus`: recorded beside them; their tapes play on a wire only,
    so that they are held to what was read while they were made."""
    told, last = record(station, [*wires, *modbus]), {}
    for name in modbus:
        print(f"{name}: {told[name]['transfers']} transfers, {told[name]['samples']} readings")
        expect(told[name]["samples"] > 0, f"{told[name]}")
        last.update({(name, channel): value for channel, value in told[name]["last"].items()})
    for name, wire in wires.items():
        header = (station.folder / f"{name}.tape").read_text().split("\n\n")[0].split("\n")
        expect(f"wire = {wire}" in header and "origin = simulator" in header, f"{name}: {header}")
        numbers, counters = decoded(station, name)
        made = sum(map(len, numbers.values()))
        print(f"{name}: {told[name]['transfers']} transfers, {told[name]['samples']} readings, {made} made of them, {counters}")
        expect(made >= told[name]["samples"] > 0, f"{name}: {told[name]['samples']} readings became {made}")
        expect(counters["bad"] == counters["checksum"] == 0, f"{name}: {counters}")
        for channel, value in told[name]["last"].items():
            late = numbers.get(channel, [])[-STILL_HELD:]
            expect(any(abs(one - value) <= 1e-9 * abs(value) for one in late), f"{name}/{channel} ended with {value}, its tape with {late}")
            last[name, channel] = value
    return last
