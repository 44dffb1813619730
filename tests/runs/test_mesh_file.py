"""The same body, built in and read from both formats of Gmsh, whose nodes are
numbered differently."""

import math
import os
import pathlib
import shutil
import subprocess

import tubes
from crevasse_run import (SOURCE, check, check_below, execute, full, run, run_on,
                          tier)

REST = """\
subsection Material
  set Relaxation time = 60
end
subsection Loads
  set Period   = 600
  set Traction = 0; sin(2*pi*t/600) - 0.4
end
subsection Time integration
  set Steps per period = 12
end
subsection Contact
  set Relaxation factor = 1.9
  set Tolerance         = 1e-13
end
subsection Periodic state
  set Maximum periods = 2
  set Tolerance       = 0
end
subsection Output
  set Probes = lip: 1, 0; inside: 0.3, 0.6
  set Fields = none
end
"""

BUILT_IN = """\
subsection Geometry
  set Shape        = edge crack
  set Subdivisions = 4, 2
end
""" + REST

FROM_FILE = """\
subsection Geometry
  set Shape     = mesh file
  set Mesh file = {mesh}
end
subsection Boundary
  set Symmetry     = 1
  set Contact      = 2
  set Loaded       = 3
  set Fixed points = 0.5, 0: 1
end
"""
READ = FROM_FILE + REST

MESHES = SOURCE / "tests" / "meshes"


def largest_difference(results, others, table):
    """Relative to the largest value of each column, or to 1."""
    mine, theirs = results.table(table), others.table(table)
    check(mine.keys() == theirs.keys(), f"{table}: the columns differ")
    difference = 0.
    for column in mine:
        check(len(mine[column]) == len(theirs[column]), "the lengths differ")
        scale = max(1., *map(abs, mine[column]))
        for a, b in zip(mine[column], theirs[column]):
            difference = max(difference, abs(a - b) / scale)
    return difference


def test_formats():
    for degree, refinements in ((1, 0), (2, 1)):
        settings = [f"Discretisation/Degree={degree}",
                    f"Geometry/Refinements={refinements}"]
        built_in = run(BUILT_IN, f"built_in_{degree}", settings)
        table = built_in.table("probe_lip.csv")
        check(len(table["t"]) == 25, "rows are missing")
        check(max(table["opening"]) > 0.1, "the crack does not open")
        check(max(table["pressure"]) > 0.1, "the crack does not close")
        for mesh in ("edge_crack_2.msh", "edge_crack_4.msh"):
            read = run(READ.format(mesh=MESHES / mesh), f"{mesh}_{degree}",
                       settings)
            for key in ("cells", "unknowns", "contact_nodes"):
                check(read.summary[key] == built_in.summary[key],
                      f"{mesh}: {key} differs")
            for table in ("probe_lip.csv", "probe_inside.csv", "contact.csv"):
                check_below(largest_difference(built_in, read, table), 1e-10,
                            f"degree {degree}, {mesh}, {table}")


def test_names():
    """Boundaries by the names of the physical groups, mixed with numbers."""
    for mesh in ("edge_crack_2.msh", "edge_crack_4.msh"):
        scene = READ.format(mesh=MESHES / mesh)
        by_number = run(scene, "by_number")
        by_name = run(scene, "by_name", [
            "Boundary/Symmetry=ligament", "Boundary/Contact=lip",
            "Boundary/Loaded=top"])
        for table in ("probe_lip.csv", "contact.csv"):
            check((by_number.directory / table).read_bytes()
                  == (by_name.directory / table).read_bytes(), table)
        mixed = run(by_name.directory / "used.prm", "mixed", [
            "Boundary/Loaded=3, lip", "Boundary/Contact=none"])
        numbers = run(scene, "numbers", ["Boundary/Loaded=3, 2",
                                         "Boundary/Contact=none"])
        check((mixed.directory / "probe_inside.csv").read_bytes()
              == (numbers.directory / "probe_inside.csv").read_bytes(), "mixed")


