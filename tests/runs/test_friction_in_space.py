"""Coulomb's friction in space: a crack through a slab against the plane, blocks that
slide on each other as rigid ones, a square crack however it is turned, and a penny-shaped
crack against what is known without friction."""

import math

from cracked import BACK, BOTTOM, CRACK, FRONT, LEFT, RIGHT, TOP, steps, write_block
from crevasse_run import check, check_below, check_close, full, run, run_on, tier
from fronts import PENNY, penny_mesh

HALF = 4.  # of the side of slab and plane; that of the crack is 1

SCENE = """\
set Dimension = {0}
subsection Geometry
  set Shape     = mesh file
  set Mesh file = {1}.msh
end
subsection Boundary
  set Crack                = {2}
  set Friction coefficient = 0.5
{3}
end
subsection Material
  set Plane state   = plane strain
  set Young modulus = 1
  set Poisson ratio = {4}
  set Viscosity     = none
end
subsection Loads
  set Period   = 1
{5}
end
subsection Time integration
  set Steps per period = 4
end
subsection Periodic state
  set Maximum periods = 1
  set Tolerance       = 0
end
subsection Output
  set Fields = none
  set Probes =
end
"""


def rows(results):
    """Rows of friction.csv as dictionaries."""
    table = results.table("friction.csv")
    return [dict(zip(table, row)) for row in zip(*table.values())]


def front(results, t):
    """Rows of crack_front.csv at an instant."""
    table = results.table("crack_front.csv")
    return [row for row in (dict(zip(table, row)) for row in zip(*table.values()))
            if row["t"] == t]


def largest(results, column):
    return max(abs(row[column]) for row in rows(results))


def line(n):
    """n cells along half of the crack, growing ones beyond."""
    positive = steps(0, 1, n) + [1 + 1 / n, 1 + 2.5 / n]
    while positive[-1] < HALF:
        positive.append(min(HALF, positive[-1] + 1.5 * (positive[-1] - positive[-2])))
    return [-x for x in positive[:0:-1]] + positive


def through_crack(dim, n=4):
    """A crack through a slab between planes of symmetry, or of its section."""
    name = f"through_{dim}"
    write_block(f"{name}.msh", ([line(n), line(n), steps(0, 0.5, 2)])[:dim],
                lambda middle, normal: (normal == 1 and middle[1] == 0
                                        and abs(middle[0]) < 1))
    z = ", 0" if dim == 3 else ""
    pressure, shear = "(1 + 0.3*cos(2*pi*t) + 0.2*x)", "(0.8*sin(2*pi*t))"
    across = "(abs(y) > abs(x))"
    load = (f"if({across}, {shear}*sign(y), 0); "
            f"if({across}, -{pressure}*sign(y), {shear}*sign(x))")
    return name, SCENE.format(
        dim, name, CRACK,
        f"  set Loaded       = {LEFT}, {RIGHT}, {BOTTOM}, {TOP}\n"
        f"  set Symmetry     = {f'{FRONT}, {BACK}' if dim == 3 else 'none'}\n"
        f"  set Fixed points = {-HALF}, 0{z}: 2; {HALF}, 0{z}: 1, 2", 0.3,
        f"  set Traction = {load}{'; 0' if dim == 3 else ''}") + """
subsection Crack tip
  set Stress intensity = true
end
"""


def test_through_crack():
    """A slab in plane strain has the slips, forces and work of the plane."""
    (name, slab), (other, plane) = through_crack(3), through_crack(2)
    solid, flat = run(slab, name), run(plane, other)
    places = {(row["t"], round(row["x"], 9)): row for row in rows(flat)}
    check(len({row["state"] for row in places.values()}) > 2, "pairs stick and slide")
    for column in ("slip", "tangential_traction", "normal_pressure"):
        size = largest(flat, column)
        worst = max(abs(row[column] - abs(places[row["t"], round(row["x"], 9)][column]))
                    for row in rows(solid))
        check_below(worst / size, 1e-10, f"{column} of the slab")
    work = flat.summary["friction"]["dissipation"]
    check_close(solid.summary["friction"]["dissipation"] / (0.5 * work), 1, 1e-10, "work")
    check(solid.summary["friction"]["kind"] == flat.summary["friction"]["kind"], "kind")
    check_below(solid.summary["certificate"]["friction"], 1e-10, "certificate")


