# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""How the histories of two runs differ, for sweeps and advice."""

import csv
import dataclasses
import math

import numpy

from crevasse.quantities import SAME_INSTANT, common_instants, selects
from crevasse.results import ResultsError

LAST_PERIODS = "last periods, displacements and openings without their mean values"
# What is left of a displacement without its mean value is rounding below this part.
ROUNDING = 1e-12


def is_periodic(scene):
    """Whether a scene looks for its periodic state. The periods before the last are then
    steps of a search, and how many there are depends on the method."""
    return (float(scene["Periodic state/Tolerance"]) > 0
            or scene["Periodic state/Method"] != "march"
            or scene["Periodic state/Start from"] != "rest")


def depends_on_constant(table):
    """Whether a table of a periodic state cannot be compared: the work of the loads
    contains the additive constant of the displacement at varying loads."""
    return table == "load_work"


class Table:
    """A table that a run has written; its columns by name."""

    def __init__(self, path):
        try:
            text = path.read_text(encoding="utf-8")
        except (OSError, ValueError):
            raise ResultsError(f"Cannot read {path}.") from None
        if not text.endswith("\n"):
            raise ResultsError(f"{path}: the last line is not complete.")
        header, *rows = csv.reader(text.splitlines())
        for row in rows:
            if len(row) != len(header):
                raise ResultsError(f"{path}: a row has {len(row)} entries instead of "
                                   f"{len(header)}.")
        try:
            values = numpy.array(rows, dtype=float).reshape(-1, len(header))
        except ValueError as error:
            raise ResultsError(f"{path}: {error}.") from None
        self.columns = dict(zip(header, values.T))
        if not {"t", "t_end"} & set(header):
            raise ResultsError(f"{path}: there is no column t.")

    @property
    def t(self):
        """The end of a period in periods.csv, which is left as it is."""
        return self.columns.get("t", self.columns.get("t_end"))

    def keep_last_period(self, period):
        if "t" in self.columns and len(self.t):
            last = self.t >= self.t[-1] - (1 + SAME_INSTANT) * period
            self.columns = {name: values[last]
                            for name, values in self.columns.items()}

    def begin_at_zero(self):
        if "t" in self.columns and len(self.t):
            self.columns["t"] = self.t - self.t[0]


def without_means(names, values):
    """Rows of values, those of displacements without their mean value: the periodic
    problem leaves an additive constant of the displacement free, and a secular flow
    moves it from period to period."""
    free = [name.startswith("u_") or name == "opening" for name in names]
    rows, moved = values[free], values.copy()
    rest = rows - rows.mean(axis=1, keepdims=True)
    rest[abs(rest) <= ROUNDING * abs(rows).max(axis=1, keepdims=True)] = 0.
    moved[free] = rest
    return moved


@dataclasses.dataclass
class Comparison:
    """Difference of a quantity between two runs, or why they cannot be compared."""
    difference: float = math.inf  # largest at the common instants
    size: float = math.nan  # largest value of the reference
    instants: int = 0
    objection: str = ""  # why the difference is unknown


def compare(column, mine, theirs, period, periodic):
    """Compares a quantity of two tables, which have the last period if periodic."""
    names = [name for name in theirs.columns
             if selects(column, name) and name in mine.columns]
    if not names:
        return Comparison(objection="the runs have no such column")
    rows, objection = common_instants(mine.t, theirs.t, period)
    if objection:
        return Comparison(instants=len(rows), objection=objection)
    i, j = numpy.array(rows).T
    one = numpy.array([mine.columns[name] for name in names])[:, i]
    whole = numpy.array([theirs.columns[name] for name in names])
    other = whole[:, j]
    if periodic:
        one, other, whole = (without_means(names, values)
                             for values in (one, other, whole))
    return Comparison(abs(one - other).max(), abs(whole).max(), len(rows))
