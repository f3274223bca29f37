"""A station whose instruments are USB devices on the guest's own kernel: axiscal-simulate makes the
truth on pseudo terminals, `axiscal-simulate usb` carries each through a real driver, axiscald opens
what udev names."""

import contextlib
import os
import sys
from pathlib import Path

from guest import SHARE, SOURCE, Commands, expect, wait_until

sys.path.insert(0, str(SOURCE / "tests/simulation"))
import bench  # noqa: E402  (the bench of the whole-run tests, here with other wires)

RECOVERY_S = 5.0  # from the node's return to good values
GIVEN_UP_S = 15.0  # the slowest driver's patience (10 s), and its re-opening
LASER = {"called": "laser", "serial": "7391230"}  # 16c0:0483, a Teensy
AIR = {"called": "air", "vendor": "289b", "product": "0505", "maker": "Dracal", "name": "VCP-PTH450-CAL",
       "serial": "E24638"}
MATERIAL = {"called": "material", "serial": "A600AXIS"}  # 0403:6001
LINKS = {"laser": "/dev/axiscal/umd-7391230-00", "air": "/dev/axiscal/dracal-E24638-00",
         "material": "/dev/axiscal/ftdi-A600AXIS-00"}


def usb_devices():
    """Each that the kernel has, by its socket and the number that it got there (devnum): what is plugged in anew
    gets a number that none before it had, so that the old one is not taken for the new. Without root hubs."""
    found = set()
    for one in Path("/sys/bus/usb/devices").glob("*-*"):
        with contextlib.suppress(OSError):  # it is just going
            if ":" not in one.name:
                found.add((one.name, (one / "devnum").read_text().strip()))
    return found


def is_set_up(device):
    """The kernel has chosen its configuration and offered all of it to the drivers: it lets nobody read which
    one while it does."""
    socket, _ = device
    with contextlib.suppress(OSError):
        return (Path("/sys/bus/usb/devices") / socket / "bConfigurationValue").read_text().strip() != ""
    return False


def kernel_drivers(numbers):
    """Of each interface of the device with these numbers (vendor, product) that a driver of the kernel serves.
    AssertionError where there is no such device."""
    for one in Path("/sys/bus/usb/devices").glob("*-*"):
        if ":" not in one.name and tuple((one / key).read_text().strip() for key in ("idVendor", "idProduct")) == numbers:
            return sorted(os.path.basename(os.readlink(driver)) for driver in one.glob("*:*/driver"))
    raise AssertionError(f"the kernel shows no USB device {':'.join(numbers)}")


def channels_of(status, name):
    return [c for c in status["channels"] if c["instrument"] == name]


def value_in(status, instrument, channel):
    return next(c["value"] for c in channels_of(status, instrument) if c["channel"] == channel)


class UsbStation(bench.Bench):
    """As Bench; `wires` says which kind of adapter each instrument sits behind."""

    def __init__(self):
        super().__init__()
        # A counter sends a thousand records a second; each costs the emulation a dozen changes of task.
        self.scenario["laser"]["rate_hz"] = 250.0
        self.links = dict(LINKS)
        self.settled = {}  # of streams: what StreamsUndisturbed knew last
        self.wires = {"laser": ("cdc-acm", LASER), "air": ("cdc-acm", AIR), "material": ("ftdi", MATERIAL)}
        for instrument in self.station["instrument"]:
            instrument["link"] = "serial:" + LINKS[instrument["name"]]
        for part in [self.scenario["laser"], *self.scenario["sensor"]]:
            part["path"] = str(self.folder / part["path"])

    def log_file(self, name):
        """On the host from the first line on: what a guest said that hangs is there, too. Several stations
        of one boot share the folder."""
        return SHARE / f"{name}.{len(list(SHARE.glob('*.*.log')))}.log"

    def start_simulator(self):
        super().start_simulator()
        self.start_usb()

    def start_usb(self):
        words = ["usb", "--scenario", self.folder / "scenario.json", "--control", self.folder / "usb.sock"]
        for name, (kind, settings) in self.wires.items():
            behind = {**settings, "behind": str(self.folder / f"{name}.tty")}
            words += ["--device", ",".join([kind, *(f"{key}={value}" for key, value in behind.items())])]
        world = self.processes.pop("axiscal-simulate")
        log = self.spawn("axiscal-simulate", *words)
        self.wait_for_line("axiscal-simulate", log, '"ready":true')
        self.processes["usb"] = self.processes.pop("axiscal-simulate")
        self.processes["axiscal-simulate"] = world
        for link in self.links.values():
            wait_until(f"udev made {link}", Path(link).exists)

    def rewire(self, name, kind, settings, link):
        """Another adapter for an instrument, before start_usb() and write_station()."""
        self.wires[name] = (kind, settings)
        self.links[name] = link
        next(one for one in self.station["instrument"] if one["name"] == name)["link"] = "serial:" + link

    def usb(self, command):
        Commands(self.folder / "usb.sock").do(command)

    def unplug_for_good(self, *names):
        """Until the kernel has let go of them: what comes back within milliseconds it may take for the same
        device and keep what that one said of itself."""
        devices = self.ask_usb("status")["devices"]
        before = usb_devices()
        going = sum(devices[name]["plugged"] for name in names)
        for name in names:
            self.usb(f"unplug {name}")
        wait_until(f"the kernel has let go of {', '.join(names)}", lambda: len(before - usb_devices()) >= going)

    def replug(self, names, fault):
        """They come back as new devices with this fault, and the kernel has offered them to its drivers."""
        before = usb_devices()
        self.unplug_for_good(*names)
        for name in names:
            self.usb(f"fault {name} {fault}")
            self.usb(f"plug {name}")
        wait_until(f"the kernel has set up {', '.join(names)}",
                   lambda: sum(map(is_set_up, usb_devices() - before)) >= len(names))

    def ask_usb(self, command):
        return Commands(self.folder / "usb.sock").ask(command)

    def state(self, name):
        return self.instrument(name)["state"]

    def wait_for_state(self, name, states, limit_s=GIVEN_UP_S):
        return wait_until(f"{name} is {' or '.join(states)}", lambda: self.state(name) in states, limit_s)

    def value(self, instrument, channel):
        return value_in(self.status(), instrument, channel)

    def good(self, status, name):
        """Every channel of the instrument that a role uses has a value; each it has where none does."""
        channels = channels_of(status, name)
        used = [c for c in channels if c["used"]] or [c for c in channels if c["quality"] != "none"]
        return used and all(c["value"] is not None for c in used)

    def wait_until_good(self, *names, limit_s=RECOVERY_S):
        """All of them within one span of time, each seen good once."""
        late = list(names)

        def all_were_good():
            status = self.status()  # once for all of them: the guest is slow
            here = {one["name"] for one in status["instruments"] if one["state"] == "available"}
            late[:] = [name for name in late if name not in here or not self.good(status, name)]
            return not late

        try:
            wait_until("good values", all_were_good, limit_s)
        except AssertionError as error:
            raise AssertionError(f"{', '.join(late)}: {error}") from None

    def logged(self):
        """Of the daemon that was started last."""
        log = [log for log in self.logs if log.name.startswith("axiscald")][-1]
        return log.read_text(errors="replace").splitlines()

    def __exit__(self, *failure):
        """Failures are the checks' own to tell."""
        for process in self.processes.values():
            process.kill()
            process.wait()


