# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The first lines of a report: stress intensity, growth and opening of the last
period, each with its estimated error where that is known, and a chart of the stress
intensity over this period."""

import collections
import math

import numpy

from crevasse import findings, histories
from crevasse.findings import INTENSITY
from crevasse.results import at, is_number
from crevasse.wording import significant

# An error of None is not known.
Number = collections.namedtuple("Number", "label, value, error, unit")
FLOW = "stress × length / time"
MOST_TIPS = 6  # in the chart: each has a colour


def numbers(run):
    """First numbers of a report: the tip in words, its numbers, then the body's."""
    tips = findings.tips_of(run.summary)
    k = leading_tip(tips)
    found = list(numbers_of_tip(tips[k])) if tips else []
    opening = run.summary_number("extremes", "opening")
    if opening is not None:
        found.append(Number("largest opening", opening, None, "length"))
    if not found:
        stress = run.summary_number("extremes", "stress")
        bounded = "no_largest_stress" not in run.summary
        found = [Number("largest stress" if bounded else
                        "largest stress at quadrature points, which no mesh bounds",
                        stress, None, "stress"),
                 Number("largest displacement",
                        run.summary_number("extremes", "displacement"), None,
                        "length")]
    bars = bars_by_label(run, k + 1 if len(tips) > 1 else None)
    return (place_of(tips, k) if len(tips) > 1 else "",
            [number._replace(unit=unit_of(number, run),
                             error=bars.get(number.label, number.error))
             for number in found if is_number(number.value)])


def bars_by_label(run, tip):
    """Error bars of a tip and of the body, which replace other estimates."""
    bars = {}
    for name, entry in run.summary.get("bars", {}).items():
        if findings.is_finding(name) and findings.split(name)[1] in (tip, None):
            label = findings.FINDINGS[findings.split(name)[0]].label
            tips = run.summary.get("crack_tips", [run.summary.get("crack_tip", {})])
            several_modes = any("Delta_K_I" in of_tip for of_tip in tips)
            bars["equivalent ΔK" if several_modes and label == "ΔK" else
                 "ΔK_I" if label == "ΔK" else label] = entry.get("bar")
    return bars


def unit_of(number, run):
    """The unit of a number; a K that is not in MPa √m is given in these, too."""
    unit = run.in_units(number.unit)
    factor = run.summary_number("units", "K_in_MPa_sqrt_m")
    if number.unit != INTENSITY or factor in (None, 1):
        return unit
    return f"{unit}; {significant(factor * number.value)} MPa √m"


def leading_tip(tips):
    """The number of the tip with the largest stress intensity or C(t)."""
    def size(tip):
        return max((value for value in (at(tip, ("equivalent_intensity", "largest")),
                                        at(tip, ("K_I", "largest")), tip.get("largest"))
                    if is_number(value)), default=-math.inf)
    return max(range(len(tips)), key=lambda k: size(tips[k]), default=None)


def place_of(tips, k):
    place = ", ".join(significant(x) for x in tips[k].get("position", ()))
    return (f"Tip {k + 1} of {len(tips)}, at ({place}), has the largest stress "
            "intensity.")


def numbers_of_tip(tip):
    """Numbers of a tip: both extremes of K_I, the larger ones of K_II and K_III."""
    for mode in ("I", "II", "III"):
        extremes = tip.get(f"K_{mode}") or {}
        ends = [extremes.get(end) for end in ("largest", "smallest")]
        if all(map(is_number, ends)):
            error = tip.get(f"K_{mode}_error")
            if mode == "I":
                yield Number("largest K_I", ends[0], error, INTENSITY)
                yield Number("smallest K_I", ends[1], error, INTENSITY)
            else:
                yield Number(f"K_{mode} of largest magnitude", max(ends, key=abs),
                             error, INTENSITY)
    for label, path, error, unit in (
            ("largest equivalent K", ("equivalent_intensity", "largest"), None, INTENSITY),
            ("ΔK_I", ("Delta_K_I",), None, INTENSITY),
            ("ΔK_II", ("Delta_K_II",), None, INTENSITY),
            ("equivalent ΔK" if "Delta_K_I" in tip else "ΔK_I", ("Delta_K",), None,
             INTENSITY),
            ("K_op", ("K_opening",), None, INTENSITY),
            ("ΔK_eff", ("Delta_K_eff",), None, INTENSITY),
            ("largest C(t)", ("largest",), "error_of_largest", FLOW),
            ("C*", ("C_star",), None, FLOW),
            ("largest C*", ("C_star", "largest"), "C_star_error", FLOW),
            ("da/dN", ("da_dN",), None, "length")):
        yield Number(label, at(tip, path), tip.get(error), unit)


