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


def over_time(run):
    """Figure with a panel for each lip: distance along it against time."""
    table = run.tables["friction.csv"]
    lips = numpy.unique(table["lip"])
    figure, panels = pyplot.subplots(len(lips), 1, figsize=(7, 1 + 2.4 * len(lips)),
                                     squeeze=False, layout="constrained", sharex=True)
    for lip, axes in zip(lips, panels[:, 0]):
        of_lip = table["lip"] == lip
        t, x, y, state = (table[name][of_lip] for name in ("t", "x", "y", "state"))
        instants = numpy.unique(t)
        # All instants have the nodes in the same order.
        n = len(t) // len(instants)
        places = numpy.column_stack((x, y))[:n]
        far = places[numpy.hypot(*(places - places[0]).T).argmax()]
        distance = numpy.hypot(*(places - far).T)
        order = distance.argsort()
        numbers = numpy.searchsorted(list(STATES), state.reshape(-1, n)[:, order])
        axes.pcolormesh(instants, distance[order], numbers.T, shading="nearest",
                        cmap=ListedColormap([colour for _, colour in STATES.values()]),
                        vmin=-0.5, vmax=len(STATES) - 0.5)
        begin = ", ".join(f"{x:.4g}" for x in far)
        axes.set(ylabel=run.in_units(f"distance from ({begin}) (length)"),
                 title=f"lip {lip:g}" if len(lips) > 1 else "")
    panels[-1, 0].set_xlabel(run.in_units("t (time)"))
    panels[0, 0].legend(handles=[patches.Patch(facecolor=colour, edgecolor=GREY, label=name)
                                 for name, colour in STATES.values()],
                        loc="lower center", bbox_to_anchor=(0.5, 1.), ncols=4, frameon=False)
    return figure
