# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Reads what a run has written, whole or not, and notes what is damaged."""

import collections
import csv
import pathlib
import re

import numpy

from crevasse.results import (ResultsError, at, is_number, number, probes_of,
                              read_columns, read_parameters, read_summary, read_xml)
from crevasse.wording import in_units

Period = collections.namedtuple("Period", "number, begin, end")

# Tables in which "nan" means unknown.
MAY_BE_UNKNOWN = {"periods.csv": ("stress_change", "stress_error_estimate"),
                  "crack_tip_": ("growth_angle", "growth_angle_G")}
ROW_A_STEP = ("probe_", "contact.", "crack_tip.", "crack_tip_", "load_work.")
TABLES_OF_EFFECTS = {"contact": ("contact.csv", "contact.csv"),  # plane, space
                     "stress intensity": ("crack_tip.csv", "crack_front.csv")}
# Columns that the charts take; a later version may have others, too.
COLUMNS = {"probe_": ("t", "u_1", "s_11"),
           "contact.": ("t", "closed_nodes", "force", "largest_pressure"),
           "friction.": ("t", "lip", "x", "y", "state"),
           "lip.": ("lip", "x", "y", "closed_part"),
           "crack_tip.": ("t", "K_I", "energy_release_rate"),
           "crack_tip_": ("t", "K_I", "K_II", "energy_release_rate", "growth_angle",
                          "equivalent_intensity"),
           "crack_front.": ("t", "front", "s"),
           "creep_integral": ("t", "C_t"),
           "load_work.": ("t", "load_work"),
           "periods.": ("period", "t_end", "stress_change",
                        "stress_error_estimate"),
           "relaxation.": ("relaxation_factor", "iterations")}
MATERIALS = re.compile(r"^  materials: (.*)$", re.M)
MATERIAL = re.compile(r"(\d+) \((.+?)\): \d+ cells?(?:, |$)")


