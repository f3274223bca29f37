#!/usr/bin/python3
"""Row of tools/bench: 100 results of 20 KB to a Samba server on loopback, beside smbclient in the same run.

publish_samba.py PROGRAM-FOLDER

"this" is axiscal-publish --once, from its start to its end: folder, write, read back, compare, rename, receipt on disk, archive. The
limit is one smbclient that puts the same files, once each, and compares nothing. For information: one smbclient doing what
axiscal-publish does but for the receipts, and an smbclient a result, as a script would. Interleaved, each on a share
that is empty; the fastest of each counts. Nothing is pinned: server and client work side by side, as they do on two computers.
"""
import contextlib
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import stall

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "peers/samba"))
import samba_server
from samba_server import Site, Skip, expect

REST_S = 0.03
COUNT, SIZE, GOAL, ROUNDS = 100, 20000, 1.3, int(os.environ.get("AXISCAL_BENCH_ROUNDS", "30"))


def timed(work):
    began = time.perf_counter()
    work()
    return (time.perf_counter() - began) * 1e3


def quietly(words):
    """What it says is nobody's work to read."""
    subprocess.run(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)


class Race:
    """Who takes how long to bring 100 files onto a share that was empty."""

    def __init__(self, site, program):
        self.site, self.best = site, {}
        self.own = [program, "--outbox", site.outbox, "--to", site.samba.url, "--credentials", site.account, "--once"]
        self.client = ["smbclient", "-s", site.samba.conf, "-p", str(site.samba.port), "-U",
                       f"{samba_server.USER}%{samba_server.PASSWORD}", f"//{site.samba.address}/results", "-c"]
        self.files = {f"run-{number:03}": site.folder / f"source-{number:03}" for number in range(COUNT)}
        for source in self.files.values():
            source.write_bytes(os.urandom(SIZE))

    def serves_nobody(self):
        """smbd has no child left but those with a name of their own, as smbd-notifyd."""
        pid = self.site.samba.process.pid
        names = []
        for child in Path(f"/proc/{pid}/task/{pid}/children").read_text().split():
            with contextlib.suppress(OSError):
                names.append(Path(f"/proc/{child}/comm").read_text().strip())
        return "smbd" not in names

    def heat(self, name, work):
        """Once what the heat before has left behind is done: its servers are gone, and so is what the kernel puts off."""
        samba_server.wait_until("the servers of the heat before are gone", self.serves_nobody)
        for there in self.site.samba.share.iterdir():
            shutil.rmtree(there) if there.is_dir() else there.unlink()
        time.sleep(REST_S)
        ms = timed(work)
        arrived = [file for file in self.site.samba.share.rglob("*") if file.is_file() and file.stat().st_size == SIZE]
        expect(len(arrived) == COUNT, f"{name}: {len(arrived)} of {COUNT} arrived")
        self.best[name] = min(self.best.get(name, float("inf")), ms)

    def talk(self, commands):
        quietly([*self.client, "; ".join(commands)])

    def round(self, number):
        self.site.staged.clear()
        for name in self.files:
            self.site.stage(f"{name}-{number}", SIZE)
        self.heat("this", lambda: quietly(self.own))
        expect(not self.site.waiting(), "not all was published")
        self.heat("put", lambda: self.talk(f"put {source} {name}.bin" for name, source in self.files.items()))
        back = self.site.folder / "back"
        self.heat("same", lambda: self.talk(f"mkdir {name}; put {source} {name}/.part; get {name}/.part {back}; "
                                            f"rename {name}/.part {name}/certificate.json" for name, source in self.files.items()))

    def one_a_result(self):
        self.heat("each", lambda: [self.talk([f"put {source} {name}.bin"]) for name, source in self.files.items()])


def main():
    try:
        samba_server.require()
        with Site(Path(sys.argv[1]) / "axiscal-publish") as site:
            site.samba.more = "log level = 0"  # as Debian ships it; the tests read more
            site.samba.configure()
            site.samba.start()
            with stall.told(stall.last_processor(), "publish, on all processors: "):
                race = Race(site, Path(sys.argv[1]) / "axiscal-publish")
                for number in range(ROUNDS):
                    race.round(number)
                race.one_a_result()
    except Skip as missing:
        print(f"publish to Samba did not run: {missing}")
        return 0
    best = race.best
    ratio = best["this"] / best["put"]
    print(f"publish 100 results of 20 KB | {best['this']:.0f} ms | {best['put']:.0f} ms (smbclient put) | "
          f"smbclient: mkdir, put, get, rename {best['same']:.0f} ms; one a result {best['each']:.0f} ms | {ratio:.2f} | "
          f"<= {GOAL} x{'' if ratio <= GOAL else '  MISSED'}")
    return 0 if ratio <= GOAL else 1


if __name__ == "__main__":
    sys.exit(main())
