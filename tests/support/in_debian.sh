#!/usr/bin/env bash
# Makes a root of Debian alone, copies the tree into it, and runs a command there, in the folder of the tree.
#   git ls-files … | tar -c … | in_debian.sh SUITE PLACE COMMAND      as root
# PLACE: an empty folder; the tree lies in PLACE/root/axiscal afterwards. What the command mounts ends with it.
set -euo pipefail
suite=$1 place=$2 command=$3
mmdebstrap --quiet --mode=root --aptopt='Acquire::Retries "5"' --variant=minbase --include=ca-certificates "$suite" "$place/root"
mkdir "$place/root/axiscal"
tar -x -C "$place/root/axiscal" --no-same-owner
cp -L /etc/resolv.conf "$place/root/etc/resolv.conf"
# shellcheck disable=SC2016 # the inner shell's own variables
exec unshare --mount --propagation private bash -euc '
    root=$1
    mount --bind "$root" "$root" # tests look for a root that is a mount point, as every computer has
    for folder in proc sys dev; do mount --rbind "/$folder" "$root/$folder"; done
    mount -t tmpfs run "$root/run"
    exec chroot "$root" env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
        sh -c "cd /axiscal && $2"' in_debian "$place/root" "$command"
