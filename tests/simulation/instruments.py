"""One instrument that fails disturbs no other, is told, and comes back by itself."""

import bench
from bench import expect, sentence
from truth import compare, expect_found


def laser_was_undisturbed(b):
    laser = b.instrument("laser")
    expect(laser["state"] == "available", f"{laser}")
    expect(laser["gaps"] == laser["lost_records"] == laser["restarts"] == 0, f"{laser}")


def fails_and_comes_back(b, sensor, behaviour, words):
    """Points need the sensor: refused while it is stale, taken again when it is back."""
    b.station["axis"]["air"]["oldest"] = "2 s"
    b.station["capture"]["timeout"] = "20 s"  # the CNC waits for its answer as long
    b.begin_run(hold_after=3)
    b.wait_for_points(3)
    b.sim(f"sensor {sensor} {behaviour}")
    b.sim("go")
    run = b.wait_for_refusal("environment_stale")
    expect(words in run["sentence"], run["sentence"])
    others = [one for one in b.status()["instruments"] if one["name"] != sensor]
    expect(all(one["state"] == "available" for one in others), f"{others}")
    refused = b.sim("status")
    expect(refused["result"] == 4 and refused["done"] == run["done"], f"{refused}")

    b.sim(f"sensor {sensor} on")
    bench.wait_until("the sensor is back", b.channels_are_good, 30)
    # The CNC asks again as docs/trigger.md says: 0, then the same number.
    b.foreign_request(0)
    b.foreign_request(run["done"] + 1)
    b.finish()
    expect(b.run()["step"] == 20, f"{b.run()}")
    laser_was_undisturbed(b)


def by_ids(b):
    """The axis by an attocube IDS3010 instead of the counter."""
    port = bench.free_port()
    laser = b.scenario["laser"]
    b.scenario["laser"] = {"kind": "ids3010", "port": port, "wavelength_nm": 1530.0, "fold": 2,
                           "dead_path_mm": laser["dead_path_mm"], "zero_mm": laser["zero_mm"]}
    b.station["instrument"] = [one for one in b.station["instrument"] if one["name"] != "laser"]
    b.station["instrument"].append({
        "name": "laser", "driver": "ids3010", "link": f"tcp:127.0.0.1:{port}", "air": "corrected here",
        "wavelength": "1530 nm", "fastest": "40 m/min",
        "certificate_number": "simulated", "due_on": "2099-12-31",
    })


@sentence("IdsLaserThatFallsSilentOrSendsGarbageIsToldAndComesBack")
def ids_fails(b):
    by_ids(b)
    b.start()
    others = ("air", "material")
    for behaviour in ("off", "garbage"):
        before = {name: b.instrument(name)["restarts"] for name in others}
        b.sim(f"sensor laser {behaviour}")
        bench.wait_until("the laser is given up", lambda: b.instrument("laser")["state"] != "available", 20)
        b.sim("sensor laser on")
        # Here only that it comes: how soon is no matter of a host that others use, too.
        bench.wait_until("the laser is back", b.channels_are_good, bench.START_S)
        expect({name: b.instrument(name)["restarts"] for name in others} == before, "others were disturbed")
    log = "\n".join(log.read_text(errors="replace") for log in b.logs if log.name.startswith("axiscald"))
    expect(log.count("laser is unavailable") + log.count("laser is faulty") == 2, log)


@sentence("AxisByAnIdsLaserIsTheTruth")
def ids_run(b):
    by_ids(b)
    # It is asked a hundred times a second, and each question waits for this computer: a still window is longer, may be
    # silent for 80 ms, and a gap of that about the end of an overrun hides 0.05 mm of it.
    b.station["capture"]["window"] = "0.4 s"
    b.station["capture"]["minimum_samples"] = 10
    b.station["cycle"]["dwell"] = "0.4 s"
    b.scenario["axis"]["acceleration_mm_per_s2"] = 60.0
    b.scenario["truth"]["window_s"] = 0.4
    b.begin_run()
    certificate = b.finish()
    expect(b.run()["step"] == 20, f"{b.run()}")
    missed = compare(b.truth(), certificate)
    expect_found(missed)


@sentence("AirSensorThatFallsSilentIsStaleAndComesBack")
def air_off(b):
    fails_and_comes_back(b, "air", "off", "The air temperature 'air/air temperature'")


@sentence("AirSensorThatSendsGarbageIsStaleAndComesBack")
def air_garbage(b):
    fails_and_comes_back(b, "air", "garbage", "The air temperature 'air/air temperature'")


