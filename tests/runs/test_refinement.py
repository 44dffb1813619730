"""Meshes refined towards the crack tip and adapted to the stress: their sizes,
the same results whatever solves on them and on however many ranks, the rates of
the energy error, what goes over from mesh to mesh, and what is refused."""

import math

from crevasse_run import (SOURCE, check, check_below, check_close, execute,
                          execute_on, full, overrides, run, run_on, tier)

SCENE = SOURCE / "prm/raous1980.prm"
ONE_PERIOD = ["Contact/Solver=automatic", "Time integration/Steps per period=20",
              "Periodic state/Maximum periods=1", "Periodic state/Tolerance=0",
              "Output/Fields=none"]
ELASTIC = ["Contact/Solver=automatic", "Material/Viscosity=none",
           "Time integration/Steps per period=4",
           "Periodic state/Maximum periods=1", "Output/Fields=none"]
TIP = "Refinement/Strategy=tip"
ADAPTIVE = "Refinement/Strategy=adaptive"

# Of the half model at F = 10, elastic and open, converged.
ENERGY = 9.71931251e-3


LENGTHS = ("u_1", "u_2", "opening")


def largest_difference(one, other, table):
    """Of the columns of two tables of probes, relative to the largest length or
    stress, that of the load included."""
    mine, theirs = one.table(table), other.table(table)
    check(list(mine) == list(theirs), f"columns of {table}")
    check(mine["t"] == theirs["t"], f"times of {table}")
    worst = 0.
    for is_length in (True, False):
        columns = [name for name in mine
                   if name != "t" and (name in LENGTHS) == is_length]
        size = max(abs(x) for name in columns for x in mine[name])
        size = size if is_length else max(size, 10.)
        worst = max(worst, *(abs(a - b) / size for name in columns for a, b in
                             zip(mine[name], theirs[name], strict=True)))
    return worst


def test_grading():
    width, height = 1 / 14, 1 / 4
    for n in (1, 4, 12):
        results = run(SCENE, "graded", ELASTIC + [TIP, f"Refinement/Cycles={n}"])
        summary = results.summary
        # Two cells touch the tip, on every level.
        check(summary["cells"] == 56 + 6 * n, f"cells with {n} levels")
        check(summary["levels"] == n + 1, "levels")
        check_close(summary["smallest_cell"],
                    math.hypot(width, height) / 2**n, 1e-12, "smallest cell")
    # In space two cells touch each of the 4 edges of the front. A division makes
    # eight cells of a cell and two edges of an edge.
    for n in (0, 1, 3):
        code, text, error = execute(
            SOURCE / "prm/cracked_box.prm", "--check", *overrides(
                ["Material/Viscosity=none"]
                + ([TIP, f"Refinement/Cycles={n}"] if n > 0 else [])))
        check(code == 0, error)
        check(f"  mesh: {128 + 7 * 2 * 4 * (2**n - 1)} cells," in text,
              f"cells in space with {n} levels:\n{text}")


@full
def test_target():
    for degree, target in ((1, 300), (2, 900)):
        settings = ELASTIC + [f"Discretisation/Degree={degree}", TIP]
        code, text, error = execute(SCENE, "--check", *overrides(
            settings + [f"Refinement/Target unknowns={target}"]))
        check(code == 0, error)
        n = run(SCENE, "target", settings
                + [f"Refinement/Target unknowns={target}"]).summary
        check(f"{n['cells']} cells, {n['unknowns']} unknowns" in text,
              "--check knows the sizes")
        more = run(SCENE, "target_passed", settings
                   + [f"Refinement/Cycles={n['levels']}"]).summary
        print(f"Q{degree}: {n['unknowns']} unknowns, then {more['unknowns']}")
        check(n["unknowns"] <= target < more["unknowns"], "the last that fits")


