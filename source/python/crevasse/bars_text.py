# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Error bars as lines of a log: values with the digits that are right, and what halves
the bar of the most important one."""

import math

from crevasse.results import is_number

MOST_ROWS = 16
PARTS = ("mesh", "time", "period")
LEADING = ("K_I_largest", "K_I_largest_1", "C_t_largest", "C_t_largest_1", "opening")


def right_digits(entry):
    """Digits of a value that its bar leaves; None without bar, or of 0."""
    if not entry["bar"] or not entry["value"]:
        return None
    return max(0, math.floor(math.log10(abs(entry["value"]) / entry["bar"])))


def row(name, entry):
    digits = right_digits(entry)
    if entry["bar"] is None:
        return f"    {name:24}{entry['value']:12.4g}   {entry['why']}"
    shown = 2 if digits is None else min(digits + 2, 10)
    parts = "".join(f"{entry[part]:10.2g}" for part in PARTS)
    return (f"    {name:24}{entry['value']:12.{shown}g} ±{entry['bar']:9.2g}"
            f"{'' if digits is None else digits:7}{parts}")


def table_of(bars):
    """Lines that show the bars: a row a quantity, with its three parts."""
    yield (f"  {'error bars of the last period':26}{'value':>12}  {'bar':>9} digits"
           f"{'mesh':>10}{'steps':>10}{'periods':>10}")
    for name, entry in list(bars.items())[:MOST_ROWS]:
        yield row(name, entry)
    if len(bars) > MOST_ROWS:
        yield f"    {len(bars) - MOST_ROWS} more in summary.json"
    if any(name.startswith("K_") for name in bars):
        yield "    bars of K replace the estimated errors above"


def to_halve(bars, choice, run):
    """A line with what halves the bar of the most important quantity, and its cost."""
    name = next((name for name in (*LEADING, *bars)
                 if name in bars and bars[name]["bar"]), None)
    if not name:
        return
    part = max(PARTS, key=lambda part: bars[name][part])
    what, times = {"mesh": finer_mesh, "time": shorter_steps,
                   "period": smaller_tolerance}[part](choice, run)
    seconds = times * run.summary.get("processor_seconds", 0.)
    yield f"  to halve the bar of {name}: {what}, about {seconds:.2g} s of CPU time"


def finer_mesh(choice, run):
    if choice.is_adaptive:
        return f"--set \"Refinement/Target unknowns={2 * choice.unknowns}\"", 2.5
    return (f"--set \"Geometry/Refinements={choice.number('Geometry/Refinements') + 1}\"",
            1.25 * 2. ** choice.dim)


def shorter_steps(choice, run):
    name = "Time integration/Steps per period"
    if run.parameter("Time integration/Step control") == "uniform":
        return f"--set \"{name}={2 * choice.number(name)}\"", 2.
    return "steps of half the length", 2.


def smaller_tolerance(choice, run):
    """Periods reduce the error at the rate at which the change of stress falls now."""
    tolerance = float(run.parameter("Periodic state/Tolerance")) / 2.
    changes = [x for x in run.summary.get("stress_change", ()) if is_number(x) and x > 0.]
    periods = len(changes)
    more = 1.
    if periods > 1 and changes[-1] < changes[-2]:
        more = math.log(.5) / math.log(changes[-1] / changes[-2])
    return f"--set \"Periodic state/Tolerance={tolerance:g}\"", 1. + more / max(periods, 1)
