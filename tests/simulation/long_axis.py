"""An axis of more than 2000 mm: one pass over all of it, another over a stretch of 2000 mm."""

import json
from pathlib import Path

import bench
from bench import expect, sentence


def long_axis(b):
    b.scenario["axis"]["travel_high_mm"] = 2600.0
    b.station["axis"]["travel_high"] = "2500 mm"
    b.station["cycle"].update(interval="240 mm", first_target="80 mm", target_count=10)
    b.station["cycle"].pop("approaches")


def programs_of(b, *words):
    shown = b.axiscal(
        "program", "--json", "--config", b.folder / "station.toml", "--out", b.folder, *words
    )
    return json.loads(shown)["programs"]


@sentence("LongAxisGetsTwoProgramsAndTheStretchCanBeArmed")
def both_passes(b):
    long_axis(b)
    b.start()
    whole, stretch = programs_of(b)
    expect((whole["pass"], whole["approaches"]) == ("whole", 1), f"{whole}")
    expect((stretch["pass"], stretch["approaches"]) == ("stretch", 5), f"{stretch}")
    span = stretch["targets_mm"][-1] - stretch["targets_mm"][0]
    expect(1500 < span <= 2000, f"the stretch spans {span} mm")
    # ISO 230-2: five targets a metre at least on the stretch, like on a short axis.
    expect(len(stretch["targets_mm"]) >= 10, f"{len(stretch['targets_mm'])} targets")
    expect(all(Path(one["file"]).is_file() for one in (whole, stretch)), "both programs")

    b.plan = stretch
    b.go_to_datum()
    b.arm()
    run = b.run()
    expect(run["pass"] == "stretch" and run["steps"] == stretch["points"], f"{run}")
    b.axiscal("abort", "--reason", "seen enough")
    bench.wait_until("the run is closed", lambda: not b.status()["run_open"], 10)
    b.axiscal("watch", code=6)
    expect("seen enough" in b.run()["sentence"], f"{b.run()}")


@sentence("DeclinedStretchNeedsOnlyOneProgramAndIsPrinted")
def declined(b):
    long_axis(b)
    b.station["cycle"]["stretch_declined"] = "agreed with the customer"
    b.write_station()
    programs = programs_of(b)
    expect([one["pass"] for one in programs] == ["whole"], f"{programs}")
    shown = b.axiscal("check-config", b.folder / "station.toml")
    expect("agreed with the customer" in shown, shown)


if __name__ == "__main__":
    bench.main()
