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
from crevasse.results import probes_of

# A quantity of one number or history: columns of a table (all components of a tensor
# together), or else a finding of the summary. An extreme is that of a sampled history.
Quantity = collections.namedtuple("Quantity", "name, table, columns, of, probe")
OF_HISTORIES = {"K_I_largest": "K_I", "K_I_smallest": "K_I", "K_II_largest": "K_II",
                "K_II_smallest": "K_II", "Delta_K": "K_I", "T_stress_largest": "T_stress",
                "T_stress_smallest": "T_stress",
                "equivalent_intensity": "equivalent_intensity",
                "energy_release_rate": "energy_release_rate", "C_t_largest": "C_t",
                "C_t_last": "C_t"}
EXTREMES = set(OF_HISTORIES) - {"Delta_K"} | {"largest opening"}
AS_THEY_ARE = ("K_opening", "Delta_K_eff", "C_star", "da_dN", "da_dN_fatigue",
               "da_dN_creep", "opening", "closed_part", "growth_angle", "drift")


class Histories:
    """The tables of the last period of a run, and the findings of its summary."""

    def __init__(self, folder, period):
        self.folder, self.period = pathlib.Path(folder), period
        self.findings = findings.read(folder)
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

    def values(self, quantity):
        """Rows of the columns of a quantity; None without history."""
        table = quantity.table and self.table(quantity.table)
        if not table:
            return None
        return numpy.array([table.columns[name] for name in quantity.columns
                            if name in table.columns])


def quantities_of(scene, run):
    """Quantities of a run, of which the histories are given."""
    found = []
    for column, _ in run.findings.items():
        name, tip = findings.split(column)
        if name in OF_HISTORIES:
            kind = "creep_integral" if name.startswith("C_t") else "crack_tip"
            table = next((table for table in (f"{kind}_{tip or 1}", kind)
                          if run.table(table)), None)
            found.append(Quantity(column, table, (OF_HISTORIES[name],), name, None))
        elif name == "opening" and (table := table_of_opening(run, scene)):
            found.append(Quantity(column, table, ("opening",), "largest opening", None))
        elif name in AS_THEY_ARE:
            found.append(Quantity(column, None, (), name, None))
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


def table_of_opening(run, scene):
    """The probe at which the lip opens most, if there is one."""
    return next((f"probe_{probe}" for probe in probes_of(scene)
                 if (table := run.table(f"probe_{probe}")) and "opening" in table.columns
                 and is_sampled(table.columns["opening"].max(), run.findings["opening"])),
                None)


def is_sampled(extreme, value):
    return abs(extreme - value) <= 1e-9 * abs(value)


def difference(quantity, one, other):
    """The largest difference of a quantity of two runs, or None and why there is none."""
    mine, theirs = one.values(quantity), other.values(quantity)
    if quantity.table is None:
        if not {quantity.name} <= one.findings.keys() & other.findings.keys():
            return None, "a companion run does not have it"
        return abs(one.findings[quantity.name] - other.findings[quantity.name]), ""
    if mine is None or theirs is None or mine.shape[0] != theirs.shape[0]:
        return None, "a companion run does not have it"
    rows, objection = common_instants(one.table(quantity.table).t,
                                      other.table(quantity.table).t, one.period)
    if objection:
        return None, objection
    i, j = numpy.array(rows).T
    found = mine[:, i] - theirs[:, j]
    if quantity.of in EXTREMES:
        if is_located(quantity, one) and is_located(quantity, other):
            return abs(one.findings[quantity.name] - other.findings[quantity.name]), ""
        near = near_extreme(quantity.of, mine[0][i], one.table(quantity.table).t[i],
                            one.period)
        return abs(found[0][near]).max(), ""
    if quantity.of == "Delta_K":  # K < 0 counts as 0
        k = mine[0][i]
        return abs(found[0][k.argmax()] - (found[0][k.argmin()] if k.min() > 0. else 0.)), ""
    return abs(found).max(), ""


def is_located(quantity, run):
    """Whether an extreme is none of the samples, but at a closure of the lip, whose
    instant the program has found."""
    values, value = run.values(quantity)[0], run.findings.get(quantity.name)
    return value is not None and not any(
        is_sampled(sample, value) for sample in (values.min(), values.max(), values[-1]))


def mode_two_of_closed_tip(quantity, run):
    """K_II at an extreme of K_I at which the lips of a crack with two lips press."""
    tip, contact = run.table(quantity.table or ""), run.table("contact")
    if (quantity.of not in ("K_I_largest", "K_I_smallest") or not contact or not tip
            or "K_II" not in tip.columns):
        return 0.
    k = tip.columns["K_I"]
    at = k.argmin() if quantity.of == "K_I_smallest" else k.argmax()
    presses = numpy.interp(tip.t[at], contact.t, contact.columns["force"]) > 0.
    return presses * abs(float(tip.columns["K_II"][at]))


def near_extreme(name, values, t, period):
    """The instants within an eighth of a period from that of an extreme: elsewhere a
    history's error, as at a closure of the lip, is none of the extreme."""
    if name == "C_t_last":
        return t >= t[-1]
    k = values.argmin() if name.endswith("smallest") else values.argmax()
    return abs(t - t[k]) <= period / 8.


def largest(quantity, run):
    """Value that a bar is for: of a history the largest magnitude."""
    if quantity.name in run.findings:
        return run.findings[quantity.name]
    return float(abs(run.values(quantity)).max(initial=0.))


def missed_by_samples(quantity, run, events_are_located):
    """How much higher the parabola through equal steps rises above the sample at an
    extreme; of a peak of a single sample half of what it rises above its neighbours.
    Other steps end where the loads have corners."""
    values = run.values(quantity)
    if values is None or quantity.of in EXTREMES and is_located(quantity, run):
        return 0.
    if quantity.of in EXTREMES or quantity.of == "Delta_K":
        y = values[0] * (-1. if quantity.of.endswith("smallest") else 1.)
    else:
        y = abs(values[numpy.unravel_index(abs(values).argmax(), values.shape)[0]])
    k, t = int(y.argmax()), run.table(quantity.table).t
    if not 0 < k < len(y) - 1 or abs(t[k + 1] + t[k - 1] - 2 * t[k]) > 1e-6 * run.period:
        return 0.
    fall, rise = y[k] - y[k - 1], y[k] - y[k + 1]
    if min(fall, rise) > y[k] / 2. and not events_are_located:
        return float(min(fall, rise)) / 2.
    return float((fall - rise) ** 2 / (8. * (fall + rise))) if fall + rise > 0. else 0.
