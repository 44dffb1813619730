"""C(t) along crack fronts in space: of a slab against the plane and against energies of
neighbouring crack lengths, of a penny-shaped crack against the ring, and what must not
change it."""

import math
import sys

from cracked import (BACK, BOTTOM, CRACK, FRONT, STEADY_CREEP, TOP, steps, write_block)
from crevasse_run import (SOURCE, check, check_below, check_close, execute, full,
                          overrides, plain, run, run_on, tier)
from fronts import penny_mesh

from crevasse import run_page

sys.path.insert(0, str(SOURCE / "prm"))
import penny_mesh as penny  # noqa: E402: where it is, is known now

A = 2e-3
BODY = f"""
subsection Material
  set Young modulus = 1000
  set Poisson ratio = 0.3
  set Viscosity = power law
  set Creep exponent = 3
  set Creep coefficient = {A}
end
""" + STEADY_CREEP
SLAB = """\
set Dimension = 3
subsection Geometry
  set Shape = edge crack
  set Thickness = 0.5
  set Subdivisions = 8, 8, 2
end
subsection Boundary
  set Symmetry = 2, 5, 6
end
""" + BODY.replace("0; 1\n", "0; 1; 0\n")
PLANE = SLAB.replace("Dimension = 3", "Dimension = 2").replace(
    "8, 8, 2", "8, 8").replace("2, 5, 6", "automatic").replace(
    "0; 1; 0", "0; 1").replace("set Young", "set Plane state = plane strain\n  set Young")
MESH = """\
set Dimension = {dimension}
subsection Geometry
  set Shape = mesh file
  set Mesh file = {name}.msh
end
subsection Boundary
  set Symmetry = {symmetry}
  set Contact = {crack}
  set Loaded = {loaded}
  set Fixed points = {fixed}
end
"""


def along_front(results, column="C_t"):
    """Lists of the values along the front by instant."""
    table = results.table("crack_front.csv")
    return {t: [value for other, value in zip(table["t"], table[column]) if other == t]
            for t in sorted(set(table["t"]))}


def worst_difference(C, expected):
    """Largest relative difference at an instant."""
    check(len(C) == len(expected) > 5, f"{len(C)} and {len(expected)} instants")
    return max(abs(value / other - 1)
               for values, others in zip(C.values(), expected, strict=True)
               for value, other in zip(values, others, strict=True))


def test_slab():
    """On the plane's mesh, extruded, C(t) is the plane's: from the first steps, when it
    falls like 1/t, to steady creep."""
    radius = ["Crack tip/Radius=0.5"]
    plane = run(PLANE, "plane", radius).table("creep_integral.csv")
    slab = run(SLAB, "slab", radius)
    C = along_front(slab)
    check_below(worst_difference(C, [3 * [value] for value in plane["C_t"]]), 1e-7,
                "C(t) of a slab over that of the plane")
    check_close(along_front(slab, "C_t_error")[4.][0] / plane["C_t_error"][-1], 1, 1e-4,
                "its estimated error")
    check(plane["C_t"][1] > 1.4 * plane["C_t"][-1], "it falls")
    front = slab.summary["creep_integrals"][0]
    check(front["vertices"] == 3 and front["last"] == max(C[4.])
          and front["largest"] >= max(map(max, C.values())), f"in the summary: {front}")
    page, *_, damages = run_page.page(slab.directory)
    for words in ("Creep integral C(t) along the crack front", "Creep at the crack"):
        check(words in page and not damages, f"{words} in the report: {damages}")


def graded(first, ratio, end):
    """Distances from 0 to an end that begin at about the first and grow."""
    n = round(math.log(1 + end / first * (ratio - 1), ratio))
    return [end * (ratio ** i - 1) / (ratio ** n - 1) for i in range(n + 1)]