def test_names_of_materials():
    scene = READ.format(mesh=MESHES / "edge_crack_4.msh")
    runs = [run(scene, f"material_{i}",
                [f"Material/Relaxation time=if(material == {material}, 60, 1)"])
            for i, material in enumerate(("10", '"body"'))]
    check(runs[0].directory.joinpath("probe_lip.csv").read_bytes()
          == runs[1].directory.joinpath("probe_lip.csv").read_bytes(), "by name")
    modulus = "Material/Young modulus=if({}, 2, 1)".format
    for condition, shape, message in (
            ('material == "blade"', "mesh file",
             'the mesh file has no material named "blade"; its names: "body" (10)'),
            ('"body" != material || "body"', "mesh file",
             '"body" must be compared with the material'),
            ('material == "body"', "edge crack", "there is no material named")):
        status, _, error = execute(
            "--check", runs[0].directory / "used.prm", "--set", modulus(condition),
            "--set", f"Geometry/Shape={shape}")
        check(status == 2 and error.count("[Material]") == 1 and message in error,
              f"exit status {status}\n{error}")
    status, _, error = execute("--check", runs[0].directory / "used.prm",
                               "--set", modulus('material == "body"'),
                               "--set", "Geometry/Mesh file=none.msh")
    check(status == 4 and "cannot be read" in error and "named" not in error, error)


def test_list_of_materials():
    scene = pathlib.Path("listed.prm")
    scene.write_text(READ.format(mesh=MESHES / "edge_crack_4.msh"))
    status, output, _ = execute("--check", scene, "--set", "Geometry/Refinements=1")
    check(status == 0 and "\n  materials: 10 (body): 32 cells\n" in output, output)


def test_where_it_is_looked_for():
    """Next to the scene file first, then in the working directory."""
    mesh = "edge_crack_2.msh"
    folder = pathlib.Path("with_mesh")
    folder.mkdir(exist_ok=True)
    shutil.copy(MESHES / mesh, folder)
    scene = folder / "scene.prm"
    scene.write_text(READ.format(mesh=mesh))
    for directory, path in ((".", scene), (folder, "scene.prm")):
        status, _, error = execute("--check", path, cwd=directory)
        check(status == 0, error)

    shutil.copy(MESHES / mesh, "here.msh")
    scene.write_text(READ.format(mesh="here.msh"))
    status, _, error = execute("--check", scene)
    check(status == 0, error)
    os.remove("here.msh")
    status, _, error = execute("--check", scene)
    check(status == 4 and "here.msh: cannot be read: No such file" in error,
          f"exit status {status}\n{error}")


def test_used_parameters():
    """A run from a mesh can be repeated from its used.prm."""
    folder = pathlib.Path("with_mesh")
    scene = folder / "again.prm"
    scene.write_text(READ.format(mesh="edge_crack_2.msh"))
    first = run(scene, "first")
    again = run(first.directory / "used.prm", "again")
    check((first.directory / "probe_lip.csv").read_bytes()
          == (again.directory / "probe_lip.csv").read_bytes(),
          "used.prm gives another result")


def tube(name, settings):
    """Error of Lame's hoop stress inside and of the displacement outside, both
    relative, of a tube from 1 to 2 under the pressure 1 in plane strain."""
    results = run(tubes.TUBE, name, settings)
    stress = results.table("probe_inside.csv")["s_22"][-1]
    moved = results.table("probe_outside.csv")["u_1"][-1]
    return abs(stress / (5 / 3) - 1), abs(moved / (4 / 3 * (1 - 0.3**2)) - 1)


