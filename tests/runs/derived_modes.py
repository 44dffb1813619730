"""Families of derived numbers of mixed modes, and of other units."""

import copy
import math

from cracked import steps, turned, write_block
from derived_draws import (PLAIN, SQUARE, Wave, growth, log_uniform, plate, same_tip,
                           stress_state, tip_of)


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
