#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""What the tests that ran in a build of the preset "coverage" have reached: a table
of the folders for doc/testing.md, then with --lines the lines that none reached."""

import argparse
import collections
import json
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]


def measured(build):
    """{file: {line: count}} of the program's own files, by gcovr."""
    if not shutil.which("gcovr"):
        sys.exit("gcovr is not installed: apt-get install gcovr")
    if not any(build.rglob("*.gcda")):
        sys.exit(f"No test has run in {build}: doc/testing.md, Coverage.")
    text = subprocess.run(  # whose filters hold in the current folder
        ["gcovr", "--root", ROOT, "--object-directory", build, build, "--json", "-j", "2",
         "--filter", "source/", "--filter", "include/", "--exclude-throw-branches",
         "--gcov-ignore-parse-errors"],
        cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True).stdout
    return {entry["file"]: {line["line_number"]: line["count"] for line in entry["lines"]
                            if not line["gcovr/noncode"]}
            for entry in json.loads(text)["files"]}


def folder(file):
    """Of a source or of its header."""
    return file.removeprefix("include/crevasse/").removeprefix("source/").split("/")[0]


def row(name, files):
    lines = [count for of_file in files for count in of_file.values()]
    reached = sum(count > 0 for count in lines)
    return f"| {name} | {len(lines)} | {100 * reached / len(lines):.1f} |"


def ranges(lines):
    """"3-5, 9" of 3, 4, 5, 9"""
    groups = []
    for line in sorted(lines):
        if groups and line == groups[-1][1] + 1:
            groups[-1][1] = line
        else:
            groups.append([line, line])
    return ", ".join(f"{a}-{b}" if b > a else str(a) for a, b in groups)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", nargs="?", type=pathlib.Path,
                        default=ROOT / "build-coverage")
    parser.add_argument("--lines", action="store_true")
    options = parser.parse_args()
    files = measured(options.build.resolve())
    folders = collections.defaultdict(list)
    for file, lines in files.items():
        folders[folder(file)].append(lines)
    print("| folder | lines | reached, % |\n|---|---|---|")
    for name in sorted(folders):
        print(row(name, folders[name]))
    print(row("all", files.values()))
    if options.lines:
        for file, lines in sorted(files.items()):
            missed = ranges(line for line, count in lines.items() if count == 0)
            if missed:
                print(f"{file}: {missed}")


if __name__ == "__main__":
    main()
