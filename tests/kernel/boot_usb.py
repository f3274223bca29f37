"""USB instruments on the kernel's own usbfs and hidraw: a Dracal USBTenki by control requests, a
LabJack U6 by its bulk stream, a TEMPer by HID reports; two DS18B20 behind a DS9490R by ds2490 and
w1_therm. The TEMPer comes by three ways: our emulation on vhci_hcd, the kernel's own USB device side
on dummy_hcd, and uhid without any USB. A plain guest with udev, no systemd.

The checks run in their order on one station that never ends: what one of them breaks, it mends.
"""

import contextlib
import json
import os
import re
import sys
import time
from pathlib import Path

from guest import PROGRAMS, check, expect, load_modules, run, run_checks, start_udev, wait_until
from recorded import on_tape
from usb_station import LASER, LINKS, StreamsUndisturbed, Undisturbed, UsbStation, kernel_drivers

NAMES = ("air", "material", "ballbar")
WITH_CHECKSUM = ("air", "ballbar")  # a TEMPer has none
GONE = ("unavailable", "faulty")
VOLTS = -2.5  # at the U6's input; 1 mm stands for 10 V
CONTACTS = "contacts"
SENSORS = ("28-000000000001", "28-000000000002")
MOST_OF_CONTACTS = 3  # lines of one outage: two sensors go and come one after the other: one, both, one
ADAPTER = ("04fa", "2490")
LACKS = {  # whose configuration was cut within its last descriptor, as the log names it; the socket is the kernel's choice
    "air": r"USB 1781:0a98 serial number A10234 port \S+ shows no interface 0:",  # it has no endpoints
    "material": r"USB 413d:2107 port \S+ has no HID interface 1 that the kernel serves",  # its endpoint 0x82 is lost
    "ballbar": r"USB 0cd5:0006 port \S+ shows no endpoint 0x83:",  # the stream's
}
PACKET = 25  # samples in a transfer of the U6
BITS = 10  # of the DS18B20: 0.25 K, 0.19 s
CARRIERS = {"gadget": ("dummy-hcd", "TEMPer2_V3.7"), "uhid": ("uhid", "TEMPer2_V3.9")}  # the third is in all others
HIDAPI_LIBUSB = "/usr/lib/x86_64-linux-gnu/libhidapi-libusb.so.0"


class DirectStation(UsbStation):
    """Instruments without a terminal: they are devices of their own."""

    def __init__(self, only=(*NAMES, CONTACTS)):
        super().__init__()
        wires = {"air": ("usbtenki", {"called": "air", "serial": "A10234"}),
                 "material": ("temper", {"called": "material"}),
                 "ballbar": ("labjack-u6", {"called": "ballbar", "serial": "470012345", "volts": str(VOLTS)}),
                 CONTACTS: ("ds9490r", {"called": CONTACTS, "sensors": str(len(SENSORS)), "bits": str(BITS)})}
        drivers = {"air": {"driver": "dracal-usbtenki", "link": "usb:A10234"},
                   "material": {"driver": "temper", "link": "usb:any",
                                "channel": [{"channel": "probe temperature", "medium": "material"}]},
                   "ballbar": {"driver": "labjack-u6", "link": "usb:470012345", "scale_length": "1 mm"},
                   CONTACTS: {"driver": "ds18b20", "sensors": list(SENSORS), "poll_period": "500 ms",
                              "channel": [{"channel": f"contact {n}", "medium": "material"} for n in (1, 2)]}}
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
            for name, (carrier, firmware) in CARRIERS.items():
                self.wires[name] = ("temper", {"called": name, "carrier": carrier, "firmware": firmware, "plugged": "no"})
        if CONTACTS in only:
            self.station["axis"]["material"]["temperature"] += [f"{CONTACTS}/contact {n}" for n in (1, 2)]
            self.station["axis"]["air"]["oldest"] = "5 s"  # what grows old is seen to be no number
        self.station["instrument"] = list(instruments.values())

    def lines_of(self, name, since):
        """What the log says of one instrument since that line, without its changes of state."""
        lines = [line for line in self.logged()[since:] if f"{name}:" in line or f"{name} is " in line]
        print("\n".join(lines))
        return [line for line in lines if f"{name}:" in line]

    def changes_of(self, name, since):
        """Its changes of state: unavailable, perhaps faulty after it, available."""
        return [line for line in self.logged()[since:] if f" {name} is " in line]


