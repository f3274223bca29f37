#!/usr/bin/python3
"""Rows of tools/bench: what axiscald takes of a processor while instruments on CAN and USB stream, on the kernel's own drivers.

wires.py PROGRAM-FOLDER

A guest with Debian's kernel and an emulated device behind each real driver (tests/kernel): at full speed where /dev/kvm works.
Elsewhere the guest's processor is emulated and does 500 million instructions a second by its clock; then the instructions that
axiscald takes are counted, kernel calls included, and held against the goal's share of a processor that does 2000 million of them
a second: 2 GHz at one instruction a cycle, which the small computers of a station reach and any newer one exceeds. A bound
of instructions does not depend on what else this computer does. No loss is borne in either case. Beside the bus candump, which
only prints the frames: those of the transducers that it saw are counted, for the daemon must have seen no fewer.
"""
import json
import os
import sys
import tempfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "tests/kernel"))
import machine  # noqa: E402

LIMIT_S = 400
FULL_SPEED = ("-accel", "kvm", "-cpu", "host", "-smp", "2")
COUNTED_MIPS = 500  # machine.COUNTED: 2 ns an instruction
STATION_MIPS = 2000


def full_speed():
    """Is there a /dev/kvm that runs a guest? A virtual computer may have one that does not."""
    if not os.access("/dev/kvm", os.W_OK):
        return False
    with tempfile.TemporaryDirectory(prefix="axiscal-wires-") as folder:
        return machine.boot(Path(folder), "true", 30, accelerator=FULL_SPEED) == 0


def tell(row, fast):
    """One line; True: the goal is met."""
    unit, scale = ("% of a CPU", 1) if fast else ("million instructions a second", COUNTED_MIPS / 100)
    bound = row["goal"] if fast else row["goal"] / 100 * STATION_MIPS
    unseen = max(0, row.get("candump_frames", 0) - row.get("frames", 0))
    met = row["percent"] * scale <= bound and row["lost"] == 0 and unseen == 0
    words = [f"{one * scale:.2f} {unit}" for one in (row["percent"], row.get("candump")) if one is not None] + ["-"]
    seen = f"{row['load']:.0f} % of the bus" if "load" in row else f"{row['hz']:.0f} samples a second"
    if "candump_frames" in row:
        seen += f", {row['frames']} frames of transducers (candump: {row['candump_frames']})"
    goal = f"<= {bound:g} {unit}, 0 lost"
    print(f"{row['row']} | {words[0]} | {words[1]} (candump) | {seen}, {row['lost']} lost | {goal}{'' if met else '  MISSED'}")
    return met


def measure(programs, share, fast):
    script = SOURCE / "tests/bench/wires_guest.py"
    status = machine.boot(share, f"export AXISCAL_SOURCE='{SOURCE}' AXISCAL_PATH='{programs}'; /usr/bin/python3 -B -u '{script}'",
                          LIMIT_S, accelerator=FULL_SPEED if fast else machine.COUNTED)
    said = (share / "output.txt").read_text(errors="replace") if (share / "output.txt").exists() else "nothing"
    rows = [json.loads(line) for line in said.splitlines() if line.startswith('{"row"')]
    if status != 0 or len(rows) < 3:
        print(f"the guest ended with {status}: {said[-3000:]}")
        return None
    return rows


def main():
    try:
        fast = full_speed()
        with tempfile.TemporaryDirectory(prefix="axiscal-wires-") as folder:
            rows = measure(Path(sys.argv[1]).resolve(), Path(folder), fast)
    except machine.CanNotRun as why:
        print(f"instruments on CAN and USB were not measured: {why}")
        return 0
    return 0 if rows and all([tell(row, fast) for row in rows]) else 1


if __name__ == "__main__":
    sys.exit(main())
