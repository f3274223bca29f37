"""The whole station as its systemd unit, with systemd as PID 1, instruments on USB (serial, usbfs, hidraw)
and a CAN bus."""

import json
import os
import re
import shutil
import signal
import ssl
import sys
import time
import urllib.request
from pathlib import Path

import guest_clock
import sandbox
from guest import SOURCE, check, expect, load_modules, run, run_checks, wait_until
from usb_station import LINKS, Undisturbed, UsbStation, bench, value_in
from truth import BOUNDED, compare  # of the whole-run tests, as bench

PUBLISHED = Path("/mnt/quality")
POLKIT_RULES = ("/usr/share/polkit-1/rules.d", "/etc/polkit-1/rules.d")
BUS = "vcan0"
DIRECT = {  # without a terminal: usbfs, hidraw, AF_CAN
    "tenki": {"driver": "dracal-usbtenki", "link": "usb:A10234"},
    "stick": {"driver": "temper", "link": "usb:any"},
    "contact": {"driver": "canopen-404", "link": f"can:{BUS}", "node": 11},
}
GONE = ("unavailable", "faulty")
INSTALL = SOURCE / "docs/install.md"
TLS = Path("/etc/axiscal/tls")
TLS_PORT = 8470
WATCHDOG_S = 30.0  # 10 s of the unit, its end by a signal, its restart


def shown(unit, *names):
    lines = run("systemctl", "show", unit, *(f"--property={name}" for name in names)).splitlines()
    return dict(line.split("=", 1) for line in lines)


def journal(unit="axiscald"):
    return run("journalctl", "-u", unit, "--no-pager", "-o", "cat")


def entries(*fields):
    """What the daemon itself told with all these fields, and all that the journal knows of each."""
    told = run("journalctl", "-u", "axiscald", "-t", "axiscald", "--no-pager", "-o", "json", *fields)
    return [json.loads(line) for line in told.splitlines()]


def told_of(name, since, last):
    """Lines of the journal about an instrument, once one of them ends so."""
    lines = [line for line in journal().splitlines()[since:] if f"{name} is " in line or f"{name}:" in line]
    return lines if any(line.endswith(f"{name} {last}") for line in lines) else None


def make_certificate():
    """As docs/install.md has it: the service reads the key by its group."""
    TLS.mkdir()
    run("openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-noenc", "-days", "30", "-subj", "/CN=localhost",
        "-addext", "subjectAltName=DNS:localhost", "-keyout", TLS / "key.pem", "-out", TLS / "fullchain.pem")
    run("chown", "root:axiscal", TLS / "key.pem")
    (TLS / "key.pem").chmod(0o640)


