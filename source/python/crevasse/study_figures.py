# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The results of a sweep against what varies, a figure for each, one line for each
combination of the parameters that are not followed along a line."""

from crevasse import sweep_table
from crevasse.histories import spans_decades
from crevasse.plotting import add_legend, line_style, name_numbers, pyplot


def draw(rows, name, numbers, along=None):
    """Draws a figure of the numbers of the points."""
    along, others, lines = sweep_table.lines_of(rows, along)
    numeric = sweep_table.is_numeric(rows, along)
    figure, axes = pyplot.subplots(figsize=(5.6, 3.6), constrained_layout=True)
    for i, (label, members) in enumerate(sweep_table.joined(lines)):
        shown = [row for row in members if row["point"] in numbers]
        x = [float(row[along]) if numeric else row[along] for row in shown]
        y = [numbers[row["point"]] for row in shown]
        style = line_style(i)
        axes.plot(x, y, label=label, linestyle="-" if numeric else "", **style)
        unsettled = [k for k, row in enumerate(shown) if row["status"] != "done"]
        axes.plot([x[k] for k in unsettled], [y[k] for k in unsettled], linestyle="",
                  **style | {"markerfacecolor": "white"})
    axes.set(xlabel=along.split("/")[-1],
             ylabel=sweep_table.label(name))
    if spans_decades(list(numbers.values())):
        axes.set_yscale("log")
    axes.grid(True, which="major", alpha=0.25, linewidth=0.6)
    if numeric and sweep_table.is_geometric(rows, along):
        axes.set_xscale("log")
        name_numbers(axes)
    if others and len(lines) > 1:
        add_legend(axes)
    return figure
