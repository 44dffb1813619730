"""Bodies of revolution: Lame's tube, SSNA104 as in the plane,
the penny-shaped crack, multigrid, ranks, and what is refused."""

import math
import pathlib

import tubes
from crevasse_run import check, check_below, execute, full, overrides, run, run_on


def write_rings(name, n_r, n_y, radii=(1., 2.), height=0.5):
    """A mesh of rectangles: 1 on y = 0, 2 on y = height, 3 inside, 4 outside."""
    def node(i, j):
        return 1 + i + j * (n_r + 1)
    nodes = [f"{node(i, j)} {radii[0] + i / n_r * (radii[1] - radii[0])!r} "
             f"{j / n_y * height!r} 0"
             for j in range(n_y + 1) for i in range(n_r + 1)]
    elements = [f"3 2 10 10 {node(i, j)} {node(i + 1, j)} {node(i + 1, j + 1)} "
                f"{node(i, j + 1)}" for j in range(n_y) for i in range(n_r)]
    for j, group in ((0, 1), (n_y, 2)):
        elements += [f"1 2 {group} {group} {node(i, j)} {node(i + 1, j)}"
                     for i in range(n_r)]
    for i, group in ((0, 3), (n_r, 4)):
        elements += [f"1 2 {group} {group} {node(i, j)} {node(i, j + 1)}"
                     for j in range(n_y)]
    pathlib.Path(name).write_text("\n".join([
        "$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", str(len(nodes)),
        *nodes, "$EndNodes", "$Elements", str(len(elements)),
        *(f"{k} {one}" for k, one in enumerate(elements, 1)), "$EndElements", ""]))
    return f"Geometry/Mesh file={name}"


RING = ["Material/Plane state=axisymmetric", "Boundary/Symmetry=1, 2",
        "Boundary/Loaded=3", "Loads/Traction=1; 0"]


def test_lame():
    """Displacements of quadratic elements at nodes, and stress at the points."""
    def exact_u(r):  # E = 1
        return (1 + 0.3) * ((1 - 0.6) / 3 * r + 4 / 3 / r)
    errors, between_nodes, of_stress = [], [], []
    for n in (4, 8, 16, 128):
        results = run(tubes.TUBE, "lame", [
            write_rings("rings.msh", n, 2), *RING,
            "Output/Probes=outside: 2, 0.25; inside: 1, 0.25; "
            f"between: {1 + 0.25 / n}, 0.25"])
        for name, r, kept in (("outside", 2, errors),
                              ("between", 1 + 0.25 / n, between_nodes)):
            u = results.table(f"probe_{name}.csv")["u_1"][-1]
            kept.append(abs(u / exact_u(r) - 1))
        inside = results.table("probe_inside.csv")
        radial, hoop = tubes.lame(1, 0, 1, 2, 1)
        of_stress.append(max(abs(inside["s_11"][-1] - radial),
                             abs(inside["s_33"][-1] - hoop)) / hoop)
        print(n, errors[-1], of_stress[-1])
    for a, b in zip(errors[:2], errors[1:3]):
        check(3.7 < math.log2(a / b) < 4.3, f"order {math.log2(a / b)} of u")
    order = math.log2(between_nodes[1] / between_nodes[2])
    print("order of u between nodes", order)
    check(2.7 < order < 3.3, "order 3 of u between nodes")
    for a, b in zip(of_stress[:2], of_stress[1:3]):
        check(math.log2(a / b) > 1.7, f"order {math.log2(a / b)} of s at the edge")
    check_below(errors[-1], 1e-8, "Lame: u outside")


def test_creeping_tube():
    """SSNA104, see test_handbook.py."""
    p, n_r = 1e-3, 96
    r = 1 + (n_r - 2.5 + 0.5 / math.sqrt(3)) / n_r
    results = run(tubes.TUBE, "creeping", [
        write_rings("creeping.msh", n_r, 2), *RING, f"Loads/Traction={p}; 0",
        "Loads/Period=2", "Material/Viscosity=isotropic",
        "Material/Viscous modulus=1", "Material/Viscous Poisson ratio=0.5",
        "Time integration/Scheme=rk4", "Time integration/Steps per period=20",
        f"Output/Probes=outside: 2, 0; best: {r!r}, 0.125"])
    for probe, column, exact in (
            ("best", "s_22", lambda t: p / 3 * (1 - 0.4 * math.exp(-t))),
            ("outside", "u_1", lambda t: 2 * p / 3 * (
                1.9 - 0.08 * math.exp(-t) + 1.5 * t))):
        table = results.table(f"probe_{probe}.csv")
        check_below(max(abs(value / exact(t) - 1)
                        for t, value in zip(table["t"], table[column])), 1e-6,
                    f"SSNA104: {column}")


PENNY = """
subsection Geometry
  set Shape = centre crack
  set Width = 20
  set Height = 20
  set Crack length = 1
  set Subdivisions = 40, 40
end
subsection Material
  set Plane state = axisymmetric
  set Viscosity = none
end
subsection Loads
  set Traction = 0; 1e-3
end
subsection Discretisation
  set Degree = 2
end
subsection Refinement
  set Strategy = tip
  set Target unknowns = 20000
end
subsection Time integration
  set Steps per period = 20
end
subsection Periodic state
  set Maximum periods = 1
  set Tolerance = 0
end
subsection Crack tip
  set Stress intensity = true
end
subsection Output
  set Fields = none
end
"""


