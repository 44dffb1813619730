"""Cracks in bodies of revolution that do not lie across the axis: cylinders, cones
and caps, with K_I, K_II and T by the derivative of the energy, by published values, by
the half model, uniform stress and the plane, and by what must not change them."""

import math
import pathlib

import cracked
from crevasse_run import (check, check_below, check_close, execute, full, plain, run,
                          run_on)

SCENE = """
subsection Geometry
  set Shape     = mesh file
  set Mesh file = {mesh}
end
subsection Boundary
  set Crack        = 7
  set Symmetry     = none
  set Fixed points = {support}: 2
  set Loaded       = 1, 2, 3, 4
end
subsection Material
  set Plane state   = axisymmetric
  set Young modulus = 13000
  set Poisson ratio = 0.3
  set Viscosity     = none
end
subsection Discretisation
  set Degree = 2
end
subsection Refinement
  set Strategy = tip
  set Cycles   = 10
end
subsection Time integration
  set Steps per period = 2
end
subsection Periodic state
  set Maximum periods = 1
end
subsection Crack tip
  set Stress intensity = true
end
subsection Output
  set Fields = none
end
"""

LINES = [-6, -4, -2.75, -2, -1.5, -1, -0.5, 0, 0.5, 1, 1.5, 2, 2.75, 4, 6]


def scene(name, radius=8., degrees=40., length=1., size=1.):
    """A ring with a square section of 12 x 12 about this radius, and in its middle
    a crack of half the length 1 that makes this angle with the radius: an angle of 90
    degrees is a cylinder. Squares around it are turned less and less from 2 to 6. The
    length is that to the end at X = 1; all is multiplied by a size."""
    lines = [length if x == 1 else x for x in LINES]

    def place(point):
        x, y = point
        part = math.log(6 / max(abs(x), abs(y), 2)) / math.log(3) if degrees < 90 else 1.
        c, s = (f(math.radians(degrees) * part) for f in (math.cos, math.sin))
        return size * (radius + c * x - s * y), size * (s * x + c * y)
    cracked.write_block(f"{name}.msh", (lines, LINES), lambda middle, normal: (
        normal == 1 and middle[1] == 0 and -1 < middle[0] < length), place)
    return SCENE.format(mesh=f"{name}.msh",
                        support=f"{size * (radius + 6)!r}, {size * -6!r}")


def pull(radius=8., radial="1", axial="2", size=1.):
    """A radial traction inside and outside and an axial one below and above."""
    end = 5.999 * size
    return (f"Loads/Traction=if(abs(y) > {end!r}, 0, if(x > {radius * size!r}, 1, -1)*"
            f"({radial})); if(abs(y) > {end!r}, if(y > 0, 1, -1)*({axial}), 0)")


def tips(results):
    """The last rows of both tips, that at X = 1 first."""
    found = [{key: column[-1] for key, column in
              results.table(f"crack_tip_{i}.csv").items()} for i in (1, 2)]
    for row, tip in zip(found, results.summary["crack_tips"], strict=True):
        row["position"], row["direction"] = tip["position"], tip["direction"]
    return sorted(found, key=lambda row: -sum(row["direction"]))


LOADS = {
    "tension": [pull()],
    "pressure": ["Loads/Traction=0; 0", "Loads/Pressure=1", "Boundary/Loaded=7"],
    "heated": ["Material/Thermal expansion=1e-5", "Loads/Traction=0; 0",
               "Loads/Temperature=100*y*(x - 8 + y)"]}


