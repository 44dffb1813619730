"""Coefficients as matrices, as formulas of place and as materials of a mesh
file; bars in series and in parallel; what is refused, and where."""

import math
import pathlib
import re

from crevasse_run import (SOURCE, check, check_below, check_close, execute, overrides,
                          plain, run, tier)

CRACK = """
subsection Geometry
  set Shape        = edge crack
  set Subdivisions = 6, 4
end
subsection Material
  set Relaxation time = 64
end
subsection Loads
  set Period   = 600
  set Traction = 0; 10*sin(2*pi*t/600) - 2
end
subsection Periodic state
  set Maximum periods = 2
  set Tolerance       = 0
end
subsection Output
  set Probes = mouth: 1, 0; inside: 0.3, 0.6; top: 0.25, 1
  set Fields = none
end
"""

TABLES = ("probe_mouth.csv", "probe_inside.csv", "probe_top.csv",
          "contact.csv")


def same_digits(one, other, what):
    for table in TABLES:
        if (one.directory / table).exists():
            check((one.directory / table).read_bytes()
                  == (other.directory / table).read_bytes(),
                  f"{what}: {table} differs")
    print(f"{what}: the same digits")


def largest_difference(one, other):
    """Of all columns of all tables, relative to the largest of its kind."""
    worst = 0.
    for table in TABLES:
        if not (one.directory / table).exists():
            continue
        mine, theirs = one.table(table), other.table(table)
        for column in mine:
            size = max(max(map(abs, mine[c])) for c in mine
                       if c[:2] == column[:2])
            if size == 0:
                continue
            worst = max(worst, *(abs(a - b) / size for a, b in
                                 zip(mine[column], theirs[column],
                                     strict=True)))
    return worst


def matrix(rows, factor=1):
    return "; ".join(", ".join(repr(factor * x) for x in row) for row in rows)


def plane_stress_matrix(modulus, ratio):
    a = modulus * ratio / (1 - ratio * ratio)
    shear = modulus / (2 * (1 + ratio))
    d = a + 2 * shear
    return [[d, a, 0], [a, d, 0], [0, 0, shear]]


def full_matrix(modulus, ratio):
    mu = modulus / (2 * (1 + ratio))
    a = 2 * mu * ratio / (1 - 2 * ratio)
    d = a + 2 * mu
    return [[d, a, a, 0], [a, d, a, 0], [a, a, d, 0], [0, 0, 0, mu]]


def test_matrices():
    """Stiffness and viscosity as matrices are those of E, nu and tau. Without
    a Poisson ratio nothing is rounded on the way, and all digits are the same;
    with one there is the rounding of inverses."""
    cases = (("plane stress", 0., plane_stress_matrix, 0.),
             ("plane strain", 0.25, full_matrix, 1e-12),
             ("plane stress", 0., full_matrix, 0.),
             ("plane strain", 0., full_matrix, 0.),
             ("plane stress", 0.25, plane_stress_matrix, 1e-12),
             ("plane stress", 0.25, full_matrix, 1e-12))
    for state, ratio, form, allowed in tier(cases[:2], cases):
        plane = [f"Material/Plane state={state}"]
        isotropic = plane + ["Material/Young modulus=16384",
                             f"Material/Poisson ratio={ratio}"]
        K = form(16384., ratio)
        by_matrix = plane + [f"Material/Stiffness matrix={matrix(K)}"]
        flow = ["Material/Viscosity=matrix",
                f"Material/Viscosity matrix={matrix(K, 64.)}"]
        one = run(CRACK, "isotropic", isotropic)
        table = one.table("probe_mouth.csv")
        check(max(table["opening"]) > 1e-4 and max(table["pressure"]) > 1,
              "the lip opens and closes")
        for which, settings in (("stiffness", by_matrix),
                                ("viscosity", isotropic + flow),
                                ("both", by_matrix + flow)):
            other = run(CRACK, "matrices", settings)
            what = f"{state}, nu = {ratio}, {len(K)} rows, {which}"
            if allowed == 0.:
                same_digits(one, other, what)
            else:
                check_below(largest_difference(one, other), allowed, what)
        if ratio == 0.:
            continue
        # Each entry counts, beside a viscosity that is not in proportion (with
        # one that is, no strain at all has K_33 of plane strain to do with).
        flow = ["Material/Viscosity=isotropic",
                "Material/Viscous modulus=16384*64",
                "Material/Viscous Poisson ratio=0.4"]
        one = run(CRACK, "flowing_otherwise", by_matrix + flow)
        for i in range(len(K)):
            for j in range(i + 1):
                changed = [list(row) for row in K]
                changed[i][j] += 200.
                changed[j][i] = changed[i][j]
                other = run(CRACK, "another_matrix", plane + flow + [
                    f"Material/Stiffness matrix={matrix(changed)}"])
                check(largest_difference(one, other) > 1e-6,
                      f"{state}: entry {i}, {j} counts")


