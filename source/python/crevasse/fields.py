# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Reads the fields of one instant and makes them nodal."""

import collections
import contextlib
import io
import re
import xml.etree.ElementTree as ElementTree

import meshio
import numpy

from crevasse.results import ResultsError, read_xml
from crevasse.skin import CELL_EDGE, OUTLINE, Skin

# Components of the tensors in the file, in its order; in the plane the rest is 0.
# In VTK's order; in the plane the first four.
COMPONENTS = ("11", "22", "33", "12", "23", "13")


class Fields:
    """Nodal fields on a conforming set of nodes: the program writes a point for each
    process and material at a node, here those at the same place become one."""

    def __init__(self, path):
        self.path = path
        points, quads, data = read_pieces(path)
        # The grid of the keys is irrational to the coordinates, so that equal
        # coordinates are not rounded apart.
        self.grid = 1e-7 * numpy.pi * numpy.ptp(points, axis=0).max()
        _, self.node = numpy.unique(self.keys(points), axis=0, return_inverse=True)
        self.node = self.node.ravel()
        self.data = data
        if "displacement" in data:
            self.separate_lips(data["displacement"][:, :2])
        _, self.first = numpy.unique(self.node, return_index=True)
        self.points = points[self.first]
        self.quads = self.node[quads]
        self.corners = quads  # by points of the file

    def separate_lips(self, displacement):
        """A node whose points do not move alike lies on two lips: each gets its
        own."""
        # The file has seven digits.
        rounding = 1e-5 * numpy.abs(displacement).max()
        low, high = (numpy.full((self.node.max() + 1, 2), sign * numpy.inf)
                     for sign in (1, -1))
        numpy.minimum.at(low, self.node, displacement)
        numpy.maximum.at(high, self.node, displacement)
        for torn in numpy.flatnonzero((high - low).max(axis=1) > rounding):
            lip = numpy.flatnonzero(self.node == torn)
            while lip.size:
                apart = numpy.abs(displacement[lip] - displacement[lip[0]])
                lip = lip[apart.max(axis=1) > rounding]
                self.node[lip] = self.node.max() + 1

    def keys(self, points):
        return numpy.round(points / self.grid).astype(numpy.int64)

    def __getitem__(self, name):
        """The field of this name: at each node the mean over its points."""
        values = self.array(name)
        count = numpy.bincount(self.node)
        if values.ndim == 1:
            return numpy.bincount(self.node, values) / count
        return numpy.stack([numpy.bincount(self.node, column) / count
                            for column in values[:, :2].T], axis=1)

    def direction(self, name):
        """Unit directions without sign: at each node the mean over its points."""
        values = self.array(name)[:, :2]
        turned = (values * values[self.first][self.node]).sum(axis=1) < 0
        values = numpy.where(turned[:, None], -values, values)
        sums = numpy.stack([numpy.bincount(self.node, column)
                            for column in values.T], axis=1)
        length = numpy.linalg.norm(sums, axis=1, keepdims=True)
        return sums / numpy.where(length > 0, length, 1)

    def array(self, name):
        if name not in self.data:
            raise ResultsError(f"{self.path}: there is no array {name}. Arrays: "
                               f"{', '.join(sorted(self.data)) or 'none'}.")
        if not numpy.isfinite(self.data[name]).all():
            raise ResultsError(f"{self.path}: {name} is beyond the range of numbers of "
                               "four bytes.")
        return self.data[name]

    def triangulation(self, wanted=20000):
        """Triangles that follow the bilinear fields on about so many parts of
        the quadrilaterals, and the function that carries nodal values over."""
        n = int(numpy.clip((wanted / len(self.quads)) ** 0.5, 1, 16))
        y, x = (numpy.mgrid[:n + 1, :n + 1] / n).reshape(2, -1)
        weights = numpy.stack([(1 - x) * (1 - y), x * (1 - y), x * y,
                               (1 - x) * y])

        def spread(values):
            return numpy.moveaxis(values[self.quads], 1, -1) @ weights

        def of_parts(values):
            return numpy.moveaxis(spread(values), 1, -1).reshape(-1, 2)

        places = of_parts(self.points)
        keys = [self.keys(places)]
        if "displacement" in self.data:  # that of lips which are apart differs
            moved = of_parts(self["displacement"])
            unit = 1e-4 * numpy.pi * (numpy.abs(moved).max() or 1.)
            keys.append(numpy.round(moved / unit).astype(numpy.int64))
        _, first, node = numpy.unique(numpy.hstack(keys), axis=0,
                                      return_index=True, return_inverse=True)
        node = node.reshape(len(self.quads), n + 1, n + 1)
        a, b, c, d = (node[:, :-1, :-1].ravel(), node[:, :-1, 1:].ravel(),
                      node[:, 1:, 1:].ravel(), node[:, 1:, :-1].ravel())
        split = numpy.concatenate([numpy.stack([a, b, c], 1),
                                   numpy.stack([a, c, d], 1)])
        order = numpy.sort(split, axis=1)
        split = split[(numpy.diff(order, axis=1) > 0).all(axis=1)]
        return split, lambda values: spread(values).reshape(-1)[first]

    def cell_edges(self, parts=1):
        """Edges of the cells, each of which has that many quadrilaterals."""
        return self.marked_edges(CELL_EDGE, 1 if len(self.quads) % parts else parts)

    def outline(self):
        """Edges of the outline of the body."""
        return self.marked_edges(OUTLINE)

    def marked_edges(self, mark, parts=1):
        skin = Skin(self.points[self.node], self.corners, parts)
        marks = skin.mark_edges(self.node[skin.kept])
        ends = numpy.stack([self.quads, numpy.roll(self.quads, -1, 1)], -1)
        marked = marks[:, None] // mark >> numpy.arange(4) & 1 == 1
        return numpy.unique(numpy.sort(ends[marked], axis=1), axis=0)

    def lip(self):
        """Ends of edges that contact forces act on; on an open lip forces of the size
        of rounding. The two lips of a crack have different points."""
        edges = numpy.stack([self.corners, numpy.roll(self.corners, -1, 1)], -1)
        edges, count = numpy.unique(numpy.sort(edges, -1).reshape(-1, 2), axis=0,
                                    return_counts=True)
        on_lip = (self.array("contact_pressure")[edges] != 0).all(axis=1)
        return self.node[edges[on_lip & (count == 1)]]

    def areas(self):
        """Each node's share of the area."""
        return node_areas(self.points, self.quads)


