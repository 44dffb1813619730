# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Runs a scene for all combinations of some parameters, and tabulates errors beside
costs. What is finished stays on disk and is not computed again."""

import hashlib
import os
import pathlib
import re

from crevasse.command import CommandError, Log, Parser, Stop, taken
from crevasse.program import Program
from crevasse.results import ResultsError, parse_parameters
from crevasse.sweep_errors import (STRESS, STRESS_FILE, StressReader,
                                   choose_quantities, history_error, no_error)
from crevasse.sweep_folder import Folder
from crevasse.sweep_output import Output
from crevasse.sweep_plan import Plan, require_none, shorten

EPILOG = """Quantities, for --error and --exact:
  probe_NAME/COLUMN     a column of a probe's table: u_1, s_22, opening, ...
  probe_NAME/u, .../s   all its displacements, all its stresses
  contact/COLUMN        of the lip's table: force, largest_pressure, closed_nodes
  crack_tip/COLUMN      K_I, K_I_stress, K_I_error, energy_release_rate, strain_energy
  crack_tip_N/COLUMN    of tip N between two lips: K_I, K_II, T_stress, ...
  creep_integral/C_t    of creep by a power law, or creep_integral_N/C_t
  periods/stress_change, load_work/load_work
  stress                at all quadrature points, in the last period
Without --error: stress, u and s of every probe, and contact/force.

Examples:
  crevasse sweep prm/raous1980.prm --set "Contact/Solver=automatic" \\
    --vary "Time integration/Scheme=heun,sdirk2" \\
    --vary "Time integration/Steps per period=20,40,80" \\
    --reference "Time integration/Steps per period=1280"

Finished points are not computed again: after an interruption, repeat the command.
doc/sweep.md explains errors, tables and folders.

