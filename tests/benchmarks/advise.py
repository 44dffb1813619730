"""Does `crevasse advise` keep what it promises, on scenes that it was not tuned on?
For each scene: the true error of the advised settings against an independent, much
finer run, and their cost beside the cheapest point of a full sweep, the product of
meshes and steps, that reaches the error.

    OMP_NUM_THREADS=1 /usr/bin/python3 tests/benchmarks/advise.py build/crevasse [SCENE ...]

Costs are seconds of the processor, the least of three. Without names
all scenes are computed, some minutes; what is finished in the working directory is
not computed again."""

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

# Scene, settings that make it small, target.
SCENES = {
    "centre crack": (PRM / "raous1980_body.prm", [
        "Geometry/Shape=centre crack", "Geometry/Crack length=0.4",
        "Geometry/Subdivisions=10, 6", "Boundary/Fixed points=automatic",
        "Loads/Traction=0; 10*sin(2*pi*t/600) - 2",
        "Periodic state/Tolerance=0", "Periodic state/Maximum periods=2",
        "Contact/Solver=automatic",
        "Output/Probes=lip: 0, 0; inside: 0.7, 0.2"], 5e-3),
    "thermal fatigue": (PRM / "thermal_fatigue.prm", [
        "Geometry/Subdivisions=10, 6", "Periodic state/Maximum periods=3",
        "Output/Probes=edge: 50, 25; inside: 30, 10"], 2e-2),
    "ageing": (PRM / "ageing.prm", [
        "Geometry/Subdivisions=8, 4", "Output/Probes=inside: 0.75, 0.25; "
        "top: 0.5, 1"], 1e-2),
    "two materials": (PRM / "bimaterial.prm", [
        "Geometry/Subdivisions=8, 4",
        "Output/Probes=mouth: 1, 0; slow: 0.3, 0.5; fast: 0.9, 0.4"], 1e-2),
    "box": (PRM / "cracked_box.prm", [
        "Geometry/Subdivisions=4, 2, 2",
        "Output/Probes=front: 1, 0, 0; centre: 0.25, 0.5, 0.25"], 3e-2),
    "creeping plate": (PRM / "raous1980_body.prm", [
        "Geometry/Shape=rectangle", "Geometry/Subdivisions=4, 4",
        "Material/Plane state=plane strain", "Material/Relaxation time=200",
        "Boundary/Clamped=0", "Boundary/Fixed points=none",
        "Loads/Traction=0; 10*(1 - cos(2*pi*t/600))*x",
        "Periodic state/Tolerance=0", "Periodic state/Maximum periods=2",
        "Contact/Solver=automatic",
        "Output/Probes=corner: 1, 1; inside: 0.5, 0.5"], 1e-3),
}


def call(program, *words, allowed=(0,)):
    process = subprocess.run([str(program), *map(str, words)], text=True,
                             capture_output=True, stdin=subprocess.DEVNULL)
    if process.returncode not in allowed:
        sys.exit(f"{words}: status {process.returncode}\n{process.stderr}")
    return process.returncode


def options(name, settings):
    return [word for setting in settings for word in ("--" + name, setting)]


def three_dimensional(scene):
    return "Dimension = 3" in scene.read_text()


def meshes(scene, cracked):
    """Degree, functions, refinements, strategy and cycles of the sweep."""
    fewer = three_dimensional(scene)
    found = [(1, 0, r, "none", 0) for r in range(2 if fewer else 4)]
    found += [(2, 0, r, "none", 0) for r in range(2 if fewer else 3)]
    if cracked:
        found += [(1, 0, r, "tip", 4 + r) for r in range(2 if fewer else 3)]
        found += [(2, 0, r, "tip", 6 + 2 * r) for r in range(1 if fewer else 3)]
    if cracked and not fewer:
        found += [(d, 2, r, "none", 0) for d in (1, 2) for r in range(3)]
    if not fewer:
        found += [(2, 0, 0, "adaptive", c) for c in (4, 8)]
    return found


def steps(scene, cracked):
    """Schemes, steps and whether contact events are located, as advise has them."""
    fewer = three_dimensional(scene)
    found = []
    for scheme, n_levels in (("heun", 4), ("rk4", 2), ("sdirk2", 4),
                             ("trapezoid", 4)):
        found += [(scheme, str(10 << k),
                   "true" if scheme == "rk4" and cracked else "false")
                  for k in range(min(n_levels, 3 if fewer else 5))]
    return found


def zipped(names, rows):
    return " & ".join(f"{name}={'; '.join(str(row[k]) for row in rows)};"
                      for k, name in enumerate(names))


