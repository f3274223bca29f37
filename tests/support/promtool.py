"""Prometheus' own checker `promtool`: this computer's, else that of Debian's package, unpacked into build/promtool.

The package is not installed: that would start a server, and bring eleven others for its pages. 19 MB of download, 48 MB on disk.
"""
import fcntl
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

PACKAGE = "prometheus"
PATIENCE_S = 120  # of a slow mirror


def unpack(folder):
    """@raise OSError, subprocess.SubprocessError where there is no apt, or it reaches no mirror."""
    with tempfile.TemporaryDirectory(dir=folder) as work:
        subprocess.run(["apt-get", "download", "-qq", PACKAGE], cwd=work, check=True, timeout=PATIENCE_S)
        archive = next(Path(work).glob(f"{PACKAGE}_*.deb"))
        subprocess.run(["dpkg-deb", "-x", archive, Path(work) / "tree"], check=True)
        os.replace(Path(work) / "tree/usr/bin/promtool", folder / "promtool")


def require(source):
    """Path of the program. Where it cannot be had the test ends here: as skipped if AXISCAL_MAY_SKIP names promtool.
    Call it before anything is made that must be removed again."""
    installed = shutil.which("promtool")
    if installed:
        return installed
    folder = Path(source) / "build/promtool"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with open(folder / "lock", "w", encoding="ascii") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)  # several tests may ask at once
            if not (folder / "promtool").exists():
                unpack(folder)
        return str(folder / "promtool")
    except (OSError, subprocess.SubprocessError) as reason:
        print(f"no promtool: {reason}; apt-get install {PACKAGE} installs it")
    sys.exit(77 if "promtool" in os.environ.get("AXISCAL_MAY_SKIP", "").split(",") else "or AXISCAL_MAY_SKIP=promtool")
