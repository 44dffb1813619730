#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""What accuracy costs in CPU seconds: meshes, contact solvers, time
schemes and linear solvers, by one sweep each over scenes of prm/studies. Draws the
figures of doc/accuracy.md. What a sweep has computed is not computed again."""

import csv
import os
import subprocess
import sys

from study import ROOT, study_options  # first: finds the package

from crevasse.plotting import (BLUE, GREEN, GREY, INK, PURPLE, VERMILION, name_numbers,
                               pyplot, save)

ORANGE, SKY, BROWN = "#E69F00", "#56B4E9", "#8C510A"
SECONDS = "CPU seconds"


class Studies:
    def __init__(self, program, output):
        self.program, self.output = program, output

    def sweep(self, name, scene, lines, *options):
        """The rows of the points of each line, all from one sweep."""
        points = [point for line in lines.values() for point in line]
        directory = self.output / name
        subprocess.run([self.program, "sweep", ROOT / "prm/studies" / scene,
                        "--output", directory, "--vary", together(points), *options],
                       check=True, env=dict(os.environ, OMP_NUM_THREADS="1"))
        with open(directory / "sweep.csv", newline="") as file:
            rows = csv.DictReader(file)
            return {label: [row for row in (next(rows) for _ in line)
                            if has_cost(row)]
                    for label, line in lines.items()}


def together(points):
    """The value of --vary that gives each point its own settings."""
    return " & ".join(f"{name}=" + " | ".join(str(point[name])
                                              for point in points)
                      for name in points[0])


def has_cost(row):
    """Not what was refused or has failed, of which a word is said."""
    if not row["processor_seconds"]:
        print(f"{row['point']}: {row['message']}", file=sys.stderr)
    return bool(row["processor_seconds"])


def numbers(rows, column):
    return [float(row[column]) for row in rows]


def draw_lines(axes, lines, styles, x, y):
    """Those of the columns x and y, in the order of x."""
    for label, rows in lines.items():
        rows = [row for row in rows if row[y] and float(row[y]) > 0]
        if rows:
            colour, marker, dashes = styles[label]
            axes.loglog(numbers(rows, x), numbers(rows, y), color=colour,
                        marker=marker, linestyle=dashes, markersize=4.5,
                        linewidth=1.3, label=label)
    axes.grid(True, which="major", alpha=0.25, linewidth=0.6)
    if x == "processor_seconds":
        name_numbers(axes)
    if y == "processor_seconds":
        axes.yaxis.set_major_formatter(plain)


def plain(x, _):
    """Without powers of ten."""
    return f"{x:.10g}"


def name_lines(figure, axes, columns):
    """Below the panels, in which there is no room."""
    figure.legend(*axes.get_legend_handles_labels(), loc="upper center",
                  bbox_to_anchor=(0.5, 0), ncols=columns, fontsize=8)


SOLID, DASHED = "-", (0, (4, 2))
MESH_STYLES = {"uniform": (GREY, "o", SOLID),
               "uniform, 2 singular functions": (BLUE, "s", SOLID),
               "graded to the tip": (GREEN, "D", DASHED),
               "adaptive": (VERMILION, "^", DASHED),
               "adaptive, 2 singular functions": (PURPLE, "v", DASHED)}
OPENING = "probe_C/opening"


def mesh(degree, strategy, functions=0, refinements=0, cycles=0, target=0):
    return {"Discretisation/Degree": degree, "Refinement/Strategy": strategy,
            "Discretisation/Singular functions": functions,
            "Geometry/Refinements": refinements, "Refinement/Cycles": cycles,
            "Refinement/Target unknowns": target}


def meshes(degree):
    """Of about equal numbers of unknowns for both degrees."""
    uniform = range(2, 7) if degree == 1 else range(1, 6)
    targets = (250, 500, 1000, 2000, 4000, 8000, 16000)
    return {
        "uniform": [mesh(degree, "none", 0, n) for n in uniform],
        "uniform, 2 singular functions":
            [mesh(degree, "none", 2, n) for n in uniform],
        # So often that the cells around the tip leave less than all others.
        "graded to the tip": [mesh(degree, "tip", 0, n, 2 * degree * n)
                              for n in range(1, 5)],
        "adaptive": [mesh(degree, "adaptive", target=n) for n in targets],
        "adaptive, 2 singular functions":
            [mesh(degree, "adaptive", 2, target=n) for n in targets]}


def mesh_strategies(studies):
    figure, panels = pyplot.subplots(1, 2, figsize=(8.2, 3.9), sharex=True,
                                     sharey=True, constrained_layout=True)
    reference = mesh(2, "adaptive", 2, target=60000)
    for axes, degree in zip(panels, (1, 2)):
        lines = studies.sweep(
            f"meshes_{degree}", "crack_tip_adaptive.prm", meshes(degree),
            "--error", OPENING, *each("--reference", reference))
        draw_lines(axes, lines, MESH_STYLES, "processor_seconds",
                   "error:" + OPENING)
        axes.set(title=f"elements of degree {degree}", xlabel=SECONDS)
    panels[0].set_ylabel("error of the opening at the mouth")
    name_lines(figure, panels[0], 3)
    return figure


def each(option, settings):
    return [word for name, value in settings.items()
            for word in (option, f"{name}={value}")]


CONTACT_STYLES = {"projected sor": (GREY, "o", SOLID),
                  "active set, factorisation": (GREEN, "D", SOLID),
                  "active set, algebraic multigrid": (VERMILION, "^", SOLID),
                  "condensed active set": (BLUE, "s", SOLID)}
LIP_STRESS = "probe_lip/s"
CONTACT_SOLVERS = {"projected sor": ("projected sor", "automatic"),
                   "active set, factorisation": ("active set", "cholesky"),
                   "active set, algebraic multigrid": ("active set", "amg"),
                   "condensed active set":
                       ("condensed active set", "cholesky")}


def contact(label, refinements, tolerance):
    solver, linear_solver = CONTACT_SOLVERS[label]
    return {"Contact/Solver": solver, "Linear solver/Type": linear_solver,
            "Geometry/Refinements": refinements,
            "Contact/Tolerance": f"{tolerance:g}"}


def contact_solvers(studies):
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(8.2, 3.9),
                                            constrained_layout=True)
    scene, tight = "contact_solvers.prm", 1e-12
    by_size = studies.sweep(
        "contact_solvers", scene,
        {label: [contact(label, n, tight)
                 for n in range(4 if label == "projected sor" else 6)]
         for label in CONTACT_SOLVERS},
        "--error", "contact/force",
        *each("--reference", contact("condensed active set", 6, tight)))
    draw_lines(left, by_size, CONTACT_STYLES, "unknowns", "processor_seconds")
    left.set(xlabel="unknowns", ylabel=SECONDS,
             title="one period, tolerance 1e-12")
    # What the tolerance leaves is seen against one that rounding decides.
    by_tolerance = studies.sweep(
        "contact_tolerances", scene,
        {label: [contact(label, 1, 10.**-k) for k in (2, 4, 8, 12)]
         for label in CONTACT_SOLVERS if "multigrid" not in label},
        "--error", LIP_STRESS,
        *each("--reference", contact("active set, factorisation", 1, 1e-14)))
    draw_lines(right, by_tolerance, CONTACT_STYLES, "processor_seconds",
               "error:" + LIP_STRESS)
    right.set(xlabel=SECONDS, ylabel="error of the stress on the lip",
              title="522 unknowns, tolerances from 1e-2 to 1e-12")
    name_lines(figure, left, 4)
    return figure


SCHEME_STYLES = {"euler": (GREY, "o", SOLID), "heun": (BLUE, "s", SOLID),
                 "exponential": (VERMILION, "^", SOLID),
                 "sdirk2": (INK, "v", SOLID),
                 "trapezoid": (GREEN, "D", SOLID),
                 "rk4 with events": (ORANGE, "*", SOLID),
                 "arkode explicit, adaptive": (SKY, "X", DASHED),
                 "arkode implicit, adaptive": (BROWN, "p", DASHED)}
STRESS = "probe_C/s"


def steps(scheme, number):
    return {"Time integration/Scheme": scheme.split(" with")[0],
            "Time integration/Steps per period": number,
            "Time integration/Step control": "uniform",
            "Time integration/Relative tolerance": "1e-4",
            "Time integration/Locate contact events":
                str("events" in scheme).lower()}


def tolerance(scheme, exponent):
    return {"Time integration/Scheme": scheme.split(",")[0],
            "Time integration/Steps per period": 40,
            "Time integration/Step control": "adaptive",
            "Time integration/Relative tolerance": f"1e-{exponent}",
            "Time integration/Locate contact events": "true"}


def schemes():
    return {label: [tolerance(label, k) for k in range(2, 7)]
            if "adaptive" in label
            else [steps(label, n) for n in (20, 40, 80, 160, 320, 640)]
            for label in SCHEME_STYLES}


def schemes_and_steps(studies):
    figure, panels = pyplot.subplots(1, 2, figsize=(8.2, 3.9), sharey=True,
                                     constrained_layout=True)
    for axes, ratio in zip(panels, (0.1, 0.01)):
        lines = studies.sweep(
            f"schemes_{ratio:g}", "time_schemes.prm", schemes(), *each(
                "--set", {"Geometry/Refinements": 2,
                          "Material/Relaxation time": f"{600 * ratio:g}"}),
            "--error", STRESS,
            *each("--reference", steps("rk4 with events", 1280)))
        draw_lines(axes, lines, SCHEME_STYLES, "processor_seconds",
                   "error:" + STRESS)
        axes.set(title=rf"$\tau/T = {ratio:g}$", xlabel=SECONDS)
    panels[0].set_ylabel("error of the stress at C, two periods")
    name_lines(figure, panels[0], 4)
    return figure


LINEAR_STYLES = {"cholesky": (BLUE, "s", SOLID), "amg": (VERMILION, "^", SOLID),
                 "gmg": (GREEN, "D", SOLID)}
# First cells and refinements of degree 1, which has as many unknowns then as
# degree 2 with one refinement less: 1938 to 115 842 in the plane.
PLANE = [("14, 4", n) for n in range(2, 6)]
SPACE = [("4, 4, 2", 1), ("6, 6, 3", 1), ("4, 4, 2", 2), ("6, 6, 3", 2),
         ("4, 4, 2", 3)]  # 1215 to 55 539 unknowns
LARGEST = [("6, 6, 3", 3)]  # 180 075, for a factorisation and its rival


def linear(solver, degree, cells, refinements):
    return {"Linear solver/Type": solver, "Discretisation/Degree": degree,
            "Geometry/Subdivisions": cells,
            "Geometry/Refinements": refinements - degree + 1}


def linear_solvers(studies):
    figure, panels = pyplot.subplots(1, 3, figsize=(8.6, 3.5), sharey=True,
                                     constrained_layout=True)
    plane = "contact_solvers.prm", PLANE, "probe_C/opening"
    space = "linear_solvers.prm", SPACE, "probe_front/opening"
    for axes, title, degree, (scene, sizes, quantity) in zip(
            panels, ("plane, degree 2", "space, degree 1", "space, degree 2"),
            (2, 1, 2), (plane, space, space)):
        with_largest = ("cholesky", "gmg") if sizes is SPACE else ()
        lines = studies.sweep(
            title.replace(", ", "_").replace(" ", "_"), scene,
            {solver: [linear(solver, degree, *size) for size in sizes
                      + LARGEST * (solver in with_largest)]
             for solver in LINEAR_STYLES},
            *each("--set", {"Time integration/Steps per period": 10}),
            "--error", quantity,
            *each("--reference", linear("cholesky", 2, *sizes[2])),
            *each("--reference", {"Refinement/Strategy": "tip",
                                  "Refinement/Cycles": 4}))
        draw_lines(axes, lines, LINEAR_STYLES, "unknowns", "processor_seconds")
        axes.set(title=title, xlabel="unknowns")
    panels[0].set_ylabel(SECONDS)
    name_lines(figure, panels[0], 3)
    return figure


STUDIES = {"mesh_strategies": mesh_strategies,
           "contact_solvers": contact_solvers,
           "schemes_and_steps": schemes_and_steps,
           "linear_solvers": linear_solvers}


def main():
    options = study_options(__doc__, "accuracy_studies", "sweeps are", STUDIES)
    studies = Studies(options.program.resolve(), options.output)
    for name in options.studies:
        save(STUDIES[name](studies), "accuracy_" + name, options.figures,
             options.formats)


if __name__ == "__main__":
    main()
