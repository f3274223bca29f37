#!/usr/bin/env python3
"""The arrows of docs/architecture.md (table "Rooms"), held against every #include and every link of the product; and the
headers that only their makers may include, held against the tests, too.

arrows.py SOURCE_DIR               checks the tree
arrows.py --self-test SOURCE_DIR   proves that planted backward includes and links are seen
"""
import pathlib
import re
import sys

FOLDERS = ("analysis", "config", "drivers", "acquisition", "tools")
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.M)
QUOTED = re.compile(r"`([^`]+)`")
# How CMake names the libraries of the table.
LINKED_AS = {"PkgConfig::pangocairo": "cairo", "PkgConfig::modbus": "modbus", "PkgConfig::libusb": "libusb", "PkgConfig::hidapi": "hidapi",
             "PkgConfig::tomlplusplus": "toml++", "PkgConfig::zstd": "zstd", "PkgConfig::nettle": "nettle", "SQLite::SQLite3": "sqlite3",
             "PkgConfig::smbclient": "libsmbclient", "PkgConfig::tevent": "tevent", "PkgConfig::libarchive": "archive", "PkgConfig::pugixml": "pugixml", "PkgConfig::openssl": "openssl", "PkgConfig::libcurl": "curl",
             "Boost::headers": "boost/asio"}
# Links that carry no arrow: compiler options, and libraries that stand in no row.
FREE = {"axiscal_options", "Threads::Threads", "CLI11::CLI11", "spdlog::spdlog", "nlohmann_json::nlohmann_json", "PkgConfig::systemd"}
# header -> who may include it, whatever the room. Of RunAt20C: the compensation and declare_at_20C.
MAKERS = {"analysis/compensation/run_at_20C_maker.hpp": {"analysis/compensation/thermal_compensation.cpp", "analysis/positioning/deviation_table.cpp"}}


def maker_complaints(path, text):
    for included in INCLUDE.findall(text):
        for header, makers in MAKERS.items():
            if included.rsplit("/", 1)[-1] == header.rsplit("/", 1)[-1] and path not in makers:
                yield f"{path}: only {' and '.join(sorted(makers))} may include {header}"


class Table:
    """may: room -> rooms and headers it may include; target_room; holder: header -> the target that holds it; at_home: library -> rooms."""

    def __init__(self, page):
        self.may, self.target_room, self.holder, self.at_home = {}, {}, {}, {}
        for line in page.split("## Rooms", 1)[-1].split("\n## ", 1)[0].splitlines():
            cells = line.strip("|").split(" | ")
            if line.startswith("| `") and len(cells) >= 4:
                self.add(cells)

    def add(self, cells):
        room = QUOTED.search(cells[0]).group(1)
        self.may[room] = {word for word in QUOTED.findall(cells[3]) if not word.startswith("tests/")}
        for library in QUOTED.findall(cells[4] if len(cells) > 4 else ""):
            self.at_home.setdefault(library, set()).add(room)
        if cells[1].startswith("part of"):
            return
        for target, header in re.findall(r"`([\w-]+)`(?: \(`([^`]+)`)?", cells[1]):
            self.target_room[target] = room
            if header:
                self.holder[header] = target

    def room_of(self, path):
        """The longest room that holds this path, or None."""
        rooms = [room for room in self.may if path == room or path.startswith(room + "/")]
        return max(rooms, key=len) if rooms else None

    def include_complaints(self, path, text):
        room = self.room_of(path)
        for included in INCLUDE.findall(text):
            target = self.room_of(included)
            if room and target and target != room and target not in self.may[room] and included not in self.may[room]:
                yield f"{path}: {room} may not include {included}"
            for library, rooms in self.at_home.items():
                if included.startswith(library) and room and room not in rooms:
                    yield f"{path}: <{included}> is at home in {', '.join(sorted(rooms))} only"

    def link_complaints(self, path, target, link):
        room = self.target_room.get(target)
        if room is None:
            yield f"{path}: {target} has no room: name it in the table of docs/architecture.md"
        elif link in self.target_room:
            held = [header for header, holder in self.holder.items() if holder == link and header in self.may[room]]
            if self.target_room[link] not in self.may[room] | {room} and not held:
                yield f"{path}: {target} ({room}) may not link {link} ({self.target_room[link]})"
        elif link in LINKED_AS:
            if room not in self.at_home.get(LINKED_AS[link], {room}):
                yield f"{path}: {target} ({room}) may not link {link}"
        elif link not in FREE:
            yield f"{path}: {target} links {link}, of which neither docs/architecture.md nor this guard knows the room"


