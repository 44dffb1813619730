"""Tables: functions that files give, in formulas of loads and materials, against the
same formulas and closed forms; steps at their jumps; files that cannot be used."""

import math
import pathlib
import random
import re
import statistics

from scipy.interpolate import PchipInterpolator

from crevasse_run import (Results, check, check_below, execute, execute_on, full,
                          overrides, plain, run, run_on, tier)

CRACKED = """
subsection Geometry
  set Shape        = edge crack
  set Subdivisions = 6, 4
end
subsection Material
  set Young modulus   = 13000
  set Relaxation time = 60
end
subsection Loads
  set Period   = 600
  set Traction = 0; 10*sin(2*pi*t/600)
end
subsection Periodic state
  set Maximum periods = 2
  set Tolerance       = 0
end
subsection Output
  set Probes = mouth: 1, 0; inside: 0.7, 0.2
  set Fields = none
end
"""

HELD_BAR = """
subsection Geometry
  set Shape        = rectangle
  set Subdivisions = 1, 1
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
  set Temperature = theta_metal(t)
end
subsection Tables
  set Files = history.csv
end
subsection Periodic state
  set Maximum periods = 1
  set Tolerance       = 0
end
subsection Output
  set Probes = inside: 0.4, 0.3
  set Fields = none
end
"""
E, TAU, ALPHA = 13000., 60., 1e-5


def write(name, text):
    pathlib.Path(name).write_text(text)
    return f"Tables/Files={name}"


def table(name, header, rows):
    return write(name, header + "\n" + "".join(
        ",".join(map(repr, row)) + "\n" for row in rows))


def difference(one, other, probes=("mouth", "inside")):
    """The largest difference of two runs in a column of a probe, relative to the
    largest value of its kind."""
    worst = 0.
    for probe in probes:
        mine, theirs = (results.table(f"probe_{probe}.csv") for results in (one, other))
        check(list(mine) == list(theirs), f"columns {list(mine)}")
        for kind in "us":
            columns = [column for column in mine if column[0] == kind]
            size = max(abs(x) for column in columns for x in theirs[column])
            worst = max([worst] + [abs(a - b) / size for column in columns
                                   for a, b in zip(mine[column], theirs[column],
                                                   strict=True)])
    return worst


def test_formula_and_table():
    """A formula that is linear between rows, and its table: of t in the loads and in
    the temperature, of theta and x in the material, with contact. Beyond the rows
    theta is held and t repeats itself."""
    files = [table("saw.csv", "t [s], force [N], theta_metal [degC]",
                   [(0., 0., 20.), (150., 10., 20.), (450., -10., 320.), (600., 0., 20.)]),
             table("alloy.csv", "theta [degC],E [MPa]",
                   [(100., 13000.), (200., 10000.)]),
             write("place.csv", "x [mm];tau [s]\r\n0.5;60\r\n0.75;30\r\n")]
    names = ", ".join(file.split("=")[1] for file in files)
    saw = "if(t < 150, t/15, if(t < 450, 10 - (t - 150)/15, -10 + (t - 450)/15))"
    theta = "if(t < 150, 20, if(t < 450, 20 + (t - 150), 320 - 2*(t - 450)))"
    for label, load, same_load in (
            ("load", "0; force(t)", f"0; {saw}"),
            ("shifted", "0; force(t + 600) - 0.2*force(t - 600)", f"0; 0.8*({saw})"),
            ("in space", "0; (1 + x)*force(t)", f"0; (1 + x)*({saw})"),
            ("warm", "0; force(t)", f"0; {saw}")):
        tables = [f"Tables/Files={names}", f"Loads/Traction={load}"]
        formulas = [f"Loads/Traction={same_load}"]
        if label == "warm":
            tables += ["Loads/Temperature=theta_metal(t)",
                       "Material/Young modulus=E(theta)",
                       "Material/Relaxation time=tau(x)"]
            formulas += [f"Loads/Temperature={theta}",
                         "Material/Young modulus=13000 - 30*min(max(theta - 100, 0), 100)",
                         "Material/Relaxation time=60 - 120*min(max(x - 0.5, 0), 0.25)"]
        check_below(difference(run(CRACKED, "by_table", tables),
                               run(CRACKED, "by_formula", formulas)), 1e-12,
                    f"formula and table, {label}")


