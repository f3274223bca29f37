#!/usr/bin/env bash
# Puts the peers that cannot stand beside Boost 1.81's headers into a root of their own: CGAL and scipy as Debian
# ships them, unpacked, never installed and never linked by the product. CGAL's package of annuli is under the GPL.
#   peer_root.sh ROOT
set -euo pipefail
root=$(realpath -m "$1")
here=$(cd "$(dirname "$0")" && pwd)
[ ! -e "$root/whole" ] || exit 0

mkdir -p "$root/packages"
cd "$root/packages"
apt-get download -q libcgal-dev libboost1.74-dev libgmp-dev libmpfr-dev libgmp10 libmpfr6 \
    python3-scipy python3-decorator liblapack3 libblas3 libgfortran5 liblbfgsb0 >fetch.log 2>&1
for package in *.deb; do dpkg -x "$package" "$root"; done

# the headers of this root before any other Boost
flags=(-std=c++17 -O3 -DNDEBUG -w -isystem "$root/usr/include" -isystem "$root/usr/include/x86_64-linux-gnu")
g++ "${flags[@]}" "$here/peers/cgal_annulus.cpp" -o "$root/cgal_annulus" \
    -L"$root/usr/lib/x86_64-linux-gnu" -Wl,-rpath,"$root/usr/lib/x86_64-linux-gnu" -lmpfr -lgmp >"$root/build.log" 2>&1
touch "$root/whole"
