"""Creep by a power of the stress: closed forms of bars and of a tube, the linear
law, the limit of explicit steps, periodic states."""

import math
import re

import tubes
from bars import BAR
from crevasse_run import (SOURCE, check, check_below, check_close, execute, full,
                          overrides, run, run_on, tier)

E, A = 13000., 1e-6
POWER_LAW = ["Material/Viscosity=power law", "Material/Plane state=plane stress"]


def exactly(scheme):
    implicit = scheme in ("sdirk2", "arkode implicit")
    return ["Time integration/Newton tolerance=1e-12"] if implicit else []


def law(n, stress):
    """A coefficient that makes all exponents creep alike at a stress."""
    return [f"Material/Creep exponent={n}",
            f"Material/Creep coefficient={A * stress ** (1 - n)!r}"]


def test_linear():
    """The exponent 1 is Maxwell's body that keeps its volume."""
    for scheme, bound in (("heun", 1e-13), ("sdirk2", 1e-10)):
        settings = ["Material/Plane state=plane strain",
                    f"Time integration/Scheme={scheme}"]
        maxwell = run(BAR, "maxwell", [
            "Material/Viscosity=isotropic", f"Material/Viscous modulus={1 / A!r}",
            "Material/Viscous Poisson ratio=0.5", *settings])
        power = run(BAR, "exponent_1", [
            *POWER_LAW, *law(1, 1.), *settings, *exactly(scheme)])
        mine, theirs = (results.table("probe_top.csv") for results in (power, maxwell))
        for column in ("u_2", "s_22", "s_33"):
            size = max(map(abs, theirs[column]))
            check_below(max(abs(a - b) for a, b in zip(mine[column], theirs[column],
                                                       strict=True)) / size,
                        bound, f"exponent 1, {scheme}, {column}")


def test_creeping_bar():
    """Under a constant stress the rate is A s^n: every scheme is exact."""
    for n, scheme in ((3, "heun"), (5, "heun"), (8, "heun"), (8, "sdirk2")):
        results = run(BAR, f"creeping_{n}", [
            *POWER_LAW, *law(n, 10.), "Loads/Traction=0; 10",
            f"Time integration/Scheme={scheme}", *exactly(scheme)])
        table = results.table("probe_top.csv")
        for t, u in zip(table["t"], table["u_2"], strict=True):
            check_below(abs(u / (10 / E + A * 10 * t) - 1), 1e-12,
                        f"n = {n}, t = {t}")


def relaxed(n, t, start):
    """The stress of a bar of fixed length."""
    rate = A * start ** (1 - n)
    if n == 1:
        return start * math.exp(-E * rate * t)
    return (start ** (1 - n) + (n - 1) * E * rate * t) ** (1 / (1 - n))


def relaxing(n, n_steps, scheme):
    """The error at the end of a bar that is cooled at once, held at both ends."""
    start = 10.
    results = run(BAR, f"relaxing_{n}", [
        *POWER_LAW, *law(n, start), "Loads/Traction=", "Boundary/Loaded=none",
        "Boundary/Symmetry=2, 3", "Material/Thermal expansion=1e-5",
        f"Loads/Temperature={-start / E / 1e-5!r}",
        f"Time integration/Scheme={scheme}", *exactly(scheme),
        f"Time integration/Steps per period={n_steps}"])
    table = results.table("probe_top.csv")
    return abs(table["s_22"][-1] / relaxed(n, table["t"][-1], start) - 1)


@full
def test_relaxing_bar():
    for scheme, order in (("euler", 1), ("heun", 2), ("rk4", 4),
                          ("sdirk2", 2), ("arkode implicit", 4)):
        for n in (1, 3, 5, 8):
            errors = [relaxing(n, n_steps, scheme) for n_steps in (40, 80)]
            found = math.log2(errors[0] / errors[1])
            print(f"{scheme}, n = {n}: {errors[1]:.1e}, order {found:.2f}")
            check(found > order - 0.3, f"{scheme}, n = {n}: order {found}")


