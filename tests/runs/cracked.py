"""Gmsh files of plates and blocks with cracks, and scenes of cracked squares
whose upper halves are the scenes of M. Raous (1980)."""

import itertools
import math
import pathlib

# The built-in plate, half of it, that relaxes within a tenth of a period.
PLATE = """
subsection Material
  set Young modulus   = 13000
  set Poisson ratio   = 0.2
  set Relaxation time = 60
end
subsection Loads
  set Period = 600
end
"""

# Creep under a constant load until it is steady, with C(t) and the work of the load.
STEADY_CREEP = """
subsection Discretisation
  set Degree = 2
end
subsection Loads
  set Period = 4
  set Traction = 0; 1
end
subsection Time integration
  set Scheme = sdirk2
  set Step control = list
  set Steps = 0.01, 0.02, 0.04, 0.08, 0.16, 0.32, 0.6, 1, 1.5, 2, 3, 3.5
end
subsection Periodic state
  set Maximum periods = 1
  set Tolerance = 0
end
subsection Crack tip
  set Creep integral = true
end
subsection Output
  set Fields = none
  set Load work = true
end
"""

# Physical groups.
LEFT, RIGHT, BOTTOM, TOP, FRONT, BACK, CRACK = 1, 2, 3, 4, 5, 6, 7


def steps(begin, end, n):
    return [begin + (end - begin) * i / n for i in range(n + 1)]


def turned(degrees, about=(0., 0.)):
    """A rotation of points in the plane."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))

    def turn(point):
        x, y = point[0] - about[0], point[1] - about[1]
        return (c * x - s * y + about[0], s * x + c * y + about[1], *point[2:])
    return turn


def write_block(path, axes, is_crack, place=lambda point: point,
                material=lambda middle: 1):
    """A mesh of the product of axes, lists of two or three coordinates each.

    is_crack(middle, normal axis) says which faces are cracks, or their group; place
    moves the nodes; both, and material, are given places before that."""
    dim = len(axes)
    shape = [len(axis) for axis in axes]

    def number(index):
        flat = 0
        for i, n in zip(reversed(index), reversed(shape), strict=True):
            flat = flat * n + i
        return flat + 1

    def element(index, free):
        """The nodes from a corner along the free axes, as Gmsh orders them."""
        corners = [list(index) for _ in range(2 ** len(free))]
        order = [(0,), (1,)] if len(free) == 1 else [(0, 0), (1, 0), (1, 1), (0, 1)]
        if len(free) == 3:
            order = [(*xy, z) for z in (0, 1) for xy in order]
        for corner, offsets in zip(corners, order, strict=True):
            for axis, offset in zip(free, offsets, strict=True):
                corner[axis] += offset
        return [number(corner) for corner in corners]

    def middle(index, free):
        return tuple(
            (axis[i] + axis[i + 1]) / 2 if d in free else axis[i]
            for d, (i, axis) in enumerate(zip(index, axes, strict=True)))

    nodes = []
    for index in itertools.product(*(range(n) for n in reversed(shape))):
        point = [axis[i] for axis, i in zip(axes, reversed(index), strict=True)]
        nodes.append(place(tuple(point)))
    elements = []
    every = tuple(range(dim))
    for index in itertools.product(*(range(n - 1) for n in shape)):
        elements.append((3 if dim == 2 else 5, material(middle(index, every)),
                         element(index, every)))
    for normal in every:
        free = tuple(d for d in every if d != normal)
        ranges = [range(n if d == normal else n - 1) for d, n in enumerate(shape)]
        for index in itertools.product(*ranges):
            if crack := is_crack(middle(index, free), normal):
                group = CRACK if crack is True else crack
            elif index[normal] in (0, shape[normal] - 1):
                group = 2 * normal + 1 + (index[normal] > 0)
            else:
                continue
            elements.append((1 if dim == 2 else 3, group, element(index, free)))

    return write_gmsh(path, nodes, elements)


def write_gmsh(path, nodes, elements):
    """Nodes are places; elements Gmsh's type, group, and nodes from 1 on."""
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", str(len(nodes))]
    lines += [f"{i + 1} " + " ".join(repr(x) for x in (*point, 0.)[:3])
              for i, point in enumerate(nodes)]
    lines += ["$EndNodes", "$Elements", str(len(elements))]
    lines += [f"{i + 1} {kind} 2 {group} {group} " + " ".join(map(str, numbers))
              for i, (kind, group, numbers) in enumerate(elements)]
    lines += ["$EndElements", ""]
    pathlib.Path(path).write_text("\n".join(lines))
    return path


