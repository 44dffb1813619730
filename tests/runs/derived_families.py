"""Families of runs whose derived numbers are known in two ways: K_op, closed parts,
Delta K, da/dN, pressures, C(t). Each function draws one instance and states its bounds.

Steps bound what samples tell of a load factor F. Its maximum lies at most h^2/8 |F''|
above the largest sample; h^2 |F''| is Wave.bend()."""

import copy
import math

import numpy
from cracked import (BOTTOM, CRACK, LEFT, RIGHT, TOP, square, square_scene, steps,
                     turned, write_block)
from interrupted_runs import check_same_bytes, has_checkpoint


class Wave:
    """A load factor of one or two harmonics and a mean."""

    def __init__(self, dice, period, mean=(-0.6, 0.6)):
        self.period = period
        self.waves = [(1., 1, dice.uniform(0, 2 * math.pi))]
        if dice.random() < 0.4:
            self.waves.append((dice.uniform(0.1, 0.4), 2, dice.uniform(0, 6.28)))
        self.mean = dice.uniform(*mean)

    def formula(self, shift=0.):
        return "(" + " + ".join([f"({self.mean!r})"] + [
            f"{a!r}*cos({n}*2*pi*(t + {shift!r})/{self.period!r} + {phase!r})"
            for a, n, phase in self.waves]) + ")"

    def fine(self):
        t = numpy.arange(20000) / 20000
        return self.mean + sum(a * numpy.cos(n * 2 * math.pi * t + phase)
                               for a, n, phase in self.waves)

    def bend(self, n_steps):
        """h^2 max |F''|."""
        return sum(a * (2 * math.pi * n / n_steps)**2 for a, n, _ in self.waves)

    def part_below(self, level, bend):
        """Of the period, and its error where F is off by a bend at each crossing."""
        values = self.fine()
        below = values < level
        slope = min((abs(values[k] - values[k - 1]) * len(values)
                     for k in numpy.flatnonzero(below != numpy.roll(below, 1))),
                    default=math.inf)
        crossings = int(numpy.sum(below != numpy.roll(below, 1)))
        return below.mean(), crossings * bend / slope + 1e-4 if crossings else 1e-4


PLAIN = """
subsection Material
  set Poisson ratio = 0.3
end
subsection Output
  set Fields = none
end
"""


def log_uniform(dice, low, high):
    return math.exp(dice.uniform(math.log(low), math.log(high)))


def growth(dice):
    """Paris' law without a threshold."""
    return {"Crack tip/Crack growth law": "paris",
            "Crack tip/Paris factor": repr(log_uniform(dice, 1e-8, 1e-4)),
            "Crack tip/Paris exponent": repr(dice.choice([2., 3., 4.5]))}


def plate(dice):
    """A built-in half model; the place along its lip: 0 at the tip, 1 at the mouth."""
    shape = dice.choice(["edge crack", "centre crack"])
    width, length = dice.choice([(1., 0.5), (2., 0.5), (1., 0.375)])
    cells = dice.choice(["8, 8", "16, 8", "8, 4"])
    settings = {"Geometry/Shape": shape, "Geometry/Width": repr(width),
                "Geometry/Crack length": repr(length),
                "Geometry/Subdivisions": cells,
                "Discretisation/Degree": dice.choice("122"),
                "Material/Young modulus": repr(log_uniform(dice, 100., 1e5)),
                "Material/Plane state": dice.choice(["plane stress", "plane strain"])}
    if dice.random() < 0.4:
        settings["Discretisation/Singular functions"] = "0"
    place = (lambda x: f"(({x})-{width - length!r})/{length!r}") if shape == \
        "edge crack" else (lambda x: f"({length!r}-({x}))/{length!r}")
    return settings, place


GAPS = ["0", "1", "{0}", "1-{0}", "{0}*{0}", "({0}-0.5)^2", "1-{0}*{0}"]


def evaluate(formula, x):
    return eval(formula.replace("^", "**"), {"x": x})  # numbers and x alone


def tip_of(results):
    return results.summary["crack_tip"]


def at_one_load(instance, settings):
    """K, places and openings of the lip of a unit load without gap."""
    results = instance.run("unit", PLAIN, {
        **settings, "Loads/Traction": "0; 1", "Time integration/Steps per period": "1",
        "Boundary/Gap": "0", "Material/Viscosity": "none"})
    lip = results.table("lip.csv")
    return tip_of(results)["K_I"]["largest"], lip["x"], lip["largest_opening"]


