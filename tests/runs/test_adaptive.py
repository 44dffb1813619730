"""Adaptive steps: the error follows the tolerance, steps of one period serve the
next, matrices stay few, and steps end where they are told to."""

from bars import BAR, LOAD, RELAXING, relaxing_bar
from crevasse_run import SOURCE, check, check_below, execute, overrides, run

SCENE = SOURCE / "prm/raous1980.prm"


def adaptive(scheme, tolerance):
    return [f"Time integration/Scheme={scheme}",
            "Time integration/Step control=adaptive",
            f"Time integration/Relative tolerance={tolerance}"]


SCHEMES = ("heun", "exponential", "sdirk2")

# A bar whose stress relaxes, against its closed form.
for scheme in SCHEMES:
    ratios = []
    for tolerance in (1e-3, 1e-4, 1e-5, 1e-6):
        results = run(BAR, "bar", RELAXING + adaptive(scheme, tolerance)
                      + ["Time integration/Steps per period=10"])
        top = results.table("probe_top.csv")
        error = max(abs(s / LOAD - relaxing_bar(t))
                    for t, s in zip(top["t"], top["s_33"]))
        ratios.append(error / tolerance)
        print(f"{scheme}, tolerance {tolerance}: {len(top['t']) - 1} steps, "
              f"error {error:.2e}")
    check(max(ratios) < 1 and max(ratios) < 10 * min(ratios),
          f"{scheme}: the error is in proportion to the tolerance: {ratios}")

# The paper's example under a mean load, that closes and opens the lip.
CONTACT = ["Loads/Traction=0; 10*(sin(2*pi*t/600) - 0.1)", "Output/Fields=none",
           "Contact/Solver=condensed active set", "Linear solver/Type=cholesky",
           "Periodic state/Maximum periods=30", "Periodic state/Tolerance=1e-8",
           "Time integration/Steps per period=20"]
reference = run(SCENE, "reference", CONTACT + [
    "Time integration/Scheme=rk4", "Time integration/Steps per period=400",
    "Time integration/Locate contact events=true",
    "Output/Field times="]).table("probe_C.csv")
at_ends = {round(t): s for t, s in zip(reference["t"], reference["s_22"])}
for scheme in SCHEMES:
    errors = []
    for tolerance in (1e-2, 1e-3, 1e-4):
        results = run(SCENE, "contact", CONTACT + adaptive(scheme, tolerance)
                      + ["Time integration/Steps=100, 200, 333.25"])
        summary = results.summary
        probe = results.table("probe_C.csv")
        period = summary["periods"]
        steps = summary["time_integration"]["steps_of_last_period"]
        check(summary["converged"], f"{scheme}: the periodic state is reached")
        # What a period began with is what it ended with.
        last, before = ([t for t in probe["t"] if 600 * k <= t < 600 * (k + 1)]
                        for k in (period - 1, period - 2))
        check(len(last) == steps and all(
            abs(a - b - 600) < 1e-9 for a, b in zip(last, before, strict=True)),
              f"{scheme}: the steps of the last two periods are the same")
        for t in (100, 200, 333.25):
            check(min(abs(600 * (period - 1) + t - s) for s in last) < 1e-9,
                  f"{scheme}: a step ends at {t}")
        errors.append(max(abs(s - at_ends[round(t)])
                          for t, s in zip(probe["t"], probe["s_22"])
                          if round(t / 600) * 600 == t and round(t) in at_ends)
                      / max(map(abs, reference["s_22"])))
        factorisations = summary["counters"]["factorisations"]
        print(f"{scheme}, tolerance {tolerance}: {steps} steps a period, "
              f"{summary['counters']['vi_solves']} VIs, {factorisations} "
              f"factorisations, error at the ends of periods {errors[-1]:.2e}, "
              f"{summary['time_integration']}")
        check(errors[-1] < tolerance, f"{scheme}: error within the tolerance")
        check(factorisations <= (25 if scheme == "sdirk2" else 1),
              f"{scheme}: {factorisations} factorisations")
    check(errors[2] < errors[0] / 10, f"{scheme}: errors fall: {errors}")

# A load that jumps: a step ends there if that is told, and cannot otherwise.
JUMP = ["Loads/Traction=0; t < 250 ? 10 : 2", "Geometry/Crack length=0.25",
        "Output/Fields=none", "Contact/Solver=condensed active set",
        "Periodic state/Maximum periods=1", "Periodic state/Tolerance=0"]
for steps in ("", "250"):
    results = run(SCENE, "jump", JUMP + adaptive("heun", 1e-4)
                  + [f"Time integration/Steps={steps}"])
    counts = results.summary["time_integration"]
    print(f"jump at 250, Steps = {steps}: {counts}")
    check((counts["rejected_steps"] < 5) == (steps != ""),
          "a jump costs steps unless it is named")

# No load, no error; and an impossible tolerance is told.
results = run(SCENE, "nothing", ["Loads/Traction=", "Output/Fields=none",
                                 "Boundary/Loaded=3"] + adaptive("heun", 1e-4))
check(results.summary["extremes"]["stress"] == 0., "no load, no stress")
for settings, exit_status, words in (
        (adaptive("rk4", 1e-4), 2, "heun, exponential, sdirk2 and those of arkode can"),
        (adaptive("heun", 0), 2, "must be greater than 0"),
        (adaptive("heun", 1e-14), 3, "Relative tolerance"),
        (adaptive("heun", 1e-4) + ["Material/Relaxation time=1e-6"], 3,
         "Choose Scheme = sdirk2, or exponential")):
    status, _, message = execute(SCENE, "--output", "results/refused",
                                 *overrides(settings))
    print(message.strip())
    check(status == exit_status and words in message, message)
