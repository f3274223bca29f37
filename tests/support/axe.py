"""axe-core, which judges whether everybody can use a page: npm's package, as tests/page/package-lock.json names it.

axe.py FOLDER [FILE]    puts the package into FOLDER; FILE is that package, for a computer without network

What is there and right is left alone. The package stays packed: it is compared with the lockfile's hash whenever it is read, whichever
way it came, and what is run is read out of it.
"""
import base64
import hashlib
import json
import os
import shutil
import subprocess
import sys
import tarfile
import tempfile
from pathlib import Path

LOCKFILE = Path(__file__).resolve().parents[1] / "page/package-lock.json"
PACKAGE = "axe-core"
PATIENCE_S = 120  # of a slow registry
HOW = "cmake -DAXISCAL_AXE=FILE takes the package from a file, for a computer without network or npm"


class NoAxe(Exception):
    """With the sentence that says what to do."""


def wanted():
    """(version, integrity) of the lockfile; the second as "sha512-" and the hash in base64."""
    entry = json.loads(LOCKFILE.read_text(encoding="utf-8"))["packages"][f"node_modules/{PACKAGE}"]
    return entry["version"], entry["integrity"]


def place_in(folder):
    return Path(folder).resolve() / f"{PACKAGE}-{wanted()[0]}.tgz"


def is_right(file):
    kind, _, hash_ = wanted()[1].partition("-")
    return file.is_file() and base64.b64encode(hashlib.new(kind, file.read_bytes()).digest()).decode() == hash_


def reason_of(said):
    """The lines of npm that say why, in one."""
    lines = [line.removeprefix("npm ERR!").removeprefix("npm error").strip() for line in said.splitlines()]
    return " ".join(line for line in lines if line and "complete log" not in line and not line.startswith("at "))[:500] or "it gave no reason"


def from_npm(folder):
    """The package as the registry has it, which is whichever npm is set to. @raise NoAxe"""
    name = f"{PACKAGE}@{wanted()[0]}"
    npm = shutil.which("npm")
    if npm is None:
        raise NoAxe(f"{name} cannot be fetched: there is no npm, which tools/install-dependencies test installs. {HOW}.")
    try:
        done = subprocess.run([npm, "pack", name, "--ignore-scripts", "--prefer-offline", "--fetch-retries=2", "--fetch-retry-mintimeout=1000",
                               "--fetch-retry-maxtimeout=5000", "--loglevel=error", "--pack-destination", "."], cwd=folder,
                              stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=PATIENCE_S, check=False)
    except subprocess.TimeoutExpired as late:
        raise NoAxe(f"{name} cannot be fetched: npm took longer than {late.timeout:g} s. {HOW}.") from late
    if done.returncode != 0 or not place_in(folder).is_file():
        raise NoAxe(f"{name} cannot be fetched by npm: {reason_of(done.stderr)}. {HOW}.")
    return place_in(folder)


def put(folder, file=None):
    """@raise NoAxe where it cannot be had, or is another one."""
    place = place_in(folder)
    if is_right(place):
        return
    place.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=place.parent) as work:
        found = from_npm(work) if file is None else Path(file)
        if not is_right(found):
            raise NoAxe(f"{found if file else 'What npm gave'} is not {place.name} with the hash of {LOCKFILE}. {HOW}.")
        shutil.copyfile(found, Path(work) / "right")
        os.replace(Path(work) / "right", place)


def script_of(folder):
    """The library's own text. @raise NoAxe"""
    place = place_in(folder)
    if not is_right(place):
        raise NoAxe(f"{place} is missing or another one: configure again, which fetches it. {HOW}.")
    with tarfile.open(place) as package:
        return package.extractfile("package/axe.min.js").read().decode("utf-8")


def require(folder):
    """script_of(); where it cannot be had the test ends here: as skipped if AXISCAL_MAY_SKIP names axe.
    Call it before anything is made that must be removed again."""
    try:
        return script_of(folder)
    except NoAxe as reason:
        print(reason)
    sys.exit(77 if "axe" in os.environ.get("AXISCAL_MAY_SKIP", "").split(",") else "or AXISCAL_MAY_SKIP=axe")


if __name__ == "__main__":
    try:
        put(*sys.argv[1:])
    except (NoAxe, OSError) as error:
        sys.exit(str(error))
