"""Bodies in space: closed forms, contact solvers, ranks, mesh files, and the two
plane states as limits of a plate: a slice between rigid planes is in plane
strain, a thin plate in plane stress."""

import math
import pathlib

import meshio
import numpy

from crevasse_run import (check, check_below, check_close, full, overrides, plain,
                          run, run_on, sweep, tier)

PLATE = """\
set Dimension = 3
subsection Geometry
  set Shape        = edge crack
  set Thickness    = 0.3
  set Subdivisions = 4, 3, 2
end
subsection Material
  set Young modulus   = 13000
  set Poisson ratio   = 0.3
  set Relaxation time = 60
end
subsection Loads
  set Period   = 600
  set Traction = 0; 10*sin(2*pi*t/600) - 4; 0
end
subsection Contact
  set Tolerance = 1e-13
end
subsection Time integration
  set Steps per period = 12
end
subsection Periodic state
  set Maximum periods = 2
  set Tolerance       = 0
end
subsection Output
  set Probes = mouth: 1, 0, 0; edge: 0.75, 0, 0.3; inside: 0.3, 0.6, 0.1
  set Fields = none
end
"""

# In two dimensions: what is said of the third one is left out.
PLANE = PLATE.replace("Dimension = 3", "Dimension = 2").replace(
    "4, 3, 2", "4, 3").replace("- 4; 0", "- 4").replace(
    "1, 0, 0; edge: 0.75, 0, 0.3; inside: 0.3, 0.6, 0.1",
    "1, 0; edge: 0.75, 0; inside: 0.3, 0.6")
PROBES = ("mouth", "edge", "inside")


def largest_difference(results, others, columns=None):
    """Of the probes, relative to the largest value of each kind of column."""
    worst = 0.
    for probe in PROBES:
        mine = results.table(f"probe_{probe}.csv")
        theirs = others.table(f"probe_{probe}.csv")
        for column in columns or theirs:
            if column not in theirs:
                continue
            size = max(abs(value) for name in theirs for value in theirs[name]
                       if name[0] == column[0])
            worst = max([worst] + [abs(a - b) / size for a, b in
                                   zip(mine[column], theirs[column])])
    return worst


def test_columns():
    results = run(PLATE, "columns", ["Output/Fields=vtu"])
    stress = [f"s_{c}" for c in ("11", "22", "33", "12", "13", "23")]
    stress.append("largest_shear_stress")
    check(list(results.table("probe_mouth.csv"))
          == ["t", "u_1", "u_2", "u_3"] + stress + ["opening", "pressure"],
          "columns on the lip")
    check(list(results.table("probe_inside.csv"))
          == ["t", "u_1", "u_2", "u_3"] + stress, "columns inside")
    opening = results.table("probe_mouth.csv")["opening"]
    pressure = results.table("probe_mouth.csv")["pressure"]
    check(max(opening) > 1e-3 and max(pressure) > 1., "it opens and closes")
    fields = {}
    for piece in results.directory.glob("*_0000.*.vtu"):
        fields.update(meshio.read(piece).point_data)
    for name, size in (("displacement", 3), ("principal_direction_3", 3),
                       ("principal_stress_3", None), ("stress", 6)):
        shape = fields[name].shape
        check(shape[1:] == (() if size is None else (size,)) or
              shape[1:] == (1,), f"{name} has the shape {shape}")
    check(results.summary["dimension"] == 3, "dimension in summary.json")


def test_closed_forms():
    """As in two dimensions: s = F(t) s_el with a lip that does not switch."""
    for degree in tier((1,), (1, 2)):
        for case, offset in (("closed", -1.5), ("open", 1.5)):
            name = f"always_{case}_Q{degree}"
            comparison = run(PLATE, name, [
                f"Discretisation/Degree={degree}", "Contact/Tolerance=1e-14",
                f"Loads/Traction=0; 10*(sin(2*pi*t/600) + {offset})*(1 + z); 0",
                f"Output/Elastic comparison={case}"
                ]).summary["elastic_comparison"]
            check_below(comparison["stress_difference"], 1e-10, name)
            check_below(comparison["drift_difference"], 1e-10, name + ": drift")


