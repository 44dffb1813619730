#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Cracks within a body, when they are pulled and when they are pressed: runs the
scenes of prm/ with two lips and draws the stress s_22. A run that is done is not
done again."""

from study import run_once, study_options  # first: finds the package

from bodies import draw_bands, even_bands
from crevasse.fields import Fields
from crevasse.plotting import pyplot, save

SCENES = ("inclined_crack", "two_cracks", "kinked_crack")
INSTANTS = ("pulled", "pressed")  # their Field times
MAGNIFY, BOUND = 60, 200  # twice the load


def main():
    options = study_options(__doc__, "cracks")
    figure, panels = pyplot.subplots(2, 3, figsize=(8.2, 8), constrained_layout=True)
    for name, column in zip(SCENES, panels.T):
        results = run_once(options, name)
        for number, (axes, what) in enumerate(zip(column, INSTANTS)):
            fields = Fields(results / f"solution_{number:04}.pvtu")
            bands = draw_bands(axes, fields, fields["stress_22"], even_bands(BOUND),
                               MAGNIFY)
            axes.autoscale_view()
            axes.set_title(f"{name.replace('_', ' ')}, {what}")
    figure.colorbar(bands, ax=panels, orientation="horizontal", shrink=0.6, aspect=40,
                    label=f"$s_{{22}}$ (MPa); displacements × {MAGNIFY}",
                    ticks=(-BOUND, -100, 0, 100, BOUND))
    save(figure, "cracks", options.figures, options.formats)


main()
