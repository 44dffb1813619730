# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""What is seen of a body: all quadrilaterals of a plane one, the boundary of one in
space, and which of their edges are drawn."""

import itertools

import numpy

# Faces of a hexahedron in VTK's order of its corners, seen from outside.
FACES = numpy.array([[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5],
                     [2, 3, 7, 6], [3, 0, 4, 7]])
CELL_EDGE, OUTLINE = 1, 16  # times 2^k for edge k of a quadrilateral
SHARP = 2 * numpy.cos(numpy.radians(20))  # |sum of two normals| 40 degrees apart
MULTIPLIERS = numpy.random.default_rng(1980).integers(1 << 62, size=8) | 1


def mixed(rows):
    """A hash of each row, the same for equal rows alone (but once in 2^64). The shift
    prevents equal hashes of hashes: without it sums of products would commute."""
    sums = rows @ MULTIPLIERS[:rows.shape[1]]
    return (sums ^ (sums >> 29)) * MULTIPLIERS[-1]


def groups(rows):
    """The group number of each row (equal rows are a group); the groups' sizes."""
    _, group, count = numpy.unique(mixed(rows), return_inverse=True,
                                   return_counts=True)
    return group, count


class Skin:
    """Points of a file that are seen, and quadrilaterals between them."""

    def __init__(self, points, cells, parts):
        """The skin of a file in which each cell was written in so many parts; of
        quadrilaterals in space all are seen."""
        self.quads, self.side = cells, numpy.arange(len(cells)) // parts
        if cells.shape[1] == 8:
            self.quads = cells[:, FACES].reshape(-1, 4)
            self.side = (6 * self.side[:, None] + numpy.arange(6)).ravel()
            group, count = groups(numpy.sort(self.quads, axis=1))
            self.select(count[group] == 1)
        self.kept, quads = numpy.unique(self.quads, return_inverse=True)
        self.quads = quads.reshape(-1, 4)
        self.points = points[self.kept]
        # Files have seven digits; irrational to the coordinates.
        self.grid = 4e-7 * numpy.pi * numpy.ptp(self.points, axis=0).max()
        self.place = mixed(self.boxes(self.points))

    def select(self, wanted):
        self.quads, self.side = self.quads[wanted], self.side[wanted]

    def boxes(self, points):
        return numpy.floor(points / self.grid).astype(numpy.int64)

    def finish(self, displacements):
        """Removes faces between processes and materials, at which a file has
        several points of one node: they are at one place and move alike at all
        instants. Returns the points and the marks of the edges."""
        node = self.place.copy()
        unit = 1e-4 * numpy.pi * (max(abs(u).max() for u in displacements) or 1)
        for k, u in enumerate(displacements):
            node += (2 * k + 1) * mixed(numpy.rint(u / unit).astype(numpy.int64))
        if self.points.shape[1] == 3:
            group, count = groups(numpy.sort(node[self.quads], axis=1))
            single = numpy.flatnonzero(count[group] == 1)
            self.select(single[~self.is_inside(self.quads[single])])
        used, quads = numpy.unique(self.quads, return_inverse=True)
        marks = self.mark_edges(node)
        self.quads, self.points = quads.reshape(-1, 4), self.points[used]
        return used, marks

    def is_inside(self, facets):
        """Whether edges or faces with cells on one side adjoin cells of another size. A
        large cell has a point at its centre, and small ones reach from there to its
        corners."""
        middle = self.points[facets].mean(axis=1)
        centre = numpy.zeros(len(facets), numpy.int64)
        large = numpy.zeros(len(facets), bool)
        for shift in itertools.product((-.25, .25), repeat=middle.shape[1]):
            found = mixed(self.boxes(middle + numpy.array(shift) * self.grid))
            hit = numpy.isin(found, self.place)
            centre[hit], large[hit] = found[hit], True
        corners = self.place[facets]
        spokes = numpy.stack([centre[large, None].repeat(facets.shape[1], 1),
                              corners[large]], -1).reshape(-1, 2)
        spokes, inside = mixed(spokes), large
        for i, j in itertools.permutations(range(facets.shape[1]), 2):
            inside = inside | numpy.isin(mixed(corners[:, [i, j]]), spokes)
        return inside

    def mark_edges(self, node):
        """A byte for each quadrilateral: which of its edges are edges of a cell, and
        which are in the outline of the body or sharp."""
        ends = numpy.stack([self.quads, numpy.roll(self.quads, -1, 1)], -1)
        ends = ends.reshape(-1, 2)
        sorted_ends = numpy.sort(node[ends], axis=1)
        side = self.side.repeat(4)[:, None]
        group, count = groups(numpy.hstack([sorted_ends, side]))
        of_cell = count[group] == 1
        group, count = groups(sorted_ends)
        outline = count[group] == 1
        single = numpy.flatnonzero(outline)
        outline[single[self.is_inside(ends[single])]] = False
        if self.points.shape[1] == 3:
            sums = numpy.stack([numpy.bincount(group, column.repeat(4))
                                for column in self.normals().T], 1)
            outline |= ((count == 2)
                        & (numpy.linalg.norm(sums, axis=1) < SHARP))[group]
        bits = (CELL_EDGE * of_cell + OUTLINE * outline).reshape(-1, 4)
        return (bits << numpy.arange(4)).sum(axis=1).astype(numpy.uint8)

    def normals(self):
        a, b, c, d = self.points[self.quads.T]
        normals = numpy.cross(c - a, d - b)
        return normals / numpy.linalg.norm(normals, axis=1, keepdims=True)