def phase_elastic(instance):
    """Once the lip is open all is in proportion to the load: it opens wholly where
    F a_i + |g_i| > 0 at all nodes, with the openings a_i of a unit load."""
    dice = instance.dice
    settings, place = plate(dice)
    settings |= {"Material/Viscosity": "none", **growth(dice)}
    n_steps = dice.choice([20, 40, 80])
    size, form = log_uniform(dice, 0.1, 100.), dice.choice(GAPS).format(place("x"))
    if settings["Geometry/Shape"] == "centre crack" and dice.random() < 0.4:
        settings["Material/Plane state"] = "axisymmetric"  # reaches the axis
    # There are none in a ring, and "automatic" takes none with a gap.
    settings["Discretisation/Singular functions"] = dice.choice("02") if form == "0" and \
        settings["Material/Plane state"] != "axisymmetric" else "0"
    K, x, openings = at_one_load(instance, settings)
    depth = dice.uniform(0.05, 0.9) * size * max(openings)
    gaps = [depth * max(evaluate(form, at), 0.) for at in x]
    opens_at = max(-g / a for g, a in zip(gaps, openings)) / size
    tip_x = float(settings["Geometry/Crack length"])
    if settings["Geometry/Shape"] == "edge crack":
        tip_x = float(settings["Geometry/Width"]) - tip_x
    next_to_tip = min(range(len(x)), key=lambda k: abs(x[k] - tip_x))
    # K is 0 as long as the node next to the tip is closed: if that opens last, K jumps.
    jump = abs(opens_at) if -gaps[next_to_tip] / openings[next_to_tip] / size == \
        opens_at else 0.
    wave = Wave(dice, 1.)
    while not (wave.fine().min() < opens_at - 0.1 and wave.part_below(
            opens_at, 0.)[0] < 1 - 4 / n_steps):
        wave = Wave(dice, 1., (-0.95, 0.8))
    bend = wave.bend(n_steps)
    largest = wave.fine().max()
    m, C = (float(settings[f"Crack tip/Paris {name}"]) for name in ("exponent", "factor"))
    wholly = []
    for k, shift in enumerate((0., dice.choice([
            dice.randint(1, n_steps) / n_steps, dice.uniform(0., 1.)]))):
        results = instance.run(f"phase_{k}", PLAIN, {
            **settings, "Time integration/Steps per period": str(n_steps),
            "Boundary/Gap": f"-{depth!r}*max({form}, 0)" if form != "0" else "0",
            "Loads/Traction": f"0; {size!r}*{wave.formula(shift)}"})
        tip, scale = tip_of(results), K * size
        instance.expect("K_max", tip["K_I"]["largest"] / scale, largest, bend / 8)
        K_op = tip.get("K_opening")
        # Contact is solved at the instants of opening: steps leave no error there.
        instance.expect("K_op", K_op and K_op / scale, opens_at, 1e-5 + jump)
        instance.expect("Delta_K_eff", tip["Delta_K_eff"] / scale, largest - opens_at,
                        bend / 8 + 1e-5 + jump)
        closed, error = wave.part_below(opens_at, 1e-5)
        parts = tip["closed_part"]
        instance.expect("closed at all", parts["wholly"] + parts["partly"], closed, error)
        if form == "0":
            instance.expect("wholly closed", parts["wholly"], closed, error)
            instance.expect("Delta_K", tip["Delta_K"] / scale, largest, bend / 8)
            instance.expect("da_dN", tip["da_dN"] / C / (scale * largest)**m, 1.,
                            1.1 * m * bend / 8 / largest + 1e-9)
            for node in results.table("lip.csv")["closed_part"]:
                instance.expect("closed part of a node", node, closed, error)
        elif wholly:
            # A progressive contact bends where nodes close: a step for each end.
            instance.expect("wholly closed", parts["wholly"], wholly[0], 2 / n_steps)
        wholly.append(parts["wholly"])


def creeping(dice, period):
    kind = dice.choice(["relaxation time", "isotropic", "chain"])
    tau = period * log_uniform(dice, 0.05, 3.)
    settings = {"Material/Viscosity": kind}
    if kind == "relaxation time":
        settings["Material/Relaxation time"] = f"{tau!r}*if(x<0.6, 1, 0.3)"
    elif kind == "isotropic":
        settings["Material/Viscous Poisson ratio"] = dice.choice(["0.2", "0.3", "0.45"])
    else:
        settings["Material/Chain"] = f"0.5: {tau!r}; 0.3: {5 * tau!r}"
    return settings, tau


def bend_of(values):
    """The largest second difference of samples of a period: what its step leaves."""
    return max(abs(values[k - 1] - 2 * values[k] + values[(k + 1) % len(values)])
               for k in range(len(values)))


