"""Temperatures that another program has computed, in VTK's files: encodings,
kinds of cells, several instants, and files that are wrong."""

import base64
import math
import pathlib
import random
import struct
import zlib

import meshio
import numpy

from crevasse_run import check, check_below, execute, probe_difference, run

BODY = """
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
"""
BOX = BODY.replace("Dimension = 2", "Dimension = 3").replace(
    "Subdivisions = 4, 3", "Subdivisions = 3, 2, 2").replace(
        "0; 5*", "0; 0; 5*").replace(
            "1, 0; inside: 0.4, 0.3",
            "1, 0, 0; inside: 0.4, 0.3, 0.2")
CELL_TYPES = {"triangle": 5, "quad": 9, "tetra": 10, "hexahedron": 12,
              "triangle6": 22, "tetra10": 24}


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


# --- a writer that knows every encoding ---------------------------------------


class Writer:
    def __init__(self, encoding="ascii", header="UInt32", compressed=False,
                 apart=False, block=1000, byte_order="LittleEndian"):
        self.encoding = encoding  # ascii, binary, base64 or raw (appended)
        self.header = header
        self.compressed = compressed
        self.apart = apart        # header and data each with its own padding
        self.block = block
        self.byte_order = byte_order
        self.appended = b""

    def integers(self, *numbers):
        return struct.pack(f"<{len(numbers)}" + "IQ"[self.header == "UInt64"],
                           *numbers)

    def encode(self, data):
        if self.compressed:
            blocks = [data[i:i + self.block]
                      for i in range(0, len(data), self.block)]
            last = len(blocks[-1])
            packed = [zlib.compress(block) for block in blocks]
            head = self.integers(len(blocks), self.block,
                                 last if last < self.block else 0,
                                 *map(len, packed))
            data = b"".join(packed)
        else:
            head = self.integers(len(data))
        if self.encoding == "raw":
            return head + data
        if self.apart or self.compressed:
            return base64.b64encode(head) + base64.b64encode(data)
        return base64.b64encode(head + data)

    def array(self, name, kind, values, components=1):
        values = numpy.asarray(values, dtype=kind.lower()).ravel()
        head = (f'<DataArray type="{kind}" Name="{name}" '
                f'NumberOfComponents="{components}" ')
        if self.encoding == "ascii":
            return head + 'format="ascii">\n' + " ".join(
                repr(value) for value in values.tolist()) + "\n</DataArray>\n"
        code = self.encode(values.tobytes())
        if self.encoding == "binary":
            return head + f'format="binary">\n  {code.decode()}\n</DataArray>\n'
        place = len(self.appended)
        self.appended += code
        return head + f'format="appended" offset="{place}"/>\n'

    def piece(self, points, cells, kind, arrays, real="Float64"):
        n = len(cells)
        data = "".join(self.array(name, real, values, 1 + 2 * (
            numpy.ndim(values) == 2)) for name, values in arrays.items())
        return (f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="{n}">\n'
                "<PointData>\n" + data + "</PointData>\n<Points>\n"
                + self.array("Points", real, points, 3) + "</Points>\n<Cells>\n"
                + self.array("connectivity", "Int64", cells)
                + self.array("offsets", "Int32",
                             [len(cells[0]) * (k + 1) for k in range(n)])
                + self.array("types", "UInt8", [CELL_TYPES[kind]] * n)
                + "</Cells>\n</Piece>\n")

    def write(self, path, *pieces):
        text = ('<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" '
                f'version="1.0" byte_order="{self.byte_order}" '
                f'header_type="{self.header}"')
        if self.compressed:
            text += ' compressor="vtkZLibDataCompressor"'
        text += (">\n<UnstructuredGrid>\n" + "".join(pieces)
                 + "</UnstructuredGrid>\n")
        code = text.encode()
        if self.appended:
            code += (f'<AppendedData encoding="{self.encoding}">\n  _'.encode()
                     + self.appended + b"\n</AppendedData>\n")
        pathlib.Path(path).write_bytes(code + b"</VTKFile>\n")


def write(path, mesh, kind, values, name="theta", **options):
    writer = Writer(**options)
    writer.write(path, writer.piece(*mesh, kind, {name: values}))


def write_collection(path, instants):
    """Of (timestep, file) or (timestep, file, part)."""
    sets = "".join(f'<DataSet timestep="{t}" group="" file="{file}" '
                   f'part="{"".join(map(str, part)) or 0}"/>\n'
                   for t, file, *part in instants)
    pathlib.Path(path).write_text(
        '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1" '
        f'byte_order="LittleEndian">\n<Collection>\n{sets}</Collection>\n'
        "</VTKFile>\n")


