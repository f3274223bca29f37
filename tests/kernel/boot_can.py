"""Instruments on CAN buses of the guest's own kernel: two transducers at 1 kHz and eight thermometers on a
vcan, a transducer and a thermometer behind a USB adapter (gs_usb); an IDS3010 and a Modbus sensor on the
guest's own TCP. A plain guest with udev, no systemd.

The checks run in their order on one station that never ends: what one of them breaks, it mends.
"""

import contextlib
import json
import os
import re
import signal
import sys
import time
from pathlib import Path

from guest import SOURCE, check, expect, load_modules, run, run_checks, start_udev, wait_until
from recorded import on_tape
from tcp_cable import TcpCable
from usb_station import Commands, StreamsUndisturbed, Undisturbed, UsbStation, channels_of

BUS = "vcan0"
GONE = ("unavailable", "faulty")
BARS = {"ballbar": (127, 3.0), "gauge": (126, -1.5)}  # node, mm
PROBES = {f"probe-{n}": 10 + n for n in range(1, 9)}
ALL = (*BARS, *PROBES)
ADAPTER_BUS = "can0"
FAR = {"far-bar": ("canopen-406", 127), "far-probe": ("canopen-404", 125)}  # behind the adapter
STREAMS = (*BARS, "far-bar")  # whose samples are numbered, so that a missing one shows
NETWORK = {  # behind a TcpCable each
    "ids": {"driver": "ids3010", "air": "corrected here", "wavelength": "1530 nm", "fastest": "40 m/min", "poll_period": "50 ms"},
    "indigo": {"driver": "modbus", "profile": str(SOURCE / "config/profiles/vaisala-indigo.toml")},
}
EVERYBODY = ("laser", "air", *ALL, *FAR, *NETWORK)
TOLD_WITHIN = 32  # frames: after so many the driver tells what a device skipped
FLOOD_HZ = 4000  # with the stream about what 1 Mbit/s can carry


class CanStation(UsbStation):
    """The laser and the air on pseudo terminals, all else on the bus."""

    def __init__(self):
        super().__init__()
        self.wires, self.links = {"adapter": ("gs-usb", {"called": "adapter", "mm": "2.5"})}, {}
        kept = [one for one in self.station["instrument"] if one["name"] in ("laser", "air")]
        for one in kept:
            part = next(p for p in [self.scenario["laser"], *self.scenario["sensor"]] if one["name"] in (p.get("name"), "laser"))
            one["link"] = "serial:" + part["path"]
        for name, (node, _) in BARS.items():
            kept.append({"name": name, "driver": "canopen-406", "link": f"can:{BUS}", "node": node})
        for name, node in PROBES.items():
            kept.append({"name": name, "driver": "canopen-404", "link": f"can:{BUS}", "node": node,
                         "channel": [{"channel": "contact 1", "medium": "material"}]})
        for name, (driver, node) in FAR.items():
            kept.append({"name": name, "driver": driver, "link": f"can:{ADAPTER_BUS}", "node": node, "sample_period": "20 ms"})
        self.cables = {name: TcpCable() for name in NETWORK}
        for name, keys in NETWORK.items():
            kept.append({"name": name, **keys, "link": f"tcp:127.0.0.1:{self.cables[name].port}"})
        self.station["instrument"] = kept
        self.station["axis"]["material"]["temperature"] = [f"{name}/contact 1" for name in PROBES]
        self.station["ballbar"] = {"sensor": "ballbar/ballbar"}

    def start_usb(self):
        super().start_usb()
        set_up_adapter()
        self.start_can()
        self.start_network()

    def start_beside(self, called, *words):
        """Another axiscal-simulate than the world's; gives back what it says of its places."""
        world = self.processes.pop("axiscal-simulate")
        log = self.spawn("axiscal-simulate", *words)
        line = self.wait_for_line("axiscal-simulate", log, '"ready":true')
        self.processes[called] = self.processes.pop("axiscal-simulate")
        self.processes["axiscal-simulate"] = world
        return json.loads(line)

    def start_network(self):
        laser = {key: self.scenario["laser"][key] for key in ("dead_path_mm", "zero_mm")}
        scenario = {**self.scenario, "laser": {"kind": "ids3010", "wavelength_nm": 1530.0, "fold": 2, **laser},
                    "sensor": [{"name": "indigo", "kind": "vaisala-hmp", "unit": 241}],
                    "cnc": {"shape": "sequence-block", "transport": "server", "port": 0}}
        path = self.folder / "network.json"
        path.write_text(json.dumps(scenario))
        places = self.start_beside("network", "--scenario", path, "--control", self.folder / "network.sock")
        self.cables["ids"].lead_to(places["sensors"]["laser"]["port"])
        self.cables["indigo"].lead_to(places["sensors"]["indigo"]["port"])

    def start_can(self):
        words = ["can", "--scenario", self.folder / "scenario.json", "--interface", BUS, "--control", self.folder / "can.sock"]
        for name, (node, mm) in BARS.items():
            words += ["--device", f"temposonics,called={name},node={node},mm={mm}"]
        for name, node in PROBES.items():
            words += ["--device", f"cantrans,called={name},node={node}"]
        self.start_beside("can", *words)

    def can(self, command):
        Commands(self.folder / "can.sock").do(command)

    def can_status(self):
        return Commands(self.folder / "can.sock").ask("status")

    def stream_devices(self):
        """As can_status()'s devices, and the transducer behind the adapter, of which the adapter tells."""
        far = re.search(rf"node {FAR['far-bar'][1]} skipped (\d+)", self.ask_usb("status")["devices"]["adapter"]["state"])
        return {**self.can_status()["devices"], "far-bar": {"skipped": int(far[1])}}

    def good(self, status, name):
        if name in ("laser", "air", *NETWORK):
            return super().good(status, name)
        channels = channels_of(status, name)
        return channels and all(c["value"] is not None for c in channels)