class Run:
    """One run, finished or not. Its summary is empty as long as it has none, and
    what cannot be read is in the list of damages and nowhere else."""

    def __init__(self, directory):
        self.directory = pathlib.Path(directory)
        if not self.directory.is_dir():
            raise ResultsError(f"{directory}: no such directory. Run the scene "
                               "first, and give its output directory.")
        if not (self.directory / "used.prm").is_file():
            raise ResultsError(f"{directory}: there is no used.prm. This is not the "
                               "output directory of a run.")
        self.parameters, self.defaults = read_parameters(self.directory / "used.prm")
        self.period = self.number("Loads/Period")
        if not self.period > 0:
            raise ResultsError(f"{directory}/used.prm: Loads/Period = "
                               f"{self.period:g} is not a period.")
        self.damages = []
        self.log = self.read_log()
        self.finished, self.summary = self.read_summary()
        self.tables = {}
        for path in sorted(self.directory.glob("*.csv")):
            if path.name.startswith(tuple(COLUMNS)):  # not what others left there
                self.read_table(path)
        if self.finished:
            self.require_tables()
            self.compare_lengths()
        self.probes = {name: point for name, point in probes_of(self.parameters).items()
                       if f"probe_{name}.csv" in self.tables}

    def parameter(self, name):
        return self.parameters.get(name, "")

    def in_units(self, label):
        """A label with the units of the scene, if these are known."""
        return in_units(label, self.parameter("Units"))

    def number(self, name):
        value = number(self.parameter(name))
        if value is None:
            raise ResultsError(f"{self.directory}/used.prm: {name} is not given as a "
                               "number.")
        return value

    def read_log(self):
        """The log of the last start; a run that was resumed has several."""
        try:
            text = (self.directory / "log.txt").read_text(encoding="utf-8",
                                                          errors="replace")
        except OSError:
            return ""
        starts = [match.start() for match
                  in re.finditer(r"^Crevasse \d\S*: ", text, re.M)]
        return text[starts[-1]:] if starts else text

    @property
    def material_names(self):
        """Physical names {material id: name} in the mesh file, of ids that have one."""
        text = MATERIALS.search(self.log)
        return {int(id): name for id, name
                in MATERIAL.findall(text[1] if text else "")}

    def read_summary(self):
        """Reads the summary, and whether there is one. A run that is resumed removes
        it at any moment."""
        path = self.directory / "summary.json"
        summary, troubles = read_summary(path)
        for trouble in troubles or ():
            self.note(path, trouble)
        return troubles is not None, summary or {}

    @property
    def dimension(self):
        return 3 if self.parameter("Dimension") == "3" else 2

    def read_table(self, path):
        """Reads a table if it is whole. The last row of a run in progress may be half
        written and is left out then; one that is resumed replaces its tables."""
        try:
            text = path.read_text(encoding="utf-8")
            if not self.finished:
                text = text[:text.rfind("\n") + 1]
            table = read_columns(text)
        except FileNotFoundError:
            return None
        except (OSError, ValueError, csv.Error) as error:
            return self.note(path, f"{error}")
        if not table:
            return self.note(path, "is empty") if self.finished else None
        if trouble := self.trouble_with(path.name, table):
            return self.note(path, trouble)
        if len(next(iter(table.values()))):
            self.tables[path.name] = table

    def trouble_with(self, name, table):
        """The mistake in columns or numbers; None if there is none."""
        for column in next(columns for begin, columns in COLUMNS.items()
                           if name.startswith(begin)):
            if column not in table:
                return f"has no column {column}"
        for column, values in table.items():
            if (any(name.startswith(begin) and column in unknown
                    for begin, unknown in MAY_BE_UNKNOWN.items())
                    or name == "relaxation.csv"):
                continue
            bad = numpy.flatnonzero(~numpy.isfinite(values))
            if len(bad):
                return (f"line {bad[0] + 2}: {column} is {values[bad[0]]:g}")
        t = table.get("t", numpy.zeros(0))
        back = numpy.flatnonzero(numpy.diff(t) < 0)
        if len(back):
            return f"line {back[0] + 3}: t goes back"
        if name.startswith(ROW_A_STEP) and not len(t):
            return "has no row" if self.finished else None
        return None

    def require_tables(self):
        """Notes tables that a finished run must have written and has not."""
        if self.summary.get("periods") == 0:
            return
        names = ["periods.csv"]
        names += [f"probe_{name}.csv" for name in probes_of(self.parameters)]
        names += [of_dimension[self.dimension - 2]
                  for effect, of_dimension in TABLES_OF_EFFECTS.items()
                  if self.summary.get("effects", {}).get(effect, {}).get("on")]
        if tips := self.summary.get("crack_tips"):  # with two lips
            names = [name for name in names if name != "crack_tip.csv"]
            names += [f"crack_tip_{k}.csv" for k, tip in enumerate(tips, 1)
                      if "no_K" not in tip]
        for name in names:
            if not (self.directory / name).is_file():
                self.note(self.directory / name, "is missing")

    def compare_lengths(self):
        """Notes tables of a finished run that are shorter than others: each has a row
        for each step, and a shorter one would look as if nothing happened later."""
        lengths = {name: len(table["t"]) for name, table in self.tables.items()
                   if "t" in table and name.startswith(ROW_A_STEP)}
        longest = max(lengths.values(), default=0)
        for name, length in lengths.items():
            if length < longest:
                self.note(self.directory / name,
                          f"ends after {length} rows, others have {longest}")
                del self.tables[name]

    def history(self, probe, wanted=None):
        """Time series of a probe over a period (counted from 1; None: the last
        that is complete), and that period."""
        name = f"probe_{probe}.csv"
        if name not in self.tables:
            raise ResultsError(f"{self.directory}: there is no probe {probe} with "
                               f"rows. Probes: {', '.join(self.probes) or 'none'}.")
        t = self.tables[name]["t"]
        slack = 1e-6 * self.period
        complete = int((t[-1] - t[0] + slack) // self.period)
        if complete < 1:
            raise ResultsError(f"{self.directory}/{name}: ends at t = {t[-1]:g}, "
                               f"before the end of the first period ({self.period:g}).")
        period = wanted or complete
        if not 1 <= period <= complete:
            raise ResultsError(f"{self.directory}/{name}: period {period} is not "
                               f"there; complete periods: 1 to {complete}.")
        begin = t[0] + (period - 1) * self.period
        inside = (t >= begin - slack) & (t <= begin + self.period + slack)
        return ({column: values[inside]
                 for column, values in self.tables[name].items()},
                Period(period, begin, begin + self.period))

    def instants(self):
        """Pairs (t, file) of all stored fields; empty without fields."""
        path = self.directory / "solution.pvd"
        try:
            return [(float(record.attrib["timestep"]),
                     self.directory / record.attrib["file"])
                    for record in read_xml(path).iter("DataSet")]
        except ResultsError:
            if path.is_file():
                raise
            return []
        except (KeyError, ValueError) as error:
            raise ResultsError(f"{path}: cannot be read ({error}).") from None

    def choose_instant(self, within_period):
        """The stored field nearest to that time within the period; of several
        that are equally near, the last."""
        def distance(instant):
            shift = (instant[0] - within_period) / self.period
            return round(abs(shift - round(shift)), 6)
        return min(reversed(self.instants()), key=distance)

    def note(self, path, trouble):
        self.damages.append(f"{path.name}: {trouble.rstrip('.')}.")

    def summary_number(self, *names):
        """A number of the summary by its path; None if there is none."""
        value = at(self.summary, names)
        return value if is_number(value) else None
