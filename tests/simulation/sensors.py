"""Other sensors than the demo's, by profile, over RTU and TCP: a run completes with them."""

import bench
from bench import expect, sentence

# Driver channel and medium; the profiles state the unit.
XY_MD02 = ("xy-md02", ("air temperature", "air humidity"))
COMET = ("comet-t7310", ("air temperature", "air humidity", "air pressure"))


def air_by(b, wire):
    """Temperature and humidity from the XY-MD02, pressure from the Comet."""
    stick = next(one for one in b.station["instrument"] if one["name"] == "air")
    b.station["instrument"].remove(stick)
    b.scenario["sensor"] = [one for one in b.scenario["sensor"] if one["name"] != "air"]
    for name, kind, profile, channels in (
        ("air", "xy-md02", *XY_MD02),
        ("barometer", "comet", *COMET),
    ):
        place = {"path": f"{name}.tty"} if wire == "serial" else {"port": bench.free_port()}
        link = (
            f"serial:{b.folder}/{name}.tty" if wire == "serial"
            else f"tcp:127.0.0.1:{place['port']}"
        )
        # The manual's 0x31 is 0x30 on the wire.
        more = {"first_register": 0x30} if kind == "comet" else {}
        b.scenario["sensor"].append({"name": name, "kind": kind, **place, **more})
        b.station["instrument"].append(
            {
                "name": name,
                "driver": "modbus",
                "profile": str(bench.SOURCE / f"config/profiles/{profile}.toml"),
                "link": link,
                "certificate_number": "simulated",
                "due_on": "2099-12-31",
                "channel": [
                    {"channel": channel, "medium": "air", "place": "beside the beam"}
                    for channel in channels
                ],
            }
        )
    b.station["axis"]["air"]["pressure"] = "barometer/air pressure"
    b.station["axis"]["air"]["humidity"] = "air/air humidity"


def run_completes(b):
    b.begin_run()
    certificate = b.finish()
    expect(b.run()["step"] == 20, f"{b.run()}")
    shown = {one["channel"]: one for one in certificate["environment"]["channels"]}
    true = b.scenario["air"]
    pressure = next(one for name, one in shown.items() if "pressure" in name)
    # 0.1 hPa is the Comet's last digit; the truth drifts by 30 Pa an hour.
    expect(abs(pressure["first"] - true["pressure_pa"]["start"]) < 15, f"{pressure}")


@sentence("AirByXyMd02AndCometOverRtuCarriesARun")
def air_rtu(b):
    air_by(b, "serial")
    run_completes(b)


@sentence("AirByXyMd02AndCometOverTcpCarriesARun")
def air_tcp(b):
    air_by(b, "tcp")
    run_completes(b)


@sentence("MaterialByATemperX232IsReadWhileItsProbeIsTheOnlySensor")
def temper_serial(b):
    b.scenario["sensor"].append({"name": "stick", "kind": "temper-serial", "path": "stick.tty"})
    b.station["instrument"].append({
        "name": "stick", "driver": "temper-serial", "link": f"serial:{b.folder}/stick.tty",
        "certificate_number": "simulated", "due_on": "2099-12-31",
        "channel": [{"channel": "probe temperature", "medium": "material", "place": "screw"}],
    })
    b.station["axis"]["material"]["temperature"] = ["stick/probe temperature"]
    b.start()
    shown = {one["channel"]: one["value"] for one in b.status()["channels"] if one["instrument"] == "stick"}
    thermal, air = b.scenario["thermal"], b.scenario["air"]
    # The stick's last digit is 0.01; the truth moves by 0.02 K (air) and 0.02 % at most within two minutes.
    for channel, truth, bound in (
        ("probe temperature", thermal["material"]["start"] + thermal["sensor_difference_k"][0], 0.02),
        ("stick temperature", air["temperature"]["start"], 0.05),
        ("stick humidity", air["humidity_percent"]["start"], 0.1),
    ):
        expect(abs(shown[channel] - truth) < bound, f"{channel}: {shown}, true {truth}")
    b.sim("sensor stick off")
    bench.wait_until("the stick is missed", lambda: b.instrument("stick")["state"] != "available", 30)
    b.sim("sensor stick on")
    bench.wait_until("it is back", lambda: b.instrument("stick")["state"] == "available", 30)


@sentence("HomodyneCounterCarriesARun")
def homodyne(b):
    """No reference, no interpolation, no error mask: four counts a fringe and a sequence number."""
    b.scenario["laser"].update(kind="umd2-homodyne", counts_per_cycle=4)
    b.station["capture"]["spread_limit"] = "5 um"  # a count is 0.08 um, without interpolation
    run_completes(b)


if __name__ == "__main__":
    bench.main()
