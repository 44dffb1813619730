#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Friction: where the lips of a kinked crack open, stick and slide over a period, and
the tractions of partial slip beside the closed form of Cattaneo (1938) and Mindlin
(1949). A run that is done is not done again."""

import math

import numpy

from study import run_once, study_options  # first: finds the package

from crevasse import friction_figure
from crevasse.plotting import BLUE, GREY, VERMILION, pyplot, save
from crevasse.run_reader import Run

# prm/fretting.prm: coefficient, radius, modulus of two bodies that are alike.
MU, RADIUS, MODULUS = 0.5, 50., 210000 / (2 * (1 - 0.3 ** 2))


def partial_slip(x, pressure, traction):
    """Half widths a of contact and c of stick, and the tractions at x under the forces
    that these add up to: p and q."""
    width = numpy.gradient(x)
    P, Q = (width * pressure).sum(), (width * traction).sum()
    a = math.sqrt(4 * P * RADIUS / (math.pi * MODULUS))
    c = a * math.sqrt(1 - abs(Q) / (MU * P))

    def arc(half):
        return numpy.sqrt(numpy.clip(1 - (x / half) ** 2, 0, None))
    largest = 2 * P / (math.pi * a)
    return a, c, largest * arc(a), math.copysign(MU * largest, Q) * (
        arc(a) - c / a * arc(c))


def fretting(run):
    table = run.tables["friction.csv"]
    pushed = numpy.isclose(table["t"], 0.25)
    x, pressure, traction = (table[name][pushed] for name in (
        "x", "normal_pressure", "tangential_traction"))
    a, c, p, q = partial_slip(x, pressure, traction)
    figure, axes = pyplot.subplots(figsize=(7, 3.2), layout="constrained")
    fine = numpy.abs(x) < 1.3 * a
    for value, exact, colour, label in (
            (MU * pressure, MU * p, GREY, "coefficient × pressure"),
            (traction, q, BLUE, "shear traction")):
        axes.plot(x[fine], abs(value[fine]), "o", color=colour, markersize=3, label=label)
        axes.plot(x[fine], abs(exact[fine]), color=colour, linewidth=1)
    for end in (-c, c):
        axes.axvline(end, color=VERMILION, linewidth=1, linestyle="--",
                     label="end of the stick zone" if end > 0 else None)
    axes.set(xlabel="x (mm)", ylabel="MPa", xlim=(-1.3 * a, 1.3 * a), ylim=(0, None))
    axes.legend(frameon=False, loc="lower center")
    return figure


def main():
    options = study_options(__doc__, "friction")
    for name, draw in (("kinked_crack_friction", friction_figure.over_time),
                       ("fretting", fretting)):
        run = Run(run_once(options, name, settings=["Output/Fields=none"]))
        save(draw(run), "friction_" + name.split("_")[0], options.figures,
             options.formats)


main()
