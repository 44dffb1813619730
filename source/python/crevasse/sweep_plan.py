# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Which runs a sweep consists of: the product of all --vary, the last one changing
fastest."""

import dataclasses
import itertools
import math

from crevasse.command import CommandError
from crevasse.results import number

FORM = ("must have the form \"Section/Name=a,b,c\", with \";\" between values that "
        "contain commas, \" | \" between values that contain both, and \" & \" between "
        "parameters that change together")
OF_PROBLEM = ("Geometry", "Boundary", "Material", "Loads")
OF_MESH = ("Subdivisions", "Refinements")
LONGEST_NAME = 80
LONGEST_QUOTE = 120


@dataclasses.dataclass
class Axis:
    """One --vary: parameters that change together, and the values of each."""
    parameters: list
    values: list

    def numbers(self):
        """The values of the first parameter that has different positive numbers
        only; empty if there is none."""
        for texts in self.values:
            found = [number(text) for text in texts]
            if (len(found) > 1 and len(set(found)) == len(found) and all(
                    x is not None and 0 < x < math.inf for x in found)):
                return found
        return []


@dataclasses.dataclass
class Point:
    indices: list  # on each axis
    values: list  # of each varied parameter
    folder: str


class Plan:
    """Whether there are such parameters is not yet looked at."""

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
        # Orders are observed along the axis with the most numbers.
        self.numbers = max((axis.numbers() for axis in self.axes), key=len)
        self.main_axis = next((a for a, axis in enumerate(self.axes)
                               if self.numbers and axis.numbers() == self.numbers),
                              None)

    def point(self, indices):
        values = [texts[i] for axis, i in zip(self.axes, indices)
                  for texts in axis.values]
        return Point(list(indices), values, folder_name(self.parameters, values))

    def settings(self, point):
        """What a point sets besides the scene and --set."""
        return [f"{name}={value}"
                for name, value in zip(self.parameters, point.values)]

    def parameters_of_problem(self):
        """Those that change what is computed, and not only how."""
        return [name for name in self.parameters
                if name.split("/")[0] in OF_PROBLEM
                and name.partition("/")[2] not in OF_MESH]


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
    """At the separators that are not within brackets. One at the end does not begin
    another part."""
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
    """Cuts at the rarest separator: a value may contain those before it."""
    if " | " in text:
        return list(map(squeeze, text.split(" | ")))
    parts = split(text, ";")
    return parts if len(parts) > 1 or text.rstrip().endswith(";") else split(text, ",")


def read_axis(option, problems):
    axis = Axis([], [])
    for text in option.split(" & "):
        path, equals, values = text.partition("=")
        name = "/".join(map(squeeze, path.rsplit("/", 1)))
        if not equals or not name:
            problems.append(quote("--vary", option) + FORM)
            continue
        values = list_of_values(values)
        if not values or "" in values:
            problems.append(quote("--vary", option) + f"{name} lacks a value; it "
                            + FORM)
        axis.parameters.append(name)
        axis.values.append(values)
    for name, values in zip(axis.parameters[1:], axis.values[1:]):
        if len(values) != len(axis.values[0]):
            problems.append(
                quote("--vary", option) + f"{axis.parameters[0]} has "
                f"{len(axis.values[0])} values, but {name} has {len(values)}: "
                "parameters that change together must have as many")
    return axis


def digest(text):
    """Eight hexadecimal digits that tell texts apart (FNV-1a)."""
    hashed = 2166136261
    for byte in text.encode():
        hashed = (hashed ^ byte) * 16777619 % 2**32
    return f"{hashed:08x}"


def folder_name(parameters, values):
    """Says what varies, and stays the same if more values are added to a list."""
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
