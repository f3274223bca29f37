"""The beam aligned before a run: the station finds the angle that the simulator hides."""

import json
import math
import os
import pty
import subprocess

import bench
from bench import expect, sentence

LEFT_MRAD = 2.5  # how the beam is left; the station is told readings, no angle
WAY_MM = 400.0


def jog(b, to_mm):
    """A part program without a station: the axis drives there and stays."""
    path = b.folder / f"jog-{to_mm:g}.ngc"
    path.write_text(f"G21 G90 G94\nG1 X{to_mm:g} F20000\nM2\n")
    b.sim(f"run {path}")
    bench.wait_until(
        "the axis is there", lambda: b.sim("status")["program"] != "running", bench.START_S
    )


def view(b):
    return json.loads(b.axiscal("align", "show", "--json"))


def rest_at_far_end(b):
    bench.wait_until(
        "the axis stands at its far end",
        lambda: view(b)["at_rest"] and view(b)["record"]["far"],
        bench.START_S,
    )


def steer(b, *angles):
    """Slowly enough that each angle is read in several blocks."""
    for angle in angles:
        b.sim(f"steer {angle}")
        before = view(b)["record"]["far"]["blocks"]
        bench.wait_until(
            "a rest was read at this angle",
            lambda seen=before: view(b)["record"]["far"]["blocks"] >= seen + 2,
            bench.START_S,
        )


@sentence("AlignFindsTheCosineErrorAndItStandsOnTheCertificate")
def aligned(b):
    b.start()
    jog(b, 0)
    b.axiscal("align", "begin")
    b.sim("steer 4")
    jog(b, WAY_MM)
    rest_at_far_end(b)
    steer(b, 0, -4, 0, LEFT_MRAD)
    shown = b.axiscal("align", "keep")
    expect("by the reading" in shown, shown)

    b.write_program()
    b.go_to_datum()
    b.arm()
    certificate = b.finish()
    kept = certificate["run"]["alignment"]
    found = kept["cosine_error"]
    truth_um = WAY_MM * 1e3 * (1 - math.cos(LEFT_MRAD * 1e-3))  # 1.25 um
    expect(kept["far_end"]["passed_maximum"], f"{kept}")
    # 0.1 um of noise a sample, a hundred in a block, the highest of a few dozen blocks: 0.04 um;
    # half a minute of drift, 1 um an hour: 0.01 um; the air's swing over 0.55 m: 0.01 um.
    expect(abs(found["error_um"] - truth_um) <= 0.1, f"{found}, truth {truth_um} um")
    expect(found["bound_um"] >= truth_um, f"{found}, truth {truth_um} um")
    expect(abs(kept["far_end"]["distance_mm"] - WAY_MM) < 1, f"{kept['far_end']}")
    run_file = b.run()["file"]
    expect(json.loads(b.axiscal("verify", run_file, "--json"))["findings"] == [], "chain")


@sentence("AlignOnATerminalEndsWithEnter")
def live(b):
    b.start()
    jog(b, 0)
    ours, theirs = pty.openpty()
    shown = subprocess.Popen(
        [b.program("axiscal"), "align", "--spot-offset", "0.8"],
        env={**os.environ, "AXISCAL_SOCKET": b.socket},
        stdin=theirs, stdout=theirs, stderr=theirs,
    )
    os.close(theirs)
    bench.wait_until("the beam is watched", lambda: view(b)["running"], bench.START_S)
    jog(b, WAY_MM)
    rest_at_far_end(b)
    os.write(ours, b"\n")
    text = b""
    try:
        while chunk := os.read(ours, 65536):
            text += chunk
    except OSError:  # a terminal ends so
        pass
    os.close(ours)
    expect(shown.wait(timeout=bench.START_S) == 0, text.decode(errors="replace"))
    words = text.decode(errors="replace")
    expect("Enter keeps this" in words and "Kept alignment" in words, words)
    kept = view(b)
    expect(not kept["running"] and kept["record"]["spot_offset_mm"] == 0.8, f"{kept}")
    # e^2 / (8 D) by hand: 0.64 mm2 / 3200 mm = 0.2 um
    expect(abs(kept["record"]["cosine_by_spot"]["bound_um"] - 0.2) < 1e-3, f"{kept['record']}")


if __name__ == "__main__":
    bench.main()