def slab(name, a=0.5, depth=(0, 0.25, 0.5), free=False, place=lambda *point: point,
         material=lambda middle: 1):
    """A slab with the crack x < a, moved; its front is in plane strain, or ends at a
    free face."""
    axes = [[a - x for x in graded(0.02, 1.4, a)[:0:-1]]
            + [a + x for x in graded(0.02, 1.4, 1 - a)],
            graded(0.02, 1.4, 1.), list(depth)]
    write_block(f"{name}.msh", axes,
                lambda middle, normal: normal == 1 and middle[1] == 0 and middle[0] < a,
                lambda point: place(*point), material)
    force = place(0, 1, 0)
    fixed = ", ".join(map(str, place(1, 0, 0)))
    axis = 1 + [abs(x) for x in place(1, 0, 0)].index(1)
    scene = MESH.format(dimension=3, name=name, crack=CRACK, loaded=TOP,
                        symmetry=f"{BOTTOM}, {FRONT}" + ("" if free else f", {BACK}"),
                        fixed=f"{fixed}: {axis}")
    return scene + BODY.replace("0; 1\n", "; ".join(map(str, force)) + "\n")


WITHOUT_LOCKING = ["Discretisation/Degree=1", "Discretisation/Volumetric strain=mean",
                   "Crack tip/Radius=0.49"]


def potential(results, n):
    """Of both halves, which the crack's length changes by the integral of C* along the
    front: the power of the loads over n + 1."""
    table = results.table("load_work.csv")
    t, work = table["t"], table["load_work"]
    return 2 / (n + 1) * (work[-1] - work[-2]) / (t[-1] - t[-2])


def mean_along(results, column="C_t"):
    """Integral of C along the front at the end, by the trapezoidal rule."""
    table = results.table("crack_front.csv")
    C = along_front(results, column)[table["t"][-1]]
    s = table["s"][-len(C):]
    return sum((b - a) * (p + q) / 2 for a, b, p, q in zip(s, s[1:], C, C[1:]))


@full
def test_energies_of_crack_lengths():
    """Of a slab in plane strain, and of one with a free face, where C varies, but does
    not depend on the tube."""
    for name, more in (("strain", {}), ("free", {
            "depth": [0.5 - x for x in graded(0.02, 1.6, 0.5)[::-1]], "free": True})):
        shorter, here, longer = (run(slab(f"{name}_{a}", a, **more), f"{name}_{a}",
                                     WITHOUT_LOCKING)
                                 for a in (0.495, 0.5, 0.505))
        expected = (potential(longer, 3) - potential(shorter, 3)) / 0.01
        C = along_front(here)[4.]
        print(name, C)
        check_close(mean_along(here) / expected, 1, 3e-3,
                    f"C* over that of the energies, {name}")
    check(min(C) < 0.3 * max(C), "C* varies along the front")
    # The last vertex is on the free face, where C is extrapolated.
    wide, narrow = ({t: C[:-1] for t, C in along_front(results).items()}
                    for results in (here, run(slab("free_0.5", 0.5, **more), "narrow", [
                        *WITHOUT_LOCKING[:-1], "Crack tip/Radius=0.15"])))
    check_below(worst_difference(wide, narrow.values()), 3e-2,
                "tubes of 0.49 and 0.15 at each vertex and instant")


@full
def test_invariance():
    """Turned by 90 degrees about each axis, on two processes, and in other units."""
    more = {"depth": steps(0, 0.5, 3), "free": True}
    here = along_front(run(slab("here", **more), "here", WITHOUT_LOCKING))
    turns = {"z": lambda x, y, z: (-y, x, z), "y": lambda x, y, z: (z, y, -x),
             "x": lambda x, y, z: (x, -z, y)}
    for axis, place in turns.items():
        other = run(slab(f"about_{axis}", place=place, **more), f"about_{axis}",
                    WITHOUT_LOCKING)
        C = along_front(other)
        if (C[4.][0] > C[4.][-1]) != (here[4.][0] > here[4.][-1]):
            C = {t: values[::-1] for t, values in C.items()}  # s grows the other way
        check_below(worst_difference(C, here.values()), 1e-9, f"turned about {axis}")
    shared = along_front(run_on(2, "here.prm", "shared", WITHOUT_LOCKING))
    check_below(worst_difference(shared, here.values()), 1e-9, "on two processes")
    units = along_front(run(slab("here", **more), "units", [
        *WITHOUT_LOCKING, "Loads/Traction=0; 1e6; 0", "Material/Young modulus=1e9",
        "Material/Creep coefficient=2e-21"]))
    check_below(worst_difference(
        {t: [1e-6 * value for value in values] for t, values in units.items()},
        here.values()), 1e-9, "in other units")


