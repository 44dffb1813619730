"""Writes the body of body.prm as a mesh file of Gmsh, its points moved."""

import pathlib


def write(name, place, nx=8, ny=4):
    """The unit square of nx x ny cells, each point (x, y) at place(x, y), with
    the ids 1 on the left of its lower side, 2 on the right, 3 above."""
    points = {(i, j): place(i / nx, j / ny)
              for j in range(ny + 1) for i in range(nx + 1)}
    number = {key: k for k, key in enumerate(points, 1)}
    (a, b), (c, d), (e, f) = place(0., 0.), place(1., 0.), place(0., 1.)
    turned_over = (c - a) * (f - b) - (d - b) * (e - a) < 0
    elements = []
    for i in range(nx):
        elements.append((1, 2 if 2 * i >= nx else 1, [(i, 0), (i + 1, 0)]))
        elements.append((1, 3, [(i, ny), (i + 1, ny)]))
        for j in range(ny):
            cell = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
            elements.append((3, 10, cell[::-1] if turned_over else cell))
    lines = [" ".join(map(str, (k, kind, 2, group, group,
                                *(number[key] for key in vertices))))
             for k, (kind, group, vertices) in enumerate(elements, 1)]
    nodes = [f"{number[key]} {x!r} {y!r} 0" for key, (x, y) in points.items()]
    pathlib.Path(name).write_text("\n".join([
        "$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", str(len(nodes)),
        *nodes, "$EndNodes", "$Elements", str(len(lines)), *lines,
        "$EndElements", ""]))