@contextlib.contextmanager
def undisturbed(station, names):
    """All but these lose nothing."""
    others = [name for name in EVERYBODY if name not in names]
    streams = [name for name in others if name in STREAMS]
    with Undisturbed(station, *(name for name in others if name not in STREAMS)), watched(station, streams):
        yield


def watched(station, streams):
    return StreamsUndisturbed(station, station.stream_devices, *streams, told_within=TOLD_WITHIN)


def set_up_adapter():
    """What systemd-networkd does on a station."""
    wait_until(f"gs_usb made {ADAPTER_BUS}", Path(f"/sys/class/net/{ADAPTER_BUS}").exists)
    run("ip", "link", "set", ADAPTER_BUS, "type", "can", "bitrate", "500000")
    run("ip", "link", "set", ADAPTER_BUS, "up")


def restart_adapter():
    run("ip", "link", "set", ADAPTER_BUS, "down")
    run("ip", "link", "set", ADAPTER_BUS, "up")


def suffers(station, names, begin, end, reasons, own={}):
    """`begin` spoils the named instruments, all are given up, `end` mends them, all come back within 5 s;
    all others lose nothing meanwhile. Each change of state is one line; the reason is told once, one of `reasons`,
    of a name in `own` one of those there. How many samples a stream lost when it broke is no reason, and one line more
    at most."""
    since = len(station.logged())
    with undisturbed(station, names):
        begin()
        for name in names:
            station.wait_for_state(name, GONE)
        mended = time.monotonic()
        end()
        station.wait_until_good(*names)
        print(f"back after {time.monotonic() - mended:.1f} s")
    for name in names:
        lines = [line for line in station.logged()[since:] if f" {name}:" in line or f" {name} is " in line]
        print("\n".join(lines))
        changes = [line for line in lines if f" {name} is " in line]
        losses = [line for line in lines if line.endswith(("position of the stream is missing", "positions of the stream are missing"))]
        told = [line for line in lines if line not in changes and line not in losses]
        expect(changes[-1].endswith("is available.") and 2 <= len(changes) <= 3, f"{name} changed: {changes}")
        expect(len(losses) <= 1, f"{name} tells its loss {len(losses)} times: {losses}")
        expect(len(told) == 1, f"why {name} is gone is told {len(told)} times: {told}")
        for line in told:
            expected = own.get(name, reasons)
            expect(any(reason in line for reason in expected), f"none of {expected}: {line}")


def near(what, value, expected, within):
    expect(value is not None and abs(value - expected) <= within, f"{what} is {value}, not {expected} +- {within}")


def two_thousand_more(station, names):
    before = {name: station.instrument(name)["samples"] for name in names}
    for name in names:
        wait_until(f"two thousand samples more of {name}",
                   lambda name=name: station.instrument(name)["samples"] >= before[name] + 2000, 60)


@check("StationReadsTenInstrumentsOnOneCanBus")
def reads(station):
    station.start()
    station.wait_until_good("laser", "air", *ALL, *FAR, *NETWORK, limit_s=30)
    material = station.scenario["thermal"]["material"]["start"]
    for name in PROBES:
        near(name, station.value(name, "contact 1"), material, 0.5)
    for name, (_, mm) in BARS.items():
        near(name, station.value(name, "ballbar"), mm * 1e-3, 1e-9)
    near("far-bar", station.value("far-bar", "ballbar"), 2.5e-3, 1e-9)
    near("far-probe", station.value("far-probe", "contact 1"), material, 0.5)
    near("indigo", station.value("indigo", "air temperature"), station.scenario["air"]["temperature"]["start"], 0.5)
    expect(station.instrument("ballbar")["model"] == "Temposonics E-series", "another device was taken")
    print([(one["name"], one["model"], one["serial"], one["firmware"]) for one in station.status()["instruments"]])


