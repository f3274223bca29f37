#!/usr/bin/env python3
"""Checks the grammar of a udev rules file (systemd 252 has no `udevadm verify`).

udev_rules.py FILE...    exit 1 and one line for each mistake
udev_rules.py --self-test
"""
import re
import sys

# udev(7): keys that compare, and keys that assign.
MATCH = {"ACTION", "DEVPATH", "KERNEL", "KERNELS", "NAME", "SYMLINK", "SUBSYSTEM", "SUBSYSTEMS", "DRIVER", "DRIVERS",
         "ATTR", "ATTRS", "SYSCTL", "ENV", "CONST", "TAG", "TAGS", "TEST", "PROGRAM", "RESULT"}
ASSIGN = {"NAME", "SYMLINK", "OWNER", "GROUP", "MODE", "SECLABEL", "ATTR", "SYSCTL", "ENV", "TAG", "RUN", "LABEL",
          "GOTO", "IMPORT", "OPTIONS"}
WITH_ATTRIBUTE = {"ATTR", "ATTRS", "ENV", "SYSCTL"}
PAIR = re.compile(r'\s*([A-Z]+)(?:\{([^}]*)\})?\s*(==|!=|\+=|-=|:=|=)\s*"((?:[^"\\]|\\.)*)"\s*(?:,|$)')


def check_pair(key, attribute, operator):
    compares = operator in ("==", "!=")
    if key not in (MATCH if compares else ASSIGN):
        return f"{key} {operator} is no rule of udev"
    if key in WITH_ATTRIBUTE and not attribute:
        return f"{key} needs the name of an attribute in braces"
    return None


def check(text):
    mistakes, labels, jumps = [], {}, []
    for number, line in enumerate(text.replace("\\\n", "").splitlines(), 1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        at = 0
        while at < len(line.rstrip()):
            pair = PAIR.match(line, at)
            if not pair:
                mistakes.append((number, f"cannot be read from: {line[at:].strip()}"))
                break
            key, attribute, operator, value = pair.groups()
            if mistake := check_pair(key, attribute, operator):
                mistakes.append((number, mistake))
            if key == "LABEL":
                labels[value] = number
            if key == "GOTO":
                jumps.append((number, value))
            at = pair.end()
    mistakes += [(n, f"GOTO {label} leads nowhere ahead") for n, label in jumps if labels.get(label, 0) <= n]
    return sorted(mistakes)


def self_test():
    assert check('SUBSYSTEM=="tty", GROUP="axiscal"\n') == []
    assert check('ACTION=="remove", GOTO="end"\nLABEL="end"\n') == []
    for wrong in ('SUBSYSTEM="tty"', 'SUBSYTEM=="tty"', 'ATTR=="1"', 'GROUP=="x"', 'GROUP="x', 'GOTO="nowhere"',
                  'LABEL="a"\nGOTO="a"', 'SUBSYSTEM=="tty" GROUP="x"'):
        assert check(wrong + "\n"), wrong
    print("each planted mistake is seen")


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    found = [(name, *mistake) for name in sys.argv[1:] for mistake in check(open(name, encoding="utf-8").read())]
    for name, line, mistake in found:
        print(f"{name}:{line}: {mistake}")
    return 1 if found or not sys.argv[1:] else 0


sys.exit(main())
