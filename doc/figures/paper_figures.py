#!/usr/bin/python3
# Copyright (C) 2026 by the Crevasse authors
# SPDX-License-Identifier: LGPL-2.1-or-later

"""Draws figures 1 to 6 of Raous (1980), section 7, from a results directory:
the mesh; stress and opening at a probe over one period; level curves of the
stress, principal stresses and second invariant of the deviator at one instant.
"""

import argparse
import pathlib
import sys

sys.dont_write_bytecode = True  # leaves nothing behind in the source tree

try:
    import field_figures
    import probe_figures
    from fields import Fields
    from plotting import save
    from results import Results, ResultsError
except ImportError as missing:
    sys.exit(f"{missing}. The figures need Debian's packages python3-matplotlib "
             "and python3-meshio and its own /usr/bin/python3.")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", metavar="RESULTS_DIR",
                        help="output directory of a finished run")
    parser.add_argument("--probe", help="probe of figures 2 and 3 (C if there "
                        "is one of that name, else the first)")
    parser.add_argument("--period", type=int, metavar="N", help="period of "
                        "figures 2 and 3, from 1 (the last complete one)")
    parser.add_argument("--instant", type=float, metavar="t", help="time within "
                        "the period of figures 4 to 6; the nearest stored one "
                        "is taken (a quarter of the period)")
    parser.add_argument("--magnify", type=float, default=10, metavar="FACTOR",
                        help="of the displacement in figures 4 to 6 (10)")
    parser.add_argument("--format", nargs="+", default=["png"],
                        choices=["png", "pdf", "svg"], help="(png)")
    parser.add_argument("--output", type=pathlib.Path, metavar="DIR",
                        help="where the figures go (RESULTS_DIR/figures)")
    return parser.parse_args()


def probe_drawings(results, options):
    """(file name, figure) of figures 2 and 3."""
    probe = results.choose_probe(options.probe)
    if probe is None:
        print("No probes in this run: figures 2 and 3 are left out.")
        return
    yield ("figure2_stress_history",
           probe_figures.stress_history(results, probe, options.period))
    opening = probe_figures.opening_history(results, probe, options.period)
    if opening is None:
        print(f"Probe {probe} is not on a crack lip: figure 3 is left out.")
    else:
        yield "figure3_opening", opening


def field_drawings(results, options):
    """(file name, figure) of figures 1, 4, 5 and 6."""
    if not results.instants():
        print("No fields in this run: figures 1, 4, 5 and 6 are left out.")
        return
    wanted = (results.period / 4 if options.instant is None
              else options.instant)
    t, path = results.choose_instant(wanted)
    within = t % results.period
    if abs(within - wanted) > 0.01 * results.period:
        print(f"Nearest stored field: t = {t:g}, which is {within:g} within "
              f"the period instead of {wanted:g}.")
    fields = Fields(path)
    if bears_nothing(results, fields):
        print(no_stress(t))
    yield from draw_fields(results, fields, t, options.magnify)


def bears_nothing(results, fields):
    """Whether all stress is rounding beside the largest of the run, as where
    the load passes through zero."""
    largest = (results.summary.get("extremes") or {}).get("stress") or 0
    return max(abs(fields[f"principal_stress_{k}"]).max()
               for k in (1, 2)) <= 1e-6 * largest


def no_stress(t):
    return (f"Figures 4 to 6 are left out: at t = {t:g}, the stored instant nearest "
            "to T/4, the body bears no stress. [Output] Field times names others.")


def draw_fields(results, fields, t, magnify):
    """(file name, figure) of the fields of one instant."""
    caption = f"$t$ = {t:g}, displacements × {magnify:g}"
    yield "figure1_mesh", field_figures.mesh(results, fields)
    if bears_nothing(results, fields):
        return
    for name, draw in (
            ("figure4_stress_levels", field_figures.stress_levels),
            ("figure5_principal_stresses", field_figures.principal_stresses),
            ("figure6_deviator_invariant", field_figures.deviator_invariant)):
        yield name, draw(fields, magnify, caption)


def main():
    options = arguments()
    try:
        results = Results(options.results)
        directory = options.output or results.directory / "figures"
        directory.mkdir(parents=True, exist_ok=True)
        drawn = 0
        for drawings in (probe_drawings, field_drawings):
            for name, figure in drawings(results, options):
                save(figure, name, directory, options.format)
                drawn += 1
        if not drawn:
            raise ResultsError(f"{options.results}: neither probes nor fields; "
                               "there is nothing to draw.")
    except (ResultsError, OSError) as error:
        sys.exit(f"paper_figures.py: {error}")


if __name__ == "__main__":
    main()