def linear(points):
    return 100 * (1 + 2 * points[:, 0] - points[:, 1])


FORMULA = "100*(1 + 2*x - y)"


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
            other = with_temperature(scene, "of_" + kind, f"{kind}.vtu")
            check_equal(one, other, kind)
    # The values in between are those of the elements: of a bilinear one here.
    corners = numpy.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.]])
    write("one.vtu", (corners, numpy.array([[0, 1, 2, 3]])), "quad",
          [10, 30, 100, 50])
    one = with_temperature(BODY, "formula_bilinear",
                           "10 + 20*x + 40*y + 30*x*y")
    other = with_temperature(BODY, "bilinear", "one.vtu")
    check_equal(one, other, "bilinear", 1e-11)


def test_encodings():
    points, cells = square("triangle", 14)
    values = linear(points)
    one = with_temperature(BODY, "formula", FORMULA)

    def compare(name):
        check_equal(one, with_temperature(BODY, "encoded", name), name)

    for encoding in ("ascii", "binary", "base64", "raw"):
        for header, compressed in (("UInt32", False), ("UInt64", True)):
            name = f"{encoding}_{header}.vtu"
            write(name, (points, cells), "triangle", values,
                  encoding=encoding, header=header, compressed=compressed)
            compare(name)
    for encoding in ("binary", "base64"):
        write("apart.vtu", (points, cells), "triangle", values, apart=True,
              encoding=encoding)
        compare("apart.vtu")
    for options in ({"binary": False}, {"compression": None}, {}):
        # Lines of the boundary are left out, and so is what is no scalar.
        meshio.vtu.write("meshio.vtu", meshio.Mesh(
            points, {"line": [[0, 1], [1, 2]], "triangle": cells},
            point_data={"T": values, "flux": points}), **options)
        other = with_temperature(BODY, "meshio", "meshio.vtu")
        check_equal(one, other, f"meshio with {options}",
                    1e-9 if "binary" in options else 1e-12)  # 12 digits


def test_names():
    points, cells = square("quad")
    values, zero = linear(points), 0 * points[:, 0]
    one = with_temperature(BODY, "formula", FORMULA)
    for arrays in ({"a": zero, "Temperature": values},
                   {"T": values, "a": zero},
                   {"a": zero, "t": zero, "THETA": values},
                   {"anything": values, "u": points}):
        writer = Writer()
        writer.write("names.vtu", writer.piece(points, cells, "quad", arrays))
        other = with_temperature(BODY, "names", "names.vtu")
        check_equal(one, other, ", ".join(arrays))


