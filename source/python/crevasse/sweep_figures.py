# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The figures of a sweep: its results against what varies, errors against costs."""

from crevasse.histories import spans_decades
from crevasse.plotting import GREY, add_legend, line_style, name_numbers, pyplot
from crevasse.results import ResultsError, number
from crevasse.sweep_table import (COSTS, findings_of, first_of_size, is_geometric,
                                  is_numeric, joined, label, lines_of, parameters,
                                  quantities, read_rows, varying, wall_times)


def drawings(options):
    """Figures (file name, figure) of a sweep: errors against costs, if there are
    errors, and each result that varies; or the one that --quantity names."""
    rows = read_rows(options.results)
    errors, found = quantities(rows), findings_of(rows)
    along = options.along and choose(options.along, parameters(rows), "parameter")
    if options.quantity:
        chosen = choose(options.quantity, [*errors, *found], "quantity")
        errors = [name for name in errors if name == chosen]
        found = {name: found[name] for name in found if name == chosen}
    else:
        found = varying(found) | ({} if errors else wall_times(rows))
    if errors:
        quantity = first_of_size(rows, errors)
        if not options.quantity:
            print(f"errors of {quantity}; --quantity takes another of "
                  + ", ".join(errors))
        yield "work_precision", draw_errors(rows, options.x, quantity, along)
    for name, numbers in found.items():
        yield name, draw_results(rows, name, numbers, along)
    if not errors and not found:
        raise ResultsError(f"{options.results}: no result of the sweep varies, and it "
                           "has measured no errors. There is nothing to draw.")


def choose(wanted, available, what):
    """The candidate whose name, or the end of it, is wanted."""
    for name in available:
        if wanted in (name, name.split("/")[-1]):
            return name
    raise ResultsError(f"There is no {what} {wanted}. There are: "
                       f"{', '.join(available) or 'none'}.")


def draw_results(rows, name, numbers, along=None):
    """A figure of the numbers of the points against what varies, one line for each
    combination of the parameters that are not followed along a line."""
    along, others, lines = lines_of(rows, along)
    numeric = is_numeric(rows, along)
    figure, axes = pyplot.subplots(figsize=(5.6, 3.6), constrained_layout=True)
    for i, (text, members) in enumerate(joined(lines)):
        shown = [row for row in members if row["point"] in numbers]
        x = [float(row[along]) if numeric else row[along] for row in shown]
        y = [numbers[row["point"]] for row in shown]
        style = line_style(i)
        bars = [number(row.get("bar:" + name, "")) or 0. for row in shown]
        axes.errorbar(x, y, yerr=bars if any(bars) else None, capsize=3, label=text,
                      linestyle="-" if numeric else "", **style)
        unsettled = [k for k, row in enumerate(shown) if row["status"] != "done"]
        axes.plot([x[k] for k in unsettled], [y[k] for k in unsettled], linestyle="",
                  **style | {"markerfacecolor": "white"})
    axes.set(xlabel=along.split("/")[-1],
             ylabel=label(name))
    if spans_decades(list(numbers.values())):
        axes.set_yscale("log")
    axes.grid(True, which="major", alpha=0.25, linewidth=0.6)
    if numeric and is_geometric(rows, along):
        axes.set_xscale("log")
        name_numbers(axes)
    if others and len(lines) > 1:
        add_legend(axes)
    return figure


def draw_errors(rows, cost, quantity, along=None):
    """A figure of errors against their costs, with the same lines."""
    along, others, followed = lines_of(rows, along)
    figure, axes = pyplot.subplots(figsize=(5.6, 4.0), constrained_layout=True)
    drawn = 0
    for i, (text, members) in enumerate(followed):
        points = [(number(row[cost]), number(row["error:" + quantity]), row[along])
                  for row in members]
        points = [point for point in points if point[0] and point[1]]
        if not points:
            print(f"{text or 'the points'}: nothing to draw")
            continue
        style = line_style(i)
        axes.loglog(*zip(*[point[:2] for point in points]), label=text, **style)
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
