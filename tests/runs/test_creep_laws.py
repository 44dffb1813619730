"""Creep by a hyperbolic sine and with strain hardening: closed forms of bars and of a
tube, orders of schemes, units, limits that are power laws, C*, meshes and checkpoints."""

import functools
import math

import numpy
import tubes
from bars import BAR
from crevasse_run import (SOURCE, check, check_below, check_close, execute, full,
                          overrides, run, tier)
from interrupted_runs import COMMON, check_same_bytes, finish, fresh, interrupt, reference
from test_creep_integral import SCENE as CRACKED
from test_creep_integral import rings

E = 13000.
HELD = ["Loads/Traction=", "Boundary/Loaded=none", "Boundary/Symmetry=2, 3",
        "Material/Thermal expansion=1e-5"]
LAWS = {"power law": "", "hyperbolic sine": "Reference stress",
        "strain hardening": "Hardening exponent"}


def creep(name, A, n, more=None):
    return ["Material/Plane state=plane stress", f"Material/Viscosity={name}",
            f"Material/Creep coefficient={A!r}", f"Material/Creep exponent={n}",
            *([f"Material/{LAWS[name]}={more}"] if LAWS[name] else [])]


power = functools.partial(creep, "power law")
sine = functools.partial(creep, "hyperbolic sine")
hardening = functools.partial(creep, "strain hardening")


def with_scheme(scheme):
    implicit = scheme in ("sdirk2", "arkode implicit")
    return [f"Time integration/Scheme={scheme}",
            *(["Time integration/Newton tolerance=1e-12"] if implicit else [])]


def top(name, settings):
    return run(BAR, name, settings).table("probe_top.csv")


def hardened(A, n, m, dose):
    """The creep strain that hardens after a dose of the integral of s^n."""
    return ((1 + m) * A * dose) ** (1 / (1 + m))


def test_constant_stress():
    """All schemes are exact; hardening starts from rest."""
    s, n, m = 10., 3, 2.
    A = 1e-15 * s ** -n
    for name, law, crept in (
            ("sine", sine(1e-8, n, 4), lambda t: 1e-8 * math.sinh(s / 4) ** n * t),
            ("hardening", hardening(A, n, m), lambda t: hardened(A, n, m, s ** n * t))):
        for scheme in ("euler", "heun", "sdirk2", "arkode explicit", "arkode implicit"):
            table = top(f"{name}_{scheme.replace(' ', '_')}", [
                *law, *with_scheme(scheme), f"Loads/Traction=0; {s}"])
            check_below(max(abs(u / (s / E + crept(t)) - 1) for t, u in
                            zip(table["t"], table["u_2"], strict=True)),
                        1e-11, f"{name}, {scheme}, constant stress")


def check_order(what, error, order, steps=(40, 80)):
    errors = [error(n) for n in steps]
    found = math.log2(errors[0] / errors[1])
    print(f"{what}: error {errors[1]:.1e}, order {found:.2f}")
    # The dose of a cubic is exact where the order is 4.
    check(found > order - 0.3 or errors[0] < 1e-11, f"{what}: {errors}")


def test_varying_stress():
    """Under a load that grows from rest, and under one that is reversed at once; at the
    end of the period the load is that of its beginning."""
    n, m = 3, 2.
    A, rate, s_0 = 1e-15 * 10. ** -n, 10 / 600, 3.
    load = [f"Loads/Traction=0; {rate!r}*t"]
    for name, law, crept in (
            ("sine", sine(1e-7, 1, s_0),
             1e-7 * s_0 / rate * (math.cosh(600 * rate / s_0) - 1)),
            ("hardening", hardening(A, n, m),
             hardened(A, n, m, rate ** n * 600 ** (n + 1) / (n + 1)))):
        for scheme, order in (("heun", 2), ("sdirk2", 2), ("arkode implicit", 4)):
            check_order(f"{name}, {scheme}, growing stress", lambda steps: abs(
                top("growing", [*law, *load, *with_scheme(scheme),
                                 f"Time integration/Steps per period={steps}"
                                 ])["u_2"][-1] / crept - 1),
                order, (10, 20))
    s = 10.
    before, after = (hardened(A, n, m, s ** n * t) for t in (300, 600))
    for scheme in ("heun", "sdirk2"):
        check_order(f"hardening, {scheme}, reversed stress", lambda steps: abs(
            (top("reversed", [*hardening(A, n, m), *with_scheme(scheme),
                              f"Loads/Traction=0; if(t < 300, {s}, {-s})",
                              f"Time integration/Steps per period={steps}"
                              ])["u_2"][-1] - s / E) / (2 * before - after) - 1), 2)


