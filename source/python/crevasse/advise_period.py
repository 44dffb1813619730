# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""How the periodic state is found: the method that finds it soonest on a coarse
mesh, and a tolerance whose error there is small beside the target. A fixed number of
periods from rest stays as it is; searches take the first of them."""

from crevasse.advise_pairs import REFERENCE, SEARCH
from crevasse.command import CommandError

PERIODS_OF_A_SEARCH = 3
PERIODS_OF_A_MARCH = 30  # a faster method has found the state by then
PERIODS_AT_LEAST = 200
TIGHTER_IN_REFERENCE = 10.
PART_OF_TOLERANCE = 0.1  # of the target
CLEARLY = 0.7
LEVEL = 1  # a few more steps than the fewest


def settings_of(method, tolerance, periods):
    return {"Periodic state/Method": method,
            "Periodic state/Tolerance": f"{tolerance:.12g}",
            "Periodic state/Maximum periods": periods}


class Period:
    def __init__(self, scene, target):
        self.searched = float(scene["Periodic state/Tolerance"]) > 0
        self.own_periods = int(scene["Periodic state/Maximum periods"])
        self.search_periods = min(self.own_periods, PERIODS_OF_A_SEARCH)
        self.most_periods = max(self.own_periods, PERIODS_AT_LEAST)
        self.target, self.tolerance = target, target / 4.
        self.methods = {}  # with trapezoid, and with all others ("")

    @property
    def times_the_periods(self):
        """Ratio of the number of periods of the final run to that of a search."""
        return 1. if self.searched else self.own_periods / self.search_periods

    def choose(self, in_time, mesh, common, runs, errors, log):
        """Chooses method and tolerance for the periodic state on the coarsest mesh."""
        if not self.searched:
            return

        def run(steps, method, tolerance, periods):
            return runs.run(f"{mesh.name}__{steps.name}__{method}_{tolerance:.12g}",
                            common | mesh.settings | steps.settings
                            | settings_of(method, tolerance, periods))

        for family in in_time:
            scheme = family.candidates[0].scheme
            if scheme not in ("trapezoid", "sdirk2"):
                continue
            key, steps = scheme.replace("sdirk2", ""), family.candidates[LEVEL]
            self.methods[key] = self.cheapest_method(
                steps, lambda *words: run(steps, *words))
        method, confirmed = self.methods[""], False
        for attempt in range(4):
            if attempt:
                self.tolerance /= 4.
            tight = run(steps, method, self.tolerance / 100., self.most_periods)
            if not tight.usable:
                break
            usual = run(steps, method, self.tolerance, self.most_periods)
            confirmed = (errors.difference(usual, tight)
                         <= PART_OF_TOLERANCE * self.target)
            if confirmed:
                break
        log(f"  periodic state: {method} with Tolerance = {self.tolerance:.12g}"
            + ("" if confirmed else ", not confirmed by a tighter one")
            + "".join(f"; with {scheme} {method}"
                      for scheme, method in self.methods.items() if scheme))

    def cheapest_method(self, steps, run):
        best, messages = None, ""
        for method in ("automatic", "anderson", "march"):
            periods = PERIODS_OF_A_MARCH if method == "march" else self.most_periods
            found = run(method, self.tolerance, periods)
            # On finer meshes the first is hardly ever slower.
            if found.usable and (best is None
                                 or found.seconds < CLEARLY * best[1].seconds):
                best = method, found
            messages += f"\n  {method}: {found.message}"
        if best is None:
            raise CommandError("no method finds the periodic state with "
                               f"{steps.text} on the coarsest mesh.{messages}", 3)
        return best[0]

    def method(self, steps):
        return self.methods["trapezoid" if steps.scheme == "trapezoid" else ""]

    def tolerance_for(self, purpose):
        return self.tolerance / (TIGHTER_IN_REFERENCE if purpose == REFERENCE else 1.)

    def settings(self, steps, purpose):
        if self.searched:
            return settings_of(self.method(steps), self.tolerance_for(purpose),
                               self.most_periods)
        if purpose == SEARCH:
            return {"Periodic state/Maximum periods": self.search_periods}
        return {}

    def name(self, steps, purpose):
        """Part of a run's name that tells the settings of the periodic state."""
        if self.searched:
            return f"__{self.method(steps)}_{self.tolerance_for(purpose):.12g}"
        periods = self.search_periods if purpose == SEARCH else self.own_periods
        return f"__{periods}_periods"

    def text(self, steps):
        if self.searched:
            return (f"periodic state by {self.method(steps)} with Tolerance = "
                    f"{self.tolerance:.12g}")
        return f"{self.own_periods} period" + "s" * (self.own_periods != 1)
