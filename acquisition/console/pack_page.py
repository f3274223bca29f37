#!/usr/bin/env python3
"""Lays the files of the page at the machine where the programs of a build look for them, as they are and packed by gzip.

pack_page.py FOLDER NAME=FILE...

FOLDER/NAME is a copy of FILE, and FOLDER/NAME.gz the same, packed; what else lies in FOLDER is removed. FOLDER ends with share/axiscal/page.
The same bytes are packed to the same bytes: zlib's own head of a gzip file bears no time and no name (RFC 1952, 2.3).
"""
import pathlib
import sys
import zlib

WITH_GZIP_HEAD = 16  # added to the window's size


def packed(data):
    by = zlib.compressobj(zlib.Z_BEST_COMPRESSION, zlib.DEFLATED, WITH_GZIP_HEAD + zlib.MAX_WBITS)
    return by.compress(data) + by.flush()


def put(path, content):
    """What is right already is left alone: FILE itself may lie there."""
    if not path.is_file() or path.read_bytes() != content:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


def remove_others(folder, kept):
    """The deepest first, so that a folder is empty when its turn comes."""
    for path in sorted(folder.rglob("*"), reverse=True):
        if path.is_dir() and not path.is_symlink():
            if not any(path.iterdir()):
                path.rmdir()
        elif path not in kept:
            path.unlink()


def main():
    folder = pathlib.Path(sys.argv[1])
    if folder.parts[-3:] != ("share", "axiscal", "page"):
        sys.exit(f"{folder} is no folder of a page: nothing is removed there")
    kept = set()
    for word in sys.argv[2:]:
        name, file = word.split("=", 1)
        data = pathlib.Path(file).read_bytes()
        for path, content in ((folder / name, data), (folder / f"{name}.gz", packed(data))):
            put(path, content)
            kept.add(path)
    remove_others(folder, kept)


main()
