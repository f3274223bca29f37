#!/usr/bin/env python3
"""One word to the simulator's control socket.

control.py SOCKET run                  starts the program
control.py SOCKET at-datum PROGRAM     exit 0 once the axis stands where the program first goes
"""
import json
import re
import socket
import sys


def ask(path, line):
    with socket.socket(socket.AF_UNIX) as door:
        door.settimeout(5)
        door.connect(path)
        door.sendall((line + "\n").encode())
        return json.loads(door.makefile().readline())


def main():
    path, word = sys.argv[1:3]
    if word == "at-datum":
        with open(sys.argv[3], encoding="ascii") as program:
            datum_mm = float(re.search(r"^G1 X([-0-9.]+)", program.read(), re.M).group(1))
        return 0 if abs(ask(path, "status").get("drive_mm", 1e9) - datum_mm) < 1e-6 else 1
    answer = ask(path, word)
    print(json.dumps(answer))
    return 0 if answer.get("ok") else 1


sys.exit(main())
