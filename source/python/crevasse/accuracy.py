# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Computes a scene to an accuracy: repeats it on finer meshes and with shorter steps
until the error bars are small enough. The parts of the bars predict the mesh and the
steps that suffice at the least cost. "crevasse SCENE --accuracy 1e-3" calls this."""

import json
import math
import pathlib
import re
import shutil

from crevasse.accuracy_tries import APART, PARTS, Mesh, Tries, Try
from crevasse.bars_companions import order_of_scheme, steps, subdivided
from crevasse.bars_text import row
from crevasse.command import CommandError, Parser, write_file
from crevasse.quantities import has_crack
from crevasse.results import parse_parameters
from crevasse.sweep import make_runs
from crevasse.sweep_folder import RESULTS, Folder

SUBDIVISIONS, REFINEMENTS = "Geometry/Subdivisions", "Geometry/Refinements"
TARGET, MOST_PERIODS = "Refinement/Target unknowns", "Periodic state/Maximum periods"
OF_MESH = (SUBDIVISIONS, REFINEMENTS, TARGET, "Refinement/Cycles", "Refinement/Tolerance")
MOST_TRIES, MOST_UNKNOWNS = 8, 500_000
GROWTH, FINEST, LARGEST_JUMP = 1.15, 64., 4.  # of the cells' number along an edge
TIMES_STEPS = 1, 2, 3, 4, 5, 6, 8, 10, 12, 16, 20, 24, 32  # the scene's: loads may jump
AIM, OF_PERIODS = .9, .1  # of the accuracy: what predictions aim at, and for the period
WIDER = 1.4  # bars of steps by companions with longer steps than by shorter ones
TWICE, FALLS = 2., .8  # on cells of half the size bars fall at least so far
ADAPTIVE = '. Try --set "Refinement/Strategy=adaptive"'
BEST_AT_TIP = {"Discretisation/Degree": 2, "Discretisation/Singular functions": 2}


def arguments(words):
    parser = Parser("SCENE", description=__doc__)
    parser.add_argument("--accuracy", type=float, required=True)
    parser.add_argument("--for", dest="quantities", default="")
    parser.add_common("results/<scene name>")
    return parser.parse(words)


class Accuracy:
    def __init__(self, options, program, log):
        self.wish, self.log = options.accuracy, log
        self.names = [name.strip() for name in options.quantities.split(",")
                      if name.strip()]
        overrides = dict(text.partition("=")[::2] for text in options.set)
        scene = parse_parameters(program.parameters(options.scene, overrides))[0]
        self.title, self.scene, self.tries = options.scene.name, scene, []
        self.directory = options.output or pathlib.Path(
            scene["Output directory"] or f"results/{options.scene.stem}")
        self.runs = Tries(scene, program, options.scene, overrides, self.directory,
                          lambda line: log.write(line + "\n"))
        self.common = {"Contact/Solver": "automatic",
                       "Output/Fields": scene["Output/Fields"]}
        if scene["Contact/Relaxation table"]:
            self.common["Contact/Relaxation table"] = ""
        if 0. < (tolerance := float(scene["Periodic state/Tolerance"])):
            self.common["Periodic state/Tolerance"] = (
                f"{min(tolerance, OF_PERIODS * self.wish):g}")
            self.common[MOST_PERIODS] = max(200, int(scene[MOST_PERIODS]))
        # Discontinuities in space should stay at sides of cells.
        self.is_smooth = not any(re.search(r"[<>]|\bif\b", text)
                                 for text in scene.values())
        # Of a period; of other controls how many times as short.
        self.n = {"uniform": int(scene["Time integration/Steps per period"]),
                  "list": scene["Time integration/Steps"].count(",") + 2}.get(
                      scene["Time integration/Step control"], 1)
        self.parts_in_time = {}  # of so many times as many steps

    def run(self):
        self.log(f"{self.title} to {self.wish:g}")
        last, why = self.first_try(), ""
        while not why and last.parts["bar"] > self.wish:
            mesh, times, why = self.prediction(last)
            if why:
                break
            last = self.attempt(mesh, times) or last
            if self.latest is not last.run:
                why = f"the next try {self.latest.status}: {self.latest.message}"
        self.conclude(last, why)

    def first_try(self):
        """The scene with its own steps, on the coarsest mesh of which a coarser one serves
        as companion. Where a tip has no singular functions, K and openings converge with
        order 1 only: it gets them if it may."""
        scene, common = self.scene, self.common
        lacks_functions = (
            scene["Discretisation/Singular functions"] in ("0", "automatic")
            and has_crack(scene)
            and scene["Refinement/Strategy"] != "adaptive")
        for elements in [BEST_AT_TIP] * lacks_functions + [{}]:
            self.common = common | elements
            for mesh in self.first_meshes():
                if not self.compute(mesh, 1):
                    continue
                try:
                    if mesh.times == 1. or self.is_smooth and self.runs.meshes:
                        return self.attempt(mesh, 1)
                except CommandError:  # large cells may have no bar beside a tip
                    if mesh.times == 1.:
                        raise
                if mesh not in self.runs.meshes:
                    self.runs.meshes.append(mesh)
        raise CommandError(self.latest.message, self.latest.exit_status or 3)

    def first_meshes(self):
        """The scene's own mesh, after those with cells four times and twice as large."""
        own = {name: self.scene[name] for name in OF_MESH}
        if self.scene["Refinement/Strategy"] != "adaptive" and own[TARGET] == "0":
            for k in (2, 1):
                n = int(own[REFINEMENTS])
                if n >= k:
                    yield Mesh(.5 ** k, own | {REFINEMENTS: n - k})
                elif own[SUBDIVISIONS] != "automatic" and (coarse := subdivided(
                        self.scene, [int(m) for m in own[SUBDIVISIONS].split(",")],
                        2. ** (k - n))):
                    yield Mesh(.5 ** n / coarse[1], own | {
                        REFINEMENTS: 0, SUBDIVISIONS: coarse[0]})
        yield Mesh(1., own)

    def compute(self, mesh, times):
        self.runs.of_try = self.common | mesh.settings | steps(self.scene, times).settings
        self.latest = self.runs.run("try", {})
        if self.latest.usable:
            self.runs.serves_as_companion(self.latest)
        return self.latest.usable

    def attempt(self, mesh, times):
        """A try with its bars; None if the run fails."""
        if not self.compute(mesh, times):
            return None
        found = Try(self.runs, self.latest, mesh, times, self.names)
        found.seconds = self.runs.seconds() - sum(one.seconds for one in self.tries)
        self.parts_in_time[times] = found.parts["time"]
        if not self.tries:
            self.log(f"  try unknowns steps{found.worst:>20}  ±  of value     mesh    steps  "
                     "periods  CPU (s)")
        self.tries.append(found)
        name = self.tries[0].worst
        self.log(f"{len(self.tries):5}{found.run.unknowns:9.0f}{self.n * times:6}"
                 f"{found.bars[name]['value']:20.6g}  ± "
                 + "".join(f"{found.parts[part]:9.1e}" for part in PARTS)
                 + f"{found.seconds:9.2g}")
        return found

    def prediction(self, last):
        """Mesh and steps that meet the wish at the least cost: the parts of the bars fall
        with their orders. Or why there are none."""
        hint = ADAPTIVE * (last.choice.has_singular_tip and not last.choice.is_adaptive)
        if why := self.reason_to_end(last, hint):
            return None, 0, why
        wish = self.wish - min(last.parts["period"], self.wish / 2.)

        def bar_and_cost(choice):
            (finer, _), times = choice
            finer /= last.mesh.times
            mesh = last.parts["mesh"] * (finer ** -last.order / AIM if finer > 1. else 1.)
            is_there = choice[0] in self.runs.meshes and times == last.steps
            return (max(mesh + self.time_part(times), wish),
                    (not is_there) * finer ** last.choice.dim * times)

        times = 0
        while times not in self.parts_in_time:
            mesh, times = min(((mesh, times) for mesh in self.meshes(last)
                               for times in TIMES_STEPS), key=bar_and_cost)
            if mesh.times > LARGEST_JUMP * last.mesh.times:  # a try between costs little
                mesh = self.mesh(math.sqrt(mesh.times * last.mesh.times))
                times = last.steps
            if times not in self.parts_in_time:
                self.parts_in_time[times], times = last.time_part(times), 0
        if mesh is last.mesh and times == last.steps:
            return None, 0, "neither its mesh nor its steps can be refined further"
        unknowns = last.run.unknowns * (mesh.times / last.mesh.times) ** last.choice.dim
        return mesh, times, "" if unknowns <= MOST_UNKNOWNS else (
            f"the next try would have {unknowns:.2g} unknowns, more than {MOST_UNKNOWNS}{hint}")

    def reason_to_end(self, last, hint):
        if len(self.tries) >= MOST_TRIES:
            return f"{MOST_TRIES} tries did not suffice"
        if len(self.tries) > 1 and last.parts["bar"] > 1. or last.parts["period"] > 1.:
            return (f"{last.worst} is 0 within its bar, so that it has no relative "
                    "accuracy. Name other quantities by --for")
        if last.parts["mesh"] > self.wish and any(
                last.mesh.times >= TWICE * one.mesh.times
                and last.parts["mesh"] > FALLS * one.parts["mesh"] for one in self.tries):
            return "the part from the mesh does not fall as cells are divided" + hint
        return ""

    def time_part(self, times):
        """As known, or by the order of the scheme: kinks lower it, and then the runs of
        these steps show it."""
        known = max(k for k in self.parts_in_time if k <= times)
        order = order_of_scheme(self.scene)
        return self.parts_in_time[known] * (known / times) ** order * (
            WIDER if known == 1 < times else 1.)

    def meshes(self, last):
        """The mesh of a try, and finer ones; companions that are finer already exist."""
        count = math.ceil(math.log(FINEST) / math.log(GROWTH))
        finer = [*self.runs.meshes, *(self.mesh(last.mesh.times * GROWTH ** k)
                                      for k in range(1, count))]
        return [last.mesh, *(mesh for mesh in finer
                             if mesh and mesh.times > APART / 1.01 * last.mesh.times)]

    def mesh(self, times):
        """A mesh that is about so many times as fine as the scene's; None without one."""
        first, settings = self.tries[0], {}
        choice, target = first.choice, first.choice.number(TARGET)
        if choice.is_adaptive:
            settings = {"Refinement/Cycles": 0, "Refinement/Tolerance": 0}
            target = target or choice.unknowns
        elif self.scene["Geometry/Shape"] == "mesh file":
            more = math.ceil(math.log2(times / first.mesh.times) - 1e-6)
            settings = {REFINEMENTS: choice.number(REFINEMENTS) + more}
            times = first.mesh.times * 2. ** more
        elif divided := choice.subdivided(
                first.mesh.times / (times if self.is_smooth else round(times))):
            settings, times = {SUBDIVISIONS: divided[0]}, first.mesh.times / divided[1]
        else:
            return None
        if target:
            settings[TARGET] = round(
                target * (times / first.mesh.times) ** choice.dim)
        return Mesh(times, first.mesh.settings | settings)

    def conclude(self, last, why):
        """Copies the last try to the output directory, and says what was reached."""
        source = self.runs.folder(last.run)
        Folder(self.directory, (source / "used.prm").read_text()).prepare()
        for path in {path for pattern in RESULTS for path in source.glob(pattern)}:
            shutil.copy2(path, self.directory)
        seconds, path = self.runs.seconds(), self.directory / "summary.json"
        summary = json.loads(path.read_text(encoding="utf-8"))
        summary["accuracy"] = {
            "asked": self.wish, "quantities": list(last.scales), "processor_seconds": seconds,
            "why_not_reached": why, "tries": [
                {"unknowns": one.run.unknowns, "steps": self.n * one.steps,
                 "processor_seconds": one.seconds, **one.parts} for one in self.tries]}
        write_file(path, json.dumps(summary, indent=2, ensure_ascii=False) + "\n")
        for warning in summary.get("warnings", []):
            self.log("  warning: " + warning)
        for name in last.scales:
            self.log(row(name, last.bars[name]))
        settings = self.common | last.mesh.settings | (
            steps(self.scene, last.steps).settings if last.steps > 1 else {})
        if last.run.costs.get("periods", 0) <= int(self.scene[MOST_PERIODS]):
            settings.pop(MOST_PERIODS, None)
        self.log(f"  reached {last.parts['bar']:.2g} in {seconds:.2g} s of CPU time, "
                 f"{last.run.seconds:.2g} s of them for the result, which has\n    "
                 + " ".join(f"--set \"{name}={value}\"" for name, value
                            in settings.items() if str(value) != self.scene[name])
                 + f"\n  results in {self.directory}")
        if why:
            raise CommandError(
                f"the accuracy {self.wish:g} is not reached: {why}. The last try, with "
                f"a bar of {last.parts['bar']:.2g}, is in {self.directory}.", 3)


def main(words):
    return make_runs(Accuracy, arguments(words), "accuracy.log", "The finished runs are "
                     "kept: repeat the command to continue.")
