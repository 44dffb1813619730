# Copyright (C) 2026 by the Crevasse authors
# SPDX-License-Identifier: LGPL-2.1-or-later

"""Style of the figures, level curves, outlines and crosses."""

import argparse
import collections
import io
import pathlib

import matplotlib

matplotlib.use("Agg")

from matplotlib import patheffects, pyplot
from matplotlib.collections import LineCollection
from matplotlib.colors import BoundaryNorm, LinearSegmentedColormap
from matplotlib.tri import Triangulation
import numpy
from PIL import Image

from results import existing_program

# Okabe and Ito's palette, told apart with every kind of colour vision.
BLUE, VERMILION, GREEN = "#0072B2", "#D55E00", "#009E73"
PURPLE = "#CC79A7"
INK, GREY, SHADE = "#222222", "#8a8a8a", "#e6e6e6"

TENSION = dict(color=VERMILION, linewidth=1.0)
COMPRESSION = dict(color=BLUE, linewidth=1.4)

HALO = [patheffects.withStroke(linewidth=2.2, foreground="white")]

pyplot.rcParams.update({
    "font.family": "DejaVu Sans", "mathtext.fontset": "dejavusans",
    "font.size": 9, "axes.titlesize": 10, "axes.labelsize": 10,
    "legend.fontsize": 9, "legend.frameon": False,
    "axes.edgecolor": INK, "axes.labelcolor": INK, "text.color": INK,
    "axes.spines.top": False, "axes.spines.right": False,
    "axes.linewidth": 0.8, "lines.linewidth": 1.6,
    "savefig.dpi": 150, "savefig.bbox": "tight", "savefig.pad_inches": 0.08,
    "pdf.fonttype": 42, "svg.fonttype": "path"})


def round_number(value):
    """The largest of 1, 2, 5, 10, ... not above the value."""
    power = 10.0 ** numpy.floor(numpy.log10(value))
    return max(m * power for m in (1, 2, 5) if m * power <= value * (1 + 1e-9))


def round_up(value):
    """The smallest of 1, 2, 5, 10, ... not below the value."""
    power = 10.0 ** numpy.floor(numpy.log10(value))
    return min(m * power for m in (1, 2, 5, 10)
               if m * power >= value * (1 - 1e-9))


def ladder(low, high, mantissas=(1, 2, 5)):
    """The numbers m times 10^k between two positive ones."""
    powers = range(int(numpy.floor(numpy.log10(low))),
                   int(numpy.ceil(numpy.log10(high))) + 1)
    return [m * 10.0 ** k for k in powers for m in mantissas
            if low <= m * 10.0 ** k <= high]


def choose_levels(values, scale, count=14):
    """Round levels: equally spaced over most of the values, wider apart in the
    peaks; 1-2-3-5 where a field without sign covers several orders. None where
    the values differ by rounding alone, measured by the scale."""
    low, high = numpy.quantile(values, [0.03, 0.97])
    least, largest = values.min(), values.max()
    if largest - least <= 1e-6 * scale:
        return numpy.array([])
    if least >= 0 and largest > 10 * numpy.median(values):
        return numpy.array(ladder(max(low, 1e-4 * largest), largest,
                                  (1, 2, 3, 5)))
    if high - low <= 1e-6 * (largest - least):
        low, high = least, largest
    step = round_up((high - low) / count)
    levels = step * numpy.arange(numpy.ceil(low / step - 1e-9),
                                 numpy.floor(high / step + 1e-9) + 1)
    peaks = (1, 1.5, 2, 3, 4, 5, 6, 8)
    for sign, end in ((1, largest), (-1, -least)):
        last = max(sign * levels[-1 if sign > 0 else 0], step)
        for level in ladder(last, max(end, last), peaks):
            if level >= last + step * (1 - 1e-9) and level >= 1.25 * last:
                levels = numpy.append(levels, sign * level)
                last = level
    levels = numpy.unique(numpy.round(levels / step, 6) + 0.0) * step
    return levels[(levels > least) & (levels < largest)]


def level_colours(levels):
    """Pale colours for the bands between levels and beyond them: blue where
    negative, orange where positive, white about zero."""
    bounds = numpy.concatenate([[-numpy.inf], levels, [numpy.inf]])
    middle = (bounds[1:] + bounds[:-1]) / 2
    middle[0] = numpy.nextafter(levels[0], -numpy.inf)  # below 0 if that is 0
    middle[-1] = levels[-1]
    below = LinearSegmentedColormap.from_list("", ["#f3f8fc", "#7fb5da"])
    above = LinearSegmentedColormap.from_list("", ["#fef8f1", "#f0a35e"])
    negative = int((middle < 0).sum())
    positive = len(middle) - negative
    return ([below(1 - i / max(negative, 1)) for i in range(negative)] +
            [above((i + 1) / max(positive, 1)) for i in range(positive)])


