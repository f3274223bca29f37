#!/usr/bin/env bash
# tools/soak on parsers and tests that are scripts: it searches as many at a time as there are cores, keeps
# what they say and find apart, plays each test with one new seed after the other, and its last line and
# status tell of the one that broke.
#   soak_abreast.sh SOURCE_DIR
set -euo pipefail
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
fail() { echo "FAILED: $*"; cat "$root/said" 2>/dev/null; exit 1; }

mkdir -p "$root"/{tools,bin,build/soak/bin,build/check/bin} "$root"/tests/fuzz/corpus/{first,second,third}
cp "$1/tools/soak" "$root/tools/soak"
printf '#!/bin/sh\n' | tee "$root/tools/install-dependencies" "$root/bin/cmake" >/dev/null
printf '#!/bin/sh\necho 2\n' >"$root/bin/nproc"
# Each counts who is at work beside it; the first two wait for each other, which one alone never sees.
cat >"$root/build/soak/bin/fuzz_first" <<'SCRIPT'
#!/bin/bash
name=${0##*fuzz_}
touch "at_work.$name"
[ "$(ls at_work.* | wc -l)" -le 2 ] || touch too_many
touch "met.$name"
for ((i = 0; i < 200; i++)); do [ -e met.first ] && [ -e met.second ] && break; sleep 0.05; done
[ -e met.first ] && [ -e met.second ] || { rm "at_work.$name"; echo "ERROR: alone"; exit 2; }
for word in "$@"; do case $word in -artifact_prefix=*) found=${word#*=} ;; esac; done
rm "at_work.$name"
if [ "$name" = third ]; then echo bad >"${found}crash-1"; echo "ERROR: third broke"; exit 77; fi
echo "stat::number_of_executed_units: 20"
SCRIPT
cp "$root"/build/soak/bin/fuzz_{first,second}
cp "$root"/build/soak/bin/fuzz_{first,third}
# Of the tests one passes with each seed, the other breaks with the third that it is given.
cat >"$root/build/check/bin/week_tests" <<'SCRIPT'
#!/bin/bash
echo "$AXISCAL_SEED $*" >>seeds
echo "[  PASSED  ] 1 test."
SCRIPT
cat >"$root/build/check/bin/run_tests" <<'SCRIPT'
#!/bin/bash
echo "$AXISCAL_SEED" >>other_seeds
[ "$(wc -l <other_seeds)" -lt 3 ] || { echo "a.cpp:1: Failure"; exit 1; }
echo "[  PASSED  ] 1 test."
SCRIPT
printf '#!/bin/sh\necho "[  PASSED  ] 2 tests."\n' >"$root/build/check/bin/setups_tests"
chmod +x "$root"/{tools,bin,build/soak/bin,build/check/bin}/*

soak() { (cd "$root" && PATH=$root/bin:$PATH tools/soak "$@" >said 2>&1); }
soak 1 first second third && fail "a broken parser ends well"
[ "$(tail -n 1 "$root/said")" = "3 targets searched for 1 s each, 40 inputs tried, 1 broken: third" ] || fail "last line"
grep -q "ERROR: third broke" "$root/said" || fail "what broke is not told"
[ ! -e "$root/too_many" ] || fail "more at a time than cores"
[ "$(cat "$root/build/soak/found/third/crash-1")" = bad ] || fail "what was found is not kept apart"
[ -z "$(ls "$root/build/soak/found/first")" ] || fail "a find in the wrong folder"

soak 1 first second || fail "two sound parsers end badly"
[ "$(tail -n 1 "$root/said")" = "2 targets searched for 1 s each, 40 inputs tried, 0 broken" ] || fail "last line of two"

soak 1 weeks || fail "a sound test ends badly"
[[ $(tail -n 1 "$root/said") =~ ^'1 targets searched for 1 s each, 0 inputs tried, '([0-9]+)' seeds of weeks, 0 broken'$ ]] || fail "last line of a test"
[ "${BASH_REMATCH[1]}" = "$(wc -l <"$root/seeds")" ] || fail "seeds counted wrongly"
[ "$(sort -u "$root/seeds" | wc -l)" = "${BASH_REMATCH[1]}" ] || fail "the same seed twice"
grep -q -- ' --gtest_filter=SimulatedWeek\.\*$' "$root/seeds" || fail "another test was asked for"

soak 30 triggers && fail "a broken test ends well"
[ "$(wc -l <"$root/other_seeds")" = 3 ] || fail "it went on behind the seed that broke"
[ "$(sort -u "$root/other_seeds" | wc -l)" = 3 ] || fail "a seed came again before it broke"
grep -q "ERROR: AXISCAL_SEED=$(tail -n 1 "$root/other_seeds") build/check/bin/run_tests" "$root/said" || fail "the seed is not told"
printf '#!/bin/sh\necho "[  PASSED  ] 0 tests."\n' >"$root/build/check/bin/run_tests"
soak 30 triggers && fail "a filter that finds no test passes"

mkdir -p "$root/tests/bench"
printf 'import os\nprint("page: its heap |", os.environ["AXISCAL_BENCH_PAGE_SECONDS"])\n' >"$root/tests/bench/page.py"
soak 7 page || fail "a page within its goals ends badly"
grep -q '^page: its heap | 7$' "$root/said" || fail "rows of the page are not shown, or of another time"
[ "$(tail -n 1 "$root/said")" = "1 targets searched for 7 s each, 0 inputs tried, the page shown, 0 broken" ] || fail "last line of the page"
printf 'print("page: its heap | 600 KiB  MISSED")\nraise SystemExit(1)\n' >"$root/tests/bench/page.py"
soak 7 page && fail "a page that grows ends well"
[ "$(tail -n 1 "$root/said")" = "1 targets searched for 7 s each, 0 inputs tried, the page shown, 1 broken: page" ] || fail "last line of a page that grows"

rm -r "$root"/tests/fuzz/corpus/third
soak 1 && fail "a target that is not named is not tried"
grep -q '^6 targets searched .* seeds of setups and .* seeds of triggers and .* seeds of truth and .* seeds of weeks, 1 broken: triggers$' "$root/said" || fail "not all targets"
