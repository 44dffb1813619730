"""Hard cases of the steps in time: steps at the bound of stability, thirty
reversals of the load in a period, coefficients and loads that jump."""

import math
import re

from hard_case import (check, check_below, column, compute, largest_difference,
                       refuse)

STEP = 60.
LIMITS = {"euler": 2., "heun": 2., "rk4": 2.785293563405282}


def amplification(scheme, z):
    """Of a stress that relaxes alone, by a step of z relaxation times."""
    order = {"euler": 1, "heun": 2, "rk4": 4}[scheme]
    return sum((-z)**k / math.factorial(k) for k in range(order + 1))


def settings(scheme, tau):
    return [f"Time integration/Scheme={scheme}",
            f"Material/Relaxation time={tau!r}"]


def test_growth():
    """On both sides of the bound a step multiplies the stress by R(z)."""
    for scheme, limit in LIMITS.items():
        for side in (0.999, 1.001):
            tau = STEP / limit / side
            stress = column(compute("stability_bound", settings(scheme, tau) + [
                "Time integration/Check stability=false"]), "body", "s_11")
            factor = amplification(scheme, STEP / tau)
            check((abs(factor) < 1) == (side < 1), "the bound is where it is")
            worst = max(abs(s / (stress[0] * factor**n) - 1)
                        for n, s in enumerate(stress))
            check_below(worst, 1e-11, f"{scheme}, {side} of the bound: stress of "
                        f"{len(stress) - 1} steps - R(z)^n, relative")


def test_bound():
    """A step of the bound but 1e-9 of it is taken; the bound itself is refused,
    and so is what is longer. The number of steps in the message is the least."""
    compute("stability_bound", settings("heun", STEP / 2 * (1 + 1e-9)))
    for factor in (1, 1 - 1e-9):
        refuse("stability_bound", settings("heun", STEP / 2 * factor), 3,
               "is too large", "whatever the mesh", "Steps per period=11",
               "sdirk2")
    tau = 4.321
    message = refuse("stability_bound", settings("rk4", tau), 3)
    told = int(re.search(r"Steps per period=(\d+)", message)[1])
    check(told == math.floor(600 / (LIMITS["rk4"] * tau)) + 1, message)
    for steps, status in ((told, 0), (told - 1, 3)):
        compute("stability_bound", settings("rk4", tau) + [
            "Periodic state/Maximum periods=1",
            f"Time integration/Steps per period={steps}"], status)


def test_reversals():
    """Fifteen cycles within one period are fifteen periods of one cycle."""
    together = compute("many_reversals")
    apart = compute("many_reversals", [
        "Loads/Period=600", "Loads/Traction=0; 10*(sin(2*pi*t/600) - 0.1)",
        "Time integration/Steps per period=40",
        "Periodic state/Maximum periods=15"])
    closed = together.table("contact.csv")["closed_nodes"]
    check(sum(a == 0 < b for a, b in zip(closed, closed[1:])) >= 15,
          "the lip closes in every cycle")
    for probe, name in (("mouth", "opening"), ("inside", "pressure"),
                        ("tip", "s_22"), ("body", "s_11")):
        check_below(largest_difference(column(together, probe, name),
                                       column(apart, probe, name)),
                    1e-12, f"one period - fifteen: {name} at {probe}")


def test_jumps():
    """Held, the stress falls by exp(-300/300 - 300/100) over the period. Each
    scheme keeps its order, for its steps end on the jump."""
    exact = math.exp(-4)
    for scheme, order, steps in (("heun", 2, 20), ("sdirk2", 2, 20),
                                 ("rk4", 4, 10)):
        errors = []
        for n in (steps, 2 * steps):
            stress = column(compute("jumps", [
                f"Time integration/Scheme={scheme}",
                f"Time integration/Steps per period={n}"]), "body", "s_11")
            errors.append(abs(stress[-1] / stress[0] - exact) / exact)
        rate = math.log2(errors[0] / errors[1])
        print(f"jump, {scheme}: errors {errors[0]:.2e}, {errors[1]:.2e}, order "
              f"{rate:.2f}")
        check(order - 0.1 < rate < order + 0.6, f"order of {scheme}")
    stress = column(compute("jumps", ["Time integration/Scheme=exponential"]),
                    "body", "s_11")
    check_below(abs(stress[-1] / stress[0] / exact - 1), 1e-12,
                "jump, exponential, which is exact here")


def test_sawtooth():
    """A load that jumps where t begins anew, without a word in its formula that
    tells of it: u = y (F + (integral of F) / tau) / E, which schemes of order 2
    integrate exactly."""
    for scheme in ("heun", "sdirk2", "rk4"):
        results = compute("stability_bound", [
            "Boundary/Symmetry=automatic", "Loads/Temperature=0",
            "Loads/Traction=0; 10*t/600", "Material/Poisson ratio=0",
            "Periodic state/Maximum periods=2", "Time integration/Steps per period=20",
            f"Time integration/Scheme={scheme}"])
        exact = [0.5 * (10 * (t % 600) / 600
                        + (t // 600 * 3000 + 10 * (t % 600)**2 / 1200) / 60) / 13000
                 for t in column(results, "body", "t")]
        check_below(largest_difference(column(results, "body", "u_2"), exact), 1e-10,
                    f"sawtooth, {scheme}")


test_growth()
test_bound()
test_reversals()
test_jumps()
test_sawtooth()
