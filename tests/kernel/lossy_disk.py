"""A disk that forgets what was not flushed: the host's side of the power cuts.

QEMU reads and writes it by the NBD protocol (the NBD project's doc/proto.md, fixed newstyle). Every
write and every flush is kept in the order of its arrival, so that one run in one guest gives any number
of power cuts: what the disk would hold after a cut at any place of the record is put together afterwards.

    state   the disk under test: ext4, at first empty
    notes   its begin takes what the CNC was told ("done 7"), which stands in the record among the writes;
            at 4096 it takes an order ("cut 3", "lie 2"), and from then on `after` is that disk; at 8192 it
            tells in JSON what was made
    after   the disk as it is when the power is back

What a cut leaves: every write that was answered before the last flush began; of the later ones a seeded
random subset, in any order of arrival, some of them torn between two sectors.
"""

import contextlib
import json
import pickle
import random
import socket
import struct
import subprocess
import tempfile
import threading
from pathlib import Path

SIZE = 32 << 20  # bytes; a run of 20 points and its certificate are 2 MB
# What a disk writes at once or not at all: the physical sector of today's. On one that tears at 512 bytes
# ext4 itself is lost with its superblock, which is two of those long.
SECTOR = 4096
NOTE, ORDER, ANSWER = 0, 4096, 8192
ANSWER_BYTES = 4096
HELLO, OPTION, REPLY = b"NBDMAGIC", b"IHAVEOPT", 0x0003E889045565A9
EXPORT_NAME, ABORT, INFO, GO = 1, 2, 6, 7  # options
ACK, EXPORT, UNSUPPORTED = 1, 3, 0x80000001  # answers to them
READ, WRITE, END, FLUSH = 0, 1, 2, 3  # commands
FUA = 1  # flag of a command: this write is durable when it is answered
CAN = 1 | 4 | 8  # flags are valid, flush, FUA
REQUEST = struct.Struct(">IHHQQI")
NAMES = ("state", "notes", "after")


class Record:
    """What reached the disk, in order: ("write", at, bytes, durable), ("flush",), ("done", number)."""

    def __init__(self, empty):
        self.empty = empty  # as mkfs left it
        self.entries = []

    def done_before(self, end):
        return next((entry[1] for entry in reversed(self.entries[:end]) if entry[0] == "done"), None)

    def last_flush(self, end):
        """Index behind the last flush before `end`; 0 without any."""
        return next((i + 1 for i in range(end - 1, -1, -1) if self.entries[i][0] == "flush"), 0)

    def begin(self):
        """Where the daemon was started: the note "done none"."""
        return next(i for i, entry in enumerate(self.entries) if entry == ("done", None))

    def cut(self, seed):
        """The disk after a cut at a random moment of the run, and a word on how it came about. Moments with
        something to lose are taken four times as often as those behind a flush."""
        dice = random.Random(seed)
        moments = range(self.begin() + 1, len(self.entries) + 1)
        end = dice.choices(moments, [4 if self.entries[m - 1][0] == "write" else 1 for m in moments])[0]
        return self.disk(end, self.last_flush(end), dice)

    def lie(self, number):
        """As a disk that calls a flush done and does nothing: cut as soon as the CNC knew `number`, with
        all that came since it knew the one before lost. Nobody can survive that."""
        known = {entry[1]: i + 1 for i, entry in enumerate(self.entries) if entry[0] == "done"}
        return self.disk(known[number], known[number - 1], None)

    def disk(self, end, durable_end, dice):
        disk = bytearray(self.empty)
        share = dice.choice((0.0, 0.3, 0.7, 1.0)) if dice else 0.0
        counts = {"written": 0, "lost": 0, "torn": 0}
        for i, entry in enumerate(self.entries[:end]):
            if entry[0] != "write":
                continue
            _, at, data, durable = entry
            if i >= durable_end and not (durable and dice):
                data = self.what_is_left(data, share, dice, counts)
            else:
                counts["written"] += 1
            for place, piece in data if isinstance(data, list) else [(0, data)]:
                disk[at + place : at + place + len(piece)] = piece
        told = {"at": end, "of": len(self.entries), "unflushed": end - durable_end, **counts, "done": self.done_before(end)}
        return disk, told

    @staticmethod
    def what_is_left(data, share, dice, counts):
        """Of one write that no flush covered: all, nothing, or some of its sectors."""
        if dice and len(data) > SECTOR and dice.random() < 0.25:
            counts["torn"] += 1
            places = range(0, len(data), SECTOR)
            return [(place, data[place : place + SECTOR]) for place in places if dice.random() < 0.5]
        kept = dice is not None and dice.random() < share
        counts["written" if kept else "lost"] += 1
        return [(0, data)] if kept else []


