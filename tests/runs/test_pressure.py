"""Loads by boundary, and loads in cracks: a pressure p in a crack is a traction p on
the plate but for a uniform stress, in the plane, on rings and in space; parts of
cracks under pressure against closed forms, with contact elsewhere."""

import math
import pathlib

from cracked import BOTTOM, CRACK, TOP, at_edge, square, steps, turned, write_block
from crevasse_run import check, check_below, execute, full, overrides, plain, run, run_on

MESH = """
subsection Geometry
  set Shape = mesh file
  set Mesh file = full.msh
end
subsection Boundary
  set Fixed points = 0, -1; 0, 1: 1
end
subsection Material
  set Young modulus = 13000
  set Poisson ratio = 0.2
  set Viscosity = none
end
subsection Crack tip
  set Stress intensity = true
end
subsection Output
  set Fields = none
  set Probes =
end
"""
PLATE = MESH.replace("mesh file\n  set Mesh file = full.msh", "edge crack").replace(
    "  set Fixed points = 0, -1; 0, 1: 1\n", "")
TENSION = [f"Boundary/Loaded={BOTTOM}, {TOP}",
           f"Loads/Traction={TOP}: 0; 10 | {BOTTOM}: 0; -10"]


def in_crack(crack, value="10"):
    return [f"Boundary/Loaded={crack}", f"Loads/Pressure={value}", "Loads/Traction="]


def last(results, column, table="crack_tip"):
    return results.table(f"{table}.csv")[column][-1]


def compare(name, scene, pressure, tension, table="crack_tip", columns=("K_I",),
            bound=1e-9):
    """Runs of a scene with two loads; they have the same K."""
    one, other = (run(scene, f"{name}_{of}", settings) for of, settings in (
        ("pressure", pressure), ("tension", tension)))
    for column in columns:
        mine, theirs = (results.table(f"{table}.csv")[column]
                        for results in (one, other))
        size = max(map(abs, theirs))
        check_below(max(abs(a - b) for a, b in zip(mine, theirs, strict=True)) / size,
                    bound, f"{name}, {column}")
    return one, other


def test_by_boundary():
    """By ids, by names, and by one formula for all."""
    square("full.msh")
    text = pathlib.Path("full.msh").read_text()
    names = f'$PhysicalNames\n3\n1 {BOTTOM} "bottom"\n1 {TOP} "the top"\n1 {CRACK} "gap"\n'
    pathlib.Path("named.msh").write_text(text.replace(
        "$Nodes", names + "$EndPhysicalNames\n$Nodes", 1))
    K = [last(run(MESH, "by_boundary", settings), "K_I", "crack_tip_1") for settings in (
        [*TENSION, f"Boundary/Crack={CRACK}"],
        [f"Boundary/Crack={CRACK}", TENSION[0],
         "Loads/Traction=0; y > 0 || y*y < -1 ? 10 : -10"],
        ["Geometry/Mesh file=named.msh", "Boundary/Crack=gap",
         "Boundary/Loaded=the top, bottom",
         "Loads/Traction=the top: 0; 10 | bottom: 0; -10"],
        ["Geometry/Mesh file=named.msh", "Boundary/Open crack=gap",
         "Boundary/Loaded=the top, bottom, gap", "Loads/Pressure=the top, bottom: -10"])]
    for other in K[1:]:
        check_below(abs(other / K[0] - 1), 1e-12, "K_I by boundary")


def test_two_lips():
    """An open crack, and one that may close but does not."""
    square("full.msh")
    for degree in (1, 2):
        settings = [f"Discretisation/Degree={degree}"]
        for role in ("Crack", "Open crack"):
            crack = [*settings, f"Boundary/{role}={CRACK}"]
            one, other = compare(f"two_lips_{degree}", MESH, crack + in_crack(CRACK),
                                 crack + TENSION, "crack_tip_1", ("K_I",))
            check_below(abs(last(one, "T_stress", "crack_tip_1")
                            - last(other, "T_stress", "crack_tip_1") - 10), 1e-2, "T")
            if role == "Open crack":
                check(not one.summary["effects"]["contact"]["on"], "contact is on")


def test_one_lip():
    """The built-in edge crack; a lip that may close, one that is not in contact, and a
    viscous body; singular functions, in elongated cells and with hanging nodes."""
    for number in (0, 2):
        for more in ([], ["Boundary/Contact=none"],
                     ["Material/Viscosity=isotropic", "Material/Viscous modulus=1e5",
                      "Loads/Period=10", "Time integration/Steps per period=8",
                      "Periodic state/Maximum periods=1", "Periodic state/Tolerance=0"],
                     ["Refinement/Strategy=tip", "Refinement/Cycles=2"]):
            common = [f"Discretisation/Singular functions={number}", *more]
            compare(f"one_lip_{number}", PLATE, common + in_crack(4),
                    [*common, "Loads/Traction=0; 10"])


def test_inclined():
    """A plate that is turned by 17 degrees."""
    square("turned.msh", degrees=17)
    x, y = turned(17)((0.5, 0))
    crack = ["Geometry/Mesh file=turned.msh", f"Boundary/Crack={CRACK}",
             f"Boundary/Fixed points={x!r}, {y!r}; 0, 0: 2"]
    compare("inclined", MESH, crack + in_crack(CRACK),
            [*crack, TENSION[0], f"Loads/Pressure={BOTTOM}, {TOP}: -10"], "crack_tip_1")


