"""Each trigger shape on each of its wires carries a whole run."""

import bench
from bench import expect, sentence


def every_point_is_there(bench_, count=20):
    certificate = bench_.finish()
    run = bench_.run()
    expect(run["state"] == "complete" and run["step"] == count, f"the run: {run}")
    rows = certificate["run"]["deviations"]
    points = [x for way in ("forward", "backward") for row in rows[way] for x in row]
    expect(len(points) == count, f"{len(points)} points on the certificate")
    laser = bench_.instrument("laser")
    expect(laser["gaps"] == 0 and laser["bad_frames"] == 0, f"the laser: {laser}")


@sentence("SequenceBlockOverTcpCarriesARun")
def sequence_block_tcp(b):
    b.begin_run()
    every_point_is_there(b)


@sentence("SequenceBlockOverRtuCarriesARun")
def sequence_block_rtu(b):
    b.trigger("sequence-block", "rtu")
    b.begin_run()
    every_point_is_there(b)


@sentence("MirroredSequenceBlockCarriesARun")
def sequence_block_mirrored(b):
    b.trigger("sequence-block", "tcp-mirrored")
    b.begin_run()
    every_point_is_there(b)


@sentence("SequenceBlockWithTheLowWordFirstCarriesARun")
def sequence_block_low_word_first(b):
    b.station["trigger"]["low_word_first"] = True
    b.scenario["cnc"]["low_word_first"] = True
    b.begin_run()
    every_point_is_there(b)


@sentence("AMixUpOfTheWordOrderGivesNoPoint")
def word_order_mixed_up(b):
    # The first targets lie beyond 6.5 mm: their counts need both words.
    b.scenario["cnc"]["low_word_first"] = True
    b.begin_run()
    run = b.wait_for_refusal("wrong_target")
    expect(run["step"] == 0 and run["done"] == 0, f"a point was taken: {run}")


@sentence("SingleRegisterCarriesARun")
def single_register(b):
    b.trigger("single-register", "tcp")
    b.begin_run()
    every_point_is_there(b)


@sentence("SingleRegisterOverRtuCarriesARun")
def single_register_rtu(b):
    b.trigger("single-register", "rtu")
    b.begin_run()
    every_point_is_there(b)


@sentence("CoilAndIndexCarriesARun")
def coil_and_index(b):
    b.trigger("coil-and-index", "tcp")
    b.begin_run()
    every_point_is_there(b)


@sentence("CoilAndIndexOverRtuCarriesARun")
def coil_and_index_rtu(b):
    b.trigger("coil-and-index", "rtu")
    b.begin_run()
    every_point_is_there(b)


@sentence("DwellWithTheMarlinProgramCarriesARun")
def dwell(b):
    b.trigger("dwell", "none")
    # The halt is seen after 0.4 s and captured within another window.
    b.station["trigger"].update(
        window="0.3 mm", stability_range="3 um", stability_period="0.15 s", hysteresis="0.2 mm",
        minimum_halt="0.3 s",
    )
    b.station["cycle"]["dwell"] = "0.9 s"
    b.write_station()
    b.write_program("--dialect", "marlin")
    # Nothing makes this program wait: the axis stands at its datum before it is started.
    b.scenario["axis"]["start_mm"] = b.plan["datum_mm"]
    b.start()
    b.arm()
    b.sim(f"run {b.plan['file']}")
    every_point_is_there(b)


if __name__ == "__main__":
    bench.main()
