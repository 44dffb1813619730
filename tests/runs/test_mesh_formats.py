"""crevasse mesh: files of other programs keep their names, or are refused with a
reason. Those of tests/meshes are of Gmsh 4.8 (plate.unv, plate_gmsh.inp), and such as
pre-processors of Abaqus write (plate_cps3.inp); others are made here after the
formats' manuals."""

import pathlib
import re
import shutil
import subprocess

import h5py
import meshio
import netCDF4
import numpy

from crevasse_run import SOURCE, check, execute, execute_on, full, start

MESHES = SOURCE / "tests" / "meshes"
CUBE = numpy.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0),
                    (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)], float)
SIDES = {"x=0": "(0, 0, 0) to (0, 1, 1)", "x=1": "(1, 0, 0) to (1, 1, 1)",
         "y=0": "(0, 0, 0) to (1, 0, 1)", "y=1": "(0, 1, 0) to (1, 1, 1)",
         "z=0": "(0, 0, 0) to (1, 1, 0)", "z=1": "(0, 0, 1) to (1, 1, 1)"}


def convert(path):
    """What is printed, and the count and the box of each name."""
    status, output, error = start("mesh", path, "converted.msh")
    check(status == 0, error)
    found = re.findall(r"^    (.+) \(\d+\): (\d+ \w+) in (\(.*?\) to \(.*?\))", output,
                       re.MULTILINE)
    return output, {name: (count, box) for name, count, box in found}


def refused(path, message):
    status, _, error = start("mesh", path, "refused.msh")
    check(status == 2 and re.search(message, " ".join(error.split())),
          f"{path}: exit status {status}: {error}")


def check_scene(roles, dimension=2, materials=""):
    """The converted mesh in a scene."""
    path = pathlib.Path("converted.prm")
    path.write_text(f"""set Dimension = {dimension}
subsection Geometry
  set Shape     = mesh file
  set Mesh file = converted.msh
end
subsection Boundary
{roles}
end
subsection Material
  set Viscosity = none
  {materials}
end
""")
    status, output, error = execute("--check", path)
    check(status == 0, error)
    return output


def test_public_files():
    """The same plate, with names in three ways."""
    for name, ligament, lip, top, body in (
            ("plate.unv", "ligament", "lip", "top_edge", "steel"),
            ("plate_gmsh.inp", "ligament", "lip", "top_edge", "steel"),
            ("plate_cps3.inp", "LIGAMENT", "LIP", "TOP", "ALL")):
        output, names = convert(MESHES / name)
        check(names[ligament] == ("8 faces", "(0, 0) to (1, 0)")
              and names[lip] == ("8 faces", "(1, 0) to (2, 0)")
              and names[top] == ("8 faces", "(0, 1) to (2, 1)")
              and "162 triangles" in output, output)
        log = check_scene(f"""set Symmetry = {ligament}
set Contact = {lip}
set Loaded = {top}
set Fixed points = 0, 0: 1
""", materials=f'set Young modulus = if(material == "{body}", 2, 1)')
        check("162 triangles divided: 486 quadrilaterals" in log
              and "materials: " in log and body in log, log)


