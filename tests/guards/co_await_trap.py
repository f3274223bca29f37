#!/usr/bin/env python3
"""No capturing lambda and no aggregate temporary inside a co_await expression.

g++ 12 destroys such a temporary twice: `co_await f([x] { ... })`, `co_await f(Arguments{x})` and
`co_await f({x})`. Name the value first, then `co_await f(std::move(named))`. A coroutine that is a
capturing lambda loses its captures with the lambda: coroutines are functions.
`if (co_await f(std::move(named)))` becomes an illegal instruction: name the answer first.

co_await_trap.py SOURCE_DIR     checks the sources
co_await_trap.py --self-test    proves that planted samples are seen and good code is not
"""
import pathlib
import re
import sys

FOLDERS = ("acquisition", "drivers", "tools", "tests")
NOISE = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'', re.S)
CAPTURING = re.compile(r"(?:^|[(,=&|]|\bco_await|\breturn)\s*\[\s*[^\]\s][^\]]*\]\s*(?:\(|\{|mutable|noexcept|->)")
# A braced value that is handed over: Name{...} or {...} as an argument or operand.
# Left out, as they have constructors of their own: std:: and Asio types, durations, errors.
BRACED = re.compile(r"(?:^|[(,]|\bco_await)\s*(?:((?:\w+::)*[A-Z]\w*(?:<[^<>]*>)?)\s*)?\{")
COROUTINE_LAMBDA = re.compile(r"\[\s*[^\]\s][^\]]*\]\s*\([^()]*(?:\([^()]*\)[^()]*)*\)\s*(?:mutable\s*)?"
                              r"->\s*(?:\w+::)*(?:Task|awaitable)\b")
CONDITION = re.compile(r"\b(?:if|while)\s*\(\s*!?\s*$")


def blank_noise(text):
    """Comments and literals become spaces, so that places stay."""
    return NOISE.sub(lambda found: re.sub(r"[^\n]", " ", found.group()), text)


def operand(text, begin):
    """What stands after co_await, to the end of its full expression."""
    depth = 0
    for at in range(begin, len(text)):
        if text[at] in "([{":
            depth += 1
        elif text[at] in ")]}":
            depth -= 1
            if depth < 0:
                return text[begin:at]
        elif text[at] == ";" and depth == 0:
            return text[begin:at]
    return text[begin:]


def complaints(path, source):
    text = blank_noise(source)
    for found in re.finditer(r"\bco_await\b", text):
        expression = operand(text, found.end())
        line = text.count("\n", 0, found.start()) + 1
        if CAPTURING.search(expression):
            yield f"{path}:{line}: a capturing lambda inside co_await: name it first"
        if BRACED.search(expression):
            yield f"{path}:{line}: a braced temporary inside co_await: name it first"
        if CONDITION.search(text[max(0, found.start() - 40):found.start()]) and "std::move" in expression:
            yield f"{path}:{line}: a condition awaits what takes a moved value: name its answer first"
    for found in COROUTINE_LAMBDA.finditer(text):
        line = text.count("\n", 0, found.start()) + 1
        yield f"{path}:{line}: a coroutine that is a capturing lambda: make it a function"


BAD = [
    "co_await f([x] { return x; });",
    "co_await f([&](int a) { return a; });",
    "auto r = co_await send(Arguments{x, y});",
    "co_await link->open({}, deadline);",
    "co_await open(a, LinkSettings{.path = p});",
    "const auto r =\n    co_await read(\n        ModbusRead{1, 3});",
    "auto task = [this]() -> Task<void> { co_return; };",
    "if (co_await wait.until_taken_over(recovery, std::move(told))) open_port();",
    "co_spawn(loop, [&session]() -> boost::asio::awaitable<void> { co_return; }, detached);",
]
GOOD = [
    "co_await f(std::move(named));",
    "const LinkSettings nowhere;\nauto opened = co_await player.open(nowhere, deadline);",
    "if (co_await ready(deadline + std::chrono::seconds{1})) { Arguments a{1}; }",
    "post(loop, [x] { use(x); });\nco_await timer.async_wait(token);",
    "co_await f(table[index], 2); // co_await f([x]{})",
    "if (auto taken = co_await f(std::move(named)); !taken) return;",
    "if (co_await f(named)) g(std::move(named));",
    'log("co_await f(Arguments{x})");',
]


def self_test():
    missed = [sample for sample in BAD if not list(complaints("planted", sample))]
    false_alarms = [sample for sample in GOOD if list(complaints("good", sample))]
    for sample in missed:
        print(f"not seen: {sample}")
    for sample in false_alarms:
        print(f"false alarm: {sample}")
    return 1 if missed or false_alarms else 0


def main():
    if sys.argv[1] == "--self-test":
        return self_test()
    root = pathlib.Path(sys.argv[1])
    found, seen = [], 0
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*.[ch]pp")):
            source = path.read_text(encoding="utf-8")
            seen += source.count("co_await")
            found += complaints(path.relative_to(root), source)
    print("\n".join(found))
    print(f"{seen} co_await looked at")
    return 1 if found or seen == 0 else 0


sys.exit(main())
