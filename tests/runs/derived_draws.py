"""What families of derived numbers draw and compare: loads, plates, growth laws; tips and
lips of two runs."""

import math

import numpy
from cracked import BOTTOM, CRACK, LEFT, RIGHT, TOP, turned


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
