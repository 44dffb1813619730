"""What friction costs: mean time of a warm contact problem with it, relative to the same
body without, where lips of 200 and 500 pairs slide and stick in parts; sets for each.

    OMP_NUM_THREADS=1 /usr/bin/python3 tests/benchmarks/friction.py build/crevasse"""

import json
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "runs"))
import cracked  # noqa: E402: where it is, is known now

SCENE = f"""
subsection Geometry
  set Shape     = mesh file
  set Mesh file = plate.msh
end
subsection Boundary
  set Crack   = {cracked.CRACK}
  set Clamped = {cracked.BOTTOM}
  set Loaded  = {cracked.TOP}
end
subsection Material
  set Young modulus   = 1
  set Poisson ratio   = 0.3
  set Viscosity       = relaxation time
  set Relaxation time = 1
end
subsection Loads
  set Period   = 1
  set Traction = 0.4*sin(2*pi*t); -1 - 0.5*sin(4*pi*t) - 0.3*x
end
subsection Discretisation
  set Degree = 1
end
subsection Time integration
  set Scheme           = heun
  set Steps per period = 40
end
subsection Periodic state
  set Method          = march
  set Maximum periods = 1
  set Tolerance       = 0
end
subsection Output
  set Fields = none
end
"""


def run(program, directory, coefficient):
    subprocess.run([program, "scene.prm", "--quiet", "--output", "results", "--force",
                    "--set", f"Boundary/Friction coefficient={coefficient}"],
                   check=True, cwd=directory)
    return json.loads((directory / "results/summary.json").read_text())


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    print("unknowns  pairs  coefficient  sets  ratios of three pairs of runs")
    for pairs, across in ((200, 240), (500, 96)):
        with tempfile.TemporaryDirectory() as name:
            directory = pathlib.Path(name)
            cells = pairs * 6 // 5
            cracked.write_block(
                directory / "plate.msh",
                (cracked.steps(-1.2, 1.2, cells), cracked.steps(-1.2, 1.2, across)),
                lambda middle, normal: (normal == 1 and abs(middle[1]) < 1e-9
                                        and abs(middle[0]) < 1))
            (directory / "scene.prm").write_text(SCENE)
            for coefficient in (0.2, 0.5):
                ratios = []
                for _ in range(3):
                    free = run(program, directory, 0)
                    held = run(program, directory, coefficient)
                    ratios.append(held["seconds"]["vi_mean"] / free["seconds"]["vi_mean"])
                counters = held["counters"]
                print(f"{held['unknowns']:8} {pairs:6} {coefficient:12} "
                      f"{counters['vi_iterations'] / counters['vi_solves']:5.2f}  "
                      + "  ".join(f"{ratio:.2f}" for ratio in ratios), flush=True)


main()
