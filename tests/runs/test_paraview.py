"""What ParaView makes of the fields: tensors and instants are read, and the script
that a run writes beside them draws the body, in the plane and in space. ParaView and a
virtual display are no part of the default tier; without them nothing is tested."""

import contextlib
import os
import pathlib
import shutil
import subprocess

from cracked import PLATE
from crevasse_run import check, run

SPACE = """
set Dimension = 3
""" + PLATE + """
subsection Geometry
  set Shape        = box
  set Subdivisions = 3, 3, 2
end
subsection Boundary
  set Clamped = 2
  set Loaded  = 3
end
"""
# Prints what a user of ParaView meets.
READER = """
import sys
from paraview import simple
reader = simple.PVDReader(FileName=sys.argv[1])
reader.UpdatePipeline(reader.TimestepValues[0])
print("instants", len(reader.TimestepValues))
for name in ("stress", "viscous_strain"):
    array = reader.PointData[name]
    print(name, *(array.GetComponentName(c) for c in range(6)))
print("cells", *reader.CellData.keys())
stress, mises = (reader.PointData[name].GetRange(c) for name, c in
                 (("stress", 1), ("von_mises_stress", 0)))
print("uniform", abs(stress[0] - stress[1]) + abs(mises[0] - abs(stress[0])) < 1e-4)
"""


@contextlib.contextmanager
def display():
    """A virtual one, by its number: xvfb-run does not wait until it is there."""
    end, begin = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(begin), "-noreset",
                               "-nolisten", "tcp"],
                              pass_fds=[begin], stderr=subprocess.DEVNULL)
    os.close(begin)
    try:
        yield os.environ | {"DISPLAY": ":" + os.read(end, 20).decode().strip()}
    finally:
        server.terminate()
        server.wait()


def pvpython(*words, environment):
    done = subprocess.run(["pvpython", "--force-offscreen-rendering", *words],
                          env=environment, capture_output=True, text=True, timeout=1200)
    check(done.returncode == 0, f"{words}: {done.stdout}{done.stderr}")
    return done.stdout


def main():
    for program in ("pvpython", "Xvfb"):
        if shutil.which(program) is None:
            print(f"SKIPPED: there is no {program} (doc/testing.md)")
            return
    instants = ["Output/Field times=75, 150, 300", "Periodic state/Maximum periods=1",
                "Periodic state/Tolerance=0"]
    plane = run(PLATE, "plane", ["Loads/Traction=0; -10", *instants]).directory
    space = run(SPACE, "space", ["Loads/Traction=0; 1; 0", *instants]).directory
    pathlib.Path("reader.py").write_text(READER)
    with display() as environment:
        said = pvpython("reader.py", plane / "solution.pvd", environment=environment)
        print(said)
        for line in ("instants 4", "stress XX YY ZZ XY YZ XZ",
                     "viscous_strain XX YY ZZ XY YZ XZ", "cells material_id",
                     "uniform True"):
            check(line in said, f"not said: {line}")
        for directory in (plane, space):
            picture = directory / "picture.png"
            said = pvpython(directory / "show_in_paraview.py", picture,
                            environment=environment)
            # An empty white picture has some 4 kB.
            size = picture.stat().st_size if picture.exists() else 0
            print(f"{picture}: {size} bytes")
            check(size > 10000, f"{directory}: no picture\n{said}")


main()
