#!/usr/bin/env python3
"""Man pages and shell completion of every program, from what each says of itself (--describe, tools/describe).

pages.py PROGRAMS SHARE   reads PROGRAMS/axiscal*, writes SHARE/man/man*/ and SHARE/bash-completion/completions/
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import time

OF_THE_SYSTEM = ("axiscald", "axiscal-notify", "axiscal-publish")  # section 8: services
CHOICES = re.compile(r"\{([^}]*)\}")
# The date of the package (reproducible-builds.org), not of the day on which it is built.
DAY = time.strftime("%Y-%m-%d", time.gmtime(int(os.environ.get("SOURCE_DATE_EPOCH", time.time()))))


def described(program):
    """The environment of whoever builds must not stand in a page: some usual values are taken from it."""
    told = subprocess.run([program, "--describe"], env={"LC_ALL": "C.UTF-8"}, check=True, capture_output=True, text=True).stdout
    version = subprocess.run([program, "--version"], env={"LC_ALL": "C.UTF-8"}, check=True, capture_output=True, text=True).stdout
    return json.loads(told), re.search(r"\d+\.\d+\.\d+", version).group()


def escaped(text):
    """For roff: no character of its language, and no line that begins with one of its orders."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return re.sub(r"^([.'])", r"\\&\1", text, flags=re.M)


def heading_of(option):
    names = ", ".join(f"\\fB{escaped(name)}\\fR" for name in option["names"])
    value = option["value"]
    if not value or option["positional"]:
        return names
    choices = CHOICES.search(value)
    return f"{names} \\fI{escaped(choices.group(1).replace(',', '|') if choices else value.split(':')[0])}\\fR"


def option_in_roff(option):
    usual = f" Usually {option['default']}." if option["default"] else ""
    needed = " Must be given." if option["required"] else ""
    text = option["text"].rstrip(".") + "." if usual or needed else option["text"]
    return f".TP\n{heading_of(option)}\n{escaped(text + usual + needed)}\n"


def synopsis_of(words, command):
    parts = [f"\\fB{escaped(words)}\\fR"]
    if any(not option["positional"] for option in command["options"]):
        parts.append("[\\fIOPTION\\fR]...")
    for option in command["options"]:
        if option["positional"]:
            name = f"\\fI{escaped(option['names'][-1])}\\fR"
            parts.append(name if option["required"] else f"[{name}]")
    if command["commands"]:
        parts.append("\\fICOMMAND\\fR")
    return " ".join(parts)


def footer_in_roff(footer):
    """As --help prints it: examples stand in columns."""
    return f".SH NOTES\n.nf\n{escaped(footer.strip())}\n.fi\n" if footer.strip() else ""


def page(words, command, section, version, others):
    name = words.replace(" ", "-")
    text = command["text"]
    brief = re.split(r"[.;:] ", re.sub(r"^axiscal\w*: ", "", text))[0].rstrip(".")
    roff = f'.TH {name.upper()} {section} {DAY} "axiscal {version}" axiscal\n'
    roff += f".SH NAME\n{escaped(name)} \\- {escaped(brief[0].lower() + brief[1:])}\n"
    roff += f".SH SYNOPSIS\n{synopsis_of(words, command)}\n.SH DESCRIPTION\n{escaped(text)}\n"
    if command["options"]:
        roff += ".SH OPTIONS\n" + "".join(map(option_in_roff, command["options"]))
    if command["commands"]:
        roff += ".SH COMMANDS\n"
        for inner in command["commands"]:
            roff += f".TP\n\\fB{escaped(inner['name'])}\\fR\n{escaped(inner['text'])}\n"
            if inner["options"] and words != "axiscal":
                roff += ".RS\n" + "".join(map(option_in_roff, inner["options"])) + ".RE\n"
    roff += footer_in_roff(command["footer"])
    seen = ",\n".join(f".BR {escaped(other)} ({number})" for other, number in others if other != name)
    return roff + (".SH SEE ALSO\n" + seen + "\n" if seen else "")


def words_after(command):
    """(words to offer, {option: choices}) behind a command."""
    offered, choices = [inner["name"] for inner in command["commands"]], {}
    for option in command["options"]:
        if option["positional"]:
            continue
        offered += option["names"]
        found = CHOICES.search(option["value"])
        for name in option["names"]:
            if option["value"]:
                choices[name] = found.group(1).split(",") if found else []
    return offered, choices


def completion(program, told):
    """A case a command; behind an option with a value its choices, else the files of the folder."""
    function = "_" + program.replace("-", "_")
    cases = [f"    '{command['name'] if command is not told else ''}') words='{' '.join(words_after(command)[0])}' ;;"
             for command in [told, *told["commands"]]]
    picks = {}
    for command in [told, *told["commands"]]:
        for option, values in words_after(command)[1].items():
            picks.setdefault((command["name"] if command is not told else "", option), values)
    lines = "\n".join(f"    '{command}':{option}) COMPREPLY=($(compgen {'-W ' + repr(' '.join(values)) if values else '-f'} -- \"$current\")); return ;;"
                      for (command, option), values in picks.items())
    known = " ".join(inner["name"] for inner in told["commands"])
    return f"""# Made from {program} --describe.
{function}() {{
    local current=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} command='' word words=''
    for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
        case " {known} " in *" $word "*) command=$word; break ;; esac
    done
    case "$command:$before" in
{lines}
    esac
    case "$command" in
{chr(10).join(cases)}
    esac
    if [[ $current != -* && ( -n $command || -z '{known}' ) ]]; then
        COMPREPLY=($(compgen -f -- "$current"))
    else
        COMPREPLY=($(compgen -W "$words" -- "$current"))
    fi
}}
complete -o filenames -F {function} {program}
"""


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def main():
    programs, share = map(pathlib.Path, sys.argv[1:])
    found = sorted(path for path in programs.glob("axiscal*") if path.is_file())
    section = {path.name: 8 if path.name in OF_THE_SYSTEM else 1 for path in found}
    for path in found:
        told, version = described(path)
        name = path.name
        inner = [(f"{name}-{command['name']}", 1) for command in told["commands"]] if name == "axiscal" else []
        others = [(other, number) for other, number in section.items()] + inner
        write(share / f"man/man{section[name]}/{name}.{section[name]}", page(name, told, section[name], version, others))
        for command in told["commands"] if name == "axiscal" else []:
            write(share / f"man/man1/{name}-{command['name']}.1", page(f"{name} {command['name']}", command, 1, version, [("axiscal", 1)]))
        write(share / f"bash-completion/completions/{name}", completion(name, told))


main()