@check("TwoTransducersStreamAtOneKilohertzWithoutAGap")
def streams(station):
    began = time.monotonic()
    with watched(station, BARS):
        two_thousand_more(station, BARS)
    devices = station.can_status()["devices"]
    print(f"two thousand samples of each within {time.monotonic() - began:.1f} s; skipped by the devices:",
          {name: devices[name]["skipped"] for name in BARS})


@check("CanLinkThatGoesDownIsNamedAndComesBack")
def down(station):
    suffers(station, ALL, lambda: run("ip", "link", "set", BUS, "down"), lambda: run("ip", "link", "set", BUS, "up"),
            [f"{BUS} is down"])


@check("BusOffOfAnAdapterIsNamedAndComesBack")
def bus_off(station):
    """gs_usb refuses restart-ms: the link is set down and up, as the page says."""
    def leave_the_bus():
        station.usb("tell adapter bus-off")
        wait_until("the kernel knows of it", lambda: "BUS-OFF" in run("ip", "-details", "link", "show", ADAPTER_BUS))

    suffers(station, FAR, leave_the_bus, restart_adapter, [f"{ADAPTER_BUS} is bus-off", f"{ADAPTER_BUS} is down"])


@check("FloodOfForeignFramesIsHeardByNobody")
def flooded(station):
    frames = {name: station.instrument(name)["frames"] for name in PROBES}
    with undisturbed(station, []):
        before = station.can_status()["foreign"]
        station.can(f"flood {FLOOD_HZ}")
        try:
            wait_until("five thousand frames of strangers passed", lambda: station.can_status()["foreign"] > before + 5000, 60)
        finally:
            station.can("flood 0")
    heard = {name: station.instrument(name)["frames"] - frames[name] for name in PROBES}
    print(heard)
    expect(all(count < 1000 for count in heard.values()), f"strangers were heard: {heard}")


@check("DeadNodesAreGivenUpAndComeBackWhileTheOthersGoOn")
def dead(station):
    names = ["ballbar", "probe-3"]

    def switch(word):
        for name in names:
            station.can(f"{word} {name}")

    suffers(station, names, lambda: switch("off"), lambda: switch("on"), ["does not answer"])


@check("NodesThatWereResetAreSetUpAgainWhileTheOthersGoOn")
def reset(station):
    names = ["gauge", "probe-5"]
    restarts = {name: station.instrument(name)["restarts"] for name in names}
    since = len(station.logged())
    with undisturbed(station, names):
        for name in names:
            station.can(f"reset {name}")
        for name in names:
            wait_until(f"{name} was opened anew", lambda name=name: station.instrument(name)["restarts"] > restarts[name], 15)
        station.wait_until_good(*names)
    told = [line for line in station.logged()[since:] if "was reset" in line]
    print("\n".join(told))
    expect(len(told) == 2 and all(any(name in line for line in told) for name in names), f"{told}")


@check("AdapterThatIsUnpluggedIsNamedAndComesBack")
def unplugged(station):
    def plug():
        station.usb("plug adapter")
        set_up_adapter()

    suffers(station, FAR, lambda: station.usb("unplug adapter"), plug,
            [f"no CAN interface {ADAPTER_BUS}", f"{ADAPTER_BUS} is down"])


@check("FramesThatTheKernelHadToDropAreCounted")
def dropped(station):
    """The daemon stands still for longer than its socket holds. What the kernel dropped is counted: all that
    was sent is either a sample or lost."""
    def books():
        sent = station.can_status()["devices"]["ballbar"]["pdos"]
        one = station.instrument("ballbar")
        return sent - one["samples"] - one["lost_records"], one["lost_records"], one["gaps"]

    two_thousand_more(station, ["ballbar"])
    open_before, lost_before, gaps_before = books()
    process = station.processes["axiscald"]
    os.kill(process.pid, signal.SIGSTOP)
    try:
        sent = station.can_status()["devices"]["ballbar"]["pdos"]
        wait_until("three thousand frames were sent",
                   lambda: station.can_status()["devices"]["ballbar"]["pdos"] > sent + 3000, 60)
    finally:
        os.kill(process.pid, signal.SIGCONT)
    station.wait_until_good("ballbar")
    two_thousand_more(station, ["ballbar"])
    open_after, lost_after, gaps_after = books()
    print(f"lost {lost_after - lost_before} in {gaps_after - gaps_before} gaps; not yet handed up {open_before} before, {open_after} after")
    expect(lost_after > lost_before, "nothing was lost: the test did not test")
    # What is on its way when the books are closed: a status takes as long as some hundred samples.
    expect(abs(open_after - open_before) < 500, f"{open_before} frames were open, then {open_after}")


