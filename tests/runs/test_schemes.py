"""The time schemes: orders against closed forms of uniform bars without
contact, on the whole of the material (chain, spring, factors of time, thermal
strain, secular flow) where implicit and explicit ones must meet, and through
contact switching; their bounds of the time step."""

import itertools
import math

from bars import BAR, LOAD, RELAXING, relaxing_bar
from crevasse_run import (FULL, SOURCE, check, check_below, execute, overrides, run,
                          tier)

def rates(errors):
    return [math.log2(coarse / fine)
            for coarse, fine in itertools.pairwise(errors)]


def steps_of(scheme, number):
    return [f"Time integration/Scheme={scheme}",
            f"Time integration/Steps per period={number}"]


ORDERS = {"euler": 1, "heun": 2, "predictor corrector": 2, "exponential": 2,
          "sdirk2": 2, "trapezoid": 2, "rk4": 4}

# The unit test time_schemes has the order of each.
for scheme, order in tier([("sdirk2", 2)], ORDERS.items()):
    errors = []
    for number in (80, 160, 320):
        top = run(BAR, "bar", RELAXING
                  + steps_of(scheme, number)).table("probe_top.csv")
        errors.append(max(abs(s / LOAD - relaxing_bar(t))
                          for t, s in zip(top["t"], top["s_33"])))
    print(f"{scheme}, without contact: errors {errors}, rates {rates(errors)}")
    check(all(abs(rate - order) < 0.1 for rate in rates(errors)),
          f"{scheme}: order {order}")

# Everything that an implicit stage must get right, at once: chain and spring,
# k(t), eta_0(t), coefficients in space and time, thermal strain; and the split
# form. All schemes meet at their own order in the solution of the finest one.
WHOLE = SOURCE / "prm/raous1980.prm"
SPLIT = "Periodic state/Secular split=on"
WHOLES = {
    "chain with spring": [
        "Material/Viscosity=chain",
        "Material/Chain=0.5: 60*(1+x); 0.2: 400",
        "Material/Young modulus=13000*(1+0.3*y*sin(2*pi*t/600))",
        "Material/Stiffness time factor=1+0.3*cos(2*pi*t/600)",
        "Material/Viscosity time factor=1+0.4*sin(2*pi*t/600)",
        "Material/Thermal expansion=1e-4",
        "Loads/Temperature=x*y*sin(2*pi*t/600)",
        "Loads/Traction=0; 10*(2+sin(2*pi*t/600))"],
    "chain, split off, under k(t) and eta_0(t)": [
        SPLIT,
        "Material/Viscosity=chain",
        "Material/Chain=0.5: 60*(1+x); 0.5: 400",
        "Material/Stiffness time factor=1+0.3*cos(2*pi*t/600)",
        "Material/Viscosity time factor=1+0.4*sin(2*pi*t/600)",
        "Loads/Traction=0; 10*(2+sin(2*pi*t/600))"],
    "secular flow split off": [
        SPLIT,
        "Material/Viscosity=isotropic",
        "Material/Viscous modulus=780000*(1+x)",
        "Material/Viscous Poisson ratio=0.4",
        "Loads/Traction=0; 10*(2+sin(2*pi*t/600))"]}


