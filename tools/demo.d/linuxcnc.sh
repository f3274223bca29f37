# shellcheck shell=bash disable=SC2154
# tools/demo --cnc linuxcnc: sourced by the demo, whose scratch, scenario, shape and processes it uses.

# The instruments of the scenario; their laser follows the positions that LinuxCNC will send.
start_simulated_instruments() {
    mkfifo "$scratch/positions"
    (cd "$scratch" && exec axiscal-simulate --scenario "$scenario" --positions "$scratch/positions") \
        >"$scratch/simulate.log" 2>&1 &
    processes+=($!)
}

# start_linuxcnc PROGRAM PORT
start_linuxcnc() {
    tools/linuxcnc/run_linuxcnc.sh --program "$1" --shape "$shape" --port "$2" \
        --positions "$scratch/positions" --scratch "$scratch" >"$scratch/run_linuxcnc.log" 2>&1 &
    processes+=($!)
}

linuxcnc_waits_at_datum() { grep -q '^waiting' "$scratch/cnc.events"; }
