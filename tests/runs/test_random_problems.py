"""Whole random problems, drawn from fixed seeds, by harmonic balance: piecewise
moduli, anisotropic viscosities, relaxation times from a thirtieth to thirty
periods, loads of several harmonics with compressive or mixed means. All are
solved, and certified."""

import random
import re

from crevasse_run import check, check_below
from periodic_scenes import FOURIER, compute, log

SCENE = """
subsection Geometry
  set Shape = edge crack
end
subsection Loads
  set Period = 600
end
subsection Output
  set Fields = none
end
"""
PERIOD = 600.
N_PROBLEMS = 200
CERTIFICATE = ("penetration", "tension", "complementarity",
               "defect of the mean")


def isotropic(modulus, ratio):
    """Of plane stress."""
    factor = modulus / (1 - ratio * ratio)
    return [[factor, factor * ratio, 0], [factor * ratio, factor, 0],
            [0, 0, factor * (1 - ratio) / 2]]


def anisotropic(draw):
    """Symmetric and positive definite: L diag(d) Lt, with d from 0.3 to 3."""
    d = [10**draw.uniform(-0.5, 0.5) for _ in range(3)]
    a, b, c = (draw.uniform(-0.6, 0.6) for _ in range(3))
    L = [[1, 0, 0], [a, 1, 0], [b, c, 1]]
    return [[sum(L[i][k] * d[k] * L[j][k] for k in range(3))
             for j in range(3)] for i in range(3)]


def relaxation_time(draw):
    return PERIOD * 10**draw.uniform(-1.5, 1.5)


def piecewise(place, left, right):
    return f"if({place}, {left!r}, {right!r})"


def material(draw):
    where = draw.choice(["x", "y"])
    place = f"{where} < {draw.uniform(0.2, 0.9)!r}"
    moduli = [13000 * 10**draw.uniform(-0.5, 0.5) for _ in range(2)]
    ratio = draw.uniform(0, 0.45)
    settings = ["Material/Young modulus=" + piecewise(place, *moduli),
                f"Material/Poisson ratio={ratio!r}"]
    kind = draw.choice(["relaxation time", "isotropic", "matrix", "matrix"])
    times = [relaxation_time(draw) for _ in range(2)]
    settings.append(f"Material/Viscosity={kind}")
    if kind == "relaxation time":
        settings.append("Material/Relaxation time=" + piecewise(place, *times))
    elif kind == "isotropic":
        viscosities = [E * tau for E, tau in zip(moduli, times)]
        settings += ["Material/Viscous modulus=" + piecewise(place,
                                                             *viscosities),
                     f"Material/Viscous Poisson ratio={draw.uniform(0, 0.5)!r}"]
    else:
        sides = [[[E * tau * x for x in row] for row in anisotropic(draw)]
                 for E, tau in zip(moduli, times)]
        rows = [[piecewise(place, sides[0][max(i, j)][min(i, j)],
                           sides[1][max(i, j)][min(i, j)])
                 for j in range(3)] for i in range(3)]
        settings.append("Material/Viscosity matrix="
                        + "; ".join(", ".join(row) for row in rows))
    return settings


def loads(draw):
    components = []
    for _ in range(2):
        waves = [f"{draw.uniform(-8, 8)!r}*(1 + {draw.uniform(-1, 1)!r}*x)"
                 f"*cos({n}*2*pi*t/600 + {draw.uniform(0, 6.3)!r})"
                 for n in draw.sample(range(1, 5), draw.randint(1, 4))]
        components.append("+".join(waves).replace("+-", "-"))
    mean = draw.choice([
        repr(-10**draw.uniform(-1, 1)),
        f"if(x < 0.75, {draw.uniform(-15, 15)!r}, {draw.uniform(-15, 15)!r})"])
    components[0] = f"0.3*({components[0]})"
    components[1] += f" + {mean}"
    return ["Loads/Traction=" + "; ".join(components)]


def problem(seed):
    draw = random.Random(seed)
    settings = [f"Geometry/Subdivisions={draw.choice(['6, 3', '8, 4'])}",
                f"Time integration/Steps per period={draw.randint(8, 48)}",
                f"Discretisation/Degree={draw.choice([1, 1, 1, 2])}",
                "Output/Probes="] + material(draw) + loads(draw)
    if draw.random() < 0.2:
        settings.append(f"Boundary/Gap={-10**draw.uniform(-5, -3)!r}*x")
    if draw.random() < 0.2:
        settings.append("Contact/Solver=automatic")
    return settings


def solve(seed):
    """The log, or None where the program failed."""
    try:
        return log(compute(f"problem_{seed}", problem(seed) + FOURIER, SCENE))
    except AssertionError as failure:
        print(failure)
        print("settings:", *(f"--set '{s}'" for s in problem(seed) + FOURIER))
        return None


def test_random_problems():
    logs = [solve(seed) for seed in range(N_PROBLEMS)]
    worst = {name: (0., None) for name in CERTIFICATE + ("states",)}
    n_contact = n_proximal = n_warned = 0
    for seed, text in enumerate(logs):
        if text is None:
            continue
        numbers = {"states": re.search(r"periodic ones by (\S+)", text)[1]}
        line = re.search(r"periodic contact at \d+ nodes: .*", text)
        if line:
            n_contact += 1
            n_proximal += "after proximal points" in line[0]
            if "certificate" in line[0]:
                numbers.update((name, re.search(name + r" ([^\s,]+)",
                                                line[0])[1])
                               for name in CERTIFICATE)
        n_warned += "not resolved" in text
        for name, number in numbers.items():
            worst[name] = max(worst[name], (abs(float(number)), seed),
                              key=lambda pair: pair[0])
    failed = [seed for seed, text in enumerate(logs) if text is None]
    print(f"{N_PROBLEMS} problems: {len(failed)} failed, {n_contact} with "
          f"contact, {n_proximal} of them by proximal points, "
          f"{n_warned} warned of what is not resolved")
    for name, (number, seed) in worst.items():
        print(f"worst {name}: {number:.1e} in problem {seed}")
    check(not failed, f"failed: {failed}")
    check(n_contact > N_PROBLEMS / 2, "most have contact")
    for name, (number, _) in worst.items():
        check_below(number, 1e-9, name)


if __name__ == "__main__":
    test_random_problems()