class ServiceStation(UsbStation):
    """As UsbStation, but everything lies where an installed station has it and systemd starts it."""

    socket = "/run/axiscal/axiscald.sock"

    def __init__(self):
        super().__init__()
        self.clock = guest_clock.GuestClock()
        self.taken = {}  # of some steps: the monotonic times between which they were asked for and became durable
        self.station["station"]["state_directory"] = "/var/lib/axiscal"
        self.station["console"].pop("socket")
        self.station["console"].pop("group")  # as a station file that names none: axiscal
        self.station["console"].update(port=TLS_PORT, certificate=str(TLS / "fullchain.pem"), key=str(TLS / "key.pem"))
        self.station["publish"]["destination"] = str(PUBLISHED)
        for instrument in self.station["instrument"]:
            if "profile" in instrument:
                instrument["profile"] = Path(instrument["profile"]).stem
        self.station["instrument"] += [{"name": name, **keys} for name, keys in DIRECT.items()]
        self.station["axis"]["air"]["oldest"] = "5 s"  # a sensor that is gone is soon missed by a run
        # What the figures must agree with: the boot lasts some minutes. What is drawn is not looked at.
        self.scenario["truth"].update(duration_s=600.0, draws=200)
        self.wires["tenki"] = ("usbtenki", {"called": "tenki", "serial": "A10234"})
        self.wires["stick"] = ("temper", {"called": "stick"})

    def good(self, status, name):
        """Of the stick its probe, the one sensor that it has."""
        if name == "stick":
            return value_in(status, name, "probe temperature") is not None
        return super().good(status, name)

    def program(self, name):
        """The installed one, where there is one."""
        installed = Path("/usr/bin") / name
        return str(installed) if installed.exists() else super().program(name)

    def start_usb(self):
        super().start_usb()
        run("ip", "link", "add", BUS, "type", "vcan")
        run("ip", "link", "set", BUS, "up")
        others = {name: self.processes.pop(name) for name in ("axiscal-simulate", "usb")}
        log = self.spawn("axiscal-simulate", "can", "--scenario", self.folder / "scenario.json", "--interface", BUS,
                         "--control", self.folder / "can.sock", "--device", "cantrans,called=contact,node=11")
        self.wait_for_line("axiscal-simulate", log, '"ready":true')
        self.processes = {**self.processes, "can": self.processes.pop("axiscal-simulate"), **others}

    def install(self):
        """What docs/install.md says after laying out the files."""
        run("systemd-sysusers")
        run("systemd-tmpfiles", "--create")
        make_certificate()
        PUBLISHED.mkdir(parents=True, exist_ok=True)
        run("chown", "axiscal:axiscal", PUBLISHED)
        run("udevadm", "control", "--reload")
        run("systemctl", "daemon-reload")
        self.leave_polkit_the_rule_of_the_package()
        run("systemctl", "start", "dbus.socket", "polkit", "systemd-logind")  # as on every PC that can fall asleep

    @staticmethod
    def leave_polkit_the_rule_of_the_package():
        """The folders of this computer's rules are polkitd's alone: whoever runs the virtual one, and is not root,
        cannot show them to it."""
        for folder in map(Path, POLKIT_RULES):
            run("mount", "-t", "tmpfs", "-o", "mode=755", "rules", folder)
            ours = Path("/hostshare/overlay") / folder.relative_to("/") / "axiscal.rules"
            if ours.exists():
                shutil.copy(ours, folder)

    def write_station(self):
        path = Path("/etc/axiscal/station.toml")
        path.write_text(bench.to_toml(self.station))
        run("chown", "root:axiscal", path)
        path.chmod(0o640)
        (self.folder / "station.toml").write_text(path.read_text())
        self.axiscal("check-config", path)

    def start_daemon(self):
        run("systemctl", "start", "axiscald", limit_s=90)
        run("systemctl", "start", "axiscal-publish", limit_s=90)

    def pid(self):
        return int(shown("axiscald", "MainPID")["MainPID"])

    def begin_run(self):
        """The one run of this boot: the checks share it. The CNC stands still after four points."""
        self.write_program()
        self.go_to_datum()
        self.sim("hold 4")
        self.arm()
        self.wait_for_points(4)

    def take_points(self, count):
        """So many more points; then the CNC stands still again."""
        done, began_ns = self.run()["step"], time.monotonic_ns()
        self.sim(f"hold {done + count}")
        self.wait_for_points(done + count)
        self.taken |= {step: (began_ns, time.monotonic_ns()) for step in range(done, done + count)}

    def told(self):
        """What a person would see of a disturbance, and what systemd would."""
        status = self.status()
        return {"instruments": {one["name"]: one["state"] for one in status["instruments"]}, "notes": status["notes"],
                "alarm": status["outbox"]["alarm"], "run": status["run"]["state"], "fault": status["run"]["fault"],
                "unit": shown("axiscald", "MainPID", "NRestarts", "SubState")}


