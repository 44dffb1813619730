# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The quantities of a run that have error bars, and how they differ between two runs:
histories at all common instants of the last period, never extremes with extremes, which
are samples."""

import collections
import pathlib

import numpy

from crevasse import findings
from crevasse.quantities import Table, common_instants
from crevasse.results import number, probes_of
from crevasse.run_reader import ROW_A_STEP, Run

# A quantity of one number or history: columns of a table (all components of a tensor
# together), or else a finding of the summary.
BEARS = 1e-9  # of the largest force, or of the period: less is rounding
STEEP = 4.  # exponent of growth that is not one number
Quantity = collections.namedtuple("Quantity", "name, table, columns, of, probe")
FINDINGS = ("K_I_largest", "K_I_smallest", "K_II_largest", "K_II_smallest",
            "K_III_largest", "K_III_smallest", "Delta_K", "K_opening", "Delta_K_eff",
            "equivalent_intensity", "energy_release_rate", "T_stress_largest",
            "T_stress_smallest", "growth_angle", "C_t_largest", "C_t_last", "C_star",
            "C_star_largest", "C_star_smallest", "da_dN", "da_dN_fatigue", "da_dN_creep",
            "opening", "closed_part", "drift")


class Histories:
    """The tables of the last period of a run, and the findings of its summary."""

    def __init__(self, folder, period):
        self.folder, self.period = pathlib.Path(folder), period
        self.findings, self.summary = findings.read(folder), Run(folder).summary
        self.tables = {}

    def table(self, name):
        """Table with time from the beginning of the last period; None if missing."""
        if name not in self.tables:
            path = self.folder / f"{name}.csv"
            table = Table(path) if path.exists() else None
            if table and len(table.t):
                table.keep_last_period(self.period)
                table.begin_at_zero()
            self.tables[name] = table
        return self.tables[name]

    def instants(self):
        """Ends of the steps of the last period; none without a history."""
        tables = (self.table(path.stem) for path in self.folder.glob("*.csv")
                  if path.name.startswith(ROW_A_STEP))
        t = next((table.t for table in tables if table), numpy.zeros(0))
        return [float(at) for at in t[numpy.diff(t, prepend=-1.) > BEARS * self.period]]

    def values(self, quantity):
        """Rows of the columns of a quantity; None without history."""
        table = quantity.table and self.table(quantity.table)
        if not table:
            return None
        return numpy.array([table.columns[name] for name in quantity.columns
                            if name in table.columns])


def quantities_of(scene, run):
    """Quantities of a run, of which the histories are given."""
    found = [Quantity(column, None, (), findings.split(column)[0], None)
             for column in run.findings if findings.split(column)[0] in FINDINGS]
    if run.table("contact"):
        found.append(Quantity("contact force", "contact", ("force",), "force", None))
    for probe, point in probes_of(scene).items():
        table = run.table(f"probe_{probe}")
        columns = list(table.columns) if table else ()
        for kind in ("u", "s", "opening", "pressure"):
            chosen = [name for name in columns
                      if name == kind or name.startswith(kind + "_")]
            if chosen:
                found.append(Quantity(f"probe {probe} {kind}", f"probe_{probe}",
                                      tuple(chosen), kind, point))
    return found


def difference(quantity, one, other):
    """The largest difference of a quantity of two runs, or None and why there is none."""
    mine, theirs = one.values(quantity), other.values(quantity)
    if quantity.name in one.findings:
        # Errors of both K in Delta_K_eff may cancel.
        both = {quantity.name.replace("Delta_K_eff", name)
                for name in ("K_I_largest", "K_opening")}
        found = [sum(abs(one.findings[name] - other.findings[name]) for name in names)
                 for names in ({quantity.name}, both)
                 if names <= one.findings.keys() & other.findings.keys()]
        return (max(found), "") if found else (None, "a companion run does not have it")
    if mine is None or theirs is None or mine.shape[0] != theirs.shape[0]:
        return None, "a companion run does not have it"
    rows, objection = common_instants(one.table(quantity.table).t,
                                      other.table(quantity.table).t, one.period)
    if objection:
        return None, objection
    i, j = numpy.array(rows).T
    return max(abs(mine[:, i] - theirs[:, j]).max(),
               abs(largest(quantity, one) - largest(quantity, other))), ""


def mode_two_of_closed_tip(quantity, run):
    """K_II at an extreme of K_I at which the lips of a crack with two lips press."""
    tip, contact = table_of_tip(quantity, run), run.table("contact")
    if (quantity.of not in ("K_I_largest", "K_I_smallest") or not contact or not tip
            or "K_II" not in tip.columns):
        return 0.
    k = tip.columns["K_I"]
    at = k.argmin() if quantity.of == "K_I_smallest" else k.argmax()
    force = contact.columns["force"]
    presses = numpy.interp(tip.t[at], contact.t, force) > BEARS * force.max()
    return presses * abs(float(tip.columns["K_II"][at]))


def error_of_tip(quantity, run, scene):
    """The error that the run itself estimates, of K and of what K determines; 0 of
    others. It is that of the instant, and does not vanish with K."""
    change, tip = with_intensity(quantity, run, scene), table_of_tip(quantity, run)
    if not change:
        return 0.
    sizes = numpy.hypot(tip.columns["K_I"], tip.columns.get("K_II", 0.))
    name = "K_II" if quantity.of.startswith("K_II_") else "K_I"
    row = (abs(tip.columns[name] - largest(quantity, run)).argmin()
           if quantity.of.startswith("K_") else sizes.argmax())
    return change * tip.columns["K_I_error"][row] / sizes.max()


def with_intensity(quantity, run, scene):
    """By how much a quantity changes for each relative change of K: by the largest K of
    its tip, by 2 G, by da/dN times the exponent of its law; 0 if K does not matter."""
    size = largest_intensity(quantity, run)
    if "K" in quantity.of or quantity.of == "equivalent_intensity" or not size:
        return size
    exponents = [number(scene[f"Crack tip/{kind} exponent"]) or STEEP
                 for kind in ("Paris", "Creep")]
    power = (2. if quantity.of == "energy_release_rate" else
             max(exponents) if quantity.of.startswith("da_dN") else 0.)
    return power * abs(largest(quantity, run))


def largest_intensity(quantity, run):
    """The largest K of both modes at the tip of a quantity."""
    tip = table_of_tip(quantity, run)
    return float(numpy.hypot(tip.columns["K_I"], tip.columns.get("K_II", 0.)).max()
                 ) if tip else 0.


def table_of_tip(quantity, run):
    return (run.table(f"crack_tip_{findings.split(quantity.name)[1] or 1}")
            or run.table("crack_tip"))


def largest(quantity, run):
    """Value that a bar is for: of a history the largest magnitude, between its samples,
    too."""
    if quantity.name in run.findings:
        return run.findings[quantity.name]
    if quantity.of == "force":
        return run.summary["extremes"]["contact_force"]
    extremes = run.summary["probes"][quantity.table.removeprefix("probe_")]
    return max(abs(value) for column in quantity.columns
               for value in extremes[column].values())
