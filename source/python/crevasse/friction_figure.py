# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""A map of which pairs of nodes are open, stick or slide over the last period."""

from matplotlib import patches, pyplot
from matplotlib.colors import ListedColormap
import numpy

from crevasse.plotting import BLUE, GREY, VERMILION

# States of friction.csv, in the order of their colours.
STATES = {-2: ("slides back", VERMILION), 0: ("open", "#e8e8e8"), 1: ("sticks", GREY),
          2: ("slides forth", BLUE)}


def at_place(place):
    return "(" + ", ".join(f"{x:.3g}" for x in place) + ")"


def over_time(run):
    """Figure with a panel for each lip: length along it against time."""
    table = run.tables["friction.csv"]
    lips = numpy.unique(table["lip"])
    figure, panels = pyplot.subplots(len(lips), 1, figsize=(7, 1 + 2.4 * len(lips)),
                                     squeeze=False, layout="constrained", sharex=True)
    for lip, axes in zip(lips, panels[:, 0]):
        of_lip = table["lip"] == lip
        t, x, y, state = (table[name][of_lip] for name in ("t", "x", "y", "state"))
        instants = numpy.unique(t)
        # All instants have the nodes in their order along the lip.
        n = len(t) // len(instants)
        places = numpy.column_stack((x, y))[:n]
        steps = numpy.hypot(*numpy.diff(places, axis=0).T)
        along = numpy.concatenate(([0], steps.cumsum()))
        numbers = numpy.searchsorted(list(STATES), state.reshape(-1, n)).T
        axes.pcolormesh(instants, along, numbers, shading="nearest",
                        cmap=ListedColormap([colour for _, colour in STATES.values()]),
                        vmin=-0.5, vmax=len(STATES) - 0.5)
        axes.set_ylabel(run.in_units("along the lip (length)"))
        # Pairs that touch, and a pair more on both sides.
        touches = numpy.flatnonzero((state.reshape(-1, n) != 0).any(axis=0))
        ends = [max(touches[0] - 1, 0), min(touches[-1] + 1, n - 1)] if len(
            touches) else [0, n - 1]
        axes.set_ylim(along[ends])
        axes.secondary_yaxis("right").set_yticks(
            along[ends], [at_place(place) for place in places[ends]])
        if len(lips) > 1:
            axes.set_title(f"lip {lip:g}")
    panels[-1, 0].set_xlabel(run.in_units("t (time)"))
    panels[0, 0].legend(handles=[patches.Patch(facecolor=colour, edgecolor=GREY, label=name)
                                 for name, colour in STATES.values()],
                        loc="lower center", bbox_to_anchor=(0.5, 1.), ncols=4, frameon=False)
    return figure
