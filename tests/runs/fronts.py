"""The shipped penny-shaped crack, and K along crack fronts in space."""

import subprocess
import sys

from crevasse_run import SOURCE

PENNY = SOURCE / "prm/penny_crack.prm"

ONE_STEP = """
subsection Discretisation
  set Degree = 2
end
subsection Time integration
  set Steps per period = 1
end
subsection Periodic state
  set Maximum periods = 1
end
subsection Crack tip
  set Stress intensity = true
end
subsection Output
  set Fields = none
end
"""


def front(results):
    """The rows of the last instant as dictionaries."""
    table = results.table("crack_front.csv")
    rows = [dict(zip(table, row)) for row in zip(*table.values())]
    return [row for row in rows if row["t"] == rows[-1]["t"]]


def penny_mesh(name, *words):
    subprocess.run([sys.executable, SOURCE / "prm/penny_mesh.py", name, *words],
                   check=True)
    return f"Geometry/Mesh file={name}"
