#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The animation of README.md: the paper's cracked plate over its third period, both
halves, on a finer mesh. A run that is done is not done again; about a minute."""

import io

import numpy
from PIL import Image

from study import run_once, study_options  # first: finds the package

from bodies import draw_bands, even_bands
from crevasse.fields import Fields
from crevasse.plotting import BLUE, GREY, SHADE, VERMILION, pyplot
from crevasse.scripting import read

PERIOD, COUNT, MAGNIFY, BOUND = 600, 24, 10, 40
INSTANTS = numpy.arange(COUNT) * PERIOD / COUNT
SETTINGS = (
    "Geometry/Subdivisions=56, 56", "Discretisation/Degree=2",
    "Discretisation/Singular functions=2", "Contact/Solver=automatic",
    "Time integration/Steps per period=48",
    "Output/Field times=" + ", ".join(f"{t:g}" for t in INSTANTS))


def draw_histories(panels, results):
    """Load, opening and pressure over the last period; returns the lines that mark
    the instant."""
    probe = results.probe("C")
    probe = probe[probe["t"] >= probe["t"].max() - PERIOD - 1e-6]
    t = (probe["t"] - probe["t"].iloc[0]) / PERIOD
    closed = probe["pressure"] > 1e-6 * probe["s_22"].abs().max()
    for axes, values, name, colour in zip(
            panels, (10 * numpy.sin(2 * numpy.pi * t), probe["opening"],
                     probe["pressure"]),
            ("traction", "opening of the mouth", "pressure at the mouth"),
            (GREY, BLUE, VERMILION)):
        axes.axvspan(t[closed].min(), t[closed].max(), color=SHADE, linewidth=0)
        axes.plot(t, values, color=colour)
        axes.set_title(name, loc="left", fontsize=10)
        axes.set(xlim=(0, 1), xticks=(0, 0.5, 1), xticklabels=())
    panels[-1].set(xticklabels=("0", "T/2", "T"))
    return [axes.axvline(0, color="black", linewidth=1) for axes in panels]


def frames(results):
    """One picture for each instant."""
    figure = pyplot.figure(figsize=(6.6, 3.9), dpi=100)
    body = figure.add_axes((0.0, 0.02, 0.38, 0.96))
    panels = [figure.add_axes((0.54, bottom, 0.43, 0.19))
              for bottom in (0.74, 0.415, 0.09)]
    bar = figure.add_axes((0.39, 0.2, 0.018, 0.6))
    marks = draw_histories(panels, read(results))
    for number, instant in enumerate(INSTANTS):
        body.clear()
        fields = Fields(results / f"solution_{number:04}.pvtu")
        bands = draw_bands(body, fields, fields["stress_22"], even_bands(BOUND),
                           MAGNIFY, mirrored=True, wanted=1)
        body.set(xlim=(-0.22, 1.06), ylim=(-1.18, 1.18))
        if number == 0:
            figure.colorbar(bands, cax=bar, ticks=(-BOUND, 0, BOUND))
            bar.set_title("$s_{22}$", fontsize=10)
        for mark in marks:
            mark.set_xdata([instant / PERIOD] * 2)
        buffer = io.BytesIO()
        figure.savefig(buffer, format="png", dpi=100,
                       bbox_inches=figure.bbox_inches)  # equal for all
        yield Image.open(buffer).convert("RGB")


def main():
    options = study_options(__doc__, "opening_crack")
    pictures = list(frames(run_once(options, "raous1980", "opening_crack", SETTINGS)))
    samples = numpy.hstack(pictures[::COUNT // 4])  # of all colours
    palette = Image.fromarray(samples).quantize(64, Image.Quantize.MAXCOVERAGE,
                                                dither=Image.Dither.NONE)
    pictures = [picture.quantize(palette=palette, dither=Image.Dither.NONE)
                for picture in pictures]
    # Where it is not played, the first picture stands: with an open crack.
    pictures = pictures[COUNT // 4:] + pictures[:COUNT // 4]
    path = options.figures / "opening_crack.gif"
    pictures[0].save(path, save_all=True, append_images=pictures[1:], duration=150,
                     loop=0, optimize=False, disposal=1)
    print(path)


main()
