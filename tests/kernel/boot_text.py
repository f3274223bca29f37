"""Serial instruments that answer text, each by an FTDI adapter on the kernel's ftdi_sio, beside a counter and two
sensors that must not notice; at last an HPI-3D in the counter's place. A plain guest with udev, no systemd.

The checks run in their order on one station that never ends: what one of them breaks, it mends. The last one has a
station of its own.
"""

import sys
from pathlib import Path

from guest import check, expect, load_modules, run_checks, start_udev, wait_until
from line_station import GONE, SENSORS, TEXT, LineStation, spoilt, suffers, unplugged
from usb_station import LINKS

EIGHT_BIT, SEVEN_BIT = ("ptu", "gauge"), ("readout", "caliper")  # which bit no character of theirs has
FTDI = ("material", *TEXT)


@check("StationReadsTextInstrumentsThroughTheKernelsDrivers")
def reads(station):
    station.start()
    station.wait_until_good(*LINKS, *TEXT, limit_s=30)
    complaints = [line for line in station.logged() if any(f" {name}:" in line for name in TEXT)]
    expect(complaints == [], f"a fresh station complains: {complaints}")


@check("OptoHeadOfASylvacGetsItsPowerFromTheModemLines")
def powered(station):
    """DTR high and RTS low; the kernel itself raises both when it opens a line."""
    for name in TEXT:
        levels = "DTR high, RTS low" if name == "caliper" else "DTR high, RTS high"
        expect(station.adapter(name).endswith(levels), f"{name}: {station.adapter(name)}")


@check("AdaptersOfFtdiWithBrokenDescriptorsAreUnavailableAndComeBack")
def broken_adapters(station):
    """Without the half of its last endpoint an adapter has none to write to. ftdi_sio makes a terminal of it all the
    same, which opens, and refuses each write with ENODEV."""
    since, restarts = len(station.logged()), {}

    def refused(name):
        return [line for line in station.logged()[since:] if f" {name}:" in line and "No such device" in line
                and "No such device or" not in line]

    def plug_broken(name):
        station.replug([name], "descriptors")
        wait_until(f"udev made {station.links[name]} of half a configuration", Path(station.links[name]).exists)
        restarts[name] = station.instrument(name)["restarts"]

    def plug_whole(name):
        try:
            wait_until(f"{name} was tried again", lambda: station.instrument(name)["restarts"] >= restarts[name] + 2)
            wait_until(f"the log says that nothing can be written to {name}", lambda: refused(name))
            expect(station.state(name) in GONE, f"{name} is {station.state(name)} behind half an adapter")
        finally:
            station.replug([name], "none")
            wait_until(f"udev made {station.links[name]} again", Path(station.links[name]).exists)

    # Its end, what cannot be written, and that it is not there between the wrong adapter and the right one.
    suffers(station, FTDI, plug_broken, plug_whole, ["laser", "air"], most_reasons=3)
    for name in FTDI:
        expect(len(refused(name)) == 1, f"that nothing can be written to {name} is told {len(refused(name))} times")


@check("UnpluggedTextInstrumentsAreUnavailableAndComeBack")
def text_unplugged(station):
    unplugged(station, TEXT, LINKS)


@check("TextInstrumentsThatSayNakForEverAreGivenUpAndComeBack")
def text_mute(station):
    spoilt(station, TEXT, "mute", LINKS)


@check("StalledTextInstrumentsAreGivenUpAndComeBack")
def text_stalled(station):
    """ftdi_sio reads no more until the line is opened anew. A Vaisala that says nothing is told its settings
    and asked once, 2 s; after a pause it is told them again, 1 s."""
    spoilt(station, TEXT, "stall", LINKS)


@check("TextThatIsCutShortIsNoReading")
def text_cut(station):
    spoilt(station, TEXT, "cut 3", LINKS)  # two of the three are the adapter's status


@check("GarbledTextIsNoReading")
def text_garbled(station):
    """A bit above ASCII, for a gauge and the stick send no checksum; with seven data bits the highest of them,
    which no digit has. Of the stick's two lines in a transfer one stays whole and is read."""
    spoilt(station, EIGHT_BIT, "corrupt 128", LINKS)
    before = {name: station.instrument(name)["bad_frames"] for name in SEVEN_BIT}
    spoilt(station, SEVEN_BIT, "corrupt 64", LINKS)
    for name in SEVEN_BIT:
        expect(station.instrument(name)["bad_frames"] > before[name], f"{name} counts no bad frame")
    before = station.instrument("stick")["bad_frames"]
    station.usb("fault stick corrupt 128")
    wait_until("the stick's damaged lines are counted", lambda: station.instrument("stick")["bad_frames"] >= before + 3)
    station.usb("fault stick none")
    station.wait_until_good("stick")


class HpiStation(LineStation):
    """Its laser is an HPI-3D behind an adapter of its own."""

    SERIAL = "A620AXIS"

    def __init__(self):
        super().__init__()
        counter = self.scenario["laser"]
        self.scenario["laser"] = {"kind": "hpi-3d", **{key: counter[key] for key in (
            "path", "wavelength_nm", "dead_path_mm", "zero_mm")}, "fold": 2}
        self.rewire("laser", "ftdi", {"called": "laser", "serial": self.SERIAL}, f"/dev/axiscal/ftdi-{self.SERIAL}-00")
        laser = next(one for one in self.station["instrument"] if one["name"] == "laser")
        link = laser["link"]
        laser.clear()
        laser.update({"name": "laser", "driver": "lasertex", "link": link, "position": "raw",
                      "wavelength": f"{counter['wavelength_nm']} nm", "fastest": "40 m/min"})


@check("HpiLaserUnpluggedMuteAndStalledIsGivenUpAndComesBack")
def hpi(station):
    for program in ("axiscald", "usb", "axiscal-simulate"):
        station.end(program)
    with HpiStation() as other:
        other.start()
        other.wait_until_good(*LINKS, limit_s=30)
        unplugged(other, ["laser"], SENSORS)
        spoilt(other, ["laser"], "mute", SENSORS)
        spoilt(other, ["laser"], "stall", SENSORS)
        spoilt(other, ["laser"], "cut 3", SENSORS)


def main():
    load_modules("vhci_hcd", "ftdi_sio", "cdc_acm")
    start_udev()
    with LineStation(*TEXT) as station:
        return run_checks(station)


sys.exit(main())
