"""K at crack tips in anisotropic bodies: the infinite plate's, which no modulus
changes, energies of neighbouring crack lengths, the isotropic limit, and relaxation
that leaves the stress as it is."""

import math

import cracked
from crevasse_run import check, check_below, execute, full, overrides, plain, run

# Half a square with an edge crack under tension.
EDGE = """
subsection Geometry
  set Shape        = edge crack
  set Crack length = 0.5
  set Subdivisions = 8, 8
end
subsection Material
  set Viscosity       = none
  set Relaxation time = 1
end
subsection Loads
  set Traction = 0; 10
end
subsection Discretisation
  set Degree = 2
end
subsection Refinement
  set Strategy         = adaptive
  set Target unknowns  = 3000
end
subsection Crack tip
  set Stress intensity = true
end
subsection Output
  set Fields = none
end
"""

# The stress far from a crack between two lips, |x| < 1, and its plate.
FAR = (3., 7., 4.)  # 11, 22, 12
SIDES = [0, 0.25, 0.5, 0.75, 1, 1.25, 1.5, 2, 3, 5, 9]
UP = [0, 0.25, 0.5, 0.75, 1, 1.5, 2, 3, 5, 9]
PLATE = """
subsection Geometry
  set Shape     = mesh file
  set Mesh file = {mesh}
end
subsection Boundary
  set Open crack   = 7
  set Loaded       = 1, 2, 3, 4
  set Fixed points = -{width}, 0: 1, 2; {width}, 0: 2
end
subsection Material
  set Viscosity = none
end
subsection Loads
  set Traction = {side}*{s[0]} + {up}*{s[2]}; {side}*{s[2]} + {up}*{s[1]}
end
subsection Discretisation
  set Degree = 2
end
subsection Refinement
  set Strategy = tip
  set Cycles   = 6
end
subsection Crack tip
  set Stress intensity = true
end
subsection Output
  set Fields = none
end
"""


def stiffness(E_1, E_2, G, nu, degrees=0.):
    """Of plane stress, with the first axis of the material turned from x."""
    Q = (E_1 / (1 - nu**2 * E_2 / E_1), nu * E_2 / (1 - nu**2 * E_2 / E_1),
         E_2 / (1 - nu**2 * E_2 / E_1), G)  # 11, 12, 22, 66
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    # strain in the material's axes = T strain, with engineering shears
    T = ((c * c, s * s, s * c), (s * s, c * c, -s * c),
         (-2 * s * c, 2 * s * c, c * c - s * s))
    K = ((Q[0], Q[1], 0), (Q[1], Q[2], 0), (0, 0, Q[3]))
    turned = [[sum(T[k][i] * K[k][m] * T[m][j] for k in range(3) for m in range(3))
               for j in range(3)] for i in range(3)]
    return "Material/Stiffness matrix=" + "; ".join(
        ", ".join(repr(0.5 * (turned[i][j] + turned[j][i])) for j in range(3))
        for i in range(3))


WOOD = (100e3, 10e3, 4e3, 0.3)


def tip_of(*settings, scene=EDGE):
    return run(scene, "edge", list(settings)).summary["crack_tip"]


@full
def test_energy_release():
    """Irwin's G = K L K is the derivative of the energy by the crack's length, and
    two squares have the same K, to the printed errors of both."""
    for name, moduli in (("along", WOOD), ("across", (10e3, 100e3, 4e3, 0.03))):
        material = stiffness(*moduli)
        energy = {a: tip_of(material, f"Geometry/Crack length={a}")["strain_energy"]
                  ["largest"] for a in (0.46, 0.48, 0.52, 0.54)}
        # of both halves
        slope = 2 * (8 * (energy[0.52] - energy[0.48])
                     - (energy[0.54] - energy[0.46])) / (12 * 0.02)
        tip, narrow = tip_of(material), tip_of(material, "Crack tip/Radius=0.2")
        print(f"{name}: {tip['K_I']}, G {tip['energy_release_rate']}, {slope}")
        check_below(abs(tip["energy_release_rate"]["largest"] / slope - 1), 1e-3,
                    f"{name}: -dU/da")
        check_below(abs(tip["K_I"]["largest"] - narrow["K_I"]["largest"]),
                    tip["K_I_error"] + narrow["K_I_error"], f"{name}: two radii")


def test_isotropic_limit():
    """Moduli that nearly are isotropic give what isotropic ones give, though the
    roots of the characteristic equation nearly coincide; all on one mesh, of which
    adaptivity would make others by rounding."""
    mesh = ["Refinement/Strategy=tip", "Refinement/Target unknowns=0", "Refinement/Cycles=6"]
    E, nu = 13000., 0.2
    exact = (E, E, E / (2 * (1 + nu)), nu)
    K = [tip_of(*mesh, stiffness(E_1, *exact[1:]))["K_I"]["largest"]
         for E_1 in (E, E * (1 + 1e-7), E * (1 + 1e-5))]
    for other in K[1:]:
        check_below(abs(other / K[0] - 1), 1e-5, "nearly isotropic")