def test_nodes():
    """A smooth formula, and a table with rows at all instants at which Euler's scheme
    evaluates it, also as a monotone cubic. The mean load vanishes in all of them."""
    rows = [(600 * k / 40, 10 * math.sin(2 * math.pi * k / 40)) for k in range(40)]
    euler = ["Time integration/Scheme=euler"]
    expected = run(CRACKED, "sine", euler)
    for label, comment in (("linear", ""), ("cubic", "# interpolation = monotone cubic,\n")):
        file = table("sine.csv", comment + "t,force", rows + [(600., 0.)])
        results = run(CRACKED, "sine_table", [*euler, file, "Loads/Traction=0; force(t)"])
        check_below(difference(results, expected), 1e-12, f"sine, {label}")
        check(not results.summary["effects"]["secular flow"]["on"], "zero mean")


def test_mean():
    """The mean of 5000 noisy rows vanishes to rounding, or is that of their trapezoids,
    and costs little where the load varies in space."""
    noise = random.Random(1)
    values = [noise.uniform(-10, 10) for _ in range(5000)]
    mean = sum(values) / len(values)
    for label, shift in (("without", 0.), ("with", 1.)):
        rows = [(600 * k / 5000, values[k % 5000] - mean + shift) for k in range(5001)]
        results = run(CRACKED, f"noise_{label}", [
            table("noise.csv", "t,force", rows), "Loads/Traction=0; (1 + x)*force(t)",
            "Periodic state/Maximum periods=1"])
        flow = results.summary["effects"]["secular flow"]
        check(flow["on"] == (label == "with"), f"{label} mean: {flow}")
        check(results.summary["seconds"]["total"] < 20, "time")


def exact_held_bar(rows, t):
    """Stress of a bar that is held, s' + s/tau = -E alpha theta', from s = 0 before the
    first row; theta is linear between rows, and jumps where t is given twice."""
    s, (time, theta) = 0., rows[0]
    s = -E * ALPHA * theta
    for later, next_theta in rows[1:]:
        end = min(later, t)
        if later > time:
            rate = -E * ALPHA * (next_theta - theta) / (later - time)
            s = rate * TAU + (s - rate * TAU) * math.exp(-(end - time) / TAU)
            if t < later:
                return s
        elif t >= later:
            s -= E * ALPHA * (next_theta - theta)
        time, theta = later, next_theta
    return s


def errors_of_held_bar(scheme, rows, header, marks):
    """Largest errors at the ends of steps, just after jumps, for halved steps."""
    file = table("history.csv", header, [(*row, *mark) for row, mark in zip(rows, marks)])
    errors = []
    for steps in (20, 40, 80):
        results = run(HELD_BAR, "kinks", [
            file, f"Time integration/Scheme={scheme}",
            f"Time integration/Steps per period={steps}"])
        of = results.table("probe_inside.csv")
        errors.append(max(abs(s - exact_held_bar(rows, t)) / (E * ALPHA * 100)
                          for t, s in zip(of["t"][:-1], of["s_22"])))
    return errors


def test_orders():
    """Heun's scheme and RK4 keep their orders through kinks that are marked, and
    through jumps, at instants of no equal step."""
    kinks = [(0., 0.), (37., 100.), (171., -40.), (401., 80.), (600., 0.)]
    jumps = kinks[:3] + [(171., 260.)] + kinks[3:]
    for label, rows, header, marks in (
            ("marked kinks", kinks, "t,theta_metal,step", [(0,), (1,), (1,), (1,), (0,)]),
            ("jump", jumps, "t,theta_metal,step",
             [(0,), (1,), (0,), (0,), (1,), (0,)])):
        for scheme, order in (("heun", 2), ("rk4", 4)):
            errors = errors_of_held_bar(scheme, rows, header, marks)
            orders = [math.log2(a / b) for a, b in zip(errors, errors[1:])]
            print(f"{scheme}, {label}: errors {errors}, orders {orders}")
            check(orders[-1] > order - 0.35 and errors[-1] < 10.**(-order), "order")
    within = errors_of_held_bar("rk4", kinks, "t,theta_metal", [()] * 5)
    print(f"rk4, kinks within steps: {within}")
    check(within[-1] > 10 * errors[-1], "marks make no difference")


