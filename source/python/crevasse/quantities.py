# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Quantities that runs are compared in, "stress" or "TABLE/COLUMN", and how their
histories differ in two runs, for sweeps and advice."""

import csv
import dataclasses
import difflib
import math
import re

import numpy

from crevasse.results import ResultsError, read_columns

PROBE = ("u", "s", "u_1", "u_2", "u_3", "s_11", "s_22", "s_33", "s_12", "s_13",
         "s_23", "largest_shear_stress", "opening", "pressure")
TABLES = {"contact": ("force", "largest_pressure", "closed_nodes"),
          "periods": ("stress_change",), "load_work": ("load_work",),
          "crack_tip": ("K_I", "K_I_stress", "K_I_singular", "K_I_error",
                        "energy_release_rate", "strain_energy", "T_stress",
                        "T_stress_error"),
          "crack_tip_N": ("K_I", "K_II", "K_I_error", "K_II_error",
                          "energy_release_rate", "growth_angle",
                          "equivalent_intensity", "T_stress", "T_stress_error",
                          "growth_angle_G", "K_I_singular", "K_II_singular"),
          "creep_integral": ("C_t", "C_t_error"),
          "creep_integral_N": ("C_t", "C_t_error")}
SAME_INSTANT = 1e-9  # of the period
LAST_PERIODS = "last periods, displacements and openings without their mean values"
# What is left of a displacement without its mean value is rounding below this part.
ROUNDING = 1e-12


def kind(table):
    """The kind of a table: crack_tip_N for the table of each tip between two lips."""
    return re.sub(r"^(crack_tip|creep_integral)_[1-9]\d*$", r"\1_N", table)


def has_two_lips(scene):
    return scene["Boundary/Crack"] not in ("", "none", "automatic")


def has_crack(scene):
    """Whether a scene has a crack, with or without contact."""
    shape = scene["Geometry/Shape"]
    return "crack" in shape or shape == "mesh file" and (
        has_lip(scene) or scene["Boundary/Open crack"] not in ("", "none", "automatic"))


def has_lip(scene):
    """Whether a scene has a lip: of a built-in crack, or on named boundaries."""
    if has_two_lips(scene):
        return True
    contact = scene["Boundary/Contact"]
    if contact == "automatic":
        return "crack" in scene["Geometry/Shape"]
    return contact not in ("", "none")


def selects(column, other):
    """Whether a column belongs to a quantity: "u" and "s" of a probe stand for all
    displacements and all stresses."""
    return other == column or column in ("u", "s") and other.startswith(column + "_")


def did_you_mean(word, words):
    near = difflib.get_close_matches(word, words, 1)
    return f"; did you mean \"{near[0]}\"?" if near else ""


def common_instants(one, other, period):
    """Rows of two ascending lists with the same t, and why a comparison at these
    says nothing: at rest all runs agree, and a few instants at which the load is zero
    may be all that adaptive steps have in common with others."""
    tolerance = SAME_INSTANT * period
    one, other = numpy.asarray(one), numpy.asarray(other)
    near = numpy.searchsorted(other, one - tolerance)
    common = numpy.flatnonzero(numpy.append(other, numpy.inf)[near] - one <= tolerance)
    rows = list(zip(common, near[common]))
    fewer = min(len(one), len(other))
    objection = ""
    if not rows or one[rows[-1][0]] <= tolerance:
        objection = "only the instant t = 0 is common with the reference"
    # One of four, or ten a period.
    elif 4 * len(rows) < fewer and len(rows) < 10 * one[rows[-1][0]] / period:
        objection = (f"only {len(rows)} of {fewer} instants are common with the "
                     "reference: use multiples of the number of steps, or name "
                     "instants in [Time integration] Steps")
    return rows, objection


def is_periodic(scene):
    """Whether a scene looks for its periodic state. The periods before the last are then
    steps of a search, and how many there are depends on the method."""
    return (float(scene["Periodic state/Tolerance"]) > 0
            or scene["Periodic state/Method"] != "march")


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
        try:
            self.columns = read_columns(text)
        except (ValueError, csv.Error) as error:
            raise ResultsError(f"{path}: {error}.") from None
        if not {"t", "t_end"} & set(self.columns):
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