def links_of(text):
    """(target, link) of every link command of one CMakeLists; axiscal_room makes a target of its folder."""
    text = re.sub(r"#[^\n]*", "", text)
    for command, inside in re.findall(r"\b(target_link_libraries|axiscal_room)\s*\(([^()]*)\)", text):
        words = inside.split()
        target = ("axiscal_" if command == "axiscal_room" else "") + words[0]
        if target == "axiscal_${name}":
            continue  # the body of axiscal_room
        for word in words[1:]:
            if word not in ("PUBLIC", "PRIVATE", "INTERFACE"):
                yield target, word


def cmake_complaints(table, files):
    """files: path -> text of the product's CMakeLists."""
    linking = set()
    for path, text in files.items():
        for target, link in links_of(text):
            linking.add(target)
            if target != "axiscal_options":
                yield from table.link_complaints(path, target, link)
    for target in sorted(set(table.target_room) - linking):
        yield f"docs/architecture.md: no CMakeLists links anything to {target}"


def include_self_test(table):
    planted = {
        "analysis/x.cpp": '#include "drivers/sample.hpp"\n', "drivers/x.cpp": '#include "acquisition/run/run_machine.hpp"\n',
        "analysis/quantity/x.hpp": '#include "analysis/record/run_record.hpp"\n', "tools/axiscal-simulate/x.cpp": '#include "drivers/sample.hpp"\n',
        "acquisition/run/x.cpp": "#include <sqlite3.h>\n", "acquisition/publish/x.cpp": "#include <libsmbclient.h>\n",
        "acquisition/station/x.cpp": '#include "acquisition/publish/smb/smb_destination.hpp"\n', "config/x.cpp": '#include "analysis/positioning/positioning_certificate.hpp"\n',
        "acquisition/publish/y.cpp": "#include <cairo.h>\n", "acquisition/console/x.cpp": "#include <openssl/ssl.h>\n",
        "acquisition/tls/x.cpp": '#include "acquisition/tls/module/carried_client.hpp"\n',
        "acquisition/tls/module/x.cpp": '#include "config/station_config.hpp"\n', "acquisition/publish/smb/x.cpp": "#include <pango/pangocairo.h>\n",
        "acquisition/publish/z.cpp": '#include "acquisition/documents/pdf/page.hpp"\n', "drivers/y.cpp": '#include "analysis/circular/circular_run.hpp"\n',
        "drivers/framing/x.cpp": '#include "drivers/sample.hpp"\n', "acquisition/journal/x.cpp": '#include "drivers/sample.hpp"\n',
        "acquisition/live/x.cpp": '#include "acquisition/measurement/measurement.hpp"\n',
        "acquisition/measurement/drift/x.cpp": '#include "acquisition/station/station.hpp"\n',
        "acquisition/run/y.cpp": '#include "acquisition/measurement/circular/circle_order.hpp"\n',
    }
    fine = {"drivers/z.cpp": '#include "analysis/record/run_record.hpp"\n#include <modbus.h>\n', "acquisition/documents/pdf/x.cpp": "#include <cairo.h>\n"}
    missed = [path for path, text in planted.items() if not list(table.include_complaints(path, text))]
    return missed + [alarm for path, text in fine.items() for alarm in table.include_complaints(path, text)]


