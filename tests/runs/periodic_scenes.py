"""Periodic problems on the mesh of the paper, a random family of others, and how
far two runs are apart over their last periods."""

import math
import random

from crevasse_run import SOURCE, run

BODY = SOURCE / "prm/raous1980_body.prm"
PERIOD = 600.
LIP = ("mouth", "inside", "near")
PROBES = LIP + ("top", "body")
COMMON = ["Contact/Solver=condensed active set", "Contact/Tolerance=1e-14",
          "Output/Fields=none",
          "Output/Probes=mouth: 1, 0; inside: 0.75, 0; "
          "near: 0.5714285714285714,"
          " 0; top: 0.25, 1; body: 0.3, 0.6"]

ALTERNATING = "0; 10*sin(2*pi*t/600)"
COMPRESSIVE = "0; 10*(cos(2*pi*t/600) - 0.1)"
TWO_HARMONICS = "0; 10*(sin(2*pi*t/600) + 0.5*cos(4*pi*t/600) - 0.1)"
# Closes the lip near its mouth and opens it near its tip, or so.
MIXED = "0; 10*sin(2*pi*t/600) + if(x < 0.75, 10, -14)"


# What crevasse needs besides a member of the family.
FAMILY_SCENE = """
subsection Geometry
  set Shape = edge crack
end
subsection Loads
  set Period = 600
end
"""


def random_material(draw, kind, varies, times):
    """Two relaxation times, on the two sides of a line or in a chain."""
    place = draw.choice(["x<0.7", "y<0.3", "y<0.5"])

    def two(a, b):
        return repr(a) if a == b else f"if({place}, {a!r}, {b!r})"

    settings = [f"Material/Plane state={draw.choice(['plane stress', 'plane strain'])}",
                f"Material/Poisson ratio={draw.choice([0, 0.2, 0.3, 0.45])}"]
    if kind == 3 and draw.random() < 0.5:
        settings.append("Material/Young modulus="
                        + two(13000., 13000. * 10**draw.uniform(-1, 1)))
    if "eta(t, x)" in varies:
        settings.append(f"Material/Relaxation time={two(*times)}"
                        "*(1 + 0.5*x*sin(2*pi*t/600))")
    elif draw.random() < 0.25:
        settings += ["Material/Viscosity=isotropic", "Material/Viscous modulus="
                     + two(*(13000. * tau for tau in times)),
                     f"Material/Viscous Poisson ratio={draw.choice([0.2, 0.3, 0.4])}"]
    elif kind == 3 and draw.random() < 0.3:
        settings += ["Material/Viscosity=chain",
                     f"Material/Chain=0.6: {times[0]!r}; 0.4: {times[1]!r}"]
    else:
        settings.append(f"Material/Relaxation time={two(*times)}")
    if "k" in varies:
        settings.append("Material/Stiffness time factor="
                        f"1 + {draw.uniform(0.1, 0.5):.3f}*sin(2*pi*t/600)")
    if "eta" in varies:
        settings.append("Material/Viscosity time factor="
                        f"1 + {draw.uniform(0.1, 0.6):.3f}*cos(2*pi*t/600)")
    if draw.random() < 0.15:
        settings += ["Material/Thermal expansion=1e-5", "Loads/Temperature="
                     f"{draw.choice([10, 50])}*(1+sin(2*pi*t/600))*y"]
    return settings


def family(seed):
    """Settings of a random problem. Of four seeds, two are of a gap that a mean load
    closes after some 3 to 60 periods, and one is of k(t), eta(t) or eta(t, x). From
    seed 200 on tau/T is 10 on one side and 0.01 on the other."""
    draw = random.Random(seed)
    kind = seed % 4
    varies = (draw.choice([["k"], ["k"], ["k", "eta"], ["eta(t, x)"]])
              if kind == 2 or kind < 2 and draw.random() < 0.25 else [])
    low, high = sorted(PERIOD * 10**draw.uniform(-0.5, 1.3) for _ in range(2))
    schemes = ["heun", "trapezoid", "sdirk2", "rk4"]
    if seed >= 200:
        low, high, schemes = 0.01 * PERIOD, 10 * PERIOD, schemes[1:3]
    times = draw.choice([(low, low), (low, high), (high, low)][seed >= 200:])
    amplitude = 10**draw.uniform(-0.5, 1)
    mean = amplitude * 10**draw.uniform(-2.5, 0.3 if kind < 2 else -0.3)
    wave = f"{amplitude:.5g}*sin(2*pi*t/600)" + draw.choice(["", "*(0.3+x)"])
    if draw.random() < 0.3:
        wave += f" + {amplitude * draw.uniform(0.2, 1):.5g}*cos(4*pi*t/600 + 1)"
    settings = random_material(draw, kind, varies, times) + [
        f"Geometry/Subdivisions={draw.choice(['6, 3', '8, 4'])}",
        f"Discretisation/Degree={draw.choice([1, 1, 2])}",
        traction(f"0; {wave} - {mean:.5g}"
                 + draw.choice(["", "*x*x", "*(x-0.3)"])),
        f"Time integration/Scheme={draw.choice(schemes)}",
        f"Time integration/Steps per period={draw.choice([24, 40])}"]
    if kind < 2:
        closing = 6 * mean / 13000 * PERIOD / math.sqrt(low * high)  # in a period
        gap = closing * 10**draw.uniform(0.5, 1.8)
        form = draw.choice(["", "*x*x", "*(1.1-x)", "*if(x<0.8, 1, 0.1)"])
    else:
        gap = amplitude / 13000 * 10**draw.uniform(-1, 1)
        form = draw.choice(["", "*x*x", "*(x-0.5)"])
    if kind < 2 or draw.random() < 0.4:
        settings.append(f"Boundary/Gap=-{gap:.4g}{form}")
    return settings


