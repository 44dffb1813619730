#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Cracks within a body, when they are pulled and when they are pressed: runs the
scenes of prm/ with two lips and draws the stress s_22. A run that is done is not
done again."""

import numpy

from study import run_once, study_options  # first: finds the package

from crevasse.fields import Fields
from crevasse.level_curves import draw_level_curves
from crevasse.plotting import pyplot, save

SCENES = ("inclined_crack", "two_cracks", "kinked_crack")
INSTANTS = ("pulled", "pressed")  # their Field times
MAGNIFY = 60


def main():
    options = study_options(__doc__, "cracks")
    figure, panels = pyplot.subplots(2, 3, figsize=(12, 10.5),
                                     constrained_layout=True)
    for name, column in zip(SCENES, panels.T):
        results = run_once(options, name)
        for number, (axes, what) in enumerate(zip(column, INSTANTS)):
            fields = Fields(results / f"solution_{number:04}.pvtu")
            stress = fields["stress_22"]
            draw_level_curves(axes, fields, stress, numpy.abs(stress).max(), MAGNIFY,
                              "$s_{22}$ [MPa]")
            axes.set_title(f"{name.replace('_', ' ')}, {what}")
    figure.supxlabel(f"displacements × {MAGNIFY}", fontsize=9)
    save(figure, "cracks", options.figures, options.formats)


main()
