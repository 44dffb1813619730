"""Families of derived numbers of half models: phases of a load, and the body with both
lips."""

import math

from cracked import square, square_scene, turned
from derived_draws import (GAPS, PLAIN, Wave, at_one_load, bend_of, creeping, evaluate,
                           growth, log_uniform, plate, same_creep, same_lip, same_tip,
                           tip_of)


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
