"""What a scene does not need costs nothing, and what it needs is made once:
the counters of summary.json, one test for each effect, and the table of
effects itself."""

import re

from cracked import PLATE
from crevasse_run import check, check_below, execute, overrides, probe_difference, run

SCENE = PLATE + """
subsection Geometry
  set Subdivisions = 6, 4
end
subsection Loads
  set Traction = 0; 10*sin(2*pi*t/600)
end
subsection Periodic state
  set Maximum periods = 2
  set Tolerance       = 0
end
subsection Output
  set Probes = mouth: 1, 0; inside: 0.3, 0.6
  set Fields = none
end
"""

STEPS, STAGES = 40, 2
# Heun's second stage lies within the step: two instants for each.
INSTANTS = STAGES * STEPS

NAMES = {"contact", "friction", "viscosity", "secular flow", "chain", "thermal strain",
         "varying stiffness", "varying viscosity", "body force", "imposed displacement",
         "singular functions", "stress intensity", "field output"}


def effects(results):
    return {name: effect["on"]
            for name, effect in results.summary["effects"].items()}


def counters(results, *names):
    values = [results.summary["counters"][name] for name in names]
    print(f"{results.directory.name}:", ", ".join(
        f"{name} {value}" for name, value in zip(names, values)))
    return values


def matrices(results):
    return counters(results, "assemblies", "factorisations")


def test_table():
    """Each effect is named, with a reason, and on where the scene asks for it
    and nowhere else."""
    always = {"contact", "viscosity"}
    for on, settings in (
            (set(), []),
            ({"secular flow"}, ["Loads/Traction=0; 10*sin(2*pi*t/600) + 1"]),
            ({"chain"}, ["Material/Viscosity=chain",
                         "Material/Chain=0.5: 40; 0.3: 100"]),
            ({"thermal strain"}, ["Material/Thermal expansion=1e-5",
                                  "Loads/Temperature=10*y"]),
            ({"varying stiffness"},
             ["Material/Stiffness time factor=1 + 0.1*sin(2*pi*t/600)"]),
            ({"varying stiffness", "varying viscosity"},
             ["Material/Young modulus=13000*(1 + 0.1*sin(2*pi*t/600))"]),
            ({"varying viscosity"},
             ["Material/Relaxation time=60 + 10*sin(2*pi*t/600)"]),
            ({"varying viscosity"},
             ["Material/Viscosity time factor=1 + 0.1*cos(2*pi*t/600)"]),
            # The mean that counts is weighted by 1/eta_0.
            ({"varying viscosity", "secular flow"},
             ["Material/Viscosity time factor=1 + 0.1*sin(2*pi*t/600)"]),
            ({"body force"}, ["Loads/Body force=0; sin(2*pi*t/600)"]),
            ({"imposed displacement"},
             ["Boundary/Displaced=3", "Loads/Traction=",
              "Loads/Displacement=free; 1e-3*sin(2*pi*t/600)"]),
            ({"field output"}, ["Output/Fields=vtu"])):
        table = run(SCENE, "table", settings).summary["effects"]
        found = {name for name, effect in table.items() if effect["on"]}
        print("; ".join(f"{name}: {effect['why']}"
                        for name, effect in table.items()
                        if effect["on"] or name in on))
        check(set(table) == NAMES, f"effects {set(table) ^ NAMES}")
        check(found == always | on, f"{settings}: on are {found}")
        check(all(len(effect["why"]) > 5 for effect in table.values()),
              "each with a reason")


