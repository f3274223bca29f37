"""What passes over an instrument's wire is kept on a tape, and gives the unmodified daemon the same
readings again."""

import json
import re
import tomllib

import bench
from bench import SOURCE, expect, sentence

RECORDED = {"laser": ["axis 1"], "air": ["air temperature", "air pressure", "air humidity"],
            "material": ["contact 1", "contact 2"]}


def record(b, name):
    tape = b.folder / f"{name}.tape"
    told = json.loads(b.axiscal("record", "--config", b.folder / "station.toml", "--instrument", name, "--out", tape,
                                "--for", 4, "--origin", "simulator", "--who", "the bench", "--json"))
    expect(told["samples"] > 0 and told["transfers"] > 0, f"{told}")
    expect(set(told["last"]) >= set(RECORDED[name]), f"{told}")
    header = tape.read_text().split("\n\n")[0].split("\n")
    expect("origin = simulator" in header and "who = the bench" in header, f"{header}")
    return told


def play(b, name):
    log = b.spawn("axiscal", "replay", b.folder / f"{name}.tape", "--link", b.folder / f"{name}.tty", "--hold", "--json")
    b.wait_for_line("axiscal", log, '"ready":true')
    b.processes["replay " + name] = b.processes.pop("axiscal")


@sentence("InstrumentsOnTapeGiveTheDaemonTheSameReadings")
def round_trip(b):
    """Air and laser by their own links, the material's Modbus line over a wire made between."""
    b.start_simulator()
    b.write_station()
    told = {name: record(b, name) for name in RECORDED}
    b.end("axiscal-simulate")
    b.start_daemon()
    seen = {}

    def look():
        for channel in b.status()["channels"]:
            if channel["value"] is not None:
                seen.setdefault((channel["instrument"], channel["channel"]), set()).add(channel["value"])
        return {(name, channel) for name in RECORDED for channel in RECORDED[name]}

    look()
    expect(not seen, f"readings without an instrument: {seen}")
    for name in RECORDED:
        play(b, name)
    for name in ("air", "material"):
        for channel in RECORDED[name]:
            last = told[name]["last"][channel]
            bench.wait_until(
                f"{name}/{channel} reads {last}",
                lambda: look() and any(abs(value - last) <= 1e-9 * abs(last) for value in seen.get((name, channel), ())),
                30,
            )
    # The bytes are the same, so are the frames; a Modbus line is polled as long as it answers.
    for name in ("laser", "air"):
        wanted = told[name]["samples"]
        bench.wait_until(f"{name} gave {wanted} samples", lambda: b.instrument(name)["samples"] == wanted, 30)


# Instrument here, and its tape: USB transfers, HID reports, frames of CAN, files and records of the kernel.
WITHOUT_A_WIRE = {"stick": "dracal-usbtenki-pth", "pen": "temper-x", "lever": "labjack-u6-stream",
                  "node": "canopen-404-cantrans", "rod": "canopen-406-temposonics", "screw": "ds18b20", "scale": "counter-capture"}
SAMPLE = re.compile(r"\+\d+ (.+?) (\S+?)(?: #\d+)?(?: epoch \d+)?$")
COUNTERS = {"frames": "frames", "samples": "samples", "bad": "bad_frames", "checksum": "checksum_errors", "gaps": "gaps",
            "lost": "lost_records", "timeouts": "timeouts"}


def expectation(tape):
    """What the driver must hand up: all said by each channel, in its order, and the counters."""
    said, counted = {}, {}
    for line in (SOURCE / "tests/traces" / f"{tape}.expected").read_text().splitlines():
        if found := SAMPLE.match(line):
            said.setdefault(found[1], []).append(found[2])
        if line.startswith("counters "):
            words = line.split()[1:]
            counted = {COUNTERS[name]: int(count) for name, count in zip(words[::2], words[1::2]) if name in COUNTERS}
    expect(said and len(counted) == len(COUNTERS), f"{tape}: {said}, {counted}")
    return said, counted