@full
def test_through_crack_without():
    """What friction leaves of K, a coefficient that is 0 here and now, two processes."""
    (name, slab), (other, plane) = through_crack(3), through_crack(2)
    solid, flat = run(slab, name), run(plane, other)
    # The integrals differ, but on the same mesh friction leaves the same part of K.
    off = ["Boundary/Friction coefficient=0"]
    bare, free = (run(f"{scene}.prm", f"free_{scene}", off) for scene in (other, name))
    part = (flat.table("crack_tip_2.csv")["K_II"][1]
            / bare.table("crack_tip_2.csv")["K_II"][1])
    for row, without in zip(front(solid, 0.25), front(free, 0.25), strict=True):
        if row["x"] > 0:
            check_close(row["K_II"] / without["K_II"], part, 1e-3, "part of K_II that is left")
        check_below(abs(row["K_III"] / row["K_II"]), 1e-9, "K_III")
    two = run_on(2, f"{name}.prm", "through_two")
    worst = max(abs(a["slip"] - b["slip"]) for a, b in zip(rows(solid), rows(two),
                                                           strict=True))
    check_below(worst / largest(solid, "slip"), 1e-9, "slips on two processes")
    # A coefficient that is 0 here and now is the run without friction.
    zero = run(f"{name}.prm", "zero", ["Boundary/Friction coefficient=0*x"])
    a, b = (results.table("crack_front.csv")["K_II"] for results in (free, zero))
    check_below(max(abs(x - y) for x, y in zip(a, b, strict=True)) / max(map(abs, a)), 1e-11,
                "K_II of a coefficient 0")


def test_other_cells_below():
    """Under a uniform pressure p and shear 2 p friction leaves 3/4 of K_II, also where the
    cells on one side of the crack are others, so that the pressure next to the front is
    wrong."""
    below = [y for y in line(4) if y < 0]
    write_block("other.msh", (line(6), below + [y for y in line(6) if y >= 0],
                              steps(0, 0.25, 1)),
                lambda middle, normal: (normal == 1 and middle[1] == 0
                                        and abs(middle[0]) < 1))
    on_top = f"if(abs(y) > {HALF - 1e-6}, sign(y), 0)*sin(pi*t)"
    on_side = f"if(abs(x) > {HALF - 1e-6}, sign(x), 0)*sin(pi*t)"
    scene = SCENE.format(
        3, "other", CRACK,
        f"  set Loaded       = {LEFT}, {RIGHT}, {BOTTOM}, {TOP}\n"
        f"  set Symmetry     = {FRONT}, {BACK}\n"
        f"  set Fixed points = {-HALF}, 0, 0: 2; {HALF}, 0, 0: 1, 2", 0.3,
        f"  set Traction = 2*{on_top}; 2*{on_side} - {on_top}; 0") + """
subsection Refinement
  set Strategy = tip
  set Cycles   = 1
end
subsection Crack tip
  set Stress intensity = true
end
"""
    held = run(scene, "other_held")
    free = run("other_held.prm", "other_free", ["Boundary/Friction coefficient=0"])
    for row, without in zip(front(held, 0.5), front(free, 0.5), strict=True):
        exact = 0.75 * without["K_II"]
        print(row["K_II"] / without["K_II"], row["K_II_error"] / abs(exact))
        check_below(abs(row["K_II"] / exact - 1), 5e-3, "K_II that friction leaves")
        check_below(abs(row["K_II"] - exact), 2 * row["K_II_error"], "its printed error")


def test_blocks():
    """A block that another one presses and pushes at 30 degrees sticks, or slides as a
    rigid one, in a uniform stress that the sides bear, too."""
    write_block("blocks.msh", [steps(0, 1, 2), steps(-1, 1, 4), steps(0, 1, 2)],
                lambda middle, normal: normal == 1 and middle[1] == 0)
    # Without Poisson's effect, height 2: shear stress d/4, limit 0.5 times 0.1.
    push = "0.3*sin(pi*t)"
    shear = f"if(t <= 0.5, min(0.25*{push}, 0.05), 0.25*({push} - 0.1))"
    c, s = math.cos(math.pi / 6), math.sin(math.pi / 6)

    def side(axis):
        return f"if({axis} > 0.999, 1, if({axis} < 0.001, -1, 0))"
    on_x, on_z = (f"({side(axis)})*({shear})" for axis in "xz")
    scene = SCENE.format(
        3, "blocks", CRACK,
        f"  set Clamped   = {BOTTOM}\n  set Displaced = {TOP}\n"
        f"  set Loaded    = {LEFT}, {RIGHT}, {FRONT}, {BACK}", 0,
        f"  set Displacement = {c!r}*{push}; -0.2; {s!r}*{push}\n"
        f"  set Traction     = 0; {c!r}*{on_x} + {s!r}*{on_z}; 0")
    results = run(scene, "blocks")
    slips = {0.25: 0.3 * math.sqrt(0.5) - 0.2, 0.5: 0.1, 0.75: 0.1}
    worst = dict.fromkeys(("slip", "tangential_traction", "normal_pressure"), 0.)
    n_rows = 0
    for row in rows(results):
        if slip := slips.get(row["t"]):  # at the end loads jump to those of the beginning
            n_rows += 1
            force = abs(0.25 * (0.3 * math.sin(math.pi * row["t"]) - slip))
            for column, value in zip(worst, (slip, force, 0.1)):
                worst[column] = max(worst[column], abs(row[column] - value) / 0.1)
    check(n_rows >= 3, "rows at three instants")
    for column, difference in worst.items():
        check_below(difference, 1e-9, f"{column} of the block")
    # The first slip begins within a step, from a mean force of half the limit.
    check_close(results.summary["friction"]["dissipation"], 0.05 * (0.1 - 0.5 * slips[0.25]),
                1e-10, "work")