@contextlib.contextmanager
def undisturbed(station, names):
    """All but these lose nothing. What the U6's buffer lost because this emulation stood still, the device
    says itself: the stream misses just that."""
    others = [one["name"] for one in station.station["instrument"] if one["name"] not in names]
    streams = [name for name in others if name == "ballbar"]
    with Undisturbed(station, *(name for name in others if name not in streams)), watched(station, streams):
        yield


def watched(station, streams):
    return StreamsUndisturbed(station, lambda: station.ask_usb("status")["devices"], *streams, told_within=PACKET)


def suffers(station, names, begin, end):
    """`begin` spoils the named instruments, all are given up, `end` mends them, all come back; all
    others lose nothing meanwhile. Each change of state is one line in the log; the reason is one more,
    however often it was met."""
    since = len(station.logged())
    with undisturbed(station, names):
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
        told_well = len(lines) == 1 if name != CONTACTS else len(lines) <= MOST_OF_CONTACTS
        expect(told_well, f"{name} is told {len(lines)} times: {lines}")
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
    station.wait_until_good("laser", *NAMES, CONTACTS, limit_s=30)
    # The truth moves by less than these within the test; scenarios/demo.toml, with each chip's step.
    air = station.scenario["air"]
    near("air temperature", station.value("air", "air temperature"), air["temperature"]["start"], 0.5)
    near("air pressure", station.value("air", "air pressure"), air["pressure_pa"]["start"], 100)
    near("air humidity", station.value("air", "air humidity"), air["humidity_percent"]["start"], 3)
    near("probe", station.value("material", "probe temperature"), station.scenario["thermal"]["material"]["start"], 0.5)
    # Half a count of 0.316 mV is 16 nm.
    near("ballbar", station.value("ballbar", "ballbar"), VOLTS * 1e-4, 2e-8)
    # Half of the sensors' step is 0.125 K.
    for n in (1, 2):
        near(f"contact {n}", station.value(CONTACTS, f"contact {n}"),
             station.scenario["thermal"]["material"]["start"], 0.5)
    expect(station.instrument("ballbar")["serial"] == "470012345", "another U6 was taken")
    print([(one["name"], one["model"], one["serial"], one["firmware"]) for one in station.status()["instruments"]])


@check("WhatIsPluggedInIsFoundWithoutOpeningIt")
def found(station):
    """By the command line, while the daemon measures with all of it."""
    told = json.loads(run(PROGRAMS / "axiscal", "devices", "--json", "--socket", station.socket, "--config",
                          station.folder / "station.toml"))
    known = {one["in_station"]: one for one in told["plugged"] if one["in_station"]}
    expect(set(known) == {"laser", "air", "material", CONTACTS}, f"known are {sorted(known)}")
    expect(known["air"]["usb"]["serial"] == "A10234", f"{known['air']}")
    expect(known["laser"]["kernel_driver"] == "cdc_acm", f"{known['laser']}")
    expect(known["material"]["node"].startswith("/dev/hidraw"), f"{known['material']}")
    expect(Path(known["material"]["node"]).group() == "axiscal", "the rules do not know the stick")
    expect(known[CONTACTS]["kernel_driver"] == "w1_therm", f"{known[CONTACTS]}")
    for one in known.values():
        expect(one["missing"] == [], f"{one}")
        expect(Path(one["node"]).exists(), f"{one}")
    # A U6 tells its number only when it is opened: ballbar and decoy differ by their sockets alone.
    bars = [one for one in told["plugged"] if one["usb"] and one["usb"]["id"] == "0cd5:0006"]
    expect(len(bars) == 2, f"{told['plugged']}")
    for one in bars:
        expect(one["in_station"] is None and one["could_be"][0]["driver"] == "labjack-u6", f"{one}")
        expect(one["may_be"] == ["ballbar"], f"{one}")
        expect('link = "usb-port:' in one["could_be"][0]["block"], f"{one}")


