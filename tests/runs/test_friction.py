"""Coulomb's friction between lips, against closed forms of a crack in an infinite body
(cracks are small in these plates; ratios do not depend on the plate) and by what must
not change it."""

import math

import cracked
from crevasse_run import (SOURCE, check, check_below, check_close, execute, execute_on, full,
                          overrides, run, run_on, tier)

HALF = 8.  # of the side of the plate; that of the crack is 1
N = 12     # cells along half a crack
E = 1 / (1 - 0.3 ** 2)  # modulus of plane strain


def grid(n):
    """Lines: n equal cells along half of the crack, growing ones beyond."""
    positions = cracked.steps(0, 1, n) + [1 + 1 / n, 1 + 2.5 / n]
    while positions[-1] < HALF:
        positions.append(min(HALF, positions[-1] + 1.5 * (positions[-1] - positions[-2])))
    return [-x for x in positions[:0:-1]] + positions


def scene(name, pressure, shear, settings="", turn=0., viscosity="none", n=N, below=None):
    """A plate with a crack along x, all turned, whose stress without the crack is the
    pressure across it and the shear along it, formulas of t; with other cells below."""
    place = cracked.turned(turn)
    rows = [y for y in grid(below or n) if y < 0.] + [y for y in grid(n) if y >= 0.]
    cracked.write_block(
        f"{name}.msh", (grid(n), rows),
        lambda middle, normal: normal == 1 and middle[1] == 0 and abs(middle[0]) < 1,
        place)
    c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
    x, y = f"({c!r}*x + {s!r}*y)", f"({c!r}*y - {s!r}*x)"
    across = f"(abs({y}) > abs({x}))"
    t_x = f"if({across}, ({shear})*sign({y}), 0)"
    t_y = f"if({across}, -({pressure})*sign({y}), ({shear})*sign({x}))"
    traction = f"{c!r}*{t_x} - {s!r}*{t_y}; {s!r}*{t_x} + {c!r}*{t_y}"
    held = "; ".join("{!r}, {!r}: {}".format(*place((x, 0.)), which)
                     for x, which in ((-HALF, 2), (HALF, "1, 2")))
    if turn:  # components along x and y do not hold a turned plate alike
        held = "; ".join("{!r}, {!r}: {}".format(*place((x, 0.)), which)
                         for x, which in ((-HALF, "1, 2"), (HALF, 2)))
    return f"""
subsection Geometry
  set Shape     = mesh file
  set Mesh file = {name}.msh
end
subsection Boundary
  set Crack        = {cracked.CRACK}
  set Loaded       = {cracked.LEFT}, {cracked.RIGHT}, {cracked.BOTTOM}, {cracked.TOP}
  set Fixed points = {held}
end
subsection Material
  set Plane state   = plane strain
  set Young modulus = 1
  set Poisson ratio = 0.3
  set Viscosity     = {viscosity}
end
subsection Loads
  set Period   = 1
  set Traction = {traction}
end
subsection Crack tip
  set Stress intensity = true
end
subsection Output
  set Fields = none
end
{settings}
"""


def friction(mu):
    return f"Boundary/Friction coefficient={mu}"


def sliding(results, tip=1):
    """K_II at the samples of the last period."""
    return results.table(f"crack_tip_{tip}.csv")["K_II"]


