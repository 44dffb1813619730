# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Makes report.html of the results of a run or of a sweep: one file with the
scene in words, the paper's figures, histories, convergence, costs, and above
all how the run ended. Exit status: 0 done, 2 there is nothing to report on, 4 a
file is damaged (the report is made of the others) or cannot be written."""

import argparse
import pathlib
import sys

from crevasse import life_output, run_page, sweep_page
from crevasse.results import ResultsError


def arguments(words):
    parser = argparse.ArgumentParser(prog="crevasse report", description=__doc__)
    parser.add_argument("results", metavar="RESULTS_DIR", type=pathlib.Path,
                        help="output directory of crevasse or crevasse sweep")
    parser.add_argument("--output", type=pathlib.Path, metavar="FILE",
                        help="(report.html in RESULTS_DIR)")
    return parser.parse_args(words)


def page_of(directory):
    """The page, its first numbers as lines, and notes for the command line about the
    results and about damaged files."""
    if not directory.is_dir():
        raise ResultsError(f"{directory}: no such directory. Give the output "
                           "directory of crevasse or of crevasse sweep.")
    if (directory / "sweep.csv").is_file():
        return sweep_page.page(directory)
    if (directory / "life.csv").is_file():
        return life_output.page(directory)
    if (directory / "used.prm").is_file():
        return run_page.page(directory)
    if (directory / "sweep.log").is_file():
        raise ResultsError(f"{directory}: no point of this sweep is done yet (there is "
                           "no sweep.csv).")
    if (directory / "summary.json").is_file():
        raise ResultsError(f"{directory}: used.prm, which describes the scene, is "
                           "missing.")
    if (directory / "advice.json").is_file():
        raise ResultsError(f"{directory}: this is an output directory of crevasse "
                           "advise; read its advice.md, or give one of the runs in "
                           f"{directory}/runs.")
    if not any(directory.iterdir()):
        raise ResultsError(f"{directory}: the directory is empty.")
    raise ResultsError(f"{directory}: this is not the output directory of a run (there "
                       "is no used.prm) nor of a sweep (no sweep.csv).")


def write(path, text):
    """Writes the page; names of directories need not be UTF-8."""
    try:
        path.write_bytes(text.encode("utf-8", errors="replace"))
    except OSError as error:
        raise OSError(f"{path}: {error.strerror}. --output FILE writes the report "
                      "elsewhere.") from None


def main(words):
    options = arguments(words)
    output = options.output or options.results / "report.html"
    try:
        text, headline, notes, damages = page_of(options.results)
        write(output, text)
    except ResultsError as error:
        print(f"crevasse report: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"crevasse report: {error}", file=sys.stderr)
        return 4
    print(*headline, output, sep="\n")
    for note in notes:
        print(f"crevasse report: {options.results}: {note}", file=sys.stderr)
    if damages:
        print(f"crevasse report: {options.results}: damaged, and not in the report: "
              f"{' '.join(damages)}", file=sys.stderr)
        return 4
    return 0
