# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Puts the settings in space and in time together: squares of errors nearly add,
seconds nearly multiply. The pair with the least predicted seconds among those whose
predicted errors are small enough is run and compared with a finer pair. The result
corrects the predictions, until no other pair promises to be cheaper."""

import dataclasses
import math

from crevasse.advise_runs import Run
from crevasse.command import CommandError

# The errors, of the target, which the searches are to reach first. Steps are searched
# on a coarse mesh, where finer steps cost little and leave more choice.
PART_IN_SPACE, PART_IN_TIME = 0.5, 0.25
# A part of the error of a reference may be missing in a difference from it.
PART_OF_REFERENCE, PART_ACCEPTED = 0.25, 0.9
MOST_FINALISTS, MOST_SECONDS = 12, 1200.
EXTENSIONS = 3
# Predictions err: kinds that were run together must save more than noise, new kinds
# may as well save what they seem to cost more.
MARGIN_IF_KNOWN, MARGIN_IF_NEW = 0.9, 1.4
SEARCH, RESULT, REFERENCE = "search", "result", "reference"  # what a run is for


@dataclasses.dataclass
class Finalist:
    pair: tuple  # indices of points in space and in time
    run: Run
    reference: Run = None  # finer; None if none could be run
    error: float = 0.  # against it, or predicted
    shared: float = 0.  # estimated part that both have


class Pairs:
    def __init__(self, space, time, base, target, times_the_periods, run, errors):
        self.space, self.time, self.base = space, time, base
        self.target, self.times_the_periods = target, times_the_periods
        self.run, self.errors = run, errors
        self.finalists, self.failed = [], set()
        self.factor_in_space = self.factor_in_time = 1.  # of estimated errors
        self.factor_of_seconds = {}  # of each family in space and in time

    def find(self):
        """Runs pairs until one reaches the target or none promises to: whether one
        does."""
        in_space = PART_IN_SPACE * self.target
        in_time = PART_IN_TIME * self.target
        for extension in range(EXTENSIONS + 1):
            while len(self.finalists) + len(self.failed) < MOST_FINALISTS:
                good = self.cheapest_good()
                pair = self.next(good.run.seconds if good else math.inf)
                if pair is None:
                    break
                self.try_pair(pair)
            if self.cheapest_good():
                return True
            if extension == EXTENSIONS:
                break
            in_space /= 2. * max(1., self.factor_in_space)
            in_time /= 2. * max(1., self.factor_in_time)
            finer = self.space.extend_to(in_space)
            if not self.time.extend_to(in_time) and not finer:
                break
        # No pair promises it: the most accurate pair is the nearest.
        for pair in sorted(self.affordable(), key=self.predicted_error):
            if not self.finalists and len(self.failed) < MOST_FINALISTS:
                self.try_pair(pair)
        if not self.finalists:
            raise CommandError("no combination of the settings in space and in time "
                               "runs; see log.txt in the folders under runs/.",
                               3)
        return self.cheapest_good() is not None

    def best(self):
        """The cheapest pair that reaches the target, or else the most accurate pair."""
        return self.cheapest_good() or min(self.finalists, key=lambda f: f.error)

    def cheapest_good(self):
        good = [finalist for finalist in self.finalists
                if finalist.error <= PART_ACCEPTED * self.target]
        return min(good, key=lambda finalist: finalist.run.seconds, default=None)

    def points(self, pair):
        return self.space.points[pair[0]], self.time.points[pair[1]]

    def families(self, pair):
        return tuple(point.family.text for point in self.points(pair))

    def predicted_error(self, pair):
        """Error that a pair promises. Errors in space and time are usually largest at
        different probes or instants: their sum is hardly ever reached."""
        space, time = self.points(pair)
        return math.hypot(self.factor_in_space * space.error,
                          self.factor_in_time * time.error)

    def searched_seconds(self, pair):
        """Seconds of a pair as the searches predict them. A part of each run depends
        neither on its steps nor on its periods."""
        space, time = self.points(pair)
        constant = 0.8 * min(point.run.seconds for point in self.space.points)
        return constant + ((space.run.seconds - constant) * self.times_the_periods
                           * time.run.work / self.base.run.work)

    def predicted_seconds(self, pair):
        """Seconds of a pair by what pairs have shown; new kinds are as far off."""
        factors = self.factor_of_seconds
        mean = (math.exp(sum(map(math.log, factors.values())) / len(factors))
                if factors else 1.)
        return factors.get(self.families(pair), mean) * self.searched_seconds(pair)

    def affordable(self):
        """Pairs whose run does not take too long; the cheapest pair in any case."""
        pairs = [(s, t) for s in range(len(self.space.points))
                 for t in range(len(self.time.points))]
        seconds = {pair: self.predicted_seconds(pair) for pair in pairs}
        return ([pair for pair in pairs if seconds[pair] <= MOST_SECONDS]
                or [min(pairs, key=seconds.get)])

    def next(self, seconds):
        """The pair to run next, if one promises the target and may take less than these
        seconds."""
        tried = self.failed | {finalist.pair for finalist in self.finalists}
        promising = []
        for pair in self.affordable():
            known = self.families(pair) in self.factor_of_seconds
            margin = MARGIN_IF_KNOWN if known else MARGIN_IF_NEW
            predicted = self.predicted_seconds(pair)
            if (pair not in tried and predicted < margin * seconds
                    and self.predicted_error(pair) <= PART_ACCEPTED * self.target):
                promising.append((predicted, pair))
        return min(promising)[1] if promising else None

    def reference_for(self, pair):
        """The cheapest pair that is finer in both parts and accurate enough, else the
        most accurate; None if there is none. Nothing is finer than the finest point
        of a search."""
        def finer(search, a, b):
            return (search.points[a].error < search.points[b].error
                    or a == b and search.points[a] is search.reference)

        def rank(other):
            error = self.predicted_error(other)
            return ((0, self.predicted_seconds(other))
                    if error <= PART_OF_REFERENCE * self.target else (1, error))

        return min((other for other in self.affordable()
                    if other != pair and other not in self.failed
                    and finer(self.space, other[0], pair[0])
                    and finer(self.time, other[1], pair[1])), key=rank, default=None)

    def try_pair(self, pair):
        def run(one, purpose):
            space, time = self.points(one)
            return self.run(space.candidate, time.candidate, purpose)

        finalist = Finalist(pair, run(pair, RESULT))
        if not finalist.run.usable:
            self.failed.add(pair)
            return
        for _ in range(3):
            other = self.reference_for(pair)
            if other is None or finalist.reference:
                break
            reference = run(other, REFERENCE)
            if not reference.usable:  # its tolerance may be out of reach
                reference = run(other, RESULT)
            if not reference.usable:
                self.failed.add(other)
                continue
            finalist.reference = reference
            # They do not differ in what both have in common.
            space, time = self.points(pair)
            if other[0] == pair[0]:
                finalist.shared += self.factor_in_space * space.error
            if other[1] == pair[1]:
                finalist.shared += self.factor_in_time * time.error
            finalist.error = finalist.shared + self.errors.difference(
                finalist.run, reference)
        if finalist.reference is None:
            finalist.error = self.predicted_error(pair)
        self.finalists.append(finalist)
        self.learn(finalist)

    def learn(self, finalist):
        """Corrects the predictions by the run of a pair."""
        pair = finalist.pair
        self.factor_of_seconds[self.families(pair)] = (
            finalist.run.seconds / self.searched_seconds(pair))
        predicted = self.predicted_error(pair)
        if predicted == 0.:
            return
        ratio = min(max(finalist.error / predicted, 0.2), 5.)
        space, time = self.points(pair)
        space_dominates = (self.factor_in_space * space.error
                           > self.factor_in_time * time.error)
        # Which part was predicted too large is not known: the next run will tell. If
        # the error is larger than predicted, the larger part is to blame.
        if ratio < 1. or space_dominates:
            self.factor_in_space *= ratio
        if ratio < 1. or not space_dominates:
            self.factor_in_time *= ratio