def test_curved_cells():
    """Edges of second order are arcs: displacements converge as h^4, with straight
    edges as h^2. New edges within cells that are divided are straight, which leaves
    h^3."""
    errors = {}
    for order in (1, 2):
        for n in (8, 16):
            errors[order, n] = tube("tube", [
                tubes.write(f"tube_{order}.msh", n, n, order)])[1]
        rate = math.log2(errors[order, 8] / errors[order, 16])
        check_below(abs(rate - 2 * order), 0.3, f"order {rate} of the displacement "
                    f"with edges of order {order}: difference")
    print(errors)
    check_below(errors[2, 16], 1e-6, "displacement, curved cells")
    check_below(1000 * errors[2, 16], errors[1, 16], "straight cells / 1000")
    mesh = tubes.write("tube_2.msh", 2, 3)
    divided = [tube("tube", [mesh, f"Geometry/Refinements={level}"])[1]
               for level in (2, 3)]
    check_below(abs(math.log2(divided[0] / divided[1]) - 3), 0.3,
                "order with refinements - 3")
    check_below(divided[1], 1e-5, "displacement, three refinements")
    # A manifold in the file alone: linear elements, whose new vertices are on it.
    linear = tube("tube", ["Geometry/Mesh file=tube_2.msh", "Discretisation/Degree=1",
                           "Geometry/Refinements=3"])
    check_below(linear[1], 5e-3, "Degree = 1")


def test_curved_cells_everywhere():
    """Adaptive meshes with hanging nodes, multigrid, and space."""
    mesh = tubes.write("coarse.msh", 2, 3)
    adaptive = [mesh, "Refinement/Strategy=adaptive", "Refinement/Cycles=5"]
    errors = tube("adaptive", adaptive)
    check_below(errors[1], 5e-4, "adaptive mesh: displacement")
    probe = run(tubes.TUBE, "direct", adaptive).table("probe_inside.csv")
    other = run(tubes.TUBE, "gmg", adaptive + [
        "Linear solver/Type=gmg", "Contact/Solver=active set"
        ]).table("probe_inside.csv")
    check_below(abs(other["s_22"][-1] / probe["s_22"][-1] - 1), 1e-9, "multigrid")
    creep = adaptive + ["Material/Viscosity=relaxation time",
                        "Time integration/Steps per period=8",
                        "Periodic state/Maximum periods=2"]
    for n_ranks in tier((), (2,)):
        whole = run(tubes.TUBE, "whole", creep).table("probe_inside.csv")
        parallel = run_on(n_ranks, "whole.prm", "parallel",
                          creep).table("probe_inside.csv")
        check_below(max(abs(a / b - 1) for a, b in zip(
            whole["s_22"], parallel["s_22"])), 1e-9, "two processes")
    space = [tubes.write("space.msh", 4, 6, length=0.25), "Dimension=3",
             "Boundary/Symmetry=1, 2, 5, 6",
             "Loads/Traction=x/sqrt(x*x+y*y); y/sqrt(x*x+y*y); 0",
             "Output/Probes=inside: 1, 0, 0; outside: 2, 0, 0"]
    plane = tube("plane", [tubes.write("plane.msh", 4, 6)])
    check_below(max(abs(a - b) for a, b in zip(tube("space", space), plane)), 1e-9,
                "a slice in space against plane strain: errors")
    refused(space + ["Geometry/Refinements=1"],
            "the program cannot refine a mesh with curved edges")


CROSSING = """SetFactory("OpenCASCADE");
Rectangle(1) = {-1, -1, 0, 2, 2};
Point(11) = {-0.5, -0.3, 0}; Point(12) = {0.5, 0.3, 0}; Line(11) = {11, 12};
Point(13) = {-0.4, 0.4, 0}; Point(14) = {0.4, -0.5, 0}; Line(12) = {13, 14};
BooleanFragments{ Surface{1}; Delete; }{ Curve{11, 12}; Delete; }
Physical Surface("body") = Surface{:};
Physical Curve("crack") = Curve In BoundingBox{-0.7, -0.7, -0.1, 0.7, 0.7, 0.1};
Physical Curve("bottom") = Curve In BoundingBox{-1.1, -1.1, -0.1, 1.1, -0.9, 0.1};
MeshSize{:} = 0.3;
"""
PENNY = """SetFactory("OpenCASCADE");
Box(1) = {-1, -1, -1, 2, 2, 2};
Disk(20) = {0, 0, 0, 0.5};
Surface{20} In Volume{1};
Physical Volume("body") = {1};
Physical Surface("crack") = {20};
Physical Surface("bottom") = {5};
MeshSize{:} = 0.5;
"""


