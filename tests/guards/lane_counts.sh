#!/usr/bin/env bash
# tools/test on a ctest that is a script: each lane closes with what it ran and skipped and why, a skip that
# nobody allowed fails its lane, and a lane that is not built tells no counts of an earlier time.
#   lane_counts.sh SOURCE_DIR
set -euo pipefail
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
fail() { echo "FAILED: $*"; cat "$root/said" 2>/dev/null; exit 1; }

mkdir -p "$root"/{tools,bin,tests/guards}
cp "$1/tools/test" "$root/tools/test"
cp "$1/tests/guards/count_skips.py" "$root/tests/guards/count_skips.py"
printf '#!/bin/sh\n' | tee "$root/tools/install-dependencies" "$root/tools/tidy" >/dev/null
# Nothing is built; the preset named in BROKEN is not even configured.
cat >"$root/bin/cmake" <<'SCRIPT'
#!/bin/sh
[ "$1 $2" != "--preset $BROKEN" ] || exit 1
mkdir -p "build/$2"
SCRIPT
cat >"$root/bin/ctest" <<'SCRIPT'
#!/bin/bash
if [[ "$*" == *--show-only=json-v1* ]]; then
    echo '{"tests": [{"name": "Peers.Drives"}, {"name": "Peers.Waits", "properties": [{"name": "LABELS", "value": ["linuxcnc"]}]}]}'
    exit
fi
cat >"${!#}" <<'REPORT'
<testsuite><testcase name="Peers.Drives" status="run"><system-out/></testcase>
<testcase name="Peers.Waits" status="notrun"><skipped message="SKIP_RETURN_CODE=77"/>
<system-out>linuxcnc is not installed</system-out></testcase></testsuite>
REPORT
echo "100% tests passed, 0 tests failed out of 2"
SCRIPT
chmod +x "$root"/{tools,bin}/*

run_lanes() { # AXISCAL_MAY_SKIP, a preset that does not build, lanes
    local may_skip=$1 broken=$2
    shift 2
    (cd "$root" && PATH=$root/bin:$PATH AXISCAL_MAY_SKIP=$may_skip BROKEN=$broken tools/test "$@" >said 2>&1)
}
closes() { # number of lines, the lines
    diff <(sed 's/ in [0-9]* min/ in N min/' "$root/said" | tail -n "$1") - >"$root/differs" || fail "other last lines: $(cat "$root/differs")"
}

run_lanes linuxcnc none release tidy dev || fail "an allowed skip fails"
closes 5 <<'LINES'
lane release passed in N min: ran 1 tests, skipped 1:
  Peers.Waits (linuxcnc): linuxcnc is not installed
lane tidy passed in N min
lane dev passed in N min: ran 1 tests, skipped 1:
  Peers.Waits (linuxcnc): linuxcnc is not installed
LINES

run_lanes samba dev release dev && fail "a skip that nobody allowed passes"
closes 3 <<'LINES'
lane release FAILED in N min: ran 1 tests, skipped 1, of which 1 may not be skipped (AXISCAL_MAY_SKIP=LABEL,... allows it):
  Peers.Waits (linuxcnc): linuxcnc is not installed - NOT ALLOWED
lane dev FAILED in N min
LINES

run_lanes linuxcnc none check || fail "one lane with an allowed skip fails"
closes 3 <<'LINES'
100% tests passed, 0 tests failed out of 2
ran 1 tests, skipped 1:
  Peers.Waits (linuxcnc): linuxcnc is not installed
LINES
run_lanes "" none check && fail "one lane with a skip that nobody allowed passes"
exit 0
