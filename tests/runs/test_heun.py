"""Heun's method: order 2 against the closed forms of uniform bars under
sin(wt); refused above 2 tau_min, bounded over 200 periods just below it."""

import math

from bars import BAR, E, LOAD, RELAXING, creeping_bar, relaxing_bar
from crevasse_run import SOURCE, check, execute, run, tier

def check_order(name, settings, column, scale, exact, order):
    errors = []
    for steps in tier((80, 160), (80, 160, 320, 640)):
        results = run(BAR, f"bar_{steps}", settings + [
            f"Time integration/Steps per period={steps}"])
        counters = results.summary["counters"]
        check(counters["linear_solves"] == 2 * steps + 1 and
              counters["vi_solves"] == counters["vi_iterations"] == 0,
              "one linear solve an evaluation, and no contact problem")
        top = results.table("probe_top.csv")
        errors.append(max(abs(value * scale - exact(t))
                          for t, value in zip(top["t"], top[column])))
    for coarse, fine in zip(errors, errors[1:]):
        rate = math.log2(coarse / fine)
        print(f"{name}: error {coarse:.3e} -> {fine:.3e}, rate {rate:.3f}")
        check(order - 0.1 <= rate <= order + 0.1, f"{name}: order {order}")


for weight in tier((0.75,), (0.5, 0.75, 1.)):
    rho = f"Time integration/Heun weight={weight}"
    check_order(f"relaxing bar, weight {weight}", RELAXING + [rho],
                "s_33", 1 / LOAD, relaxing_bar, 2)
    # The stress of the creeping bar does not depend on r: Heun is a quadrature
    # of sin(wt) there, for the paper's weight the third-order one of Radau.
    check_order(f"creeping bar, weight {weight}", [rho], "u_2", E / LOAD,
                creeping_bar, 3 if weight == 0.75 else 2)

# 10 steps of 60: stable for tau > 30.
SCENE = SOURCE / "prm/raous1980.prm"
STEPS = "Time integration/Steps per period=10"
status, _, message = execute(SCENE, "--set", STEPS, "--set",
                             "Material/Relaxation time=29.999", "--output",
                             "results/refused")
print(message)
check(status == 3 and "Steps per period=11" in message, "refused above")

BELOW = [STEPS, "Material/Relaxation time=30.001", "Periodic state/Tolerance=0",
         "Output/Fields=none", "Contact/Solver=automatic"]
first = run(SCENE, "one_period", BELOW + ["Periodic state/Maximum periods=1"])
later = run(SCENE, "just_below", BELOW + ["Periodic state/Maximum periods=200"])
check(later.summary["periods"] == 200, "all periods computed")
largest = [results.summary["extremes"]["stress"] for results in (first, later)]
print(f"largest stress in period 1: {largest[0]:.6g}, in 200: {largest[1]:.6g}")
check(largest[1] <= 1.2 * largest[0], "bounded over 200 periods")