def test_embedded_cracks():
    """Cracks within meshes of triangles or tetrahedra, as Gmsh makes them, and within
    those that it divides itself."""
    if not shutil.which("gmsh"):
        print("there is no gmsh")
        return
    for dim, text in ((2, CROSSING), (3, PENNY)):
        scene = pathlib.Path(f"embedded_{dim}.prm")
        scene.write_text(f"""set Dimension = {dim}
subsection Geometry
  set Shape     = mesh file
  set Mesh file = embedded_{dim}.msh
end
subsection Boundary
  set Crack   = crack
  set Clamped = bottom
end
""")
        for setting in ("", f"Mesh.SubdivisionAlgorithm = {dim - 1};"):
            geometry = pathlib.Path(f"embedded_{dim}.geo")
            geometry.write_text(text + setting)
            made = subprocess.run(["gmsh", f"-{dim}", geometry], capture_output=True,
                                  text=True, timeout=1200)
            check(made.returncode == 0, made.stdout + made.stderr)
            status, output, error = execute(scene, "--check")
            check(status == 0 and ("divided: " in output) == (setting == ""),
                  output + error)


SQUARE = FROM_FILE.format(mesh="square.msh") + """\
subsection Material
  set Young modulus = 13000
  set Poisson ratio = 0.2
  set Viscosity     = none
end
subsection Loads
  set Period   = 1
  set Traction = 0; 10
end
subsection Discretisation
  set Singular functions = 2
end
subsection Crack tip
  set Stress intensity = true
end
subsection Time integration
  set Steps per period = 1
end
subsection Output
  set Fields = none
end
"""
K_OF_SQUARE = 35.41196  # doc/crack_tip.md


