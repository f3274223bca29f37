#!/usr/bin/python3
"""Rows of tools/bench: what axiscald takes of a processor while instruments on CAN and USB stream, on the kernel's own drivers.

wires.py PROGRAM-FOLDER

A guest with Debian's kernel and an emulated device behind each real driver (tests/kernel): at full speed where /dev/kvm works,
and only then held against the goal. Elsewhere the guest's processor is emulated and does 500 million instructions a second by
its clock: the instructions that axiscald takes are told, kernel calls included. Beside the bus candump, which only prints the frames.
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


def full_speed():
    """Is there a /dev/kvm that runs a guest? A virtual computer may have one that does not."""
    if not os.access("/dev/kvm", os.W_OK):
        return False
    with tempfile.TemporaryDirectory(prefix="axiscal-wires-") as folder:
        return machine.boot(Path(folder), "true", 30, accelerator=FULL_SPEED) == 0


def tell(row, fast):
    met = not fast or (row["percent"] <= row["goal"] and row["lost"] == 0)
    amount = "{:.2f} % of a CPU" if fast else "{:.1f} million instructions a second"
    taken = [row["percent"], *([row["candump"]] if row.get("candump") is not None else [])]
    words = [amount.format(one if fast else one / 100 * COUNTED_MIPS) for one in taken] + ["-"]
    seen = f"{row['load']:.0f} % of the bus" if "load" in row else f"{row['hz']:.0f} samples a second"
    goal = f"<= {row['goal']:g} %, 0 lost" + ("" if fast else " (not judged: emulated)")
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