@full
def test_release_rates():
    """G of one radian is the change of the energy, half the work of the loads."""
    wave = "(1 - cos(2*pi*t))/2"
    for degrees in (0., 40., 90.):
        for load in ("tension", "pressure"):
            settings = ["Output/Load work=true", "Loads/Period=1", *LOADS[load],
                        "Geometry/Refinements=2", "Refinement/Cycles=8"]
            if load == "pressure":
                settings.append(f"Loads/Pressure={wave}")
            else:
                settings.append(pull(radial=wave, axial="2*" + wave))
            U, rates = [], []
            for length in (0.99, 1, 1.01):
                results = run(scene("length", degrees=degrees, length=length), "length",
                              settings)
                U.append(results.table("load_work.csv")["load_work"][1])
                rates.append(max(  # of the tip at X = 1
                    (sum(tip["direction"]), table["energy_release_rate"][1]
                     * tip["position"][0]) for table, tip in zip(
                         (results.table(f"crack_tip_{i}.csv") for i in (1, 2)),
                         results.summary["crack_tips"], strict=True))[1])
            check_close(rates[1] / (U[2] - U[0]) * 0.04, 1, 1e-3,
                        f"G at {degrees} degrees, {load}, over the change of the energy")


@full
def test_heat():
    """A temperature strains as a pressure p does on all boundaries with the gradient of
    p as a body force, p = -E alpha theta / (1 - 2 nu)."""
    p = 13000 * 1e-5 / 0.4 * 100
    heated, pressed = (tips(run(scene("heat"), "heat", settings)) for settings in (
        LOADS["heated"], [
            "Loads/Traction=0; 0", "Boundary/Loaded=1, 2, 3, 4, 7",
            f"Loads/Pressure=-{p!r}*y*(x - 8 + y)",
            f"Loads/Body force=-{p!r}*y; -{p!r}*(x - 8 + 2*y)"]))
    for a, b in zip(heated, pressed):
        for K in ("K_I", "K_II"):
            check_close(a[K] / b["K_I"], b[K] / b["K_I"], 2e-4, f"{K} by heat")


def test_uniform_stress():
    """A stress along the lips has no K, and T is this stress, though its hoop strain
    is not that of plane strain."""
    for name, degrees, radial, axial in (("cylinder", 90., 0., 2.),
                                         ("disc", 0., 2., 0.)):
        for tip in tips(run(scene("uniform", degrees=degrees), "uniform",
                            [pull(radial=repr(radial), axial=repr(axial)),
                             "Refinement/Cycles=1"])):
            check_close(tip["T_stress"] / 2, 1, 1e-3, f"T, {name}")
            for K in ("K_I", "K_II"):
                check_below(abs(tip[K]), 1e-6, f"{K}, {name}")


@full
def test_plane():
    """Far from the axis a cone is a plate in plane strain, with a difference in
    proportion to the curvature."""
    plane = tips(run(scene("plane", 1000.), "plane", [
        pull(1000.), "Material/Plane state=plane strain",
        "Boundary/Fixed points=1006, -6: 2; 994, -6: 1, 2"]))
    for radius, allowed in ((1e4, 2e-3), (1e5, 2e-4)):
        ring = tips(run(scene("far", radius), "far", [pull(radius)]))
        for one, other in zip(ring, plane):
            for name in ("K_I", "K_II"):
                check_close(one[name] / plane[0]["K_I"], other[name] / plane[0]["K_I"],
                            allowed, f"{name} at the radius {radius:g}")


@full
def test_radii():
    for degrees in (40., 90.):
        for load in LOADS:
            one, other = (tips(run(scene("radii", degrees=degrees), "radii", [
                *LOADS[load], *more])) for more in ([], ["Crack tip/Radius=0.25"]))
            size = max(abs(tip[K]) for tip in one for K in ("K_I", "K_II"))
            for a, b in zip(one, other):
                for K in ("K_I", "K_II"):
                    check_below(abs(a[K] - b[K]) / size,
                                (a[K + "_error"] + b[K + "_error"]) / size,
                                f"{K}, {load}: two radii, and the printed errors")
                check_close(a["T_stress"] / size, b["T_stress"] / size, 1e-2, "T")


def test_invariances():
    """Other units, and two processes."""
    expected = tips(run(scene("as_it_is"), "as_it_is", [pull()]))
    large = tips(run(scene("large", size=1e3), "large", [
        pull(size=1e3, radial="1e-6", axial="2e-6"), "Material/Young modulus=0.013"]))
    shared = tips(run_on(2, "as_it_is.prm", "shared", [pull()]))
    for a, b, c in zip(expected, large, shared, strict=True):
        for K in ("K_I", "K_II"):
            check_close(b[K] / math.sqrt(1e3) * 1e6 / a["K_I"], a[K] / a["K_I"], 1e-8,
                        f"{K} in other units")
            check_close(c[K] / a["K_I"], a[K] / a["K_I"], 1e-8, f"{K} on two processes")