def test_infinite_plate():
    """K_I = s_22 sqrt(pi a) and K_II = s_12 sqrt(pi a) whatever the moduli (Sih,
    Paris, Irwin 1965), and T = s_11 + Re(mu_1 mu_2) s_22 + Re(mu_1 + mu_2) s_12 with
    the roots of the characteristic equation; plates of two sizes are
    extrapolated. What is left is the error of the mesh."""
    root = math.sqrt(math.pi)
    T = {0: 3 - 7 * math.sqrt(10), 90: 3 - 7 / math.sqrt(10), 30: -8.612432}
    for degrees in T:
        found = []
        for width in (14, 28):
            across = [x for x in SIDES if x < width / 2] + [width / 2, width]
            up = [y for y in UP if y < width / 2] + [width / 2, width]
            mesh = cracked.write_block(
                f"plate_{width}.msh",
                ([-x for x in across[:0:-1]] + across, [-y for y in up[:0:-1]] + up),
                lambda middle, n: n == 1 and middle[1] == 0 and abs(middle[0]) < 1)

            def on(x, width=width):
                return f"(if({x} > {width}-1e-6, 1, 0) - if({x} < 1e-6-{width}, 1, 0))"
            summary = run(PLATE.format(mesh=mesh, width=width, s=FAR, side=on("x"),
                                       up=on("y")), "plate",
                          [stiffness(*WOOD, degrees),
                           "Geometry/Refinements=1"]).summary
            tips = summary["crack_tips"]
            check(all(tip["growth_angle"] is None for tip in tips),
                  "no direction of growth by a criterion of isotropic bodies")
            found.append([tips[0][name]["largest"]
                          for name in ("K_I", "K_II", "T_stress")])
        printed = math.hypot(tips[0]["K_I_error"], tips[0]["K_II_error"])
        exact, errors = (FAR[1] * root, FAR[2] * root, T[degrees]), []
        for name, narrow, wide, value in zip(("K_I", "K_II", "T"), *found, exact):
            extrapolated = (4 * wide - narrow) / 3
            print(f"{degrees} degrees, {name}: {narrow:.6g}, {wide:.6g}, "
                  f"{extrapolated:.6g}, exact {value:.6g}")
            errors.append(abs(extrapolated - value))
            check_below(errors[-1], 2e-3 * FAR[1] * root, f"{degrees} degrees, {name}")
        ratio = printed / math.hypot(*errors[:2])
        check(0.5 < ratio < 10, f"{degrees} degrees: printed over true error {ratio:.2f}")


def test_turned():
    """A body that is turned has the same K and the same printed errors."""
    width, found = 14, []
    axes = [[*(-x for x in axis[:0:-1]), *axis] for axis in (
        [x for x in points if x < width / 2] + [width / 2, width] for points in (SIDES, UP))]
    for degrees in (0, 35):
        turn = cracked.turned(degrees)
        c, s = turn((1, 0))
        mesh = cracked.write_block(
            f"turned_{degrees}.msh", axes,
            lambda middle, n: n == 1 and middle[1] == 0 and abs(middle[0]) < 1, turn)
        side, up = (f"(if({x} > {width}-1e-6, 1, 0) - if({x} < 1e-6-{width}, 1, 0))"
                    for x in (f"({c!r}*x + {s!r}*y)", f"({c!r}*y - {s!r}*x)"))
        along, across = (f"({side}*{a} + {up}*{b})" for a, b in (FAR[::2], FAR[:0:-1]))
        x, y = (width * part for part in (c, s))
        found.append(run(PLATE.format(mesh=mesh, width=width, s=FAR, side=0, up=0), "turned", [
            stiffness(*WOOD, 30 + degrees), "Refinement/Cycles=2",
            f"Boundary/Fixed points={-x!r}, {-y!r}: 1, 2; {x!r}, {y!r}: 2",
            f"Loads/Traction={c!r}*{along} - {s!r}*{across}; {s!r}*{along} + {c!r}*{across}",
        ]).summary["crack_tips"])
    for one, other in zip(*found):
        for name in ("K_I", "K_II", "K_I_error", "K_II_error", "T_stress_error"):
            a, b = (tip[name]["largest"] if name in ("K_I", "K_II") else tip[name]
                    for tip in (one, other))
            check_below(abs(a / b - 1), 1e-3, f"{name} of a turned body")


def test_relaxation():
    """A relaxation time leaves the stress as it is; another viscosity is refused
    before anything is computed, as are asymmetric halves."""
    elastic = tip_of(stiffness(*WOOD))["K_I"]["largest"]
    table = run(EDGE, "relaxes", [
        stiffness(*WOOD), "Material/Viscosity=relaxation time",
        "Time integration/Scheme=sdirk2", "Time integration/Steps per period=4",
        "Periodic state/Method=march", "Periodic state/Maximum periods=1",
        "Periodic state/Tolerance=0"]).table("crack_tip.csv")
    check_below(max(abs(K / elastic - 1) for K in table["K_I"]), 1e-6, "K_I")
    with open("refused.prm", "w") as file:
        file.write(plain(EDGE))
    for settings, words in (
            ([stiffness(*WOOD), "Material/Viscosity=isotropic",
              "Material/Viscous modulus=1e4"], "not proportional"),
            ([stiffness(*WOOD, 30)], "not symmetric about the line")):
        status, _, error = execute("--check", "refused.prm", *overrides(settings))
        check(status == 2 and words in error, error)


TESTS = [test_energy_release, test_isotropic_limit, test_infinite_plate, test_turned,
         test_relaxation]

if __name__ == "__main__":
    for test in TESTS:
        test()
