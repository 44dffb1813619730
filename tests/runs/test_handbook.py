"""K_I against handbooks: edge and centre cracks in a long strip, and the geometries
SSLP101 and SSLP320 of Code_Aster's validation manual, on the scene and with the
formulas of the study doc/figures/crack_tip_handbook.py. The formulas are good to
0.5 % and 0.1 %; our own value is converged to 0.01 %. A creeping tube, SSNA104 of
the same manual."""

import math
import sys

import tubes
from crevasse_run import SOURCE, check, check_below, overrides, run, sweep

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


# K_I of SSLP320 that Code_Aster's test sslp320a expects of itself (X-FEM), by
# crack length; its reference is a polynomial of Tada's handbook, to 2 %.
SSLP320 = {2.5: 4193126.49524, 3.: 5090867.38741, 3.5: 6165052.48187,
           4.: 7475887.01513, 4.5: 9106532.07494, 5.: 11177273.3688}


def polynomial(alpha):
    return (1.12 - 0.231 * alpha + 10.55 * alpha**2 - 21.72 * alpha**3
            + 30.35 * alpha**4)


def test_sweep_of_lengths():
    """An edge crack in a plate of 10 x 30 under a stress of 1e6."""
    check_below(abs(polynomial(0.25) * math.sqrt(2.5 * math.pi) * 1e6 / 4.205998e6
                    - 1), 1e-6, "the value of the manual at 2.5")
    points, _ = sweep("sslp320", SCENE, "--vary", "Geometry/Crack length=2.5:5:6",
                      *overrides(["Geometry/Width=10", "Geometry/Height=15",
                                  "Geometry/Subdivisions=20, 30",
                                  "Refinement/Strategy=none",
                                  "Material/Young modulus=205e9",
                                  "Material/Poisson ratio=0",
                                  "Material/Plane state=plane strain",
                                  "Loads/Traction=0; 1e6"]))
    check(len(points) == len(SSLP320), "points")
    for point in points:
        a, found = (float(point[name]) for name in ("Geometry/Crack length",
                                                    "K_I_largest"))
        by_handbook = polynomial(a / 10) * math.sqrt(math.pi * a) * 1e6
        print(a, found, found / by_handbook - 1, found / SSLP320[a] - 1,
              found / (edge_crack(a / 10) * math.sqrt(math.pi * a) * 1e6) - 1)
        check_below(abs(found / by_handbook - 1), 8e-3, f"a = {a}: the handbook")
        check_below(abs(found / SSLP320[a] - 1), 3e-3, f"a = {a}: Code_Aster")


def test_creeping_tube():
    """SSNA104: a tube held axially under a pressure from t = 0 on, whose creep rate
    is 3/2 of the deviator of the stress."""
    p, n_r, n_phi = 1e-3, 96, 16
    # Where the stress of quadratic elements is best, near the outer side.
    best = 0.5 / math.sqrt(3)
    r = 1 + (n_r - 2.5 + best) / n_r
    phi = (n_phi / 2 + 0.5 + best) / n_phi * math.pi / 2
    results = run(tubes.TUBE, "tube", [
        tubes.write("tube.msh", n_r, n_phi),
        f"Loads/Traction={p}*x/sqrt(x*x+y*y); {p}*y/sqrt(x*x+y*y)",
        "Loads/Period=2", "Material/Viscosity=isotropic",
        "Material/Viscous modulus=1", "Material/Viscous Poisson ratio=0.5",
        "Time integration/Scheme=rk4", "Time integration/Steps per period=20",
        f"Output/Probes=outside: 2, 0; "
        f"best: {r * math.cos(phi)!r}, {r * math.sin(phi)!r}"])
    for probe, column, exact in (
            ("best", "s_33", lambda t: p / 3 * (1 - 0.4 * math.exp(-t))),
            ("outside", "u_1", lambda t: 2 * p / 3 * (
                1.9 - 0.08 * math.exp(-t) + 1.5 * t))):
        table = results.table(f"probe_{probe}.csv")
        check(len(table["t"]) == 21, "rows are missing")
        check_below(max(abs(value / exact(t) - 1)
                        for t, value in zip(table["t"], table[column])), 1e-6,
                    f"SSNA104: {column}")


test_formula()
test_sweep_of_lengths()
test_creeping_tube()
test_handbook()
test_plane_strain()
