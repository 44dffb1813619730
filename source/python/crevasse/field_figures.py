# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Figures 1, 4, 5 and 6: the mesh and the fields of one instant; and which of the
stored instants pictures show."""

import numpy
from matplotlib import colormaps
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.lines import Line2D

from crevasse import headline
from crevasse.fields import read_pieces
from crevasse.level_curves import draw_level_curves
from crevasse.plotting import (BLUE, COMPRESSION, INK, TENSION, VERMILION, deformed,
                               draw_crosses, draw_outline, finish_body, pyplot,
                               round_number, signed, thin_out)
from crevasse.quantities import SAME_INSTANT
from crevasse.results import number

COMPONENTS = ("11", "22", "12")
MOST_FILES = 25  # that are looked into


def mesh(run, fields):
    """Figure 1: the mesh at rest, materials, the crack and the named points."""
    figure, axes = pyplot.subplots(figsize=(5, 5))
    edges = fields.cell_edges(int(run.number("Discretisation/Degree")) ** 2)
    axes.add_collection(LineCollection(fields.points[edges], colors=INK,
                                       linewidths=0.6 if len(edges) < 2000
                                       else 0.3))
    points, parts = built_in_shape(run)
    for (begin, end), (label, colour) in parts.items():
        axes.plot([begin, end], [0, 0], color=colour, linewidth=3, label=label,
                  solid_capstyle="butt")
    if "material" in fields.data:
        draw_materials(axes, fields, run.material_names)
    lip = fields.lip()
    if len(lip) and not parts:
        axes.add_collection(LineCollection(fields.points[lip], label="crack lip",
                                           colors=VERMILION, linewidths=3))
    middle = (fields.points.min(axis=0) + fields.points.max(axis=0)) / 2
    for name, point in points.items():
        axes.plot(*point, "o", color=INK, markersize=4)
        outward = [1 if p >= m else -1 for p, m in zip(point, middle)]
        axes.annotate(name, point, (7 * outward[0], 9 * outward[1]),
                      textcoords="offset points", ha="center", va="center",
                      fontsize=11)
    finish_body(axes, fields.points)
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.03),
                    ncol=2 if len(axes.get_legend_handles_labels()[0]) < 7 else 4)
    return figure


def draw_materials(axes, fields, names):
    """Draws each material in its own colour, by the material of points; more materials
    than colours get no legend."""
    material = fields.data["material"][fields.corners[:, 0]]
    numbers = numpy.unique(material)
    colours = colormaps["Pastel1"]
    for k in numbers.astype(int):
        cells = fields.points[fields.quads[material == k]]
        colour = colours(k % colours.N)
        axes.add_collection(PolyCollection(cells, facecolors=colour, zorder=0))
        if len(numbers) <= colours.N:
            axes.plot([], [], "s", color=colour,
                      label=names.get(k, f"material {k}"))


def built_in_shape(run):
    """Draws the named points, and the lip and the ligament of a shape with a crack."""
    points, parts = dict(run.probes), {}
    shape = run.parameter("Geometry/Shape")
    if shape in ("edge crack", "centre crack"):
        width, height, crack = (run.number(f"Geometry/{name}") for name
                                in ("Width", "Height", "Crack length"))
        lip, ligament = ("crack lip", VERMILION), ("ligament", BLUE)
        if shape == "edge crack":
            tip = width - crack
            parts = {(tip, width): lip, (0, tip): ligament}
            named = dict(A=(0, 0), B=(tip, 0), C=(width, 0), D=(width, height),
                         E=(0, height))
            for name, point in named.items():
                if name not in points and point not in points.values():
                    points[name] = point
        else:
            parts = {(0, crack): lip, (crack, width): ligament}
    return points, parts


def stress_levels(fields, magnify, caption):
    """Figure 4: level curves of the three components of the stress."""
    figure, panels = pyplot.subplots(1, 3, figsize=(12, 5),
                                     constrained_layout=True)
    stress = [fields[f"stress_{name}"] for name in COMPONENTS]
    scale = numpy.abs(stress).max()
    for axes, name, values in zip(panels, COMPONENTS, stress):
        draw_level_curves(axes, fields, values, scale, magnify, "stress")
        axes.set_title(f"$s_{{{name}}}$   ({span(values, scale)})")
    figure.supxlabel(caption, fontsize=9)
    return figure


def span(values, scale):
    """Least and largest value as text, zero where of the order of rounding."""
    least, largest = (0.0 if abs(value) <= 1e-6 * scale else value
                      for value in (values.min(), values.max()))
    if largest - least <= 1e-6 * scale:
        return signed(largest, 3)
    return f"{signed(least, 3)} to {signed(largest, 3)}"


def principal_stresses(fields, magnify, caption):
    """Figure 5: crosses along the principal directions, as long as the stresses."""
    figure, axes = pyplot.subplots(figsize=(6, 6))
    kept = thin_out(fields.points, 1500)
    values = numpy.stack([fields[f"principal_stress_{k}"] for k in (1, 2)], 1)
    directions = numpy.stack([fields.direction(f"principal_direction_{k}")
                              for k in (1, 2)], 1)
    place = deformed(fields, magnify)
    size = numpy.ptp(fields.points, axis=0)
    largest = abs(values).max() or 1
    typical = numpy.median(abs(values).max(axis=1)) or largest
    length = min(0.8 * numpy.sqrt(size.prod() / len(kept)) / typical,
                 0.3 * size.max() / (numpy.quantile(abs(values), 0.99) or largest),
                 0.45 * size.max() / largest)
    draw_outline(axes, fields, magnify)
    bars = draw_crosses(axes, place[kept, None], values[kept], directions[kept],
                        length)
    unit = round_number(0.13 * size.max() / length)
    left = place[:, 0].min()
    below = min(place[:, 1].min(), bars[..., 1].min()) - 0.06 * size.max()
    scale = numpy.array([[left, below], [left + unit * length, below]])
    axes.plot(*scale.T, "|-", color=INK, linewidth=1.1)
    axes.annotate(f"stress {signed(unit)}", scale[1], (8, 0), va="center",
                  textcoords="offset points")
    finish_body(axes, fields.points, place, bars, scale)
    axes.legend([Line2D([], [], **TENSION), Line2D([], [], **COMPRESSION)],
                ["tension", "compression"], loc="upper center", borderpad=0,
                bbox_to_anchor=(0.5, 0), ncol=2)
    axes.text(0.5, -0.07, caption, transform=axes.transAxes, ha="center",
              va="top")
    return figure


def deviator_invariant(fields, magnify, caption):
    """Figure 6: level curves of the second invariant of the deviator."""
    figure, axes = pyplot.subplots(figsize=(5.6, 6.2), constrained_layout=True)
    values = fields["second_deviator_invariant"]
    draw_level_curves(axes, fields, values, values.max(), magnify,
                      "stress squared")
    axes.set_title(f"$J_2$   ({span(values, values.max())})")
    figure.supxlabel(caption, fontsize=9)
    return figure


def bears_nothing(run, fields):
    """Whether all stress at an instant is rounding beside the largest of the run, as
    where the load passes through zero."""
    largest = run.summary_number("extremes", "stress") or 0
    return max(abs(fields[f"principal_stress_{k}"]).max()
               for k in (1, 2)) <= 1e-6 * largest


def no_stress(t, what="Figures 4 to 6"):
    return (f"{what} are left out: at t = {t:g} the body bears no stress. "
            "[Output] Field times names other instants.")


def draw_fields(run, fields, t, magnify):
    """Draws the figures (file name, figure) of the fields of one instant."""
    caption = f"$t$ = {t:g}, displacements × {magnify:g}"
    yield "figure1_mesh", mesh(run, fields)
    if bears_nothing(run, fields):
        return
    for name, draw in (("figure4_stress_levels", stress_levels),
                       ("figure5_principal_stresses", principal_stresses),
                       ("figure6_deviator_invariant", deviator_invariant)):
        yield name, draw(fields, magnify, caption)


def is_scene_of_paper(run):
    return run.parameter("Title").startswith("Raous (1980)")


def shown_instant(run):
    """The instant (t, file) of pictures: in the paper's scenes next to T/4, else that
    of the largest stress intensity or, without one, of the largest stress."""
    if is_scene_of_paper(run):
        return run.choose_instant(instant_of_paper(run))
    stored = run.instants()
    if len(stored) < 2:
        return stored[0]
    if found := headline.loading_of_crack(run):
        t, K = found
        values = [K[abs(t - instant).argmin()] for instant, _ in stored]
        if max(values) > 1e-6 * abs(K).max():
            return stored[int(numpy.argmax(values))]
    return max(with_creep_integral(run, stored), key=lambda entry: largest_stress(
        entry[1], run.dimension))


def instant_of_paper(run):
    """The instant T/4 of the paper, or the field time of the scene next to it."""
    named = [value for value in map(number, run.parameter("Output/Field times")
                                    .split(",")) if value is not None]
    return min(named, key=lambda t: abs(t - run.period / 4),
               default=run.period / 4)


def evenly(stored):
    """All instants or, of many, some at equal distances."""
    rows = numpy.linspace(0, len(stored) - 1, min(len(stored), MOST_FILES))
    return [stored[k] for k in numpy.unique(rows.round().astype(int))]


def with_creep_integral(run, stored):
    """The stored instants at which C(t), and so the singular stress, is known, if there
    are any; of many some."""
    some = evenly(stored)
    tables = [table for name, table in run.tables.items()
              if name.startswith("creep_integral")]
    known = [(t, path) for t, path in some for table in tables[:1]
             if abs(table["t"] - t).min() <= SAME_INSTANT * run.period]
    return known or some


def largest_stress(path, dimension):
    data = read_pieces(path, dimension)[2]
    return data["von_mises_stress"].max() if "von_mises_stress" in data else 0.