@check("ServiceIsReadyBeforeAnyInstrumentIsPluggedIn")
def ready(station):
    station.install()
    # The part program waits for an answer as long as a capture may last, and 2 s. A watchdog's kill
    # and restart take 12 s: a shorter time-out ends the part program before the daemon is back.
    station.station["capture"]["timeout"] = "30 s"
    station.write_station()
    station.start_daemon()
    state = shown("axiscald", "Type", "ActiveState", "SubState", "NRestarts", "User")
    expect(state == {"Type": "notify", "ActiveState": "active", "SubState": "running", "NRestarts": "0", "User": "axiscal"},
           f"{state}\n{journal()}")
    publisher = shown("axiscal-publish", "ActiveState", "NRestarts")
    expect(publisher == {"ActiveState": "active", "NRestarts": "0"}, f"{publisher}\n{journal('axiscal-publish')}")


@check("ControlSocketBelongsToTheGroupAlone")
def control_socket(station):
    """docs/install.md: 0660 axiscal:axiscal, in a folder that others do not enter."""
    for place, mode in ((Path(station.socket), 0o660), (Path(station.socket).parent, 0o750)):
        rights = place.stat().st_mode & 0o7777
        expect((place.owner(), place.group(), rights) == ("axiscal", "axiscal", mode),
               f"{place} belongs to {place.owner()}:{place.group()} and has mode {rights:o}")


@check("ConsoleSpeaksTlsInsideTheUnit")
def console_by_tls(station):
    """The module is loaded, and its thread works, under all that the unit takes away."""
    trusted = ssl.create_default_context(cafile=TLS / "fullchain.pem")
    with urllib.request.urlopen(f"https://localhost:{TLS_PORT}/v1/status", timeout=30, context=trusted) as answer:
        expect(json.load(answer)["station"] == station.status()["station"], "another station answers")
    expect("axiscald-tls.so" in Path(f"/proc/{station.pid()}/maps").read_text(), "who speaks TLS here?")


@check("InstrumentsPluggedInLaterAreNamedGroupedAndOpened")
def plugged_in(station):
    load_modules("vhci_hcd")  # the drivers of the instruments are udev's to load
    station.start_simulator()
    for name, link in LINKS.items():
        node = Path(os.path.realpath(link))
        print(name, link, node)
        expect(node.group() == "axiscal", f"{node} belongs to {node.group()}")
        expect(node.stat().st_mode & 0o777 == 0o660, f"{node} has mode {node.stat().st_mode:o}")
    try:
        station.wait_until_good(*LINKS, *DIRECT, limit_s=30)
    finally:
        print(journal())


@check("LatencyTimerOfAnFtdiAdapterIsSetByTheRules")
def latency(station):
    node = Path(os.path.realpath(LINKS["material"])).name
    timer = Path(f"/sys/bus/usb-serial/devices/{node}/latency_timer").read_text().strip()
    expect(timer == "1", f"{node} holds bytes back for {timer} ms")
    device = station.ask_usb("status")["devices"]["material"]["state"]
    expect(device.startswith("latency timer 1 ms,"), f"the adapter itself says: {device}")


@check("UnitIsHardenedAsMuchAsItClaims")
def hardened(station):
    """docs/install.md states a figure for each, to the tenth."""
    row = re.search(r"^\| exposure by `systemd-analyze security`.*\| ([0-9.]+) \| ([0-9.]+) \| ([0-9.]+) \|$", INSTALL.read_text(), re.M)
    claimed = dict(zip(sandbox.SERVICES, row.groups()))
    found = {}
    for unit in sandbox.SERVICES:
        told = run("systemd-analyze", "security", "--no-pager", unit, may_fail=True)
        found[unit] = re.search(r"exposure level for \S+: ([0-9.]+)", told).group(1)
        print(*(line for line in told.splitlines() if not line.startswith("✓")), sep="\n")
    expect(found == claimed, f"exposed by {found}; docs/install.md claims {claimed}")


