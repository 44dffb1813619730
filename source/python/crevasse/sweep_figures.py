# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Which figures of a sweep are drawn."""

from crevasse import study_figures, work_precision
from crevasse.results import ResultsError
from crevasse.sweep_table import (findings_of, first_of_size, parameters, quantities,
                                  read_rows, varying, wall_times)


def drawings(options):
    """Figures (file name, figure) of a sweep: errors against costs, if there are
    errors, and each result that varies; or the one that --quantity names."""
    rows = read_rows(options.results)
    errors, found = quantities(rows), findings_of(rows)
    along = options.along and choose(options.along, parameters(rows), "parameter")
    if options.quantity:
        chosen = choose(options.quantity, [*errors, *found], "quantity")
        errors = [name for name in errors if name == chosen]
        found = {name: found[name] for name in found if name == chosen}
    else:
        found = varying(found) | ({} if errors else wall_times(rows))
    if errors:
        quantity = first_of_size(rows, errors)
        if not options.quantity:
            print(f"errors of {quantity}; --quantity takes another of "
                  + ", ".join(errors))
        yield "work_precision", work_precision.draw(rows, options.x, quantity, along)
    for name, numbers in found.items():
        yield name, study_figures.draw(rows, name, numbers, along)
    if not errors and not found:
        raise ResultsError(f"{options.results}: no result of the sweep varies, and it "
                           "has measured no errors. There is nothing to draw.")


def choose(wanted, available, what):
    """The candidate whose name, or the end of it, is wanted."""
    for name in available:
        if wanted in (name, name.split("/")[-1]):
            return name
    raise ResultsError(f"There is no {what} {wanted}. There are: "
                       f"{', '.join(available) or 'none'}.")
