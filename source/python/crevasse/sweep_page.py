# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The report of a sweep: the results of its points against what varies, and, where
errors were measured, what accuracy costs and which points no other one beats."""

import collections
import json
import math
import re

from crevasse import findings, sweep_table
from crevasse.histories import COLOURS, spans_decades
from crevasse.page import render
from crevasse.plotting import INK
from crevasse.results import ResultsError, number
from crevasse.run_reader import Run

MARKERS = ("circle", "rect", "triangle", "rectRot", "crossRot", "star")


def page(directory):
    """The text of the page, no headline, notes about the sweep, and damaged files."""
    rows = sweep_table.read_rows(directory)
    description, damages = read_description(directory)
    quantities = sweep_table.quantities(rows)
    along, others, lines = sweep_table.lines_of(rows)
    studies = [study(rows, lines, quantity) for quantity in quantities]
    charts = [chart for part in studies for chart in part["charts"]]
    found = sweep_table.findings_of(rows)
    drawn = sweep_table.varying(found)
    result_charts = finding_charts(rows, lines, along, drawn | (
        {} if quantities else sweep_table.wall_times(rows)))
    charts += result_charts
    for k, chart in enumerate(charts):
        chart["id"] = f"chart{k}"
    unfinished = points_to_come(directory, rows)
    text = render(
        "sweep.html", title=description.get("title") or f"Sweep {directory.name}",
        directory=directory.resolve(), rows=rows,
        names=sweep_table.parameters(rows), values=values(rows), along=along,
        quantities=quantities, studies=studies, unfinished=unfinished,
        reference=description.get("reference", {}),
        warnings=description.get("warnings", []),
        findings={name: findings.label(name) for name in found},
        constant={findings.label(name): next(iter(points.values()))
                  for name, points in found.items() if name not in drawn},
        result_charts=result_charts, damages=damages,
        states=collections.Counter(row["status"] for row in rows),
        scene=scene_of(directory, rows), orders=any("order:" + name in rows[0]
                                                    for name in quantities),
        beside=any((number(row.get("jobs", "")) or 1) > 1 for row in rows),
        shown=first_with_points(studies, rows, quantities),
        data={"charts": charts, "shades": [], "lip": False})
    return text, [], [unfinished] * bool(unfinished), damages


def read_description(directory):
    """Title and reference of a sweep, from sweep.json."""
    path = directory / "sweep.json"
    try:
        description = json.loads(path.read_text(encoding="utf-8"))
        if isinstance(description, dict):
            return description, []
        return {}, [f"{path.name}: is not a description of a sweep."]
    except (OSError, ValueError) as error:
        return {}, [f"{path.name}: {error}."]


def values(rows):
    """The values of each varied parameter, in the order of the points."""
    return {name: list(dict.fromkeys(row[name] for row in rows))
            for name in sweep_table.parameters(rows)}


def points_to_come(directory, rows):
    """A sentence on points of the log that are not in the table; nothing if the sweep
    is complete."""
    try:
        text = (directory / "sweep.log").read_text(errors="replace")
    except OSError:
        return ""
    planned = re.match(r"Crevasse .*: sweep of .*, (\d+) points?$", text, re.M)
    if not planned or int(planned[1]) <= len(rows):
        return ""
    return (f"Not finished: {len(rows)} of {planned[1]} points are done. Repeat the "
            "command to continue.")


def words(row, names):
    """The parameters of a point in words, shown when hovering over it."""
    return [f"{name.split('/')[-1]} = {row[name]}" for name in names]


def study(rows, lines, quantity):
    """Charts of the error of one quantity against costs, and the points of the Pareto
    fronts by their cost."""
    charts, fronts = [], {}
    for cost in chosen_costs(rows):
        series, best = work_precision_series(rows, lines, quantity, cost)
        if series:
            label = sweep_table.COSTS[cost]
            charts.append({"kind": "points", "x": label, "log": ["x", "y"],
                           "y": "relative error", "series": series,
                           "title": f"Error of {quantity} against {label}"})
            fronts[cost] = {row["point"] for row in best}
    return {"quantity": quantity, "charts": charts, "fronts": fronts}


def chosen_costs(rows):
    """Costs of charts: wall time, and contact problems (without: linear solves)."""
    contact = any(number(row["vi_solves"]) for row in rows)
    return "seconds", "vi_solves" if contact else "linear_solves"


def work_precision_series(rows, lines, quantity, cost):
    """The lines of a chart, and the points on its Pareto front."""
    error = "error:" + quantity
    names = sweep_table.parameters(rows)
    series = []
    for k, (label, members) in enumerate(lines):
        shown = [row for row in members if drawable(row, cost, error)]
        if shown:
            series.append({
                "label": label or quantity, **style(k),
                "points": [[number(row[cost]), number(row[error]),
                            words(row, names) + not_done(row)] for row in shown]})
    best = pareto_front([row for row in rows if drawable(row, cost, error)], cost,
                        error)
    if series:
        series.append({"label": "no other point is cheaper and as accurate",
                       "colour": INK, "hollow": True, "loose": True,
                       "points": [[number(row[cost]), number(row[error])]
                                  for row in best]})
    return series, best


def not_done(row):
    return [] if row["status"] == "done" else [row["status"]]


def drawable(row, cost, error):
    """Whether logarithmic axes can show a point."""
    return (0 < (number(row[cost]) or 0) < math.inf
            and 0 < (number(row[error]) or 0) < math.inf)


def pareto_front(rows, cost, error):
    """Points to which no other one is superior in cost and error."""
    best, least = [], float("inf")
    for row in sorted(rows, key=lambda row: (number(row[cost]),
                                             number(row[error]))):
        if number(row[error]) < least:
            least = number(row[error])
            best.append(row)
    return best


def first_with_points(studies, rows, quantities):
    """The quantity that is shown first: the first whose chart has points."""
    if not quantities:
        return None
    first = sweep_table.first_of_size(rows, quantities)
    drawn = [part["quantity"] for part in studies if part["charts"]]
    return first if first in drawn or not drawn else drawn[0]


def finding_charts(rows, lines, along, found):
    """Charts of each finding against the parameter along the lines."""
    axis = {"x": along.split("/")[-1], **scale(rows, along)}
    read_x = str if "categories" in axis else float
    names = sweep_table.parameters(rows)
    charts = []
    for name, numbers in found.items():
        title, unit = (("wall time", "s") if name == "seconds" else
                       (findings.label(name), findings.unit(name)))
        series = [{"label": label or title, **style(k),
                   "loose": "categories" in axis,
                   "points": [[read_x(row[along]), numbers[row["point"]],
                               words(row, names) + not_done(row),
                               row["status"] != "done",
                               number(row.get("bar:" + name, ""))]
                              for row in members if row["point"] in numbers]}
                  for k, (label, members) in enumerate(sweep_table.joined(lines))]
        log = ["y"] if spans_decades(list(numbers.values())) else []
        charts.append({"kind": "points", "title": title, **axis,
                       "log": axis.get("log", []) + log, "y": unit, "what": title,
                       "series": [line for line in series if line["points"]]})
    return charts


def scale(rows, along):
    """Scale of an axis. Texts are categories; numbers that are spaced by factors have a
    logarithmic axis."""
    if not sweep_table.is_numeric(rows, along):
        return {"categories": list(dict.fromkeys(row[along] for row in rows))}
    return {"log": ["x"]} if sweep_table.is_geometric(rows, along) else {}


def style(k):
    return {"colour": COLOURS[k % len(COLOURS)],
            "marker": MARKERS[(k + k // len(COLOURS)) % len(MARKERS)]}


def scene_of(directory, rows):
    """The scene of one of the runs; the scenes differ in the varied parameters only."""
    for name in ["reference", *(row["point"] for row in rows)]:
        try:
            return Run(directory / name)
        except ResultsError:
            continue
    return None
