#!/usr/bin/env python3
"""tools/npm_package.py with an npm that is a script: a package is taken by its hash alone, whichever way it comes, and what stands in
the way is told with the option that solves it.

npm_package.py SOURCE_DIR
"""
import base64
import hashlib
import io
import json
import os
import subprocess
import sys
import tarfile
import tempfile
from pathlib import Path

TOOL = Path(sys.argv[1]).resolve() / "tools/npm_package.py"


def packed(text):
    """A package with one file, the same bytes each time."""
    whole = io.BytesIO()
    with tarfile.open(fileobj=whole, mode="w") as package:
        entry = tarfile.TarInfo("package/dist/plot.js")
        entry.size = len(text)
        package.addfile(entry, io.BytesIO(text))
    return whole.getvalue()


def main():
    with tempfile.TemporaryDirectory() as root:
        root = Path(root)
        right, other = packed(b"right"), packed(b"other")
        hash_ = base64.b64encode(hashlib.sha512(right).digest()).decode()
        (root / "lock.json").write_text(json.dumps({"packages": {"node_modules/plot": {"version": "1.2.3", "integrity": f"sha512-{hash_}"}}}))
        (root / "right.tgz").write_bytes(right)
        (root / "other.tgz").write_bytes(other)
        place = root / "npm/plot-1.2.3.tgz"

        def asked(npm="", file=""):
            """(whether it went well, what it says)"""
            folder = root / "bin"
            folder.mkdir(exist_ok=True)
            (folder / "npm").unlink(missing_ok=True)
            if npm:
                (folder / "npm").write_text(f"#!/bin/sh\n{npm}\n")
                (folder / "npm").chmod(0o755)
            # Of a home with a blank, as some are; no other npm is seen.
            done = subprocess.run([sys.executable, "-B", TOOL, "--option", "AXISCAL_PLOT", "--file", file, root / "lock.json", "plot", root / "npm",
                                   f"dist/plot.js={root / 'a page'}/plot.js"], env={**os.environ, "PATH": str(folder)}, capture_output=True,
                                  text=True, check=False)
            return done.returncode == 0, done.stderr

        def refused(what, *words, **ways):
            good, said = asked(**ways)
            lacks = [word for word in [*words, "cmake -DAXISCAL_PLOT=FILE"] if word not in said]
            assert not good and not lacks and not place.exists(), f"{what}: lacks {lacks}: {said}"

        cp = "/bin/cp"
        refused("no npm", "plot@1.2.3", "tools/install-dependencies")
        refused("npm without network", "ENOTFOUND", npm="echo 'npm ERR! code ENOTFOUND' >&2; exit 1")
        refused("npm gives another one", "plot-1.2.3.tgz", "hash", npm=f"{cp} {root}/other.tgz plot-1.2.3.tgz")
        refused("the file is another one", "other.tgz", "hash", file=str(root / "other.tgz"))
        refused("the file is not there", "none.tgz", file=str(root / "none.tgz"))
        for ways in [{"npm": f"{cp} {root}/right.tgz plot-1.2.3.tgz"}, {"file": str(root / "right.tgz")}]:
            place.unlink(missing_ok=True)
            good, said = asked(**ways)
            assert good and place.read_bytes() == right and (root / "a page/plot.js").read_bytes() == b"right", said
        good, said = asked()  # neither npm nor file: it is here
        assert good, said
        place.write_bytes(other)
        good, said = asked()
        assert not good and "plot@1.2.3" in said, f"what was changed on the disk is taken: {said}"
    print("a package is taken by its hash alone")


main()
