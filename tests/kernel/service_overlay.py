"""Lays the tree of the packages and a systemd target for the checks over the guest's root."""

import shutil
import subprocess
from pathlib import Path

# The target is all that this computer starts: sysinit (udev, journal, sysusers, tmpfiles), then the
# checks. What else the host has enabled stays out.
TARGET = """[Unit]
Requires=sysinit.target rig.service
Wants=systemd-udevd.service systemd-udev-trigger.service
After=sysinit.target
AllowIsolate=yes
"""
SERVICE = """[Unit]
After=sysinit.target systemd-udev-trigger.service
[Service]
Type=exec
Environment=PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 TZ=UTC
ExecStart=/bin/sh /hostshare/command.sh
"""
MASKED = ("timers.target", "paths.target", "sockets.target", "systemd-timesyncd.service", "systemd-pstore.service",
          "systemd-hwdb-update.service", "ldconfig.service", "systemd-journal-catalog-update.service",
          "systemd-update-done.service", "systemd-networkd.service", "networking.service", "apparmor.service")


def lay(share, programs):
    """Unpacks the packages that were made of these programs; returns the words for the kernel's command line."""
    overlay = share / "overlay"
    overlay.mkdir()
    packages = sorted((Path(programs).resolve().parent / "packages").glob("axiscal*.deb"))
    if not packages:
        raise RuntimeError("no packages were made of this build: ctest -R Package.AreMade")
    for package in packages:
        done = subprocess.run(["dpkg-deb", "-x", package, overlay], capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"{package}: {done.stdout}{done.stderr}")
    if (overlay / "lib").exists():  # Debian's /lib is a link to /usr/lib
        shutil.copytree(overlay / "lib", overlay / "usr/lib", dirs_exist_ok=True)
        shutil.rmtree(overlay / "lib")
    units = overlay / "etc/systemd/system"
    units.mkdir(parents=True)
    (units / "rig.target").write_text(TARGET)
    (units / "rig.service").write_text(SERVICE)
    (overlay / "etc/machine-id").write_text("0123456789abcdef0123456789abcdef\n")
    masks = " ".join(f"systemd.mask={unit}" for unit in MASKED)
    return f"rig.init=/lib/systemd/systemd systemd.unit=rig.target systemd.log_level=notice {masks}"
