# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The quantities of an advice, and how they differ between two runs."""

import math

import numpy

from crevasse.command import CommandError
from crevasse.quantities import TABLES as ALL_TABLES
from crevasse.quantities import (PROBE, Comparison, Table, compare, depends_on_constant,
                                 did_you_mean, has_lip, is_periodic, kind)

# These differ from mesh to mesh.
OF_MESH = ("stress", "periods/stress_change", "contact/closed_nodes",
           "crack_tip/K_I_error", "crack_tip_N/K_I_error", "crack_tip_N/K_II_error")
TABLES = {table: columns for table, names in ALL_TABLES.items()
          if (columns := [name for name in names if f"{table}/{name}" not in OF_MESH])}
# A stress or displacement that is so much smaller than at the other probes is zero
# except for rounding.
VANISHES = 1e-9


def choose_quantities(text, scene, probes):
    """Quantities to compare: the list of --quantities, or u and s of every probe."""
    if scene["Periodic state/Maximum periods"] == "0":
        raise CommandError("[Periodic state] Maximum periods = 0: the scene computes "
                           "no period, so that no history has an error. Set it to at "
                           "least 1.", 2)
    if text is None:
        if not probes:
            raise CommandError(
                "the scene has no probes, so that no history has an error. Name the "
                "points whose displacement and stress matter, as in --set "
                "\"Output/Probes=mouth: 1, 0\", or other quantities, as in "
                "--quantities contact/force.", 2)
        return [f"probe_{name}/{kind}" for name in probes for kind in "us"]
    names = list(dict.fromkeys(map(str.strip, text.split(","))))
    tables = {f"probe_{probe}": PROBE for probe in probes} | TABLES
    problems = [f"--quantities {name}: {problem}" for name in names
                if (problem := problem_of(name, scene, tables))]
    if problems:
        raise CommandError("\n".join(problems), 2)
    return names


def problem_of(name, scene, tables):
    """Why the scene does not write a quantity; None if it does."""
    if name in OF_MESH:
        return ("differs from mesh to mesh. Take columns of probes, contact, "
                "crack_tip or load_work.")
    table, slash, column = name.partition("/")
    if kind(table) not in tables or not slash:
        return ("is not a quantity; allowed is TABLE/COLUMN with a table of: "
                + ", ".join(tables) + (did_you_mean(table, tables) or "."))
    if column not in (columns := tables[kind(table)]):
        return f"there is no such column; columns are: {', '.join(columns)}."
    if table == "contact" and not has_lip(scene):
        return "the scene has no contact."
    if table.startswith("crack_tip") and (
            scene["Crack tip/Stress intensity"] == "false" or not has_lip(scene)):
        return "set [Crack tip] Stress intensity = true."
    if depends_on_constant(table) and is_periodic(scene):
        return ("depends on the additive constant of the displacement, which a "
                "periodic state does not determine. Use probes.")
    if table == "load_work" and scene["Output/Load work"] != "true":
        return "set [Output] Load work = true."
    return None


class Errors:
    """Relative differences between runs by quantity. Quantities can be left out."""

    def __init__(self, runs, scene, quantities):
        self.runs, self.quantities = runs, quantities
        self.period = float(scene["Loads/Period"])
        self.periodic = is_periodic(scene)
        self.left_out = set()
        self.known, self.tables = {}, {}

    def counting(self):
        return [name for name in self.quantities if name not in self.left_out]

    def difference(self, one, reference):
        """The largest relative difference of all quantities that are not left out."""
        differences = self.differences(one, reference)
        return max((differences[name] for name in self.counting()), default=0.)

    def differences(self, one, reference):
        """{quantity: relative difference}: infinite if unknown, 0 for quantities that
        vanish in the reference."""
        key = one.name, reference.name
        if key not in self.known:
            found = {name: self.compare(name, one, reference)
                     for name in self.quantities}
            largest = {}
            for name, of in found.items():
                column = name.split("/")[1]
                largest[column] = numpy.fmax(largest.get(column, 0.), of.size)
            self.known[key] = {
                name: math.inf if not math.isfinite(of.difference + of.size) else
                0. if of.size <= VANISHES * largest[name.split("/")[1]] else
                of.difference / of.size for name, of in found.items()}
        return self.known[key]

    def compare(self, quantity, one, reference):
        table, column = quantity.split("/")
        mine, theirs = self.table(one, table), self.table(reference, table)
        if mine is None or theirs is None:
            return Comparison(objection="a run has no such table")
        return compare(column, mine, theirs, self.period, self.periodic)

    def table(self, run, name):
        """Columns of a run's table at the instants compared; None without the table."""
        key = run.name, name
        if key not in self.tables:
            path = self.runs.folder(run) / f"{name}.csv"
            table = Table(path) if path.is_file() else None
            if self.periodic and table:
                table.keep_last_period(self.period)
                table.begin_at_zero()
            self.tables[key] = table
        return self.tables[key]

    def require_histories(self, run):
        """Raises CommandError if a quantity is missing, or all are zero."""
        found = {name: self.compare(name, run, run) for name in self.quantities}
        for name, of in found.items():
            if of.objection:
                raise CommandError(
                    f"--quantities {name}: the scene does not write it. Probes have "
                    "u_3 and its stresses in three dimensions only, and opening and "
                    "pressure on a lip only.", 2)
        if not any(of.size for of in found.values()):
            raise CommandError(f"{run.name}: all compared quantities are 0 at all "
                               "instants, so that they have no relative error. Load "
                               "the body, or move the probes.", 3)
