# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The results of a run that parameter studies tabulate and draw: numbers of its
summary."""

import collections
import itertools
import math
import re

from crevasse.results import at
from crevasse.run_reader import Run

# Findings with the same unit are of the same kind. A path that begins with "tip" leads
# through each crack tip.
Finding = collections.namedtuple("Finding", "label, unit, path")
INTENSITY = "stress × √length"

FINDINGS = {name: Finding(*rest) for name, *rest in (
    ("K_I_largest", "largest K_I", INTENSITY, ("tip", "K_I", "largest")),
    ("K_I_smallest", "smallest K_I", INTENSITY, ("tip", "K_I", "smallest")),
    ("Delta_K", "ΔK", INTENSITY, ("tip", "Delta_K")),
    ("K_opening", "K_op", INTENSITY, ("tip", "K_opening")),
    ("Delta_K_eff", "ΔK_eff", INTENSITY, ("tip", "Delta_K_eff")),
    ("K_II_largest", "largest K_II", INTENSITY, ("tip", "K_II", "largest")),
    ("K_II_smallest", "smallest K_II", INTENSITY, ("tip", "K_II", "smallest")),
    ("K_III_largest", "largest K_III", INTENSITY, ("tip", "K_III", "largest")),
    ("K_III_smallest", "smallest K_III", INTENSITY, ("tip", "K_III", "smallest")),
    ("equivalent_intensity", "largest equivalent K", INTENSITY,
     ("tip", "equivalent_intensity", "largest")),
    ("growth_angle", "direction of growth", "degrees", ("tip", "growth_angle")),
    ("T_stress_largest", "largest T-stress", "stress", ("tip", "T_stress", "largest")),
    ("T_stress_smallest", "smallest T-stress", "stress",
     ("tip", "T_stress", "smallest")),
    ("energy_release_rate", "largest energy release rate", "force / length",
     ("tip", "energy_release_rate", "largest")),
    ("C_star", "C*", "stress × length / time", ("tip", "C_star")),
    ("C_star_largest", "largest C*", "stress × length / time", ("tip", "C_star", "largest")),
    ("C_star_smallest", "smallest C*", "stress × length / time",
     ("tip", "C_star", "smallest")),
    ("C_t_largest", "largest C(t)", "stress × length / time", ("tip", "largest")),
    ("C_t_last", "C(t) at the end", "stress × length / time", ("tip", "last")),
    ("K_I_error", "estimated error of K_I", INTENSITY, ("tip", "K_I_error")),
    ("da_dN", "da/dN", "length", ("tip", "da_dN")),
    ("da_dN_fatigue", "da/dN by fatigue", "length", ("tip", "da_dN_fatigue")),
    ("da_dN_creep", "da/dN by creep", "length", ("tip", "da_dN_creep")),
    ("opening", "largest opening", "length", ("extremes", "opening")),
    ("closed_part", "lip partly or wholly closed", "part of the period",
     ("closed_part",)),
    ("wholly_closed_part", "lip wholly closed", "part of the period",
     ("wholly_closed_part",)),
    ("slip_range", "largest slip range", "length", ("friction", "largest_slip_range")),
    ("net_slip", "net slip of a period", "length", ("friction", "net_slip")),
    ("dissipation", "work of friction in a period", "force × length",
     ("friction", "dissipation")),
    ("largest_stress", "largest stress at quadrature points", "stress", ("extremes", "stress")),
    ("largest_displacement", "largest displacement", "length",
     ("extremes", "displacement")),
    ("drift", "largest drift of the displacement", "length / time",
     ("drift", "largest_rate")),
    ("stress_change", "last change of the stress", "part of the stress",
     ("last_stress_change",)))}


def split(column):
    """Splits a column into the finding's name and the number of the tip, if any."""
    name, tip = re.fullmatch(r"(.+?)(?:_(\d+))?", column).groups()
    return name, tip and int(tip)


def is_finding(column):
    return split(column)[0] in FINDINGS


def place(column):
    """Key by which columns are sorted."""
    name, tip = split(column)
    return list(FINDINGS).index(name), tip or 0


def unit(column):
    return FINDINGS[split(column)[0]].unit


def label(column):
    name, tip = split(column)
    return FINDINGS[name].label + (f" at tip {tip}" if tip else "")


def read(directory):
    """{column: number} of a run; what the run does not have is left out."""
    run = Run(directory)
    tips = tips_of(run.summary)
    closed = [run.summary_number("closed_part", part) for part in ("wholly", "partly")]
    places = {**run.summary, "closed_part": None if None in closed else sum(closed),
              "wholly_closed_part": closed[0],
              "last_stress_change": (run.summary.get("stress_change") or [None])[-1]}
    found = {}
    for name, finding in FINDINGS.items():
        of_tips = tips if finding.path[0] == "tip" else [{}]
        for k, tip in enumerate(of_tips, 1):
            value = at({**places, "tip": tip}, finding.path)
            if isinstance(value, (int, float)) and math.isfinite(value):
                found[f"{name}_{k}" if len(of_tips) > 1 else name] = value
    return found


def bars(directory):
    """{column: error bar} of a run; what has no bar is left out."""
    return {name: entry["bar"] for name, entry in
            Run(directory).summary.get("bars", {}).items()
            if is_finding(name) and entry.get("bar") is not None}


def tips_of(summary):
    """Entries of the summary by crack tip, or for all crack fronts together."""
    tips = summary.get("crack_tips") or [
        tip for tip in (summary.get("crack_tip"), front(summary)) if tip]
    return [{**creep, **tip} for tip, creep in itertools.zip_longest(
        tips, summary.get("creep_integrals", ()), fillvalue={})]


def front(summary):
    """Entries of a crack front as those of a tip, without places of extremes."""
    return {name: {end: at(extreme, ("value",)) for end, extreme in value.items()}
            if isinstance(value, dict) else value
            for name, value in summary.get("crack_front", {}).items()}
