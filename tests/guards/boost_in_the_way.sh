#!/usr/bin/env bash
# tools/install-dependencies where Boost 1.74's headers are installed, or Boost is a newer one, on package programs that are
# scripts: it names the old ones, prints the one line that solves it, changes nothing, and after that line it installs.
#   boost_in_the_way.sh SOURCE_DIR
set -euo pipefail
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
fail() { echo "FAILED: $*"; cat "$root/said" "$root/asked" 2>/dev/null; exit 1; }

# The computer: a line "state package version" for each that dpkg knows of, and the same of what its Debian has.
mkdir "$root/bin"
cat >"$root/bin/dpkg-query" <<'SCRIPT'
#!/bin/bash
# dpkg-query -W -f FORMAT PATTERN...
[ "$1 $2" = "-W -f" ] || exit 2
format=$3 found=1
shift 3
while read -r state name version; do
    for pattern in "$@"; do
        [[ $name == $pattern ]] || continue
        line=${format//'${db:Status-Status}'/$state}
        line=${line//'${Version}'/$version}
        printf '%b' "${line//'${Package}'/$name}"
        found=0
    done
done <"$COMPUTER"
exit $found
SCRIPT
cat >"$root/bin/apt-cache" <<'SCRIPT'
#!/bin/bash
# apt-cache policy NAME
[ "$1" = policy ] || exit 2
while read -r name version; do
    [ "$name" != "$2" ] || printf '%s:\n  Installed: (none)\n  Candidate: %s\n' "$name" "$version"
done <"$DEBIAN"
SCRIPT
# Boost 1.81's headers conflict with 1.74's: without --no-remove apt-get would take those away by itself.
cat >"$root/bin/apt-get" <<'SCRIPT'
#!/bin/bash
echo "apt-get $*" >>"$ASKED"
words=() no_remove=
while [ $# -gt 0 ]; do
    case $1 in
    -o) shift ;;
    --no-remove) no_remove=yes ;;
    -*) ;;
    *) words+=("$1") ;;
    esac
    shift
done
remove() { local name; for name in "$@"; do sed -i "s/^installed $name\( \|\$\)/config-files $name /" "$COMPUTER"; done; }
case ${words[0]} in
remove) remove "${words[@]:1}" ;;
install)
    [ -z "$BROKEN" ] || { echo "E: Unable to fetch some archives"; exit 100; }
    if [[ " ${words[*]} " == *" libboost1.81-dev "* ]] && grep -q '^installed libboost.*1\.74' "$COMPUTER"; then
        [ -z "$no_remove" ] || { echo "E: Packages need to be removed but remove is disabled."; exit 100; }
        remove 'libboost.*1\.74.*'
    fi
    for name in "${words[@]:1}"; do
        echo "installed $name $(awk -v name="$name" '$1 == name {print $2}' "$DEBIAN")" >>"$COMPUTER"
    done ;;
esac
SCRIPT
printf '#!/bin/sh\nexec "$@"\n' >"$root/bin/sudo"
chmod +x "$root"/bin/*
export COMPUTER=$root/computer DEBIAN=$root/debian ASKED=$root/asked BROKEN=
export PATH=$root/bin:$PATH

installs() { : >"$ASKED"; "$1/tools/install-dependencies" build >"$root/said" 2>&1; }

printf '%s\n' 'libboost1.81-dev 1.81.0-5' 'libboost-dev 1.74.0.3' >"$DEBIAN" # Debian 12
cat >"$COMPUTER" <<'LIST'
installed g++
config-files libboost-python1.74-dev
installed libboost1.74-dev 1.74.0-18
installed libboost-dev 1.74.0.3
installed libboost-chrono1.74-dev 1.74.0-18
LIST
cp "$COMPUTER" "$root/before"
installs "$1" && fail "Boost 1.74 in the way, and it ends well"
cmp "$COMPUTER" "$root/before" || fail "the computer was changed"
grep -q ' install .*--no-remove .*libboost1.81-dev' "$ASKED" || fail "installed without --no-remove"
grep -q ' remove ' "$ASKED" && fail "it removed packages by itself"
grep -qF "Boost 1.74's headers (libboost1.74-dev libboost-dev libboost-chrono1.74-dev) stand in the way" "$root/said" \
    || fail "the message does not name the packages that are installed, and no others"
mapfile -t lines < <(grep -E '^ +(sudo +)?apt-get ' "$root/said")
[ ${#lines[@]} = 1 ] || fail "${#lines[@]} lines to type instead of one"
[ "$(tail -n 1 "$root/said")" = "${lines[0]}" ] || fail "the line to type is not the last"

# What it printed solves it, typed as it stands.
bash -c "${lines[0]}" || fail "the printed line fails"
grep -q '^installed libboost.*1\.74' "$COMPUTER" && fail "the printed line leaves packages in the way"
installs "$1" || fail "still refused after the printed line"
grep -q '^installed libboost1.81-dev ' "$COMPUTER" || fail "Boost 1.81 is not installed after the printed line"
installs "$1" || fail "a second time fails"
[ ! -s "$ASKED" ] || fail "asks apt-get although nothing is missing"

# Debian 13 has no package of that name, and a Boost that is new enough.
echo 'libboost-dev 1.83.0.2+b2' >"$DEBIAN"
echo "installed g++" >"$COMPUTER"
installs "$1" || fail "Boost 1.83 is not taken"
grep -q ' install .*libboost-dev' "$ASKED" || fail "libboost-dev is not installed"
grep -q 'libboost1.81-dev' "$ASKED" && fail "asks for what this Debian has not"
installs "$1" || fail "a second time fails"
[ ! -s "$ASKED" ] || fail "asks apt-get although Boost 1.83 is here"

# Another failure is not blamed on Boost.
echo 'libboost1.81-dev 1.81.0-5' >"$DEBIAN"
echo "installed g++" >"$COMPUTER"
BROKEN=yes installs "$1" && fail "apt-get fails, and it ends well"
grep -q "could not install: .*libboost1.81-dev" "$root/said" || fail "what could not be installed is not named"
grep -qE "Boost 1.74|apt-get remove" "$root/said" && fail "Boost 1.74 is blamed where there is none"
exit 0