def test_faces_of_abaqus():
    """Each face of a cell by its number in Abaqus's manual, in an instance that is
    turned and moved."""
    kinds = {"C3D8R": (CUBE, ("z=0", "z=1", "y=0", "x=1", "y=1", "x=0")),
             "C3D4": (CUBE[[0, 1, 3, 4]], ("z=0", "y=0", None, "x=0")),
             "C3D6": (CUBE[[0, 1, 3, 4, 5, 7]], ("z=0", "z=1", "y=0", None, "x=0"))}
    for kind, (points, sides) in kinds.items():
        # Abaqus moves an instance first, and then turns it.
        turned = (points - [0.5, 0.5, 0]) @ [[0, -1, 0], [1, 0, 0], [0, 0, 1]] + [
            0.5, 0.5, 0] - [10, 0, 0]
        lines = ["*PART, NAME=one\n*Node, nset=all nodes"] + [
            f"{i}, " + ", ".join(map(repr, point)) for i, point in
            enumerate(turned.tolist(), 1)]
        lines += [f"*element, type={kind}, elset=body", "7, " + ", ".join(
            str(i) for i in range(1, len(points) + 1)) + ","]
        for number, side in enumerate(sides, 1):
            lines += [f"*Surface, name={side or 'inclined'}, type=ELEMENT",
                      f"body, S{number}"]
        lines += ["*End part", "** a comment", "*Assembly, name=A",
                  "*Instance, name=one-1, part=ONE", "10, 0, 0",
                  "0.5, 0.5, 0, 0.5, 0.5, 1, 90", "*End instance",
                  "*Nset, nset=corner, instance=one-1", "1,",
                  "*Surface, type=NODE, name=below", "one-1.all nodes, 1.",
                  "*End Assembly", "*Boundary", "corner, 1, 3"]
        pathlib.Path("faces.inp").write_text("\n".join(lines))
        output, names = convert("faces.inp")
        for side in filter(None, sides):
            check(names[side] == ("1 face", SIDES[side]), f"{kind}, {side}: {output}")
        check("left out: set of nodes corner (1 in (0, 0, 0))" in output
              and "*BOUNDARY" in output, output)
        check(names["below"][0] == f"{len(sides)} faces", output)


GENERATED = """*HEADING
*NODE
1, 1., 0.
21, 0., 1.
101, 2., 0.
121, 0., 2.
900, 0., 0.
*NGEN, NSET=INSIDE,
  LINE=C
1, 21, 1, 900
*NGEN, LINE=C
101, 121, 1, 900
*NODE
201, 1.5, 0.
221, 0., 1.5
*NGEN, LINE=C
201, 221, 2, 900
*ELEMENT, TYPE=CPE8R, ELSET=RING
"""


def test_generated_nodes():
    """Nodes on circles, elements of second order over two lines, sets of sets."""
    rows = [f"{i // 2 + 1}, {i}, {100 + i}, {102 + i}, {i + 2},\n {200 + i}, "
            f"{101 + i}, {202 + i}, {i + 1}" for i in range(1, 21, 2)]
    pathlib.Path("ring.inp").write_text(GENERATED + "\n".join(rows) + """
*ELSET, ELSET=FIRST, GENERATE
1, 9, 2
*ELSET, ELSET=BOTH
FIRST, 2
*ELEMENT, TYPE=T3D3, ELSET=OUTER
900, 101, 102, 103
*SURFACE, NAME=HOLE
BOTH, S4
10, S4
*TIE, NAME=T
""")
    output, names = convert("ring.inp")
    check(names["BOTH"][0] == "6 cells" and names["RING"][0] == "10 cells"
          and names["HOLE"][0] == "7 faces" and names["INSIDE"][0] == "10 faces"
          and names["OUTER"][0] == "1 face" and "*TIE" in output, output)
    mesh = meshio.read("converted.msh")
    radii = numpy.sort(numpy.linalg.norm(mesh.points, axis=1))
    expected = numpy.repeat([0, 1, 1.5, 2], [1, 21, 11, 21])
    check(abs(radii - expected).max() < 1e-14, f"radii {radii}")
    check_scene("set Clamped = HOLE")


