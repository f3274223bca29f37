#!/usr/bin/env python3
"""A library that belongs to one program is loaded by no other, directly or through another library.

one_program_loads.py RULE SOURCE_DIR BUILD_DIR  every built program, and the licences that the rule wants
one_program_loads.py RULE --self-test           proves that a planted link is seen
RULE is `drawing` (Cairo and Pango live in the short-lived report process), `gpl` (libsmbclient is under the GPL), `tls`
(OpenSSL is loaded by stations that name a certificate, and by no program when it begins) or `web` (libcurl and the bytes of
foreign servers live in the short-lived sender of the webhook).
"""
import dataclasses
import pathlib
import re
import subprocess
import sys
import tempfile

HELD = "axiscald"  # the program that every rule is about
PLAIN = "libc.so.6 => /lib/libc.so.6\n"


@dataclasses.dataclass(frozen=True)
class Rule:
    must: str            # the one program that loads it: else the guard would see nothing
    others: tuple        # may load it, too: its own tests
    library: re.Pattern  # how ldd names it
    why: str
    planted: tuple       # lines of ldd that must each be seen; the first is that of `must`
    fine: str            # what is said when all is well
    licences: tuple = () # files with words that stand in them


RULES = {
    "drawing": Rule(
        must="axiscal-report", others=("report_tests",), library=re.compile(r"libcairo|libpango"),
        why="drawing belongs to axiscal-report, a process of its own",
        planted=("libcairo.so.2 => /lib/libcairo.so.2\n", "libpango-1.0.so.0 => /lib/libpango-1.0.so.0\n"),
        fine="one program draws"),
    "gpl": Rule(
        must="axiscal-publish", others=("smb_tests",), library=re.compile(r"libsmbclient|/samba/"),
        why="it would be under the GPL",
        planted=("libsmbclient.so.0 => /usr/lib/libsmbclient.so.0\n",
                 "libtalloc-report.so => /usr/lib/x86_64-linux-gnu/samba/libtalloc-report.so\n"),
        fine="the GPL stays where it is",
        licences=(("LICENSE", "Apache License"), ("LICENSES/GPL-3.0-or-later.txt", "GNU GENERAL PUBLIC LICENSE"))),
    "tls": Rule(
        must="axiscald-tls.so", others=("tls_tests", "axiscal-notify"),  # libcurl loads libssh2, and that libcrypto
        library=re.compile(r"libssl|libcrypto"),
        why="OpenSSL belongs to axiscald-tls.so, which is loaded where a certificate is named",
        planted=("libssl.so.3 => /lib/libssl.so.3\n", "libcrypto.so.3 => /lib/libcrypto.so.3\n"),
        fine="OpenSSL waits until a certificate is named"),
    "web": Rule(
        must="axiscal-notify", others=(), library=re.compile(r"libcurl"),
        why="TLS belongs to axiscal-notify, a process of its own",
        planted=("libcurl-gnutls.so.4 => /usr/lib/x86_64-linux-gnu/libcurl-gnutls.so.4\n",
                 "libcurl.so.4 => /usr/lib/x86_64-linux-gnu/libcurl.so.4\n"),
        fine="one program speaks to the web"),
}


def complaints(rule, loads):
    """loads: program -> what ldd says of it."""
    found = [f"{name} loads {rule.library.search(said).group()}: {rule.why}"
             for name, said in sorted(loads.items()) if name not in (rule.must, *rule.others) and rule.library.search(said)]
    if not rule.library.search(loads.get(rule.must, "")):
        found.append(f"{rule.must} does not load {rule.library.pattern}: this guard would see nothing")
    if "libc.so" not in loads.get(HELD, ""):
        found.append(f"{HELD} is not there, or ldd tells nothing of it: build it first")
    return found


def licence_complaints(rule, source):
    for name, words in rule.licences:
        file = source / name
        if not file.is_file() or words not in file.read_text(encoding="utf-8"):
            yield f"{name} is missing or is not that licence"


def is_program(file):
    with file.open("rb") as beginning:
        return beginning.read(4) == b"\x7fELF"


def loads_of(folder):
    loads = {}
    for file in folder.iterdir():
        if file.is_file() and is_program(file):
            loads[file.name] = subprocess.run(["ldd", file], capture_output=True, text=True, check=False).stdout
    return loads


def self_test(rule):
    own = PLAIN + rule.planted[0]
    cases = [({rule.must: own, HELD: PLAIN}, 0), ({rule.must: own, HELD: PLAIN, **dict.fromkeys(rule.others, own)}, 0),
             ({rule.must: PLAIN, HELD: PLAIN}, 1), ({rule.must: own}, 1),
             ({rule.must: own, HELD: "not a dynamic executable"}, 1), ({}, 2)]
    for line in rule.planted:
        cases += [({rule.must: own, HELD: PLAIN + line}, 1), ({rule.must: own, HELD: PLAIN, "axiscal": PLAIN + line}, 1)]
    found = [f"{loads}: {complaints(rule, loads)}" for loads, wanted in cases if len(complaints(rule, loads)) != wanted]
    with tempfile.TemporaryDirectory() as empty:
        told = list(licence_complaints(rule, pathlib.Path(empty)))
    return found + ([f"an empty folder: {told}"] if len(told) != len(rule.licences) else [])


def main():
    rule = RULES[sys.argv[1]]
    if sys.argv[2] == "--self-test":
        found = self_test(rule)
    else:
        build = pathlib.Path(sys.argv[3])
        loads = loads_of(build / "bin") | loads_of(build / "lib/axiscal")
        found = complaints(rule, loads) + list(licence_complaints(rule, pathlib.Path(sys.argv[2])))
        print(f"{len(loads)} programs looked at")
    print("\n".join(found) or rule.fine)
    return 1 if found else 0


sys.exit(main())
