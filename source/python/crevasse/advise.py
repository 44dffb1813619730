# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Finds the cheapest settings with which the histories of a scene have a relative
error, and writes them as a scene. The error is the largest of all quantities, each
relative to its largest value. Schemes and steps, elements and meshes, and the search
for the periodic state are tried; body and loads never change."""

import argparse
import dataclasses
import pathlib
import sys

from crevasse import advise_report
from crevasse.advise_candidates import (families_in_space, families_in_time,
                                        family_of)
from crevasse.advise_errors import Errors, choose_quantities
from crevasse.advise_pairs import (PART_IN_SPACE, PART_IN_TIME, RESULT, SEARCH,
                                   Pairs)
from crevasse.advise_period import Period
from crevasse.advise_runs import Runs
from crevasse.advise_search import Search
from crevasse.command import CommandError, Log, Parser, Stop, taken
from crevasse.program import Program
from crevasse.quantities import LAST_PERIODS
from crevasse.results import ResultsError, number, parse_parameters, probes_of

ERROR_OF_BASE = 0.1  # of the steps with which meshes are compared
EPILOG = """Files in DIR:
  advised.prm   includes the scene, with the settings found: crevasse advised.prm
  advice.md     what was chosen and all that was measured, for people
  advice.json   the same for scripts
  runs/         the runs

Example:
  crevasse advise prm/raous1980.prm --error 1e-2

Finished runs are not computed again: after an interruption, repeat the command.
doc/advise.md explains the method.

