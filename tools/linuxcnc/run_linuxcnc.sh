#!/usr/bin/env bash
# Runs one part program of `axiscal program` on a LinuxCNC without a screen, then shuts it down.
#
#   run_linuxcnc.sh --program FILE --shape SHAPE {--port PORT|--serial LINE} --positions PIPE --scratch DIR
#   run_linuxcnc.sh --program FILE --block FILE --scratch DIR
#
#   --program    LinuxCNC dialect, axes X, Y, Z and A; with --block one of `axiscal probing program`
#   --shape      single-register | coil-and-index | sequence-block: as in the station file's [trigger]
#   --port       the station's Modbus TCP port on this computer; mb2hal is its client
#   --serial     the serial line to the station instead, 115200 8N1: mb2hal is its Modbus RTU master. A name of
#                31 characters at most, from --scratch on where it is no whole path
#   --positions  named pipe (made when missing) that gets the 1 kHz position stream, lines `n x y z a table` with the
#                position that an indexing table is told; something must read it before:
#                axiscal-simulate --positions PIPE
#   --block      three axes with a touch probe instead: X, Y, Z of the block's corner in mm and DELAY_00 to
#                DELAY_15 in s, as lines KEY = VALUE
#   --scratch    existing folder for LinuxCNC's files; the caller removes it
#
# While it runs DIR/cnc.events gets a line for each step: homed, "waiting X" (the program stands at
# its datum until `axiscal arm`), "message TEXT", "error TEXT", ended. DIR/cnc.log is LinuxCNC's own output.
# Exit: 0 the program ended well; 1 it did not (the reason on stderr); 2 wrong arguments;
# 77 LinuxCNC is not installed. TERM or INT shuts LinuxCNC down. Only one LinuxCNC can live on a
# computer, and starting a second one kills the first: this script waits for others of its kind
# and refuses to disturb a foreign one. Needs no terminal; runs as root or as an ordinary user.
set -euo pipefail

usage() { sed -n '4,5p' "$0" >&2; exit 2; }
refuse() { echo "run_linuxcnc: $1" >&2; exit "${2:-1}"; }

program='' shape='' port='' serial='' positions='' scratch='' block=''
while [ $# -gt 0 ]; do
    case "$1" in
    --program | --shape | --port | --serial | --positions | --scratch | --block) [ $# -ge 2 ] || usage ;;
    *) usage ;;
    esac
    printf -v "${1#--}" %s "$2"
    shift 2