class Disks:
    """The three exports; one lock gives everything one order."""

    def __init__(self, empty, seed):
        self.lock = threading.Lock()
        self.record = Record(bytes(empty))
        self.seed = seed
        self.content = {"state": bytearray(empty), "notes": bytearray(1 << 20), "after": bytearray(empty)}

    def read(self, name, at, length):
        with self.lock:
            return bytes(self.content[name][at : at + length])

    def write(self, name, at, data, durable):
        with self.lock:
            self.content[name][at : at + len(data)] = data
            if name == "state":
                self.record.entries.append(("write", at, data, durable))
            elif name == "notes":
                self.take_note(at, data.split(b"\0")[0].decode().split())

    def flush(self, name):
        with self.lock:
            if name == "state":
                self.record.entries.append(("flush",))

    def take_note(self, at, words):
        if at == NOTE:
            self.record.entries.append(("done", None if words[1] == "none" else int(words[1])))
        elif at == ORDER:
            number = int(words[1])
            made = self.record.cut(f"{self.seed}/{number}") if words[0] == "cut" else self.record.lie(number)
            self.content["after"], told = made
            answer = json.dumps({"seed": self.seed, **told}).encode()
            self.content["notes"][ANSWER : ANSWER + ANSWER_BYTES] = answer.ljust(ANSWER_BYTES, b"\0")


class Connection:
    """One client: the handshake, then its commands one after the other."""

    def __init__(self, wire, disks):
        self.wire, self.disks = wire, disks

    def take(self, length):
        data = bytearray()
        while len(data) < length:
            piece = self.wire.recv(length - len(data))
            if not piece:
                raise ConnectionError("the client is gone")
            data += piece
        return bytes(data)

    def serve(self):
        with contextlib.suppress(OSError), self.wire:
            name = self.shake_hands()
            while name:
                _, flags, command, cookie, at, length = REQUEST.unpack(self.take(REQUEST.size))
                if command == END:
                    return
                data = b""
                if command == READ:
                    data = self.disks.read(name, at, length)
                elif command == WRITE:
                    self.disks.write(name, at, self.take(length), bool(flags & FUA))
                elif command == FLUSH:
                    self.disks.flush(name)
                error = 0 if command in (READ, WRITE, FLUSH) else 22  # EINVAL
                self.wire.sendall(struct.pack(">IIQ", 0x67446698, error, cookie) + data)

    def shake_hands(self):
        """@returns the export asked for; None: the client wanted to know only."""
        self.wire.sendall(HELLO + OPTION + struct.pack(">H", 3))  # fixed newstyle, no zeroes
        self.take(4)
        while True:
            _, option, length = struct.unpack(">8sII", self.take(16))
            data = self.take(length)
            if option == ABORT:
                return None
            if option == EXPORT_NAME:
                name = data.decode()
                self.wire.sendall(struct.pack(">QH", len(self.disks.content[name]), CAN))
                return name
            if option not in (INFO, GO):
                self.answer(option, UNSUPPORTED)
                continue
            (letters,) = struct.unpack(">I", data[:4])
            name = data[4 : 4 + letters].decode()
            self.answer(option, EXPORT, struct.pack(">HQH", 0, len(self.disks.content[name]), CAN))
            self.answer(option, ACK)
            if option == GO:
                return name

    def answer(self, option, kind, data=b""):
        self.wire.sendall(struct.pack(">QIII", REPLY, option, kind, len(data)) + data)


class Server:
    """Serves while the with-block lasts; words() are what QEMU needs to see the three disks."""

    def __init__(self, folder, environment, seed):
        self.folder = folder
        self.meeting = tempfile.TemporaryDirectory(prefix="axiscal-disks-")  # a socket's name has 107 characters at most
        self.path = Path(self.meeting.name) / "disks.sock"
        image = folder / "empty.ext4"
        with open(image, "wb") as file:
            file.truncate(SIZE)
        # All tables now: the kernel is to write nothing but what it is asked for.
        subprocess.run(["mkfs.ext4", "-q", "-F", "-b", "4096", "-E", "lazy_itable_init=0,lazy_journal_init=0", str(image)],
                       env=environment, check=True)
        self.disks = Disks(image.read_bytes(), seed)
        image.unlink()

    def words(self):
        words = []
        for name in NAMES:
            words += ["-blockdev", f"driver=nbd,node-name={name},server.type=unix,server.path={self.path},export={name}",
                      "-device", f"virtio-blk-pci,drive={name},serial={name},write-cache=on"]
        return words

    def __enter__(self):
        self.door = socket.socket(socket.AF_UNIX)
        self.door.bind(str(self.path))
        self.door.listen()
        threading.Thread(target=self.welcome, daemon=True).start()
        return self

    def welcome(self):
        with contextlib.suppress(OSError):
            while True:
                wire, _ = self.door.accept()
                threading.Thread(target=Connection(wire, self.disks).serve, daemon=True).start()

    def __exit__(self, *_):
        """The record stays beside the logs: any cut can be made again from it (Record, Disks)."""
        self.door.close()
        self.meeting.cleanup()
        with open(self.folder / "record.pickle", "wb") as file:
            pickle.dump((self.disks.seed, self.disks.record), file)