def square(n, corners, twins=False, plane="{} {} 0"):
    """The paper's square of n x n squares, each of cells with these corners; the crack
    is on the right. With twins the crack is on the left of the middle as well, whose
    lips have separate nodes in no group."""
    number = {}
    lines = []
    for j in range(n + 1):
        for i in range(n + 1):
            number[i, j] = len(lines) + 1
            lines.append(plane.format(i / n, j / n))
    upper = dict(number)
    for i in range(n // 2 if twins else 0):
        upper[i, n // 2] = len(lines) + 1
        lines.append(plane.format(i / n, 0.5))
    # Other programs give all elements the entity 0.
    elements = [f"1 2 {2 if 2 * i >= n else 1} 0 {number[i, 0]} {number[i + 1, 0]}"
                for i in range(n)]
    elements += [f"1 2 3 0 {number[i, n]} {number[i + 1, n]}" for i in range(n)]
    for j in range(n):
        of_row = upper if 2 * j == n else number
        for i in range(n):
            nodes = (of_row[i, j], of_row[i + 1, j], number[i + 1, j + 1],
                     number[i, j + 1])
            elements += [f"{len(cell) - 1} 2 10 0 "
                         + " ".join(str(nodes[k]) for k in cell) for cell in corners]
    pathlib.Path("square.msh").write_text("\n".join([
        "$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", str(len(lines)),
        *(f"{k} {line}" for k, line in enumerate(lines, 1)), "$EndNodes", "$Elements",
        str(len(elements)), *(f"{k} {line}" for k, line in enumerate(elements, 1)),
        "$EndElements", ""]))


TRIANGLES, QUADRILATERALS = ((0, 1, 2), (0, 2, 3)), ((0, 1, 2, 3),)


def test_triangles_and_quadrilaterals():
    """K_I of the paper's square on triangles, against the converged value, and against
    quadrilaterals within the printed errors."""
    tips = []
    for name, n, corners in (("triangles", 12, TRIANGLES),
                             ("quadrilaterals", 28, QUADRILATERALS)):
        square(n, corners)
        tips.append(run(SQUARE, name).summary)
        check(tips[-1]["unknowns"] < 2000, f"{tips[-1]['unknowns']} unknowns")
    values, errors = ([tip["crack_tip"][key]["largest"] if key == "K_I" else
                       tip["crack_tip"][key] for tip in tips]
                      for key in ("K_I", "K_I_error"))
    check_below(abs(values[0] / K_OF_SQUARE - 1), 3e-3, "error of K_I on triangles")
    check_below(abs(values[0] - values[1]), sum(errors), "triangles - quadrilaterals")


def check_public(name, roles, *settings, dimension=2):
    path = pathlib.Path("public.prm")
    path.write_text(f"""set Dimension = {dimension}
subsection Geometry
  set Shape     = mesh file
  set Mesh file = {MESHES / name}
end
subsection Boundary
{roles}
end
""")
    return execute("--check", path, *(word for setting in settings
                                      for word in ("--set", setting)))


def test_groups():
    """Elements in several groups; groups that nothing names, on the surface and within
    the body."""
    roles = "set Clamped = bottom\nset Loaded = top\nset Crack = crack"
    name = "cracked_triangles.msh"
    for material, found in (
            ("inclusion", "6 (matrix): 4320 cells, 7 (inclusion): 192 cells"),
            ("all", "8 (all): 4512 cells")):
        status, output, error = check_public(
            name, roles, f'Material/Young modulus=if(material == "{material}", 2, 1)')
        check(status == 0 and f"materials: {found}\n" in output
              and "crack tip: (-0.4, -0.2)" in output, output + error)
    both = 'if(material == "inclusion", 2, if(material == "all", 3, 1))'
    for setting, message in (
            (f"Material/Young modulus={both}",
             '"inclusion" (7) and "all" (8), to which the scene gives different'),
            ("Boundary/Loaded=outer", '"bottom" (1) and "outer" (3), to which'),
            ("Boundary/Loaded=interface",
             "and its group 5 has a role; only the surface")):
        status, _, error = check_public(name, roles, setting)
        check(status == 2 and message in " ".join(error.split()), error)
    status, output, error = check_public(
        name, roles.replace("bottom", "none"), "Boundary/Loaded=outer, top",
        "Boundary/Fixed points=-2, -2: 1, 2; 2, -2: 2")
    check(status == 0, error)


def test_mixed_cells():
    """Triangles beside quadrilaterals, which are divided where they must fit."""
    status, output, error = check_public(
        "plate_mixed.msh", "set Symmetry = ligament\nset Contact = lip\n"
        "set Loaded = top edge\nset Fixed points = 0, 0: 1",
        'Material/Young modulus=if(material == "steel", 2, 1)')
    check(status == 0 and "triangles divided" in output and "(steel)" in output,
          output + error)


def test_coincident_faces():
    """Lips in no group are found, and may be named by the number that is printed."""
    pathlib.Path("square.prm").write_text(SQUARE.replace(
        "functions = 2", "functions = 0").replace("intensity = true",
                                                  "intensity = automatic"))
    square(8, TRIANGLES, twins=True)
    status, output, error = execute("--check", "square.prm")
    check(status == 0 and "16 faces on the surface coincide in pairs" in output
          and "[Boundary] Crack = 4; " in output, output + error)
    status, output, error = execute(
        "--check", "square.prm", "--set", "Boundary/Crack=4", "--set",
        "Boundary/Contact=none", "--set", "Boundary/Symmetry=1, 2")
    check(status == 0 and "crack tip: (0.5, 0.5)" in output
          and "coincide" not in output, output + error)


def test_plane():
    pathlib.Path("square.prm").write_text(SQUARE)
    square(4, TRIANGLES, plane="{} 0 {}")
    status, _, error = execute("--check", "square.prm")
    check(status == 2 and "extend from z = 0 to 1; turn the mesh into the plane x-y"
          in error, error)


PENNY_BLOCK = """SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 20, 20, 20};
Disk(20) = {0, 0, 0, 2, 2};
BooleanFragments{ Volume{1}; Delete; }{ Surface{20}; Delete; }
e = 1e-3;
lip() = Surface In BoundingBox{-e, -e, -e, 2+e, 2+e, e};
low() = Surface In BoundingBox{-e, -e, -e, 20+e, 20+e, e};
low() -= lip();
Physical Surface(1) = {low()};
Physical Surface(2) = {lip()};
Physical Surface(3) = Surface In BoundingBox{-e, -e, 20-e, 20+e, 20+e, 20+e};
Physical Surface(4) = Surface In BoundingBox{-e, -e, -e, e, 20+e, 20+e};
Physical Surface(5) = Surface In BoundingBox{-e, -e, -e, 20+e, e, 20+e};
Physical Volume("body") = Volume{:};
Mesh.MeshSizeMax = 7;
Mesh.ElementOrder = 2;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Field[1] = Distance;
Field[1].CurvesList = {2};
Field[1].NumPointsPerCurve = 100;
Field[2] = MathEval;
Field[2].F = "0.35 + 0.55*F1";
Background Field = 2;
"""


@full
def test_penny_of_tetrahedra():
    """K_I in the mean over the front, of curved tetrahedra; in an infinite body it is
    2 s sqrt(a/pi)."""
    if not shutil.which("gmsh"):
        print("there is no gmsh")
        return
    pathlib.Path("penny.geo").write_text(PENNY_BLOCK)
    subprocess.run(["gmsh", "-3", "penny.geo"], check=True, capture_output=True,
                   timeout=1200)
    results = run(SOURCE / "prm" / "penny_crack.prm", "penny", [
        f"Geometry/Mesh file={pathlib.Path('penny.msh').resolve()}"])
    table = results.table("crack_front.csv")
    n = table["t"].count(table["t"][-1])
    arc, values = table["s"][-n:], table["K_I"][-n:]
    mean = sum((a + b) / 2 * (t - s) for a, b, s, t in zip(
        values, values[1:], arc, arc[1:])) / (arc[-1] - arc[0])
    check_below(abs(mean / (2e6 * math.sqrt(2 / math.pi)) - 1), 0.01, "mean of K_I")


def refused(settings, message):
    path = pathlib.Path("refused.prm")
    path.write_text(tubes.TUBE)
    code, _, error = execute("--check", path, *(
        word for setting in settings for word in ("--set", setting)))
    check(code == 2 and message in " ".join(error.split()),
          f"{message}: exit status {code}\n{error}")


def test_refused_curves():
    mesh = tubes.write("tube_2.msh", 2, 3)
    for role in ("Symmetry=1, 2, 4", "Contact=4"):
        refused([mesh, f"Boundary/{role}"], "is curved; lips and planes of "
                "symmetry must be flat")

    def quarter_point(r, phi):
        """Of the second of four cells."""
        return (r - 0.06, phi) if abs(r - 1.375) < 1e-9 else (r, phi)
    refused([tubes.write("quarter.msh", 4, 3, move=quarter_point)],
            "is not near the middle of the edge")

    def bulge(r, phi):
        return (1.2, phi) if r == 1 and abs(phi - math.pi / 12) < 1e-9 else (r, phi)
    refused([tubes.write("folded.msh", 10, 3, move=bulge)], "or folds over")
    text = pathlib.Path("tube_2.msh").read_text()
    pathlib.Path("third.msh").write_text(text.replace(" 16 2 10", " 36 2 10"))
    refused(["Geometry/Mesh file=third.msh"], "cannot be read as a mesh")


test_formats()
test_curved_cells()
test_curved_cells_everywhere()
test_refused_curves()
test_embedded_cracks()
test_triangles_and_quadrilaterals()
test_groups()
test_mixed_cells()
test_coincident_faces()
test_plane()
test_penny_of_tetrahedra()
test_names()
test_names_of_materials()
test_list_of_materials()
test_where_it_is_looked_for()
test_used_parameters()