def test_arrhenius():
    """A rate A exp(-Q/theta) at a temperature that differs from place to place:
    the bars side by side do not know of one another, for none is held."""
    n, stress = 5, 10.
    results = run(BAR, "arrhenius", [
        *POWER_LAW, *law(n, stress)[:1], f"Loads/Traction=0; {stress}",
        "Loads/Temperature=200*sin(2*pi*t/600)",
        f"Material/Creep coefficient={A * stress ** (1 - n)!r}"
        "*exp(-2000/(theta + 873) + 2000/873)",
        "Time integration/Scheme=rk4", "Time integration/Steps per period=80"])
    table = results.table("probe_top.csv")

    def rate(t):
        theta = 200 * math.sin(2 * math.pi * t / 600)
        return A * stress * math.exp(-2000 / (theta + 873) + 2000 / 873)
    # Simpson's rule on the steps, which RK4 is here.
    h, crept = table["t"][1], 0.
    for t in table["t"][:-1]:
        crept += h / 6 * (rate(t) + 4 * rate(t + h / 2) + rate(t + h))
    check_below(abs(table["u_2"][-1] / (stress / E + crept) - 1), 1e-10,
                "Arrhenius, displacement")


def test_tube():
    """Steady creep of a thick tube under pressure, in plane strain, reached from
    the elastic state: stresses of order 2 in the mesh, and extrapolated."""
    n, radii, stresses = 5, (1.25, 1.5, 1.75), []
    for rings in (12, 24):
        mesh = tubes.write("tube.msh", rings, rings, order=1)
        results = run(tubes.TUBE, f"tube_{rings}", [
            mesh, "Material/Viscosity=power law", "Material/Young modulus=1000",
            f"Material/Creep exponent={n}", "Material/Creep coefficient=1e-3",
            "Discretisation/Degree=1", "Discretisation/Volumetric strain=mean",
            "Loads/Period=30", "Time integration/Steps per period=30",
            "Time integration/Scheme=arkode explicit", "Time integration/Order=4",
            "Time integration/Step control=adaptive",
            "Time integration/Relative tolerance=1e-4",
            "Output/Probes=" + "; ".join(f"r{100 * r:.0f}: {r}, 0" for r in radii)])
        stresses.append([results.table(f"probe_r{100 * r:.0f}.csv")[column][-1] for r in radii
                         for column in ("s_11", "s_22", "s_33")])
    expected = []
    for r in radii:
        power, size = (2 / r) ** (2 / n), 2 ** (2 / n) - 1
        radial, hoop = (1 - power) / size, (1 + (2 / n - 1) * power) / size
        expected += [radial, hoop, (radial + hoop) / 2]
    coarse, fine = (max(abs(a - b) for a, b in zip(found, expected, strict=True))
                    for found in stresses)
    check_close(math.log2(coarse / fine), 2, 0.1, f"tube, order ({fine:.1e})")
    for a, b, exact in zip(*stresses, expected, strict=True):
        check_below(abs(b + (b - a) / 3 - exact), 2e-5, f"tube, stress {exact:.4f}")


def test_limit_of_steps():
    """The stress bounds the step: the program says so, and adapts it, also to
    a stress that grows within the period."""
    settings = [*POWER_LAW, *law(5, 5.), "Loads/Traction=0; 20"]
    with open("bar.prm", "w", encoding="utf-8") as file:
        file.write(BAR)
    status, _, error = execute("bar.prm", "--output", "results/unstable",
                               *overrides(settings))
    check(status == 3 and "is stable with steps of at most" in error, error)
    # Where all strain is creep the bar relaxes what it bears, and steps beyond
    # the bound would make the stress grow; the tolerance would allow them.
    held = [*POWER_LAW, *law(5, 10.), "Loads/Traction=", "Boundary/Loaded=none",
            "Boundary/Symmetry=2, 3", "Material/Thermal expansion=1e-5",
            "Loads/Temperature=-200*sin(2*pi*t/600)",
            "Time integration/Relative tolerance=1e-2"]
    exact = run(BAR, "held", [*held, "Time integration/Scheme=rk4",
                              "Time integration/Steps per period=4000"])
    exact = exact.table("probe_top.csv")["s_22"]
    size = max(map(abs, exact))
    for scheme in ("heun", "arkode explicit"):
        results = run(BAR, f"adapted_{scheme.split()[0]}", [
            *held, f"Time integration/Scheme={scheme}",
            "Time integration/Step control=adaptive",
            "Time integration/Steps per period=8"])
        table = results.table("probe_top.csv")
        check_below(max(abs(stress - exact[round(t / 600 * 4000)])
                        for t, stress in zip(table["t"], table["s_22"], strict=True))
                    / size, 4e-2, f"{scheme}, adaptive")
        if scheme == "heun":
            of_bound = [(after - t) * 5 * E * A * (stress / 10) ** 4 / 2 for
                        t, after, stress in zip(table["t"], table["t"][1:],
                                                table["s_22"])]
            print(f"largest step: {max(of_bound):.2f} of the bound")
            check(0.5 < max(of_bound) < 1, "the bound limits no step, or too late")


