"""Cracks whose two lips touch each other: against half models with a plane of
symmetry, turned, by all solvers, on several processes, where cracks kink, cross
and separate parts, and on adapted meshes."""

import math
import pathlib
import random

from cracked import (BOTTOM, CRACK, FRONT, LEFT, TOP, at_edge, square, square_scene,
                     steps, turned, write_block)
from crevasse_run import check, check_below, execute, run, run_on, tier

AUTOMATIC = ["Contact/Solver=condensed active set"]
FOUR_STEPS = ["Time integration/Steps per period=12",
              "Periodic state/Maximum periods=1", "Periodic state/Tolerance=0",
              "Material/Relaxation time=200"]


def write(name, scene):
    pathlib.Path(name).write_text(scene)
    return name


def largest(values):
    return max(map(abs, values))


def difference(one, other, factor=1.):
    """Of two lists, relative to the largest of the second."""
    return largest(a - factor * b for a, b in zip(one, other, strict=True)) / \
        largest(b * factor for b in other)


def compare_histories(one, other, factor=1., columns=("opening", "pressure"),
                      probe="probe_mouth.csv"):
    mine, theirs = one.table(probe), other.table(probe)
    worst = 0.
    for column in columns:
        if largest(theirs[column]) > 0.:
            worst = max(worst, difference(mine[column], theirs[column],
                                          factor if column == "opening" else 1.))
    return worst


def test_full_is_half():
    for degree, n in ((1, 14), (2, 14)):
        square("half.msh", n, half=True)
        square("full.msh", n)
        settings = [*AUTOMATIC, f"Discretisation/Degree={degree}"]
        half = run(square_scene("half.msh", half=True), f"half_{degree}", settings)
        both = run(square_scene("full.msh"), f"full_{degree}", settings)
        check_below(compare_histories(both, half, 2.), 1e-9,
                    f"opening and pressure, degree {degree}")
        check_below(compare_histories(both, half, 1., ("u_1", "u_2", "s_11", "s_22",
                                                       "s_12"), "probe_inside.csv"),
                    1e-9, f"displacement and stress, degree {degree}")
        mine, theirs = (results.summary["counters"] for results in (both, half))
        print(mine, theirs)
        check(mine["vi_iterations"] - theirs["vi_iterations"] in (-1, 0, 1),
              "the numbers of sets differ")


def test_heterogeneous():
    """Moduli, gap and temperature of a random body that is symmetric."""
    generator = random.Random(5)
    stiffness = {(i, j): generator.choice((1, 2, 3)) for i in range(14)
                 for j in range(4)}

    def material(middle):
        return stiffness[int(14 * middle[0]), int(4 * abs(middle[1]))]
    square("half.msh", half=True, material=material)
    square("full.msh", material=material)
    settings = [*AUTOMATIC, "Material/Young modulus=13000*material^2",
                "Material/Relaxation time=30+20*material",
                "Material/Thermal expansion=1e-5",
                "Loads/Temperature=20*x*abs(y)*sin(2*pi*t/600+1)"]
    half = run(square_scene("half.msh", half=True), "random_half",
               [*settings, "Boundary/Gap=-2e-4*x*(1-x)"])
    both = run(square_scene("full.msh"), "random_full",
               [*settings, "Boundary/Gap=-4e-4*x*(1-x)"])
    check_below(compare_histories(both, half, 2.), 1e-9, "heterogeneous")
    check_below(compare_histories(both, half, 1., ("s_11", "s_22", "s_12"),
                                  "probe_inside.csv"), 1e-9, "its stress")


def test_turned():
    square("full.msh")
    straight = run(square_scene("full.msh"), "turned_0", AUTOMATIC)
    for degrees in tier((17, 90), (17, 45, 90)):
        square("turned.msh", degrees=degrees)
        results = run(square_scene("turned.msh", degrees), f"turned_{degrees}",
                      AUTOMATIC)
        check_below(compare_histories(results, straight), 1e-9,
                    f"turned by {degrees} degrees")
        mine = results.table("probe_inside.csv")
        theirs = straight.table("probe_inside.csv")
        for invariant in (lambda a, b, c: a + b,
                          lambda a, b, c: math.hypot((a - b) / 2, c)):
            values = [[invariant(*s) for s in zip(t["s_11"], t["s_22"], t["s_12"],
                                                  strict=True)]
                      for t in (mine, theirs)]
            check_below(difference(*values), 1e-9, "invariant of the stress")


