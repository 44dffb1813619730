# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""A mesh with named groups, between the file that it comes from and the Gmsh file that
the program reads."""

import collections

import numpy


class Mistake(Exception):
    """A mistake in a file: the message has its place, and what to do."""


# Kinds of elements by dimension and number of nodes, which are ordered as in VTK:
# number of corners, Gmsh's number of the kind, and Gmsh's order of the nodes.
Kind = collections.namedtuple("Kind", "corners, gmsh, order")
WEDGE = [*range(7), 8, 12, 7, 13, 14, 9, 11, 10]
BRICK = [*range(9), 11, 16, 9, 17, 10, 18, 19, 12, 15, 13, 14]
KINDS = {(1, 2): Kind(2, 1, range(2)), (1, 3): Kind(2, 8, range(3)),
         (2, 3): Kind(3, 2, range(3)), (2, 6): Kind(3, 9, range(6)),
         (2, 4): Kind(4, 3, range(4)), (2, 8): Kind(4, 16, range(8)),
         (3, 4): Kind(4, 4, range(4)), (3, 10): Kind(4, 11, [*range(8), 9, 8]),
         (3, 5): Kind(5, 7, range(5)),
         (3, 6): Kind(6, 6, range(6)), (3, 15): Kind(6, 18, WEDGE),
         (3, 8): Kind(8, 5, range(8)), (3, 20): Kind(8, 17, BRICK)}
# With nodes in faces and in the interior, which are left out.
KINDS |= {(2, 7): KINDS[2, 6], (2, 9): KINDS[2, 8], (3, 13): KINDS[3, 5],
          (3, 14): KINDS[3, 10], (3, 18): KINDS[3, 15], (3, 27): KINDS[3, 20]}
NOUNS = {(1, 2): "lines", (2, 3): "triangles", (2, 4): "quadrilaterals",
         (3, 4): "tetrahedra", (3, 5): "pyramids", (3, 6): "wedges",
         (3, 8): "hexahedra"}
# Corners of the faces of a cell, in Abaqus's order of the faces.
FACES = {(2, 3): ((0, 1), (1, 2), (2, 0)),
         (2, 4): ((0, 1), (1, 2), (2, 3), (3, 0)),
         (3, 4): ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)),
         (3, 5): ((0, 1, 2, 3), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)),
         (3, 6): ((0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)),
         (3, 8): ((0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3),
                  (3, 7, 4, 0))}


class Mesh:
    """What a file contains: points, elements, and groups of elements, of faces and of
    nodes by their names. Elements are counted over all blocks."""

    def __init__(self, points):
        self.points = numpy.zeros((len(points), 3))
        if len(points):
            self.points[:, :numpy.shape(points)[1]] = points
        self.blocks = []  # dimension, kind, nodes
        self.n_elements = 0
        self.elements = collections.defaultdict(list)  # indices
        self.faces = collections.defaultdict(list)  # element, number of the face
        self.nodes = collections.defaultdict(list)  # indices
        self.numbers = {}  # of groups
        self.notes = []  # what was left out

    def add(self, dimension, nodes, what):
        """Appends elements with these nodes; returns their indices."""
        nodes = numpy.asarray(nodes, dtype=int)
        kind = KINDS.get((dimension, nodes.shape[1]))
        if kind is None:
            raise Mistake(f"{what} has {nodes.shape[1]} nodes; allowed are lines, "
                          "triangles, quadrilaterals, tetrahedra, wedges and hexahedra "
                          "of first or second order")
        if nodes.min(initial=0) < 0 or nodes.max(initial=0) >= len(self.points):
            raise Mistake(f"{what} has a node that the file does not contain")
        self.blocks.append((dimension, kind, nodes))
        first, self.n_elements = self.n_elements, self.n_elements + len(nodes)
        return range(first, self.n_elements)

    @property
    def dimension(self):
        return max((dimension for dimension, _, nodes in self.blocks if len(nodes)),
                   default=0)


class Body:
    """The body that a mesh describes: its cells, those of its faces that have a name or
    are elements, and the groups of both by their numbers."""

    def __init__(self, mesh):
        self.mesh = mesh
        self.dimension = mesh.dimension
        if self.dimension < 2:
            raise Mistake("there are no cells of a plane or space")
        self.cells, self.elements = {}, {}  # corners by index: cells, boundary
        self.count = collections.Counter()
        first = 0
        for dimension, kind, nodes in mesh.blocks:
            self.count[dimension, kind.corners] += len(nodes)
            corners = dict(enumerate(nodes[:, :kind.corners].tolist(), first))
            first += len(nodes)
            if dimension >= self.dimension - 1:
                (self.cells if dimension == self.dimension
                 else self.elements).update(corners)
        self.numbers = {True: {}, False: {}}  # by name: of cells, of faces
        self.groups_of_cell = collections.defaultdict(set)
        self.groups_of_face = collections.defaultdict(set)  # by the sorted corners
        self.faces = {}  # corners, by the sorted corners
        self.find_faces_of_cells()
        self.name_elements()
        self.name_faces()

    def find_faces_of_cells(self):
        """Finds all faces, and those of one cell alone: corners, by the sorted
        corners."""
        self.all_faces, inner = {}, set()
        for cell in self.cells:
            for face in self.faces_of(cell):
                key = tuple(sorted(face))
                if self.all_faces.setdefault(key, face) is not face:
                    inner.add(key)
        self.surface = {key: face for key, face in self.all_faces.items()
                        if key not in inner}

    def name_elements(self):
        alone = sum(tuple(sorted(corners)) not in self.all_faces
                    for corners in self.elements.values())
        if alone:
            self.mesh.notes.append(f"{alone} elements of the boundary that are no face "
                                   "of a cell")
        for corners in self.elements.values():
            self.add_face(corners)
        for name, elements in self.mesh.elements.items():
            for element in elements:
                if element in self.cells:
                    self.groups_of_cell[element].add(self.number(name, True))
                elif element in self.elements:
                    self.add_face(self.elements[element], name)

    def name_faces(self):
        """Names faces of cells; shells have one face, which is all of them. Without the
        number of a face all faces on the surface are meant. A set of nodes names the
        faces of the surface between them, unless there are others of its name."""
        for name, faces in self.mesh.faces.items():
            for element, number in faces:
                if element in self.elements:
                    self.add_face(self.elements[element], name)
                elif element not in self.cells:
                    continue
                elif number is None:
                    for face in self.faces_of(element):
                        if tuple(sorted(face)) in self.surface:
                            self.add_face(face, name)
                elif number >= len(self.faces_of(element)):
                    raise Mistake(f"surface {name}: a cell has no face {number + 1}")
                else:
                    self.add_face(self.faces_of(element)[number], name)
        others = {*self.numbers[False]}
        for name, nodes in self.mesh.nodes.items():
            nodes = {*map(int, nodes)}
            if name in others or not nodes:
                continue
            faces = [face for face in self.surface if nodes.issuperset(face)]
            for face in faces:
                self.add_face(self.surface[face], name)
            if not faces:
                self.mesh.notes.append(
                    f"set of nodes {name} ({len(nodes)} in {self.box(nodes)}), which "
                    "has no face; [Boundary] Fixed points takes coordinates")

    def number(self, name, is_of_cells):
        """The number of a group: that of the file, if no other has it."""
        numbers = self.numbers[is_of_cells]
        if name not in numbers:
            number = self.mesh.numbers.get(name, 0)
            taken = {*numbers.values()}
            if number < 1 or number in taken:
                number = max(taken | {*self.mesh.numbers.values()}, default=0) + 1
            numbers[name] = max(number, 1)
        return numbers[name]

    def faces_of(self, cell):
        corners = self.cells[cell]
        return [[corners[i] for i in face]
                for face in FACES[self.dimension, len(corners)]]

    def add_face(self, corners, name=None):
        key = tuple(sorted(corners))
        if key not in self.all_faces:
            return
        self.faces.setdefault(key, corners)
        if name is not None:
            self.groups_of_face[key].add(self.number(name, False))

    def box(self, nodes):
        """The smallest box with these nodes, as text: "(0, 0) to (1, 2)"."""
        size = numpy.ptp(self.mesh.points, axis=0).max()
        points = self.mesh.points[[*nodes], :self.dimension]
        ends = ["(" + ", ".join(f"{0 if abs(x) < 1e-9 * size else x:.6g}"
                                for x in corner) + ")"
                for corner in (points.min(0), points.max(0))]
        return " to ".join(ends) if ends[0] != ends[1] else ends[0]


def write(body, path):
    """Writes a Gmsh file of format 4.1. Elements that are in the same groups form one
    entity."""
    entities = {dimension: collections.defaultdict(list)
                for dimension in (body.dimension - 1, body.dimension)}
    for face, corners in body.faces.items():
        entities[body.dimension - 1][frozenset(body.groups_of_face[face])].append(
            (KINDS[body.dimension - 1, len(corners)], corners))
    first = 0
    for dimension, kind, nodes in body.mesh.blocks:
        if dimension == body.dimension:
            for index, row in enumerate(nodes[:, kind.order].tolist(), first):
                entities[dimension][frozenset(body.groups_of_cell[index])].append(
                    (kind, row))
        first += len(nodes)
    with open(path, "w", encoding="utf-8") as file:
        write_head(file, body, entities)
        n = len(body.mesh.points)
        file.write(f"$Nodes\n1 {n} 1 {n}\n{body.dimension} 1 0 {n}\n")
        file.writelines(f"{i}\n" for i in range(1, n + 1))
        file.writelines("%.17g %.17g %.17g\n" % (*point,)
                        for point in body.mesh.points.tolist())
        file.write("$EndNodes\n")
        write_elements(file, entities)


def write_head(file, body, entities):
    file.write("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n"
               f"{sum(map(len, body.numbers.values()))}\n")
    for is_of_cells, numbers in body.numbers.items():
        for name, number in numbers.items():
            name = name.replace('"', "'")
            file.write(f'{body.dimension - 1 + is_of_cells} {number} "{name}"\n')
    low, high = (" ".join(map(repr, corner.tolist())) for corner in (
        body.mesh.points.min(0), body.mesh.points.max(0)))
    counts = [len(entities.get(dimension, ())) for dimension in range(4)]
    file.write("$EndPhysicalNames\n$Entities\n" + " ".join(map(str, counts)) + "\n")
    for groups in entities.values():
        for tag, group in enumerate(groups, 1):
            file.write(f"{tag} {low} {high} {len(group)} "
                       + "".join(f"{number} " for number in sorted(group)) + "0\n")
    file.write("$EndEntities\n")


def write_elements(file, entities):
    blocks = {}
    for dimension, groups in entities.items():
        for tag, members in enumerate(groups.values(), 1):
            for kind, nodes in members:
                blocks.setdefault((dimension, tag, kind.gmsh), []).append(nodes)
    n = sum(map(len, blocks.values()))
    file.write(f"$Elements\n{len(blocks)} {n} 1 {n}\n")
    number = 0
    for key, members in blocks.items():
        file.write("{} {} {} {}\n".format(*key, len(members)))
        for nodes in members:
            number += 1
            file.write(f"{number} " + " ".join(str(node + 1) for node in nodes) + "\n")
    file.write("$EndElements\n")
