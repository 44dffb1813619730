# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The tries of a scene on several meshes with several steps, and their error bars."""

import collections
import math

from crevasse.advise_runs import Runs, as_text
from crevasse.bars import Bars
from crevasse.bars_companions import SMALLEST_RATIO, Choice, Companion, steps
from crevasse.command import CommandError, Log
from crevasse.quantities import did_you_mean
from crevasse.run_reader import Run as Results

DEFAULT = ("K_I_largest", "opening")  # the first that a scene has
APART = 1.3  # ratio of cells from which a mesh is a good companion
PARTS = ("bar", "mesh", "time", "period")
Mesh = collections.namedtuple("Mesh", "times, settings")  # times as fine as the scene's


class Tries(Runs):
    """Runs that are known by their settings: a companion of one try is that of others."""

    def __init__(self, scene, *arguments):
        super().__init__(*arguments, False)
        self.scene_parameters = scene
        self.of_try, self.numbers, self.meshes = {}, {}, []

    def run(self, name, settings):
        settings = self.of_try | settings
        number = self.numbers.setdefault(key(settings), f"{len(self.numbers) + 1:03}")
        self.known[name] = super().run(number, settings)
        return self.known[name]

    def serves_as_companion(self, run):
        """A try is its own companion, which marches over as many periods."""
        settings = self.of_try | Choice(Results(self.folder(run))).common()
        self.numbers.setdefault(key(settings), run.name)

    def seconds(self):
        return sum({run.name: run.seconds for run in self.known.values()}.values())

    def coarser_than(self, mesh):
        """Companions on at most two meshes of former tries, the finer one first."""
        ratios = {mesh.times / other.times: other.settings for other in self.meshes}
        first = min([r for r in ratios if r >= APART]
                    or [r for r in ratios if r >= SMALLEST_RATIO], default=math.inf)
        second = sorted(r for r in ratios if r >= SMALLEST_RATIO * first)[:1]
        return [Companion(f"coarser_{k}", ratios[r], r, 0.)
                for k, r in enumerate([first, *second]) if r < math.inf]


def key(settings):
    return tuple(sorted(as_text(settings).items()))


class BarsOfTry(Bars):
    """Error bars of a try, by companions on coarser meshes of former runs, or else those
    of --bars. Errors of steps depend little on the mesh: the coarsest one shows them."""

    def __init__(self, runs, run, mesh, times):
        super().__init__(runs.folder(run), runs, Log(True))
        self.in_space(runs.coarser_than(mesh) or self.choice.meshes())
        known = [mesh.settings for mesh in runs.meshes]
        runs.meshes += [new for new in (mesh, *(
            Mesh(mesh.times / other.ratio, mesh.settings | other.settings)
            for other, _ in self.meshes)) if new.settings not in known]
        self.in_time(times)
        self.conclude()

    def in_time(self, times):
        """Steps so many times as short as the scene's, beside those of twice the length;
        the scene's own beside those of half the length."""
        self.time, self.why_no_time = None, self.no_limit("time")
        if self.why_no_time:
            return
        scene = self.runs.scene_parameters
        coarsest = min(self.runs.meshes, key=lambda mesh: mesh.times).settings
        one, other = (steps(scene, k) for k in (times, max(times // 2, 2 // times)))
        base, self.why_no_time = self.companion(f"steps_{times}", coarsest | one.settings)
        if base:
            run, self.why_no_time = self.companion(other.name, coarsest | other.settings)
            other.ratio /= one.ratio
            self.time = run and (other, base, run)


class Try:
    """A try with its bars, relative to the largest value of the quantities asked for."""

    def __init__(self, runs, run, mesh, steps, asked):
        bars = BarsOfTry(runs, run, mesh, steps)
        self.mesh, self.steps, self.run, self.choice = mesh, steps, run, bars.choice
        self.all_bars, self.bars = bars, bars.bars
        self.kinds = {quantity.name: quantity.of for quantity in bars.quantities}
        self.parts, self.scales, self.order = dict.fromkeys(PARTS, 0.), {}, 99.
        self.worst = ""  # the quantity with the largest bar
        for name in asked or DEFAULT:
            self.take(name, bool(asked))
            if self.scales and not asked:
                break
        if not self.scales:
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
            self.scales[name] = scale

    def time_part(self, steps):
        """The part of other steps, from their runs on the coarsest mesh."""
        self.all_bars.in_time(steps)
        parts = [(self.all_bars.time_part(quantity)[0], self.scales[quantity.name])
                 for quantity in self.all_bars.quantities if quantity.name in self.scales]
        return max(math.inf if part is None else part / scale for part, scale in parts)
