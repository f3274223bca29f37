#!/usr/bin/env python3
"""Every codec is searched for inputs that break it (tests/fuzz, tools/soak).

A codec is a header of drivers/ or acquisition/console/ whose opening comment calls it pure ("Pure"): bytes or text in,
values out. It must be included by a target of tests/fuzz, or stand below with the reason why not.
Orders of the JSON API (`..._from_json` of acquisition/console) must be called by one. Each target
has a line in CMakeLists.txt and inputs under corpus/, and each folder of inputs has its target.

fuzz_targets.py SOURCE_DIR     checks the sources
fuzz_targets.py --self-test    proves that planted mistakes are seen
"""
import pathlib
import re
import sys

# Pure, but no bytes of others go in.
NO_CODEC = {
    "acquisition/console/metrics_text.hpp": "writes alone; names of the station file go in, and station_file reads those",
    "acquisition/console/so_far_json.hpp": "writes alone; what goes in was computed here",
    "acquisition/console/stored_run_json.hpp": "writes alone; run_file and certificate_facts read what goes in",
    "drivers/appearance.hpp": "a table of what instruments show themselves as",
    "drivers/canopen/pdo_stream.hpp": "counts frames by their times; the frames are judged by canopen",
    "drivers/canopen/register_watch.hpp": "one object read; its frames are judged by canopen",
    "drivers/clock/lower_hull.hpp": "reached through device_clock",
    "drivers/clock/open_requests.hpp": "instants, no bytes",
    "drivers/clock/placed_time.hpp": "two instants, no bytes",
    "drivers/trigger/coil_and_index_map.hpp": "made by register_map",
    "drivers/trigger/dwell_detector.hpp": "samples in, no bytes",
    "drivers/trigger/sequence_block_map.hpp": "made by register_map",
    "drivers/trigger/single_register_map.hpp": "made by register_map",
    "drivers/framing/byte_order.hpp": "its callers have checked the length",
    "drivers/wire/can_frame.hpp": "a frame as the kernel gives it",
    "drivers/wire/parity_marks.hpp": "two states over any bytes, cut everywhere by its tests",
    "drivers/wire/link_settings.hpp": "text of the station file, parsed by station_file's readers",
    "drivers/plugged/candidates.hpp": "what sysfs told, compared with a table",
    "drivers/registry.hpp": "a table of drivers",
    "drivers/sample.hpp": "values",
}
INCLUDE = re.compile(r'#include "([\w./]+)"')
ORDER = re.compile(r"\b(\w+_from_json)\(")
TARGET = re.compile(r"^axiscal_fuzz\((\w+)", re.M)


def is_pure(header):
    opening = re.match(r"#pragma once\n((?://(?!/)[^\n]*\n)+)", header)
    return bool(opening) and re.search(r"\bPure\b", opening.group(1)) is not None


def complaints(codecs, orders, targets, kept, sources):
    """codecs: pure headers; orders: names of the JSON API; targets: of CMakeLists.txt;
    kept: number of inputs by folder; sources: text of each target by its name."""
    text = "\n".join(sources.values())
    reached = set(INCLUDE.findall(text))
    for header in sorted(set(codecs) - reached - set(NO_CODEC)):
        yield f"{header} is a codec without a target in tests/fuzz"
    for header in sorted(set(NO_CODEC) - set(codecs)):
        yield f"tests/guards/fuzz_targets.py: {header} is no pure header of drivers/ or acquisition/console/"
    for order in sorted(orders):
        if not re.search(rf"\b{order}\(", text):
            yield f"{order} reads what others send and is called by no target of tests/fuzz"
    for target in sorted(targets):
        if target not in sources:
            yield f"tests/fuzz/{target}.cpp is missing"
        if not kept.get(target):
            yield f"tests/fuzz/corpus/{target} holds no input"
    for folder in sorted(set(kept) - set(targets)):
        yield f"tests/fuzz/corpus/{folder} has no target"


def self_test():
    codecs = ["drivers/a/b.hpp", *NO_CODEC]
    good = (codecs, ["order_from_json"], ["b"], {"b": 1}, {"b": '#include "drivers/a/b.hpp"\norder_from_json(body);'})
    planted = [
        (good, 0),
        (([*codecs, "drivers/a/new.hpp"], *good[1:]), 1),
        ((codecs[:-1], *good[1:]), 1),
        ((codecs, ["other_from_json"], *good[2:]), 1),
        ((*good[:3], {"b": 0}, good[4]), 1),
        ((*good[:3], {"b": 1, "old": 3}, good[4]), 1),
        ((*good[:2], ["b", "c"], {"b": 1, "c": 1}, good[4]), 1),
    ]
    wrong = [nth for nth, (case, number) in enumerate(planted) if len(list(complaints(*case))) != number]
    told = [is_pure("#pragma once\n// Lines of a gauge. Pure.\n"), not is_pure("#pragma once\n// A link.\n/// Pure.\n")]
    for nth in wrong:
        print(f"planted sample {nth} is judged wrongly")
    return 0 if not wrong and all(told) else 1


def main():
    if sys.argv[1] == "--self-test":
        return self_test()
    root = pathlib.Path(sys.argv[1])
    fuzz = root / "tests/fuzz"
    headers = [*(root / "drivers").rglob("*.hpp"), *(root / "acquisition/console").glob("*.hpp")]
    codecs = [str(path.relative_to(root)) for path in sorted(headers)
              if is_pure(path.read_text(encoding="utf-8"))]
    orders = {name for path in (root / "acquisition/console").glob("*.hpp")
              for name in ORDER.findall(path.read_text(encoding="utf-8"))}
    targets = TARGET.findall((fuzz / "CMakeLists.txt").read_text(encoding="utf-8"))
    kept = {folder.name: len(list(folder.iterdir())) for folder in (fuzz / "corpus").iterdir()}
    sources = {name: (fuzz / f"{name}.cpp").read_text(encoding="utf-8") for name in targets
               if (fuzz / f"{name}.cpp").exists()}
    found = list(complaints(codecs, orders, targets, kept, sources))
    print("\n".join(found))
    print(f"{len(codecs)} pure headers, {len(targets)} targets, {sum(kept.values())} inputs kept")
    return 1 if found or not codecs else 0


sys.exit(main())
