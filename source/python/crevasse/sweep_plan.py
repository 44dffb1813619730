# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Which runs a sweep consists of: the product of all --vary, the last one changing
fastest."""

import dataclasses
import fractions
import itertools
import math

from crevasse.command import CommandError
from crevasse.results import number, shortest

FORM = ("must have the form \"Section/Name=a,b,c\" or \"Section/Name=first:last:count\", "
        "with \";\" between values that contain commas, \" | \" between values that "
        "contain both, and \" & \" between parameters that change together")
OF_PROBLEM = ("Geometry", "Boundary", "Material", "Loads")
OF_MESH = ("Subdivisions", "Refinements")
LONGEST_NAME = 80
LONGEST_QUOTE = 120
MOST_IN_RANGE = 10000


@dataclasses.dataclass
class Axis:
    """One --vary: parameters that change together, and the values of each."""
    parameters: list
    values: list

    def refinement(self):
        """The values of the first numerical setting that each value halves or doubles;
        empty if there is none: then errors have no orders."""
        for name, texts in zip(self.parameters, self.values):
            found = [number(text) or 0 for text in texts]
            if (not is_of_problem(name) and len(found) > 1 and 0 < min(found)
                    and max(found) < math.inf and any(all(
                        math.isclose(b, factor * a) for a, b in zip(found, found[1:]))
                        for factor in (0.5, 2))):
                return found
        return []


@dataclasses.dataclass
class Point:
    indices: list  # on each axis
    values: list  # of each varied parameter
    folder: str


class Plan:
    """The points of a sweep. Whether its parameters exist is not yet checked."""

    def __init__(self, texts):
        problems = [] if texts else ["A sweep needs a list of values: --vary "
                                     "\"Section/Name=a,b,c\""]
        self.axes, self.parameters = [], []
        for text in texts:
            self.axes.append(read_axis(text, problems))
            for name in self.axes[-1].parameters:
                if name in self.parameters:
                    problems.append(quote("--vary", text) + f"{name} is varied twice; "
                                    "parameters that change together belong into one "
                                    "--vary")
                if name == "Output directory":
                    problems.append(quote("--vary", text) + "each point has a folder "
                                    "of its own below --output")
                self.parameters.append(name)
        require_none(problems)
        self.points = [self.point(indices) for indices in itertools.product(
            *(range(len(axis.values[0])) for axis in self.axes))]
        # Orders are observed along the axis that refines most often.
        refinements = [axis.refinement() for axis in self.axes]
        self.numbers = max(refinements, key=len)
        self.main_axis = refinements.index(self.numbers) if self.numbers else None

    def point(self, indices):
        values = [texts[i] for axis, i in zip(self.axes, indices)
                  for texts in axis.values]
        return Point(list(indices), values, folder_name(self.parameters, values))

    def settings(self, point):
        """Settings of a point in addition to the scene and --set."""
        return [f"{name}={value}"
                for name, value in zip(self.parameters, point.values)]

    def parameters_of_problem(self):
        """Varied parameters that change the problem, not only its solution."""
        return list(filter(is_of_problem, self.parameters))


def is_of_problem(name):
    section, _, last = name.partition("/")
    return section in OF_PROBLEM and last not in OF_MESH


def require_none(problems):
    if problems:
        many = f"{len(problems)} problems:\n" if len(problems) > 1 else ""
        raise CommandError(many + "\n".join(problems), 2)


def shorten(text):
    return text if len(text) <= LONGEST_QUOTE else text[:LONGEST_QUOTE] + "..."


def quote(option, text):
    return f"{option} \"{shorten(text)}\": "


def squeeze(text):
    return " ".join(text.split())


def split(text, separator):
    """Splits a text at the separators that are not within brackets. A separator at the
    end does not begin another part."""
    parts, depth = [""], 0
    for character in text:
        depth += (character == "(") - (character == ")")
        if character == separator and depth == 0:
            parts.append("")
        else:
            parts[-1] += character
    parts = list(map(str.strip, parts))
    return parts if parts[-1] else parts[:-1]


def list_of_values(text):
    """Splits a list at its rarest separator: a value may contain more frequent ones."""
    if " | " in text:
        return list(map(squeeze, text.split(" | ")))
    parts = split(text, ";")
    return parts if len(parts) > 1 or text.rstrip().endswith(";") else split(text, ",")


def expand(text):
    """The values of a range "first:last:count" as texts; any other text itself. There
    may be colons in names, too."""
    parts = text.split(":")
    numbers = [number(part) for part in parts]
    if len(parts) not in (2, 3) or sum(x is not None for x in numbers) < 2:
        return [text]
    if len(parts) == 2:
        raise ValueError(f"lacks the number of values: {text}:11 has 11")
    if None in numbers or not all(map(math.isfinite, numbers)):
        raise ValueError("has a part that is not a finite number")
    first, last = (fractions.Fraction(part.strip()) for part in parts[:2])
    count = int(numbers[2])
    if count != numbers[2] or not 2 <= count <= MOST_IN_RANGE:
        raise ValueError(f"has {parts[2].strip()} values: give a whole number from 2 to "
                         f"{MOST_IN_RANGE}; write a single value without colons")
    if first == last:
        raise ValueError("begins where it ends: give two different numbers")
    exact = (first + (last - first) * k / (count - 1) for k in range(count))
    return [str(value) if value.denominator == 1 and abs(value) < 1e15
            else shortest(float(value)) for value in exact]


def read_values(option, name, text, problems):
    values = list_of_values(text)
    if not values or "" in values:
        problems.append(quote("--vary", option) + f"{name} lacks a value; it " + FORM)
    expanded = []
    for value in values:
        try:
            expanded += expand(value)
        except ValueError as error:
            problems.append(quote("--vary", option) + f"the range {shorten(value)} of "
                            f"{name} {error}. Ranges are first:last:count, as 0.1:0.6:11")
            expanded.append(value)
    return expanded


def read_axis(option, problems):
    axis = Axis([], [])
    for text in option.split(" & "):
        path, equals, values = text.partition("=")
        name = "/".join(map(squeeze, path.rsplit("/", 1)))
        if not equals or not name:
            problems.append(quote("--vary", option) + FORM)
            continue
        axis.parameters.append(name)
        axis.values.append(read_values(option, name, values, problems))
    for name, values in zip(axis.parameters[1:], axis.values[1:]):
        if len(values) != len(axis.values[0]):
            problems.append(
                quote("--vary", option) + f"{axis.parameters[0]} has "
                f"{len(axis.values[0])} values, but {name} has {len(values)}: "
                "parameters that change together must have as many")
    return axis


def digest(text):
    """Eight hexadecimal digits that distinguish texts (FNV-1a)."""
    hashed = 2166136261
    for byte in text.encode():
        hashed = (hashed ^ byte) * 16777619 % 2**32
    return f"{hashed:08x}"


def folder_name(parameters, values):
    """Folder of a point, which does not change if a list gets more values."""
    def safe(text, allowed):
        return "".join(chr(byte) if chr(byte) in allowed or byte < 128
                       and chr(byte).isalnum() else "_" for byte in text.encode())
    name = "__".join(f"{safe(parameter.split('/')[-1], '').lower()}_{safe(value, '.-+')}"
                     for parameter, value in zip(parameters, values))
    faithful = all(safe(value, ".-+ ") == value for value in values)
    if faithful and len(name) <= LONGEST_NAME:
        return name
    return name[:LONGEST_NAME] + "__" + digest("".join(
        f"{parameter}={value}\n" for parameter, value in zip(parameters, values)))
