"""How wide are the error bars of `crevasse SCENE --bars`? The effectivity, bar over true
error, of all quantities of twenty small scenes: the table of doc/accuracy.md.

    OMP_NUM_THREADS=1 /usr/bin/python3 tests/benchmarks/error_bars.py build/crevasse [SCENE ...]

True errors come from reference runs with cells of a quarter of the size and four times
the steps, or where that is better with singular functions; error_bars.json beside this
file keeps them, and --rebuild computes them again. --others: eight scenes on which no
factor of the bars was chosen. All runs stay in
results/error_bars; a scene takes seconds, a reference up to a minute."""

import json
import os
import pathlib
import statistics
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "source/python"))
TRUTH = pathlib.Path(__file__).with_suffix(".json")
STEPS = "Time integration/Steps per period"
FINEST = 1e-5  # errors below this part of the quantity's scale are not counted

SQUARE = {"Contact/Solver": "automatic", "Output/Fields": "none", "Geometry/Subdivisions": "8, 8",
          "Crack tip/Stress intensity": "true",
          "Output/Probes": "C: 1, 0; lip: 0.75, 0; body: 0.35, 0.4; side: 1, 0.5"}
RATES = {"Crack tip/Stress intensity": "true"}
Q2 = {"Discretisation/Degree": 2}
SINGULAR = Q2 | {"Discretisation/Singular functions": 2}
PRESSED = {"Loads/Traction": "0; 10*sin(2*pi*t/600) - 3", "Periodic state/Tolerance": 1e-4,
           "Periodic state/Maximum periods": 60}
FINE_SQUARE = SINGULAR | {"Geometry/Refinements": 2, "Refinement/Strategy": "none",
                          "Refinement/Target unknowns": 0}
PLATE = {"Crack tip/Stress intensity": "true", "Periodic state/Tolerance": 1e-4,
         "Output/Probes": "mouth: 50, 0; lip: 45, 0; body: 20, 20; side: 50, 25"}
HALF, QUARTER = {"Geometry/Refinements": 1}, {"Geometry/Refinements": 2}


def sdirk2(n):
    return {"Time integration/Scheme": "sdirk2", STEPS: n}


