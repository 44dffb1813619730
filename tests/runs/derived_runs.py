"""Families of derived numbers of runs that are resumed, of schemes and of steps, of
jumps, and of viscosities written in two ways."""

import math

from derived_draws import (PLAIN, Wave, creeping, growth, log_uniform, plate, same_tip,
                           tip_of)
from interrupted_runs import check_same_bytes, has_checkpoint


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


def written(instance):
    """A viscosity in its modulus, or time, or in its factor; with a mean load or not."""
    dice = instance.dice
    settings, _ = plate(dice)
    tau, E = log_uniform(dice, 0.05, 3.), float(settings["Material/Young modulus"])
    name, value = dice.choice([("Viscous modulus", tau * E), ("Relaxation time", tau)])
    kind = "isotropic" if name == "Viscous modulus" else "relaxation time"
    settings |= growth(dice) | {
        "Material/Viscosity": kind, "Material/Viscous Poisson ratio": "0.3",
        "Loads/Traction": f"0; {Wave(dice, 1.).formula()}",
        "Time integration/Steps per period": "20",
        "Time integration/Scheme": dice.choice(["sdirk2", "trapezoid"]),
        "Periodic state/Method": dice.choice(["march", "anderson"]),
        "Periodic state/Tolerance": "1e-7", "Periodic state/Maximum periods": "400"}
    one, other = (instance.run(f"written_{k}", PLAIN, settings | {
        f"Material/{name}": repr(value / factor),
        "Material/Viscosity time factor": repr(factor)})
        for k, factor in enumerate((1., log_uniform(dice, 1e-3, 1e3))))
    same_tip(instance, tip_of(one), tip_of(other), 1e-6, fluidity=1 / E / tau)
    forces = [results.summary["secular"].get("contact_force") for results in (one, other)]
    instance.expect("mean contact force", forces[1], forces[0], 1e-6)


def shifted_jumps(instance):
    """The phase of a load with a jump changes nothing, if steps end there: K_max and
    growth are those of the factor of the load."""
    dice = instance.dice
    settings, _ = plate(dice)
    n_steps, width = dice.choice([8, 20]), dice.uniform(0.2, 0.9)
    first, slope = dice.randint(0, n_steps - 1), dice.uniform(-0.9, 3.)
    settings |= {"Crack tip/Crack growth law": "creep", "Crack tip/Creep factor": "1",
                 "Crack tip/Creep growth parameter": "stress intensity",
                 "Crack tip/Creep exponent": "1", "Time integration/Scheme": "automatic"}
    if dice.random() < 0.5:
        settings |= {"Material/Viscosity": "relaxation time",
                     "Time integration/Scheme": "sdirk2"}
    else:
        settings |= {"Material/Viscosity": "none"}
    n_high = max(1, round(width * n_steps))
    K = tip_of(instance.run("unit", PLAIN, settings | {
        "Loads/Traction": "0; 1", "Material/Viscosity": "none",
        "Time integration/Steps per period": "1"}))["K_I"]["largest"]
    place = f"(t - {first / n_steps!r} - floor(t - {first / n_steps!r} + 1e-13))"
    end = n_high / n_steps
    tip = tip_of(instance.run("jumps", PLAIN, settings | {
        "Loads/Period": "1", "Time integration/Steps per period": str(n_steps),
        "Loads/Traction": f"0; if({place} < {end - 1e-13!r}, 1 + {slope!r}*{place}, 0.05)"}))
    largest = max(1., 1 + slope * end, 0.05)
    instance.expect("K_max", tip["K_I"]["largest"] / K, largest, 1e-5)
    instance.expect("da_dN", tip["da_dN"] / K, end + slope * end**2 / 2
                    + 0.05 * (1 - end), 1e-5)