def intensities(name, settings=()):
    return run(PENNY, name, settings).table("crack_tip.csv")["K_I"]


def test_penny():
    """Sneddon's K; the cylinder of 20 radii adds some 1e-4."""
    exact = 2e-3 / math.sqrt(math.pi)
    for settings in ((), ("Material/Poisson ratio=0",), (
            "Material/Viscosity=relaxation time", "Material/Relaxation time=0.3")):
        check_below(max(abs(K / exact - 1) for K in intensities("penny", settings)),
                    5e-4, f"K of the penny-shaped crack {settings}")


@full
def test_weight():
    """Where Poisson's ratio is 0, a force per volume pulls as the traction of the same
    resultant does: without the crack the stress at its place is the same."""
    pulled, heavy = (intensities("weight", ["Material/Poisson ratio=0", *loads])[-1]
                     for loads in ((), ("Loads/Traction=0; 0",
                                        "Loads/Body force=0; 1e-3/20")))
    check_below(abs(heavy / pulled - 1), 1e-8, "K of a body force and of a traction")


def test_release_rate():
    """A crack from the surface: G of one radian is the change of the energy."""
    runs = [run(PENNY, "outer", [
        "Geometry/Shape=edge crack", "Geometry/Width=10", "Geometry/Height=10",
        f"Geometry/Crack length={length}", "Geometry/Subdivisions=100, 100",
        "Refinement/Strategy=none"]).table("crack_tip.csv")
            for length in (4.9, 5, 5.1)]
    energies = [table["strain_energy"][-1] for table in runs]
    G = 2 * (energies[2] - energies[0]) / 0.2 / 5
    check_below(abs(runs[1]["energy_release_rate"][-1] / G - 1), 1e-3,
                "G and the change of the energy")


@full
def test_variation():
    """Graded stiffness and thermal strain in the integral: squares of two sizes agree,
    of which the larger one has more of them in it."""
    for settings in (["Material/Young modulus=13000*exp(x)"],
                     ["Material/Thermal expansion=1e-5", "Loads/Traction=0; 0",
                      "Loads/Temperature=100*(x^2 - 1)"]):
        small, large = (intensities("variation", [*settings, f"Crack tip/Radius={size}"])[-1]
                        for size in (0.3, 0.6))
        check(small > 1e-8, f"there is a K: {small}")
        check_below(abs(large / small - 1), 2e-4, f"{settings}: two squares")


@full
def test_two_ways():
    """Multigrid and a factor, with the lip closed and open, on a body that touches
    its axis."""
    for load in ("0.01; -1", "0; 1"):
        for more in (["Discretisation/Degree=2"], ["Discretisation/Degree=1"], [
                "Discretisation/Degree=1", "Discretisation/Volumetric strain=mean",
                "Material/Poisson ratio=0.49"]):
            u, p = zip(*((table["u_2"][-1], table["pressure"][-1]) for table in (
                run(PENNY, "ways", [
                    "Geometry/Subdivisions=20, 20", "Geometry/Refinements=1",
                    f"Loads/Traction={load}", f"Linear solver/Type={solver}",
                    "Contact/Solver=active set", "Refinement/Strategy=none",
                    "Crack tip/Stress intensity=false",
                    "Output/Probes=axis: 0, 0; top: 20, 20", *more]).table(
                        f"probe_{probe}.csv")
                for solver, probe in (("cholesky", "axis"), ("gmg", "axis")))))
            check_below(abs(u[0] - u[1]), 1e-7, f"{load} {more}: gmg, opening")
            check_below(abs(p[0] - p[1]), 1e-7, f"{load} {more}: gmg, pressure")
            check(p[0] > 0.5 if "-" in load else u[0] > 0.1, "closed or open")


def test_ranks():
    """The penny-shaped crack, open, on two processes."""
    alone = intensities("penny")
    shared = run_on(2, "penny.prm", "shared").table("crack_tip.csv")["K_I"]
    check_below(max(abs(a - b) for a, b in zip(shared, alone, strict=True))
                / max(map(abs, alone)), 1e-8, "K on two processes")


def test_refused():
    for settings, word in (
            (["Discretisation/Singular functions=1"], "Singular functions"),
            (["Crack tip/Method=williams fit"], "williams fit"),
            (["Material/Poisson ratio=0.3 + 0.1*sin(2*pi*t)"], "must not vary in time"),
            (["Material/Viscosity=isotropic",
              "Material/Viscous Poisson ratio=0.45"], "Stress intensity")):
        status, _, error = execute("penny.prm", "--output", "results/refused",
                                   *overrides(settings))
        check(status != 0 and word in error, f"{settings}: {error}")
    status, _, error = execute("lame.prm", "--output", "results/refused", *overrides(
        [write_rings("left.msh", 4, 2, (-1., 1.)), *RING]))
    check(status != 0 and "must not be negative" in error, error)


for test in (test_lame, test_creeping_tube, test_penny, test_weight,
             test_release_rate, test_variation, test_two_ways, test_ranks, test_refused):
    test()
