#!/usr/bin/python3
"""Foreign Modbus programs against our trigger ports: modbus_peers.py HOST-PROGRAM mbpoll|pymodbus

The host finishes each request at once. A missing tool is a failure unless AXISCAL_MAY_SKIP names
it (then exit 77)."""
import importlib.util
import inspect
import os
import pty
import re
import select
import shutil
import socket
import subprocess
import sys
import threading
import time
import tty

PATIENCE_S = 20  # only ends a failing test


class Host:
    """Our port in its own process."""

    def __init__(self, program, *words):
        self.process = subprocess.Popen([program, *words], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, text=True)
        self.lines = []
        self.port = int(self.process.stdout.readline().split()[1])
        threading.Thread(target=self._collect, daemon=True).start()

    def _collect(self):
        for line in self.process.stdout:
            self.lines.append(line.strip())

    def requests(self):
        return [int(line.split()[1]) for line in self.lines if line.startswith("request")]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.stdin.close()
        code = self.process.wait(PATIENCE_S)
        assert code == 0, f"host ended with {code}"


class SerialCable:
    """Two pseudo terminals with their masters joined."""

    def __enter__(self):
        pairs = [pty.openpty(), pty.openpty()]
        self.masters = [master for master, _ in pairs]
        self.slaves = [slave for _, slave in pairs]
        for descriptor in self.masters + self.slaves:
            tty.setraw(descriptor)
        self.ends = [os.ttyname(slave) for slave in self.slaves]
        self.going = True
        self.thread = threading.Thread(target=self._carry)
        self.thread.start()
        return self

    def _carry(self):
        while self.going:
            for end in select.select(self.masters, [], [], 0.1)[0]:
                other = self.masters[1 - self.masters.index(end)]
                os.write(other, os.read(end, 4096))

    def __exit__(self, *_):
        self.going = False
        self.thread.join()
        for descriptor in self.masters + self.slaves:
            os.close(descriptor)


def until(condition, what):
    end = time.monotonic() + PATIENCE_S
    while time.monotonic() < end:
        value = condition()
        if value:
            return value
        time.sleep(0.005)
    raise AssertionError(f"never came: {what}")


def equal(seen, wanted, what):
    assert seen == wanted, f"{what}: {seen} instead of {wanted}"


# --- mbpoll -------------------------------------------------------------------------------------

def mbpoll(where, table, first, *values, count=1):
    """Registers are counted from 0 here, from 1 by mbpoll."""
    words = ["mbpoll", *where[:-1], "-a", "1", "-t", str(table), "-r", str(first + 1), "-q", "-1"]
    words += [where[-1], *map(str, values)] if values else ["-c", str(count), where[-1]]
    done = subprocess.run(words, capture_output=True, text=True, timeout=PATIENCE_S)
    assert done.returncode == 0, f"{words}: {done.stdout}{done.stderr}"
    return [int(value) for value in re.findall(r"^\[\d+\]:\s+(-?\d+)", done.stdout, re.M)]


def mbpoll_answers(where):
    words = ["mbpoll", *where[:-1], "-a", "1", "-t", "4", "-r", "1", "-q", "-1", where[-1]]
    return subprocess.run(words, capture_output=True, timeout=PATIENCE_S).returncode == 0


def mbpoll_sequence_block(where, host):
    for sequence in range(1, 4):
        mbpoll(where, 4, 1, 2, sequence)  # CMD capture, CMD_SEQ: one FC16
        equal(mbpoll(where, 4, 18, count=2), [sequence, 0], "ACK_SEQ and RESULT by FC3")
        equal(mbpoll(where, 3, 18), [sequence], "ACK_SEQ by FC4")
    mbpoll(where, 4, 1, 6, 4)  # a command of another version
    equal(mbpoll(where, 4, 18, count=2), [3, 5], "done stays, RESULT bad command")
    equal(mbpoll(where, 4, 32), [4], "FAULT_SEQ")
    until(lambda: host.requests() == [1, 2, 3], "three requests")


def mbpoll_lane(program):
    with Host(program, "sequence-block", "tcp") as host:
        mbpoll_sequence_block(["-m", "tcp", "-p", str(host.port), "127.0.0.1"], host)
    with SerialCable() as cable, Host(program, "sequence-block", "rtu", cable.ends[0]) as host:
        where = ["-m", "rtu", "-b", "115200", "-P", "none", cable.ends[1]]
        until(lambda: mbpoll_answers(where), "the first answer: a port forgets what came before silence")
        mbpoll_sequence_block(where, host)
    with Host(program, "single-register", "tcp") as host:
        where = ["-m", "tcp", "-p", str(host.port), "127.0.0.1"]
        for sequence in (0, 1, 2, 65534, 1):
            mbpoll(where, 4, 0, sequence)
            if sequence:
                equal(mbpoll(where, 3, 0), [sequence], "echo")
        until(lambda: host.requests() == [1, 2, 65534, 1], "four requests")
    with Host(program, "coil-and-index", "tcp") as host:
        where = ["-m", "tcp", "-p", str(host.port), "127.0.0.1"]
        for sequence in (1, 2):
            mbpoll(where, 4, 0, sequence)
            mbpoll(where, 0, 0, 1)
            equal(mbpoll(where, 1, 0), [1], "acknowledge")
            equal(mbpoll(where, 3, 0), [sequence], "done sequence")
            mbpoll(where, 0, 0, 0)
            equal(mbpoll(where, 1, 0), [0], "acknowledge after the coil fell")


