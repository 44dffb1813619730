# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Gives the results of a run error bars: what the mesh, the steps and the search for the
periodic state leave. Companion runs with larger cells and shorter steps show it; those
that are finished are not computed again. "crevasse SCENE --bars" calls this after the
run."""

import json
import math
import pathlib
import shutil

import numpy

from crevasse.advise_runs import Runs
from crevasse.bars_companions import SAFETY, SMALLEST_RATIO, Choice, factor
from crevasse.bars_compare import (Histories, difference, error_of_tip, largest,
                                   mode_two_of_closed_tip, quantities_of, with_intensity)
from crevasse.bars_text import table_of, to_halve
from crevasse.command import CommandError, Parser, write_file
from crevasse.quantities import has_two_lips
from crevasse.results import is_number
from crevasse.run_reader import Run
from crevasse.sweep import make_runs

NO_LIMIT = "no limit"
ROUNDING = 1e-9  # of the largest stress
LARGE, FALLS = .15, .85  # differences of a quantity without a limit, as h is halved
# Part of K_II that K_I of a closed tip between two lips may have where it is 0
# (doc/crack_tip.md). Meshes that are not symmetric about the crack have it in common.
SLIDING = .05
# Errors of tips that the run has estimated, and the quantities whose bars replace them.
ESTIMATES = {**{f"K_{mode}_error": (f"K_{mode}_largest", f"K_{mode}_smallest")
                for mode in ("I", "II", "III")},
             "C_star_error": ("C_star_largest", "C_star_smallest"),
             "error_of_largest": ("C_t_largest",), "error_of_last": ("C_t_last",)}
OF_A_TIP = ("s", "pressure")  # what a tip makes infinite


def arguments(words):
    parser = Parser("bars", description=__doc__)
    parser.add_argument("results", nargs=1, type=pathlib.Path)
    parser.add_common("the results")
    # The scene comes second, for the run is what is asked for.
    options = parser.parse(words)
    options.scene, options.results = options.results[0], options.scene
    return options


class Bars:
    """The error bars of one run."""

    def __init__(self, results, runs, log):
        self.results, self.runs, self.log = results, runs, log
        self.directory = results / "bars"
        self.own = Run(results)
        if not self.own.finished:
            raise CommandError(f"{results}: the run is not finished.", 2)
        self.scene = self.own.parameters
        self.choice = Choice(self.own)
        self.mine = Histories(results, self.own.period)
        self.quantities = quantities_of(self.scene, self.mine)

    def run(self):
        self.forget_older_runs()
        meshes = [] if self.no_limit("mesh") else self.choice.meshes()
        steps = None if self.no_limit("time") else self.choice.steps(self.mine.instants())
        costs = [mesh.cost for mesh in meshes]
        share = sum(costs) + (steps.cost * min([1., *costs]) if steps else 0.)
        seconds = self.own.summary.get("processor_seconds", 0.)
        self.log(f"Error bars: companion runs, about {share * seconds:.2g} s "
                 f"({100 * share:.0f} % of the run)")
        self.in_space(meshes)
        self.in_time(steps)
        self.conclude()

    def conclude(self):
        """The bars of all quantities, into log and summary."""
        self.bars = bars = {
            quantity.name: self.bar(quantity) for quantity in self.quantities}
        if (stress := self.own.summary_number("extremes", "stress")) is not None:
            bars["largest_stress"] = no_bar(stress, NO_LIMIT + (
                ": the largest at quadrature points, which lie elsewhere on each mesh"))
        self.write(bars)

    def no_limit(self, part):
        """Why companions cannot show a part of the errors: the run has warned of it."""
        why = self.own.summary.get("no_limit", {}).get(part, "")
        return why and f"{NO_LIMIT}: {why}"

    def forget_older_runs(self):
        """Removes the companions of an earlier run in this directory."""
        begun = (self.results / "used.prm").stat().st_mtime
        for path in self.directory.glob("runs/*/finished.json"):
            if path.stat().st_mtime < begun:
                shutil.rmtree(path.parent)

    def companion(self, name, settings):
        """Histories of a companion run; None, with the reason in the log, if it fails."""
        run = self.runs.run(name, self.choice.common() | settings)
        if run.usable:
            return Histories(self.runs.folder(run), self.own.period), ""
        reason = " ".join(run.message.split()).split(". ")[0].rstrip(".")
        self.log(f"  {name} {run.status}: {reason}")
        return None, f"the companion run {name} {run.status}: {reason}"

    def in_space(self, meshes):
        """Runs companions on other meshes; if the coarser one is refused, on a finer."""
        self.meshes, self.why_no_mesh = [], self.no_limit("mesh")
        for mesh in [] if self.why_no_mesh else [*meshes, self.choice.finer()]:
            if mesh.ratio < 1. and self.meshes:
                break
            run, self.why_no_mesh = self.companion(mesh.name, mesh.settings)
            if run and self.choice.is_adaptive:
                unknowns = self.runs.known[mesh.name].unknowns
                mesh.ratio = (self.choice.unknowns / unknowns) ** (1. / self.choice.dim)
                if 1. / SMALLEST_RATIO < mesh.ratio < SMALLEST_RATIO:
                    run, self.why_no_mesh = None, (
                        f"the companion run {mesh.name} has {unknowns:.0f} unknowns, too "
                        "nearly as many as the run")
            if run:
                self.meshes.append((mesh, run))
            elif self.meshes:
                break

    def in_time(self, steps):
        """Steps are compared on the cheaper mesh."""
        on_mesh, base = {}, self.mine
        if self.meshes and self.meshes[0][0].ratio > 1.:
            on_mesh, base = self.meshes[0][0].settings, self.meshes[0][1]
        self.time, self.why_no_time = None, self.no_limit("time")
        if steps:
            run, self.why_no_time = self.companion(steps.name, on_mesh | steps.settings)
            self.time = run and (steps, base, run)

    def bar(self, quantity):
        value = largest(quantity, self.mine)
        if self.is_at_a_tip(quantity):
            return no_bar(value, NO_LIMIT + ": beside a crack tip")
        mesh, why = self.mesh_part(quantity, value)
        time, why_time = self.time_part(quantity)
        period = self.period_part(quantity, value)
        parts = {"mesh": mesh, "time": time, "period": period}
        if why or why_time:
            return no_bar(value, why or why_time) | parts
        return {"value": value, "bar": mesh + time + period, **parts}

    def mesh_part(self, quantity, value):
        if not self.meshes:
            return None, self.why_no_mesh
        changes, why = self.changes(quantity)
        if why:
            return None, why
        if self.choice.is_adaptive and quantity.of == "s":
            # It keeps the cells far from the tip: the probes stand for each other.
            changes = [max(rest) for rest in zip(*filter(None, (
                self.changes(other)[0] for other in self.quantities if other.of == "s")))]
        if quantity.of in OF_A_TIP and self.grows(quantity, changes):
            return None, NO_LIMIT + ": it grows as the cells are halved"
        kind = quantity.of
        if kind == "force" and self.choice.has_singular_tip and self.tip_opens():
            kind = "opening"
        part = self.choice.mesh_part(kind, changes, [mesh.ratio for mesh, _ in self.meshes])
        of_sliding = SLIDING * mode_two_of_closed_tip(quantity, self.mine)
        if len(changes) == 1:
            # Two estimates that may be wrong by like factors: their mean, if that is more.
            part = max(part, (part * error_of_tip(quantity, self.mine, self.scene)) ** .5)
        return max(part, SAFETY * min(abs(value), of_sliding)), ""

    def tip_opens(self):
        """Whether lips press somewhere while a tip has a singular stress: that of two lips,
        which slide, or of a tip that opens before the rest of the lip. The contact force
        then has the error of an opening."""
        lip, tips = self.own.tables.get("lip.csv"), self.tips()
        if has_two_lips(self.scene) or lip is None or not tips:
            return has_two_lips(self.scene)
        nearest = numpy.min([numpy.hypot(lip["x"] - x, lip["y"] - y) for x, y in tips], axis=0)
        closed = lip["closed_part"]
        return closed[nearest <= nearest.min()].max() < .99 * closed.max()

    def grows(self, quantity, changes):
        """Whether a stress grows from mesh to mesh, by more than rounding."""
        if len(changes) < 2:
            return False
        coarsest, coarser = (largest(quantity, run) for _, run in self.meshes[::-1])
        finest = largest(quantity, self.mine)
        rounding = ROUNDING * (self.own.summary_number("extremes", "stress") or 0.)
        return (finest > coarser > coarsest and changes[0] > FALLS * changes[1]
                and changes[0] > max(LARGE * finest, rounding))

    def changes(self, quantity):
        """Differences from mesh to mesh, or why there are none."""
        changes, finer = [], self.mine
        for _, run in self.meshes:
            change, why = difference(quantity, finer, run)
            if change is None:
                return changes, "" if changes else why
            changes.append(change)
            finer = run
        return changes, ""

    def time_part(self, quantity):
        if self.time is None:
            return (None, self.why_no_time) if self.why_no_time else (0., "")
        other, base, run = self.time
        change, why = difference(quantity, base, run)
        if change is None:
            return None, why
        order = 1. if other.name == "smaller_tolerance" else self.choice.order_in_time
        return factor(other.ratio, order) * change, ""

    def period_part(self, quantity, value):
        """The estimated error of the stress that the run has printed, relative; none if
        no periodic state is asked for. Drift is what displacements gain in a period."""
        if float(self.scene["Periodic state/Tolerance"]) == 0.:
            return 0.
        estimates = self.own.summary.get("stress_error_estimate") or [0.]
        part = next((part for part in reversed(estimates) if is_number(part)), 0.)
        if quantity.of == "drift":
            value = (self.own.summary_number("extremes", "displacement") or 0.
                     ) / self.own.period
        return part * (with_intensity(quantity, self.mine, self.scene) or abs(value))

    def is_at_a_tip(self, quantity):
        if quantity.of not in OF_A_TIP:
            return False
        cell = self.own.summary.get("smallest_cell") or 0.
        return any(math.dist(quantity.probe[:len(tip)], tip) <= cell
                   for tip in self.tips())

    def tips(self):
        """Crack tips in the plane, or of a straight front of a built-in shape."""
        summary, shape = self.own.summary, self.scene["Geometry/Shape"]
        named = summary.get("crack_tips") or [summary.get("crack_tip") or {}]
        tips = [tip["position"] for tip in named if tip.get("position")]
        if not tips and "crack" in shape:
            length = float(self.scene["Geometry/Crack length"])
            tips = [(length if shape == "centre crack" else
                     float(self.scene["Geometry/Width"]) - length, 0.)]
        return tips

    def write(self, bars):
        path = self.results / "summary.json"
        summary = json.loads(path.read_text(encoding="utf-8"))
        summary["bars"] = bars
        replace_estimates(bars, summary)
        write_file(path, json.dumps(summary, indent=2, ensure_ascii=False) + "\n")
        lines = [*table_of(bars), *to_halve(bars, self.choice, self.own)]
        for line in lines:
            self.log(line)
        path = self.results / "log.txt"
        log = path.read_text(encoding="utf-8").partition(lines[0])[0]  # without older ones
        write_file(path, log + "".join(line + "\n" for line in lines))


def replace_estimates(bars, summary):
    """Makes the estimated errors of tips in a summary those of the bars, so that K has
    one error."""
    alone = [summary[name] for name in ("crack_tip", "crack_front") if name in summary]
    for tips in summary.get("crack_tips", alone), summary.get("creep_integrals", []):
        for k, tip in enumerate(tips, 1):
            for estimate in ESTIMATES.keys() & tip.keys():
                found = [bars[name]["bar"] for kind in ESTIMATES[estimate]
                         if (name := f"{kind}_{k}" if len(tips) > 1 else kind) in bars]
                if found and None not in found:
                    tip[estimate] = max(found)


def no_bar(value, why):
    return {"value": value, "bar": None, "mesh": None, "time": None, "period": None,
            "why": why}


def bars_of(options, program, log):
    overrides = dict(text.partition("=")[::2] for text in options.set)
    return Bars(options.results, Runs(program, options.scene, overrides,
                                      options.results / "bars", log, False), log)


def main(words):
    return make_runs(bars_of, arguments(words), "bars.log", "The results and the finished "
                     "companion runs are kept: repeat the command with --resume.")
