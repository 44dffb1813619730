"""K_I, K_II and K_III along fronts of cracks with two lips in space: a penny-shaped
crack under tension and shear against closed forms and against the half model, a
slice against the plane, and a slab turned in space."""

import contextlib
import io
import math
import pathlib

from cracked import BACK, BOTTOM, CRACK, FRONT, LEFT, RIGHT, TOP, steps, write_block
from crevasse_run import (check, check_below, check_close, execute, full, plain, run,
                          run_on, tier)
from fronts import ONE_STEP, PENNY, front, penny_mesh

from crevasse import report as make_report

RADIUS, NU, STRESS = 2., 0.3, 1e6
K_0 = 2 * STRESS * math.sqrt(RADIUS / math.pi)  # under tension
MODES = ("K_I", "K_II", "K_III")
TWO_LIPS = ["Boundary/Contact=none", "Boundary/Crack=2", "Boundary/Loaded=3,6,7"]

SCENE = """\
set Dimension = {0}
subsection Geometry
  set Shape     = mesh file
  set Mesh file = {1}
end
subsection Boundary
  set Crack        = {2}
  set Symmetry     = {3}
  set Loaded       = {4}
  set Fixed points = {5}
end
subsection Material
  set Young modulus = 13000
  set Poisson ratio = 0.3
  set Plane state   = plane strain
  set Viscosity     = none
end
subsection Loads
  set Period   = 1
  set Traction = {6}
end
""" + ONE_STEP


def at_sides(axis):
    """1 on the positive side of the block, -1 on the other, 0 elsewhere."""
    return f"if(abs({axis})>19.99,if({axis}>0,1,-1),0)"


def test_penny():
    """Tension and shear (Tada, Paris, Irwin, Handbook, 1973): K_II and K_III go with
    the cosine and the sine of the angle from the shear's direction."""
    results = run(PENNY, "sheared", [
        penny_mesh("sheared.msh", "6", "0.1", "xz"), *TWO_LIPS,
        "Boundary/Symmetry=5", "Boundary/Fixed points=20,0,0: 3; -20,0,0: 1,3",
        f"Loads/Traction=1e6*{at_sides('z')}; 0; "
        f"1e6*({at_sides('z')}+{at_sides('x')})"])
    size = 2 * K_0 / (2 - NU)
    worst = dict.fromkeys(MODES, 0.)
    for row in front(results):
        c, s = row["x"] / RADIUS, row["y"] / RADIUS
        for name, exact in zip(MODES, (K_0, size * c, (1 - NU) * size * s)):
            worst[name] = max(worst[name], abs(row[name] - exact))
        G = (row["K_I"]**2 + row["K_II"]**2 + row["K_III"]**2 / (1 - NU)) * (1 - NU**2)
        check_close(row["energy_release_rate"] * 2e11 / G, 1, 1e-12, "G")
    # A hat takes the mean of about a cosine: 1 - angle^2 / 12 of an element.
    for name, amplitude in zip(MODES, (K_0, size, (1 - NU) * size)):
        check_below(worst[name] / amplitude, 0.015, f"{name} of the penny-shaped crack")
    summary = results.summary["crack_front"]
    check_close(summary["K_II"]["largest"]["position"][0], RADIUS, 1e-9, "where K_II is")
    check_close(summary["K_III"]["largest"]["position"][1], RADIUS, 1e-9,
                "where K_III is")


@full
def test_half_model():
    """Both lips have the K_I of one on a plane of symmetry."""
    half = run(PENNY, "half", [penny_mesh("half.msh", "4", "0.1")])
    both = run(PENNY, "both", [
        penny_mesh("both.msh", "4", "0.1", "z"), *TWO_LIPS, "Boundary/Symmetry=4,5",
        "Boundary/Fixed points=20,20,0: 3", f"Loads/Traction=0; 0; 1e6*{at_sides('z')}"])
    for a, b in zip(front(half), front(both), strict=True):
        check_below(abs(b["K_I"] / a["K_I"] - 1), 1e-7, "K_I of both lips")
        check_below(max(abs(b["K_II"]), abs(b["K_III"])) / K_0, 1e-7, "K_II, K_III")


def is_crack(middle, normal):
    return normal == 1 and middle[1] == 0 and middle[0] < 0


def test_slice():
    """Between planes of symmetry a straight front is in plane strain."""
    axes = [steps(-1, 1, 12), steps(-1, 1, 12), steps(0, 0.5, 3)]
    write_block("slice.msh", axes, is_crack)
    write_block("plane.msh", axes[:2], is_crack)
    load = "3*{0} + 0*{1}; 3*{1} + 10*{0}".format(
        *(f"if(abs({axis})>0.999,if({axis}>0,1,-1),0)" for axis in "yx"))
    results = run(SCENE.format(
        3, "slice.msh", CRACK, f"{FRONT}, {BACK}", f"{LEFT}, {RIGHT}, {TOP}, {BOTTOM}",
        "1, -1, 0: 1, 2; 1, 1, 0: 1", load + "; 0"), "slice")
    with (contextlib.redirect_stdout(io.StringIO()),
          contextlib.redirect_stderr(io.StringIO()) as stderr):
        check(make_report.main([str(results.directory)]) == 0, stderr.getvalue())
    page = (results.directory / "report.html").read_text()
    check("largest K<sub>III</sub>" in page, "the report knows K_III")
    slab = front(results)
    plane = run(SCENE.format(
        2, "plane.msh", CRACK, "none", f"{LEFT}, {RIGHT}, {TOP}, {BOTTOM}",
        "1, -1: 1, 2; 1, 1: 1", load), "plane").table("crack_tip_1.csv")
    for row in slab:
        for name, allowed in (("K_I", 1e-3), ("K_II", 2e-3)):
            check_below(abs(row[name] / plane[name][-1] - 1), allowed,
                        f"{name} of the slice")
        check_below(abs(row["K_III"] / plane["K_I"][-1]), 1e-9, "K_III of the slice")


