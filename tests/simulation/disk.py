"""The disk fails in mid-run: nothing is acknowledged, the CNC holds, the message says what to do, and the
run goes on by itself once the disk is mended."""

import contextlib
import ctypes
import errno
import json
import os
import subprocess
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "support"))
import as_root
import bench
from bench import expect, sentence
from steps import DATA, NAME, SYNC, Steps

BEFORE = 5  # points
NEW_MOUNTS, NEW_USER = 0x00020000, 0x10000000  # of unshare(2)


def begin(b):
    b.station["capture"]["timeout"] = "20 s"  # the CNC holds that long
    b.begin_run()
    b.wait_for_points(BEFORE)


# What is wrong, and what to do about it.
FULL = ("is full (", " MB are free): free some 100 MB there; runs under published have been copied to the share and may go.")
READ_ONLY = ("cannot be written: mount its disk for writing, and let it belong to the user of axiscald.",)
BROKEN = ("reports an error of its own (see dmesg): copy the runs to another one.",)


def held(b, words):
    """The station names the fault and what to do; the CNC sees no new `done`."""
    run = b.wait_for_refusal("not_durable")
    for part in words:
        expect(part in run["sentence"], f"not a word of {part!r}: {run['sentence']}")
    expect(run["state"] == "stopped", f"{run}")
    done = b.sim("status")["done"]
    expect(done == run["done"], f"the CNC sees {done} done, the run {run['done']}")
    return done


def goes_on(b, done):
    """Every point once; the file is whole; the certificate tells of it."""
    certificate = b.finish()
    run = b.run()
    expect(run["step"] == run["steps"] == 20 > done, f"{run}")
    told = json.loads(b.axiscal("verify", b.folder / "state/runs" / f"{run['id']}.axiscal", "--json"))
    expect(told["rows"]["point"] == 20 and told["complete"], f"{told}")
    remarks = " ".join(certificate["run"]["remarks"])
    print(remarks)
    expect("The disk took no records for" in remarks, remarks)


def fails(b, error, kinds, words):
    steps = Steps(b)
    begin(b)
    steps.fail(error, kinds)
    done = held(b, words)
    failed = steps["failed"]
    bench.wait_until("three more attempts", lambda: steps["failed"] >= failed + 3, 20)
    expect(b.sim("status")["done"] == done, "acknowledged without a disk")
    steps.fail(0, 0)
    goes_on(b, done)
    print(f"{steps['failed']} steps failed with {errno.errorcode[error]}")


@sentence("FullDiskHoldsTheCncAndTheRunGoesOn")
def full(b):
    fails(b, errno.ENOSPC, DATA | NAME, FULL)


@sentence("ReadOnlyDiskHoldsTheCncAndTheRunGoesOn")
def read_only(b):
    fails(b, errno.EROFS, DATA | NAME, READ_ONLY)


@sentence("DiskThatCannotSyncHoldsTheCncAndTheRunGoesOn")
def broken_sync(b):
    fails(b, errno.EIO, SYNC, BROKEN)


def own_mounts():
    """From here on what this test mounts is seen by it and its programs alone, and ends with them."""
    user, group = os.geteuid(), os.getegid()
    if ctypes.CDLL(None).unshare(NEW_MOUNTS | (NEW_USER if user != 0 else 0)) != 0:
        return False
    if user != 0:
        for name, line in (("setgroups", "deny"), ("uid_map", f"0 {user} 1"), ("gid_map", f"0 {group} 1")):
            with open(f"/proc/self/{name}", "w") as file:
                file.write(line)
    subprocess.run(["mount", "--make-rprivate", "/"], check=True)
    return True


def can_mount():
    """Tried by a child: nobody leaves a namespace again."""
    child = os.fork()
    if child == 0:
        status = 1
        with contextlib.suppress(Exception):
            if own_mounts():
                status = subprocess.run(["mount", "-t", "tmpfs", "axiscal-test", "/mnt"], check=False).returncode
        os._exit(status)
    return os.waitpid(child, 0)[1] == 0


def require_mounts():
    """A user namespace, root, or the same script as root; where none can be had the test ends here."""
    # A user namespace is for a process without threads, and the bench starts one.
    if os.geteuid() != 0 and can_mount() and own_mounts():
        return
    why = "not even root may mount here"
    try:
        as_root.require()
        if can_mount() and own_mounts():
            return
    except as_root.NoRoot as refusal:
        why = f"no user namespace, and {refusal}"
    print(f"no disk can be mounted: {why}")
    sys.exit(77 if "mount" in os.environ.get("AXISCAL_MAY_SKIP", "").split(",") else "or AXISCAL_MAY_SKIP=mount")


@sentence("RealDiskFilledToTheLastByteHoldsTheCncAndTheRunGoesOn")
def really_full(b):
    state = b.folder / "state"
    state.mkdir()
    subprocess.run(["mount", "-t", "tmpfs", "-o", "size=3m", "axiscal-test", state], check=True)
    try:
        begin(b)
        ballast = state / "ballast"
        with open(ballast, "wb", buffering=0) as file:
            for size in (65536, 4096):
                try:
                    while True:
                        file.write(bytes(size))
                except OSError as full_now:
                    expect(full_now.errno == errno.ENOSPC, f"{full_now}")
        done = held(b, FULL)
        ballast.unlink()
        goes_on(b, done)
    finally:
        for process in b.processes.values():
            process.kill()
            process.wait()
        subprocess.run(["umount", "-l", state], check=True)


if __name__ == "__main__":
    if sys.argv[1].startswith("RealDisk"):
        require_mounts()
    bench.main()
