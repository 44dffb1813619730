# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Errors of a sweep against their costs, one line for each combination of the
parameters that are not followed along a line."""

from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from crevasse.plotting import BLUE, GREEN, GREY, INK, VERMILION, ladder, pyplot
from crevasse.results import ResultsError, number
from crevasse.sweep_table import (COSTS, first_of_size, lines_of, parameters,
                                  quantities, read_rows)

MARKERS = "osD^vPX*"


def drawings(options):
    """(file name, figure)."""
    rows = read_rows(options.results)
    names = quantities(rows)
    if not names:
        raise ResultsError(f"{options.results}: the sweep has measured no errors.")
    quantity = (choose(options.quantity, names, "quantity") if options.quantity
                else first_of_size(rows, names))
    print(f"errors of {quantity}; --quantity takes another of {', '.join(names)}")
    along = options.along and choose(options.along, parameters(rows), "parameter")
    yield "work_precision", draw(rows, options.x, quantity, along)


def choose(wanted, available, what):
    """The one whose name, or the end of it, is wanted."""
    for name in available:
        if wanted in (name, name.split("/")[-1]):
            return name
    raise ResultsError(f"There is no {what} {wanted}. There are: "
                       f"{', '.join(available) or 'none'}.")


def draw(rows, cost, quantity, along=None):
    along, others, followed = lines_of(rows, along)
    figure, axes = pyplot.subplots(figsize=(5.6, 4.0), constrained_layout=True)
    drawn = 0
    for i, (label, members) in enumerate(followed):
        points = [(number(row[cost]), number(row["error:" + quantity]), row[along])
                  for row in members]
        points = [point for point in points if point[0] and point[1]]
        if not points:
            print(f"{label or 'the points'}: nothing to draw")
            continue
        colour = (BLUE, VERMILION, GREEN, INK, GREY)[i % 5]
        axes.loglog(*zip(*[point[:2] for point in points]), label=label,
                    color=colour, marker=MARKERS[i % len(MARKERS)], markersize=4.5)
        for x, y, value in points:
            axes.annotate(value, (x, y), xytext=(4, 4), fontsize=6.5, color=colour,
                          textcoords="offset points")
        drawn += len(points)
    if not drawn:
        raise ResultsError(f"No point has an error of {quantity} and {COSTS[cost]}; "
                           "--x and --quantity choose others.")
    axes.set(xlabel=COSTS[cost], ylabel=f"relative error of {quantity}")
    axes.set_title(f"numbers: {along.split('/')[-1]}", fontsize=8, loc="right",
                   color=GREY)
    axes.grid(True, which="major", alpha=0.25, linewidth=0.6)
    name_costs(axes)
    if others:
        axes.legend()
    return figure


def name_costs(axes):
    """Costs without powers of ten: 1, 2, 5, 10, ..."""
    low, high = axes.get_xlim()
    mantissas = ((1,) if high > 1e4 * low else
                 (1, 2, 5) if high > 10 * low else (1, 1.5, 2, 3, 4, 5, 7))
    axes.xaxis.set_major_locator(FixedLocator(ladder(low, high, mantissas)))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:.10g}"))