Exit status: as that of a run; 3 if the error is not reached with the largest meshes
that are tried: the nearest settings are written then."""


def target_error(text):
    """Parses --error: rounding and the contact tolerance are not far below 1e-8."""
    error = number(text)
    if error is None or not 1e-8 <= error < 1.:
        raise argparse.ArgumentTypeError(
            f"\"{text}\" is not an allowed relative error: must be a number of at "
            "least 1e-8 and less than 1, such as 1e-3.")
    return error


def arguments(words):
    parser = Parser("advise", description=__doc__, epilog=EPILOG)
    parser.add_argument("--error", type=target_error, required=True, metavar="NUMBER",
                        help="relative error of the histories, such as 1e-3")
    parser.add_argument("--quantities", metavar="LIST", help="quantities that must "
                        "have this error, separated by commas, such as probe_mouth/u, "
                        "crack_tip/K_I (u and s of all probes)")
    parser.add_common("results/<scene name>_advice")
    return parser.parse(words)


class Advice:
    """The search for the cheapest settings: what was requested, and what was found."""

    def __init__(self, options, program, log):
        self.scene_file, self.target, self.log = options.scene, options.error, log
        overrides = dict(text.partition("=")[::2] for text in options.set)
        self.scene = parse_parameters(
            program.parameters(options.scene, overrides))[0]
        quantities = choose_quantities(options.quantities, self.scene,
                                       probes_of(self.scene))
        self.directory = options.output or pathlib.Path(
            (self.scene["Output directory"] or f"results/{options.scene.stem}")
            + "_advice")
        self.program, self.overrides = program, overrides
        self.runs = Runs(program, options.scene, overrides, self.directory, log)
        self.errors = Errors(self.runs, self.scene, quantities)
        self.period = Period(self.scene, self.target)
        self.common = {"Contact/Solver": "automatic", "Linear solver/Type": "automatic"}
        if self.scene.get("Contact/Relaxation table"):
            self.common["Contact/Relaxation table"] = ""
        self.own = self.own_error = None

    def settings(self, space, time, purpose):
        return (self.common | space.settings | time.settings
                | self.period.settings(time, purpose))

    def run_pair(self, space, time, purpose):
        return self.runs.run(
            f"{space.name}__{time.name}{self.period.name(time, purpose)}",
            self.settings(space, time, purpose))

    def find(self):
        in_time, in_space = families_in_time(self.scene), families_in_space(self.scene)
        coarsest = self.coarsest_mesh(in_space[0], family_of("sdirk2", in_time))
        self.period.choose(in_time, coarsest, self.common, self.runs, self.errors,
                           self.log)
        self.log("Time, on a coarse mesh:")
        self.time = Search(
            True, in_time, lambda steps: self.run_pair(coarsest, steps, SEARCH),
            self.errors, self.log)
        self.time.extend_to(PART_IN_TIME * self.target)
        if not self.time.points:
            raise CommandError("no scheme runs on the coarsest mesh: "
                               + "; ".join(self.time.notes), 3)
        self.errors.require_histories(self.time.points[0].run)
        self.require_errors(self.time)
        base = self.search_in_space(in_space)
        self.require_errors(self.space)
        if not self.errors.counting():
            raise CommandError("no history converges as the cells are halved, so that "
                               "no error can be reached: "
                               + "; ".join(self.space.notes), 3)
        self.log("Both together:")
        self.pairs = Pairs(self.space, self.time, base, self.target,
                           self.period.times_the_periods, self.run_pair, self.errors)
        self.reached = self.pairs.find()
        self.best = self.pairs.best()

    def coarsest_mesh(self, meshes, stable_steps):
        """First mesh on which the program accepts the scene, by a run of one period."""
        steps = stable_steps.candidates[0]
        for mesh in meshes.candidates[:meshes.refusals_that_pass + 1]:
            trial = self.runs.run(
                f"{mesh.name}__{steps.name}__one_period",
                self.common | mesh.settings | steps.settings
                | {"Periodic state/Method": "march",
                   "Periodic state/Tolerance": 0, "Periodic state/Maximum periods": 1})
            if trial.usable:  # before much is computed
                self.errors.require_histories(trial)
            if trial.status != "refused":
                return mesh
        return meshes.candidates[0]

    def require_errors(self, search):
        """Raises CommandError unless two runs can be compared, which errors need."""
        if search.reference is None:
            raise CommandError(
                f"the error in {'time' if search.in_time else 'space'} is unknown: an "
                "error needs two runs of one kind that have the compared quantities. "
                "Each kind ended: " + "; ".join(search.notes), 3)

    def search_in_space(self, families):
        """Searches the meshes with the cheapest steps that work on finer meshes, too:
        there explicit schemes may fail, as where creep grows with the stress at a tip.
        Returns the point in time."""
        for base in self.bases_in_time():
            self.log(f"Space, with {base.candidate.text}:")
            self.space = Search(
                False, [dataclasses.replace(family, points=[]) for family in families],
                lambda mesh: self.run_pair(mesh, base.candidate, SEARCH),
                self.errors, self.log)
            self.space.extend_to(PART_IN_SPACE * self.target)
            if self.space.reference is not None:
                break
            self.time.leave_out(base.family, "on finer meshes it fails: "
                                + "; ".join(self.space.notes))
        return base

    def bases_in_time(self):
        """For each scheme the point of least work whose error is small beside the
        histories, cheapest first."""
        small = [point for point in self.time.points if point.error < ERROR_OF_BASE]
        best = {}
        for point in sorted(small or [self.time.reference],
                            key=lambda point: point.run.work):
            best.setdefault(point.family.text, point)
        return list(best.values())

    def write(self):
        space, time = (point.candidate for point in self.pairs.points(self.best.pair))
        self.choice = f"{space.text}; {time.text}; {self.period.text(time)}"
        self.used = self.program.parameters(
            self.scene_file, self.overrides | self.settings(space, time, RESULT)
            | {"Output directory": ""})
        self.advised = parse_parameters(self.used)[0]
        advise_report.write(self.directory, self)
        # Last: it may take longer than all else, and the advice is there already.
        self.own = self.runs.run("original", {})
        if self.own.has_results and self.best.reference:
            self.own_error = self.errors.difference(self.own, self.best.reference)
        advise_report.write(self.directory, self)
        for line in advise_report.conclusion(self):
            self.log(line)


def advise(options, stop, log):
    advice = Advice(options, Program(stop), log)
    with taken(advice.directory):
        log.open(advice.directory / "advice.log")
        stop.file = advice.directory / "stop"
        log(f"Settings of {options.scene.name} for an error of {options.error:g}")
        log("  compared are " + (LAST_PERIODS if advice.errors.periodic
                                 else "all instants from rest"))
        advice.find()
        advice.write()
    if not advice.reached:
        raise CommandError(
            "the error is not reached: the nearest settings have an error of "
            f"{advice.best.error:.2g}. {advice.directory}/advice.md lists how far each "
            "kind of mesh and scheme was refined.", 3)


def main(words):
    options = arguments(words)
    try:
        advise(options, Stop(options.wall_time, "The finished runs are kept: repeat "
                             "the command to continue."), Log(options.quiet))
    except CommandError as error:
        print(f"crevasse advise: {error}", file=sys.stderr)
        return error.status
    except (OSError, ResultsError) as error:
        print(f"crevasse advise: {error}", file=sys.stderr)
        return 4
    return 0
