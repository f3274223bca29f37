"""A virtual computer with Debian's stock kernel, whose root is this computer's own.

QEMU in pure emulation (no /dev/kvm needed, no root), the kernel as Debian ships it, devices made
inside by the kernel's own virtual USB controller. Built once into build/rig of the source tree:
70 MB of download, 500 MB on disk, 10 s. A guest reaches its first line in about 4 s.

The guest's clock counts its instructions (2 ns each) and follows the host's only while the guest has
nothing to do: a deadline inside means the same on a busy host as on a free one. (Jumping over idle
time, sleep=off, would let deadlines pass while the host fetches a file.) The price is one processor.
"""

import contextlib
import fcntl
import lzma
import os
import re
import shutil
import subprocess
from pathlib import Path

HERE = Path(__file__).resolve().parent
RIG = HERE.parent.parent / "build" / "rig"
PROGRAMS = ("qemu-system-x86_64", "busybox", "cpio", "modprobe", "depmod", "apt-get", "dpkg")
SAYS_GOODBYE = 0xF4  # port of isa-debug-exit; a guest that writes n ends qemu with 2 n + 1
COUNTED = ("-accel", "tcg", "-icount", "shift=1", "-cpu", "qemu64")
FIRST_MODULES = ("virtio_pci", "9p", "9pnet_virtio", "overlay", "virtio_blk", "ext4")


class CanNotRun(Exception):
    """A program of the host is missing; the message says how to get it."""


def with_sbin():
    return {**os.environ, "PATH": os.environ.get("PATH", "") + ":/usr/sbin:/sbin"}


def run(*words, cwd=None):
    done = subprocess.run(words, cwd=cwd, env=with_sbin(), capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, words))}: {done.stdout}{done.stderr}")
    return done.stdout


def require_programs(*more):
    path = with_sbin()["PATH"]
    missing = [name for name in (*PROGRAMS, *more) if shutil.which(name, path=path) is None]
    if missing:
        raise CanNotRun(f"missing: {' '.join(missing)}; tools/install-dependencies test installs them")


def unpack_kernel():
    """The package is unpacked, not installed. Debian 12's image is an xz archive behind a stub; without the
    stub it starts 2.5 s earlier (PVH entry). That of Debian 13, packed otherwise, is started as it is."""
    depends = run("apt-cache", "depends", "linux-image-amd64").splitlines()
    package = next(line.split()[1] for line in depends if line.strip().startswith("Depends: linux-image-"))
    work = RIG / "unpacked"
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    run("apt-get", "download", "-qq", package, cwd=RIG)
    archive = next(RIG.glob(f"{package}_*.deb"))
    run("dpkg", "-x", archive, work)
    archive.unlink()
    if not (work / "lib").exists():  # Debian 13 has them below /usr alone
        (work / "lib").symlink_to("usr/lib")
    version = next((work / "lib/modules").iterdir()).name
    run("depmod", "-b", work, version)
    image = (work / f"boot/vmlinuz-{version}").read_bytes()
    at = image.find(b"\xfd7zXZ\0")
    (RIG / "kernel").write_bytes(lzma.LZMADecompressor().decompress(image[at:]) if at >= 0 else image)
    return version


def build_initrd(version):
    tree = RIG / "initrd"
    shutil.rmtree(tree, ignore_errors=True)
    for folder in ("bin", "proc", "sys", "dev", "modules", "root", "lower", "scratch"):
        (tree / folder).mkdir(parents=True)
    shutil.copy(shutil.which("busybox"), tree / "bin/busybox")
    shutil.copy(HERE / "initrd-init", tree / "init")
    (tree / "init").chmod(0o755)
    order = []
    for module in FIRST_MODULES:
        for line in run("modprobe", "-S", version, "-d", RIG / "unpacked", "--show-depends", module).splitlines():
            file = Path(line.removeprefix("insmod ").strip()) if line.startswith("insmod ") else None
            if file and file.name.removesuffix(".xz") not in order:
                order.append(file.name.removesuffix(".xz"))
                packed = file.read_bytes()  # Debian 13 packs each module
                (tree / "modules" / order[-1]).write_bytes(lzma.decompress(packed) if file.suffix == ".xz" else packed)
    (tree / "modules/order").write_text("\n".join(order) + "\n")
    run("sh", "-c", 'find . | cpio -o -H newc --quiet | gzip -1 >"$0"', RIG / "initrd.gz", cwd=tree)


