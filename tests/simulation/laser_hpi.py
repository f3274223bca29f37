"""A Lasertex HPI-3D instead of the counter: read with its sensors, missed, found again."""

import bench
from bench import expect, sentence
from truth import compare, expect_found


def by_hpi(b):
    """The axis by an HPI-3D whose own correction for air is off."""
    laser = b.scenario["laser"]
    b.scenario["laser"] = {"kind": "hpi-3d", "path": "laser.tty", "fold": 2, "wavelength_nm": laser["wavelength_nm"],
                           "dead_path_mm": laser["dead_path_mm"], "zero_mm": laser["zero_mm"]}
    b.station["instrument"] = [one for one in b.station["instrument"] if one["name"] != "laser"]
    b.station["instrument"].append({
        "name": "laser", "driver": "lasertex", "link": f"serial:{b.folder}/laser.tty", "position": "raw",
        "wavelength": f"{laser['wavelength_nm']} nm", "fastest": "40 m/min",
        "certificate_number": "simulated", "due_on": "2099-12-31",
    })


def shown(b):
    return {one["channel"]: one["value"] for one in b.status()["channels"] if one["instrument"] == "laser"}


@sentence("HpiLaserIsReadWithItsSensorsMissedAndFoundAgain")
def hpi_fails(b):
    by_hpi(b)
    b.start()
    air, thermal = b.scenario["air"], b.scenario["thermal"]
    # Its last digits are 0.01 degC, 10 Pa and 1 %; the truth moves by less within two minutes.
    for channel, truth, bound in (
        ("air temperature", air["temperature"]["start"], 0.05),
        ("air pressure", air["pressure_pa"]["start"], 20),
        ("air humidity", air["humidity_percent"]["start"], 1),
        ("material 1", thermal["material"]["start"] + thermal["sensor_difference_k"][0], 0.05),
    ):
        bench.wait_until(f"{channel} is shown", lambda name=channel: shown(b).get(name) is not None, 30)
        expect(abs(shown(b)[channel] - truth) < bound, f"{channel}: {shown(b)}, true {truth}")
    b.sim("beam off")
    bench.wait_until("the beam is missed", lambda: shown(b)["axis 1"] is None, 30)
    b.sim("beam on")
    bench.wait_until("the beam is back", b.channels_are_good, 30)
    # After a restart it sends nothing until it is ordered: the driver gives up after eight seconds and orders anew.
    for trouble in ("sensor laser garbage", "restart-counter"):
        b.sim(trouble)
        bench.wait_until("the laser is given up", lambda: b.instrument("laser")["state"] != "available", 30)
        b.sim("sensor laser on")
        bench.wait_until("the laser is back", b.channels_are_good, bench.START_S)


@sentence("AxisByAnHpiLaserIsTheTruth")
def hpi_run(b):
    """It tells 25 positions a second: a still window is longer, and a gap of 80 ms about the end of an overrun
    hides 0.05 mm of it."""
    by_hpi(b)
    b.station["capture"]["window"] = "1 s"
    b.station["cycle"]["dwell"] = "1.2 s"
    b.scenario["axis"]["acceleration_mm_per_s2"] = 60.0
    b.scenario["truth"]["window_s"] = 1.0
    b.begin_run()
    certificate = b.finish()
    expect(b.run()["step"] == 20, f"{b.run()}")
    expect_found(compare(b.truth(), certificate))


if __name__ == "__main__":
    bench.main()