def phase_creeping(instance):
    """Whole steps change nothing but the numbers of the samples."""
    dice = instance.dice
    settings, _ = plate(dice)
    period = log_uniform(dice, 0.1, 1e4)
    more, tau = creeping(dice, period)
    settings |= more | growth(dice) | {"Loads/Period": repr(period)}
    if settings["Material/Viscosity"] == "isotropic":
        settings["Material/Viscous modulus"] = repr(
            tau * float(settings["Material/Young modulus"]))
    n_steps = dice.choice([20, 40, 60])
    whole_steps = dice.random() < 0.5
    method = dice.choice(["automatic", "fourier", "anderson", "march"])
    scheme = {"automatic": "automatic", "fourier": "trapezoid"}.get(
        method, dice.choice(["sdirk2", "trapezoid"]))
    settings |= {"Time integration/Scheme": scheme, "Periodic state/Method": method,
                 "Time integration/Steps per period": str(n_steps)}
    wave = Wave(dice, period, (-0.3, 0.3))
    shape = dice.choice(["", "", f"*(0.5 + x/{settings['Geometry/Width']})"])
    shifts = 0., (dice.randint(1, n_steps - 1) + (
        0. if whole_steps else dice.uniform(0.2, 0.8))) * period / n_steps
    one, other = (instance.run(f"phase_{k}", PLAIN, {
        **settings, "Loads/Traction": f"0; {wave.formula(shift)}{shape}"})
        for k, shift in enumerate(shifts))
    tips = tip_of(one), tip_of(other)
    history = one.table("crack_tip.csv")["K_I"][-n_steps - 1:-1]
    size = max(map(abs, history))
    # The tolerance of the search, or that and what a step leaves of K.
    allowed = 1e-4 * size + (0. if whole_steps else bend_of(history))
    m = float(settings["Crack tip/Paris exponent"])
    for name in ("K_opening", "Delta_K", "Delta_K_eff"):
        instance.expect(name, tips[1].get(name), tips[0].get(name), 2 * allowed)
    for name in ("largest", "smallest"):
        instance.expect(f"{name} K", tips[1]["K_I"][name], tips[0]["K_I"][name], allowed)
    instance.expect("da_dN", tips[1]["da_dN"] / tips[0]["da_dN"], 1.,
                    2.2 * m * allowed / tips[0]["Delta_K"])
    step = 1e-3 if whole_steps else 1.5 / n_steps  # of two instants of a change
    for name in ("wholly", "partly"):
        instance.expect(f"closed {name}", tips[1]["closed_part"][name],
                        tips[0]["closed_part"][name], step)
    lips = [results.table("lip.csv") for results in (one, other)]
    for a, b in zip(*(lip["closed_part"] for lip in lips)):
        instance.expect("closed part of a node", b, a, step)
    if whole_steps:
        instance.expect_all("largest pressure", lips[1]["largest_pressure"],
                            lips[0]["largest_pressure"], 1e-3)


def half_and_full(instance):
    """Both lips of a symmetric body, turned or not, against its upper half."""
    dice = instance.dice
    kind = dice.choice(["none", "none", "relaxation time", "power law"])
    # C(t) needs a square of two cells around the tip.
    n = 20 if kind == "power law" else dice.choice([14, 16, 20])
    degrees = dice.choice([0., dice.uniform(-80, 80)])
    soft = dice.uniform(0.2, 0.8)

    def material(middle):
        return 1 + (abs(middle[1]) > soft)
    meshes = [square(instance.path(name), n, degrees if name == "full.msh" else 0.,
                     half=name == "half.msh", material=material)
              for name in ("half.msh", "full.msh")]
    wave, gap = Wave(dice, 600.), dice.choice(["0", "1", "(x-0.5)", "(1-x)"])
    depth = dice.uniform(0.1, 2) * 1e-3
    n_steps = dice.choice([20, 40])
    settings = {
        "Discretisation/Degree": dice.choice("12"), "Material/Viscosity": kind,
        "Material/Young modulus": "13000*material",
        "Material/Relaxation time": "60*material",
        "Time integration/Steps per period": str(n_steps),
        "Time integration/Scheme": "sdirk2" if kind == "power law" else "automatic",
        "Periodic state/Method": "march" if kind == "power law" else "automatic",
        "Periodic state/Tolerance": "0" if kind == "power law" else "1e-7",
        "Periodic state/Maximum periods": "1" if kind == "power law" else "100",
        "Output/Fields": "none"}
    if kind == "power law":
        settings |= {"Material/Creep exponent": "3", "Material/Creep coefficient": "3e-8",
                     "Crack tip/Creep integral": "true"}
    else:
        settings |= growth(dice)
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    x, y = f"({c!r}*x + {s!r}*y)", f"({c!r}*y - {s!r}*x)"
    force = f"10*{wave.formula()}*(1 + 0.5*{{}})"
    half = instance.run("half", square_scene(meshes[0], half=True), {
        **settings, "Boundary/Gap": f"-{depth!r}*max({gap}, 0)" if gap != "0" else "0",
        "Loads/Traction": f"0; {force.format('x')}",
        "Output/Probes": "mouth: 1, 0"})
    force = f"{force.format(x)}*{y}"
    mouth = ", ".join(map(repr, turned(degrees)((1, 0))))
    full = instance.run("full", square_scene(meshes[1], degrees), {
        **settings, "Boundary/Gap": f"-2*{depth!r}*max({gap.replace('x', x)}, 0)"
        if gap != "0" else "0",
        "Loads/Traction": f"{-s!r}*{force}; {c!r}*{force}",
        "Output/Probes": f"mouth: {mouth}"})
    # Rounding without creep, the tolerance of the search, or that of Newton's method.
    bound = {"none": 1e-6, "relaxation time": 1e-4, "power law": 1e-4}[kind]
    for column, factor in (("opening", 2), ("pressure", 1)):
        instance.expect_all(f"{column} of the mouth",
                            full.table("probe_mouth.csv")[column],
                            [factor * one for one in half.table(
                                "probe_mouth.csv")[column]], bound,
                            None if column == "opening" else 10.)
    for column in ("force", "largest_pressure"):
        instance.expect_all(column, full.table("contact.csv")[column],
                            half.table("contact.csv")[column], bound, 10.)
    same_lip(instance, half, full, bound)
    if kind == "power law":
        same_creep(instance, half, full)
    else:
        same_tip(instance, tip_of(half), full.summary["crack_tips"][0], bound,
                 fluidity=0. if kind == "none" else 1 / 13000 / 60)


