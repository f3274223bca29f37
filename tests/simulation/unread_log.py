"""A log that nobody reads (a full pipe, a stopped terminal, a journal that hangs) holds nothing up."""

import contextlib
import fcntl
import os
import socket
import struct

import bench
from bench import expect, sentence

NOTES = 2000  # of more than 100 bytes: more than pipe and daemon keep
SAMPLES = 3000  # of a laser of 1 kHz: what the kernel keeps of it lasts a tenth of a second
LOSSES = ("restarts", "bad_frames", "checksum_errors", "gaps", "lost_records")


@contextlib.contextmanager
def full_pipe():
    """The write end of a pipe into which nothing goes any more. Its read end stays open, unread."""
    read_end, write_end = os.pipe()
    fcntl.fcntl(write_end, fcntl.F_SETPIPE_SZ, 4096)
    os.set_blocking(write_end, False)
    with contextlib.suppress(BlockingIOError):
        while True:
            os.write(write_end, b"x")
    os.set_blocking(write_end, True)
    try:
        yield write_end
    finally:
        os.close(write_end)
        os.close(read_end)


def answers(b):
    with contextlib.suppress(OSError):
        return b.status()
    return None


def be_refused(b, count):
    """One client asks for so many captures without a run: each refusal is a note."""
    with socket.create_connection(("127.0.0.1", b.station["trigger"]["port"]), timeout=10) as wire:
        for sequence in range(1, count + 1):
            pdu = struct.pack(">BHHBHH", 16, 1, 2, 4, 2, sequence)
            wire.sendall(struct.pack(">HHHB", sequence, 0, len(pdu) + 1, 1) + pdu)
            answer = wire.recv(64)
            expect(answer[7:8] == b"\x10", f"the station answered {answer.hex()}")


@sentence("LogThatNobodyReadsLosesNoRecordAndHoldsNobodyUp")
def unread(b):
    with full_pipe() as nobody:
        b.daemon_stderr = nobody
        b.start_simulator()
        b.write_station()
        b.spawn("axiscald", "--config", b.folder / "station.toml")
        bench.wait_until("the daemon answers", lambda: answers(b), bench.START_S)
        bench.wait_until("every sensor gives a value", b.channels_are_good, bench.START_S)
        before = b.instrument("laser")
        be_refused(b, NOTES)
        note = b.status()["notes"][-1]
        expect(f"Request {NOTES} is refused" in note, note)
        enough = before["samples"] + SAMPLES
        bench.wait_until("the laser goes on", lambda: b.instrument("laser")["samples"] >= enough, 60)
        after = b.instrument("laser")
        lost = {key: after[key] - before[key] for key in LOSSES}
        print(f"{after['samples'] - before['samples']} samples beside {NOTES} notes that nobody read: {lost}")
        expect(not any(lost.values()), f"the laser lost {lost}")
        code = b.end("axiscald")  # or TimeoutExpired, naming the program: nobody ever reads the pipe
    expect(code == 0, f"axiscald ended with {code}")


if __name__ == "__main__":
    bench.main()
