#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The pictures of doc/tutorial.md: the mesh with the names of its boundaries, fields,
K_I over the cycle and its error on finer meshes. A run that is done is not done again;
the first time takes a minute."""

from matplotlib.collections import LineCollection, PolyCollection
import meshio
import numpy

from study import ROOT, run_once, study_options  # first: finds the package

from bodies import draw_bands, even_bands
from crevasse.fields import Fields
from crevasse.plotting import (BLUE, GREEN, GREY, HALO, INK, PURPLE, SHADE, VERMILION,
                               pyplot, save)
from crevasse.scripting import read

SCENE = "plate_with_hole"
PERIOD, MAGNIFY = 24, 100
NAMES = {"ligament": BLUE, "lip": GREEN, "rim": VERMILION, "outside": PURPLE}
MATERIALS = {"plate": "#ffffff", "sleeve": "#f6dfc3"}
PLACES = {"ligament": (36, -4), "lip": (16, -4), "rim": (0, 5), "outside": (0, 54),
          "plate": (-33, 27), "sleeve": (0, 13)}
ONE_MATERIAL = ("Material/Thermal expansion=14e-6", "Material/Young modulus=170000",
                "Material/Chain=0.6: 40")


def in_group(mesh, name, kind):
    """The cells of that kind of a physical group, by corners."""
    number = mesh.field_data[name][0]
    cells = [block.data[group == number] for block, group in zip(
        mesh.cells, mesh.cell_data["gmsh:physical"]) if block.type == kind]
    return numpy.concatenate(cells)


def draw_mesh(axes, path):
    mesh = meshio.read(path)
    points = mesh.points[:, :2]
    for name, colour in MATERIALS.items():
        axes.add_collection(PolyCollection(
            points[in_group(mesh, name, "quad9")[:, :4]], facecolor=colour,
            edgecolor=GREY, linewidth=0.5))
        axes.text(*PLACES[name], name, ha="center", va="center",
                  path_effects=HALO)
    for name, colour in NAMES.items():
        lines = points[in_group(mesh, name, "line3")[:, [0, 2, 1]]]
        axes.add_collection(LineCollection(lines, colors=colour, linewidths=3))
        axes.text(*PLACES[name], name, ha="center", va="center", color=colour)
    axes.set(xlim=(-54, 54), ylim=(-8, 58), aspect="equal", title="Gmsh's mesh")
    axes.axis("off")


def draw_tip(axes, results):
    fields = Fields(results / "solution_0000.pvtu")
    parts = len(fields.quads) // read(results).summary["cells"]
    axes.add_collection(LineCollection(fields.points[fields.cell_edges(parts)],
                                       colors=GREY, linewidths=0.6))
    axes.plot((9, 22), (0, 0), color=GREEN, linewidth=3)
    axes.plot((22, 40), (0, 0), color=BLUE, linewidth=3)
    axes.plot(22, 0, "o", color=INK, markersize=4)
    axes.set(xlim=(9, 35), ylim=(-1, 15), aspect="equal",
             title="at the tip, as it is computed")
    axes.axis("off")


def mesh_figure(options, results):
    figure, panels = pyplot.subplots(1, 2, figsize=(10, 3.6), constrained_layout=True,
                                     gridspec_kw={"width_ratios": (1, 0.95)})
    draw_mesh(panels[0], ROOT / f"prm/{SCENE}.msh")
    draw_tip(panels[1], results)
    save(figure, "tutorial_mesh", options.figures, options.formats)


def field_figure(options, results):
    cold, hot = (Fields(results / f"solution_{k:04}.pvtu") for k in (0, 1))
    figure, panels = pyplot.subplots(1, 3, figsize=(12, 4.4), constrained_layout=True)
    for axes, fields, values, levels, colours, title, label in (
            (panels[0], hot, hot["temperature"], numpy.linspace(0, 200, 11),
             "YlOrRd", "t = 12 h: temperature", "K"),
            (panels[1], hot, hot["stress_22"], even_bands(160), "RdBu_r",
             "t = 12 h, hot: $s_{22}$", "MPa"),
            (panels[2], cold, cold["stress_22"], even_bands(160), "RdBu_r",
             "t = 0, cold: $s_{22}$", "MPa")):
        bands = draw_bands(axes, fields, values, levels, MAGNIFY, mirrored=True,
                           colours=colours, wanted=60000)
        axes.autoscale_view()
        axes.set_title(title)
        figure.colorbar(bands, ax=axes, orientation="horizontal", label=label,
                        shrink=0.8, ticks=levels[::len(levels) // 4])
    save(figure, "tutorial_fields", options.figures, options.formats)


def last_period(table):
    return table[table["t"] >= table["t"].max() - PERIOD * (1 + 1e-9)]


def cycle_figure(options, runs):
    figure, axes = pyplot.subplots(figsize=(6.4, 3.6), constrained_layout=True)
    for (label, results), colour in zip(runs.items(), (VERMILION, BLUE)):
        tip = last_period(read(results).crack_tip())
        axes.plot(tip["t"] - tip["t"].min(), tip["K_I"], color=colour, label=label)
    lip = last_period(read(next(iter(runs.values()))).contact)
    for least, colour in ((1, "#f1f1f1"), (lip["closed_nodes"].max(), SHADE)):
        t = lip["t"][lip["closed_nodes"] >= least] - lip["t"].min()
        axes.axvspan(t.min(), t.max(), color=colour, linewidth=0)
    axes.text(12, 60, "lip closed", ha="center", color=GREY)
    axes.axhline(0, color=GREY, linewidth=0.8)
    axes.set(xlim=(0, PERIOD), xticks=range(0, 25, 4), xlabel="time t (h)",
             ylabel=r"$K_I$ (MPa $\sqrt{\mathrm{mm}}$)")
    axes.legend(loc="upper center")
    save(figure, "tutorial_cycle", options.figures, options.formats)


def main():
    options = study_options(__doc__, "tutorial")
    results = run_once(options, SCENE)
    mesh_figure(options, results)
    field_figure(options, results)
    cycle_figure(options, {
        "sleeve of another steel": results,
        "plate and sleeve of one steel": run_once(options, SCENE, "one_material",
                                                  ONE_MATERIAL)})


main()