def test_penny():
    """Of radius a in a wide cylinder, under pressure for r < b."""
    penny = ["Geometry/Shape=centre crack", "Material/Plane state=axisymmetric",
             "Boundary/Open crack=4", "Boundary/Contact=none", "Geometry/Width=20",
             "Geometry/Height=20", "Geometry/Subdivisions=40, 40",
             "Refinement/Strategy=tip", "Refinement/Cycles=4",
             "Geometry/Crack length=2"]
    compare("penny", PLATE, penny + in_crack(4), [*penny, "Loads/Traction=0; 10"])
    K = last(run(PLATE, "penny_part", penny + in_crack(4, "if(x<1,10,0)")), "K_I")
    exact = 20 * math.sqrt(2 / math.pi) * (1 - math.sqrt(0.75))
    check_below(abs(K / exact - 1), 5e-3, "a penny crack partly under pressure")


def test_space():
    """A crack of a block, with one lip and with two."""
    for name, role, axes, supports in (
            ("half", "Contact", (steps(0, 1, 8), steps(0, 1, 6), steps(0, 0.5, 3)),
             f"Boundary/Symmetry={BOTTOM}"),
            ("full", "Open crack", (steps(0, 1, 8), steps(-1, 1, 12), steps(0, 0.5, 3)),
             "Boundary/Symmetry=none")):
        write_block("block.msh", axes, at_edge)
        settings = ["Geometry/Mesh file=block.msh", "Dimension=3", supports,
                    f"Boundary/{role}={CRACK}", "Discretisation/Degree=1"]
        settings.append("Boundary/Fixed points=0, 0, 0; 0, 0, 0.5: 1"
                        + ("" if name == "half" else ", 2; 0, 1, 0: 1; 0, 1, 0.5: 1"))
        tension = ([f"Boundary/Loaded={TOP}", "Loads/Traction=0; 10; 0"]
                   if name == "half" else
                   [f"Boundary/Loaded={BOTTOM}, {TOP}",
                    f"Loads/Traction={TOP}: 0; 10; 0 | {BOTTOM}: 0; -10; 0"])
        compare(f"space_{name}", MESH, settings + in_crack(CRACK), settings + tension,
                "crack_front")


def test_part_of_crack():
    """A centre crack in a wide plate under pressure for |x| < b."""
    a, b = 1., 0.5
    scene = [f"Geometry/Crack length={a}", "Geometry/Shape=centre crack",
             "Geometry/Width=40", "Geometry/Height=40", "Geometry/Subdivisions=80, 80",
             "Boundary/Open crack=4", "Boundary/Contact=none",
             "Discretisation/Degree=2", "Refinement/Strategy=tip",
             "Refinement/Cycles=3",
             *in_crack(4, f"if(x<{b},10,0)")]
    K = last(run(PLATE, "part", scene), "K_I")
    check_below(abs(K / (20 * math.sqrt(a / math.pi) * math.asin(b / a)) - 1), 5e-3,
                "a crack partly under pressure (Tada, Paris, Irwin)")


@full
def test_closes_elsewhere():
    """A long crack in a compressed plate is open for |x| < c, c = b/sin(pi s/2p), and
    its opening at the end b of the pressure p is that of Dugdale's strip."""
    p, s, b, E = 20., 10., 1., 13000.
    c = b / math.sin(math.pi * s / (2 * p))
    results = run(PLATE, "closes", [
        "Geometry/Shape=centre crack", "Geometry/Width=30", "Geometry/Height=30",
        "Geometry/Crack length=4", "Geometry/Subdivisions=150, 60",
        "Discretisation/Degree=2",
        "Boundary/Loaded=3, 4", f"Loads/Traction=3: 0; {-s}",
        f"Loads/Pressure=4: if(x<{b},{p},0)", f"Output/Probes=end: {b}, 0; far: 3, 0"])
    opening = last(results, "opening", "probe_end")
    exact = 4 * p * b / (math.pi * E) * math.log(c / b)
    check_below(abs(opening / exact - 1), 2e-2, "opening at the end of the pressure")
    check_below(abs(last(results, "pressure", "probe_far") / s - 1), 0.1,
                "pressure of contact far from the open part")


def test_ranks():
    """Two processes compute what one does."""
    square("full.msh")
    pathlib.Path("ranks.prm").write_text(plain(MESH))
    settings = [f"Boundary/Open crack={CRACK}", *in_crack(CRACK)]
    one, two = run("ranks.prm", "one", settings), run_on(2, "ranks.prm", "two", settings)
    for column in ("K_I", "T_stress"):
        check_below(abs(last(two, column, "crack_tip_1")
                        / last(one, column, "crack_tip_1") - 1), 1e-9, column)


def test_refused():
    """With the parameter and what to do, before meshes are adapted."""
    adaptive = ["Refinement/Strategy=adaptive", "Refinement/Target unknowns=3000"]
    for settings, expected in (
            (["Loads/Traction=3: 0; 1 | 1: 0; 1"], "boundary id 1 must have the role Loaded"),
            (["Loads/Traction=3: 0; 1 | 3: 0; 1"], "one value only"),
            (["Loads/Traction=3: 0; 1 | 0; 1"], "must begin with its boundaries"),
            (["Loads/Traction=top: 0; 1"], "names of boundaries need a mesh file"),
            (["Loads/Traction=3: 1"], "must be 2 formulas"),
            (["Loads/Pressure=1; 2"], "must be one formula"),
            (["Boundary/Loaded=4", "Loads/Pressure=1", "Crack tip/Method=williams fit"],
             "lips without load"),
            (["Boundary/Contact=4", "Boundary/Open crack=4"], "must have one role only")):
        path = pathlib.Path("refused.prm")
        path.write_text(plain(PLATE))
        status, _, error = execute(path, "--check", *overrides(settings + adaptive))
        check(status == 2 and expected in error, f"{settings}: {status} {error}")


test_by_boundary()
test_two_lips()
test_one_lip()
test_inclined()
test_penny()
test_space()
test_part_of_crack()
test_closes_elsewhere()
test_ranks()
test_refused()
