# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Style of the figures, outlines and crosses."""

import collections
import io
import shutil

import matplotlib

matplotlib.use("Agg")

from matplotlib import patheffects, pyplot
from matplotlib.collections import LineCollection
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator
import numpy
from PIL import Image

from crevasse.results import ResultsError

# Okabe and Ito's palette, told apart with every kind of colour vision.
BLUE, VERMILION, GREEN = "#0072B2", "#D55E00", "#009E73"
PURPLE = "#CC79A7"
INK, GREY, SHADE = "#222222", "#8a8a8a", "#e6e6e6"

MARKERS = "osD^vPX*"

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
    """The largest of 1, 2, 5, 10, ... that does not exceed the value."""
    power = 10.0 ** numpy.floor(numpy.log10(value))
    return max(m * power for m in (1, 2, 5) if m * power <= value * (1 + 1e-9))


def round_up(value):
    """The smallest of 1, 2, 2.5, 5, 10, ... that is not below the value."""
    power = 10.0 ** numpy.floor(numpy.log10(value))
    return min(m * power for m in (1, 2, 2.5, 5, 10)
               if m * power >= value * (1 - 1e-9))


def magnification(points, displacements, part):
    """A round factor by which the largest displacement, the mean of each instant apart,
    is about that part of the body."""
    moved = abs(displacements - displacements.mean(axis=-2, keepdims=True)).max()
    size = numpy.ptp(points, axis=0).max()
    return float(round_number(part * size / moved)) if moved > 1e-12 * size else 1.


def ladder(low, high, mantissas=(1, 2, 5)):
    """Numbers m times 10^k between two positive numbers."""
    powers = range(int(numpy.floor(numpy.log10(low))),
                   int(numpy.ceil(numpy.log10(high))) + 1)
    return [m * 10.0 ** k for k in powers for m in mantissas
            if low <= m * 10.0 ** k <= high]


def line_style(k):
    """Style of the k-th of several lines with points."""
    return {"color": (BLUE, VERMILION, GREEN, INK, GREY)[k % 5],
            "marker": MARKERS[k % len(MARKERS)], "markersize": 4.5}


MOST_IN_LEGEND = 3  # lines, within the axes


def add_legend(axes):
    """Adds a legend, beside the axes where it would hide lines."""
    n = len(axes.get_legend_handles_labels()[1])
    if n > MOST_IN_LEGEND:
        axes.legend(loc="upper left", bbox_to_anchor=(1, 1), fontsize=7,
                    ncol=1 + (n - 1) // 20)
    else:
        axes.legend()


def name_numbers(axes):
    """Labels a logarithmic axis on the right without powers of ten: 1, 2, 5, 10, ..."""
    low, high = axes.get_xlim()
    mantissas = ((1,) if high > 1e4 * low else
                 (1, 2, 5) if high > 10 * low else (1, 1.5, 2, 3, 4, 5, 7))
    axes.xaxis.set_major_locator(FixedLocator(ladder(low, high, mantissas)))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:.10g}"))


def signed(value, digits=6):
    """A number as text, with a typographic minus sign."""
    text = f"{value:.{digits}g}"
    if 1 <= abs(value) < 1e7:
        text = f"{float(text):.10g}"  # without a power of ten
    return text.replace("-", "\N{MINUS SIGN}")


def deformed(fields, magnify):
    return fields.points + magnify * fields["displacement"]


def draw_outline(axes, fields, magnify):
    """Draws the body at rest, dashed, and deformed."""
    edges = fields.outline()
    axes.add_collection(LineCollection(fields.points[edges], colors=GREY,
                                       linewidths=0.7, linestyles=(0, (4, 3))))
    axes.add_collection(LineCollection(deformed(fields, magnify)[edges],
                                       colors=INK, linewidths=1.2,
                                       capstyle="round"))


def finish_body(axes, *places):
    """Sets limits that hold all those points, equal scales, and no frame."""
    places = numpy.concatenate([place.reshape(-1, 2) for place in places])
    margin = 0.01 * numpy.ptp(places, axis=0).max()
    low, high = places.min(axis=0) - margin, places.max(axis=0) + margin
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal")
    axes.axis("off")


def thin_out(points, most):
    """About so many nodes, no two of which are close to each other."""
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
    """Draws bars of that length per unit stress, compressive ones thicker; returns the
    ends of all bars. A bar that is shorter than thick would seem to point the other way
    and is left out."""
    reach = values[..., None] * directions * length / 2
    bars = numpy.stack([place - reach, place + reach], axis=2).reshape(-1, 2, 2)
    reach = values.ravel() * length / numpy.ptp(place.reshape(-1, 2), 0).max()
    for sign, style in ((1, TENSION), (-1, COMPRESSION)):
        axes.add_collection(LineCollection(bars[sign * reach > 0.004], **style))
    return bars


def write_png(figure, target):
    """Writes a figure to a path or a stream, with 128 colours: a third of the size."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png")
    image = Image.open(buffer).convert("RGB")
    image.quantize(128, dither=Image.Dither.NONE).save(
        target, format="png", optimize=True,
        dpi=image.info.get("dpi", (150, 150)))


def save(figure, stem, directory, formats):
    """Writes the figure in all chosen formats."""
    if "pgf" in formats and not shutil.which("xelatex"):
        raise ResultsError("--format pgf needs xelatex, which is not installed: Debian's "
                           "package texlive-xetex has it. For LaTeX pdf serves, too.")
    for extension in formats:
        path = directory / f"{stem}.{extension}"
        if extension == "png":
            write_png(figure, path)
        else:
            figure.savefig(path)
        print(path)
    pyplot.close(figure)
