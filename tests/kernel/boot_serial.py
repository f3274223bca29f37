"""Serial instruments on the kernel's own drivers: the µMD counter and a Dracal stick by cdc_acm, a
Modbus sensor by ftdi_sio, behind udev's names. A plain guest with udev, no systemd.

The checks run in their order on one station that never ends: what one of them breaks, it mends.
"""

import contextlib
import os
import sys
from pathlib import Path

from guest import check, expect, load_modules, run_checks, start_udev, wait_until
from usb_station import LINKS, Undisturbed, UsbStation

SENSORS = ("air", "material")
GONE = ("unavailable", "faulty")


def told(station, name, since):
    """What the log says of one instrument since that line, without its changes of state."""
    lines = [line for line in station.logged()[since:] if f"{name}:" in line or f"{name} is " in line]
    print("\n".join(lines))
    return [line for line in lines if f"{name}:" in line]


def suffers(station, names, begin, end, others):
    """`begin` spoils the named instruments, all of them are given up, `end` mends them, all come
    back; the others lose nothing meanwhile. The log says once that each is gone, and each reason once
    at most (the same one again is only counted): silent, then not to be opened either."""
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
        expect(len(reasons) == len(sentences) <= 2, f"why {name} is gone is told {len(reasons)} times: {reasons}")


def unplugged(station, names, others):
    nodes = {name: os.path.realpath(LINKS[name]) for name in names}

    def plug(name):
        station.usb(f"plug {name}")
        wait_until(f"udev made {LINKS[name]} again", Path(LINKS[name]).exists)

    suffers(station, names, lambda name: station.usb(f"unplug {name}"), plug, others)
    back = {name: os.path.realpath(LINKS[name]) for name in names}
    expect(back == nodes, f"a dead descriptor held its node: {nodes} came back as {back}")


def spoilt(station, names, fault, others):
    suffers(station, names, lambda name: station.usb(f"fault {name} {fault}"),
            lambda name: station.usb(f"fault {name} none"), others)


@check("StationReadsInstrumentsThroughTheKernelsDrivers")
def reads(station):
    station.start()
    station.wait_until_good(*LINKS, limit_s=30)
    expect([line for line in station.logged() if "laser:" in line] == [], "a fresh station complains")
    print({name: os.path.realpath(link) for name, link in LINKS.items()})


@check("UnpluggedCounterIsUnavailableAndComesBack")
def laser_unplugged(station):
    unplugged(station, ["laser"], SENSORS)


@check("UnpluggedSensorsAreUnavailableAndComeBack")
def sensors_unplugged(station):
    unplugged(station, SENSORS, ["laser"])


@check("CounterThatSaysNakForEverIsGivenUpAndComesBack")
def laser_mute(station):
    spoilt(station, ["laser"], "mute", SENSORS)


@check("SensorsThatSayNakForEverAreGivenUpAndComeBack")
def sensors_mute(station):
    spoilt(station, SENSORS, "mute", ["laser"])


@check("ShortReadsOfTheCounterAreNoRecords")
def laser_cut(station):
    spoilt(station, ["laser"], "cut 3", SENSORS)


@check("GarbledRecordsOfTheCounterAreCountedAndNeverRead")
def laser_garbled(station):
    """A bit above ASCII in each transfer: what stands between is read, and its gaps are counted."""
    before = station.instrument("laser")
    with Undisturbed(station, *SENSORS):
        station.usb("fault laser corrupt 128")
        wait_until("garbled records are counted",
                   lambda: station.instrument("laser")["bad_frames"] > before["bad_frames"] + 100)
        station.usb("fault laser none")
    station.wait_until_good("laser")
    after = station.instrument("laser")
    expect(after["lost_records"] > before["lost_records"], f"no gap is counted: {after}")
    expect(after["restarts"] == before["restarts"], "a garbled record ended the connection")


@check("OneWrongBitFailsTheSensorsChecksums")
def sensors_corrupt(station):
    before = {name: station.instrument(name)["checksum_errors"] for name in SENSORS}
    spoilt(station, SENSORS, "corrupt 1", ["laser"])
    for name in SENSORS:
        expect(station.instrument(name)["checksum_errors"] > before[name], f"{name} counts no wrong checksum")


@check("StalledSensorsAreGivenUpAndComeBack")
def sensors_stalled(station):
    spoilt(station, SENSORS, "stall", ["laser"])


@check("NodeThatComesBackUnderAnotherNumberIsFoundByItsName")
def renamed(station):
    """Another program holds the dead node, so that the kernel gives the next number."""
    node = os.path.realpath(LINKS["air"])
    holder = os.open(node, os.O_RDONLY | os.O_NOCTTY | os.O_NONBLOCK)
    try:
        with Undisturbed(station, "laser", "material"):
            station.usb("unplug air")
            station.wait_for_state("air", GONE)
            station.usb("plug air")
            wait_until(f"udev made {LINKS['air']} again", Path(LINKS["air"]).exists)
            expect(os.path.realpath(LINKS["air"]) != node, f"{node} was free after all")
            station.wait_until_good("air")
    finally:
        os.close(holder)


@check("DeviceWithBrokenDescriptorsStaysUnavailable")
def broken_descriptors(station):
    with Undisturbed(station, "laser", "material"):
        station.usb("fault air descriptors")
        station.usb("unplug air")
        station.wait_for_state("air", GONE)
        station.usb("plug air")
        wait_until("the kernel has seen the device", lambda: "descriptor" in os.popen("dmesg | tail -n 20").read())
        expect(not Path(LINKS["air"]).exists(), "the kernel made a terminal of half a configuration")
        expect(station.state("air") in GONE, station.state("air"))
        station.usb("unplug air")
        station.usb("fault air none")
        station.usb("plug air")
        wait_until(f"udev made {LINKS['air']} again", Path(LINKS["air"]).exists)
        station.wait_until_good("air")


@check("LongLatencyTimerOfAnFtdiAdapterIsToldOnce")
def latency(station):
    """The rules set 1 ms; here somebody undid that before the start."""
    station.end("axiscald")
    station.end("usb")
    station.rewire("laser", "ftdi", {"called": "laser", "serial": "A700AXIS"}, "/dev/axiscal/ftdi-A700AXIS-00")
    station.start_usb()
    node = Path(os.path.realpath(station.links["laser"])).name
    timer = Path(f"/sys/bus/usb-serial/devices/{node}/latency_timer")
    wait_until("the rules have set 1 ms", lambda: timer.read_text().strip() == "1")
    timer.write_text("16")
    expect(station.ask_usb("status")["devices"]["laser"]["state"] == "latency timer 16 ms", "the adapter was not told")
    station.write_station()
    station.start_daemon()
    station.wait_until_good("laser", limit_s=30)
    lines = [line for line in station.logged() if "holds bytes back" in line]
    print(lines)
    expect(len(lines) == 1 and "16 ms instead of 1 ms" in lines[0], f"{station.logged()}")
    expect(station.instrument("laser")["lost_records"] == 0, "records were lost on the way")


def main():
    load_modules("vhci_hcd", "cdc_acm", "ftdi_sio")
    start_udev()
    with UsbStation() as station:
        return run_checks(station)


sys.exit(main())
