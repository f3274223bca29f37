#!/usr/bin/env bash
# The packages unpacked into a scratch root: all that a station needs is there, and the programs run.
#   installed_tree.sh PACKAGES SOURCE_DIR VERSION BUILD_DIR
set -euo pipefail
packages=$1 source=$2 version=$3 build=$4
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
fail() { echo "FAILED: $*"; exit 1; }

for package in axiscal axiscal-publish axiscal-doc; do
    dpkg-deb -x "$packages/${package}_$version"_*.deb "$root" || fail "no package $package of version $version"
done

wanted=(/usr/share/doc/axiscal/copyright /usr/share/doc/axiscal-publish/copyright
    /usr/lib/axiscal/axiscald-tls.so /usr/share/axiscal/station.example.toml /usr/lib/sysusers.d/axiscal.conf /usr/lib/tmpfiles.d/axiscal.conf)
for program in axiscald axiscal axiscal-notify axiscal-publish axiscal-report; do wanted+=("/usr/bin/$program"); done
for profile in "$source"/config/profiles/*.toml; do wanted+=("/usr/share/axiscal/profiles/${profile##*/}"); done
pages=()
while read -r file; do pages+=("${file#"$source"/acquisition/console/page/}")
done < <(find "$source/acquisition/console/page" -type f ! -name package.json)
for name in "${pages[@]}"; do wanted+=("/usr/share/axiscal/page/$name" "/usr/share/axiscal/page/$name.gz"); done
for name in uplot.js uplot.css uplot.license.txt; do
    wanted+=("/usr/share/axiscal/page/libraries/$name" "/usr/share/axiscal/page/libraries/$name.gz")
done
while read -r file; do wanted+=("/usr/share/axiscal/conformance/${file#"$source"/tests/reference/conformance/}")
done < <(find "$source/tests/reference/conformance" -name '*.json' -o -name '*.py')
while read -r page; do wanted+=("/usr/share/doc/axiscal/${page#"$source"/docs/}"); done < <(find "$source/docs" -name '*.md' -o -name '*.schema.json')
for file in "${wanted[@]}"; do
    [ -s "$root$file" ] || fail "not installed: $file"
done
# Packed or not, a browser gets what was written; the packed form bears no time and no name (RFC 1952, 2.3).
for name in "${pages[@]}"; do
    page=$root/usr/share/axiscal/page/$name
    cmp "$source/acquisition/console/page/$name" "$page" || fail "the page has another $name"
    gzip -dc "$page.gz" | cmp - "$page" || fail "$name.gz is packed of something else"
    [ "$(od -An -tx1 -N8 "$page.gz")" = " 1f 8b 08 00 00 00 00 00" ] || fail "$name.gz has a head that differs from day to day"
done
# These stand where this system's systemd and udev look for them.
for name in axiscald.service axiscal-notify.service axiscal-notify.path axiscal-publish.service 70-axiscal.rules; do
    [ "$(find "$root" -name "$name" -size +0 | wc -l)" = 1 ] || fail "not installed once: $name"
done

# What helps to test or to play is no part of a measuring PC.
while read -r file; do
    case $file in
    */axiscal-simulate | */modbus_peer_host | *_tests | */fuzz_* | *.a | *.hpp) fail "installed, but belongs to the tests: $file" ;;
    esac
done < <(find "$root" -type f)

for program in axiscald axiscal axiscal-notify axiscal-publish axiscal-report; do
    said=$("$root/usr/bin/$program" --version) || fail "$program --version ends with $?"
    [[ $said == *"$version"* ]] || fail "$program --version says: $said"
done
said=$("$root/usr/bin/axiscal" conformance --brief) || fail "the installed cases: $said"
# What speaks TLS is found beside the programs, too, and says what is wrong with the files.
tls=$root/tls.toml
sed 's|^# certificate = .*|certificate = "/nowhere.pem"|; s|^# key = .*|key = "/nowhere.pem"|' \
    "$root/usr/share/axiscal/station.example.toml" >"$tls"
said=$(env -u AXISCAL_PROFILE_PATH "$root/usr/bin/axiscal" check-config "$tls" 2>&1) && fail "a certificate that is not there is accepted"
[[ $said == *"/nowhere.pem is not there"* ]] || fail "check-config of a missing certificate says: $said"
for program in "$root"/usr/bin/axiscal*; do
    "$program" --help >"$root/help.txt" || fail "${program##*/} --help ends with $?"
    ! grep -aqF "$build" "$root/help.txt" || fail "${program##*/} --help names the build folder"
done
# The example names a profile: found beside the programs, not where the build was meant to go.
env -u AXISCAL_PROFILE_PATH "$root/usr/bin/axiscal" check-config "$root/usr/share/axiscal/station.example.toml" \
    || fail "the installed example is refused by the installed program"
echo "${#wanted[@]} files and 5 services' files are installed; programs say $version"
