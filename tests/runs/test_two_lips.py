"""Cracks whose two lips touch each other: against half models with a plane of
symmetry, turned, by all solvers, on several processes, where cracks kink, cross
and separate parts, and on adapted meshes."""

import math
import pathlib
import random

from cracked import (BOTTOM, CRACK, FRONT, LEFT, TOP, at_edge, square, square_scene,
                     steps, turned, write_block)
from crevasse_run import (Results, check, check_below, execute, execute_on, full,
                          overrides, plain, run, run_on, start, sweep, tier)

from crevasse.fields import Fields

AUTOMATIC = ["Contact/Solver=condensed active set"]
FOUR_STEPS = ["Time integration/Steps per period=12",
              "Periodic state/Maximum periods=1", "Periodic state/Tolerance=0",
              "Material/Relaxation time=200"]


def write(name, scene):
    pathlib.Path(name).write_text(plain(scene))
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
        if largest(theirs[column]) > 1e-9:  # open lips have forces of rounding
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


@full
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


def test_multigrid_at_45_degrees():
    """Where components of the normal are equal, all meshes take the same one."""
    for half in (True, False):
        iterations = []
        for degrees in (44, 45):
            square("turned.msh", degrees=degrees, half=half)
            results = run(square_scene("turned.msh", degrees, half), "multigrid", [
                *FOUR_STEPS, "Geometry/Refinements=2", "Contact/Solver=active set",
                "Linear solver/Type=gmg", "Linear solver/Tolerance=1e-12"])
            iterations.append(results.summary["counters"]["linear_iterations"])
        print("iterations at 44 and 45 degrees:", *iterations)
        check(iterations[1] <= 1.01 * iterations[0], "more iterations at 45 degrees")


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
    """Both lips are divided alike, also where the body is stiffer on one side, and the
    estimate falls."""
    square("full_17.msh", degrees=17)
    for strategy, more in (("adaptive", ["Refinement/Target unknowns=3000"]),
                           ("adaptive", ["Refinement/Cycles=3", "Material/Young modulus="
                                         "13000*if(y > 0.3*x, 1, 30)"]),
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


def along(cracks):
    """On cracks along lines of the mesh: (normal, value, begin, end) each."""
    return lambda middle, normal: any(
        normal == axis and abs(middle[axis] - value) < 1e-9
        and begin < middle[1 - axis] < end for axis, value, begin, end in cracks)


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


def compare_contact(one, other, bound, what):
    mine, theirs = (results.table("contact.csv") for results in (one, other))
    rounding = 1e-10  # of loads of about 10: the lip never closes
    for column in ("force", "largest_pressure"):
        if largest(theirs[column]) > rounding:
            check_below(difference(mine[column], theirs[column]), bound,
                        f"{what}: {column}")
        else:
            check_below(largest(mine[column]), rounding, f"{what}: {column}, open")


def test_random_scenes():
    """Cracks along the lines of a distorted mesh, which may cross, with gaps, in
    two materials, under random loads: the contact solvers agree."""
    for seed in range(tier(4, 100)):
        generator = random.Random(seed)
        n = 8
        shift = {(i, j): (generator.uniform(-0.02, 0.02), generator.uniform(-0.02, 0.02))
                 for i in range(n + 1) for j in range(n + 1)}
        turn = turned(generator.uniform(0, 360))

        def place(point):
            dx, dy = shift[round(n * point[0]), round(n * point[1])]
            return turn((point[0] + dx, point[1] + dy))
        cracks = []
        for _ in range(generator.randint(1, 3)):
            begin = generator.randint(1, n - 4) / n
            cracks.append((generator.randint(0, 1), generator.randint(1, n - 1) / n,
                           begin, begin + generator.randint(2, 3) / n))
        soft = generator.random()
        write_block("random.msh", [steps(0, 1, n)] * 2, along(cracks), place,
                    lambda middle: 1 + (middle[0] > soft))
        settings = ["Geometry/Mesh file=random.msh",
                    f"Discretisation/Degree={generator.randint(1, 2)}",
                    "Material/Young modulus=1000*material",
                    f"Boundary/Gap=-{generator.choice((0, 1e-3))}*x^2",
                    f"Loads/Traction={generator.uniform(-9, 9)}*cos(2*pi*t); "
                    f"{generator.uniform(-9, 9)}*sin(2*pi*t)"]
        one, other, third = (run(SCENE_OF_SQUARE, f"random_{solver[:3]}", [
            *settings, f"Contact/Solver={solver}"]) for solver in (
                "condensed active set", "active set", "projected sor"))
        compare_contact(other, one, 1e-8, f"seed {seed}")
        compare_contact(third, one, 1e-6, f"seed {seed}, SOR")
        if seed % 10 == 0:
            pathlib.Path("random.prm").write_text(plain(SCENE_OF_SQUARE))
            n_ranks = (2, 3, 7)[seed // 10 % 3]
            compare_contact(run_on(n_ranks, "random.prm", "random_ranks", settings),
                            one, 1e-8, f"seed {seed}, {n_ranks} processes")


@full
def test_crossing_cracks():
    """T- and X-shaped, kinked and interacting cracks: two contact solvers
    agree."""
    shapes = {"T": [(1, 0.5, 0.2, 0.8), (0, 0.5, 0.2, 0.5)],
              "X": [(1, 0.5, 0.2, 0.8), (0, 0.5, 0.2, 0.8)],
              "L": [(1, 0.5, 0.2, 0.5), (0, 0.5, 0.2, 0.5)],
              "two": [(1, 0.5, 0.2, 0.6), (1, 0.25, 0.5, 0.9)],
              "border": [(0, 0.5, 0.5, 1.)]}
    for name, cracks in shapes.items():
        write_block(f"{name}.msh", [steps(0, 1, 8)] * 2, along(cracks), turned(20))
        mesh = f"Geometry/Mesh file={name}.msh"
        ways = [run(SCENE_OF_SQUARE, f"{name}_{solver[:3]}", [
            mesh, f"Contact/Solver={solver}"]) for solver in (
                "condensed active set", "active set", "projected sor")]
        for other in ways[1:]:
            compare_contact(other, ways[0], 1e-7, name)
        check(ways[0].summary["contact_nodes"] > 2, "contact nodes")


@full
def test_resumed():
    """A run that goes on ends as one that never ended, byte for byte; on other
    processes to rounding."""
    square("full_17.msh", degrees=17)
    scene = write("resumed.prm", square_scene("full_17.msh", 17))
    redistributes = ["Output/Checkpoint every=2", "Periodic state/Tolerance=0",
                     "Material/Viscosity=isotropic",
                     "Material/Viscous modulus=780000*if(x<0.3,0.2,1)",
                     "Material/Viscous Poisson ratio=0.4"]

    def go(name, n_periods, *more, way=execute):
        return way(scene, "--output", f"results/{name}", *more, *overrides(
            [*redistributes, f"Periodic state/Maximum periods={n_periods}"]))
    for name, n_periods in (("whole", 5), ("part", 3), ("part_of_3", 3)):
        status, _, error = go(name, n_periods, "--force")
        check(status == 0, error)
    status, _, error = go("part", 5, "--resume")
    check(status == 0, error)
    for table in ("probe_mouth.csv", "contact.csv"):
        check(pathlib.Path("results/part", table).read_bytes() ==
              pathlib.Path("results/whole", table).read_bytes(), table)
    status, _, error = go("part_of_3", 5, "--resume",
                          way=lambda *words: execute_on(3, *words))
    check(status == 0, error)
    check_below(compare_histories(Results("results/part_of_3"),
                                  Results("results/whole")), 1e-9,
                "resumed on three processes")


def test_slip():
    """Closed lips slide where the body is sheared, and not by symmetry."""
    square("full.msh")
    pressed = run(square_scene("full.msh"), "pressed", [
        *AUTOMATIC, "Loads/Traction=0; -(5+sin(2*pi*t/600))*y"])
    check(pressed.table("contact.csv")["closed_nodes"][-1] == 7, "all is closed")
    slip = pressed.summary["slip_while_closed"]["largest"]
    size = pressed.summary["extremes"]["displacement"]
    check_below(slip / size, 1e-9, "slip of symmetric lips")
    sheared = run(square_scene("full.msh"), "sheared", [
        *AUTOMATIC, f"Boundary/Clamped={BOTTOM}", f"Boundary/Loaded={TOP}",
        "Boundary/Fixed points=none", "Loads/Traction=sin(2*pi*t/600); -5"])
    slip = sheared.summary["slip_while_closed"]
    size = sheared.summary["extremes"]["displacement"]
    check(slip["largest"] > 0.01 * size and abs(slip["at"][1]) < 1e-12,
          f"sheared lips slide: {slip}")
    # Open lips have forces of rounding, and lips that touch have none.
    for pull in ("5+sin(2*pi*t/600)", "0"):
        opened = run(square_scene("full.msh"), "opened", [
            *AUTOMATIC, f"Loads/Traction=sin(2*pi*t/600)*y; ({pull})*y"])
        check(opened.summary["slip_while_closed"]["largest"] == 0.,
              f"{pull}: what does not press does not slide")
        check("slide on each other" not in (opened.directory / "log.txt").read_text(),
              f"{pull}: a line of the log")


HYDROSTATIC = """
subsection Geometry
  set Shape = mesh file
end
subsection Boundary
  set Fixed points = -1, -1; 1, -1: 2
end
subsection Material
  set Young modulus = 1000
  set Viscosity = none
end
subsection Loads
  set Traction = if(x<-0.999, 5, if(x>0.999, -5, 0)); if(y<-0.999, 5, if(y>0.999, -5, 0))
end
subsection Time integration
  set Steps per period = 1
end
subsection Crack tip
  set Stress intensity = false
end
"""


def test_kink():
    """Under hydrostatic pressure lips bear it, whatever way they go: in an L, along
    an edge in space, around a part that contact alone holds, and where rigid planes
    meet. The force is p times the length of the lip."""
    def is_l(middle, normal):
        return (normal == 1 and middle[1] == 0 and 0 < middle[0] < 0.5
                or normal == 0 and middle[0] == 0 and 0 < middle[1] < 0.5)

    def is_square(middle, normal):
        return abs(middle[normal]) == 0.5 > abs(middle[1 - normal])
    axis = steps(-1, 1, 8)
    write_block("kink.msh", (axis, axis), is_l)
    write_block("edge.msh", (axis, axis, steps(0, 1, 2)), is_l)
    write_block("part.msh", (axis, axis), is_square)
    write_block("planes.msh", (axis, steps(0, 1, 2)), lambda *_: False,
                lambda at: (at[0], at[1] - 0.75 * max(0, at[0]) * (1 - at[1])))
    block = run(HYDROSTATIC.replace("-1, -1; 1, -1: 2", "-1, -1, 0: 1, 2; 1, -1, 0: 2"),
                "edge", ["Dimension=3", "Geometry/Mesh file=edge.msh",
                         f"Boundary/Symmetry={FRONT}, {FRONT + 1}",
                         f"Boundary/Crack={CRACK}", "Boundary/Loaded=1, 2, 3, 4",
                         "Loads/Traction=if(x<-0.999, 5, if(x>0.999, -5, 0)); "
                         "if(y<-0.999, 5, if(y>0.999, -5, 0)); 0",
                         "Output/Probes=kink: 0, 0, 0.5; on: 0.25, 0, 0.5"])
    check_pressed(block, "edge", 1, ("kink", "on"))
    for degree in (1, 2):
        for name, length, roles in (
                ("kink", 1, [f"Boundary/Crack={CRACK}", "Boundary/Loaded=1, 2, 3, 4"]),
                ("part", 4, [f"Boundary/Crack={CRACK}", "Boundary/Loaded=1, 2, 3, 4"]),
                ("planes", 2.25, [f"Boundary/Contact={BOTTOM}", "Boundary/Loaded=1, 2, 4",
                                  "Boundary/Fixed points=none"])):
            place = {"kink": "0, 0", "part": "0.5, 0.5", "planes": "0, 0"}[name]
            results = run(HYDROSTATIC, f"{name}_{degree}", [
                f"Geometry/Mesh file={name}.msh", f"Discretisation/Degree={degree}",
                f"Output/Probes=kink: {place}", *roles])
            check_pressed(results, f"{name}, degree {degree}", length, ("kink",))


def check_pressed(results, what, length, probes):
    contact, lip = results.table("contact.csv"), results.table("lip.csv")
    check_below(abs(contact["force"][0] / (5 * length) - 1), 1e-9, f"{what}: force")
    check_below(max(abs(p / 5 - 1) for p in (*lip["largest_pressure"],
                                             *contact["largest_pressure"])), 1e-9,
                f"{what}: pressure")
    check(contact["closed_nodes"][0] == len(lip["lip"]), f"{what}: all is closed")
    for name in probes:
        check_below(abs(results.table(f"probe_{name}.csv")["pressure"][0] / 5 - 1), 1e-9,
                    f"{what}: pressure at {name}")


def test_side_of_probe():
    """Log and summary name the lip whose displacement a probe has: pulled apart, it
    moves into its body, away from the other one."""
    square("full.msh")
    results = run(square_scene("full.msh"), "side", [
        *AUTOMATIC, "Loads/Traction=0; 5*y", *FOUR_STEPS])
    side = results.summary["probes"]["mouth"]["body_of_lip"]
    check(largest([side[0], abs(side[1]) - 1]) < 1e-12, f"{side}")
    table = results.table("probe_mouth.csv")
    check(table["opening"][-1] > 0 and
          abs(table["u_2"][-1] - side[1] * table["opening"][-1] / 2)
          < 1e-6 * table["opening"][-1],
          "the lip moves into its body by half of the opening")
    log = (results.directory / "log.txt").read_text()
    check("probe mouth: lies on a crack" in log and f"(0, {side[1]:g})" in log, log)
    check("body_of_lip" not in results.summary["probes"]["inside"],
          "a probe within the body")


@full
def test_sweep():
    """Where there is contact a study measures its force unasked; tips have tables
    of their own."""
    square("full.msh")
    scene = write("swept.prm", square_scene("full.msh"))
    for quantity, wanted in (("contact/force", ()),
                             ("crack_tip_1/K_I", ("--error", "crack_tip_1/K_I"))):
        rows, _ = sweep(
            "sweep", scene, *wanted, "--vary", "Time integration/Steps per period=20,40",
            "--reference", "Time integration/Steps per period=80",
            *overrides([*AUTOMATIC, "Crack tip/Stress intensity=true"]),
            fresh=not wanted, run=start)
        errors = [float(row[f"error:{quantity}"]) for row in rows]
        check(0 < errors[1] < errors[0], errors)


def test_pictures():
    """Lips that are apart are two lines of the outline, not one within."""
    square("full_17.msh", degrees=17)
    results = run(square_scene("full_17.msh", 17), "pictures", [
        *FOUR_STEPS, "Output/Field times=150, 450"])
    turn_back = turned(-17)
    for number, n_expected in ((0, 2 * 7), (1, 0)):  # open, then closed
        fields = Fields(results.directory / f"solution_{number:04}.pvtu")
        middles = fields.points[fields.outline()].mean(axis=1)
        on_lip = [turn_back(point) for point in middles]
        n_found = sum(abs(y) < 1e-6 and 0 < x < 1 for x, y in on_lip)
        check(n_found == n_expected, f"{n_found} edges of lips, {n_expected} expected")


def test_unmatched_lip():
    square("full.msh")
    scene = square_scene("full.msh").replace(f"set Crack = {CRACK}",
                                             f"set Crack = {LEFT}, {CRACK}")
    status, _, error = execute(write("unmatched.prm", scene),
                               "--output", "results/unmatched")
    check(status == 2 and "has no partner" in error, error)


def test_crack_of_one_element():
    write_block("short.msh", (steps(0, 1, 3), steps(-1, 1, 2)),
                lambda middle, normal: normal == 1 and abs(middle[0] - 0.5) < 0.1
                and middle[1] == 0)
    status, _, error = execute(write("short.prm", square_scene("short.msh")),
                               "--output", "results/short")
    check(status == 2 and f"the crack of the physical group {CRACK}, which has 1 "
          "element, cannot open" in error and "at least two elements" in error, error)


test_full_is_half()
test_heterogeneous()
test_turned()
test_one_lip_turned()
test_solvers()
test_multigrid_at_45_degrees()
test_ranks()
test_adapted_meshes()
test_space()
test_crossing_cracks()
test_random_scenes()
test_resumed()
test_slip()
test_kink()
test_side_of_probe()
test_sweep()
test_pictures()
test_unmatched_lip()
test_crack_of_one_element()