def test_solvers_agree():
    # Opens and closes; the lip's nodes crowd at the tip.
    for degree in (1, 2):
        settings = ONE_PERIOD + [f"Discretisation/Degree={degree}", TIP,
                                 "Refinement/Cycles=3", "Contact/Tolerance=1e-13",
                                 "Contact/Maximum iterations=100000",
                                 "Output/Probes=C: 1, 0; near: 0.53, 0.02"]
        reference = run(SCENE, "condensed", settings
                        + ["Contact/Solver=condensed active set"])
        closed = reference.table("contact.csv")["closed_nodes"]
        check(min(closed) == 0 and max(closed) > 3, f"opens, closes: {closed}")
        for solver in tier(("active set",), ("active set", "projected sor")):
            other = run(SCENE, solver.replace(" ", "_"), settings
                        + [f"Contact/Solver={solver}"])
            for table in ("probe_C.csv", "probe_near.csv"):
                check_below(largest_difference(reference, other, table), 1e-10,
                            f"Q{degree}, {solver}: {table}")


def test_ranks():
    for name, refinement in {
            "tip": [TIP, "Refinement/Cycles=4"],
            "adaptive": [ADAPTIVE, "Refinement/Cycles=4"],
            "foretold": [ADAPTIVE, "Refinement/Target unknowns=3000"],
            "readapted": [ADAPTIVE, "Refinement/Cycles=2",
                          "Refinement/Readapt every=1",
                          "Refinement/Coarsen fraction=0.02",
                          "Periodic state/Maximum periods=2"]}.items():
        settings = ONE_PERIOD + ["Discretisation/Degree=2",
                                 "Linear solver/Type=mumps"] + refinement
        reference = run(SCENE, name, settings)
        for n_ranks in tier((2,), (2, 3)):
            other = run_on(n_ranks, SCENE, f"{name}_{n_ranks}", settings)
            for key in ("cells", "unknowns", "smallest_cell"):
                check(reference.summary[key] == other.summary[key],
                      f"{name} on {n_ranks} ranks: {key}")
            check_below(largest_difference(reference, other, "probe_C.csv"),
                        1e-9, f"{name} on {n_ranks} ranks: probe_C.csv")


def rate(meshes, least):
    """Slope of the norm of the error against unknowns, by least squares."""
    points = [(math.log(mesh["unknowns"]),
               0.5 * math.log(1 - mesh["energy"] / ENERGY))
              for mesh in meshes if mesh["unknowns"] >= least]
    check(len(points) >= 4, "enough meshes")
    mean_x = sum(x for x, _ in points) / len(points)
    mean_y = sum(y for _, y in points) / len(points)
    return (sum((x - mean_x) * (y - mean_y) for x, y in points)
            / sum((x - mean_x)**2 for x, _ in points))


@full
def test_energy_rates():
    for degree, expected, target in ((1, -0.5, 60000), (2, -1., 60000))[
            tier(1, 0):]:
        results = run(SCENE, f"rates_{degree}", ELASTIC + [
            f"Discretisation/Degree={degree}", ADAPTIVE,
            "Geometry/Subdivisions=2, 2",
            f"Refinement/Target unknowns={target}"])
        meshes = results.summary["refinement"]["meshes"]
        print(f"Q{degree}: cells, unknowns, relative error of the energy norm, "
              "estimated one")
        for mesh in meshes:
            error = math.sqrt(1 - mesh["energy"] / ENERGY)
            print(f"  {mesh['cells']:6} {mesh['unknowns']:7} {error:.3e} "
                  f"{mesh['estimated_error']:.3e} "
                  f"{mesh['estimated_error'] / error:.2f}")
        check_close(rate(meshes, 1000), expected, 0.15 * -expected,
                    f"Q{degree}: rate of the energy norm")
        for mesh in meshes:
            error = math.sqrt(1 - mesh["energy"] / ENERGY)
            check(0.5 < mesh["estimated_error"] / error < 2.,
                  "the estimate is about the error")
        if degree == 2:
            # By the rate of the energy, from a mesh nearby.
            near = next(m for m in meshes if m["unknowns"] >= 1500)
            check_below((1 - near["energy"] / ENERGY)
                        * (near["unknowns"] / 3000)**2, 2e-4,
                        "energy with 3000 unknowns")