# --- pymodbus -----------------------------------------------------------------------------------

def pymodbus_sequence_block(cnc, host):
    assert cnc.connect()
    for sequence in range(1, 51):
        claim = [2, sequence, sequence - 1, 1, 0, 1000, 0, 0, 1200]
        assert not cnc.write_registers(1, claim, slave=1).isError()
        equal(cnc.read_holding_registers(18, count=2, slave=1).registers, [sequence, 0], "answer")
    equal(cnc.read_input_registers(18, count=1, slave=1).registers, [50], "FC4")
    assert not cnc.write_register(2, 51, slave=1).isError()
    # Two of its words changed between pymodbus 3.0 and 3.8.
    known = inspect.signature(cnc.readwrite_registers).parameters
    words = {"values" if "values" in known else "write_registers": [52], "slave" if "slave" in known else "unit": 1}
    both = cnc.readwrite_registers(read_address=18, read_count=2, write_address=2, **words)
    equal(both.registers, [52, 0], "FC23 writes, then reads")
    equal(cnc.write_register(18, 9, slave=1).exception_code, 2, "ACK_SEQ is not the CNC's")
    equal(cnc.read_coils(0, count=1, slave=1).exception_code, 1, "no coils here")
    equal(cnc.read_holding_registers(30, count=9, slave=1).exception_code, 2, "beyond the map")
    until(lambda: host.requests() == list(range(1, 53)), "52 requests in order")
    cnc.close()


def pymodbus_coil(program):
    from pymodbus.client import ModbusTcpClient
    with Host(program, "coil-and-index", "tcp") as host:
        cnc = ModbusTcpClient("127.0.0.1", port=host.port)
        assert cnc.connect()
        cnc.write_register(0, 0, slave=1)
        for sequence in range(1, 21):
            cnc.write_coil(0, True, slave=1)  # the coil overtakes its index
            equal(cnc.read_discrete_inputs(0, count=1, slave=1).bits[0], False, "not yet")
            cnc.write_register(0, sequence, slave=1)
            equal(cnc.read_discrete_inputs(0, count=1, slave=1).bits[0], True, "acknowledge")
            equal(cnc.read_input_registers(0, count=1, slave=1).registers, [sequence], "done")
            cnc.write_coils(0, [False], slave=1)
            equal(cnc.read_discrete_inputs(0, count=1, slave=1).bits[0], False, "released")
        cnc.close()


def pymodbus_as_cnc(program):
    """pymodbus is the CNC's server, our port its client."""
    from pymodbus.datastore import (ModbusSequentialDataBlock, ModbusServerContext,
                                    ModbusSlaveContext)
    from pymodbus.server import StartTcpServer
    words = ModbusSlaveContext(hr=ModbusSequentialDataBlock(1, [0] * 64))
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    context = ModbusServerContext(slaves=words, single=True)
    threading.Thread(target=StartTcpServer, daemon=True,
                     kwargs={"context": context, "address": ("127.0.0.1", port)}).start()
    with Host(program, "sequence-block", "mirrored", str(port)) as host:
        until(lambda: words.getValues(3, 28, 1) == [0x8000], "our words in the CNC")
        for sequence in range(1, 6):
            words.setValues(3, 1, [2, sequence])
            until(lambda: words.getValues(3, 18, 2) == [sequence, 0], f"ACK_SEQ {sequence}")
        equal(host.requests(), [1, 2, 3, 4, 5], "requests")
        beat = words.getValues(3, 16, 1)
        until(lambda: words.getValues(3, 16, 1) != beat, "DAEMON_HEARTBEAT")


def pymodbus_lane(program):
    from pymodbus.client import ModbusSerialClient, ModbusTcpClient
    with Host(program, "sequence-block", "tcp") as host:
        pymodbus_sequence_block(ModbusTcpClient("127.0.0.1", port=host.port), host)
    with SerialCable() as cable, Host(program, "sequence-block", "rtu", cable.ends[0]) as host:
        cnc = ModbusSerialClient(cable.ends[1], baudrate=115200, timeout=1)
        assert cnc.connect()
        until(lambda: not cnc.read_holding_registers(0, count=1, slave=1).isError(),
              "the first answer: a port forgets what came before silence")
        pymodbus_sequence_block(cnc, host)
    pymodbus_coil(program)
    pymodbus_as_cnc(program)


def main():
    program, lane = sys.argv[1:3]
    present = shutil.which("mbpoll") if lane == "mbpoll" else importlib.util.find_spec("pymodbus")
    if not present:
        may_skip = os.environ.get("AXISCAL_MAY_SKIP", "").split(",")
        print(f"{lane} is not installed (apt-get install mbpoll python3-pymodbus)")
        return 77 if lane in may_skip else 1
    {"mbpoll": mbpoll_lane, "pymodbus": pymodbus_lane}[lane](program)
    print(f"{lane}: all answers as they should be")
    return 0


sys.exit(main())
