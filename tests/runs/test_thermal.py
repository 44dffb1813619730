"""Thermal strain: a bar that is held and one that is free, a tensor that turns
with the body, temperatures from a table, and coefficients that depend on the
temperature."""

import math
import pathlib

from crevasse_run import check, check_below, execute, run

BAR = """
subsection Geometry
  set Shape        = rectangle
  set Subdivisions = 3, 2
end
subsection Boundary
  set Symmetry = 2, 3
end
subsection Material
  set Young modulus     = 13000
  set Poisson ratio     = 0.2
  set Relaxation time   = 60
  set Thermal expansion = 1e-5
end
subsection Loads
  set Period      = 600
  set Temperature = 100*sin(2*pi*t/600)
end
subsection Periodic state
  set Maximum periods = 2
  set Tolerance       = 0
end
subsection Output
  set Probes = left: 0, 0.5; inside: 0.4, 0.3; top: 1, 1
  set Fields = none
end
"""

PROBES = ("left", "inside", "top")
E, NU, TAU, ALPHA, THETA = 13000., 0.2, 60., 1e-5, 100.
OMEGA = 2 * math.pi / 600


def theta(t):
    return THETA * math.sin(OMEGA * t)


def heun_strain(period, steps, rate, n_periods):
    """The viscous strain at all instants by the paper's scheme."""
    r, values, dt = 0., [0.], period / steps
    for k in range(n_periods * steps):
        t = period * (k % steps) / steps
        first = rate(t, r)
        second = rate(t + 2 * dt / 3, r + 2 * dt / 3 * first)
        r += dt * (first / 4 + 3 * second / 4)
        values.append(r)
    return values


def test_held_bar():
    """s' + s/tau = -E alpha theta', from s = 0, between two rigid planes."""
    a = OMEGA * TAU / (1 + (OMEGA * TAU)**2)

    def exact(t):
        return -E * ALPHA * THETA * a * (
            math.cos(OMEGA * t) + OMEGA * TAU * math.sin(OMEGA * t)
            - math.exp(-t / TAU))

    errors = []
    for steps in (40, 80, 160, 320):
        results = run(BAR, "held_bar",
                      [f"Time integration/Steps per period={steps}"])
        r = heun_strain(600, steps,
                        lambda t, r: (-ALPHA * theta(t) - r) / TAU, 2)
        worst = error = 0.
        for probe in PROBES:
            table = results.table(f"probe_{probe}.csv")
            for k, t in enumerate(table["t"]):
                worst = max(worst, abs(table["s_22"][k] + E * (
                    ALPHA * theta(600 * (k % steps) / steps) + r[k])))
                error = max(error, abs(table["s_22"][k] - exact(t)))
            for column in ("s_11", "s_12"):
                worst = max(worst, *map(abs, table[column]))
        size = E * ALPHA * THETA
        check_below(worst / size, 1e-12, f"{steps} steps: recursion of Heun")
        errors.append(error / size)
    orders = [math.log2(x / y) for x, y in zip(errors, errors[1:])]
    print(f"held bar against the closed form: errors {errors}, "
          f"orders {orders}")
    check(errors[-1] < 1e-4 and 1.9 < orders[-1] < 2.2, "order 2")


def test_free_bar():
    """A uniform temperature strains a free body without stress, and so does one
    that is linear in place; the displacement is alpha theta x."""
    free = ["Boundary/Symmetry=2"]
    size = E * ALPHA * THETA
    for name, settings in {
            "uniform": [],
            "linear": ["Loads/Temperature=100*(x + 0.3)*sin(2*pi*t/600)",
                       "Discretisation/Degree=2"],
            "in plane strain": ["Material/Plane state=plane strain",
                                "Material/Thermal expansion=1e-5, 2e-5, 0, 0"],
            "elastic": ["Material/Viscosity=none"],
            "chain": ["Material/Viscosity=chain",
                      "Material/Chain=0.3: 60; 0.2: 200"]}.items():
        results = run(BAR, "free_bar", free + settings)
        stress = max(max(map(abs, results.table(f"probe_{probe}.csv")[column]))
                     for probe in PROBES
                     for column in ("s_11", "s_22", "s_12"))
        check_below(max(stress, results.summary["extremes"]["stress"]) / size,
                    1e-12, f"free bar, {name}: stress")
        if name == "uniform":
            top = results.table("probe_top.csv")
            check_below(max(abs(top[f"u_{d}"][k] - ALPHA * theta(t))
                            for d in (1, 2) for k, t in enumerate(top["t"]))
                        / (ALPHA * THETA), 1e-12, "free bar: u = alpha theta x")
    # In plane strain the thickness is held: s_33 relaxes as the held bar does.
    results = run(BAR, "plane_strain", free + [
        "Material/Plane state=plane strain"])
    r = heun_strain(600, 40, lambda t, r: (-ALPHA * theta(t) - r) / TAU, 2)
    table = results.table("probe_inside.csv")
    check_below(max(abs(s + E * (ALPHA * theta(600 * (k % 40) / 40) + r[k]))
                    for k, s in enumerate(table["s_33"])) / size, 1e-12,
                "free bar in plane strain: s_33")


