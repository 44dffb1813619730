"""Temperatures that another program has computed: conversion by the script
"crevasse temperature", several instants and meshes, and files that are wrong."""

import contextlib
import io
import math
import pathlib
import random
import sys

import h5py
import meshio
import numpy

from crevasse_run import (SOURCE, check, check_below, execute, full, plain,
                          probe_difference, run)

sys.path.insert(0, str(SOURCE / "source" / "python"))
from crevasse import temperature  # noqa: E402

BODY = plain("""
set Dimension = 2
subsection Geometry
  set Shape        = edge crack
  set Subdivisions = 4, 3
end
subsection Boundary
  set Symmetry = 2
end
subsection Material
  set Young modulus     = 13000 - 20*theta
  set Poisson ratio     = 0.2
  set Relaxation time   = 60*exp(-theta/400)
  set Thermal expansion = 1e-5
end
subsection Loads
  set Period   = 600
  set Traction = 0; 5*sin(2*pi*t/600)
end
subsection Time integration
  set Steps per period = 12
end
subsection Periodic state
  set Maximum periods = 1
  set Tolerance       = 0
end
subsection Output
  set Probes = mouth: 1, 0; inside: 0.4, 0.3
  set Fields = none
end
""")
BOX = BODY.replace("Dimension = 2", "Dimension = 3").replace(
    "Subdivisions = 4, 3", "Subdivisions = 3, 2, 2").replace(
        "0; 5*", "0; 0; 5*").replace(
            "1, 0; inside: 0.4, 0.3",
            "1, 0, 0; inside: 0.4, 0.3, 0.2")


def with_temperature(scene, name, temperature):
    return run(scene, name, [f"Loads/Temperature={temperature}"])


def check_equal(one, other, what, bound=1e-12):
    check_below(probe_difference(one, other), bound, what)


# --- meshes of the unit square and cube, that are not those of the body -------


def square(kind, n=5):
    """Points are moved inside, so that quadrilaterals are not rectangles."""
    generator = random.Random(3)
    points = []
    for j in range(n + 1):
        for i in range(n + 1):
            inside = 0 < i < n and 0 < j < n
            points.append([(i + inside * generator.uniform(-.2, .2)) / n,
                           (j + inside * generator.uniform(-.2, .2)) / n, 0.7])
    cells = []
    for j in range(n):
        for i in range(n):
            a = j * (n + 1) + i
            quad = [a, a + 1, a + n + 2, a + n + 1]
            if kind == "quad":
                cells.append(quad)
            else:  # one of them turned the wrong way round
                cells += [quad[:3], [quad[0], quad[3], quad[2]]]
    return numpy.array(points), numpy.array(cells)