READ = CRACK.replace("set Shape        = edge crack", """\
set Shape        = mesh file
end
subsection Boundary
  set Symmetry     = 1
  set Contact      = 2
  set Loaded       = 3
  set Fixed points = 0.5, 0: 1
end
subsection Geometry""")


def test_mesh_materials():
    """The right half of the body is another material: told by x, and by the
    physical groups of a mesh file."""
    mesh = (SOURCE / "tests/meshes/edge_crack_2.msh").read_text()
    for number in (9, 10, 11, 12):  # of another surface, too
        mesh = mesh.replace(f"\n{number} 3 2 10 1 ", f"\n{number} 3 2 20 2 ")
    pathlib.Path("two_materials.msh").write_text(mesh)

    def settings(condition):
        return [f"Material/Young modulus=if({condition}, 13000, 40000)",
                f"Material/Poisson ratio=if({condition}, 0.2, 0.35)",
                f"Material/Relaxation time=if({condition}, 60, 45)",
                f"Material/Thermal expansion=if({condition}, 1e-5, 2e-5)",
                "Loads/Temperature=20*sin(4*pi*t/600)"]

    file = ["Geometry/Mesh file=two_materials.msh", "Geometry/Refinements=1"]
    by_id = run(READ, "by_material", file + settings("material == 10"))
    by_place = run(READ, "by_place", file + settings("x < 0.5"))
    same_digits(by_id, by_place, "materials of the mesh and of formulas")
    built_in = run(CRACK, "built_in", ["Geometry/Subdivisions=8, 4"]
                   + settings("x < 0.5"))
    check_below(largest_difference(by_id, built_in), 1e-10, "built-in shape")
    uniform = run(READ, "uniform", file + settings("material > 0"))
    check(largest_difference(by_id, uniform) > 0.01, "it is two materials")


BAR = """
subsection Geometry
  set Shape        = rectangle
  set Subdivisions = 2, 2
end
subsection Material
  set Poisson ratio   = 0
end
subsection Loads
  set Period   = 600
end
subsection Periodic state
  set Maximum periods = 1
  set Tolerance       = 0
  set Secular split   = off
end
subsection Output
  set Probes = one: 0, 0.5; other: 1, 0.5; end: 0.5, 1
  set Fields = none
end
"""

E = (13000., 40000.)
TAUS = (60., 25.)


def heun(rate, r, steps, period):
    """r at all instants; the paper's scheme with weight 3/4."""
    values, dt = [r], period / steps
    for k in range(steps):
        t = period * k / steps
        first = rate(t, r)
        second = rate(t + 2 * dt / 3, r + 2 * dt / 3 * first)
        r += dt * (first / 4 + 3 * second / 4)
        values.append(r)
    return values


def moduli(variable):
    return [f"Material/Young modulus=if({variable} < 0.5, {E[0]}, {E[1]})",
            f"Material/Relaxation time=if({variable} < 0.5, {TAUS[0]}, "
            f"{TAUS[1]})"]


def test_series():
    """Two layers one above the other, under a load that is constant or
    alternates: u = sum of F/E + int F/(E tau), a quadrature of Heun's."""
    for name, formula, load, integral in (
            ("constant", "10", lambda t: 10., lambda t: 10 * t),
            ("alternating", "10*sin(2*pi*t/600)",
             lambda t: 10 * math.sin(2 * math.pi * t / 600),
             lambda t: 10 * 600 / (2 * math.pi)
             * (1 - math.cos(2 * math.pi * t / 600)))):
        errors = []
        for steps in (40, 80, 160):
            table = run(BAR, f"series_{name}", moduli("y") + [
                f"Loads/Traction=0; {formula}",
                f"Time integration/Steps per period={steps}"]
                ).table("probe_end.csv")
            # The last sample is that of t = T, the first of the next period.
            flow = heun(lambda t, r: load(t), 0., steps, 600.)
            size = max(map(abs, table["u_2"]))
            discrete = exact = 0.
            for k, t in enumerate(table["t"]):
                now = load(t % 600)
                discrete = max(discrete, abs(table["u_2"][k] - sum(
                    0.5 * (now / e + flow[k] / (e * tau))
                    for e, tau in zip(E, TAUS))))
                exact = max(exact, abs(table["u_2"][k] - sum(
                    0.5 * (now / e + integral(t) / (e * tau))
                    for e, tau in zip(E, TAUS))))
            check_below(discrete / size, 1e-12,
                        f"in series, {name}, {steps} steps: recursion")
            errors.append(exact / size)
        print(f"in series, {name}: errors {errors}")
        check(errors[-1] < 1e-12 if name == "constant" else
              2.8 < math.log2(errors[0] / errors[1]) < 3.2,
              "Radau's quadrature, of order 3")


