"""The periodic state found by harmonic balance tends to that of another scheme as the
steps get short."""

import math

from crevasse_run import check
from periodic_scenes import FOURIER, case, compute, difference, method, steps


def test_order():
    """Heun's method, converged, tends to the same state. Where in a step
    contact changes is a matter of chance, so that a single number of steps may
    do better than others by far: the worst of three counts."""
    finest = 3840
    for name, ratio in (("b", 1), ("c", 0.1), ("c", 10)):
        settings = case(name, ratio)
        reference = compute("finest", settings + steps(finest) + method(
            "averaged", "heun", 1e-7))
        check(reference.summary["converged"], "the reference has converged")
        errors = []
        for level in range(4):
            errors.append(max(
                difference(compute("fourier", settings + steps(n) + FOURIER),
                           reference, stride=finest // n)
                for n in (32 * 2**level, 40 * 2**level, 48 * 2**level)))
        orders = [math.log2(a / b) for a, b in zip(errors, errors[1:])]
        mean = sum(orders) / len(orders)
        print(f"({name}), tau/T = {ratio}, from Heun's limit: "
              + ", ".join(f"{x:.1e}" for x in errors) + "; orders "
              + ", ".join(f"{x:.2f}" for x in orders) + f"; mean {mean:.2f}")
        check(1.6 <= mean <= 2.5, "order 2")


test_order()