@check("ServiceSeesItsDevicesAndFoldersAndNothingElse")
def confined(station):
    """From inside: a script in a unit that differs from the daemon's by its program only."""
    places = [*LINKS.values(), "/dev/ttyS0", "/dev/kmsg", "/dev/mem", "/dev/uhid", "/dev/hwrng"]
    for path in ("/etc/axiscal", "/usr", "/root", "/mnt", "/var/log", "/run", "/var/lib/axiscal", "/run/axiscal"):
        places.append(f"{path}/planted")
    said = sandbox.inside("axiscald", f"""
import errno, os
for place in {places!r}:
    try:
        create = os.O_CREAT if place.endswith("planted") else 0
        os.close(os.open(place, os.O_WRONLY | os.O_NONBLOCK | os.O_NOCTTY | create))
        told = "open"
    except OSError as error:
        told = "open" if error.errno == errno.EBUSY else "shut"  # busy: allowed, but the daemon has it
    print(told, place)
""")
    print(said)
    opened = {line.split()[1] for line in said.splitlines() if line.startswith("open")}
    wanted = {*LINKS.values(), "/dev/ttyS0", "/var/lib/axiscal/planted", "/run/axiscal/planted"}
    expect(len(said.splitlines()) == len(places), f"not every place was tried: {said}")
    expect(opened == wanted, f"open by mistake: {opened - wanted}; shut by mistake: {wanted - opened}")


@check("ServicesReadAndMayDoWhatTheirPageSays")
def page_of_the_sandbox(station):
    load_modules("wire")  # /sys/bus/w1, as where an adapter for 1-Wire is
    sandbox.judge()


@check("DaemonKnowsTheBootThatTheKernelNames")
def boot_known(station):
    """The unit once hid the boot's id, and empty equalled empty: no restart of the computer was noticed."""
    # Other checks fail here: nothing has been measured for long enough.
    checks = json.loads(run(station.program("axiscal"), "preflight", "--json", may_fail=True))
    print(checks)
    computer = next(one for one in checks["checks"] if one["name"] == "computer")
    expect(computer["passed"] and not computer["warning"], f"{computer}")


def kept_awake():
    """What logind says that is inhibited by blocking."""
    return run("busctl", "get-property", "org.freedesktop.login1", "/org/freedesktop/login1",
               "org.freedesktop.login1.Manager", "BlockInhibited").split('"')[1].split(":")


@check("ComputerMayFallAsleepWhileNoRunIsOpenAndNotInMidRun")
def awake(station):
    """By the rule that is installed, under the unit's own user. The end of the lock: in the check of the watchdog."""
    computer = wait_until("logind has given a lock", lambda: next(
        one for one in json.loads(run(station.program("axiscal"), "preflight", "--json", may_fail=True))["checks"]
        if one["name"] == "computer"))
    expect(not computer["warning"], f"{computer}\n{run('journalctl', '-u', 'polkit', '-o', 'cat', may_fail=True)}")
    expect("sleep" not in kept_awake(), f"without a run {kept_awake()} is inhibited")
    station.begin_run()
    wait_until("the computer is kept awake", lambda: {"sleep", "handle-lid-switch"} <= set(kept_awake()))
    print(run("systemd-inhibit", "--list", "--no-pager"))


@check("ClockSetToAndFroALeapAndAnotherZoneDisturbNothing")
def clock_set(station):
    """In mid-run, two points after each: an hour forward, a leap second at a midnight, back, another time zone. The
    run goes on in the next checks, and the one after them looks for the times of these points."""
    if not station.run():  # the check before did not come so far
        station.begin_run()
    told, clock = station.told(), station.clock
    with Undisturbed(station, *LINKS, *DIRECT), clock.right_at_the_end():
        for change in (clock.an_hour_forward, clock.through_a_leap_second, clock.back, clock.to_another_zone):
            change()
            station.take_points(2)
            station.wait_until_good(*LINKS, *DIRECT)
    now = station.told()
    expect(now == told, f"{told} became {now}")


