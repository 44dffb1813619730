"""Makes fretting.msh, Gmsh's format, for fretting.prm: two blocks [-2, 2] x [0, 2] and
[-2, 2] x [-2, 0] with a crack between them, and small cells where they touch. Physical
groups: 1 bottom, 2 top, 3 crack.

    /usr/bin/python3 fretting_mesh.py [FILE [SIZE]]

SIZE of the cells for |x| < 0.4 and at the crack (0.02)."""

import itertools
import sys

HALF, CONTACT, RATIO = 2., 0.4, 1.4


def lines(size, contact):
    """Lines from -HALF to HALF, at equal distances up to the contact's end, which grow
    from there on."""
    at = [size * i for i in range(round(contact / size) + 1)]
    while at[-1] < HALF:
        size *= RATIO
        at.append(at[-1] + size if at[-1] + 1.5 * size < HALF else HALF)
    return [-x for x in at[:0:-1]] + at


def main():
    path = sys.argv[1] if len(sys.argv) > 1 else "fretting.msh"
    size = float(sys.argv[2]) if len(sys.argv) > 2 else 0.02
    X, Y = lines(size, CONTACT), lines(size, 0.)
    n = len(X)
    nodes = [f"{1 + i + n * j} {x:.12g} {y:.12g} 0"
             for (j, y), (i, x) in itertools.product(enumerate(Y), enumerate(X))]

    def side(j, group):
        return [f"1 2 {group} {group} {1 + i + n * j} {2 + i + n * j}"
                for i in range(n - 1)]
    elements = side(0, 1) + side(len(Y) - 1, 2) + side(len(Y) // 2, 3)
    for j, i in itertools.product(range(len(Y) - 1), range(n - 1)):
        first = 1 + i + n * j
        elements.append(f"3 2 4 4 {first} {first + 1} {first + n + 1} {first + n}")
    lines_of_file = [
        "$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "4",
        '1 1 "bottom"', '1 2 "top"', '1 3 "crack"', '2 4 "blocks"', "$EndPhysicalNames",
        "$Nodes", str(len(nodes)), *nodes, "$EndNodes", "$Elements", str(len(elements)),
        *(f"{1 + k} {element}" for k, element in enumerate(elements)), "$EndElements", ""]
    with open(path, "w") as file:
        file.write("\n".join(lines_of_file))


main()