def history(settings, scheme, number, periods):
    results = run(WHOLE, "whole", settings + steps_of(scheme, number) + [
        "Contact/Solver=condensed active set", "Output/Fields=none",
        f"Periodic state/Maximum periods={periods}",
        "Periodic state/Tolerance=0"])
    probe = results.table("probe_C.csv")
    return [probe[name][::number // 40] for name in ("u_2", "s_11", "s_22")]


def error(history, reference):
    """The worst of the quantities, each relative to its largest value."""
    return max(max(abs(a - b) for a, b in zip(ours, theirs))
               / max(map(abs, theirs))
               for ours, theirs in zip(history, reference))


for name, settings in WHOLES.items():
    reference = history(settings, "rk4", 640, 1)
    for scheme, order in tier([("sdirk2", 2)], ORDERS.items()):
        if scheme == "rk4":
            continue
        # Their steps flow steadily otherwise than the secular problem.
        if scheme in ("exponential", "predictor corrector") and (
                SPLIT in settings):
            status, _, message = execute(
                WHOLE, "--output", "results/refused",
                *overrides(settings + steps_of(scheme, 80)))
            check(status == 2 and "sdirk2" in message,
                  f"{scheme} refuses the split: {message}")
            continue
        errors = [error(history(settings, scheme, number, 1), reference)
                  for number in (80, 160, 320)]
        print(f"{name}, {scheme}: errors {errors}, rates {rates(errors)}")
        check(all(abs(rate - order) < 0.15 for rate in rates(errors)),
              f"{name}, {scheme}: order {order}")

# The paper's lip under a mean load that keeps it closing and opening: kinks cost
# regularity, so that orders are means over three halvings. rk4 has about 2,
# unless its steps end where nodes switch.
CONTACT = ["Loads/Traction=0; 10*(sin(2*pi*t/600) - 0.1)"]
EVENTS = ["Time integration/Locate contact events=true"]
reference = history(CONTACT + EVENTS, "rk4", 1280, 2)
check_below(error(history(CONTACT + EVENTS, "rk4", 640, 2), reference), 1e-9,
            "reference solution, change when its steps are halved")


def mean_rate(scheme, settings):
    errors = [error(history(CONTACT + settings, scheme, number, 2), reference)
              for number in (40, 80, 160, 320)]
    mean = sum(rates(errors)) / 3
    print(f"contact, {scheme} {settings}: errors {errors}, rates "
          f"{rates(errors)}, mean {mean:.2f}")
    return mean


for scheme, order in ORDERS.items():
    expected = 2 if scheme == "rk4" else order
    if FULL:
        check(abs(mean_rate(scheme, []) - expected) < 0.25,
              f"contact, {scheme}: order {expected}")
    check(mean_rate(scheme, EVENTS) > (3.7 if scheme == "rk4" else order - 0.25),
          f"contact with located events, {scheme}: order {order}")

# Steps of 10 relaxation times: only sdirk2 takes them, and factorises once for
# the steps and once for the first state.
LARGE = ["Material/Relaxation time=3.75", *CONTACT,
         "Time integration/Steps per period=16", "Periodic state/Maximum periods=5",
         "Periodic state/Tolerance=0", "Contact/Solver=condensed active set",
         "Linear solver/Type=cholesky"]
for scheme in ("euler", "heun", "rk4", "predictor corrector"):
    status, _, message = execute(
        WHOLE, "--output", "results/refused",
        *overrides(LARGE + [f"Time integration/Scheme={scheme}"]))
    check(status == 3 and "sdirk2" in message,
          f"{scheme} refuses and names sdirk2: {message}")
results = run(WHOLE, "large", LARGE + ["Time integration/Scheme=sdirk2"])
counters = results.summary["counters"]
print(f"sdirk2: {counters}")
check(counters["factorisations"] == counters["assemblies"] == 2,
      "sdirk2 factorises twice")
check(counters["vi_solves"] == 5 * (2 * 16 + 1) + 1 + 1,
      "two contact problems a step, the first state of a period, and beta")
fine = run(WHOLE, "fine", LARGE[:2] + LARGE[3:] + [
    "Time integration/Scheme=sdirk2", "Time integration/Steps per period=64"])
coarse_w, fine_w = (r.table("probe_C.csv")["opening"] for r in (results, fine))
check_below(max(abs(a - b) for a, b in zip(coarse_w, fine_w[::4]))
            / max(fine_w), 0.02, "opening, steps of 10 relaxation times")

# Equal steps differ by rounding: still one factorisation for all of them. What
# varies only by thermal strain needs no other.
for name, settings in {
        "unequal by rounding": ["Loads/Period=1", "Output/Field times=",
                                "Material/Relaxation time=0.1"],
        "thermal strain": ["Material/Thermal expansion=1e-5",
                           "Loads/Temperature=100*x*sin(2*pi*t/600)"]}.items():
    counters = run(WHOLE, "once", settings + steps_of("sdirk2", 41) + [
        "Contact/Solver=condensed active set", "Linear solver/Type=cholesky",
        "Periodic state/Maximum periods=2", "Periodic state/Tolerance=0"]
        ).summary["counters"]
    print(f"{name}: {counters['factorisations']} factorisations")
    check(counters["factorisations"] == counters["assemblies"] == 2,
          f"{name}: factorised once for the steps, once for the first state")

# A stiffness that varies freely and no memory for it: what is made anew must
# neither be used after it is gone nor be made twice.
for scheme, systems in (("predictor corrector", 8), ("sdirk2", 16)):
    summaries = [run(WHOLE, "anew", [
        "Material/Young modulus=13000*(2+sin(2*pi*t/600)*x)",
        f"Linear solver/Memory for instants={memory}",
        "Contact/Solver=condensed active set", "Output/Fields=none",
        "Periodic state/Maximum periods=2", "Periodic state/Tolerance=0",
        "Material/Relaxation time=200"] + steps_of(scheme, 8)).summary
        for memory in (0, 1000)]
    made = [summary["counters"]["assemblies"] for summary in summaries]
    print(f"{scheme}: {made} assemblies")
    kept = systems + (1 if scheme == "sdirk2" else 0)
    check(made[1] == kept and made[0] <= 2 * kept + 1, f"{scheme}: {made}")
    check_below(abs(summaries[0]["extremes"]["stress"]
                    / summaries[1]["extremes"]["stress"] - 1), 1e-10,
                f"{scheme}, stress with and without memory")

# A body that flows without end, and one that flows far within a period: stress
# is the difference of strains that rounding swamps, which is reported. Under a mean
# load the contact problems fail, else the stress of a run that ended well does.
for name, load, words in (
        ("mean load", " + 3", "set [Periodic state] Secular split = on"),
        ("no mean load", "", "Rounding leaves errors of")):
    status, _, message = execute(
        WHOLE, "--output", "results/swamped", *overrides([
            "Material/Relaxation time=1e-14" if load else
            "Material/Relaxation time=1e-25", "Output/Fields=none",
            f"Loads/Traction=0; 10*sin(2*pi*t/600){load}",
            "Contact/Solver=condensed active set",
            "Periodic state/Maximum periods=2", "Periodic state/Tolerance=0",
            *steps_of("sdirk2", 40)]))
    print(f"{name}: {message}")
    check(status == 3 and words in message, f"{name}: rounding is reported")
