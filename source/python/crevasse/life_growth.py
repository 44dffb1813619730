# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""What drives the growth of a crack over its length, the growth by the scene's law,
which the program evaluates, and the periods N = integral of da/(da/dN)."""

import dataclasses
import json
import tempfile

import numpy
from scipy.interpolate import BarycentricInterpolator, PchipInterpolator

from crevasse import findings
from crevasse.command import CommandError
from crevasse.program import message_of, options
from crevasse.results import at
from crevasse.run_reader import Run

# What the law depends on, and the power of the length with which it grows in a large
# body under a given stress.
DRIVERS = {"K_max": 0.5, "Delta_K": 0.5, "Delta_K_eff": 0.5, "C_star": 1.}
ROUNDING = 1e-9
MIXED = 0.1  # K_II of the equivalent K, from which on that is no K_I
PARTS = 60  # between neighbouring lengths, each with Gauss points
ROWS = 10  # of life.csv between neighbouring lengths
GAUSS, WEIGHTS = numpy.polynomial.legendre.leggauss(4)


@dataclasses.dataclass
class Node:
    """A crack length, and what a run found there."""
    a: float
    drivers: dict
    state: tuple  # whether K is 0 at times, and whether the lip is closed at times
    error: float  # of K, relative
    place: tuple
    angle: float
    transition: float  # time until creep is steady
    creep: tuple  # growth a period, where a history drives it, also with the error
    theta: float = 0.  # temperature at K_max
    is_mixed: bool = False  # whether K is the equivalent of two modes


def last_period(table, period):
    """Rows of a table in the last period."""
    return table["t"] >= table["t"][-1] - (1 + ROUNDING) * period


def index_of_tip(places, tip):
    """The place of the tip with this number, which the user must give if there are several."""
    if len(places) > 1 and not tip or tip and tip > len(places):
        numbered = "; ".join(f"{k}: ({', '.join(f'{x:g}' for x in place)})"
                             for k, place in enumerate(places, 1))
        raise CommandError(f"there are {len(places)} crack tips: choose one by --tip N "
                           f"({numbered}).", 2)
    return (tip or 1) - 1


class Reader:
    """Reads nodes from runs of a scene, and asks the program for growth by its law."""

    def __init__(self, program, scene_file, settings, scene, tip):
        self.program, self.scene_file, self.settings = program, scene_file, settings
        self.period = float(scene["Loads/Period"])
        law = scene["Crack tip/Crack growth law"]
        if law == "none":
            raise CommandError(f"{scene_file}: [Crack tip] Crack growth law = none: a life "
                               "needs a law; set one in the scene or by --law.", 2)
        driver = scene["Crack tip/Creep growth parameter"] if (
            "creep" in law or law == "sum") else ""
        self.needs_c_star = driver == "C star"
        self.history = {"C(t)": "C_t", "stress intensity": "K"}.get(driver)
        self.needs_K = driver != "C(t)"
        self.effective = scene["Crack tip/Growth range"] == "Delta K eff"
        self.tip, self.place = tip, None  # a number, or near which place

    def ask(self, drivers):
        """Growth by fatigue and by creep for lists of drivers."""
        with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
            json.dump({name: [None if numpy.isnan(x) else float(x) for x in values]
                       for name, values in drivers.items()}, file)
            file.flush()
            call = self.program.finish(self.program.start(
                "growth", file.name, self.scene_file, *options(self.settings)))
        if call.status:
            raise CommandError(message_of(call), max(call.status, 2))
        return numpy.array(call.output.split(), dtype=float).reshape(-1, 2).T

    def choose_tip(self, run):
        tips = findings.tips_of(run.summary)
        if not tips:
            raise CommandError(f"{run.directory}: the run has no crack tip.", 2)
        if self.place is not None:
            distances = [numpy.linalg.norm(self.place - tip["position"]) for tip in tips]
            self.tip = 1 + int(numpy.argmin(distances))
        return tips[index_of_tip([tip["position"] for tip in tips], self.tip)]

    def node(self, a, directory):
        run = Run(directory)
        tip = self.choose_tip(run)
        def of_tip(*path):
            value = at(tip, path)
            return numpy.nan if value is None else value
        K = of_tip("equivalent_intensity", "largest")
        K = max(of_tip("K_I", "largest") if numpy.isnan(K) else K, 0.)
        drivers = {"K_max": K, **{name: of_tip(name) for name in list(DRIVERS)[1:]}}
        if "Delta_K_eff" not in tip:  # without contact
            drivers["Delta_K_eff"] = drivers["Delta_K"]
        self.require(a, tip, drivers)
        size = max(abs(of_tip("K_I", end)) for end in ("largest", "smallest"))
        error = (of_tip("K_I_error") / size if size > 0. else
                 of_tip("error_of_largest") / of_tip("largest") / 2)
        error = 0. if numpy.isnan(error) else error
        creep = numpy.nan, numpy.nan
        if self.history:
            t, driver, theta = self.table(run)
            power = 1 if self.history == "K" else 2
            creep = [self.ask({"t": t, "driver": factor**power * driver,
                               "theta": theta})[1][0] for factor in (1, 1 + error)]
        closed = at(tip, ("closed_part", "wholly")), at(tip, ("closed_part", "partly"))
        return Node(a, drivers, (drivers["Delta_K"] >= K * (1 - ROUNDING), any(closed)),
                    error, tip["position"], self.angle(tip),
                    of_tip("transition_time") if self.needs_c_star else numpy.nan,
                    creep, at(tip, ("theta",)) or 0., any(
                        abs(of_tip("K_II", end)) > MIXED * K
                        for end in ("largest", "smallest")))

    def angle(self, tip):
        """Direction of growth from straight ahead; of a path from the x axis."""
        angle = tip.get("growth_angle")
        if self.place is None:
            return angle or 0.
        if angle is None:
            raise CommandError("--path: the direction of growth is known for isotropic "
                               "bodies only. Leave out --path.", 2)
        x, y = tip["direction"]
        return angle + numpy.degrees(numpy.arctan2(y, x))

    def require(self, a, tip, drivers):
        for needed, driver, name, why, status in (
                (self.needs_K, "K_max", "K", "no_K", 3),
                (self.needs_c_star, "C_star", "C*", "no_C_star", 2),
                (self.effective, "Delta_K_eff", "Delta_K_eff", "no_K_opening", 3)):
            if needed and numpy.isnan(drivers[driver]):
                raise CommandError(f"at a = {a:g} {name} is not known: "
                                   f"{tip.get(why, 'the run has none')}", status)

    def table(self, run):
        """Instants, driver of creep and temperatures in the last period."""
        name = "crack_tip" if self.history == "K" else "creep_integral"
        table = run.tables.get(f"{name}.csv") or run.tables[f"{name}_{self.tip or 1}.csv"]
        column = table.get("equivalent_intensity", table.get("K_I", table.get("C_t")))
        last = last_period(table, self.period)
        t, driver = table["t"][last], column[last]
        theta = table.get("theta", numpy.zeros(len(column)))[last]
        begin = table["t"][-1] - self.period
        if t[0] > begin + ROUNDING * self.period:  # C(t) is not known at first
            t, driver, theta = (numpy.append(first, rest) for first, rest in (
                (begin, t), (numpy.nan, driver), (theta[-1], theta)))
        return t, driver, theta


def curve(a, values, power, piecewise=False):
    """Interpolates the values of a driver over the lengths a. What grows like a**power
    in a large body varies little after division by that: where it is positive at all
    lengths, its logarithm is interpolated by a polynomial, or by monotone cubics if that
    is to be piecewise. Values that are 0 somewhere have no logarithm: they are
    interpolated by monotone cubics. A driver that is unknown (nan) at a length is unknown
    between the lengths, too."""
    rest = values / a**power
    if not (rest > 0.).all():
        if numpy.isnan(rest).any():
            return lambda x: numpy.full(numpy.shape(x), numpy.nan)
        line = PchipInterpolator(a, rest)
        return lambda x: x**power * numpy.maximum(line(x), 0.)
    line = (PchipInterpolator if piecewise else BarycentricInterpolator)(
        a, numpy.log(rest))
    return lambda x: x**power * numpy.exp(line(x))


def curves(a, nodes, piecewise):
    """Interpolates all drivers. The length at which a tip or a lip begins to close is a
    kink of K_min or K_op, and so of the ranges, but not of K_max. With such a length
    among the nodes, K_min and K_op are interpolated by monotone cubics, which a kink
    spoils only near itself, and each range is K_max less one of them."""
    values = {name: numpy.array([node.drivers[name] for node in nodes])
              for name in DRIVERS}
    found = {name: curve(a, values[name], power, piecewise)
             for name, power in DRIVERS.items()}
    if kink(nodes):
        def above(lower):
            return lambda x: found["K_max"](x) - numpy.sqrt(x) * lower(x)
        for name in ("Delta_K", "Delta_K_eff"):
            if not numpy.isnan(values[name]).any():
                found[name] = above(PchipInterpolator(
                    a, (values["K_max"] - values[name]) / numpy.sqrt(a)))
    return found


def kink(nodes):
    """The two neighbouring lengths between which the tip or the lip begins to close at
    times, or ceases to; None if there are none. Node.state says whether it closes."""
    return next(((one.a, other.a) for one, other in zip(nodes, nodes[1:])
                 if one.state != other.state), None)


class Growth:
    """Growth between the lengths of some nodes of one or more scenes, by K as computed or
    with its estimated error."""

    def __init__(self, readers, shares, nodes, with_error=False, piecewise=False):
        """@param nodes a list for each scene."""
        self.readers, self.shares, self.nodes = readers, shares, nodes
        self.a = numpy.array([node.a for node in nodes[0]])
        self.curves = [curves(self.a, own, piecewise) for own in nodes]
        self.creep = [curve(self.a, numpy.array([node.creep[with_error] for node in own]),
                            0., piecewise) for own in nodes]
        self.theta = [PchipInterpolator(self.a, [node.theta for node in own])
                      for own in nodes]
        # Errors are no smooth function of the length.
        self.errors = [PchipInterpolator(self.a, [with_error * node.error for node in own])
                       for own in nodes]

    def kink(self):
        """The first kink of any scene."""
        return next(filter(None, map(kink, self.nodes)), None)

    def rates(self, a):
        """Growth by fatigue and by creep a period of the first scene."""
        total = numpy.zeros((2, len(a)))
        for reader, share, lines, creep, error, theta in zip(
                self.readers, self.shares, self.curves, self.creep, self.errors,
                self.theta):
            growth = reader.ask({"theta": theta(a), **{
                name: line(a) * (1 + error(a))**(2 * DRIVERS[name])
                for name, line in lines.items()}})
            if reader.history:
                growth[1] = creep(a)
            total += share * growth
        return total

    def end(self, start, end):
        """The length at which the growth ends, and why if before the given end: at the
        toughness the law gives infinite growth, at rest none, beyond a table nan."""
        why = ""
        for _ in range(4):  # to 1e-12
            a = numpy.linspace(start, end, 1001)
            total = self.rates(a).sum(axis=0)
            k = int((~((total > 0.) & (total < numpy.inf))).argmax())
            if 0. < total[k] < numpy.inf:
                break
            why = ("K_c" if total[k] > 0. else "arrest" if total[k] == 0. else "law")
            start, end = a[max(k - 1, 0)], a[k]
        return start if why == "law" else end, why

    def integrate(self, edges):
        """The growth and N at the edges of parts."""
        middle, half = (edges[1:] + edges[:-1]) / 2, numpy.diff(edges) / 2
        inner = (middle[:, None] + half[:, None] * GAUSS).ravel()
        rates = self.rates(numpy.concatenate([edges, inner]))
        total = rates.sum(axis=0)
        with numpy.errstate(divide="ignore"):
            periods = numpy.nan_to_num(1 / total[len(edges):], nan=numpy.inf,
                                       posinf=numpy.inf).reshape(
                -1, len(GAUSS)) @ WEIGHTS * half
        return rates[:, :len(edges)], numpy.concatenate([[0.], numpy.cumsum(periods)])


def edges_of(nodes, start, end):
    """Edges of the parts for the quadrature; none is as short as rounding."""
    inner = [a for a in nodes if start * (1 + ROUNDING) < a < end * (1 - ROUNDING)]
    marks = [start, *inner, end]
    return numpy.unique([numpy.linspace(low, high, PARTS + 1)
                         for low, high in zip(marks, marks[1:])])