def same_creep(instance, half, full):
    """Rates are recovered from both sides of the ligament, or one. The printed errors
    are estimates: twice their sum. A rate is a difference over two steps: where nodes
    opened or closed in them, C(t) is uncertain by what it changes in a step."""
    tables = half.table("creep_integral.csv"), full.table("creep_integral_1.csv")
    contact = half.table("contact.csv")
    times, closed, C = contact["t"], contact["closed_nodes"], tables[0]["C_t"]
    for k, t in enumerate(tables[0]["t"]):
        errors = sum(table["C_t_error"][k] for table in tables)
        at = times.index(t)
        changes = len(set(closed[at - 2:at + 1])) > 1
        instance.expect(f"C(t = {t})", tables[1]["C_t"][k], C[k], 2 * errors
                        + 0.02 * max(C) + changes * abs(C[k] - C[max(k - 1, 0)]))


def same_lip(instance, one, other, bound):
    """Of half and full model: nodes in one order along the lip."""
    lips = [results.table("lip.csv") for results in (one, other)]
    order = [sorted(range(len(lip["x"])), key=lambda k: math.hypot(
        lip["x"][k], lip["y"][k])) for lip in lips]
    for column, factor, scale in (("largest_opening", 2, None), ("closed_part", 1, 1.),
                                  ("largest_pressure", 1, None)):
        mine, theirs = ([lip[column][k] for k in along]
                        for lip, along in zip(lips, order))
        instance.expect_all(f"lip.csv, {column}", theirs, [factor * a for a in mine],
                            10 * bound, scale)
    for name in ("wholly", "partly"):
        instance.expect(f"closed {name}", other.summary["closed_part"][name],
                        one.summary["closed_part"][name], 10 * bound)


def same_tip(instance, one, other, bound, factor=1., fluidity=0.):
    """Of a mode I tip: its K and what follows; C* is K^2 times a fluidity, or less."""
    size = max(abs(one["K_I"][name]) for name in ("largest", "smallest"))
    pairs = [(f"{name} K", one["K_I"][name], other["K_I"][name])
             for name in ("largest", "smallest")]
    pairs += [(name, one.get(name), other.get(name))
              for name in ("K_opening", "Delta_K", "Delta_K_eff")]
    for name, mine, theirs in pairs:
        instance.expect(name, theirs, mine and mine * factor, 10 * bound * size * factor)
    if fluidity:
        instance.expect("C*", other["C_star"], one["C_star"],
                        10 * bound * size**2 * fluidity)
    if one.get("da_dN"):
        instance.expect("da_dN", other["da_dN"] / one["da_dN"], 1, 100 * bound)
    for name in ("wholly", "partly"):
        instance.expect(f"tip closed {name}", other["closed_part"][name],
                        one["closed_part"][name], 10 * bound)


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


# Sides of the square |X|, |Y| < 1 with a crack within, which is turned as a whole.
SQUARE = f"""
subsection Geometry
  set Shape = mesh file
end
subsection Boundary
  set Loaded = {LEFT}, {RIGHT}, {BOTTOM}, {TOP}
  set Crack = {CRACK}
end
subsection Material
  set Young modulus = 1000
  set Viscosity = none
end
subsection Output
  set Fields = none
end
"""