def test_shielding():
    """K_II(mu) = K_II(0) (1 - mu p/tau), however the plate is turned or scaled."""
    # The squares of K_II end where cells do, but for rounding.
    square = "subsection Crack tip\n  set Radius = 0.5\nend"
    free = run(scene("shield", "sin(pi*t)^2", "0.8*sin(pi*t)^2", square), "shield")
    reference = [max(sliding(free, tip)) for tip in (1, 2)]
    check_below(abs(reference[0] / reference[1] - 1), 1e-9, "halves alike")
    for mu in (0.2, 0.5):
        held = run("shield.prm", f"shield_{mu}", [friction(mu)])
        for tip in (1, 2):
            check_close(max(sliding(held, tip)) / reference[tip - 1], 1 - mu / 0.8, 1e-9,
                        f"K_II of tip {tip} with mu {mu}")
        check_below(held.summary["certificate"]["friction"], 1e-12, "certificate of friction")
        check(held.summary["friction"]["kind"] == "alternating slip",
              held.summary["friction"])
    stuck = run("shield.prm", "shield_stuck", [friction(0.9)])
    check_below(max(sliding(stuck)) / reference[0], 1e-9, "K_II where it sticks")
    check(stuck.summary["friction"]["kind"] == "shakedown", stuck.summary["friction"])
    free = run(scene("shield_turned", "sin(pi*t)^2", "0.8*sin(pi*t)^2", square, turn=31.),
               "shield_turned")
    check_close(max(sliding(free)) / reference[0], 1, 1e-10, "K_II of the turned plate")
    turned = run("shield_turned.prm", "shield_turned_held", [friction(0.5)])
    check_close(max(sliding(turned)) / max(sliding(free)), 0.375, 1e-9, "K_II, turned")
    two = run_on(2, "shield.prm", "shield_two", [friction(0.5)])
    check_close(max(sliding(two)) / reference[0], 0.375, 1e-9, "K_II on two processes")


