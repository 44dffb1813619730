# Copyright (C) 2026 by the Crevasse authors
# SPDX-License-Identifier: LGPL-2.1-or-later

"""Reads what one run of Crevasse has written: parameters and
probes, and where the fields are."""

import argparse
import collections
import csv
import json
import os
import pathlib
import xml.etree.ElementTree as ElementTree

import numpy

Period = collections.namedtuple("Period", "number, begin, end")


class ResultsError(Exception):
    """Something is wrong with the results directory; the text says what."""


class RunFolder:
    """What a run has written until now, finished or not."""

    def __init__(self, directory):
        self.directory = pathlib.Path(directory)
        self.require_files("used.prm")
        self.parameters = read_parameters(self.directory / "used.prm")
        self.period = self.number("Loads/Period")
        self.probes = {name: point for name, point
                       in named_points(self.parameters.get("Output/Probes", ""))
                       if (self.directory / f"probe_{name}.csv").is_file()}

    def require_files(self, *names):
        if not self.directory.is_dir():
            raise ResultsError(f"{self.directory}: no such directory. Run the "
                               "scene first; its output directory is what is "
                               "needed.")
        for name in names:
            if not (self.directory / name).is_file():
                raise ResultsError(
                    f"{self.directory}: there is no {name}. This is not a "
                    "results directory, or its run has not finished.")

    def table(self, name):
        return read_csv(self.directory / name)

    def number(self, name):
        try:
            return float(self.parameters[name])
        except (KeyError, ValueError):
            raise ResultsError(f"{self.directory}/used.prm: {name} is not given "
                               "as a number.") from None

    def choose_probe(self, name=None):
        """The probe of that name; else C as in the paper, else the first."""
        if name is None:
            return "C" if "C" in self.probes else next(iter(self.probes), None)
        if name not in self.probes:
            raise ResultsError(f"{self.directory}: there is no probe {name}. "
                               f"Probes: {', '.join(self.probes) or 'none'}.")
        return name

    def history(self, probe, wanted):
        """Time series of a probe over a period (counted from 1; None: the last
        that is complete), and that period."""
        path = self.directory / f"probe_{probe}.csv"
        table = self.table(path.name)
        t = require(table, "t", path)
        slack = 1e-6 * self.period
        complete = int((t[-1] - t[0] + slack) // self.period)
        if complete < 1:
            raise ResultsError(f"{path}: ends at t = {t[-1]:g}, before the first "
                               f"period ({self.period:g}) is over.")
        number = wanted or complete
        if not 1 <= number <= complete:
            raise ResultsError(f"{path}: period {number} is not there; complete "
                               f"periods: 1 to {complete}.")
        begin = t[0] + (number - 1) * self.period
        inside = (t >= begin - slack) & (t <= begin + self.period + slack)
        return ({name: values[inside] for name, values in table.items()},
                Period(number, begin, begin + self.period))

    def instants(self):
        """(t, file) of every stored field; empty where none were wanted."""
        path = self.directory / "solution.pvd"
        if not path.is_file():
            return []
        try:
            return [(float(record.attrib["timestep"]),
                     self.directory / record.attrib["file"])
                    for record in read_xml(path).iter("DataSet")]
        except (KeyError, ValueError) as error:
            raise ResultsError(f"{path}: cannot be read ({error}).") from None

    def choose_instant(self, within_period):
        """The stored field nearest to that time within the period; of several
        that are equally near, the last."""
        def distance(instant):
            shift = (instant[0] - within_period) / self.period
            return round(abs(shift - round(shift)), 6)
        return min(reversed(self.instants()), key=distance)

    def cell_parts(self):
        """Each cell is written as degree x degree quadrilaterals."""
        return int(self.number("Discretisation/Degree")) ** 2


class Results(RunFolder):
    """A results directory of a finished run in two dimensions."""

    def __init__(self, directory):
        self.directory = pathlib.Path(directory)
        self.require_files("used.prm", "summary.json")
        super().__init__(directory)
        try:
            self.summary = json.loads(
                (self.directory / "summary.json").read_text(encoding="utf-8"))
        except (OSError, ValueError) as error:
            raise ResultsError(f"{directory}/summary.json: {error}.") from None
        if self.summary.get("dimension", 2) != 2:
            raise ResultsError(f"{directory}: the run is three-dimensional; "
                               "these figures are for two dimensions.")


def existing_program(text):
    """What a study's command line names; told if it is not there."""
    path = pathlib.Path(text)
    if not (path.is_file() and os.access(path, os.X_OK)):
        raise argparse.ArgumentTypeError(
            f"{text} is no program. cmake --build build makes build/crevasse.")
    return path


def read_xml(path):
    try:
        return ElementTree.parse(path).getroot()
    except (OSError, ElementTree.ParseError) as error:
        raise ResultsError(f"{path}: cannot be read ({error}).") from None


def read_csv(path):
    """The columns of a table by their names."""
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    if len(rows) < 3:
        raise ResultsError(f"{path}: has no more than one row of values; the run "
                           "has not finished.")
    try:
        values = numpy.array(rows[1:], dtype=float)
    except ValueError:
        raise ResultsError(f"{path}: has rows of unequal length or entries that "
                           "are not numbers.") from None
    return dict(zip(rows[0], values.T))


def require(table, name, path):
    if name not in table:
        raise ResultsError(f"{path}: there is no column {name}. Columns: "
                           f"{', '.join(table)}.")
    return table[name]


def read_parameters(path):
    """{"Section/Name": value} of deal.II's parameter format. Titles and names of
    files may be of any encoding."""
    values, section = {}, []
    try:
        text = path.read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        raise ResultsError(f"{path}: cannot be read ({error}).") from None
    for number, line in enumerate(text.splitlines(), 1):
        words = line.split("#")[0].strip()
        if words.startswith("subsection "):
            section.append(words.split(None, 1)[1])
        elif words == "end":
            if not section:
                raise ResultsError(f"{path}: line {number}: end without a "
                                   "subsection.")
            section.pop()
        elif words.startswith("set ") and "=" in words:
            name, value = words[4:].split("=", 1)
            values["/".join(section + [name.strip()])] = value.strip()
    return values


def named_points(text):
    """Name and coordinates of each entry of "A: 0, 0; B: 1, 0"."""
    for entry in filter(None, map(str.strip, text.split(";"))):
        name, _, point = entry.rpartition(":")
        try:
            yield name.strip(), tuple(map(float, point.split(",")))
        except ValueError:
            pass  # a formula or a form of a later version: not drawn
