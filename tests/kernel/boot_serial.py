"""Serial instruments on the kernel's own drivers: the µMD counter and a Dracal stick by cdc_acm,
a Modbus sensor by ftdi_sio. A plain guest with udev."""

import sys

from guest import SOURCE, Commands, Programs, check, expect, load_modules, run_checks, start_udev, wait_until
from pathlib import Path


class World:
    def __init__(self, programs):
        self.programs = programs


@check("TheKernelMakesATerminalOfEachAdapter")
def terminals(world):
    world.programs.start_ready(
        "world", "axiscal-simulate", "--scenario", SOURCE / "tools/axiscal-simulate/scenarios/demo.toml",
        "--control", "/run/world.sock")
    world.programs.start_ready(
        "usb", "axiscal-simulate", "usb", "--scenario", SOURCE / "tools/axiscal-simulate/scenarios/demo.toml",
        "--control", "/run/usb.sock",
        "--device", "cdc-acm,called=laser,serial=1234560,behind=laser.tty",
        "--device", "cdc-acm,called=air,vendor=289b,product=0505,maker=Dracal,name=VCP-PTH450,serial=E24638,behind=air.tty",
        "--device", "ftdi,called=material,serial=A600AXIS,behind=material.tty")
    for node in ("/dev/ttyACM0", "/dev/ttyACM1", "/dev/ttyUSB0", "/dev/axiscal/umd-1234560-00"):
        wait_until(f"{node} is there", Path(node).exists)
    print(sorted(map(str, Path("/dev/axiscal").iterdir())), sorted(map(str, Path("/dev/serial/by-id").iterdir())))
    print(Commands("/run/usb.sock").ask("status"))


def main():
    load_modules("vhci_hcd", "cdc_acm", "ftdi_sio")
    start_udev()
    with Programs() as programs:
        return run_checks(World(programs))


sys.exit(main())
