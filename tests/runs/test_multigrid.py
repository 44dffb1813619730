"""Matrix-free geometric multigrid gives what the other linear solvers do,
in the plane and in space, on one and two ranks; what it cannot do is refused.
"""

from crevasse_run import SOURCE, check, check_below, execute, run_on, tier

SCENES = {
    "space": (SOURCE / "prm/cracked_box.prm",
              ["Geometry/Subdivisions=4, 2, 2", "Geometry/Refinements=2"],
              "probe_front.csv"),
    "plane": (SOURCE / "prm/raous1980.prm",
              ["Contact/Solver=automatic", "Discretisation/Degree=2",
               "Geometry/Refinements=1"],
              "probe_C.csv")}
COMMON = ["Periodic state/Maximum periods=1", "Periodic state/Tolerance=0",
          "Time integration/Steps per period=12"]


def test_same_results():
    for label in tier(("space",), SCENES):
        scene, settings, probe = SCENES[label]

        def results(solver, n_ranks=1):
            return run_on(n_ranks, scene, f"{label}_{solver}_{n_ranks}",
                          COMMON + settings + [f"Linear solver/Type={solver}"])
        expected = results("mumps").table(probe)
        for solver, n_ranks in (("amg", 1), ("gmg", 1), ("gmg", 2)):
            found = results(solver, n_ranks)
            for column, values in found.table(probe).items():
                size = max(map(abs, expected[column])) or 1.
                check(len(values) == len(expected[column]), "rows")
                check_below(max(abs(a - b) for a, b in
                                zip(values, expected[column])) / size, 1e-8,
                            f"{label}, {solver}, {n_ranks} ranks, {column}")
            if solver == "gmg":
                check("matrix-free geometric multigrid" in
                      found.summary["contact_solver"]["description"], "solver")


def test_refusal():
    code, _, error = execute(SCENES["plane"][0], "--output", "results/refused",
                             "--set", "Linear solver/Type=gmg",
                             "--set", "Contact/Solver=projected sor")
    check(code == 2 and "has no matrix" in error, error)


test_same_results()
test_refusal()
