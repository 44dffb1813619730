"""Makes penny_crack.msh, Gmsh's format, for penny_crack.prm: one eighth of a block
[0, 20]^3 with a penny-shaped crack of radius 2 in the plane z = 0, whose centre is
the origin. Hexahedra of second order, graded to the front, which is an arc to
fourth order in its angle; physical groups: 1 ligament, 2 lip, 3 top, 4 x = 0, 5
y = 0, 6 the sides, free.

    /usr/bin/python3 penny_mesh.py [FILE [CELLS [SIZE [AXES]]]]

CELLS along the front (8), SIZE of the cells there, as a part of the radius
(0.05). With AXES, as xz, the block is mirrored to negative x and z; with z both
lips are modelled, 2 is the crack, and 7 the bottom."""

import itertools
import math
import sys

RADIUS, BLOCK = 2., 20.
CORE, INNER, OUTER = 0.5, 0.7, 1.6  # square in the middle and polar rings, in radii
EDGES = ((0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5),
         (4, 7), (5, 6), (6, 7))  # Gmsh's order of the middles
HEXAHEDRON = ((0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0),
              (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2))
FACES = ((0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6),
         (3, 0, 4, 7))


def graded(begin, end, first, ratio):
    """Numbers from begin to end, at distances that grow from about the first."""
    n = max(1, round(math.log(1 + abs(end - begin) / first * (ratio - 1), ratio)))
    return [begin + (end - begin) * (ratio ** i - 1) / (ratio ** n - 1)
            for i in range(n + 1)]


def between(numbers, twice):
    """The number at an index, given twice, or the middle of two."""
    return (numbers[twice // 2] + numbers[(twice + 1) // 2]) / 2


def on_square(side, corner, part):
    """A point of the polygon (side, 0), (corner, corner), (0, side)."""
    if part > 0.5:
        y, x = on_square(side, corner, 1 - part)
        return x, y
    return side + (corner - side) * 2 * part, corner * 2 * part


def on_circle(radius, part):
    return (radius * math.cos(math.pi / 2 * part),
            radius * math.sin(math.pi / 2 * part))


def on_block(part):
    x, y = on_circle(1., part)
    return tuple(BLOCK * c / max(x, y) for c in (x, y))


def blend(a, b, part):
    return tuple((1 - part) * p + part * q for p, q in zip(a, b))


def patches(cells, size):
    """(number of cells in both directions, function of twice the indices) in the
    plane of the crack."""
    first = size * RADIUS
    rings = graded(RADIUS, INNER * RADIUS, first, 1.6)[::-1]
    rings += graded(RADIUS, OUTER * RADIUS, first, 1.6)[1:]
    core = CORE * RADIUS
    last = rings[-1] - rings[-2]
    outer = graded(0., 1., last / (BLOCK - rings[-1]), 1.7)
    half = cells // 2

    def in_core(i, j):
        return blend(blend((0, 0), (core, 0), i / cells),
                     blend((0, core), (0.8 * core, 0.8 * core), i / cells),
                     j / cells)

    def around_core(i, j):
        return blend(on_square(core, 0.8 * core, j / (2 * cells)),
                     on_circle(rings[0], j / (2 * cells)), i / 2)

    yield (half, half), in_core
    yield (1, cells), around_core
    yield ((len(rings) - 1, cells),
           lambda i, j: on_circle(between(rings, i), j / (2 * cells)))
    yield ((len(outer) - 1, cells),
           lambda i, j: blend(on_circle(rings[-1], j / (2 * cells)),
                              on_block(j / (2 * cells)), between(outer, i)))


def group(points, mirrored):
    """That of a face, by its corners; None within the body."""
    for axis, value, number in ((2, BLOCK, 3), (2, -BLOCK, 7), (0, 0., 4), (1, 0., 5),
                                (0, BLOCK, 6), (0, -BLOCK, 6), (1, BLOCK, 6),
                                (1, -BLOCK, 6)):
        if all(abs(p[axis] - value) < 1e-9 for p in points):
            return None if value == 0 and axis in mirrored else number
    if all(p[2] == 0. for p in points):
        x, y = (sum(p[axis] for p in points) / 4 for axis in (0, 1))
        if math.hypot(x, y) < RADIUS:
            return 2
        return None if 2 in mirrored else 1
    return None


def make(path, cells, size, mirrored=()):
    """mirrored: axes, 0 to 2."""
    layers = graded(0., BLOCK, size * RADIUS, 1.6)
    nodes, elements, faces = {}, [], set()
    signs = list(itertools.product(*((1, -1) if axis in mirrored else (1,)
                                     for axis in range(3))))

    def number(point):
        key = tuple(round(c, 9) + 0. for c in point)
        return nodes.setdefault(key, (len(nodes) + 1, point))[0]

    for (n, m), place in patches(cells, size):
        for i in range(n):
            for j in range(m):
                for k, sign in itertools.product(range(len(layers) - 1), signs):
                    def at(offset):
                        first = offset[0] if math.prod(sign) > 0 else 2 - offset[0]
                        point = (*place(2 * i + first, 2 * j + offset[1]),
                                 between(layers, 2 * k + offset[2]))
                        return tuple(s * x for s, x in zip(sign, point))

                    def middle(a, b):
                        return at([(HEXAHEDRON[a][d] + HEXAHEDRON[b][d]) // 2
                                   for d in range(3)])

                    corners = [at(offset) for offset in HEXAHEDRON]
                    elements.append((17, 10, [number(p) for p in corners] + [
                        number(middle(a, b)) for a, b in EDGES]))
                    for face in FACES:
                        ends = [corners[v] for v in face]
                        key = tuple(sorted(number(p) for p in ends))
                        role = group(ends, mirrored)
                        if role and key not in faces:
                            faces.add(key)
                            elements.append((16, role, [number(p) for p in ends] + [
                                number(middle(face[v], face[(v + 1) % 4]))
                                for v in range(4)]))
    with open(path, "w") as file:
        print(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{len(nodes)}", file=file)
        for index, point in nodes.values():
            print(index, *(f"{c:.15g}" for c in point), file=file)
        print(f"$EndNodes\n$Elements\n{len(elements)}", file=file)
        for index, (kind, role, corners) in enumerate(elements, 1):
            print(index, kind, 2, role, role, *corners, file=file)
        print("$EndElements", file=file)


if __name__ == "__main__":
    words = sys.argv[1:] + ["penny_crack.msh", "8", "0.05", ""][len(sys.argv) - 1:]
    make(words[0], int(words[1]), float(words[2]),
         ["xyz".index(axis) for axis in words[3]])
