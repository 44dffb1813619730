"""crevasse life --path: the deflection of a crack beside a hole and its order, holes that
cracks reach, the advance of the tip against closed forms, wrong commands."""

import math
import os
import pathlib
import shutil

import numpy

from crevasse_run import PROGRAM, SOURCE, check, check_below, check_close, execute, full

os.environ["CREVASSE_PROGRAM"] = str(PROGRAM)
from crevasse.life_body import Body  # noqa: E402
from crevasse.life_output import page, read  # noqa: E402
from crevasse.life_path import between, direction, unit  # noqa: E402

SCENE = SOURCE / "prm/curved_path.prm"
GEOMETRY = SOURCE / "prm/curved_path.geo"


def path(name, *words, scene=SCENE, status=0, fresh=True):
    """life.json, the columns of life.csv, and what was printed; or the error."""
    directory = pathlib.Path("results") / name
    if fresh:
        shutil.rmtree(directory, ignore_errors=True)
    code, output, error = execute("life", scene, "--path", "--output", directory, *words)
    check(code == status, f"{name}: exit status {code}, not {status}\n{output}{error}")
    print(output + error)
    return error if status in (2, 3) else (*read(directory), output + error)


def test_tips():
    """SSLV316 of Code_Aster: three increments of 0.4, each turned by 30 degrees."""
    tip, heading = numpy.array([2., 9.]), 0.
    for expected in ((2.34641, 9.2), (2.54642, 9.5464), (2.54644, 9.9464)):
        heading += 30
        tip = tip + 0.4 * unit(heading)
        check_below(abs(tip - expected).max(), 3e-5, f"tip {expected}")
    check_close(between(179, -179), -2, 1e-12, "across 180 degrees")