# Scene, settings, settings of the reference.
SCENES = {
    "square, Q1": ("raous1980", SQUARE, FINE_SQUARE),
    "square, Q2": ("raous1980", SQUARE | Q2, FINE_SQUARE),
    "square, Q2, functions": ("raous1980", SQUARE | SINGULAR, FINE_SQUARE),
    "square, Q1, functions, euler": (
        "raous1980", SQUARE | {"Discretisation/Singular functions": 2,
                               "Time integration/Scheme": "euler", STEPS: 80}, FINE_SQUARE),
    "square, pressed, sdirk2": ("raous1980", SQUARE | SINGULAR | PRESSED | sdirk2(40),
                                FINE_SQUARE),
    "square, rk4 with events": (
        "raous1980", SQUARE | Q2 | {"Time integration/Scheme": "rk4", STEPS: 20,
                                    "Time integration/Locate contact events": "true"},
        FINE_SQUARE),
    "square, trapezoid, fourier": (
        "raous1980", SQUARE | Q2 | {"Time integration/Scheme": "trapezoid",
                                    "Periodic state/Tolerance": 1e-6,
                                    "Periodic state/Method": "fourier"}, FINE_SQUARE),
    "square, adaptive": (
        "raous1980", SQUARE | Q2 | {"Geometry/Subdivisions": "4, 4",
                                    "Refinement/Strategy": "adaptive",
                                    "Refinement/Target unknowns": 1000},
        FINE_SQUARE | {"Geometry/Subdivisions": "8, 8"}),
    "square, graded to the tip": (
        "raous1980", SQUARE | {"Refinement/Strategy": "tip", "Refinement/Cycles": 3},
        FINE_SQUARE),
    "no tip": ("studies/signorini_rates", {
        "Geometry/Refinements": 2, "Output/Load work": "false",
        "Output/Probes": "left: 0, 0; lip: 0.375, 0; body: 0.3, 0.2"},
        {"Geometry/Refinements": 5}),
    "two materials": ("bimaterial", {
        "Output/Fields": "none",
        "Output/Probes": "mouth: 1, 0; lip: 0.875, 0; slow: 0.6, 0.4; fast: 0.9, 0.4"},
        QUARTER | Q2),
    "two materials, Q2": ("bimaterial", Q2 | {
        "Geometry/Subdivisions": "8, 4", "Output/Fields": "none", "Periodic state/Tolerance": 1e-4,
        "Output/Probes": "mouth: 1, 0; lip: 0.875, 0; slow: 0.6, 0.4; fast: 0.9, 0.4"},
        QUARTER),
    "thermal": ("thermal_fatigue", PLATE | {"Geometry/Subdivisions": "10, 8"},
                HALF | SINGULAR),
    "thermal, Q2, sdirk2": ("thermal_fatigue", PLATE | Q2 | sdirk2(30) | {
        "Geometry/Subdivisions": "10, 8"}, HALF | SINGULAR),
    "crack growth": ("crack_growth", {
        "Geometry/Subdivisions": "10, 20",
        "Output/Probes": "mouth: 50, 0; lip: 45, 0; body: 20, 20"}, QUARTER),
    "inclined crack": ("inclined_crack", RATES | {
        "Discretisation/Degree": 1, STEPS: 20, "Refinement/Cycles": 1,
        "Output/Fields": "none", "Output/Probes": "body: 0.5, 0.5; top: 0, 1"},
        SINGULAR | {"Refinement/Cycles": 2}),
    "cracked box": ("cracked_box", {
        "Output/Probes": "front: 1, 0, 0; lip: 0.75, 0, 0.25; body: 0.25, 0.5, 0.25",
        "Geometry/Subdivisions": "8, 4, 2", STEPS: 20, "Output/Fields": "none"},
        Q2 | {"Geometry/Refinements": 1}),
    "power law": ("power_law", {
        "Geometry/Subdivisions": "20, 40", "Refinement/Cycles": 4, "Output/Fields": "none",
        "Periodic state/Maximum periods": 1, "Output/Probes": "mouth: 50, 0; body: 20, 20"},
        QUARTER),
    "ring": ("raous1980", SQUARE | sdirk2(40) | {
        "Material/Plane state": "axisymmetric", "Crack tip/Stress intensity": "false",
        "Boundary/Fixed points": "none", "Boundary/Symmetry": "0, 2",
        "Discretisation/Degree": 2}, QUARTER | {"Refinement/Strategy": "tip",
                                                "Refinement/Cycles": 4}),
    "plate with a hole": ("plate_with_hole", {
        "Output/Fields": "none", "Refinement/Cycles": 2, "Discretisation/Degree": 1,
        STEPS: 20}, Q2 | {"Refinement/Cycles": 6}),
}

# Scenes on which nothing was chosen: most are those of advise.py.
PLAIN = {"Contact/Solver": "automatic", "Output/Fields": "none",
         "Crack tip/Stress intensity": "true", "Geometry/Subdivisions": "8, 4"}
TWO_PERIODS = {"Periodic state/Tolerance": 0, "Periodic state/Maximum periods": 2}
FINE_TIP = QUARTER | Q2 | {"Refinement/Strategy": "tip", "Refinement/Cycles": 5}
BENT = PLAIN | Q2 | TWO_PERIODS | {
    "Geometry/Subdivisions": "8, 8", "Material/Relaxation time": 300,
    "Loads/Traction": "0; 20*(x - 0.4)*sin(2*pi*t/600) + 2*sin(6*pi*t/600)",
    "Output/Probes": "above: 0.75, 0.25; top: 0.5, 1; side: 0, 0.5; mouth: 1, 0; lip: 0.75, 0"}
