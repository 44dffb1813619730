# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Deformed bodies in colours, without labels: for small pictures."""

from matplotlib.collections import LineCollection
from matplotlib.tri import Triangulation
import numpy

from crevasse.level_curves import range_without_peaks
from crevasse.plotting import INK, deformed, round_up


def even_bands(bound, count=16):
    """Levels between colours: blue where negative, red where positive."""
    return numpy.linspace(-bound, bound, count + 1)


def symmetric_bound(fields, values, share=0.02):
    """A round bound of all values but the largest: at a crack tip they have none."""
    return round_up(range_without_peaks(numpy.abs(values), fields.areas(), share)[1])


def draw_bands(axes, fields, values, levels, magnify, mirrored=False, colours="RdBu_r",
               wanted=20000):
    """With mirrored also the half below the plane y = 0. Returns the bands, for a
    colour bar."""
    triangles, carry = fields.triangulation(wanted)
    place = deformed(fields, magnify)
    edges = place[fields.outline()]
    x, y, z = carry(place[:, 0]), carry(place[:, 1]), carry(values)
    for side in (1, -1) if mirrored else (1,):
        bands = axes.tricontourf(Triangulation(x, side * y, triangles), z,
                                 levels=levels, cmap=colours, extend="both")
        lines = edges * [1, side]
        if mirrored:  # the ligament is no boundary of the whole body
            lines = lines[numpy.abs(lines[:, :, 1]).max(axis=1) > 1e-9]
        axes.add_collection(LineCollection(lines, colors=INK, linewidths=0.9,
                                           capstyle="round"))
    axes.set_aspect("equal")
    axes.axis("off")
    return bands
