# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Input decks for CalculiX: the paper's square with gap elements under its lip, and a
creeping quarter of a tube. doc/figures/compare.py runs them."""

import numpy


class Mesh:
    """The image of n x m squares with elements of degree 1 or 2. In a fan the first
    column is triangles about one node."""

    def __init__(self, n, m, degree, place, fan=False):
        self.cells, nodes, numbers = [], [], {}

        def node(i, j):
            key = (i, j * (i > 0 or not fan))
            if key not in numbers:
                numbers[key] = len(numbers) + 1
                nodes.append(place(*key))
            return numbers[key]

        for i in range(0, 2 * n, 2):
            for j in range(0, 2 * m, 2):
                corners = [(i, j), (i + 2, j), (i + 2, j + 2), (i, j + 2)]
                middles = [(i + 1, j), (i + 2, j + 1), (i + 1, j + 2), (i, j + 1)]
                kept = 3 if fan and i == 0 else 4
                keys = corners[:kept] + middles[:kept] * (degree - 1)
                self.cells.append([node(*key) for key in keys])
        self.x, self.y = numpy.array(nodes).T

    def numbers(self, where):
        return [int(k) + 1 for k in numpy.flatnonzero(where)]

    def faces(self, where):
        """Element, its face, and the nodes of that."""
        for number, cell in enumerate(self.cells, 1):
            n = 3 if len(cell) == 6 else 4
            for face in range(n):
                nodes = [cell[face], cell[(face + 1) % n], *cell[n + face:n + face + 1]]
                if all(where[node - 1] for node in nodes):
                    yield number, face + 1, nodes

    def forces(self, where, traction):
        """Of a traction along x: ∫ φ t at the nodes, by Gauss's rule."""
        forces = numpy.zeros(len(self.x))
        for _, _, nodes in self.faces(where):
            nodes = numpy.array(nodes) - 1
            a, b = self.x[nodes[:2]]
            for s, weight in zip(*numpy.polynomial.legendre.leggauss(4)):
                shapes = ((1 - s) / 2, (1 + s) / 2) if len(nodes) == 2 else (
                    s * (s - 1) / 2, s * (s + 1) / 2, 1 - s * s)
                forces[nodes] += (numpy.array(shapes) * weight * abs(b - a) / 2
                                  * traction((a + b) / 2 + s * (b - a) / 2))
        return forces

    def lines(self, *material):
        """Plane strain."""
        yield "*NODE"
        for k, place in enumerate(zip(self.x, self.y), 1):
            # It reads at most 20 letters of a number.
            yield f"{k}, {place[0]:.12e}, {place[1]:.12e}, 0."
        for size, kind in ((4, "CPE4"), (6, "CPE6"), (8, "CPE8R")):
            yield f"*ELEMENT, TYPE={kind}, ELSET=BODY"
            for k, cell in enumerate(self.cells, 1):
                if len(cell) == size:
                    yield f"{k}, " + ", ".join(map(str, cell))
        yield from ("*MATERIAL, NAME=M", *material,
                    "*SOLID SECTION, ELSET=BODY, MATERIAL=M")


def uniform(n, degree):
    return Mesh(n, n, degree, lambda i, j: (i / (2 * n), j / (2 * n)))


def fan(m):
    """Rings about the tip of the square that grow in proportion, 3 m elements
    each; the first one has its middle nodes at a quarter."""
    def reach(i):
        return ((1 - 1 / m) ** (4 * m - i // 2) * (i > 0) if i % 2 == 0 else
                reach(2) / 4 if i == 1 else (reach(i - 1) + reach(i + 1)) / 2)

    def place(i, j):
        side, s = divmod(j / (2 * m), 1)
        x, y = ((1, s), (1 - s, 1), (0, 1 - s), (0, 0))[int(side)]
        return 0.5 + reach(i) * (x - 0.5), reach(i) * y
    return Mesh(4 * m, 3 * m, 2, place, fan=True)


def gaps(mesh, nodes):
    """Between nodes and the ground. CalculiX iterates on them only where some
    material is not linear: see square_deck()."""
    n_nodes, n_cells = len(mesh.x), len(mesh.cells)
    numbered = list(enumerate(nodes, 1))
    return ["*NODE", *(f"{n_nodes + k}, {mesh.x[node - 1]:.12e}, 0., 0."
                       for k, node in numbered),
            "*ELEMENT, TYPE=GAPUNI, ELSET=LIP",
            *(f"{n_cells + k}, {n_nodes + k}, {node}" for k, node in numbered),
            "*GAP, ELSET=LIP", "0., 0., 1., 0., , 1.e8, 1.e-8",
            "*BOUNDARY", *(f"{n_nodes + k}, 1, 3" for k, _ in numbered)]


def square_deck(mesh, young, poisson, traction, contact):
    """Plane stress by the moduli of plane strain: elements CPS join the layers of
    the thickness and are stiffer. With contact the material yields, far away."""
    bottom = mesh.y < 1e-12
    tip = bottom & (abs(mesh.x - 0.5) < 1e-12)
    lines = list(mesh.lines(
        "*ELASTIC", f"{young * (1 + 2 * poisson) / (1 + poisson)**2!r}, "
        f"{poisson / (1 + poisson)!r}", *["*PLASTIC", "1.e10, 0."] * contact))
    if contact:
        lines += gaps(mesh, mesh.numbers(bottom & (mesh.x > 0.5 + 1e-12)))
    lines += ["*BOUNDARY", f"{mesh.numbers(tip)[0]}, 1, 1",
              *(f"{k}, 2, 2" for k in mesh.numbers(bottom & (mesh.x < 0.5 + 1e-12))),
              "*STEP", "*STATIC", "*CLOAD"]
    forces = mesh.forces(mesh.y > 1 - 1e-12, traction)
    lines += [f"{k}, 2, {force:.12e}" for k, force in enumerate(forces, 1) if force]
    return lines + ["*EL PRINT, ELSET=BODY, TOTALS=ONLY", "ELSE", "*END STEP"]


def tube_deck(mesh, steps):
    """A quarter; the load first without creep."""
    lines = list(mesh.lines("*ELASTIC", "1., 0.3", "*CREEP, LAW=NORTON", "1., 1., 0."))
    lines += ["*BOUNDARY", *(f"{k}, 2, 2" for k in mesh.numbers(mesh.y < 1e-12)),
              *(f"{k}, 1, 1" for k in mesh.numbers(mesh.x < 1e-12)),
              "*NSET, NSET=OUTSIDE", str(mesh.numbers(mesh.x > 2 - 1e-12)[0])]
    inside = numpy.hypot(mesh.x, mesh.y) < 1 + 1e-12
    lines += ["*STEP", "*STATIC", "*DLOAD",
              *(f"{cell}, P{face}, 1.e-3" for cell, face, _ in mesh.faces(inside))]
    shown = ["*NODE PRINT, NSET=OUTSIDE", "U", "*END STEP"]
    return [*lines, *shown, f"*STEP, INC={2 * steps}", "*VISCO, DIRECT, CETOL=1.",
            f"{2 / steps!r}, 2.", *shown]
