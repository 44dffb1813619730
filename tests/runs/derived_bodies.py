"""Families of derived numbers of other bodies: of revolution, with kinked lips, in a
corner."""

import math

from cracked import BOTTOM, CRACK, LEFT, RIGHT, TOP, steps, turned, write_block
from derived_draws import (PLAIN, SQUARE, Wave, growth, log_uniform, same_tip,
                           stress_state, tip_of)


def penny(instance):
    """A penny-shaped crack in a long cylinder: K = 2 sigma sqrt(a/pi) times a factor
    of the radii (Tada, Paris, Irwin: 0.5 %), closed where the load presses."""
    dice = instance.dice
    a, b = 1., dice.choice([4., 6.])
    wave, size = Wave(dice, 1.), log_uniform(dice, 1e-3, 10.)
    n_steps, length = dice.choice([20, 40]), log_uniform(dice, 1e-3, 1e3)
    settings = {
        "Geometry/Shape": "centre crack", "Geometry/Width": repr(b * length),
        "Geometry/Height": repr(3 * b * length), "Geometry/Crack length": repr(a * length),
        "Geometry/Subdivisions": f"{int(4 * b)}, {int(6 * b)}",
        "Material/Plane state": "axisymmetric", "Material/Viscosity": "none",
        "Material/Young modulus": repr(log_uniform(dice, 10., 1e5)),
        "Discretisation/Degree": dice.choice("12"), **growth(dice),
        "Refinement/Strategy": "tip", "Refinement/Cycles": dice.choice("23"),
        "Time integration/Steps per period": str(n_steps),
        "Loads/Traction": f"0; {size!r}*{wave.formula()}"}
    results = instance.run("penny", PLAIN, settings)
    tip, ratio = tip_of(results), a / b
    factor = (1 - 0.5 * ratio + 0.148 * ratio**3) / math.sqrt(1 - ratio)
    K = 2 * size * math.sqrt(a * length / math.pi) * factor
    bend, largest = wave.bend(n_steps), wave.fine().max()
    # The formula's error, and that which the program prints of its mesh.
    mesh = 0.008 + 2 * tip["K_I_error"] / K / largest
    instance.expect("K_max", tip["K_I"]["largest"] / K, largest,
                    bend / 8 + mesh * largest)
    instance.expect("Delta_K", tip["Delta_K"] / K, largest - max(wave.fine().min(), 0.),
                    bend / 8 + mesh * largest)
    closed, error = wave.part_below(0., 1e-5)
    instance.expect("K_op", (tip.get("K_opening") or 0.) / K, 0., 1e-5)
    for name, expected in (("wholly", closed), ("partly", 0.)):
        instance.expect(f"closed {name}", tip["closed_part"][name], expected, error)
        instance.expect(f"lips closed {name}", results.summary["closed_part"][name],
                        expected, error)
    pressure = max(0., -wave.fine().min()) * size
    lip = results.table("lip.csv")
    for node, part in zip(lip["largest_pressure"], lip["closed_part"]):
        instance.expect("largest pressure of a node", node, pressure,
                        size * (bend / 8 + 1e-6))
        instance.expect("closed part of a node", part, closed, error)
    area = (a * length)**2 / 2  # of one radian
    instance.expect("largest force over area",
                    max(results.table("contact.csv")["force"]) / area, pressure,
                    size * (bend / 8 + 1e-6))


