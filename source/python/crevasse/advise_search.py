# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Searches one part of the settings, time or space: runs the next candidate of the
family that promises the error at the least cost, until one has it and no family
promises it cheaper."""

import dataclasses
import math

from crevasse.advise_candidates import Candidate, Family
from crevasse.advise_runs import Run

PART_OF_FINEST = 0.3  # of the error looked for, that the reference may have
# Limits of one run.
MOST_UNKNOWNS = 3e5
MOST_SECONDS = 300.
HOPE, WORST = 0.15, 0.95  # ratios of errors from one level to the next
LARGE, FALLS = 0.1, 0.75  # changes of a quantity that does not converge
MANY_UNKNOWNS, CLEARLY = 1e4, 4.


@dataclasses.dataclass
class Point:
    candidate: Candidate
    run: Run
    family: Family
    error: float = math.inf  # estimated, of this part of the settings alone


class Search:
    """Search in time or space. Errors are differences from the finest run of the family
    that converges best, plus the error that this run is estimated to have."""

    def __init__(self, in_time, families, run, errors, log):
        self.in_time, self.families, self.run = in_time, families, run
        self.errors, self.log = errors, log
        self.points, self.notes = [], []
        self.reference = None
        self.hardest_is_named = False

    def cost(self, point):
        return point.run.work if self.in_time else point.run.seconds

    def extend_to(self, error):
        """Runs candidates until a point has this error, and the reference a fraction of
        it; returns whether they have."""
        while True:
            best = self.cheapest(error)
            good_reference = (self.reference is not None
                              and self.reference.error <= PART_OF_FINEST * error)
            family = self.suspicious(error)
            # On a coarse mesh, steps with a little more error cost next to nothing,
            # and may suit a mesh with a little less.
            if not family:
                bound = self.cost(best) if best else math.inf
                family = self.cheapest_next(
                    bound, math.inf if best and self.in_time else error)
            if best and not good_reference and not family:
                family = self.reference.family if self.reference else None
                if not family or not self.may_continue(family):
                    family = self.cheapest_next(math.inf, error)
            if not family:
                return best is not None
            self.run_next(family)
            if family.halves_cells:
                self.leave_out_diverging(error)
            self.estimate()
            self.name_the_hardest()

    def cheapest(self, error):
        """The cheapest point with at most this error, except the reference."""
        good = [point for point in self.points
                if point is not self.reference and point.error <= error]
        return min(good, key=self.cost, default=None)

    def growth(self, family):
        """Growth factor of the work from one level of a family to the next."""
        if self.in_time or len(family.points) < 2:
            return family.growth
        before, last = family.points[-2:]
        return max(family.growth, last.run.unknowns / before.run.unknowns)

    def predicted_cost(self, family, levels):
        if not family.points:
            return 0.
        # A part of each run is the same for all.
        constant = 0. if self.in_time else 0.8 * min(map(self.cost, self.points))
        return constant + ((self.cost(family.points[-1]) - constant)
                           * self.growth(family) ** levels)

    def levels_to(self, family, error):
        """Number of levels that a family needs for an error, if errors fall as last
        time; before that, as those of the best methods do."""
        if not family.points or math.inf in (family.points[-1].error, error):
            return 1.
        last = family.points[-1].error
        ratio = HOPE
        if len(family.points) > 1:
            before = family.points[-2].error
            ratio = min(max(last / before if before else 0., 0.02), WORST)
        levels = math.ceil(math.log(last / error) / -math.log(ratio)) if last else 1
        return max(1., levels)

    def may_continue(self, family):
        """Whether limits of size and time allow the family's next candidate."""
        if family.ended:
            return False
        seconds = unknowns = 0.
        if family.points:
            seconds = self.growth(family) * family.points[-1].run.seconds
            unknowns = self.growth(family) * family.points[-1].run.unknowns
        if family.next == len(family.candidates):
            self.end(family, "its finest candidate was run")
        elif not self.in_time and unknowns > MOST_UNKNOWNS:
            self.end(family, f"the next mesh would have about {unknowns:.0f} unknowns")
        elif seconds > MOST_SECONDS:
            self.end(family, f"the next run would take about {seconds:.0f} s")
        return not family.ended

    def cheapest_next(self, bound, error):
        """The family that promises the error at the least cost, below the bound."""
        best = None
        for family in self.families:
            cost = self.predicted_cost(family, self.levels_to(family, error))
            if cost < bound and self.may_continue(family):
                best, bound = family, cost
        return best

    def run_next(self, family):
        candidate = family.candidates[family.next]
        family.next += 1
        run = self.run(candidate)
        if run.usable:
            # An adaptive mesh may be as fine as it gets.
            if (not self.in_time and family.points
                    and family.points[-1].run.unknowns == run.unknowns):
                return self.end(family, "its mesh is not refined further")
            point = Point(candidate, run, family)
            family.points.append(point)
            return self.points.append(point)
        family.refusals += run.status == "refused"
        if run.status != "refused" or family.refusals > family.refusals_that_pass:
            sentence = " ".join(run.message.split()).split(". ")[0].rstrip(".")
            self.end(family, f"{candidate.text} {run.status}: {sentence}.")

    def end(self, family, reason):
        family.ended = True
        self.notes.append(f"{family.text}: {reason}")

    def leave_out(self, family, reason):
        """Leaves out a family with all its runs."""
        self.end(family, reason)
        family.points.clear()
        self.points = [point for point in self.points if point.family is not family]
        self.reference = None
        self.estimate()

    def changes(self, family):
        """Differences of each run of a family from the run before it."""
        return [self.errors.difference(a.run, b.run)
                for a, b in zip(family.points, family.points[1:])]

    def error_of_last(self, family):
        changes = self.changes(family)
        if len(changes) < 2 or changes[-1] == 0.:
            return changes[-1] if changes else math.inf
        # Errors that fall by a ratio each time. Very fast ones may do so by chance.
        ratio = changes[-1] / changes[-2] if changes[-2] else math.inf
        ratio = min(max(ratio, 0.1), 0.8) if ratio == ratio else 0.8
        return changes[-1] * ratio / (1. - ratio)

    def estimate(self):
        """Estimates the errors of all points."""
        least, family = min(((self.error_of_last(family), k)
                             for k, family in enumerate(self.families)))
        if least == math.inf:
            return
        self.reference = self.families[family].points[-1]
        for point in self.points:
            point.error = least + (
                0. if point is self.reference else
                self.errors.difference(point.run, self.reference.run))

    def diverges(self, family, quantity, error):
        """Whether a quantity keeps changing as all cells are halved; None if unknown
        yet. At a tip each halving changes the stress by 1 - 1/sqrt(2) of itself."""
        changes = [self.errors.differences(a.run, b.run)[quantity]
                   for a, b in zip(family.points, family.points[1:])]
        if changes and changes[-1] < max(LARGE, error):
            return False
        if len(changes) < 2:
            return None
        return changes[-1] > FALLS * changes[-2]

    def suspicious(self, error):
        """A family whose next run may show that a quantity does not converge. The first
        such family is the cheapest; the others are asked if it is suspicious."""
        for family in self.families:
            if not family.halves_cells:
                continue
            suspicious = len(family.points) < 2 or any(
                self.diverges(family, name, error) in (None, True)
                for name in self.errors.counting())
            if not suspicious:
                return None
            if len(family.points) < 3 and self.may_continue(family):
                return family
        return None

    def leave_out_diverging(self, error):
        for name in self.errors.counting():
            # The unknown counts for nothing, unless a run can tell.
            verdicts = [False if verdict is None and not family.ended
                        and len(family.points) < 3 else verdict
                        for family in self.families if family.halves_cells
                        for verdict in [self.diverges(family, name, error)]]
            if True in verdicts and False not in verdicts:
                self.errors.left_out.add(name)
                self.notes.append(
                    f"{name} is left out: it does not converge as the cells are "
                    "halved. The stress at a crack tip is infinite, at a free corner "
                    "zero, and on the line between two materials it has two values: "
                    "move the probe to a point where the stress has one finite value")
                self.log(f"  {name} does not converge as the cells are halved: left "
                         "out")

    def name_the_hardest(self):
        """Logs once if one quantity alone makes the search expensive."""
        if (self.hardest_is_named or self.in_time or self.reference is None
                or self.reference.run.unknowns < MANY_UNKNOWNS):
            return
        own = self.reference.family.points
        if len(own) < 2 or len(self.errors.counting()) < 2:
            return
        changes = self.errors.differences(own[-2].run, own[-1].run)
        ranked = sorted(self.errors.counting(), key=changes.get)
        largest, second = changes[ranked[-1]], changes[ranked[-2]]
        if largest >= CLEARLY * second:
            self.hardest_is_named = True
            self.log(f"  {ranked[-1]} needs these meshes: it still changes by "
                     f"{largest:.2g}, all others by at most {second:.2g}. If it does "
                     "not matter, name the quantities that do with --quantities.")