@check("BallbarStreamsAtOneKilohertzWithoutAGap")
def streams(station):
    """A gap is what the device itself skipped, or the kernel's and the driver's loss."""
    began = time.monotonic()
    with watched(station, ["ballbar"]):
        before = station.instrument("ballbar")["samples"]
        wait_until("two thousand samples more", lambda: station.instrument("ballbar")["samples"] >= before + 2000, 60)
    print(f"two thousand samples within {time.monotonic() - began:.1f} s; skipped by the device:",
          station.ask_usb("status")["devices"]["ballbar"]["skipped"])


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
    """The 1-Wire adapter, too: w1_therm reads nothing or zeros, at once."""
    spoilt(station, (*NAMES, CONTACTS), "stall")


@check("ShortTransfersAreNoReadings")
def cut(station):
    spoilt(station, NAMES, "cut 3")  # the shortest reading, of an SHT31, has four bytes


@check("WrongChecksumsOnUsbAreNoReadings")
def corrupt(station):
    before = {name: station.instrument(name)["checksum_errors"] for name in WITH_CHECKSUM}
    spoilt(station, WITH_CHECKSUM, "corrupt 4")
    for name in WITH_CHECKSUM:
        expect(station.instrument(name)["checksum_errors"] > before[name], f"{name} counts no wrong checksum")


@check("UsbInstrumentsWithDescriptorsCutShortAreNamedAndComeBack")
def cut_descriptors(station):
    """Their configuration ends within its last descriptor; the rest of them is whole, and the kernel shows the
    device. One line of the log says what it lacks, however often it is opened in vain."""
    since = len(station.logged())

    def says(name):
        return [line for line in station.logged()[since:] if f" {name}:" in line and re.search(LACKS[name], line)]

    with undisturbed(station, NAMES):
        try:
            station.replug(NAMES, "descriptors")
            for name in NAMES:
                wait_until(f"the log says what {name} lacks", lambda name=name: says(name))
                expect(station.state(name) in GONE, f"{name} is {station.state(name)}")
            restarts = {name: station.instrument(name)["restarts"] for name in NAMES}
            wait_until("each was tried again", lambda: all(station.instrument(name)["restarts"] > restarts[name] for name in NAMES))
            told = {name: says(name) for name in NAMES}
        finally:
            station.replug(NAMES, "none")
        station.wait_until_good(*NAMES)
    for name in NAMES:
        lines, changes = station.lines_of(name, since), station.changes_of(name, since)
        expect(len(told[name]) == 1, f"what {name} lacks is told {len(told[name])} times: {told[name]}")
        # That it is not plugged in: before, and once more between the wrong device and the right one.
        expect(len(lines) <= 3, f"{name} is told {len(lines)} times: {lines}")
        expect(changes[-1].endswith("is available.") and 2 <= len(changes) <= 3, f"{name} changed: {changes}")
    expect(station.instrument("ballbar")["serial"] == "470012345", "another U6 was taken")


def kernel_text(sensor):
    """What the kernel shows of a thermometer now; a reading of its own, beside the daemon's."""
    return Path(f"/sys/bus/w1/devices/{sensor}/w1_slave").read_text()


