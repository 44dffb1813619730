# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The body through which a crack grows: its border, holes, and the tips of its cracks,
from the geometry that is meshed; meshes of it with the crack as far as it has grown."""

import math

import numpy
from numpy.linalg import norm
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from crevasse.command import CommandError
from crevasse.life_growth import index_of_tip
from crevasse.mesh_geo import by_gmsh, mesh_in
from crevasse.mesh_parts import Mistake
from crevasse.results import shortest

FINER = 0.2  # size of the border's segments, of the mesh size of the geometry
TOUCHES = 1e-9  # of the size of the body


def of_geometry(work, *arguments, **options):
    """What work() makes of a geometry, or a message that Gmsh cannot."""
    try:
        return work(*arguments, **options)
    except Mistake as mistake:
        raise CommandError(f"[Geometry] Mesh file = {mistake}.", 2) from None


def survey(gmsh, source, cracks):
    """Segments of all curves, and the tips of the cracks with these names or numbers."""
    model = gmsh.model
    gmsh.open(source)
    if model.getDimension() != 2:
        raise ValueError("a path needs a body in the plane")
    groups = [tag for _, tag in model.getPhysicalGroups(1)
              if {str(tag), model.getPhysicalName(1, tag)} & {*cracks}]
    own = {curve: group for group in groups
           for curve in model.getEntitiesForPhysicalGroup(1, group)}
    gmsh.option.setNumber("Mesh.MeshSizeFactor",
                          FINER * gmsh.option.getNumber("Mesh.MeshSizeFactor"))
    model.mesh.generate(1)
    tags, points, _ = model.mesh.getNodes()
    place = {tag: k for k, tag in enumerate(tags)}
    lines = []  # nodes, surfaces on both sides, group of a crack
    ends = {}
    for _, curve in model.getEntities(1):
        surfaces, vertices = model.getAdjacencies(1, curve)
        if curve in own:
            surfaces = []  # which OpenCASCADE gives to curves within them, too
        kinds, _, nodes = model.mesh.getElements(1, curve)
        for kind, row in zip(kinds, nodes):
            rows = row.reshape(-1, model.mesh.getElementProperties(kind)[3])[:, :2]
            lines += [(place[one], place[other], [*map(int, surfaces)], own.get(curve))
                      for one, other in rows.tolist()]
        for vertex in vertices:
            ends.setdefault(int(vertex), []).append(curve)
    within = {curve: surface for _, surface in model.getEntities(2)
              for kind, curve in model.mesh.getEmbedded(2, surface) if kind == 1}
    tips = [(int(vertex), [*model.getValue(0, int(vertex), [])[:2]], own[curves[0]],
             within[curves[0]]) for vertex, curves in ends.items()
            if len(curves) == 1 and {*curves} <= {*own} & {*within}]
    return points.reshape(-1, 3)[:, :2].tolist(), lines, tips


def nearest(point, begins, ends):
    """Distances from a point to segments, and the nearest points of these."""
    along = ends - begins
    part = numpy.clip(((point - begins) * along).sum(axis=1) / (along**2).sum(axis=1), 0, 1)
    places = begins + part[:, None] * along
    return norm(places - point, axis=1), places


class Body:
    def __init__(self, source, trusted, cracks, tip):
        self.source, self.trusted = source, trusted
        points, lines, tips = of_geometry(by_gmsh, survey, source, trusted, cracks)
        if not tips:
            raise CommandError(
                f"{source}: there is no tip, where a curve of the crack ends within the "
                "body. Give the first crack as a curve, Curve{7} In Surface{1}; "
                "Physical Curve(\"crack\") = {7};, and name it in [Boundary] Crack or "
                "Open crack.", 2)
        points = numpy.array(points)
        self.size = numpy.ptp(points, axis=0).max()
        outline = points[[line[:2] for line in lines if line[2]]]
        for _, (x, y), *_ in tips:
            if nearest([x, y], *outline.swapaxes(0, 1))[0].min() < TOUCHES * self.size:
                raise CommandError(
                    f"{source}: the crack begins at ({shortest(x)}, {shortest(y)}) on a "
                    "border that has no point there, and would stay closed there. Let the "
                    "border have this point, as the end of two of its curves.", 2)
        index = index_of_tip([place for _, place, *_ in tips], tip)
        self.vertex, place, self.group, self.surface = tips[index]
        self.tip = numpy.array(place)
        border = [line for line in lines if line[2] or line[3] not in (None, self.group)]
        nodes = numpy.array([line[:2] for line in border])
        self.begins, self.ends = points[nodes[:, 0]], points[nodes[:, 1]]
        own = points[[line[:2] for line in lines if line[3] == self.group]]
        self.crack, self.length = own, norm(own[:, 1] - own[:, 0], axis=1).sum()
        graph = coo_matrix((numpy.ones(len(nodes)), nodes.T), [len(points)] * 2)
        self.part = connected_components(graph, directed=False)[1][nodes[:, 0]]
        self.kind = ["crack" if not line[2] else "border" if len(line[2]) == 1
                     else "interface" for line in border]

    def gap(self, point):
        """Distance from a point to the nearest border, hole or other crack; its name."""
        distances, places = nearest(point, self.begins, self.ends)
        k = distances.argmin()
        return distances[k], self.name(k, places[k])

    def ahead(self, point, direction):
        """Distance from a point to the border in a direction, and what is there."""
        x, y = direction
        def turned(points):  # with the direction as first axis
            return (points - point) @ numpy.array([[x, -y], [y, x]])
        begins, ends = turned(self.begins), turned(self.ends)
        crosses = (begins[:, 1] > 0) != (ends[:, 1] > 0)
        with numpy.errstate(divide="ignore", invalid="ignore"):
            where = begins[:, 0] - begins[:, 1] * (ends[:, 0] - begins[:, 0]) / (
                ends[:, 1] - begins[:, 1])
        where[~crosses | (where < 0)] = math.inf
        k = where.argmin()
        return where[k], self.name(k, point + min(where[k], 2 * self.size) * direction)

    def name(self, k, point):
        """The name of what segment k belongs to: "hole at (6, 4.75)"."""
        own = self.part == self.part[k]
        low, high = self.begins[own].min(axis=0), self.begins[own].max(axis=0)
        outer = numpy.ptp(self.begins, axis=0) - (high - low) < TOUCHES * self.size
        kind = self.kind[k]
        if kind == "border" and not outer.all():
            kind, point = "hole", (low + high) / 2
        x, y = (f"{0 if abs(x) < TOUCHES * self.size else x:.4g}" for x in point)
        return f"{kind} at ({x}, {y})"

    def outlines(self):
        """Border and first crack as polylines [[x, y], ...], for pictures."""
        lines = []
        for begin, end in [*zip(self.begins.tolist(), self.ends.tolist()),
                           *self.crack.tolist()]:
            if not lines or lines[-1][-1] != begin:
                lines.append([begin])
            lines[-1].append(end)
        return lines

    def mesh(self, folder, name, points, step, factor):
        """Meshes the body with the crack grown along points, the first of which is the
        tip; returns the path of the mesh."""
        lengths = norm(numpy.diff(points, axis=0), axis=1)
        size = [*map(shortest, [*lengths, step / 2])]
        text = f"MeshSize{{{self.vertex}}} = {size[0]};\np0 = {self.vertex};\n"
        for k, (x, y) in enumerate(points[1:], 1):
            text += (f"p{k} = newp; Point(p{k}) = {{{float(x)!r}, {float(y)!r}, 0, "
                     f"{size[k]}}};\n"
                     f"l{k} = newl; Line(l{k}) = {{p{k - 1}, p{k}}};\n"
                     f"Curve{{l{k}}} In Surface{{{self.surface}}};\n")
        return of_geometry(mesh_in, folder, name, self.source, self.trusted, text,
                           self.group, factor)
