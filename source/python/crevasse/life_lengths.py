# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The crack lengths that a life may be computed from, with the settings of each, and
their order: errors of K that change from length to length, as where the tip is on no
grid line, would be far larger in N than those of the interpolation."""

import math

import numpy

from crevasse.command import CommandError
from crevasse.life_body import of_geometry
from crevasse.mesh_geo import by_gmsh, crack_lengths, mesh_in
from crevasse.results import number, shortest
from crevasse.sweep_plan import Plan

FEWEST_CELLS = 4  # from the first length to the last
LIGAMENT = 2  # cells of it that are left where no --to ends the growth
ON_A_LINE = 1e-6
FIRST, FEWEST = 5, 3  # lengths
OF_GEOMETRY = 32  # parts between the lengths of a geometry, which may be any


class Lengths:
    """Possible lengths, ascending, and the settings of each. The growth begins at
    "start" and ends at "end" at the latest, for the reason "why"."""

    def __init__(self, options, scene):
        self.why, self.trusts, self.body_ends = "--to", options.trust_mesh, None
        self.geometry = scene["Geometry/Mesh file"] * (
            scene["Geometry/Shape"] == "mesh file")
        if scene["Geometry/Crack growth"]:
            raise CommandError(f"[Geometry] Crack growth = {scene['Geometry/Crack growth']}: "
                               "each run of a life has one crack length. Leave it out.", 2)
        if options.vary or options.lengths:
            self.of_values(options)
        elif self.geometry.lower().endswith(".geo"):
            self.of_geometry(options)
        else:
            self.of_shape(options, scene)
        self.all = numpy.array(self.all)
        if not self.start < self.end:
            raise CommandError(f"--from {self.start:g} --to {self.end:g}: the growth ends "
                               "before it begins; give a longer crack by --to.", 2)

    def of_values(self, options):
        plan = Plan(options.vary)
        values = [point.values for point in plan.points]
        lengths = options.lengths
        if not lengths and plan.parameters == ["Geometry/Crack length"]:
            lengths = [number(value) or 0. for value, in values]
        if not lengths or len(lengths) != len(values):
            raise CommandError(f"--lengths has {len(lengths or [])} lengths for the "
                               f"{len(values)} values of --vary; each value needs the "
                               "length of its crack.", 2)
        if len(values) < FEWEST or sorted(set(lengths)) != lengths:
            raise CommandError(f"--lengths {','.join(map(shortest, lengths))}: must be at "
                               f"least {FEWEST} lengths that ascend.", 2)
        self.all = lengths
        self.settings = dict(enumerate(map(plan.settings, plan.points)))
        self.start, self.end = options.start or lengths[0], options.end or lengths[-1]
        if self.start < lengths[0]:
            raise CommandError(f"--from {self.start:g}: is shorter than the first of "
                               f"--lengths, {lengths[0]:g}.", 2)
        if not options.end or self.end > lengths[-1]:
            self.end, self.why = lengths[-1], "last length"

    def of_geometry(self, options):
        constants = of_geometry(by_gmsh, crack_lengths, self.geometry, self.trusts)
        if len(constants) != 1:
            raise CommandError(
                f"{self.geometry}: there are {len(constants)} constants with the name "
                "\"crack length\". Give the length as one: DefineConstant[ a = {1, Name "
                "\"crack length\"} ]; or let the crack turn by --path.", 2)
        (self.constant, own), = constants.items()
        if not options.end:
            raise CommandError("--to is missing: how long the crack becomes.", 2)
        self.start, self.end = options.start or own, options.end
        self.all = self.points(self.start, self.end, OF_GEOMETRY)
        self.settings = {}  # of the lengths that are meshed

    def settings_of(self, k, folder):
        """Settings of a length; meshes of geometries are made in the folder."""
        if k not in self.settings:
            a = float(self.all[k])
            path = of_geometry(mesh_in, folder, f"a_{a:.10g}", self.geometry, self.trusts,
                               constants={self.constant: a})
            self.settings[k] = [f"Geometry/Mesh file={path}"]
        return self.settings[k]

    @staticmethod
    def points(low, high, parts):
        """Chebyshev-Lobatto points, ascending."""
        return low + (high - low) * (1 - numpy.cos(
            numpy.pi * numpy.arange(parts + 1) / parts)) / 2

    def of_shape(self, options, scene):
        if scene["Geometry/Shape"] not in ("edge crack", "centre crack"):
            raise CommandError(
                f"[Geometry] Shape = {scene['Geometry/Shape']}: the length of its crack is "
                "not known. Give a .geo file with DefineConstant[ a = {1, Name \"crack "
                "length\"} ]; or meshes of several lengths, --vary \"Geometry/Mesh file="
                "a.msh,b.msh,c.msh\" --lengths 1,2,3.", 2)
        width = self.body_ends = float(scene["Geometry/Width"])
        self.start = options.start or float(scene["Geometry/Crack length"])
        for option, value in (("--from", self.start), ("--to", options.end or 0.)):
            if value >= width:
                raise CommandError(f"{option} {value:g}: the crack would leave the body, "
                                   f"whose Width is {width:g}.", 2)
        self.cells = cells = self.choose_cells(scene, options.end)
        last = cells[0] - (1 if options.end else LIGAMENT)
        self.end = min(options.end or width, last * width / cells[0])
        if self.end != options.end:
            self.why = "ligament"
        lines = range(max(math.floor(self.start * cells[0] / width + ON_A_LINE), 1),
                      min(math.ceil(self.end * cells[0] / width - ON_A_LINE), last) + 1)
        self.all = [line * width / cells[0] for line in lines]
        self.settings = {k: [f"Geometry/Crack length={shortest(a)}",
                             f"Geometry/Subdivisions={cells[0]}, {cells[1]}"]
                         for k, a in enumerate(self.all)}

    def choose_cells(self, scene, end):
        """Subdivisions with grid lines at both ends if there are some, and with some
        lines between them."""
        width, height = (float(scene[f"Geometry/{name}"]) for name in ("Width", "Height"))
        own = [number(text) for text in scene["Geometry/Subdivisions"].split(",")]
        if None in own:  # automatic
            size = max(min(self.start, width - (end or self.start), height) / 7,
                       max(width, height) / 64)
            own = [round(width / size), round(height / size)]
        last = end or width
        fewest = math.ceil(max(own[0], width / self.start - ON_A_LINE,
                               FEWEST_CELLS * width / max(last - self.start, 1e-3 * width)
                               - ON_A_LINE))
        n = next((n for n in range(fewest, 2 * fewest) if all(
            abs(a * n / width - round(a * n / width)) < ON_A_LINE
            for a in (self.start, last))), fewest)
        return n, max(1, round(own[1] * n / own[0]))

    def first(self):
        """Numbers of the first lengths, next to Chebyshev-Lobatto points."""
        points = self.points(*self.all[[0, -1]], FIRST - 1)
        points[[1, -1]] = points[[-1, 1]]  # the last one is left out for the error
        return list(dict.fromkeys(int(abs(self.all - x).argmin()) for x in points))

    def next(self, chosen, rates, within=None):
        """Number of the length to add, within two lengths if some are there: a Leja
        point, so that the interpolation stays close to that of Chebyshev points,
        weighted by the periods that the crack spends there; None if all are chosen.

        @param rates growth a period at all lengths."""
        # No time is spent beyond the toughness, where the rate is infinite, nor where the
        # law ends (nan). A crack that rests stays for ever: the longest time of other
        # lengths stands for it.
        grows = (rates > 0.) & numpy.isfinite(rates)
        weights = numpy.zeros(len(self.all))
        weights[grows] = 1 / rates[grows]
        weights[rates == 0.] = weights.max()
        if not weights.any():
            weights[:] = 1.
        others = [k for k in range(len(self.all)) if k not in chosen]
        if within:
            low, high = within
            others = [k for k in others if low < self.all[k] < high] or others
        return max(others, default=None, key=lambda k: weights[k] * abs(
            self.all[k] - self.all[chosen]).prod())