def no_number(station, trouble, channels, word):
    """The cable suffers, these channels lose their values, the others keep theirs; the log tells why, at
    most once a sensor. Once mended, all have values again. Gives back what the kernel showed of the first."""
    since = len(station.logged())
    mended = "mended" + (trouble[trouble.index(":"):] if ":" in trouble else "")
    with undisturbed(station, [CONTACTS]):
        station.usb(f"tell {CONTACTS} {trouble}")
        try:
            for n in channels:
                wait_until(f"contact {n} is no number", lambda n=n: station.value(CONTACTS, f"contact {n}") is None)
            wait_until(f"the note says {word}", lambda: word in station.instrument(CONTACTS)["note"])
            shown = kernel_text(SENSORS[channels[0] - 1])
            for n in {1, 2} - set(channels):
                expect(station.value(CONTACTS, f"contact {n}") is not None, f"contact {n} has no value either")
        finally:
            station.usb(f"tell {CONTACTS} {mended}")
        station.wait_until_good(CONTACTS)
    told = station.lines_of(CONTACTS, since)
    expect(1 <= len(told) <= len(channels) and word in told[0], f"that {word} is told {len(told)} times: {told}")
    print(shown)
    return shown


@check("PowerOnValueOfAThermometerIsNoNumber")
def power_on(station):
    """The kernel shows 85 degC, and a right checksum."""
    shown = no_number(station, "power-lost:2", [2], "85 degC")
    expect(" YES\n" in shown and shown.endswith("t=85000\n"), f"the kernel showed {shown!r}")


@check("WrongChecksumOnOneWireIsNoNumber")
def wrong_crc(station):
    """The kernel reads five times and then shows nothing; the last value grows old."""
    before = station.instrument(CONTACTS)["bad_frames"]
    shown = no_number(station, "wrong-crc:1", [1], "was read wrongly")
    expect(shown == "", f"the kernel showed {shown!r}")
    expect(station.instrument(CONTACTS)["bad_frames"] >= before + 3, "unread ones are not counted")


@check("ShortedOneWireCableIsNoNumber")
def shorted(station):
    """Zeros, whose checksum is right."""
    shown = no_number(station, "shorted", [1, 2], "all bytes are zero")
    expect(" YES\n" in shown and shown.endswith("t=0\n"), f"the kernel showed {shown!r}")


@check("OneWireAdapterThatSaysNakOrCutsItsAnswersIsGivenUpAndComesBack")
def adapter_spoilt(station):
    """ds2490 waits a second for each transfer and w1_therm tries five times: the file is read for as long."""
    for fault in ("mute", "cut 1"):
        since = len(station.logged())
        with undisturbed(station, [CONTACTS]):
            station.usb(f"fault {CONTACTS} {fault}")
            try:
                station.wait_for_state(CONTACTS, GONE)
                expect([station.value(CONTACTS, f"contact {n}") for n in (1, 2)] == [None, None], "a value outlived its sensor")
            finally:
                station.usb(f"fault {CONTACTS} none")
            mended = time.monotonic()
            station.wait_until_good(CONTACTS)
            print(f"{fault}: back after {time.monotonic() - mended:.1f} s")
        told, changes = station.lines_of(CONTACTS, since), station.changes_of(CONTACTS, since)
        expect(len(told) <= MOST_OF_CONTACTS, f"why it is gone is told {len(told)} times: {told}")
        expect(changes[-1].endswith("is available.") and 2 <= len(changes) <= 3, f"{changes}")


def without_adapter(station, take, give):
    """`take` robs the kernel of its 1-Wire, `give` brings it back: no value outlives it, one line tells, and all others lose
    nothing."""
    since = len(station.logged())
    with undisturbed(station, [CONTACTS]):
        try:
            take()
            station.wait_for_state(CONTACTS, GONE)
            expect([station.value(CONTACTS, f"contact {n}") for n in (1, 2)] == [None, None], "a value outlived its sensor")
        finally:
            give()
        wait_until("the kernel has found both again", lambda: all(Path(f"/sys/bus/w1/devices/{one}").exists() for one in SENSORS))
        station.wait_until_good(CONTACTS)
    # One of them may be missed while the other is still there, or there already.
    told = station.lines_of(CONTACTS, since)
    expect(sum("none of the sensors" in line for line in told) == 1 and len(told) <= 3, f"{told}")
    changes = station.changes_of(CONTACTS, since)
    expect(changes[-1].endswith("is available.") and 2 <= len(changes) <= 3, f"{changes}")


