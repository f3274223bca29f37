"""What a long story said of its checks: `ok SENTENCE` or `FAILED SENTENCE: why`, and indented what belongs to it."""

import os
import sys

SKIPPED = 77


def missing(why, label):
    """Ends the test: skipped only where AXISCAL_MAY_SKIP names the label."""
    print(why)
    if label in os.environ.get("AXISCAL_MAY_SKIP", "").split(","):
        sys.exit(SKIPPED)
    sys.exit(f"or AXISCAL_MAY_SKIP={label}")


def never_run(sentences, said):
    """The checks of which was said neither "ok" nor "FAILED"."""
    lines = said.splitlines()
    return [sentence for sentence in sentences
            if f"ok {sentence}" not in lines and not any(line.startswith(f"FAILED {sentence}:") for line in lines)]


def outcome(folder, sentence, label):
    """Prints the line of the check in FOLDER/output.txt, and what follows it up to the next one; 0 where it was ok."""
    said = folder / "output.txt"
    if not said.exists():
        missing(f"{said} is not there: nothing has run", label)
    lines = said.read_text(errors="replace").splitlines()
    at = next((i for i, line in enumerate(lines) if line == f"ok {sentence}" or line.startswith(f"FAILED {sentence}:")), None)
    if at is None:
        print("\n".join(lines[-30:]))
        sys.exit(f"it never came to {sentence}")
    print("\n".join([lines[at], *(line for line in lines[at + 1 : at + 80] if line.startswith("  "))]))
    return 0 if lines[at].startswith("ok ") else 1
