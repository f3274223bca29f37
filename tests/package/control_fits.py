#!/usr/bin/env python3
"""tools/package.d/debian says of version and libraries what CMakeLists.txt and tools/install-dependencies say.

control_fits.py SOURCE_DIR VERSION
"""
import pathlib
import re
import sys

NOT_ASKED = {"g++", "git", "ca-certificates", "libgtest-dev", "libgmock-dev"}  # build-essential has the first; the others build no package
OF_PACKAGING = {"debhelper-compat", "dh-sequence-installsysusers"}


def as_listed(word):
    """Of "a | b (>= 1)" both names and the version; of one name alone no version, which tools/install-dependencies does not state."""
    ways = [re.match(r"([a-z0-9.+-]+)(?::any)?(?: \((>= [^)]+)\))?", way.strip()).groups("") for way in word.split("|")]
    return ways[0][0] if len(ways) == 1 else " | ".join(" ".join(filter(None, way)) for way in ways)


def main():
    source, version = pathlib.Path(sys.argv[1]), sys.argv[2]
    folder = source / "tools/package.d/debian"
    named = re.match(r"axiscal \(([^)]+)\)", (folder / "changelog").read_text()).group(1)
    complaints = [] if named == version else [f"debian/changelog says {named}, CMakeLists.txt {version}"]
    words = re.search(r"^build=\(([^)]*)\)", (source / "tools/install-dependencies").read_text(), re.M).group(1).split()
    listed = {" | ".join(way.replace("=", " >= ") for way in word.strip('"').split("|")) for word in words}
    field = re.search(r"^Build-Depends:(.*?)^\S*$", (folder / "control").read_text(), re.M | re.S).group(1)
    asked = {as_listed(word) for word in field.split(",") if word.strip()}
    wanted, given = listed - NOT_ASKED, asked - OF_PACKAGING
    complaints += [f"tools/install-dependencies has {name}, Build-Depends lacks it" for name in sorted(wanted - given)]
    complaints += [f"Build-Depends has {name}, tools/install-dependencies lacks it" for name in sorted(given - wanted)]
    print("\n".join(complaints) or f"version {version} and {len(wanted)} packages agree")
    return 1 if complaints else 0


sys.exit(main())
