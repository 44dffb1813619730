# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Quantities that runs are compared in: "stress", or "TABLE/COLUMN"."""

import difflib
import re

PROBE = ("u", "s", "u_1", "u_2", "u_3", "s_11", "s_22", "s_33", "s_12", "s_13",
         "s_23", "largest_shear_stress", "opening", "pressure")
TABLES = {"contact": ("force", "largest_pressure", "closed_nodes"),
          "periods": ("stress_change",), "load_work": ("load_work",),
          "crack_tip": ("K_I", "K_I_stress", "K_I_error", "energy_release_rate",
                        "strain_energy"),
          "crack_tip_N": ("K_I", "K_II", "K_I_error", "K_II_error",
                          "energy_release_rate", "growth_angle",
                          "equivalent_intensity", "T_stress", "growth_angle_G",
                          "K_I_singular", "K_II_singular"),
          "creep_integral": ("C_t", "C_t_error"),
          "creep_integral_N": ("C_t", "C_t_error")}
SAME_INSTANT = 1e-9  # of the period


def kind(table):
    """The kind of a table: crack_tip_N for the table of each tip between two lips."""
    return re.sub(r"^(crack_tip|creep_integral)_[1-9]\d*$", r"\1_N", table)


def has_two_lips(scene):
    return scene["Boundary/Crack"] not in ("", "none", "automatic")


def has_lip(scene):
    """Whether a scene has a lip: of a built-in crack, or on named boundaries."""
    if has_two_lips(scene):
        return True
    contact = scene["Boundary/Contact"]
    if contact == "automatic":
        return "crack" in scene["Geometry/Shape"]
    return contact not in ("", "none")


def selects(column, other):
    """Whether a column belongs to a quantity: "u" and "s" of a probe stand for all
    displacements and all stresses."""
    return other == column or column in ("u", "s") and other.startswith(column + "_")


def did_you_mean(word, words):
    near = difflib.get_close_matches(word, words, 1)
    return f"; did you mean \"{near[0]}\"?" if near else ""


def common_instants(one, other, period):
    """Rows of two ascending lists with the same t, and why a comparison at these
    says nothing: at rest all runs agree, and a few instants at which the load is zero
    may be all that adaptive steps have in common with others."""
    tolerance = SAME_INSTANT * period
    one, other = list(one), list(other)
    rows, i, j = [], 0, 0
    while i < len(one) and j < len(other):
        if abs(one[i] - other[j]) <= tolerance:
            rows.append((i, j))
            i, j = i + 1, j + 1
        elif one[i] < other[j]:
            i += 1
        else:
            j += 1
    fewer = min(len(one), len(other))
    objection = ""
    if not rows or one[rows[-1][0]] <= tolerance:
        objection = "only the instant t = 0 is common with the reference"
    # One of four, or ten a period.
    elif 4 * len(rows) < fewer and len(rows) < 10 * one[rows[-1][0]] / period:
        objection = (f"only {len(rows)} of {fewer} instants are common with the "
                     "reference: use multiples of the number of steps, or name "
                     "instants in [Time integration] Steps")
    return rows, objection
