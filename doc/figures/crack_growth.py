#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""How a crack grows: the life of prm/crack_growth.prm by crevasse life, with a figure of
a(N) and of what the growth consists of. Runs that are done are not computed again."""

import subprocess

import numpy

from study import ROOT, print_table, study_options  # first: finds the package

from crevasse.life_output import read
from crevasse.plotting import BLUE, INK, VERMILION, pyplot, save

SCENE = ROOT / "prm" / "crack_growth.prm"
LENGTHS = range(5, 36, 5)  # mm, of the table
DAYS = 365.25


def draw(table, computed, directory, formats):
    figure, (growth, speed) = pyplot.subplots(1, 2, figsize=(8.2, 3.6),
                                              constrained_layout=True)
    a, years = table["a"], table["N"] / DAYS
    fatigue, creep = table["da_dN_fatigue"], table["da_dN_creep"]
    by_fatigue = numpy.concatenate([[0.], numpy.cumsum(
        (1 / fatigue[1:] + 1 / fatigue[:-1]) / 2 * numpy.diff(a))]) / DAYS
    growth.plot(years, a, color=INK, label="fatigue and creep")
    growth.plot(numpy.interp(computed, a, years), computed, "o", color=INK, markersize=3.5)
    growth.plot(by_fatigue, a, color=BLUE, linestyle=(0, (4, 2)), linewidth=1.3,
                label="fatigue alone")
    growth.legend(loc="lower right")
    growth.set(xlabel="years of daily starts", ylabel="crack length (mm)",
               ylim=(0, 37), xlim=(0, None),
               title="growth of a crack of 5 mm")
    for values, colour, name in ((fatigue + creep, INK, "fatigue and creep"),
                                 (creep, VERMILION, "creep"), (fatigue, BLUE, "fatigue")):
        speed.semilogy(a, values, color=colour, label=name)
    speed.set(xlabel="crack length (mm)", ylabel="growth a day (mm)",
              title="what it consists of")
    for axes in (growth, speed):
        axes.grid(True, which="major", alpha=0.25, linewidth=0.6)
    speed.legend()
    save(figure, "crack_growth", directory, formats)


def main():
    options = study_options(__doc__, "crack_growth_life", "life is")
    subprocess.run([options.program.resolve(), "life", SCENE, "--from", "5", "--to", "35",
                    "--error", "1e-3", "--output", options.output], check=True)
    life, table = read(options.output)
    rows = [abs(table["a"] - a).argmin() for a in LENGTHS]
    print_table(("a (mm)", "ΔK (MPa √mm)", "C* (MPa mm/h)", "da/dN (mm)", "N"), [
        (f"{table['a'][k]:g}", f"{table['Delta_K'][k]:.1f}", f"{table['C_star'][k]:.3e}",
         f"{table['da_dN_fatigue'][k] + table['da_dN_creep'][k]:.3e}", f"{table['N'][k]:.0f}")
        for k in rows])
    draw(table, [node["a"] for node in life["lengths"]], options.figures, options.formats)


if __name__ == "__main__":
    main()