def build():
    """Makes what is not there yet; several tests may ask at once."""
    require_programs()
    RIG.mkdir(parents=True, exist_ok=True)
    with open(RIG / "lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        known = RIG / "version"
        if not known.exists() or not (RIG / "kernel").exists():
            known.write_text(unpack_kernel())
        initrd = RIG / "initrd.gz"
        if not initrd.exists() or initrd.stat().st_mtime < (HERE / "initrd-init").stat().st_mtime:
            build_initrd(known.read_text())


def folder_words(tag, path, read_only):
    path = str(path).replace(",", ",,")  # QEMU's own way to write a comma
    device = f"local,id={tag},path={path},security_model=none,multidevs=remap"
    return ["-fsdev", device + (",readonly=on" if read_only else ""),
            "-device", f"virtio-9p-pci,fsdev={tag},mount_tag={tag}"]


def lay_secrets(share):
    """Whoever is not root cannot read the host's shadow files, nor can the guest then, which sees them through this user's QEMU
    and wants to add groups: it gets some of its own, without any password."""
    etc = share / "overlay/etc"
    for name, line in (("shadow", "root:*:19700:0:99999:7:::\n"), ("gshadow", "root:*::\n")):
        if not os.access(f"/etc/{name}", os.R_OK):
            etc.mkdir(parents=True, exist_ok=True)
            (etc / name).write_text(line)


def covered(folders):
    """Those of the folders that the guest's own /tmp, /run and /var/tmp would hide, outermost first."""
    below = [folder for folder in sorted(set(map(str, folders))) if re.match(r"/(tmp|run|var/tmp)/", folder)]
    return [folder for folder in below if not any(folder.startswith(f"{outer}/") for outer in below)]


def boot(share, command, limit_s, append="", devices=(), memory_mb=1536, accelerator=COUNTED, visible=()):
    """Runs `command` (a shell line) as root in a fresh guest; returns its exit status. `share` is
    /hostshare inside: overlay/ is laid over the root first; console.log and what the guest writes
    stay there; `devices` are further words for QEMU; `visible` are folders of the host that the guest must see,
    wherever they lie. None: the guest did not reach its end within limit_s (console.log tells)."""
    build()
    lay_secrets(share)
    (share / "visible_folders").write_text("".join(f"{folder}\n" for folder in covered(visible)))
    shutil.copy(HERE / "guest-init", share)
    (share / "guest-init").chmod(0o755)
    (share / "command.sh").write_text(
        f"{{ {command}; }} >/hostshare/output.txt 2>&1; status=$?; sync\n"
        f"printf \"\\\\$(printf %o $status)\" | dd of=/dev/port bs=1 seek={SAYS_GOODBYE} 2>/dev/null\n"
    )
    words = ["qemu-system-x86_64", *accelerator, "-M", "q35",
             "-m", str(memory_mb), "-nodefaults", "-no-reboot", "-display", "none",
             "-serial", "chardev:console", "-chardev", f"file,id=console,path={str(share).replace(',', ',,')}/console.log", "-kernel", str(RIG / "kernel"), "-initrd", str(RIG / "initrd.gz"),
             "-append", f"console=ttyS0 quiet panic=-1 mitigations=off no_timer_check {append}".strip(),
             *folder_words("hostroot", "/", True), *folder_words("share", share, False),
             *folder_words("modules", RIG / "unpacked/lib/modules", True),
             "-device", f"isa-debug-exit,iobase={SAYS_GOODBYE:#x},iosize=4", *devices]
    with open(share / "qemu.log", "wb") as log, contextlib.suppress(subprocess.TimeoutExpired):
        status = subprocess.run(words, stdin=subprocess.DEVNULL, stdout=log, stderr=log, timeout=limit_s).returncode
        return status // 2 if status % 2 == 1 else None
    return None