def test_constant_stiffness():
    for name, settings in {
            "constant": [],
            "stiffness_factor":
                ["Material/Stiffness time factor=1 + 0.5*sin(2*pi*t/600)"],
            "viscosity_factor":
                ["Material/Viscosity time factor=1 + 0.5*cos(2*pi*t/600)"],
            "varying_viscosity":
                ["Material/Relaxation time=60 + 10*sin(2*pi*t/600) + x"],
            "temperature": ["Material/Thermal expansion=1e-5",
                            "Loads/Temperature=100*x*sin(2*pi*t/600)"],
            "chain": ["Material/Viscosity=chain",
                      "Material/Chain=0.5: 40; 0.3: 100"]}.items():
        check(matrices(run(SCENE, name, settings)) == [1, 1],
              f"{name}: one matrix, one factor")


def test_varying_stiffness():
    """One matrix for each distinct instant, kept for later periods; without
    memory made anew, with the same results."""
    varying = ["Material/Young modulus=13000*(1 + 0.5*x*sin(2*pi*t/600))"]
    kept = {}
    for periods in (1, 2, 4):
        here = varying + [f"Periodic state/Maximum periods={periods}"]
        kept[periods] = run(SCENE, f"kept_{periods}", here)
        check(matrices(kept[periods]) == [INSTANTS, INSTANTS],
              "one for each instant")
        none = run(SCENE, f"anew_{periods}", here + [
            "Linear solver/Memory for instants=0"])
        found = matrices(none)
        check(found[0] == found[1] and found[0] >= periods * INSTANTS,
              "one for each instant of each period")
        check_below(probe_difference(kept[periods], none), 1e-10,
                    "results with and without memory")
        if periods == 4:
            # Some are kept, the others made anew.
            part = run(SCENE, "part", here + [
                "Linear solver/Memory for instants=1"])
            some = matrices(part)
            check(INSTANTS < some[0] < found[0], "some are kept")
            check_below(probe_difference(kept[periods], part), 1e-10,
                        "results with and without some memory")
    # Equal instants: those of Euler are the beginnings of the steps.
    check(matrices(run(SCENE, "euler", varying + [
        "Time integration/Scheme=euler"])) == [STEPS, STEPS],
        "Euler: one for each step")
    # rk4: the middle stages share an instant, the last one is the first of the
    # next step.
    check(matrices(run(SCENE, "rk4", varying + [
        "Time integration/Scheme=rk4"])) == [2 * STEPS, 2 * STEPS],
        "rk4: two for each step")


def test_no_contact():
    summary = run(SCENE, "no_contact", ["Boundary/Contact=none"]).summary
    counter = summary["counters"]
    print("without contact:", summary["contact_solver"]["name"], counter)
    check(summary["contact_solver"]["name"] == "none", "no contact solver")
    check(not summary["effects"]["contact"]["on"], "no contact")
    check(summary["contact_nodes"] == 0, "no nodes of it")
    check(counter["linear_solves"] == 2 * INSTANTS + 1, "plain solves only")
    check(counter["vi_solves"] == counter["vi_iterations"] == 0
          and "vi_mean" not in summary["seconds"], "no contact problem")


def test_no_viscosity():
    results = run(SCENE, "no_viscosity", [
        "Material/Viscosity=none", "Output/Fields=vtu",
        "Output/Field times=150", "Loads/Traction=0; 10*sin(2*pi*t/600) + 1"])
    summary = results.summary
    counter = summary["counters"]
    print("without viscosity:", counter)
    check(counter["rate_evaluations"] == 0, "nothing creeps")
    # One problem for each step, no stages between.
    check(counter["vi_solves"] == summary["periods"] * STEPS + 1,
          "a problem for each step")
    check("drift" not in summary and not summary["secular"]["on"]
          and "largest_rate" not in summary["secular"], "nothing flows")
    fields = "".join(path.read_text(errors="replace") for path in
                     results.directory.glob("solution*.pvtu"))
    check("displacement" in fields and "viscous" not in fields,
          "no field of the viscous strain")
    fields = "".join(
        path.read_text(errors="replace") for path in
        run(SCENE, "viscous", ["Output/Fields=vtu"]).directory.glob(
            "solution*.pvtu"))
    check("viscous_strain" in fields, "which there is otherwise")


