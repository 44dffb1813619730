"""Imposed displacements: bars and shear against closed forms, elastic and viscous, with
a steady rate, in the plane, in space and on rings; periodic motions by all methods; two
lips, singular functions, multigrid and two processes; reactions against loads."""

import math
import pathlib

import meshio

from cracked import CRACK, square
from crevasse_run import check, check_below, execute, overrides, plain, run, run_on

# A bar of length 2 along y that may contract, held at its lower end.
BAR = """
subsection Geometry
  set Shape        = rectangle
  set Width        = 1
  set Height       = 2
  set Subdivisions = 3, 5
end
subsection Boundary
  set Loaded    = none
  set Displaced = 3
end
subsection Material
  set Young modulus   = 100
  set Poisson ratio   = 0.3
  set Relaxation time = 2
end
subsection Loads
  set Period       = 4
  set Displacement = free; 0.02*sin(2*pi*t/4)
end
subsection Periodic state
  set Maximum periods = 1
  set Tolerance       = 0
end
subsection Output
  set Probes = top: 1, 2; inside: 0.4, 1.1
  set Fields = none
end
"""
ELASTIC = ["Material/Viscosity=none"]


def worst(values, exact, size):
    return max(abs(a - b) for a, b in zip(values, exact, strict=True)) / size


def columns(results, name, probe="inside"):
    return results.table(f"probe_{probe}.csv")[name]


def test_elastic_bar():
    """Stress, contraction, and the reaction, in the plane, in space and on rings."""
    for name, more, width in (
            ("plane", [], 1.), ("degree_2", ["Discretisation/Degree=2"], 1.),
            ("mean", ["Material/Plane state=axisymmetric", "Discretisation/Degree=1",
                      "Discretisation/Volumetric strain=mean"], 0.5),
            ("ring", ["Material/Plane state=axisymmetric"], 0.5),
            ("space", ["Dimension=3", "Geometry/Shape=box", "Geometry/Thickness=1",
                       "Geometry/Subdivisions=2, 3, 2", "Boundary/Symmetry=0, 2, 5",
                       "Loads/Displacement=free; 0.02*sin(2*pi*t/4); free",
                       "Output/Probes=top: 1, 2, 1; inside: 0.4, 1.1, 0.3"], 1.)):
        results = run(BAR, f"elastic_{name}", ELASTIC + more)
        t = columns(results, "t")
        strain = [0.01 * math.sin(2 * math.pi * x / 4) for x in t]
        for column, factor, probe in (
                ("s_22", 100, "inside"), ("s_11", 0, "inside"), ("u_2", 1.1, "inside"),
                ("u_2", 2, "top"), ("u_1", -0.3, "top")):
            check_below(worst(columns(results, column, probe),
                              [factor * e for e in strain], 1. if factor == 100 else 0.01),
                        1e-12, f"{name}: {column} at {probe}")
        reactions = results.table("reactions.csv")
        check_below(worst(reactions["F_y_3"], [100 * width * e for e in strain], 1.),
                    1e-12, f"{name}: reaction")
        check_below(max(map(abs, reactions["F_x_3"])), 1e-12, "no other reaction")


def test_elastic_shear():
    """All sides move as in a uniform shear; on a mesh with hanging nodes."""
    g = "0.01*sin(2*pi*t/4)"
    for name, more in (("uniform", []), ("hanging", [
            "Refinement/Strategy=adaptive", "Refinement/Cycles=2",
            "Refinement/Marking=fixed fraction", "Refinement/Refine fraction=0.3"])):
        results = run(BAR, f"shear_{name}", [
            *ELASTIC, *more, "Boundary/Displaced=0, 1, 2, 3", "Boundary/Symmetry=none",
            f"Loads/Displacement=0: {g}*y; 0 | 1: {g}*y; 0 | 2: {g}*y; 0 | 3: {g}*y; 0"])
        t = columns(results, "t")
        exact = [0.01 * math.sin(2 * math.pi * x / 4) * 100 / 2.6 for x in t]
        check_below(worst(columns(results, "s_12"), exact, 0.4), 1e-12, f"shear, {name}")
        forces = results.table("reactions.csv")
        check_below(max(abs(sum(forces[f"F_{axis}_{side}"][k] for side in range(4)))
                        for axis in "xy" for k in range(len(t))), 1e-12, "equilibrium")