Exit status: as that of a run. The table says which points are refused or fail; the
status is 3 only if no point has results."""


def arguments(words):
    parser = Parser("sweep", description=__doc__, epilog=EPILOG)
    parser.add_common("results/<scene name>_sweep")
    parser.add_list("--vary", "LIST", "\"Section/Name=a,b,c\": the values of a "
                    "parameter, separated by \";\" if they contain commas, by \" | \" "
                    "if both; \"S/N=a,b & S/M=c,d\" changes two together. All "
                    "combinations are computed")
    parser.add_list("--reference", "ASSIGNMENT", "\"Section/Name=value\": errors are "
                    "measured against the run of the scene with this")
    parser.add_list("--exact", "FORMULA", "\"QUANTITY=formula of t\": a closed form "
                    "to compare a quantity with")
    parser.add_argument("--error", default="", metavar="LIST", help="quantities whose "
                        "errors are wanted, separated by commas: stress, or "
                        "TABLE/COLUMN as crack_tip/K_I")
    return parser.parse(words)


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
            if error.status != 2:
                raise
            message = re.sub(r"\A\d+ problems:\n", "", str(error))
            for text in map(shorten, own):
                message = message.replace(f"--set \"{text}\"",
                                          f"--{'vary' if k else 'reference'} \"{text}\"")
            mistakes += message.splitlines()
        calls[k] = None
    require_none(list(dict.fromkeys(mistakes)))
    return texts


class Sweep:
    """Reads the scenes of all points."""

    def __init__(self, options, program, log):
        self.options, self.program, self.log = options, program, log
        self.plan = Plan(options.vary)
        self.settings = [options.reference, *map(self.plan.settings, self.plan.points)]
        self.used = read_scenes(program, options, self.settings)
        self.refuse_equal_points()
        self.scenes = [parse_parameters(text)[0] for text in self.used]
        self.quantities = choose_quantities(options, self.scenes, program)
        self.needs_reference = None in self.quantities.values()
        self.directory = options.output or pathlib.Path(
            (self.scenes[0]["Output directory"] or f"results/{options.scene.stem}")
            + "_sweep")
        self.output = Output(self.plan, self.quantities,
                             f"Sweep of {options.scene.name}", self.reference_in_words())
        self.stress = None  # of the reference

    def refuse_equal_points(self):
        known = set()
        for point, used in zip(self.plan.points, self.used[1:]):
            if used in known:
                raise CommandError("--vary: there are several points with "
                                   + ", ".join(point.values)
                                   + "; each value may be listed once", 2)
            known.add(used)

    def reference_in_words(self):
        parts = (["the run with " + ", ".join(self.options.reference)]
                 if self.needs_reference else [])
        parts += [f"{name} = {formula}" for name, formula in self.quantities.items()
                  if formula is not None]
        return "Errors are measured against " + "; ".join(parts)

    def basis(self):
        """What errors are measured, and against what."""
        text = f"{self.quantities}" + (self.used[0] if self.needs_reference else "")
        return hashlib.sha256(text.encode()).hexdigest()[:16]

    def run(self):
        n = len(self.plan.points)
        self.log(f"Crevasse {os.environ.get('CREVASSE_VERSION', '')}: sweep of "
                 f"{self.options.scene.name}, {n} point{'s' * (n > 1)}")
        self.log("  " + self.reference_in_words())
        if self.needs_reference and (names := self.plan.parameters_of_problem()):
            self.log(f"  note: {', '.join(names)} changes the problem itself: errors "
                     "against one reference tell how results differ from it, not how "
                     "accurate they are")
        try:
            if self.needs_reference:
                self.find_reference()
            for number in range(n):
                self.find_point(number)
        finally:
            for warning in self.output.warnings():
                self.log("  warning: " + warning)
        self.log(f"  table in {self.directory}/sweep.md, sweep.csv, sweep.json")
        if not any(result.has_results for result in self.output.results):
            raise CommandError(f"None of the points has results: {self.directory}"
                               "/sweep.md tells why.", 3)

    def compute(self, folder, settings):
        return folder.compute(self.program, self.options.scene,
                              [*self.options.set, *settings], STRESS in self.quantities)

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
            self.log.progress("  reference ...")
            result = self.compute(folder, self.settings[0])
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

    def find_point(self, number):
        point = self.plan.points[number]
        folder = Folder(self.directory / point.folder, self.used[number + 1])
        numbered = f"  {number + 1} of {len(self.plan.points)}: "
        result = self.stored(folder, number)
        there = " (already there)" if result else ""
        if not result:
            self.program.stop.check()
            self.log.progress(numbered + self.output.values(number) + " ...")
            result = self.compute(folder, self.settings[number + 1])
            self.measure(folder, number, result)
            folder.finish(result)
        self.output.results.append(result)
        self.output.write(self.directory)
        self.log(numbered + self.output.line(number) + there)

    def stored(self, folder, number):
        """The result that is there already, with errors against the present reference;
        None if there is none."""
        result = folder.finished()
        if result and result.has_results and result.basis != self.basis():
            try:
                self.measure(folder, number, result)
            except ResultsError as error:
                self.log(f"  computed again, to measure errors anew: {error}")
                return None
            folder.finish(result)
            self.log(f"  errors of {folder.path} measured anew")
        return result

    def measure(self, folder, number, result):
        result.basis = self.basis()
        result.errors = {}
        if not result.has_results:
            return
        scene = self.scenes[number + 1]
        period = float(scene["Loads/Period"])
        # Both from the same rest; else the periods before are steps of a search.
        whole_run = all(of["Periodic state/Method"] == "march"
                        and of["Periodic state/Start from"] == "rest"
                        for of in (scene, self.scenes[0]))
        for name, formula in self.quantities.items():
            result.errors[name] = (
                self.stress_error(folder, result, period) if name == STRESS else
                history_error(name, formula, folder.path, self.directory / "reference",
                              period, whole_run, self.program))

    def stress_error(self, folder, result, period):
        if not result.has_periods:
            return no_error("the run has computed no period")
        if self.stress is None:
            return no_error("the reference has computed no period")
        return StressReader(folder.path / STRESS_FILE).error(self.stress, period)


def sweep(options, stop, log):
    run = Sweep(options, Program(stop), log)
    with taken(run.directory):
        log.open(run.directory / "sweep.log")
        stop.look_in(run.directory)
        run.run()


def main(words):
    options = arguments(words)
    log = Log(options.quiet)
    try:
        sweep(options, Stop(options.wall_time, "The points that are finished are kept: "
                            "the same command goes on with the others."), log)
    except (CommandError, ResultsError, OSError) as error:
        status = getattr(error, "status", 4)
        if status == 5:
            log(f"crevasse: {error}")
        else:
            log.error(f"crevasse: {error}")
        return status
    return 0
