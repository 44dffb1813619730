# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Reads mesh files with their groups. Of the formats below meshio 5.0 loses groups or
orders of nodes; it reads all others."""

import collections
import itertools
import pathlib

import numpy

from crevasse import mesh_abaqus
from crevasse.mesh_parts import Mesh, Mistake

# Dimensions of the kinds of meshio and of MED, by the beginning of their names.
DIMENSIONS = {"line": 1, "triangle": 2, "quad": 2, "tetra": 3, "pyramid": 3, "wedge": 3,
              "hexahedron": 3, "SE": 1, "TR": 2, "QU": 2, "TE": 3, "T1": 3, "PY": 3,
              "P1": 3, "PE": 3, "HE": 3, "H2": 3}
# Kinds of VTK with another order of corners.
SWAPPED = {"pixel": ("quad", [0, 1, 3, 2]),
           "voxel": ("hexahedron", [0, 1, 3, 2, 4, 5, 7, 6])}
# Integers in cells with more different values are no groups.
MOST_VALUES = 1000


def read(path):
    """The mesh of a file, and the name of its format."""
    suffix = pathlib.Path(path).suffix.lower()
    with open(path, "rb") as file:
        head = file.read(200).lstrip()
    if suffix == ".msh":
        raise Mistake(f"{path}: the program reads Gmsh files itself, and divides their "
                      "triangles and tetrahedra")
    if suffix == ".inp" and head.startswith(b"*"):
        return mesh_abaqus.read(path), "Abaqus"
    for name, suffixes, reader in (
            ("UNV", (".unv",), read_unv), ("MED", (".med",), read_med),
            ("Exodus", (".e", ".exo", ".ex2"), read_exodus)):
        if suffix in suffixes:
            try:
                return reader(path), name
            except (OSError, ValueError, LookupError, AttributeError,
                    StopIteration) as error:
                raise Mistake(f"{path}: cannot be read as {name}: "
                              f"{type(error).__name__} {error}") from None
    file_format = "avsucd" if suffix in (".inp", ".ucd") else None
    return read_by_meshio(path, file_format), "by meshio"


def read_unv(path):
    """Data sets of nodes, elements and groups. In elements of second order a node in
    the middle follows its corner, and verticals stand between bottom and top."""
    orders = {(1, 3): [0, 2, 1], (2, 6): [0, 2, 4, 1, 3, 5],
              (2, 8): [0, 2, 4, 6, 1, 3, 5, 7],
              (3, 10): [0, 2, 4, 9, 1, 3, 5, 6, 7, 8],
              (3, 15): [0, 2, 4, 9, 11, 13, 1, 3, 5, 10, 12, 14, 6, 7, 8],
              (3, 20): [0, 2, 4, 6, 12, 14, 16, 18, 1, 3, 5, 7, 13, 15, 17, 19,
                        8, 9, 10, 11]}
    index, points, elements, groups, others = {}, [], {}, [], set()
    for number, lines in data_sets(path):
        if number in (15, 781, 2411):
            if number == 15:
                records = [(line.split()[0], line.split()[4:7]) for line in lines]
            else:
                records = [(head.split()[0], line.split())
                           for head, line in zip(lines[::2], lines[1::2])]
            for label, words in records:
                index[int(label)] = len(points)
                points.append([float(word.upper().replace("D", "E")) for word in words])
        elif number in (780, 2412):
            rows = ([*map(int, line.split())] for line in lines)
            for label, kind, *_, n in rows:
                nodes = next(rows)
                # Beams have a line of their own; of rods some files have one.
                if 21 <= kind <= 32 or (kind == 11 and len(nodes) != n):
                    nodes = next(rows)
                while len(nodes) < n:
                    nodes += next(rows)
                dimension = 1 if kind <= 32 else 2 if kind < 100 else 3
                if n > 1:
                    nodes = [nodes[i] for i in orders.get((dimension, n), range(n))]
                    elements.setdefault((dimension, n), {})[label] = nodes
        elif number in (2417, 2429, 2430, 2432, 2435, 2452, 2467, 2477):
            groups += groups_of_unv(lines, 4 if number >= 2435 else 2)
        else:
            others.add(str(number))
    mesh = Mesh(points)
    place = {}
    for (dimension, n), members in elements.items():
        place.update(zip(members, mesh.add(
            dimension, [[index[node] for node in nodes] for nodes in members.values()],
            f"an element of {n} nodes")))
    for number, name, entities in groups:
        mesh.numbers[name] = number
        mesh.nodes[name] += [index[label] for kind, label in entities if kind == 7]
        mesh.elements[name] += [place[label] for kind, label in entities
                                if kind == 8 and label in place]
    if others:
        mesh.notes.append("data sets " + ", ".join(sorted(others)))
    return mesh


def data_sets(path):
    """Numbers and lines of the data sets of a UNV file."""
    lines = iter(pathlib.Path(path).read_text(errors="replace").splitlines())
    for line in lines:
        if line.strip() == "-1":
            number = int(next(lines).split()[0])
            yield number, [*itertools.takewhile(lambda text: text.strip() != "-1",
                                                lines)]


def groups_of_unv(lines, width):
    """Number, name, and pairs of kind (7: node, 8: element) and label of each group."""
    lines = iter(lines)
    for head in lines:
        number, *_, n = map(int, head.split())
        name, words = next(lines).strip(), []
        while len(words) < width * n:
            words += map(int, next(lines).split())
        yield number, name, list(zip(words[::width], words[1::width]))


def read_med(path):
    """Families of MED give a cell or node the names of all its groups."""
    import h5py  # pylint: disable=import-outside-toplevel

    with h5py.File(path, "r") as file:
        if len(file["ENS_MAA"]) != 1:
            raise Mistake(f"{path}: contains {len(file['ENS_MAA'])} meshes ("
                          + ", ".join(file["ENS_MAA"]) + "); exactly one is allowed")
        [(title, step)] = file["ENS_MAA"].items()
        families = file["FAS"][title] if title in file.get("FAS", ()) else {}
        while "NOE" not in step:  # the last of several steps
            step = list(step.values())[-1]
        n = step["NOE/COO"].attrs["NBR"]
        mesh = Mesh(step["NOE/COO"][()].reshape(-1, n).T)
        names_of = {kind: {family.attrs["NUM"]: names_in(family)
                           for family in families.get(kind, {}).values()}
                    for kind in ("NOEUD", "ELEME")}
        if "FAM" in step["NOE"]:
            for node, number in enumerate(step["NOE/FAM"][()]):
                for name in names_of["NOEUD"].get(number, ()):
                    mesh.nodes[name].append(node)
        for kind, block in step["MAI"].items():
            if kind == "PO1":
                continue
            if kind[:2] not in DIMENSIONS:
                raise Mistake(f"{path}: cells of the kind {kind} are not allowed")
            nodes = block["NOD"][()].reshape(-1, block["NOD"].attrs["NBR"]).T - 1
            elements = mesh.add(DIMENSIONS[kind[:2]], nodes, f"{path}: a cell {kind}")
            numbers = block["FAM"][()] if "FAM" in block else []
            for element, number in zip(elements, numbers):
                for name in names_of["ELEME"].get(number, ()):
                    mesh.elements[name].append(element)
        return mesh


def names_in(family):
    """Names of the groups of a family of MED."""
    if "GRO" not in family:
        return []
    rows = numpy.ascontiguousarray(family["GRO/NOM"][()]).view("S80").ravel()
    return [row.split(b"\0")[0].decode("utf-8", "replace").strip() for row in rows]


def read_exodus(path):
    """Blocks, side sets and node sets, by their names or else as "block 1"."""
    import netCDF4  # pylint: disable=import-outside-toplevel

    # Sides of Exodus as Abaqus numbers them; nodes of second order as VTK does.
    sides = {4: [1, 2, 3, 0], 6: [2, 3, 4, 0, 1], 8: [2, 3, 4, 5, 0, 1]}
    orders = {15: [*range(9), 12, 13, 14, 9, 10, 11],
              20: [*range(12), 16, 17, 18, 19, 12, 13, 14, 15]}
    with netCDF4.Dataset(path) as file:
        file.set_auto_mask(False)
        get = {name: variable[()] for name, variable in file.variables.items()
               if not name.startswith("vals_")}
        points = get["coord"].T if "coord" in get else numpy.column_stack(
            [get["coord" + axis] for axis in "xyz" if "coord" + axis in get])
        mesh = Mesh(points)
        shell = range(-2, 4) if numpy.shape(points)[1] == 3 else range(4)
        order_of = {}
        for number, name in named(get, "eb", "block"):
            nodes = get[f"connect{number}"] - 1
            kind = file.variables[f"connect{number}"].elem_type.upper()
            dimension = (3 if kind.startswith(("HEX", "TET", "WEDGE", "PYR")) else
                         2 if kind.startswith(("QUAD", "TRI", "SHELL")) else 1)
            n = nodes.shape[1]
            if dimension == 3 and n >= 15:
                nodes = nodes[:, orders[15 if n < 20 else 20]]
            elements = mesh.add(dimension, nodes, f"{path}: an element {kind}")
            mesh.elements[name].extend(elements)
            # In space the first two sides of shells are the front and the back.
            order = sides.get(mesh.blocks[-1][1].corners) if dimension == 3 else shell
            order_of.update(dict.fromkeys(elements, order))
        for number, name in named(get, "ss", "side set"):
            mesh.faces[name].extend(
                (element, order_of[element][side]) for element, side in zip(
                    get[f"elem_ss{number}"] - 1, get[f"side_ss{number}"] - 1))
        for number, name in named(get, "ns", "node set"):
            mesh.nodes[name].extend(get[f"node_ns{number}"] - 1)
        return mesh


def named(get, prefix, word):
    """Numbers and names of the blocks or sets of an Exodus file that have members."""
    member = {"eb": "connect", "ss": "elem_ss", "ns": "node_ns"}[prefix]
    for number in range(1, 1 + len(get.get(prefix + "_prop1", ()))):
        if f"{member}{number}" in get:
            name = b"".join(get[prefix + "_names"][number - 1]) if (
                prefix + "_names" in get) else b""
            yield number, (name.split(b"\0")[0].decode("utf-8", "replace").strip()
                           or f"{word} {get[prefix + '_prop1'][number - 1]}")


def read_by_meshio(path, file_format):
    """Sets, and integers in cells: value 3 of the array "id" is the group "id 3" with
    the number 3."""
    import meshio  # pylint: disable=import-outside-toplevel

    from crevasse.temperature import by_meshio, kind_of

    source = by_meshio(path, lambda: meshio.read(path, file_format))
    mesh = Mesh(source.points)
    elements, left_out = [], collections.Counter()
    for block in source.cells:
        kind, nodes = kind_of(block.type), block.data
        if kind in SWAPPED:
            nodes, kind = nodes[:, SWAPPED[kind][1]], SWAPPED[kind][0]
        if kind in DIMENSIONS:
            elements.append(mesh.add(DIMENSIONS[kind], nodes, f"{path}: {block.type}"))
        else:
            elements.append([None] * len(nodes))
            left_out[kind] += len(nodes)
    elements = [*itertools.chain(*elements)]
    for name, arrays in source.cell_data.items() if source.cells else ():
        values = numpy.concatenate([*map(numpy.asarray, arrays)])
        if values.size == len(values):
            values = values.ravel()
        if values.ndim > 1 or values.dtype.kind not in "iu" or (
                len(numpy.unique(values)) > MOST_VALUES):
            left_out[f"array {name}"] += len(values)
            continue
        for value in numpy.unique(values[values != 0]).tolist():
            mesh.numbers[f"{name} {value}"] = value
            mesh.elements[f"{name} {value}"] += [
                elements[i] for i in numpy.flatnonzero(values == value)]
    firsts = [0, *itertools.accumulate(len(block.data) for block in source.cells)]
    for name, members in source.cell_sets.items():
        mesh.elements[name] += [elements[first + i] for first, indices in
                                zip(firsts, members) for i in indices]
    for name, members in source.point_sets.items():
        mesh.nodes[name] += [*members]
    left_out.update({f"array {name} at points": len(values)
                     for name, values in source.point_data.items()})
    mesh.notes += [f"{name} ({count})" for name, count in left_out.items()]
    return mesh
