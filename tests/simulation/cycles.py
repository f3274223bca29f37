"""The kinds of cycle beside the standard one, from program to certificate."""

import bench
from bench import expect, sentence


@sentence("StepCycleOnAGivenListCarriesARun")
def step_cycle(b):
    targets = [31.2, 113.7, 188.1, 271.9, 353.4]
    for key in ("interval", "target_count", "first_target", "seed"):
        del b.station["cycle"][key]
    b.station["cycle"].update(kind="step", targets=[f"{x} mm" for x in targets])
    b.begin_run()
    certificate = b.finish()
    expect(b.run()["step"] == 20, f"{b.run()}")
    shown = [one["target"] for one in certificate["positions"]]
    expect(shown == targets, f"{shown}")
    expect("Step cycle" in " ".join(certificate["run"]["remarks"]), "the remark")


@sentence("SingleApproachGivesTheReducedList")
def single_approach(b):
    b.station["cycle"]["approaches"] = 1
    b.begin_run()
    certificate = b.finish()
    expect(b.run()["step"] == 10, f"{b.run()}")
    given, refused = certificate["parameters"], certificate["not_evaluated"]
    # Without a spread there is neither repeatability nor accuracy (ISO 230-2, one approach).
    for name in ("E", "M", "B", "B_mean"):
        expect(name in given, f"{name} is missing: {given}")
    for name in ("A", "R", "A_forward", "R_backward"):
        expect(name not in given and name in refused, f"{name}: {given} {refused}")


@sentence("OneWayRunEvaluatesNoReversal")
def one_way(b):
    b.station["cycle"].update(bidirectional=False, approaches=3)
    b.begin_run()
    certificate = b.finish()
    expect(b.run()["step"] == 15, f"{b.run()}")
    given, refused = certificate["parameters"], certificate["not_evaluated"]
    expect("A_forward" in given and "E_forward" in given, f"{given}")
    for name in ("B", "B_mean", "M", "E_backward"):
        expect(name not in given and name in refused, f"{name}: {given} {refused}")


if __name__ == "__main__":
    bench.main()