def wide_ring(instance):
    """A ring with a crack in a plane across its axis, of a radius R that is large
    beside its section: plane strain, up to some sizes of the section over R."""
    dice = instance.dice
    R, n = 10**dice.uniform(3.5, 4.5), dice.choice([8, 10])
    wave, n_steps = Wave(dice, 1.), dice.choice([20, 40])
    inner = dice.random() < 0.5
    found = []
    gap = dice.choice([None, 1., 0.])
    kind = dice.choice(["none", "none", "relaxation time"])
    law = growth(dice)
    degree, cycles = dice.choice("12"), dice.choice("02")
    for shift, state in ((0., "plane strain"), (R, "axisymmetric")):
        mesh = write_block(
            instance.path(f"{state[:5]}.msh"), (steps(shift, shift + 1, n), steps(0, 1, n)),
            lambda middle, normal, shift=shift: normal == 1 and middle[1] == 0 and (
                (middle[0] - shift < 0.5) == inner))
        place = f"((x - {shift!r} - 0.5)*{-2 if inner else 2})"
        results = instance.run(state[:5], PLAIN, {
            "Geometry/Shape": "mesh file", "Geometry/Mesh file": str(mesh),
            "Boundary/Contact": str(CRACK), "Boundary/Symmetry": str(BOTTOM),
            "Boundary/Loaded": str(TOP),
            "Boundary/Fixed points": f"{shift + (1 if inner else 0)!r}, 0: 1",
            "Boundary/Gap": "0" if gap is None else f"-2e-3*abs({gap!r} - {place})",
            "Material/Plane state": state, "Material/Young modulus": "1000",
            "Material/Viscosity": kind, "Material/Relaxation time": "0.2",
            "Loads/Traction": f"0; {wave.formula()}", **law,
            "Refinement/Strategy": "tip" if cycles != "0" else "none",
            "Refinement/Cycles": cycles, "Discretisation/Degree": degree,
            "Time integration/Steps per period": str(n_steps),
            "Output/Probes": f"mouth: {shift + (0 if inner else 1)!r}, 0"})
        found.append(results)
    bound = 30 / R + (1e-5 if kind != "none" else 0.)
    one, other = found
    same_tip(instance, tip_of(one), tip_of(other), bound,
             fluidity=0. if kind == "none" else 1 / 1000 / 0.2)
    for column in ("opening", "pressure"):
        instance.expect_all(f"{column} of the mouth",
                            other.table("probe_mouth.csv")[column],
                            one.table("probe_mouth.csv")[column], bound,
                            1. if column == "pressure" else None)


def walk(dice, n):
    """Faces of a crack that walks along the lines of a mesh and meets no node twice:
    pairs of nodes."""
    at = dice.randint(3, n - 5), dice.randint(3, n - 3)
    path, direction = [at], (1, 0)
    for _ in range(dice.randint(4, 12)):
        moves = [direction] * 2 + [(-direction[1], direction[0]),
                                   (direction[1], -direction[0])]
        direction = dice.choice(moves)
        at = at[0] + direction[0], at[1] + direction[1]
        near = [(at[0] + i, at[1] + j) for i, j in ((1, 0), (-1, 0), (0, 1), (0, -1))]
        if not all(2 < x < n - 2 for x in at) or at in path or \
                sum(p in path for p in near) > 1:  # encloses nothing
            break
        path.append(at)
    return list(zip(path, path[1:]))