def is_said(channel, words):
    """Whether the status shows what the expectation says: a number, or a quality and no number."""
    if channel["value"] is None:
        return channel["quality"] == words
    return re.match(r"-?\d", words) and abs(channel["value"] - float(words)) <= 1e-9 * abs(float(words))


@sentence("TapesWithoutAWireGiveTheUnmodifiedDaemonWhatIsExpected")
def without_a_wire(b):
    """Nothing else is there: every value that is shown is one of the tape's, and nothing can be armed."""
    for name, tape in WITHOUT_A_WIRE.items():
        block = b.axiscal("replay", SOURCE / "tests/traces" / f"{tape}.tape", "--block", name)
        b.station["instrument"] += tomllib.loads(block)["instrument"]
    b.write_station()
    expected = {name: expectation(tape) for name, tape in WITHOUT_A_WIRE.items()}
    states = {name: set() for name in expected}
    b.start_daemon()
    log = b.logs[-1]

    def played():
        status = json.loads(b.axiscal("status", "--json"))
        for channel in status["channels"]:
            if channel["quality"] in ("none", "stale"):
                continue
            shown = f"{channel['instrument']}/{channel['channel']}: {channel['value']} {channel['quality']}"
            if channel["instrument"] not in expected:
                expect(channel["value"] is None, f"no tape gives {shown}")
                continue
            said = expected[channel["instrument"]][0][channel["channel"]]
            expect(any(is_said(channel, words) for words in said), f"{shown} is not one of {said}")
        tapes = [one for one in status["instruments"] if one["name"] in expected]
        for one in tapes:
            expect(one["tape"].endswith(f"/{WITHOUT_A_WIRE[one['name']]}.tape"), f"{one}")
            states[one["name"]].add(one["state"])
        return status if all(one["note"] == "the tape is at its end" for one in tapes) else None

    status = bench.wait_until("every tape is at its end", played, 60)
    for one in status["instruments"]:
        if one["name"] in expected:
            counted = {counter: one[counter] for counter in COUNTERS.values()}
            expect(counted == expected[one["name"]][1], f"{one['name']} counts {counted}, not {expected[one['name']][1]}")
            expect(states[one["name"]] <= {"tape", "unavailable"}, f"{one['name']} was {states[one['name']]}")
            bench.wait_until(f"the log says that {one['name']} plays a tape",
                             lambda words=f"{one['name']} plays a tape.": words in log.read_text(errors="replace"), 10)
    expect("tape" in states["node"], f"the node's state while it played: {states['node']}")
    last = {(one["instrument"], one["channel"]): one for one in status["channels"]}
    for name in ("stick", "pen", "node", "screw"):  # a length older than two seconds is stale
        for channel, said in expected[name][0].items():
            expect(is_said(last[name, channel], said[-1]), f"{name}/{channel} ends with {said[-1]}: {last[name, channel]}")
    b.axiscal("arm", "--override", "instruments=the customer waits", code=4)
    expect("stick plays the tape" in b.complaint, b.complaint)
    expect("no instrument: plays /" in b.axiscal("status"), "status names no tape")


@sentence("RecordingNeverOverwritesATapeAndNamesWhatIsNotThere")
def refusals(b):
    b.start_simulator()
    b.write_station()
    station = b.folder / "station.toml"
    tape = b.folder / "air.tape"
    tape.write_text("precious")
    b.axiscal("record", "--config", station, "--instrument", "air", "--out", tape, code=2)
    expect(tape.read_text() == "precious", "the tape was overwritten")
    b.axiscal("record", "--config", station, "--instrument", "aire", "--out", b.folder / "x", code=3)
    expect("laser, air, material" in b.complaint, b.complaint)
    b.end("axiscal-simulate")
    b.axiscal("record", "--config", station, "--instrument", "air", "--out", b.folder / "x", "--for", 1, code=1)
    expect("is axiscald stopped" in b.complaint, b.complaint)
    expect(not (b.folder / "x").exists(), "an empty tape was kept")


if __name__ == "__main__":
    bench.main()