class Undisturbed:
    """Watches that instruments go on without a loss while something happens to others. A polled one has no
    gaps: an answer that it missed is a time-out."""

    LOSSES = ("restarts", "bad_frames", "checksum_errors", "timeouts", "gaps", "lost_records")

    def __init__(self, station, *names):
        self.station, self.names = station, names

    def counts(self):
        """One status for all of them: the guest is slow."""
        here = {one["name"]: one for one in self.station.status()["instruments"]}
        return {name: here[name] for name in self.names}

    def __enter__(self):
        self.before = self.counts()
        return self

    def standing(self):
        now = self.counts()
        return [name for name in self.names if now[name]["frames"] <= self.before[name]["frames"]]

    def __exit__(self, kind, *_):
        if kind is not None:
            return
        try:
            wait_until("they go on", lambda: not self.standing(), RECOVERY_S)
        except AssertionError as error:
            raise AssertionError(f"{', '.join(self.standing())}: {error}") from None
        now = self.counts()
        for name, then in self.before.items():
            lost = {key: (then[key], now[name][key]) for key in self.LOSSES if now[name][key] != then[key]}
            expect(not lost, f"{name} was disturbed: {lost}")
            expect(now[name]["state"] == "available", f"{name} is {now[name]['state']}")


class StreamsUndisturbed:
    """As Undisturbed, of streams at 1 kHz. A device that this emulation did not let send in time says how many
    samples it skipped (`devices` asks it), and just those must be missed: each gap has at least one of them.
    `told_within`: after so many samples more the driver has told what the device skipped; that is waited for only
    where something was skipped since the books agreed last, or the stream began anew."""

    OTHERS = ("restarts", "bad_frames", "checksum_errors", "timeouts")

    def __init__(self, station, devices, *names, told_within):
        self.station, self.devices, self.names, self.told_within = station, devices, names, told_within

    def books(self):
        if not self.names:
            return {}
        devices = self.devices()
        seen = {one["name"]: one for one in self.station.status()["instruments"] if one["name"] in self.names}
        return {name: {"missed": one["lost_records"] - devices[name]["skipped"], "skipped": devices[name]["skipped"],
                       "samples": one["samples"], "others": {key: one[key] for key in self.OTHERS}, "state": one["state"]}
                for name, one in seen.items()}

    def agree(self):
        """What was skipped last is told a little later."""
        now = self.books()
        return all(now[name]["missed"] == then["missed"] for name, then in self.before.items()) and now

    def __enter__(self):
        self.before = self.books()
        if any(self.may_be_unsettled(name) for name in self.names):
            wait_until("the books are settled", self.settled, 30)
        return self

    def may_be_unsettled(self, name):
        """A stream that began anew misses nothing of what was skipped before."""
        now, then = self.before[name], self.station.settled.get(name, {"skipped": 0, "others": {"restarts": 0}})
        return now["skipped"] != then["skipped"] and now["others"]["restarts"] == then["others"]["restarts"]

    def settled(self):
        """What was skipped before has been told: nothing was missed while twice as many samples came."""
        first = self.books()
        enough = {name: one["samples"] + 2 * self.told_within for name, one in first.items()}
        wait_until(f"samples more of {', '.join(self.names)}",
                   lambda: all(one["samples"] >= enough[name] for name, one in self.books().items()), 30)
        self.before = self.books()
        return all(first[name]["missed"] == self.before[name]["missed"] for name in self.names)

    def __exit__(self, kind, *_):
        if kind is not None or not self.names:
            return
        try:
            now = wait_until("lost and skipped agree", self.agree, 30)
        except AssertionError as error:
            raise AssertionError(f"{error}: {self.before} became {self.books()}") from None
        for name, then in self.before.items():
            self.station.settled[name] = now[name]
            expect(now[name]["samples"] > then["samples"], f"{name} does not go on")
            expect(now[name]["others"] == then["others"], f"{name} was disturbed: {then} became {now[name]}")
            expect(now[name]["state"] == "available", f"{name} is {now[name]['state']}")