def traction(formula):
    return f"Loads/Traction={formula}"


def relaxation(ratio, left_of=None):
    """Relaxation time in periods; ten times that on the right of a place."""
    tau = ratio * PERIOD
    return ["Material/Relaxation time=" + (
        repr(tau) if left_of is None
        else f"if(x < {left_of}, {tau!r}, {10 * tau!r})")]


def case(name, ratio):
    """Settings of the problems (a), (b) and (c) with tau/T."""
    formula, left_of = {"a": (ALTERNATING, None), "b": (COMPRESSIVE, None),
                        "c": (TWO_HARMONICS, 0.5)}[name]
    return [traction(formula)] + relaxation(ratio, left_of)


def steps(n):
    return [f"Time integration/Steps per period={n}"]


def method(name, scheme="trapezoid", tolerance=1e-11, periods=1000,
           split=None):
    settings = [f"Periodic state/Method={name}",
                f"Periodic state/Tolerance={tolerance}",
                f"Periodic state/Maximum periods={periods}",
                f"Time integration/Scheme={scheme}"]
    if split is not None:
        settings.append(f"Periodic state/Secular split={split}")
    return settings


FOURIER = method("fourier")


def compute(name, settings, scene=BODY, status=0):
    """More than one setting for a parameter: the last one counts."""
    last = {word.split("=")[0]: word for word in COMMON + settings}
    return run(scene, name, last.values(), status)


def log(results):
    return (results.directory / "log.txt").read_text()


def period(results, table, column, which=-1):
    """Samples of a period, its first instant included, its last not."""
    values = results.table(table)[column]
    n_periods = results.summary["periods"]
    n = (len(values) - 1) // n_periods
    first = n * (which % n_periods)
    return values[first:first + n]


def flow(results, probe):
    """The rate at which the lip opens at a probe; 0 if it is not resolved."""
    return results.summary["secular"]["per_probe"][probe]["beta"][1] or 0.


def error_estimate(results):
    return results.summary["stress_error_estimate"][-1]


def largest_stress(results):
    return results.summary["extremes"]["stress"]


def difference(one, other, openings=False, stride=1, which=-1,
               probes=PROBES):
    """Of stress, pressure, contact force and perhaps opening of two runs over
    a period, relative to the largest value of each kind. Every stride-th
    sample of the other one counts; which period is one of its. What flows open
    does so by beta a time."""
    def pair(table, column):
        mine = period(one, table, column)
        theirs = period(other, table, column, which)[::stride]
        assert len(mine) == len(theirs), (table, len(mine), len(theirs))
        return mine, theirs

    def apart(pairs, least=0.):
        size = max([least] + [max(map(abs, mine)) for mine, _ in pairs])
        return max(max(abs(a - b) for a, b in zip(*p)) for p in pairs) / size

    tables = [f"probe_{probe}.csv" for probe in probes]
    on_lip = [t for t in tables if "pressure" in one.table(t)]
    stresses = [pair(t, c) for t in tables for c in ("s_11", "s_22", "s_12")]
    size = max(max(map(abs, mine)) for mine, _ in stresses)
    worst = apart(stresses)
    if on_lip:
        worst = max(worst, apart([pair(t, "pressure") for t in on_lip], size),
                    apart([pair("contact.csv", "force")], 0.1 * size))
    if openings:
        gains = [[flow(results, p) * PERIOD * (k % results.summary["periods"])
                  for p in probes if f"probe_{p}.csv" in on_lip]
                 for results, k in ((one, -1), (other, which))]
        worst = max(worst, apart([
            ([x - my_gain for x in mine], [x - their_gain for x in theirs])
            for (mine, theirs), my_gain, their_gain
            in zip([pair(t, "opening") for t in on_lip], *gains)]))
    return worst


WAYS = {"march": method("march", None), "anderson": method("anderson", None),
        "averaged": method("averaged", None), "automatic": method("automatic", None)}


def search(seed, way, most, tolerance=1e-6):
    """Results of a member of the family by a method, or None where it is refused or
    does not end within so many periods."""
    settings = COMMON + family(seed) + [
        s for s in WAYS[way] if not s.startswith("Time integration")] + [
        f"Periodic state/Tolerance={tolerance}",
        f"Periodic state/Maximum periods={most}"]
    try:
        return compute(f"{way}_{seed}".replace(" ", "_"), settings, FAMILY_SCENE)
    except AssertionError as failure:
        if any(f"exit status {n} " in str(failure) for n in (2, 3)):
            return None
        raise


def stress_difference(one, other):
    """At the probes over the last period, relative to what the estimated error is
    relative to."""
    return max(abs(a - b) for probe in PROBES for column in ("s_11", "s_22", "s_12")
               for a, b in zip(*(period(r, f"probe_{probe}.csv", column)
                                 for r in (one, other)))) / largest_stress(one)


def search_by_all(seed, most):
    """Periods of all methods that end, and how far the stress is from that of the
    automatic choice, in the sum of the estimated errors."""
    found = {way: search(seed, way, most) for way in WAYS}
    found = {way: results for way, results in found.items() if results}
    apart = 0.
    for way, results in found.items():
        if "automatic" in found and way != "automatic":
            estimates = sum(error_estimate(r) for r in (results, found["automatic"]))
            apart = max(apart, stress_difference(found["automatic"], results)
                        / max(estimates, 1e-9))
    return {way: r.summary["periods"] for way, r in found.items()}, apart


def ratio_to_best(periods):
    """Periods of the automatic choice by those of the best method."""
    best = min(n for way, n in periods.items() if way != "automatic")
    return periods["automatic"] / best
