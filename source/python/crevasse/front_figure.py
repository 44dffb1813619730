# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""K_I along a crack front in space, over arc length and time."""

import numpy
from matplotlib import pyplot

from crevasse.plotting import BLUE, GREY, INK, VERMILION


def intensity(run):
    """A figure of crack_front.csv; a row of axes for each front: K_I at the
    instants of its extremes, and over arc length and time."""
    table = run.tables["crack_front.csv"]
    fronts = numpy.unique(table["front"])
    figure, all_axes = pyplot.subplots(len(fronts), 2, figsize=(9, 3.2 * len(fronts)),
                                       squeeze=False, layout="constrained")
    for front, axes in zip(fronts, all_axes):
        own = table["front"] == front
        t, s = numpy.unique(table["t"][own]), numpy.unique(table["s"][own])
        K, error = (table[name][own].reshape(len(t), len(s))
                    for name in ("K_I", "K_I_error"))
        draw_lines(axes[0], t, s, K, error)
        draw_map(axes[1], t, s, K)
        if len(fronts) > 1:
            axes[0].set_title(f"front {front:g}")
    return figure


def draw_lines(axes, t, s, K, error):
    """With a band of the estimated error."""
    instants = {K.max(axis=1).argmax(): VERMILION, K.min(axis=1).argmin(): BLUE}
    for k, colour in instants.items():
        axes.fill_between(s, K[k] - error[k], K[k] + error[k], color=colour,
                          alpha=0.25, linewidth=0)
        axes.plot(s, K[k], color=colour, marker=".", label=f"t = {t[k]:g}")
    axes.axhline(0, color=GREY, linewidth=0.6)
    axes.set(xlabel="s along the front (length)", ylabel="K$_I$ (stress × √length)")
    axes.legend()


def draw_map(axes, t, s, K):
    if len(t) < 2 or len(s) < 2:
        axes.axis("off")
        return
    size = abs(K).max() or 1.
    shades = axes.pcolormesh(s, t, K, shading="gouraud", cmap="RdBu_r", vmin=-size,
                             vmax=size)
    axes.set(xlabel="s along the front (length)", ylabel="t (time)")
    axes.figure.colorbar(shades, ax=axes, label="K$_I$").outline.set_edgecolor(INK)