def test_center():
    """Of two materials, a probe at the center of a cell is as good as another."""
    table = run(BAR, "center", moduli("y")[:1] + [
        "Loads/Traction=0; 10", "Material/Viscosity=none",
        "Output/Probes=center: 0.25, 0.25"]).table("probe_center.csv")
    check_close(table["s_22"][0], 10., 1e-12, "stress at a cell's center")
    check_close(table["u_2"][0], 0.25 * 10. / E[0], 1e-12, "displacement there")


def test_parallel():
    """Two columns side by side between rigid planes, stretched by a cooling
    that stays or alternates: each relaxes by itself. The probes are away from
    the interface, where the recovered stress is the mean of both sides."""
    for name, formula, theta in (
            ("step", "-100", lambda t: -100.),
            ("alternating", "-100*sin(2*pi*t/600)",
             lambda t: -100 * math.sin(2 * math.pi * t / 600))):
        errors = []
        for steps in (40, 80, 160):
            results = run(BAR, f"parallel_{name}", moduli("x") + [
                "Boundary/Symmetry=2, 3", "Material/Thermal expansion=1e-5",
                f"Loads/Temperature={formula}",
                f"Time integration/Steps per period={steps}"])
            exact_error = 0.
            for probe, e, tau in zip(("one", "other"), E, TAUS):
                table = results.table(f"probe_{probe}.csv")
                # Of the viscous strain; the total strain is zero.
                r = heun(lambda t, r: (-1e-5 * theta(t % 600) - r) / tau, 0.,
                         steps, 600.)
                size = max(map(abs, table["s_22"]))
                check_below(max(
                    abs(s - e * (-1e-5 * theta(t % 600) - r[k])) / size
                    for k, (t, s) in enumerate(zip(table["t"],
                                                   table["s_22"]))), 1e-12,
                    f"in parallel, {name}, {probe}, {steps} steps: recursion")
                exact_error = max(exact_error, max(
                    abs(s / e - relaxing(name, t, tau))
                    for t, s in zip(table["t"], table["s_22"])))
            errors.append(exact_error)
        orders = [math.log2(a / b) for a, b in zip(errors, errors[1:])]
        print(f"in parallel, {name}: errors {errors}, orders {orders}")
        check(1.8 < orders[-1] < 2.4, "order 2")


def relaxing(name, t, tau):
    """Exact mechanical strain minus viscous strain."""
    if name == "step":
        return 1e-3 * math.exp(-t / tau)
    # e' = theta' - e/tau from rest.
    w = 2 * math.pi / 600
    a = w * tau / (1 + (w * tau)**2)
    return 1e-3 * a * (math.cos(w * t) + w * tau * math.sin(w * t)
                       - math.exp(-t / tau))


REFUSED = [
    # settings, what the message names
    (["Material/Stiffness matrix=10, 1, 0; 2, 10, 0; 0, 0, 4"],
     ["Stiffness matrix", "asymmetry", "must be symmetric"]),
    (["Material/Stiffness matrix=1, 2, 0; 2, 1, 0; 0, 0, 4"],
     ["Stiffness matrix", "must be positive definite"]),
    (["Material/Stiffness matrix=1, 2; 2, 1"],
     ["Stiffness matrix", "must have 3 (11, 22, 12) or 4", "it has 2"]),
    (["Material/Stiffness matrix=1, 0, 0; 0, 1, 0; 0, 1"],
     ["Stiffness matrix", "must have 3 entries"]),
    (["Material/Stiffness matrix=10, x, 0; 0, 10, 0; 0, 0, 4"],
     ["Stiffness matrix", "must be symmetric", "at ("]),
    (["Material/Viscosity=matrix",
      "Material/Viscosity matrix=1, 2, 0; 2, 1, 0; 0, 0, 4"],
     ["Viscosity matrix", "must be positive definite"]),
    (["Material/Viscosity=matrix",
      "Material/Viscosity matrix=10, 1, 0; 2, 10, 0; 0, 0, 4"],
     ["Viscosity matrix", "must be symmetric"]),
    (["Material/Young modulus=0.5 - x"],
     ["Young modulus = 0.5 - x: is -0.0", "at (0.5", "must be greater than 0"]),
    (["Material/Young modulus=2 - y - 2*t/600"],
     ["Young modulus", "t = 3", "must be greater than 0"]),
    (["Material/Relaxation time=if(x < 0.2 && t >= 300, -5, 60)"],
     ["Relaxation time", "is -5", "t = 300"]),
    (["Material/Poisson ratio=0.3 + 0.3*x"],
     ["Poisson ratio", "at (0.7", "less than 0.5"]),
    (["Material/Young modulus=13000 - 200*theta", "Loads/Temperature=100*y"],
     ["Young modulus", "(theta = ", "must be greater than 0"]),
    (["Material/Stiffness time factor=sin(2*pi*t/600)"],
     ["Stiffness time factor", "at t = ", "must be greater than 0"]),
    (["Material/Viscosity time factor=0"],
     ["Viscosity time factor", "must be greater than 0"]),
    (["Material/Viscosity time factor=1 + x"],
     ["Viscosity time factor", '"x"', "Known names: t, pi"]),
    (["Material/Stiffness time factor=1 +* t"], ["Stiffness time factor"]),
    (["Material/Thermal expansion=1, 2"],
     ["Thermal expansion", "must have 1, 3 or 4 components"]),
]


