# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Reads summary.json. Parts without the expected shape are left out and
reported: a damaged or edited file may still be JSON."""

import json
import math

NUMBER, TEXT, YES_OR_NO = "number", "text", "yes or no"
EACH = "each"  # whatever its name is
# Shapes of what the pages look into; of the rest they show what is there.
SHAPES = {
    "effects": {EACH: {"on": YES_OR_NO, "why": TEXT}},
    "counters": {EACH: NUMBER},
    "certificate": {EACH: NUMBER},
    "seconds": {EACH: NUMBER}, "calls": {EACH: NUMBER}, "share": {EACH: NUMBER},
    "extremes": {EACH: NUMBER}, "closed_part": {EACH: NUMBER},
    "secular": {"on": YES_OR_NO, "opening_nodes": NUMBER,
                "per_probe": {EACH: {"beta": [NUMBER], "mean_pressure": NUMBER}}},
    "drift": {"per_probe": {EACH: [NUMBER]}},
    "crack_tip": {"method": TEXT, "position": [NUMBER], "direction": [NUMBER],
                  "radius": NUMBER},
    "crack_tips": [{"method": TEXT, "position": [NUMBER], "direction": [NUMBER],
                    "radius": NUMBER,
                    "K_I": {EACH: NUMBER}, "K_II": {EACH: NUMBER},
                    "energy_release_rate": {EACH: NUMBER},
                    "equivalent_intensity": {EACH: NUMBER}, "growth_angle": NUMBER,
                    "growth_angle_G": NUMBER, "Delta_K": NUMBER,
                    "Delta_K_I": NUMBER, "Delta_K_II": NUMBER,
                    "Delta_K_eff": NUMBER, "K_opening": NUMBER, "no_K_opening": TEXT,
                    "closed_part": {EACH: NUMBER}}],
    "creep_integrals": [{"position": [NUMBER], "direction": [NUMBER],
                         "radius": NUMBER, "largest": NUMBER, "last": NUMBER,
                         "error_of_largest": NUMBER, "error_of_last": NUMBER}],
    "crack_front": {"radius": NUMBER, "vertices": NUMBER, **dict.fromkeys(
        ("K_I", "K_II", "K_III"), {EACH: {
            "value": NUMBER, "t": NUMBER, "s": NUMBER, "position": [NUMBER]}})},
    "contact_solver": {}, "linear_solver": {}, "time_integration": {},
    "libraries": {}, "elastic_comparison": {},
    "refinement": {"meshes": [{}], "readaptations": [{}]},
    "warnings": [TEXT], "cells_of_ranks": [NUMBER],
    "stress_change": [NUMBER], "stress_error_estimate": [NUMBER],
    "periods": NUMBER, "converged": YES_OR_NO, "contact_nodes": NUMBER}


def read(path):
    """The summary, and sentences about what is wrong with it; None if there is no file.
    """
    try:
        summary = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        return {}, None
    except (OSError, ValueError) as error:
        return {}, [f"{error}"]
    if not isinstance(summary, dict):
        return {}, ["is not a summary"]
    wrong = [name for name, shape in SHAPES.items()
             if name in summary and not has_shape(summary[name], shape)]
    for name in wrong:
        del summary[name]
    return summary, [f"{name} is not what a run writes" for name in wrong]


def is_finite(number):
    """Whether a number of JSON, which may have hundreds of digits, is finite."""
    try:
        return math.isfinite(number)
    except OverflowError:
        return False


def has_shape(value, shape):
    """Whether a value has the expected shape. Unknown numbers and answers are null."""
    if isinstance(shape, list):
        return isinstance(value, list) and all(has_shape(item, shape[0])
                                               for item in value)
    if isinstance(shape, dict):
        return isinstance(value, dict) and all(
            has_shape(item, shape.get(name, shape.get(EACH)))
            for name, item in value.items())
    if shape == NUMBER:
        return value is None or (isinstance(value, (int, float))
                                 and not isinstance(value, bool)
                                 and is_finite(value))
    if shape == TEXT:
        return isinstance(value, str)
    if shape == YES_OR_NO:
        return value is None or isinstance(value, bool)
    return True
