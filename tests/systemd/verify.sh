#!/usr/bin/env bash
# Unpacks the packages into a scratch root and lets systemd judge the service files there.
#   verify.sh PACKAGES SOURCE_DIR
# Exit 77 (skipped) only where systemd-analyze is missing, or root and sudo are, and AXISCAL_MAY_SKIP names systemd.
set -euo pipefail
packages=$1 source=$2

cannot() {
    case ",${AXISCAL_MAY_SKIP:-}," in *,systemd,*) echo "skipped: $1"; exit 77 ;; esac
    echo "$1, or AXISCAL_MAY_SKIP=systemd"
    exit 1
}
command -v systemd-analyze >/dev/null || cannot "systemd-analyze is missing: apt-get install systemd"
# Folders are given to other users in the scratch root.
as_root=()
if [ "$(id -u)" -ne 0 ]; then
    as_root=(sudo -n)
    "${as_root[@]}" true </dev/null 2>/dev/null \
        || cannot "this needs root, and sudo refuses without a password: run as root, or as a user whom sudo obeys"
fi

root=$(mktemp -d)
trap '"${as_root[@]}" rm -rf "$root"' EXIT
fail() { echo "FAILED: $*"; exit 1; }

for package in axiscal axiscal-publish axiscal-doc; do
    dpkg-deb -x "$packages/$package"_*.deb "$root" || fail "no package $package"
done

units=/usr/lib/systemd/system
[ -d "$root$units" ] || units=/lib/systemd/system # as the debhelper of Debian 12 lays them
for file in "$units/axiscald.service" "$units/axiscal-notify.service" "$units/axiscal-notify.path" "$units/axiscal-publish.service" /usr/lib/sysusers.d/axiscal.conf \
    /usr/lib/tmpfiles.d/axiscal.conf /usr/lib/modules-load.d/axiscal.conf /usr/share/polkit-1/rules.d/axiscal.rules \
    /usr/share/axiscal/station.example.toml; do
    [ -s "$root/$file" ] || fail "not installed: $file"
done
rules=$(find "$root" -name 70-axiscal.rules)
[ -s "$rules" ] || fail "not installed: 70-axiscal.rules"

# The scratch root is a system of its own: stub programs, and systemd's own units to refer to.
mkdir -p "$root/usr/bin" "$root/etc/axiscal"
for program in axiscald axiscal-notify axiscal-publish; do
    grep -q "^ExecStart=/usr/bin/$program --config /etc/axiscal/station.toml$" "$root/$units/$program.service" \
        || fail "$program.service starts another program"
    printf '#!/bin/sh\n' >"$root/usr/bin/$program"
    chmod 755 "$root/usr/bin/$program"
done
for unit in "$units"/*.target "$units"/*.slice "$units"/*.mount "$units"/*.socket; do
    if [ -e "$unit" ]; then cp -P "$unit" "$root/$units/"; fi
done

# Every document that a unit names is installed.
while read -r page; do
    [ -e "$root/$page" ] || fail "Documentation= names $page, which is not installed"
done < <(sed -n 's|^Documentation=file://||p' "$root/$units"/axiscal*.service)

judge() { # unit, highest exposure in tenths
    local said
    said=$(systemd-analyze verify --man=no --root="$root" "$units/$1" 2>&1) || fail "verify $1: $said"
    [ -z "$said" ] || fail "verify $1 says: $said"
    systemd-analyze security --no-pager --offline=true --threshold="$2" "$root/$units/$1" >"$root/score.log" 2>&1 \
        || { cat "$root/score.log"; fail "$1 is more exposed than $2 tenths"; }
    tail -n 1 "$root/score.log"
}
# Each kind of device that the unit allows is known at its start: systemd passes over others in silence.
declare -A module=([ttyUSB]=usbserial [ttyACM]=cdc_acm [usb_device]=usbcore [hidraw]=hid)
while read -r kind; do
    [ "$kind" != ttyS ] || continue # part of the kernel
    grep -qx "${module[$kind]:-none}" "$root/usr/lib/modules-load.d/axiscal.conf" \
        || fail "no module of modules-load.d/axiscal.conf makes the devices of DeviceAllow=char-$kind"
done < <(sed -n 's/^DeviceAllow=char-\([A-Za-z_]*\) .*/\1/p' "$root/$units/axiscald.service")
# What docs/install.md claims; Kernel.UnitIsHardenedAsMuchAsItClaims holds the page.
judge axiscald.service 16
judge axiscal-publish.service 10
judge axiscal-notify.service 10

# The judge is awake: a planted mistake is told.
sed 's/^NoNewPrivileges=/NoNewPriviliges=/' "$root/$units/axiscald.service" >"$root/$units/axiscal-planted.service"
grep -q NoNewPriviliges <<<"$(systemd-analyze verify --man=no --root="$root" "$units/axiscal-planted.service" 2>&1)" \
    || fail "systemd-analyze does not see a misspelt key"

# systemd's own readers, against the scratch root: what they refuse is a syntax error.
printf 'root:x:0:0::/root:/bin/sh\n' >"$root/etc/passwd"
printf 'root:x:0:\ndialout:x:20:\n' >"$root/etc/group"
"${as_root[@]}" systemd-sysusers --root="$root" axiscal.conf >"$root/sysusers.log" 2>&1 \
    || { cat "$root/sysusers.log"; fail "sysusers"; }
grep -q '^axiscal:.*:/var/lib/axiscal:' "$root/etc/passwd" || fail "sysusers made no user axiscal"
# It makes nothing of root's below a folder that is another's.
"${as_root[@]}" chown -R root:root "$root"
"${as_root[@]}" chmod 755 "$root"
"${as_root[@]}" systemd-tmpfiles --root="$root" --create axiscal.conf || fail "tmpfiles"
[ "$("${as_root[@]}" stat -c %a "$root/var/lib/axiscal/outbox")" = 750 ] || fail "the outbox has other rights than 0750"

python3 "$source/tests/systemd/udev_rules.py" "$rules"
