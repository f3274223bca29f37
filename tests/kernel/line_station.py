"""A station of serial instruments on the kernel's own drivers, and what is done to them in each boot that has
them. Those that answer text sit behind an FTDI adapter each; a scale is read by a counter's records, which come by
a named pipe; the CNC, a Modbus RTU client on libmodbus, asks on a line of its own."""

import contextlib
import os
from pathlib import Path

from counter_pipe import CounterPipe
from guest import expect, wait_until
from usb_station import LINKS, Undisturbed, UsbStation

SENSORS = ("air", "material")
TEXT = {  # name: what stands in the station file, what the simulator has behind the adapter, the adapter
    "ptu": ({"driver": "vaisala", "model": "ptu300"}, "vaisala", "A601AXIS"),
    "gauge": ({"driver": "ascii-gauge", "model": "mitutoyo", "unit": "mm"}, "mitutoyo", "A602AXIS"),
    "stick": ({"driver": "temper-serial"}, "temper-serial", "A603AXIS"),
    "readout": ({"driver": "ascii-gauge", "model": "nd-28x"}, "nd-28x", "A604AXIS"),
    "caliper": ({"driver": "ascii-gauge", "model": "sylvac"}, "sylvac", "A605AXIS"),
}
SCALE = "scale"
COUNT = 123456
CNC_LINE = "/dev/axiscal/ftdi-A800AXIS-00"
GONE = ("unavailable", "faulty")


class LineStation(UsbStation):
    """With these of the instruments that answer text."""

    def __init__(self, *text):
        super().__init__()
        for name in text:
            keys, kind, serial = TEXT[name]
            self.scenario["sensor"].append({"name": name, "kind": kind, "path": str(self.folder / f"{name}.tty")})
            self.wires[name] = ("ftdi", {"called": name, "serial": serial})
            self.links[name] = f"/dev/axiscal/ftdi-{serial}-00"
            self.station["instrument"].append({"name": name, **keys, "link": "serial:" + self.links[name]})

    def add_scale(self):
        self.counter = CounterPipe(self.folder / "counter0", COUNT)
        self.station["instrument"].append(
            {"name": SCALE, "driver": "counter", "device": str(self.counter.path), "event": "capture", "bits": 32,
             "resolution": "0.1 um", "fastest": "40 m/min", "silence": "2 s"})

    def add_trigger_line(self):
        self.trigger("sequence-block", "rtu")
        self.station["trigger"]["serial_port"] = CNC_LINE
        self.scenario["cnc"]["poll_s"] = 0.05  # emulation beside other work
        # The part program waits for an answer as long as a capture may last, and 2 s.
        self.station["capture"]["timeout"] = "30 s"
        self.wires["cnc"] = ("ftdi", {"called": "cnc", "serial": "A800AXIS"})
        self.links["cnc"] = CNC_LINE

    def line_notes(self, since):
        lines = [line for line in self.logged()[since:] if CNC_LINE in line]
        print("\n".join(lines))
        return lines

    def requested(self):
        return self.sim("status")["requests"]

    def adapter(self, name):
        """What its adapter says that the host has set."""
        return self.ask_usb("status")["devices"][name]["state"]

    def go_on_until(self, requests):
        """The CNC moves and asks until it has asked so often; then it stands still."""
        self.sim(f"hold {requests}")

    def captured(self, points):
        """So many points are durable, the CNC has read so of the last one, and nothing was taken twice."""
        self.wait_for_points(points)
        wait_until(f"the CNC reads done = {points}", lambda: self.sim("status")["done"] == points)
        expect(self.run()["step"] == points, f"{self.run()['step']} points of {points} requests")


def told(station, name, since):
    """What the log says of one instrument since that line, without its changes of state."""
    lines = [line for line in station.logged()[since:] if f"{name}:" in line or f"{name} is " in line]
    print("\n".join(lines))
    return [line for line in lines if f"{name}:" in line]


def suffers(station, names, begin, end, others, most_reasons=1):
    """`begin` spoils the named instruments, all of them are given up, `end` mends them, all come
    back within 5 s; the others lose nothing meanwhile. The log says once that each is gone, and once why at most:
    what a driver finds itself; that nothing good came for ten seconds is in the state. `most_reasons`: of
    several faults one after the other."""
    since = len(station.logged())
    with contextlib.ExitStack() as mending:
        with Undisturbed(station, *others):
            for name in names:
                mending.callback(end, name)
                begin(name)
            for name in names:
                station.wait_for_state(name, GONE)
            mending.close()
            station.wait_until_good(*names)
    for name in names:
        reasons = told(station, name, since)
        gone = [line for line in station.logged()[since:] if any(f"{name} is {state}" in line for state in GONE)]
        expect(len(gone) == 1, f"that {name} is gone is told {len(gone)} times: {gone}")
        sentences = {line.split("info: ")[1] for line in reasons}
        expect(len(reasons) == len(sentences) <= most_reasons, f"why {name} is gone is told {len(reasons)} times: {reasons}")


def unplugged(station, names, others):
    links = [station.links[name] for name in names]
    nodes = {os.path.realpath(link) for link in links}

    def plug(name):
        station.usb(f"plug {name}")
        wait_until(f"udev made {station.links[name]} again", Path(station.links[name]).exists)

    suffers(station, names, lambda name: station.usb(f"unplug {name}"), plug, others)
    back = {os.path.realpath(link) for link in links}
    expect(back == nodes, f"a dead descriptor held its node: {nodes} came back as {back}")


def spoilt(station, names, fault, others, **more):
    suffers(station, names, lambda name: station.usb(f"fault {name} {fault}"),
            lambda name: station.usb(f"fault {name} none"), others, **more)