def kinked_lips(instance):
    """A body under uniform pressure has it everywhere, also on a crack of any form:
    at each node of its lips, and as their force over their length."""
    dice = instance.dice
    dim, n = (3, 6) if dice.random() < 0.15 else (2, 12)
    if dim == 3:
        faces = [((3, j), (4, j)) for j in (3,)] + [((3, 3), (3, 4))]
    else:
        faces = walk(dice, n)
    while len(faces) < 2:
        faces = walk(dice, n)
    axis = steps(-1, 1, n)
    skew, degrees = dice.uniform(-0.25, 0.25), dice.uniform(-180, 180)
    waves = [(dice.uniform(0, 0.12), dice.randint(1, 3), dice.uniform(0, 6)) for _ in "xy"]
    turn = turned(degrees)
    middles = {tuple((axis[p[d]] + axis[q[d]]) / 2 for d in (0, 1)) for p, q in faces}

    def is_crack(middle, normal):
        return normal < 2 and any(abs(middle[0] - m[0]) + abs(middle[1] - m[1]) < 1e-9
                                  for m in middles) and (
            dim == 2 or abs(middle[2]) < 0.7)

    def place(point):
        X, Y = point[:2]
        inside = (1 - X * X) * (1 - Y * Y)
        (a, k, p), (b, m, q) = waves
        X, Y = (X + inside * (skew * Y + a * math.sin(3 * k * Y + p)),
                Y + inside * b * math.sin(3 * m * X + q))
        return (*turn((X, Y)), *point[2:])
    mesh = write_block(instance.path("kinked.msh"), (axis, axis) + (
        (steps(-1, 1, 4),) if dim == 3 else ()), is_crack, place)
    pressure = log_uniform(dice, 1e-3, 1e3)
    formula = f"(-{pressure!r}*(1 + 0.3*sin(2*pi*t)))"
    settings = stress_state([formula, formula, "0"], degrees)
    if dim == 3:
        z = f"; {formula}*(if(z > 0.9999, 1, 0) - if(z < -0.9999, 1, 0))"
        corners = [(*turn((X, Y)), -1.) for X, Y in ((-1, -1), (1, -1), (-1, 1))]
        at = [", ".join(map(repr, corner)) for corner in corners]
        settings = {
            "Dimension": "3", "Loads/Traction": settings["Loads/Traction"] + z,
            "Boundary/Loaded": "1, 2, 3, 4, 5, 6", "Boundary/Fixed points":
            f"{at[0]}; {at[1]}: {settings['Boundary/Fixed points'][-1]}, 3; {at[2]}: 3",
            "Crack tip/Stress intensity": "false"}
    results = instance.run("kinked", SQUARE, {
        **settings, "Geometry/Mesh file": str(mesh),
        "Discretisation/Degree": dice.choice("12") if dim == 2 else "1",
        "Time integration/Steps per period": "4"})
    lip = results.table("lip.csv")
    for node in lip["largest_pressure"]:
        instance.expect("pressure of a node", node, 1.3 * pressure, 1e-7 * pressure)
    for part in lip["closed_part"]:
        instance.expect("closed part of a node", part, 1., 1e-9)
    contact = results.table("contact.csv")
    instance.expect("largest pressure", max(contact["largest_pressure"]), 1.3 * pressure,
                    1e-7 * pressure)
    instance.expect("wholly closed", results.summary["closed_part"]["wholly"], 1., 1e-9)
    size = sum(math.dist(place((axis[p[0]], axis[p[1]])), place((axis[q[0]], axis[q[1]])))
               for p, q in faces) if dim == 2 else None
    if size:
        instance.expect("force over length", max(contact["force"]) / size, 1.3 * pressure,
                        1e-7 * pressure)


def blocked_corner(instance):
    """A block pressed into a corner, or a channel, of rigid planes."""
    dice = instance.dice
    degrees, n = dice.uniform(-180, 180), dice.choice([4, 7])
    mesh = write_block(instance.path("block.msh"), (steps(0, 1, n), steps(0, 1, n)),
                       lambda middle, normal: False, turned(degrees))
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    X, Y = f"({c!r}*x + {s!r}*y)", f"({c!r}*y - {s!r}*x)"
    pressure = log_uniform(dice, 1e-3, 1e3)
    F = f"({pressure!r}*(1 + 0.5*cos(2*pi*t)))"
    t = [f"(-{F}*if({X} > 0.9999, 1, 0))", f"(-{F}*if({Y} > 0.9999, 1, 0))"]
    results = instance.run("block", SQUARE, {
        "Geometry/Mesh file": str(mesh), "Boundary/Loaded": f"{RIGHT}, {TOP}",
        "Boundary/Crack": "none", "Boundary/Contact": f"{LEFT}, {BOTTOM}",
        "Discretisation/Degree": dice.choice("12"),
        "Time integration/Steps per period": "4", "Crack tip/Stress intensity": "false",
        "Loads/Traction": f"{c!r}*{t[0]} - {s!r}*{t[1]}; {s!r}*{t[0]} + {c!r}*{t[1]}"})
    for node in results.table("lip.csv")["largest_pressure"]:
        instance.expect("pressure of a node", node, 1.5 * pressure, 1e-7 * pressure)
    instance.expect("force over length", max(results.table("contact.csv")["force"]) / 2,
                    1.5 * pressure, 1e-7 * pressure)
