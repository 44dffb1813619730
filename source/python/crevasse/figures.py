# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Draws the figures of a results directory. Of a run: figures 1 to 6 of Raous
(1980), section 7: the mesh; stress and opening at a probe over one period; level
curves of the stress, principal stresses and second invariant of the deviator at one
instant; with friction, where lips stick and slide. Of a sweep: each result that varies, such as K_I, against the parameter; errors
against costs. Of a life: its path, crack length over periods, growth, K and C*. Exit
status: 0 done, 2 nothing to draw, 4 a file cannot be written."""

import argparse
import pathlib
import sys

from crevasse import (field_figures, friction_figure, life_figures, probe_figures,
                      sweep_figures)
from crevasse.fields import Fields
from crevasse.plotting import save
from crevasse.results import ResultsError
from crevasse.run_reader import Run
from crevasse.sweep_table import COSTS


def arguments(words):
    parser = argparse.ArgumentParser(prog="crevasse figures", description=__doc__)
    parser.add_argument("results", metavar="RESULTS_DIR", type=pathlib.Path,
                        help="output directory of crevasse, crevasse sweep or crevasse "
                        "life")
    parser.add_argument("--output", type=pathlib.Path, metavar="DIR",
                        help="directory of the figures (RESULTS_DIR/figures)")
    parser.add_argument("--format", nargs="+", default=["png"],
                        choices=["png", "pdf", "svg", "pgf"], help="(png); pgf, "
                        "for a paper in LaTeX, needs xelatex")
    of_run = parser.add_argument_group("options for a run")
    of_run.add_argument("--probe", help="probe of figures 2 and 3 (C if it exists, "
                        "else the first)")
    of_run.add_argument("--period", type=int, metavar="N", help="period of figures 2 "
                        "and 3, from 1 (the last complete one)")
    of_run.add_argument("--instant", type=float, metavar="t", help="time within the "
                        "period of figures 4 to 6; the nearest stored one is taken "
                        "(the largest stress intensity, else the largest stress; in "
                        "the paper's scenes a quarter of the period)")
    of_run.add_argument("--magnify", type=float, default=10, metavar="FACTOR",
                        help="magnification of displacements in figures 4 to 6 (10)")
    of_sweep = parser.add_argument_group("options for a sweep")
    of_sweep.add_argument("--x", choices=list(COSTS), default="seconds",
                          help="cost that errors are drawn against (seconds)")
    of_sweep.add_argument("--quantity", help="draw one figure only: the error of this "
                          "quantity, such as stress, or this result, such as "
                          "K_I_largest")
    of_sweep.add_argument("--along", metavar="NAME", help="parameter that varies along "
                          "each line (the one with the most numeric values)")
    return parser.parse_args(words)


def probe_drawings(run, options):
    """Draws figures 2 and 3 as (file name, figure)."""
    if not run.probes:
        print("No probes in this run: figures 2 and 3 are left out.")
        return
    probe = options.probe or ("C" if "C" in run.probes else next(iter(run.probes)))
    yield ("figure2_stress_history",
           probe_figures.stress_history(run, probe, options.period))
    opening = probe_figures.opening_history(run, probe, options.period)
    if opening is None:
        print(f"Probe {probe} is not on a crack lip: figure 3 is left out.")
    else:
        yield "figure3_opening", opening


def field_drawings(run, options):
    """Draws figures 1, 4, 5 and 6 as (file name, figure)."""
    if not run.instants():
        print("No fields in this run: figures 1, 4, 5 and 6 are left out.")
        return
    wanted = options.instant
    t, path = (field_figures.shown_instant(run) if wanted is None else
               run.choose_instant(wanted))
    within = t % run.period
    if wanted is not None and abs(within - wanted) > 0.01 * run.period:
        print(f"Nearest stored field: t = {t:g}, which is {within:g} within "
              f"the period instead of {wanted:g}.")
    fields = Fields(path)
    if field_figures.bears_nothing(run, fields):
        print(field_figures.no_stress(t))
    yield from field_figures.draw_fields(run, fields, t, options.magnify)


def run_drawings(options):
    run = Run(options.results)
    if not run.finished:
        raise ResultsError(f"{options.results}: the run has not finished.")
    if run.dimension != 2:
        raise ResultsError(f"{options.results}: the run is three-dimensional; these "
                           "figures are for two dimensions.")
    for damage in run.damages:
        print(f"crevasse figures: damaged: {damage}", file=sys.stderr)
    yield from probe_drawings(run, options)
    yield from field_drawings(run, options)
    if "friction.csv" in run.tables:
        yield "friction", friction_figure.over_time(run)


def main(words):
    options = arguments(words)
    drawings = next((kind.drawings for name, kind in
                     {"sweep.csv": sweep_figures, "life.csv": life_figures}.items()
                     if (options.results / name).is_file()), run_drawings)
    directory = options.output or options.results / "figures"
    drawn = 0
    try:
        for name, figure in drawings(options):
            directory.mkdir(parents=True, exist_ok=True)
            save(figure, name, directory, options.format)
            drawn += 1
        if not drawn:
            raise ResultsError(f"{options.results}: neither probes nor fields; there "
                               "is nothing to draw.")
    except ResultsError as error:
        print(f"crevasse figures: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"crevasse figures: {error}", file=sys.stderr)
        return 4
    return 0
