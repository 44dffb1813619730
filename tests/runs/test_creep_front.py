"""C(t) along crack fronts in space: of a slab against the plane and against energies of
neighbouring crack lengths, of a penny-shaped crack against the ring, and what must not
change it."""

import math
import sys

from cracked import (BACK, BOTTOM, CRACK, FRONT, STEADY_CREEP, TOP, steps, write_block)
from crevasse_run import (SOURCE, check, check_below, check_close, execute, full,
                          overrides, plain, run, run_on)
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


def mean_along(results):
    """Integral of C along the front at the end, by the trapezoidal rule."""
    table = results.table("crack_front.csv")
    C = along_front(results)[table["t"][-1]]
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
    axes = [steps(-1, 1, 8), steps(-1, 1, 8), [0., 0.5]]
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
    check_below(worst_difference(along_front(results["space"]), [[c, c] for c in C]), 1e-6,
                "C(t) of both lips over that of the plane")


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
    test_refusals()
    test_energies_of_crack_lengths()
    test_invariance()
    test_penny()
    test_what_varies()
    test_two_lips()
