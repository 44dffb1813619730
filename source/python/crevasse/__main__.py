# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The subcommands of the program that are scripts: python3 -m crevasse NAME ..."""

import importlib
import os
import sys

NAMES = ("sweep", "advise", "life", "bars", "accuracy", "figures", "report", "temperature",
         "mesh", "picture")
MODULES = {"life": "life_command"}  # crevasse.life() is a function
FILE_FAILURE = 4


def main(words):
    if not words or words[0] not in NAMES:
        print(f"python3 -m crevasse {'|'.join(NAMES)} ...", file=sys.stderr)
        return 2
    if os.environ.get("OMPI_COMM_WORLD_RANK", "0") != "0":
        return 0  # of mpirun: the first process does it
    try:
        module = MODULES.get(words[0], words[0])
        command = importlib.import_module(f"crevasse.{module}")
    except ImportError as missing:
        print(f"crevasse {words[0]}: {missing}. It needs Debian's packages "
              "python3-h5py, python3-jinja2, python3-matplotlib, "
              "python3-meshio and python3-scipy, and Debian's own /usr/bin/python3.", file=sys.stderr)
        return FILE_FAILURE
    try:
        status = command.main(words[1:])
    except SystemExit as end:  # of --help
        status = end.code
    except KeyboardInterrupt:
        return 130
    sys.stdout.flush()
    return status


def guarded(words):
    """Runs a subcommand; reports unreadable and unwritable files, except standard
    output."""
    try:
        return main(words)
    except OSError as error:
        what = error.filename or "the standard output"
        # What is left of it must go somewhere when Python ends.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        print(f"crevasse {words[0]}: cannot write to {what} ({error.strerror}).",
              file=sys.stderr)
        return FILE_FAILURE


if __name__ == "__main__":
    sys.stdout.reconfigure(errors="backslashreplace")  # names need not be text
    sys.exit(guarded(sys.argv[1:]))