def test_other_cells_below():
    """The pressure in the cells at the tips is wrong, K_II and K_I are not."""
    tips = "subsection Refinement\n  set Strategy = tip\n  set Cycles = {}\nend"
    for cycles in tier((3,), (1, 3, 8)):
        free = run(scene("other", "sin(pi*t)^2", "0.8*sin(pi*t)^2", tips.format(cycles),
                         below=N // 3), "other")
        held = run("other.prm", "other_held", [friction(0.5)])
        for tip in (1, 2):
            exact = 0.375 * max(sliding(free, tip))
            error = abs(max(sliding(held, tip)) - exact)
            found = held.summary["crack_tips"][tip - 1]
            print(f"{cycles}: {error / exact}, printed {found['K_II_error'] / exact}")
            check_below(error / exact, 1.5e-2, f"K_II of tip {tip} with {cycles} cycles")
            check_below(error, 2 * found["K_II_error"], "printed error of K_II")
            check_below(-found["K_I"]["smallest"] / exact, 2e-2, "K_I of a closed tip")


@full
def test_coefficients_by_crack():
    """Coefficients by boundary are those of a formula of the place; a node where two
    boundaries meet has the first one."""
    text = scene("by_crack", "sin(pi*t)^2", "0.8*sin(pi*t)^2")
    cracked.write_block(
        "by_crack.msh", (grid(N), grid(N)),
        lambda middle, normal: (normal == 1 and middle[1] == 0 and abs(middle[0]) < 1
                                and (cracked.CRACK if middle[0] < 0 else 8)))
    crack = f"Boundary/Crack={cracked.CRACK}, 8"
    one = run(text, "by_crack", [crack, friction("7: 0.2 | 8: 0.5 + 0*t")])
    other = run("by_crack.prm", "by_place", [crack, friction("if(x < 1e-9, 0.2, 0.5)")])
    half = run("by_crack.prm", "on_one", [crack, friction("8: 0.5")])
    none = run("by_crack.prm", "elsewhere_0", [crack, friction("8: 0.5 | 7: 0")])
    size = max(map(abs, sliding(one)))
    for a, b, what in ((one, other, "by place"), (half, none, "0 where none is given")):
        check_below(max(abs(x - y) for tip in (1, 2) for x, y in
                        zip(sliding(a, tip), sliding(b, tip), strict=True)) / size, 1e-13,
                    f"coefficients {what}")
    check(max(map(abs, sliding(half))) > 1.05 * size, "7 bears no friction")
    for mu, message in (("9: 0.3", "the boundary id 9 must have the role Crack or Contact"),
                        ("7: 0.3 | 7: 0.2", "must have one value only"),
                        ("7: 0.3 | 0.2", "must begin with its boundaries"),
                        ("7: -0.3 | 8: 0.2", "must be at least 0")):
        status, _, error = execute("by_crack.prm", "--output", "results/refused",
                                   *overrides([crack, friction(mu)]))
        check(status == 2 and message in error, f"{mu}: {status}, {error}")


def test_negative_on_one_rank():
    """A coefficient that is negative on one rank, at some instant, ends all ranks."""
    mu = "if(x > 0.9, 0.4 - t, 0.3)"
    status, _, error = execute_on(2, "shield.prm", "--output", "results/negative",
                                  *overrides([friction(mu)]))
    check(status == 2 and "must be at least 0" in error, f"{status}: {error}")


def test_no_friction():
    """A coefficient that is 0 here and now is the run without friction."""
    text = scene("none", "1 - 2*sin(2*pi*t)", "0.8*cos(2*pi*t)")
    free = run(text, "none")
    zero = run("none.prm", "zero", [friction("0*x")])
    size = max(map(abs, sliding(free)))
    for column in ("K_I", "K_II"):
        # Friction takes a second period to know that nothing is remembered.
        a, b = (r.table("crack_tip_1.csv")[column][-41:] for r in (free, zero))
        check_below(max(abs(x - y) for x, y in zip(a, b, strict=True)) / size, 1e-11,
                    f"difference of {column}")


@full
def test_pulsating_compression():
    """Under a uniaxial pressure S(t), slip is reversed at a fraction of its largest
    value, and a period dissipates a known work."""
    psi, mu = math.radians(50), 0.3
    s, c = math.sin(psi), math.cos(psi)
    load = "sin(pi*t)^2"
    n = 400
    results = run(
        scene("pulse", f"{s * s!r}*{load}", f"{s * c!r}*{load}"), "pulse",
        [friction(mu), f"Time integration/Steps per period={n}",
         "Discretisation/Degree=2"])
    free = run("pulse.prm", "pulse_free", ["Time integration/Steps per period=4",
                                           "Discretisation/Degree=2"])
    unit = max(sliding(free)) / (s * c)
    K = [k / unit for k in sliding(results)[-n - 1:]]
    check_close(max(K), s * c - mu * s * s, 1e-9, "largest K_II")
    turn = min(math.sin(math.pi * i / n) ** 2 for i in range(n // 2, n)
               if abs(K[i] - max(K)) < 1e-9)
    check_close(turn, (c - mu * s) / (c + mu * s), 7e-3, "load at which it slips back")
    # The work is proportional to the slip, whose ratio to that of the infinite body
    # is that of the slips without friction.
    work = results.summary["friction"]["dissipation"]
    table = results.table("friction.csv")
    largest = max(table["slip"])
    mesh = largest / (4 / E * (s * c - mu * s * s))
    exact = (math.pi / E * mu * s * s * (s * c - mu * s * s) * 2 * c / (c + mu * s))
    check_close(work / mesh, exact, 7e-3, "work of a period")


def test_partial_slip():
    """mu = 0 for |x| < c: slip spreads to c/cos(pi tau/2 mu p)."""
    n = tier(N, 4 * N)
    c = (round(0.35 * n) + 0.5) / n  # between two pairs
    for ratio in (0.3, 0.5):
        text = scene(f"partial_{ratio}", "1", f"{ratio}*sin(2*pi*t)",
                     "subsection Time integration\n  set Steps per period = 4\nend\n",
                     n=n)
        results = run(text, f"partial_{ratio}",
                      [friction(f"if(abs(x) < {c!r}, 0, 1)")])
        table = results.table("friction.csv")
        slip = {round(x, 9): q for t, x, q in zip(table["t"], table["x"], table["slip"],
                                                  strict=True) if t == 0.25}
        first = [x for t, x in zip(table["t"], table["x"], strict=True) if t == 0.]
        check(first == sorted(first), "rows follow the lip")
        theta = math.pi * ratio / 2
        exact = 8 * c / (math.pi * E) * math.atanh(math.sin(theta))
        check_close(slip[0.] / exact, 1., tier(2e-2, 5e-3), f"slip in the middle, {ratio}")
        moved = max(x for x, q in slip.items() if abs(q) > 1e-9)
        check_below(abs(moved + 0.5 / n - c / math.cos(theta)), 1.01 / n,
                    f"end of the slip, {ratio}")


def test_fretting():
    """The shipped scene of partial slip, against Hertz, Cattaneo and Mindlin: forces that
    are the sums of its tractions give the largest pressure and the zone that sticks."""
    results = run(SOURCE / "prm/fretting.prm", "fretting", ["Output/Fields=none"])
    table = results.table("friction.csv")
    x, p, q = ([value for t, value in zip(table["t"], table[name], strict=True)
                if abs(t - 0.25) < 1e-9]
               for name in ("x", "normal_pressure", "tangential_traction"))
    width = [(x[min(i + 1, len(x) - 1)] - x[max(i - 1, 0)]) / 2 for i in range(len(x))]
    P, Q = (sum(map(math.prod, zip(width, values, strict=True))) for values in (p, q))
    modulus, radius, mu = 210000 / (2 * (1 - 0.3 ** 2)), 50, 0.5
    a = math.sqrt(4 * P * radius / (math.pi * modulus))
    check_close(max(p) / (2 * P / (math.pi * a)), 1, 2e-2, "largest pressure")
    sticks = [abs(place) for place, pressure, shear in zip(x, p, q, strict=True)
              if pressure > 1e-6 * max(p) and abs(shear) < mu * pressure * (1 - 1e-9)]
    check_close(max(sticks) / a, math.sqrt(1 - abs(Q) / (mu * P)), 0.02 / a,
                "half width of the zone that sticks")
    check(results.summary["friction"]["kind"] == "alternating slip",
          results.summary["friction"])


def test_memory():
    """Under a constant shear and a pressure that swings, the slip at the least
    pressure stays for good."""
    text = scene("memory", "1 + 0.4*sin(2*pi*t)", "0.8")
    results = run(text, "memory", [friction(0.5)])
    free = run("memory.prm", "memory_free")
    check_close(sliding(results)[-1] / sliding(free)[-1], 1 - 0.5 * 0.6 / 0.8, 1e-9,
                "K_II for good")
    check(results.summary["friction"]["kind"] == "shakedown",
          results.summary["friction"])


def test_stop():
    """A march ends when both the stress and the net slip of a period repeat: not with the
    stress alone, and also where the lips ratchet."""
    settings = """
subsection Time integration
  set Scheme           = sdirk2
  set Steps per period = 20
end
subsection Periodic state
  set Maximum periods = 40
  set Tolerance       = 1e-2
end
"""
    slow = run(scene("slow_slip", "1 + 0.5*sin(2*pi*t) + 0.4*x", "0.5*cos(2*pi*t) + 0.2",
                     settings, viscosity="chain\n  set Chain = 0.7: 0.6", n=5),
               "slow_slip", [friction(0.4)])
    estimates = slow.table("periods.csv")["stress_error_estimate"]
    stress = next(k for k, error in enumerate(estimates, 1) if error <= 1e-2)
    print(f"stress within the tolerance after {stress} periods, slip after {len(estimates)}")
    check(slow.summary["converged"] and stress + 2 <= len(estimates), "slip is periodic")
    more = run("slow_slip.prm", "slow_slip_more", [
        friction(0.4), "Periodic state/Tolerance=0", "Periodic state/Maximum periods=22"])
    slips = [found.summary["friction"]["net_slip"] for found in (slow, more)]
    check_below(abs(slips[0] - slips[1]) / more.summary["friction"]["largest_slip_range"], 1e-2,
                "error of the slip")
    ratchets = run(scene("ratchet", "1 + 0.4*sin(2*pi*t)", "0.8", settings,
                         viscosity="chain\n  set Chain = 1: 0.5", n=5),
                   "ratchet", [friction(0.5)])
    found = ratchets.summary["friction"]
    check(ratchets.summary["converged"] and found["kind"] == "ratchetting", found)
    check_close(found["net_slip"] / found["largest_slip_range"], 1, 1e-6, "net slip")
    log = (ratchets.directory / "log.txt").read_text()
    check("each period leaves a slip of up to" in log, "the log has the rate")


def test_relaxation():
    """Stuck slip relaxes with the body, by half of its stiffness or all of it, until
    the shear that is left moves it again."""
    for part in (0.5, 1.):
        steps = ", ".join(repr(2e-9 + 0.01 * i) for i in range(201))
        text = scene(f"relax_{part}", "1", "if(t < 1e-9, 1.2, 0.9)", f"""
subsection Time integration
  set Scheme       = rk4
  set Step control = list
  set Steps        = 0, {steps}
end
subsection Periodic state
  set Maximum periods = 1
  set Tolerance       = 0
end
""", viscosity=f"chain\n  set Chain = {part}: 1")
        results = run(text, f"relax_{part}", [friction(0.5), "Loads/Period=2.000000002"])
        table = results.table("crack_tip_1.csv")
        K = dict(zip((round(t, 3) for t in table["t"]), table["K_II"], strict=True))
        check_close(K[0.25] / K[0.], 1 - part + part * math.exp(-0.25), 1e-8,
                    f"stuck K_II of a body that relaxes by {part}")
        if part == 1.:
            check_close(table["K_II"][-2] / K[0.], 0.4 / 0.7, 1e-8, "K_II in the end")
            slides = min(t for t, k in zip(table["t"], table["K_II"], strict=True)
                         if abs(k / K[0.] - 0.4 / 0.7) < 1e-8)
            check_close(slides, -math.log(0.4 / 0.7), 0.01, "instant at which it slides")


def test_jump():
    """A coefficient that jumps acts from its instant on, not within the step before: as
    one that jumps just after the step."""
    text = scene("jump", "1", "0.8*sin(2*pi*t)", """
subsection Periodic state
  set Maximum periods = 2
  set Tolerance       = 0
end
""", viscosity="chain\n  set Chain = 0.7: 0.3", n=5)
    at, after = (run(text, f"jump_{k}", [friction(f"if(t<0.5{k},0.2,0.7)"),
                                         "Time integration/Steps per period=20"])
                 for k in ("", "+1e-9"))
    K = [dict(zip((round(t, 6) for t in results.table("crack_tip_1.csv")["t"]),
                  sliding(results), strict=True)) for results in (at, after)]
    check_close(K[0][1.55], K[1][1.55], 1e-6, "K_II after the jump")


# Pressures that vary along the crack, so that pairs slide and open one by one, but for one.
ORDERS = {"pressed": ("1 + 0.5*sin(2*pi*t) + 0.4*x", "0.5*cos(2*pi*t)"),
          "opening": ("0.4 + sin(2*pi*t) + 0.4*x", "0.5*cos(2*pi*t)"),
          "closing": ("1.4*sin(2*pi*t) - 0.5 - 0.3*x", "0.5*sin(4*pi*t)"),
          "wandering": ("0.5 + 0.8*sin(2*pi*t) - 0.4*x", "0.4*sin(2*pi*t + 1) + 0.3"),
          "uniform": ("1 + 0.5*sin(2*pi*t)", "0.5*cos(2*pi*t)")}


@full
def test_order():
    """With its events located, the error of displacements over a period falls with the
    square of the steps, nearly. K depends on few pairs next to the tip, of which some slide
    in one run and stick in another; it does not jump."""
    for name, loads in ORDERS.items():
        text = scene(f"order_{name}", *loads, """
subsection Periodic state
  set Maximum periods = 1
  set Tolerance       = 0
end
""", viscosity="chain\n  set Chain = 0.7: 0.3")
        errors = {}
        for events in ("true",) if name in ("wandering", "uniform") else ("true", "false"):
            found = []
            for n in (20, 40, 80, 160, 640):
                results = run(text, f"order_{name}_{events}_{n}", [
                    friction(0.4), f"Time integration/Steps per period={n}",
                    f"Time integration/Locate contact events={events}",
                    "Output/Probes=beside: 0.5, 0.5"])
                found.append([[row for key in keys for row in
                               results.table(table)[key][::n // 20]] for table, keys in (
                                   ("probe_beside.csv", ("u_1", "u_2")),
                                   ("crack_tip_1.csv", ("K_I", "K_II")))])
            errors[events], of_K = ([max(abs(x - y) for x, y in zip(
                f[k], found[-1][k], strict=True)) for f in found[:-1]] for k in (0, 1))
            print(f"{name}, events {events}: errors of K {of_K}")
            if events == "true":
                check_below(of_K[-1], 5e-4, f"{name}: error of K")
        order = {events: math.log2(found[0] / found[-1]) / 3
                 for events, found in errors.items()}
        print(f"{name}: errors {errors}, orders {order}")
        check(order["true"] >= 1.7, f"{name}: order {order}")


def test_rigid_plane():
    """SSNV128: a square that a pressure holds on a rigid plane, pushed from the side;
    the displacement along the plane at five places."""
    n = tier(16, 64)
    cracked.write_block("ssnv128.msh", (cracked.steps(0, 0.04, n),) * 2,
                        lambda *_: False)
    text = f"""
subsection Geometry
  set Shape     = mesh file
  set Mesh file = ssnv128.msh
end
subsection Boundary
  set Contact  = {cracked.BOTTOM}
  set Symmetry = {cracked.RIGHT}
  set Loaded   = {cracked.LEFT}, {cracked.TOP}
  set Friction coefficient = 1
end
subsection Discretisation
  set Degree = 2
end
subsection Material
  set Plane state   = plane strain
  set Young modulus = 1.3e11
  set Poisson ratio = 0.2
  set Viscosity     = none
end
subsection Loads
  set Period   = 1
  set Traction = if(x < 1e-9, 15e7*t/0.8, 0); if(x < 1e-9, 0, -5e7*t/0.8)
end
subsection Periodic state
  set Maximum periods = 1
  set Tolerance = 0
end
subsection Output
  set Fields = none
  set Probes =
end
"""
    results = run(text, "ssnv128", ["Time integration/Steps per period=5"])
    table = results.table("friction.csv")
    slip = sorted((x, abs(q) * 1e6) for t, x, q in
                  zip(table["t"], table["x"], table["slip"], strict=True)
                  if abs(t - 0.8) < 1e-9)
    for x, expected in ((0., 28.60), (0.00125, 27.23), (0.005, 22.87), (0.0075, 19.81),
                        (0.01125, 15.41)):
        found = next(q for place, q in slip if abs(place - x) < 1e-9)
        check_close(found, expected, 1e-2 * expected, f"displacement at {x}")


def test_refused():
    """What friction does not go with, each in a sentence."""
    for settings, message in (
            (["Periodic state/Method=anderson"], "must be march or automatic"),
            (["Time integration/Scheme=arkode explicit"], "must not be one of ARKODE"),
            (["Refinement/Strategy=adaptive"], "must not be adaptive"),
            (["Linear solver/Type=amg"], "needs a factorisation"),
            (["Contact/Solver=active set"], "is for contact without friction"),
            (["Discretisation/Singular functions=1"], "slide on the lips"),
            (["Crack tip/Method=williams fit"], "for lips without shear"),
            (["Crack tip/Creep integral=true"], "does not include"),
            (["Boundary/Friction coefficient=x"], "must be at least 0"),
            (["Boundary/Friction coefficient=0.3+0.01*theta"], "without [Loads] Temp")):
        status, _, error = execute(
            "shield.prm", "--output", "results/refused",
            *overrides([friction(0.5), "Material/Viscosity=chain", "Material/Chain=0.5: 1",
                        *settings]))
        check(status == 2 and message in error, f"{settings}: {status}, {error}")


for test in (test_shielding, test_other_cells_below, test_coefficients_by_crack,
             test_negative_on_one_rank,
             test_no_friction, test_pulsating_compression, test_partial_slip,
             test_fretting, test_memory, test_stop, test_relaxation, test_jump, test_order,
             test_rigid_plane, test_refused):
    test()
