"""A real Samba server on a port of its own, for one test; and the publisher beside it.

Debian's smbd with every folder of its state in a scratch folder, never the system's own. It needs root, so require() starts
the script again through sudo for everybody else; the account is "games", which every Debian has and nobody logs in with.
"""
import contextlib
import ctypes
import hashlib
import json
import os
import random
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / "support"))
import as_root

PATIENCE_S = 90  # only ends a failing test
LOOK_S = 0.002
USER, PASSWORD = "games", "shopfloor"
DIE_WITH_PARENT = 1  # PR_SET_PDEATHSIG of prctl(2)
NEW_NETWORK, NEW_MOUNTS = 0x40000000, 0x00020000  # CLONE_NEWNET, CLONE_NEWNS of unshare(2)
LIBC = ctypes.CDLL(None, use_errno=True)

SMB_CONF = """[global]
  workgroup = SHOP
  server role = standalone server
  interfaces = {interface}
  bind interfaces only = yes
  smb ports = {port}
  server min protocol = SMB2_10
  server smb encrypt = required
  map to guest = never
  disable netbios = yes
  load printers = no
  printcap name = /dev/null
  disable spoolss = yes
  unix extensions = no
  deadtime = 0
  passdb backend = tdbsam:{home}/private/passdb.tdb
  private dir = {home}/private
  lock directory = {home}/lock
  state directory = {home}/state
  cache directory = {home}/cache
  ncalrpc dir = {home}/ncalrpc
  pid directory = {home}/run
  log file = {home}/smbd.log
  log level = 2
  max log size = 0
{more}
{shares}"""
SHARE = """[{name}]
  path = {path}
  read only = no
  valid users = games
"""


class Skip(Exception):
    """What is missing here and cannot be had."""


def die_with_parent():
    LIBC.prctl(DIE_WITH_PARENT, signal.SIGKILL)


def expect(condition, message):
    if not condition:
        raise AssertionError(message)


def wait_until(what, probe, limit_s=PATIENCE_S):
    end = time.monotonic() + limit_s
    while True:
        found = probe()
        if found:
            return found
        expect(time.monotonic() < end, f"after {limit_s:g} s still not: {what}")
        time.sleep(LOOK_S)


def run(*words, **more):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=PATIENCE_S, check=False, **more)
    expect(done.returncode == 0, f"{' '.join(map(str, words))}: {done.returncode} {done.stdout}{done.stderr}")
    return done.stdout


def free_port():
    while True:
        port = random.SystemRandom().randint(12000, 32000)
        with socket.socket() as probe, contextlib.suppress(OSError):
            probe.bind(("127.0.0.1", port))
            return port


def own_namespaces(kinds):
    """This process, and what it starts, leaves the computer's network or mounts behind."""
    if LIBC.unshare(kinds) != 0:
        raise Skip(f"no namespaces here: {os.strerror(ctypes.get_errno())}")


def require():
    """smbd and root, else Skip. Whoever is not root ends here with what the script says under sudo."""
    for tool in ("smbd", "smbpasswd", "smbclient"):
        if not shutil.which(tool, path=os.environ.get("PATH", "") + ":/usr/sbin"):
            raise Skip(f"{tool} is missing: tools/install-dependencies test")
    try:
        as_root.require()
    except as_root.NoRoot as why:
        raise Skip(f"smbd starts as root only; {why}") from why


