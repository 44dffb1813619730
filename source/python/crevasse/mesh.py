# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""crevasse mesh: converts a mesh file of another program, with its groups, into a Gmsh
file, and says what it found: doc/meshes.md."""

import argparse
import os
import pathlib
import sys
import tempfile

import numpy

from crevasse import mesh_formats, mesh_geo
from crevasse.mesh_parts import NOUNS, Body, Mistake, write
from crevasse.wording import plural, whole

INPUT_MISTAKE, FILE_FAILURE = 2, 4


def main(words):
    parser = argparse.ArgumentParser(
        prog="crevasse mesh", description="Converts a mesh file of another program "
        "into a Gmsh file (.msh), and lists its cells, names and what is left out.")
    parser.add_argument("input", metavar="IN", help="Abaqus or CalculiX (.inp), UNV, "
                        "MED, Exodus (.e, .exo), VTK (.vtk, .vtu), another format of "
                        "meshio, or a geometry for Gmsh (.geo, .brep)")
    parser.add_argument("output", metavar="OUT.msh")
    parser.add_argument("--trust-mesh", action="store_true", help="let a .geo file start "
                        "programs, and read and write files")
    arguments = parser.parse_args(words)
    if not arguments.output.lower().endswith(".msh"):
        parser.error("the second name must end in .msh")
    try:
        target = pathlib.Path(arguments.output)
        if arguments.input.lower().endswith(mesh_geo.SUFFIXES):
            form, lines = "by Gmsh", save(target, lambda part: mesh_geo.by_gmsh(
                mesh_geo.mesh, arguments.input, arguments.trust_mesh, part))
        else:
            mesh, form = mesh_formats.read(arguments.input)
            body = Body(flat(mesh))
            save(target, lambda part: write(body, part))
            lines = report(body)
    except Mistake as mistake:
        text = str(mistake)
        if not text.startswith(arguments.input):
            text = f"{arguments.input}: {text}"
        print(f"crevasse mesh: {text.rstrip('.')}.", file=sys.stderr)
        return INPUT_MISTAKE
    except (OSError, ImportError) as error:
        print("crevasse mesh: " + (
            f"{error}. It needs Debian's packages python3-gmsh, python3-h5py, "
            "python3-meshio and python3-netcdf4" if isinstance(error, ImportError) else
            f"{error.filename}: {error.strerror}"), file=sys.stderr)
        return FILE_FAILURE
    print("\n".join([f"{arguments.input} ({form}):", *lines,
                     f"  written to {arguments.output}"]))
    return 0


def flat(mesh):
    """Turns a plane mesh in x-z or y-z into the plane x-y."""
    if mesh.dimension == 2:
        used = numpy.unique(numpy.concatenate([nodes.ravel()
                                               for _, _, nodes in mesh.blocks]))
        sizes = numpy.ptp(mesh.points[used], axis=0)
        if sizes[2] > 1e-6 * sizes.max():
            axis = int(sizes.argmin())
            if sizes[axis] > 1e-6 * sizes.max():
                raise Mistake("its triangles and quadrilaterals do not lie in a plane; "
                              "shells are not implemented")
            others = [d for d in range(3) if d != axis]
            mesh.points = mesh.points[:, [*others, axis]]
            mesh.notes.append("coordinate " + "xyz"[axis] + ", which is constant: "
                              + "xyz"[others[0]] + " and " + "xyz"[others[1]]
                              + " become x and y")
    return mesh


def save(path, write_to):
    """Writes the file as a whole or not at all; returns what write_to returns."""
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, part = tempfile.mkstemp(dir=path.parent, suffix=".part.msh")
    os.close(handle)
    try:
        result = write_to(part)
        os.chmod(part, 0o644)
        os.replace(part, path)
        return result
    finally:
        if os.path.exists(part):
            os.remove(part)


def report(body):
    """Lines on cells, names and what was left out."""
    nodes = {node for corners in body.cells.values() for node in corners}
    yield (f"  {whole(len(body.mesh.points))} points; the cells are in "
           + body.box(nodes))
    yield "  elements: " + ", ".join(
        f"{whole(n)} {NOUNS[kind]}" for kind, n in sorted(body.count.items())[::-1]
        if n)
    for what, noun, members, groups in (
            ("materials", "cell", body.cells, body.groups_of_cell),
            ("boundaries", "face", body.faces, body.groups_of_face)):
        numbers = body.numbers[members is body.cells]
        yield f"  {what}:" + ("" if numbers else " none has a name")
        for name, number in numbers.items():
            keys = [key for key in members if number in groups[key]]
            nodes = {node for key in keys for node in members[key]}
            inner = sum(key not in body.surface for key in keys)
            yield (f"    {name} ({number}): {plural(len(keys), noun)}"
                   + (f" in {body.box(nodes)}" if nodes else "")
                   + (f", {whole(inner)} within the body"
                      if inner and noun == "face" else ""))
    if any(n and dimension == body.dimension and (dimension, corners) not in (
            (2, 4), (3, 8)) for (dimension, corners), n in body.count.items()):
        yield ("  the program will divide triangles and wedges into three, tetrahedra "
               "into four")
    if body.count[3, 5]:
        yield "  warning: the program cannot use pyramids"
    for note in body.mesh.notes:
        yield f"  left out: {note}"
