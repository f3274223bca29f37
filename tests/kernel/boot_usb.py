"""USB instruments on the kernel's own usbfs and hidraw: a Dracal USBTenki by control requests, a
LabJack U6 by its bulk stream, a TEMPer by HID reports. A plain guest with udev, no systemd.

The checks run in their order on one station that never ends: what one of them breaks, it mends.
"""

import json
import os
import sys
import time
from pathlib import Path

from guest import PROGRAMS, check, expect, load_modules, run, run_checks, start_udev, wait_until
from usb_station import LASER, LINKS, Undisturbed, UsbStation

NAMES = ("air", "material", "ballbar")
WITH_CHECKSUM = ("air", "ballbar")  # a TEMPer has none
GONE = ("unavailable", "faulty")
VOLTS = -2.5  # at the U6's input; 1 mm stands for 10 V
HIDAPI_LIBUSB = "/usr/lib/x86_64-linux-gnu/libhidapi-libusb.so.0"


class DirectStation(UsbStation):
    """Instruments without a terminal: they are devices of their own."""

    def __init__(self, only=NAMES):
        super().__init__()
        wires = {"air": ("usbtenki", {"called": "air", "serial": "A10234"}),
                 "material": ("temper", {"called": "material"}),
                 "ballbar": ("labjack-u6", {"called": "ballbar", "serial": "470012345", "volts": str(VOLTS)})}
        drivers = {"air": {"driver": "dracal-usbtenki", "link": "usb:A10234"},
                   "material": {"driver": "temper", "link": "usb:any",
                                "channel": [{"channel": "probe temperature", "medium": "material"}]},
                   "ballbar": {"driver": "labjack-u6", "link": "usb:470012345", "scale_length": "1 mm"}}
        self.names = only
        instruments = {one["name"]: one for one in self.station["instrument"]}
        for name in only:
            instruments[name] = {"name": name, **drivers[name]}
            self.wires[name] = wires[name]
            self.links.pop(name, None)
        if "ballbar" in only:
            # Another U6, plugged in first: only the serial number tells which one is meant.
            decoy = {"decoy": ("labjack-u6", {"called": "decoy", "serial": "470099999", "volts": "5"})}
            self.wires = {**decoy, **self.wires}
            self.station["ballbar"] = {"sensor": "ballbar/ballbar"}
        if "material" in only:
            self.station["axis"]["material"]["temperature"] = ["material/probe temperature"]
        self.station["instrument"] = list(instruments.values())

    def value(self, instrument, channel):
        return next(c["value"] for c in self.status()["channels"]
                    if c["instrument"] == instrument and c["channel"] == channel)

    def lines_of(self, name, since):
        """What the log says of one instrument since that line, without its changes of state."""
        lines = [line for line in self.logged()[since:] if f"{name}:" in line or f"{name} is " in line]
        print("\n".join(lines))
        return [line for line in lines if f"{name}:" in line]

    def changes_of(self, name, since):
        """Its changes of state: unavailable, perhaps faulty after it, available."""
        return [line for line in self.logged()[since:] if f" {name} is " in line]


def suffers(station, names, begin, end):
    """`begin` spoils the named instruments, all are given up, `end` mends them, all come back; the
    laser loses nothing meanwhile. Each change of state is one line in the log; the reason is one more,
    however often it was met."""
    since = len(station.logged())
    with Undisturbed(station, "laser"):
        for name in names:
            begin(name)
        for name in names:
            station.wait_for_state(name, GONE)
        mended = time.monotonic()
        for name in names:
            end(name)
        station.wait_until_good(*names)
        print(f"back after {time.monotonic() - mended:.1f} s")
    for name in names:
        lines = station.lines_of(name, since)
        expect(len(lines) == 1, f"{name} is told {len(lines)} times: {lines}")
        changes = station.changes_of(name, since)
        expect(changes[-1].endswith("is available.") and 2 <= len(changes) <= 3, f"{name} changed: {changes}")


def spoilt(station, names, fault):
    suffers(station, names, lambda name: station.usb(f"fault {name} {fault}"),
            lambda name: station.usb(f"fault {name} none"))


def near(what, value, expected, within):
    expect(value is not None and abs(value - expected) <= within, f"{what} is {value}, not {expected} +- {within}")


@check("StationReadsUsbInstrumentsByControlBulkAndHid")
def reads(station):
    station.start()
    station.wait_until_good("laser", *NAMES, limit_s=30)
    # The truth moves by less than these within the test; scenarios/demo.toml, with each chip's step.
    air = station.scenario["air"]
    near("air temperature", station.value("air", "air temperature"), air["temperature"]["start"], 0.5)
    near("air pressure", station.value("air", "air pressure"), air["pressure_pa"]["start"], 100)
    near("air humidity", station.value("air", "air humidity"), air["humidity_percent"]["start"], 3)
    near("probe", station.value("material", "probe temperature"), station.scenario["thermal"]["material"]["start"], 0.5)
    # Half a count of 0.316 mV is 16 nm.
    near("ballbar", station.value("ballbar", "ballbar"), VOLTS * 1e-4, 2e-8)
    expect(station.instrument("ballbar")["serial"] == "470012345", "another U6 was taken")
    print([(one["name"], one["model"], one["serial"], one["firmware"]) for one in station.status()["instruments"]])