def test_relaxation():
    """Under a constant displacement the stress relaxes; at the order of the scheme."""
    errors = []
    for n in (20, 40):
        results = run(BAR, f"relaxation_{n}", [
            "Loads/Displacement=free; 0.02", f"Time integration/Steps per period={n}",
            "Time integration/Scheme=sdirk2"])
        errors.append(worst(columns(results, "s_22"),
                            [math.exp(-t / 2) for t in columns(results, "t")], 1.))
    print("errors of 20 and 40 steps:", *errors)
    check_below(errors[1], 2e-4, "relaxation")
    check(3.5 < errors[0] / errors[1] < 4.6, f"order: {errors}")
    exact = run(BAR, "relaxation_exact", ["Loads/Displacement=free; 0.02",
                                          "Time integration/Scheme=exponential"])
    check_below(worst(columns(exact, "s_22"),
                      [math.exp(-t / 2) for t in columns(exact, "t")], 1.), 1e-12,
                "relaxation by the exponential scheme")
    law = run(BAR, "relaxation_power", [
        "Loads/Displacement=free; 0.02", "Material/Viscosity=power law",
        "Material/Creep coefficient=0.01", "Material/Creep exponent=3",
        "Time integration/Scheme=rk4", "Time integration/Steps per period=200"])
    check_below(worst(columns(law, "s_22"),
                      [1 / math.sqrt(1 + 2 * t) for t in columns(law, "t")], 1.), 1e-6,
                "relaxation with a power law")


def test_heat():
    """Thermal strain beside an imposed displacement."""
    results = run(BAR, "heat", [*ELASTIC, "Material/Thermal expansion=1e-4",
                                "Loads/Temperature=50*sin(2*pi*t/4)"])
    exact = [0.5 * math.sin(2 * math.pi * t / 4) for t in columns(results, "t")]
    check_below(worst(columns(results, "s_22"), exact, 0.5), 1e-12, "stress of a warm bar")


def test_flow_in_fields():
    """Probe and fields have displacement and rate; the formula repeats, by itself it
    does not."""
    results = run(BAR, "parabola", [
        "Loads/Displacement=free; 0.005*t*(4 - t)", "Loads/Displacement rate=free; 0.003",
        "Periodic state/Maximum periods=2", "Output/Fields=vtu"])
    exact = [0.005 * (t % 4) * (4 - t % 4) + 0.003 * t for t in columns(results, "t")]
    check_below(worst(columns(results, "u_2", "top"), exact, 0.02), 1e-12, "at the probe")
    mesh = meshio.read(results.directory / "solution_0000.0.vtu")
    moved = mesh.point_data["displacement"][mesh.points[:, 1] > 1.99, 1]
    check_below(abs(moved / 0.024 - 1).max(), 1e-6, "in fields")  # of seven digits


METHODS = ["Time integration/Scheme=trapezoid", "Time integration/Steps per period=40",
           "Periodic state/Maximum periods=100", "Periodic state/Tolerance=1e-11"]


def test_secular_bar():
    """A rate v of one end: the stress is eta v / L in the mean, the displacement grows."""
    for method in ("march", "anderson", "fourier"):
        results = run(BAR, f"secular_{method}", [
            *METHODS, f"Periodic state/Method={method}", "Loads/Displacement rate=free; 0.003"])
        t = columns(results, "t")
        mean = sum(columns(results, "s_22")[-40:]) / 40
        check_below(abs(mean / (100 * 2 * 0.0015) - 1), 1e-9, f"{method}: mean stress")
        moved = [0.02 * math.sin(2 * math.pi * x / 4) + 0.003 * x for x in t]
        check_below(worst(columns(results, "u_2", "top"), moved, 0.02), 1e-12,
                    f"{method}: displacement of the end")
        beta = results.summary["secular"]["per_probe"]
        check_below(abs(beta["top"]["beta"][1] / 0.003 - 1), 1e-12, "beta of the end")
        check_below(abs(beta["inside"]["beta"][1] / 0.00165 - 1), 1e-12, "beta inside")
        check_below(abs(results.table("reactions.csv")["F_y_3"][-1]
                        - columns(results, "s_22")[-1]), 1e-12, "its reaction")


