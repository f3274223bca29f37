"""The packages once more, as those of the next version: the same programs, which call themselves so.

A program tells its version from one string of its own (config/version.hpp), of the same length in both.
"""

import re
import subprocess
from pathlib import Path

THIS, NEXT = "0.1.0", "0.1.1"


def rename_program(path):
    old = path.read_bytes()
    own = re.compile(rb"(?<![\w.])" + re.escape(THIS.encode()) + rb"\0")  # not SMBCLIENT_0.1.0, a symbol of libsmbclient
    found = len(own.findall(old))
    if found != 1:
        raise AssertionError(f"{path.name} holds its version {found} times, not once")
    path.write_bytes(own.sub(NEXT.encode() + b"\0", old))


def make(packages, scratch, to):
    """Of axiscal and axiscal-publish; gives back their paths."""
    made = []
    for name in ("axiscal", "axiscal-publish"):
        tree = Path(scratch) / f"next-{name}"
        subprocess.run(["dpkg-deb", "-R", next(Path(packages).glob(f"{name}_*.deb")), tree], check=True)
        control = tree / "DEBIAN/control"
        control.write_text(control.read_text().replace(THIS, NEXT))
        for program in (tree / "usr/bin").iterdir():
            rename_program(program)
        sums = tree / "DEBIAN/md5sums"
        lines = [line.split("  ", 1)[1] for line in sums.read_text().splitlines()]
        done = subprocess.run(["md5sum", "--", *lines], cwd=tree, capture_output=True, text=True, check=True)
        sums.write_text(done.stdout)
        package = Path(to) / f"{name}_{NEXT}_amd64.deb"
        subprocess.run(["dpkg-deb", "--root-owner-group", "-Zxz", "-z1", "-b", tree, package], check=True, capture_output=True)
        made.append(package)
    return made