def test_divisions_for_an_estimate():
    """Cells are divided several times after one estimate, with squares that are
    foretold. With Cycles each mesh is divided once: the same ends with it."""
    settings = ELASTIC + ["Discretisation/Degree=2", ADAPTIVE,
                          "Geometry/Subdivisions=10, 10",
                          "Refinement/Target unknowns=8000"]
    several, single = (
        run(SCENE, name, settings + more).summary["refinement"]["meshes"]
        for name, more in (("several", []), ("single", ["Refinement/Cycles=40"])))
    for name, meshes in (("several", several), ("single", single)):
        print(name, [(m["unknowns"], m["estimated_error"]) for m in meshes])
    check(len(several) <= 6 and len(single) >= 15, "far fewer meshes")
    # The error falls with the first power of the unknowns.
    several, single = (meshes[-1]["estimated_error"] * meshes[-1]["unknowns"]
                       for meshes in (several, single))
    check_below(several / single, 1.1, "error for the same unknowns")


def test_tolerance():
    results = run(SCENE, "tolerance", ELASTIC + [
        ADAPTIVE, "Discretisation/Degree=2", "Refinement/Tolerance=0.02"])
    errors = [mesh["estimated_error"]
              for mesh in results.summary["refinement"]["meshes"]]
    check(errors[-1] <= 0.02 < errors[-2], f"ends at the tolerance: {errors}")


def test_joining():
    """The first mesh may be smaller than the one before, which is no reason to end;
    a mesh that comes back is. Divisions end, too, where about as many cells are
    joined as are divided."""
    def unknowns(cells, target, *more):
        results = run(SCENE, "joining", ELASTIC + [
            ADAPTIVE, "Discretisation/Degree=2",
            f"Geometry/Subdivisions={cells}, {cells}",
            f"Refinement/Target unknowns={target}", *more])
        return [mesh["unknowns"] for mesh in results.summary["refinement"]["meshes"]]

    few = unknowns(2, 3000, "Geometry/Refinements=3", "Refinement/Coarsen fraction=0.005")
    check(few[1] < few[0] < 0.9 * 3000 < few[-1], f"goes on: {few}")
    many = unknowns(10, 8000, "Refinement/Coarsen fraction=0.1")
    check(many[-1] in many[:-1], f"ends: {many}")
    unknowns(10, 8000, "Refinement/Marking=fixed fraction",
             "Refinement/Refine fraction=0.05", "Refinement/Coarsen fraction=0.3")


def test_readaptation():
    # A mean load, so that the viscous strain has an integral; a viscosity that
    # redistributes the stress.
    settings = ["Contact/Solver=automatic", "Discretisation/Degree=2",
                "Geometry/Subdivisions=4, 4", "Geometry/Refinements=2",
                "Material/Viscosity=isotropic",
                "Material/Viscous modulus=780000*if(x<0.3,0.2,1)",
                "Material/Viscous Poisson ratio=0.4",
                "Loads/Traction=0; 3+10*sin(2*pi*t/600)",
                "Periodic state/Maximum periods=4", "Periodic state/Tolerance=0",
                "Output/Fields=none", "Output/Load work=true",
                ADAPTIVE, "Refinement/Cycles=2",
                "Refinement/Marking=fixed fraction",
                "Refinement/Refine fraction=0.1",
                "Refinement/Coarsen fraction=0.3"]
    results = run(SCENE, "readapted", settings + ["Refinement/Readapt every=2"])
    summary = results.summary
    meshes = summary["refinement"]["meshes"]
    taken = summary["refinement"]["readaptations"]
    check([step["after_period"] for step in taken] == [2], "once, in the middle")
    for step in taken:
        before, after = (step[f"viscous_strain_{when}"]
                         for when in ("before", "after"))
        print(f"cells {meshes[-1]['cells']} -> {step['cells']}, norm of r "
              f"{before['norm']} -> {after['norm']}, integrals "
              f"{before['integral']} -> {after['integral']}")
        size = max(map(abs, before["integral"]))
        check(size > 0.1 * before["norm"], "there is an integral")
        check_below(max(abs(a - b) for a, b in zip(before["integral"],
                                                   after["integral"])) / size,
                    1e-12, "change of the integral of r")
        change = 1 - after["norm"] / before["norm"]
        check(change > 1e-9, "cells were joined, which takes from the norm")
        check_below(change, 1e-3, "change of the norm of r")
    check(summary["periods"] == 4, "all periods")
    check(results.table("periods.csv")["period"] == [1, 2, 3, 4], "their table")
    for name in ("probe_C.csv", "contact.csv", "load_work.csv"):
        times = results.table(name)["t"]
        check(times == [15. * k for k in range(161)], f"{name} goes on")
    # The same as on a mesh that stays.
    fixed = run(SCENE, "not_readapted", settings)
    opening, expected = (r.table("probe_C.csv")["opening"]
                         for r in (results, fixed))
    check_below(max(abs(a - b) for a, b in zip(opening, expected, strict=True))
                / max(expected), 1e-2, "opening after another adaptation")
    more = (summary["counters"]["vi_solves"]
            - fixed.summary["counters"]["vi_solves"])
    check(more in (1, 2), f"{more} more contact problems, for the displacement "
          "to take over: all legs are counted")


