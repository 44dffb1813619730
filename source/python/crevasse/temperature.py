# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""crevasse temperature: converts temperatures that another program computed, or a
table, into the one file that [Loads] Temperature reads (its format is described in
temperature/temperature_series.h). Reads .pvd, .pvtu, series in .xdmf, .csv, and
every format of meshio."""

import argparse
import os
import pathlib
import re
import sys
import tempfile
import types
import xml.etree.ElementTree

import h5py
import meshio
import numpy

from crevasse.mesh_parts import Mistake

INPUT_MISTAKE, FILE_FAILURE = 2, 4
NAMES = ("theta", "temperature", "t")

# The simplices into which a cell is split, by their corners. Those of cells of
# higher degree come first.
SIMPLICES = {
    2: {"triangle": ((0, 1, 2),),
        "quad": ((0, 1, 2), (0, 2, 3)),
        "quadrilateral": ((0, 1, 2), (0, 2, 3)),
        "pixel": ((0, 1, 3), (0, 3, 2))},
    3: {"tetra": ((0, 1, 2, 3),),
        "tetrahedron": ((0, 1, 2, 3),),
        "pyramid": ((0, 1, 2, 4), (0, 2, 3, 4)),
        "wedge": ((0, 1, 2, 5), (0, 1, 5, 4), (0, 4, 5, 3)),
        "hexahedron": ((0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6),
                       (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)),
        "voxel": ((0, 1, 3, 7), (0, 3, 2, 7), (0, 2, 6, 7),
                  (0, 6, 4, 7), (0, 4, 5, 7), (0, 5, 1, 7))}}


def main(words):
    arguments = parse(words)
    try:
        n_instants, n_meshes = convert(arguments)
    except Mistake as mistake:
        print(f"crevasse temperature: {mistake}", file=sys.stderr)
        return INPUT_MISTAKE
    except OSError as error:
        print(f"crevasse temperature: {error.filename}: {error.strerror}",
              file=sys.stderr)
        return FILE_FAILURE
    print(f"{arguments.output}: {n_instants} instant(s), {n_meshes} mesh(es)")
    return 0


def parse(words):
    parser = argparse.ArgumentParser(
        prog="crevasse temperature", description="Converts temperatures that "
        "another program computed into a file for [Loads] Temperature.")
    parser.add_argument("fields", help="a .pvd, .pvtu or .xdmf file; a .csv table "
                        "with the columns t, x, y[, z], theta and a row for each "
                        "point of a rectangular grid at each instant; or any other "
                        "that meshio reads, for one instant")
    parser.add_argument("--output", "-o", required=True, metavar="FILE.h5")
    parser.add_argument("--array", help="name of the scalar at the points (theta, "
                        "temperature or T, or the only scalar)")
    parser.add_argument("--subtract", type=float, default=0., metavar="T0",
                        help="temperature without thermal strain (0)")
    arguments = parser.parse_args(words)
    if not arguments.output.lower().endswith(".h5"):
        parser.error("--output must end in .h5")
    return arguments


def convert(arguments):
    """Writes the file; returns the numbers of instants and meshes."""
    path = pathlib.Path(arguments.output)
    meshes, mesh_of, times, dimension = [], [], [], None
    handle, part = tempfile.mkstemp(dir=path.parent, suffix=".part")
    os.close(handle)
    try:
        with h5py.File(part, "w") as file:
            for number, (time, name, parts) in enumerate(
                    instants(arguments.fields)):
                points, cells, theta, own = merge(name, parts, arguments.array)
                if dimension not in (None, own):
                    raise Mistake(f"{name}: its cells have dimension {own}, those of "
                                  f"earlier files {dimension}.")
                dimension = own
                index = next((index for index, mesh in enumerate(meshes)
                              if all(map(numpy.array_equal, mesh,
                                         (points, cells)))), len(meshes))
                if index == len(meshes):
                    meshes.append((points, cells))
                    file[f"points_{index}"] = points
                    file[f"cells_{index}"] = cells
                file[f"theta_{number}"] = theta - arguments.subtract
                times.append(time)
                mesh_of.append(index)
            file["times"], file["mesh_of"] = times, mesh_of
        os.chmod(part, 0o644)
        os.replace(part, path)
    finally:
        if os.path.exists(part):
            os.remove(part)
    return len(times), len(meshes)


def instants(name):
    """The instants in ascending order: time, file name, and the fields of its
    parts, each as points, blocks of cells and arrays at the points."""
    suffix = pathlib.Path(name).suffix.lower()
    if suffix == ".pvd":
        parts = {}
        for data_set in elements(name, "Collection", "DataSet"):
            time = data_set.get("timestep", "")
            try:
                parts.setdefault(float(time), []).append(
                    neighbour(name, data_set.get("file", "")))
            except ValueError:
                raise Mistake(f'{name}: has a DataSet with timestep = "{time}"; '
                              "it must be the instant within the period.") \
                    from None
        for time in sorted(parts):
            yield time, parts[time][0], [field for file in parts[time]
                                         for field in read(file)]
    elif suffix in (".xdmf", ".xmf"):
        yield from xdmf_series(name)
    elif suffix == ".csv":
        yield from table(name)
    else:
        yield 0., name, read(name)


def elements(name, kind, tag):
    """The elements of a collection of VTK's: pieces or data sets."""
    try:
        found = xml.etree.ElementTree.parse(name).getroot().findall(
            f"{kind}/{tag}")
    except xml.etree.ElementTree.ParseError as error:
        raise Mistake(f"{name}: is not XML: {error}") from None
    if not found:
        raise Mistake(f"{name}: is not a {kind} that names a {tag}.")
    return found


