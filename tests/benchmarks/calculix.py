"""CPU seconds of CalculiX (Debian's calculix-ccx, 2.20) and of the program for
the same scene: a plate in plane strain with an edge crack, 56 x 56 bilinear cells
with mean dilatation, viscosity without change of volume, 160 steps in four periods.

CalculiX creeps by Norton's law with the exponent 1, implicitly; one-sided contact
are gap elements between the lip and the ground. It may not reach the end: its
seconds are then those of the increments that it did, in proportion to all.

    OMP_NUM_THREADS=1 /usr/bin/python3 tests/benchmarks/calculix.py build/crevasse"""

import csv
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

N, PERIODS, STEPS, PERIOD = 56, 4, 40, 600.
YOUNG, POISSON, VISCOUS, LOAD = 13000., 0.3, 780000., 10.
SCENE = f"""
subsection Geometry
  set Subdivisions = {N}, {N}
end
subsection Material
  set Plane state = plane strain
  set Young modulus = {YOUNG}
  set Poisson ratio = {POISSON}
  set Viscosity = isotropic
  set Viscous modulus = {VISCOUS}
  set Viscous Poisson ratio = 0.5
end
subsection Discretisation
  set Degree = 1
  set Volumetric strain = mean
end
subsection Loads
  set Period = {PERIOD}
  set Traction = 0; {LOAD}*sin(2*pi*t/{PERIOD})
end
subsection Time integration
  set Steps per period = {STEPS}
end
subsection Periodic state
  set Maximum periods = {PERIODS}
  set Tolerance = 0
end
subsection Output
  set Fields = none
  set Probes = mouth: 1, 0
end
"""


def node(i, j, k):
    return 1 + i + (N + 1) * (j + (N + 1) * k)


def deck():
    """One layer of bricks whose sides do not move in z: plane strain."""
    plane = [(i, j) for j in range(N + 1) for i in range(N + 1)]
    cells = [(i, j) for j in range(N) for i in range(N)]
    lip = [(node(i, 0, k), i) for i in range(N // 2 + 1, N + 1) for k in (0, 1)]
    ground = {n: 100000 + n for n, _ in lip}
    instants = [PERIOD / STEPS * n for n in range(PERIODS * STEPS + 1)]
    lines = ["*NODE"] + [f"{node(i, j, k)}, {i / N}, {j / N}, {k / N}"
                            for k in (0, 1) for i, j in plane]
    lines += [f"{ground[n]}, {i / N}, 0., {int(n > node(N, N, 0)) / N}"
              for n, i in lip]
    lines += ["*ELEMENT, TYPE=C3D8, ELSET=BODY"] + [
        f"{1 + i + N * j}, " + ", ".join(
            str(node(i + a, j + b, k)) for k in (0, 1)
            for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))) for i, j in cells]
    for number, (n, _) in enumerate(lip):
        lines += [f"*ELEMENT, TYPE=GAPUNI, ELSET=G{n}",
                  f"{10000 + number}, {ground[n]}, {n}",
                  f"*GAP, ELSET=G{n}", "0., 0., 1., 0., , 1.e6, 1.e-6"]
    lines += ["*MATERIAL, NAME=M", "*ELASTIC", f"{YOUNG}, {POISSON}",
              "*CREEP, LAW=NORTON", f"{1 / VISCOUS:.10e}, 1., 0.",
              "*SOLID SECTION, ELSET=BODY, MATERIAL=M"]
    lines += ["*BOUNDARY"] + [f"{node(i, j, k)}, 3, 3" for k in (0, 1)
                                 for i, j in plane]
    lines += [f"{g}, 1, 3" for g in ground.values()]
    lines += [f"{node(i, 0, k)}, 2, 2" for k in (0, 1)
              for i in range(N // 2 + 1)]
    lines += [f"{node(N // 2, 0, k)}, 1, 1" for k in (0, 1)]
    lines += ["*AMPLITUDE, NAME=SINE"] + [
        f"{t}, {math.sin(2 * math.pi * t / PERIOD):.10e}"
        for t in instants]
    lines += [f"*NSET, NSET=MOUTH\n{node(N, 0, 0)}",
              f"*STEP, INC={10 * len(instants)}", "*VISCO, DIRECT, CETOL=1.",
              f"{PERIOD / STEPS}, {PERIODS * PERIOD}",
              "*DLOAD, AMPLITUDE=SINE"]
    lines += [f"{1 + i + N * (N - 1)}, P5, {-LOAD}" for i in range(N)]
    lines += ["*NODE PRINT, NSET=MOUTH", "U", "*END STEP"]
    return "\n".join(lines) + "\n"


def cpu_seconds(command, folder):
    before = os.times()
    subprocess.run(command, cwd=folder, check=False, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    after = os.times()
    return (after.children_user - before.children_user
            + after.children_system - before.children_system)


def measure(program, folder):
    """CPU seconds of both, openings of the mouth of both over time."""
    (folder / "plate.inp").write_text(deck())
    (folder / "plate.prm").write_text(SCENE)
    ours = cpu_seconds([program, "plate.prm", "--quiet", "--output", "ours"],
                       folder)
    theirs = cpu_seconds(["ccx", "plate"], folder)
    with open(folder / "ours/probe_mouth.csv", newline="") as file:
        openings = [float(row["opening"]) for row in csv.DictReader(file)]
    printed = re.findall(r"time .*\n\n +\d+ +\S+ +(\S+)",
                         (folder / "plate.dat").read_text())
    return ours, theirs, openings, [float(value) for value in printed]


def main():
    runs = []
    for _ in range(3):
        with tempfile.TemporaryDirectory() as directory:
            runs.append(measure(pathlib.Path(sys.argv[1]).resolve(),
                                pathlib.Path(directory)))
    n = len(runs[0][3])
    ours = min(run[0] for run in runs)
    theirs = min(run[1] for run in runs)
    all_steps = PERIODS * STEPS
    print(f"Crevasse {ours:.2f} s for {all_steps} steps, CalculiX {theirs:.1f} s "
          f"for {n}: {theirs * all_steps / n / ours:.0f} times")
    quarter = STEPS // 4
    print(f"opening of the mouth at T/4: {runs[0][2][quarter]:.4e}, "
          f"{runs[0][3][quarter - 1]:.4e} (Euler's implicit scheme)")


if __name__ == "__main__":
    main()
