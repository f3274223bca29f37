#!/usr/bin/env python3
"""tools/package.d/debian says of version and libraries what CMakeLists.txt and tools/install-dependencies say.

control_fits.py SOURCE_DIR VERSION
"""
import pathlib
import re
import sys

NOT_ASKED = {"g++", "git", "ca-certificates", "libgtest-dev", "libgmock-dev"}  # build-essential has the first; the others build no package
OF_PACKAGING = {"debhelper-compat", "dh-sequence-installsysusers"}


def main():
    source, version = pathlib.Path(sys.argv[1]), sys.argv[2]
    folder = source / "tools/package.d/debian"
    named = re.match(r"axiscal \(([^)]+)\)", (folder / "changelog").read_text()).group(1)
    complaints = [] if named == version else [f"debian/changelog says {named}, CMakeLists.txt {version}"]
    listed = re.search(r"^build=\(([^)]*)\)", (source / "tools/install-dependencies").read_text(), re.M).group(1).split()
    field = re.search(r"^Build-Depends:(.*?)^\S*$", (folder / "control").read_text(), re.M | re.S).group(1)
    asked = {re.match(r"[a-z0-9.+-]+", word.strip()).group() for word in field.split(",") if word.strip()}
    wanted, given = set(listed) - NOT_ASKED, asked - OF_PACKAGING
    complaints += [f"tools/install-dependencies has {name}, Build-Depends lacks it" for name in sorted(wanted - given)]
    complaints += [f"Build-Depends has {name}, tools/install-dependencies lacks it" for name in sorted(given - wanted)]
    print("\n".join(complaints) or f"version {version} and {len(wanted)} packages agree")
    return 1 if complaints else 0


sys.exit(main())
