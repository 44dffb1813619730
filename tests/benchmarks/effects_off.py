"""What an effect costs that a scene mentions but does not use: time per step
against the scene that does not mention it, on 240 x 240 cells. And what it costs
when it is on. Alternating runs, medians.

    OMP_NUM_THREADS=1 /usr/bin/python3 tests/benchmarks/effects_off.py build/crevasse [OTHER_PROGRAM]

With another program (an older build, which does not know the effects) its time
for the plain scene is the last row."""

import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

SCENE = pathlib.Path(__file__).resolve().parents[2] / "prm/raous1980.prm"
COMMON = ["Geometry/Subdivisions=240, 240", "Contact/Solver=automatic",
          "Periodic state/Maximum periods=1", "Periodic state/Tolerance=0",
          "Output/Fields=none"]
OFF = {
    "thermal strain": ["Material/Thermal expansion=1e-5"],
    "temperature alone": ["Loads/Temperature=100*sin(2*pi*t/600)"],
    "stiffness factor": ["Material/Stiffness time factor=1"],
    "viscosity factor": ["Material/Viscosity time factor=1"],
    "body force": ["Loads/Body force=0; 0"],
    "secular flow": ["Periodic state/Secular split=off"],
    "displaced boundary": ["Boundary/Displaced=none"],
    "open crack": ["Boundary/Open crack=none"],
    "pressure": ["Loads/Pressure=0"],
}
ON = {
    "thermal strain": ["Material/Thermal expansion=1e-5",
                       "Loads/Temperature=100*sin(2*pi*t/600)"],
    "stiffness factor": ["Material/Stiffness time factor=1+0.1*sin(2*pi*t/600)"],
    "two materials": ["Material/Young modulus=if(x<0.5, 13000, 12000)"],
    "chain of three": ["Material/Viscosity=chain",
                       "Material/Chain=0.5: 60; 0.3: 100; 0.2: 200"],
    "secular flow": ["Loads/Traction=0; 10*(sin(2*pi*t/600) - 0.1)"],
}
REPETITIONS = 3


def milliseconds_per_step(program, settings):
    """Of the time stepping, with and without the variational inequalities."""
    with tempfile.TemporaryDirectory() as directory:
        command = [program, SCENE, "--quiet", "--output", directory]
        for setting in COMMON + settings:
            command += ["--set", setting]
        subprocess.run(command, check=True)
        summary = json.loads(
            (pathlib.Path(directory) / "summary.json").read_text())
    seconds, n = summary["seconds"], summary["counters"]["vi_solves"]
    whole = seconds["time stepping"] / n
    return 1e3 * whole, 1e3 * (whole - seconds["vi_mean"])


def main():
    program = sys.argv[1]
    cases = {"plain": (program, [])}
    cases.update({name + ", off": (program, s) for name, s in OFF.items()})
    cases.update({name + ", on": (program, s) for name, s in ON.items()})
    if len(sys.argv) > 2:
        cases["plain, other program"] = (sys.argv[2], [])
    times = {name: [] for name in cases}
    for _ in range(REPETITIONS):
        for name, (executable, settings) in cases.items():
            times[name].append(milliseconds_per_step(executable, settings))
    median = {name: [statistics.median(column) for column in zip(*runs)]
              for name, runs in times.items()}
    print("| | ms per evaluation | ratio | without the inequality | ratio |")
    print("|---|---|---|---|---|")
    base = median["plain"]
    for name, (whole, rest) in median.items():
        print(f"| {name} | {whole:.1f} | {whole / base[0]:.2f} "
              f"| {rest:.1f} | {rest / base[1]:.2f} |")


main()
