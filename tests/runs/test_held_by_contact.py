"""Parts that contact alone holds: pressed blocks against closed forms, up to the
load that tips them over, and what is refused."""

import math

from cracked import BOTTOM, CRACK, FRONT, LEFT, TOP, steps, turned, write_block
from crevasse_run import (check, check_below, check_close, execute, full, overrides, plain,
                          run, run_on, tier)

E, TAU, PERIOD = 13000., 60., 600.
PRESSED = "5-4*cos(2*pi*t/600)"  # pressure at the top, 1 at t = 0


def blocks(path, n=4, dim=2, crack=True):
    """A block on another one, with a crack between them all across, or one."""
    axes = [steps(0, 1, n), steps(-1, 1, 2 * n), steps(0, 0.5, 2)]
    return write_block(path, axes[:dim],
                       lambda middle, normal: crack and normal == 1 and middle[1] == 0)


def scene(mesh, roles, traction=f"0; -({PRESSED})", probes="top: 0.5, 1"):
    return f"""
subsection Geometry
  set Shape = mesh file
  set Mesh file = {mesh}
end
subsection Boundary
  set Loaded = {TOP}
  {roles}
end
subsection Material
  set Young modulus = {E}
  set Poisson ratio = 0.2
  set Viscosity = relaxation time
  set Relaxation time = {TAU}
end
subsection Loads
  set Period = {PERIOD}
  set Traction = {traction}
end
subsection Time integration
  set Scheme = trapezoid
  set Steps per period = 40
end
subsection Periodic state
  set Method = march
  set Maximum periods = 2
  set Tolerance = 0
end
subsection Output
  set Probes = {probes}
end
"""


def log(results):
    return (results.directory / "log.txt").read_text()


def check_uniaxial(results, height=2.):
    """At each sample of the probe at the top: -s_22 = p, the pressure there, and
    what the trapezoidal rule makes of u' = -height (p' + p / tau) / E."""
    table = results.table("probe_top.csv")
    t, u = table["t"], table["u_2"]
    p = [5 - 4 * math.cos(2 * math.pi * now / PERIOD) for now in t]
    check_below(max(abs(s + now) / 9 for s, now in zip(table["s_22"], p, strict=True)),
                1e-9, "stress of a pressed block")
    flow = worst = 0.
    for i in range(1, len(t)):
        flow += (t[i] - t[i - 1]) * (p[i] + p[i - 1]) / 2 / TAU
        worst = max(worst, abs(u[i] - u[0] + height * (p[i] - p[0] + flow) / E))
    check_below(worst / (height * flow / E), 1e-9, "its displacement")


def test_block_on_block():
    """Nothing but the block below holds the upper one against moving down."""
    blocks("blocks.msh")
    roles = f"set Crack = {CRACK}\n  set Symmetry = {BOTTOM}, {LEFT}"
    results = run(scene("blocks.msh", roles), "on_block")
    check("held by contact alone: translation along x2 of part 2 of 2" in log(results),
          "the log says what holds the block")
    check_uniaxial(results)
    table = results.table("contact.csv")
    check(set(table["closed_nodes"]) == {5.}, "all is closed")
    for split in ("on", "off"):
        periodic = run(scene("blocks.msh", roles), f"split_{split}", [
            f"Periodic state/Secular split={split}", "Time integration/Scheme=heun"])
        stress = periodic.table("probe_top.csv")["s_22"]
        check_below(max(abs(s + 5 - 4 * math.cos(2 * math.pi * i / 40)) / 9
                        for i, s in enumerate(stress)), 1e-9, f"split {split}")


def test_block_on_plane():
    """A rigid plane holds a block against moving and turning, up to the pressure
    whose resultant leaves the base: p = 1 + a (x - 1/2) has it a / 12 off the
    middle."""
    blocks("block.msh", crack=False)
    on_plane = f"set Contact = {BOTTOM}\n  set Fixed points = 0.5, -1: 1"
    results = run(scene("block.msh", on_plane), "on_plane")
    check("translation along x2" in log(results) and
          "rotation in the plane x1-x2" in log(results), "two motions")
    check_uniaxial(results)
    for a in (5.9, -5.9):
        results = run(scene("block.msh", on_plane, f"0; -(1+{a}*(x-0.5))"),
                      "stands", ["Periodic state/Maximum periods=1"])
        check_close(sum(results.table("contact.csv")["force"][-1:]), 1., 1e-9,
                    "force on the plane")
    refused(scene("block.msh", on_plane, "0; -(1+6.1*(x-0.5))"), 3,
            "In period 1, step 1 from t = 0 to 15: ", "rotation in the plane x1-x2",
            "no equilibrium")


