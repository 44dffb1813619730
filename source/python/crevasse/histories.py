# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Charts of what a run has over time: probes, lip, stress intensity; and when the lip
is open, partly closed and closed. A chart is what templates/charts.js draws: series,
and views with the values of each."""

import numpy

from crevasse.plotting import BLUE, GREEN, INK, PURPLE, VERMILION

COLOURS = (BLUE, VERMILION, GREEN, PURPLE, INK, "#E69F00")
MOST_ROWS = 2000
BEARS = 1e-6  # pressures below this part of the largest stress are noise
ROUNDING = 1e-9  # values below this part of the largest of their kind are noise


def probe_charts(run, name):
    """Charts of displacement, stress and, on a lip, opening and pressure of a probe."""
    table = run.tables[f"probe_{name}.csv"]
    for kind, prefix, axis in (("displacement", "u_", "u (length)"),
                               ("stress", "s_", "s (stress)"),
                               ("opening", "opening", "u_N − gap (length)"),
                               ("contact pressure", "pressure", "g (stress)")):
        columns = [column for column in table if column.startswith(prefix)
                   and (column != "s_33" or table[column].any())]  # plane stress
        if columns:
            yield chart(run, table, columns, axis, f"{name}: {kind}",
                        noise=ROUNDING * largest(table, kind)) | bands(
                            run, *[f"probe {name} {prefix.rstrip('_')}"] * len(columns))


def bands(run, *names):
    """The error bars of the series of a chart, by their names in summary.json."""
    bars = run.summary.get("bars", {})
    return {"bars": [bars.get(name, {}).get("bar") for name in names]}


def largest(table, kind):
    """Largest value of all displacements (and openings), or of all stresses."""
    first = "u_" if kind in ("displacement", "opening") else "s_"
    return max(abs(values).max() for column, values in table.items()
               if column.startswith(first))


def lip_charts(run):
    """Charts of the force on the lip and of how much of it is closed."""
    table = run.tables["contact.csv"]
    presses = table["largest_pressure"].max() > BEARS * largest_stress(run)
    yield chart(run, table, ["force"],
                "force" if run.dimension == 3 else "force per thickness",
                "Contact force on the lip",
                noise=ROUNDING * table["force"].max() if presses else numpy.inf
                ) | bands(run, "contact force")
    yield chart(run, table, ["closed_nodes"], "closed nodes", "Closed nodes of "
                f"the lip (it has {nodes_of_lip(run)})")


def stress_intensity_charts(run):
    table = run.tables["crack_tip.csv"]
    columns = [column for column in table if column.startswith("K_I")
               and column != "K_I_error"]
    yield chart(run, table, columns, "K (stress × √length)",
                "Stress intensity") | bands(run, "K_I_largest")
    yield chart(run, table, ["energy_release_rate"], "force / length",
                "Energy release rate, both halves")


def mixed_mode_charts(run, name):
    """Charts of K_I, K_II and the growth direction of a tip with two lips."""
    table = run.tables[name]
    kinds = ["K_I", "K_II", "equivalent_intensity"]
    tip = name[len("crack_tip"):-len(".csv")] if "crack_tip_2.csv" in run.tables else ""
    largest_kind = max(abs(table[column]).max() for column in kinds)
    yield chart(run, table, kinds, "K (stress × √length)", "Stress intensity",
                noise=ROUNDING * largest_kind) | bands(run, *(
                    f"{kind}{tip}" for kind in ("K_I_largest", "K_II_largest",
                                                "equivalent_intensity")))
    rests = table["equivalent_intensity"] <= ROUNDING * largest_kind
    if not numpy.isnan(table["growth_angle"]).any():  # known in one isotropic body
        yield chart(run, table | {"growth_angle": numpy.where(
            rests, 0, table["growth_angle"])}, ["growth_angle"],
            "degrees from the crack", "Direction of growth by the largest hoop stress")
    yield chart(run, table, ["energy_release_rate"], "force / length",
                "Energy release rate")


def creep_integral_charts(run, name):
    yield chart(run, run.tables[name], ["C_t"], "C(t) (stress × length / time)",
                "Creep integral C(t)", log=True)


def load_work_charts(run):
    yield chart(run, run.tables["load_work.csv"], ["load_work"], "force × length",
                "Work ∫ loads · u")


def spans_decades(values):
    """Whether positive numbers are so different that a linear axis hides the small."""
    values = numpy.asarray(values)
    return bool(values.size and values.min() > 0 and values.max() > 30 * values.min())


def chart(run, table, columns, axis, title, noise=0, log=False):
    """Chart with the whole run, thinned where it is long, and its last period. Noise is
    drawn as zero. The axis is logarithmic if that is wanted and needed."""
    t = table["t"]
    values = [numpy.where(abs(table[column]) > noise, table[column], 0)
              for column in columns]
    views = {"whole": view(t, values, thin_rows(values))}
    begin = last_period(t, run.period)
    if begin is not None:
        views["last"] = view(t, values, numpy.flatnonzero(
            t >= begin - 1e-6 * run.period))
    return {"kind": "history", "title": title, "y": run.in_units(axis),
            "period": run.period,
            "log": log and spans_decades(values),
            "from_zero": all(numpy.ptp(v) <= 1e-6 * abs(v).max() for v in values),
            "series": [{"label": symbol(column), "colour": colour}
                       for column, colour in zip(columns, COLOURS)],
            "views": views}


def view(t, values, rows):
    return {"t": rounded(t[rows], 9), "values": [rounded(v[rows]) for v in values]}


def rounded(values, digits=6):
    """A number with the digits that can be seen."""
    return [float(f"{value:.{digits}g}") for value in values]


def thin_rows(values):
    """Rows that draw the same curve: the extremes of each of many stretches."""
    rows = len(values[0])
    if rows <= MOST_ROWS:
        return numpy.arange(rows)
    stretches = numpy.array_split(numpy.arange(rows),
                                  MOST_ROWS // (2 * len(values)))
    kept = {0, rows - 1}
    for stretch in stretches:
        for column in values:
            kept |= {stretch[column[stretch].argmin()],
                     stretch[column[stretch].argmax()]}
    return numpy.array(sorted(kept))


def symbol(column):
    """Symbol of a column, such as u_1, with indices below."""
    words = {"K_I_stress": "K_I by the fit to the stress",
             "K_I_singular": "K_I of the singular function",
             "equivalent_intensity": "equivalent K",
             "energy_release_rate": "G", "growth_angle": "angle",
             "C_t": "C(t)", "closed_nodes": "closed nodes", "load_work": "work"}
    kind, _, index = column.partition("_")
    if not index.isdigit():
        return words.get(column, column)
    return kind + index.translate(str.maketrans("123", "₁₂₃"))


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