def test_advice_on_steps():
    """Steps beyond the bound may make the stress grow before they are refused. The
    number of steps in the message is that of the elastic stress: it is enough."""
    plate = BAR.replace("Shape        = rectangle", "Shape = edge crack")
    settings = ["Geometry/Subdivisions=8, 4", *POWER_LAW, *law(5, 15.),
                "Loads/Traction=0; 10*sin(2*pi*t/600) - 3",
                "Time integration/Scheme=rk4", "Periodic state/Maximum periods=2",
                "Output/Probes=mouth: 1, 0"]
    with open("advice.prm", "w", encoding="utf-8") as file:
        file.write(plate)
    numbers = []
    for n in (4, 8, 16):
        status, _, error = execute(
            "advice.prm", "--output", "results/advice",
            *overrides([*settings, f"Time integration/Steps per period={n}"]))
        check(status == 3, error)
        numbers.append(int(re.search(r"needs at least (\d+) \[Time", error)[1]))
    check(max(numbers) < 1.3 * min(numbers), f"the advice depends on steps: {numbers}")
    run(plate, "advice", [*settings, f"Time integration/Steps per period={numbers[0]}"])


def test_periodic_state():
    """March and Anderson's acceleration come to the same state of a cracked
    plate, and their estimates hold; under a mean load, where the lip opens and
    closes in every period and the plate flows, those of marches do."""

    def stresses(n, scheme, mean, method, tolerance):
        name, n_steps = scheme
        results = run(SOURCE / "prm/raous1980.prm", method, [
            "Material/Viscosity=power law", *law(n, 20.),
            "Contact/Solver=automatic", "Geometry/Subdivisions=8, 4",
            f"Loads/Traction=0; 10*(sin(2*pi*t/600) - {mean})",
            f"Time integration/Scheme={name}",
            f"Time integration/Steps per period={n_steps}",
            "Output/Probes=mouth: 1, 0; inside: 0.75, 0.5", "Output/Fields=none",
            "Periodic state/Maximum periods=400", f"Periodic state/Method={method}",
            f"Periodic state/Tolerance={tolerance}"])
        table = results.table("probe_inside.csv")
        openings = results.table("probe_mouth.csv")["opening"][-n_steps - 1:]
        print(f"n = {n}, {method}, {tolerance}: {len(table['t']) // n_steps} periods, "
              f"openings from {min(openings):.1e} to {max(openings):.1e}")
        check(mean == 0 or min(openings) == 0 < max(openings), "opens and closes")
        return [x for column in ("s_11", "s_22", "s_12")
                for x in table[column][-n_steps - 1:]]

    explicit, implicit = ("heun", 400), ("sdirk2", 20)
    for n, scheme, mean, best, others in (
            (5, explicit, 0., ("anderson", 1e-4), (("march", 2e-2), ("anderson", 1e-3))),
            (5, implicit, 0.2, ("march", 1e-3), (("march", 1e-1), ("march", 2e-2))),
            (8, implicit, 0.5, ("march", 1e-3), (("march", 1e-1), ("march", 2e-2)))):
        exact = stresses(n, scheme, mean, *best)
        for method, tolerance in others:
            found = stresses(n, scheme, mean, method, tolerance)
            check_below(max(abs(a - b) for a, b in zip(found, exact, strict=True))
                        / max(map(abs, exact)), tolerance,
                        f"n = {n}, {method}, mean {mean}, error")


def cyclic(name, scheme, n_steps, n_periods, more=(), on=run):
    """A cracked plate under a cyclic load with a mean, beyond the first periods:
    contact opens and closes, the crack tip creeps most."""
    return on(SOURCE / "prm/raous1980.prm", name, [
        "Material/Viscosity=power law", *law(5, 20.),
        "Material/Plane state=plane strain", "Contact/Solver=automatic",
        "Geometry/Subdivisions=32, 16",
        "Loads/Traction=0; 10*(sin(2*pi*t/600) - 0.2)", "Output/Fields=none",
        f"Time integration/Scheme={scheme}",
        f"Time integration/Steps per period={n_steps}",
        "Output/Probes=mouth: 1, 0; inside: 0.75, 0.5",
        f"Periodic state/Maximum periods={n_periods}", "Periodic state/Tolerance=0",
        *more])


