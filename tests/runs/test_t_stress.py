"""T, the constant stress along a crack, of half models: closed forms of the infinite
row of cracks and of the half plane, the model of both lips, and lips that press."""

import math

import cracked
from crevasse_run import SOURCE, check, check_below, check_close, full, run

STRIP = SOURCE / "prm/studies/crack_tip_handbook.prm"
FUNCTIONS = ["Refinement/Strategy=none", "Refinement/Target unknowns=0"]


def tip_of(settings):
    return run(STRIP, "strip", settings).summary["crack_tip"]


def test_row_of_cracks():
    """A row of collinear cracks between planes of symmetry (Westergaard, J. Appl. Mech.
    6, 1939): K_I = sqrt(2 tan(pi a/2)), and T = s_11 - s_22 with the stress far away,
    where the planes hold the strain along the row at 0."""
    row = ["Geometry/Shape=centre crack", "Boundary/Symmetry=0, 1, 2",
           "Geometry/Height=4", "Geometry/Subdivisions=10, 40"]
    graded = ["Discretisation/Singular functions=0", "Refinement/Strategy=tip",
              "Refinement/Target unknowns=0", "Refinement/Cycles=6"]
    for a, mesh, allowed in ((0.3, FUNCTIONS, 3e-4), (0.5, FUNCTIONS, 3e-4),
                             (0.5, graded, 5e-3)):
        tip = tip_of([*row, *mesh, f"Geometry/Crack length={a}"])
        K, T = tip["K_I"]["largest"], tip["T_stress"]["largest"]
        check_below(abs(K / math.sqrt(2 * math.tan(math.pi * a / 2)) - 1), allowed, "K_I")
        error = abs(T / (0.3 - 1) - 1)
        printed = tip["T_stress_error"] / abs(T)
        print(f"a = {a}: T = {T}, error {error}, printed {printed}")
        check_below(error, allowed, "T")
        check(0.5 * error < printed < 40 * error, "the printed error of T")


@full
def test_half_plane():
    """An edge crack in the half plane has T = -0.526 of the tension across it (Sham,
    Int. J. Fract. 48, 1991; Fett, Eng. Fract. Mech. 60, 1998). A plate differs by
    a part of the square of crack by width."""
    wide, wider = (tip_of([f"Geometry/Width={width}", f"Geometry/Height={width}",
                           "Geometry/Crack length=1",
                           f"Geometry/Subdivisions={width}, {width}",
                           f"Refinement/Target unknowns={400 * width}"])["T_stress"]
                   ["largest"] for width in (20, 40))
    print(f"T = {wide}, {wider}")
    check_below(abs((4 * wider - wide) / 3 / -0.526 - 1), 5e-3, "T of the half plane")


def test_both_lips():
    """An elastic half model has the T of the model of both lips, open and pressed: where lips
    press, T is the stress along the crack less that across it."""
    tables = []
    for half in (True, False):
        mesh = cracked.square(f"{half}.msh", half=half)
        scene = cracked.square_scene(
            mesh, half=half, more="subsection Crack tip\n  set Stress intensity = true\nend\n")
        name = "crack_tip.csv" if half else "crack_tip_1.csv"
        tables.append(run(scene, f"half_{half}", ["Material/Viscosity=none"]).table(name))
    one, other = tables
    size = max(map(abs, one["T_stress"]))
    check_below(max(abs(a - b) for a, b in zip(one["T_stress"], other["T_stress"],
                                               strict=True)) / size, 1e-8, "T of both")
    closed = one["t"].index(450.)
    check_close(one["T_stress"][closed], 10., 1e-3, "T under a pressure of 10")


def test_graded_modulus():
    """The printed error of T is the true one where a modulus varies across a closed crack.
    The field of T is singular like 1/r^2, so that this variation counts at the tip."""
    T, printed = zip(*(
        (tip["T_stress"]["largest"], tip["T_stress_error"])
        for tip in (run(cracked.PLATE, f"graded_{n}", [
            "Material/Viscosity=none", "Material/Young modulus=13000*exp(y)",
            "Loads/Traction=0; -10", "Crack tip/Stress intensity=true",
            "Discretisation/Degree=2", "Time integration/Steps per period=1",
            f"Geometry/Subdivisions={n}, {n}"]).summary["crack_tip"] for n in (12, 24, 48))))
    print(f"T = {T}, printed errors {printed}")
    check(0.25 * printed[0] < abs(T[0] - T[2]) < 4 * printed[0], "the printed error of T")
    check_close(T[1], T[2], 1e-5 * T[2], "T on two meshes")


TESTS = [test_row_of_cracks, test_half_plane, test_both_lips, test_graded_modulus]

if __name__ == "__main__":
    for test in TESTS:
        test()
