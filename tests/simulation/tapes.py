"""What passes over an instrument's wire is kept on a tape, and gives the unmodified daemon the same
readings again."""

import json

import bench
from bench import expect, sentence

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
