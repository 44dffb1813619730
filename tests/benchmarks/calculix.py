"""CPU seconds of CalculiX (Debian's calculix-ccx, 2.20) and of the program for
the same scene: a plate in plane strain with an edge crack, 56 x 56 bilinear cells
with mean dilatation, viscosity without change of volume, 160 steps in four periods.

CalculiX creeps by Norton's law with the exponent 1, implicitly; one-sided contact
are gap elements between the lip and the ground. It may not reach the end: its
seconds are then those of the increments that it did, in proportion to all.

    OMP_NUM_THREADS=1 /usr/bin/python3 tests/benchmarks/calculix.py build/crevasse

With an exponent as second argument both creep by its power law, one period: errors
of the mouth's opening against what each program tends to with its steps, where the
lip is open, how far these limits differ, and the seconds. The elements of CalculiX
have incompatible modes then (C3D8I): its C3D8 locks, and agrees with Volumetric
strain = full.

    OMP_NUM_THREADS=1 /usr/bin/python3 tests/benchmarks/calculix.py build/crevasse 5"""

import csv
import math
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

N, PERIODS, STEPS, PERIOD = 56, 4, 40, 600.
YOUNG, POISSON, VISCOUS, LOAD = 13000., 0.3, 780000., 10.
COARSEST = 40  # steps of a period
UNIT = 20.  # the stress at which all exponents creep alike


def scene(n, exponent, steps, periods):
    law = f"""
  set Viscosity = isotropic
  set Viscous modulus = {VISCOUS}
  set Viscous Poisson ratio = 0.5""" if exponent == 1 else f"""
  set Viscosity = power law
  set Creep coefficient = {UNIT ** (1 - exponent) / VISCOUS}
  set Creep exponent = {exponent}"""
    return f"""
subsection Geometry
  set Subdivisions = {n}, {n}
end
subsection Material
  set Plane state = plane strain
  set Young modulus = {YOUNG}
  set Poisson ratio = {POISSON}{law}
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
  set Scheme = {"heun" if exponent == 1 else "sdirk2"}
  set Steps per period = {steps}
end
subsection Periodic state
  set Maximum periods = {periods}
  set Tolerance = 0
end
subsection Output
  set Fields = none
  set Probes = mouth: 1, 0
end
"""


