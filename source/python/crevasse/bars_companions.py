# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The runs that error bars compare a run with: the same scene with larger (or smaller)
cells, or with other steps, and the factor by which a difference becomes an error."""

import dataclasses
import math

from crevasse.quantities import has_crack, has_lip

ORDERS = {"euler": 1.}  # of time schemes; all others have 2 or more
LINEAR_CREEP = ("relaxation time", "isotropic", "matrix", "chain")
SMALLEST_RATIO = 1.2  # of the sizes of cells, that a difference says something
# Factors of safety: of Roache's grid convergence index; at a tip, where coarse meshes
# have not reached their order; and where an adaptive mesh keeps cells of its companion.
SAFETY, SAFETY_AT_TIP, SAFETY_ADAPTIVE = 1.25, 1.5, 2.
LOCAL = ("s", "pressure")
OF_CONTACT = ("s", "pressure", "force", "closed_part", "K_opening", "Delta_K_eff")


@dataclasses.dataclass
class Companion:
    """A run with cells or steps that are `ratio` times as large."""
    name: str
    settings: dict
    ratio: float
    cost: float  # predicted, as part of the run's


def factor(ratio, order, safety=SAFETY):
    """Bar of a run as a multiple of its difference from a companion: errors c h^p of the
    run and c (ratio h)^p of the companion differ by |ratio^p - 1| c h^p."""
    return safety / abs(ratio ** order - 1.)


def order_of_scheme(scene):
    """Order in time: 1 with friction, whatever the scheme, where the instants at which
    lips open, close and begin to slide are not located."""
    scheme, creep = scene["Time integration/Scheme"], scene["Material/Viscosity"]
    locates = creep != "none" and (
        scene["Time integration/Locate contact events"] == "true"
        or scheme == "automatic" and creep in LINEAR_CREEP)
    if scene["Boundary/Friction coefficient"] != "0" and not locates:
        return 1.
    return ORDERS.get(scheme, 2.)


class Choice:
    """Companions that suit a scene."""

    def __init__(self, run):
        self.scene, self.summary = run.parameters, run.summary
        self.dim = run.dimension
        effects = self.summary.get("effects", {})
        self.functions = effects.get("singular functions", {}).get("on")
        self.has_singular_tip = has_crack(self.scene) and not self.functions
        self.is_adaptive = self.scene["Refinement/Strategy"] == "adaptive"
        self.unknowns = self.summary["unknowns"]

    def number(self, name):
        return int(self.scene[name])

    def order_in_space(self, kind):
        """Order of a quantity. The energy of a crack tip without singular functions, and
        with it K and displacements, converges as h, on optimal adaptive meshes as
        h^(2 Degree); singular functions leave the next term, r^(3/2), whose energy
        converges as h^3. Stress and pressure at points, and bodies without a tip, are
        limited by the ends of the contact zone: h^(3/2). The contact force is a
        product of energies, as is the instant at which a lip closes, and as ends move
        by cells it converges as h^2."""
        degree = self.number("Discretisation/Degree")
        if self.is_adaptive:
            return 2. * degree
        if self.functions:
            return min(degree + (kind not in LOCAL), 2. if kind in OF_CONTACT else 3.)
        if kind == "force":
            return 2.
        return 1.5 if kind in LOCAL or not self.has_singular_tip else 1.

    def mesh_part(self, kind, changes, ratios):
        """The bar's part from the mesh, of the changes between meshes with ratios of
        their cells. Where the error changes its sign, the first change may vanish: the
        second shows it, unless errors fall faster than elements of this degree let them.
        """
        order = self.order_in_space(kind)
        change = changes[0]
        if len(changes) == 2 and ratios[1] >= SMALLEST_RATIO * ratios[0]:
            degree = self.number("Discretisation/Degree")
            fast = factor(ratios[1] / ratios[0], degree + 2., 1.) / (
                factor(1. / ratios[0], degree + 2., 1.))
            change = max(change, changes[1] * fast)
        safety = (SAFETY_ADAPTIVE if self.is_adaptive else
                  SAFETY_AT_TIP if order == 1. else SAFETY)
        return factor(ratios[0], order, safety) * change

    @property
    def order_in_time(self):
        """Schemes have order 2 or more, but a lip's opening and closing are kinks, whose
        error depends on their place in the step, located or not: two runs show it
        with an order between 1 and 2."""
        order = order_of_scheme(self.scene)
        return min(order, 1.5) if has_lip(self.scene) else order

    def common(self):
        """Settings of all companions."""
        table = "Contact/Relaxation table"
        return self.same_periods() | ({table: ""} if self.scene[table] else {})

    def same_periods(self):
        """A march of the companion has the periods of the run, so that displacements are
        those of the same motion. Without tolerance it has them anyway."""
        if not (self.summary.get("periodic_method", "").startswith("march")
                and float(self.scene["Periodic state/Tolerance"])):
            return {}
        return {"Periodic state/Method": "march", "Periodic state/Tolerance": 0,
                "Periodic state/Maximum periods": self.summary["periods"]}

    def meshes(self):
        """A companion with cells twice as large and one with cells four times as large
        (of adaptive meshes one with half of the unknowns); where the mesh cannot be
        coarsened, one with half the cells' size."""
        coarser = [mesh for times in (1, 2)[:1 if self.is_adaptive else 2]
                   if (mesh := self.coarser(times))]
        return coarser or [self.finer()]

    def coarser(self, times):
        """The mesh with cells 2^times as large; None if there is none."""
        settings, ratio = {}, 2. ** times
        if self.is_adaptive:
            ratio = 2. ** (times / self.dim)
            settings = {"Refinement/Cycles": 0, "Refinement/Tolerance": 0}
        else:
            refinements = self.number("Geometry/Refinements")
            settings = {"Geometry/Refinements": max(refinements - times, 0)}
            if times > refinements:
                coarse = self.subdivided(2. ** (times - refinements))
                if coarse is None:
                    return None
                settings["Geometry/Subdivisions"], ratio = coarse
                ratio *= 2. ** refinements
        if self.number("Refinement/Target unknowns") or "Refinement/Cycles" in settings:
            settings["Refinement/Target unknowns"] = round(
                self.unknowns / ratio ** self.dim)
        return Companion("coarser" if times == 1 else "coarsest", settings, ratio,
                         ratio ** -self.dim)

    def finer(self):
        settings = {"Geometry/Refinements": self.number("Geometry/Refinements") + 1}
        if target := self.number("Refinement/Target unknowns"):
            settings["Refinement/Target unknowns"] = 2 ** self.dim * target
        return Companion("finer", settings, .5, 2.5 ** self.dim)

    def subdivided(self, times):
        return subdivided(self.scene, self.summary.get("subdivisions"), times)

    def steps(self, instants):
        return steps(self.scene, 2, instants)