def neighbour(name, other):
    return str(pathlib.Path(name).parent / other)


def read(name):
    """Reads the fields of one file, or of all files that a .pvtu names."""
    if name.lower().endswith(".pvtu"):
        return [field for piece in elements(name, "PUnstructuredGrid", "Piece")
                for field in read(neighbour(name, piece.get("Source", "")))]
    with open(name, "rb"):
        pass  # the system's reason, if it cannot be read
    if name.lower().endswith(".vtu") and is_empty(name):
        return []
    mesh = by_meshio(name, lambda: meshio.read(name))
    return [(mesh.points, mesh.cells, mesh.point_data)]


def is_empty(name):
    """Whether the part of a parallel program's process has no cells."""
    with open(name, "rb") as file:
        counts = re.findall(rb'NumberOfCells\s*=\s*"(\d*)"', file.read())
    return counts and all(count == b"0" for count in counts)


def xdmf_series(name):
    def read_all():
        with meshio.xdmf.TimeSeriesReader(name) as reader:
            points, cells = reader.read_points_cells()
            return points, cells, [reader.read_data(step)[:2]
                                   for step in range(reader.num_steps)]

    with open(name, "rb"):
        pass
    points, cells, steps = by_meshio(name, read_all)
    for time, data in sorted(steps, key=lambda step: step[0]):
        yield time, name, [(points, cells, data)]


def table(name):
    """The instants of a table on a rectangular grid, whose rows have any order."""
    try:
        with open(name) as file:
            header = file.readline().replace(" ", "").strip()
            rows = numpy.loadtxt(file, delimiter=",", ndmin=2)
    except ValueError as error:
        raise Mistake(f"{name}: {error}") from None
    columns = header.split(",")
    if header not in ("t,x,y,theta", "t,x,y,z,theta") or (
            rows.shape[1] != len(columns)):
        raise Mistake(f"{name}: its first line must be t,x,y,theta or t,x,y,z,theta, "
                      "and the others as many numbers.")
    _, order = numpy.unique(rows[:, :-1], axis=0, return_index=True)
    sizes = [len(numpy.unique(column)) for column in rows.T[:-1]]
    if not len(order) == len(rows) == numpy.prod(sizes):
        raise Mistake(f"{name}: its rows are not the points of a rectangular grid, "
                      "the same at each instant.")
    numbers = numpy.arange(numpy.prod(sizes[1:])).reshape(sizes[1:])
    cells = [numbers[tuple(slice(corner >> d & 1, n - 1 + (corner >> d & 1))
                           for d, n in enumerate(numbers.shape))].ravel()
             for corner in range(1 << numbers.ndim)]
    block = types.SimpleNamespace(type="pixel" if numbers.ndim == 2 else "voxel",
                                  data=numpy.stack(cells, 1))
    for of_instant in rows[order].reshape(sizes[0], -1, len(columns)):
        yield of_instant[0, 0], name, [(of_instant[:, 1:-1], [block],
                                        {"theta": of_instant[:, -1]})]


