# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The figures of a life: those of its page, for print."""

from crevasse.histories import COLOURS
from crevasse.life_output import charts_of, read, units_of
from crevasse.plotting import add_legend, name_numbers, pyplot


def drawings(options):
    """Figures (file name, figure): the path on the body, a(N) with its band, da/dN over
    ΔK, K and C* over a."""
    life, table = read(options.results)
    if "body" in life:
        yield "path", draw_path(life["body"], table, units_of(life))
    for chart in charts_of(table, life):
        if chart["series"]:
            yield chart["name"], draw(chart)


def draw_path(body, table, units):
    figure, axes = pyplot.subplots(figsize=(5.6, 3.6), constrained_layout=True)
    for outline in body:
        axes.plot(*zip(*outline), color="#777777", linewidth=0.8)
    axes.plot(table["x"], table["y"], color=COLOURS[0])
    axes.set(xlabel=units("x (length)"), ylabel=units("y (length)"), aspect="equal")
    return figure


def draw(chart):
    figure, axes = pyplot.subplots(figsize=(5.6, 3.6), constrained_layout=True)
    for k, line in enumerate(chart["series"]):
        # Where lines coincide, those behind show through.
        style = {"linewidth": 0.8 if k else 1.6, "linestyle": "--" if k > 1 else "-"}
        if line.get("loose"):
            style = {"linestyle": "", "marker": "o", "markersize": 4.5}
        axes.plot(*zip(*line["points"]), label=line["label"], color=line["colour"], **style)
    axes.set(xlabel=chart["x"], ylabel=chart["y"],
             **{f"{axis}scale": "log" for axis in chart["log"]})
    if "x" in chart["log"]:
        name_numbers(axes)
    axes.grid(True, which="major", alpha=0.25, linewidth=0.6)
    if len(chart["series"]) > 1:
        add_legend(axes)
    return figure