@check("RunHoldsWhileASensorIsUnpluggedAndGoesOnWhenItIsBack")
def sensor_unplugged(station):
    """The CNC stands after a point until the sensor's last value is too old. Its next request is refused and
    told why, and nothing is acknowledged; once the sensor is back the CNC asks again (docs/trigger.md, rule 7)."""
    if not station.run():  # the check before did not come so far
        station.begin_run()
    done = station.run()["step"]
    since = len(journal().splitlines())
    with Undisturbed(station, *(name for name in (*LINKS, *DIRECT) if name != "material")):
        station.usb("unplug material")
        try:
            station.wait_for_state("material", GONE)
            wait_until("its last value is too old", lambda: station.value("material", "contact 1") is None)
            station.sim(f"hold {done + 4}")
            refused = station.wait_for_refusal("environment_stale")
            expect("'material/contact 1'" in refused["sentence"] and refused["step"] == done, f"{refused}")
            seen = wait_until("the CNC has read the refusal", lambda: (s := station.sim("status"))["fault_sequence"] == done + 1 and s)
            expect(seen["result"] == 4 and seen["done"] == done, f"the CNC has read {seen}")
        finally:
            station.usb("plug material")
        wait_until(f"udev made {LINKS['material']} again", Path(LINKS["material"]).exists)
        station.wait_until_good("material")
        station.foreign_request(0)
        station.foreign_request(done + 1)
        wait_until("the point is taken", lambda: station.run()["step"] > done)
    told = wait_until("the journal says that it is back", lambda: told_of("material", since, "is available."))
    print("\n".join(told))
    gone = [line for line in told if any(f"material is {state}." in line for state in GONE)]
    expect(len(gone) == 1, f"that it is gone is told {len(gone)} times: {told}")


@check("JournalIsSearchedByFaultRunAndInstrument")
def journal_fields(station):
    """docs/install.md. The run and the sensor are those of the check before; what is about nothing has no such field."""
    run_id = station.run()["id"]
    refused = entries("AXISCAL_FAULT=environment_stale", f"AXISCAL_RUN={run_id}")
    expect(refused and all("is refused: " in one["MESSAGE"] for one in refused), f"{refused}")
    of_sensor = entries("AXISCAL_INSTRUMENT=material")
    expect(any(one["MESSAGE"] == "material is available." for one in of_sensor), f"{of_sensor}")
    ready = next(one for one in entries() if one["MESSAGE"] == "ready")
    expect(not any(name.startswith("AXISCAL_") for name in ready), f"{ready}")
    for one in (*refused, *of_sensor, ready):
        named = {name: one.get(name) for name in ("PRIORITY", "SYSLOG_FACILITY", "_SYSTEMD_UNIT")}
        expect(named == {"PRIORITY": "6", "SYSLOG_FACILITY": "3", "_SYSTEMD_UNIT": "axiscald.service"}, f"{one}")


@check("RunGoesOnAfterTheWatchdogKilledTheDaemon")
def watchdog(station):
    """The run of the checks before. The clock is an hour slow from before the restart to behind the end of the run."""
    if not station.run():
        station.begin_run()
    with station.clock.right_at_the_end():
        station.clock.an_hour_back()
        goes_on_after_the_watchdog(station)


