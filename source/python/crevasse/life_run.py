# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""One life: runs at crack lengths, on disk or to be computed, until the error of N is
below what was asked, and what ended the growth."""

import itertools
import json
import os
import pathlib
import types

import numpy
from scipy.interpolate import PchipInterpolator

from crevasse import life_output
from crevasse.command import CommandError
from crevasse.findings import INTENSITY
from crevasse.life_growth import Growth, Reader, edges_of
from crevasse.life_lengths import Lengths
from crevasse.program import options as words_of
from crevasse.program import without_numbers
from crevasse.results import parse_parameters
from crevasse.sweep_folder import Folder
from crevasse.sweep_run import choose_jobs
from crevasse.wording import in_units, plural

NOT_OF_THE_LAW = ("Stress intensity", "Creep integral", "Method", "Radius")
CYCLES = "Refinement/Cycles"  # which halve the cells at the tip alone
MOST_REFINEMENTS = {CYCLES: 4, "Geometry/Refinements": 2}  # of the meshes of the scene
CHORD = 0.9, 1.02  # distance of two tips, of the growth between them
ENDS = {"--to": "the length of --to", "last length": "the last of --lengths",
        "K_c": "K_max reaches the toughness",
        "arrest": "the crack does not grow: its life is infinite",
        "ligament": "what is left of the ligament is too small",
        "law": "the law gives no growth for what drives it here"}
LARGEST_KINK = 5.  # degrees, of straight growth and between steps of a path
STEADY = 0.1  # of the ligament: growth within the time until creep is steady


def without_law(scene, usual):
    """Settings that leave runs as they are if the law changes: the usual ones of the
    section Crack tip."""
    return [*(f"Crack tip/{name}={value}" for name, value in usual.items()
              if name not in NOT_OF_THE_LAW),
            *["Crack tip/Stress intensity=true"]
            * (scene["Crack tip/Creep integral"] != "true")]


class Life:
    is_path = False  # a path's drivers are interpolated piecewise

    def __init__(self, options, program, log):
        self.options, self.program, self.log = options, program, log
        members = [(options.scene, 1.), *options.block]
        self.files = [file for file, _ in members]
        for file in self.files * options.trust_mesh:  # reading a scene needs its mesh
            program.finish_parameters(program.start(
                file, *words_of(options.set), "--trust-mesh", "--print-parameters", "prm"))
        self.shares = [part for _, part in members]
        texts = [program.finish_parameters(program.start_parameters(file, options.set))
                 for file in self.files]
        scenes = [parse_parameters(text)[0] for text in texts]
        self.readers = [Reader(program, file, options.set, scene, options.tip)
                        for file, scene in zip(self.files, scenes)]
        options.bars |= any(scene["Output/Error bars"] == "true" for scene in scenes)
        self.law = scenes[0]["Crack tip/Crack growth law"]
        self.units = scenes[0]["Units"]
        self.lengths = self.possible_lengths(options, scenes[0])
        call = program.finish(program.start("--print-parameters", "json"))
        usual = json.loads(call.output)["Crack tip"]
        self.own = [without_law(scene, usual) for scene in scenes]
        self.jobs = choose_jobs(options, program, False)
        self.directory = options.output or pathlib.Path(
            (scenes[0]["Output directory"] or f"results/{options.scene.stem}") + "_life")
        self.period = sum(part * reader.period
                          for part, reader in zip(self.shares, self.readers))
        self.refinements = [(name, int(scene[name])) for scene in scenes for name in [
            CYCLES if scene["Refinement/Strategy"] == "tip" and int(scene[CYCLES]) else
            "Geometry/Refinements"]]
        self.nodes, self.levels, self.run_warnings, self.warnings = {}, {}, {}, {}
        self.runs = self.new_runs = 0

    def possible_lengths(self, options, scene):
        return Lengths(options, scene)

    def text(self, value, unit="length", digits=6):
        """A number with its unit, if [Units] names it."""
        named = in_units(unit, self.units)
        number = numpy.format_float_positional(value, digits, fractional=False, trim="-")
        return number + f" {named}" * (named != unit)

    def name(self, k):
        """The name of the folder of a length."""
        return f"a_{self.lengths.all[k]:.10g}" + (
            f"_refined_{self.levels[k]}" if k in self.levels else "")

    def settings_of_length(self, k):
        return self.lengths.settings_of(k, self.directory / "meshes")

    def settings(self, member, k):
        level, (name, least) = self.levels.get(k, 0), self.refinements[member]
        return [*self.options.set, *self.own[member], *self.settings_of_length(k),
                *[f"{name}={least + level}"] * (level > 0)]

    def run(self):
        lengths = self.lengths
        self.log(f"Crevasse {os.environ.get('CREVASSE_VERSION', '')}: life of "
                 f"{self.options.scene.name} from a = {self.text(lengths.start)} to "
                 f"{self.text(lengths.end)}, {len(lengths.all)} possible lengths")
        first = lengths.first()
        self.compute(chosen := [*first])
        while True:
            found = self.estimate(chosen)
            following = lengths.next(chosen, found.growth.rates(lengths.all).sum(axis=0),
                                     found.kink)
            is_first = len(chosen) == len(first) and following is not None
            if not is_first:
                self.log(f"  {len(chosen)} lengths: {found.words}")
            if found.is_enough and not is_first:
                break
            of_meshes = not is_first and found.error_of_mesh > found.error_of_lengths
            if of_meshes and (coarse := self.coarse(chosen)):
                self.refine(coarse)
            elif following is None or (
                    of_meshes and found.error_of_mesh > self.options.error * found.N):
                break
            else:
                if least := min(self.levels.get(k, 0) for k in chosen):
                    self.levels[following] = least
                chosen.append(following)
                self.compute([following])
        self.conclude(found, chosen)

    def coarse(self, chosen):
        """The lengths with the largest errors of K, if their meshes may be refined."""
        errors = {k: max(self.nodes[member, k].error for member in range(len(self.files)))
                  for k in chosen}
        return [k for k, error in errors.items() if error > max(errors.values()) / 2
                and self.levels.get(k, 0) < min(MOST_REFINEMENTS[name]
                                                for name, _ in self.refinements)]

    def refine(self, numbers):
        self.log("  halves the cells at a = " + ", ".join(
            self.text(self.lengths.all[k]) for k in sorted(numbers)))
        for k in numbers:
            self.levels[k] = self.levels.get(k, 0) + 1
        self.compute(numbers)

    def compute(self, numbers):
        """Finds the nodes with these numbers, on disk or by runs, several at a time."""
        waiting = [(member, k) for k in numbers for member in range(len(self.files))]
        running = {}
        while waiting or running:
            if waiting and len(running) < self.jobs:
                member, k = waiting.pop(0)
                folder, result = self.stored(member, k)
                if result:
                    self.keep(member, k, folder, result, " (already there)")
                else:
                    call = folder.begin(self.program, self.files[member],
                                        self.settings(member, k),
                                        *["--bars"] * self.options.bars)
                    running[call] = member, k, folder
            else:
                call = self.program.finish(*running)
                member, k, folder = running.pop(call)
                result = folder.result(self.program.outcome(call))
                folder.finish(result)
                self.new_runs += 1
                self.keep(member, k, folder, result)

    def stored(self, member, k):
        used = self.program.finish_parameters(self.program.start_parameters(
            self.files[member], ["Output/Fields=none", *self.settings(member, k)]))
        block = f"block_{member}" if member else ""
        folder = Folder(self.directory / block / self.name(k), used)
        return folder, folder.finished(self.options.bars)

    def keep(self, member, k, folder, result, remark=""):
        a = self.lengths.all[k]
        if result.status != "done":
            raise CommandError(f"The run at a = {self.text(a)} ({folder.path}): "
                               f"{result.message}",
                               3 if result.status != "refused" else 2)
        self.run_warnings[member, k] = result.warnings  # a finer mesh has others
        self.runs += 1
        node = self.readers[member].node(a, folder.path)
        if not self.is_path:
            self.compare_places(member, node)
        self.nodes[member, k] = node
        K = node.drivers["K_max"]
        self.log(f"  a = {self.text(a)}: " + (
            f"growth by creep {self.text(node.creep[0], digits=5)}" if numpy.isnan(K)
            else f"K_max {self.text(K, INTENSITY, 5)}")
            + f", estimated error of K {100 * node.error:.1g} %; "
            f"{result.costs['seconds']:.2g} s{remark}")

    def compare_places(self, member, node):
        """Refuses lengths of --lengths or of a .geo file that are not those of the runs:
        a tip moves by as much as its crack grows, by less where the crack has kinks."""
        other = next((self.nodes[key] for key in self.nodes if key[0] == member), node)
        grown = abs(node.a - other.a)
        moved = numpy.linalg.norm(numpy.subtract(node.place, other.place))
        if not CHORD[0] * grown <= moved <= CHORD[1] * grown:
            raise CommandError(
                f"from a = {other.a:g} to {node.a:g} the crack grows by "
                f"{self.text(grown)}, but the tip of the runs moves by "
                f"{self.text(moved)}: from ({', '.join(f'{x:g}' for x in other.place)}) to "
                f"({', '.join(f'{x:g}' for x in node.place)}). Give the lengths of these "
                "cracks.", 2)

    def growth(self, chosen, with_error=False):
        return Growth(self.readers, self.shares, [
            [self.nodes[member, k] for k in sorted(chosen)]
            for member in range(len(self.files))], with_error, self.is_path)

    def estimate(self, chosen):
        """N up to the end of the growth, and its errors, with the chosen lengths."""
        growth, start = self.growth(chosen), self.lengths.start
        end, why = growth.end(start, self.lengths.end)
        if why == "law" and end == start:
            raise CommandError(f"The law gives no growth at a = {start:g}, K_max = "
                               f"{growth.curves[0]['K_max'](start):.5g}: is it outside the "
                               "growth table?", 2)
        found = types.SimpleNamespace(growth=growth, kink=growth.kink(), end=end,
                                      why=why or self.lengths.why)
        found.edges = edges_of(growth.a, start, end)
        found.rates, found.periods = growth.integrate(found.edges)
        if why == "arrest":
            found.periods[-1] = numpy.inf
        found.N = found.periods[-1]
        self.estimate_errors(found, chosen)
        return found

    def comparisons(self, chosen):
        """Kinds of errors, the growths that N is compared with, and factors: without the
        last length, and with the errors of K."""
        return [("error_of_lengths", self.growth(chosen[:-1]), 1.),
                ("error_of_mesh", self.growth(chosen, with_error=True), 1.)]

    def estimate_errors(self, found, chosen):
        found.error_of_lengths = found.error_of_mesh = 0.
        found.errors = numpy.zeros(len(found.edges))
        if numpy.isfinite(found.N) and found.N > 0.:
            for name, other, factor in self.comparisons(chosen):
                difference = factor * abs(other.integrate(found.edges)[1] - found.periods)
                known = numpy.isfinite(difference)  # not beyond the end of a table
                difference[~known] = (difference[known].max() if found.why == "law"
                                      and known.any() else numpy.inf)
                setattr(found, name, difference[-1])
                found.errors = found.errors + difference
        error = found.errors[-1]
        found.is_enough = error <= self.options.error * found.N or not numpy.isfinite(
            found.N)
        found.words = (f"N = {found.N:.6g} periods, estimated error {error:.2g} "
                       f"(lengths {found.error_of_lengths:.1g}, "
                       f"meshes {found.error_of_mesh:.1g})" if numpy.isfinite(found.N)
                       else f"no end: the crack does not grow at a = {self.text(found.end)}")

    def conclude(self, found, chosen):
        for text in itertools.chain(*self.run_warnings.values()):
            self.warnings.setdefault(without_numbers(text), text)
        self.describe_transition(found, chosen)
        if not self.is_path:
            self.warn_of_turn(found, chosen)
        life_output.write(self, found, chosen)
        for text in self.warnings.values():
            self.log("  warning: " + text)
        self.log(f"  ends at a = {self.text(found.end)}: {ENDS.get(found.why, found.why)}\n"
                 f"  {plural(self.new_runs, 'new run')}; {self.directory}/life.csv, life.json")
        if not found.is_enough:
            raise CommandError(
                f"The estimated error of N, {100 * found.errors[-1] / found.N:.2g} %, is "
                f"above --error {self.options.error:g}: " + self.advice(found), 3)

    def advice(self, found):
        return ("the meshes are too coarse; refine them." if
                found.error_of_mesh >= found.error_of_lengths else
                "there are no more lengths; " + (
                    "give more values of --vary, with their --lengths." if self.options.vary
                    else "K varies from mesh to mesh: refine them." if self.lengths.geometry
                    else "allow more by finer Subdivisions."))

    def warn_of_turn(self, found, chosen):
        turning = [node for k in chosen if abs((node := self.nodes[0, k]).angle)
                   > LARGEST_KINK and node.a <= found.end]
        if turning:
            first = min(turning, key=lambda node: node.a)
            self.warnings["turn"] = (
                f"from a = {self.text(first.a)} on the crack would turn, there by "
                f"{abs(first.angle):.2g} degrees: this life is that of straight growth. "
                "--path lets it turn, in a body from a .geo file")

    def describe_transition(self, found, chosen):
        """How much the crack grows until creep is steady, part of the ligament or, where
        that is not known, of its length, at the edges; nan without growth by C*."""
        nodes = [self.nodes[0, k] for k in sorted(chosen)]
        times = numpy.array([node.transition for node in nodes])
        found.transition = numpy.full(len(found.edges), numpy.nan)
        if numpy.isnan(times).any():
            return
        time = PchipInterpolator(found.growth.a, times)(found.edges)
        whole = self.lengths.body_ends
        rest, of_rest = (whole - found.edges, "of the ligament") if whole else (
            found.edges, "of its length")
        found.transition = found.rates.sum(axis=0) * time / self.period / rest
        largest = found.transition.max()
        self.log("  creep is steady after a time of at most "
                 f"{self.text(times.max(), 'time', 4)}; the crack grows meanwhile by at most "
                 f"{self.text(100 * largest, '%', 2)} % {of_rest}")
        if largest > STEADY:
            a = found.edges[(found.transition > STEADY).argmax()]
            self.warnings["transition"] = (
                f"from a = {self.text(a, digits=4)} on the crack grows by more than "
                f"{100 * STEADY:g} % {of_rest} before creep is steady: C* does not describe "
                "its growth there")