def relaxed_by_sine(t, start, A, s_0):
    """Of s' = -E A sinh(s / s_0)."""
    left = math.tanh(start / (2 * s_0)) * math.exp(-E * A * t / s_0)
    return 2 * s_0 * math.atanh(left)


def relaxed_with_hardening(t, start, A):
    """Of n = m = 1: -ln x - (1 - x) = E² A t / start for the part x of the stress."""
    low, high = 0., 1.
    for _ in range(100):
        x = 0.5 * (low + high)
        low, high = (x, high) if -math.log(x) - 1 + x > E * E * A * t / start else (low, x)
    return start * x


def cooled(start):
    return [*HELD, f"Loads/Temperature={-start / E / 1e-5!r}"]


def test_relaxation():
    """A bar that is cooled at once, held at both ends."""
    for name, law, exact in (
            ("sine", sine(1e-7, 1, 2.), lambda t: relaxed_by_sine(t, 10., 1e-7, 2.)),
            ("hardening", hardening(1e-10, 1, 1.),
             lambda t: relaxed_with_hardening(t, 10., 1e-10))):
        for scheme in ("heun", "sdirk2"):
            def error(steps, law=law, exact=exact, scheme=scheme):
                table = top("relaxing", [
                    *law, *cooled(10.), *with_scheme(scheme),
                    f"Time integration/Steps per period={steps}"])
                return abs(table["s_22"][-1] / exact(table["t"][-1]) - 1)
            check_order(f"{name}, {scheme}, relaxation", error, 2)
    for scheme in ("arkode explicit", "arkode implicit", "sdirk2"):
        table = top("relaxing_adaptive", [
            *hardening(1e-10, 1, 1.), *cooled(10.), *with_scheme(scheme),
            "Time integration/Step control=adaptive",
            "Time integration/Relative tolerance=1e-4"])
        check_below(max(abs(s - relaxed_with_hardening(t, 10., 1e-10)) for t, s in
                        zip(table["t"][1:], table["s_22"][1:], strict=True)) / 10.,
                    1e-4, f"hardening, {scheme}, adaptive, relaxation")


def test_far_beyond_the_reference_stress():
    """Arguments of the sine up to 10⁵, whose exponential is no number: what relaxes
    forgets where it began, but for the sign that the second stage of a long step may
    leave. Explicit steps are refused."""
    A, s_0 = 1e-7, 2.
    steps = ", ".join(str(600 * 10. ** (-k / 8)) for k in range(64, 0, -1))
    for start in (200., 2e5):
        table = top("far_beyond", [
            *sine(A, 1, s_0), *cooled(start), *with_scheme("sdirk2"),
            "Time integration/Step control=list", f"Time integration/Steps={steps}"])
        exact = 2 * s_0 * math.atanh(math.exp(-E * A * 600 / s_0))
        check_close(abs(table["s_22"][-1] / exact), 1, 0.02, f"relaxed from {start}")
    status, _, error = execute(
        "far_beyond.prm", "--output", "results/explicit",
        *overrides([*sine(A, 1, s_0), *cooled(2e5), "Time integration/Scheme=heun"]))
    check(status == 3 and "Creep coefficient" in error, error)


def plate(name, law, more=()):
    """Stresses and opening of a cracked plate under a cyclic load."""
    results = run(SOURCE / "prm/raous1980.prm", name, [
        *law, "Contact/Solver=automatic", "Geometry/Subdivisions=8, 4",
        "Output/Probes=mouth: 1, 0; inside: 0.75, 0.5", "Output/Fields=none",
        "Periodic state/Maximum periods=2", "Periodic state/Tolerance=0", *more])
    inside, mouth = (results.table(f"probe_{name}.csv") for name in ("inside", "mouth"))
    return [inside[name] for name in ("s_11", "s_22", "s_12")] + [mouth["u_2"]]


def apart(one, other):
    return max(max(abs(a - b) for a, b in zip(mine, theirs, strict=True))
               / max(map(abs, theirs)) for mine, theirs in zip(one, other, strict=True))


