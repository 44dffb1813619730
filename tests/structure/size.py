# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Counts the lines of source and include: all, and those of code, which are
neither blank nor comment; by folder, and the largest files; the Python package
beside. Fails where a folder or a file is too large to read."""

import collections
import pathlib
import sys

LARGEST_SHARE = 1 / 7
LONGEST_FILE = 400


def lines_of_code(text):
    """Of C++. Comments begin lines: the end of a line of code is no line."""
    count, in_comment = 0, False
    for line in map(str.strip, text.splitlines()):
        if in_comment or line.startswith("/*"):
            in_comment = "*/" not in line
        elif line and not line.startswith("//"):
            count += 1
    return count


def main(root):
    folders = collections.defaultdict(lambda: [0, 0, 0])
    lengths = {}
    for path in sorted(p for part in ("source", "include")
                       for p in (root / part).rglob("*")
                       if p.suffix in (".cc", ".h")):
        text = path.read_text()
        lengths[path.relative_to(root).as_posix()] = len(text.splitlines())
        for i, number in enumerate((1, len(text.splitlines()),
                                    lines_of_code(text))):
            folders[path.parent.name][i] += number
    files, lines, code = map(sum, zip(*folders.values()))

    print(f"{'folder':18}{'files':>6}{'lines':>8}{'code':>8}{'share':>8}")
    for name, row in sorted(folders.items(), key=lambda item: -item[1][1]):
        print(f"{name:18}{row[0]:6}{row[1]:8}{row[2]:8}{row[1] / lines:8.1%}")
    print(f"{'all':18}{files:6}{lines:8}{code:8}")
    package = sorted((root / "source" / "python").rglob("*.py"))
    print(f"{'Python package':18}{len(package):6}"
          f"{sum(len(p.read_text().splitlines()) for p in package):8}")
    print("largest files:")
    for name in sorted(lengths, key=lengths.get, reverse=True)[:10]:
        print(f"{lengths[name]:6} {name}")

    errors = []
    if files < 100:
        errors.append(f"only {files} files under {root}: wrong folder?")
    errors += [f"{name} has {row[1] / lines:.1%} of all lines, a seventh is "
               "allowed" for name, row in folders.items()
               if row[1] > LARGEST_SHARE * lines]
    errors += [f"{name} has {length} lines, {LONGEST_FILE} are allowed"
               for name, length in lengths.items() if length > LONGEST_FILE]
    print(*errors, sep="\n", file=sys.stderr)
    return 1 if errors else 0


sys.exit(main(pathlib.Path(sys.argv[1]).resolve()))