def reference_settings(scene, cracked):
    """Neither the mesh nor the scheme of what is advised: an adaptive mesh in the
    plane, one that is halved in space, and many steps."""
    settings = ["Discretisation/Degree=2", "Discretisation/Singular functions=0",
                "Contact/Solver=automatic"]
    if three_dimensional(scene):
        settings += ["Geometry/Refinements=2", "Refinement/Strategy=" +
                     ("tip" if cracked else "none"), "Refinement/Cycles=5"]
        n = 40
    else:
        settings += ["Geometry/Refinements=1", "Refinement/Strategy=adaptive",
                     "Refinement/Target unknowns=12000"]
        n = 80
    if "thermal" in scene.name:
        # Each instant has a factor of its own: few of them, on a smaller mesh.
        return settings[:-1] + [
            "Refinement/Target unknowns=6000", f"{STEPS}=160",
            "Time integration/Scheme=sdirk2"]
    return settings + ["Time integration/Scheme=rk4", f"{STEPS}={n}",
                       "Time integration/Step control=uniform",
                       "Time integration/Locate contact events=" +
                       ("true" if cracked else "false")]


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
    """The least of three measurements of each scene, taken in turns: seconds of the
    processor, as a sweep of one point tells them."""
    least = [math.inf] * len(scenes)
    for repetition in range(3):
        for k, file in enumerate(scenes):
            directory = where / "timed"
            shutil.rmtree(directory, ignore_errors=True)
            call(program, "sweep", file, "--output", directory, "--vary",
                 "Title=timed", "--exact", f"probe_{probe}/u_1=t")
            row = next(csv.DictReader(open(directory / "sweep.csv")))
            least[k] = min(least[k], float(row["processor_seconds"]))
    return least


def in_words(used):
    """Settings of a point of the sweep."""
    values = {name: re.search(rf"set {name} +=([^#\n]*)", used)[1].strip()
              for name in ("Degree", "Singular functions", "Refinements", "Strategy",
                           "Cycles", "Scheme", "Steps per period")}
    return (f"degree {values['Degree']}, {values['Singular functions']} functions, "
            f"{values['Refinements']} refinements, {values['Strategy']} "
            f"{values['Cycles']}; {values['Scheme']} "
            f"{values['Steps per period']}")


def judge(program, name):
    scene, settings, target = SCENES[name]
    cracked = "Geometry/Shape=rectangle" not in settings
    where = pathlib.Path(name.replace(" ", "_"))
    where.mkdir(exist_ok=True)
    common = options("set", settings)
    status = call(program, "advise", scene, "--error", target, "--output",
                  where / "advice", "--quiet", *common, allowed=(0, 3))
    advice = json.loads((where / "advice/advice.json").read_text())

    periodic = advice["periodic_state"]
    search = []
    if periodic:
        changes = advice["changes"]
        method = changes.get("[Periodic state] Method", {}).get("is", "automatic")
        tolerance = changes["[Periodic state] Tolerance"]["is"]
        search = [f"Periodic state/Method={method}",
                  f"Periodic state/Tolerance={tolerance}",
                  "Periodic state/Maximum periods=200"]
    finest = ([f"Periodic state/Tolerance={target / 1000}",
               "Periodic state/Method=automatic",
               "Periodic state/Maximum periods=200"] if periodic else [])
    space = zipped(["Discretisation/Degree", "Discretisation/Singular functions",
                    "Geometry/Refinements", "Refinement/Strategy",
                    "Refinement/Cycles"], meshes(scene, cracked))
    time = zipped(["Time integration/Scheme", STEPS,
                   "Time integration/Locate contact events"],
                  steps(scene, cracked))
    call(program, "sweep", scene, "--output", where / "sweep", "--quiet",
         *common, "--set", "Contact/Solver=automatic",
         *options("set", search), "--vary", space, "--vary", time,
         *options("reference", reference_settings(scene, cracked) + finest),
         "--error", "probe_" + advice["counts"][0].split("_", 1)[1])

    probes = sorted({quantity.split("/")[0][6:] for quantity in
                     advice["counts"] + advice["left_out"]})
    used = (where / "sweep/reference/used.prm").read_text()
    period = float(re.search(r"set Period +=(\S| )+", used)[0].split("=")[1]
                   .split("#")[0])
    reference = where / "sweep/reference"
    measured = error(where / "advice/runs" / advice["run"], reference, probes,
                     period, periodic, advice["left_out"])
    points = []
    for row in csv.DictReader(open(where / "sweep/sweep.csv")):
        if row["status"] == "done":
            found = error(where / "sweep" / row["point"], reference, probes,
                          period, periodic, advice["left_out"])
            points.append((float(row["processor_seconds"]), found, row["point"]))
    good = [point for point in points if point[1] <= target]
    result = {"status": status, "target": target, "error": measured,
              "choice": advice["choice"], "n_points": len(points),
              "left_out": advice["left_out"],
              "error of the finest points": sorted(p[1] for p in points)[:3]}
    if good:
        # One measurement is noisy: the cheapest ones are measured again.
        cheapest = sorted(good)[:4]
        own, *others = seconds(
            program, probes[0], [where / "advice/advised.prm"] +
            [where / "sweep" / point[2] / "used.prm" for point in cheapest],
            where)
        best = others.index(min(others))
        used = (where / "sweep" / cheapest[best][2] / "used.prm").read_text()
        result.update(best=in_words(used), best_error=cheapest[best][1],
                      seconds=own, best_seconds=others[best])
    (where / "result.json").write_text(json.dumps(result, indent=1))
    return result


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    names = sys.argv[2:] or list(SCENES)
    print("| scene | target | true error | advised | seconds | best of the sweep "
          "| its error | its seconds | ratio |\n|" + "---|" * 9)
    for name in names:
        r = judge(program, name)
        print(f"| {name} | {r['target']:g} | {r['error']:.1e} | {r['choice']} |",
              f"{r['seconds']:.3f} | {r['best']} | {r['best_error']:.1e} | "
              f"{r['best_seconds']:.3f} | {r['seconds'] / r['best_seconds']:.2f} |"
              if "best" in r else f"| none of {r['n_points']} points reaches it "
              "| | | |", flush=True)


main()
