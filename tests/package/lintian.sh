#!/usr/bin/env bash
# Debian's judge of packages finds no error and nothing to warn of; each override has its reason beside it.
#   lintian.sh PACKAGES SOURCE
set -euo pipefail
packages=$1 source=$2
fail() { echo "FAILED: $*"; exit 1; }

# A lane's own programs are packed, which are compiled without hardening: tools/package compiles others.
said=$(lintian --no-cfg --allow-root --fail-on error,warning --suppress-tags-from-file <(printf '%s\n' hardening-no-pie hardening-no-relro) \
    "$packages"/*.deb 2>&1) || { echo "$said"; fail "lintian is not satisfied"; }
for file in "$source"/tools/package.d/debian/*.lintian-overrides; do
    awk '/^#/ {reason = 1; next} NF && !reason {bad = 1} NF {reason = 0} END {exit bad}' "$file" \
        || fail "$file overrides without a reason in the line above"
done

# debhelper enables and starts no service that it does not see: that of Debian 12 looks into /lib/systemd/system alone.
for package in axiscal axiscal-publish; do
    unit=axiscald
    [ "$package" = axiscal ] || unit=$package
    script=$(dpkg-deb --ctrl-tarfile "$packages/${package}"_*.deb | tar -xO ./postinst)
    grep -q "deb-systemd-invoke \$_dh_action .*'$unit.service'" <<<"$script" || fail "an update of $package does not restart $unit"
done
echo "lintian is satisfied with $(ls "$packages"/*.deb | wc -l) packages"