def test_steep_hardening():
    """Newton's method for the stress at a point alternates between two stresses of a
    hardening body under long steps, without bisection; shorter steps agree."""
    def largest_opening(steps):
        *_, opening = plate("steep", [
            *hardening(1e-14, 5, 2.), *with_scheme("sdirk2"),
            "Material/Plane state=plane strain", "Loads/Traction=0; 40*sin(2*pi*t/600)",
            "Discretisation/Volumetric strain=mean", "Periodic state/Maximum periods=1",
            f"Time integration/Steps per period={steps}"])
        return max(opening)
    check_close(largest_opening(20) / largest_opening(40), 1, 1e-3,
                "largest opening with 20 and 40 steps")


def test_limits():
    """Small arguments of the sine, and no hardening, are the power law."""
    A, n, s_0 = 1e-6 * 20. ** -2, 3, 1e7
    for scheme, steps in (("heun", 400), ("sdirk2", 20)):
        more = [*with_scheme(scheme), f"Time integration/Steps per period={steps}",
                "Loads/Traction=0; 10*(sin(2*pi*t/600) - 0.2)"]
        expected = plate("power", power(A, n), more)
        for name, law in (("sine", sine(A * s_0 ** n, n, s_0)),
                          ("hardening", hardening(A, n, 0))):
            check_below(apart(plate(name, law, more), expected), 1e-10,
                        f"{name}, {scheme}, against the power law")


def test_units():
    """The same in MPa and Pa."""
    def rows(law, scale):
        *stresses, opening = plate("units", [
            *law, f"Material/Young modulus={E * scale!r}",
            f"Loads/Traction=0; {10 * scale!r}*(sin(2*pi*t/600) - 0.2)",
            *with_scheme("sdirk2"), "Time integration/Steps per period=20"])
        return [[s / scale for s in stress] for stress in stresses] + [opening]

    A, n, m = 1e-6 * 20. ** -2, 3, 1.5
    for name, law in (
            ("sine", lambda scale: sine(1e-5, n, repr(8 * scale))),
            ("hardening", lambda scale: hardening(A * 1e-4 ** m * scale ** -n, n, m))):
        check_below(apart(rows(law(1e6), 1e6), rows(law(1.), 1.)), 1e-9,
                    f"{name}, Pa against MPa")


def test_tube():
    """Steady creep of a thick tube under pressure by a sine of small arguments."""
    n, s_0, radii = 5, 100., (1.25, 1.5, 1.75)
    results = run(tubes.TUBE, "tube", [
        tubes.write("tube.msh", 24, 24, order=1), *sine(1e-3 * s_0 ** n, n, s_0)[1:],
        "Material/Young modulus=1000", "Discretisation/Degree=1",
        "Discretisation/Volumetric strain=mean", "Loads/Period=30",
        "Time integration/Scheme=sdirk2", "Time integration/Steps per period=300",
        "Output/Probes=" + "; ".join(f"r{100 * r:.0f}: {r}, 0" for r in radii)])
    for r in radii:
        table = results.table(f"probe_r{100 * r:.0f}.csv")
        ratio, size = (2 / r) ** (2 / n), 2 ** (2 / n) - 1
        for column, exact in (("s_11", (1 - ratio) / size),
                              ("s_22", (1 + (2 / n - 1) * ratio) / size)):
            check_close(table[column][-1], exact, 1e-3, f"tube, r = {r}, {column}")


@full
def test_energies_of_crack_lengths():
    """C* is the slope of the potential, which is the integral of the rate of the
    load's displacement over the loads."""
    points, weights = numpy.polynomial.legendre.leggauss(6)

    def power_of(length, load):
        results = run(CRACKED, "length", [
            *sine(0.1, 3, 4.), f"Geometry/Crack length={length}", f"Loads/Traction=0; {load!r}"])
        table = results.table("load_work.csv")
        t, work = table["t"], table["load_work"]
        return (work[-1] - work[-2]) / (t[-1] - t[-2]), results

    def potential(length):
        """Of both halves."""
        return 2 * sum(weight / 2 * power_of(length, (1 + x) / 2)[0] * 2 / (1 + x)
                       for x, weight in zip(points, weights, strict=True))
    expected = (potential(0.505) - potential(0.495)) / 0.01
    table = power_of(0.5, 1.)[1].table("creep_integral.csv")
    check_close(table["C_t"][-1] / expected, 1, 5e-3, "C* over that of the energies")


def test_graded_sine():
    """A law that varies does not make C* depend on the square."""
    graded = ["Creep coefficient=exp(2*x)", "Creep exponent=3 + x",
              "Reference stress=8 + x"]
    scene = rings(*tier((3, 1.5, 1e-2), (4, 1.3, 1e-3)))
    large, small = (run(scene, "graded", [
        *sine(1, 3, 8), *("Material/" + more for more in graded),
        "Refinement/Strategy=none", f"Crack tip/Radius={r}"
        ]).table("creep_integral.csv")["C_t"][-1] for r in (0.5, 0.1))
    check_close(large / small, 1, 1e-2, "C* by squares of 0.5 and 0.1")