@full
def test_creep():
    """With a viscosity in proportion to the stiffness K follows the load."""
    settings = ["Time integration/Steps per period=20", pull(
        radial="1 + sin(2*pi*t/600)", axial="2"), "Loads/Period=600",
        "Periodic state/Tolerance=0"]
    elastic = tips(run(scene("creeps"), "elastic", settings))
    crept = tips(run(scene("creeps"), "crept", [
        *settings, "Material/Viscosity=relaxation time", "Material/Relaxation time=60"]))
    for a, b in zip(elastic, crept):
        for K in ("K_I", "K_II"):
            check_close(b[K] / a["K_I"], a[K] / a["K_I"], 1e-4, f"{K} after creep")


PENNY_LINES = [0, 0.5, 1, 1.5, 2, 3, 5, 8, 12]


def test_half_model():
    """A penny-shaped crack drawn with both lips has the K_I of the half model; in a
    temperature, too."""
    lines = PENNY_LINES[:1] + [x for x in PENNY_LINES if x > 0]
    heights = [-y for y in lines[:0:-1]] + lines
    is_crack = (lambda middle, normal: normal == 1 and middle[1] == 0
                and middle[0] < 1)
    cracked.write_block("both.msh", (lines, heights), is_crack)
    cracked.write_block("half.msh", (lines, lines), is_crack)
    both = SCENE.format(mesh="both.msh", support="12, -12")
    half = both.replace("both.msh", "half.msh").replace(
        "Crack        = 7", "Contact = 7").replace("= none", "= 3", 1).replace(
        "12, -12: 2", "none")
    for load in (["Loads/Traction=0; if(abs(y) > 11.99, if(y > 0, 1, -1), 0)"], [
            "Loads/Traction=0; 0", "Material/Thermal expansion=1e-5",
            "Loads/Temperature=-100*exp(-x^2 - y^2)"]):
        one = run(half, "half", ["Boundary/Loaded=4", *load]).table("crack_tip.csv")
        two = run(both, "both", load).table("crack_tip_1.csv")
        check(one["K_I"][-1] > 1e-3, "an open crack")
        check_close(two["K_I"][-1] / one["K_I"][-1], 1, 1e-7, "K_I of both lips")
        check_below(abs(two["K_II"][-1] / two["K_I"][-1]), 1e-7, "K_II")


@full
def test_cooled_penny():
    """A penny-shaped crack of which the lips are kept at another temperature than the
    body far away (Olesiak and Sneddon, 1959; Murakami's handbook, 11.39): K_I =
    E alpha |theta| sqrt(a/pi) / (1 - nu) in an infinite body, extrapolated from two."""
    K = []
    for size in (20, 40):
        K.append(run(SCENE.format(mesh="none", support="none").replace(
            "mesh file", "centre crack").replace("  set Mesh file = none\n", ""),
            f"cooled_{size}", [
                f"Geometry/Width={size}", f"Geometry/Height={size}",
                "Geometry/Crack length=1", f"Geometry/Subdivisions={2 * size}, {2 * size}",
                "Boundary/Crack=none", "Boundary/Symmetry=automatic",
                "Boundary/Loaded=automatic", "Boundary/Fixed points=none",
                "Material/Thermal expansion=1e-5", "Loads/Temperature="
                "-2/pi*asin(2/(sqrt((x-1)^2+y^2)+sqrt((x+1)^2+y^2)))"]).table(
                    "crack_tip.csv")["K_I"][-1])
    exact = 13000 * 1e-5 / 0.7 / math.sqrt(math.pi)
    check_close((2 * K[1] - K[0]) / exact, 1, 3e-3,
                f"K of cooled lips; {K[0] / exact:.4f} and {K[1] / exact:.4f} in bodies of "
                "20 and 40 radii")


