#!/usr/bin/env bash
# tools/demo --json as a program would call it: one line on stdout, a path, and a truth that holds.
#   demo.sh SOURCE_DIR BUILD_DIR [demo options]
# A missing LinuxCNC is a failure unless AXISCAL_MAY_SKIP names linuxcnc (then exit 77).
set -euo pipefail
source=$1 build=$2
shift 2
if [[ " $* " == *linuxcnc* ]] && ! command -v linuxcnc >/dev/null; then
    echo "linuxcnc is missing: tools/install-dependencies linuxcnc, or AXISCAL_MAY_SKIP=linuxcnc"
    case ",${AXISCAL_MAY_SKIP:-}," in *,linuxcnc,*) exit 77 ;; esac
    exit 1
fi
line=$(AXISCAL_BUILD=$build "$source/tools/demo" --json "$@")
python3 - "$line" <<'E2'
import json, sys
assert "\n" not in sys.argv[1], "more than one line on stdout"
with open(sys.argv[1], encoding="utf-8") as file:
    document = json.load(file)
figures, truth = document["parameters"], document["truth"]["parameters"]
assert set(truth) == set(figures), (sorted(truth), sorted(figures))
assert len(document["positions"]) == 11 and document["format"] == "axiscal.result/1"
for key, hidden in truth.items():
    low, high = (hidden["value"] - hidden["bound"], hidden["value"] + hidden["bound"]) if "bound" in hidden else (hidden["low"], hidden["high"])
    assert low <= figures[key]["value"] <= high, (key, figures[key], hidden)
    assert figures[key]["expanded_uncertainty"]["k"] == 2 and figures[key]["expanded_uncertainty"]["value"] > 0, key
assert document["preliminary"] is False and "missing" not in document
print("12 figures within what the injected noise explains")
E2
rm -rf "$(dirname "$line")"
