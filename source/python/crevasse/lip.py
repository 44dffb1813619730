# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""When the lip of a run is open, partly closed and closed."""

import numpy

BEARS = 1e-6  # pressures below this part of the largest stress are noise


def last_period(t, period):
    """Begin of the last period, one period before the end: a run that was stopped may
    have ended within a period. None where that is nearly the whole run."""
    if t[-1] - t[0] < 1.5 * period:
        return None
    return t[-1] - period


def nodes_of_lip(run):
    return run.summary.get("contact_nodes") or int(
        run.tables["contact.csv"]["closed_nodes"].max())


def lip_intervals(run):
    """[begin, end, state] of "closed" and "partly closed" stretches of time;
    between them the lip is open. A node that touches without pressing is open:
    so the lip is at rest."""
    table = run.tables.get("contact.csv")
    if table is None:
        return []
    presses = table["largest_pressure"] > BEARS * largest_stress(run)
    closed = table["closed_nodes"] >= nodes_of_lip(run)
    states = numpy.where(presses, numpy.where(closed, 2, 1), 0)
    t = table["t"]
    middle = numpy.concatenate([t[:1], (t[1:] + t[:-1]) / 2, t[-1:]])
    changes = numpy.flatnonzero(numpy.diff(states)) + 1
    ends = [0, *changes, len(t)]
    return [[float(middle[a]), float(middle[b]), int(states[a])]
            for a, b in zip(ends[:-1], ends[1:]) if states[a]]


def largest_stress(run):
    """Largest stress of the run: much smaller pressures are noise."""
    sizes = [run.summary_number("extremes", "stress") or 0,
             abs(run.tables["contact.csv"]["largest_pressure"]).max()]
    for name, table in run.tables.items():
        if name.startswith("probe_"):
            sizes += [abs(values).max() for column, values in table.items()
                      if column.startswith("s_")]
    return max(sizes)
