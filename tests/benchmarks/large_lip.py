"""Six Heun steps of a slab in space whose lip of 700 to 11 000 nodes opens and
closes in parts: sets for each contact problem, iterations of conjugate gradients
for each set, seconds.

    OMP_NUM_THREADS=1 /usr/bin/python3 tests/benchmarks/large_lip.py build/crevasse"""

import json
import pathlib
import subprocess
import sys
import tempfile

SCENE = pathlib.Path(__file__).resolve().parents[2] / "prm/cracked_box.prm"
SETTINGS = {
    "Geometry/Width": "1.12", "Geometry/Height": "0.16",
    "Geometry/Thickness": "1.12", "Geometry/Crack length": "0.96",
    "Geometry/Subdivisions": "28, 2, 28",
    "Discretisation/Degree": "1",
    "Loads/Traction": "0; 10*sin(2*pi*t/600) - 3"
                      " + 30*(z/2.24 - 0.25)*cos(4*pi*t/600); 0",
    "Time integration/Steps per period": "6",
    "Periodic state/Maximum periods": "1", "Periodic state/Tolerance": "0",
    "Output/Probes": "", "Output/Fields": "none",
}


def run(program, settings):
    with tempfile.TemporaryDirectory() as directory:
        command = [program, SCENE, "--quiet", "--output", directory]
        for name, value in {**SETTINGS, **settings}.items():
            command += ["--set", f"{name}={value}"]
        # Not periodic after one period: status 3, with all results.
        subprocess.run(command, check=False, stderr=subprocess.DEVNULL)
        return json.loads((pathlib.Path(directory) / "summary.json").read_text())


def main():
    print("solver  unknowns    lip  sets  iterations  seconds")
    for solver in sys.argv[2:] or ["gmg"]:
        for refinements in range(3):
            summary = run(sys.argv[1], {
                "Geometry/Refinements": str(refinements),
                "Linear solver/Type": solver})
            counters = summary["counters"]
            sets = counters["vi_iterations"]
            print(f"{solver:8}{summary['unknowns']:8} "
                  f"{summary['contact_nodes']:6} "
                  f"{sets / counters['vi_solves']:5.1f} "
                  f"{counters['linear_iterations'] / sets:11.1f} "
                  f"{summary['seconds']['total']:8.1f}")


if __name__ == "__main__":
    main()