def test_parts():
    """Pieces of a file, of several files, and files that deal.II wrote."""
    points, cells = square("quad", 4)
    values = linear(points)
    one = with_temperature(BODY, "formula", FORMULA)
    pathlib.Path("parts").mkdir(exist_ok=True)

    def halves(writer):
        """The second one with points of its own, and in between a process that
        has no cells."""
        mine = [writer.piece(points, part, "quad", {"theta": values})
                for part in (cells[:7], cells[7:])]
        return [mine[0], '<Piece NumberOfPoints="0" NumberOfCells="0"/>\n',
                mine[1]]

    writer = Writer("binary")
    writer.write("pieces.vtu", *halves(writer))
    first, _, second = halves(writer)
    writer.write("parts/first.vtu", first)
    writer.write("parts/second.vtu", second)
    write_collection("parts.pvd", [(0, "parts/first.vtu", 0),
                                   (0, "parts/second.vtu", 1)])
    pathlib.Path("parallel.pvtu").write_text(
        '<?xml version="1.0"?>\n<VTKFile type="PUnstructuredGrid">\n'
        '<PUnstructuredGrid GhostLevel="0">\n<Piece Source="parts/first.vtu"/>'
        '\n<Piece Source="parts/second.vtu"/>\n</PUnstructuredGrid>\n'
        "</VTKFile>\n")
    write_collection("of_pvtu.pvd", [(300, "parallel.pvtu")])
    for name in ("pieces.vtu", "parts.pvd", "parallel.pvtu", "of_pvtu.pvd"):
        check_equal(one, with_temperature(BODY, "parts", name), name)

    # Files of a run: a stress, named theta, against the same in our encoding.
    fields = run(BODY, "fields", [
        "Output/Fields=vtu", "Output/Field times=150, 450"]).directory
    for path in fields.glob("*.*vtu"):
        path.write_text(path.read_text().replace('"stress_11"', '"theta"'))
    theirs = meshio.read(fields / "solution_0000.0.vtu")
    theta = theirs.point_data["theta"].ravel()
    print(f"deal.II's file: theta from {theta.min():.3g} to {theta.max():.3g}")
    check(numpy.ptp(theta) > 0.1, "the field varies")
    write("ours.vtu", (theirs.points, theirs.cells_dict["quad"]), "quad", theta)
    one = with_temperature(BODY, "ours", "ours.vtu")
    for name in ("solution_0000.0.vtu", "solution_0000.pvtu"):
        other = with_temperature(BODY, "theirs", (fields / name).resolve())
        check_equal(one, other, name)
    with_temperature(BODY, "of_fields", (fields / "solution.pvd").resolve())


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
                  wave(t) * linear(points), encoding="binary")
            instants.append((t, f"step_{number}.vtu"))
            for x in (0, 1):
                for y in (0, 1):
                    value = wave(t) * 100 * (1 + 2 * x - y)
                    table.write(f"{t},{x},{y},{value!r}\n")
    write_collection("series.pvd", instants[::-1])
    one = with_temperature(BODY, "table", "table.csv")
    other = with_temperature(BODY, "series", "series.pvd")
    check_equal(one, other, "series against table")
    # Below the directory of the scene, and from used.prm.
    pathlib.Path("elsewhere").mkdir(exist_ok=True)
    scene = pathlib.Path("elsewhere/scene.prm")
    scene.write_text(BODY.replace("set Period ", "set Temperature = "
                                  "../series.pvd\n  set Period "))
    for path in (scene, run(scene, "relative").directory / "used.prm"):
        check_equal(other, run(path, "again"), str(path), 0.)


def test_other_content():
    """A run is gone on with if none of the files has changed."""
    points, cells = square("quad")

    def write_step(factor):
        write("first.vtu", (points, cells), "quad", linear(points))
        write("second.vtu", (points, cells), "quad", factor * linear(points))

    write_step(0.5)
    write_collection("kept.pvd", [(0, "first.vtu"), (300, "second.vtu")])
    pathlib.Path("kept.prm").write_text(BODY.replace(
        "set Period ", "set Temperature = kept.pvd\n  set Period "))
    arguments = ["kept.prm", "--output", "results/kept"]
    for more, factor, expected in (([], 0.5, 0), (["--resume"], 0.5, 0),
                                   (["--resume"], 0.6, 2)):
        write_step(factor)
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
        run(BODY, "short", ["Loads/Temperature=short.vtu"], status)


def refused(message, name, scene=BODY, expected=2):
    pathlib.Path("refused.prm").write_text(scene)
    status, _, error = execute("refused.prm", "--check", "--set",
                               f"Loads/Temperature={name}")
    print(f"{status}: {error.strip()}")
    check(status == expected, f"{name}: exit status {status}")
    check("[Loads] Temperature = " in error and name + ": " in error
          and message in error, f"{name}: no '{message}' in '{error}'")