def moving(*more):
    """A bar that bends, whose mesh changes after two periods."""
    return [*hardening(1e-12, 3, 1.), *with_scheme("sdirk2"),
            "Loads/Traction=0; 10*(1 + x^3)*sin(2*pi*t/600)",
            "Time integration/Steps per period=10", "Geometry/Subdivisions=4, 4",
            "Discretisation/Degree=2", "Periodic state/Maximum periods=5",
            "Refinement/Strategy=adaptive", "Refinement/Cycles=1",
            "Refinement/Readapt every=2", *more]


def test_meshes():
    """The state moves with the mesh: strains are conserved, and what follows is
    near what a mesh finds that was fine from the start."""
    adapted = run(BAR, "adapted", moving())
    changes = adapted.summary["refinement"]["readaptations"]
    check(len({change["cells"] for change in changes}) > 1, f"no new meshes: {changes}")
    for change in changes:
        before, after = (change[f"viscous_strain_{when}"]["integral"]
                         for when in ("before", "after"))
        check_below(max(abs(a - b) for a, b in zip(before, after, strict=True))
                    / max(map(abs, before)), 1e-10, "integral of the strains")
    fine = run(BAR, "fine", moving("Refinement/Strategy=none",
                                   "Refinement/Readapt every=0",
                                   "Geometry/Subdivisions=16, 16"))
    one, other = (results.table("probe_top.csv")["u_2"][-11:]
                  for results in (adapted, fine))
    check_below(apart([one], [other]), 1e-3, "displacements on changing meshes")


def test_checkpoints():
    """A cracked plate whose run is interrupted ends with the same bytes."""
    settings = [*COMMON, *moving(), "Output/Checkpoint every=1"]
    whole, _ = reference("whole", settings)
    directory = fresh("resumed")
    interrupt(directory, settings, "stop file", 35)
    check_same_bytes(whole, finish(directory, settings), "resumed")


def test_periodic_stress():
    """The stress of a held bar becomes periodic while the strain hardens it."""
    results = run(BAR, "marched", [
        *hardening(1e-12, 3, 1.), *HELD, *with_scheme("sdirk2"),
        "Loads/Temperature=-200*sin(2*pi*t/600)", "Periodic state/Method=march",
        "Periodic state/Maximum periods=400", "Periodic state/Tolerance=2e-2"])
    stress = results.table("probe_top.csv")["s_22"]
    check_below(abs(stress[-1] - stress[-41]) / max(stress), 1e-3, "periodic stress")


def test_refusals():
    with open("bar.prm", "w", encoding="utf-8") as file:
        file.write(BAR)
    hard = hardening(1e-12, 3, 1.)
    for settings, words in (
            ([*hard, "Periodic state/Method=anderson"], "never decreases"),
            ([*hard, "Periodic state/Method=fourier"], "couples the harmonics"),
            ([*hard, "Crack tip/Creep integral=true"], "without hardening"),
            (hardening(1e-12, 3, "1 + t/600"), "must not depend on t"),
            (hardening(1e-12, 3, -1), "at least 0"),
            ([*sine(1e-12, 3, 1.), "Time integration/Scheme=trapezoid"],
             "Viscosity = hyperbolic sine is not"),
            ([*hard, "Crack tip/Crack growth law=creep"], "must be none"),
            (sine(1e-12, 3, 1.)[:-1], "Reference stress"),
            (sine(1e-12, 3, 0), "greater than 0")):
        status, _, error = execute("bar.prm", "--output", "results/refused",
                                   *overrides(settings))
        check(status == 2 and words in error, f"{settings}: {status}: {error}")
    status, log, _ = execute("--check", "bar.prm", *overrides(
        [*power(1e-12, 3), "Material/Hardening exponent=1"]))
    check("Hardening exponent = 1 is not used" in log, log)


if __name__ == "__main__":
    test_constant_stress()
    test_varying_stress()
    test_relaxation()
    test_far_beyond_the_reference_stress()
    test_steep_hardening()
    test_limits()
    test_units()
    test_tube()
    test_energies_of_crack_lengths()
    test_graded_sine()
    test_meshes()
    test_checkpoints()
    test_periodic_stress()
    test_refusals()