@sentence("MaterialSensorThatSendsGarbageIsStaleAndComesBack")
def material_garbage(b):
    fails_and_comes_back(b, "material", "garbage", "The material temperature 'material/contact 1'")


@sentence("MaterialSensorThatFloodsIsStaleAndComesBack")
def material_flood(b):
    fails_and_comes_back(b, "material", "flood", "The material temperature 'material/contact 1'")


@sentence("AirSensorThatFloodsDisturbsNothing")
def air_flood(b):
    b.begin_run()
    b.sim("sensor air flood")
    b.finish()
    expect(b.run()["step"] == 20, f"{b.run()}")
    laser_was_undisturbed(b)
    frames = b.instrument("air")["frames"]
    expect(frames > 2000, f"only {frames} lines came: that was no flood")


def ends_with_datum_lost(b):
    bench.wait_until("the run is closed", lambda: not b.status()["run_open"], 30)
    b.axiscal("watch", code=6)
    run = b.run()
    expect(run["state"] == "incomplete" and run["fault"] == "datum_lost", f"{run}")
    expect(run["step"] < 20 and run["certificate"] == "", f"{run}")


@sentence("LostBeamIsToldAndEndsTheRunWhenItComesBack")
def beam_lost(b):
    b.begin_run(hold_after=3)
    b.wait_for_points(3)
    b.sim("beam off")
    b.sim("go")
    run = b.wait_for_refusal("beam_lost")
    axis = b.status()["axis"]
    expect(axis["position_mm"] is None, f"a lost beam shows no position: {axis}")
    expect(b.sim("status")["done"] == run["done"], "done stays")
    b.sim("beam on")
    ends_with_datum_lost(b)


@sentence("RestartedCounterEndsTheRun")
def counter_restart(b):
    b.begin_run(hold_after=3)
    b.wait_for_points(3)
    b.sim("restart-counter")
    ends_with_datum_lost(b)


@sentence("UnpluggedLaserIsToldComesBackAndEndsTheRun")
def laser_off(b):
    b.begin_run(hold_after=3)
    b.wait_for_points(3)
    b.sim("sensor laser off")
    bench.wait_until(
        "the laser is unavailable", lambda: b.instrument("laser")["state"] == "unavailable", 30
    )
    b.sim("sensor laser on")
    ends_with_datum_lost(b)
    bench.wait_until("the laser is back", b.channels_are_good, 30)


def laser_fails_among_sensors(b, behaviour):
    """Air and material are read on; the laser comes back by itself and a run can be armed."""
    b.start()
    b.sim(f"sensor laser {behaviour}")
    sensors = ("air", "material")
    before = {name: b.instrument(name)["samples"] for name in sensors}
    bench.wait_until(
        "the sensors go on",
        lambda: all(b.instrument(name)["samples"] >= before[name] + 6 for name in sensors),
        20,
    )
    for name in sensors:
        one = b.instrument(name)
        expect(one["state"] == "available" and one["restarts"] == 0, f"{one}")
    b.sim("sensor laser on")
    bench.wait_until("the laser is back", b.channels_are_good, 20)
    b.write_program()
    b.go_to_datum()
    b.arm()
    b.wait_for_points(2)


@sentence("LaserThatSendsGarbageDisturbsNoSensor")
def laser_garbage(b):
    laser_fails_among_sensors(b, "garbage")


@sentence("LaserThatFloodsDisturbsNoSensor")
def laser_flood(b):
    laser_fails_among_sensors(b, "flood")


@sentence("RecordsThatTheLaserSkippedAreCounted")
def skipped_records(b):
    b.start()
    before = b.instrument("laser")
    b.sim("skip 7")
    bench.wait_until("a gap is counted", lambda: b.instrument("laser")["gaps"] == 1, 10)
    laser = b.instrument("laser")
    expect(laser["lost_records"] == 7 and laser["restarts"] == before["restarts"], f"{laser}")


@sentence("LaserThatChangesToSixteenFieldsIsReadOn")
def sixteen_fields(b):
    b.begin_run(hold_after=3)
    b.wait_for_points(3)
    b.sim("fields 16")
    b.sim("hold 8")
    b.wait_for_points(8)
    b.sim("fields 8")
    b.sim("go")
    b.finish()
    laser_was_undisturbed(b)
    expect(b.instrument("laser")["bad_frames"] == 0, f"{b.instrument('laser')}")


if __name__ == "__main__":
    bench.main()
