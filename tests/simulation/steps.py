"""Steps by which the daemon changes its state folder, seen and disturbed from outside: the test's side
of tests/preload/write_steps.cpp."""

import mmap
import os
import re
import struct

# count, kill_at, tear, error, kinds, failed, program, met, folder, kill_what
HEAD = struct.Struct("<8Q256s64s")
WORDS, LOGGED = 64, 8192
DATA, SYNC, NAME = 1, 2, 4


def label_of(step):
    """What a step of the log does and to which file, whatever the date in its name."""
    kind, name, _ = step
    return re.sub("[0-9]", "0", f"{kind} {name}")


class Steps:
    """One file shared with every program that loads the library."""

    FIELDS = ["count", "kill_at", "tear", "fail_error", "fail_kinds", "failed", "first_program", "met"]

    def __init__(self, bench):
        path = bench.folder / "steps"
        path.write_bytes(bytes(HEAD.size + WORDS * LOGGED))
        with open(path, "r+b") as file:
            self.memory = mmap.mmap(file.fileno(), 0)
        self.watch(bench.station["station"]["state_directory"])
        library = bench.preloadable(os.path.join(os.environ["AXISCAL_PATH"], "write_steps.so"))
        bench.environment.update(LD_PRELOAD=library, AXISCAL_STEPS=str(path))
        # The sanitizers want to be the first library; they need not be.
        bench.environment["ASAN_OPTIONS"] = "verify_asan_link_order=0"

    def watch(self, folder):
        """Steps in this folder count, elsewhere they do not."""
        self.memory[64 : 64 + 256] = os.path.realpath(folder).encode().ljust(256, b"\0")

    def __getitem__(self, field):
        return struct.unpack_from("<Q", self.memory, 8 * self.FIELDS.index(field))[0]

    def __setitem__(self, field, value):
        struct.pack_into("<Q", self.memory, 8 * self.FIELDS.index(field), value)

    def fail(self, error, kinds):
        """From now on these kinds of steps fail with this errno; 0 ends it."""
        self["fail_kinds"] = kinds
        self["fail_error"] = error

    def kill_before(self, label, nth, tear):
        """The nth step from now on with this label (see label_of; empty: any) is not done any more, or by half.
        0: none is."""
        at = struct.calcsize("<8Q256s")
        self["kill_at"] = 0
        self.memory[at : at + WORDS] = label.encode().ljust(WORDS, b"\0")
        self["met"], self["tear"] = 0, tear
        self["kill_at"] = nth

    def log(self):
        """What each step was: ("pwrite", "x.axiscal-wal", 4096)."""
        told = []
        for number in range(min(self["count"], LOGGED)):
            at = HEAD.size + number * WORDS
            words = self.memory[at : at + WORDS].split(b"\0")[0].decode(errors="replace").split(" ")
            told.append((words[0], " ".join(words[1:-1]), int(words[-1] or 0)))
        return told