def square_crack(name, turns, place):
    """A square crack in a block, its pressure uneven, sheared at 20 degrees, all turned
    about the crack's normal."""
    half, n = 2., tier(3, 8)
    write_block(f"{name}.msh", [steps(-half, half, 2 * n)] * 3,
                lambda middle, normal: (normal == 1 and middle[1] == 0 and
                                        max(abs(middle[0]), abs(middle[2])) < 1), place)
    c, s = math.cos(math.radians(90 * turns)), math.sin(math.radians(90 * turns))
    # Coordinates before the turn, from those after.
    x, z = f"({round(c)}*x + {round(s)}*z)", f"({round(c)}*z - {round(s)}*x)"
    a, b = math.cos(math.radians(20)), math.sin(math.radians(20))
    on_top = f"if(abs(y) > {half - 1e-6}, sign(y), 0)"
    on_x, on_z = (f"if(abs({axis}) > {half - 1e-6}, sign({axis}), 0)" for axis in (x, z))
    shear = "0.6*sin(2*pi*t)"
    t_x, t_z = (f"{part!r}*{shear}*{on_top}" for part in (a, b))
    t_y = (f"{shear}*({a!r}*{on_x} + {b!r}*{on_z}) - (1 + 0.4*{x})*{on_top}")
    load = (f"{round(c)}*({t_x}) - {round(s)}*({t_z}); {t_y}; "
            f"{round(s)}*({t_x}) + {round(c)}*({t_z})")

    def at(*point):
        return ", ".join(map(repr, place(point)))
    which = [1, 3] if turns % 2 == 0 else [3, 1]
    return SCENE.format(
        3, name, CRACK,
        f"  set Loaded       = {LEFT}, {RIGHT}, {FRONT}, {BACK}, {BOTTOM}, {TOP}\n"
        f"  set Fixed points = {at(-half, 0., 0.)}: 2, {which[1]}; "
        f"{at(half, 0., 0.)}: 1, 2, 3; {at(0., 0., half)}: 2",
        0.3, f"  set Traction = {load}")


def test_turned():
    """A square crack, and the same with body and loads turned by 90 degrees about its
    normal: the tangents of its pairs are not turned with it."""
    def turn(point):
        return -point[2], point[1], point[0]
    as_it_is = run(square_crack("square", 0, lambda point: point), "square")
    other = run(square_crack("turned", 1, turn), "turned")

    def at(row, place=lambda point: point):
        return (row["t"], *(round(x, 6) + 0. for x in place((row["x"], row["y"], row["z"]))))
    found = {at(row): row for row in rows(other)}
    states = {row["state"] for row in rows(as_it_is)}
    check(states >= {1., 2.}, f"pairs stick and slide: {states}")
    for column in ("slip", "tangential_traction", "normal_pressure"):
        worst = max(abs(row[column] - found[at(row, turn)][column])
                    for row in rows(as_it_is))
        check_below(worst / largest(as_it_is, column), 1e-10, f"{column}, turned")
    limit = max(row["tangential_traction"] - 0.5 * row["normal_pressure"]
                for row in rows(as_it_is))
    check_below(limit, 1e-9, "traction beyond the limit")


@full
def test_penny():
    """A penny-shaped crack pressed and sheared uniformly slides like one without
    friction under the shear that friction leaves (K_II and K_III of Tada, Paris, Irwin,
    Handbook, 1973)."""
    at_x, at_z = (f"if(abs({axis})>19.99,if({axis}>0,1,-1),0)" for axis in "xz")
    mesh = [penny_mesh("pressed.msh", "6", "0.1", "xz"), "Boundary/Contact=none",
            "Boundary/Crack=2", "Boundary/Loaded=3,6,7", "Boundary/Symmetry=5",
            "Boundary/Fixed points=20,0,0: 3; -20,0,0: 1,3", "Periodic state/Tolerance=0",
            f"Loads/Traction=1e6*({at_z}); 0; 1e6*({at_x}) - 1e6*({at_z})"]
    free, held = (front(run(PENNY, f"penny_{mu}",
                            [*mesh, f"Boundary/Friction coefficient={mu}"]), 1)
                  for mu in (0, 0.4))
    size = max(row["K_II"] for row in free)
    for name in ("K_II", "K_III"):
        worst = max(abs(b[name] - 0.6 * a[name]) for a, b in zip(free, held, strict=True))
        check_below(worst / size, 1e-2, f"{name} that friction leaves")


for test in (test_through_crack, test_through_crack_without, test_other_cells_below,
             test_blocks, test_turned,
             test_penny):
    test()
