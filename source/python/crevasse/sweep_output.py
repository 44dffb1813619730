# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The results of a sweep as sweep.csv, sweep.md and sweep.json, all three written as a
whole after each point, and sweep.tex, written at its end."""

import csv
import dataclasses
import io
import json
import math
import typing

from crevasse import findings
from crevasse.command import write_file
from crevasse.program import COSTS, without_numbers
from crevasse.results import shortest

FOR_PEOPLE = {"vi_solves": "VIs", "linear_solves": "linear solves",
              "factorisations": "factorisations",
              "rate_evaluations": "rate evaluations", "seconds": "seconds",
              "seconds_time_stepping": "stepping (s)", "processor_seconds": "CPU (s)",
              "peak_memory_bytes": "memory (MB)"}
MOST_NUMBERS = 3  # in a line


@dataclasses.dataclass
class Column:
    name: str  # in sweep.csv
    title: str
    text: typing.Callable  # of the number of a point
    is_number: bool = True

    def is_called(self, name):
        return name in (self.name, self.name.split("/")[-1], self.title)


class Output:
    def __init__(self, plan, quantities, title, reference, columns=""):
        self.plan, self.quantities = plan, list(quantities)
        self.title, self.reference = title, reference
        self.wanted = [name.strip() for name in columns.split(",") if name.strip()]
        self.reference_result = None
        self.results = {}  # by the numbers of the points

    def write(self, directory):
        write_file(directory / "sweep.csv", self.csv())
        write_file(directory / "sweep.md", self.markdown())
        write_file(directory / "sweep.json",
                   json.dumps(self.json(), indent=2, ensure_ascii=False) + "\n")

    def points(self):
        """Number, point and result of each finished point."""
        return [(p, self.plan.points[p], result)
                for p, result in sorted(self.results.items())]

    def findings(self):
        """Names of the findings that any point has."""
        return sorted({name for result in self.results.values()
                       for name in result.findings}, key=findings.place)

    def bars(self):
        """Names of the findings that have an error bar at any point."""
        return {name for result in self.results.values() for name in result.bars}

    def error(self, p, quantity):
        return self.results[p].errors.get(quantity, {}).get("value")

    def predecessor(self, p):
        """The point before this one along the main axis that has results, alike on
        the other axes; None if there is none."""
        def others(point):
            return point.indices[:axis] + point.indices[axis + 1:]
        axis, points = self.plan.main_axis, self.plan.points
        return None if axis is None else next(
            (q for q in range(p - 1, -1, -1) if others(points[q]) == others(points[p])
             and q in self.results and self.results[q].has_results), None)

    def order(self, p, quantity):
        """Order p of an error ~ number^-p from the predecessor to this point."""
        before = self.predecessor(p)
        if before is None:
            return None
        errors = self.error(before, quantity), self.error(p, quantity)
        if not all(errors):
            return None
        ends = (self.plan.numbers[self.plan.points[q].indices[self.plan.main_axis]]
                for q in (p, before))
        return (-math.log(errors[1] / errors[0])
                / math.log(next(ends) / next(ends)))

    def warnings(self):
        """Warnings of all runs, one of each kind, and how many points have it."""
        kinds = {}
        n = len(self.results)
        for p, result in [*sorted(self.results.items()), (-1, self.reference_result)]:
            for text in result.warnings if result else []:
                texts, where = kinds.setdefault(without_numbers(text), ([], set()))
                texts.append(text)
                where.add(p)
        for texts, where in kinds.values():
            remarks = (["reference"] if where == {-1} else
                       [f"{len(where - {-1})} of {n} points"]
                       if where - {-1} < set(self.results) else [])
            if len(set(texts)) > 1:
                remarks.append("numbers of the first")
            yield texts[0] + (f" ({', '.join(remarks)})" if remarks else "")

    def csv(self):
        text = io.StringIO()
        table = csv.writer(text, lineterminator="\n")
        has_orders = self.plan.main_axis is not None
        names, bars, costs = self.findings(), self.bars(), (*COSTS, "jobs")
        table.writerow(["point", *self.plan.parameters, "status", *names,
                        *("bar:" + name for name in names if name in bars),
                        *(what + quantity for quantity in self.quantities for what in
                          ("error:", *["order:"] * has_orders, "instants:")),
                        *costs, "message"])
        for p, point, result in self.points():
            cells = [shortest(result.findings.get(name)) for name in names]
            cells += [shortest(result.bars.get(name)) for name in names if name in bars]
            for quantity in self.quantities:
                cells += [shortest(self.error(p, quantity)),
                          *[formatted(self.order(p, quantity), "%.3f")] * has_orders,
                          result.errors.get(quantity, {}).get("instants", "")]
            table.writerow([point.folder, *point.values, result.status, *cells,
                            *(json.dumps(result.costs[name]) if name in result.costs
                              else "" for name in costs),
                            result.message.replace("\n", " ")])
        return text.getvalue()

    def json(self):
        reference = {"description": self.reference} if self.reference else {}
        if self.reference_result:
            reference["costs"] = self.reference_result.costs
        return {"title": self.title, "parameters": self.plan.parameters,
                "quantities": self.quantities, "reference": reference,
                "warnings": list(self.warnings()),
                "points": [{"folder": point.folder,
                            "values": dict(zip(self.plan.parameters, point.values)),
                            "results": result.findings, "bars": result.bars,
                            **result.as_json()}
                           for _, point, result in self.points()]}

    def markdown(self):
        text = f"# {self.title}\n\n"
        if self.reference:
            costs = (f" ({costs_in_words(self.reference_result)})"
                     if self.reference_result else "")
            text += f"{self.reference}{costs}.\n\n"
        shown = self.shown()
        text += row([column.title for column in shown])
        text += row(["---:" if column.is_number else "---" for column in shown])
        for p, *_ in self.points():
            text += row([column.text(p) for column in shown])
        warnings = "".join(f"- {warning}\n" for warning in self.warnings())
        return (text + "".join(self.notes())
                + (f"\nWarnings:\n\n{warnings}" if warnings else ""))

    def latex(self):
        """A table for a paper, with the rules of the package booktabs."""
        import pandas  # slow
        shown = self.shown()
        frame = pandas.DataFrame([[column.text(p) for column in shown]
                                  for p, *_ in self.points()],
                                 columns=[column.title for column in shown])
        return (frame.style.hide(axis="index").format(escape="latex")
                .format_index(escape="latex", axis="columns").to_latex(
                    hrules=True, column_format="".join(
                        "r" if column.is_number else "l" for column in shown)))

    def columns(self):
        """The columns of the tables for people."""
        bars = self.bars()
        for k, name in enumerate(self.plan.parameters):
            yield Column(name, self.short_name(name),
                         lambda p, k=k: self.plan.points[p].values[k])
        for name in self.findings():
            yield Column(name, name, lambda p, name=name: formatted(
                self.results[p].findings.get(name), "%.5g"))
            if name in bars:
                yield Column("bar:" + name, f"bar of {name}", lambda p, name=name:
                             formatted(self.results[p].bars.get(name), "%.1g"))
        for name in self.quantities:
            yield Column("error:" + name, f"error of {name}",
                         lambda p, name=name: formatted(self.error(p, name), "%.1e"))
            if self.plan.main_axis is not None:
                yield Column("order:" + name, "order",
                             lambda p, name=name: formatted(self.order(p, name), "%.2f"))
        for name, title in FOR_PEOPLE.items():
            yield Column(name, title, lambda p, name=name: cost(self.results[p], name))
        yield Column("status", "status", lambda p: self.results[p].status, False)

    def shown(self):
        """Those of the columns that --columns names, in its order, or else all."""
        columns = list(self.columns())
        return [column for wanted in self.wanted for column in columns
                if column.is_called(wanted)] or columns

    def unknown_columns(self):
        """What --columns names, but no run has."""
        columns = list(self.columns())
        return [wanted for wanted in self.wanted
                if not any(column.is_called(wanted) for column in columns)]

    def notes(self):
        if any(result.costs.get("jobs", 1) > 1 for result in self.results.values()):
            yield ("\nSeveral points were computed at a time, so that each took longer. To "
                   "compare wall times, use --jobs 1 and another --output.\n")
        begin = "\nRemarks:\n\n"
        for p, _, result in self.points():
            remarks = [f"{result.status}. " + result.message.replace("\n", " ")
                       ] if result.message else []
            remarks += [f"no error of {quantity}, because "
                        f"{result.errors[quantity]['reason']}."
                        for quantity in self.quantities
                        if result.errors.get(quantity, {}).get("reason")]
            for remark in remarks:
                yield f"{begin}- {self.values(p)}: {remark}\n"
                begin = ""

    def short_name(self, parameter):
        """Name of a parameter without its section, where that is enough."""
        last = parameter.split("/")[-1]
        namesakes = [other for other in self.plan.parameters
                     if other.split("/")[-1] == last]
        return last if len(namesakes) == 1 else parameter

    def values(self, p):
        """Values of a point, such as "Scheme = heun, Steps per period = 20"."""
        return ", ".join(f"{self.short_name(parameter)} = {value}" for parameter, value
                         in zip(self.plan.parameters, self.plan.points[p].values))

    def line(self, p):
        """A point in one line: values, errors, costs."""
        result = self.results[p]
        if not result.has_results:
            return f"{self.values(p)}: {result.status}"
        errors = [f"{quantity} " + formatted(self.error(p, quantity), "%.1e")
                  for quantity in self.quantities
                  if self.error(p, quantity) is not None]
        numbers = {}  # K_I of a constant load once
        for name, value in result.findings.items():
            numbers.setdefault(value, f"{findings.label(name)} {value:.5g}")
        found = ("error of " + ", ".join(errors[:MOST_NUMBERS]) if errors else
                 "no error" if self.quantities else 
                 ", ".join([*numbers.values()][:MOST_NUMBERS]))
        text = f"{self.values(p)}: {found}; {costs_in_words(result)}"
        return text if result.status == "done" else f"{text}; {result.status}"


def formatted(value, form):
    return "" if value is None else form % value


def row(cells):
    return "| " + " | ".join(cell.replace("|", "\\|").replace("\n", " ")
                             for cell in cells) + " |\n"


def cost(result, name):
    value = result.costs.get(name)
    if name == "peak_memory_bytes":
        return formatted(value and 1e-6 * value, "%.0f")
    if isinstance(value, float):
        return ("%.2g" if value < 10 else "%.1f") % value
    return "" if value is None else json.dumps(value)


def costs_in_words(result):
    has_contact = cost(result, "vi_solves") != "0"
    solves = (cost(result, "vi_solves") + " VIs" if has_contact else
              cost(result, "linear_solves") + " linear solves")
    return f"{solves}, {cost(result, 'seconds')} s"
