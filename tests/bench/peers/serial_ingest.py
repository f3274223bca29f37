#!/usr/bin/env python3
"""4096 records of 60 bytes through a pseudo terminal, as in ingest_bench.cpp: read line by line by pyserial, and by gpsd, which
parses NMEA sentences of that length. CPU time alone counts, of the reader."""
import json
import os
import re
import shutil
import socket
import subprocess
import sys
import threading
import time
import tty

ROW, RECORDS, ROUNDS = "serial ingest, 4096 records of 60 bytes", 4096, 5


def told(peer, **what):
    print(json.dumps({"peer": peer, **what}))


def terminal():
    master, slave = os.openpty()
    tty.setraw(slave)
    return master, slave


def send_all(master, text):
    while text:
        text = text[os.write(master, text):]


def pyserial():
    try:
        import serial  # pylint: disable=import-outside-toplevel
    except ImportError:
        return told("pyserial", not_run="python3-serial is not installed")
    master, slave = terminal()
    line = serial.Serial(os.ttyname(slave), 115200, timeout=5)
    record = b"0 17 2000000123 411 1000123 10000000456 0 0".ljust(58, b" ") + b"\r\n"
    best = float("inf")
    for _ in range(ROUNDS):
        feeder = threading.Thread(target=send_all, args=(master, record * RECORDS))
        feeder.start()
        before = time.thread_time_ns()
        for _ in range(RECORDS):
            [int(field) for field in line.readline().split()]
        best = min(best, time.thread_time_ns() - before)
        feeder.join()
    return told("pyserial, readline and int", row=ROW, ns=best)


def sentence(number):
    """A position of 60 bytes or so, with its checksum (NMEA 0183: exclusive or of all between $ and *)."""
    body = f"GPGLL,4916.45,N,12311.12,W,{number % 86400 // 3600:02}{number % 3600 // 60:02}{number % 60:02}.00,A,A"
    check = 0
    for letter in body.encode():
        check ^= letter
    return f"${body}*{check:02X}\r\n".encode()


def cpu_ns(pid):
    fields = open(f"/proc/{pid}/stat", encoding="ascii").read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) * 10**9 // os.sysconf("SC_CLK_TCK")


def gpsd():
    program = shutil.which("gpsd", path=os.environ["PATH"] + ":/usr/sbin")
    if not program:
        return told("gpsd", not_run="it is not installed, and not by us: its hotplug rules reach for serial adapters")
    master, slave = terminal()
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    daemon = subprocess.Popen([program, "-N", "-n", "-b", "-S", str(port), os.ttyname(slave)], stdin=subprocess.DEVNULL,
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        send_all(master, b"".join(sentence(i) for i in range(100)))  # it finds out what it reads
        time.sleep(2)
        rounds = 25  # the kernel counts CPU time in hundredths of a second
        text = b"".join(sentence(i) for i in range(RECORDS))
        before = cpu_ns(daemon.pid)
        for _ in range(rounds):
            send_all(master, text)  # returns when all but the last kilobytes were taken
        time.sleep(0.5)
        if daemon.poll() is not None:
            return told("gpsd", not_run=f"it ended with {daemon.returncode}")
        return told("gpsd, NMEA", row=ROW, ns=(cpu_ns(daemon.pid) - before) / rounds)
    finally:
        daemon.kill()
        daemon.wait()


if re.search(sys.argv[1], ROW):
    pyserial()
    gpsd()