def deck(n, exponent, steps, periods):
    """One layer of bricks whose sides do not move in z: plane strain."""
    def node(i, j, k):
        return 1 + i + (n + 1) * (j + (n + 1) * k)

    plane = [(i, j) for j in range(n + 1) for i in range(n + 1)]
    cells = [(i, j) for j in range(n) for i in range(n)]
    lip = [(node(i, 0, k), i) for i in range(n // 2 + 1, n + 1) for k in (0, 1)]
    ground = {one: 100000 + one for one, _ in lip}
    instants = [PERIOD / steps * k for k in range(periods * steps + 1)]
    lines = ["*NODE"] + [f"{node(i, j, k)}, {i / n}, {j / n}, {k / n}"
                            for k in (0, 1) for i, j in plane]
    lines += [f"{ground[one]}, {i / n}, 0., {int(one > node(n, n, 0)) / n}"
              for one, i in lip]
    lines += [f"*ELEMENT, TYPE={'C3D8' if exponent == 1 else 'C3D8I'}, ELSET=BODY"] + [
        f"{1 + i + n * j}, " + ", ".join(
            str(node(i + a, j + b, k)) for k in (0, 1)
            for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))) for i, j in cells]
    for number, (one, _) in enumerate(lip):
        lines += [f"*ELEMENT, TYPE=GAPUNI, ELSET=G{one}",
                  f"{10000 + number}, {ground[one]}, {one}",
                  f"*GAP, ELSET=G{one}", "0., 0., 1., 0., , 1.e6, 1.e-6"]
    lines += ["*MATERIAL, NAME=M", "*ELASTIC", f"{YOUNG}, {POISSON}",
              "*CREEP, LAW=NORTON", f"{UNIT ** (1 - exponent) / VISCOUS:.10e}, {exponent}., 0.",
              "*SOLID SECTION, ELSET=BODY, MATERIAL=M"]
    lines += ["*BOUNDARY"] + [f"{node(i, j, k)}, 3, 3" for k in (0, 1)
                                 for i, j in plane]
    lines += [f"{g}, 1, 3" for g in ground.values()]
    lines += [f"{node(i, 0, k)}, 2, 2" for k in (0, 1)
              for i in range(n // 2 + 1)]
    lines += [f"{node(n // 2, 0, k)}, 1, 1" for k in (0, 1)]
    lines += ["*AMPLITUDE, NAME=SINE"] + [
        f"{t}, {math.sin(2 * math.pi * t / PERIOD):.10e}"
        for t in instants]
    lines += [f"*NSET, NSET=MOUTH\n{node(n, 0, 0)}",
              f"*STEP, INC={10 * len(instants)}", "*VISCO, DIRECT, CETOL=1.",
              f"{PERIOD / steps}, {periods * PERIOD}",
              "*DLOAD, AMPLITUDE=SINE"]
    lines += [f"{1 + i + n * (n - 1)}, P5, {-LOAD}" for i in range(n)]
    lines += ["*NODE PRINT, NSET=MOUTH", "U", "*END STEP"]
    return "\n".join(lines) + "\n"


def cpu_seconds(command, folder, output=subprocess.DEVNULL):
    """Of the whole process, its start included. CalculiX may end early."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, cwd=folder, check=False, stdout=output)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def ours(program, folder, law):
    """CPU seconds and openings of the mouth over time."""
    (folder / "plate.prm").write_text(scene(*law))
    seconds = cpu_seconds([program, "plate.prm", "--quiet", "--output", "ours"],
                          folder)
    with open(folder / "ours/probe_mouth.csv", newline="") as file:
        return seconds, [float(row["opening"]) for row in csv.DictReader(file)][1:]


def theirs(folder, law):
    (folder / "plate.inp").write_text(deck(*law))
    seconds = cpu_seconds(["ccx", "plate"], folder)
    return seconds, [float(value) for value in re.findall(
        r"time .*\n\n +\d+ +\S+ +(\S+)", (folder / "plate.dat").read_text())]


def compare_speed(program, folder):
    law = (N, 1, STEPS, PERIODS)
    runs = [(ours(program, folder, law), theirs(folder, law)) for _ in range(3)]
    (_, mine), (_, others) = runs[0]
    n, n_all = len(others), PERIODS * STEPS
    seconds, their_seconds = (min(run[which][0] for run in runs) for which in (0, 1))
    print(f"Crevasse {seconds:.2f} s for {n_all} steps, CalculiX {their_seconds:.1f} s "
          f"for {n}: {their_seconds * n_all / n / seconds:.0f} times")
    print(f"opening of the mouth at T/4: {mine[STEPS // 4 - 1]:.4e}, "
          f"{others[STEPS // 4 - 1]:.4e} (Euler's implicit scheme)")


def history(openings):
    """At the instants that all have, until the lip closes."""
    stride = len(openings) // COARSEST
    return openings[stride - 1::stride][:COARSEST * 9 // 20]


def differ(one, exact):
    """Relative to the largest opening."""
    return max(abs(a - b) for a, b in zip(one, exact)) / max(exact)


def extrapolate(fine, coarse):
    """The limit of steps of first order, halved once."""
    return [2 * a - b for a, b in zip(fine, coarse)]


def compare_errors(program, folder, exponent):
    exact = history(ours(program, folder, (N, exponent, 960, 1))[1])
    mine = {}
    for steps in (40, 80):
        seconds, openings = ours(program, folder, (N, exponent, steps, 1))
        mine[differ(history(openings), exact)] = seconds
    found = {}
    for steps in (40, 80, 160):
        found[steps] = theirs(folder, (N, exponent, steps, 1))
    limit = extrapolate(*(history(found[steps][1]) for steps in (160, 80)))
    print(f"limits differ by {differ(limit, exact):.1e} of the largest opening")
    for error, seconds in mine.items():
        print(f"Crevasse: error {error:.1e} in {seconds:.2f} s")
    for steps, (seconds, openings) in found.items():
        error = differ(history(openings), limit)
        print(f"CalculiX, {steps} steps: error {error:.1e} in {seconds:.1f} s")
        for my_error, my_seconds in mine.items():
            print(f"  {seconds * error / my_error / my_seconds:.0f} times as long as "
                  f"Crevasse for {my_error:.1e}, in proportion to the steps")


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as directory:
        if len(sys.argv) > 2:
            compare_errors(program, pathlib.Path(directory), int(sys.argv[2]))
        else:
            compare_speed(program, pathlib.Path(directory))


if __name__ == "__main__":
    main()
