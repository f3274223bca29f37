#!/usr/bin/env bash
# The disk of a PC as an IT department hands it over: Debian's least with systemd, ssh, an account of a technician, and no
# axiscal. The libraries that the packages name are there already: unpacking them costs an emulated processor two minutes
# (Package.RunsInAMinimalRoot* installs them by name).
#   disk.sh PACKAGES KEY.pub DISK     as root; DISK: an ext4 image
set -euo pipefail
packages=$1 key=$2 disk=$3
# What is proven here is proven for the Debian that this is.
. /etc/os-release
work=$(mktemp -d /var/tmp/axiscal-disk-XXXXXX)
trap 'rm -rf --one-file-system "$work"' EXIT
mkdir "$work/packages"
cp "$packages"/*.deb "$work/packages/"
cp "$key" "$work/packages/key.pub"
cat >"$work/packages/prepare" <<'END'
set -eu
export DEBIAN_FRONTEND=noninteractive
apt-get -q update
libraries=$(apt-get install -s --no-install-recommends /packages/*.deb | awk '$1 == "Inst" && $2 !~ /^axiscal/ {print $2}')
apt-get -q install -y --no-install-recommends $libraries
install -d -m 700 /root/.ssh
install -m 600 /packages/key.pub /root/.ssh/authorized_keys
useradd --create-home --shell /bin/bash technician
install -d -o technician -m 700 /home/technician/.ssh
install -o technician -m 600 /packages/key.pub /home/technician/.ssh/authorized_keys
echo hall-3 >/etc/hostname
printf '127.0.0.1 localhost hall-3\n' >/etc/hosts
printf '/dev/vda / ext4 rw,errors=remount-ro 0 1\n' >/etc/fstab
printf '[Match]\nName=e*\n[Network]\nAddress=10.0.2.15/24\nGateway=10.0.2.2\n' >/etc/systemd/network/wire.network
systemctl enable -q systemd-networkd ssh
systemctl mask -q systemd-networkd-wait-online.service apt-daily.timer apt-daily-upgrade.timer
mv /packages /srv/packages
rm -f /srv/packages/key.pub /srv/packages/prepare
END
# shellcheck disable=SC2016 # the inner shell's own variables
mmdebstrap --quiet --mode=root --aptopt='Acquire::Retries "5"' --variant=minbase --skip=cleanup/apt,cleanup/reproducible \
    --include=systemd-sysv,udev,dbus,polkitd,kmod,iproute2,openssh-server,ca-certificates,adduser \
    --customize-hook="cp -r $work/packages \$1/packages" \
    --customize-hook='chroot "$1" sh /packages/prepare' "$VERSION_CODENAME" "$work/root" >"$work/log" 2>&1 \
    || { tail -40 "$work/log"; exit 1; }
rm -f "$disk"
PATH=$PATH:/usr/sbin:/sbin mkfs.ext4 -q -E lazy_itable_init=0 -d "$work/root" "$disk" 2G >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