def goes_on_after_the_watchdog(station):
    station.sim("go")
    station.wait_for_points(station.run()["step"] + 1)
    run_id, pid = station.run()["id"], station.pid()
    os.kill(pid, signal.SIGSTOP)
    wait_until("systemd restarts the daemon", lambda: shown("axiscald", "NRestarts")["NRestarts"] == "1", WATCHDOG_S)
    wait_until("the daemon is ready again", lambda: shown("axiscald", "SubState")["SubState"] == "running")
    print(journal()[-3000:])
    expect(station.pid() != pid, "it is the same process")
    expect("Watchdog timeout" in run("journalctl", "--no-pager", "-o", "cat"), "the journal does not name the watchdog")
    wait_until("the open run goes on", station.run)
    expect(station.run()["id"] == run_id, "another run goes on")
    wait_until("the new process keeps the computer awake", lambda: "sleep" in kept_awake())
    station.wait_until_good(*DIRECT)  # the unit lets the new process to them, too, while the run is made
    station.axiscal("watch", "--until-published")
    wait_until("the computer may fall asleep again", lambda: "sleep" not in kept_awake())
    # File by file, each whole at once under its name.
    published = wait_until("the certificate is on the share",
                           lambda: [one for one in PUBLISHED.rglob("certificate.json") if one.with_suffix(".pdf").exists()])
    certificate = json.loads(published[0].read_text())
    rows = certificate["run"]["deviations"]
    expect([len(row) for row in rows["forward"] + rows["backward"]] == [2] * 10, f"{rows}")
    expect("The run was interrupted at" in " ".join(certificate["run"]["remarks"]), f"{certificate['run']['remarks']}")
    expect(published[0].with_suffix(".pdf").stat().st_size > 10000, f"{list(PUBLISHED.rglob('*'))}")
    station.sim("truth truth.json")
    missed = compare(json.loads((station.folder / "truth.json").read_text()), certificate)
    expect(not set(missed) & set(BOUNDED), f"outside of the truth: {', '.join(missed)}")


@check("RunAndCertificateKeepTheirTimesWhateverTheClockWasSetTo")
def times_kept(station):
    """Of the run above: no sample is missing, each point stands where it was taken, and on paper it does so in UTC by
    the clock tie of the opening, whatever the clock said at that moment. The end is the test of it: the clock was wrong
    then, and the file says so."""
    opened, closed, points = guest_clock.read_run(station.run()["file"])
    counts = (len(points), len(station.taken))
    expect(counts == (20, 8), f"of {counts[0]} points {counts[1]} were taken while the clock was set, not 8 of 20")
    guest_clock.judge_samples(points)
    guest_clock.judge_points(points, station.taken)
    guest_clock.judge_ties(station.clock, opened, closed, closed_ahead_s=-guest_clock.HOUR_S)
    folder = next(PUBLISHED.rglob("certificate.json")).parent
    table = wait_until("its table is on the share", lambda: next(folder.glob("certificate.csv"), None)).read_text()
    certificate = json.loads((folder / "certificate.json").read_text())
    said = " ".join(certificate["run"]["remarks"])
    expect("was set in mid-run" in said, f"the certificate does not say that the clock was set: {said}")
    guest_clock.judge_papers(station.clock, opened, closed, points, certificate, table)


@check("KilledDaemonIsBackAtOnce")
def killed(station):
    before = int(shown("axiscald", "NRestarts")["NRestarts"])
    run("systemctl", "kill", "-s", "KILL", "axiscald")
    wait_until("systemd restarts the daemon", lambda: int(shown("axiscald", "NRestarts")["NRestarts"]) == before + 1)
    wait_until("the daemon is ready again", lambda: shown("axiscald", "SubState")["SubState"] == "running")
    station.wait_until_good(*LINKS, *DIRECT)


@check("ServiceStopsInOrderWhileAnInstrumentHangs")
def stops(station):
    """The daemon ends by itself, and nobody loses patience: the kernel keeps its corpse while the control requests
    of the hanging adapters run out, which take 5 s each; no signal cuts them short."""
    station.usb("fault material mute")
    station.usb("fault air mute")
    wait_until("the sensor is given up", lambda: station.state("material") == "unavailable", 30)
    before = len(journal())  # the watchdog has killed in an earlier check
    run("systemctl", "stop", "axiscald", limit_s=90)
    result, said = shown("axiscald", "Result", "ExecMainStatus"), journal()[before:]
    print(result, said[-1500:])
    expect(result == {"Result": "success", "ExecMainStatus": "0"}, f"{result}\n{said[-3000:]}")
    expect("stopping" in said, f"the stop itself is not in what is looked at: {said}")
    expect("Killing process" not in said and "timed out" not in said, said[-3000:])


def main():
    with ServiceStation() as station:
        return run_checks(station)


sys.exit(main())
