# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""One life along a curved path: each run has the crack that the runs before have made
grow, in the direction of the largest hoop stress, and a mesh of its own. A second path
with doubled steps gives the errors of path and N."""

import copy
import types

import numpy
from numpy.linalg import norm

from crevasse.command import CommandError
from crevasse.life_body import Body
from crevasse.life_run import ENDS, LARGEST_KINK, Life
from crevasse.wording import plural

GAP = 2.5  # steps from a border, below which the step is halved
SMALLEST = 1 / 32  # of the step
FACTORS = 1., 0.8, 0.5  # of the mesh size, where a mesh fails
MOST_STEPS = 2000
RICHARDSON = 1 / 3  # of the difference that doubled steps of second order make
ROUNDING = 1e-9
AS_DRAWN = 1e-3  # difference of --from and the crack


def unit(degrees):
    angle = numpy.radians(degrees)
    return numpy.array([numpy.cos(angle), numpy.sin(angle)])


def between(one, other):
    """The angle from another direction to one, in degrees, at most 180."""
    return (one - other + 180.) % 360. - 180.


def direction(heading, before, step, step_before):
    """The mean direction over the next step, of second order (Adams-Bashforth)."""
    return heading + between(heading, before) * step / step_before / 2


class PathLife(Life):
    is_path = True

    def __init__(self, options, program, log):
        super().__init__(options, program, log)
        self.steps, self.chosen, self.places = [], [], [self.body.tip]
        self.companion = None

    def possible_lengths(self, options, scene):
        """The lengths are known when the crack has grown."""
        if options.vary or options.lengths:
            raise CommandError("--path: the path gives the lengths; leave out --vary and "
                               "--lengths.", 2)
        source = scene["Geometry/Mesh file"]
        if scene["Geometry/Shape"] != "mesh file" or not source.lower().endswith(".geo"):
            raise CommandError("--path: needs a body that is meshed anew for each length: "
                               "[Geometry] Shape = mesh file, and a .geo file as Mesh "
                               f"file, not \"{source or scene['Geometry/Shape']}\". It may "
                               "merge a .brep file, and add the first crack.", 2)
        cracks = [name.strip() for role in ("Crack", "Open crack")
                  for name in scene[f"Boundary/{role}"].split(",") if name.strip()]
        self.body = Body(source, options.trust_mesh, cracks, options.tip)
        start = self.body.length
        if options.start and abs(options.start / start - 1) > AS_DRAWN:
            raise CommandError(f"--from {options.start:g}: the crack of {source} is "
                               f"{start:g} long. Draw one of this length, or leave out "
                               "--from.", 2)
        if options.end and options.end <= start:
            raise CommandError(f"--to {options.end:g}: the crack is {start:g} long at the "
                               "beginning; give a longer one.", 2)
        self.step = options.step or start / 10
        return types.SimpleNamespace(start=start, end=options.end or numpy.inf, why="--to",
                                     all=[], settings={}, names=[], body_ends=None)

    def run(self):
        self.log(f"Crevasse: path of {self.options.scene.name} from a = "
                 f"{self.text(self.lengths.start)} at ({self.body.tip[0]:g}, "
                 f"{self.body.tip[1]:g}), steps of {self.text(self.step)}")
        self.follow()
        if len(self.steps) < 2:
            why, K = self.lengths.why, self.nodes[0, self.chosen[-1]].drivers["K_max"]
            is_law = why in ("arrest", "law")
            raise CommandError(
                f"The path ends after {plural(len(self.steps), 'step')}, at a = {self.a:g} "
                f"with K_max = {K:.5g}: {ENDS.get(why, why)}"
                + ("." if is_law else "; choose a smaller --step."), 3 if is_law else 2)
        self.log("  the same with doubled steps, for the errors")
        options = copy.copy(self.options)
        options.output, options.step = self.directory / "doubled_steps", 2 * self.step
        other = self.companion = PathLife(options, self.program, self.log)
        pairs = [sum(self.steps[k:k + 2]) for k in range(0, len(self.steps), 2)]
        other.follow(pairs)
        same = [min(2 * k, len(self.steps)) for k in range(len(other.places))]
        differences = norm(numpy.array(self.places)[same] - other.places, axis=1)
        self.path_errors = ([other.lengths.all[k] for k in other.chosen],
                            RICHARDSON * differences)
        self.ends_alike = other.a >= self.a - max(pairs) * (1 + ROUNDING)
        if not self.ends_alike:
            self.path_errors = [self.lengths.start, self.a], [numpy.inf] * 2
            self.warnings["other"] = (
                f"with doubled steps the path ends elsewhere: by {other.lengths.why} at "
                f"a = {other.a:g}")
        self.run_warnings |= {(*key, "doubled"): texts
                              for key, texts in other.run_warnings.items()}
        self.runs += other.runs
        self.new_runs += other.new_runs
        found = self.estimate(self.chosen)
        found.path_error = numpy.interp(found.edges, *self.path_errors)
        x, y = self.places[-1]
        self.log(f"  {len(self.chosen)} lengths: {found.words}\n  the path ends at "
                 f"({x:.5g}, {y:.5g}), estimated error "
                 f"{self.text(found.path_error[-1], digits=2)}")
        self.conclude(found, self.chosen)

    def follow(self, given=()):
        """Lets the crack grow by given steps, or until something ends it."""
        step, ahead = self.step, None
        heading = before = self.find([self.body.tip], self.lengths.start)
        self.chosen.append(len(self.lengths.all) - 1)
        while not (why := self.end_here()) and len(self.steps) < MOST_STEPS:
            last, n = self.places[-1], len(self.steps)
            kink = 0. if ahead is None else abs(between(heading, ahead))
            step, why = self.within(self.next_step(step, kink), last, unit(heading))
            if given and not why:
                step = given[n] if n < len(given) else 0.
                distance, what = self.body.ahead(last, unit(heading))
                why = what if distance <= step else "" if step else "steps"
            if why:
                break
            if n == 0:  # Heun
                there = self.find([last, last + step * unit(heading)], self.a + step,
                                  "_predicted")
                ahead = heading + between(there, heading) / 2
            else:
                ahead = direction(heading, before, step, self.steps[-1])
            place = last + step * unit(ahead)
            try:
                before, heading = heading, self.find([*self.places, place], self.a + step)
            except CommandError as error:
                if n < 2 or error.status not in (2, 3):
                    raise
                self.warnings["mesh"], why = str(error), f"mesh at a = {self.a:g}"
                break
            self.places.append(place)
            self.steps.append(step)
            self.chosen.append(len(self.lengths.all) - 1)
        self.lengths.end, self.lengths.why = self.a, why or "steps"

    @property
    def a(self):
        return self.lengths.start + sum(self.steps)

    def end_here(self):
        """What ends the growth at the last length; nothing if it goes on."""
        nodes = [self.nodes[member, self.chosen[-1]] for member in range(len(self.files))]
        if self.a >= self.lengths.end * (1 - ROUNDING):
            return "--to"
        growth = sum(reader.ask({"theta": [node.theta], **{
            name: [value] for name, value in node.drivers.items()}}).sum()
            + (node.creep[0] if reader.history else 0.)
            for reader, node in zip(self.readers, nodes))
        if numpy.isinf(growth):
            return "K_c"
        return "" if growth > 0. else "law" if numpy.isnan(growth) else "arrest"

    def next_step(self, step, kink):
        """Halves the step after a large kink, and doubles it after a small one."""
        if kink > LARGEST_KINK:
            return max(step / 2, SMALLEST * self.step)
        return min(2 * step, self.step) if kink < LARGEST_KINK / 2 else step

    def within(self, step, point, ahead):
        """A step that ends well before a border, or what the crack has reached."""
        gap, nearest = self.body.gap(point)
        smallest = SMALLEST * self.step
        while step > smallest and gap < GAP * step:
            step = max(step / 2, smallest)
        distance, what = self.body.ahead(point, ahead)
        if distance <= GAP * smallest or gap <= smallest / 2:
            return step, what if distance <= GAP * smallest else nearest
        return min(step, self.lengths.end - self.a), ""

    def find(self, points, a, suffix=""):
        """The direction in which the crack along these points would grow, in degrees;
        other mesh sizes are tried where a mesh fails."""
        k, lengths = len(self.lengths.all), self.lengths
        lengths.all.append(a)
        lengths.names.append(f"a_{a:.10g}{suffix}")
        for reader in self.readers:
            reader.place = points[-1]
        step = norm(points[-1] - points[-2]) if len(points) > 1 else self.step
        failure = None
        for factor in FACTORS:
            try:
                path = self.body.mesh(self.directory / "meshes", lengths.names[k], points,
                                      step, factor)
                lengths.settings[k] = [f"Geometry/Mesh file={path}"]
                self.compute([k])
                return self.nodes[0, k].angle
            except CommandError as error:
                if error.status not in (2, 3):
                    raise
                failure = failure or error
        raise CommandError(f"At a = {a:g} neither the mesh nor two others can be used: "
                           f"{failure}", 3)

    def name(self, k):
        return self.lengths.names[k]

    def settings_of_length(self, k):
        return self.lengths.settings[k]

    def comparisons(self, chosen):
        other = self.companion
        return [("error_of_lengths", other.growth(other.chosen),
                 RICHARDSON if self.ends_alike else numpy.inf),
                ("error_of_mesh", self.growth(chosen, with_error=True), 1.)]

    def advice(self, found):
        return (super().advice(found) if found.error_of_mesh >= found.error_of_lengths else
                "choose a smaller --step.")
