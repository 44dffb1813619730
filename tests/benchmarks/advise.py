"""Does `crevasse advise` keep what it promises, on scenes that it was not tuned on?
For each scene: the true error of the advised settings against an independent, much
finer run, and their cost beside the cheapest point of a full sweep, the product of
meshes and steps, that reaches the error.

    OMP_NUM_THREADS=1 /usr/bin/python3 tests/benchmarks/advise.py build/crevasse [SCENE ...]

Costs are CPU seconds, the least of several. Without names all scenes are
computed, some half an hour; what is finished in the working directory is not computed
again. result.json of each scene has more than the table."""

import csv
import json
import math
import pathlib
import re
import shutil
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PRM = ROOT / "prm"
STEPS = "Time integration/Steps per period"

# Scene, settings that make it small, target; and what else the reference has where
# finer meshes are needed, in the sweep too. The numbers of cells are even: the
# reference has one and a half times as many.
SCENES = {
    "centre crack": (PRM / "raous1980_body.prm", [
        "Geometry/Shape=centre crack", "Geometry/Crack length=0.4",
        "Geometry/Subdivisions=10, 6", "Boundary/Fixed points=automatic",
        "Loads/Traction=0; 10*sin(2*pi*t/600) - 2",
        "Periodic state/Tolerance=0", "Periodic state/Maximum periods=2",
        "Contact/Solver=automatic",
        "Output/Probes=lip: 0, 0; inside: 0.7, 0.2"], 5e-3),
    "creeping plate": (PRM / "raous1980_body.prm", [
        "Geometry/Shape=rectangle", "Geometry/Subdivisions=4, 4",
        "Material/Plane state=plane strain", "Material/Relaxation time=200",
        "Boundary/Clamped=0", "Boundary/Fixed points=none",
        "Loads/Traction=0; 10*(1 - cos(2*pi*t/600))*x",
        "Periodic state/Tolerance=0", "Periodic state/Maximum periods=2",
        "Contact/Solver=automatic",
        "Output/Probes=corner: 1, 1; inside: 0.5, 0.5"], 1e-3),
    "ageing": (PRM / "ageing.prm", [
        "Geometry/Subdivisions=8, 4", "Output/Probes=inside: 0.75, 0.25; "
        "top: 0.5, 1"], 1e-2),
    # The stress at the mouth, a corner, is a tenth of that elsewhere.
    "two materials": (PRM / "bimaterial.prm", [
        "Geometry/Subdivisions=8, 4",
        "Output/Probes=mouth: 1, 0; slow: 0.3, 0.5; fast: 0.9, 0.4"], 5e-2),
    "thermal fatigue": (PRM / "thermal_fatigue.prm", [
        "Geometry/Subdivisions=10, 4", "Periodic state/Maximum periods=3",
        "Periodic state/Tolerance=0", "Output/Probes=edge: 50, 25; inside: 30, 10"], 2e-2),
    "box": (PRM / "cracked_box.prm", [
        "Geometry/Subdivisions=4, 2, 2",
        "Output/Probes=above: 1, 0.5, 0.25; centre: 0.25, 0.5, 0.25"], 5e-2),
    "gap and chain": (PRM / "raous1980_body.prm", [
        "Geometry/Subdivisions=8, 4", "Geometry/Crack length=0.25",
        "Boundary/Gap=-4e-4*(x - 0.75)", "Contact/Solver=automatic",
        "Material/Viscosity=chain", "Material/Relaxation time=",
        "Material/Chain=0.5: 30; 0.3: 300",
        "Loads/Traction=0; 10*sin(2*pi*t/600) - 3*cos(4*pi*t/600)",
        "Periodic state/Method=anderson", "Periodic state/Tolerance=1e-6",
        # Not on the lip itself: its stress, where the end of contact passes by,
        # asks for 260 000 unknowns and more.
        "Output/Probes=above: 0.875, 0.25; top: 0.25, 1; inside: 0.5, 0.5"], 1e-2),
    "slow, graded material": (PRM / "raous1980_body.prm", [
        "Geometry/Subdivisions=8, 4", "Contact/Solver=automatic",
        "Material/Young modulus=13000*(1 + x*x + y)",
        "Material/Relaxation time=2000*(1 + x)",
        "Loads/Traction=0; 10*sin(2*pi*t/600) - 1",
        "Periodic state/Tolerance=0", "Periodic state/Maximum periods=8",
        "Output/Probes=mouth: 1, 0; inside: 0.75, 0.25"], 1e-2,
        # The stress at the mouth, a corner, converges slowly, and to locate the
        # events of so many nodes takes thousands of contact problems a period.
        ["Geometry/Refinements=3", "Refinement/Target unknowns=55296",
         "Time integration/Scheme=sdirk2", f"{STEPS}=160",
         "Time integration/Locate contact events=false"]),
    "steam turbine": (PRM / "crack_growth.prm", [
        "Geometry/Subdivisions=10, 8",
        "Output/Probes=mouth: 50, 0; inside: 30, 20; far: 10, 80"], 2e-2,
        ["Time integration/Scheme=sdirk2", f"{STEPS}=192",
         "Time integration/Locate contact events=false"]),
    # The lip closes and opens from the mouth, in bending.
    "bent to and fro": (PRM / "raous1980_body.prm", [
        "Geometry/Subdivisions=8, 4", "Contact/Solver=automatic",
        "Material/Plane state=plane strain", "Material/Poisson ratio=0.3",
        "Material/Relaxation time=300",
        "Loads/Traction=0; 20*(x - 0.4)*sin(2*pi*t/600) + 2*sin(6*pi*t/600)",
        "Periodic state/Tolerance=0", "Periodic state/Maximum periods=3",
        "Output/Probes=above: 0.75, 0.25; top: 0.5, 1; side: 0, 0.5"], 1e-2),
    "late closing": (ROOT / "tests/hard/late_closing.prm", [
        "Geometry/Subdivisions=4, 4", "Loads/Traction=-10*(1 + y*cos(2*pi*t/60)); 0",
        "Output/Probes=end: 0.5, 0; body: 0.3, 0.6"], 5e-3),
}


