"""The bounds of the time step, with their check switched off: just above them
the stress of explicit schemes grows from step to step, just below it does not,
on meshes of 1/14, 1/56 and 1/224 alike (model, section 2). What has no bound
takes relaxation times a million apart within one body."""

import itertools

from bars import BAR
from crevasse_run import (FULL, SOURCE, check, check_below, execute, overrides, run,
                          tier)

SCENE = SOURCE / "prm/raous1980.prm"
STEPS, PERIODS = 10, 20
STEP = 600 / STEPS

LIMITS = {"euler": 2., "heun": 2., "rk4": 2.785293563405282}
MESHES = tier((0, 2), (0, 2, 4))


def settings(scheme, tau, refinements):
    return [f"Time integration/Scheme={scheme}",
            f"Time integration/Steps per period={STEPS}",
            f"Material/Relaxation time={tau:.15g}",
            "Loads/Traction=0; 10*(sin(2*pi*t/600)-0.1)",
            # Stress without load, which relaxes everywhere.
            "Material/Thermal expansion=1e-5",
            "Loads/Temperature=100*x*x*sin(3*y)",
            f"Geometry/Refinements={refinements}",
            "Contact/Solver=condensed active set", "Output/Fields=none",
            f"Periodic state/Maximum periods={PERIODS}",
            "Periodic state/Tolerance=0"]


def growth(scheme, tau, refinements):
    """The largest stress of the run against that of an elastic body."""
    results = run(SCENE, "bound", settings(scheme, tau, refinements)
                  + ["Time integration/Check stability=false"])
    return results.summary["extremes"]["stress"] / elastic[refinements]


elastic = {refinements: run(SCENE, "elastic", settings("heun", 60, refinements)
                            + ["Material/Viscosity=none"]
                            ).summary["extremes"]["stress"]
           for refinements in MESHES}
for scheme, limit in LIMITS.items():
    for refinements in MESHES if scheme == "heun" or FULL else (0,):
        below, above = (growth(scheme, STEP / limit * factor, refinements)
                        for factor in (1.02, 0.98))
        print(f"{scheme}, h = 1/{14 * 2**refinements}: largest stress / elastic "
              f"{below:.3g} below the bound, {above:.3g} above")
        check(below < 2.5, f"{scheme} does not grow below its bound")
        check(above > 10 * below, f"{scheme} grows above its bound")
    status, _, message = execute(
        SCENE, "--output", "results/refused",
        *overrides(settings(scheme, STEP / limit * 0.98, 0)))
    check(status == 3 and "sdirk2" in message,
          f"{scheme} refuses beyond its bound and names what works: {message}")
# Those of arkode's methods are computed from its tables.
for order, limit in tier(((3, 2.5127),), (
        (2, 2.), (3, 2.5127), (4, LIMITS["rk4"]), (5, 3.3066))):
    below, above = (run(SCENE, "bound", settings(
        "arkode explicit", STEP / limit * factor, 0) + [
            f"Time integration/Order={order}",
            "Time integration/Check stability=false"]
        ).summary["extremes"]["stress"] / elastic[0]
                    for factor in (1.02, 0.98))
    print(f"arkode explicit, order {order}: {below:.3g} below, {above:.3g} above")
    check(below < 2.5 and above > 10 * below, f"arkode explicit, order {order}")
    message = execute(SCENE, "--output", "results/refused", *overrides(settings(
        "arkode explicit", STEP / limit * 0.98, 0)
        + [f"Time integration/Order={order}"]))[2]
    check(f"{limit:.4g}"[:4] in message, f"the bound is reported: {message}")

# Half of a bar relaxes a million times faster than the other. A smooth rise of
# the load: whatever rises or falls all the time does so with steps of T/40. A
# load that is there at once: the fast half has no time to relax, and the one
# step over that leaves less than 3e-3 of the jump to the next.
HALVES = ["Geometry/Subdivisions=8, 8",
          "Material/Relaxation time=600 * (x < 0.5 ? 1e-6 : 1)",
          "Output/Probes=fast: 0.25, 0.5; slow: 0.75, 0.5; between: 0.5, 0.5; "
          "corner: 0, 0"]


def histories(load, scheme, steps):
    """All stresses and displacements but the last, for the load starts anew
    there, by probe and column."""
    results = run(BAR, "contrast", HALVES + [
        f"Loads/Traction=0; {load}", f"Time integration/Scheme={scheme}",
        f"Time integration/Steps per period={steps}"])
    return {(probe, column): results.table(f"probe_{probe}.csv")[column][:-1]
            for probe in ("fast", "slow", "between", "corner")
            for column in ("u_2", "s_11", "s_22")}


def wavering(values):
    """By how much a history goes against its direction; 0 if monotone."""
    steps = [b - a for a, b in itertools.pairwise(values)]
    return max(0., min(max(steps), -min(steps)))


for name, load, bound in (("rising load", "5*(1-cos(pi*t/600))", 1e-9),
                          ("load at once", "10", 3e-3)):
    exact = histories(load, "sdirk2", 2000)
    monotone = {key for key, values in exact.items()
                if 0 < max(map(abs, values)) and
                wavering(values[::50]) <= 1e-9 * max(map(abs, values))}
    check(len(monotone) >= 7, f"{name}: {len(monotone)} monotone histories")
    for scheme in ("sdirk2", "arkode implicit"):
        ours = histories(load, scheme, 40)
        check_below(max(wavering(ours[key]) / max(map(abs, exact[key]))
                        for key in monotone), bound,
                    f"{name}, {scheme}, T/40: {len(monotone)} histories that are "
                    "monotone waver by")
        check_below(max(max(abs(a - b) for a, b in zip(ours[key],
                                                       exact[key][::50]))
                        / max(map(abs, exact[key])) for key in monotone), 5e-3,
                    f"{name}, {scheme}, T/40: error")
for scheme in ("euler", "heun", "rk4", "predictor corrector"):
    status, _, message = execute(
        "contrast.prm", "--output", "results/refused",
        *overrides(HALVES + ["Loads/Traction=0; 10",
                             f"Time integration/Scheme={scheme}"]))
    check(status == 3 and "sdirk2" in message, f"{scheme} refuses: {message}")