def lines(run):
    """The first numbers of a report as lines of text."""
    place, found = numbers(run)
    if place:
        yield place
    for label, value, error, unit in found:
        error = f" ± {significant(error, 2)}" if is_number(error) else ""
        yield f"{label}: {significant(value)}{error} ({unit})"


def tips_with_two_lips(run):
    """Tables {number: table} of tips between two lips."""
    numbers = {int(name[len("crack_tip_"):-len(".csv")]): table
               for name, table in run.tables.items() if name.startswith("crack_tip_")}
    return dict(sorted(numbers.items()))


def has_K_along_front(run):
    return "K_I" in run.tables.get("crack_front.csv", ())


def along_front(run, column):
    """Instants, and at each the largest value along the fronts."""
    front = run.tables["crack_front.csv"]
    t, rows = numpy.unique(front["t"], return_inverse=True)
    largest = numpy.full(len(t), -numpy.inf)
    numpy.maximum.at(largest, rows.ravel(), front[column])
    return t, largest


def curves_of_intensity(run):
    """Instants, and by name the stress intensities that a chart shows (of several tips
    their equivalent intensities); None without crack tip."""
    tips = tips_with_two_lips(run)
    if "crack_tip.csv" in run.tables:
        table = run.tables["crack_tip.csv"]
        return table["t"], {"K_I": table["K_I"]}
    if tips:
        table = next(iter(tips.values()))
        return table["t"], (
            {name: table[name] for name in ("K_I", "K_II")} if len(tips) == 1 else
            {f"tip {k}": tip["equivalent_intensity"] for k, tip in tips.items()})
    if has_K_along_front(run):
        t, largest = along_front(run, "K_I")
        return t, {"largest K_I along the front": largest}
    return None


def loading_of_crack(run):
    """Instants, and the quantity whose maximum loads a crack tip most: K_I, the
    equivalent intensity, or with three modes the energy release rate. None without
    crack tip."""
    tips = list(tips_with_two_lips(run).values())
    if tips:
        return tips[0]["t"], numpy.max([tip["equivalent_intensity"] for tip in tips],
                                       axis=0)
    if "crack_tip.csv" in run.tables:
        return run.tables["crack_tip.csv"]["t"], run.tables["crack_tip.csv"]["K_I"]
    if has_K_along_front(run):
        has_modes = "K_II" in run.tables["crack_front.csv"]
        return along_front(run, "energy_release_rate" if has_modes else "K_I")
    return None


def chart(run):
    """Chart of K, or else C(t), over the last period; None if the run has neither."""
    found = curves_of_intensity(run)
    title, axis, log = "Stress intensity", "K (stress × √length)", False
    if found and len(found[1]) > 1 and "K_I" not in found[1]:
        title, axis = "Equivalent stress intensity", f"equivalent {axis}"
    if has_K_along_front(run):
        title = "Largest K_I along the front"
    if not found:
        names = [name for name in run.tables if name.startswith("creep_integral")]
        if names:
            table = run.tables[names[0]]
            found = table["t"], {"C_t": table["C_t"]}
        elif "crack_front.csv" in run.tables:
            t, largest = along_front(run, "C_t")
            found = t, {"largest C(t) along the front": largest}
        else:
            return None
        title, axis, log = "Creep integral C(t)", f"C(t) ({FLOW})", True
    t, curves = found
    short = histories.last_period(t, run.period) is None and t[-1] - t[0] < 0.99 * run.period
    span = "the time computed" if short else "the last period"
    curves = dict(list(curves.items())[:MOST_TIPS])
    largest = max(abs(values).max() for values in curves.values())
    drawn = histories.chart(run, {"t": t, **curves}, list(curves), axis,
                            f"{title} over {span}",
                            noise=histories.ROUNDING * largest, log=log)
    drawn["views"] = {"whole": drawn["views"].get("last", drawn["views"]["whole"])}
    return drawn | histories.bands(run, *(f"{name}_largest" for name in curves))