def cracked_plate(instance, name, ends, degrees=0., mirrored=False, length=1.,
                  bend=0.):
    """A crack on Y = 0 between two of 16 by 16 cells; bend moves nodes within, and
    not those of the crack."""
    turn = turned(degrees)

    def place(point):
        X, Y = point
        inside = bend * (1 - X * X) * (1 - Y * Y)
        X, Y = X + inside * Y * (1 + X), Y * (1 + inside * X)
        return turn((length * (-X if mirrored else X), length * Y))
    axis = steps(-1, 1, 16)
    return write_block(instance.path(name), (axis, axis), lambda middle, normal: (
        normal == 1 and middle[1] == 0 and ends[0] < middle[0] < ends[1]), place)


def stress_state(S, degrees=0., length=1.):
    """Supports and tractions of a uniform stress 11, 22, 12 of the square before it is
    turned; formulas of t."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    side = [f"(if({X} > {0.9999 * length!r}, 1, 0) - if({X} < {-0.9999 * length!r}, 1, 0))"
            for X in (f"({c!r}*x + {s!r}*y)", f"({c!r}*y - {s!r}*x)")]
    t = [f"({S[0]}*{side[0]} + {S[2]}*{side[1]})", f"({S[2]}*{side[0]} + {S[1]}*{side[1]})"]
    turn = turned(degrees)
    points = [", ".join(map(repr, turn((X * length, -length)))) for X in (-1, 1)]
    return {"Boundary/Fixed points":
            f"{points[0]}; {points[1]}: {1 if abs(s) > abs(c) else 2}",
            "Loads/Traction": f"{c!r}*{t[0]} - {s!r}*{t[1]}; {s!r}*{t[0]} + {c!r}*{t[1]}"}


def same_tips(instance, one, other, bound, sign=1., scale=1., growth_ratio=1.):
    """Tips in one order: K_I and K_II of equal or opposite sign, and what follows."""
    size = scale * max(abs(tip[K][name]) for tip in one for K in ("K_I", "K_II")
                       for name in ("largest", "smallest"))
    for k, (mine, theirs) in enumerate(zip(one, other, strict=True)):
        range_II = [scale * sign * mine["K_II"][name] for name in ("largest", "smallest")]
        pairs = [(f"{name} K_I", theirs["K_I"][name], scale * mine["K_I"][name])
                 for name in ("largest", "smallest")]
        pairs += [("largest K_II", theirs["K_II"]["largest"], max(range_II)),
                  ("smallest K_II", theirs["K_II"]["smallest"], min(range_II))]
        pairs += [(name, theirs.get(name), mine.get(name) and scale * mine[name])
                  for name in ("Delta_K", "Delta_K_eff", "K_opening")]
        for name, value, expected in pairs:
            instance.expect(f"tip {k + 1}, {name}", value, expected, bound * size)
        instance.expect(f"tip {k + 1}, da_dN", theirs["da_dN"] / mine["da_dN"],
                        growth_ratio, 10 * bound * growth_ratio)
        for name in ("wholly", "partly"):
            instance.expect(f"tip {k + 1}, closed {name}", theirs["closed_part"][name],
                            mine["closed_part"][name], 10 * bound)


def mixed_case(dice):
    ends = dice.choice([(-0.5, 0.5), (-0.25, 0.5), (-0.75, 0.125)])
    return ends, {**growth(dice), "Discretisation/Degree": dice.choice("12"),
                  "Time integration/Steps per period": str(dice.choice([20, 40]))}


def mirrored_modes(instance):
    """A body turned by any angle, or seen in a mirror, has the same K_I and growth,
    and a mirror changes the sign of K_II."""
    dice = instance.dice
    ends, settings = mixed_case(dice)
    waves = [Wave(dice, 1.) for _ in range(3)]
    amplitude = [dice.uniform(1, 20) for _ in range(3)]
    S = [f"{a!r}*{wave.formula()}" for a, wave in zip(amplitude, waves)]
    bend, degrees = dice.choice([0., dice.uniform(0.05, 0.2)]), dice.uniform(-180, 180)
    mirrored = dice.random() < 0.6
    mesh = cracked_plate(instance, "one.msh", ends, bend=bend)
    one = instance.run("one", SQUARE, {
        **settings, "Geometry/Mesh file": str(mesh), **stress_state(S)})
    mesh = cracked_plate(instance, "other.msh", ends, degrees, mirrored, bend=bend)
    shear = f"-1*({S[2]})" if mirrored else S[2]
    other = instance.run("other", SQUARE, {
        **settings, "Geometry/Mesh file": str(mesh),
        **stress_state([S[0], S[1], shear], degrees)})
    back = turned(-degrees)

    def along(tip):
        return back(tip["position"])[0] * (-1 if mirrored else 1)
    same_tips(instance, one.summary["crack_tips"],
              sorted(other.summary["crack_tips"], key=along), 1e-6,
              -1. if mirrored else 1.)


def reversed_modes(instance):
    """A closed crack slides in proportion to the shear: fully reversed, its range is
    twice that of half the range. An open crack under constant tension does not know
    the mean of the shear."""
    dice = instance.dice
    ends, settings = mixed_case(dice)
    closed = dice.random() < 0.5
    normal = dice.uniform(-40, -20) if closed else dice.uniform(20, 40)
    shear, n = dice.uniform(2, 9), int(settings["Time integration/Steps per period"])
    phase = dice.randint(0, n) / n  # extremes are samples in both runs
    wave = f"{shear!r}*sin(2*pi*(t + {phase!r}))"
    mesh = str(cracked_plate(instance, "plate.msh", ends))
    tips = [instance.run(f"case_{k}", SQUARE, {
        **settings, "Geometry/Mesh file": mesh,
        **stress_state(["0", repr(normal), S])}).summary["crack_tips"]
        for k, S in enumerate((wave, f"0.5*({shear!r} + {wave})" if closed
                               else f"(2*{shear!r} + {wave})"))]
    m = float(settings["Crack tip/Paris exponent"])
    ratio = 2. if closed else 1.
    for k, (one, other) in enumerate(zip(*tips)):
        instance.expect(f"tip {k + 1}, Delta_K", one["Delta_K"] / other["Delta_K"], ratio,
                        1e-6)
        instance.expect(f"tip {k + 1}, da_dN", one["da_dN"] / other["da_dN"], ratio**m,
                        1e-5 * ratio**m)
        swing = [tip["K_II"]["largest"] - tip["K_II"]["smallest"] for tip in (one, other)]
        instance.expect(f"tip {k + 1}, range of K_II", swing[0] / swing[1], ratio, 1e-6)


def units(instance):
    """Lengths, stresses and times in other units, with Norton's law as well."""
    dice = instance.dice
    n = dice.choice([0, 0, 1, 3, 5, 7])  # 0: elastic
    L, P, T = 10.**dice.choice([-3, 0, 3]), 10.**dice.choice([-6, 3, 6]), \
        10.**dice.choice([-3, 0, 4])
    settings, _ = plate(dice)
    length = {name: float(settings[f"Geometry/{name}"]) for name in ("Width", "Crack length")}
    E = float(settings["Material/Young modulus"])
    wave = Wave(dice, 1., (0.2, 0.6))
    steps_per_period, load = dice.choice([20, 40]), E * log_uniform(dice, 1e-4, 1e-2)
    rate = log_uniform(dice, 0.03, 1.) / E / load**(n - 1)  # a strain as large as load/E
    found = []
    for l, p, t in ((1., 1., 1.), (L, P, T)):
        own = copy.copy(wave)
        own.period = t
        more = {"Material/Viscosity": "none", "Crack tip/Crack growth law": "paris",
                "Crack tip/Paris exponent": "3",
                "Crack tip/Paris factor": repr(1e-6 * l / (p * math.sqrt(l))**3)}
        if n:
            more = {"Material/Viscosity": "power law", "Material/Creep exponent": str(n),
                    "Material/Creep coefficient": repr(rate / p**n / t),
                    "Crack tip/Creep integral": "true",
                    "Time integration/Scheme": "sdirk2",
                    "Periodic state/Maximum periods": "1", "Periodic state/Tolerance": "0",
                    "Time integration/Newton tolerance": "1e-10",
                    "Discretisation/Singular functions": "0"}
        found.append(instance.run(f"unit_{len(found)}", PLAIN, {
            **settings, **more, **{f"Geometry/{name}": repr(l * value)
                                   for name, value in length.items()},
            "Geometry/Height": repr(l), "Geometry/Subdivisions": "8, 8",
            "Material/Young modulus": repr(E * p), "Loads/Period": repr(t),
            "Time integration/Steps per period": str(steps_per_period),
            "Loads/Traction": f"0; {load * p!r}*{own.formula()}"}))
    one, other = found
    if n:
        instance.expect_all("C(t)", other.table("creep_integral.csv")["C_t"],
                            [C * P * L / T for C in one.table("creep_integral.csv")["C_t"]],
                            1e-5)
    else:
        tip, scaled = tip_of(one), tip_of(other)
        same_tip(instance, tip, {**scaled, "da_dN": scaled["da_dN"] / L}, 1e-8,
                 P * math.sqrt(L))
    for column, factor in (("opening", L), ("pressure", P)):
        values = one.table("probe_mouth.csv")[column]
        instance.expect_all(f"{column} of the mouth", other.table("probe_mouth.csv")[column],
                            [factor * value for value in values], 1e-6,
                            P * load if column == "pressure" else None)


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


