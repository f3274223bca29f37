"""What a program finds inside a service's unit, and the page that says so (docs/sandbox.md)."""

import re
from pathlib import Path

from guest import SOURCE, expect, run

SERVICES = ("axiscald", "axiscal-publish", "axiscal-notify")
PAGE = SOURCE / "docs/sandbox.md"
WORDS = {"reads", "writes", "shut", "may", "may not"}

# Runs as the service; the names of the page stand in `files` and `calls`.
PROBE = """
import ctypes, mmap, os, socket, tempfile

libc = ctypes.CDLL(None, use_errno=True)

def called(result):
    if result < 0:
        raise OSError(ctypes.get_errno(), "refused")

def opened(path, how):
    os.close(os.open(path, how | os.O_NONBLOCK | os.O_NOCTTY))

def written(path):
    if os.path.isdir(path):
        os.unlink(tempfile.mkstemp(dir=path)[1])
    else:
        opened(path, os.O_WRONLY)

def read(path):
    if os.path.isdir(path):
        os.listdir(path)
        return
    opened(path, os.O_RDONLY)
    with open(path, "rb") as file:
        if path.startswith("/proc/") and not file.read(1):
            raise OSError(0, "empty")

def try_file(path):
    for word, attempt in (("writes", written), ("reads", read)):
        try:
            attempt(path)
            return word
        except OSError as error:
            if error.errno == 16:  # busy: it may, but somebody has it
                return "writes"
    return "shut"

def chown():
    with tempfile.NamedTemporaryFile() as file:
        os.chown(file.name, os.getuid(), os.getgid())

def fork():
    child = os.fork()
    if child == 0:
        os._exit(0)
    os.waitpid(child, 0)

def capable():
    status = open("/proc/self/status").read()
    if not int(status.split("CapEff:")[1].split()[0], 16):
        raise OSError(1, "none")

calls = {f"socket {name}": lambda name=name: socket.socket(getattr(socket, name), socket.SOCK_DGRAM if "INET" in name
         or "UNIX" in name else socket.SOCK_RAW, {"AF_CAN": 1}.get(name, 0)).close()
         for name in ("AF_UNIX", "AF_INET", "AF_INET6", "AF_NETLINK", "AF_CAN", "AF_PACKET")}
calls |= {
    "inotify_init1": lambda: called(libc.inotify_init1(0)),
    "pidfd_open": lambda: os.pidfd_open(os.getpid()),
    "getaddrinfo": lambda: socket.getaddrinfo("localhost", 1),
    "fork": fork,
    "chown": chown,
    "setpriority": lambda: os.setpriority(os.PRIO_PROCESS, 0, 1),
    "sched_setscheduler": lambda: os.sched_setscheduler(0, os.SCHED_BATCH, os.sched_param(0)),
    "adjtimex": lambda: called(libc.adjtimex(ctypes.create_string_buffer(512))),
    "clock_settime": lambda: __import__("time").clock_settime(0, __import__("time").time()),
    "mmap write and execute": lambda: mmap.mmap(-1, 4096, prot=mmap.PROT_READ | mmap.PROT_WRITE | mmap.PROT_EXEC).close(),
    "unshare": lambda: called(libc.unshare(0x10000000)),
    "capabilities": capable,
    "connect to D-Bus": lambda: socket.socket(socket.AF_UNIX).connect("/run/dbus/system_bus_socket"),
}

def try_call(name):
    try:
        calls[name]()
        return "may"
    except OSError:
        return "may not"

for name in names:
    print((try_file if name.startswith("/") else try_call)(name), name, sep="\\t")
"""


def claimed():
    """Of each row of the page, what it says of each service."""
    rows = {}
    for line in PAGE.read_text().splitlines():
        row = re.fullmatch(r"\| `([^`]+)` \| ([a-z ]+) \| ([a-z ]+) \| ([a-z ]+) \|.*\|", line)
        expect(row or not line.startswith("| `"), f"docs/sandbox.md: no row of this form: {line}")
        if row:
            rows[row[1]] = row.groups()[1:]
    expect(rows and {word for words in rows.values() for word in words} <= WORDS, f"docs/sandbox.md: {rows}")
    return rows


def inside(service, script):
    """What the script prints in a unit that differs from the service's by its program only."""
    Path("/run/inside.py").write_text(script)
    unit = run("systemctl", "cat", service)
    unit = re.sub(r"^ExecStart=.*", "ExecStart=/usr/bin/python3 -I /run/inside.py", unit, flags=re.M)
    unit = re.sub(r"^Type=.*", "Type=oneshot", unit, flags=re.M)
    unit = re.sub(r"^(WatchdogSec|Restart|RestartSec|NotifyAccess)=.*\n", "", unit, flags=re.M)
    # The daemon's folder in /run must outlive this shell.
    unit = unit.replace("[Service]", "[Service]\nRuntimeDirectoryPreserve=yes\nStandardOutput=truncate:/run/inside.out")
    Path("/run/systemd/system").mkdir(parents=True, exist_ok=True)
    Path("/run/systemd/system/axiscal-inside.service").write_text(unit)
    run("systemctl", "daemon-reload")
    run("systemctl", "start", "axiscal-inside")
    return Path("/run/inside.out").read_text()


def found(service):
    said = inside(service, f"names = {list(claimed())!r}\n{PROBE}")
    return {name: word for word, name in (line.split("\t") for line in said.splitlines())}


def judge():
    rows, wrong = claimed(), []
    for service in SERVICES:
        truth = found(service)
        wanted = {name: words[SERVICES.index(service)] for name, words in rows.items()}
        wrong += [f"{service}: {name} is {truth.get(name)}, not {word}" for name, word in wanted.items() if truth.get(name) != word]
        print(service, *(f"{word}\t{name}" for name, word in truth.items()), sep="\n")
    expect(not wrong, f"docs/sandbox.md, {'; '.join(wrong)}")