OTHERS = {
    "centre crack": ("raous1980_body", PLAIN | TWO_PERIODS | {
        "Geometry/Shape": "centre crack", "Geometry/Crack length": 0.4,
        "Geometry/Subdivisions": "10, 6", "Loads/Traction": "0; 10*sin(2*pi*t/600) - 2",
        "Output/Probes": "lip: 0, 0; inside: 0.7, 0.2"}, FINE_SQUARE),
    "creeping plate": ("raous1980_body", PLAIN | TWO_PERIODS | {
        "Crack tip/Stress intensity": "false",
        "Geometry/Shape": "rectangle", "Geometry/Subdivisions": "4, 4",
        "Material/Plane state": "plane strain", "Material/Relaxation time": 200,
        "Boundary/Clamped": 0, "Boundary/Fixed points": "none",
        "Loads/Traction": "0; 10*(1 - cos(2*pi*t/600))*x",
        "Output/Probes": "corner: 1, 1; inside: 0.5, 0.5"}, QUARTER | Q2),
    "ageing": ("ageing", PLAIN | {
        "Output/Probes": "inside: 0.75, 0.25; top: 0.5, 1; lip: 0.75, 0"}, FINE_TIP),
    "gap and chain": ("raous1980_body", PLAIN | {
        "Crack tip/Stress intensity": "false", "Geometry/Crack length": 0.25,
        "Boundary/Gap": "-4e-4*(x - 0.75)", "Material/Viscosity": "chain",
        "Material/Relaxation time": "", "Material/Chain": "0.5: 30; 0.3: 300",
        "Loads/Traction": "0; 10*sin(2*pi*t/600) - 3*cos(4*pi*t/600)",
        "Periodic state/Method": "anderson", "Periodic state/Tolerance": 1e-6,
        "Output/Probes": "above: 0.875, 0.25; top: 0.25, 1; mouth: 1, 0"}, FINE_TIP),
    "graded material": ("raous1980_body", PLAIN | TWO_PERIODS | {
        "Crack tip/Stress intensity": "false",
        "Material/Young modulus": "13000*(1 + x*x + y)",
        "Material/Relaxation time": "2000*(1 + x)",
        "Loads/Traction": "0; 10*sin(2*pi*t/600) - 1",
        "Output/Probes": "mouth: 1, 0; inside: 0.75, 0.25"}, FINE_TIP),
    "steam turbine": ("crack_growth", {
        "Geometry/Subdivisions": "10, 16", "Discretisation/Singular functions": 0,
        "Output/Probes": "mouth: 50, 0; inside: 30, 20; far: 10, 80"}, FINE_SQUARE),
    "bent": ("raous1980_body", BENT | {
        "Material/Plane state": "plane strain", "Material/Poisson ratio": 0.3}, FINE_SQUARE),
    "bent, functions, sdirk2": ("raous1980_body", BENT | SINGULAR | sdirk2(30), FINE_SQUARE),
}


def finer_steps(scene, settings):
    """Settings of four times the steps."""
    if scene["Time integration/Step control"] == "list":
        t = [0., *map(float, scene["Time integration/Steps"].split(",")),
             float(scene["Loads/Period"])]
        return {"Time integration/Steps": ", ".join(repr(t) for t in sorted(
            {a + k / 4 * (b - a) for a, b in zip(t, t[1:]) for k in range(4)} - {0.}))}
    return {STEPS: 4 * int(scene[STEPS])}


def kind_of(quantity):
    name = quantity.of
    return ("K" if name.startswith(("K_", "Delta_K")) else
            "C*" if name.startswith("C_") else
            {"u": "displacement", "s": "stress", "force": "contact force"}.get(name, name))


class Case:
    """A scene, its run and its reference."""

    def __init__(self, name, program, log, folder):
        prm, self.settings, self.of_reference = (SCENES | OTHERS)[name]
        self.scene, self.name = ROOT / f"prm/{prm}.prm", name
        self.folder = folder / "".join(c if c.isalnum() else "_" for c in name)
        self.program, self.log = program, log

    def compute(self, folder, settings):
        from crevasse.program import assignments
        if not (folder / "summary.json").exists():
            end = self.program.compute(self.scene, assignments(settings), folder)
            if not end.has_results:
                raise SystemExit(f"{self.name}: {folder}: {end.message}")
        return folder

    def bars(self):
        from crevasse import bars
        from crevasse.program import assignments
        own = self.compute(self.folder, self.settings)
        options = bars.arguments([str(own), str(self.scene), *(
            word for text in assignments(self.settings) for word in ("--set", text))])
        self.found = bars.bars_of(options, self.program, self.log)
        self.found.directory.mkdir(exist_ok=True)
        self.found.run()
        return json.loads((own / "summary.json").read_text())["bars"]

    def truth(self):
        """True errors {quantity: {total, time, scale}}. The reference of a march has as
        many periods, so that the part of the periods is not in them. The scale of drift
        is the displacement over the period."""
        from crevasse.bars_compare import Histories, difference, largest
        finer = finer_steps(self.found.scene, self.settings)
        same = self.found.choice.same_periods()
        runs = [Histories(self.compute(self.folder / f"reference_{part}",
                                       self.settings | same | more), self.found.own.period)
                for part, more in (("total", self.of_reference | finer), ("time", finer))]
        errors, scales = {}, {}
        for quantity in self.found.quantities:
            entry = {}
            for part, run in zip(("total", "time"), runs):
                if {quantity.name} <= run.findings.keys() & self.found.mine.findings.keys():
                    entry[part] = abs(run.findings[quantity.name]
                                      - self.found.mine.findings[quantity.name])
                elif (change := difference(quantity, self.found.mine, run)[0]) is not None:
                    entry[part] = float(change)
            kind = kind_of(quantity)
            scales[kind] = max(scales.get(kind, 0.), abs(largest(quantity, runs[0]))
                               if len(entry) == 2 else 0.)
            errors[quantity.name] = entry
        scales["drift"] = runs[0].summary["extremes"]["displacement"] / runs[0].period
        for quantity in self.found.quantities:
            errors[quantity.name]["scale"] = scales[kind_of(quantity)]
            errors[quantity.name]["kind"] = kind_of(quantity)
            errors[quantity.name]["same_periods"] = bool(same)
        return errors