def stopped_and_resumed(instance, settings, seconds):
    """After some steps, until it ends: at the fourth time by itself."""
    for share in (0.3, 0.6, 1., None):
        words = ["--resume"] if has_checkpoint(instance.path("resumed")) else []
        if share:
            words += ["--wall-time", repr(max(share * seconds, 1e-3))]
        results = instance.run("resumed", PLAIN, settings, *words, allowed=(0, 5))
        if (results.directory / "summary.json").exists():
            break
    return results


def resumed(instance):
    """Stopped at any step or extended from any checkpoint, a run ends as one that was
    not: tables byte for byte, and all derived numbers."""
    dice = instance.dice
    settings, _ = plate(dice)
    period, periods, n_steps = 1., dice.randint(2, 5), dice.choice([10, 20])
    more, tau = creeping(dice, period)
    settings |= more | {"Loads/Period": "1"}
    if settings["Material/Viscosity"] == "isotropic":
        settings["Material/Viscous modulus"] = repr(
            tau * float(settings["Material/Young modulus"]))
    if dice.random() < 0.3:
        settings |= {"Material/Viscosity": "none"}
    settings |= growth(dice) | {
        "Loads/Traction": f"0; {Wave(dice, period).formula()}*(0.5 + x)",
        "Time integration/Steps per period": str(n_steps),
        "Time integration/Scheme": dice.choice(["heun", "sdirk2", "trapezoid",
                                                "exponential"]),
        "Time integration/Check stability": "false",
        "Periodic state/Method": dice.choice(["march", "anderson"]),
        "Periodic state/Tolerance": "0",
        "Output/Checkpoint every": str(dice.randint(1, 3))}
    whole = instance.run("whole", PLAIN, settings
                         | {"Periodic state/Maximum periods": str(periods)})
    ends = sorted({dice.randint(1, periods) for _ in range(2)} | {periods})
    if dice.random() < 0.5:
        for k, end in enumerate(ends):
            again = instance.run("resumed", PLAIN, settings | {
                "Periodic state/Maximum periods": str(end)}, *(["--resume"] if k else []))
    else:
        again = stopped_and_resumed(instance, settings
                                    | {"Periodic state/Maximum periods": str(periods)},
                                    whole.summary["seconds"]["total"])
    check_same_bytes(whole, again, f"ends {ends}")
    for name in ("crack_tip", "closed_part", "extremes", "drift"):
        mine, theirs = (r.summary.get(name) for r in (whole, again))
        instance.expect(name, 0. if mine == theirs else 1., 0., 0.5)


