"""Inside the guest of wires.py: what axiscald takes of a processor while instruments stream. One JSON object a row."""
import contextlib
import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

SOURCE = Path(os.environ["AXISCAL_SOURCE"])
sys.path.insert(0, str(SOURCE / "tests/kernel"))
from guest import PROGRAMS, Commands, Programs, load_modules, run, start_udev, wait_until  # noqa: E402

SECONDS = 20.0
BUS, BITS_A_SECOND = "vcan0", 1_000_000
FRAME_BITS = 111  # eight data bytes, 11-bit identifier, gap between frames, not one stuffed bit
FLOOD_HZ = 6300   # with the two transducers above 90 % of what the bus can carry, counted so
BARS, PROBES = {"ballbar": 127, "gauge": 126}, {f"probe-{n}": 10 + n for n in range(1, 9)}
SCENARIO = SOURCE / "tests/peers/linuxcnc/quiet-circle.toml"
FOLDER = Path("/run/wires")
STATION = f"""
[station]
name = "wires"
state_directory = "{FOLDER}/state"
[ballbar]
sensor = "ballbar/ballbar"
length = "100 mm"
[circular]
radius = "100 mm"
feed = "1000 mm/min"
[trigger]
shape = "single-register"
transport = "tcp"
host = "127.0.0.1"
port = 1502
[console]
socket = "{FOLDER}/axiscald.sock"
group = ""
port = 0
[certificate]
machine = "none"
"""


def cpu_ns(pid):
    """Of all its threads, by the scheduler's own count."""
    return sum(int(task.read_text().split()[0]) for task in Path(f"/proc/{pid}/task").glob("*/schedstat"))


def percent_of(pids, seconds=SECONDS):
    before, began = [cpu_ns(pid) for pid in pids], time.monotonic_ns()
    time.sleep(seconds)  # the length of a measurement, not a hope
    span = time.monotonic_ns() - began
    return [100 * (cpu_ns(pid) - then) / span for pid, then in zip(pids, before)]


def status():
    environment = {**os.environ, "AXISCAL_SOCKET": str(FOLDER / "axiscald.sock")}
    done = subprocess.run([PROGRAMS / "axiscal", "status", "--json"], env=environment, capture_output=True, text=True)
    return json.loads(done.stdout) if done.returncode == 0 else None


def instrument(name):
    return next(one for one in status()["instruments"] if one["name"] == name)


def start_daemon(programs, instruments, names):
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    (FOLDER / "station.toml").write_text(STATION + instruments)
    os.environ["AXISCAL_PROFILE_PATH"] = str(SOURCE / "config/profiles")
    programs.start("axiscald", "axiscald", "--config", FOLDER / "station.toml")
    wait_until("the station is up", status)
    for name in names:
        wait_until(f"{name} is available", lambda name=name: instrument(name)["state"] == "available")
    return programs.running["axiscald"].pid


def passed():
    return int(Path(f"/sys/class/net/{BUS}/statistics/tx_packets").read_text())


class Lost:
    """Frames of the transducers that the daemon did not see; what the emulation skipped itself is no loss."""

    def count(self):
        devices = Commands(FOLDER.parent / "can.sock").ask("status")["devices"]
        return sum(instrument(name)["lost_records"] - devices[name]["skipped"] for name in BARS)

    def settled(self):
        before = self.count()
        time.sleep(0.5)  # a skip is told 32 frames later
        return before == self.count()

    def now(self):
        wait_until("the books agree", self.settled)
        return self.count()


class Witness:
    """candump beside the daemon, where it is installed: which frames of the transducers it saw."""

    def __init__(self):
        self.said = FOLDER.parent / "candump.txt"
        self.process = None
        if shutil.which("candump"):
            with open(self.said, "wb") as out:
                self.process = subprocess.Popen(["candump", BUS], stdout=out)

    def frames(self):
        said = self.said.read_bytes()
        return sum(said.count(f" {0x180 + node:03X} ".encode()) for node in BARS.values())

    def end(self):
        if self.process:
            self.process.terminate()
            self.process.wait()


def samples():
    return sum(instrument(name)["samples"] for name in BARS)


def measure_can(programs):
    run("ip", "link", "add", BUS, "type", "vcan")
    run("ip", "link", "set", BUS, "up")
    words = ["can", "--scenario", SCENARIO, "--interface", BUS, "--control", FOLDER.parent / "can.sock"]
    for name, node in BARS.items():
        words += ["--device", f"temposonics,called={name},node={node},mm=1"]
    for name, node in PROBES.items():
        words += ["--device", f"cantrans,called={name},node={node}"]
    programs.start_ready("can", "axiscal-simulate", *words)
    drivers = [*((name, "canopen-406", node) for name, node in BARS.items()),
               *((name, "canopen-404", node) for name, node in PROBES.items())]
    text = "".join(f'[[instrument]]\nname = "{name}"\ndriver = "{driver}"\nlink = "can:{BUS}"\nnode = {node}\n'
                   for name, driver, node in drivers)
    daemon = start_daemon(programs, text, [*BARS, *PROBES])
    lost, witness = Lost(), Witness()
    pids = [daemon, *([witness.process.pid] if witness.process else [])]
    with contextlib.ExitStack() as ends:
        ends.callback(witness.end)
        for name, flood in (("CAN: 2 transducers at 1 kHz, 8 sensors", 0), ("the same at 90 % of the bus", FLOOD_HZ)):
            Commands(FOLDER.parent / "can.sock").do(f"flood {flood}")
            # The daemon is looked at around candump: what candump saw in between, it must have seen.
            lost_before, samples_before = lost.now(), samples()
            frames_before = witness.frames() if witness.process else 0
            passed_before, began = passed(), time.monotonic()
            found = percent_of(pids)
            load = (passed() - passed_before) / (time.monotonic() - began) * FRAME_BITS / BITS_A_SECOND
            row = {"row": name, "percent": found[0], "candump": found[1] if len(found) > 1 else None, "goal": 2.0,
                   "load": 100 * load}
            if witness.process:
                row["candump_frames"] = witness.frames() - frames_before
                row["frames"] = samples() - samples_before
            Commands(FOLDER.parent / "can.sock").do("flood 0")
            yield {**row, "lost": lost.now() - lost_before}
    programs.end("axiscald")


def measure_u6(programs):
    programs.start_ready("usb", "axiscal-simulate", "usb", "--scenario", SCENARIO, "--control", FOLDER.parent / "usb.sock",
                         "--device", "labjack-u6,called=ballbar,serial=470012345,volts=1")
    text = '[[instrument]]\nname = "ballbar"\ndriver = "labjack-u6"\nlink = "usb:470012345"\nscale_length = "1 mm"\n'
    daemon = start_daemon(programs, text, ["ballbar"])
    before, began = instrument("ballbar"), time.monotonic()
    percent, = percent_of([daemon])
    after, span = instrument("ballbar"), time.monotonic() - began
    yield {"row": "LabJack U6, stream of 1 kHz", "percent": percent, "goal": 1.0, "lost": after["lost_records"] - before["lost_records"],
           "hz": (after["samples"] - before["samples"]) / span}


def main():
    load_modules("vcan", "can_raw", "vhci_hcd")
    start_udev()
    with Programs() as programs:
        for measure in (measure_can, measure_u6):
            for row in measure(programs):
                print(json.dumps(row), flush=True)


main()