def cube(kind, n=3):
    generator = random.Random(5)
    points = []
    for k in range(n + 1):
        for j in range(n + 1):
            for i in range(n + 1):
                inside = 0 < i < n and 0 < j < n and 0 < k < n
                points.append([(c + inside * generator.uniform(-.15, .15)) / n
                               for c in (i, j, k)])
    corners = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0),
               (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
    tetrahedra = ((0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6),
                  (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6))
    cells = []
    for k in range(n):
        for j in range(n):
            for i in range(n):
                hexahedron = [((k + c) * (n + 1) + j + b) * (n + 1) + i + a
                              for a, b, c in corners]
                if kind == "hexahedron":
                    cells.append(hexahedron)
                else:
                    cells += [[hexahedron[v] for v in tetrahedron]
                              for tetrahedron in tetrahedra]
    return numpy.array(points), numpy.array(cells)


def midpoints(points, cells):
    """Makes simplices quadratic; which edge comes first does not matter."""
    points, numbers, quadratic = list(points), {}, []
    for cell in cells:
        nodes = list(cell)
        for a in range(len(cell)):
            for b in range(a + 1, len(cell)):
                edge = tuple(sorted((cell[a], cell[b])))
                if edge not in numbers:
                    numbers[edge] = len(points)
                    points.append((points[edge[0]] + points[edge[1]]) / 2)
                nodes.append(numbers[edge])
        quadratic.append(nodes)
    return numpy.array(points), numpy.array(quadratic)


# --- files of other programs ----------------------------------------------------


def write(path, mesh, kind, values, name="theta", **options):
    """Lines of the boundary are left out, and so is what is no scalar."""
    points, cells = mesh
    meshio.vtu.write(path, meshio.Mesh(
        points, {"line": [[0, 1], [1, 2]], kind: cells},
        point_data={name: numpy.array(values), "flux": points}), **options)


def write_collection(path, instants):
    sets = "".join(f'<DataSet timestep="{t}" group="" part="0" file="{file}"/>\n'
                   for t, file in instants)
    pathlib.Path(path).write_text(
        '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1" '
        f'byte_order="LittleEndian">\n<Collection>\n{sets}</Collection>\n'
        "</VTKFile>\n")


def script(*words):
    """Exit status and messages of the script."""
    with contextlib.redirect_stderr(io.StringIO()) as error, \
            contextlib.redirect_stdout(io.StringIO()) as output:
        status = temperature.main([str(word) for word in words])
    return status, output.getvalue() + error.getvalue()


def convert(name, *words):
    """Returns the name of the converted file."""
    output = pathlib.Path(name).stem + ".h5"
    status, messages = script(name, "--output", output, *words)
    check(status == 0, messages)
    return output


def linear(points):
    return 100 * (1 + 2 * points[:, 0] - points[:, 1])


FORMULA = "100*(1 + 2*x - y)"
TABLE = "t,x,y,theta\n0,0,0,1\n0,1,0,1\n0,0,1,1\n0,1,1,1\n"


# --- tests --------------------------------------------------------------------


def test_cells():
    """A linear field is matched on every kind of cell."""
    for scene, formula, kinds, mesh in (
            (BODY, FORMULA, ("triangle", "quad", "triangle6"), square),
            (BOX, FORMULA + " + 50*z", ("tetra", "hexahedron", "tetra10"),
             cube)):
        name = f"formula_{len(kinds[0])}"
        one = with_temperature(scene, name, formula)
        check(max(map(abs, one.table("probe_inside.csv")["s_11"])) > 0.1,
              "the temperature strains the body")
        for kind in kinds:
            points, cells = mesh(kind)
            if kind in ("triangle6", "tetra10"):
                points, cells = midpoints(points, cells)
            values = linear(points)
            if scene == BOX:
                values = values + 50 * points[:, 2]
            write(f"{kind}.vtu", (points, cells), kind, values)
            other = with_temperature(scene, "of_" + kind,
                                     convert(f"{kind}.vtu"))
            check_equal(one, other, kind)


def test_splitting():
    """The simplices of each kind of cell fill it once."""
    prism = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1)]
    box = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
    for kind, corners, expected in (
            ("quad", [(0, 0), (1, 0), (1, 1), (0, 1)], 1.),
            ("pixel", [(0, 0), (1, 0), (0, 1), (1, 1)], 1.),
            ("pyramid", [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1)],
             1 / 3), ("wedge", prism, 0.5), ("voxel", box, 1.),
            ("hexahedron", [box[i] for i in (0, 1, 3, 2, 4, 5, 7, 6)], 1.)):
        corners = numpy.array(corners, dtype=float)
        n = corners.shape[1]
        simplices = temperature.SIMPLICES[n][kind]
        volumes = [abs(numpy.linalg.det(corners[list(simplex[1:])]
                                        - corners[simplex[0]]))
                   / math.factorial(n) for simplex in simplices]
        check_below(abs(sum(volumes) - expected), 1e-12, kind)
        check(min(volumes) > 0.1, f"{kind}: {volumes}")


def test_names():
    points, cells = square("quad")
    values, zero = linear(points), 0 * points[:, 0]
    one = with_temperature(BODY, "formula", FORMULA)
    for arrays, words in (({"a": zero, "Temperature": values}, ()),
                          ({"a": zero, "t": zero, "THETA": values}, ()),
                          ({"anything": values, "u": points}, ()),
                          ({"T": zero, "a": values + 273},
                           ("--array", "a", "--subtract", 273))):
        meshio.vtu.write("names.vtu", meshio.Mesh(
            points, {"quad": cells}, point_data=arrays))
        other = with_temperature(BODY, "names", convert("names.vtu", *words))
        check_equal(one, other, ", ".join(arrays), 1e-11)


def test_parts():
    """Files of the program for two processes, one of them without cells:
    a stress, named theta."""
    fields = run(BODY, "fields", [
        "Output/Fields=vtu", "Output/Field times=150, 450"]).directory
    for path in fields.glob("*.*vtu"):
        path.write_text(path.read_text().replace('"von_mises_stress"', '"theta"'))
    theirs = meshio.read(fields / "solution_0000.0.vtu")
    theta = theirs.point_data["theta"].ravel()
    print(f"theta from {theta.min():.3g} to {theta.max():.3g}")
    check(numpy.ptp(theta) > 0.1, "the field varies")
    write("ours.vtu", (theirs.points, theirs.cells_dict["quad"]), "quad", theta)
    one = with_temperature(BODY, "ours", convert("ours.vtu"))
    (fields / "empty.vtu").write_text(
        '<VTKFile type="UnstructuredGrid"><UnstructuredGrid><Piece '
        'NumberOfPoints="0" NumberOfCells="0"/></UnstructuredGrid></VTKFile>')
    record = (fields / "solution_0000.pvtu").read_text()
    (fields / "two.pvtu").write_text(record.replace(
        "<Piece ", '<Piece Source="empty.vtu"/>\n<Piece ', 1))
    for name in ("solution_0000.0.vtu", "solution_0000.pvtu", "two.pvtu"):
        other = with_temperature(BODY, "theirs", convert(fields / name))
        check_equal(one, other, name)
    with h5py.File(convert(fields / "solution.pvd")) as file:
        check(len(file["times"]) > 1 and "points_1" not in file,
              "instants share their mesh")