def test_refusals():
    pathlib.Path("refused.prm").write_text(plain(CRACK))
    for settings, parts in REFUSED:
        arguments = ["--check", "refused.prm"]
        for setting in settings:
            arguments += ["--set", setting]
        status, _, error = execute(*arguments)
        print(error.strip())
        check(status == 2, f"{settings}: exit status {status}")
        for part in parts:
            check(part in error, f"{settings}: no \"{part}\" in\n{error}")


def test_refusals_between_steps():
    """However a scheme comes upon a value that no material has, between the instants
    that are looked at before, too."""
    scene = pathlib.Path("between.prm")
    scene.write_text(plain(CRACK))
    adaptive = ["Time integration/Step control=adaptive",
                "Time integration/Relative tolerance=1e-4"]
    tau = "Relaxation time=if(t>150.5 && t<157, {}, 300)".format
    for setting, *others in (
            (tau(-300), "Time integration/Scheme=heun", *adaptive),
            (tau(-300), "Time integration/Scheme=exponential", *adaptive),
            (tau(-300), "Time integration/Scheme=rk4",
             "Loads/Traction=0; 10*min(1, max(-1, (t-153.5)/2))",
             "Time integration/Locate contact events=true"),
            ("Poisson ratio=if(t>150.5 && t<157, 0.6, 0.2)",
             "Time integration/Scheme=heun", *adaptive),
            ("Viscosity time factor=if(t>150.5 && t<157, -1, 1)",
             "Time integration/Scheme=heun", *adaptive)):
        status, _, error = execute(
            scene, "--output", "results/between", "--force", *overrides(
                ["Output/Fields=none", "Periodic state/Maximum periods=2",
                 f"Material/{setting}", *others]))
        print(error.strip())
        t = re.search(r"t = ([\d.]+)", error)
        check(status == 2 and t and 150.5 < float(t[1]) < 157
              and f"[Material] {setting.replace('=', ' = ', 1)}: is " in error,
              f"{setting}, {others}: {status} {error}")


def test_stability():
    """The smallest relaxation time, wherever and whenever it is, bounds the
    step: 15 for the body, 2 x 15 for a step, that is more than 20 steps."""
    for what, settings in {
            "at some place": ["Relaxation time=if(x < 0.1, 15, 60)"],
            "for some time": ["Relaxation time=if(t < 300, 60, 15)"],
            "stiffness factor": ["Stiffness time factor=if(t < 300, 1, 4)",
                                 "Relaxation time=60"],
            "viscosity factor": ["Viscosity time factor=if(t < 300, 1, 1/4)",
                                 "Relaxation time=60"],
            "both factors": ["Viscosity time factor=if(t < 300, 4, 1/4)",
                             "Stiffness time factor=if(t < 300, 4, 1)",
                             "Relaxation time=60"],
            "stiffness": ["Young modulus=13000*if(x < 0.1 && t > 300, 4, 1)",
                          "Poisson ratio=0.3",
                          "Viscosity=isotropic", "Viscous modulus=13000*60",
                          "Viscous Poisson ratio=0.3"],
            "chain": ["Viscosity=chain", "Chain=0.1: 15; 0.2: 100"],
            "temperature": ["Relaxation time=60 - theta"]}.items():
        sets = ["--set", "Loads/Temperature=45*max(0, sin(2*pi*t/600))"]
        for setting in settings:
            sets += ["--set", "Material/" + setting]
        for steps, expected in ((20, 3), (21, 0)):
            status, output, error = execute(
                "--check", "refused.prm", *sets, "--set",
                f"Time integration/Steps per period={steps}")
            print(f"{what}, {steps} steps: status {status} {error.strip()}")
            check(status == expected, what)
            if expected == 3:
                check("smallest relaxation time 15," in error
                      and "at least 21 steps" in error, error)


if __name__ == "__main__":
    test_matrices()
    test_mesh_materials()
    test_series()
    test_center()
    test_parallel()
    test_refusals()
    test_refusals_between_steps()
    test_stability()