def call(program, *words, allowed=(0,)):
    process = subprocess.run([str(program), *map(str, words)], text=True,
                             capture_output=True, stdin=subprocess.DEVNULL)
    if process.returncode not in allowed:
        sys.exit(f"{words}: status {process.returncode}\n{process.stderr}")
    return process.returncode


def options(name, settings):
    return [word for setting in settings for word in ("--" + name, setting)]


def parameter(used, name):
    """The value that used.prm has for a parameter."""
    return re.search(rf"set {name} +=([^#\n]*)", used)[1].strip()


class Body:
    """What the sweep and the reference must know of a scene."""

    def __init__(self, used):
        self.cells = [int(n) for n in parameter(used, "Subdivisions").split(",")]
        self.in_space = len(self.cells) == 3
        shape = parameter(used, "Shape")
        self.tip = "crack" in shape
        self.gap = parameter(used, "Gap") != "0"
        self.lip = self.tip or parameter(used, "Contact") not in ("automatic", "none")
        self.period = float(parameter(used, "Period"))
        # A factor of its own at each instant.
        self.slow = "theta" in parameter(used, "Young modulus")
        own = int(parameter(used, "Steps per period"))
        self.fewest = next((n for n in range(10, 20) if own % n == 0), 10)


def meshes(body, finer):
    """Degree, functions, refinements, strategy and cycles of the sweep."""
    fewer = body.in_space
    found = [(1, 0, r, "none", 0) for r in range(2 if fewer else 4)]
    found += [(2, 0, r, "none", 0) for r in range(2 if fewer else 3)]
    if body.tip:
        found += [(1, 0, r, "tip", 4 + r) for r in range(2 if fewer else 3)]
        found += [(2, 0, r, "tip", 6 + 2 * r) for r in range(1 if fewer else 3)]
    if body.tip and not fewer and not body.gap:
        found += [(d, 2, r, "none", 0) for d in (1, 2) for r in range(3)]
    if not fewer:
        found += [(2, 0, 0, "adaptive", c) for c in (4, 8)]
    if finer:
        found += [(2, 0, 3, "none", 0), (2, 0, 3, "tip", 12), (2, 2, 3, "none", 0)]
    return found


def steps(body):
    """Schemes, steps and whether contact events are located, as advise has them."""
    found = []
    for scheme, n_levels in (("heun", 4), ("rk4", 2), ("sdirk2", 4),
                             ("trapezoid", 4)):
        found += [(scheme, str(body.fewest << k),
                   "true" if scheme == "rk4" and body.lip else "false")
                  for k in range(min(n_levels, 3 if body.in_space else 4))]
    return found


def replaced(settings, others):
    """Settings of the same name by the others."""
    values = dict(setting.split("=", 1) for setting in [*settings, *others])
    return [f"{name}={value}" for name, value in values.items()]


def zipped(names, rows):
    return " & ".join(f"{name}={'; '.join(str(row[k]) for row in rows)};"
                      for k, name in enumerate(names))


