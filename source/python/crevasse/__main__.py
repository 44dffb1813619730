# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The subcommands of the program that are scripts: python3 -m crevasse NAME ..."""

import importlib
import os
import sys

NAMES = ("sweep", "advise", "figures", "report", "temperature")
FILE_FAILURE = 4


def main(words):
    if not words or words[0] not in NAMES:
        print(f"python3 -m crevasse {'|'.join(NAMES)} ...", file=sys.stderr)
        return 2
    if os.environ.get("OMPI_COMM_WORLD_RANK", "0") != "0":
        return 0  # of mpirun: the first process does it
    try:
        command = importlib.import_module(f"crevasse.{words[0]}")
    except ImportError as missing:
        print(f"crevasse {words[0]}: {missing}. It needs Debian's packages "
              "python3-h5py, python3-jinja2, python3-matplotlib and "
              "python3-meshio, and Debian's own /usr/bin/python3.", file=sys.stderr)
        return FILE_FAILURE
    try:
        return command.main(words[1:])
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    sys.stdout.reconfigure(errors="backslashreplace")  # names need not be text
    sys.exit(main(sys.argv[1:]))
