# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The table of a sweep: its rows, and the lines that its points form."""

import csv
import math

from crevasse import findings
from crevasse.results import ResultsError, number

COSTS = {"vi_solves": "contact problems",
         "linear_solves": "linear solves",
         "seconds": "wall time (s)",
         "processor_seconds": "CPU time (s)",
         "seconds_time_stepping": "wall time of the time stepping (s)",
         "peak_memory_bytes": "memory of a process (bytes)"}


def label(name):
    """Label of a finding with its unit, or of a cost."""
    return COSTS.get(name) or f"{findings.label(name)} ({findings.unit(name)})"


def wall_times(rows):
    """Wall times {point: seconds}, as findings_of(); empty if unknown."""
    times = {row["point"]: float(row["seconds"]) for row in rows
             if is_number(row["seconds"])}
    return {"seconds": times} if times else {}


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
    """Names of the parameters: the columns between "point" and "status"."""
    names = list(rows[0])
    return names[1:names.index("status")]


def is_numeric(rows, name):
    return all(is_number(row[name]) for row in rows)


def is_number(text):
    value = number(text)
    return value is not None and math.isfinite(value)


def is_geometric(rows, name):
    """Whether factors between positive numbers are more equal than differences."""
    numbers = sorted({float(row[name]) for row in rows})
    if numbers[0] <= 0:
        return False
    steps = [(b - a, math.log(b / a)) for a, b in zip(numbers, numbers[1:])]
    spreads = [max(kind) / min(kind) for kind in zip(*steps)]
    return bool(spreads) and spreads[1] < spreads[0]


def most_numeric(rows, names):
    """The parameter with the most values, among those that are numbers; where none of
    these varies, among all."""
    def values(name):
        n = len({row[name] for row in rows})
        return (n if n > 1 and is_numeric(rows, name) else 0), n
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
    """Whether one number has one value for each value of another: the two were changed
    together. Texts form separate lines."""
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


def joined(lines):
    """One line through all points, if each point would be a line by itself."""
    if any(len(members) > 1 for _, members in lines):
        return lines
    return [("", [row for _, members in lines for row in members])]


def findings_of(rows):
    """Findings {column: {point: number}} of the results that have numbers."""
    numbers = {name: {row["point"]: float(row[name]) for row in rows
                      if is_number(row[name])}
               for name in rows[0] if findings.is_finding(name)}
    return {name: points for name, points in numbers.items() if points}


def varying(found):
    """The findings that differ by more than rounding and by more than a thousandth."""
    sizes = {name: max(map(abs, points.values())) for name, points in found.items()}
    return {name: points for name, points in found.items()
            if max(points.values()) - min(points.values())
            > max(1e-3 * sizes[name], 1e-9 * max(
                size for other, size in sizes.items()
                if findings.unit(other) == findings.unit(name)))}


def first_of_size(rows, quantities):
    """The first quantity whose errors are more than rounding, if there is one."""
    return next((quantity for quantity in quantities
                 if any((number(row["error:" + quantity]) or 0) > 1e-12
                        for row in rows)), quantities[0])


def quantities(rows):
    """Names of the quantities that have errors."""
    return [name.removeprefix("error:") for name in rows[0]
            if name.startswith("error:")]
