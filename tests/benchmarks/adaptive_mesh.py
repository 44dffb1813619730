"""Time of an adaptive run over five periods in which the crack opens and closes
against that of a uniform mesh with 64 times the cells of the paper's, and the
error of both against that mesh with singular functions. Alternating runs,
medians.

    OMP_NUM_THREADS=1 /usr/bin/python3 tests/benchmarks/adaptive_mesh.py build/crevasse"""

import csv
import json
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