def test_secular_flow():
    """Zero mean: nothing to solve. Otherwise one problem more, with the same
    matrix for a viscosity in proportion to the stiffness, with one of its own
    for another."""
    summary = run(SCENE, "zero_mean").summary
    base = summary["counters"]["vi_solves"]
    check(not summary["secular"]["on"] and base == 2 * INSTANTS + 1,
          "zero mean: off")
    mean = ["Loads/Traction=0; 10*sin(2*pi*t/600) + 1"]
    for name, settings, on, matrix in (
            ("proportional", [], True, 1),
            ("other", ["Material/Viscosity=isotropic",
                       "Material/Viscous modulus=13000*60",
                       "Material/Viscous Poisson ratio=0.45"], True, 2),
            ("switched_off", ["Periodic state/Secular split=off"], False, 1),
            ("varying", ["Material/Relaxation time=60 + sin(2*pi*t/600)"],
             False, 1),
            ("spring", ["Material/Viscosity=chain", "Material/Chain=0.5: 60"],
             False, 1)):
        results = run(SCENE, name, mean + settings)
        secular = results.summary["secular"]
        print(f"{name}: {secular['why']}")
        check(secular["on"] == on, f"{name}: {secular}")
        check(matrices(results) == [matrix, matrix], f"{name}: matrices")
        check(counters(results, "vi_solves") == [base + on],
              f"{name}: problems solved")


def verbose(name, settings):
    """What a run prints between the table of periods and its end."""
    status, output, error = execute(
        f"{name}.prm", "--verbose", "--force", "--output", f"results/{name}",
        *overrides(settings))
    check(status == 0, error)
    return output.split("ms a call\n")[1].split("\n  Time = ")[0]


def test_meters():
    """Parts of the time that add up to it, each called as often as the scene
    says; a table on request."""
    settings = ["Geometry/Refinements=4", "Output/Fields=vtu",
                "Output/Field times=150", "Output/Checkpoint every=1"]
    results = run(SCENE, "meters", settings)
    summary, log = results.summary, (results.directory / "log.txt").read_text()
    share, calls, seconds = (summary[name] for name in ("share", "calls", "seconds"))
    counter = summary["counters"]
    print(calls, share, seconds)
    evaluations = 2 * INSTANTS + 1  # the last one is for the fields
    # Instants at which the lip opens and closes are found after the last period.
    located = calls["rate evaluations"] - evaluations
    check(2 <= located <= 30, f"{located} solves to find two instants")
    for name, number in {
            "assembly": 1, "factorisation": 1, "time stepping": 1,
            "strain sweeps": 2 * (evaluations + located),
            **dict.fromkeys(("contact problems", "linear solves", "contact on the lip",
                             "certificates"), evaluations + located),
            "tables": 2 * STEPS + 1, "fields": 2, "checkpoints": 2}.items():
        check(calls[name] == number, f"{name}: {calls[name]}, not {number}")
        check(0 < share[name] * seconds["total"] <= seconds[name] * (1 + 1e-9), name)
    check(counter["vi_solves"] == counter["rate_evaluations"] == evaluations,
          "counters agree")
    check_below(abs(sum(share.values()) - 1), 1e-9, "parts of the whole")
    check(0 <= share["all else"] <= 0.3, "most of it has a name")
    check(seconds["vi_mean"] * evaluations <= seconds["time stepping"]
          and seconds["back_solve_mean"] * evaluations <= seconds["linear solves"],
          "means")
    check("ms a call" not in log, "not asked for")
    table = verbose("meters", settings)
    print(table)
    rows = table.splitlines()
    check({re.split("  +", row)[1] for row in rows} == set(share), "a row for each")


if __name__ == "__main__":
    test_table()
    test_constant_stiffness()
    test_varying_stiffness()
    test_no_contact()
    test_no_viscosity()
    test_secular_flow()
    test_meters()
