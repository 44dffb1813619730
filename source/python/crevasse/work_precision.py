# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Errors of a sweep against their costs, one line for each combination of the
parameters that are not followed along a line."""

from crevasse.plotting import (GREY, add_legend, line_style, name_numbers,
                               pyplot)
from crevasse.results import ResultsError, number
from crevasse.sweep_table import COSTS, lines_of


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
        style = line_style(i)
        axes.loglog(*zip(*[point[:2] for point in points]), label=label, **style)
        for x, y, value in points:
            axes.annotate(value, (x, y), xytext=(4, 4), fontsize=6.5,
                          color=style["color"], textcoords="offset points")
        drawn += len(points)
    if not drawn:
        raise ResultsError(f"No point has an error of {quantity} and {COSTS[cost]}; "
                           "--x and --quantity choose others.")
    axes.set(xlabel=COSTS[cost], ylabel=f"relative error of {quantity}")
    axes.set_title(f"numbers: {along.split('/')[-1]}", fontsize=8, loc="right",
                   color=GREY)
    axes.grid(True, which="major", alpha=0.25, linewidth=0.6)
    name_numbers(axes)
    if others:
        add_legend(axes)
    return figure