def test_order():
    """In a field of directions that turn with x the path is a catenary: order 2, also
    where steps alternate."""
    def end(n, alternate):
        steps = numpy.tile([4 / 3, 2 / 3] if alternate else [1, 1], n // 2) / n
        place, before = numpy.zeros(2), 0.
        for k, step in enumerate(steps):
            heading = numpy.degrees(numpy.arctan(numpy.sinh(place[0])))
            if k == 0:
                there = place + step * unit(heading)
                ahead = numpy.degrees(numpy.arctan(numpy.sinh(there[0]))) / 2
            else:
                ahead = direction(heading, before, step, steps[k - 1])
            place, before = place + step * unit(ahead), heading
        return place
    exact = numpy.array([math.asinh(1), math.sqrt(2) - 1])  # a catenary of length 1
    for alternate in (False, True):
        errors = [numpy.linalg.norm(end(n, alternate) - exact) for n in (64, 128)]
        check(1.8 < math.log2(errors[0] / errors[1]) < 2.2, f"order of {errors}")


def test_border():
    body = Body(str(GEOMETRY), False, ["crack"], None)
    check_close(body.length, 0.5, 1e-12, "length")
    gap, name = body.gap(body.tip)
    check_close(gap, 0.5, 1e-12, "gap")
    check(name == "border at (0, 0)", name)
    gap, name = body.gap(numpy.array([0.8, 0.]))
    check_close(gap, math.hypot(0.3, 0.55) - 0.25, 2e-3, "gap to the hole")
    check(name == "hole at (1.1, 0.55)", name)
    distance, name = body.ahead(body.tip, unit(0))
    check(name == "border at (2, 0)" and abs(distance - 1.5) < 1e-12, name)
    distance, name = body.ahead(body.tip, unit(math.degrees(math.atan2(0.55, 0.6))))
    check_close(distance, math.hypot(0.6, 0.55) - 0.25, 2e-3, "distance to the hole")
    check(name == "hole at (1.1, 0.55)", name)


def test_fragments():
    """OpenCASCADE gives a curve within a surface to its borders; a crack is none."""
    pathlib.Path("fragments.geo").write_text("""
SetFactory("OpenCASCADE");
Rectangle(1) = {0, -2, 0, 2, 4};
Point(11) = {0, 0, 0};
Point(12) = {0.5, 0, 0};
Line(11) = {11, 12};
BooleanFragments{ Surface{1}; Delete; }{ Curve{11}; Delete; }
crack[] = Curve In BoundingBox{-0.01, -0.01, -0.01, 0.51, 0.01, 0.01};
Physical Curve("crack") = {crack[]};
""")
    body = Body("fragments.geo", False, ["crack"], None)
    check_below(abs(body.tip - [0.5, 0]).max(), 1e-12, "tip")
    gap, name = body.gap(body.tip)
    check(name == "border at (0, 0)" and abs(gap - 0.5) < 1e-12, f"{name}, {gap}")


def test_short_path():
    words = ["--step", "0.1", "--to", "0.7"]
    found, table, _ = path("short", *words)
    check(found["stopped_by"] == "--to" and found["new_runs"] == found["runs"], f"{found}")
    check_close(table["a"][-1], 0.7, 1e-12, "length")
    check_close(table["y"][-1], 0.00565, 2e-4, "deflection")
    check_close(math.hypot(table["x"][-1] - 0.5, table["y"][-1]), 0.2, 1e-4, "arc")
    check(table["path_error"][-1] < 1e-3, "error of the path")
    text = page(pathlib.Path("results/short"))[0]
    check("Path" in text and text.count('id="periods"') == 1, "the page")
    code, _, error = execute("figures", "results/short")
    names = [file.stem for file in pathlib.Path("results/short/figures").iterdir()]
    check(code == 0 and "path" in names, f"figures {names}\n{error}")
    again, _, _ = path("short", *words, fresh=False)
    check(again["new_runs"] == 0 and again["N"] == found["N"], f"{again}")
    error = path("arrest", *words, "--set", "Crack tip/Paris threshold=1e3", status=3)
    check("its life is infinite" in error, error)
    tough = 1.15 * table["K_max"][0]
    found, table, _ = path("tough", "--step", "0.05", "--to", "0.7", "--set",
                           f"Crack tip/Fracture toughness={tough}", "--error", "0.3")
    check(found["stopped_by"] == "K_c" and found["to"] < 0.6, f"{found['stopped_by']}")
    check_close(table["K_max"][-1] / tough, 1, 1e-6, "K at the end")


@full
def test_broken():
    pathlib.Path("was_there").unlink(missing_ok=True)
    text = GEOMETRY.read_text()
    pathlib.Path("no_crack.geo").write_text(text.replace('"crack"', '"line"'))
    pathlib.Path("two_tips.geo").write_text(
        text.replace("Line(10) = {5, 11}", "Point(12) = {0.2, 0, 0}; Line(10) = {12, 11}"))
    pathlib.Path("no_point.geo").write_text(
        text.replace("Line(10) = {5, 11}", "Point(12) = {0, 0.1, 0}; Line(10) = {12, 11}"))
    pathlib.Path("hostile.geo").write_text(text + 'SystemCall "touch was_there";\n')
    for message, words in (
            ("needs a body that is meshed anew", ["--set", "Geometry/Mesh file="
                                                  f"{SOURCE}/prm/kinked_crack.msh"]),
            ("crack is 0.5 long at the beginning", ["--to", "0.4"]),
            ("the path gives the lengths", ["--lengths", "1,2,3"]),
            ("is not a length", ["--step", "0"]),
            ("curved_path.geo is 0.5 long. Draw one of this", ["--from", "1"]),
            ("choose a smaller --step", ["--step", "0.1", "--to", "0.6"]),
            ("no", ["--set", "Geometry/Mesh file=no_crack.geo"]),
            ("there are 2 crack tips: choose one by --tip N (1:", [
                "--set", "Geometry/Mesh file=two_tips.geo"]),
            ("begins at (0, 0.1) on a border that has no point there", [
                "--set", "Geometry/Mesh file=no_point.geo"]),
            ("SystemCall", ["--set", "Geometry/Mesh file=hostile.geo"]),
            ("Crack growth law = none", ["--law", "none"])):
        error = path("broken", *words, status=2)
        check(message in error and "Traceback" not in error, f"{message}: {error}")
    check(not pathlib.Path("was_there").exists(), "a command of the file was run")


@full
def test_three_holes():
    """The beam of Bittencourt et al. (1996). A crack from a notch at x = 4 ends in the middle
    hole. One from x = 5 comes within 0.06 of the bottom hole, turns back, and comes within
    0.08 of the middle one; from x = 4.95 it ends in this, from x = 5.05 in the other."""
    text = SCENE.read_text().replace("curved_path", "three_holes")
    for old, new in (("Clamped    = bottom", "Fixed points = 1, 0; 19, 0: 2"),
                     ("= top", "= load"), ("0; 5*", "0; -5*"), ("Cycles   = 3",
                                                                "Cycles   = 2")):
        check(old in text, old)
        text = text.replace(old, new)
    scene = pathlib.Path("three_holes.prm")
    scene.write_text(text)
    geometry = (SOURCE / "tests/meshes/three_holes.geo").read_text()
    gaps = {}
    ends = {4: "hole at (6, 4.75)", 4.95: "hole at (6, 4.75)", 5: "--to",
            5.05: "hole at (6, 2.75)"}
    for x, end in ends.items():
        a = 1 if x == 4 else 1.5
        pathlib.Path("three_holes.geo").write_text(
            geometry.replace("x = {4,", f"x = {{{x},").replace("a = {1,", f"a = {{{a},"))
        found, table, _ = path("three_holes", "--step", "0.3", "--to", "5.5",
                               "--error", "0.03", scene=scene)
        gaps[x] = [numpy.hypot(table["x"] - 6, table["y"] - y).min() - 0.25
                   for y in (2.75, 4.75)]
        print(f"notch at {x}: {gaps[x]} from the holes")
        check((numpy.diff(table["N"]) > 0).all() and (table["N_error"] >= 0).all(), "N")
        check(found["stopped_by"] == end, f"{x}: {found['stopped_by']}")
        check(x != 4 or found["path_error"] < 0.05, f"{found['path_error']}")
    check(0.04 < gaps[5][0] < 0.07 and 0.05 < gaps[5][1] < 0.09, "beside both holes")


@full
def test_deflection():
    """0.0498 in the limit; the printed error is that of the path. With more cells at the
    tip than the scene's, whose differences of 1e-5 count in the order."""
    ends = []
    for step in (0.1, 0.05, 0.025):
        found, table, _ = path("plate", "--step", step, "--to", "1", "--error", "0.1",
                               "--set", "Refinement/Cycles=4")
        ends.append(table["y"][-1])
    order = math.log2((ends[1] - ends[0]) / (ends[2] - ends[1]))
    print(f"deflections {ends}, order {order}")
    check_below(abs(ends[1] - 0.0498), 5e-4, "deflection")
    check(order > 1.7, f"order {order}")
    limit = ends[2] + (ends[2] - ends[1]) / 3
    true = abs(limit - ends[2])
    check(true / 2 < found["path_error"] < 5 * true, f"{found['path_error']}, {true}")
    check_below(abs(limit - 0.0498), 3e-4, "limit")


test_tips()
test_order()
test_border()
test_fragments()
test_short_path()
test_broken()
test_three_holes()
test_deflection()