def turn(x, y, z):
    """About the axis 1 by 30 degrees, then about the axis 3 by 20."""
    c, s = math.cos(math.pi / 6), math.sin(math.pi / 6)
    y, z = c * y - s * z, s * y + c * z
    c, s = math.cos(math.pi / 9), math.sin(math.pi / 9)
    return c * x - s * y, s * x + c * y, z


def slab(name, place, n=8, layers=3, tension="10", cracks=is_crack):
    """A free slab with an edge crack under tension, shear and twist, moved."""
    write_block(f"{name}.msh", [steps(-1, 1, n), steps(-1, 1, n), steps(0, 0.5, layers)],
                cracks, lambda point: place(*point))
    rows = [place(*(float(i == j) for j in range(3))) for i in range(3)]
    X, Y = (" + ".join(f"({factor!r})*{axis}" for factor, axis in zip(row, "xyz"))
            for row in rows[:2])
    on_x, on_y = (f"if(abs({at})>0.999,if({at}>0,1,-1),0)" for at in (X, Y))
    local = [f"3*{on_y}", f"({tension})*{on_y} + 3*{on_x}",
             f"2*{on_y} - 6*abs({on_x})*({Y})"]
    load = "; ".join(" + ".join(f"({row[i]!r})*({part})"
                                for row, part in zip(rows, local)) for i in range(3))

    def at(*point):
        return ", ".join(map(repr, place(*point)))
    return SCENE.format(
        3, f"{name}.msh", CRACK, "none", f"{LEFT}, {RIGHT}, {TOP}, {BOTTOM}",
        f"{at(1, -1, 0)}; {at(1, 1, 0)}: 1, 3; {at(1, -1, 0.5)}: 1", load)


def test_turned():
    """As the body is, turned, and on two processes."""
    as_it_is = front(run(slab("as_it_is", lambda *point: point), "as_it_is"))
    check(min(abs(row["K_III"]) for row in as_it_is) > 1, "twist makes K_III")
    turned = front(run(slab("turned", turn), "turned"))
    shared = front(run_on(2, "as_it_is.prm", "shared"))
    size = max(abs(row[name]) for row in as_it_is for name in MODES)
    for what, others in (("turned", turned), ("on two processes", shared)):
        worst = max(abs(a[name] - b[name]) / size for name in MODES
                    for a, b in zip(as_it_is, others, strict=True))
        check_below(worst, 1e-7, what)


def test_closed():
    """Pressed lips bear no K_I, and slide as open ones do; where only a part of
    the front is closed, K_I is 0 there."""
    def as_it_is(*point):
        return point
    opened = front(run(slab("opened", as_it_is), "opened"))
    pressed = front(run(slab("pressed", as_it_is, tension="-10"), "pressed"))
    size = max(row["K_I"] for row in opened)
    for a, b in zip(opened, pressed, strict=True):
        check(a["K_I"] > 0.5 * size and b["K_I"] == b["K_I_error"] == 0.,
              "K_I of pressed lips")
        for name in ("K_II", "K_III"):
            check_below(abs(a[name] - b[name]) / size, 1e-7, f"{name} of pressed lips")
    bent = front(run(slab("bent", as_it_is, layers=6, tension="40*(z - 0.25)"), "bent"))
    K = [row["K_I"] for row in sorted(bent, key=lambda row: row["z"])]
    print(K)
    check(K[0] == K[1] == 0. and min(K[-2:]) > 0.05 * size, "closed where z is small")


@full
def test_two_cracks():
    """From both sides of a slab: turned by 180 degrees about the axis 2 it is the
    same, and shear and twist change their sign."""
    scene = slab("double", lambda *point: point, cracks=lambda middle, normal: (
        normal == 1 and middle[1] == 0 and abs(middle[0]) > 0.5))
    rows = front(run(scene, "double"))
    left, right = ([row for row in rows if row["x"] * side > 0] for side in (-1, 1))
    check({row["front"] for row in left} != {row["front"] for row in right},
          "there are two fronts")
    size = max(row["K_I"] for row in rows)
    for a, b in zip(sorted(left, key=lambda row: row["z"]),
                    sorted(right, key=lambda row: -row["z"]), strict=True):
        for name, sign in zip(MODES, (1, -1, -1)):
            check_below(abs(a[name] - sign * b[name]) / size, 1e-9,
                        f"{name} of both fronts")


def test_refusals():
    thin = slab("thin", lambda *point: point, layers=1)
    # Half of the bottom is a lip, too, on a rigid plane.
    mixed = slab("mixed", lambda *point: point, n=4, layers=2).replace(
        "Symmetry     = none", f"Contact = 8\n  set Symmetry = {BOTTOM}").replace(
        f"{TOP}, {BOTTOM}", f"{TOP}")
    mesh = pathlib.Path("mixed.msh")
    mesh.write_text(mesh.read_text().replace(f" 2 {BOTTOM} {BOTTOM} ", " 2 8 8 ", 4))
    for name, scene, message in (
            ("thin", thin, "has one element"),
            ("mixed", mixed, "Model both lips of all cracks")):
        with open(f"{name}.prm", "w") as file:
            file.write(plain(scene))
        status, _, error = execute(f"{name}.prm", "--check")
        check(status == 2 and message in " ".join(error.split()),
              f"{name}: status {status}\n{error}")


TESTS = [test_slice, test_turned, test_half_model, test_closed, test_two_cracks,
         test_refusals, *tier([], [test_penny])]

if __name__ == "__main__":
    for test in TESTS:
        test()
