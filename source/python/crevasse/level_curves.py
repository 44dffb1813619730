# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Labelled level curves on a deformed body."""

import numpy
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.tri import Triangulation

from crevasse.plotting import (HALO, INK, deformed, draw_outline, finish_body,
                               round_up, signed)


def even_levels(low, high, count, outside=False):
    """Equally spaced round levels between two values, or around them."""
    step = round_up((high - low) / count)
    first, last = numpy.floor([low / step + 1e-9, high / step + 1e-9])
    if outside:
        last = numpy.ceil(high / step - 1e-9)
    else:
        first = numpy.ceil(low / step - 1e-9)
    return step * (numpy.arange(first, last + 1) + 0.0)


def range_without_peaks(values, areas, share):
    """Values between which a field lies on all of the body except that share at either
    end: at a crack tip the stress has no bound."""
    order = values.argsort()
    part = areas[order].cumsum()
    return values[order][numpy.searchsorted(part, part[-1] * numpy.array(
        [share, 1 - share]))]


def choose_levels(values, areas, scale):
    """Levels of a field; None if its values differ by rounding of the scale only."""
    least, largest = values.min(), values.max()
    if largest - least <= 1e-6 * scale:
        return numpy.array([])
    low, high = range_without_peaks(values, areas, 0.03)
    if high - low <= 1e-6 * (largest - least):
        low, high = least, largest
    levels = even_levels(low, high, 14)
    return levels[(levels > least) & (levels < largest)]


def level_colours(levels):
    """Pale colours for the bands between levels and beyond them: blue where negative,
    orange where positive, white about zero."""
    bounds = numpy.concatenate([[-numpy.inf], levels, [numpy.inf]])
    middle = (bounds[1:] + bounds[:-1]) / 2
    middle[0] = numpy.nextafter(levels[0], -numpy.inf)  # below 0 if that is 0
    middle[-1] = levels[-1]
    below = LinearSegmentedColormap.from_list("", ["#f3f8fc", "#7fb5da"])
    above = LinearSegmentedColormap.from_list("", ["#fef8f1", "#f0a35e"])
    negative = int((middle < 0).sum())
    depth = (numpy.arange(len(middle)) - negative + (middle >= 0)) / max(
        negative, len(middle) - negative)
    return [below(-d) if d < 0 else above(d) for d in depth]


def draw_level_curves(axes, fields, values, scale, magnify, quantity):
    """Draws labelled level curves over pale bands on the deformed body, and a bar that
    names all levels."""
    triangles, carry = fields.triangulation()
    place = deformed(fields, magnify)
    body = Triangulation(carry(place[:, 0]), carry(place[:, 1]), triangles)
    z = carry(values)
    levels = choose_levels(values, fields.areas(), scale)
    if len(levels) > 1:
        ground = axes.tricontourf(body, z, levels, extend="both",
                                  colors=level_colours(levels))
        bar = axes.figure.colorbar(ground, ax=axes, orientation="horizontal",
                                   spacing="uniform", ticks=levels, aspect=45,
                                   shrink=0.92, pad=0.02,
                                   label=quantity)
        names = [signed(level, 3) for level in levels]
        crowded = sum(map(len, names)) > 45
        bar.ax.set_xticklabels(names, fontsize=7, rotation=90 if crowded else 0)
        bar.outline.set_linewidth(0.5)
    if len(levels):
        lines = axes.tricontour(body, z, levels=levels, colors=INK,
                                linewidths=0.7, linestyles="solid")
    draw_outline(axes, fields, magnify)
    finish_body(axes, fields.points, place)
    if len(levels):
        label_levels(axes, lines)


def label_levels(axes, lines):
    """Puts a label on each line where there is room for it."""
    labels = lines.clabel(fmt=signed, fontsize=7.5, inline=False, colors=INK)
    axes.figure.canvas.draw()
    taken = []
    for label in sorted(labels, key=lambda text: len(text.get_text())):
        label.set_path_effects(HALO)
        box = label.get_window_extent().padded(1.5)
        if any(box.overlaps(other) for other in taken):
            label.remove()
        else:
            taken.append(box)