def test_one_lip_turned():
    """A lip that touches a rigid plane in any direction."""
    square("half.msh", half=True)
    straight = run(square_scene("half.msh", half=True), "one_lip_0", AUTOMATIC)
    square("half_17.msh", degrees=17, half=True)
    results = run(square_scene("half_17.msh", 17, half=True), "one_lip_17",
                  AUTOMATIC)
    check_below(compare_histories(results, straight), 1e-9, "one lip, 17 degrees")


def test_solvers():
    square("full_17.msh", degrees=17)
    scene = square_scene("full_17.msh", 17)
    settings = [*FOUR_STEPS, "Geometry/Refinements=2"]
    reference = run(scene, "condensed", settings + AUTOMATIC)
    for solver, linear, bound in (
            ("active set", "cholesky", 1e-9), ("active set", "gmg", 1e-8),
            ("active set", "amg", 1e-8), ("condensed active set", "mumps", 1e-9)):
        results = run(scene, "solver", [*settings, f"Contact/Solver={solver}",
                                        f"Linear solver/Type={linear}",
                                        "Linear solver/Tolerance=1e-12"])
        check_below(compare_histories(results, reference), bound,
                    f"{solver} with {linear}")
    coarse = FOUR_STEPS
    sor = run(scene, "sor", [*coarse, "Contact/Solver=projected sor"])
    check_below(compare_histories(sor, run(scene, "coarse", coarse + AUTOMATIC)),
                1e-8, "projected SOR")


def test_ranks():
    square("full_17.msh", degrees=17)
    scene = write("ranks.prm", square_scene("full_17.msh", 17))
    settings = [*FOUR_STEPS, "Geometry/Refinements=1"]
    alone = run(scene, "one_rank", settings)
    for n_ranks in tier((3,), (2, 3, 7)):
        results = run_on(n_ranks, scene, f"ranks_{n_ranks}", settings)
        check_below(compare_histories(results, alone), 1e-8,
                    f"{n_ranks} processes")
        check_below(compare_histories(results, alone, 1., ("u_1", "s_11", "s_22"),
                                      "probe_inside.csv"), 1e-8, "and within")


def test_adapted_meshes():
    """Both lips are divided alike, and the estimate falls."""
    square("full_17.msh", degrees=17)
    for strategy, more in (("adaptive", ["Refinement/Target unknowns=3000"]),
                           ("tip", ["Refinement/Cycles=4"])):
        results = run(square_scene("full_17.msh", 17), strategy,
                      [*FOUR_STEPS, f"Refinement/Strategy={strategy}", *more])
        n_unknowns = results.summary["unknowns"]
        print(f"{strategy}: {n_unknowns} unknowns")
        check(n_unknowns > 400, "the mesh was not refined")
    readapted = run(square_scene("full_17.msh", 17), "readapted", [
        *FOUR_STEPS, "Periodic state/Maximum periods=3", "Refinement/Strategy=adaptive",
        "Refinement/Cycles=2", "Refinement/Readapt every=1",
        "Refinement/Coarsen fraction=0.1"])
    check(len(readapted.summary["refinement"]["readaptations"]) == 2, "readapted")


def block_scene(mesh, half):
    roles = (f"set Contact = {CRACK}\n  set Symmetry = {BOTTOM}, {FRONT}\n"
             f"  set Loaded = {TOP}" if half else
             f"set Crack = {CRACK}\n  set Symmetry = {FRONT}\n"
             f"  set Loaded = {BOTTOM}, {TOP}")
    ties = "0.5, 0, 0: 1; 0.5, 0, 0.5: 1" + ("" if half else
                                            "; 0.5, 0, 0: 2; 0, 0, 0: 2; 0.5, 0, 0.5: 2")
    return f"""
set Dimension = 3
subsection Geometry
  set Shape = mesh file
  set Mesh file = {mesh}
end
subsection Boundary
  {roles}
  set Fixed points = {ties}
end
subsection Material
  set Young modulus = 13000
  set Poisson ratio = 0.2
  set Relaxation time = 200
end
subsection Loads
  set Period = 600
  set Traction = 0; 10*sin(2*pi*t/600)*y*(1+z); 0
end
subsection Output
  set Probes = mouth: 1, 0, 0.25; inside: 0.75, 0.5, 0.25
end
"""