def by_meshio(name, reader):
    """Reads a file by meshio, which may raise anything for a damaged one."""
    try:
        return reader()
    except (Exception, SystemExit) as error:  # pylint: disable=broad-except
        with open(name, "rb") as file:
            if b"vtkLZ4DataCompressor" in file.read(1000):
                raise Mistake(f"{name}: is compressed by LZ4, which meshio does not "
                              "read; write it with ZLib or uncompressed (ParaView: "
                              "Compressor Type)") from None
        raise Mistake(f"{name}: cannot be read by meshio: "
                      f"{type(error).__name__} {error}") from None


def merge(name, parts, array):
    """Points, simplices, temperature and dimension of one instant. Vertices of
    several parts are not merged: a temperature may jump across a crack."""
    cells = [(kind_of(block.type), block.data)
             for _, blocks, _ in parts for block in blocks]
    dimension = next((dimension for dimension in (3, 2) for kind, data in cells
                      if kind in SIMPLICES[dimension] and len(data)), None)
    if dimension is None:
        raise Mistake(f"{name}: has no cells of a plane or space; allowed are "
                      + ", ".join(SIMPLICES[2] | SIMPLICES[3]) + ".")
    points, simplices, values, n_points = [], [], [], 0
    for own_points, blocks, data in parts:
        for block in blocks:
            splitting = SIMPLICES[dimension].get(kind_of(block.type), ())
            simplices += [n_points + block.data[:, corners]
                          for corners in splitting]
        points.append(in_dimension(name, numpy.asarray(own_points), dimension))
        values.append(choose(name, data, array))
        n_points += len(own_points)
    points, simplices, values = map(numpy.concatenate,
                                    (points, simplices, values))
    check(name, points, simplices, values)
    return points, simplices, values, dimension


def kind_of(cell_type):
    """Kind of a cell without its degree: of quad9, VTK_LAGRANGE_QUADRILATERAL."""
    return cell_type.lower().removeprefix("vtk_lagrange_").rstrip("0123456789")


def in_dimension(name, points, dimension):
    if dimension == 2 and points.shape[1] == 3:
        if numpy.ptp(points[:, 2]) > 1e-6 * numpy.ptp(points[:, :2]):
            raise Mistake(f"{name}: its points differ in z; a mesh of triangles "
                          "or quadrilaterals must lie in a plane z = const.")
    return points[:, :dimension].astype(float)


def choose(name, data, array):
    """The array at the points that must be the temperature."""
    scalars = {key: numpy.ravel(values) for key, values in data.items()
               if numpy.ndim(values) == 1 or numpy.shape(values)[1:] == (1,)}
    wanted = [array] if array else [
        key for known in NAMES for key in scalars if key.lower() == known]
    if not array and not wanted and len(scalars) == 1:
        wanted = list(scalars)
    if not wanted or wanted[0] not in scalars:
        raise Mistake(
            f"{name}: no scalar at its points is "
            + (f'"{array}"' if array else "named theta, temperature or T")
            + f"; scalars: {', '.join(scalars) or 'none'}; others: "
            + (", ".join(set(data) - set(scalars)) or "none")
            + ". Choose one with --array. Values in cells are not read "
            "(ParaView: Cell Data to Point Data).")
    return scalars[wanted[0]].astype(float)


def check(name, points, simplices, values):
    if simplices.min() < 0 or simplices.max() >= len(points):
        raise Mistake(f"{name}: a cell has a point that the file does not contain.")
    if len(values) != len(points):
        raise Mistake(f"{name}: has {len(values)} temperatures at {len(points)} "
                      "points.")
    for what, numbers in (("coordinates", points[simplices.ravel()]),
                          ("temperatures", values[simplices.ravel()])):
        if not numpy.isfinite(numbers).all():
            raise Mistake(f"{name}: some {what} are not finite.")