PLATE = BAR.replace("rectangle", "edge crack").replace("3, 5", "8, 6")
PULL = ["Loads/Displacement=free; 0.01*(0.4 + sin(2*pi*t/4))*(1 + x/4)",
        "Loads/Traction=", "Crack tip/Stress intensity=true",
        "Output/Probes=mouth: 1, 0; inside: 0.75, 0.5"]
# Without it no contact force has a mean, and the lip closes less and less for ever.
ADVANCE = "Loads/Displacement rate=free; -0.002"


def test_methods_with_contact():
    """A cracked plate whose lip closes: march, anderson and fourier agree."""
    every = {method: run(PLATE, f"plate_{method}", [
        *METHODS, *PULL, ADVANCE, f"Periodic state/Method={method}"])
        for method in ("march", "anderson", "fourier")}
    n = 41
    for method in ("anderson", "fourier"):
        for name, column in (("probe_mouth", "opening"), ("probe_mouth", "pressure"),
                             ("probe_inside", "s_22"), ("crack_tip", "K_I"),
                             ("reactions", "F_y_3")):
            mine, theirs = (every[which].table(f"{name}.csv")[column][-n:]
                            for which in (method, "march"))
            check_below(worst(mine, theirs, max(map(abs, theirs))), 1e-9,
                        f"{method}, {column}")
    check(max(every["march"].table("contact.csv")["closed_nodes"]) > 0, "never closed")


def test_chain_averaged():
    """Relaxation times decades apart, by the averaged body."""
    settings = [*PULL, "Loads/Displacement rate=free; -2e-5", "Material/Viscosity=chain", "Material/Chain=0.5: 1; 0.5: 400",
                "Time integration/Scheme=sdirk2", "Time integration/Steps per period=16",
                "Periodic state/Maximum periods=60", "Periodic state/Tolerance=1e-9"]
    one, other = (run(PLATE, f"chain_{method}", [*settings, f"Periodic state/Method={method}"])
                  for method in ("anderson", "averaged"))
    for name, column in (("probe_mouth", "opening"), ("probe_inside", "s_22")):
        mine, theirs = (results.table(f"{name}.csv")[column][-17:]
                        for results in (one, other))
        check_below(worst(mine, theirs, max(map(abs, theirs))), 1e-7, f"chain, {column}")


def test_solvers_and_ranks():
    """Singular functions; multigrid; two processes."""
    pathlib.Path("plate.prm").write_text(plain(PLATE))
    settings = [*PULL, "Time integration/Steps per period=8"]
    plate = run("plate.prm", "plate", settings)
    for other in (run_on(2, "plate.prm", "ranks", settings),
                  run("plate.prm", "gmg", [*settings, "Linear solver/Type=gmg",
                                           "Contact/Solver=active set",
                                           "Linear solver/Tolerance=1e-12"])):
        for name, column in (("probe_mouth", "opening"), ("reactions", "F_y_3"),
                             ("crack_tip", "K_I")):
            mine, theirs = (results.table(f"{name}.csv")[column]
                            for results in (other, plate))
            check_below(worst(mine, theirs, max(map(abs, theirs))), 1e-9,
                        f"{other.directory}, {column}")
    fine = [*PULL, *ELASTIC, "Discretisation/Degree=2", "Geometry/Subdivisions=16, 32",
            "Time integration/Steps per period=4"]
    K = [run(PLATE, f"singular_{n}", [*fine, f"Discretisation/Singular functions={n}"]
             ).table("crack_tip.csv")["K_I"][1] for n in (0, 2)]
    check_below(abs(K[0] / K[1] - 1), 2e-2, "K_I without singular functions")


