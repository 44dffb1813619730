# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Numbers and units of measurement as text."""

import math
import re

from crevasse.results import number

MINUS = "\N{MINUS SIGN}"
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


FORCES = {("mm", "MPa"): "N", ("m", "Pa"): "N", ("m", "kPa"): "kN", ("m", "MPa"): "MN",
          ("mm", "GPa"): "kN", ("in", "psi"): "lbf", ("in", "ksi"): "kip"}


def in_units(label, units):
    """A label whose unit is in words, such as "K (stress × √length)" or "length / time",
    with the units that [Units] names; the label itself where it names none."""
    names = [name.strip() for name in units.split(",")]
    if len(names) != 4:
        return label
    length, stress, time, _ = names
    over_area = re.fullmatch(rf"(\w+)/{length}\^?2", stress)  # kgf/mm2
    words = {"length": length, "stress": stress, "time": time,
             "force": over_area[1] if over_area else
             FORCES.get((length, stress), f"{stress} {length}²")}

    def named(match):
        return re.sub("length|stress|time|force", lambda word: words[word[0]], match[0])
    unit = r"√?(length|stress|time|force)( [×/] \(?√?(length|stress|time|force)|\))*"
    if re.fullmatch(unit, label):
        return re.sub(".+", named, label)
    return re.sub(rf"\({unit}\)", named, label)


def significant(value, digits=4):
    """A number with that many digits, and a power of ten where it would be long."""
    if value is None:
        return "–"
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return str(value)
    if not math.isfinite(value):
        return "not known"
    if value == 0:
        return "0"
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    power = int(exponent)
    if -4 <= power < 6:
        text = f"{float(f'{value:.{digits}g}'):.{max(digits - 1 - power, 0)}f}"
        if "." in text:
            text = text.rstrip("0").rstrip(".")
    else:
        if "." in mantissa:
            mantissa = mantissa.rstrip("0").rstrip(".")
        text = f"{mantissa} · 10{str(power).translate(SUPERSCRIPTS)}"
    return text.replace("-", MINUS, 1) if value < 0 else text


def measured(text, digits=4):
    """A number of a table with significant digits; empty without a number."""
    value = number(text)
    return text if value is None else significant(value, digits)


def whole(value):
    """An integer in groups of three digits."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return "–" if value is None else str(value)
    return f"{value:,.0f}".replace(",", "\N{NO-BREAK SPACE}")


def seconds(value):
    if not isinstance(value, (int, float)) or not math.isfinite(value):
        return "–"
    if value < 120:
        return f"{significant(value, 3)} s"
    minutes, rest = divmod(round(value), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours} h {minutes} min" if hours else f"{minutes} min {rest} s"


def subscripts(label):
    """HTML with subscripts, for symbols such as K_I and ΔK_eff."""
    return re.sub(r"_(\w+)", r"<sub>\1</sub>", label)


def megabytes(value):
    if not isinstance(value, (int, float)):
        return "–"
    return f"{whole(value / 1e6)} MB"


def plural(count, noun):
    return f"{whole(count)} {noun}" + ("" if count == 1 else "s")