@check("BrokenProbeIsFaultyAndMendsWhileTheOthersGoOn")
def broken(station):
    suffers(station, ["probe-2"], lambda: station.can("fault probe-2"), lambda: station.can("mend probe-2"), ["0x5030"])


def spoilt(station, nodes, fault, cable_fault, reasons, own={}):
    """Nodes whose frames are wrong, and a network that is, at once: each is given up for its own reason."""
    def switch(frames, *replies):
        for name in nodes:
            station.can(f"spoil {name} {frames}")
        for cable in station.cables.values():
            cable.suffer(*replies)

    suffers(station, [*nodes, *NETWORK], lambda: switch(fault, *cable_fault), lambda: switch("none", "none"), reasons, own)


@check("FramesAndRepliesWithWrongBytesEndInNoReadings")
def corrupt(station):
    """One bit of each byte. No sum goes with a PDO's content, for the bus has its own; a node whose state is
    wrong is set up anew, and what it answers then is no answer."""
    spoilt(station, ["gauge", "probe-4"], "corrupt 1", ["corrupt", 128],
           ["was taken out of operation", "does not answer"], {"indigo": ["what came is not Modbus"]})


@check("ShortFramesAndRepliesAreNoReadings")
def cut(station):
    """Behind a reply that ends too early the next one begins in its place, which is no Modbus then."""
    before = {name: station.instrument(name)["bad_frames"] for name in ("ballbar", "probe-6")}
    spoilt(station, list(before), "cut 3", ["cut", 3], ["shorter than its mapping", "does not answer"],
           {"indigo": ["what came is not Modbus", "does not answer"]})
    for name, count in before.items():
        expect(station.instrument(name)["bad_frames"] > count, f"{name} counts no short frame")


@check("NetworkInstrumentsThatAreKilledAreNamedAndComeBack")
def killed(station):
    spoilt(station, [], "", ["down"], ["connection is closed", "no connection", "refused"])


@check("NetworkInstrumentsThatFallSilentAreGivenUpAndComeBack")
def silent(station):
    spoilt(station, [], "", ["mute"], ["does not answer"])


@check("AdapterWithBrokenDescriptorsIsNoBus")
def broken_descriptors(station):
    def plug():
        station.unplug_for_good("adapter")
        station.usb("fault adapter none")
        station.usb("plug adapter")
        set_up_adapter()

    def break_it():
        station.usb("fault adapter descriptors")
        station.usb("unplug adapter")
        for name in FAR:
            station.wait_for_state(name, GONE)
        station.usb("plug adapter")
        wait_until("the kernel has seen the device", lambda: "descriptor" in os.popen("dmesg | tail -n 20").read())
        expect(not Path(f"/sys/class/net/{ADAPTER_BUS}").exists(), "the kernel made a bus of half a configuration")

    suffers(station, FAR, break_it, plug, [f"no CAN interface {ADAPTER_BUS}", f"{ADAPTER_BUS} is down"])


@check("AdapterThatSaysNakForEverIsGivenUpAndComesBack")
def mute(station):
    suffers(station, FAR, lambda: station.usb("fault adapter mute"), lambda: station.usb("fault adapter none"),
            ["does not answer", "does not get rid of its frames"])


@check("AdapterThatStallsOrCutsItsFramesIsGivenUpAndComesBackWithItsLink")
def adapter_spoilt(station):
    """gs_usb never reads again after a STALL, and a frame whose echo came short keeps its place among the ten that may be on
    their way: as after bus-off the link is set down and up."""
    def mend():
        station.usb("fault adapter none")
        restart_adapter()

    for fault in ("stall", "cut 3"):  # of the 20 bytes of a frame
        suffers(station, FAR, lambda fault=fault: station.usb(f"fault adapter {fault}"), mend,
                ["does not answer", "does not get rid of its frames"])


@check("RecordingsByCanAndTcpGiveTheirDriversTheSameReadings")
def recorded(station):
    """A transducer and a thermometer behind the adapter, the IDS by its JSON on TCP, the Indigo by Modbus, led over a port made between.
    The daemon is not needed any more."""
    last = on_tape(station, {"far-bar": "can", "far-probe": "can", "ids": "tcp"}, modbus=["indigo"])
    near("far-bar", last["far-bar", "ballbar"], 2.5e-3, 1e-9)
    near("far-probe", last["far-probe", "contact 1"], station.scenario["thermal"]["material"]["start"], 0.5)
    near("indigo", last["indigo", "air temperature"], station.scenario["air"]["temperature"]["start"], 0.5)
    expect(("ids", "axis 1") in last, f"the IDS gave {last}")


def main():
    load_modules("vcan", "can_raw", "vhci_hcd", "gs_usb")
    start_udev()
    run("ip", "link", "add", BUS, "type", "vcan")
    run("ip", "link", "set", BUS, "up")
    with CanStation() as station:
        return run_checks(station)


sys.exit(main())