def test_steps():
    """Jumps end adaptive and listed steps as well, and harmonic balance says why it
    has no equal steps."""
    rows = [(0., 0.), (37., 100.), (37., 20.), (600., 0.)]
    file = table("history.csv", "t,theta_metal", rows)
    for control in ("adaptive", "list", "uniform"):
        results = run(HELD_BAR, "control", [
            file, f"Time integration/Step control={control}",
            *["Time integration/Steps=100, 200, 300, 400, 500"][control == "uniform":]])
        of = results.table("probe_inside.csv")
        check(37. in of["t"], f"{control}: {of['t']}")
        if control != "list":
            worst = max(abs(s - exact_held_bar(rows, t)) / (E * ALPHA * 100)
                        for t, s in zip(of["t"][:-1], of["s_22"]))
            check_below(worst, 1e-2, f"{control} steps through a jump")
    marked = table("history.csv", "t,theta_metal,step",
                   [(0., 0., 0), (37., 50., 1), (600., 0., 0)])
    status, _, error = execute("control.prm", *overrides([
        marked, "Periodic state/Method=fourier", "Time integration/Scheme=trapezoid"]))
    check(status == 2 and "rows of a table" in error, error)


def test_log():
    """--check prints ranges, and what the steps miss."""
    rows = [(0., 0.), (299., 0.), (300., 10.), (301., 0.), (600., 0.)]
    pathlib.Path("check.prm").write_text(plain(CRACKED))
    file = table("pulse.csv", "t,force", rows)
    status, output, error = execute("--check", "check.prm", *overrides([
        file, "Loads/Traction=0; force(t)", "Time integration/Steps per period=21"]))
    check(status == 0 and "table force(t): 5 rows from 0 to 600, values from 0 to 10\n"
          in output and "steps miss up to 100 % of the range of force, at t = 300"
          in output, output + error)
    status, output, _ = execute("--check", "check.prm")
    check("  table" not in output, output)
    file = table("columns.csv", "t,force,pull,push",
                 [(0., 0., 0., 9.), (1., 9., 1., 3.), (600., 0., 0., 9.)])
    for load, expected, unexpected in (
            ("force(t)", "that no formula calls: pull, push\n", "another argument"),
            ("force(x)", "force has rows of t, but another argument in Loads/Traction = "
             "0; force(x)", "% of the range of p")):
        status, output, error = execute("--check", "check.prm", *overrides([
            file, f"Loads/Traction=0; {load}", "Loads/Body force=0; 0"]))
        check(status == 0 and expected in output and unexpected not in output,
              output + error)


PEAKS = [(0., 0.), (150., 2.), (290., 2.), (293., 10.), (296., -6.), (299., 2.),
         (450., -2.), (600., 0.)]