TAU = 5.
# A Maxwell body, whose stress stays elastic, so that it flows at once.
MAXWELL = ["Material/Viscosity=relaxation time", f"Material/Relaxation time={TAU}",
           "Time integration/Step control=uniform", "Time integration/Steps per period=4",
           "Periodic state/Method=march", "Crack tip/Creep integral=false",
           "Crack tip/Stress intensity=true"]


def c_star_along(results):
    """C* at the vertices, which is energy_release_rate over the relaxation time."""
    C, G = ([*along_front(results, column).values()][-1]
            for column in ("C_star", "energy_release_rate"))
    check_below(max(abs(c * TAU / g - 1) for c, g in zip(C, G, strict=True)), 1e-9,
                "C* = G/tau")
    return C


def test_c_star_of_slab():
    """C* of linear creep is that of the plane with the same cells; nothing flows
    without a mean load."""
    settings = [*MAXWELL, "Crack tip/Radius=0.5"]
    plane = run(PLANE, "linear_plane", settings).summary["crack_tip"]["C_star"]
    slab = run(SLAB, "linear_slab", settings)
    C = c_star_along(slab)
    front = slab.summary["crack_front"]
    print("C*:", C, "in the plane:", plane, "in the summary:", front["C_star"])
    check_below(max(abs(value / plane - 1) for value in C), 3e-4, "C* of a slab")
    for end, value in (("largest", max(C)), ("smallest", min(C))):
        check(front["C_star"][end]["value"] == value, f"{end} in the summary")
    check_below(front["C_star_error"] / plane, 1e-2, "its estimated error")
    page, _, _, damages = run_page.page(slab.directory)
    check("largest C*" in page and not damages, f"C* in the report: {damages}")
    settings += ["Geometry/Subdivisions=8, 4, 1", "Discretisation/Degree=1"]
    half_closed = ["Loads/Traction=0; 13 - 20*x"]
    plane = run(PLANE, "linear_half_closed_plane", [
        *settings, *half_closed, "Geometry/Subdivisions=8, 4"]).summary["crack_tip"]["C_star"]
    C = c_star_along(run(SLAB, "linear_half_closed", [*settings, half_closed[0] + "; 0"]))
    print("half closed: C*:", C, "in the plane:", plane)
    check_below(max(abs(value / plane - 1) for value in C), 1e-2, "C* of a lip half closed")
    swings = run(SLAB, "linear_swings", [*settings, "Loads/Traction=0; sin(pi*t/2); 0"])
    check(swings.summary["crack_front"]["C_star"]["largest"]["value"] == 0.,
          "no C* without a mean load")
    refused = [("factor", ["Material/Viscosity time factor=1 + 0.5*sin(pi*t/2)"],
                "varies in time"),
               ("force", ["Loads/Body force=0; 1; 0"], "body force"),
               ("elastic", ["Material/Viscosity=none"], "viscosity")]
    for name, more, words in tier(refused[:1], refused):
        results = run(SLAB, f"linear_{name}", [*settings, *more])
        front = results.summary["crack_front"]
        check(front["C_star"] is None and words in front["no_C_star"],
              f"no C*: {front['no_C_star']}")
        check("C_star" not in results.table("crack_front.csv"), "no column")


