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

from crevasse.accuracy_tries import PARTS, Mesh, Tries, Try
from crevasse.bars_companions import ORDERS
from crevasse.bars_text import row
from crevasse.command import CommandError, Parser, write_file
from crevasse.quantities import has_crack
from crevasse.results import parse_parameters
from crevasse.sweep import make_runs
from crevasse.sweep_folder import RESULTS, Folder

STEPS, SUBDIVISIONS = "Time integration/Steps per period", "Geometry/Subdivisions"
REFINEMENTS, TARGET = "Geometry/Refinements", "Refinement/Target unknowns"
OF_MESH = (SUBDIVISIONS, REFINEMENTS, TARGET, "Refinement/Cycles", "Refinement/Tolerance")
MOST_TRIES, MOST_UNKNOWNS = 8, 500_000
GROWTH, FINEST, LARGEST_JUMP = 1.15, 64., 4.  # of the cells' number along an edge
TIMES_STEPS = (1, 2, 3, 4, 6, 8, 12, 16, 24, 32)  # the scene's, at which loads may jump
AIM, OF_PERIODS = .8, .1  # of the accuracy: what predictions aim at, and for the period
MOST_PERIODS = 200
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
        self.runs = Tries(program, options.scene, overrides, self.directory,
                          lambda line: log.write(line + "\n"))
        self.common = {"Contact/Solver": "automatic"}
        if scene["Contact/Relaxation table"]:
            self.common["Contact/Relaxation table"] = ""
        if 0. < (tolerance := float(scene["Periodic state/Tolerance"])):
            self.common["Periodic state/Tolerance"] = (
                f"{min(tolerance, OF_PERIODS * self.wish):g}")
            self.common["Periodic state/Maximum periods"] = max(
                MOST_PERIODS, int(scene["Periodic state/Maximum periods"]))
        # Discontinuities in space should stay at sides of cells.
        self.is_smooth = not any(re.search(r"[<>]|\bif\b", text)
                                 for text in scene.values())
        self.n = int(scene[STEPS])

    def run(self):
        self.log(f"{self.title} to {self.wish:g}")
        last, why = self.first_try(), ""
        while not why and last.parts["bar"] > self.wish:
            mesh, steps, why = self.prediction(last)
            if why:
                break
            last = self.attempt(mesh, steps) or last
            if self.latest != last.run:
                why = f"the next try {self.latest.status}: {self.latest.message}"
        self.conclude(last, why)

    def first_try(self):
        """The scene on its own mesh with its own steps. Where a tip has no singular
        functions, K and openings converge with order 1 only: it gets them if it may."""
        scene, common = self.scene, self.common
        own = Mesh(1., {name: scene[name] for name in OF_MESH})
        lacks_functions = (
            scene["Discretisation/Singular functions"] in ("0", "automatic")
            and has_crack(scene)
            and scene["Refinement/Strategy"] != "adaptive")
        for elements in [BEST_AT_TIP] * lacks_functions + [{}]:
            self.common = common | elements
            if found := self.attempt(own, 1):
                return found
        raise CommandError(self.latest.message, self.latest.exit_status or 3)

    def settings(self, mesh, steps):
        return self.common | mesh.settings | {STEPS: self.n * steps}

    def attempt(self, mesh, steps):
        """A try with its bars; None if the run fails."""
        before, self.runs.of_try = self.runs.seconds(), self.settings(mesh, steps)
        self.latest = self.runs.run("try", {"Output/Fields": self.scene["Output/Fields"]})
        if not self.latest.usable:
            return None
        found = Try(self.runs, self.latest, mesh, steps, self.names)
        found.seconds = self.runs.seconds() - before
        if not self.tries:
            self.log(f"  try unknowns steps{found.worst:>20}  ±  of value     mesh    steps  "
                     "periods  CPU (s)")
        self.tries.append(found)
        name = self.tries[0].worst
        self.log(f"{len(self.tries):5}{found.run.unknowns:9.0f}{self.n * steps:6}"
                 f"{found.bars[name]['value']:20.6g}  ± "
                 + "".join(f"{found.parts[part]:9.1e}" for part in PARTS)
                 + f"{found.seconds:9.2g}")
        return found

    def prediction(self, last):
        """Mesh and steps that meet the wish at the least cost: the parts of the bars fall
        with their orders. Or why there are none."""
        if len(self.tries) >= MOST_TRIES:
            return None, 0, f"{MOST_TRIES} tries did not suffice"
        if any(one.mesh.times < last.mesh.times and one.parts["mesh"] < last.parts["mesh"]
               > self.wish for one in self.tries):
            return None, 0, "the part from the mesh does not fall as cells are divided"
        wish = AIM * self.wish - min(last.parts["period"], OF_PERIODS * self.wish)

        def bar_and_cost(choice):
            (times, _), steps = choice
            times /= last.mesh.times
            bar = last.parts["mesh"] / times ** last.order + self.time_part(steps)
            is_there = choice[0] in self.runs.meshes and steps == last.steps
            return max(bar, wish), (not is_there) * times ** last.choice.dim * steps

        mesh, steps = min(((mesh, steps) for mesh in self.meshes(last)
                           for steps in self.steps()), key=bar_and_cost)
        if mesh.times > LARGEST_JUMP * last.mesh.times:  # a try between costs little
            mesh, steps = self.mesh(math.sqrt(mesh.times * last.mesh.times)), last.steps
        if mesh is last.mesh and steps == last.steps:
            return None, 0, "neither its mesh nor its steps can be refined further"
        unknowns = last.run.unknowns * (mesh.times / last.mesh.times) ** last.choice.dim
        return mesh, steps, (f"the next try would have {unknowns:.2g} unknowns, more "
                             f"than {MOST_UNKNOWNS}") * (unknowns > MOST_UNKNOWNS)

    def steps(self):
        """How many times as many steps; other controls of steps are left as they are."""
        are_equal = self.scene["Time integration/Step control"] == "uniform"
        return TIMES_STEPS if are_equal else [1]

    def time_part(self, steps):
        """What the try with the next smaller number of steps lets expect, by the order of
        the scheme: kinks lower it, and a further try repairs that."""
        known = max((one for one in self.tries if one.steps <= steps),
                    key=lambda one: (one.steps, one.mesh.times))
        order = ORDERS.get(self.scene["Time integration/Scheme"], 2.)
        return known.parts["time"] * (known.steps / steps) ** order

    def meshes(self, last):
        """The mesh of a try, and finer ones; companions that are finer already exist."""
        count = math.ceil(math.log(FINEST) / math.log(GROWTH))
        finer = [*self.runs.meshes, *(self.mesh(last.mesh.times * GROWTH ** k)
                                      for k in range(1, count))]
        return [last.mesh, *(mesh for mesh in finer
                             if mesh and mesh.times > GROWTH / 1.01 * last.mesh.times)]

    def mesh(self, times):
        """A mesh that is about so many times as fine as the scene's; None without one."""
        choice, settings = self.tries[0].choice, {}
        target = choice.number(TARGET)
        if choice.is_adaptive:
            settings = {"Refinement/Cycles": 0, "Refinement/Tolerance": 0}
            target = target or choice.unknowns
        elif self.scene["Geometry/Shape"] == "mesh file":
            more = math.ceil(math.log2(times) - 1e-6)
            settings, times = {REFINEMENTS: choice.number(REFINEMENTS) + more}, 2. ** more
        elif divided := choice.subdivided(
                1. / (times if self.is_smooth else round(times))):
            settings, times = {SUBDIVISIONS: divided[0]}, 1. / divided[1]
        else:
            return None
        if target:
            settings[TARGET] = round(target * times ** choice.dim)
        return Mesh(times, self.tries[0].mesh.settings | settings)

    def conclude(self, last, why):
        """Copies the last try to the output directory, and says what was reached."""
        source = self.runs.folder(last.run)
        Folder(self.directory, (source / "used.prm").read_text()).prepare()
        for path in {path for pattern in RESULTS for path in source.glob(pattern)}:
            shutil.copy2(path, self.directory)
        seconds, path = self.runs.seconds(), self.directory / "summary.json"
        summary = json.loads(path.read_text(encoding="utf-8"))
        summary["accuracy"] = {
            "asked": self.wish, "quantities": last.names, "processor_seconds": seconds,
            "why_not_reached": why, "tries": [
                {"unknowns": one.run.unknowns, "steps": self.n * one.steps,
                 "processor_seconds": one.seconds, **one.parts} for one in self.tries]}
        write_file(path, json.dumps(summary, indent=2, ensure_ascii=False) + "\n")
        for warning in summary.get("warnings", []):
            self.log("  warning: " + warning)
        for name in last.names:
            self.log(row(name, last.bars[name]))
        settings = self.settings(last.mesh, last.steps)
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
