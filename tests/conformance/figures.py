#!/usr/bin/env python3
"""Every figure that must be the same, bit by bit, wherever the program was compiled: of the conformance kit, of run files of
each kind, and the truth of the demo's machine.

figures.py PROGRAMS SOURCE OUT.json    PROGRAMS: folder of axiscal and axiscal-simulate
"""
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

PROGRAMS, SOURCE, OUT = (Path(word).resolve() for word in sys.argv[1:4])
sys.argv[1:] = [str(PROGRAMS / "axiscal"), str(SOURCE)]
sys.path.append(str(SOURCE / "tests/cli"))
import measured_files
import run_files

RUN = str(SOURCE / "tests/reference/fifty_points.axiscal")


def run(program, *words):
    done = subprocess.run([PROGRAMS / program, *map(str, words)], capture_output=True, text=True, timeout=600, check=False)
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
            del figures[name]["run"]["run_file_sha256"]  # SQLite's own bytes differ from version to version
            os.unlink(path)
    figures["truth of the demo"] = run("axiscal-simulate", "truth", "--scenario",
                                       SOURCE / "tools/axiscal-simulate/scenarios/demo.toml", "--targets", "34,130,226,514,994",
                                       "--approaches", "5")
    OUT.write_text(json.dumps(figures, indent=1, sort_keys=True) + "\n")
    print(f"{sum(len(case['figures']) for case in kit['cases'])} figures of the kit, {len(figures) - 2} run files, {OUT}")


main()
