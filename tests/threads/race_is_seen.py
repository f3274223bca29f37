#!/usr/bin/env python3
"""The thread sanitizer reports a planted race, and nothing where the product's own fence stands.

race_is_seen.py DATA_RACE_PROGRAM      (with the TSAN_OPTIONS of the other tests)
"""
import subprocess
import sys

SANITIZER_EXIT = 66


def main():
    forgotten = subprocess.run([sys.argv[1], "forgotten"], capture_output=True, text=True)
    fenced = subprocess.run([sys.argv[1], "fenced"], capture_output=True, text=True)
    seen = (forgotten.returncode == SANITIZER_EXIT
            and "WARNING: ThreadSanitizer: data race" in forgotten.stderr
            and "leave_it_lying" in forgotten.stderr)
    clean = fenced.returncode == 0 and fenced.stdout == "42\n" and "ThreadSanitizer" not in fenced.stderr
    if not seen:
        print(f"the planted race was not reported (exit {forgotten.returncode}):\n{forgotten.stderr}")
    if not clean:
        print(f"the fence was reported (exit {fenced.returncode}):\n{fenced.stderr}")
    print("a planted race is reported, the product's fence is not" if seen and clean else "FAILED")
    return 0 if seen and clean else 1


sys.exit(main())