def creep_scene(dice):
    n = dice.choice([2, 3, 3, 5])
    load = log_uniform(dice, 1., 30.)
    E = 1000.
    # In a period the far field creeps by a part, or some times, of its elastic strain.
    rate = log_uniform(dice, 0.1, 3.) / E / load**(n - 1)
    shape = dice.choice(["1", "1", "min(1, t/0.3)", "(1 + 0.5*sin(2*pi*t))",
                         "0.5*(1 - cos(2*pi*t))"])
    return {"Geometry/Subdivisions": "8, 4", "Refinement/Strategy": "tip",
            "Refinement/Cycles": dice.choice("23"), "Discretisation/Degree": "1",
            "Discretisation/Singular functions": "0",
            "Material/Young modulus": repr(E), "Material/Viscosity": "power law",
            "Material/Creep exponent": str(n), "Material/Creep coefficient": repr(rate),
            "Loads/Traction": f"0; {load!r}*{shape}", "Periodic state/Method": "march",
            "Periodic state/Maximum periods": "1", "Periodic state/Tolerance": "0",
            "Crack tip/Creep integral": "true", "Crack tip/Crack growth law": "creep",
            "Crack tip/Creep growth parameter": "C(t)", "Crack tip/Creep factor": "1",
            "Crack tip/Creep exponent": "0.8"}, shape


OTHER_SCHEMES = [
    {"Time integration/Scheme": "trapezoid"},
    {"Time integration/Scheme": "arkode implicit"},
    {"Time integration/Scheme": "arkode implicit",
     "Time integration/Step control": "adaptive"},
    {"Time integration/Scheme": "sdirk2", "Time integration/Step control": "adaptive",
     "Time integration/Relative tolerance": "1e-3"},
    {"Time integration/Scheme": "sdirk2", "Time integration/Step control": "list"}]