def refused(text, status, *parts, settings=()):
    with open("refused.prm", "w") as file:
        file.write(plain(text))
    code, _, error = execute("refused.prm", "--output", "results/refused", "--force",
                             *overrides(settings))
    check(code == status, f"status {code}\n{error}")
    for part in parts:
        check(part in error, f"{part} is not in\n{error}")


def test_loads_that_pause():
    """Without load contact bears nothing; the stress stays that of the load."""
    blocks("blocks.msh")
    roles = f"set Crack = {CRACK}\n  set Symmetry = {BOTTOM}, {LEFT}"
    for name, load, value in (
            ("from_zero", "1-cos(2*pi*t/600)", lambda t: 1 - math.cos(t)),
            ("half_waves", "max(0, sin(2*pi*t/600))", lambda t: max(0, math.sin(t)))):
        results = run(scene("blocks.msh", roles, f"0; -({load})"), name)
        stress = results.table("probe_top.csv")["s_22"]
        check_below(max(abs(s + value(2 * math.pi * i / 40))
                        for i, s in enumerate(stress)), 1e-9, name)


@full
def test_in_space():
    blocks("space.msh", n=2, dim=3, crack=False)
    three = [("\nsubsection Geometry", "\nset Dimension = 3\nsubsection Geometry", 1)]
    text = scene("space.msh", f"set Contact = {BOTTOM}\n"
                 "  set Fixed points = 0, -1, 0: 1, 3; 1, -1, 0: 3",
                 f"0; -({PRESSED}); 0", "top: 0.5, 1, 0.25").replace(*three[0])
    results = run(text, "space")
    check(log(results).count("held by contact alone") == 3, "three motions")
    check_uniaxial(results)
    on_planes = scene("space.msh", f"set Contact = {BOTTOM}\n"
                      f"  set Symmetry = {LEFT}, {FRONT}", f"0; -({PRESSED}); 0",
                      "top: 0.5, 1, 0.25").replace(*three[0])
    check_uniaxial(run(on_planes, "in_a_corner"))
    for n_ranks in tier((2,), (2, 3)):
        results = run_on(n_ranks, "space.prm", f"ranks_{n_ranks}")
        check_uniaxial(results)


def test_refused():
    blocks("blocks.msh")
    roles = f"set Crack = {CRACK}\n  set Symmetry = {BOTTOM}, {LEFT}"
    refused(scene("blocks.msh", roles, "0; sin(2*pi*t/600)-0.5"), 3,
            "In period 1, step ", "1 x translation along x2 of part 2 of 2",
            "no equilibrium")
    refused(scene("blocks.msh", f"set Crack = {CRACK}\n  set Symmetry = {BOTTOM}"), 3,
            "Unconstrained rigid-body motions:\n  translation along x1 of part 1 of 2 of "
            "the mesh (parts share no face)\n  translation along x1 of part 2 of 2",
            "open or close a lip by less than a thousandth")
    pressed = scene("blocks.msh", roles)
    for setting in ("Contact/Solver=active set", "Contact/Solver=projected sor",
                    "Linear solver/Type=amg"):
        refused(pressed, 2, "translation along x2 of part 2 of 2",
                "Solver = condensed active set and [Linear solver] Type = cholesky or "
                "mumps", settings=[setting])
    # The traction pulls through the pin: the moment that rounding leaves counts for
    # nothing, whatever its sign.
    refused("subsection Material\n  set Viscosity = none\nend\n", 3,
            "rotation in the plane x1-x2 about (0.5, 0)", settings=[
                "Boundary/Symmetry=none", "Boundary/Fixed points=0.5, 0",
                "Loads/Traction=0; 10"])
    refused(pressed, 2, "Elastic comparison = open",
            settings=["Output/Elastic comparison=open"])
    refused(pressed, 2, "contact alone holds the body", "Method = march",
            settings=["Periodic state/Method=fourier"])
    refused(pressed, 2, "its position is not unique", "Method = march",
            settings=["Periodic state/Method=anderson"])


