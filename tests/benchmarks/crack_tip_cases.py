#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""K at crack tips with printed and true errors, over two squares, and for a user who
chooses no radius, no method and no mesh refinement: the tables of doc/crack_tip.md.

    /usr/bin/python3 tests/benchmarks/crack_tip_cases.py build/crevasse [CASE ...]

runs all cases, or those that are named. True errors are differences to a converged mesh
or to exact values. More cases are more rows of CASES."""

import dataclasses
import math
import os
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
NAMES, sys.argv = sys.argv[2:], [sys.argv[0], sys.argv[1], str(ROOT)]
sys.path += [str(ROOT / "tests/runs"), str(ROOT / "doc/figures")]

import cracked  # noqa: E402
import crack_tip_handbook as handbook  # noqa: E402
import test_anisotropic_tip as wood  # noqa: E402
import test_curved_crack as arc  # noqa: E402
import test_mixed_mode as plate  # noqa: E402
from crevasse_run import Failure, plain, run  # noqa: E402
from fronts import PENNY, penny_mesh  # noqa: E402

Q2, NO_FUNCTIONS, FUNCTIONS = ("Discretisation/Degree=2", *(
    f"Discretisation/Singular functions={n}" for n in (0, 2)))
PLAIN = ["Refinement/Strategy=none", "Refinement/Target unknowns=0", "Refinement/Cycles=0"]
# What a user has who chooses nothing.
DEFAULTS = [*PLAIN, "Crack tip/Radius=0", "Crack tip/Method=automatic",
            "Geometry/Refinements=0"]


def graded(cycles, *more):
    return [*PLAIN, NO_FUNCTIONS, "Refinement/Strategy=tip", f"Refinement/Cycles={cycles}",
            *more]


def adaptive(unknowns, *more):
    return [*PLAIN, NO_FUNCTIONS, Q2, "Refinement/Strategy=adaptive",
            f"Refinement/Target unknowns={unknowns}", *more]


FINE, BEST = adaptive(60000), adaptive(20000, FUNCTIONS)


@dataclasses.dataclass
class Case:
    """Text or path of a scene; settings of all its runs; those of the case; those of a
    converged mesh, or the exact K by name; and those of a user, beside DEFAULTS."""
    scene: object
    base: list
    own: list
    truth: object
    of_user: list = dataclasses.field(default_factory=list)


SQUARE = """
subsection Geometry
  set Shape        = edge crack
  set Crack length = 0.5
end
subsection Material
  set Young modulus = 13000
  set Poisson ratio = 0.2
  set Viscosity     = none
end
subsection Loads
  set Traction = 0; 10
end
subsection Crack tip
  set Stress intensity = true
end
subsection Time integration
  set Steps per period = 1
end
subsection Output
  set Fields = none
