"""Random settings, seeded: whatever they are, a run ends by itself with one of the
documented statuses, says why if it failed, and has nothing but finite numbers and
states of contact that are some if it did not. A third argument runs more than a
test has time for: "test_random_settings.py build/crevasse . 1000"; a fourth is the
first seed."""

import json
import math
import pathlib
import random
import re
import shutil
import sys

from crevasse_run import SOURCE, Failure, Results, check, execute, overrides

SCENE = SOURCE / "tests/hard/body.prm"
STATUSES = {0, 2, 3, 5}  # done, refused, failed, out of the time below
WALL_TIME, PATIENCE = 10, 600  # seconds
# Nothing is to be written anywhere else, or read: that is status 4.
UNWANTED = {"Output directory", "Tables/Files"}
# Columns that are nan where there is nothing yet, or where SOR did not converge.
UNKNOWN = {"stress_change", "stress_error_estimate", "iterations",
           "iterations_27_bits"}
NUMBERS = ["0", "-0", "1", "-1", "2", "3", "7", "0.5", "1e-12", "1e-3", "12.5",
           "1e3", "1e9", "1e300", "1e-300", "1e999", "nan", "inf", "-inf",
           "4294967296", "18446744073709551616", "0x10", "1,5", "1e", "--1"]
WORDS = ["automatic", "none", "true", "false", "on", "off", "", " ", "#", "$a",
         "end", "set", "\\", '"', "µ", "\x01", "a" * 5000, "(" * 300, "x",
         "x=0", "../x", "%s%n"]
ATOMS = ["x", "y", "z", "t", "theta", "material", "pi", "1", "600", "0", "1e-9",
         "1e200", "frequency"]
FUNCTIONS = ["sin", "exp", "sqrt", "log", "abs", "if", "rand", "min", "nothing"]


# Each turns on some of what the program can do, for the settings to meet it.
THEMES = [
    [],
    ["Dimension=3", "Geometry/Subdivisions=4, 2, 2",
     "Loads/Traction=0; 10*sin(2*pi*t/600)*(1+z); 0", "Output/Probes=mouth: 1, 0, 0"],
    ["Material/Viscosity=chain", "Material/Chain=0.5: 60; 0.3: 600"],
    ["Material/Plane state=plane strain", "Material/Viscosity=isotropic",
     "Material/Viscous modulus=1e6", "Material/Viscous Poisson ratio=0.5"],
    ["Material/Thermal expansion=1e-5", "Loads/Temperature=100*x*sin(2*pi*t/600)",
     "Material/Young modulus=13000 - theta"],
    ["Time integration/Step control=adaptive", "Time integration/Scheme=sdirk2"],
    ["Time integration/Scheme=arkode implicit"],
    ["Periodic state/Method=automatic", "Periodic state/Tolerance=1e-4",
     "Periodic state/Maximum periods=30"],
    ["Periodic state/Method=fourier", "Time integration/Scheme=trapezoid",
     "Periodic state/Tolerance=1e-4"],
    ["Discretisation/Singular functions=2", "Crack tip/Stress intensity=true"],
    ["Refinement/Strategy=adaptive", "Refinement/Cycles=2"],
    ["Refinement/Strategy=tip", "Refinement/Cycles=3", "Discretisation/Degree=2"],
    ["Geometry/Refinements=1", "Linear solver/Type=gmg"],
    ["Geometry/Shape=centre crack", "Boundary/Gap=-1e-4", "Output/Fields=vtu"],
    ["Contact/Solver=projected sor", "Output/Elastic comparison=open"],
]


class Parameter:
    def __init__(self, name, default, allowed):
        self.name, self.default, self.allowed = name, default, allowed
        one_of = re.match(r"one of: (.*)", allowed)
        self.choices = (one_of[1].split(", ") if one_of
                        else ["true", "false"] if allowed.startswith("true")
                        else ["1", "2", "3"] if name.endswith(("Dimension", "Degree"))
                        else [])
        self.is_integer = "integer" in allowed and "," not in default


def parameters():
    """All of them, from the page that the program prints."""
    _, page, _ = execute("--print-parameters", "markdown")
    found, section = [], ""
    for line in page.splitlines():
        if line.startswith("## "):
            section = "" if line == "## Top level" else line[3:] + "/"
        row = re.match(r"\| (?!name \|)([^|]+) \| ([^|]*) \| .* \| ([^|]*) \|", line)
        if row:
            found.append(Parameter(section + row[1], row[2].strip(" `"), row[3]))
    return [one for one in found if one.name not in UNWANTED]


def number(dice, near=1.):
    if dice.random() < 0.15:
        return dice.choice(NUMBERS)
    if dice.random() < 0.3:
        return str(dice.randint(0, 40))
    return f"{near * 10**dice.gauss(0, 1):.6g}"


def formula(dice, depth=0):
    kind = dice.random()
    if depth > 3 or kind < 0.35:
        return dice.choice(ATOMS) if kind < 0.25 else number(dice)
    inner = [formula(dice, depth + 1) for _ in range(dice.randint(1, 3))]
    if kind < 0.6:
        return f"{dice.choice(FUNCTIONS)}({', '.join(inner)})"
    return "(" + dice.choice(["+", "-", "*", "/", "^", "<", "&&"]).join(inner) + ")"


