#!/usr/bin/env bash
# The same source gives the same packages: staged in two folders, on two days, with two habits of whoever builds.
#   same_bits.sh PACKAGES SOURCE BUILD    packs BUILD's programs once more and compares
#   same_bits.sh SOURCE                   compiles everything twice (tools/test --all)
set -euo pipefail
work=$(mktemp -d /var/tmp/axiscal-bits-XXXXXX)
trap 'rm -rf "$work"' EXIT
fail() { echo "FAILED: $*"; exit 1; }

if [ $# = 3 ]; then
    first=$1 source=$2 words=(--ready "$3")
else
    source=$1 words=() first=$work/first
    AXISCAL_STAGE=$work/one "$source/tools/package" --to "$first" >"$work/first.log" 2>&1 || { cat "$work/first.log"; fail "the first packages"; }
fi
# Four years on, in a longer path, with files that only their owner may read, in another time zone.
(umask 077 && TZ=Asia/Kathmandu LANG=C AXISCAL_STAGE=$work/another/place/for.it \
    faketime -f "+1500d" "$source/tools/package" "${words[@]}" --to "$work/second" >"$work/second.log" 2>&1) \
    || { cat "$work/second.log"; fail "the second packages"; }
for package in "$first"/*.deb; do
    name=${package##*/}
    if ! cmp "$package" "$work/second/$name"; then
        for one in "$package" "$work/second/$name"; do dpkg-deb -x "$one" "$work/tree-$(basename "$(dirname "$one")")"; done
        diff -rq "$work/tree-$(basename "$first")" "$work/tree-second" || true
        fail "$name has other bits the second time"
    fi
done
# docs/release.md: whoever builds a release again compares two short files.
cmp "$first/SHA256SUMS" "$work/second/SHA256SUMS" || fail "SHA256SUMS differs"
(cd "$first" && sha256sum --check --quiet --strict SHA256SUMS) || fail "SHA256SUMS does not fit the packages"
[ "$(wc -l <"$first/SHA256SUMS")" = "$(ls "$first"/*.deb | wc -l)" ] || fail "SHA256SUMS names another number of packages"
echo "$(ls "$first"/*.deb | wc -l) packages have the same bits twice"
