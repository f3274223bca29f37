#!/usr/bin/env python3
"""libsmbclient is under the GPL: only axiscal-publish and its own tests may load it, directly or through another library.

one_gpl_program.py SOURCE_DIR BUILD_DIR | one_gpl_program.py --self-test
"""
import pathlib
import re
import subprocess
import sys

MAY = {"axiscal-publish", "smb_tests"}
MUST = "axiscal-publish"
LIBRARY = re.compile(r"libsmbclient|/samba/")


def complaints(loads):
    """loads: program -> what ldd says of it."""
    found = [f"{name} loads {LIBRARY.search(said).group()}: it would be under the GPL"
             for name, said in sorted(loads.items()) if name not in MAY and LIBRARY.search(said)]
    if not LIBRARY.search(loads.get(MUST, "")):
        found.append(f"{MUST} does not load libsmbclient: this guard would see nothing")
    return found


def licence_complaints(source):
    for name, words in (("LICENSE", "Apache License"), ("LICENSES/GPL-3.0-or-later.txt", "GNU GENERAL PUBLIC LICENSE")):
        file = source / name
        if not file.is_file() or words not in file.read_text(encoding="utf-8"):
            yield f"{name} is missing or is not that licence"


def loads_of(folder):
    loads = {}
    for file in folder.iterdir():
        if file.is_file() and file.read_bytes()[:4] == b"\x7fELF":
            loads[file.name] = subprocess.run(["ldd", file], capture_output=True, text=True, check=False).stdout
    return loads


def self_test():
    smb, plain = "libsmbclient.so.0 => /usr/lib/libsmbclient.so.0\n", "libc.so.6 => /lib/libc.so.6\n"
    cases = [({MUST: smb, "axiscald": plain}, 0), ({MUST: smb, "axiscald": smb}, 1), ({MUST: plain}, 1),
             ({MUST: smb, "axiscal": "libtalloc-report.so => /usr/lib/x86_64-linux-gnu/samba/libtalloc-report.so"}, 1), ({}, 1)]
    return [f"{loads}: {complaints(loads)}" for loads, wanted in cases if len(complaints(loads)) != wanted]


def main():
    if sys.argv[1] == "--self-test":
        found = self_test()
    else:
        loads = loads_of(pathlib.Path(sys.argv[2]) / "bin")
        found = complaints(loads) + list(licence_complaints(pathlib.Path(sys.argv[1])))
        print(f"{len(loads)} programs looked at")
    print("\n".join(found) or "the GPL stays where it is")
    return 1 if found else 0


sys.exit(main())
