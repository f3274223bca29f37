"""What stands in the guest for the kernel's counter device: Debian's kernel is built without counters. A named pipe gives
the records of <linux/counter.h>, and what can go wrong with them. The driver opens it as it would the device, but asks it for no
events: those calls stay untried."""

import contextlib
import os
import struct
import threading
import time

# struct counter_event: timestamp, value; component type, scope, parent, id; event, channel; status; one byte to fill.
RECORD = struct.Struct("=QQBBBBBBBx")
TYPE_COUNT, SCOPE_COUNT, EVENT_CAPTURE = 2, 2, 6
VALUE, EVENT, STATUS = 10, 20, 22  # places in the record; the first is the value's third byte, of counts by 65536
PERIOD_S = 0.01
FAULTS = ("none", "ended", "gone", "silent", "corrupt")


class CounterPipe:
    """ended: the writer closes its end. gone: so, and the node goes, too. silent: an open end that writes nothing. corrupt: the byte
    at `place` of each record is XORed with `mask`. Records come each PERIOD_S, with the stamp of CLOCK_MONOTONIC, as the kernel's do."""

    def __init__(self, path, count):
        self.path, self.count = path, count
        self.fault, self.place, self.mask, self.writer = "none", 0, 0, None
        self.lock = threading.Lock()
        os.mkfifo(path)
        threading.Thread(target=self.feed, daemon=True).start()

    def suffer(self, fault, place=0, mask=0):
        assert fault in FAULTS, fault
        with self.lock:
            self.fault, self.place, self.mask = fault, place, mask
            if fault == "gone":
                os.unlink(self.path)
            elif not self.path.exists():
                os.mkfifo(self.path)
            if fault in ("ended", "gone"):
                self.end()

    def end(self):
        if self.writer is not None:
            os.close(self.writer)
        self.writer = None

    def feed(self):
        while True:
            time.sleep(PERIOD_S)
            with self.lock:
                if self.fault not in ("ended", "gone"):
                    self.give()

    def give(self):
        """One record. Nobody reads, or somebody too slowly: it is lost, as the device's own queue would lose it."""
        if self.writer is None:
            with contextlib.suppress(OSError):
                self.writer = os.open(self.path, os.O_WRONLY | os.O_NONBLOCK | os.O_CLOEXEC)
        if self.writer is None or self.fault == "silent":
            return
        try:
            os.write(self.writer, self.record())
        except BlockingIOError:
            pass
        except BrokenPipeError:
            self.end()

    def record(self):
        stamp = time.clock_gettime_ns(time.CLOCK_MONOTONIC)
        whole = RECORD.pack(stamp, self.count, TYPE_COUNT, SCOPE_COUNT, 0, 0, EVENT_CAPTURE, 0, 0)
        record = bytearray(whole)
        if self.fault == "corrupt":
            record[self.place] ^= self.mask
        return bytes(record)