@full
def test_c_star_of_crack_lengths():
    """The integral of C* along a front in plane strain, and along one that ends at a free
    face, by the power; turned, on two processes, in other units, and of a viscosity with
    a factor of time."""
    depth = [0.5 - x for x in graded(0.02, 1.6, 0.5)[::-1]]
    settings = [*MAXWELL, "Crack tip/Radius=0.49"]
    for more, bound in (((), 3e-3), ((depth, True), 6e-3)):
        shorter, here, longer = (
            run(slab(f"linear_{a}", a, *more), f"linear_{a}", settings)
            for a in (0.495, 0.5, 0.505))
        C = c_star_along(here)
        expected = (potential(longer, 1) - potential(shorter, 1)) / 0.01
        print("C* along the front:", C)
        check_close(mean_along(here, "C_star") / expected, 1, bound,
                    "C* over that of the power")
    check(min(C) < 0.9 * max(C), "C* varies along the front")
    turned = c_star_along(run(slab("turned", 0.5, depth, True,
                                   lambda x, y, z: (z, y, -x)), "turned", settings))
    others = {
        "turned": turned[::-1] if (turned[0] > turned[-1]) != (C[0] > C[-1]) else turned,
        "on two processes": c_star_along(run_on(2, "linear_0.5.prm", "two", settings)),
        "in other units": [1e-6 * c for c in c_star_along(run(
            slab("units", 0.5, depth, True), "units", [
                *settings, "Loads/Traction=0; 1e6; 0", "Material/Young modulus=1e9"]))],
        "with a factor of time": c_star_along(run(slab("factor", 0.5, depth, True), "factor", [
            *settings, f"Material/Relaxation time={TAU / 4}",
            "Material/Viscosity time factor=4"]))}
    for name, values in others.items():
        check_below(max(abs(a / b - 1) for a, b in zip(values, C, strict=True)), 1e-9, name)


LONG = ["Loads/Period=40", "Time integration/Steps=0.1, 0.3, 1, 2, 4, 8, 14, 20, 26, 32, "
        "36, 38", "Crack tip/Radius=0.9"]


@full
def test_penny():
    """A penny-shaped crack in a block against the ring in a cylinder, of the same cells;
    both are 2 and 4 per cent below the estimate for infinite bodies of He and Hutchinson,
    J. Appl. Mech. 48, 1981, for which test_round_cracks.py has more cells."""
    cells, size, n_faces = 4, 0.05, 4
    mesh = penny_mesh("penny.msh", str(cells), str(size))
    columns = {round(place(2 * i, 0)[0], 9) for (k, _), place in penny.patches(
        cells, size) for i in range(k + 1)}
    layers = penny.graded(0., penny.BLOCK, size * penny.RADIUS, 1.6)
    write_block("ring.msh", [sorted(columns), layers], lambda middle, normal:
                normal == 1 and middle[1] == 0 and middle[0] < penny.RADIUS)
    ring = MESH.format(dimension=2, name="ring", symmetry=BOTTOM, crack=CRACK, loaded=TOP,
                       fixed="none") + BODY.replace(
        "set Young", "set Plane state = axisymmetric\n  set Young")
    space = MESH.format(dimension=3, name="penny", symmetry="1, 4, 5", crack=2, loaded=3,
                        fixed="none") + BODY.replace("0; 1\n", "0; 0; 1\n")
    for n in (1, 3):
        more = [*LONG, f"Material/Creep exponent={n}"]
        C_of_ring = run(ring, "ring", more).table("creep_integral.csv")["C_t"]
        C = along_front(run(space, "penny", [mesh, *more]))
        check_below(worst_difference(C, [(n_faces + 1) * [C] for C in C_of_ring]), 5e-3,
                    f"C(t) of the penny-shaped crack over that of the ring, n = {n}")
        exact = 6 / math.pi * A * penny.RADIUS / math.sqrt(1 + 3 / n)
        check_close(C[40.][0] / exact, 1, 0.05, f"C* of He and Hutchinson, n = {n}")
    # K at a vertex sees how long the elements of the front are.
    expected = run(ring, "linear_ring", MAXWELL).summary["crack_tip"]["C_star"]
    C = c_star_along(run(space, "linear_penny", [penny_mesh("penny.msh", "8", "0.1"),
                                                 *MAXWELL]))
    print("C*:", C, "of the ring:", expected)
    check_below(max(abs(value / expected - 1) for value in C), 5e-3,
                "C* of the penny-shaped crack over that of the ring")
    exact = 4 / math.pi * penny.RADIUS * (1 - 0.3**2) / 1000 / TAU
    check_close(expected / exact, 1, 0.01, "C* of the infinite body")


@full
def test_what_varies():
    """Body force, temperature and a law that varies, as in the plane."""
    more = ["Crack tip/Radius=0.5", "Material/Thermal expansion=1e-3",
            "Loads/Temperature=(x^2 + y)*t", f"Material/Creep coefficient={A}*exp(3*x)",
            "Material/Young modulus=1000*(1 + 0.9*x)", "Material/Creep exponent=3 + x"]
    plane = run(PLANE, "plane", [*more, "Loads/Body force=0; 2"]).table(
        "creep_integral.csv")["C_t"]
    C = along_front(run(SLAB, "slab", [*more, "Loads/Body force=0; 2; 0"]))
    check_below(worst_difference(C, [3 * [value] for value in plane]), 1e-6,
                "C(t) of a slab over that of the plane")