def reference_settings(body):
    """Neither the mesh nor the scheme of what is advised: in the plane other cells,
    that are smaller everywhere and adapted where the stress varies; many steps."""
    settings = ["Discretisation/Degree=2", "Discretisation/Singular functions=0",
                "Contact/Solver=automatic", "Geometry/Refinements=2"]
    if body.in_space:
        settings += ["Refinement/Strategy=" + ("tip" if body.tip else "none"),
                     "Refinement/Cycles=5"]
    else:
        cells = ", ".join(str(3 * n // 2) for n in body.cells)
        # Half of them more than before adaption.
        unknowns = round(1.5 * 8 * 16 * 1.5**2) * math.prod(body.cells)
        settings += [f"Geometry/Subdivisions={cells}", "Refinement/Strategy=adaptive",
                     f"Refinement/Target unknowns={unknowns}"]
    if body.slow:
        return settings + [f"{STEPS}={16 * body.fewest}",
                           "Time integration/Scheme=sdirk2"]
    return settings + ["Time integration/Scheme=rk4",
                       f"{STEPS}={(4 if body.in_space else 8) * body.fewest}",
                       "Time integration/Step control=uniform",
                       "Time integration/Locate contact events=" +
                       ("true" if body.lip else "false")]


def table(directory, name):
    with open(directory / f"probe_{name}.csv") as file:
        rows = list(csv.reader(file))
    return {column: [float(row[i]) for row in rows[1:]]
            for i, column in enumerate(rows[0])}


def error(directory, reference, probes, period, periodic, left_out):
    """The largest relative error of u and s of all probes, as doc/advise.md
    defines it; independent of the program's own."""
    worst = 0.
    for name in probes:
        mine, theirs = table(directory, name), table(reference, name)
        if periodic:
            for one in (mine, theirs):
                begin = one["t"][-1] - period
                keep = [i for i, t in enumerate(one["t"])
                        if t >= begin - 1e-6 * period]
                for column in list(one):
                    one[column] = [one[column][i] for i in keep]
                one["t"] = [t - one["t"][0] for t in one["t"]]
        places = {round(t / period, 7): i for i, t in enumerate(theirs["t"])}
        common = [(i, places[round(t / period, 7)])
                  for i, t in enumerate(mine["t"])
                  if round(t / period, 7) in places]
        assert len(common) >= 10, f"{directory}: few instants in common"
        for kind in "us":
            if f"probe_{name}/{kind}" in left_out:
                continue
            difference = size = 0.
            for column in mine:
                if not column.startswith(kind + "_"):
                    continue
                a = [mine[column][i] for i, _ in common]
                b = [theirs[column][j] for _, j in common]
                means = ((statistics.mean(a), statistics.mean(b))
                         if periodic and kind == "u" else (0., 0.))
                difference = max(difference, *(
                    abs((x - means[0]) - (y - means[1])) for x, y in zip(a, b)))
                size = max(size, *(abs(y - means[1])
                                   for y in theirs[column]))
            worst = max(worst, difference / size)
    return worst


def seconds(program, probe, scenes, where):
    """The least of several measurements of each scene, taken in turns: CPU
    seconds, as a sweep of one point tells them."""
    least = [math.inf] * len(scenes)
    for repetition in range(5):
        for k, file in enumerate(scenes):
            directory = where / "timed"
            shutil.rmtree(directory, ignore_errors=True)
            call(program, "sweep", file, "--output", directory, "--vary",
                 "Title=timed", "--exact", f"probe_{probe}/u_1=t")
            row = next(csv.DictReader(open(directory / "sweep.csv")))
            least[k] = min(least[k], float(row["processor_seconds"]))
    return least


def total_seconds(folders):
    """Of all runs that have ended."""
    results = [json.loads((folder / "finished.json").read_text())
               for folder in folders]
    return sum((result.get("costs") or {}).get("processor_seconds", 0.)
               for result in results)


def in_words(used):
    """Settings of a point of the sweep."""
    functions, refinements, strategy = (
        parameter(used, name)
        for name in ("Singular functions", "Refinements", "Strategy"))
    words = "degree " + parameter(used, "Degree")
    words += ", singular functions" if functions != "0" else ""
    words += f", refined {refinements} times" if refinements != "0" else ""
    if strategy != "none":
        words += f", {strategy} in {parameter(used, 'Cycles')} cycles"
    return (f"{words}; {parameter(used, 'Scheme')}, "
            f"{parameter(used, 'Steps per period')} steps")


def advice_of(program, scene, target, common, where):
    status = call(program, "advise", scene, "--error", target, "--output",
                  where / "advice", "--quiet", *common, allowed=(0, 3))
    return status, json.loads((where / "advice/advice.json").read_text())


def full_sweep(program, scene, common, body, advice, target, finer, where):
    """All meshes with all steps; where the state is periodic, found as advised."""
    search, finest = [], []
    if advice["periodic_state"]:
        changes = advice["changes"]
        method = changes.get("[Periodic state] Method", {}).get("is", "automatic")
        tolerance = changes["[Periodic state] Tolerance"]["is"]
        search = [f"Periodic state/Method={method}",
                  f"Periodic state/Tolerance={tolerance}",
                  "Periodic state/Maximum periods=200"]
        finest = ["Periodic state/Method=automatic",
                  f"Periodic state/Tolerance={target / 1000}",
                  "Periodic state/Maximum periods=200"]
    space = zipped(["Discretisation/Degree", "Discretisation/Singular functions",
                    "Geometry/Refinements", "Refinement/Strategy",
                    "Refinement/Cycles"], meshes(body, finer))
    time = zipped(["Time integration/Scheme", STEPS,
                   "Time integration/Locate contact events"], steps(body))
    call(program, "sweep", scene, "--output", where / "sweep", "--quiet",
         *common, "--set", "Contact/Solver=automatic",
         *options("set", search), "--vary", space, "--vary", time,
         *options("reference", replaced(reference_settings(body) + finest, finer)),
         "--error", "probe_" + advice["counts"][0].split("_", 1)[1])
    with open(where / "sweep/sweep.csv") as file:
        return [row for row in csv.DictReader(file) if row["status"] == "done"]


def judge(program, name):
    scene, settings, target, *finer = SCENES[name]
    where = pathlib.Path(name.replace(" ", "_"))
    where.mkdir(exist_ok=True)
    common = options("set", settings)
    status, advice = advice_of(program, scene, target, common, where)
    runs = where / "advice/runs"
    # Of the scene itself, which may be too coarse to run.
    body = Body(subprocess.run([program, scene, *common, "--print-parameters"],
                               text=True, capture_output=True, check=True).stdout)
    points = full_sweep(program, scene, common, body, advice, target,
                        finer[0] if finer else [], where)

    probes = sorted({quantity.split("/")[0][6:] for quantity in
                     advice["counts"] + advice["left_out"]})

    def error_of(folder):
        return error(folder, where / "sweep/reference", probes, body.period,
                     advice["periodic_state"], advice["left_out"])

    points = sorted((float(row["processor_seconds"]),
                     error_of(where / "sweep" / row["point"]), row["point"])
                    for row in points)
    good = [point for point in points if point[1] <= target]
    result = {"status": status, "target": target, "error": error_of(runs / advice["run"]),
              "choice": advice["choice"], "n_points": len(points),
              "left_out": advice["left_out"],
              "error_of_its_reference": error_of(runs / advice["reference"])
              if advice["reference"] else None,
              "error_of_the_finest_points": sorted(p[1] for p in points)[:3],
              "seconds_of_advise": total_seconds(
                  folder for folder in runs.iterdir() if folder.name != "original"),
              "seconds_of_sweep": total_seconds(
                  where / "sweep" / point[2] for point in points)}
    if good:
        # One measurement is noisy: the cheapest ones are measured again.
        own, *others = seconds(
            program, probes[0], [where / "advice/advised.prm"] +
            [where / "sweep" / point[2] / "used.prm" for point in good[:4]],
            where)
        best = others.index(min(others))
        used = (where / "sweep" / good[best][2] / "used.prm").read_text()
        result.update(best=in_words(used), best_error=good[best][1],
                      seconds=own, best_seconds=others[best])
    (where / "result.json").write_text(json.dumps(result, indent=1))
    return result


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    names = sys.argv[2:] or list(SCENES)
    print("| scene | target | true error | advised | seconds | best of the sweep "
          "| its error | its seconds | ratio | advise / sweep |\n|" + "---|" * 10)
    for name in names:
        r = judge(program, name)
        best = (f"{r['seconds']:.3f} | {r['best']} | {r['best_error']:.1e} | "
                f"{r['best_seconds']:.3f} | {r['seconds'] / r['best_seconds']:.2f}"
                if "best" in r else
                f"| none of {r['n_points']} points reaches it | | |")
        print(f"| {name} | {r['target']:g} | {r['error']:.1e} | {r['choice']} | {best} "
              f"| {r['seconds_of_advise']:.0f} s / {r['seconds_of_sweep']:.0f} s |",
              flush=True)


main()