def test_instants():
    """Linear in time as a table is, across the end of the period, too; meshes
    may differ."""
    def wave(t):
        return abs((t % 600) - 300) / 300

    with open("table.csv", "w") as table:
        table.write("t,x,y,theta\n")
        instants = []
        for number, t in enumerate((50, 120, 300, 420, 550)):
            kind = "triangle" if number == 3 else "quad"
            points, cells = square(kind, 6 if number == 4 else 5)
            write(f"step_{number}.vtu", (points, cells), kind,
                  wave(t) * linear(points))
            instants.append((t, f"step_{number}.vtu"))
            for x in (0, 1):
                for y in (0, 1):
                    value = wave(t) * 100 * (1 + 2 * x - y)
                    table.write(f"{t},{x},{y},{value!r}\n")
    write_collection("series.pvd", instants[::-1])
    convert("series.pvd")
    one = with_temperature(BODY, "table", convert("table.csv"))
    other = with_temperature(BODY, "series", "series.h5")
    check_equal(one, other, "series against table")
    # Below the directory of the scene, and from used.prm.
    pathlib.Path("elsewhere").mkdir(exist_ok=True)
    scene = pathlib.Path("elsewhere/scene.prm")
    scene.write_text(BODY.replace("set Period ", "set Temperature = "
                                  "../series.h5\n  set Period "))
    for path in (scene, run(scene, "relative").directory / "used.prm"):
        check_equal(other, run(path, "again"), str(path), 0.)


def test_other_content():
    """A run is resumed only if the file has not changed."""
    points, cells = square("quad")
    pathlib.Path("kept.prm").write_text(BODY.replace(
        "set Period ", "set Temperature = kept.h5\n  set Period "))
    arguments = ["kept.prm", "--output", "results/kept"]
    for more, factor, expected in (([], 0.5, 0), (["--resume"], 0.5, 0),
                                   (["--resume"], 0.6, 2)):
        write("kept.vtu", (points, cells), "quad", factor * linear(points))
        convert("kept.vtu")
        status, _, error = execute(*arguments, *more)
        check(status == expected, f"{more}, {factor}: {status} {error}")
    check("[Loads] Temperature" in error, error)


def test_curved_boundary():
    """A point between an arc and the edge that stands for it is accepted, one
    further out is not."""
    highest = 1 - (1 - 1 / math.sqrt(3)) / 6  # of the quadrature points
    for gap, status in ((0.045, 0), (0.055, 2)):
        top = highest - gap * 1.32  # the diameter of a cell of this height
        points, cells = square("quad", 1)
        points[:, 1] *= top
        write("short.vtu", (points, cells), "quad", linear(points))
        run(BODY, "short", [f"Loads/Temperature={convert('short.vtu')}"], status)


def refused(message, name, scene=BODY, expected=2):
    pathlib.Path("refused.prm").write_text(plain(scene))
    status, _, error = execute("refused.prm", "--check", "--set",
                               f"Loads/Temperature={name}")
    print(f"{status}: {error.strip()}")
    check(status == expected, f"{name}: exit status {status}")
    check("[Loads] Temperature = " in error and name + ": " in error
          and message in error, f"{name}: no '{message}' in '{error}'")