def node_areas(points, quads):
    """Area of each node: a quarter of each quadrilateral around a point."""
    points = numpy.pad(points, ((0, 0), (0, 3 - points.shape[1])))
    a, b, c, d = (points[corner] for corner in quads.T)
    area = numpy.linalg.norm(numpy.cross(c - a, d - b), axis=1) / 8
    return numpy.bincount(quads.ravel(), area.repeat(4), len(points))


def read_pieces(path, dimension=2):
    """Points, quadrilaterals or hexahedra, and point data of a .vtu file or of all
    pieces of a .pvtu file."""
    kind = {2: "quad", 3: "hexahedron"}[dimension]
    mesh = read_whole(path)
    for block in mesh.cells:
        if block.type != kind:
            raise ResultsError(f"{path}: has cells of type {block.type} instead of "
                               f"{kind}.")
    return mesh.points[:, :dimension], mesh.cells[0].data, mesh.point_data


def read_whole(path):
    """The mesh of a .vtu, or of all processes in a .pvtu; a tensor "stress" as
    "stress_11" and so on, and the materials of cells as "material" of their points,
    if there are several."""
    files = [path]
    if path.suffix == ".pvtu":
        files = [path.parent / piece.get("Source")
                 for piece in read_xml(path).iter("Piece")]
    points, shift = [], 0
    cells, data = collections.defaultdict(list), collections.defaultdict(list)
    for mesh in filter(None, map(read_mesh, files)):
        for block in mesh.cells:
            cells[block.type].append(block.data.astype(numpy.int64) + shift)
        points.append(mesh.points.astype(float))
        for name, values in mesh.point_data.items():
            if values.shape[1:] == (6,):
                n = 6 if mesh.cells[0].type == "hexahedron" else 4
                for component, column in zip(COMPONENTS[:n], values.T):
                    data[f"{name}_{component}"].append(column.astype(float))
            else:
                data[name].append(values.astype(float))
        ids = numpy.zeros(len(mesh.points))
        for block, of_cells in zip(mesh.cells, mesh.cell_data.get("material_id", ())):
            ids[block.data] = of_cells[:, None]
        data["material"].append(ids)
        shift += len(mesh.points)
    if not cells:
        raise ResultsError(f"{path}: has no cells.")
    if len(numpy.unique(numpy.concatenate(data["material"]))) == 1:
        del data["material"]
    return meshio.Mesh(
        numpy.concatenate(points),
        {name: numpy.concatenate(parts) for name, parts in cells.items()},
        {name: numpy.concatenate(parts) for name, parts in data.items()
         if sum(map(len, parts)) == shift})


def read_mesh(path):
    """Reads a .vtu file; None for the file of a process without cells."""
    try:
        with open(path, "rb") as file:
            if re.search(rb'NumberOfCells="0+"', file.read(4096)):
                return None
        with contextlib.redirect_stderr(io.StringIO()):  # says it is damaged, too
            return meshio.read(path)
    except OSError as error:
        raise ResultsError(f"{path}: cannot be read ({error}).") from None
    except (meshio.ReadError, SystemExit, ValueError, KeyError, AssertionError,
            ElementTree.ParseError):
        raise ResultsError(f"{path}: is incomplete or in a form that meshio does "
                           "not read.") from None
