# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""One sweep: computes the reference and the points, several at a time, measures errors,
and writes tables and log in the order of the plan."""

import hashlib
import os
import pathlib
import re

from crevasse import findings
from crevasse.command import CommandError, write_file
from crevasse.quantities import LAST_PERIODS, is_periodic
from crevasse.results import ResultsError, checksums, normal_form, parse_parameters
from crevasse.sweep_errors import (STRESS, STRESS_FILE, StressReader,
                                   choose_quantities, exact_error, history_error,
                                   no_error)
from crevasse.sweep_folder import Folder
from crevasse.sweep_output import Output
from crevasse.sweep_plan import Plan, require_none, shorten


def read_scenes(program, options, settings):
    """The text of used.prm for the settings of the reference and of each point. Tells
    all mistakes of all scenes, which share most of them, each once."""
    calls, texts, mistakes = [], [], []
    for k, own in enumerate(settings):
        for following in settings[len(calls):k + (os.cpu_count() or 1)]:
            calls.append(program.start_parameters(
                options.scene, ["Output/Fields=none", *options.set, *following]))
        try:
            texts.append(program.finish_parameters(calls[k]))
        except CommandError as error:
            message = re.sub(r"\A\d+ problems:\n", "", str(error))
            for text in map(shorten, own):
                message = message.replace(f"--set \"{text}\"",
                                          f"--{'vary' if k else 'reference'} \"{text}\"")
            if error.status != 2:
                raise CommandError(message, error.status) from None
            mistakes += message.splitlines()
        calls[k] = None
    require_none(list(dict.fromkeys(mistakes)))
    return texts


def choose_jobs(options, program, one_at_a_time):
    """Number of points that run at the same time."""
    if program.ranks > 1 and options.jobs not in (None, 1):
        raise CommandError(f"--jobs {options.jobs}: with mpirun each point is computed on "
                           f"all {program.ranks} processes, one point at a time. Leave "
                           "out --jobs, or mpirun.", 2)
    one = program.ranks > 1 or one_at_a_time
    return options.jobs or (1 if one else len(os.sched_getaffinity(0)))


class Sweep:
    """A sweep. It finds the reference and the points, on disk or by runs."""

    def __init__(self, options, program, log):
        self.options, self.program, self.log = options, program, log
        self.plan = Plan(options.vary)
        self.settings = [options.reference, *map(self.plan.settings, self.plan.points)]
        self.used = read_scenes(program, options, self.settings)
        self.refuse_equal_points()
        self.scenes = [parse_parameters(text)[0] for text in self.used]
        self.quantities = choose_quantities(options, self.scenes, program)
        self.needs_reference = None in self.quantities.values()
        # One kind of error in all rows of a table.
        self.periodic = any(map(is_periodic, self.scenes))
        if options.repeat > 1 and options.jobs not in (None, 1):
            raise CommandError(f"--jobs {options.jobs}: runs that are repeated for their "
                               "times are computed one at a time. Leave out --jobs, or "
                               "--repeat.", 2)
        self.jobs = choose_jobs(options, program,
                                bool(self.quantities) or options.repeat > 1)
        self.directory = options.output or pathlib.Path(
            (self.scenes[0]["Output directory"] or f"results/{options.scene.stem}")
            + "_sweep")
        self.output = Output(self.plan, self.quantities,
                             f"Sweep of {options.scene.name}", self.reference_in_words(),
                             options.columns)
        self.stress = None  # of the reference
        self.running = {}  # {call: (number of the scene, folder)}
        self.lines = [[] for _ in self.plan.points]  # of the log, not yet written

    def refuse_equal_points(self):
        known = set()
        for point, text in zip(self.plan.points, self.used[1:]):
            used = str(normal_form(text))
            if used in known:
                raise CommandError("--vary: there are several points with "
                                   + ", ".join(point.values)
                                   + "; each value may be listed once", 2)
            known.add(used)

    def reference_in_words(self):
        parts = (["the run with " + ", ".join(self.options.reference)
                  + f" ({LAST_PERIODS})" * self.periodic]
                 if self.needs_reference else [])
        parts += [f"{name} = {formula}" for name, formula in self.quantities.items()
                  if formula is not None]
        return "Errors are measured against " + "; ".join(parts) if parts else ""

    def basis(self):
        """Hash of the quantities whose errors are measured, and of their reference."""
        text = f"{self.quantities}" + (f"{self.periodic}{normal_form(self.used[0])}"
                                       f"{checksums(self.used[0])}"
                                       if self.needs_reference else "")
        return hashlib.sha256(text.encode()).hexdigest()[:16]

    def run(self):
        n = len(self.plan.points)
        self.log(f"Crevasse {os.environ.get('CREVASSE_VERSION', '')}: sweep of "
                 f"{self.options.scene.name}, {n} point{'s' * (n > 1)}")
        if self.quantities:
            self.log("  " + self.reference_in_words())
        if self.needs_reference and (names := self.plan.parameters_of_problem()):
            self.log(f"  note: {', '.join(names)} changes the problem itself: errors "
                     "against one reference tell how results differ from it, not how "
                     "accurate they are")
        try:
            if self.needs_reference:
                self.find_reference()
            self.find_points()
        finally:
            self.write_lines(to_the_end=True)
            if self.output.results:
                write_file(self.directory / "sweep.tex", self.output.latex())
            for warning in self.output.warnings():
                self.log("  warning: " + warning)
            for name in self.output.unknown_columns():
                self.log(f"  warning: --columns: no run has {name}; sweep.csv shows "
                         "what they have")
        self.log(f"  table in {self.directory}/sweep.md, sweep.tex, sweep.csv, sweep.json")
        if not any(result.has_results for result in self.output.results.values()):
            raise CommandError(f"None of the points has results: {self.directory}"
                               "/sweep.md tells why.", 3)

    def begin(self, folder, k, repetition=1):
        """Starts the run of scene k; 0 is the reference. The last repetition gets the
        error bars."""
        self.program.stop.check()
        call = folder.begin(self.program, self.options.scene,
                            [*self.options.set, *self.settings[k]],
                            *["--stress-record"] * (STRESS in self.quantities),
                            *["--bars"] * (self.wants_bars(k)
                                           and repetition == self.options.repeat))
        self.running[call] = k, folder

    def wants_bars(self, k):
        return k > 0 and (self.options.bars or self.scenes[k]["Output/Error bars"] == "true")

    def finish_one(self):
        call = self.program.finish(*self.running, show_progress=self.show_progress)
        k, folder = self.running.pop(call)
        result = folder.result(self.program.outcome(call))
        if result.costs:
            result.costs["jobs"] = self.jobs if k else 1
        return k, folder, result

    def show_progress(self):
        if self.log.shows_progress:
            self.log.progress("  " + "; ".join(f"{self.name(k)}: {folder.progress()}"
                                               for k, folder in self.running.values()))

    def name(self, k):
        """Name of a run on the terminal: with the values where there is room."""
        if k == 0:
            return "reference"
        number = f"{k} of {len(self.plan.points)}"
        return f"{number}: {self.output.values(k - 1)}" if self.jobs == 1 else number

    def find_reference(self):
        folder = Folder(self.directory / "reference", self.used[0])
        result = folder.finished()
        try:
            was_there = result is not None and result.has_results
            if was_there:
                self.read_stress(folder, result)
        except ResultsError:
            was_there = False  # damaged
        if not was_there:
            self.log("  reference: started")
            self.begin(folder, 0)
            _, _, result = self.finish_one()
            self.output.reference_result = result
            if result.status != "done":
                raise CommandError("The reference run: " + result.message,
                                   2 if result.exit_status == 2 else 3)
            self.read_stress(folder, result)
            folder.finish(result)
        self.output.reference_result = result
        self.log("  reference: " + ("already there" if was_there else "computed"))

    def read_stress(self, folder, result):
        if STRESS in self.quantities and result.has_periods:
            self.stress = StressReader(folder.path / STRESS_FILE)

    def find_points(self):
        for number, point in enumerate(self.plan.points):
            while len(self.running) >= self.jobs:
                self.compute_one()
            folder = Folder(self.directory / point.folder, self.used[number + 1])
            if result := self.stored(folder, number):
                self.keep(folder, number, result, " (already there)")
            else:
                self.begin(folder, number + 1)
        while self.running:
            self.compute_one()

    def compute_one(self):
        k, folder, result = self.finish_one()
        for repetition in range(2, self.options.repeat + 1):
            times = {name: value for name, value in result.costs.items()
                     if "seconds" in name}
            self.begin(folder, k, repetition)
            _, _, result = self.finish_one()
            result.costs |= {name: min(value, result.costs.get(name, value))
                             for name, value in times.items()}
        if result.costs:
            result.costs["repeats"] = self.options.repeat
        self.measure(folder, k - 1, result)
        folder.finish(result)
        self.keep(folder, k - 1, result)

    def keep(self, folder, number, result, remark=""):
        if result.has_results:
            result.findings = findings.read(folder.path)
            result.bars = findings.bars(folder.path)
        self.output.results[number] = result
        self.output.write(self.directory)
        self.lines[number].append(f"  {number + 1} of {len(self.plan.points)}: "
                                  + self.output.line(number) + remark)
        self.write_lines()

    def write_lines(self, to_the_end=False):
        """Logs the finished points in the order of the plan, not of their ends."""
        for number, lines in enumerate(self.lines):
            if not (to_the_end or number in self.output.results):
                break
            while lines:
                self.log(lines.pop(0))

    def stored(self, folder, number):
        """The result of an earlier run, with errors against the present reference; None
        if there is none."""
        result = folder.finished(self.wants_bars(number + 1))
        if result and 0 < result.costs.get("repeats", 0) < self.options.repeat:
            return None
        if (result and result.has_results and self.quantities
                and result.basis != self.basis()):
            try:
                self.measure(folder, number, result)
            except ResultsError as error:
                self.lines[number].append("  computed again, to measure errors anew: "
                                          f"{error}")
                return None
            folder.finish(result)
            self.lines[number].append(f"  errors of {folder.path} measured anew")
        return result

    def measure(self, folder, number, result):
        result.basis = self.basis()
        result.errors = {}
        if not result.has_results:
            return
        scene = self.scenes[number + 1]
        period = float(scene["Loads/Period"])
        from_rest = scene["Periodic state/Method"] == "march"
        for name, formula in self.quantities.items():
            result.errors[name] = (
                self.stress_error(folder, result, period) if name == STRESS else
                history_error(name, folder.path, self.directory / "reference", period,
                              self.periodic) if formula is None else
                exact_error(name, formula, folder.path, period, from_rest, self.program))

    def stress_error(self, folder, result, period):
        if not result.has_periods:
            return no_error("the run has computed no period")
        if self.stress is None:
            return no_error("the reference has computed no period")
        return StressReader(folder.path / STRESS_FILE).error(self.stress, period)