def test_refused():
    points, cells = square("quad")
    write("good.vtu", (points, cells), "quad", linear(points))
    convert("good.vtu")
    refused("crevasse temperature good.vtu --output", "good.vtu")
    refused("No such file", "missing.h5", expected=4)
    pathlib.Path("bad.h5").write_text("x,y\n")
    refused("is not an HDF5 file", "bad.h5")

    def changed(message, **datasets):
        pathlib.Path("bad.h5").write_bytes(pathlib.Path("good.h5").read_bytes())
        with h5py.File("bad.h5", "a") as file:
            for name, values in datasets.items():
                del file[name]
                if values is not None:
                    file[name] = values
        refused(message, "bad.h5")

    changed('no dataset "times"', times=None)
    changed("ascending", times=[0, 0])
    changed("from 0 to 601; they must be within", times=[0, 601])
    changed("from -1 to", times=[-1])
    changed('"mesh_of" must have as many', mesh_of=[0, 0])
    changed('no dataset "points_1"', mesh_of=[1])
    changed("rows of 1 numbers", theta_0=b"text")
    changed("3 rows for 36 points", theta_0=[1, 2, 3])
    changed("not finite", theta_0=[math.nan] * 36)
    changed("the entry 36", cells_0=[[0, 1, 36]])
    changed("the entry -1", cells_0=[[0, -1, 5]])
    changed("rows of 3 numbers", cells_0=[[0, 1, 2, 3]])
    refused("for Dimension = 3", "good.h5", scene=BOX)
    points[:, 0] *= 0.5
    write("half.vtu", (points, cells), "quad", linear(points))
    refused("lies outside the mesh", convert("half.vtu"))


def test_refused_by_script():
    points, cells = square("quad")
    values = linear(points)
    write("good.vtu", (points, cells), "quad", values)

    def script_refuses(message, name, *words, expected=2):
        status, messages = script(name, "--output", "bad.h5", *words)
        print(f"{status}: {messages.strip()}")
        check(status == expected and message in messages, f"not: {message}")
        check(not list(pathlib.Path().glob("*.part")), "a part is left")

    def bad(message, kind="quad", mesh=(points, cells), **arrays):
        meshio.vtu.write("bad.vtu", meshio.Mesh(mesh[0], {kind: mesh[1]},
                                                point_data=arrays))
        script_refuses(message, "bad.vtu")

    script_refuses("No such file", "missing.vtu", expected=4)
    script_refuses("No such file", "missing.pvd", expected=4)
    for message, rows in (("first line", "time,x,y,theta\n0,0,0,1\n"),
                          ("first line", "t,x,y,theta\n0,0,0,0,1\n"),
                          ("first line", ""), ("could not convert",
                                               "t,x,y,theta\n0,0,0,warm\n"),
                          ("rectangular grid", TABLE.replace("0,1,0,1\n", "")),
                          ("rectangular grid", TABLE + "0,0,0,2\n"),
                          ("no cells", "t,x,y,theta\n0,0,0,1\n0,1,0,1\n")):
        pathlib.Path("bad.csv").write_text(rows)
        script_refuses(message, "bad.csv")
    bad("scalars: a, b", a=values, b=values)
    bad("others: u", u=points)
    bad("temperatures are not finite", theta=values * math.nan)
    bad("no cells of a plane or space", "line", (points, cells[:, :2]),
        theta=values)
    bad("differ in z", mesh=(points + numpy.outer(values, [0, 0, 1]), cells),
        theta=values)
    script_refuses('no scalar at its points is "b"', "good.vtu", "--array", "b")
    for length in (0, 100, 1000):
        pathlib.Path("bad.vtu").write_bytes(
            pathlib.Path("good.vtu").read_bytes()[:length])
        script_refuses("cannot be read by meshio", "bad.vtu")
    for message, instants in (
            ("names a DataSet", ()), ('timestep = "later"',
                                      (("later", "good.vtu"),)),
            ("No such file", ((0, "missing.vtu"),))):
        write_collection("bad.pvd", instants)
        script_refuses(message, "bad.pvd",
                       expected=4 if message == "No such file" else 2)


@full
def test_corrupted():
    """Bytes that are damaged may be found wrong or not, but nothing crashes."""
    generator = random.Random(1)
    points, cells = square("quad", 3)
    write("whole.vtu", (points, cells), "quad", linear(points))
    whole = pathlib.Path(convert("whole.vtu")).read_bytes()
    pathlib.Path("refused.prm").write_text(BODY)
    statuses = []
    for round in range(20):
        bad = bytearray(whole)
        for _ in range(3):
            bad[generator.randrange(len(bad))] = generator.randrange(256)
        if round % 3 == 2:
            del bad[generator.randrange(len(bad)):]
        pathlib.Path("damaged.h5").write_bytes(bad)
        status, _, error = execute("refused.prm", "--check", "--set",
                                   "Loads/Temperature=damaged.h5")
        statuses.append(status)
        check(status in (0, 2, 3), f"exit status {status}: {error}")
    print(f"damaged files: exit statuses {statuses}")


if __name__ == "__main__":
    test_cells()
    test_splitting()
    test_names()
    test_parts()
    test_instants()
    test_other_content()
    test_curved_boundary()
    test_refused()
    test_refused_by_script()
    test_corrupted()
