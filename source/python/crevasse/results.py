# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Parameters, points and XML files, as runs write them."""

import decimal
import re
import xml.etree.ElementTree as ElementTree


NAMES = ("Title", "Output directory", "Mesh file", "Temperature")
NUMBER = re.compile(r"(?<![\w.])(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?(?![\w.])")


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
