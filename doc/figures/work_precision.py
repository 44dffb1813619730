#!/usr/bin/python3
# Copyright (C) 2026 by the Crevasse authors
# SPDX-License-Identifier: LGPL-2.1-or-later

"""Draws what accuracy costs: the errors of a sweep against its costs, one line
for each combination of the parameters that are not followed along a line."""

import argparse
import csv
import pathlib
import sys

sys.dont_write_bytecode = True  # leaves nothing behind in the source tree

from results import ResultsError

COSTS = {"vi_solves": "variational inequalities",
         "linear_solves": "linear solves",
         "seconds": "wall time (s)",
         "processor_seconds": "time of the processor (s)",
         "seconds_time_stepping": "wall time of the time stepping (s)"}
MARKERS = "osD^vPX*"


def number(text):
    try:
        return float(text)
    except ValueError:
        return None


def read_rows(directory):
    path = directory / "sweep.csv"
    try:
        with open(path, newline="") as file:
            rows = list(csv.DictReader(file))
    except OSError as error:
        raise ResultsError(f"{path}: {error.strerror}. Give the output directory "
                           "of crevasse sweep.") from None
    except (ValueError, csv.Error) as error:
        raise ResultsError(f"{path}: {error}.") from None
    if not rows:
        raise ResultsError(f"{path}: there are no points yet.")
    for name in ("point", "status", *COSTS):
        if name not in rows[0]:
            raise ResultsError(f"{path}: has no column {name}: it is not the table "
                               "of a sweep.")
    for point, row in enumerate(rows, 1):
        if None in row or None in row.values():
            raise ResultsError(f"{path}: point {point} has another number of "
                               "columns than the header.")
    return rows


def parameters(rows):
    """The columns between "point" and "status"."""
    names = list(rows[0])
    return names[1:names.index("status")]


def choose(wanted, available, what):
    """The one whose name, or the end of it, is wanted."""
    found = [name for name in available
             if wanted in (name, name.split("/")[-1])]
    if not found:
        sys.exit(f"There is no {what} {wanted}. There are: "
                 f"{', '.join(available) or 'none'}.")
    return found[0]


def most_numeric(rows, names):
    """The parameter with the most values, among those that are numbers."""
    def values(name):
        texts = {row[name] for row in rows}
        return len(texts) if all(number(text) is not None
                                 for text in texts) else 0
    return max(names, key=values)


def lines(rows, along, others):
    """Label and rows of each line, in the order in which they were computed."""
    groups = {}
    for row in rows:
        groups.setdefault(tuple(row[name] for name in others), []).append(row)
    for values, members in groups.items():
        members.sort(key=lambda row: (number(row[along]) is None,
                                      number(row[along]) or 0))
        label = ", ".join(
            value if number(value) is None and value not in ("true", "false")
            else f"{name.split('/')[-1]} {value}"
            for name, value in zip(others, values))
        yield label, members


def changes_with(rows, name, along):
    """Whether a number has one value for each value of another: the two were
    changed together. What is no number makes lines of its own."""
    pairs = {(row[along], row[name]) for row in rows}
    return (len(pairs) == len({row[along] for row in rows})
            and all(number(row[name]) is not None for row in rows))


def lines_of(rows, along=None):
    """The parameter that is followed along a line, by default that with the most
    numbers, those that tell the lines apart, and the lines."""
    along = along or most_numeric(rows, parameters(rows))
    others = [name for name in parameters(rows)
              if name != along and not changes_with(rows, name, along)]
    return along, others, list(lines(rows, along, others))


def draw(rows, options):
    try:
        from plotting import BLUE, GREEN, GREY, INK, VERMILION, pyplot
    except ImportError as missing:
        sys.exit(f"{missing}. Figures need Debian's package python3-matplotlib.")
    along, others, followed = lines_of(
        rows, options.along and choose(options.along, parameters(rows),
                                       "parameter"))
    figure, axes = pyplot.subplots(figsize=(5.6, 4.0), constrained_layout=True)
    error = "error:" + options.quantity
    drawn = []
    for i, (label, members) in enumerate(followed):
        points = [(number(row[options.x]), number(row[error]), row[along])
                  for row in members]
        points = [point for point in points if point[0] and point[1]]
        if not points:
            print(f"{label or 'the points'}: nothing to draw")
            continue
        colour = (BLUE, VERMILION, GREEN, INK, GREY)[i % 5]
        axes.loglog(*zip(*[point[:2] for point in points]), label=label,
                    color=colour, marker=MARKERS[i % len(MARKERS)],
                    markersize=4.5)
        drawn += [(*point, colour) for point in points]
    if not drawn:
        sys.exit(f"No point has an error of {options.quantity} and "
                 f"{COSTS[options.x]}; --x and --quantity choose others.")
    write_numbers(axes, drawn)
    axes.set(xlabel=COSTS[options.x],
             ylabel=f"relative error of {options.quantity}")
    axes.set_title(f"numbers: {along.split('/')[-1]}", fontsize=8, loc="right",
                   color=GREY)
    axes.grid(True, which="major", alpha=0.25, linewidth=0.6)
    name_costs(axes)
    if others:
        axes.legend()
    try:
        figure.savefig(options.out)
    except (OSError, ValueError) as problem:  # the directory, the format
        sys.exit(f"{options.out}: {problem}. --out FILE takes another one.")
    print(options.out)


def name_costs(axes):
    """Costs without powers of ten: 1, 2, 5, 10, ..."""
    from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator
    from plotting import ladder
    low, high = axes.get_xlim()
    mantissas = ((1,) if high > 1e4 * low else
                 (1, 2, 5) if high > 10 * low else (1, 1.5, 2, 3, 4, 5, 7))
    axes.xaxis.set_major_locator(FixedLocator(ladder(low, high, mantissas)))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:.10g}"))


def write_numbers(axes, points):
    """At each point the value along its line."""
    for x, y, value, colour in points:
        axes.annotate(value, (x, y), xytext=(4, 4), fontsize=6.5, color=colour,
                      textcoords="offset points")


def first_of_size(rows, quantities):
    """The first quantity whose errors are more than rounding, if there is."""
    for quantity in quantities:
        if any((number(row["error:" + quantity]) or 0) > 1e-12
               for row in rows):
            return quantity
    return quantities[0]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", type=pathlib.Path,
                        help="the output directory of crevasse sweep")
    parser.add_argument("--x", choices=list(COSTS), default="linear_solves",
                        help="the cost (linear_solves)")
    parser.add_argument("--quantity", help="whose error (the first one)")
    parser.add_argument("--along", metavar="NAME",
                        help="the parameter that is followed along a line (the "
                             "one with the most numeric values)")
    parser.add_argument("--out", type=pathlib.Path, help="the figure's file "
                        "(work_precision.png in RESULTS)")
    options = parser.parse_args()
    options.out = options.out or options.results / "work_precision.png"
    return options


def main():
    options = arguments()
    try:
        rows = read_rows(options.results)
    except ResultsError as error:
        sys.exit(str(error))
    quantities = [name[len("error:"):] for name in rows[0]
                  if name.startswith("error:")]
    options.quantity = (choose(options.quantity, quantities, "quantity")
                        if options.quantity else first_of_size(rows, quantities))
    print(f"errors of {options.quantity}; --quantity takes another of "
          f"{', '.join(quantities)}")
    draw(rows, options)


if __name__ == "__main__":
    main()