def steps(scene, times, instants=None):
    """The companion with steps of half the length, or a quarter of the tolerance, also of
    elastic bodies, whose extremes lie between instants; or the run with so many times as
    many steps. Longer steps would be cheaper, but they may miss what the run's steps
    show. Given the instants of a period, in which steps end at rows of tables, too."""
    control, section = scene["Time integration/Step control"], "Time integration/"
    name = section + "Steps per period"
    if control == "uniform" and len(instants or ()) <= int(scene[name]) + 1:
        return Companion("shorter_steps", {name: times * int(scene[name])}, 1. / times,
                         float(times))
    if control != "adaptive":
        instants = instants or [0., *map(float, scene[section + "Steps"].split(",")),
                                float(scene["Loads/Period"])]
        divided_steps = {a + (b - a) * k / times for a, b in zip(instants, instants[1:])
                         for k in range(times)}
        return Companion("shorter_steps", {
            section + "Step control": "list",
            section + "Steps": ", ".join(map(repr, sorted(divided_steps - {0.})))},
            1. / times, float(times))
    return Companion("smaller_tolerance", {
        name: float(scene[name]) / times ** 2
        for kind in ("Relative", "Absolute") if (name := f"{section}{kind} tolerance")},
        1. / times ** 2, .8 * times)


def subdivided(scene, n, times):
    """Subdivisions divided by a number, and how many times larger the cells become; None
    if that is impossible. The crack tip stays a vertex."""
    if scene["Geometry/Shape"] == "mesh file":
        return None
    fraction = None
    if "crack" in scene["Geometry/Shape"]:
        fraction = (float(scene["Geometry/Crack length"])
                    / float(scene["Geometry/Width"]))
    first = divided(n[0], times, fraction)
    coarse = [first] + [max(1, round(k * first / n[0])) for k in n[1:]]
    ratio = math.prod(k / c for k, c in zip(n, coarse)) ** (1. / len(n))
    if ratio < SMALLEST_RATIO * times / 2. or (fraction and first < 2):
        return None
    return ", ".join(map(str, coarse)), ratio


def divided(n, times, fraction):
    """The number of cells nearest to n/times that puts a vertex at a fraction, if n
    does."""
    def has_vertex(k):
        return fraction is None or abs(k * fraction - round(k * fraction)) < 1e-9

    near = [k for k in range(max(1, math.ceil(.7 * n / times)), int(1.45 * n / times) + 1)
            if has_vertex(k) or not has_vertex(n)]
    return min(near or [math.ceil(n / times)],
               key=lambda k: (abs(math.log(k * times / n)), -k))
