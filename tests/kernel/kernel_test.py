#!/usr/bin/env python3
"""The host's side of the kernel tests: one boot, many checks.

kernel_test.py BOOT FOLDER PROGRAMS           boots, runs every check of boot_BOOT.py, keeps what it said in FOLDER
kernel_test.py BOOT FOLDER PROGRAMS SENTENCE  tells how that check went in the last boot
kernel_test.py shell FOLDER PROGRAMS COMMAND  boots and runs a shell line, by hand
kernel_test.py --self-test                    a boot that runs no check, or not every one, is found

FOLDER keeps output.txt, console.log and the logs of all programs. Exit 77 (skipped) only where a
program of the host is missing and AXISCAL_MAY_SKIP names kernel.
"""

import contextlib
import datetime
import os
import re
import shlex
import shutil
import sys
from pathlib import Path

import machine

sys.path.append(str(machine.HERE.parent / "support"))
from check_log import missing, never_run, outcome

SOURCE = machine.HERE.parent.parent
LIMIT_S = int(os.environ.get("AXISCAL_LIMIT_S", "200"))


def tell(share, status):
    """What the guest said; its console too where it did not reach its end."""
    said = share / "output.txt"
    print(said.read_text(errors="replace") if said.exists() else "the guest said nothing")
    if status is None:
        console = share / "console.log"
        print(f"the guest did not reach its end; the last of {console}:")
        print(console.read_text(errors="replace")[-4000:] if console.exists() else "(nothing)")


def run_boot(name, share, programs, command=None):
    shutil.rmtree(share, ignore_errors=True)
    share.mkdir(parents=True)
    inside = f"export AXISCAL_SOURCE={shlex.quote(str(SOURCE))} AXISCAL_PATH={shlex.quote(str(programs))}; "
    append, devices = "", ()
    if command is None:
        command = f"/usr/bin/python3 -B -u {shlex.quote(str(machine.HERE / f'boot_{name}.py'))}"
        if name == "service":
            import service_overlay
            append = service_overlay.lay(share, programs)
    try:
        with contextlib.ExitStack() as beside:
            if name == "power":
                import lossy_disk
                machine.require_programs("mkfs.ext4")
                # The long list cuts at other moments each day, the lane that gates a change at the same ones.
                day = datetime.date.today().isoformat() if os.environ.get("AXISCAL_ALL") else "1"
                seed = os.environ.get("AXISCAL_SEED", day)
                devices = beside.enter_context(lossy_disk.Server(share, machine.with_sbin(), seed)).words()
                inside += f"export AXISCAL_CUTS={300 if os.environ.get('AXISCAL_ALL') else 10}; "
            status = machine.boot(share, inside + command, LIMIT_S, append, devices, visible=(SOURCE, programs))
    except machine.CanNotRun as why:
        missing(str(why), "kernel")
    tell(share, status)
    print(f"all of it stays in {share}")
    return status


def sentences_of(name):
    return re.findall(r'^@check\("(.*)"\)$', (machine.HERE / f"boot_{name}.py").read_text(), re.MULTILINE)


def whole_boot(name, share, programs):
    """0 where the guest came to its end and ran every check. A check that failed is told by its own test."""
    if run_boot(name, share, programs) is None:
        return 1
    said = share / "output.txt"
    missing_checks = never_run(sentences_of(name), said.read_text(errors="replace") if said.exists() else "")
    for sentence in missing_checks:
        print(f"the guest never came to {sentence}")
    return 1 if missing_checks else 0


def self_test():
    sentences = ["First", "Second"]
    assert never_run(sentences, "") == sentences
    assert never_run(sentences, "python3: can't open file") == sentences
    assert never_run(sentences, "ok First\n  2.0 s\n") == ["Second"]
    assert never_run(sentences, "ok First\nFAILED Second: it broke\n") == []
    assert never_run(sentences, "ok FirstOfAll\nFAILED Second\n") == sentences
    for boot in sorted(machine.HERE.glob("boot_*.py")):
        assert sentences_of(boot.stem.removeprefix("boot_")), f"{boot} has no check"
    return 0


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    name, share, programs, *rest = sys.argv[1:]
    share = Path(share).resolve()
    if name == "shell":
        return run_boot(name, share, programs, rest[0])
    if rest:
        return outcome(share, rest[0], "kernel")
    return whole_boot(name, share, programs)


sys.exit(main())
