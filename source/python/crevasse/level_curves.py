# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Labelled level curves on a deformed body."""

import numpy
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.tri import Triangulation

from crevasse.plotting import (HALO, INK, deformed, draw_outline, finish_body, ladder,
                               round_up, signed)


def choose_levels(values, scale, count=14):
    """Round levels: equally spaced over most of the values, wider apart in the
    peaks; 1-2-3-5 where a field without sign covers several orders. None where
    the values differ by rounding alone, measured by the scale."""
    low, high = numpy.quantile(values, [0.03, 0.97])
    least, largest = values.min(), values.max()
    if largest - least <= 1e-6 * scale:
        return numpy.array([])
    if least >= 0 and largest > 10 * numpy.median(values):
        return numpy.array(ladder(max(low, 1e-4 * largest), largest,
                                  (1, 2, 3, 5)))
    if high - low <= 1e-6 * (largest - least):
        low, high = least, largest
    step = round_up((high - low) / count)
    levels = step * numpy.arange(numpy.ceil(low / step - 1e-9),
                                 numpy.floor(high / step + 1e-9) + 1)
    peaks = (1, 1.5, 2, 3, 4, 5, 6, 8)
    for sign, end in ((1, largest), (-1, -least)):
        last = max(sign * levels[-1 if sign > 0 else 0], step)
        for level in ladder(last, max(end, last), peaks):
            if level >= last + step * (1 - 1e-9) and level >= 1.25 * last:
                levels = numpy.append(levels, sign * level)
                last = level
    levels = numpy.unique(numpy.round(levels / step, 6) + 0.0) * step
    return levels[(levels > least) & (levels < largest)]


def level_colours(levels):
    """Pale colours for the bands between levels and beyond them: blue where
    negative, orange where positive, white about zero."""
    bounds = numpy.concatenate([[-numpy.inf], levels, [numpy.inf]])
    middle = (bounds[1:] + bounds[:-1]) / 2
    middle[0] = numpy.nextafter(levels[0], -numpy.inf)  # below 0 if that is 0
    middle[-1] = levels[-1]
    below = LinearSegmentedColormap.from_list("", ["#f3f8fc", "#7fb5da"])
    above = LinearSegmentedColormap.from_list("", ["#fef8f1", "#f0a35e"])
    negative = int((middle < 0).sum())
    positive = len(middle) - negative
    return ([below(1 - i / max(negative, 1)) for i in range(negative)] +
            [above((i + 1) / max(positive, 1)) for i in range(positive)])


def draw_level_curves(axes, fields, values, scale, magnify, quantity):
    """Labelled level curves over a pale ground on the deformed body, and a bar
    that names all levels: in the peaks they are wider apart."""
    triangles, carry = fields.triangulation()
    place = deformed(fields, magnify)
    body = Triangulation(carry(place[:, 0]), carry(place[:, 1]), triangles)
    z = carry(values)
    levels = choose_levels(values, scale)
    if len(levels) > 1:
        ground = axes.tricontourf(body, z, levels, extend="both",
                                  colors=level_colours(levels))
        bar = axes.figure.colorbar(ground, ax=axes, orientation="horizontal",
                                   spacing="uniform", ticks=levels, aspect=45,
                                   shrink=0.92, pad=0.02,
                                   label=quantity + spacing(levels))
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


def spacing(levels):
    steps = numpy.diff(levels)
    return ("" if steps.max() <= 1.001 * steps.min() else
            "; non-uniform levels")


def label_levels(axes, lines):
    """A label on each line where there is room for it."""
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
