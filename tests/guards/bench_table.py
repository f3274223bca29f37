#!/usr/bin/env python3
"""The table of tools/bench is printed whatever becomes of one row: made benchmark programs die at their end, and in the middle.

bench_table.py TABLE_SCRIPT
"""
import os
import subprocess
import sys
import tempfile

# Speaks as Google Benchmark does; "dies" is the row at which it is killed, "at_end" kills it when all is told.
PROGRAM = """#!/usr/bin/env python3
import json, os, re, signal, sys
DIES, AT_END = {dies!r}, {at_end!r}
works = ["first row/this", "first row/limit", "second row/this"]
words = dict(word.split("=", 1) for word in sys.argv[1:])
wanted = [work for work in works if re.search(words["--benchmark_filter"], work)]
if "--benchmark_list_tests" in words:
    print("\\n".join(wanted))
    sys.exit()
if any(work.startswith(DIES) for work in wanted if DIES):
    print('{{"benchmarks": [', flush=True)
    os.kill(os.getpid(), signal.SIGSEGV)
figure = dict(run_type="iteration", real_time=1000.0, label="read pass", goal_ratio=0, goal_ms=0, goal_numpy=0, goal_peer=0)
print(json.dumps(dict(benchmarks=[dict(figure, run_name=work, family_index=works.index(work)) for work in wanted])), flush=True)
if AT_END:
    os.kill(os.getpid(), signal.SIGSEGV)
"""


def table(script, **how):
    with tempfile.TemporaryDirectory() as folder:
        program = os.path.join(folder, "made_bench")
        with open(program, "w", encoding="utf-8") as file:
            file.write(PROGRAM.format(**{"dies": "", "at_end": False, **how}))
        os.chmod(program, 0o755)
        cpu = str(min(os.sched_getaffinity(0)))
        done = subprocess.run([sys.executable, "-B", script, program, cpu, "0.01", "-"], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


def expect(holds, told):
    if not holds:
        sys.exit(told)


code, shown = table(sys.argv[1])
expect(code == 0 and "| first row" in shown and "| second row" in shown, f"all is well: {code}\n{shown}")
code, shown = table(sys.argv[1], at_end=True)
expect(code == 1 and "| first row" in shown and "| second row" in shown, f"it dies at its end: {code}\n{shown}")
expect("ended with -11" in shown, f"that it died is told: {shown}")
code, shown = table(sys.argv[1], dies="second")
expect(code == 1 and "| first row" in shown, f"one row dies: {code}\n{shown}")
expect("second row: ended with -11" in shown, f"which row died is told: {shown}")
print("the table is printed, and what died is told")