@full
def test_peaks():
    """Adaptive steps end at the peaks of a table, those of ARKODE too, and so do a
    flight's with 10 000 rows; equal steps that miss peaks end with a warning."""
    noise = random.Random(3)
    gusts = [(noise.uniform(30, 570), noise.uniform(.5, 3), noise.uniform(-3, 3))
             for _ in range(100)]
    flight = [(.06 * k, 10 * min(1, k / 1000, 10 - k / 1000) + sum(
        size * max(0, 1 - abs(.06 * k - t) / width) for t, width, size in gusts))
        for k in range(10000)] + [(600., 0.)]
    for rows, schemes in ((PEAKS, ("heun", "sdirk2", "arkode explicit", "arkode implicit")),
                          (flight, ("heun", "arkode explicit"))):
        file = table("history.csv", "t,theta_metal", rows)
        exact = [exact_held_bar(rows, t) for t, _ in rows[::1 if rows is PEAKS else 10]]
        for scheme in schemes:
            results = run(HELD_BAR, "peaks", [
                file, f"Time integration/Scheme={scheme}",
                "Time integration/Step control=adaptive",
                "Time integration/Relative tolerance=1e-3"])
            of = results.table("probe_inside.csv")
            for sign in (-1, 1):
                missed = max(sign * s for s in exact) - max(sign * s for s in of["s_22"])
                check_below(missed / max(map(abs, exact)), 1e-3, f"{scheme}: missed of "
                            f"{len(rows)} rows in {len(of['t'])} steps")
            check("steps miss" not in str(results.summary["warnings"]), "no warning")
    results = run(HELD_BAR, "peaks", [table("history.csv", "t,theta_metal", PEAKS)])
    warnings = [text for text in results.summary["warnings"] if "steps miss" in text]
    check(re.search("50.1 % of the range of theta_metal, at t = 293", *warnings), warnings)
    log = (results.directory / "log.txt").read_text()
    check(log.count(warnings[0]) == 2, log)
    # A column that no formula calls forces no steps.
    file = table("history.csv", "t,theta_metal,noise", [
        (600. * k / 999, 0.01 * min(k, 999 - k), noise.random() if k % 999 else 0.)
        for k in range(1000)])
    _, output, error = execute("--check", "peaks.prm", *overrides([
        file, "Time integration/Step control=adaptive"]))
    check(re.search("adaptive steps, .* at least 4[0-9] a period", output), output + error)
    marked = table("history.csv", "t,theta_metal,step", [(*row, 1) for row in PEAKS])
    check("steps miss" not in str(run(HELD_BAR, "peaks", [marked]).summary["warnings"]),
          "marked rows")


def test_monotone_cubic():
    """Monotone cubics are SciPy's to rounding: over t those of the rows of many
    periods, which do not depend on where a period begins."""
    rows = [(0., 5.), (40., 7.), (100., 6.), (170., -4.), (260., 0.), (330., 0.),
            (420., 9.), (530., 8.), (600., 5.)]
    comment = "# interpolation = monotone cubic\n"
    elastic = ["Material/Viscosity=none", "Time integration/Steps per period=150"]

    def stress(name, *settings):
        of = run(HELD_BAR, name, [*elastic, *settings]).table("probe_inside.csv")
        return of["t"], of["s_22"]

    by_period = [(t + 600. * k, value) for k in (-1, 0, 1) for t, value in rows[:-1]]
    instants, found = stress("cubic", table(
        "history.csv", comment + "t,theta_metal", rows))
    expected = PchipInterpolator(*zip(*by_period))(instants)
    check_below(max(abs(-s / E / ALPHA - e) for s, e in zip(found, expected)) / 9.,
                1e-12, "SciPy's cubic over t")
    for begin in (40., 260., 420.):
        shifted = table("history.csv", comment + "t,theta_metal", [
            (t - begin, value) for t, value in by_period
            if begin <= t <= begin + 600.])
        _, other = stress("shifted", shifted)
        same = [found[round((t + begin) / 4) % 150] for t in instants]
        check_below(max(abs(a - b) for a, b in zip(same, other)) / (9. * E * ALPHA),
                    1e-12, f"begin of the period at t = {begin}")
    history = table("history.csv", "t,theta_metal", [(0., 0.), (598., 598.), (600., 0.)])
    for shape in (rows, [(0., 0.), (10., 1.), (500., 900.), (600., 0.)],
                  [(0., 0.), (300., 1.), (310., 100.), (600., 99.)],
                  [(0., 0.), (300., 1.), (310., -100.), (600., -101.)]):
        table("alloy.csv", comment + "theta,alpha", shape)
        instants, found = stress(
            "alloy", history.replace("history.csv", "history.csv, alloy.csv"),
            "Material/Thermal expansion=alpha(theta)")
        values = PchipInterpolator(*zip(*shape))([min(t, 598.) for t in instants])
        check_below(max(abs(-s / E - t * e) for t, s, e in zip(
            instants[:-1], found, values)) / (600 * max(abs(values))), 1e-12,
            "SciPy's cubic over theta")


