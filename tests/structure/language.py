# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Turns of phrase that the program does not use, in the pages or, with the
option --all, also in sources, scenes and tests. Beside each is what to write."""

import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1]).resolve()

TURNS = {
    r"\bhow well\b": "how accurate",
    r"when to believe": "when to trust",
    r"\b(goes|go|going|gone|went) on (where|by|with|from|as|to)\b": "resumes, continues",
    r"\b(take|takes|taken|taking|took) (it |them )?up (again|where|a|the|by)\b":
        "resume",
    r"rigid motions? (is |are )?left free|\bleaves? free\b":
        "unconstrained rigid-body motion",
    r"half the step leaves": "halving the step divides the error by 2^p",
    r"what is not said": "name the subject",
    r"\bbut for the\b": "except the",
    r"as they do now": "at the current rate",
    r"wider apart": "non-uniform",
    r"\bcalls? for\b.*\band why\b": "active effects",
    r"other than the default": "non-default",
    r"here of the (run|point)": "settings of the reference run",
    r"of these time stepping": "stepping (s)",
    r"\bof the processor\b": "CPU (s)",
    r"\bis had for\b": "give",
    r"\bin vain\b|\bhonest\b": "correctly reported as failed",
    r"whose volume hardly|volume hardly changes": "nearly incompressible",
    r"multigrid without a matrix|without a matrix, geometric": "matrix-free multigrid",
    r"\b(is|are|was|were) (told|warned of)\b": "is reported; causes a warning",
    r"hardly meant": "probably a mistake",
    r"swings? on": "oscillates instead of decaying",
    r"takes \w+ periods of anderson": "converges in n Anderson iterations",
}


def files():
    yield from [ROOT / "README.md", ROOT / "CHANGELOG.md"]
    yield from sorted((ROOT / "doc").rglob("*.md"))
    if "--all" in sys.argv:
        for folder, ends in (("doc", "py"), ("include", "h"), ("source", "cc"),
                             ("source", "py"), ("prm", "prm"), ("tests", "cc"),
                             ("tests", "py"), ("tests", "prm")):
            yield from sorted((ROOT / folder).rglob(f"*.{ends}"))


found = 0
for path in files():
    if path == pathlib.Path(__file__).resolve():
        continue
    text = path.read_text()
    for turn, instead in TURNS.items():
        # A turn may be broken across lines.
        for match in re.finditer(turn.replace(" ", r"\s+"), text):
            line = text.count("\n", 0, match.start()) + 1
            words = " ".join(match[0].split())
            print(f"{path.relative_to(ROOT)}:{line}: '{words}': {instead}")
            found += 1
print(found, "turns found")
sys.exit(1 if found else 0)
