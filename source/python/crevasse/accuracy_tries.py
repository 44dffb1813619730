# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The tries of a scene on several meshes with several steps, and their error bars."""

import collections

from crevasse.advise_runs import Runs, as_text
from crevasse.bars import Bars
from crevasse.bars_companions import SMALLEST_RATIO, Choice, Companion
from crevasse.bars_compare import Histories, quantities_of
from crevasse.command import CommandError, Log
from crevasse.quantities import did_you_mean
from crevasse.run_reader import Run

DEFAULT = ("K_I_largest", "opening")  # the first that a scene has
APART = 2.  # ratio of cells from which a mesh is a good companion
PARTS = ("bar", "mesh", "time", "period")
Mesh = collections.namedtuple("Mesh", "times, settings")  # times as fine as the scene's


class Tries(Runs):
    """Runs that are known by their settings: a companion of one try is that of others."""

    def __init__(self, *arguments):
        super().__init__(*arguments, False)
        self.of_try, self.numbers, self.meshes = {}, {}, []

    def run(self, name, settings):
        settings = self.of_try | settings
        key = tuple(sorted(as_text(settings).items()))
        number = self.numbers.setdefault(key, f"{len(self.numbers) + 1:03}")
        self.known[name] = super().run(number, settings)
        return self.known[name]

    def seconds(self):
        return sum({run.name: run.seconds for run in self.known.values()}.values())

    def coarser_than(self, mesh):
        """Companions on at most two meshes of former tries, the finer one first."""
        former = sorted(((mesh.times / other.times, other.settings)
                         for other in self.meshes), key=lambda pair: pair[0])
        found = ([pair for pair in former if pair[0] >= APART]
                 or [pair for pair in former if pair[0] >= SMALLEST_RATIO])
        return [Companion(f"coarser_{k}", settings, ratio, 0.)
                for k, (ratio, settings) in enumerate(found[:2])]


class BarsOfTry(Bars):
    """Error bars of a try, by companions on the coarser meshes of former tries. The first
    try, on the scene's own mesh, has those of --bars."""

    def __init__(self, runs, run, mesh):
        self.results, self.runs, self.log = runs.folder(run), runs, Log(True)
        self.own = Run(self.results)
        self.scene, self.choice = self.own.parameters, Choice(self.own)
        is_first = not runs.meshes
        if not is_first:
            coarser = runs.coarser_than(mesh)
            self.choice.meshes = lambda: coarser
        self.mine = Histories(self.results, self.own.period)
        self.quantities = quantities_of(self.scene, self.mine)
        self.run()
        runs.meshes.append(mesh)
        if is_first:
            runs.meshes += [Mesh(1. / other.ratio, mesh.settings | other.settings)
                            for other, _ in self.meshes]

    def forget_older_runs(self):
        pass

    def in_time(self, steps):
        """Errors of steps depend little on the mesh: the coarsest one shows them."""
        meshes = self.meshes
        self.meshes = meshes[-1:]
        super().in_time(steps)
        self.meshes = meshes


class Try:
    """A try with its bars, relative to the largest value of the quantities asked for."""

    def __init__(self, runs, run, mesh, steps, asked):
        bars = BarsOfTry(runs, run, mesh)
        self.mesh, self.steps, self.run, self.choice = mesh, steps, run, bars.choice
        self.bars = Run(bars.results).summary["bars"]
        self.kinds = {quantity.name: quantity.of for quantity in bars.quantities}
        self.parts, self.names, self.order = dict.fromkeys(PARTS, 0.), [], 99.
        self.worst = ""  # the quantity with the largest bar
        for name in asked or DEFAULT:
            self.take(name, bool(asked))
            if self.names and not asked:
                break
        if not self.names:
            raise CommandError("the scene has neither K_I nor an opening: name others by "
                               f"--for, such as \"{next(iter(self.kinds), '')}\".", 2)

    def take(self, asked, is_required):
        group = [name for name in self.kinds
                 if name == asked or name.startswith(asked + "_")]
        if not group and is_required:
            raise CommandError(
                f"--for \"{asked}\": the run has no such quantity, but "
                + ", ".join(self.kinds) + did_you_mean(asked, self.kinds), 2)
        scale = max((abs(self.bars[name]["value"]) for name in group), default=0.)
        if group and not scale:
            if is_required:
                raise CommandError(f"{asked} is 0, so that it has no relative accuracy. "
                                   "Name other quantities by --for.", 2)
            return  # the next one serves
        for name in group:
            entry = self.bars[name]
            if entry["bar"] is None:
                raise CommandError(f"{name} has no error bar: {entry['why']}. Name other "
                                   "quantities by --for.", 3)
            if not self.worst or entry["bar"] > self.parts["bar"] * scale:
                self.worst = name
            for part in PARTS:
                self.parts[part] = max(self.parts[part], entry[part] / scale)
            self.order = min(self.order, self.choice.order_in_space(self.kinds[name]))
        self.names += group