def test_as_spreadsheets_write():
    """Quoted cells, the line of separators, empty cells at ends of lines, a byte order
    mark, CRLF, comments with colons and capitals after the rows: all are one table."""
    rows = [(0., 0.), (100., 9.), (300., -4.), (450., 2.), (600., 0.)]
    expected = run(HELD_BAR, "usual", [table(
        "history.csv", "# interpolation = monotone cubic\nt,theta_metal", rows)])
    for label, text in (
            ("quoted", '"# Interpolation: Monotone Cubic",\n"t [s]","theta_metal [K, abs]"\n'
             + "".join(f'"{t}","{v}"\n' for t, v in rows)),
            ("Excel's", "\ufeffsep=;\r\nt [s];theta_metal;;\r\n" + "".join(
                f"{t};{v};;\r\n" for t, v in rows)
             + ";;;\r\n# INTERPOLATION monotone  cubic;;;\r\n"),
            ("tabulators", "t (s)\ttheta_metal\t\n" + "".join(
                f"+{t}\t{v}\t\n" for t, v in rows) + "#interpolation=monotone cubic\n")):
        results = run(HELD_BAR, "of_spreadsheet", [write("history.csv", text)])
        check_below(difference(results, expected, ["inside"]), 0. + 1e-15, label)


def test_theta_beyond_rows():
    """A temperature beyond the rows of a table is a warning of the summary."""
    history = table("history.csv", "t,theta_metal", [(0., 20.), (200., 120.), (600., 20.)])
    for rows, expected in (([(20., 1e-5), (120., 2e-5)], []),
                           ([(30., 1e-5), (110., 2e-5)],
                            ["rows of theta from 30 to 110, but is needed from 20 to 120"])):
        table("alloy.csv", "theta,alpha", rows)
        results = run(HELD_BAR, "beyond", [
            history.replace("history.csv", "history.csv, alloy.csv"),
            "Loads/Reference temperature=20", "Material/Thermal expansion=alpha(theta)",
            "Time integration/Steps per period=60"])
        found = [text for text in results.summary["warnings"] if "rows of theta" in text]
        check(len(found) == len(expected) and
              all(sentence in text for sentence, text in zip(expected, found)), found)


def test_reference_temperature():
    """Absolute temperatures, and mean coefficients from another temperature."""
    history = [(0., 20.), (200., 120.), (600., 20.)]
    change = run(HELD_BAR, "change", [table("history.csv", "t,theta_metal", [
        (t, theta - 20.) for t, theta in history])])
    absolute = [table("history.csv", "t,theta_metal", history),
                "Loads/Reference temperature=20"]
    check_below(difference(run(HELD_BAR, "absolute", absolute), change, ["inside"]), 1e-12,
                "absolute temperatures")

    # alpha is a mean from 0: the strain is alpha(theta) theta - alpha(20) 20.
    table("alloy.csv", "theta,alpha", [(0., 1e-5), (200., 2e-5)])
    strain = "(1e-5 + 5e-8*({0}))*({0}) - 1.1e-5*20"
    mean = run(HELD_BAR, "mean", absolute + [
        "Tables/Files=history.csv, alloy.csv", "Material/Mean expansion from=0",
        "Material/Thermal expansion=alpha(theta)"])
    of_strain = run(HELD_BAR, "of_strain", [
        absolute[0], "Material/Thermal expansion=1",
        "Loads/Temperature=" + strain.format("theta_metal(t)")])
    check_below(difference(mean, of_strain, ["inside"]), 1e-12, "mean coefficients")
    for settings, message in (
            (["Material/Mean expansion from=0"], "needs .Loads. Reference temperature"),
            (["Loads/Reference temperature=20", "Loads/Temperature=0"],
             "needs the absolute temperature"),
            (["Loads/Reference temperature=warm"], "must be a number, or empty")):
        status, _, error = execute("--check", "mean.prm", *overrides(settings))
        check(status == 2 and re.search(message, error), error)


@full
def test_ranks():
    files = [table("saw.csv", "t,force", [(0., 0.), (150., 10.), (150., 2.), (600., 0.)]),
             "Loads/Traction=0; force(t)"]
    expected = run(CRACKED, "one", files)
    results = run_on(2, "one.prm", "two", files)
    check_below(difference(results, expected), 1e-9, "two ranks")
    write("saw.csv", "t,force\n0,0\n600,1\n")
    status, _, error = execute_on(2, "one.prm", "--check", *overrides(files))
    check(status == 2 and error.count("saw.csv: force begins with") == 1, f"{status}\n{error}")