def test_solvers():
    """A load that turns the plate about its crack front and across it, and a
    gap that depends on z."""
    settings = ["Loads/Traction=0; 10*sin(2*pi*t/600)*(1 + 3*z) - 5*x; sin(9*x)",
                "Boundary/Gap=-1e-5*z"]
    for degree in tier((1,), (1, 2)):
        first = None
        for solver in ("condensed active set", "active set", "projected sor"):
            more = [f"Contact/Solver={solver}", f"Discretisation/Degree={degree}",
                    "Contact/Relaxation factor=1.85"]
            if degree == 2:
                more.append("Geometry/Subdivisions=2, 2, 1")
            results = run(PLATE, f"{solver}_{degree}".replace(" ", "_"),
                          settings + more)
            closed = results.table("contact.csv")["closed_nodes"][1:]
            check(min(closed) < results.summary["contact_nodes"] and
                  max(closed) > 0, "some nodes are closed, some are open")
            first = first or results
            check_below(largest_difference(results, first), 1e-10,
                        f"{solver}, degree {degree}")


def test_ranks():
    alone = run(PLATE, "one_rank")
    both = run_on(2, "one_rank.prm", "two_ranks")
    check_below(largest_difference(both, alone), 1e-10, "two ranks")


def test_plane_strain():
    """A slice between rigid planes, of one cell and of more."""
    for degree in (1, 2):
        plane = run(PLANE, f"plane_strain_{degree}", [
            "Material/Plane state=plane strain",
            f"Discretisation/Degree={degree}"])
        for cells in (1, 2):
            slice_ = run(PLATE, f"slice_{degree}_{cells}", [
                f"Geometry/Subdivisions=4, 3, {cells}",
                "Boundary/Symmetry=2, 5, 6", f"Discretisation/Degree={degree}"])
            # Force per thickness in two dimensions.
            check_below(largest_difference(slice_, plane), 1e-10,
                        f"degree {degree}, {cells} cells: slice - plane strain")
            force = slice_.table("contact.csv")["force"]
            expected = plane.table("contact.csv")["force"]
            check_below(max(abs(a / 0.3 - b) for a, b in zip(force, expected))
                        / max(expected), 1e-10, "force per thickness")


BOX = PLATE.replace("edge crack", "box").replace(
    "mouth: 1, 0, 0; edge: 0.75, 0, 0.3; inside: 0.3, 0.6, 0.1", "top: 1, 1, 0")
RECTANGLE = PLANE.replace("edge crack", "rectangle").replace(
    "mouth: 1, 0; edge: 0.75, 0; inside: 0.3, 0.6", "top: 1, 1")


def lift(scene, name, cells, traction, settings):
    """u_2 of the corner (1,1) of an elastic body under a load that bends it."""
    table = run(scene, name, [
        f"Geometry/Subdivisions={cells}", f"Loads/Traction={traction}",
        "Material/Viscosity=none", "Time integration/Steps per period=1",
        "Periodic state/Maximum periods=1"] + settings).table("probe_top.csv")
    return table["u_2"][-1]


def test_largest_shear_stress():
    """Of the stress beside it, in all plane states and in space."""
    for state in ("in space", "plane stress", "plane strain", "axisymmetric"):
        results = run(PLATE if state == "in space" else PLANE, f"shear {state}", [
            f"Material/Plane state={state}"] * (state != "in space"))
        table = results.table("probe_inside.csv")
        stress = numpy.zeros((len(table["t"]), 3, 3))
        for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)):
            if f"s_{i + 1}{j + 1}" in table:
                stress[:, i, j] = stress[:, j, i] = table[f"s_{i + 1}{j + 1}"]
        principal = numpy.linalg.eigvalsh(stress)
        expected = (principal[:, 2] - principal[:, 0]) / 2
        check_below(abs(table["largest_shear_stress"] - expected).max()
                    / expected.max(), 1e-12, f"largest shear stress, {state}")


def test_shear_of_heated_bar():
    """It cannot expand across the plane: each of its principal stresses 0, F and
    nu F - E alpha theta is in turn the largest, the smallest and between. A sweep
    takes the quantity."""
    load, heat = "(10*sin(2*pi*t/600)-4)", "10*cos(2*pi*t/600)"
    pathlib.Path("heated.prm").write_text(plain(RECTANGLE))
    across = f"(0.3*{load}-1.3*{heat})"
    rows, _ = sweep(
        "heated", "heated.prm", "--vary", "Discretisation/Degree=1,2", "--exact",
        "probe_top/largest_shear_stress="
        f"(max(0,max({load},{across}))-min(0,min({load},{across})))/2",
        *overrides([f"Loads/Traction=0; {load}", "Material/Viscosity=none",
                    "Material/Plane state=plane strain", f"Loads/Temperature={heat}",
                    "Material/Thermal expansion=1e-4"]))
    for row in rows:
        check_below(float(row["error:probe_top/largest_shear_stress"]), 1e-12,
                    f"heated bar, degree {row['Discretisation/Degree']}")