def measure(bars, truth, rows):
    """Appends (kind, part, effectivity, quantity) of one scene."""
    for name, error in truth.items():
        bar = bars.get(name)
        if not bar or bar["bar"] is None or "total" not in error:
            continue
        all_parts = bar["mesh"] + bar["time"] + bar["period"] * (not error["same_periods"])
        for part, mine in (("total", all_parts), ("time", bar["time"])):
            rounding = (error["kind"] in ("contact force", "pressure", "C*")
                        and error["scale"] < 1e-6)
            if error[part] > FINEST * error["scale"] > 0. and not rounding:
                rows.append((error["kind"], part, mine / error[part], name))


def as_json(kept):
    """A line a quantity, with four digits."""
    return "{" + ",\n".join(
        f"{json.dumps(scene)}: {{\n" + ",\n".join(
            f" {json.dumps(name)}: " + json.dumps(
                {key: float(f"{value:.4g}") if isinstance(value, float) else value
                 for key, value in entry.items()}) for name, entry in errors.items())
        + "}" for scene, errors in kept.items()) + "}\n"


def share(values, most):
    return 100. * sum(.5 <= value <= most for value in values) / len(values)


def main():
    words = [word for word in sys.argv[1:] if not word.startswith("--")]
    os.environ["CREVASSE_PROGRAM"] = str(pathlib.Path(words[0]).resolve())
    from crevasse.command import Log, Stop
    from crevasse.program import Program
    program, log = Program(Stop(None, "")), Log("--quiet" in sys.argv)
    kept = json.loads(TRUTH.read_text()) if TRUTH.exists() else {}
    rows = []
    for name in words[1:] or (OTHERS if "--others" in sys.argv else SCENES):
        log(f"== {name}")
        case = Case(name, program, log, pathlib.Path("results/error_bars").absolute())
        bars = case.bars()
        if "--rebuild" in sys.argv or name not in kept:
            kept[name] = case.truth()
            TRUTH.write_text(as_json(kept))
        begin = len(rows)
        measure(bars, kept[name], rows)
        for kind, part, effectivity, quantity in rows[begin:]:
            if part == "total" or effectivity < .5:
                parts = [bars[quantity][which] for which in ("mesh", "time")]
                log(f"  {'!' if not .5 <= effectivity <= 5 else ' '} {quantity:24} {part:6}"
                    f"{effectivity:9.3g}  bar {parts[0]:.2g} + {parts[1]:.2g}, true "
                    f"{kept[name][quantity]['total']:.2g}, of time "
                    f"{kept[name][quantity]['time']:.2g}")
    print("| quantity | part | n | within ½ … 5 | within ½ … 10 | below ½ | below ¼ "
          "| median |\n|---|---|---|---|---|---|---|---|")
    for part in ("total", "time"):
        for kind in sorted({row[0] for row in rows}):
            values = [row[2] for row in rows if row[:2] == (kind, part)]
            if values:
                print(f"| {kind} | {part} | {len(values)} | {share(values, 5):.0f} % "
                      f"| {share(values, 10):.0f} % | {sum(v < .5 for v in values)} "
                      f"| {sum(v < .25 for v in values)} | {statistics.median(values):.1f} |")


if __name__ == "__main__":
    main()
