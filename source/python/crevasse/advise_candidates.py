# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The settings that advise tries: families of candidates, each more accurate and
more expensive than the one before it."""

import dataclasses

from crevasse.quantities import has_lip, has_two_lips

LEVELS_IN_TIME = 9
LEVELS_IN_SPACE = 7
# Cells that are too large are halved; other reasons of a refusal remain, and each
# level takes longer to be refused.
REFUSALS_IN_SPACE = 2
TIME = "Time integration/"


@dataclasses.dataclass
class Candidate:
    name: str  # in the names of folders
    text: str
    settings: dict
    scheme: str = ""  # of the time integration; none in space


@dataclasses.dataclass
class Family:
    text: str
    candidates: list
    growth: float = 2.  # of the work from one candidate to the next
    refusals_that_pass: int = 0
    # All cells are halved from one to the next, and nothing else is done about
    # singularities.
    halves_cells: bool = False
    # What a search has done.
    next: int = 0
    refusals: int = 0
    points: list = dataclasses.field(default_factory=list)
    ended: bool = False


def fewest_steps(scene):
    """Fewest steps a period: ten samples are the fewest that show a history. Loads may
    jump at the ends of the scene's own steps: slightly more steps that divide these are
    preferred. Finer candidates double the number."""
    own = int(scene[TIME + "Steps per period"])
    if scene[TIME + "Step control"] == "uniform":
        return next((n for n in range(10, 20) if own % n == 0), 10)
    return 10


def equal_steps(scene, scheme, locate_events=False):
    text = scheme + (" with located events" if locate_events else "")
    candidates = []
    for level in range(LEVELS_IN_TIME):
        n = fewest_steps(scene) << level
        settings = {TIME + "Scheme": scheme, TIME + "Step control": "uniform",
                    TIME + "Steps per period": n,
                    TIME + "Locate contact events": str(locate_events).lower()}
        if scene[TIME + "Steps"]:
            settings[TIME + "Steps"] = ""  # of other step controls
        candidates.append(Candidate(f"{scheme}_{n}", f"{text}, {n} steps a period",
                                    settings, scheme))
    return Family(text, candidates, refusals_that_pass=LEVELS_IN_TIME)


def steps_by_tolerance(scene):
    """Adaptive steps with smaller and smaller tolerances, sampled at equal
    distances."""
    scheme = "arkode implicit"
    candidates = []
    for level in range(LEVELS_IN_TIME):
        tolerance = f"{1e-2 / 4 ** level:.12g}"
        candidates.append(Candidate(
            f"arkode_{tolerance}", f"{scheme}, relative tolerance {tolerance}",
            {TIME + "Scheme": scheme, TIME + "Order": 4,
             TIME + "Step control": "adaptive",
             TIME + "Steps per period": 2 * fewest_steps(scene),
             TIME + "Relative tolerance": tolerance,
             TIME + "Locate contact events": str(has_lip(scene)).lower()}, scheme))
    return Family(scheme, candidates, growth=1.5)


def families_in_time(scene):
    linear = scene["Material/Viscosity"] in (
        "relaxation time", "isotropic", "matrix", "chain", "none")
    return [equal_steps(scene, "heun"), equal_steps(scene, "rk4", has_lip(scene)),
            equal_steps(scene, "sdirk2"),
            *([equal_steps(scene, "trapezoid")] if linear else []),
            steps_by_tolerance(scene)]


def family_of(scheme, families):
    return next(family for family in families
                if family.candidates[0].scheme == scheme)


def meshes(scene, degree, functions=0, strategy="none"):
    """A family of finer and finer meshes with elements of one kind."""
    graded, adapted = strategy == "tip", strategy == "adaptive"
    # Each division at the tip halves the error that it leaves. A level divides by
    # four what cells of degree 1 leave elsewhere, by eight those of degree 2.
    first, per_level = {"tip": (4, 1) if degree == 1 else (6, 2),
                        "adaptive": (4, 4), "none": (0, 0)}[strategy]
    text = f"degree {degree}" + (", graded to the tip" if graded else
                                 ", adaptive mesh" if adapted else
                                 ", singular functions" if functions else "")
    candidates = []
    for level in range(LEVELS_IN_SPACE):
        refinements = 0 if adapted else level
        cycles = first + level * per_level
        name = (f"q{degree}" + ("_singular" if functions else "")
                + (f"_adaptive_{cycles}" if adapted else f"_{refinements}")
                + (f"_tip_{cycles}" if graded else ""))
        refined = (f", refined {level} time{'s' * (level > 1)}"
                   if refinements else "")
        candidates.append(Candidate(
            name, text + refined + (f" in {cycles} cycles" if cycles else ""),
            {"Discretisation/Degree": degree,
             "Discretisation/Singular functions": functions,
             "Geometry/Refinements": refinements,
             "Refinement/Strategy": strategy, "Refinement/Cycles": cycles,
             "Refinement/Target unknowns": 0, "Refinement/Tolerance": 0,
             "Refinement/Readapt every": 0}))
    return Family(text, candidates,
                  growth=3. if adapted else 2. ** int(scene["Dimension"]),
                  refusals_that_pass=0 if adapted else REFUSALS_IN_SPACE,
                  halves_cells=strategy == "none" and not functions)


def families_in_space(scene):
    """The families of meshes that suit the scene."""
    plane = scene["Dimension"] == "2"
    families = [meshes(scene, 1), meshes(scene, 2)]
    if has_lip(scene) and scene["Geometry/Shape"] not in ("rectangle", "box"):
        families += [meshes(scene, degree, strategy="tip") for degree in (1, 2)]
        if plane and not has_two_lips(scene):
            families += [meshes(scene, degree, functions=2) for degree in (1, 2)]
    if plane:
        families.append(meshes(scene, 2, strategy="adaptive"))
    return families