def exodus(path, kind, points, cell, sides, names=True):
    """One cell with a side set of each of its sides."""
    with netCDF4.Dataset(path, "w", format="NETCDF3_64BIT_OFFSET") as file:
        for name, size in (("num_nodes", len(points)), ("num_el_blk", 1), ("len", 33),
                           ("num_el_in_blk1", 1), ("n", len(cell)), ("one", 1),
                           ("num_side_sets", len(sides)), ("num_dim", 3)):
            file.createDimension(name, size)
        for axis, values in zip("xyz", points.T):
            file.createVariable("coord" + axis, "f8", "num_nodes")[:] = values
        connect = file.createVariable("connect1", "i4", ("num_el_in_blk1", "n"))
        connect.elem_type = kind
        connect[:] = [cell]
        file.createVariable("eb_prop1", "i4", "num_el_blk")[:] = [10]
        file.createVariable("ss_prop1", "i4", "num_side_sets")[:] = range(
            1, len(sides) + 1)
        if names:
            given = file.createVariable("ss_names", "S1", ("num_side_sets", "len"))
            for i, side in enumerate(sides):
                given[i] = numpy.array([*(side or "inclined").ljust(33, "\0")], "S1")
        for i in range(1, len(sides) + 1):
            file.createVariable(f"elem_ss{i}", "i4", "one")[:] = [1]
            file.createVariable(f"side_ss{i}", "i4", "one")[:] = [i]


@full
def test_sides_of_exodus():
    hexahedron = ("y=0", "x=1", "y=1", "x=0", "z=0", "z=1")
    kinds = {"HEX8": (CUBE, hexahedron),
             "TETRA": (CUBE[[0, 1, 3, 4]], ("y=0", None, "x=0", "z=0")),
             "WEDGE": (CUBE[[0, 1, 3, 4, 5, 7]], ("y=0", None, "x=0", "z=0", "z=1"))}
    ends = ((0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 5), (2, 6), (3, 7), (4, 5),
            (5, 6), (6, 7), (7, 4))
    kinds["HEX20"] = (numpy.vstack([CUBE] + [CUBE[[*pair]].mean(0) for pair in ends]),
                      hexahedron)
    for kind, (points, sides) in kinds.items():
        exodus("cell.exo", kind, points, range(1, len(points) + 1), sides)
        output, names = convert("cell.exo")
        for side in filter(None, sides):
            check(names[side] == ("1 face", SIDES[side]), f"{kind}, {side}: {output}")
        check(names["block 10"][0] == "1 cell", output)
        check_scene("set Clamped = z=0", 3)
    exodus("cell.e", *("HEX8", CUBE, range(1, 9), hexahedron), names=False)
    check(convert("cell.e")[1]["side set 5"][1] == SIDES["z=0"], "number of a side set")


