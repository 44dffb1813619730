#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""What the accuracy of K_I costs, on the scene prm/studies/crack_tip_elastic.prm:
errors of K_I and of the energy against unknowns and seconds for uniform, graded and
adaptive meshes, elements of degree 1 and 2, and 0 to 3 singular functions. Prints
the tables and draws the figures of doc/crack_tip.md. Runs that are finished are not
computed again."""

import csv
import json
import os
import shutil
import subprocess
import sys

import numpy

from study import ROOT, print_table, study_options  # first: finds the package

from crevasse.plotting import BLUE, GREEN, GREY, INK, PURPLE, VERMILION, pyplot, save

SCENE = ROOT / "prm" / "studies" / "crack_tip_elastic.prm"
K_I, ENERGY = 35.41196, 9.71931251e-3  # converged
REPEATS = 2  # the shortest time counts
# Cells of uniform meshes.
UNIFORM = ("14, 4", "14, 14", "28, 28", "56, 56", "112, 112")
TIP_BASES = ("6, 6", "8, 8", "8, 5")  # with the last one a square cuts cells
TIP_CYCLES = (1, 2, 3, 4, 5, 6, 7, 8, 10)
TARGETS = (250, 500, 1000, 2000, 3000, 6000, 12000, 24000, 48000)
PLURAL = ("no functions", "1 function", "2 functions", "3 functions")


class Point:
    """One mesh: what it costs, and its errors."""

    def __init__(self, about):
        self.unknowns, self.seconds = about["unknowns"], min(about["seconds"])
        self.K_error = abs(about["K_I"] / K_I - 1)
        self.fit_error = abs(about["K_I_stress"] / K_I - 1)
        self.energy_error = abs(about["strain_energy"] / ENERGY - 1)
        self.norm_error = self.energy_error ** 0.5  # of the energy norm
        self.coefficient_error = (abs(about["K_I_singular"] / K_I - 1)
                                  if "K_I_singular" in about else None)


class Studies:
    def __init__(self, program, output):
        self.program, self.output = program, output

    def point(self, degree, functions, cells, **refinement):
        """Of a mesh that the section Refinement makes of those cells."""
        settings = {"Geometry/Subdivisions": cells,
                    "Discretisation/Degree": degree,
                    "Discretisation/Singular functions": functions}
        for name, value in refinement.items():
            settings["Refinement/" + name.replace("_", " ")] = value
        words = "_".join(str(value) for value in settings.values())
        directory = self.output / words.replace(", ", "x").replace(" ", "_")
        path = directory / "run.json"
        if not path.exists():
            self.compute(settings, directory, path)
        with open(path) as file:
            return Point(json.load(file))

    def compute(self, settings, directory, path):
        raw = directory / "raw"
        words = [word for name, value in settings.items()
                 for word in ("--set", f"{name}={value}")]
        print(directory.name, file=sys.stderr, flush=True)
        seconds = []
        for _ in range(REPEATS):
            shutil.rmtree(raw, ignore_errors=True)
            result = subprocess.run(
                [self.program, SCENE, "--quiet", "--output", raw, *words],
                env=dict(os.environ, OMP_NUM_THREADS="1"),
                stderr=subprocess.PIPE, text=True)
            if result.returncode != 0:
                sys.exit(result.stderr)
            with open(raw / "summary.json") as file:
                summary = json.load(file)
            seconds.append(summary["seconds"]["total"])
        with open(raw / "crack_tip.csv", newline="") as file:
            row = list(csv.DictReader(file))[-1]
        shutil.rmtree(raw)
        about = {name: float(value) for name, value in row.items()}
        about.update(unknowns=summary["unknowns"], seconds=seconds)
        path.write_text(json.dumps(about))

    def uniform(self, degree, functions):
        return [self.point(degree, functions, cells) for cells in
                UNIFORM[:5 if degree == 1 else 4]]

    def graded(self, degree, functions, cells):
        return [self.point(degree, functions, cells, Strategy="tip",
                           Cycles=n) for n in TIP_CYCLES]

    def adaptive(self, degree, functions):
        return [self.point(degree, functions, "4, 4", Strategy="adaptive",
                           Target_unknowns=target) for target in TARGETS]


def percent(error):
    """With two digits, from 10 % on with three."""
    return f"{float(f'{100 * error:.{3 if error >= 0.1 else 2}g}'):g} %"


def rate(points, cost):
    """Of the error of the energy norm, by a straight line."""
    return numpy.polyfit(numpy.log([cost(point) for point in points]),
                         numpy.log([point.norm_error for point in points]),
                         1)[0]


def must_hold(studies):
    """Bounds and what is found; returns whether all hold."""
    print("What must hold: error of K_I\n")
    rows, good = [], True

    def add(what, value, bound):
        nonlocal good
        good = good and value <= bound
        rows.append([what, percent(value), percent(bound),
                     "yes" if value <= bound else "NO"])

    for degree, cells, functions, bound in (
            (1, "14, 4", 0, None), (1, "14, 4", 1, 0.045),
            (1, "14, 4", 3, 0.015), (1, "28, 28", 0, None),
            (1, "28, 28", 1, 0.0015), (2, "14, 4", 2, 0.001),
            (2, "14, 14", 2, 0.0001)):
        point = studies.point(degree, functions, cells)
        what = (f"Q{degree}, {cells.replace(', ', ' × ')}, "
                f"{PLURAL[functions]} ({point.unknowns} unknowns)")
        if bound is None:
            rows.append([what, percent(point.K_error), "", ""])
        else:
            add(what, point.K_error, bound)
    point = studies.point(2, 0, "8, 8", Strategy="tip", Cycles=8)
    # Each division leaves four faces whose three nodes follow from others; on
    # the plane of symmetry 25 nodes are held, and the tip in x too.
    add(f"Q2, graded to the tip, no functions ({point.unknowns} unknowns, "
        f"{point.unknowns - 8 * 4 * 3 * 2 - 26} of them free)", point.K_error,
        0.0015)
    for point in studies.adaptive(2, 0):
        if 2500 < point.unknowns <= 3000:
            add(f"Q2, adaptive, no functions ({point.unknowns} unknowns)",
                point.K_error, 0.0001)
    print_table(["", "error", "bound", "holds"], rows)

    print("Rates of the error in the energy norm\n")
    rows = []
    for degree in (1, 2):
        uniform = [studies.point(degree, 0, cells) for cells in UNIFORM[2:]]
        h = rate(uniform, lambda point: point.unknowns ** -0.5)
        adaptive = [point for point in studies.adaptive(degree, 0)
                    if point.unknowns > 700]
        n = rate(adaptive, lambda point: point.unknowns)
        for what, value, wanted in ((f"Q{degree}, uniform: h^", h, 0.5),
                                    (f"Q{degree}, adaptive: N^", n,
                                     -0.5 * degree)):
            holds = abs(value / wanted - 1) <= 0.15
            good = good and holds
            rows.append([what + f"{value:.3f}", f"{wanted:g} ± 15 %",
                         "yes" if holds else "NO"])
    print_table(["", "expected", "holds"], rows)
    return good


def tables(studies):
    """All that was measured."""
    def cells_of(point):
        return [str(point.unknowns), percent(point.K_error),
                "" if point.coefficient_error is None
                else percent(point.coefficient_error),
                percent(point.fit_error), f"{point.energy_error:.1e}",
                f"{point.seconds:.2g}"]
    header = ["", "functions", "unknowns", "K_I", "coefficient of w₁",
              "fit to the stress", "energy", "seconds"]
    for degree in (1, 2):
        print(f"Q{degree}: errors and cost\n")
        rows = []
        for functions in range(4):
            for cells, point in zip(UNIFORM, studies.uniform(degree,
                                                             functions)):
                rows.append([cells.replace(", ", " × "), str(functions),
                             *cells_of(point)])
        for functions in (0, 2):
            for cells in TIP_BASES:
                for cycles, point in zip(TIP_CYCLES, studies.graded(
                        degree, functions, cells)):
                    rows.append([f"{cells.replace(', ', ' × ')}, graded "
                                 f"{cycles} times", str(functions),
                                 *cells_of(point)])
        for functions in (0, 2):
            for point in studies.adaptive(degree, functions):
                rows.append(["adaptive", str(functions), *cells_of(point)])
        print_table(header, rows)


STYLES = {0: (GREY, "no functions"), 2: (BLUE, "1 or 2 functions"),
          3: (INK, "3 functions")}
DASHED = (0, (4, 2))


def curves(studies, degree):
    """Name, style and points of each line."""
    for functions, (colour, name) in STYLES.items():
        yield (f"uniform, {name}", dict(color=colour, marker="o"),
               studies.uniform(degree, functions))
    yield ("adaptive, no functions",
           dict(color=VERMILION, marker="^", linestyle=DASHED),
           studies.adaptive(degree, 0))
    yield ("adaptive, 2 functions",
           dict(color=PURPLE, marker="v", linestyle=DASHED),
           studies.adaptive(degree, 2))
    yield ("8 × 8 cells graded to the tip, no functions",
           dict(color=GREEN, marker="s", linestyle=DASHED),
           studies.graded(degree, 0, "8, 8"))


def draw(studies, stem, cost, label, directory, formats, most=None):
    figure, panels = pyplot.subplots(1, 2, figsize=(8.2, 3.9), sharex=True,
                                     sharey=True, constrained_layout=True)
    for axes, degree in zip(panels, (1, 2)):
        for name, style, points in list(curves(studies, degree))[:most]:
            axes.loglog([cost(point) for point in points],
                        [100 * point.K_error for point in points],
                        markersize=4.5, linewidth=1.3, label=name, **style)
        axes.set(title=f"elements of degree {degree}", xlabel=label)
        axes.grid(True, which="major", alpha=0.25, linewidth=0.6)
    panels[0].set_ylabel("error of $K_I$ (%)")
    for axis in (panels[0].xaxis, panels[0].yaxis):
        axis.set_major_formatter(lambda x, _: numpy.format_float_positional(
            float(f"{x:.3g}"), trim="-"))
    figure.legend(*panels[0].get_legend_handles_labels(), loc="upper center",
                  bbox_to_anchor=(0.5, 0), ncols=3, fontsize=8)
    save(figure, stem, directory, formats)


def main():
    options = study_options(__doc__, "crack_tip_studies",
                            studies=("tables", "figures"))
    studies = Studies(options.program.resolve(), options.output)
    if "figures" in options.studies:
        draw(studies, "crack_tip_error", lambda point: point.unknowns, "unknowns",
             options.figures, options.formats)
        draw(studies, "crack_tip_work", lambda point: point.seconds, "seconds",
             options.figures, options.formats, most=5)
    if "tables" in options.studies:
        tables(studies)
        if not must_hold(studies):
            sys.exit("Not all bounds hold.")


if __name__ == "__main__":
    main()
