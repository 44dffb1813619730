# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The quantities of a sweep, and the errors of its points: the largest difference
over the largest value of the reference, at all instants that both have."""

import math

import numpy

from crevasse.command import CommandError
from crevasse.quantities import (PROBE, TABLES, Table, common_instants, compare,
                                 depends_on_constant, did_you_mean, has_lip, kind,
                                 without_means)
from crevasse.results import ResultsError, probes_of
from crevasse.sweep_plan import quote, require_none, shorten, split, squeeze

STRESS = "stress"
STRESS_FILE = "stress_samples.bin"
MARK = int.from_bytes(b"CSTRESS2", "little")


def choose_quantities(options, scenes, program):
    """{name: formula or None}: those of --error and --exact, or, where there is a
    reference but no --error, the stress, u and s of every probe, and the contact
    force; nothing without a reference. The reference's scene is the first."""
    probes = list(dict.fromkeys(
        name for scene in scenes for name in probes_of(scene)))
    tables = TABLES | {f"probe_{probe}": PROBE for probe in probes}
    problems, chosen = [], {}
    if options.error:
        for name in split(options.error, ","):
            if problem := problem_of(name, tables):
                problems.append(f"--error {shorten(name)}: {problem}")
            else:
                chosen[name] = None
    elif options.reference:
        chosen = dict.fromkeys([STRESS, *(f"probe_{probe}/{kind}"
                                          for probe in probes for kind in "us"),
                                *["contact/force"] * has_lip(scenes[0])])
    for text in options.exact:
        name, equals, formula = text.partition("=")
        name = squeeze(name)
        problem = (problem_of(name, tables) if equals else
                   "must have the form \"QUANTITY=formula of t\"")
        problem = problem or problem_with_formula(name, formula, program)
        if not problem and chosen.get(name) is not None:
            problem = "has two closed forms"
        if problem:
            problems.append(quote("--exact", text) + problem)
        else:
            chosen[name] = formula
    require_none(problems)
    for name, formula in chosen.items():
        if formula is None and not options.reference:
            raise CommandError(
                f"There is nothing to compare {name} with: give a run that is accurate "
                "enough, --reference \"Section/Name=value\", or a closed form, --exact "
                f"\"{name}=formula of t\".", 2)
    return chosen


def problem_of(name, tables):
    """Mistake in the name of a quantity; None if there is none."""
    table, slash, column = name.partition("/")
    if name == STRESS or slash and column in tables.get(kind(table), ()):
        return None
    if slash and kind(table) in tables:
        return (f"has no column \"{shorten(column)}\"; columns are: "
                + ", ".join(tables[kind(table)]))
    return ("is not a quantity; allowed are \"stress\" and \"TABLE/COLUMN\" with a "
            "table of: " + ", ".join(tables) + did_you_mean(table, tables))


def problem_with_formula(name, formula, program):
    table, _, column = name.partition("/")
    if name == STRESS or table == "periods" or column in ("u", "s"):
        return "a formula can replace only one column over time"
    return evaluate(program, name, formula, ())[1]


def evaluate(program, name, formula, instants):
    """Values of a formula, which the program reads, or why there are none."""
    call = program.finish(program.start(
        "evaluate", f"--exact {name}", formula, *map(repr, instants)))
    if call.status:
        return None, call.error.strip()
    return numpy.array(call.output.split(), dtype=float), None


def no_error(reason, instants=0):
    return {"value": None, "instants": instants, "reason": reason}


def relative_error(difference, size, instants):
    """The largest difference at common instants, divided by the largest value of the
    reference at any instant."""
    if not math.isfinite(difference + size):
        return no_error("there are values that are not finite", instants)
    if size == 0.:
        return no_error("the reference is 0 at all instants", instants)
    return {"value": float(difference / size), "instants": instants}


def history_error(name, folder, reference, period, periodic):
    """Error of a column over time, at all instants or in the last periods."""
    table, column = name.split("/")
    if periodic and depends_on_constant(table):
        return no_error("it depends on the additive constant of the displacement, "
                        "which a periodic state does not determine")
    tables = []
    for whose, path in (("run", folder), ("reference", reference)):
        if not (path / f"{table}.csv").exists():
            return no_error(f"the {whose} has no table {table}")
        tables.append(Table(path / f"{table}.csv"))
        if periodic:
            tables[-1].keep_last_period(period)
            tables[-1].begin_at_zero()
    found = compare(column, *tables, period, periodic)
    if found.objection:
        return no_error(found.objection, found.instants)
    return relative_error(found.difference, found.size, found.instants)


def exact_error(name, formula, folder, period, whole_run, program):
    """Error of a column against a formula of t, at all instants of a march from rest,
    or in the last period."""
    table, column = name.split("/")
    if not (folder / f"{table}.csv").exists():
        return no_error(f"the run has no table {table}")
    mine = Table(folder / f"{table}.csv")
    if column not in mine.columns:
        return no_error("the run has no such column")
    if not whole_run:
        mine.keep_last_period(period)
    values, reason = evaluate(program, name, formula, mine.t.tolist())
    if reason:
        return no_error(reason)
    if not len(mine.t) or mine.t[-1] == 0.:
        return no_error("the run has only the instant t = 0")
    found, exact = mine.columns[column][None], values[None]
    if not whole_run:
        found, exact = (without_means([column], of) for of in (found, exact))
    return relative_error(abs(found - exact).max(), abs(exact).max(), len(values))


class StressReader:
    """The stress at all quadrature points at the instants of the last period, as the
    program writes it (postprocess/stress_writer.h)."""

    def __init__(self, path):
        try:
            data = numpy.fromfile(path, dtype="<u8")
            mark, dim, points, components, samples = map(int, data[:5])
            sizes = samples, 2 * points, dim * points, samples * points * components
            if mark != MARK or path.stat().st_size != 8 * (5 + sum(sizes)):
                raise ValueError
        except (OSError, ValueError):
            raise ResultsError(f"{path}: is not there, or is damaged.") from None
        ends = numpy.cumsum((5, *sizes))
        instants, cells, coordinates, stress = (
            data[begin:end] for begin, end in zip(ends, ends[1:]))
        self.instants = instants.view(float)
        # By cells, whatever the number of ranks was; within a cell as they are.
        order = numpy.lexsort(cells.reshape(-1, 2).T)
        self.coordinates = coordinates.view(float).reshape(points, dim)[order]
        self.stress = stress.view(float).reshape(samples, points, components)[:, order]

    def error(self, reference, period):
        mine, theirs = self.coordinates, reference.coordinates
        if mine.shape != theirs.shape or (
                abs(mine - theirs).max(initial=0.) > 1e-10 * abs(theirs).max(initial=0.)):
            return no_error("the run and the reference have different quadrature "
                            "points")
        rows, objection = common_instants(self.instants, reference.instants, period)
        if objection:
            return no_error(objection, len(rows))
        i, j = numpy.array(rows).T
        size = abs(reference.stress).max(initial=0.)
        return relative_error(abs(self.stress[i] - reference.stress[j]).max(initial=0.),
                              size, len(rows))
