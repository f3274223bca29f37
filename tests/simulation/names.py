"""Names are for people: the two example files, and names as bad as can be, lead to a certificate on the share.

Of an example file only what must differ here is changed: where it lives, what it is wired to, and how
long a run takes. Its names, its texts and its tables stay as they are shipped."""

import json
import re
import tomllib
from pathlib import Path

import bench
import papers
import rotary
from bench import SOURCE, expect, sentence


def example(name):
    return tomllib.loads((SOURCE / "config" / name).read_text(encoding="utf-8"))


def house(b, station):
    """The shipped station in the scratch folder of the bench, on its wires."""
    own = b.station
    station["station"]["state_directory"] = own["station"]["state_directory"]
    station["console"] = own["console"]
    station["publish"] = own["publish"]
    station["trigger"] = own["trigger"]
    station["preflight"] = own["preflight"]
    wires = {one["name"]: one for one in own["instrument"]}
    for instrument in station["instrument"]:
        wire = wires[instrument["name"]]
        instrument.update({key: wire[key] for key in ("link", "profile") if key in wire})
        # The serial numbers are those of other devices than the simulated ones.
        instrument.pop("serial", None)
        instrument["due_on"] = "2099-12-31"
    b.station = station


def whole_run(b, *words_of_arming):
    b.start()
    b.write_program()
    b.go_to_datum()
    b.arm(*words_of_arming)
    certificate = b.finish()
    papers.publish(b)
    return certificate


def judge(b, certificate, station, axis):
    run = b.run()
    folder = run["id"]
    expect(re.fullmatch(r"[A-Za-z0-9_][A-Za-z0-9_-]*", folder), f"the run's id: {folder!r}")
    expect(b.status()["station"] == station, f"the station is shown as {b.status()['station']!r}")
    expect(certificate["run"]["id"] == folder, f"{certificate['run']['id']}")
    runs = b.folder / "state" / "runs"
    expect(Path(run["file"]).parent == runs, f"the run file lies at {run['file']}")
    expect([one.name for one in runs.glob("*.axiscal")] == [f"{folder}.axiscal"], "one run file")
    copies = sorted(one.name for one in (b.share / folder).iterdir())
    expect({Path(one).suffix for one in copies} >= {".pdf", ".json", ".csv", ".axiscal"}, f"{copies}")
    checked = json.loads(b.axiscal("verify", run["file"], "--certificate",
                                   b.share / folder / "certificate.json", "--json"))
    expect(checked["findings"] == [] and checked["certificate_findings"] == [], f"{checked}")
    told = json.dumps(certificate, ensure_ascii=False)
    expect(json.dumps(axis, ensure_ascii=False)[1:-1] in told, f"the axis {axis!r} on the certificate")


@sentence("ExampleStationFileLeadsToACertificateOnTheShare")
def station_example(b):
    house(b, example("station.example.toml"))
    b.station["axis"]["travel_high"] = "400 mm"
    b.station["cycle"].update(interval="80 mm", target_count=5, first_target="28 mm", approaches=2, seed=20261121)
    b.station["capture"]["fastest"] = "40 m/min"  # of the simulated machine
    b.station["instrument"][0]["fastest"] = "40 m/min"
    b.hurry()
    judge(b, whole_run(b), "bay 3", "X")
    expect(b.run()["id"].startswith("bay-3-"), b.run()["id"])


@sentence("ExampleStationFileOfARotaryAxisLeadsToACertificateOnTheShare")
def rotary_example(b):
    rotary.rotary(b)
    own = b.station
    house(b, example("rotary.example.toml"))
    axis = b.station["axis"]
    axis.update({key: own["axis"][key] for key in ("travel_low", "travel_high")})
    axis["angle"]["turn_time"] = own["axis"]["angle"]["turn_time"]
    axis["angle"]["range"] = own["axis"]["angle"]["range"]
    b.station["cycle"].update(own["cycle"])
    b.station["capture"].update(own["capture"])
    b.station["instrument"][0]["fastest"] = "40 m/min"
    judge(b, whole_run(b), "bay 3", "A")


HOSTILE = [
    ("../../out", "X/1"),
    ("hall3/bay2", "..\\..\\X"),
    ("CON", "NUL."),
    ("工位三 \U0001f527", "оси №1 <b>&amp;"),
    ("\x00\x1b[31m\r\nX-Forged: 1", "%(G0 X999)\n%"),
    (" . ", "a" * 300),
]


def hostile(number):
    def run(b):
        station, axis = HOSTILE[number]
        shown = "".join(" " if letter < " " else letter for letter in station)
        b.station["station"]["name"] = station
        b.station["axis"].update(name=axis, program_axis="X")
        words = f"{station} {axis} =1+1;'\"--"
        b.station["certificate"].update({key: words for key in ("machine", "machine_serial", "place", "procedure")})
        for instrument in b.station["instrument"]:
            for channel in instrument.get("channel", []):
                channel["place"] = words
        # No program can be given a NUL among its words.
        certificate = whole_run(b, "--state-that", f"operator={words}".replace("\x00", ""))
        judge(b, certificate, shown, "".join(" " if letter < " " else letter for letter in axis))
        program = Path(b.plan["file"]).read_bytes()
        expect(program.isascii() and not re.search(rb"[\x00-\x09\x0b-\x1f%]", program), "the part program")
        outside = [one for one in b.folder.parent.iterdir() if re.match(r"out([-.]|$)", one.name)]
        expect(not outside, f"written outside of its folder: {outside}")

    return run


@sentence("HostileNamesOfAPathLeadToACertificate")
def of_a_path(b):
    hostile(0)(b)


@sentence("HostileNamesOfAnotherPathLeadToACertificate")
def of_another_path(b):
    hostile(1)(b)


@sentence("HostileNamesOfWindowsDevicesLeadToACertificate")
def of_devices(b):
    hostile(2)(b)


@sentence("NamesInOtherLettersLeadToACertificate")
def of_other_letters(b):
    hostile(3)(b)


@sentence("HostileNamesOfControlCharactersLeadToACertificate")
def of_control_characters(b):
    hostile(4)(b)


@sentence("HostileNamesWithoutALetterOrWithoutAnEndLeadToACertificate")
def of_nothing(b):
    hostile(5)(b)


if __name__ == "__main__":
    bench.main()