def draw_level_curves(axes, fields, values, scale, magnify, quantity):
    """Labelled level curves over a pale ground on the deformed body, and a bar
    that names all levels: in the peaks they are wider apart."""
    triangles, carry = fields.triangulation()
    place = deformed(fields, magnify)
    body = Triangulation(carry(place[:, 0]), carry(place[:, 1]), triangles)
    z = carry(values)
    levels = choose_levels(values, scale)
    if len(levels) > 1:
        ground = axes.tricontourf(body, z, levels, extend="both",
                                  colors=level_colours(levels))
        bar = axes.figure.colorbar(ground, ax=axes, orientation="horizontal",
                                   spacing="uniform", ticks=levels, aspect=45,
                                   shrink=0.92, pad=0.02,
                                   label=quantity + spacing(levels))
        names = [signed(level, 3) for level in levels]
        crowded = sum(map(len, names)) > 45
        bar.ax.set_xticklabels(names, fontsize=7, rotation=90 if crowded else 0)
        bar.outline.set_linewidth(0.5)
    if len(levels):
        lines = axes.tricontour(body, z, levels=levels, colors=INK,
                                linewidths=0.7, linestyles="solid")
    draw_outline(axes, fields, magnify)
    finish_body(axes, fields.points, place)
    if len(levels):
        label_levels(axes, lines)


def spacing(levels):
    steps = numpy.diff(levels)
    return ("" if steps.max() <= 1.001 * steps.min() else
            "; levels wider apart in the peaks")


def signed(value, digits=6):
    """With a minus sign as typesetters know it."""
    text = f"{value:.{digits}g}"
    if 1 <= abs(value) < 1e7:
        text = f"{float(text):.10g}"  # without a power of ten
    return text.replace("-", "\N{MINUS SIGN}")


def label_levels(axes, lines):
    """A label on each line where there is room for it."""
    labels = lines.clabel(fmt=signed, fontsize=7.5, inline=False, colors=INK)
    axes.figure.canvas.draw()
    taken = []
    for label in sorted(labels, key=lambda text: len(text.get_text())):
        label.set_path_effects(HALO)
        box = label.get_window_extent().padded(1.5)
        if any(box.overlaps(other) for other in taken):
            label.remove()
        else:
            taken.append(box)


def deformed(fields, magnify):
    return fields.points + magnify * fields["displacement"]


def draw_outline(axes, fields, magnify):
    """The body as it is at rest, dashed, and deformed."""
    edges = fields.outline()
    axes.add_collection(LineCollection(fields.points[edges], colors=GREY,
                                       linewidths=0.7, linestyles=(0, (4, 3))))
    axes.add_collection(LineCollection(deformed(fields, magnify)[edges],
                                       colors=INK, linewidths=1.2,
                                       capstyle="round"))


def finish_body(axes, *places):
    """Limits that hold all those points, equal scales, no frame."""
    places = numpy.concatenate([place.reshape(-1, 2) for place in places])
    margin = 0.01 * numpy.ptp(places, axis=0).max()
    low, high = places.min(axis=0) - margin, places.max(axis=0) + margin
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal")
    axes.axis("off")


def thin_out(points, most):
    """Nodes, about so many, no two of which are close to each other."""
    if len(points) <= most:
        return numpy.arange(len(points))
    apart = 1.05 * numpy.sqrt(numpy.ptp(points, axis=0).prod() / most)
    boxes = numpy.floor(points / apart).astype(int)
    kept, inside = [], collections.defaultdict(list)
    for node in numpy.lexsort(points.T):
        x, y = boxes[node]
        near = [other for i in (-1, 0, 1) for j in (-1, 0, 1)
                for other in inside.get((x + i, y + j), ())]
        if all(numpy.hypot(*(points[node] - points[other])) >= apart
               for other in near):
            kept.append(node)
            inside[x, y].append(node)
    return numpy.array(kept)


def draw_crosses(axes, place, values, directions, length):
    """Bars of that length per unit stress, the compressive ones thicker;
    returns the ends of all bars. A bar shorter than thick would seem to point
    the other way and is left out."""
    reach = values[..., None] * directions * length / 2
    bars = numpy.stack([place - reach, place + reach], axis=2).reshape(-1, 2, 2)
    reach = values.ravel() * length / numpy.ptp(place.reshape(-1, 2), 0).max()
    for sign, style in ((1, TENSION), (-1, COMPRESSION)):
        axes.add_collection(LineCollection(bars[sign * reach > 0.004], **style))
    return bars


def write_png(figure, target):
    """To a path or a stream, with 128 colours: a third of the size."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png")
    image = Image.open(buffer).convert("RGB")
    image.quantize(128, dither=Image.Dither.NONE).save(
        target, format="png", optimize=True,
        dpi=image.info.get("dpi", (150, 150)))


def save(figure, stem, directory, formats):
    """Writes the figure in every format wanted."""
    for extension in formats:
        path = directory / f"{stem}.{extension}"
        if extension == "png":
            write_png(figure, path)
        else:
            figure.savefig(path)
        print(path)
    pyplot.close(figure)


def print_table(header, rows):
    """In Markdown; a study may take long, so that what there is shows."""
    print("| " + " | ".join(header) + " |")
    print("|" + "---|" * len(header))
    for row in rows:
        print("| " + " | ".join(row) + " |")
    print(flush=True)


def study_options(description, name, kept="runs are", studies=None):
    """What the command line of a study says: the program, which of several
    studies, where what it computes is kept, where its figures go and in which
    formats."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("program", type=existing_program, help="build/crevasse")
    if studies:
        parser.add_argument("--studies", nargs="+", choices=list(studies),
                            default=list(studies),
                            help="which ones (all)")
    parser.add_argument("--output", type=pathlib.Path,
                        default=pathlib.Path("results") / name,
                        help=f"where the {kept} kept")
    parser.add_argument("--figures", type=pathlib.Path,
                        default=pathlib.Path(__file__).resolve().parent,
                        help="where the figures go")
    parser.add_argument("--formats", nargs="+", default=["png"],
                        choices=("png", "pdf", "svg"))
    return parser.parse_args()
