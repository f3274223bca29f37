#!/usr/bin/env python3
"""The arrows of docs/architecture.md, held against every #include of the product.

arrows.py SOURCE_DIR        checks the tree
arrows.py --self-test       proves that a planted backward include is seen
"""
import pathlib
import re
import sys

# room -> rooms whose headers it may include (itself always). quantity <- config <- drivers <- acquisition -> analysis
MAY = {
    "analysis/quantity": set(),
    "analysis": {"analysis/quantity"},
    "config": {"analysis/quantity", "analysis/run_record.hpp", "analysis/circular/circular_setup.hpp"},
    "drivers": {"analysis/quantity", "analysis/run_record.hpp", "config"},
    "acquisition/capture": {"analysis/quantity", "analysis", "config", "drivers"},
    "acquisition/run": {"analysis/quantity", "analysis", "config", "drivers", "acquisition/capture"},
    "acquisition/program": {"analysis/quantity", "analysis", "config", "drivers/framing/checksum.hpp"},
    "acquisition/journal": {"analysis/quantity", "analysis", "drivers"},
    "acquisition/publish": {"analysis/quantity", "analysis", "config", "acquisition/journal"},
    "acquisition/publish/smb": {"analysis/quantity", "config", "acquisition/publish", "acquisition/journal"},
    "acquisition/station": {"analysis/quantity", "analysis", "config", "drivers", "acquisition/capture",
                            "acquisition/run", "acquisition/journal"},
    "acquisition/console": {"analysis/quantity", "analysis", "config", "acquisition/station",
                            "drivers/scheduler.hpp", "drivers/spawn.hpp"},
    "acquisition": {"analysis/quantity", "analysis", "config", "drivers", "acquisition/journal", "acquisition/station",
                    "acquisition/console"},
    "tools/axiscal-simulate": {"analysis/quantity"},
}
# Libraries that may be named only in one room.
ONLY = {
    "cairo": {"acquisition/publish"}, "pango": {"acquisition/publish"}, "sqlite3": {"acquisition/journal"}, "zstd": {"acquisition/journal"},
    "libsmbclient": {"acquisition/publish/smb"},  # GPL: docs/dependencies.md
    "toml++": {"config", "tools/axiscal-simulate"}, "modbus": {"drivers", "tools/axiscal-simulate"},
    "libusb": {"drivers"}, "hidapi": {"drivers"},
    "boost/asio": {"drivers", "acquisition/station", "acquisition/journal", "acquisition/console", "acquisition",
                   "acquisition/publish", "tools/axiscal-simulate", "tools/axiscal"},
}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.M)


def room_of(path):
    """The longest room that holds this path, or None."""
    rooms = [room for room in MAY if path == room or path.startswith(room + "/")]
    return max(rooms, key=len) if rooms else None


def complaints(path, text):
    room = room_of(path)
    for included in INCLUDE.findall(text):
        target = room_of(included)
        if room and target and target != room and target not in MAY[room] and included not in MAY[room]:
            yield f"{path}: {room} may not include {included}"
        for library, rooms in ONLY.items():
            if included.startswith(library) and room and room not in rooms:
                yield f"{path}: <{included}> is at home in {', '.join(sorted(rooms))} only"


def self_test():
    planted = {
        "analysis/x.cpp": '#include "drivers/sample.hpp"\n', "drivers/x.cpp": '#include "acquisition/run/run_machine.hpp"\n',
        "analysis/quantity/x.hpp": '#include "analysis/run_record.hpp"\n', "tools/axiscal-simulate/x.cpp": '#include "drivers/sample.hpp"\n',
        "acquisition/run/x.cpp": "#include <sqlite3.h>\n", "acquisition/publish/x.cpp": "#include <libsmbclient.h>\n",
        "acquisition/station/x.cpp": '#include "acquisition/publish/smb/smb_destination.hpp"\n', "config/x.cpp": '#include "analysis/certificate.hpp"\n',
    }
    missed = [path for path, text in planted.items() if not list(complaints(path, text))]
    fine = list(complaints("drivers/x.cpp", '#include "analysis/run_record.hpp"\n#include <modbus.h>\n'))
    print("missed:", missed, "false alarms:", fine)
    return 1 if missed or fine else 0


def main():
    if sys.argv[1] == "--self-test":
        return self_test()
    root, found, seen = pathlib.Path(sys.argv[1]), [], 0
    for folder in ("analysis", "config", "drivers", "acquisition", "tools"):
        for file in sorted((root / folder).rglob("*.[ch]pp")):
            seen += 1
            found += complaints(file.relative_to(root).as_posix(), file.read_text(encoding="utf-8"))
    print("\n".join(found) or f"{seen} files, every arrow points the right way")
    return 1 if found or seen < 20 else 0


sys.exit(main())
