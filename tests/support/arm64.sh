#!/usr/bin/env bash
# Builds for arm64, runs the unit tests in QEMU's user emulation, then COMMAND, for which programs start so, too.
#   arm64.sh COMMAND...
# As root, in a root of its own (in_debian.sh): it adds an architecture to it, and tells the kernel, as the package
# qemu-user-static does, what starts programs of arm64; that ends with it.
set -euo pipefail
cd "$(dirname "$0")/../.."
export DEBIAN_FRONTEND=noninteractive
install() { apt-get -o Acquire::Retries=5 -q install -y --no-install-recommends "$@" >&2; }
# All is read before it is judged: grep -q leaves at once, and the one who still writes would count as failed.
has() { grep -q 'Candidate: [^(]' <<<"$(apt-cache policy "$1")"; }

dpkg --add-architecture arm64
apt-get -q update >&2
# Libraries of that architecture in the place of this one's; those that are headers alone have none.
packages=()
for one in $(sed -n '/^build=(/,/)/p' tools/install-dependencies | tr -d '"()' | sed 's/^build=//'); do
    name=${one%%[|=]*}
    [ "$name" != g++ ] || name=g++-aarch64-linux-gnu
    case $name in *-dev) if has "$name:arm64"; then name=$name:arm64; fi ;; esac
    packages+=("$name")
done
install "${packages[@]}" libc6-dev:arm64 qemu-user-static poppler-utils tesseract-ocr

kernel=/proc/sys/fs/binfmt_misc
[ -e "$kernel/register" ] || mount -t binfmt_misc none "$kernel"
if [ ! -e "$kernel/qemu-aarch64" ]; then
    cat /usr/lib/binfmt.d/qemu-aarch64.conf >"$kernel/register"
    trap 'echo -1 >"$kernel/qemu-aarch64"' EXIT
fi

mkdir -p build
cmake --preset check -DCMAKE_TOOLCHAIN_FILE=tests/support/arm64.cmake >build/configure.log || { cat build/configure.log; exit 1; }
cmake --build build/check -j "$(nproc)"
# What QEMU's user emulation does not do: take memory back (MADV_REMOVE), tell whether a terminal is exclusive (TIOCGEXCL),
# tell at once that a program is not there (posix_spawn).
not_emulated=SampleRing.HoldsNoMoreMemoryThanItsSamplesNeedHoweverOftenItHasGoneRound
not_emulated+=:SerialLink.APtyIsNotExclusiveForAProgramThatWasKilled
not_emulated+=:SleepLockAgainst.AComputerWithoutSystemdIsToldAtOnce
export AXISCAL_MACHINES=1 # of each mistake and ten hidden ones: an emulated processor is 18 times slower
failed=()
for tests in build/check/bin/*_tests; do
    echo "$tests"
    "$tests" --gtest_brief=1 --gtest_filter="-$not_emulated" 2>&1 | tee -a build/units.log || failed+=("$tests")
done
awk '/tests? from .* ran/ {ran += $2} END {print ran " unit tests ran, emulated"}' build/units.log | tee build/check.counts
[ ${#failed[@]} -eq 0 ] || { echo "failed: ${failed[*]}"; exit 1; }
"$@"