@full
def test_plane_stress():
    """Of a thin plate, free in front and behind: at a given mesh the thickness
    counts to second order, and so does the mesh size where the plate is thin:
    strain across the plate, which plane stress eliminates at each point, is
    continuous there."""
    load = "0; 10*cos(pi*x)^2"  # no shear at the corners: a smooth stress
    differences = []
    for n in (4, 8, 16):
        plane = lift(RECTANGLE, f"plane_stress_{n}", f"{n}, {n}", load, [])
        plate = lift(BOX, f"thin_{n}", f"{n}, {n}, 1", load + "; 0",
                     ["Geometry/Thickness=1e-3"])
        differences.append(abs(plate / plane - 1.))
    rates = [math.log2(a / b) for a, b in zip(differences, differences[1:])]
    print("thin plate - plane stress:", differences, "orders in h:", rates)
    check_close(rates[-1], 2., 0.1, "order in the mesh size")

    lifts = [lift(BOX, f"thickness_{k}", "8, 8, 2", "0; 10*(1 - 2*x)*x; 0",
                  [f"Geometry/Thickness={0.4 / 2 ** k}"]) for k in range(4)]
    steps = [abs(a - b) for a, b in zip(lifts, lifts[1:])]
    rates = [math.log2(a / b) for a, b in zip(steps, steps[1:])]
    print("thickness 0.4, 0.2, ...:", lifts, "orders:", rates)
    check_close(rates[-1], 2., 0.1, "order in the thickness")


# Gmsh's numbers of lines along the edges of a hexahedron, as (x, y, z).
CORNERS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0),
           (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))


def write_mesh(path, n, front):
    """The plate with n = (4, 3, 2) cells; its crack front runs through the
    nodes at x = 0.5 + front(z)."""
    def number(i, j, k):
        return 1 + i + (n[0] + 1) * (j + (n[1] + 1) * k)

    nodes, elements = [], []
    for k in range(n[2] + 1):
        for j in range(n[1] + 1):
            for i in range(n[0] + 1):
                x, y, z = i / n[0], j / n[1], 0.3 * k / n[2]
                nodes.append((x + 4 * x * (1 - x) * (1 - y) * front(z), y, z))
    for k in range(n[2]):
        for i in range(n[0]):
            lip = 2 * i >= n[0]
            for y, role in ((0, 2 if lip else 1), (n[1], 3)):
                elements.append((3, role, [
                    number(i + a, y, k + b)
                    for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]))
            for j in range(n[1]):
                elements.append((5, 10, [number(i + a, j + b, k + c)
                                         for a, b, c in CORNERS]))
    with open(path, "w") as file:
        print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes", file=file)
        print(len(nodes), file=file)
        for index, (x, y, z) in enumerate(nodes, 1):
            print(index, x, y, z, file=file)
        print("$EndNodes\n$Elements", file=file)
        print(len(elements), file=file)
        for index, (kind, role, corners) in enumerate(elements, 1):
            print(index, kind, 2, role, role, *corners, file=file)
        print("$EndElements", file=file)


def test_mesh_file():
    """The same plate from a file; and one with a curved crack front."""
    read = ["Geometry/Shape=mesh file", "Boundary/Symmetry=1",
            "Boundary/Contact=2", "Boundary/Loaded=3"]
    straight = read + ["Geometry/Mesh file=straight.msh",
                       "Boundary/Fixed points=0.5, 0, 0: 1, 3; 0.5, 0, 0.3: 1"]
    write_mesh("straight.msh", (4, 3, 2), lambda z: 0.)
    for degree in (1, 2):
        more = [f"Discretisation/Degree={degree}"]
        built_in = run(PLATE, f"built_in_{degree}", more)
        from_file = run(PLATE, f"straight_{degree}", straight + more)
        check_below(largest_difference(from_file, built_in), 1e-10,
                    f"degree {degree}: mesh file - built-in shape")

    write_mesh("curved.msh", (8, 4, 4), lambda z: 2 * z * (0.3 - z))
    curved = run(PLATE, "curved", read + [
        "Geometry/Mesh file=curved.msh", "Output/Elastic comparison=open",
        "Loads/Traction=0; 10*(sin(2*pi*t/600) + 1.5); 0",
        "Boundary/Fixed points=0.5, 0, 0: 1, 3; 0.5, 0, 0.3: 1"])
    check_below(curved.summary["elastic_comparison"]["stress_difference"],
                1e-10, "curved front, always open")


test_columns()
test_mesh_file()
test_closed_forms()
test_solvers()
test_ranks()
test_plane_strain()
test_largest_shear_stress()
test_shear_of_heated_bar()
test_plane_stress()
