# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Makes the page of crevasse --check --picture: the mesh, its boundaries and what
belongs to it, before a run. The program writes mesh_picture() to standard input."""

import datetime
import json
import os
import pathlib
import sys

from matplotlib import colormaps
from matplotlib.colors import to_hex
import numpy

from crevasse.command import write_file
from crevasse.field_view import encode, pack_materials, pack_skin, text_of
from crevasse.page import render
from crevasse.skin import Skin

MOST_WORST = 5
AROUND = [0, 1, 3, 2]  # a cell: the program numbers corners by x first, then by y
# Of each role, for the first, second, ... of its boundaries.
COLOURS = {"Clamped": ("#0072b2", "#56b4e9", "#003a5c"),
           "Symmetry": ("#009e73", "#7fd6bd", "#00513b"),
           "Loaded": ("#d55e00", "#f2a65e", "#7a3600"),
           "Contact": ("#c2378f", "#e79acb", "#6b1b4e"),
           "Crack": ("#7b3fc4", "#b795ea", "#3f1a70"),
           "Open crack": ("#0f8b8d", "#86cfd0", "#0a4a4b"),
           "Displaced": ("#e3b505", "#f1da82", "#8a6d00"),
           "axis": ("#8a6d00", "#8a6d00", "#8a6d00"),
           "free": ("#777777", "#a9a9a9", "#4d4d4d")}


def main(words):
    picture = json.load(sys.stdin)
    fields = pack(picture)
    write_file(pathlib.Path(words[0]), render(
        "picture.html", title=picture["title"] or pathlib.Path(picture["scene"]).name,
        picture=picture, fields=fields, data={"charts": [], "shades": []},
        version=os.environ.get("CREVASSE_VERSION", ""),
        written=datetime.datetime.now().strftime("%Y-%m-%d %H:%M")))
    return 0


def pack(picture):
    """What templates/field_*.js and mesh_marks.js show; replaces lists of the program
    by tables of the page."""
    dimension = picture["dimension"]
    points = numpy.array(picture["points"])
    cells, faces = ({name: numpy.array(values) for name, values in
                     picture[part].items()} for part in ("cells", "faces"))
    seen = numpy.arange(len(cells["id"])) if dimension == 2 else faces["cell"]
    skin = Skin(points, cells["vertices"][:, AROUND] if dimension == 2
                else faces["vertices"], 1)
    materials = list(parts(dict(picture["materials"]), cells))
    with_role = {number: "" for ids in picture["roles"].values() for number in ids}
    boundaries = list(parts(with_role | dict(picture["boundaries"]), faces, points))
    describe_boundaries(boundaries, picture["roles"], picture["axisymmetric"])
    size = float(numpy.ptp(skin.points, axis=0).max())
    picture["worst"] = list(worst_cells(points, cells))
    for fixed in picture.setdefault("fixed", []):
        fixed["held"] = [f"u{k}" for k, is_held in zip("₁₂₃", fixed["components"])
                         if is_held]
    picture |= {"materials": materials, "boundaries": boundaries, "typical": size / 40,
                "n_cells": len(cells["id"])}
    # A boundary's edges (pairs of points) in the plane, its quadrilaterals in space.
    drawn = (numpy.searchsorted(skin.kept, faces["vertices"]) if dimension == 2
             else numpy.arange(len(faces["id"]))).astype(numpy.uint32)
    return {"dimension": dimension, "still": True, "per_quad": True,
            "period": 1, "times": [0], "stored": 1, "factor": 0, "first": 0,
            **pack_skin(skin, skin.mark_edges(numpy.arange(len(skin.points)))),
            "components": [pack_ids(cells["id"][seen], materials),
                           pack_quality(cells["quality"][seen])],
            "groups": [{"colour": b["colour"], "kind": b["kind"],
                        "parts": text_of(drawn[faces["id"] == b["id"]])}
                       for b in boundaries],
            **{name: picture.get(name, [])
               for name in ("fixed", "probes", "front", "worst")}}


def parts(names, objects, points=None):
    """The cells of each material or the faces of each boundary, and names without any;
    with points, the box around them."""
    for number in sorted({*names, *objects["id"].tolist()}):
        chosen = objects["id"] == number
        part = {"id": number, "name": names.get(number, ""), "n": int(chosen.sum()),
                "size": float(objects["size"][chosen].sum())}
        if points is not None and part["n"]:
            corners = points[objects["vertices"][chosen]].reshape(-1, points.shape[1])
            corners[abs(corners) < 1e-9 * abs(points).max()] = 0  # rounding
            part["box"] = [corners.min(axis=0).tolist(), corners.max(axis=0).tolist()]
        yield part


def worst_cells(points, cells):
    """The worst cells that are not rectangular, the worst first."""
    for k in numpy.argsort(cells["quality"], kind="stable")[:MOST_WORST]:
        corners = points[cells["vertices"][k]]
        if cells["quality"][k] < 1 - 1e-6:
            yield {"quality": float(cells["quality"][k]), "corners": corners.tolist(),
                   "point": corners.mean(axis=0).tolist(),
                   "size": float(numpy.ptp(corners, axis=0).max())}


def pack_ids(ids, materials):
    component = pack_materials(ids[None], {part["id"]: part["name"] or str(part["id"])
                                           for part in materials})
    if len(component["names"]) == 1:  # needs no colour beside those of the roles
        component["colours"] = 3 * ["#ececec"]
    return component


def pack_quality(quality):
    """The same levels for each mesh; the worse, the darker."""
    levels = numpy.linspace(0, 1, 11)
    colours = [to_hex(colormaps["viridis"](place)) for place in levels[:-1] + 0.05]
    low, quantum = float(quality.min()), float(numpy.ptp(quality) / 65535) or 1e-6
    return {"name": "quality", "label": "cell quality", "low": low, "quantum": quantum,
            "values": [encode(quality, low, quantum)], "levels": levels.tolist(),
            "colours": [colours[0], *colours, colours[-1]]}


def describe_boundaries(boundaries, roles, is_axisymmetric):
    """Gives each boundary its role, a kind, which is the first of its roles, a label
    and a colour."""
    count = dict.fromkeys(COLOURS, 0)
    for boundary in boundaries:
        own = [role for role, ids in roles.items() if boundary["id"] in ids]
        on_axis = is_axisymmetric and boundary["n"] and boundary["box"][1][0] == 0
        boundary["kind"] = kind = own[0] if own else "axis" if on_axis else "free"
        boundary["role"] = (" and ".join(own).lower() or
                            (kind if boundary["n"] else "no role"))
        boundary["label"] = boundary["name"] or f"boundary {boundary['id']}"
        boundary["colour"] = COLOURS[kind][count[kind] % 3]
        count[kind] += 1