def anything(dice):
    kind = dice.random()
    if kind < 0.3:
        return dice.choice(WORDS)
    one = number if kind < 0.6 else formula
    separator = dice.choice([", ", "; ", ": ", " "])
    return separator.join(one(dice) for _ in range(dice.choice([1, 1, 2, 3, 6])))


def value(parameter, dice):
    """Mostly what the parameter might mean; often enough what it does not."""
    if dice.random() < 0.15:
        return anything(dice)
    if parameter.choices:
        return dice.choice(parameter.choices)
    if parameter.is_integer:
        return str(dice.choice([0, 1, 2, 3, 5, 10, 40, 1000]))
    if "formula" in parameter.allowed and dice.random() < 0.4:
        swing = dice.choice(["sin(2*pi*t/600)", "x", "(t < 300)", "x*y", "-0.1"])
        return f"{number(dice, 100.)}*(1 + 0.5*{swing})"
    numbers = re.findall(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e-?\d+)?", parameter.default)
    if numbers:
        changed = dice.choice(numbers)
        return parameter.default.replace(changed,
                                         number(dice, abs(float(changed)) or 1.), 1)
    return dice.choice([formula, number])(dice)


def settings(seed, all_parameters):
    dice = random.Random(seed)
    chosen = dice.sample(all_parameters, dice.choice([1, 1, 2, 3]))
    return (dice.choice(THEMES) +
            [f"{one.name}={value(one, dice)}" for one in chosen])


def require_finite(entry, where):
    """Numbers of the summary; the scene is what it was given."""
    if isinstance(entry, dict):
        for name, inner in entry.items():
            if (where, name) != ("summary", "scene"):
                require_finite(inner, f"{where}.{name}" if name else where)
    elif isinstance(entry, list):
        for inner in entry:
            require_finite(inner, where)
    elif isinstance(entry, float):
        check(math.isfinite(entry), f"{where} = {entry}")


def require_contact(probe, name, extremes, tolerance):
    """Lips do not interpenetrate, do not pull, and press only where they touch."""
    if "opening" not in probe:
        return
    opening = [value / (extremes["opening"] or 1.) for value in probe["opening"]]
    pressure = [value / (extremes["stress"] or 1.) for value in probe["pressure"]]
    check(min(opening) >= -tolerance, f"{name}: the lips interpenetrate")
    check(min(pressure) >= -tolerance, f"{name}: the lips pull")
    check(all(min(pair) <= tolerance for pair in zip(opening, pressure)),
          f"{name}: an open lip presses")


def require_sound(results):
    """Of a run that says that all is well."""
    summary = results.summary
    require_finite(summary, "summary")
    tolerance = max(1e-3, 100 * float(summary["scene"]["Contact"]["Tolerance"]))
    for what, size in summary.get("certificate", {}).items():
        check(size <= tolerance, f"certificate: {what} = {size}")
    for path in results.directory.glob("*.csv"):
        table = results.table(path.name)
        for column, values in table.items():
            if column not in UNKNOWN:
                check(all(map(math.isfinite, values)), f"{path.name}: {column}")
        boundary = summary["scene"]["Boundary"]
        # With another lip than the crack, the crack is an open one.
        if path.name.startswith("probe_") and [boundary[name] for name in (
                "Gap", "Contact", "Open crack")] == ["0", "automatic", "automatic"]:
            require_contact(table, path.name, summary["extremes"], tolerance)


def judge(seed, all_parameters):
    """The status; a Failure names the settings."""
    chosen = settings(seed, all_parameters)
    directory = pathlib.Path("results")
    shutil.rmtree(directory, ignore_errors=True)
    try:
        status, _, error = execute(
            SCENE, "--quiet", "--output", directory, "--wall-time", WALL_TIME,
            *overrides(chosen), seconds=PATIENCE)
        check(status in STATUSES, f"status {status}\n{error}")
        check(status in (0, 5) or len(error.split()) > 4,
              f"status {status} without a reason: {error!r}")
        check("terminate called" not in error and "deal.II" not in error,
              f"an error of a library:\n{error}")
        if status == 0:
            require_sound(Results(directory))
    except Failure as failure:
        return None, f"seed {seed}: {json.dumps(chosen)}: {failure}"
    return status, ""


def main():
    n_runs, first = [int(word) for word in sys.argv[3:5] + ["40", "1"][
        len(sys.argv[3:5]):]]
    all_parameters = parameters()
    check(len(all_parameters) > 60, "the page of parameters was not understood")
    counts, failures = {}, []
    for seed in range(first, first + n_runs):
        status, failure = judge(seed, all_parameters)
        counts[status] = counts.get(status, 0) + 1
        if failure:
            failures.append(failure)
            print(failure, flush=True)
    print("runs by exit status:", dict(sorted(counts.items(), key=str)))
    check(not failures, f"{len(failures)} of {n_runs} runs")
    check(counts.get(0, 0) >= n_runs // 10, "hardly any run was computed")


main()