def test_enclosed():
    """A square within a crack: each of its motions must be stopped. Pressed from all
    sides it has the pressure of the load; pushed along x within a crack that is wide
    along y nothing tells where it is along y."""
    def is_crack(middle, normal):
        return abs(middle[normal]) == 0.5 > abs(middle[1 - normal])
    write_block("enclosed.msh", (steps(-1, 1, 8), steps(-1, 1, 8)), is_crack)
    text = scene("enclosed.msh", f"set Crack = {CRACK}\n  set Fixed points = "
                 "-1, -1; 1, -1: 2", probes="top: 0.25, 0.25")
    text = text.replace("relaxation time\n", "none\n", 1)
    sides = ["Boundary/Loaded=1, 2, 3, 4", "Periodic state/Maximum periods=1"]

    def load(sign):
        return (f"Loads/Traction=if(x < -0.999, {sign}, if(x > 0.999, -{sign}, 0)); "
                f"if(y < -0.999, {sign}, if(y > 0.999, -{sign}, 0))")
    pressed = run(text, "enclosed", [*sides, load("3")]).table("probe_top.csv")
    check_below(max(abs(s / 3 + 1) for s in pressed["s_11"] + pressed["s_22"]), 1e-9,
                "stress of the square")
    refused(text, 3, "translation along x1 of part 2", "translation along x2 of part 2",
            "rotation in the plane x1-x2", "no load presses a lip",
            settings=[*sides, load("(-3)")])
    with open("refused.prm", "w") as file:
        file.write(plain(text))
    code, _, error = execute("refused.prm", "--output", "results/refused", "--force",
                             *overrides(["Boundary/Loaded=", "Loads/Traction=0; 0",
                                         "Boundary/Clamped=1, 2, 3, 4",
                                         "Boundary/Fixed points=none",
                                         "Loads/Body force=if(max(abs(x), abs(y)) < 0.5, "
                                         "1, 0); 0",
                                         "Boundary/Gap=if(abs(y) < 0.4999, 0, -0.01)"]))
    check(code == 3 and "motions:\n  translation along x2 of part 2 of 2" in error
          and "x1" not in error, f"{code}: {error}")


def test_pushed_in_turn():
    """A square within a crack, pushed first against one of its sides, then against
    another: in each half of the period it may slide, but both together hold it,
    however the body is turned. Pushed against one side alone it slides along it."""
    def is_crack(middle, normal):
        return abs(middle[normal]) == 0.5 > abs(middle[1 - normal])
    for degrees in (0, 30):
        write_block("turned.msh", (steps(-1, 1, 8), steps(-1, 1, 8)), is_crack,
                    turned(degrees))
        c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        x, y = f"abs({c!r}*x + {s!r}*y)", f"abs({c!r}*y - {s!r}*x)"
        text = scene("turned.msh", f"set Crack = {CRACK}\n  set Clamped = 1, 2, 3, 4\n"
                     f"  set Gap = if(min({x}, {y}) > 0.49, -0.01, -1e-5)", "0; 0",
                     "inside: 0, 0")
        for old, new in (("relaxation time\n", "none\n"), ("ratio = 0.2", "ratio = 0"),
                         (f"  set Loaded = {TOP}\n", "")):
            text = text.replace(old, new, 1)

        def push(first, then, x=x, y=y):
            return "Loads/Body force=" + "; ".join(
                f"if(max({x}, {y}) < 0.5, if(t < 300, {a!r}, {b!r}), 0)"
                for a, b in zip(first, then, strict=True))
        short = ["Periodic state/Maximum periods=1", "Time integration/Steps per period=4"]
        results = run(text, f"in_turn_{degrees}", [*short, push((c, s), (-s, c))])
        check("contact alone holds is undetermined" in log(results), "one position of many")
    refused(text, 3, "motions:\n  translation along x1 x2 of part 2 of 2",
            "no load presses a lip", settings=[*short, push((c, s), (c, s))])


test_block_on_block()
test_block_on_plane()
test_loads_that_pause()
test_in_space()
test_refused()
test_enclosed()
test_pushed_in_turn()
