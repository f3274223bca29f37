#!/usr/bin/env python3
"""Every relative link in a Markdown file leads to a file that is there.

links.py SOURCE_FOLDER | links.py --self-test
"""
import os
import re
import sys
import tempfile

LINK = re.compile(r"\]\(([^)\s]+)\)")
SKIPPED = {".git", "build", "build-asan", "demo-share"}


def markdown_files(root):
    for folder, folders, names in os.walk(root):
        folders[:] = [name for name in folders if name not in SKIPPED and not name.startswith("build")]
        yield from (os.path.join(folder, name) for name in names if name.endswith(".md"))


def broken_links(root):
    found = []
    for path in markdown_files(root):
        with open(path, encoding="utf-8") as source:
            text = re.sub(r"```.*?```", "", source.read(), flags=re.S)
        for target in LINK.findall(text):
            if re.match(r"[a-z]+:", target) or target.startswith("#"):
                continue
            if not os.path.exists(os.path.join(os.path.dirname(path), target.split("#")[0])):
                found.append(f"{os.path.relpath(path, root)}: {target} does not exist")
    return found


def self_test():
    with tempfile.TemporaryDirectory() as root:
        with open(os.path.join(root, "a.md"), "w", encoding="utf-8") as out:
            out.write("[good](a.md) [far](https://x.example) [bad](gone.md#part)\n```\n[code](not-seen)\n```\n")
        return [] if broken_links(root) == ["a.md: gone.md#part does not exist"] else ["planted link not seen"]


if __name__ == "__main__":
    problems = self_test() if sys.argv[1] == "--self-test" else broken_links(sys.argv[1])
    print("\n".join(problems) or "no broken link")
    sys.exit(1 if problems else 0)
