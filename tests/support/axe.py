"""axe-core, which judges whether everybody can use a page: npm's package, as tests/page/package-lock.json names it.

It stays packed: it is compared with the lockfile's hash whenever it is read, whichever way it came (tools/npm_package.py).
"""
import os
import sys
from pathlib import Path

TESTS = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(TESTS.parent / "tools"))
from npm_package import NoPackage, NpmPackage  # noqa: E402


def require(folder):
    """The library's own text, out of the package in this folder; where it cannot be had the test ends here: as skipped if
    AXISCAL_MAY_SKIP names axe. Call it before anything is made that must be removed again."""
    try:
        return NpmPackage(TESTS / "page/package-lock.json", "axe-core", "AXISCAL_AXE").bytes_of(folder, "axe.min.js").decode("utf-8")
    except NoPackage as reason:
        print(reason)
    sys.exit(77 if "axe" in os.environ.get("AXISCAL_MAY_SKIP", "").split(",") else "or AXISCAL_MAY_SKIP=axe")