@full
def test_five_periods():
    """Against a uniform mesh with 64 times the cells of the paper's, whose own
    error singular functions take away; without them it is 1 %."""
    scene = SOURCE / "prm/studies/crack_tip_adaptive.prm"
    fine = ["Refinement/Strategy=none", "Geometry/Subdivisions=112, 32"]
    exact = run(scene, "uniform_singular",
                fine + ["Discretisation/Singular functions=2"])
    plain = run(scene, "uniform", fine)
    limit = exact.table("probe_C.csv")["opening"]
    check(min(limit) < 1e-6 < max(limit), "opens and closes")

    def error(results):
        opening = results.table("probe_C.csv")["opening"]
        return max(abs(a - b) for a, b in
                   zip(opening, limit, strict=True)) / max(limit)

    print(f"uniform, 64 times finer: {plain.summary['unknowns']} unknowns, "
          f"error without singular functions {error(plain):.2e}")
    # After a mesh for T/2 the periods want another one.
    for settings in [], ["Refinement/Readapt every=2", "Refinement/Instants=300"]:
        adaptive = run(scene, "five_periods", settings)
        check_below(error(adaptive), 1e-3, f"{settings}: opening with "
                    f"{adaptive.summary['unknowns']} unknowns")
        check(error(adaptive) < error(plain), "better than the finer mesh")
    refinement = adaptive.summary["refinement"]
    check(refinement["readaptations"][0]["cells"] > refinement["meshes"][-1]["cells"],
          "another mesh, to which the viscous strain goes over")


def refused(settings, expected):
    code, _, error = execute(SCENE, "--check", *overrides(settings))
    print(error.strip())
    check(code == 2 and expected in error, f"{settings}: {code}, {error}")


def test_refusals():
    refused([TIP, "Refinement/Cycles=2", "Geometry/Shape=rectangle"],
            "the mesh has no crack tip")
    refused([TIP, "Refinement/Cycles=2", "Boundary/Contact=none",
             "Boundary/Open crack=none"],
            "the mesh has no crack tip")
    refused([TIP, "Refinement/Cycles=30"], "must be at most 26")
    refused([ADAPTIVE, "Refinement/Cycles=2", "Loads/Traction=0; 0"],
            "the stress is zero")
    again = [ADAPTIVE, "Refinement/Cycles=1", "Refinement/Readapt every=1"]
    refused(again + ["Periodic state/Method=anderson"],
            "unless [Periodic state] Method = march")
    refused(again + ["Periodic state/Secular split=on"],
            "with [Periodic state] Secular split = on")
    refused(again + ["Material/Viscosity=none"],
            "with [Material] Viscosity = none")


def test_mesh_that_is_fine_enough():
    """A first mesh with more unknowns than Target unknowns is kept, on all ranks."""
    for strategy in (TIP, ADAPTIVE):
        words = ("--check", *overrides([strategy, "Refinement/Target unknowns=100",
                                        "Contact/Solver=automatic"]))
        for code, output, error in (execute(SCENE, *words),
                                    execute_on(3, SCENE, *words)):
            check(code == 0 and "Target unknowns = 100: the mesh has 150 before "
                  "refinement, and is not refined" in output, output + error)
            check("150 unknowns" in output, output)


for test in (test_grading, test_target, test_solvers_agree, test_ranks,
             test_energy_rates, test_divisions_for_an_estimate, test_tolerance,
             test_joining, test_readaptation, test_five_periods, test_refusals,
             test_mesh_that_is_fine_enough):
    print(test.__name__)
    test()
