# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""K_I along a crack front in space, of two lips also K_II and K_III, over arc length
and time."""

import numpy
from matplotlib import pyplot

from crevasse.plotting import BLUE, GREY, INK, VERMILION


def intensity(run):
    """A figure of crack_front.csv; a row of axes for each front and mode: K at the
    instants of its extremes, and over arc length and time."""
    table = run.tables["crack_front.csv"]
    fronts = numpy.unique(table["front"])
    rows = [(front, name) for front in fronts for name in ("K_I", "K_II", "K_III")
            if name in table]
    figure, all_axes = pyplot.subplots(len(rows), 2, figsize=(9, 3.2 * len(rows)),
                                       squeeze=False, layout="constrained")
    for (front, name), axes in zip(rows, all_axes):
        own = table["front"] == front
        t, s = numpy.unique(table["t"][own]), numpy.unique(table["s"][own])
        K, error = (table[column][own].reshape(len(t), len(s))
                    for column in (name, name + "_error"))
        label = "K$_{" + name[2:] + "}$ (stress × √length)"
        draw_lines(axes[0], t, s, K, error, label)
        draw_map(axes[1], t, s, K, label)
        if len(fronts) > 1:
            axes[0].set_title(f"front {front:g}")
    return figure


def draw_lines(axes, t, s, K, error, label):
    """Draws K along the front at some instants, with a band of the estimated error."""
    instants = {K.max(axis=1).argmax(): VERMILION, K.min(axis=1).argmin(): BLUE}
    for k, colour in instants.items():
        axes.fill_between(s, K[k] - error[k], K[k] + error[k], color=colour,
                          alpha=0.25, linewidth=0)
        axes.plot(s, K[k], color=colour, marker=".", label=f"t = {t[k]:g}")
    axes.axhline(0, color=GREY, linewidth=0.6)
    axes.set(xlabel="s along the front (length)", ylabel=label)
    axes.legend()


def draw_map(axes, t, s, K, label):
    if len(t) < 2 or len(s) < 2:
        axes.axis("off")
        return
    size = abs(K).max() or 1.
    shades = axes.pcolormesh(s, t, K, shading="gouraud", cmap="RdBu_r", vmin=-size,
                             vmax=size)
    axes.set(xlabel="s along the front (length)", ylabel="t (time)")
    axes.figure.colorbar(shades, ax=axes, label=label).outline.set_edgecolor(INK)