def growing_steps(n_steps):
    """From a thousandth of equal steps on, until they are as long as those."""
    instants, step = [], 1e-3 / n_steps
    while (instants[-1:] or [0.])[0] + step < 1:
        instants.append((instants[-1:] or [0.])[0] + step)
        step = min(1.3 * step, 1 / n_steps)
    return ", ".join(map(repr, instants))


def schemes(instance):
    """C(t) at the end, the opening and the growth by implicit schemes: halving the
    steps of sdirk2 tells its error, the program prints that of C(t)."""
    dice = instance.dice
    settings, shape = creep_scene(dice)
    n_steps, other = dice.choice([20, 40]), dict(dice.choice(OTHER_SCHEMES))
    if other.get("Time integration/Step control") == "list":
        other["Time integration/Steps"] = growing_steps(n_steps)
    coarse, fine, by_other = (instance.run(label, PLAIN, {
        **settings, "Time integration/Scheme": "sdirk2",
        "Time integration/Steps per period": str(n), **more})
        for label, n, more in (("coarse", n_steps, {}), ("fine", 2 * n_steps, {}),
                               ("other", n_steps, other)))

    def numbers(results):
        tip, mouth = results.summary["creep_integrals"][0], results.table("probe_mouth.csv")
        return {"C(t)": tip["last"], "opening": mouth["opening"][-1],
                "da_dN": tip["da_dN"]}, tip["error_of_last"]
    (of_coarse, _), (of_fine, error), (found, other_error) = map(
        numbers, (coarse, fine, by_other))
    for name, value in found.items():
        if name == "da_dN" and shape == "1":
            continue  # C(t) ~ 1/t: the growth in the first step is none of its error
        allowed = 2 * abs(of_coarse[name] - of_fine[name]) + 0.02 * abs(of_fine[name])
        if name != "opening":
            allowed += error + other_error if name == "C(t)" else 0.05 * abs(of_fine[name])
        instance.expect(f"{name} by {other['Time integration/Scheme']}", value,
                        of_fine[name], allowed)
    instance.expect("C(t) < 0", min(0., found["C(t)"] / of_fine["C(t)"]), 0., 0.02)


def pulse(instance):
    """A bar under a short pulse: its creep is the integral of A s^n."""
    dice = instance.dice
    n, width, at = dice.choice([1, 2, 3, 5]), dice.uniform(0.03, 0.12), dice.uniform(0.2, 0.8)
    load, E = log_uniform(dice, 1., 50.), 1000.
    rate = log_uniform(dice, 1., 30.) / E / load**(n - 1) / width
    scheme = dice.choice([{"Time integration/Scheme": "sdirk2"}, *OTHER_SCHEMES[:4],
                          {"Time integration/Scheme": "heun"}])
    adaptive = "Time integration/Step control" in scheme
    n_steps = dice.choice([20, 40]) if adaptive else math.ceil(8 / width)
    results = instance.run("bar", PLAIN, {
        "Geometry/Shape": "rectangle", "Geometry/Subdivisions": "2, 2",
        "Material/Young modulus": repr(E), "Material/Viscosity": "power law",
        "Material/Creep exponent": str(n), "Material/Creep coefficient": repr(rate),
        "Loads/Traction": f"0; {load!r}*max(0, 1 - abs(t - {at!r})/{width!r})",
        "Periodic state/Method": "march", "Periodic state/Maximum periods": "1",
        "Periodic state/Tolerance": "0", "Output/Probes": "top: 0.5, 1",
        "Time integration/Check stability": "false",
        "Time integration/Steps per period": str(n_steps), **scheme})
    crept = results.table("probe_top.csv")["u_2"][-1]
    exact = rate * load**n * 2 * width / (n + 1)
    # Rules of second order over a peak with a kink: h^2 max f'' / 12 over the pulse
    # and h^2 f' / 4 at its kinks, with f = (1 - s/width)^n. Adaptive steps find the
    # pulse, with fifty times their tolerance of the stress or less.
    h = 1 / n_steps / width
    allowed = 0.05 if adaptive else (n + 1) * (n * (n - 1) / 12 + n / 4) * h**2 + 1e-3
    instance.expect(f"creep by {scheme}", crept / exact, 1., allowed)


FAMILIES = {"phase, elastic": phase_elastic, "phase, creeping": phase_creeping,
            "half and full": half_and_full, "penny": penny, "wide ring": wide_ring,
            "mirrored, turned": mirrored_modes, "reversed modes": reversed_modes,
            "units": units, "kinked lips": kinked_lips, "rigid corner": blocked_corner,
            "resumed": resumed, "creep schemes": schemes, "pulse": pulse}
