"""A PC with a disk of its own: Debian's kernel, systemd, a network card, and serial lines that lead out of it.

QEMU in pure emulation, as in tests/kernel/machine.py, but with the clock of the host: what stands around the PC (machine,
instruments, CNC, file server) runs outside and lives on while the PC restarts. People enter by ssh.
"""

import contextlib
import ctypes
import shlex
import shutil
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent / "kernel"))
import machine

DIE_WITH_PARENT = 1  # PR_SET_PDEATHSIG of prctl(2)
BOOT_LIMIT_S = 180
LIBC = ctypes.CDLL(None)


class Ended(AssertionError):
    """A command inside ended otherwise than it should."""


class Computer:
    """`ports`: of each TCP port of this computer that leads in, the one inside; the first is that of ssh. `usb`: of each serial
    adapter its USB serial number and the terminal outside that it is wired to. `com`: the terminal behind the PC's own serial
    port, /dev/ttyS1 inside; None: nothing is plugged in there."""

    def __init__(self, folder, disk, key, ports, usb, com):
        self.folder, self.disk, self.key, self.ports = Path(folder), disk, Path(key), ports
        self.usb, self.com, self.process = usb, com, None
        self.monitor = self.key.parent / "monitor"  # a short path, as a socket's must be
        self.boots = 0

    def words(self):
        def quoted(path):
            return str(path).replace(",", ",,")
        leads_in = "".join(f",hostfwd=tcp:127.0.0.1:{outside}-:{inside}" for outside, inside in self.ports.items())
        kernel = next((machine.RIG / "unpacked/boot").glob("vmlinuz-*"))  # with its stub, or it could not wake up (PVH)
        words = ["qemu-system-x86_64", "-accel", "tcg", "-cpu", "max", "-M", "q35", "-m", "1024", "-nodefaults", "-no-reboot",
                 "-display", "none", "-kernel", str(kernel), "-initrd", str(machine.RIG / "initrd.gz"),
                 "-append", "console=ttyS0 quiet panic=-1 mitigations=off rig.disk",
                 "-drive", f"file={quoted(self.disk)},format=raw,if=virtio,cache=unsafe",
                 *machine.folder_words("modules", machine.RIG / "unpacked/lib/modules", True),
                 "-netdev", f"user,id=wire{leads_in}", "-device", "e1000,netdev=wire",
                 "-device", "virtio-rng-pci",
                 "-chardev", f"file,id=console,path={quoted(self.folder / f'console.{self.boots}.log')}", "-serial", "chardev:console",
                 "-device", "qemu-xhci", "-monitor", f"unix:{quoted(self.monitor)},server=on,wait=off"]
        if self.com:
            words += ["-chardev", f"serial,id=com,path={quoted(self.com)}", "-serial", "chardev:com"]
        for serial, terminal in self.usb.items():
            words += ["-chardev", f"serial,id={serial},path={quoted(terminal)}",
                      "-device", f"usb-serial,chardev={serial},serial={serial}"]
        return words

    def start(self):
        """Until people can enter."""
        self.boots += 1
        with open(self.folder / "qemu.log", "ab") as log:
            self.process = subprocess.Popen(self.words(), stdin=subprocess.DEVNULL, stdout=log, stderr=log,
                                            preexec_fn=lambda: LIBC.prctl(DIE_WITH_PARENT, signal.SIGKILL))
        end = time.monotonic() + BOOT_LIMIT_S
        while self.ssh("root", "true").returncode != 0:
            if self.process.poll() is not None or time.monotonic() > end:
                raise AssertionError(f"the PC does not start: {(self.folder / 'qemu.log').read_text()}{self.console()[-3000:]}")
            time.sleep(0.5)

    def console(self):
        logs = sorted(self.folder.glob("console.*.log"))
        return logs[-1].read_text(errors="replace") if logs else ""

    def ssh_words(self, user, command, more=()):
        words = ["ssh", *more, "-i", self.key, "-p", next(iter(self.ports)), "-o", "BatchMode=yes", "-o", "StrictHostKeyChecking=no",
                 "-o", "UserKnownHostsFile=/dev/null", "-o", "LogLevel=ERROR", "-o", "ConnectTimeout=20", "-o", "ControlMaster=auto",
                 "-o", f"ControlPath={self.key.parent}/s%C", "-o", "ControlPersist=yes", f"{user}@127.0.0.1", command]
        return [str(word) for word in words]

    def ssh(self, user, command, given=None, limit_s=600, more=()):
        """One connection is kept open for each user: a new one costs the emulated processor a second."""
        return subprocess.run(self.ssh_words(user, command, more), input=given, stdin=None if given is not None else subprocess.DEVNULL,
                              capture_output=True, text=True, timeout=limit_s, check=False)

    def run(self, command, user="root", code=0, given=None, limit_s=600):
        """What a person types; its exit code must be `code`. Gives back what it printed."""
        done = self.ssh(user, command, given, limit_s)
        if done.returncode != code:
            raise Ended(f"{user}@hall-3: {command}: exit {done.returncode}, not {code}\n{done.stdout}{done.stderr}")
        return done.stdout

    def go_down(self, word):
        """reboot or poweroff, until it is off. The connection may end before systemctl's answer has come: ssh says 255 then."""
        done = self.ssh("root", f"systemctl {word}")
        if done.returncode not in (0, 255):
            raise Ended(f"systemctl {word}: exit {done.returncode}\n{done.stdout}{done.stderr}")
        self.wait_for_end()

    def log_out(self, user):
        self.ssh(user, "true", more=("-O", "exit"))

    def put(self, file, folder):
        """Carries a file in, as on a USB stick."""
        with open(file, "rb") as given:
            command = f"cat >{shlex.quote(f'{folder}/{Path(file).name}')}"
            subprocess.run(self.ssh_words("root", command), stdin=given, check=True, timeout=300)

    def wait_for_end(self, limit_s=120):
        """After it was told to restart or to go off."""
        self.process.wait(limit_s)
        for kept in self.key.parent.glob("s*"):
            if kept.is_socket():
                kept.unlink()

    def tell_qemu(self, command):
        """Gives back what its monitor answers."""
        with socket.socket(socket.AF_UNIX) as wire:
            wire.settimeout(20)
            wire.connect(str(self.monitor))
            heard = wire.makefile("rw")
            heard.write(command + "\n")
            heard.flush()
            said = ""
            while said.count("(qemu) ") < 2:
                said += heard.read(1)
            return said

    def sleep(self, seconds, limit_s=60):
        """It was told to suspend; after so many seconds of it somebody presses its key."""
        end = time.monotonic() + limit_s
        while "suspended" not in self.tell_qemu("info status"):
            if time.monotonic() > end:
                raise AssertionError(f"the PC does not suspend: {self.console()[-2000:]}")
            time.sleep(0.2)
        time.sleep(seconds)
        self.tell_qemu("system_wakeup")

    def kill(self):
        if self.process:
            with contextlib.suppress(ProcessLookupError):
                self.process.kill()
            self.process.wait()
            self.process = None


def fresh_disk(made, to):
    """A copy of the disk; what was never written stays so."""
    subprocess.run(["cp", "--sparse=always", "--reflink=auto", made, to], check=True)
    return to


def require_programs():
    machine.require_programs("ssh", "ssh-keygen", "mmdebstrap", "mkfs.ext4")
    machine.build()
    return shutil.which("qemu-system-x86_64")
