#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""How a crack grows: sweeps the scene prm/crack_growth.prm over the crack length,
interpolates the growth a period between lengths, integrates dN = da / (da/dN), and
draws a(N) and what the growth consists of. A sweep that is done is not computed
again."""

import csv
import subprocess
import sys

import numpy

from study import ROOT, study_options  # first: finds the package

from crevasse.plotting import BLUE, INK, VERMILION, pyplot, save

SCENE = ROOT / "prm" / "crack_growth.prm"
LENGTHS = "5:35:13"  # mm
FACTOR, EXPONENT = 5.21e-13, 3  # the scene's fatigue
DAYS = 365.25


def slopes(x, y):
    """Of the monotone cubic interpolation of F. N. Fritsch and J. Butland (1984)."""
    h, d = numpy.diff(x), numpy.diff(y) / numpy.diff(x)
    inner = numpy.where(d[1:] * d[:-1] > 0,
                        3 * (h[1:] + h[:-1]) /
                        ((2 * h[1:] + h[:-1]) / d[:-1]
                         + (h[1:] + 2 * h[:-1]) / d[1:]), 0.)
    return numpy.concatenate([[1.5 * d[0] - 0.5 * inner[0]], inner,
                              [1.5 * d[-1] - 0.5 * inner[-1]]])


def interpolate(x, y, at):
    """Monotone between the points, with a continuous slope."""
    slope, k = slopes(x, y), numpy.clip(numpy.searchsorted(x, at) - 1, 0,
                                        len(x) - 2)
    h = x[k + 1] - x[k]
    s = (at - x[k]) / h
    return ((1 + 2 * s) * (1 - s) ** 2 * y[k] + s ** 2 * (3 - 2 * s) * y[k + 1]
            + h * s * (1 - s) * ((1 - s) * slope[k] - s * slope[k + 1]))


def rate(lengths, rates, at):
    """da/dN, between logarithms."""
    return numpy.exp(interpolate(numpy.log(lengths), numpy.log(rates),
                                 numpy.log(at)))


def periods(lengths, rates, at):
    """N(a) from the first length on, by the trapezoidal rule."""
    inverse = 1 / rate(lengths, rates, at)
    steps = 0.5 * (inverse[1:] + inverse[:-1]) * numpy.diff(at)
    return numpy.concatenate([[0], numpy.cumsum(steps)])


def sweep(program, output):
    """Columns of the sweep's table."""
    subprocess.run([program, "sweep", SCENE, "--quiet", "--output", output,
                    "--vary", f"Geometry/Crack length={LENGTHS}"], check=True)
    with open(output / "sweep.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        if row["status"] != "done":
            sys.exit(f"{row['point']}: {row['status']}: {row['message']}")
    return [numpy.array([float(row[name]) for row in rows]) for name in
            ("Geometry/Crack length", "da_dN", "Delta_K", "C_star")]


def draw(lengths, rates, fatigue, directory, formats):
    figure, (growth, speed) = pyplot.subplots(1, 2, figsize=(8.2, 3.6),
                                              constrained_layout=True)
    a = numpy.linspace(lengths[0], lengths[-1], 3001)
    years = periods(lengths, rates, a) / DAYS
    growth.plot(years, a, color=INK, label="fatigue and creep")
    growth.plot(numpy.interp(lengths, a, years), lengths, "o", color=INK,
                markersize=3.5)
    growth.plot(periods(lengths, fatigue, a) / DAYS, a, color=BLUE,
                linestyle=(0, (4, 2)), linewidth=1.3,
                label="fatigue alone")
    growth.legend(loc="lower right")
    growth.set(xlabel="years of daily starts", ylabel="crack length (mm)",
               ylim=(0, 37), xlim=(0, None),
               title="growth of a crack of 5 mm")
    for values, colour, name in ((rates, INK, "fatigue and creep"),
                                 (rates - fatigue, VERMILION, "creep"),
                                 (fatigue, BLUE, "fatigue")):
        speed.semilogy(a, rate(lengths, values, a), color=colour, label=name)
        speed.semilogy(lengths, values, "o", color=colour, markersize=3.5)
    speed.set(xlabel="crack length (mm)", ylabel="growth a day (mm)",
              title="what it consists of")
    for axes in (growth, speed):
        axes.grid(True, which="major", alpha=0.25, linewidth=0.6)
    speed.legend()
    save(figure, "crack_growth", directory, formats)


def main():
    options = study_options(__doc__, "crack_growth_sweep", "sweep is")
    lengths, rates, spans, flows = sweep(options.program.resolve(), options.output)
    fatigue = FACTOR * spans ** EXPONENT
    all_periods = periods(lengths, rates, numpy.linspace(*lengths[[0, -1]],
                                                         3001))[-1]
    coarse = periods(lengths[::2], rates[::2], numpy.linspace(
        *lengths[[0, -1]], 3001))[-1]
    at_lengths = [periods(lengths, rates, numpy.linspace(
        lengths[0], a, 3001))[-1] for a in lengths]
    print("| a (mm) | ΔK (MPa √mm) | C* (MPa mm/h) | da/dN (mm) | N |\n"
          + "|---" * 5 + "|")
    for a, span, flow, growth, n in zip(lengths, spans, flows, rates, at_lengths):
        print(f"| {a:g} | {span:.1f} | {flow:.3e} | {growth:.3e} | {n:.0f} |")
    print(f"\n{all_periods:.0f} periods to a = {lengths[-1]:g}; from every "
          f"other length {100 * (coarse / all_periods - 1):+.2f} %")
    draw(lengths, rates, fatigue, options.figures, options.formats)


if __name__ == "__main__":
    main()