class Samba:
    """One server; `share` is the folder behind //address:port/results."""

    def __init__(self, folder, address="127.0.0.1", interface="lo", enter=()):
        self.home = Path(folder) / "samba"
        self.share = Path(folder) / "share"
        self.address, self.port, self.enter = address, free_port(), list(enter)
        self.interface = interface
        for name in ("private", "lock", "state", "cache", "ncalrpc", "run"):
            (self.home / name).mkdir(parents=True, mode=0o755)
        (self.home / "private").chmod(0o700)
        self.share.mkdir()
        shutil.chown(self.share, USER)
        self.conf = self.home / "smb.conf"
        self.more, self.shares = "", ["results"]
        self.configure()
        run("smbpasswd", "-c", self.conf, "-s", "-a", USER, input=f"{PASSWORD}\n{PASSWORD}\n")
        self.process = None

    def configure(self):
        shares = "".join(SHARE.format(name=name, path=self.share) for name in self.shares)
        self.conf.write_text(SMB_CONF.format(home=self.home, port=self.port, interface=self.interface, more=self.more,
                                             shares=shares))

    @property
    def url(self):
        return f"smb://{self.address}:{self.port}/results"

    def start(self):
        """A process group of its own, so that all of its processes can be stopped at once."""
        with open(self.home / "smbd.out", "ab") as out:
            self.process = subprocess.Popen([*self.enter, "/usr/sbin/smbd", "-F", "--no-process-group", "-s", self.conf],
                                            stdin=subprocess.DEVNULL, stdout=out, stderr=out, start_new_session=True,
                                            preexec_fn=die_with_parent)
        wait_until("smbd listens", self.listens)
        return self

    def listens(self):
        expect(self.process.poll() is None, f"smbd ended: {(self.home / 'smbd.out').read_text()}")
        if self.enter:
            sockets = subprocess.run([*self.enter, "cat", "/proc/net/tcp"], capture_output=True, text=True, check=False).stdout
        else:
            sockets = Path("/proc/net/tcp").read_text()
        return any(f":{self.port:04X} " in line and " 0A " in line for line in sockets.splitlines())

    def reload(self):
        self.configure()
        self.process.send_signal(signal.SIGHUP)

    def freeze(self):
        os.killpg(self.process.pid, signal.SIGSTOP)

    def thaw(self):
        os.killpg(self.process.pid, signal.SIGCONT)

    def kill(self):
        """Without a word, with all sessions."""
        if self.process:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(self.process.pid, signal.SIGKILL)
            self.process.wait()
            self.process = None

    def sessions_begun(self):
        """How often somebody gave the account and was let in. (Samba 4.22 tells no connection to a share.)"""
        return (self.home / "smbd.log").read_text(errors="replace").count("authentication for user [games] -> [games] -> [games] succeeded")

    def client(self, commands, *, enter=()):
        return run(*enter, "smbclient", "-s", self.conf, "-p", self.port, "-U", f"{USER}%{PASSWORD}",
                   f"//{self.address}/results", "-c", commands)


