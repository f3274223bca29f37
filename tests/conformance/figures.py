#!/usr/bin/env python3
"""Every figure that must be the same, bit by bit, wherever the program was compiled: of the conformance kit, of run files of
each kind, and the truth of the demo's machine.

figures.py PROGRAMS SOURCE OUT.json              PROGRAMS: folder of axiscal and axiscal-simulate
figures.py PROGRAMS SOURCE --baseline KEPT.json  a hash of each part, to be kept
figures.py PROGRAMS SOURCE --against KEPT.json   exit 1, and each part named, where a bit is another
figures.py --self-test                           proves that planted changes are named

What is kept is computed as on a processor without fused multiply-add, which each of amd64 can be made by GLIBC_TUNABLES:
glibc's sine, arc sine and exponential take another path where there is one (tests/cli/other_processor.py).
"""
import hashlib
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path


def hashes(figures):
    """Of each case of the kit and of each section of a run's result, by its name."""
    parts = {f"kit: {case['id']}": case["figures"] for case in figures["conformance"]}
    for name, result in figures.items():
        if name != "conformance":
            parts |= {f"{name}: {section}": value for section, value in result.items()}
    return {name: hashlib.sha256(json.dumps(part, sort_keys=True).encode()).hexdigest()[:16] for name, part in parts.items()}


def compared(found, kept):
    """What is another than what was kept, a line each."""
    changed = [name for name in kept if name in found and found[name] != kept[name]]
    return ([f"another bit in '{name}'" for name in changed] + [f"'{name}' is missing" for name in kept if name not in found]
            + [f"'{name}' is new" for name in found if name not in kept])


def self_test():
    def figures(last, section="A"):
        return {"conformance": [{"id": "circle", "figures": [{"got": last}]}], "linear": {section: 1.0}}

    kept = hashes(figures(0.1))
    assert compared(hashes(figures(0.1)), kept) == []
    assert compared(hashes(figures(0.1 + 2**-56)), kept) == ["another bit in 'kit: circle'"]
    assert compared(hashes(figures(0.1, "B")), kept) == ["'linear: A' is missing", "'linear: B' is new"]


if sys.argv[1:] == ["--self-test"]:
    sys.exit(self_test())
ORDER = sys.argv[3] if len(sys.argv) == 5 else ""
if ORDER not in ("", "--baseline", "--against") or len(sys.argv) not in (4, 5):
    sys.exit(__doc__)
PROGRAMS, SOURCE, OUT = (Path(word).resolve() for word in (*sys.argv[1:3], sys.argv[-1]))
sys.argv[1:] = [str(PROGRAMS / "axiscal"), str(SOURCE)]
sys.path.append(str(SOURCE / "tests/cli"))
import measured_files
import run_files

ENVIRONMENT = os.environ | ({"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-FMA,-AVX2,-FMA4,-AVX512F"} if ORDER else {})
RUN = str(SOURCE / "tests/reference/fifty_points.axiscal")


def run(program, *words):
    done = subprocess.run([PROGRAMS / program, *map(str, words)], env=ENVIRONMENT, capture_output=True, text=True, timeout=600,
                          check=False)
    if done.returncode != 0:
        sys.exit(f"{program} {words}: {done.returncode}\n{done.stdout[-2000:]}{done.stderr}")
    return json.loads(done.stdout)


def runs():
    """Name and rows of a run file of each kind."""
    yield "linear", run_files.with_synchronisation(run_files.read(RUN))
    yield "scale", run_files.scale(RUN)
    yield "freezing", measured_files.freezing(RUN)
    yield "rotary", measured_files.rotary(RUN)
    yield "circular", measured_files.circular(RUN)


def main():
    kit = run("axiscal", "conformance", "--json", "--cases", SOURCE / "tests/reference/conformance")
    figures = {"conformance": kit["cases"], "fifty points": run("axiscal", "analyze", RUN)}
    with tempfile.TemporaryDirectory(prefix="axiscal-figures-") as folder:
        for name, rows in runs():
            path = os.path.join(folder, "run.axiscal")
            run_files.write(path, str(SOURCE), rows)
            figures[name] = run("axiscal", "analyze", path)
            os.unlink(path)
    figures["truth of the demo"] = run("axiscal-simulate", "truth", "--scenario",
                                       SOURCE / "tools/axiscal-simulate/scenarios/demo.toml", "--targets", "34,130,226,514,994",
                                       "--approaches", "5")
    for name in figures.keys() - {"conformance", "truth of the demo"}:
        # SQLite's own bytes differ from version to version, and a release changes no figure.
        figures[name]["run"].pop("run_file_sha256", None)
        figures[name]["run"].pop("software_version")
    if ORDER == "--against":
        found = compared(hashes(figures), json.loads(OUT.read_text()))
        if found:
            sys.exit("\n".join(found) + f"\nWhere that is meant, say why and keep the new ones: figures.py … --baseline {OUT}")
    else:
        kept = hashes(figures) if ORDER else figures
        OUT.write_text(json.dumps(kept, indent=1, sort_keys=True) + "\n")
    print(f"{sum(len(case['figures']) for case in kit['cases'])} figures of the kit, {len(figures) - 2} run files, {OUT}")


main()
