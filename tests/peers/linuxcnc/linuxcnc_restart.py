#!/usr/bin/python3
"""axiscald is killed in mid-program: linuxcnc_restart.py SOURCE_DIR BUILD_DIR SHAPE

LinuxCNC stands at its request meanwhile. The restarted station goes on with the open run, takes
the standing request, and LinuxCNC drives its program to the end as if nothing had been: 110 of 110 points,
E as injected, the interruption told on the certificate. mb2hal is linked anew as docs/trigger.md says."""
import json
import os
import pathlib
import subprocess
import sys

from linuxcnc_bench import PATIENCE_S, run_in_bench, until
from linuxcnc_figures import judge_certificate

BEFORE = 3  # points


def run_of(bench):
    run = bench.status()["run"]
    assert run, "no run is open"
    return run


def link_anew(bench, beside):
    """mb2hal ends some time after it was asked to, and only one bears the name."""
    recipe = (bench.source / f"tools/linuxcnc/{bench.shape}.hal").read_text().splitlines()
    again = [line for line in recipe if line.startswith(("loadusr", "net"))]
    (bench.scratch / "again.hal").write_text("\n".join([*again, ""]))
    environment = dict(os.environ)
    if os.geteuid() == 0:  # as run_linuxcnc.sh started it
        meeting = next(bench.scratch.glob("axiscal-cnc.*"))
        environment |= {"RTAPI_UID": os.environ.get("RTAPI_UID", "65534"),
                        "RTAPI_FIFO_PATH": str(meeting / "fifo")}

    def halcmd(*words, stdout):
        subprocess.run(["halcmd", *words], cwd=bench.scratch, env=environment, check=True, stdin=subprocess.DEVNULL,
                       stdout=stdout, stderr=subprocess.STDOUT, timeout=PATIENCE_S)

    def is_gone():
        with open(bench.scratch / "components.log", "w") as told:
            halcmd("list", "comp", stdout=told)
        return "mb2hal" not in (bench.scratch / "components.log").read_text()

    with open(bench.scratch / "again.log", "w") as log:  # mb2hal keeps it and writes much
        halcmd("unloadusr", "mb2hal", stdout=log)
        until(is_gone, "mb2hal has ended", beside)
        halcmd("-f", "again.hal", stdout=log)


def kill_in_mid_program(bench, daemon, cnc):
    """A new axiscald takes the place of the old one. @returns the run as it was."""
    until(lambda: run_of(bench)["done"] >= BEFORE, f"{BEFORE} points", [daemon, cnc])
    before = run_of(bench)
    daemon.kill()
    daemon.wait(PATIENCE_S)
    bench.running.remove(daemon)
    bench.start_station(bench.scratch / "station.toml")
    return before


def reach_the_end(bench, cnc, before):
    """The same run, whole. @returns the folder of its certificate."""
    folder = bench.reach_the_end(cnc)
    assert run_of(bench)["id"] == before["id"], "another run"
    told = json.dumps(json.loads((folder / "certificate.json").read_text())["run"]["events"])
    assert "recorded nothing" in told, f"the interruption is not told: {told}"
    print(f"killed after {before['done']} points, the same run went on to its end")
    return folder


def restart(bench):
    daemon, cnc, program = bench.begin_run()
    before = kill_in_mid_program(bench, daemon, cnc)
    link_anew(bench, [cnc])
    judge_certificate(reach_the_end(bench, cnc, before), bench.truth(program))


if __name__ == "__main__":
    sys.exit(run_in_bench(restart))
