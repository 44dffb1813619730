# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The report of one run: gathers what templates/run.html shows."""

import contextlib
import datetime
import math
import os

from crevasse import field_view, headline, histories, paper
from crevasse.ending import checkpoint, ending_of
from crevasse.page import render
from crevasse.plotting import BLUE, GREY, VERMILION
from crevasse.results import number
from crevasse.run_reader import Run


def page(directory):
    """The text of the page, its headline, notes about the run, and damaged files."""
    run = Run(directory)
    ending = ending_of(run)
    fields = paper.unless_damaged(run, field_view.pack)
    pictures, missing = paper.pictures(run)
    groups = history_groups(run)
    convergence = convergence_chart(run)
    relaxation = relaxation_chart(run)
    first = headline.chart(run)
    charts = [chart for chart in (
        first, *(chart for group in groups for chart in group["charts"]), convergence,
        relaxation) if chart]
    for k, chart in enumerate(charts):
        chart["id"] = f"chart{k}"
    shades = histories.lip_intervals(run)
    lip = "contact.csv" in run.tables
    text = render(
        "run.html", run=run, summary=run.summary, ending=ending,
        title=run.parameter("Title") or directory.resolve().name,
        directory=directory.resolve(), written=time_of(run),
        changed=changed_parameters(run), fields=fields,
        is_paper=paper.is_scene_of_paper(run), pictures=pictures, missing=missing,
        headline=headline.numbers(run), first_chart=first,
        groups=groups, convergence=convergence, relaxation=relaxation,
        lip=lip, presses=bool(shades),
        periods=run.tables.get("periods.csv"), costs=costs(run),
        thinned=is_thinned(charts),
        several=any("last" in chart.get("views", ()) for chart in charts),
        data={"charts": charts, "shades": shades, "lip": lip})
    return text, list(headline.lines(run)), list(notes_on(run, ending)), run.damages


def notes_on(run, ending):
    """Notes about a run that is not simply done, and what to do."""
    if ending.kind != "good":
        yield f"{ending.heading}." + (f" {checkpoint(run)}" if ending.kind == "bad"
                                      and not run.finished else "")


def time_of(run):
    """Time of the newest file that shows the end of the run."""
    times = []
    for name in ("used.prm", "log.txt", "summary.json"):
        with contextlib.suppress(FileNotFoundError):  # a run that is resumed
            times.append(os.path.getmtime(run.directory / name))
    return datetime.datetime.fromtimestamp(max(times)).strftime("%Y-%m-%d %H:%M")


def changed_parameters(run):
    """Rows (name, value, default) of non-default parameters."""
    return [(name, run.parameters[name], default)
            for name, default in run.defaults.items()]


def history_groups(run):
    """Charts over time of the crack tips, the lip, each probe, and the loads."""
    groups = tip_groups(run)
    if "contact.csv" in run.tables:
        groups.append({"heading": "The lip as a whole",
                       "charts": list(histories.lip_charts(run))})
    for name in run.tables:
        if name.startswith("probe_"):
            probe = name[len("probe_"):-len(".csv")]
            point = ", ".join(f"{x:g}" for x in run.probes.get(probe, ()))
            groups.append({
                "heading": f"Probe {probe}" + (f" ({point})" if point else ""),
                "charts": list(histories.probe_charts(run, probe))})
    if "load_work.csv" in run.tables:
        groups.append({"heading": "Loads", "charts":
                       list(histories.load_work_charts(run))})
    return groups


def tip_groups(run):
    groups = []
    if "crack_tip.csv" in run.tables:
        groups.append({"heading": "Crack tip", "charts":
                       list(histories.stress_intensity_charts(run))})
    for name in run.tables:
        if name.startswith("crack_tip_"):
            number = name[len("crack_tip_"):-len(".csv")]
            groups.append({"heading": f"Crack tip {number}", "charts":
                           list(histories.mixed_mode_charts(run, name))})
    for name in run.tables:
        if name.startswith("creep_integral"):
            number = name[len("creep_integral"):-len(".csv")].replace("_", " ")
            groups.append({"heading": f"Creep at crack tip{number}", "charts":
                           list(histories.creep_integral_charts(run, name))})
    return groups


def relaxation_chart(run):
    """Chart of the paper's Table 1: iterations of SOR by relaxation factor."""
    table = run.tables.get("relaxation.csv")
    if table is None:
        return None
    order = table["relaxation_factor"].argsort()
    return {"kind": "points", "title": "Table 1: iterations of SOR",
            "x": "relaxation factor", "y": "iterations", "log": ["y"],
            "series": [points(label, colour, table["relaxation_factor"][order],
                              table[column][order])
                       for column, label, colour in
                       (("iterations", "to the residual of a direct solver", BLUE),
                        ("iterations_27_bits", "to that of 27 bits", VERMILION))
                       if column in table]}


def is_thinned(charts):
    return any(len(chart["views"]["whole"]["t"]) > histories.MOST_ROWS / 2
               and "last" in chart["views"] for chart in charts
               if chart["kind"] == "history")


def convergence_chart(run):
    """Chart of the change and the estimated error of the stress by period; None if
    there is one period only."""
    table = run.tables.get("periods.csv")
    if table is None or len(table["period"]) < 2:
        return None
    series = [points("change from the period before", BLUE, table["period"][1:],
                     table["stress_change"][1:]),
              points("estimated error", VERMILION, table["period"],
                     table["stress_error_estimate"])]
    tolerance = number(run.parameter("Periodic state/Tolerance"))
    if tolerance:
        ends = table["period"][[0, -1]]
        series.append(points("tolerance", GREY, ends, [tolerance, tolerance])
                      | {"bare": True})
    return {"kind": "points", "title": "Way to the periodic state",
            "x": "period", "y": "relative to the largest stress",
            "log": ["y"], "whole": True, "series": series}


def points(label, colour, xs, ys):
    """A line through the points that a logarithmic axis can show."""
    return {"label": label, "colour": colour,
            "points": [[float(x), float(y)] for x, y in zip(xs, ys)
                       if math.isfinite(y) and y > 0]}


def costs(run):
    """Rows (what, seconds, calls, part of the whole), the largest first; the seconds
    are exclusive, so that they add up to the whole."""
    total = run.summary.get("seconds", {}).get("total") or 0
    calls = run.summary.get("calls", {})
    return [(name, part * total, calls.get(name), part)
            for name, part in run.summary.get("share", {}).items()
            if part is not None] if total > 0 else []
