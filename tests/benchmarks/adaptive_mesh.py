"""Time of an adaptive run over five periods in which the crack opens and closes
against that of a uniform mesh with 64 times the cells of the paper's, and the
error of both against that mesh with singular functions; then what adaptation from
13 122 to 30 000 unknowns costs, in parts of the solve on the last mesh.
Alternating runs, medians.

    OMP_NUM_THREADS=1 /usr/bin/python3 tests/benchmarks/adaptive_mesh.py build/crevasse"""

import csv
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

SCENE = (pathlib.Path(__file__).resolve().parents[2]
         / "prm/studies/crack_tip_adaptive.prm")
UNIFORM = ["Refinement/Strategy=none", "Geometry/Subdivisions=112, 32"]
CASES = {
    "uniform with singular functions":
        UNIFORM + ["Discretisation/Singular functions=2"],
    "uniform": UNIFORM,
    "adaptive": [],
    "adaptive, again after period 4":
        ["Refinement/Readapt every=4", "Refinement/Target unknowns=1500"],
    "14 x 4 cells with singular functions":
        ["Refinement/Strategy=none", "Geometry/Subdivisions=14, 4",
         "Discretisation/Singular functions=2"],
}
PAPER = SCENE.parents[1] / "raous1980.prm"
ELASTIC = ["Contact/Solver=automatic", "Material/Viscosity=none",
           "Time integration/Steps per period=4",
           "Periodic state/Maximum periods=1", "Output/Fields=none",
           "Geometry/Subdivisions=40, 40", "Discretisation/Degree=2"]
TO_30000 = ["Refinement/Strategy=adaptive", "Refinement/Target unknowns=30000"]
REPETITIONS = 5


def run(program, settings):
    """Unknowns, seconds and the opening at the mouth over time."""
    with tempfile.TemporaryDirectory() as directory:
        command = [program, SCENE, "--quiet", "--output", directory]
        for setting in settings:
            command += ["--set", setting]
        subprocess.run(command, check=True)
        folder = pathlib.Path(directory)
        summary = json.loads((folder / "summary.json").read_text())
        with open(folder / "probe_C.csv", newline="") as file:
            opening = [float(row["opening"]) for row in csv.DictReader(file)]
    return summary["unknowns"], summary["seconds"]["total"], opening


def cpu_seconds(program, directory, settings, *options):
    before = os.times()
    command = [program, PAPER, "--quiet", "--output", directory, *options]
    for setting in ELASTIC + settings:
        command += ["--set", setting]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    after = os.times()
    return sum(after[k] - before[k] for k in (2, 3))


def adaptation():
    """--check adapts, but does not solve after that."""
    for name, more in (("several divisions an estimate", []),
                       ("one division an estimate", ["Refinement/Cycles=99"])):
        parts = []
        for _ in range(REPETITIONS):
            with tempfile.TemporaryDirectory() as directory:
                settings = TO_30000 + more
                start = cpu_seconds(sys.argv[1], directory, [], "--check")
                adapted = cpu_seconds(sys.argv[1], directory, settings, "--check")
                whole = cpu_seconds(sys.argv[1], directory, settings)
                summary = json.loads(
                    (pathlib.Path(directory) / "summary.json").read_text())
            meshes = summary["refinement"]["meshes"]
            last = whole - adapted + meshes[-1]["seconds"]
            parts.append((adapted - start) / last)
        print(f"{name}: {len(meshes)} meshes, {meshes[-1]['unknowns']} unknowns, "
              f"error {meshes[-1]['estimated_error']:.2e}, adaptation "
              f"{statistics.median(parts):.1f} times the last solve")


def main():
    runs = {name: [] for name in CASES}
    for _ in range(REPETITIONS):
        for name, settings in CASES.items():
            runs[name].append(run(sys.argv[1], settings))
    exact = runs["uniform with singular functions"][0][2]
    slow = statistics.median(r[1] for r in runs["uniform"])
    print(f"{'mesh':38} {'unknowns':>8} {'error':>8} {'seconds':>8}  part")
    for name, results in runs.items():
        error = max(abs(a - b) for a, b in
                    zip(results[0][2], exact, strict=True)) / max(exact)
        seconds = statistics.median(r[1] for r in results)
        print(f"{name:38} {results[0][0]:8} {error:8.1e} {seconds:8.3f}  "
              f"1/{slow / seconds:.1f}")


main()
adaptation()