done
[ -n "$program" ] && [ -n "$scratch" ] || usage
kind=machine
[ -z "$block" ] || kind=probe
[ "$kind" = probe ] || { [ -n "$shape" ] && [ -n "$port$serial" ] && [ -n "$positions" ]; } || usage
[ -z "$port" ] || [ -z "$serial" ] || usage
[ ${#serial} -le 31 ] || refuse "mb2hal cuts the name of a serial line off after 31 characters: $serial" 2
home=$(cd "$(dirname "$0")" && pwd)
[ "$kind" = probe ] || [ -f "$home/$shape.hal" ] || refuse "--shape is single-register, coil-and-index or sequence-block, not \"$shape\"" 2
[ -f "$program" ] || refuse "there is no program $program" 2
[ -d "$scratch" ] || refuse "there is no folder $scratch" 2
for tool in linuxcnc mb2hal halsampler; do
    command -v "$tool" >/dev/null || refuse "$tool is not installed (apt-get install linuxcnc-uspace)" 77
done
program=$(realpath "$program") scratch=$(realpath "$scratch")

if [ "$kind" = machine ]; then
    [ -p "$positions" ] || mkfifo "$positions"
    positions=$(realpath "$positions")
else
    [ -f "$block" ] || refuse "there is no block $block" 2
    block=$(realpath "$block")
fi

# The lock is the program file itself: nothing to create, and every user can take it.
exec 9<"$(command -v linuxcnc)"
flock -w 900 9 || refuse "another bench has held LinuxCNC for 15 minutes"
others() { ps -C rtapi_app,milltask,linuxcncsvr,mb2hal -o pid= || true; }
others_gone() {
    for _ in $(seq "$1"); do
        [ -n "$(others)" ] || return 0
        sleep 0.1
    done
    return 1
}
others_gone 50 || refuse "a LinuxCNC runs on this computer already; a second one would kill it"

# As root LinuxCNC insists on another user for its real-time part, which meets the rest at a socket
# in a folder that both can reach. A short path: a socket's name has 107 characters.
meeting=$(mktemp -d "${TMPDIR:-/tmp}/axiscal-cnc.XXXXXX")
cnc=''
finish() {
    trap '' TERM INT # nothing may stop the cleaning up
    if [ -n "$cnc" ] && kill -0 "$cnc" 2>/dev/null; then
        # LinuxCNC goes when its display goes; before there is one, its own script must.
        kill -TERM "$(cat "$scratch/display.pid" 2>/dev/null || echo "$cnc")" 2>/dev/null || true
        wait "$cnc" || true
    fi
    # Its processes outlive LinuxCNC's script by a second; nobody may meet them.
    others_gone 100 || echo "run_linuxcnc: LinuxCNC's processes are still there: $(others | xargs)" >&2
    rm -rf "$meeting"
}
trap finish EXIT
trap 'exit 1' TERM INT
if [ "$(id -u)" = 0 ]; then
    chmod 1777 "$meeting"
    export RTAPI_UID=${RTAPI_UID:-65534} RTAPI_FIFO_PATH=$meeting/fifo
fi

# HAL files name the files they need without quotes: they are read from the scratch folder, wherever this checkout lies.
recipe=$scratch/recipe
mkdir -p "$recipe"
cp "$home"/*.hal "$home/headless_display.py" "$recipe"
fill() { sed -e "s#@HOME@#$recipe#g; s#@PROGRAM@#$program#g; s#@SCRATCH@#$scratch#g; s#@POSITIONS@#$positions#g; s#@SHAPE@#$shape#g" "$1"; }
fill "$home/$kind.ini.in" >"$scratch/machine.ini"
[ -z "$block" ] || { printf '\n[BLOCK]\n'; cat "$block"; } >>"$scratch/machine.ini"
to_station="s/^TCP_IP=.*/TCP_IP=127.0.0.1/; s/^TCP_PORT=.*/TCP_PORT=$port/"
if [ -n "$serial" ]; then # as docs/trigger.md says
    line="SERIAL_PORT=$serial\nSERIAL_BAUD=115200\nSERIAL_BITS=8\nSERIAL_PARITY=none\nSERIAL_STOP=1\nSERIAL_DELAY_MS=0"
    to_station="s/^LINK_TYPE=.*/LINK_TYPE=serial/; s#^TCP_IP=.*#$line#; /^TCP_PORT=/d"
fi
[ "$kind" = probe ] || sed -e "$to_station" "$home/$shape.mb2hal.ini" >"$scratch/mb2hal.ini"
printf 'T1 P1 D1 Z0\n' >"$scratch/tool.tbl"
: >"$scratch/machine.var"
: >"$scratch/cnc.events"
rm -f "$scratch/display.pid"

unset DISPLAY # else LinuxCNC opens windows for its messages
cd "$scratch"
HOME=$scratch linuxcnc -r "$scratch/machine.ini" </dev/null >"$scratch/cnc.log" 2>&1 9<&- &
cnc=$!
status=0
wait "$cnc" || status=$?
cnc=''
grep '^error' "$scratch/cnc.events" >&2 || true
# The exit status alone proves nothing: it is also 0 when the display never started.
grep -q '^ended' "$scratch/cnc.events" || { tail -n 20 "$scratch/cnc.log" >&2; refuse "the program did not come to its end"; }
exit "$status"
