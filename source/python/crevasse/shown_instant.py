# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Chooses the stored instants that pictures show."""

import numpy

from crevasse import headline
from crevasse.fields import read_pieces
from crevasse.quantities import SAME_INSTANT
from crevasse.results import number

MOST_FILES = 25


def is_scene_of_paper(run):
    return run.parameter("Title").startswith("Raous (1980)")


def shown_instant(run):
    """The instant (t, file) of pictures: in the paper's scenes next to T/4, else that
    of the largest stress intensity or, without one, of the largest stress."""
    if is_scene_of_paper(run):
        return run.choose_instant(instant_of_paper(run))
    stored = run.instants()
    if len(stored) < 2:
        return stored[0]
    if found := headline.loading_of_crack(run):
        t, K = found
        values = [K[abs(t - instant).argmin()] for instant, _ in stored]
        if max(values) > 1e-6 * abs(K).max():
            return stored[int(numpy.argmax(values))]
    return max(with_creep_integral(run, stored), key=lambda entry: largest_stress(
        entry[1], run.dimension))


def instant_of_paper(run):
    """The instant T/4 of the paper, or the field time of the scene next to it."""
    named = [value for value in map(number, run.parameter("Output/Field times")
                                    .split(",")) if value is not None]
    return min(named, key=lambda t: abs(t - run.period / 4),
               default=run.period / 4)


def with_creep_integral(run, stored):
    """The stored instants at which C(t), and so the singular stress, is known, if there
    are any; of many some, evenly chosen."""
    rows = numpy.linspace(0, len(stored) - 1, min(len(stored), MOST_FILES))
    some = [stored[k] for k in numpy.unique(rows.round().astype(int))]
    tables = [table for name, table in run.tables.items()
              if name.startswith("creep_integral")]
    known = [(t, path) for t, path in some for table in tables[:1]
             if abs(table["t"] - t).min() <= SAME_INSTANT * run.period]
    return known or some


def largest_stress(path, dimension):
    data = read_pieces(path, dimension)[2]
    return data["von_mises_stress"].max() if "von_mises_stress" in data else 0.
