#!/usr/bin/env python3
"""One package of npm, as a lockfile names it: a file that stays packed. Nothing of it is run.

npm_package.py [--file FILE] [--option NAME] LOCKFILE PACKAGE FOLDER [INSIDE=PLACE ...]
    puts the package into FOLDER; what is there and right is left alone
    --file FILE     is the package, for a computer without network or npm; empty: npm fetches it, from whichever registry it is set to
    --option NAME   of the option of cmake that gives FILE, for what is said where the package cannot be had
    INSIDE=PLACE    writes that file of the package to PLACE

Its hash is compared with the lockfile's whenever it is read, whichever way it came. No address of a registry stands in a lockfile.
"""
import argparse
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

PATIENCE_S = 120  # of a slow registry


class NoPackage(Exception):
    """With the sentence that says what to do."""


def reason_of(said):
    """The lines of npm that say why, in one."""
    lines = [line.removeprefix("npm ERR!").removeprefix("npm error").strip() for line in said.splitlines()]
    return " ".join(line for line in lines if line and "complete log" not in line and not line.startswith("at "))[:500] or "it gave no reason"


class NpmPackage:
    """@param option  of cmake, by which a file is given"""

    def __init__(self, lockfile, name, option):
        self.lockfile, self.name = Path(lockfile), name
        entry = json.loads(self.lockfile.read_text(encoding="utf-8"))["packages"][f"node_modules/{name}"]
        self.version, self.integrity = entry["version"], entry["integrity"]
        self.how = f"cmake -D{option}=FILE takes the package from a file, for a computer without network or npm"

    def place_in(self, folder):
        return Path(folder).resolve() / f"{self.name.replace('@', '').replace('/', '-')}-{self.version}.tgz"

    def is_right(self, file):
        kind, _, hash_ = self.integrity.partition("-")
        return file.is_file() and base64.b64encode(hashlib.new(kind, file.read_bytes()).digest()).decode() == hash_

    def from_npm(self, folder):
        """The package as the registry has it, which is whichever npm is set to. @raise NoPackage"""
        name = f"{self.name}@{self.version}"
        npm = shutil.which("npm")
        if npm is None:
            raise NoPackage(f"{name} cannot be fetched: there is no npm, which tools/install-dependencies installs. {self.how}.")
        try:
            done = subprocess.run([npm, "pack", name, "--ignore-scripts", "--prefer-offline", "--fetch-retries=2",
                                   "--fetch-retry-mintimeout=1000", "--fetch-retry-maxtimeout=5000", "--loglevel=error",
                                   "--pack-destination", "."], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                                  timeout=PATIENCE_S, check=False)
        except subprocess.TimeoutExpired as late:
            raise NoPackage(f"{name} cannot be fetched: npm took longer than {late.timeout:g} s. {self.how}.") from late
        if done.returncode != 0 or not self.place_in(folder).is_file():
            raise NoPackage(f"{name} cannot be fetched by npm: {reason_of(done.stderr)}. {self.how}.")
        return self.place_in(folder)

    def put(self, folder, file=None):
        """@raise NoPackage where it cannot be had, or is another one."""
        place = self.place_in(folder)
        if self.is_right(place):
            return
        place.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=place.parent) as work:
            found = Path(file) if file else self.from_npm(work)
            if not self.is_right(found):
                raise NoPackage(f"{found if file else 'What npm gave'} is not {place.name} with the hash of {self.lockfile}. {self.how}.")
            shutil.copyfile(found, Path(work) / "right")
            os.chmod(Path(work) / "right", 0o644)
            os.replace(Path(work) / "right", place)

    def bytes_of(self, folder, inside):
        """One file of the package. @raise NoPackage"""
        place = self.place_in(folder)
        if not self.is_right(place):
            raise NoPackage(f"{place} is missing or another one: configure again, which fetches it. {self.how}.")
        with tarfile.open(place) as package:
            return package.extractfile(f"package/{inside}").read()

    def write(self, folder, inside, place):
        """What is there and the same is left alone, so that nothing is built anew."""
        said, place = self.bytes_of(folder, inside), Path(place)
        if place.is_file() and place.read_bytes() == said:
            return
        place.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=place.parent) as work:
            (Path(work) / "whole").write_bytes(said)
            os.replace(Path(work) / "whole", place)


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--file", default="")
    words.add_argument("--option", default="AXISCAL_PACKAGE")
    for name in ["lockfile", "package", "folder"]:
        words.add_argument(name)
    words.add_argument("taken", nargs="*", metavar="INSIDE=PLACE")
    given = words.parse_args()
    package = NpmPackage(given.lockfile, given.package, given.option)
    package.put(given.folder, given.file)
    for inside, _, place in (one.partition("=") for one in given.taken):
        package.write(given.folder, inside, place)


if __name__ == "__main__":
    try:
        main()
    except (NoPackage, OSError) as error:
        sys.exit(str(error))
