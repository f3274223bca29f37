#!/usr/bin/python3
"""Row of tools/bench: 100 results of 20 KB to a Samba server on loopback, beside smbclient in the same run.

publish_samba.py PROGRAM-FOLDER

"this" is axiscal-publish --once, from its start to its end: folder, write, read back, compare, rename, receipt on disk, archive. The
limit is one smbclient that puts the same files, once each, and compares nothing. For information: one smbclient doing what
axiscal-publish does but for the receipts, and an smbclient a result, as a script would. Interleaved; the fastest of each counts.
Nothing is pinned: server and client work side by side, as they do on two computers.
"""
import os
import subprocess
import sys
import time
from pathlib import Path

import stall

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "peers/samba"))
import samba_server
from samba_server import Site, Skip, expect, run

COUNT, SIZE, GOAL, ROUNDS = 100, 20000, 1.3, int(os.environ.get("AXISCAL_BENCH_ROUNDS", "5"))


def timed(work):
    began = time.perf_counter()
    work()
    return (time.perf_counter() - began) * 1e3


def rounds(site, program):
    files = [(f"run-{number:03}", site.folder / f"source-{number:03}") for number in range(COUNT)]
    for name, source in files:
        source.write_bytes(os.urandom(SIZE))
    best = {}

    def keep(name, ms):
        best[name] = min(best.get(name, float("inf")), ms)

    for one in range(ROUNDS):
        site.staged.clear()
        for number in range(COUNT):
            site.stage(f"r{one}-{number:03}", SIZE)
        words = [program, "--outbox", site.outbox, "--to", site.samba.url, "--credentials", site.account, "--once"]
        keep("this", timed(lambda: run(*words)))
        expect(not site.waiting() and len(site.on_share()) == (one + 1) * COUNT, "not all was published")
        client = ["smbclient", "-s", site.samba.conf, "-p", str(site.samba.port), "-U",
                  f"{samba_server.USER}%{samba_server.PASSWORD}", f"//{site.samba.address}/results", "-c"]

        def talk(commands):
            subprocess.run([*client, "; ".join(commands)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)
        back = site.folder / "back"
        keep("put", timed(lambda: talk([f"put {source} {name}-{one}.bin" for name, source in files])))
        keep("same", timed(lambda: talk([f"mkdir {name}-{one}; put {source} {name}-{one}/.part; get {name}-{one}/.part {back}; "
                                         f"rename {name}-{one}/.part {name}-{one}/certificate.json" for name, source in files])))
        for file in site.samba.share.glob("run-*-*"):
            if file.is_dir():
                next(file.iterdir()).unlink()
                file.rmdir()
    keep("each", timed(lambda: [talk([f"put {source} {name}-each.bin"]) for name, source in files]))
    return best


def main():
    try:
        samba_server.require()
        with Site(Path(sys.argv[1]) / "axiscal-publish") as site:
            site.samba.start()
            with stall.told(stall.last_processor(), "publish, on all processors: "):
                best = rounds(site, Path(sys.argv[1]) / "axiscal-publish")
    except Skip as missing:
        print(f"publish to Samba did not run: {missing}")
        return 0
    ratio = best["this"] / best["put"]
    print(f"publish 100 results of 20 KB | {best['this']:.0f} ms | {best['put']:.0f} ms (smbclient put) | "
          f"smbclient: mkdir, put, get, rename {best['same']:.0f} ms; one a result {best['each']:.0f} ms | {ratio:.2f} | "
          f"<= {GOAL} x{'' if ratio <= GOAL else '  MISSED'}")
    return 0 if ratio <= GOAL else 1


if __name__ == "__main__":
    sys.exit(main())
