"""A first station file is short, and a certificate comes of it."""

import tomllib

import bench
from bench import expect, sentence

PARTS = ("laser/axis 1", "air/air temperature", "air/air pressure", "air/air humidity", "material/contact 1", "material/contact 2")
MOST_LINES, MOST_NOT_OF_INSTRUMENTS = 30, 15


def lines_of(text):
    return [line for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#")]


def all_give_values(b):
    values = {f"{one['instrument']}/{one['channel']}": one["value"] for one in b.status()["channels"]}
    return all(values.get(name) is not None for name in PARTS)


@sentence("AStationFileOfThirtyLinesGivesACertificate")
def short_file(b):
    """Only the places of the test are added to what `axiscal station new` wrote, and what shortens its waiting."""
    b.shorten()
    b.start_simulator()
    path = b.folder / "new.toml"
    axis, cycle = b.station["axis"], b.station["cycle"]
    profile = next(one["profile"] for one in b.station["instrument"] if one["name"] == "material")
    b.axiscal("station", "new", "--out", path, "--axis", axis["name"], "--travel-low", axis["travel_low"],
              "--travel-high", axis["travel_high"], "--sign", axis["sign"], "--dead-path", axis["dead_path"],
              "--expansion", axis["material"]["coefficient"], "--expansion-uncertainty", axis["material"]["standard_uncertainty"], "--overrun", cycle["overrun"], "--feed", cycle["feed"],
              "--shape", "sequence-block", "--transport", "tcp", "--client", "none", "--sysfs", b.folder, "--dev", b.folder,
              "--instrument", f"{b.folder}/laser.tty=umd", "--instrument", f"{b.folder}/air.tty=dracal-vcp",
              "--instrument", f"{b.folder}/material.tty=modbus", "--set", f"material.profile={profile}")
    text = path.read_text()
    lines = lines_of(text)
    expect(len(lines) <= MOST_LINES, f"{len(lines)} lines:\n{text}")
    own = lines.index("[[instrument]]")
    expect(own <= MOST_NOT_OF_INSTRUMENTS, f"{own} lines that no instrument has:\n{text}")
    made = tomllib.loads(text)
    made["trigger"]["port"] = b.station["trigger"]["port"]
    made["cycle"] |= {"dwell": cycle["dwell"], "approaches": 2}
    made["capture"] = {name: b.station["capture"][name] for name in ("window", "timeout", "slope_limit")}
    b.station = made | {name: b.station[name] for name in ("station", "console", "publish", "preflight")}
    b.write_station()
    b.start_daemon()
    bench.wait_until("every sensor gives a value", lambda: all_give_values(b), bench.START_S)
    b.write_program()
    b.go_to_datum()
    b.arm("--state-that", "state=as found", "--state-that", "control_compensation=none")
    certificate = b.finish()
    expect(b.run()["step"] == 44, f"{b.run()}")
    expect("A" in certificate["parameters"], f"{certificate.get('not_evaluated')}")
    print(f"{len(lines)} lines, {own} of them before the instruments")


if __name__ == "__main__":
    bench.main()
