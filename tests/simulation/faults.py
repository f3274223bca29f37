"""What goes wrong with requests is recognised, named and never acknowledged."""

import json

import bench
from bench import expect, sentence

OUTSIDE_WINDOW, WRONG_TARGET, WRONG_DIRECTION, OUT_OF_ORDER = 3, 9, 10, 11  # RESULT


def refused_is(b, fault, words, result, sequence, done):
    """The third request was refused with this fault; the CNC was told the same."""
    run = b.wait_for_refusal(fault)
    expect(words in run["sentence"], f"'{words}' is not said: {run['sentence']}")
    expect(run["done"] == done and run["step"] == done, f"done moved: {run}")
    seen = bench.wait_until(
        "the CNC has read the refusal",
        lambda: (s := b.sim("status"))["fault_sequence"] == sequence and s,
        10,
    )
    expect(seen["result"] == result and seen["done"] == done, f"the CNC has read {seen}")


def finishes_with_each_point_once(b):
    certificate = b.finish()
    run = b.run()
    expect(run["state"] == "complete" and run["step"] == run["steps"] == 20, f"{run}")
    rows = certificate["run"]["deviations"]
    expect([len(row) for row in rows["forward"] + rows["backward"]] == [2] * 10, f"{rows}")
    return certificate


@sentence("DoubledRequestsAreTakenOnce")
def doubled(b):
    b.inject("doubled", 3)
    b.inject("doubled", 20)
    b.begin_run()
    finishes_with_each_point_once(b)


@sentence("DoubledCoilIsTakenOnce")
def doubled_coil(b):
    b.trigger("coil-and-index", "tcp")
    b.inject("doubled", 3)
    b.begin_run()
    finishes_with_each_point_once(b)


@sentence("RequestThatComesLateFromAnotherPlaceIsNamed")
def late(b):
    """The CNC did not wait: when request 3 arrives, the axis stands at the next target."""
    b.inject("late", 3, late_s=1.0)
    b.begin_run()

    def told():
        notes = [n for n in b.status()["notes"] if "Request 3 is refused" in n]
        return notes and notes[-1]

    note = bench.wait_until("request 3 is refused", told, 30)
    expect("it stands at the target at" in note, note)
    expect(b.run()["done"] == 2 and b.sim("status")["done"] == 2, f"done moved: {b.run()}")


@sentence("FinishedRequestThatComesLateIsNamedAndTheRunGoesOn")
def late_and_finished(b):
    b.begin_run()
    b.wait_for_points(4)
    b.foreign_request(2)

    def told():
        events = [e for e in b.status()["notes"] if "came late" in e]
        return events and events[-1]

    note = bench.wait_until("the late request is named", told, 10)
    expect("Request 2 came late: it was finished before" in note, note)
    certificate = finishes_with_each_point_once(b)
    kinds = [e["fault"] for e in certificate["run"]["events"] if "fault" in e]
    expect("out_of_order" in kinds, f"the events: {kinds}")


@sentence("MissedRequestIsNamed")
def missed(b):
    b.inject("missed", 3)
    b.begin_run()
    refused_is(b, "out_of_order", "request 3 was missed", OUT_OF_ORDER, 4, 2)


@sentence("RequestOutOfOrderIsNamed")
def out_of_order(b):
    b.inject("out-of-order", 3)
    b.begin_run()
    refused_is(b, "out_of_order", "Request 4 came", OUT_OF_ORDER, 4, 2)


@sentence("RequestForAnotherTargetIsNamed")
def wrong_target(b):
    b.inject("wrong-target", 3)
    b.begin_run()
    refused_is(b, "wrong_target", "The CNC claims target index 3", WRONG_TARGET, 3, 2)


@sentence("RequestFromAnotherDirectionIsNamed")
def wrong_direction(b):
    b.inject("wrong-direction", 3)
    b.begin_run()
    refused_is(
        b, "wrong_direction", "The CNC claims the negative direction", WRONG_DIRECTION, 3, 2
    )


@sentence("RefusedSingleRegisterHoldsTheCncUntilItsTimeOut")
def single_register_holds(b):
    b.trigger("single-register", "tcp")
    b.inject("out-of-order", 3)
    b.inject("out-of-order", 4)  # the same point, approached again
    b.begin_run()
    run = b.wait_for_refusal("out_of_order")
    expect(run["done"] == 2, f"done moved: {run}")
    seen = bench.wait_until(
        "the CNC gives up", lambda: (s := b.sim("status"))["program"] == "failed" and s, 60
    )
    expect("no answer for request 3" in seen["message"], f"{seen}")
    expect(b.run()["done"] == seen["done"] == 2, f"done moved: {b.run()}")


@sentence("AWithheldPointIsApproachedAgainByTheProgram")
def approached_again(b):
    """One disturbed halt costs one approach, not the program."""
    b.inject("wrong-target", 3)
    b.begin_run()
    b.wait_for_refusal("wrong_target")
    bench.wait_until("point 3 is taken at the second approach", lambda: b.run()["done"] >= 4, 60)
    expect(b.run()["sentence"] == "", f"the refusal stands still: {b.run()}")


def first_targets_tell(b, motion_fault, words):
    """A set-up that is wrong is told in one sentence before the third point."""
    b.scenario["cnc"]["motion_fault"] = motion_fault
    b.begin_run()
    bench.wait_until("a fault is named", lambda: b.run()["fault"], 30)
    run = b.run()
    print(f"{motion_fault}: {run['fault']}: {run['sentence']}")
    expect(run["step"] <= 1, f"{run['step']} points were taken")
    expect(words in run["sentence"], f"'{words}' is not said: {run['sentence']}")


@sentence("OpticThatMovedIsNamedWithTheCertificate")
def moved_optic(b):
    """By 3 um, between two points of the first cycle: too little to be refused. The station names it, on the certificate
    and to whoever asks for the status."""
    b.begin_run(hold_after=8)
    b.wait_for_points(8)
    b.sim("move-optic 3")
    b.sim("go")
    found = finishes_with_each_point_once(b)["setup_findings"]
    expect([one["error"] for one in found] == ["moved_optic"], f"{found}")
    print(f"{found[0]['seen']}: {found[0]['value']} {found[0]['unit']}")
    expect(abs(found[0]["value"] - 3) < 0.5, f"{found}")
    said = " ".join(json.loads(b.axiscal("status", "--json"))["notes"])
    expect(found[0]["probably"] in said, f"'{found[0]['probably']}' is not in {said}")


@sentence("SwappedSignIsToldAtTheFirstTargets")
def swapped_sign(b):
    first_targets_tell(b, "swapped-sign", "the sign is turned")


@sentence("WrongAxisIsToldAtTheFirstTargets")
def wrong_axis(b):
    first_targets_tell(b, "wrong-axis", "another axis is measured")


@sentence("InchForMillimetreIsToldAtTheFirstTargets")
def inch(b):
    first_targets_tell(b, "inch", "a millimetre is taken for an inch")


@sentence("DiameterProgrammingIsToldAtTheFirstTargets")
def diameter(b):
    first_targets_tell(b, "diameter", "the axis is programmed in diameter")


@sentence("ShiftedDatumIsToldAtTheFirstTargets")
def shifted_datum(b):
    first_targets_tell(b, "shifted-datum", "the datum is shifted by 1")


if __name__ == "__main__":
    bench.main()