def at_ends_of_steps(results, n_coarse):
    """Stresses and openings of the last period at the instants that n_coarse
    steps have."""
    inside, mouth = (results.table(f"probe_{name}.csv") for name in ("inside", "mouth"))
    n = round(600 / (mouth["t"][1] - mouth["t"][0]))
    return [column[-n - 1:][:: n // n_coarse] for column in (
        inside["s_11"], inside["s_22"], inside["s_12"], mouth["opening"])]


def apart(one, other):
    return max(max(abs(a - b) for a, b in zip(mine, theirs, strict=True))
               / max(map(abs, theirs)) for mine, theirs in zip(one, other, strict=True))


@full
def test_implicit_periods():
    """Explicit and implicit schemes come to the same states, sdirk2 with its
    order."""
    n_periods = 16
    exact = at_ends_of_steps(
        cyclic("arkode", "arkode implicit", 80, n_periods), 20)
    explicit = at_ends_of_steps(cyclic("heun", "heun", 320, n_periods), 20)
    check_below(apart(explicit, exact), 1e-3, "heun against arkode implicit")
    errors = [apart(at_ends_of_steps(cyclic("sdirk2", "sdirk2", n, n_periods), 20),
                    exact) for n in (40, 80)]
    found = math.log2(errors[0] / errors[1])
    print(f"sdirk2 against arkode implicit: {errors[1]:.1e}, order {found:.2f}")
    check(1.5 < found < 2.5 and errors[1] < 5e-3, "sdirk2 against arkode implicit")


