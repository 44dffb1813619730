# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""What the studies of this folder share: the package that reads and draws results,
command lines, tables."""

import argparse
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True  # leaves nothing behind in the source tree
sys.path.insert(1, str(ROOT / "source/python"))


def existing_program(text):
    """The program on a study's command line."""
    path = pathlib.Path(text)
    if not (path.is_file() and os.access(path, os.X_OK)):
        raise argparse.ArgumentTypeError(
            f"{text} is no program. cmake --build build makes build/crevasse.")
    return path


def print_table(header, rows):
    """In Markdown; a study may take long, so that what there is shows."""
    print("| " + " | ".join(header) + " |")
    print("|" + "---|" * len(header))
    for row in rows:
        print("| " + " | ".join(row) + " |")
    print(flush=True)


def run_once(options, scene, name=None, settings=()):
    """The results of a scene of prm/ with these settings; a run that is done is not
    done again."""
    results = options.output / (name or scene)
    if not (results / "summary.json").exists():
        changes = [word for setting in settings for word in ("--set", setting)]
        subprocess.run([options.program, "--quiet", "--force",
                        ROOT / f"prm/{scene}.prm", "--output", results, *changes],
                       check=True)
    return results


def study_options(description, name, kept="runs are", studies=None):
    """What the command line of a study says: the program, which of several
    studies, where what it computes is kept, where its figures go and in which
    formats."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("program", type=existing_program, help="build/crevasse")
    if studies:
        parser.add_argument("--studies", nargs="+", choices=list(studies),
                            default=list(studies),
                            help="which ones (all)")
    parser.add_argument("--output", type=pathlib.Path,
                        default=pathlib.Path("results") / name,
                        help=f"where the {kept} kept")
    parser.add_argument("--figures", type=pathlib.Path,
                        default=pathlib.Path(__file__).resolve().parent,
                        help="where the figures go")
    parser.add_argument("--formats", nargs="+", default=["png"],
                        choices=("png", "pdf", "svg"))
    return parser.parse_args()
