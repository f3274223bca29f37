"""The CNC ties the datum: `axiscal arm --datum-by-cnc`, then request 1 is prepare and the points count from 2."""

import contextlib
import math
import signal
import sqlite3

import bench
import truth
from bench import expect, sentence

REVERSAL_UM = -3.0  # an approach from above stops 3 um further than one from below
LINEAR_UM_PER_M = 40.0


def known_errors(b):
    """An axis whose error at each place is said in one line, without a scatter of its stops."""
    errors = b.scenario["errors"]
    del errors["periodic"]
    errors.update(
        linear_um_per_m=LINEAR_UM_PER_M, quadratic_um_per_m2=0.0, cubic_um_per_m3=0.0,
        reversal_um=REVERSAL_UM, reversal_slope_um_per_m=0.0, approach_noise_um=0.0,
    )


def arm_then_run(b, *words):
    """Armed while the axis stands anywhere; nobody is at the station when it reaches its datum."""
    b.start()
    b.write_program(*words)
    datum, start = b.plan["datum_mm"], b.scenario["axis"]["start_mm"]
    expect(datum > start + 1, f"the datum {datum} mm is to be reached from below, from {start} mm")
    b.arm("--datum-by-cnc")
    run = b.run()
    expect(run["done"] == 0 and run["step"] == 0, f"armed: {run}")
    b.sim(f"run {b.plan['file']}")


def rows(file, words):
    with contextlib.closing(sqlite3.connect(f"file:{file}?mode=ro", uri=True)) as base:
        return base.execute(words).fetchall()


def the_cnc_tied_the_datum(b):
    """One row, which names request 1 of the CNC (0 would be `arm`) and the plan's datum; all points are
    requests of the CNC from 2 on and stand on it."""
    file = b.run()["file"]
    datums = rows(file, "SELECT id, sequence, coordinate_m, n FROM datum")
    expect(len(datums) == 1, f"the datums: {datums}")
    name, sequence, coordinate_m, readings = datums[0]
    expect(sequence == 1, f"the datum was tied by request {sequence}")
    expect(abs(coordinate_m * 1e3 - b.plan["datum_mm"]) < 1e-6, f"{coordinate_m} m: {b.plan}")
    expect(readings > 1, f"{readings} readings in the window")
    points = rows(file, "SELECT step, sequence, origin, datum_id FROM point ORDER BY step")
    wanted = [(step, step + 2, "cnc", name) for step in range(b.plan["points"])]
    expect(points == wanted, f"the points: {points}")


def true_deviation_um(b, target_mm, backward):
    """At 20 degC, from the datum, which was reached from below: the laser reads 0 there."""
    way = LINEAR_UM_PER_M * 1e-3 * (target_mm - b.plan["datum_mm"])
    return way - REVERSAL_UM if backward else way


def allowed_um(b):
    """A point less the datum: two windows, each with its noise, and what resolution of the sensors, formulas
    and drift shift between them. z holds for all points at 99.9 % (Gaussian tail and union bound)."""
    datum, last = b.plan["datum_mm"], b.plan["targets_mm"][-1]
    z = math.sqrt(2 * math.log(b.plan["points"] / 0.001))
    along, _ = truth.systematic_um(b.scenario, last - datum, datum)
    return math.sqrt(2) * z * truth.sigma_um(b.scenario) + along


def every_point_is_right(b, certificate):
    """All of them, each against what the machine hides at its target."""
    bound, wrong, count = allowed_um(b), [], 0
    expect(bound < 0.5, f"{bound} um allow too much to tell anything")
    for way in ("forward", "backward"):
        given = certificate["run"]["deviations"][way]
        for target, row in zip(b.plan["targets_mm"], given, strict=True):
            true = true_deviation_um(b, target, way == "backward")
            expect(len(row) == b.plan["approaches"], f"{way} at {target} mm: {row}")
            for mm in row:
                count += 1
                if abs(mm * 1e3 - true) > bound:
                    wrong.append(f"{way} at {target} mm: {mm * 1e3:.3f} um, true {true:.3f} um")
    print(f"{count} points, {len(wrong)} wrong, {bound:.3f} um allowed")
    expect(count == b.plan["points"] and not wrong, "; ".join(wrong) or f"{count} points")


def finishes_right(b):
    certificate = b.finish()
    run = b.run()
    last = b.plan["points"] + 1
    expect(run["state"] == "complete" and run["step"] == run["steps"] == last - 1, f"{run}")
    expect(run["done"] == last, f"{run}")
    bench.wait_until("the part program has ended", lambda: b.sim("status")["program"] == "done", 30)
    the_cnc_tied_the_datum(b)
    every_point_is_right(b, certificate)


@sentence("CncTiesTheDatumWithItsPrepareAndEveryPointIsRight")
def tcp(b):
    known_errors(b)
    arm_then_run(b, "--datum-by-cnc")
    finishes_right(b)


@sentence("CncTiesTheDatumInItsOwnRegistersAndEveryPointIsRight")
def mirrored(b):
    known_errors(b)
    b.station["cycle"]["approaches"] = 1
    b.trigger("sequence-block", "tcp-mirrored")
    arm_then_run(b, "--datum-by-cnc")
    finishes_right(b)


@sentence("CncTiesTheDatumAndADaemonKilledBehindItGoesOn")
def killed(b):
    known_errors(b)
    b.station["cycle"]["approaches"] = 1
    b.start()
    b.write_program("--datum-by-cnc")
    b.arm("--datum-by-cnc")
    b.sim("hold 1")  # the CNC has its datum and does not move to the first target
    b.sim(f"run {b.plan['file']}")
    bench.wait_until("the datum is durable", lambda: b.run()["done"] == 1, 60)
    expect(b.end("axiscald", signal.SIGKILL) == -signal.SIGKILL, "the exit code of axiscald")
    b.start_daemon_again()
    expect(b.run()["done"] == 1, f"the prepare is published again: {b.run()}")
    b.sim("go")
    finishes_right(b)


@sentence("CncThatLeavesItsPrepareOutIsTold")
def left_out(b):
    arm_then_run(b)  # a program that waits for `axiscal arm` to tie the datum
    run = b.wait_for_refusal("no_run_armed")
    expect("No datum is tied yet: send prepare" in run["sentence"], run["sentence"])
    expect(run["done"] == 0 and run["step"] == 0, f"a point was taken: {run}")
    expect(not rows(run["file"], "SELECT id FROM datum"), "a datum was tied")


if __name__ == "__main__":
    bench.main()