def test_long_steps():
    """With steps ten times those that heun may take a few Newton iterations a
    stage suffice, with about one factor a period."""
    n_bound, n_periods = 104, 32
    for scheme in ("sdirk2", "arkode implicit"):
        results = cyclic("long_steps", scheme, n_bound // 10, n_periods)
        counters = results.summary["counters"]
        # Each error has the bound beside it that was applied to it.
        lines = re.findall(r"^  (certificate of|Newton's method:) .*residual (\S+) "
                           r"\(accepted up to (\S+)\)$",
                           (results.directory / "log.txt").read_text(), re.M)
        check(len(lines) == 2, f"{scheme}: {lines}")
        for name, residual, bound in lines:
            check_below(float(residual) / float(bound), 1, f"{scheme}: {name}")
        check_below(counters["vi_solves"] / counters["implicit_stages"], 4,
                    f"{scheme}: Newton iterations a stage")
        check_below(counters["factorisations"] / n_periods, 1.5,
                    f"{scheme}: factorisations a period")


def test_hard_steps():
    """Steps so long that Newton's method alone runs away; other linear solvers
    and two processes find the same."""
    settings = law(8, 20.)
    one = cyclic("cholesky", "sdirk2", 6, 2, settings)
    for name, more in (("gmg", ["Linear solver/Type=gmg"]),
                       ("mumps", ["Linear solver/Type=mumps"])):
        check_below(apart(at_ends_of_steps(cyclic(name, "sdirk2", 6, 2,
                                                  settings + more), 6),
                          at_ends_of_steps(one, 6)), 1e-5, name)
    shared = cyclic("two", "sdirk2", 6, 2, settings,
                    lambda *arguments: run_on(2, *arguments))
    check_below(apart(at_ends_of_steps(shared, 6), at_ends_of_steps(one, 6)), 1e-5,
                "two processes")


def coarse_crack():
    return [
        *POWER_LAW, "Material/Plane state=plane strain", "Contact/Solver=automatic",
        "Geometry/Subdivisions=14, 4", "Loads/Traction=0; 10", "Output/Fields=none",
        "Refinement/Strategy=tip", "Refinement/Cycles=3", "Discretisation/Degree=1",
        "Discretisation/Volumetric strain=mean", "Time integration/Scheme=sdirk2",
        "Output/Probes=mouth: 1, 0; inside: 0.75, 0.5",
        "Periodic state/Maximum periods=1", "Periodic state/Tolerance=0"]


def cracked(name, settings, more=()):
    return run(SOURCE / "prm/raous1980.prm", name, [*coarse_crack(), *settings, *more])


@full
def test_large_exponents():
    """Newton's method finds what the listed steps of a load at once leave, however
    coarse: steps of a decade and half a period come to the same steady rate."""
    decades = ", ".join(str(600 * 10. ** -k) for k in range(7, 0, -1))
    trials = (("sdirk2", 2, "300"), ("arkode implicit", 4, decades),
              *(("arkode implicit", order, "300")
                for order in tier((4,), (2, 3, 4, 5))))
    for n in (10, 15):
        opening, *others = (cracked(f"exponent_{n}", [
            *law(n, 20.), "Time integration/Step control=list",
            f"Time integration/Scheme={scheme}", f"Time integration/Order={order}",
            f"Time integration/Steps={steps}"]).table("probe_mouth.csv")["u_2"][-1]
            for scheme, order, steps in (("sdirk2", 2, decades), *trials))
        for other, (scheme, order, steps) in zip(others, trials, strict=True):
            check_close(other / opening, 1, 0.05, f"n = {n}, {scheme}, order {order}, "
                        f"{steps.count(',') + 2} steps: opening over that of sdirk2 "
                        "by decades")


def test_units():
    """The coefficients of large exponents are tiny in Pa, and their squares are no
    numbers any more: the same run in MPa and in Pa, with a jump of the law."""
    n = 25
    coefficient = A * 20. ** (1 - n)

    def rows(unit):
        """With the stresses in units of so many Pa."""
        scale = 1e6 / unit
        results = cracked(f"unit_{unit:.0e}", [
            f"Material/Young modulus={13000. * scale!r}",
            f"Loads/Traction=0; 10*{scale!r}", f"Material/Creep exponent={n}",
            f"Material/Creep coefficient={coefficient * scale ** -n!r}"
            "*if(t < 300, 1, 3)", "Time integration/Steps per period=8",
            "Time integration/Newton tolerance=1e-11"])
        inside, mouth = (results.table(f"probe_{name}.csv")
                         for name in ("inside", "mouth"))
        return [mouth["u_2"], [s / scale for s in inside["s_22"]]]

    check_below(apart(rows(1.), rows(1e6)), 1e-9, f"n = {n}, Pa against MPa")


def test_adaptive_start():
    """Adaptive steps begin by the rate of the elastic stress at the tip, which a
    load at once leaves, and grow with the time since."""
    decades = ", ".join(str(600 * 10. ** (-k / 4)) for k in range(32, 0, -1))
    listed, adaptive = (cracked(f"start_{control}", [
        *law(5, 5.), f"Time integration/Step control={control}", more])
        for control, more in (("list", f"Time integration/Steps={decades}"),
                              ("adaptive", "Time integration/Relative tolerance=1e-2")))
    check_close(adaptive.table("probe_mouth.csv")["u_2"][-1]
                / listed.table("probe_mouth.csv")["u_2"][-1], 1, 0.01,
                "adaptive from a load at once: opening over that of listed steps")
    check_below(adaptive.summary["time_integration"]["accepted_steps"], 500, "steps")


def test_refusals():
    """What is known of linear creep alone is refused, with what to take."""
    for settings, words in (
            (["Periodic state/Method=fourier"], "couples the harmonics"),
            (["Periodic state/Secular split=on"], "the mean of nonlinear creep"),
            (["Periodic state/Method=anderson", "Loads/Traction=0; 10"],
             "grows from period to period"),
            (["Time integration/Scheme=exponential"], "sdirk2 for long steps"),
            (["Time integration/Scheme=trapezoid"], "oscillates instead of relaxing"),
            (["Time integration/Newton tolerance=0"], "at least 1e-13"),
            (["Crack tip/Stress intensity=true"], "creep is nonlinear in the stress")):
        with open("bar.prm", "w", encoding="utf-8") as file:
            file.write(BAR)
        status, _, error = execute("bar.prm", "--output", "results/refused",
                                   *overrides([*POWER_LAW, *law(5, 10.), *settings]))
        check(status != 0 and words in error, f"{settings}: {error}")


test_linear()
test_creeping_bar()
test_relaxing_bar()
test_arrhenius()
test_tube()
test_limit_of_steps()
test_advice_on_steps()
test_large_exponents()
test_units()
test_adaptive_start()
test_periodic_state()
test_implicit_periods()
test_long_steps()
test_hard_steps()
test_refusals()
