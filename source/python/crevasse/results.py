# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Parameters, points, summaries and XML files, as runs write them. Parts of summaries
without the expected shape are left out and reported: a damaged or edited file may still
be JSON."""

import csv
import decimal
import io
import json
import math
import os
import pathlib
import re
import xml.etree.ElementTree as ElementTree
import zlib

import numpy


NAMES = ("Title", "Output directory", "Mesh file", "Temperature", "Files")
FILES = ("Geometry/Mesh file", "Loads/Temperature", "Tables/Files",
         "Crack tip/Growth table")  # whose values may be names of files
NUMBER = re.compile(r"(?<![\w.])(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?(?![\w.])")
A_NUMBER, A_TEXT, YES_OR_NO, NOTHING = "number", "text", "yes or no", "null"
EACH = "each"  # whatever its name is
ALONG_FRONT = {EACH: {"value": A_NUMBER, "t": A_NUMBER, "s": A_NUMBER, "position": [A_NUMBER]}}
# Shapes of what the pages look into; of the rest they show what is there.
SHAPES = {
    "effects": {EACH: {"on": YES_OR_NO, "why": A_TEXT}},
    "counters": {EACH: A_NUMBER},
    "certificate": {EACH: A_NUMBER},
    "seconds": {EACH: A_NUMBER}, "calls": {EACH: A_NUMBER}, "share": {EACH: A_NUMBER},
    "extremes": {EACH: A_NUMBER}, "no_largest_stress": A_TEXT, "closed_part": {EACH: A_NUMBER},
    "secular": {"on": YES_OR_NO, "opening_nodes": A_NUMBER,
                "per_probe": {EACH: {"beta": [A_NUMBER], "mean_pressure": A_NUMBER}}},
    "drift": {"per_probe": {EACH: [A_NUMBER]}},
    "crack_tip": {"method": A_TEXT, "position": [A_NUMBER], "direction": [A_NUMBER],
                  "radius": A_NUMBER},
    "crack_tips": [{"method": A_TEXT, "position": [A_NUMBER], "direction": [A_NUMBER],
                    "radius": A_NUMBER,
                    "K_I": {EACH: A_NUMBER}, "K_II": {EACH: A_NUMBER},
                    "energy_release_rate": {EACH: A_NUMBER},
                    "equivalent_intensity": {EACH: A_NUMBER}, "growth_angle": A_NUMBER,
                    "growth_angle_G": A_NUMBER, "Delta_K": A_NUMBER,
                    "Delta_K_I": A_NUMBER, "Delta_K_II": A_NUMBER,
                    "Delta_K_eff": A_NUMBER, "K_opening": A_NUMBER, "no_K_opening": A_TEXT,
                    "closed_part": {EACH: A_NUMBER}}],
    "creep_integrals": [{"position": [A_NUMBER], "direction": [A_NUMBER],
                         "radius": A_NUMBER, "largest": A_NUMBER, "last": A_NUMBER,
                         "error_of_largest": A_NUMBER, "error_of_last": A_NUMBER}],
    "crack_front": {"radius": A_NUMBER, "vertices": A_NUMBER, "K_I": ALONG_FRONT,
                    "K_II": ALONG_FRONT, "K_III": ALONG_FRONT,
                    "C_star": (NOTHING, ALONG_FRONT)},
    "contact_solver": {}, "linear_solver": {}, "time_integration": {},
    "libraries": {}, "elastic_comparison": {},
    "refinement": {"meshes": [{}], "readaptations": [{}]},
    "warnings": [A_TEXT], "cells_of_ranks": [A_NUMBER], "subdivisions": [A_NUMBER],
    "bars": {EACH: {EACH: A_NUMBER, "why": A_TEXT}}, "no_limit": {EACH: A_TEXT},
    "stress_change": [A_NUMBER], "stress_error_estimate": [A_NUMBER],
    "periods": A_NUMBER, "converged": YES_OR_NO, "contact_nodes": A_NUMBER}


class ResultsError(Exception):
    """Something is wrong with the results directory; the text says what."""


def number(text):
    """The number that a text is; None if it is none."""
    try:
        return float(text)
    except ValueError:
        return None


def shortest(value):
    """The shortest text that reads back as the same number."""
    if value is None:
        return ""
    value = float(value)  # whose repr, unlike that of NumPy 2, is a number alone
    digits = decimal.Decimal(repr(value)).normalize()
    places = len(digits.as_tuple().digits) - 1
    return min(format(digits, "f"), f"{value:.{places}e}", key=len)


def same_scenes(one, other):
    """Whether two texts of used.prm have the same values: 0.30 is 0.3, also in lists and
    formulas. Names, such as those of files, are compared as texts."""
    return normal_form(one) == normal_form(other)


def normal_form(text):
    values = {}
    for name, value in parse_parameters(text)[0].items():
        if name.rpartition("/")[2] not in NAMES:
            value = NUMBER.sub(lambda found: repr(float(found[0])), value)
            value = "".join(value.split())
        values[name] = value
    return values


def checksums(text):
    """{name: checksum} of the files that a text of used.prm names: another file with the
    same name makes another scene."""
    values = parse_parameters(text)[0]
    names = [part.strip() for name in FILES for part in values.get(name, "").split(",")]
    return {name: zlib.crc32(pathlib.Path(name).read_bytes())
            for name in names if os.path.isfile(name)}


def at(value, path):
    """Value of nested dictionaries at the end of a path; None if there is none."""
    for key in path:
        value = value.get(key) if isinstance(value, dict) else None
    return value


def read_parameters(path):
    """Reads a parameter file, whose titles and file names may have any encoding."""
    try:
        return parse_parameters(path.read_text(encoding="utf-8", errors="replace"),
                                path)
    except OSError as error:
        raise ResultsError(f"{path}: cannot be read ({error}).") from None


def parse_parameters(text, source="used.prm"):
    """({"Section/Name": value}, {"Section/Name": default}) of deal.II's parameter
    format; the program writes defaults of the parameters that differ from them."""
    values, defaults, section = {}, {}, []
    for line_number, line in enumerate(text.splitlines(), 1):
        words, mark, default = line.partition("# default:")
        words = words.split("#")[0].strip()
        if words.startswith("subsection "):
            section.append(words.split(None, 1)[1])
        elif words == "end":
            if not section:
                raise ResultsError(f"{source}: line {line_number}: end without a "
                                   "subsection.")
            section.pop()
        elif words.startswith("set ") and "=" in words:
            name, value = words[4:].split("=", 1)
            name = "/".join(section + [name.strip()])
            values[name] = value.strip()
            if mark:
                defaults[name] = default.strip()
    return values, defaults


def read_columns(text):
    """{column: values} of a table. Raises ValueError or csv.Error if it is damaged."""
    header, *rows = list(csv.reader(io.StringIO(text))) or [[]]
    for line, row in enumerate(rows, 2):
        if len(row) != len(header):
            raise ValueError(f"line {line} has {len(row)} of {len(header)} columns")
    return dict(zip(header, numpy.array(rows, dtype=float).reshape(
        -1, max(len(header), 1)).T))


def named_points(text):
    """Name and coordinates of each entry of "A: 0, 0; B: 1, 0"."""
    for entry in filter(None, map(str.strip, text.split(";"))):
        name, _, point = entry.rpartition(":")
        try:
            yield name.strip(), tuple(map(float, point.split(",")))
        except ValueError:
            pass  # a formula or a form of a later version: not drawn


def probes_of(parameters):
    """Probes {name: point} of a scene, also the automatic one."""
    text = parameters.get("Output/Probes", "")
    mouth = mouth_of_crack(parameters)
    if text == "automatic":
        return {"mouth": mouth} if mouth else {}
    return dict(named_points(text))


def mouth_of_crack(parameters):
    """Mouth of a built-in crack, as in parameters/automatic.cc; None without one."""
    x = number({"edge crack": parameters.get("Geometry/Width", ""), "centre crack": "0"
                }.get(parameters.get("Geometry/Shape"), ""))
    rest = (0., 0.) if parameters.get("Dimension") == "3" else (0.,)
    return None if x is None else (x, *rest)


def read_xml(path):
    try:
        return ElementTree.parse(path).getroot()
    except (OSError, ElementTree.ParseError) as error:
        raise ResultsError(f"{path}: cannot be read ({error}).") from None


def read_summary(path):
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


def is_number(value):
    """Whether a value of JSON is a finite number, which may have hundreds of digits."""
    try:
        return (isinstance(value, (int, float)) and not isinstance(value, bool)
                and math.isfinite(value))
    except OverflowError:
        return False


def has_shape(value, shape):
    """Whether a value has the expected shape, or one of several. Unknown numbers and answers
    are null."""
    if isinstance(shape, tuple):
        return any(has_shape(value, one) for one in shape)
    if isinstance(shape, list):
        return isinstance(value, list) and all(has_shape(item, shape[0])
                                               for item in value)
    if isinstance(shape, dict):
        return isinstance(value, dict) and all(
            has_shape(item, shape.get(name, shape.get(EACH)))
            for name, item in value.items())
    if shape == NOTHING:
        return value is None
    if shape == A_NUMBER:
        return value is None or is_number(value)
    if shape == A_TEXT:
        return isinstance(value, str)
    if shape == YES_OR_NO:
        return value is None or isinstance(value, bool)
    return True
