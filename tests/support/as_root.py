"""Runs a test script once more as root, through sudo, for a person who is not root.

The person's process stays the parent: it passes the answer on, removes what root left in the scratch folder, and is what
ctest ends. Once it is gone the child under root hears the end of its standard input, cleans up and ends, too: nobody but root
could stop it. tools/test asks for the password before the tests; here sudo is never given one.
"""
import contextlib
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading

CHILD = "AXISCAL_UNDER_ROOT"  # set for the child alone
HANDED_ON = ("PATH", "LC_ALL", "TZ", "PYTHONDONTWRITEBYTECODE", "ASAN_OPTIONS", "UBSAN_OPTIONS", "LSAN_OPTIONS", "TSAN_OPTIONS")
WAY_OUT = "run as root, or as a user whom sudo obeys without a password or after tools/test asked for it"


class NoRoot(Exception):
    """Neither root nor sudo; the message tells why and the way out."""


def require():
    """Nothing where this process is root. Else the script runs to its end under sudo, and this process ends with the same code.
    Call it before anything is made that must be removed again.
    @raise NoRoot where sudo is missing or refuses."""
    if os.geteuid() == 0:
        if CHILD in os.environ:
            _end_with_parent()
        return
    _try_sudo()
    sys.exit(_run_again())


def _try_sudo():
    if not shutil.which("sudo"):
        raise NoRoot(f"this needs root, and sudo is not installed: {WAY_OUT}")
    tried = subprocess.run(["sudo", "-n", "true"], stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    if tried.returncode != 0:
        raise NoRoot(f"this needs root ({tried.stderr.strip() or 'sudo refuses'}): {WAY_OUT}")


def _words(scratch):
    """sudo's own policy drops PATH and most names, so they are written out for env(1)."""
    names = [name for name in os.environ if name.startswith("AXISCAL_") or name in HANDED_ON]
    kept = [f"{name}={os.environ[name]}" for name in sorted(names)]
    return ["sudo", "-n", "--", "env", *kept, f"TMPDIR={scratch}", f"{CHILD}=1", sys.executable, *sys.orig_argv[1:]]


def _run_again():
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("ended by SIGTERM"))
    memory = "/dev/shm" if "TMPDIR" not in os.environ and os.access("/dev/shm", os.W_OK) else None
    scratch = tempfile.mkdtemp(prefix="axiscal-root-", dir=memory)
    os.chmod(scratch, 0o755)  # servers that the test starts serve it as users of their own
    try:
        child = subprocess.Popen(_words(scratch), stdin=subprocess.PIPE)
        try:
            return child.wait()
        finally:
            child.stdin.close()
            child.wait()
    finally:
        subprocess.run(["sudo", "-n", "rm", "-rf", "--one-file-system", "--", scratch], stdin=subprocess.DEVNULL, check=False)


def _end_with_parent():
    """The parent keeps the other end of standard input; its end is the end of this process, in order, by SIGTERM."""
    os.environ.pop(CHILD)
    if signal.getsignal(signal.SIGTERM) == signal.SIG_DFL:
        signal.signal(signal.SIGTERM, lambda *_: sys.exit("ended by SIGTERM"))

    def listen():
        with contextlib.suppress(OSError):
            while os.read(line, 4096):
                pass
        signal.pthread_kill(threading.main_thread().ident, signal.SIGTERM)  # another thread would not wake it

    line = os.dup(0)
    with open(os.devnull, "rb") as nothing:  # what the test starts must not hear the line
        os.dup2(nothing.fileno(), 0)
    threading.Thread(target=listen, daemon=True).start()