def test_two_lips():
    """Both halves of a plate have twice the opening of one, and opposite reactions; a
    traction that the reactions equal gives the same."""
    square("half.msh", half=True)
    square("full.msh")
    scene = PLATE.replace("edge crack", "mesh file")
    common = [*ELASTIC, *PULL[1:3], "Time integration/Steps per period=8",
              "Output/Probes=mouth: 1, 0", "Boundary/Loaded=none"]
    half = run(scene, "half", [*common, "Geometry/Mesh file=half.msh", "Boundary/Displaced=4",
                               "Boundary/Symmetry=3", f"Boundary/Contact={CRACK}", PULL[0],
                               "Boundary/Fixed points=0.5, 0: 1"])
    up = PULL[0].partition("; ")[2]
    both = run(scene, "full", [
        *common, "Geometry/Mesh file=full.msh", "Boundary/Displaced=3, 4",
        f"Boundary/Crack={CRACK}", "Boundary/Fixed points=0.5, 0: 1",
        f"Loads/Displacement=4: free; {up} | 3: free; -({up})"])
    openings = [results.table("probe_mouth.csv")["opening"] for results in (half, both)]
    check_below(worst(openings[1], [2 * x for x in openings[0]], max(openings[1])), 1e-9,
                "opening")
    forces = both.table("reactions.csv")
    check_below(worst(forces["F_y_4"], [-x for x in forces["F_y_3"]],
                      max(forces["F_y_4"])), 1e-9, "opposite reactions")
    check_below(worst(forces["F_y_4"], half.table("reactions.csv")["F_y_4"],
                      max(forces["F_y_4"])), 1e-9, "reaction of the half")


def test_reactions_equal_loads():
    """Of a clamped end under traction, pressure and body force at its other sides, with
    a displaced end that holds still."""
    results = run(BAR, "loads", [
        *ELASTIC, "Boundary/Symmetry=none", "Boundary/Clamped=2", "Boundary/Displaced=3",
        "Loads/Displacement=0; 0", "Boundary/Loaded=0, 1", "Loads/Body force=3; -5*t",
        "Loads/Traction=0: 7*t; 2 | 1: 1; y", "Loads/Pressure=0: 11", "Loads/Period=1",
        "Time integration/Steps per period=4"])
    forces = results.table("reactions.csv")
    for k, t in enumerate(forces["t"]):
        t = t % 1
        for axis, load in (("x", 3 * 2 + 7 * t * 2 + 1 * 2 + 11 * 2),
                           ("y", -5 * t * 2 + 2 * 2 + 2)):
            check_below(abs(forces[f"F_{axis}_2"][k] + forces[f"F_{axis}_3"][k] + load)
                        / 30, 1e-9, f"equilibrium along {axis}")


def test_refused():
    """With the parameter and what to do."""
    for settings, expected in (
            (["Loads/Displacement="], "must have a value for the boundary id 3"),
            (["Loads/Displacement=1: 0; 0"], "boundary id 1 must have the role Displaced"),
            (["Boundary/Displaced=none"], "no boundary has the role Displaced"),
            (["Loads/Displacement=0"], "must be 2 formulas"),
            (["Loads/Displacement rate=1; 0"], "must be free for component 1"),
            (["Loads/Displacement rate=free; t"], "cannot be used"),
            (["Loads/Displacement rate=free; 1", *ELASTIC], "Displacement rate"),
            (["Output/Load work=true"], "[Output] Load work"),
            (["Boundary/Loaded=3", "Loads/Traction=0; 1"], "must have one role only")):
        path = pathlib.Path("refused.prm")
        path.write_text(plain(BAR))
        status, _, error = execute(path, "--check", *overrides(settings))
        check(status == 2 and expected in error, f"{settings}: {status} {error}")


def test_inclined_supports_are_refused():
    """Nodes that are imposed and tied to an inclined plane, or open an inclined lip."""
    square("half_17.msh", degrees=17, half=True)
    path = pathlib.Path("inclined.prm")
    path.write_text(plain(BAR.replace("rectangle", "mesh file")))
    for roles, expected in (
            (["Boundary/Displaced=4", "Boundary/Symmetry=2, 3"], "a plane of symmetry"),
            (["Boundary/Displaced=2", "Boundary/Symmetry=none",
              f"Boundary/Contact={CRACK}"], "a lip whose normal")):
        status, _, error = execute(path, "--check", *overrides(
            ["Geometry/Mesh file=half_17.msh", "Output/Probes=", *roles]))
        check(status == 2 and expected in error, f"{roles}: {status} {error}")


test_elastic_bar()
test_elastic_shear()
test_relaxation()
test_heat()
test_flow_in_fields()
test_secular_bar()
test_methods_with_contact()
test_chain_averaged()
test_solvers_and_ranks()
test_two_lips()
test_reactions_equal_loads()
test_refused()
test_inclined_supports_are_refused()