@check("WhatIsPluggedInIsFoundWithoutOpeningIt")
def found(station):
    """By the command line, while the daemon measures with all of it."""
    told = json.loads(run(PROGRAMS / "axiscal", "devices", "--json", "--socket", station.socket, "--config",
                          station.folder / "station.toml"))
    known = {one["in_station"]: one for one in told["plugged"] if one["in_station"]}
    expect(set(known) == {"laser", "air", "material"}, f"known are {sorted(known)}")
    expect(known["air"]["usb"]["serial"] == "A10234", f"{known['air']}")
    expect(known["laser"]["kernel_driver"] == "cdc_acm", f"{known['laser']}")
    expect(known["material"]["node"].startswith("/dev/hidraw"), f"{known['material']}")
    for one in known.values():
        expect(one["missing"] == [], f"{one}")
        expect(Path(one["node"]).exists(), f"{one}")
    # A U6 tells its number only when it is opened: ballbar and decoy differ by their sockets alone.
    bars = [one for one in told["plugged"] if one["usb"] and one["usb"]["id"] == "0cd5:0006"]
    expect(len(bars) == 2, f"{told['plugged']}")
    for one in bars:
        expect(one["in_station"] is None and one["could_be"][0]["driver"] == "labjack-u6", f"{one}")
        expect('link = "usb-port:' in one["could_be"][0]["block"], f"{one}")


@check("BallbarStreamsAtOneKilohertzWithoutAGap")
def streams(station):
    """Emulation beside other work may be too slow for the stream for a while; the device then says
    so and the samples are counted as lost. A driver that loses packets loses them in every part."""
    parts = []
    for _ in range(20):
        before = station.instrument("ballbar")
        began = time.monotonic()
        wait_until("two thousand samples more", lambda: station.instrument("ballbar")["samples"] >= before["samples"] + 2000, 60)
        after = station.instrument("ballbar")
        lost = {key: after[key] - before[key] for key in ("gaps", "lost_records", "checksum_errors", "bad_frames", "restarts")}
        parts.append((after["samples"] - before["samples"], round(time.monotonic() - began, 1), lost))
        if not any(lost.values()):
            break
    print("\n".join(map(str, parts)))
    expect(not any(parts[-1][2].values()), "no part of the stream was without a loss")


@check("UnpluggedUsbInstrumentsAreUnavailableAndComeBackBySerialNumber")
def unplugged(station):
    for name in NAMES:
        suffers(station, [name], lambda name: station.usb(f"unplug {name}"), lambda name: station.usb(f"plug {name}"))
    expect(station.instrument("ballbar")["serial"] == "470012345", "another U6 was taken")
    near("ballbar", station.value("ballbar", "ballbar"), VOLTS * 1e-4, 2e-8)


@check("UsbInstrumentsUnpluggedAtOnceComeBack")
def all_unplugged(station):
    suffers(station, NAMES, lambda name: station.usb(f"unplug {name}"), lambda name: station.usb(f"plug {name}"))


@check("UsbInstrumentsThatSayNakForEverAreGivenUpAndComeBack")
def mute(station):
    spoilt(station, NAMES, "mute")


@check("UsbInstrumentsThatStallAreGivenUpAndComeBack")
def stall(station):
    spoilt(station, NAMES, "stall")


@check("ShortTransfersAreNoReadings")
def cut(station):
    spoilt(station, NAMES, "cut 3")  # the shortest reading, of an SHT31, has four bytes


@check("WrongChecksumsOnUsbAreNoReadings")
def corrupt(station):
    before = {name: station.instrument(name)["checksum_errors"] for name in WITH_CHECKSUM}
    spoilt(station, WITH_CHECKSUM, "corrupt 4")
    for name in WITH_CHECKSUM:
        expect(station.instrument(name)["checksum_errors"] > before[name], f"{name} counts no wrong checksum")


@check("TemperIsReadByHidapiOverLibusbToo")
def libusb_back_end(station):
    """The same library calls, served by libusb instead of hidraw. A station of its own: the other
    libusb instruments tell libusb to discover nothing, which that back end needs."""
    for name in list(station.processes):
        station.end(name)
    os.environ["LD_PRELOAD"] = HIDAPI_LIBUSB
    try:
        with DirectStation(only=("material",)) as other:
            other.start()
            other.wait_until_good("laser", "material", limit_s=30)
            maps = open(f"/proc/{other.processes['axiscald'].pid}/maps", encoding="utf-8").read()
            expect("libhidapi-libusb" in maps, "the other back end is not there")
            near("probe", other.value("material", "probe temperature"),
                 other.scenario["thermal"]["material"]["start"], 0.5)
            suffers(other, ["material"], lambda name: other.usb(f"unplug {name}"),
                    lambda name: other.usb(f"plug {name}"))
    finally:
        del os.environ["LD_PRELOAD"]


def main():
    load_modules("vhci_hcd", "cdc_acm", "ftdi_sio", "usbhid", "hid_generic")
    start_udev()
    with DirectStation() as station:
        return run_checks(station)


sys.exit(main())