def test_rotated_tensor():
    """The body and its expansion turned by 90 degrees; and by 45, where a free
    body shears by twice the tensor's component 12."""
    held = {"11, 22": ("Boundary/Symmetry=2, 3", "1e-5, 3e-5, 0", "s_22"),
            "22, 11": ("Boundary/Symmetry=0, 1", "3e-5, 1e-5, 0", "s_11"),
            "four": ("Boundary/Symmetry=2, 3", "1e-5, 3e-5, 7e-5, 0", "s_22")}
    columns = {}
    for name, (symmetry, tensor, column) in held.items():
        columns[name] = run(BAR, "rotated", [
            symmetry, f"Material/Thermal expansion={tensor}",
            "Boundary/Fixed points=0, 0", "Geometry/Subdivisions=3, 3",
            ]).table("probe_inside.csv")[column]
    size = max(map(abs, columns["11, 22"]))
    print(f"largest held stress {size:.6g}")
    check(0.3 < size / (E * 3e-5 * THETA) < 1, "of the component 22")
    for name in ("22, 11", "four"):
        check_below(max(abs(a - b) for a, b in
                        zip(columns["11, 22"], columns[name])) / size, 1e-12,
                    f"expansion {name}")

    # chi = Q diag(1e-5, 3e-5) Q^T at 45 degrees.
    results = run(BAR, "sheared", [
        "Boundary/Symmetry=none", "Boundary/Fixed points=0, 0; 1, 0: 2",
        "Material/Thermal expansion=2e-5, 2e-5, -1e-5"])
    check_below(results.summary["extremes"]["stress"] / (E * 3e-5 * THETA),
                1e-12, "turned by 45 degrees: stress of a free body")
    table = results.table("probe_top.csv")
    for column, expected in (("u_1", 2e-5 - 2e-5), ("u_2", 2e-5)):
        check_below(max(abs(u - expected * theta(t)) for t, u in
                        zip(table["t"], table[column])) / (3e-5 * THETA),
                    1e-12, f"turned by 45 degrees: {column}")


CRACK = BAR.replace("set Shape        = rectangle",
                    "set Shape        = edge crack").replace(
                        "set Symmetry = 2, 3", "set Symmetry = 2")


def difference(one, other):
    worst = 0.
    for probe in PROBES:
        mine, theirs = (results.table(f"probe_{probe}.csv")
                        for results in (one, other))
        for column in mine:
            size = max(max(map(abs, mine[c])) for c in mine
                       if c[0] == column[0])
            worst = max(worst, *(abs(a - b) / size for a, b in
                                 zip(mine[column], theirs[column],
                                     strict=True)))
    return worst


def converted(name):
    """The setting of the temperature that a table has."""
    status, _, error = execute("temperature", f"{name}.csv", "--output", f"{name}.h5")
    check(status == 0, error)
    return f"Loads/Temperature={name}.h5"


def test_table():
    """A table of instants and places, converted, is interpolated linearly in each:
    a formula of the same kind is matched exactly, also across the end of the
    period, where it comes back."""
    instants, places = [100 * k for k in range(6)], [0, 0.5, 1]

    def wave(t):  # goes up and down in straight lines
        return abs((t % 600) - 300) / 3

    with open("temperature.csv", "w") as file:
        file.write("t,x,y,theta\n")
        for t in instants:
            for x in places:
                for y in places:
                    value = wave(t) * (1 + 2 * x - y)
                    file.write(f"{t},{x},{y},{value!r}\n")
    formula = "abs(t - 300)/3*(1 + 2*x - y)"
    law = ["Material/Young modulus=13000 - 20*theta",
           "Loads/Traction=0; 5*sin(2*pi*t/600)",
           "Material/Relaxation time=60*exp(-theta/400)"]
    one = run(CRACK, "from_formula", law + [f"Loads/Temperature={formula}"])
    table = one.table("probe_top.csv")
    check(max(table["s_11"]) > 0.1, "the temperature strains the body")
    other = run(CRACK, "from_table", law + [converted("temperature")])
    check_below(difference(one, other), 1e-11, "table against formula")
    # One value of the table that is wrong must show.
    lines = pathlib.Path("temperature.csv").read_text().splitlines()
    lines[5] = lines[5].rsplit(",", 1)[0] + ",400"
    pathlib.Path("wrong.csv").write_text("\n".join(lines) + "\n")
    other = run(CRACK, "from_wrong_table", law + [converted("wrong")])
    check(difference(one, other) > 1e-3, "each value counts")


def test_coefficients():
    """Coefficients of a uniform temperature theta(t) are those of the t that it
    stands for, to the last digit."""
    theta_of_t = "100*sin(2*pi*t/600)"
    laws = {"Young modulus": "13000 - 40*{}",
            "Relaxation time": "60*exp(-{}/300)",
            "Poisson ratio": "0.2 + 0.0005*{}",
            "Thermal expansion": "1e-5*(1 + {}/500)"}
    load = ["Loads/Traction=0; 5*cos(2*pi*t/600)",
            f"Loads/Temperature={theta_of_t}"]
    runs = [run(CRACK, name, load + [
        f"Material/{key}={law.format(variable)}" for key, law in laws.items()])
        for name, variable in (("of_theta", "theta"),
                               ("of_t", f"({theta_of_t})"))]
    for probe in PROBES:
        name = f"probe_{probe}.csv"
        check((runs[0].directory / name).read_bytes()
              == (runs[1].directory / name).read_bytes(),
              f"theta and the formula of t differ: {name}")
    print("coefficients of theta and of t: the same digits")
    for name in laws:
        other = run(CRACK, "without_one", load + [
            f"Material/{key}={law.format('theta' if key != name else '0')}"
            for key, law in laws.items()])
        check(difference(runs[0], other) > 1e-4, f"{name} of theta counts")


if __name__ == "__main__":
    test_held_bar()
    test_free_bar()
    test_rotated_tensor()
    test_table()
    test_coefficients()