TWO = "a table has at least two columns and two rows with different values of t, as"
CUBIC = "# interpolation = monotone cubic\nt,force\n"
WRONG = {
    "": 'wrong.csv: the first column is ""; it must be t, theta',
    "t,force\n": TWO,
    "t\n0\n600\n": TWO,
    "t,force\n0,0\n0,1\n": TWO,
    CUBIC + "0,0\n300,1\n600,0\n": TWO,
    "time,force\n0,0\n": 'the first column is "time"; it must be t, theta, x, y',
    "t force\n0\n": 'the first column is "t force"; .* Commas separate columns',
    "\x01\xff,\x02\n": "the first column is",
    "t,max force\n": 'the name of the column "max force" must consist of letters',
    "t,,force\n": 'the name of the column "" must consist of letters',
    "t,sin\n": 'formulas or another column have the name of the column "sin"',
    "t,theta [K]\n": 'name of the column "theta" already; rename it',
    "t,pi\n": 'name of the column "pi" already; rename it',
    "t,t\n": 'name of the column "t" already; rename it',
    "t,force,force\n": 'name of the column "force" already',
    "t;force\n0;0\n0,5;1\n": r'row 3: t = "0,5" must be a number, with a decimal point',
    't,force\n0,0\n"0,5",1\n': r'row 3: t = "0,5" must be a number, with a decimal point',
    "t,force\n0,0\n0,5,1,0\n": r"row 3: a row needs 2 numbers \(t, force\), this one has "
                             "4; numbers have a decimal point, not a comma",
    "t,force\n0,0\n5\n": "row 3: a row needs 2 numbers .*, this one has 1",
    "t,force\n0,0\n5,\n": "row 3: a row needs 2 numbers .*, this one has 1",
    "t,force\n0,0\n5,nan\n": 'row 3: force = "nan" must be a number',
    "t,force\n0,0\n1e400,1\n": 'row 3: t = "1e400" must be a number',
    "t,force,step\n0,0,0\n5,1,x\n": 'row 3: step = "x" must be a number',
    "t,force,step\n0,0,0\n5,1,2\n600,0,0\n": "row 3: step = 2 must be 1 where a time step",
    "# a logger\nt,force\n0,0\n\n5,1\n3,1\n": "row 6: t = 3 after 5; rows must ascend",
    "t,force\n0,0\n5,1\n5,1\n5,2\n": "row 5: t = 5 after 5; .* the same value twice",
    "# interpolation = spline\nt,force\n": 'comment "# interpolation = spline" must be "# int',
    "# Interpolation of a kind\nt,force\n": "must be .# interpolation = linear. or",
    CUBIC + "0,0\n300,1\n300,2\n600,0\n":
        "row 5: t = 300 after 300; .* a monotone cubic has no jumps",
    "t,force\n0,0\n300,1\n300,2\n600,0\n# interpolation = monotone cubic\n":
        "row 4: t = 300 after 300; .* a monotone cubic has no jumps",
    "t,force\n0,0\n500,1\n540,0\n":
        r"wrong.csv: t goes from 0 to 540; it must go from 0 to \[Loads\] Period = 600",
    "t,force\n10,0\n600,0\n": "wrong.csv: t goes from 10 to 600",
    "t,force\n0,0\n600,1\n": "wrong.csv: force begins with 0 and ends with 1, but every",
}


def test_wrong_files():
    """Each has its sentence with file and row, whatever the formulas call."""
    pathlib.Path("wrong.prm").write_text(plain(CRACKED))
    for text, message in tier([*WRONG.items()][::3], WRONG.items()):
        file = write("wrong.csv", text)
        status, output, error = execute("--check", "wrong.prm", *overrides([
            file, "Loads/Traction=0; force(t)"]))
        check(status == 2 and len(re.findall(r"/wrong\.csv[,:] ", error)) == 1
              and "] Files = " in error
              and re.search(message, error), f"{text!r}: {status}\n{error}{output}")
        check("cannot be used" not in error, f"{text!r}: the formula\n{error}")
    right = "t,force\n0,0\n300,1\n600,0\n"
    write("right.csv", right)
    write("again.csv", right)
    for files, formula, status, message in (
            ("none.csv", "1", 4, r"\[Tables\] Files = none.csv: cannot be read: No such"),
            ("right.csv, ./right.csv", "1", 2, "right.csv: the file is listed twice"),
            ("right.csv, again.csv", "1", 2, '"force" is in .*right.csv as well'),
            ("right.csv", "strength(t)", 2, r"Known names: .* the columns of \[Tables\]"),
            ("right.csv", "force", 2, "Unexpected token|Function .* used as"),
            ("right.csv", "force(t, 1)", 2, "Too many parameters"),
            ("right.csv", "force(1/(t - 150))", 2, "no finite value")):
        code, output, error = execute("--check", "wrong.prm", *overrides([
            f"Tables/Files={files}", f"Loads/Traction=0; {formula}"]))
        check(code == status and re.search(message, error), f"{formula}: {error}{output}")


