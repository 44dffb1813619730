"""Hard cases of the material: relaxation times a million apart, moduli 1e8
apart, Poisson's ratio 0.4999."""

import math

from hard_case import (MODULUS, PERIOD, accuracy, check, check_below, column,
                       compute, largest_difference)


def pressing(t):
    """The load of the scenes with two materials, and its integral."""
    w = 2 * math.pi / PERIOD
    return 5 * (1 - math.cos(w * t)), 5 * (t - math.sin(w * t) / w)


def stress_error(results):
    """Of the closed form: s_22 = -F everywhere, and F is the pressure."""
    worst = 0.
    for probe, name, sign in (("top", "s_22", -1), ("body", "s_22", -1),
                              ("mouth", "s_22", -1), ("mouth", "pressure", 1)):
        load = [sign * pressing(t)[0] for t in column(results, probe, "t")]
        worst = max(worst, largest_difference(column(results, probe, name),
                                              load))
    return worst


def top(t, moduli, times):
    """Its displacement: halves in series, elastic and viscous strain."""
    load, impulse = pressing(t)
    return -sum(0.5 / E * (load + impulse / tau)
                for E, tau in zip(moduli, times))


def test_relaxation_times():
    times = (600e-6, 600.)
    for split, bounds in (("automatic", (1e-7, 1e-7)), ("on", (1e-8, 1e-11))):
        results = compute("relaxation_ratio", [
            f"Periodic state/Secular split={split}"])
        check_below(stress_error(results), bounds[0],
                    f"relaxation times, split {split}: stress and pressure")
        # At the ends of periods, where the steps' quadrature is exact.
        u = column(results, "top", "u_2")[40::40]
        check_below(largest_difference(u, [
            top(PERIOD * k, (MODULUS,) * 2, times) for k in (1, 2)]), bounds[1],
            f"relaxation times, split {split}: displacement")


def test_moduli():
    for name, halves in (("soft at the lip", (1, 1e8)),
                         ("stiff at the lip", (1e8, 1))):
        moduli = [MODULUS * factor for factor in halves]
        formula = "if(y < 0.5, {}, {})".format(*moduli)
        results = compute("stiffness_contrast", [
            f"Material/Young modulus={formula}",
            f"Material/Viscous modulus=60*{formula}"])
        error = stress_error(results)
        check_below(error, accuracy(results),
                    f"moduli, {name}: stress and pressure, certified")
        check_below(error, 1e-5 if halves[0] == 1 else 1e-12,
                    f"moduli, {name}: stress and pressure")
        u = column(results, "top", "u_2")[40::40]
        check_below(largest_difference(u, [
            top(PERIOD * k, moduli, (60., 60.)) for k in (1, 2)]), 1e-5,
            f"moduli, {name}: displacement")


def test_incompressible():
    """The stress of a plane body under tractions does not depend on Poisson's
    ratio (Michell), and the opening does by 1 - nu^2."""
    results = {}
    for nu, strain in ((0.4999, "mean"), (0.3, "mean"), (0.4999, "full")):
        run = compute("incompressible", [f"Material/Poisson ratio={nu}",
                                         f"Discretisation/Volumetric strain={strain}"])
        opening = max(column(run, "mouth", "opening")) / (1 - nu**2)
        K = max(run.table("crack_tip.csv")["K_I"])
        print(f"nu = {nu}, {strain}: K_I {K:.5g}, opening / (1 - nu^2) "
              f"{opening:.6g}")
        results[nu, strain] = (K, opening)
    for quantity in (0, 1):
        (mean, other, full) = (values[quantity] for values in results.values())
        check_below(abs(mean / other - 1), 0.03,
                    "nu = 0.4999 - nu = 0.3, mean dilatation")
        check(full < 0.6 * other, "without it, the body locks")


test_relaxation_times()
test_moduli()
test_incompressible()
