"""Bodies of revolution: Lame's tube, SSNA104 as in the plane, a sphere's strain,
the penny-shaped crack, multigrid, ranks, and what is refused."""

import math
import pathlib

import tubes
from crevasse_run import check, check_below, execute, overrides, run


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
    exact_u = (1 + 0.3) * ((1 - 0.6) / 3 * 2 + 4 / 3 / 2)  # E = 1, at r = 2
    errors, of_stress = [], []
    for n in (4, 8, 16, 128):
        results = run(tubes.TUBE, "lame", [
            write_rings("rings.msh", n, 2), *RING,
            "Output/Probes=outside: 2, 0.25; inside: 1, 0.25; middle: 1.5, 0.25"])
        u = results.table("probe_outside.csv")["u_1"][-1]
        errors.append(abs(u / exact_u - 1))
        inside = results.table("probe_inside.csv")
        radial, hoop = tubes.lame(1, 0, 1, 2, 1)
        of_stress.append(max(abs(inside["s_11"][-1] - radial),
                             abs(inside["s_33"][-1] - hoop)) / hoop)
        print(n, errors[-1], of_stress[-1])
    for a, b in zip(errors[:2], errors[1:3]):
        check(3.7 < math.log2(a / b) < 4.3, f"order {math.log2(a / b)} of u")
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


for test in (test_lame, test_creeping_tube):
    test()
