"""Scenes of cracks between two materials; circular inclusions of the radius 1 in round
plates, debonded along arcs: meshes of second order, and K of the infinite plate."""

import cmath
import math

import cracked

# Inclusion and plate: E, nu.
INCLUSION, PLATE = (10., 0.2), (1., 0.35)
SCENE = """
subsection Geometry
  set Shape     = mesh file
  set Mesh file = {mesh}
end
subsection Boundary
  set Open crack   = 7
  set Loaded       = {loaded}
  set Fixed points = {points}
end
subsection Material
  set Plane state   = plane {state}
  set Young modulus = if(material < 1.5, {E[0]}, {E[1]})
  set Poisson ratio = if(material < 1.5, {nu[0]}, {nu[1]})
  set Viscosity     = none
end
subsection Loads
  set Traction = {load}
end
subsection Discretisation
  set Degree = 2
end
subsection Refinement
  set Strategy = tip
  set Cycles   = {cycles}
end
subsection Time integration
  set Steps per period = 1
end
subsection Crack tip
  set Stress intensity = true
end
subsection Output
  set Fields    = none
  set Load work = true
end
"""


def axes(degrees):
    """Cosine and sine of a turn, and formulas of the coordinates before it."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return c, s, f"({c!r}*x+{s!r}*y)", f"({c!r}*y-{s!r}*x)"


def turned_scene(degrees, place, along, across, bodies, stress, width, loaded, **more):
    """A body turned with its loads, which are given along both axes before; bodies have E
    in the unit of stress, and nu. It is held at |x| = width on its middle line."""
    c, s, *_ = axes(degrees)
    points = "; ".join("{!r}, {!r}: {}".format(*place((x, 0.)), components)
                       for x, components in ((width, "1, 2"),
                                             (-width, "2" if abs(c) > abs(s) else "1")))
    return SCENE.format(
        points=points, loaded=loaded, E=[stress * E for E, _ in bodies],
        nu=[nu for _, nu in bodies],
        load=f"{c!r}*({along}) - {s!r}*({across}); {s!r}*({along}) + {c!r}*({across})",
        **more)


def K_of(tip):
    return complex(tip["K_I"]["largest"], tip["K_II"]["largest"])


class SecondOrder:
    """Cells of second order, whose points a function gives at halves of their numbers."""

    def __init__(self, place=lambda point: point):
        self.place, self.nodes, self.numbers, self.elements = place, [], {}, []

    def number(self, point):
        at = tuple(round(x, 12) + 0. for x in point)
        if at not in self.numbers:
            self.nodes.append(self.place(point))
            self.numbers[at] = len(self.nodes)
        return self.numbers[at]

    def quad(self, group, f, i, j):
        self.elements.append((16, group, [self.number(f(i + a, j + b)) for a, b in (
            (0, 0), (1, 0), (1, 1), (0, 1), (0.5, 0), (1, 0.5), (0.5, 1), (0, 0.5))]))

    def edge(self, group, f):
        self.elements.append((8, group, [self.number(f(x)) for x in (0, 1, 0.5)]))

    def write(self, path):
        return cracked.write_gmsh(path, self.nodes, self.elements)


def between(values, i):
    """Value i; at a half the mean of two."""
    return 0.5 * (values[math.floor(i)] + values[math.ceil(i)])


def write_inclusion(path, n, width, crack, place=lambda point: point,
                    shape=lambda angle: 1.):
    """A square of n/4 cells a side around the middle, rings of n cells around it, one
    of whose edges is the interface, up to the radius width. The crack, group 7, is
    between two angles in degrees, to which nodes move; shape is the radius
    of the interface."""
    quarter = n // 4
    angles = [2 * math.pi * i / n for i in range(n + 1)]
    for tip in crack:
        i = round(tip * n / 360)
        for k in range(-3, 4):  # cells at the tip keep their size
            angles[(i + k) % n] += ((math.radians(tip) - 2 * math.pi * i / n)
                                    * min(1, (4 - abs(k)) / 3))
    angles[n] = angles[0] + 2 * math.pi
    # Parts of the way from the square to the interface, and radii from there on.
    inside, outside = [0., 0.35, 0.65, 0.85, 1.], [1.]
    while outside[-1] < width:
        outside.append(outside[-1] * (1 + 8 / n))
    outside = [1 + (r - 1) * (width - 1) / (outside[-1] - 1) for r in outside]
    last = 3 + len(outside)

    def on_square(i):
        side, rest = divmod(i + n // 8, quarter)
        x, y = 0.4, 0.4 * (2 * rest / quarter - 1)
        for _ in range(int(side) % 4):
            x, y = -y, x
        return x, y

    def on_ring(i, j):
        away = between(outside, max(j - 4, 0))
        # Far away equal angles and circles, whatever the interface has.
        part = (away - 1) / (width - 1)
        angle = between(angles, i) * (1 - part) + 2 * math.pi * i / n * part
        x, y, r = math.cos(angle), math.sin(angle), shape(angle)
        if j < 4:
            part = between(inside, j)
            return tuple(a + part * (r * b - a) for a, b in zip(on_square(i), (x, y)))
        r = away * (r + (1 - r) * part)
        return r * x, r * y

    mesh = SecondOrder(place)
    for i in range(quarter):
        for j in range(quarter):
            mesh.quad(1, lambda i, j: tuple(0.4 * (2 * x / quarter - 1) for x in (i, j)),
                      i, j)
    begin, end = (math.radians(tip) for tip in crack)
    for i in range(n):
        for j in range(last):
            mesh.quad(1 if j < 4 else 2, on_ring, i, j)
        if (between(angles, i + 0.5) - begin) % (2 * math.pi) < end - begin:
            mesh.edge(7, lambda x: on_ring(i + x, 4))
        mesh.edge(1, lambda x: on_ring(i + x, last))
    return mesh.write(path)


def bent_plate(name, radius=None, cycles=6):
    """A plate |x|, |y| < 4, bent about a centre below it, with a crack |x| < 1 on its middle
    line between two materials, pulled at its ends."""
    steps = [-4, -2, -1.5, -1.25, -1, -0.75, -0.5, 0, 0.5, 0.75, 1, 1.25, 1.5, 2, 4]
    mesh, n = SecondOrder(), len(steps) - 1

    def at(i, j):
        x, y = between(steps, i), between(steps, j)
        if radius is None:
            return x, y
        return ((radius + y) * math.sin(x / radius),
                y - (radius + y) * 2 * math.sin(x / radius / 2)**2)
    for i in range(n):
        for j in range(n):
            mesh.quad(1 if steps[j] >= 0 else 2, at, i, j)
        mesh.edge(1, lambda x: at(i + x, 0))
        mesh.edge(1, lambda x: at(i + x, n))
        if abs(between(steps, i + 0.5)) < 1:
            mesh.edge(7, lambda x: at(i + x, n // 2))
    ends = [at(i, n // 2) for i in (0, n)]
    return SCENE.format(
        mesh=mesh.write(f"{name}.msh"), state="stress", cycles=cycles, loaded=1,
        E=[INCLUSION[0], PLATE[0]], nu=[INCLUSION[1], PLATE[1]], load="0; if(y > 0, 7, -7)",
        points="; ".join("{!r}, {!r}: {}".format(*end, components)
                         for end, components in zip(ends, ("1, 2", "2"))))


def debond(name, crack, width=10., far=(0., 7., 0.), inclusion=INCLUSION, plate=PLATE,
           state="stress", cycles=6, n=32, degrees=0., unit=(1., 1.),
           shape=lambda t: 1.):
    """A plate with an inclusion debonded between two angles, under the stresses far
    away 11, 22 and 12. All is turned, and has units of length and stress."""
    turn = cracked.turned(degrees)
    length, stress = unit

    def place(point):
        return tuple(length * x for x in turn(point))
    mesh = write_inclusion(f"{name}.msh", n, width, crack, place, shape)
    _, _, x, y = axes(degrees)
    s_11, s_22, s_12 = (f * stress / (width * length) for f in far)
    along, across = f"{s_11!r}*{x}+{s_12!r}*{y}", f"{s_12!r}*{x}+{s_22!r}*{y}"
    return turned_scene(degrees, place, along, across, (inclusion, plate), stress, width, 1,
                        mesh=mesh, state=state, cycles=cycles)


def exact(crack, far, inclusion=INCLUSION, plate=PLATE, state="stress"):
    """K at the tips at both angles, at the distance of the crack's length (England, J.
    Appl. Mech. 33, 1966; Toya, J. Mech. Phys. Solids 22, 1974), by Muskhelishvili's
    continuation: s_rr + i s_rt = Phi_1 - Phi_1e on the circle, where Phi_1 + Phi_2e =
    Phi_2 + Phi_1e = H = h + conj(Gamma')/z^2, and F = A Phi_1 inside, B Phi_2 + (1/mu_2
    - 1/mu_1) H outside, jumps on the crack only: F+ + A/B F- = A/B (kappa_2 + 1)/mu_2 H."""
    (mu_1, k_1), (mu_2, k_2) = (
        (E / (2 * (1 + nu)), 3 - 4 * nu if state == "strain" else (3 - nu) / (1 + nu))
        for E, nu in (inclusion, plate))
    A, B, c = k_1 / mu_1 + 1 / mu_2, k_2 / mu_2 + 1 / mu_1, 1 / mu_2 - 1 / mu_1
    s_11, s_22, s_12 = far
    alpha, middle = (math.radians(crack[1] + sign * crack[0]) / 2 for sign in (-1, 1))
    # In axes through the middle of the crack.
    gamma = (s_11 + s_22) / 4
    gamma_1 = complex((s_22 - s_11) / 2, s_12) * cmath.exp(2j * middle)
    a, b = cmath.exp(-1j * alpha), cmath.exp(1j * alpha)
    epsilon = math.log(A / B) / (2 * math.pi)
    at_a, at_b = complex(-0.5, epsilon), complex(-0.5, -epsilon)

    def X(z):
        """(z - a)^at_a (z - b)^at_b, ~ 1/z, with the crack as its cut."""
        log = cmath.log((z - a) / (z - b) * cmath.exp(1j * alpha)) - 1j * alpha
        return cmath.exp(at_a * log) / (z - b)
    assert abs(X(1 - 1e-9) / X(1 + 1e-9) + A / B) < 1e-6 * A / B

    # F = E H + X (c_1 z + c_0 + d_1/z + d_2/z^2): regular at 0, B Gamma + (1/mu_2 - 1/mu_1)
    # h far away; no residue there, as the lips meet at both tips.
    E = A * (B + c) / (A + B)
    L, slope = -at_a / a - at_b / b, -at_a / a**2 - at_b / b**2
    d_2 = -E * gamma_1.conjugate() / X(0)
    d_1 = -d_2 * L
    x_1 = b + at_a * (b - a)
    # F(0) = p h + q, and h = Gamma - conj(F(0))/A.
    p = E - X(0) * x_1 * (c - E)
    q = X(0) * (d_1 * L + d_2 * (L**2 + slope) / 2 - x_1 * B * gamma)
    P, Q = p.conjugate() / A, gamma - q.conjugate() / A
    h = (Q - P * Q.conjugate()) / (1 - abs(P)**2)
    c_1 = B * gamma + (c - E) * h
    found = []
    for tip, own, ahead in ((a, -epsilon, -1), (b, epsilon, 1)):
        s = 1e-7
        z = tip * cmath.exp(1j * ahead * s)
        stress = (1 / A + 1 / B) * X(z) * (c_1 * (z - x_1) + d_1 / z + d_2 / z**2)
        found.append(stress.conjugate() * math.sqrt(2 * math.pi * s)
                     * (s / (2 * alpha))**(-1j * own))
    return found
