"""Mesh files of a quarter of a tube about the origin, with the ids 1 on y = 0, 2
on x = 0, 3 inside, 4 outside (and in space 5 and 6 at the ends), of elements of
first or second order, and Lame's solution for tubes of layers."""

import math
import pathlib

# Of the edges of a hexahedron, in Gmsh's order of the nodes in their middles.
EDGES = {4: ((0, 1), (1, 2), (2, 3), (3, 0)),
         8: ((0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7),
             (4, 5), (4, 7), (5, 6), (6, 7))}


def write(name, n_r, n_phi, order=2, radii=(1., 2.), length=None,
          material=lambda r: 10, move=lambda r, phi: (r, phi), crack=0):
    """Format 2.2. Cells are cut along radii and circles; @p material numbers
    those around a radius; @p move changes the polar coordinates of a node; on
    y = 0 as many cells as @p crack says, from inside, have the id 7."""
    numbers = {}

    def node(key):
        """By twice the indices along r, phi and z."""
        return numbers.setdefault(key, len(numbers) + 1)

    def element(group, corners):
        nodes = [node(key) for key in corners]
        edges = EDGES.get(len(corners), ((0, 1),))
        if order == 2:
            nodes += [node(tuple((a + b) // 2 for a, b in
                                 zip(corners[i], corners[j]))) for i, j in edges]
        kind = {(2, 1): 1, (2, 2): 8, (4, 1): 3, (4, 2): 16, (8, 1): 5,
                (8, 2): 17}[len(corners), order]
        elements.append((kind, 2, group, group, *nodes))

    elements = []
    for i in range(n_r):
        group = material(radii[0] + (i + 0.5) / n_r * (radii[1] - radii[0]))
        for j in range(n_phi):
            cell = [(2 * (i + a), 2 * (j + b)) for a, b in
                    ((0, 0), (1, 0), (1, 1), (0, 1))]
            sides = [(group_of_side, [cell[a], cell[b]]) for group_of_side, a, b, on in
                     ((7 if i < crack else 1, 0, 1, j == 0), (2, 2, 3, j == n_phi - 1),
                      (3, 3, 0, i == 0), (4, 1, 2, i == n_r - 1)) if on]

            def at(points, z):
                return [(*point, z) for point in points]
            if length is None:
                element(group, at(cell, 0))
                for side, points in sides:
                    element(side, at(points, 0))
            else:
                element(group, at(cell, 0) + at(cell, 2))
                element(5, at(cell, 0))
                element(6, at(cell, 2))
                for side, points in sides:
                    element(side, at(points, 0) + at(points, 2)[::-1])
    nodes = []
    for (i, j, k), number in numbers.items():
        r, phi = move(radii[0] + i / (2 * n_r) * (radii[1] - radii[0]),
                      j / (2 * n_phi) * math.pi / 2)
        # To rounding on the axes.
        x, y = (r, 0.) if j == 0 else (0., r) if j == 2 * n_phi else (
            r * math.cos(phi), r * math.sin(phi))
        nodes.append(f"{number} {x!r} {y!r} {k / 2 * (length or 0)!r}")
    pathlib.Path(name).write_text("\n".join([
        "$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", str(len(nodes)),
        *nodes, "$EndNodes", "$Elements", str(len(elements)),
        *(" ".join(map(str, (k, *one))) for k, one in enumerate(elements, 1)),
        "$EndElements", ""]))
    return f"Geometry/Mesh file={name}"


# One period under a pressure of 1 inside; plane strain.
TUBE = """
subsection Geometry
  set Shape     = mesh file
  set Mesh file = tube.msh
end
subsection Boundary
  set Symmetry = 1, 2
  set Loaded   = 3
end
subsection Material
  set Plane state   = plane strain
  set Poisson ratio = 0.3
  set Viscosity     = none
end
subsection Loads
  set Traction = x/sqrt(x*x+y*y); y/sqrt(x*x+y*y)
end
subsection Discretisation
  set Degree = 2
end
subsection Time integration
  set Steps per period = 2
end
subsection Periodic state
  set Maximum periods = 1
  set Tolerance       = 0
end
subsection Output
  set Probes = inside: 1, 0; outside: 2, 0
  set Fields = none
end
"""


def lame(pressure_in, pressure_out, a, b, r):
    """Radial and hoop stress."""
    mean = (pressure_in * a**2 - pressure_out * b**2) / (b**2 - a**2)
    part = (pressure_in - pressure_out) * a**2 * b**2 / (b**2 - a**2) / r**2
    return mean - part, mean + part
