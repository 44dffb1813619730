"""A crack with two lips against the half model with as many unknowns and lip
nodes (100 000 and 500), 40 Heun steps: contact problems in back-solves with
their own factors, and seconds. The half model is taken before and after.

    OMP_NUM_THREADS=1 /usr/bin/python3 tests/benchmarks/two_lips.py build/crevasse"""

import json
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "runs"))
from cracked import at_edge, square_scene, steps, turned, write_block  # noqa: E402

SETTINGS = {
    "Contact/Solver": "condensed active set", "Linear solver/Type": "cholesky",
    "Periodic state/Maximum periods": "1", "Periodic state/Tolerance": "0",
    "Loads/Traction": "0; 10*sin(2*pi*t/600)*y*(1+x)",
    "Output/Probes": "", "Output/Fields": "none",
}


def run(program, folder, half, degrees):
    rows = 50 if half else 25
    mesh = folder / "plate.msh"
    heights = [0.2 * y for y in (steps(0, 1, rows) if half else steps(-1, 1, 2 * rows))]
    write_block(mesh, [steps(0, 1, 1000), heights], at_edge, turned(degrees))
    scene = folder / "plate.prm"
    scene.write_text(square_scene(mesh, degrees, half))
    command = [program, scene, "--quiet", "--output", folder / "results"]
    for name, value in SETTINGS.items():
        if degrees == 0 or name != "Loads/Traction":
            command += ["--set", f"{name}={value}"]
    # Not periodic after one period: status 3, with all results.
    subprocess.run(command, check=False, stderr=subprocess.DEVNULL)
    return json.loads((folder / "results/summary.json").read_text())


def main():
    print("model            unknowns  pairs   VIs  sets  VI in back-solves  step [s]")
    for name, half, degrees in (("half", True, 0), ("two lips", False, 0),
                                ("two lips, 17°", False, 17), ("half", True, 0)):
        with tempfile.TemporaryDirectory() as folder:
            summary = run(sys.argv[1], pathlib.Path(folder), half, degrees)
        counters, seconds = summary["counters"], summary["seconds"]
        n = counters["vi_solves"]
        per_solve = seconds["vi_mean"] / seconds["back_solve_mean"]
        print(f"{name:16} {summary['unknowns']:8} {summary['contact_nodes']:6} {n:5} "
              f"{counters['vi_iterations'] / n:5.2f} {per_solve:18.2f} "
              f"{seconds['time stepping'] / 40:9.3f}")


if __name__ == "__main__":
    main()
