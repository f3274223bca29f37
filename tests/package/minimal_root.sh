#!/usr/bin/env bash
# A root that holds nothing but Debian's least, then the packages: every program runs with what they name, an update keeps the
# station file, and a purge keeps the runs and says where.
#   minimal_root.sh PACKAGES SOURCE
# Exit 77 (skipped) only where root or mmdebstrap is missing and AXISCAL_MAY_SKIP names debian.
set -euo pipefail
packages=$1 source=$2
. /etc/os-release # a package is for the Debian that it was made on
cannot() {
    case ",${AXISCAL_MAY_SKIP:-}," in *,debian,*) echo "skipped: $1"; exit 77 ;; esac
    echo "$1, or AXISCAL_MAY_SKIP=debian"
    exit 1
}
command -v mmdebstrap >/dev/null || cannot "mmdebstrap is missing: tools/install-dependencies test"
as_root=()
if [ "$(id -u)" -ne 0 ]; then
    as_root=(sudo -n)
    "${as_root[@]}" true </dev/null 2>/dev/null || cannot "this needs root, and sudo refuses without a password"
fi
work=$(mktemp -d /var/tmp/axiscal-root-XXXXXX)
trap '"${as_root[@]}" rm -rf "$work"' EXIT
mkdir "$work/packages"
cp "$packages"/*.deb "$source/tests/reference/fifty_points.axiscal" "$work/packages/"
cp "$source/tests/package/in_the_root.sh" "$work/packages/"
chmod -R a+rX "$work"

"${as_root[@]}" mmdebstrap --quiet --aptopt='Acquire::Retries "5"' --variant=minbase --format=null --include=ca-certificates \
    --customize-hook="mkdir \$1/packages && cp $work/packages/* \$1/packages/" \
    --customize-hook='chroot "$1" sh /packages/in_the_root.sh' "$VERSION_CODENAME" >"$work/log" 2>&1 \
    || { tail -40 "$work/log"; echo "FAILED: see above"; exit 1; }
grep '^ok ' "$work/log"
[ "$(grep -c '^ok ' "$work/log")" = 6 ] || { tail -40 "$work/log"; echo "FAILED: not every step was reached"; exit 1; }