SQUARES = numpy.array([(0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (2, 1)], float)


def med(path, parts, families, of_nodes=(), points=SQUARES):
    """Cells with groups as MED has them: a cell or node has a family, a family has the
    names of several groups."""
    with h5py.File(path, "w") as file:
        step = file.create_group("ENS_MAA/Mesh_1/" + 2 * "-0000000000000000001")
        step["NOE/COO"] = points.T.ravel()
        step["NOE/COO"].attrs["NBR"] = len(points)
        step["NOE/FAM"] = numpy.isin(numpy.arange(len(points)), [0, 3]).astype(int)
        for kind, (cells, numbers) in parts.items():
            step[f"MAI/{kind}/NOD"] = numpy.array(cells).T.ravel() + 1
            step[f"MAI/{kind}/NOD"].attrs["NBR"] = len(cells)
            step[f"MAI/{kind}/FAM"] = numpy.array(numbers)
        file.create_group("FAS/Mesh_1/FAMILLE_ZERO").attrs["NUM"] = 0
        for where, groups in (("ELEME", families), ("NOEUD", of_nodes or {})):
            for number, names in groups.items():
                family = file.create_group(f"FAS/Mesh_1/{where}/FAM_{number}")
                family.attrs["NUM"] = number
                if names:
                    rows = [[*name.ljust(80, "\0").encode()] for name in names]
                    family["GRO/NOM"] = numpy.array(rows, numpy.int8)


def test_families_of_med():
    med("squares.med",
        {"QU4": ([(0, 1, 4, 3), (1, 2, 5, 4)], [-1, -2]),
         "SE2": ([(0, 1), (1, 2), (2, 5)], [-3, -4, -5])},
        {-1: ["all", "left"], -2: ["all"], -3: ["below"], -4: ["below", "lip"], -5: []},
        {1: ["wall"]})
    output, names = convert("squares.med")
    check(names == {"all": ("2 cells", "(0, 0) to (2, 1)"),
                    "left": ("1 cell", "(0, 0) to (1, 1)"),
                    "below": ("2 faces", "(0, 0) to (2, 0)"),
                    "lip": ("1 face", "(1, 0) to (2, 0)"),
                    "wall": ("1 face", "(0, 0) to (0, 1)")}, output)
    check_scene("set Clamped = wall\nset Loaded = lip")
    check_scene("set Clamped = below")


@full
def test_second_order_of_med():
    """The order of MED's manual, where the base of a cell is seen from inside: names,
    and middles on the curves, which come back between the ends of their edges."""
    def bent(points):  # where corners of the cube stay
        x, y, z = points.T
        return numpy.column_stack([x, y + 0.2 * x * (1 - x), z + 0.1 * y * (1 - y)])

    triangle, square = [(0, 1), (1, 2), (2, 0)], [(0, 1), (1, 2), (2, 3), (3, 0)]
    kinds = {  # corners, edges; base by its kind and number of corners
        "T10": ([0, 3, 1, 4], triangle + [(0, 3), (1, 3), (2, 3)], ("TR6", 3), "tetra10"),
        "P15": ([0, 3, 1, 4, 7, 5], triangle + [(a + 3, b + 3) for a, b in triangle]
                + [(0, 3), (1, 4), (2, 5)], ("TR6", 3), "wedge15"),
        "H20": ([0, 3, 2, 1, 4, 7, 6, 5], square + [(a + 4, b + 4) for a, b in square]
                + [(i, i + 4) for i in range(4)], ("QU8", 4), "hexahedron20")}
    for kind, (corners, edges, (base, n), of_meshio) in kinds.items():
        points = CUBE[corners]
        points = bent(numpy.vstack([points] + [points[[*edge]].mean(0) for edge in edges]))
        sides = [*range(n), *range(len(corners), len(corners) + n)]
        med("second.med", {kind: ([range(len(points))], [-1]), base: ([sides], [-2])},
            {-1: ["steel"], -2: ["base"]}, points=points)
        output, names = convert("second.med")
        check(names == {"steel": ("1 cell", names["steel"][1]),
                        "base": ("1 face", "(0, 0, 0) to (1, 1, 0)")}, output)
        meshio._mesh.topological_dimension["wedge15"] = 3  # which meshio 5.0 forgets
        mesh = meshio.read("converted.msh")
        cell = mesh.points[mesh.cells_dict[of_meshio][0]]
        middles = bent(numpy.array([cell[[*edge]].mean(0) for edge in edges]))
        check(abs(cell[len(corners):] - middles).max() < 1e-14, f"{kind}: {cell}")
        log = check_scene("set Clamped = base", 3)
        check("(steel)" in log and "clamped" in log, log)


def test_partitions():
    """Of Gmsh: parts have their boundaries, and keep the names of what they divide."""
    if not shutil.which("gmsh"):
        print("there is no gmsh")
        return
    pathlib.Path("parts.geo").write_text("""
Point(1) = {0, 0, 0, 0.3}; Point(2) = {1, 0, 0, 0.3}; Point(3) = {1, 1, 0, 0.3};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 1};
Curve Loop(1) = {1, 2, 3}; Plane Surface(1) = {1};
Physical Curve("bottom", 5) = {1}; Physical Curve("right", 6) = {2};
Physical Surface("body", 7) = {1};
""")
    logs = []
    for topology in (None, 0, 1):
        options = [] if topology is None else [
            "-part", "3", "-setnumber", "Mesh.PartitionCreateTopology", str(topology),
            "-save_all"]
        made = subprocess.run(
            ["gmsh", "-2", "parts.geo", "-format", "msh41", *options, "-o",
             "converted.msh"], capture_output=True, text=True, timeout=600)
        text = pathlib.Path("converted.msh").read_text()
        check(made.returncode == 0 and ("$PartitionedEntities" in text)
              == (topology is not None), made.stdout + made.stderr)
        logs.append(check_scene("set Clamped = bottom\nset Loaded = right",
                                materials='set Young modulus = if(material == "body", 2, 1)'))
        pathlib.Path("picture.html").unlink(missing_ok=True)
        check(execute("--check", "converted.prm", "--picture", "picture.html")[0] == 0
              and re.search(r"<td>bottom</td>.*?clamped</td><td [^>]*>8</td>",
                            pathlib.Path("picture.html").read_text(), re.DOTALL),
              "faces of the bottom")
    check(logs[0] == logs[1] == logs[2] and "(body)" in logs[0], "\n".join(logs))


def test_numbers_of_vtk():
    """Integers in cells are groups of these numbers."""
    points = numpy.array([(0, 0, 0), (0, 0, 1), (2, 0, 0), (2, 0, 1), (1, 0, 0)], float)
    mesh = meshio.Mesh(points, [("triangle", [(0, 4, 1), (4, 2, 3), (4, 3, 1)]),
                                ("line", [(0, 1)])],
                       cell_data={"id": [numpy.array([[7], [8], [8]]), numpy.array([[3]])],
                                  "size": [numpy.ones(3), numpy.ones(1)]})
    for name in ("squares.vtk", "squares.vtu"):
        meshio.write(name, mesh)
        output, names = convert(name)
        check(names == {"id 3": ("1 face", "(0, 0) to (0, 1)"),
                        "id 7": ("1 cell", "(0, 0) to (1, 1)"),
                        "id 8": ("2 cells", "(0, 0) to (2, 1)")}, output)
        check("left out: array size" in output
              and "left out: coordinate y, which is constant" in output, output)
        check("7 (id 7): 3 cells, 8 (id 8): 6 cells" in check_scene("set Clamped = 3"),
              "numbers")


@full
def test_unv_of_second_order():
    """Middles follow their corners; old groups; beams have a line more."""
    points = [(0, 0), (1, 0.1), (2, 0), (2.1, 1), (2, 2), (1, 2), (0, 2), (0, 1)]
    lines = ["    -1", "  2411"]
    for i, (x, y) in enumerate(points, 1):
        lines += [f"{i:10d}         1         1        11",
                  f"{x:25.16E}{y:25.16E}{0:25.16E}".replace("E", "D")]
    lines += ["    -1", "    -1", "  2412",
              "         1        45         1         1         7         8",
              "".join(f"{i:10d}" for i in range(1, 9)),
              "         2        22         1         1         7         3",
              "         0         1         1",
              "         1         2         3", "    -1", "    -1", "  2430",
              "         5" + 6 * "         0" + "         1", "below",
              "         8         2", "    -1", "    -1", "   164", "nothing", "    -1"]
    pathlib.Path("second.unv").write_text("\n".join(lines) + "\n")
    output, names = convert("second.unv")
    check(names == {"below": ("1 face", "(0, 0) to (2, 0)")}
          and "left out: data sets 164" in output, output)
    text = pathlib.Path("converted.msh").read_text()
    check("\n2 1 16 1\n2 1 3 5 7 2 4 6 8\n" in text, "quadrilateral of 8 nodes")
    check_scene("set Clamped = 5")


def test_conversion_before_a_run():
    """Once for each content of the file, and not by the processes of mpirun."""
    shutil.rmtree("results", ignore_errors=True)
    folder = pathlib.Path("parts")
    folder.mkdir(exist_ok=True)
    shutil.copy(MESHES / "plate_cps3.inp", folder / "plate.inp")
    scene = folder / "plate.prm"
    scene.write_text("""subsection Geometry
  set Shape     = mesh file
  set Mesh file = plate.inp
end
subsection Boundary
  set Symmetry = LIGAMENT
  set Contact  = LIP
  set Loaded   = TOP
  set Fixed points = 0, 0: 1
end
subsection Material
  set Young modulus = if(material == "ALL", 2, 1)
end
""")
    status, output, error = execute_on(2, "--check", scene)
    asked = re.search(r'run "crevasse (mesh \S+plate.inp (results/meshes/plate-\S+.msh))"',
                      error)
    check(status == 2 and asked, f"exit status {status}: {error}")
    for ways in range(2):  # by that command, by itself
        if ways == 0:
            check(start(*asked[1].split())[0] == 0, asked[1])
            status, output, error = execute_on(2, "--check", scene)
        else:
            pathlib.Path(asked[2]).unlink()
            status, output, error = execute("--check", scene)
        check(status == 0 and "materials: 1 (ALL): 486 cells" in output
              and ("LIP (2): 8 faces" in output) == (ways == 1), output + error)
    status, output, error = execute("--check", scene)
    check(status == 0 and "8 faces" not in output, output + error)
    (folder / "plate.inp").rename(folder / "whole.inp")
    (folder / "plate.inp").write_text("*INCLUDE, INPUT=whole.inp\n")
    for n in (2, 3):  # files, one for each content
        status, output, error = execute("--check", scene, "--quiet")
        check(status == 0 and output == "", output + error)
        check(len([*pathlib.Path("results/meshes").iterdir()]) == n, f"not {n} files")
        with open(folder / "whole.inp", "a") as file:
            file.write("*STEP\n")
    (folder / "plate.inp").write_text("*NCOPY\n")
    status, _, error = execute(
        "--check", SOURCE / "prm" / "raous1980.prm", "--set",
        f"Geometry/Mesh file={(folder / 'plate.inp').resolve()}")
    check(status == 2 and "is allowed only with Shape = mesh file" in error, error)


def test_what_is_refused():
    whole = (MESHES / "plate_cps3.inp").read_text()
    for name, (old, new), message in (
            ("copies", ("*Elset, elset=ALL", "*NCOPY\n*Elset, elset=ALL"),
             r"line 266: \*NCOPY cannot be read: it is not implemented"),
            ("label", ("1, 64, 75, 82", "1, 64, 75, 820"),
             r"line 103: \*ELEMENT: there is no 820"),
            ("set", ("_LIP_S1, S1", "_LIB_S1, S1"),
             r"line 278: \*SURFACE: there is no '_LIB_S1'"),
            ("face", ("_LIP_S1, S1", "_LIP_S1, S5"),
             "surface LIP: a cell has no face 5")):
        check(old in whole, name)
        path = pathlib.Path(f"wrong_{name}.inp")
        path.write_text(whole.replace(old, new, 1))
        refused(path, message)
    pathlib.Path("itself.inp").write_text("*INCLUDE, INPUT=itself.inp\n")
    refused("itself.inp", "a file includes itself")
    refused(MESHES / "edge_crack_4.msh", "the program reads Gmsh files itself")
    pathlib.Path("empty.unv").write_text("    -1\n  2411\n")
    refused("empty.unv", "there are no cells of a plane or space")
    pathlib.Path("wrong.med").write_text("nothing")
    refused("wrong.med", "wrong.med: ")
    pathlib.Path("wrong.vtu").write_text("nothing")
    refused("wrong.vtu", "wrong.vtu: cannot be read by meshio")
    text = (re.sub("type=", 'compressor="vtkLZ4DataCompressor" type=',
                   pathlib.Path("squares.vtu").read_text(errors="replace"), count=1))
    pathlib.Path("lz4.vtu").write_text(
        text.replace(' compressor="vtkZLibDataCompressor"', ""))
    refused("lz4.vtu", "is compressed by LZ4, .* write it with ZLib")
    status, _, error = start("mesh", "none.unv", "out.msh")
    check(status == 4 and "none.unv: No such file" in error, error)


test_public_files()
test_faces_of_abaqus()
test_generated_nodes()
test_sides_of_exodus()
test_families_of_med()
test_second_order_of_med()
test_partitions()
test_numbers_of_vtk()
test_unv_of_second_order()
test_conversion_before_a_run()
test_what_is_refused()