class Publisher:
    """axiscal-publish as a service; everything it says with --json is kept."""

    def __init__(self, program, outbox, to, account, *more):
        self.said, self.log = [], []
        patience = () if "--timeout" in more else ("--timeout", "1")
        words = [program, "--outbox", outbox, "--to", to, "--credentials", account, "--json", "--retry", "0.1", *patience, *more]
        self.process = subprocess.Popen([str(word) for word in words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                        preexec_fn=die_with_parent)
        self.threads = [threading.Thread(target=self._hear, args=ear, daemon=True)
                        for ear in ((self.process.stdout, self.said, json.loads), (self.process.stderr, self.log, str.strip))]
        for thread in self.threads:
            thread.start()

    @staticmethod
    def _hear(stream, into, read):
        for line in stream:
            into.append(read(line))

    def reasons(self):
        return [line["reason"] for line in self.said if line["event"] == "waiting"]

    def waits_because(self, words, since=0):
        """Until it tells a reason with these words; returns it."""
        def told():
            expect(self.process.poll() is None, f"axiscal-publish ended: {self.log[-3:]}")
            return [reason for reason in self.reasons()[since:] if words in reason]
        return wait_until(f"a reason with '{words}' among {self.reasons()[-3:]}", told)[0]

    def published(self, count=1):
        """What it told of its first so many results, once it told them."""
        def told():
            return [line for line in self.said if line["event"] == "published"]
        wait_until(f"{count} results are told", lambda: len(told()) >= count)
        return told()

    def end(self, how=signal.SIGTERM):
        if self.process.poll() is None:
            self.process.send_signal(how)
        code = self.process.wait(PATIENCE_S)
        for thread in self.threads:
            thread.join(PATIENCE_S)
        return code


class Site:
    """An outbox, an account, a server; and what must be true of the share at every moment."""

    def __init__(self, program, folder=None, **server):
        self.program = program
        memory = "/dev/shm" if "TMPDIR" not in os.environ and os.access("/dev/shm", os.W_OK) else None
        self.folder = Path(folder or tempfile.mkdtemp(prefix="axiscal-samba-", dir=memory))
        self.folder.chmod(0o755)
        self.samba = Samba(self.folder, **server)
        self.outbox = self.folder / "state" / "outbox"
        self.outbox.mkdir(parents=True)
        self.account = self.folder / "account"
        self.give_account(PASSWORD)
        self.staged, self.foreign, self.publisher, self.ended = {}, {}, None, []

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        if self.samba.process:
            self.samba.thaw()
        if self.publisher:
            self.publisher.end(signal.SIGKILL)
        self.samba.kill()
        if kind and not issubclass(kind, Skip):
            for name in ("smbd.out", "smbd.log"):
                log = self.samba.home / name
                if log.exists():
                    print(f"--- {name}\n" + log.read_text(errors="replace")[-2000:])
            if self.publisher:
                print("--- axiscal-publish\n" + "\n".join(self.publisher.log[-20:]))
        shutil.rmtree(self.folder, ignore_errors=True)

    def give_account(self, password):
        self.account.write_text(f"username={USER}\npassword={password}\n")
        self.account.chmod(0o600)

    def publish(self, *more, to=None):
        self.publisher = Publisher(self.program, self.outbox, to or self.samba.url, self.account, *more)
        return self.publisher

    def stage(self, run_id, size=20000, names=("certificate.json",)):
        """An entry as the report program leaves it."""
        staging = self.outbox / f".{run_id}.staging"
        staging.mkdir()
        files = {}
        for name in names:
            content = random.Random(f"{run_id}/{name}").randbytes(size)
            (staging / name).write_bytes(content)
            files[name] = hashlib.sha256(content).hexdigest()
        staging.rename(self.outbox / run_id)
        self.staged[run_id] = files

    def waiting(self):
        return sorted(entry.name for entry in self.outbox.iterdir() if not entry.name.startswith("."))

    def parts(self):
        return list(self.samba.share.glob("*/.*.part"))

    def on_share(self):
        """Every file under a final name, and its SHA-256."""
        return {str(file.relative_to(self.samba.share)): hashlib.sha256(file.read_bytes()).hexdigest()
                for file in sorted(self.samba.share.glob("*/*")) if file.is_file() and not file.name.endswith(".part")}

    def expect_whole(self):
        """Nothing on the share but whole files, and nobody else's was touched."""
        for name, digest in self.on_share().items():
            run_id, file = name.split("/")
            wanted = self.foreign.get(name) or self.staged.get(run_id.split("@")[0], {}).get(file)
            if wanted is None:  # a second folder of that run: <run-id>-2
                wanted = self.staged.get(run_id.rsplit("-", 1)[0], {}).get(file)
            expect(digest == wanted, f"{name} on the share is not what was staged")

    def expect_all_published(self):
        """The queue is empty; every staged file is on the share, once and whole, with its receipt."""
        wait_until(f"the outbox is empty; {self.publisher.reasons()[-1:]}", lambda: not self.waiting())
        self.expect_whole()
        found = self.on_share()
        for run_id, files in self.staged.items():
            receipt = json.loads((self.outbox.parent / "published" / run_id / "receipt.json").read_text())
            told = {one["name"]: one["sha256"] for one in receipt["files"]}
            expect(told == files, f"receipt of {run_id}: {told}")
            folder = receipt["folder"].rsplit("/", 1)[1]
            for name, digest in files.items():
                expect(found.get(f"{folder}/{name}") == digest, f"{folder}/{name} is not on the share")
        ours = sum(len(files) for files in self.staged.values())
        expect(len(found) == ours + len(self.foreign), f"{len(found)} files on the share, not {ours} and {len(self.foreign)}")
        expect(not self.parts(), f"unfinished files are left: {self.parts()}")

    def catch_in_mid_write(self, stop, go_on, size=48_000_000):
        """Stages big results until `stop` halted the work with one of them half on the share; returns its name."""
        for attempt in range(30):
            run_id = f"big-{attempt}"
            self.stage(run_id, size, ("raw.bin",))
            final = self.samba.share / run_id / "raw.bin"
            wait_until("a file is on its way", lambda: final.exists() or [p for p in self.parts() if p.stat().st_size > 0])
            stop()
            half = [part for part in self.parts() if 0 < part.stat().st_size < size]
            if half and not final.exists():
                return run_id
            go_on()
            wait_until("that one was too quick", final.exists)
        raise AssertionError("never met the publisher in mid-write")