def test_space():
    axes = [steps(0, 1, 4), steps(-1, 1, 4), steps(0, 0.5, 2)]
    write_block("full.msh", axes, at_edge)
    write_block("half.msh", [axes[0], steps(0, 1, 2), axes[2]], at_edge)
    settings = ["Time integration/Steps per period=12", "Geometry/Refinements=1",
                "Periodic state/Maximum periods=1", "Periodic state/Tolerance=0"]
    half = run(block_scene("half.msh", True), "half_block", settings)
    both = run(block_scene("full.msh", False), "full_block", settings)
    check_below(compare_histories(both, half, 2.), 1e-9, "opening in space")
    check_below(compare_histories(both, half, 1., ("u_1", "u_2", "u_3", "s_22"),
                                  "probe_inside.csv"), 1e-9, "and within")
    gmg = run(block_scene("full.msh", False), "full_block_gmg", [
        *settings, "Linear solver/Type=gmg", "Contact/Solver=active set"])
    check_below(compare_histories(gmg, both), 1e-7, "with multigrid")
    run(block_scene("full.msh", False), "graded_block", [
        *settings, "Geometry/Refinements=0", "Refinement/Strategy=tip",
        "Refinement/Cycles=2"])


def crossing(path, cracks):
    """A clamped square with cracks along lines of the mesh: (normal, value, begin,
    end) each."""
    def is_crack(middle, normal):
        return any(normal == axis and abs(middle[axis] - value) < 1e-9
                   and begin < middle[1 - axis] < end
                   for axis, value, begin, end in cracks)
    return write_block(path, [steps(0, 1, 8), steps(0, 1, 8)], is_crack,
                       turned(20))


SCENE_OF_SQUARE = f"""
subsection Geometry
  set Shape = mesh file
end
subsection Boundary
  set Clamped = {BOTTOM}
  set Loaded = {TOP}
  set Crack = {CRACK}
end
subsection Material
  set Young modulus = 1000
  set Poisson ratio = 0.3
  set Relaxation time = 2
end
subsection Loads
  set Period = 1
  set Traction = 3*cos(2*pi*t); 10*sin(2*pi*t)
end
subsection Periodic state
  set Maximum periods = 1
  set Tolerance = 0
end
"""


def test_crossing_cracks():
    """T- and X-shaped, kinked and interacting cracks: two contact solvers
    agree."""
    shapes = {"T": [(1, 0.5, 0.2, 0.8), (0, 0.5, 0.2, 0.5)],
              "X": [(1, 0.5, 0.2, 0.8), (0, 0.5, 0.2, 0.8)],
              "L": [(1, 0.5, 0.2, 0.5), (0, 0.5, 0.2, 0.5)],
              "two": [(1, 0.5, 0.2, 0.6), (1, 0.25, 0.5, 0.9)],
              "border": [(0, 0.5, 0.5, 1.)]}
    for name, cracks in shapes.items():
        crossing(f"{name}.msh", cracks)
        mesh = f"Geometry/Mesh file={name}.msh"
        ways = [run(SCENE_OF_SQUARE, name, [mesh, *more]) for more in (
            ["Contact/Solver=condensed active set"],
            ["Contact/Solver=active set"], ["Contact/Solver=projected sor"])]
        for other in ways[1:]:
            mine, theirs = (way.table("contact.csv") for way in (ways[0], other))
            for column in mine:
                if column != "t" and largest(theirs[column]) > 0.:
                    check_below(difference(mine[column], theirs[column]), 1e-7,
                                f"{name}: {column}")
        check(ways[0].summary["contact_nodes"] > 2, "contact nodes")


def test_unmatched_lip():
    square("full.msh")
    scene = square_scene("full.msh").replace(f"set Crack = {CRACK}",
                                             f"set Crack = {LEFT}, {CRACK}")
    status, _, error = execute(write("unmatched.prm", scene),
                               "--output", "results/unmatched")
    check(status == 2 and "has no partner" in error, error)


test_full_is_half()
test_heterogeneous()
test_turned()
test_one_lip_turned()
test_solvers()
test_ranks()
test_adapted_meshes()
test_space()
test_crossing_cracks()
test_unmatched_lip()