end
"""
K_SQUARE = {"K_I": 35.41196}
AUTOMATIC = ["Geometry/Subdivisions=automatic"]


def strips():
    lengths = [(shape, a) for shape in ("edge", "centre") for a in handbook.LENGTHS]
    for k, (shape, a) in enumerate(lengths):
        yield f"{shape} crack, a/W = {a}", Case(
            handbook.SCENE,
            [f"Geometry/Shape={shape} crack", f"Geometry/Crack length={a!r}"],
            (adaptive(4000), graded(6), [*PLAIN, FUNCTIONS])[k % 3], BEST, AUTOMATIC)
    yield "SSLP101", Case(handbook.SCENE, list(handbook.SSLP101), adaptive(4000, FUNCTIONS),
                          BEST, AUTOMATIC)
    for a in (2.5, 3., 3.5, 4., 4.5, 5.):
        yield f"SSLP320, a = {a}", Case(handbook.SCENE, [
            "Geometry/Width=10", "Geometry/Height=15", f"Geometry/Crack length={a}",
            "Geometry/Subdivisions=20, 30"], PLAIN, BEST, AUTOMATIC)


def squares():
    for degree, cells, functions, cycles in ((1, 28, 0, 0), (2, 14, 0, 0), (1, 14, 2, 0),
                                             (2, 8, 2, 2), (1, 14, 0, 4)):
        yield (f"square, Q{degree}, {cells} × {cells}, {functions} functions, "
               f"{cycles} cycles"), Case(SQUARE, [], [
                   *(graded(cycles) if cycles else PLAIN), f"Discretisation/Degree={degree}",
                   f"Geometry/Subdivisions={cells}, {cells}",
                   f"Discretisation/Singular functions={functions}"], K_SQUARE, AUTOMATIC)
    hot = ["Material/Thermal expansion=1e-5", "Loads/Traction=0; 0",
           "Loads/Temperature=100*(1 - x^2)"]
    for name, settings in (
            ("heated", hot), ("graded modulus", ["Material/Young modulus=13000*exp(x)"]),
            ("two materials", ["Material/Young modulus=if(y < 0.25, 13000, 130000)"]),
            ("body force", ["Loads/Traction=0; 0", "Loads/Body force=0; 5*y"]),
            ("half closed by bending", ["Loads/Traction=0; 13 - 20*x"])):
        yield f"square, {name}", Case(
            SQUARE, settings, ["Geometry/Subdivisions=12, 12", Q2, *graded(5)],
            ["Geometry/Subdivisions=16, 16", *adaptive(40000)], AUTOMATIC)


def arcs():
    def mesh(h, order):
        name = f"arc_{order}_{h}.geo"
        pathlib.Path(name).write_text(arc.GEOMETRY.format(h=h, order=order))
        return f"Geometry/Mesh file={name}"
    inside = ["Boundary/Loaded=arc", "Loads/Traction=0; 0", "Loads/Pressure=0.01"]
    for name, h, order, base in (("curved", 0.1, 2, []), ("curved, pressure", 0.1, 2, inside),
                                 ("polygon of 32", 0.1, 1, []),
                                 ("polygon of 16", 0.2, 1, [])):
        yield f"arc, {name}", Case(
            arc.SCENE, base, [mesh(h, order), *graded(5)],
            [mesh(0.1, 2), *graded(8), "Geometry/Refinements=2"], [mesh(h, order)])


def anisotropic():
    width = 14
    across = [x for x in wood.SIDES if x < width / 2] + [width / 2, width]
    up = [y for y in wood.UP if y < width / 2] + [width / 2, width]
    mesh = cracked.write_block(
        "wood.msh", ([-x for x in across[:0:-1]] + across, [-y for y in up[:0:-1]] + up),
        lambda middle, n: n == 1 and middle[1] == 0 and abs(middle[0]) < 1)

    def on(x):
        return f"(if({x} > {width}-1e-6, 1, 0) - if({x} < 1e-6-{width}, 1, 0))"
    for degrees in (0, 30, 90):
        yield f"anisotropic, {degrees}°", Case(
            wood.PLATE.format(mesh=mesh, width=width, s=wood.FAR, side=on("x"), up=on("y")),
            [wood.stiffness(*wood.WOOD, degrees)], ["Geometry/Refinements=1", *graded(6)],
            FINE)
    for name, moduli in (("along", wood.WOOD), ("across", (10e3, 100e3, 4e3, 0.03))):
        yield f"anisotropic edge crack, {name}", Case(
            wood.EDGE, [wood.stiffness(*moduli)], adaptive(3000), FINE, AUTOMATIC)


def plates():
    one = ["Time integration/Steps per period=1"]
    pulled = [f"Loads/Traction=0; {plate.STRESS}*if(y > 0, 1, -1)", *one]
    for name, width, own, shape in (
            ("inclined", 10, graded(8), {"angle": plate.ANGLE}),
            ("inclined, 3 cycles", 10, graded(3), {"angle": plate.ANGLE}),
            ("inclined, large", 40, graded(8), {"angle": plate.ANGLE}),
            ("inclined, functions", 10, [*PLAIN, "Geometry/Refinements=1", FUNCTIONS],
             {"angle": plate.ANGLE}),
            ("kinked", 10, graded(6), {"crack": plate.bent(1)}),
            ("kinked, 3 cycles", 10, graded(3), {"crack": plate.bent(1)})):
        file = "plate_" + name.replace(",", "").replace(" ", "_")
        yield f"plate, {name}", Case(plate.scene(file, width, 1, **shape), pulled, own, FINE)
    elastic = ["Material/Viscosity=none", "Material/Chain=", "Loads/Traction=0; 100", *one]
    for name in ("inclined_crack", "two_cracks", "kinked_crack"):
        for cycles in (3, 6):
            yield f"{name}.prm, {cycles} cycles", Case(
                ROOT / f"prm/{name}.prm", elastic, graded(cycles), FINE)


def fronts():
    yield "penny", Case(PENNY, [penny_mesh("penny.msh", "6", "0.1")], [],
                        {"K_I": 2e6 * math.sqrt(2 / math.pi)})


def all_cases():
    for family in (strips, squares, arcs, anisotropic, plates, fronts):
        yield from family()


MODES = ("K_I", "K_II", "K_III")
FINEST = 1e-5  # smaller errors are not counted


def numbers(results):
    """Rows of all tips, or vertices of the front, where K is largest."""
    rows = []
    for path in sorted(results.directory.glob("crack_[tf]*.csv")):
        table = results.table(path.name)
        if "front" in table:
            rows += [dict(zip(table, row)) for row in zip(*table.values())
                     if row[0] == table["t"][-1]]
            continue
        k = max(range(len(table["t"])), key=lambda k: math.hypot(
            *(table[K][k] for K in MODES if K in table)))
        rows.append({name: column[k] for name, column in table.items()})
    return rows


def size(row, suffix=""):
    return math.hypot(*(row[K + suffix] for K in MODES if K in row))


def distance(one, other):
    return math.hypot(*(one[K] - other[K] for K in MODES if K in other))


def measured(name, case, word, settings):
    folder = "".join(c if c.isalnum() else "_" for c in f"{name}_{word}")
    scene = case.scene
    if isinstance(scene, str):
        path = pathlib.Path(f"{folder}.prm")
        path.write_text(scene if word == "user" else plain(scene))
        scene = path
    return run(scene, folder, ["Crack tip/Stress intensity=true", "Output/Fields=none",
                               *case.base, *settings])


def attempt(name, case, word, settings):
    """Nothing if the program refuses, as where cells at the tip are too large."""
    try:
        return numbers(measured(name, case, word, settings))
    except Failure:
        return None


def own_and_true(name, case):
    """The results of the case, and its rows beside the true ones."""
    results = measured(name, case, "own", case.own)
    own = numbers(results)
    truth = ([case.truth] * len(own) if isinstance(case.truth, dict) else
             numbers(measured(name, case, "truth", case.truth)))
    return results, list(zip(own, truth, strict=True))


def errors(pairs):
    """Error and printed error where the error is largest, by the largest K."""
    K = max(size(own) for own, _ in pairs)
    own, truth = max(pairs, key=lambda pair: distance(*pair))
    return distance(own, truth) / K, size(own, "_error") / K


def judge(name, case):
    results, pairs = own_and_true(name, case)
    error, printed = errors(pairs)
    summary = results.summary
    tip = (summary.get("crack_tip") or summary.get("crack_front")
           or summary["crack_tips"][0])
    narrow, user = (attempt(name, case, *run) for run in (
        ("narrow", [*case.own, f"Crack tip/Radius={tip['radius'] / 2!r}"]),
        ("user", [*DEFAULTS, *case.of_user])))
    return (error, printed, printed / error,
            max(distance(a, b) / size(a, "_error") for (a, _), b in zip(pairs, narrow))
            if narrow else "–",
            max(distance(a, truth) for a, (_, truth) in zip(user, pairs))
            / max(size(own) for own, _ in pairs) if user else "refused")


def text(x):
    return x if isinstance(x, str) else f"{x:.2g}"


def main():
    folder = pathlib.Path("results/crack_tip_cases")
    folder.mkdir(parents=True, exist_ok=True)
    os.chdir(folder)
    print("| case | error | printed | printed/error | two radii/printed | user |\n"
          + "|---" * 6 + "|", flush=True)
    ratios = []
    for name, case in all_cases():
        if NAMES and not any(word in name for word in NAMES):
            continue
        row = judge(name, case)
        if row[0] > FINEST:
            ratios.append(row[2])
        print(f"| {name} | " + " | ".join(map(text, row)) + " |", flush=True)
    for what, inside in (("below 1/4", lambda x: x < 0.25),
                         ("1/4 to 1/2", lambda x: 0.25 <= x < 0.5),
                         ("1/2 to 10", lambda x: 0.5 <= x <= 10), ("above", lambda x: x > 10)):
        print(f"printed/error {what}: {sum(map(inside, ratios))} of {len(ratios)} cases with "
              f"errors above {FINEST}")


if __name__ == "__main__":
    main()