@full
def test_two_lips():
    """A slab modelled on both sides of the crack, as the plane is."""
    axes = [steps(-1, 1, 8), steps(-1, 1, 8), [0., 0.25, 0.5]]
    results = {}
    for dimension, name, more, fixed in (
            (2, "plane", "", "1, -1: 1, 2; 1, 1: 1"),
            (3, "space", "; 0", "1, -1, 0: 1, 2; 1, 1, 0: 1")):
        write_block(f"{name}.msh", axes[:dimension], lambda middle, normal:
                    normal == 1 and middle[1] == 0 and middle[0] < 0)
        scene = MESH.replace("Contact", "Crack").format(
            dimension=dimension, name=name, crack=CRACK, loaded=f"{BOTTOM}, {TOP}",
            fixed=fixed, symmetry=f"{FRONT}, {BACK}" if more else "none") + BODY.replace(
            "0; 1\n", f"0; if(y > 0, 1, -1){more}\n")
        if not more:
            scene = scene.replace("set Young", "set Plane state = plane strain\n  set Young")
        results[name] = run(scene, name, ["Crack tip/Radius=0.5"])
    C = results["plane"].table("creep_integral_1.csv")["C_t"]
    check_below(worst_difference(along_front(results["space"]), [3 * [c] for c in C]), 1e-6,
                "C(t) of both lips over that of the plane")
    sheared, side = [*MAXWELL, "Crack tip/Radius=0.5"], "if(y > 0, 1, -1)"
    C = c_star_along(run("space.prm", "sheared_space", [
        *sheared, f"Loads/Traction={side}; {side}; 0"]))
    plane = run("plane.prm", "sheared_plane", [
        *sheared, f"Loads/Traction={side}; {side}"]).summary["crack_tips"][0]
    print("C*:", C, "in the plane:", plane)
    check_below(max(abs(c / plane["C_star"] - 1) for c in C), 3e-3,
                "C* of both modes over that of the plane")


REFUSED = [
    ("lips", ["Boundary/Loaded=3, 4"], "names a lip"),
    ("radius", ["Crack tip/Radius=0.6"], "must be at most 0.5"),
    ("cells", ["Crack tip/Radius=0.2"], "crack front reach 0.125 from it, but the square"),
    ("growth", ["Crack tip/Crack growth law=creep", "Crack tip/Creep factor=1",
                "Crack tip/Creep growth parameter=C(t)"], "is for Dimension = 2"),
    ("singular", ["Discretisation/Singular functions=1"], "Singular functions = 0"),
    ("force", ["Loads/Traction=1; 1; 0"], "on the crack front has to bear loads")]


def test_refusals():
    with open("refused.prm", "w") as file:
        file.write(plain(SLAB))
    for name, settings, words in REFUSED:
        status, _, error = execute("--check", "refused.prm", *overrides(settings))
        print(f"{name}: {status}: {error.strip()}")
        check(status == 2 and words in " ".join(error.split()), name + " is refused")
    for name, material, words in (
            ("beside", lambda middle: 1 + (middle[0] > 0.7), "another material) begins"),
            ("along", lambda middle: 1 + (middle[2] > 0.25),
             "cells at the crack front have different materials")):
        with open(f"{name}.prm", "w") as file:
            file.write(plain(slab(name, material=material)))
        status, _, error = execute("--check", f"{name}.prm", *overrides([
            "Material/Young modulus=1000*material", "Crack tip/Radius=0.4"]))
        print(f"{name}: {status}: {error.strip()}")
        check(status == 2 and words in " ".join(error.split()), name + " is refused")


if __name__ == "__main__":
    test_slab()
    test_c_star_of_slab()
    test_refusals()
    test_c_star_of_crack_lengths()
    test_energies_of_crack_lengths()
    test_invariance()
    test_penny()
    test_what_varies()
    test_two_lips()
