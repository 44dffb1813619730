"""Linear elements with the mean volumetric strain do not lock:
prm/studies/incompressibility.prm, also in a slice in
space."""

import pathlib
import sys

from crevasse_run import PROGRAM, SOURCE, check, check_below, run

sys.path.insert(0, str(SOURCE / "doc/figures"))
from incompressibility import Run, extrapolated_work  # noqa: E402

SLICE = """\
set Dimension = 3
subsection Geometry
  set Thickness    = 0.1
  set Subdivisions = 16, 16, 1
end
subsection Boundary
  set Symmetry = 2, 5, 6
end
"""


def test_locking():
    directory = pathlib.Path("results")
    directory.mkdir(exist_ok=True)
    exact = extrapolated_work(*(Run(PROGRAM, 0.4999, (2, "full"), level,
                                    directory) for level in (1, 2)))
    full, mean = (Run(PROGRAM, 0.4999, (1, volume), 0, directory)
                  for volume in ("full", "mean"))
    print("error of the work: full", full.error(exact), "mean",
          mean.error(exact))
    check(full.error(exact) > 0.4, "the full volumetric strain locks")
    check_below(mean.error(exact), 0.06, "the mean one does not")
    return mean


def test_slice(plane):
    """Between rigid planes a slice in space is in plane strain: so is the mean
    dilatation, which then has a third direction."""
    scene = SOURCE / "prm/studies/incompressibility.prm"
    text = SLICE + "".join(
        line for line in scene.read_text().splitlines(keepends=True)
        if not line.startswith("set Title") and "Subdivisions" not in line
        ).replace("Traction = 0; 10", "Traction = 0; 10; 0")
    results = run(text, "slice", ["Geometry/Refinements=0"])
    work = results.table("load_work.csv")["load_work"][-1] / 0.1
    check_below(abs(work / plane.work - 1), 1e-9, "slice - plane strain")


test_slice(test_locking())
