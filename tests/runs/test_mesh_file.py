"""The same body, built in and read from both formats of Gmsh, whose nodes are
numbered differently."""

import os
import pathlib
import shutil

from crevasse_run import SOURCE, check, check_below, execute, run

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

READ = """\
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
""" + REST

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


test_formats()
test_names()
test_names_of_materials()
test_list_of_materials()
test_where_it_is_looked_for()
test_used_parameters()
