"""K_I against handbooks: edge and centre cracks in a long strip, and the geometry
SSLP101 of Code_Aster's validation manual, on the scene and with the formulas of
the study doc/figures/crack_tip_handbook.py. The formulas are good to 0.5 % and
0.1 %; our own value is converged to 0.01 %."""

import math
import sys

from crevasse_run import SOURCE, check_below, run

sys.path.insert(0, str(SOURCE / "doc/figures"))
from crack_tip_handbook import MESHES, cases, edge_crack  # noqa: E402

SCENE = SOURCE / "prm/studies/crack_tip_handbook.prm"


def test_formula():
    """As it is tabulated."""
    for alpha, factor in ((0.1, 1.1957), (0.2, 1.3667), (0.3, 1.6551),
                          (0.4, 2.1080), (0.5, 2.8266), (0.6, 4.0432)):
        check_below(abs(edge_crack(alpha) - factor), 5.1e-5,
                    f"Tada's formula at {alpha}")


def test_handbook():
    for name, settings, a, formula in cases():
        coarse, fine = (run(SCENE, "handbook", settings + [
            f"Refinement/Target unknowns={n}"]).table("crack_tip.csv")["K_I"][-1]
            for n in MESHES)
        check_below(abs(coarse / fine - 1), 1e-4, f"{name}: two meshes")
        check_below(abs(fine / math.sqrt(math.pi * a) / formula - 1),
                    2e-3 if name.startswith("centre") else 8e-3,
                    f"{name}: K_I against the formula")


def test_plane_strain():
    """The load gives the stress, whatever the plane state and the moduli."""
    stress, strain = (run(SCENE, "plane", settings).table("crack_tip.csv")
                      for settings in ((), (
                          "Material/Plane state=plane strain",
                          "Material/Young modulus=7e4",
                          "Material/Poisson ratio=0.4")))
    check_below(abs(strain["K_I"][-1] / stress["K_I"][-1] - 1), 1e-4,
                "K_I in plane strain with other moduli")


test_formula()
test_handbook()
test_plane_strain()
