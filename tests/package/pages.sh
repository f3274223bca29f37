#!/usr/bin/env bash
# Each program and each command has its man page and its completion, in the words of --help.
#   pages.sh PACKAGES
set -euo pipefail
packages=$1
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
fail() { echo "FAILED: $*"; exit 1; }
for package in "$packages"/*.deb; do dpkg-deb -x "$package" "$root"; done
export LC_ALL=C.UTF-8 MANWIDTH=200

page() { man --warnings -l "$(find "$root/usr/share/man" -name "$1.[18].gz")" 2>"$root/warnings" | col -bx; }
count=0
holds() { # page, program words...
    local name=$1 text word
    shift
    text=$(page "$name") || fail "man cannot read the page of $name"
    [ ! -s "$root/warnings" ] || fail "$name: $(head -3 "$root/warnings")"
    for word in $("$root/usr/bin/$1" "${@:2}" --help | grep -oE -- '(^|[ ,])--[a-z-]+' | tr -d ' ,' | sort -u); do
        grep -qF -- "$word" <<<"$text" || fail "the page of $name lacks $word"
    done
    count=$((count + 1))
}
for program in axiscal axiscald axiscal-notify axiscal-publish axiscal-report axiscal-simulate; do holds "$program" "$program"; done
commands=$("$root/usr/bin/axiscal" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z-]*\) .*/\1/p')
for command in $commands; do holds "axiscal-$command" axiscal "$command"; done

completed() { # program, words typed...; prints what is offered for the last
    local program=$1
    shift
    # shellcheck disable=SC1090
    (. "$root/usr/share/bash-completion/completions/$program"
        COMP_WORDS=("$program" "$@") COMP_CWORD=$#
        COMPREPLY=()
        "_${program//-/_}"
        printf '%s\n' "${COMPREPLY[@]}")
}
[ "$(completed axiscal re | sort | xargs)" = "reading record replay result retake" ] || fail "axiscal re: $(completed axiscal re)"
[ "$(completed axiscal retake --direction '' | sort | xargs)" = "down up" ] || fail "retake --direction: $(completed axiscal retake --direction '')"
grep -qx -- --reason <<<"$(completed axiscal abort --re)" || fail "abort --re: $(completed axiscal abort --re)"
[ "$(completed axiscald --con)" = --config ] || fail "axiscald --con: $(completed axiscald --con)"
touch "$root/a-run.axiscal"
[ "$(completed axiscal verify "$root/a-r")" = "$root/a-run.axiscal" ] || fail "verify completes no file"
echo "$count pages hold every option of --help; completion offers commands, options, choices and files"
