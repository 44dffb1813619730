"""Periodic problems on the mesh of the paper, and how far two runs are apart
over their last periods."""

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
           start="rest", split=None):
    settings = [f"Periodic state/Method={name}",
                f"Periodic state/Start from={start}",
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
    """The rate at which the lip opens at a probe."""
    return results.summary["secular"]["per_probe"][probe]["beta"][1]


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