def write_rings(path, per_side, ratio, smallest):
    """The half square |x| < 1/2, 0 < y < 1/2, with the crack on y = 0 < x, in rings
    about its tip of which each is larger than the last by a ratio, 4 per_side cells
    a ring, around a half square of equal cells."""
    n = 2 * per_side
    n_rings = math.ceil(math.log(0.5 / smallest) / math.log(ratio))
    radii = [0.5 * (smallest / 0.5) ** (1 - i / n_rings) for i in range(n_rings + 1)]
    around = ([(per_side, i) for i in range(per_side)]
              + [(per_side - i, per_side) for i in range(n)]
              + [(-per_side, per_side - i) for i in range(per_side + 1)])
    inside = {(i, j): 1 + k for k, (j, i) in enumerate(itertools.product(
        range(per_side), range(-per_side + 1, per_side)))}
    nodes = [(i * smallest / per_side, j * smallest / per_side) for i, j in inside]
    first = len(nodes) + 1
    nodes += [(r * i / per_side, r * j / per_side) for r in radii for i, j in around]

    def ring(i, k):
        return first + i * len(around) + k

    def core(i, j):
        return inside.get((i, j)) or ring(0, around.index((i, j)))

    elements = []
    for i, j in itertools.product(range(-per_side, per_side), range(per_side)):
        elements.append((3, 1, [core(i, j), core(i + 1, j), core(i + 1, j + 1),
                                core(i, j + 1)]))
        if j == 0:
            elements.append((1, CRACK if i >= 0 else BOTTOM, [core(i, 0), core(i + 1, 0)]))
    for i, k in itertools.product(range(n_rings), range(2 * n)):
        elements.append((3, 1, [ring(i, k), ring(i + 1, k), ring(i + 1, k + 1),
                                ring(i, k + 1)]))
    for i in range(n_rings):
        elements.append((1, CRACK, [ring(i, 0), ring(i + 1, 0)]))
        elements.append((1, BOTTOM, [ring(i, 2 * n), ring(i + 1, 2 * n)]))
    elements += [(1, TOP, [ring(n_rings, k), ring(n_rings, k + 1)])
                 for k in range(per_side, 3 * per_side)]
    return write_gmsh(path, nodes, elements)


def at_edge(middle, normal):
    """Whether a face lies on the crack of raous1980_body.prm."""
    return normal == 1 and middle[1] == 0 and middle[0] > 0.5


def square(path, n=14, degrees=0., half=False, material=lambda middle: 1):
    """Two of the halves of raous1980_body.prm, or the upper one, with n cells
    across each."""
    rows = max(2, 2 * n // 7)
    return write_block(
        path, (steps(0, 1, n), steps(0, 1, rows) if half else steps(-1, 1, 2 * rows)),
        at_edge, turned(degrees), material)


def square_scene(mesh, degrees=0., half=False, more=""):
    """raous1980 by both halves, or the upper one, turned about the origin. The
    loads are in equilibrium: supports hold no force, but the turned square may
    turn a little more."""
    turn = turned(degrees)
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    force = f"10*sin(2*pi*t/600)*({c!r}*y - {s!r}*x)"  # y is turned back

    def at(x, y):
        return ", ".join(repr(value) for value in turn((x, y)))
    free = 1 if abs(s) > abs(c) else 2
    roles = (f"set Contact = {CRACK}\n  set Symmetry = {BOTTOM}\n"
             f"  set Fixed points = {at(0.5, 0)}: {3 - free}\n  set Loaded = {TOP}"
             if half else
             f"set Crack = {CRACK}\n  set Loaded = {BOTTOM}, {TOP}\n"
             f"  set Fixed points = {at(0.5, 0)}; {at(0, 0)}: {free}")
    return f"""
subsection Geometry
  set Shape = mesh file
  set Mesh file = {mesh}
end
subsection Boundary
  {roles}
end
subsection Material
  set Young modulus = 13000
  set Poisson ratio = 0.2
  set Viscosity = relaxation time
  set Relaxation time = 60
end
subsection Loads
  set Period = 600
  set Traction = {-s!r}*{force}; {c!r}*{force}
end
subsection Time integration
  set Steps per period = 40
end
subsection Periodic state
  set Method = march
  set Maximum periods = 3
  set Tolerance = 0.04
end
subsection Output
  set Probes = mouth: {at(1, 0)}; inside: {at(0.75, 0.5)}
end
{more}
"""