CAP = """
R = 1; L = 5; al = 45*Pi/180;
Point(1) = {0,-L,0,1}; Point(2) = {L,-L,0,1};
Point(3) = {L,L,0,1}; Point(4) = {0,L,0,1};
Point(9) = {0,0,0,1}; Point(5) = {0,R,0,0.1};
Point(6) = {R*Sin(al),R*Cos(al),0,0.1};
Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,4}; Line(4) = {4,5};
Line(6) = {5,1}; Circle(5) = {5,9,6};
Curve Loop(1) = {1,2,3,4,6}; Plane Surface(1) = {1}; Curve{5} In Surface{1};
Physical Curve("outside", 3) = {1,2,3}; Physical Curve("axis", 4) = {4,6};
Physical Curve("cap", 7) = {5}; Physical Surface("body", 11) = {1};
Mesh.RecombineAll = 1; Mesh.SubdivisionAlgorithm = 1;
Mesh.ElementOrder = 2;
"""


def cap(name, settings=(), angle=45.):
    pathlib.Path("cap.geo").write_text(CAP.replace("al = 45", f"al = {angle!r}"))
    return run(SCENE.format(mesh="cap.geo", support="5, -5"), name, [
        "Boundary/Loaded=outside", "Loads/Traction=if(x > 4.9999, 1, 0); "
        "if(abs(y) > 4.9999, if(y > 0, 1, -1), 0)", "Material/Poisson ratio=0.22",
        "Refinement/Cycles=4", *settings])


def row_of(results):
    return {key: column[-1] for key, column in results.table("crack_tip_1.csv").items()}


@full
def test_cap():
    """A crack along a cap of a sphere under tension in all directions: what must not
    change it. T does not depend on the support, and the mesh finds it."""
    tip = row_of(cap("cap"))
    unit = math.sqrt(math.sin(math.pi / 4))
    for name, settings in (("radius", ["Crack tip/Radius=0.15"]), ("graded", [
            "Boundary/Fixed points=5, 5: 2", "Refinement/Cycles=8"])):
        other = row_of(cap(f"cap_{name}", settings))
        for K in ("K_I", "K_II"):
            check_below(abs(tip[K] - other[K]) / unit,
                        (tip[K + "_error"] + other[K + "_error"]) / unit,
                        f"{K} and the printed errors, {name}")
        check_close(other["T_stress"], tip["T_stress"], 2e-2, f"T, {name}")
    inside = row_of(cap("cap_inside", [
        "Boundary/Loaded=cap", "Loads/Traction=0; 0", "Loads/Pressure=1"]))
    for K in ("K_I", "K_II"):
        check_close(inside[K] / unit, tip[K] / unit, 5e-4, f"{K} of a pressure in it")


@full
def test_release_rate_of_cap():
    """By caps of other angles, on other meshes."""
    more = ["Output/Load work=true", "Geometry/Refinements=1", "Refinement/Cycles=7"]
    U = {}
    for angle in (42., 43.5, 45., 46.5, 48.):
        results = cap("cap_angle", more, angle)
        U[angle] = results.table("load_work.csv")["load_work"][-1] / 2
        if angle == 45.:
            G = row_of(results)["energy_release_rate"]
    slopes = [(U[45 + d] - U[45 - d]) / math.radians(2 * d) for d in (3., 1.5)]
    check_close((4 * slopes[1] - slopes[0]) / 3 / (G * math.sin(math.pi / 4)), 1, 7e-3,
                "change of the energy with the angle over G")


CREEP = """
subsection Geometry
  set Shape = edge crack
  set Subdivisions = 20, 20
end
subsection Refinement
  set Strategy = tip
  set Cycles = 4
end
subsection Material
  set Plane state = axisymmetric
  set Young modulus = 1000
  set Poisson ratio = 0.3
  set Viscosity = power law
  set Creep exponent = 3
  set Creep coefficient = 2e-3
end
""" + cracked.STEADY_CREEP


def power(results):
    table = results.table("load_work.csv")
    t, work = table["t"], table["load_work"]
    return (work[-1] - work[-2]) / (t[-1] - t[-2])


