#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The thumbnails of doc/scenes.md: each main scene of prm/ as a small picture of the
stress s_22 on the deformed body, at an instant at which its crack is open. A run that
is done is not done again; the first time takes two minutes."""

import dataclasses
import itertools
import subprocess
import sys

from mpl_toolkits.mplot3d.art3d import Poly3DCollection
import numpy

from study import ROOT, run_once, study_options  # first: finds the package

from bodies import draw_bands, even_bands, symmetric_bound
from crevasse.fields import Fields, read_pieces
from crevasse.plotting import pyplot, write_png
from crevasse.skin import Skin


@dataclasses.dataclass
class Scene:
    """How a scene is drawn: the settings that its picture needs, the number of the
    stored instant, whether it is one half of a symmetric body."""
    settings: tuple = ()
    instant: int = 0
    mirrored: bool = True


FINE = ("Geometry/Subdivisions=28, 28", "Discretisation/Degree=2",
        "Contact/Solver=automatic")
PLANE = {
    "raous1980": Scene(FINE),
    "thermal_fatigue": Scene(("Output/Field times=0",)),
    "ageing": Scene(),
    "coated_blade": Scene(),
    "concrete": Scene(),
    "bimaterial": Scene(),
    "crack_growth": Scene(("Output/Fields=vtu", "Output/Field times=12")),
    "power_law": Scene(),
    "inclined_crack": Scene(mirrored=False),
    "two_cracks": Scene(mirrored=False),
    "kinked_crack": Scene(mirrored=False),
    "plate_with_hole": Scene()}
BOX = ("Geometry/Subdivisions=16, 8, 8",)
PENNY = ("Output/Fields=vtu", "Output/Field times=0")


def magnification(points, displacement):
    """The largest displacement is then 6 % of the body."""
    return 0.06 * numpy.ptp(points, axis=0).max() / numpy.abs(displacement).max()


def draw_plane(axes, results, scene):
    fields = Fields(results / f"solution_{scene.instant:04}.pvtu")
    stress = fields["stress_22"]
    draw_bands(axes, fields, stress, even_bands(symmetric_bound(fields, stress)),
               magnification(fields.points, fields["displacement"]), scene.mirrored)
    axes.autoscale_view()


def skin_of(results, component):
    """The surface of a body in space: its quadrilaterals, and the places,
    displacements and stress of its nodes."""
    points, cells, data = read_pieces(results / "solution_0000.pvtu", 3)
    skin = Skin(points, cells, 1)
    used, _ = skin.finish([data["displacement"][skin.kept]])
    kept = skin.kept[used]
    return (skin.quads, skin.points, data["displacement"][kept],
            data[component][kept].ravel())


def draw_box(axes, results):
    """Both halves, each face in the colour of the stress at its middle."""
    quads, points, displacement, stress = skin_of(results, "stress_22")
    place = points + magnification(points, displacement) * displacement
    bound = numpy.quantile(numpy.abs(stress), 0.97)
    value = numpy.clip(stress[quads].mean(axis=1) / bound, -1, 1)
    colours = pyplot.get_cmap("RdBu_r")((value + 1) / 2)
    ligament = (numpy.abs(place[quads, 1]) < 1e-9).all(axis=1)
    faces = numpy.concatenate([place[quads], place[quads] * [1, -1, 1]])
    shown = ~numpy.tile(ligament, 2)
    # The vertical axis of Matplotlib is its third one.
    axes.add_collection3d(Poly3DCollection(
        faces[shown][:, :, [2, 0, 1]], edgecolor="#22222240", linewidth=0.3,
        facecolor=numpy.tile(colours, (2, 1))[shown]))
    low, high = faces.min(axis=(0, 1)), faces.max(axis=(0, 1))
    axes.set(xlim=(low[2], high[2]), ylim=(low[0], high[0]), zlim=(low[1], high[1]))
    axes.set_box_aspect((high - low)[[2, 0, 1]], zoom=1.15)
    axes.view_init(elev=18, azim=38)
    axes.axis("off")


def draw_crack_plane(axes, results, reach=4):
    """The stress across the plane of the penny-shaped crack, whose quarter is
    modelled."""
    quads, points, _, stress = skin_of(results, "stress_33")
    quads = quads[(points[quads, 2] < 1e-6).all(axis=1)]
    triangles = numpy.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    for signs in itertools.product((1, -1), repeat=2):
        axes.tricontourf(*(points[:, :2] * signs).T, triangles, stress, cmap="RdBu_r",
                         levels=even_bands(3e6), extend="both")
    axes.set(xlim=(-reach, reach), ylim=(-reach, reach), aspect="equal")
    axes.axis("off")


def penny_crack(options):
    mesh = (options.output / "penny_crack.msh").absolute()
    mesh.parent.mkdir(parents=True, exist_ok=True)
    subprocess.run([sys.executable, ROOT / "prm/penny_mesh.py", mesh], check=True)
    return run_once(options, "penny_crack", settings=(
        f"Geometry/Mesh file={mesh}", *PENNY))


def new_axes(**projection):
    return pyplot.figure(figsize=(2.2, 2.2)).add_axes((0.02, 0.02, 0.96, 0.96),
                                                      **projection)


def write_thumbnail(options, name, axes):
    path = options.figures / f"scene_{name}.png"
    write_png(axes.figure, path)
    pyplot.close(axes.figure)
    print(path)


def main():
    options = study_options(__doc__, "gallery")
    pyplot.rcParams.update({"savefig.dpi": 100, "savefig.bbox": None})
    for name, scene in PLANE.items():
        axes = new_axes()
        draw_plane(axes, run_once(options, name, settings=scene.settings), scene)
        write_thumbnail(options, name, axes)
    axes = new_axes(projection="3d")
    draw_box(axes, run_once(options, "cracked_box", settings=BOX))
    write_thumbnail(options, "cracked_box", axes)
    axes = new_axes()
    draw_crack_plane(axes, penny_crack(options))
    write_thumbnail(options, "penny_crack", axes)


main()
