# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Runs scenes of Crevasse and reads their results: doc/python.md."""

__all__ = ["CommandError", "Life", "Results", "ResultsError", "life", "read", "run"]


def __getattr__(name):
    """Imports scripting when a name of it is used: the subcommands import this package
    as well, and report themselves which of Debian's packages are missing."""
    if name not in __all__:
        raise AttributeError(f"module crevasse has no attribute {name}")
    from crevasse import scripting
    return getattr(scripting, name)


def __dir__():
    return __all__