def test_notched_bar():
    """C* of a bar with a crack around it, by the loads' power; early C(t), which has
    elastic rates, depends on the square by what few cells leave."""
    shorter, here, longer, small = (
        run(CREEP, f"notched_{a}_{len(more)}", [f"Geometry/Crack length={a}", *more])
        for a, more in ((0.495, []), (0.5, []), (0.505, []),
                        (0.5, ["Crack tip/Radius=0.1"])))
    C, other = (results.table("creep_integral.csv")["C_t"] for results in (here, small))
    expected = 2 / 4 * (power(longer) - power(shorter)) / 0.01 / 0.5
    check_close(C[-1] / expected, 1, 5e-3, "C* over that of the power")
    check_below(max(abs(a / b - 1) for a, b in zip(C, other, strict=True)), 2e-2,
                "squares of 0.5 and 0.1")


@full
def test_creeping_penny():
    """He and Hutchinson, J. Appl. Mech. 48, 1981: J = (6/pi) sigma epsilon a /
    sqrt(1 + 3/n), of some per cent."""
    for n in (1, 3):
        results = run(CREEP, "creeping_penny", [
            "Geometry/Shape=centre crack", "Geometry/Width=8", "Geometry/Height=8",
            "Geometry/Crack length=1", "Geometry/Subdivisions=64, 64",
            f"Material/Creep exponent={n}", "Loads/Period=40",
            "Time integration/Steps=0.1, 0.3, 1, 2, 4, 8, 14, 20, 26, 32, 36, 38"])
        exact = 6 / math.pi * 2e-3 / math.sqrt(1 + 3 / n)
        check_close(results.table("creep_integral.csv")["C_t"][-1] / exact, 1, 0.03,
                    f"C* of a penny-shaped crack, n = {n}")


@full
def test_creeping_cone():
    """C* of both tips by the power, of the tip that moves."""
    creep = [line for line in (
        pull(), "Material/Viscosity=power law", "Material/Creep exponent=3",
        "Material/Creep coefficient=1e-4", "Crack tip/Stress intensity=false",
        "Crack tip/Creep integral=true", "Output/Load work=true", "Loads/Period=40",
        "Periodic state/Tolerance=0", "Geometry/Refinements=2",
        "Time integration/Scheme=sdirk2", "Time integration/Step control=list",
        "Time integration/Steps=0.1, 0.3, 1, 2, 4, 8, 14, 20, 26, 32, 36, 38")]
    shorter, here, longer = (run(scene("cone", length=length), f"cone_{length}", creep)
                             for length in (0.98, 1, 1.02))
    ends = here.summary["creep_integrals"]
    i = max((0, 1), key=lambda i: sum(ends[i]["direction"]))
    expected = (power(longer) - power(shorter)) / 4 / 0.04 / ends[i]["position"][0]
    check_close(ends[i]["last"] / expected, 1, 5e-3, "C* of a conical crack")


def test_refusals():
    """Only a plane across the axis is a plane of symmetry."""
    cracked.write_block("refused.msh", ([8, 9, 10], LINES), lambda middle, normal: (
        normal == 0 and middle[0] == 8 and middle[1] < 1))
    pathlib.Path("refused.prm").write_text(plain(SCENE.format(
        mesh="refused.msh", support="10, -6").replace("Crack        = 7", "Contact = 7")
        .replace("= none", "= 1", 1).replace("1, 2, 3, 4", "2, 3, 4")))
    status, _, error = execute("refused.prm", "--check", "--set",
                               "Refinement/Strategy=none")
    print(status, error)
    check(status == 2 and "has one lip" in error, "a crack with one lip")


TESTS = [test_release_rates, test_heat, test_uniform_stress, test_plane, test_radii,
         test_invariances, test_creep, test_half_model, test_cooled_penny, test_cap,
         test_release_rate_of_cap, test_notched_bar, test_creeping_penny,
         test_creeping_cone, test_refusals]

if __name__ == "__main__":
    for test in TESTS:
        test()