def link_self_test(table, files):
    """Plants a line in the real CMakeLists; each adds its own complaint to those of the tree."""
    planted = {
        "target_link_libraries(axiscal_drivers PRIVATE\n    axiscal_analysis)": 1, "target_link_libraries(axiscal_station PUBLIC axiscal_report)": 1,
        "axiscal_room(console axiscal_publish)": 1, "target_link_libraries(axiscald PRIVATE PkgConfig::pangocairo)": 1,
        "target_link_libraries(axiscal_publish PRIVATE PkgConfig::pangocairo)": 1, "target_link_libraries(axiscal_simulated axiscal_drivers)": 1,
        "target_link_libraries(axiscal_config PUBLIC axiscal_analysis)": 1, "target_link_libraries(axiscal_attic PUBLIC axiscal_quantity)": 1,
        "target_link_libraries(axiscal_journal PUBLIC axiscal_drivers)": 1, "target_link_libraries(axiscal_run PRIVATE ${whatever})": 1,
        "target_link_libraries(axiscald PRIVATE axiscal_smb)": 1, "target_link_libraries(axiscald PRIVATE PkgConfig::openssl)": 1, "target_link_libraries(axiscal_measurement PUBLIC axiscal_station)": 1,
        "target_link_libraries(axiscal_drivers PRIVATE axiscal_record) # axiscal_analysis": 0,
    }
    alone = len(list(cmake_complaints(table, files)))
    wrong = [line for line, more in planted.items()
             if len(list(cmake_complaints(table, files | {"planted": line}))) != alone + more]
    without = {path: text for path, text in files.items() if not path.startswith("drivers")}
    return wrong + ([] if len(list(cmake_complaints(table, without))) > alone else ["a target of the table without a CMakeLists"])


def maker_self_test(files):
    """files: path -> text. A planted include by anybody else is seen, the makers' own are there and are fine."""
    wrong = [path for path in ("analysis/x.cpp", "analysis/run_at_20C.hpp", "tools/axiscal/x.cpp", "tests/unit/analysis/x.cpp")
             if not list(maker_complaints(path, '#include "analysis/compensation/run_at_20C_maker.hpp"\n'))]
    wrong += [] if list(maker_complaints("analysis/x.cpp", '#include "run_at_20C_maker.hpp"\n')) else ["beside the header"]
    for header, makers in MAKERS.items():
        wrong += [f"{path} does not include {header}" for path in makers if header not in INCLUDE.findall(files[path])]
        wrong += [alarm for path in makers for alarm in maker_complaints(path, files[path])]
    return wrong


def main():
    root = pathlib.Path(sys.argv[-1])
    table = Table((root / "docs/architecture.md").read_text(encoding="utf-8"))
    lists = {file.relative_to(root).as_posix(): file.read_text(encoding="utf-8")
             for folder in FOLDERS for file in sorted((root / folder).rglob("CMakeLists.txt"))}
    if sys.argv[1] == "--self-test":
        texts = {path: (root / path).read_text(encoding="utf-8") for makers in MAKERS.values() for path in makers}
        wrong = include_self_test(table) + link_self_test(table, lists) + maker_self_test(texts)
        print("not as planted:", wrong)
        return 1 if wrong else 0
    found, seen = list(cmake_complaints(table, lists)), 0
    for folder in (*FOLDERS, "tests"):
        for file in sorted((root / folder).rglob("*.[ch]pp")):
            path, text = file.relative_to(root).as_posix(), file.read_text(encoding="utf-8")
            found += maker_complaints(path, text)
            if folder != "tests":
                seen += 1
                found += table.include_complaints(path, text)
    print("\n".join(found) or f"{seen} files and {len(table.target_room)} targets, every arrow points the right way")
    return 1 if found or seen < 20 or len(table.may) < 15 else 0


sys.exit(main())