@check("UnpluggedOneWireAdapterIsUnavailableAndComesBack")
def adapter_unplugged(station):
    without_adapter(station, lambda: station.usb(f"unplug {CONTACTS}"), lambda: station.usb(f"plug {CONTACTS}"))


@check("OneWireAdapterWithBrokenDescriptorsIsRefusedByTheKernelAndComesBack")
def adapter_broken(station):
    """The last endpoint of its fourth setting is lost, the one that ds2490 chooses: it counts two where three belong."""
    def plug_broken():
        station.replug([CONTACTS], "descriptors")
        expect(kernel_drivers(ADAPTER) == [], f"half an adapter is served by {kernel_drivers(ADAPTER)}")
        expect(not list(Path("/sys/bus/w1/devices").glob("w1_bus_master*")), "the kernel made a 1-Wire of half an adapter")
        tried = station.instrument(CONTACTS)["restarts"]
        wait_until("it was tried again", lambda: station.instrument(CONTACTS)["restarts"] >= tried + 2)

    expect(kernel_drivers(ADAPTER) == ["DS9490R"], f"the adapter is served by {kernel_drivers(ADAPTER)}")
    without_adapter(station, plug_broken, lambda: station.replug([CONTACTS], "none"))
    expect(kernel_drivers(ADAPTER) == ["DS9490R"], f"the adapter is served by {kernel_drivers(ADAPTER)}")


def comes_by(station, name):
    """The TEMPer by another way in the place of the one on vhci_hcd: read, unplugged, back."""
    _, firmware = CARRIERS[name]
    station.usb("unplug material")
    station.wait_for_state("material", GONE)
    try:
        station.usb(f"plug {name}")
        station.wait_until_good("material")
        one = station.instrument("material")
        print(one["model"], one["firmware"], station.value("material", "probe temperature"))
        expect(one["firmware"] == firmware, f"another stick answers: {one}")
        near("probe", station.value("material", "probe temperature"),
             station.scenario["thermal"]["material"]["start"], 0.5)
        suffers(station, ["material"], lambda _: station.usb(f"unplug {name}"), lambda _: station.usb(f"plug {name}"))
    finally:
        station.usb(f"unplug {name}")
        station.usb("plug material")
    station.wait_until_good("material")


@check("TemperThatTheKernelItselfEmulatesIsReadAlike")
def gadget(station):
    """Descriptors, enumeration and class requests are the kernel's (libcomposite, usb_f_hid on
    dummy_hcd): what our emulation got wrong would show here."""
    comes_by(station, "gadget")


@check("TemperWithoutUsbIsReadByUhid")
def uhid(station):
    comes_by(station, "uhid")


@check("RecordingsByUsbfsHidrawAndOneWireGiveTheirDriversTheSameReadings")
def recorded(station):
    """Control requests, bulk stream, HID reports and the kernel's texts. Nobody starts the daemon again: the next station is another."""
    last = on_tape(station, {"air": "usb", "ballbar": "usb", "material": "hid", CONTACTS: "files"})
    material = station.scenario["thermal"]["material"]["start"]
    near("air temperature", last["air", "air temperature"], station.scenario["air"]["temperature"]["start"], 0.5)
    near("ballbar", last["ballbar", "ballbar"], VOLTS * 1e-4, 2e-8)
    near("probe", last["material", "probe temperature"], material, 0.5)
    for n in (1, 2):
        near(f"contact {n}", last[CONTACTS, f"contact {n}"], material, 0.5)


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
            comes_by(other, "gadget")
    finally:
        del os.environ["LD_PRELOAD"]


def main():
    load_modules("vhci_hcd", "cdc_acm", "ftdi_sio", "usbhid", "hid_generic", "ds2490", "w1_therm", "uhid", "dummy_hcd",
                 "usb_f_hid")
    run("mount", "-t", "configfs", "none", "/sys/kernel/config")
    start_udev()
    with DirectStation() as station:
        return run_checks(station)


sys.exit(main())