def test_paths_and_resume():
    """Files are looked for beside the scene; a run whose table has changed is not
    resumed."""
    place = pathlib.Path("beside")
    place.mkdir(exist_ok=True)
    rows = [(0., 0.), (150., 10.), (600., 0.)]
    table(place / "saw.csv", "t,force", rows)
    scene = place / "saw.prm"
    scene.write_text(plain(CRACKED.replace("10*sin(2*pi*t/600)", "force(t)"))
                     + "subsection Tables\n  set Files = saw.csv\nend\n")
    for more, rows, expected in (([], rows, 0), (["--resume"], rows, 0),
                                 (["--resume"], [*rows[:1], (151., 10.), rows[2]], 2)):
        table(place / "saw.csv", "t,force", rows)
        settings = ["Output/Checkpoint every=1",
                    f"Periodic state/Maximum periods={3 if more else 2}"]
        status, _, error = execute(scene, "--output", "results/resumed", *more,
                                   *overrides(settings))
        check(status == expected, f"{more}: {status}\n{error}")
    check(re.search(r"Content of files\] \[Tables\] saw.csv: was", error), error)
    used = Results("results/resumed").directory / "used.prm"
    status, _, error = execute("--check", used)
    check(status == 0, error)

    # Two files of one name, of which the first changes.
    for folder, column in (("one", "force"), ("two", "pull")):
        (place / folder).mkdir(exist_ok=True)
        table(place / folder / "rows.csv", f"t,{column}", rows)
    words = [scene, "--output", "results/both", *overrides([
        "Tables/Files=one/rows.csv, two/rows.csv", "Loads/Traction=0; force(t) + pull(t)",
        "Output/Checkpoint every=1"])]
    status, _, error = execute(*words)
    check(status == 0, error)
    table(place / "one/rows.csv", "t,force", [(0., 0.), (150., 9.), (600., 0.)])
    status, _, error = execute(*words, "--resume")
    check(status == 2 and "[Tables] rows.csv: was" in error, f"{status} {error}")


@full
def test_cost():
    """A flight of 10 000 rows against one of two, for the same number of steps: the
    time stepping of alternating runs."""
    table("long.csv", "t,force", [
        (0.06 * k, min(k / 250, 20 - k / 250, k / 250 - 40, key=abs))
        for k in range(10000)] + [(600., 0.)])
    seconds = {"short": [], "long": []}
    table("short.csv", "t,force", [(0., 0.), (150., 10.), (450., -10.), (600., 0.)])
    for _ in range(9):
        for name, of in seconds.items():
            results = run(CRACKED, f"cost_{name}", [
                f"Tables/Files={name}.csv", "Loads/Traction=0; force(t)",
                "Geometry/Subdivisions=48, 48", "Time integration/Steps per period=200"])
            of.append(results.summary["seconds"]["time stepping"])
    ratio = statistics.median(seconds["long"]) / statistics.median(seconds["short"])
    check_below(min(ratio, min(seconds["long"]) / min(seconds["short"])), 1.02,
                f"10 000 rows against 4: ratio of medians {ratio:.3f}")


if __name__ == "__main__":
    for test in (test_formula_and_table, test_nodes, test_mean, test_orders, test_steps,
                 test_log, test_peaks, test_monotone_cubic, test_as_spreadsheets_write,
                 test_theta_beyond_rows, test_reference_temperature, test_ranks,
                 test_wrong_files, test_paths_and_resume, test_cost):
        test()