def test_refused():
    points, cells = square("quad")
    values = linear(points)
    mesh = (points, cells)
    write("good.vtu", mesh, "quad", values)
    good = pathlib.Path("good.vtu").read_text()

    def changed(message, old, new):
        check(old in good, f"no {old} in the file")
        pathlib.Path("bad.vtu").write_text(good.replace(old, new))
        refused(message, "bad.vtu")

    refused("No such file", "missing.vtu", expected=4)
    refused("No such file", "missing.pvd", expected=4)
    pathlib.Path("bad.vtu").write_text("")
    refused("is empty", "bad.vtu")
    pathlib.Path("bad.vtu").write_text("x,y\n")
    refused("is not XML", "bad.vtu")
    pathlib.Path("bad.vtu").write_text("<a/>")
    refused("no element VTKFile", "bad.vtu")
    pathlib.Path("bad.vtu").write_text("<a>" * 1000000)
    refused("elements within elements", "bad.vtu")
    for length in (100, len(good) // 2, len(good) - 20):
        pathlib.Path("bad.vtu").write_text(good[:length])
        refused("breaks off", "bad.vtu")
    changed("BigEndian", "LittleEndian", "BigEndian")
    changed("LZ4", 'header_type="UInt32"', 'compressor="vtkLZ4DataCompressor"')
    changed("header_type", "UInt32", "UInt16")
    changed("its type is", '"UnstructuredGrid"', '"PolyData"')
    changed("36 numbers; it must have 35", 'Points="36"', 'Points="35"')
    changed("must have 4000000000", 'Points="36"', 'Points="4000000000"')
    changed("NumberOfPoints", 'Points="36"', 'Points="-3"')
    changed("4000000000", 'Cells="25"', 'Cells="4000000000"')
    changed("not finite at the point (0, 0)", "\n100.0 ", "\nnan ")
    changed('has "1oo"', "\n100.0 ", "\n1oo ")
    changed("the entry 36", "\n0 1 7 6", "\n36 1 7 6")
    changed("the entry -1", "\n0 1 7 6", "\n-1 1 7 6")
    changed("the entry 1.5", "\n0 1 7 6", "\n1.5 1 7 6")
    changed("\"offsets\"", "\n4 8 12", "\n4 2 12")
    changed("type 13", "\n9 9", "\n13 9")
    changed("differ in z", "0.0 0.0 0.7", "0.0 0.0 0.5")
    changed("\"offsets\"", 'Name="offsets"', 'Name="others"')
    changed("Its scalars", '"theta" NumberOfComponents='
            '"1"', '"theta" NumberOfComponents="9"')
    changed("the type \"Text\"", 'type="Float64" Name="theta"',
            'type="Text" Name="theta"')
    changed("the format \"hex\"", 'Name="theta" NumberOfComponents="1" '
            'format="ascii"', 'Name="theta" NumberOfComponents="1" '
            'format="hex"')
    changed("triangles (5)", "\n9 9", "\n10 9")
    refused("no cells of dimension 3", "good.vtu", scene=BOX)
    points[:, 0] *= 0.5
    write("half.vtu", mesh, "quad", values)
    refused("lies outside of the mesh", "half.vtu")
    points[:, 0] *= 2

    writer = Writer()
    writer.write("bad.vtu", writer.piece(points, cells, "quad",
                                         {"a": values, "b": values}))
    refused('"a", "b"', "bad.vtu")
    writer.write("bad.vtu", writer.piece(points, cells, "quad",
                                         {"u": points}))
    refused('others: "u"', "bad.vtu")

    # Collections
    def collection(message, *instants):
        write_collection("bad.pvd", instants)
        refused(message, "bad.pvd")

    collection("names no DataSet")
    collection("from 0 to 601; they must be within", (0, "good.vtu"),
               (601, "good.vtu"))
    collection("from -1 to", (-1, "good.vtu"))
    collection("two DataSets for timestep = 5", (5, "good.vtu"),
               (5, "good.vtu"))
    collection('timestep = "later"', ("later", "good.vtu"))
    collection("missing.vtu: cannot be read", (0, "missing.vtu"))
    collection("bad.vtu: one array", (0, "good.vtu"), (1, "bad.vtu"))
    collection("must be UnstructuredGrid", (0, "bad.pvd"))
    pathlib.Path("bad.pvd").write_text(good)
    refused("must be a Collection", "bad.pvd")


def test_corrupted():
    """Bytes that are damaged may be found wrong or not, but nothing crashes."""
    generator = random.Random(1)
    points, cells = square("quad", 3)
    statuses = []
    for encoding in ("ascii", "binary", "base64", "raw"):
        for compressed in (False, True):
            write("whole.vtu", (points, cells), "quad", linear(points),
                  encoding=encoding, compressed=compressed)
            whole = pathlib.Path("whole.vtu").read_bytes()
            for round in range(6):
                bad = bytearray(whole)
                for _ in range(3):
                    bad[generator.randrange(len(bad))] = generator.choice(
                        (b"AZaz/09", b"A/=<>09 \x00\xff")[round % 2])
                if round % 3 == 2:
                    del bad[generator.randrange(len(bad)):]
                pathlib.Path("damaged.vtu").write_bytes(bad)
                pathlib.Path("refused.prm").write_text(BODY)
                status, _, error = execute(
                    "refused.prm", "--check", "--set",
                    "Loads/Temperature=damaged.vtu")
                statuses.append(status)
                check(status in (0, 2, 3), f"exit status {status}: {error}")
    print(f"damaged files: exit statuses {statuses}")


if __name__ == "__main__":
    test_cells()
    test_encodings()
    test_names()
    test_parts()
    test_instants()
    test_other_content()
    test_curved_boundary()
    test_refused()
    test_corrupted()
