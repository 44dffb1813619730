#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The convergence study of prm/studies/signorini_rates.prm: energy error and end
of the closed part of the lip on finer and finer meshes, Q1 and Q2, against the
finest Q2 mesh, with its wall time."""

import argparse
import csv
import json
import math
import pathlib
import subprocess
import sys

from study import ROOT, existing_program  # first: finds the package

COARSE_CELLS = 4  # along each side


class Run:
    """One point of the study."""

    def __init__(self, program, degree, refinements, directory):
        self.degree = degree
        self.cells = COARSE_CELLS * 2**refinements
        results = directory / f"Q{degree}_{self.cells}"
        subprocess.run(
            [program, ROOT / "prm/studies/signorini_rates.prm", "--quiet",
             "--output", results,
             "--set", f"Discretisation/Degree={degree}",
             "--set", f"Geometry/Refinements={refinements}"], check=True)
        summary = json.loads((results / "summary.json").read_text())
        self.unknowns = summary["unknowns"]
        self.seconds = summary["seconds"]["total"]
        self.work = last_row(results / "load_work.csv")["load_work"]
        # The closed nodes, and the held one at x = 0, reach this far; the end
        # of the closed part lies within the next distance between nodes.
        closed = last_row(results / "contact.csv")["closed_nodes"]
        self.spacing = 1 / (self.cells * degree)
        self.end = (closed + 0.5) * self.spacing

    def error(self, exact_work):
        """Relative error in the energy norm, bounded by that of the potential
        energy, which is -1/2 of the work of the loads."""
        return math.sqrt(abs(exact_work - self.work) / exact_work)


def last_row(path):
    with open(path) as file:
        return {key: float(value) for key, value in
                list(csv.DictReader(file))[-1].items()}


def print_table(runs, finest):
    print(" degree  cells   unknowns  energy error  order   end of contact   "
          "seconds")
    last = None
    for run in runs:
        if last is not None and last.degree != run.degree:
            last = None
        error = run.error(finest.work)
        order = ("" if last is None else
                 f"{math.log2(last.error(finest.work) / error):.2f}")
        print(f"     Q{run.degree}  {run.cells:5d} {run.unknowns:10d}  "
              f"{error:12.3e}  {order:>5}  {run.end:.5f} ± {run.spacing / 2:.5f}"
              f"  {run.seconds:8.2f}")
        last = run
    print(f"against Q2 with {finest.cells} × {finest.cells} cells: "
          f"end of contact {finest.end:.5f} ± {finest.spacing / 2:.5f}")


def draw(runs, finest, path):
    try:
        from crevasse.plotting import pyplot
    except ImportError as missing:
        sys.exit(f"{missing}. Figures need Debian's package python3-matplotlib.")
    figure, (left, middle, right) = pyplot.subplots(
        1, 3, figsize=(11, 3.6), constrained_layout=True)
    for degree, rate in ((1, 1.), (2, 1.5)):
        points = [run for run in runs if run.degree == degree]
        h = [1 / run.cells for run in points]
        errors = [run.error(finest.work) for run in points]
        line, = left.loglog(h, errors, "o-", label=f"Q{degree}")
        left.loglog(h, [errors[-1] * (x / h[-1])**rate for x in h], "--",
                    color=line.get_color(), linewidth=0.8,
                    label=f"h to the power {rate:g}")
        middle.loglog(h, [abs(run.end - finest.end) or finest.spacing / 2
                          for run in points], "o-", color=line.get_color(),
                      label=f"Q{degree}")
        right.loglog([run.seconds for run in points], errors, "o-",
                     color=line.get_color(), label=f"Q{degree}")
    left.set(xlabel="cell size h", ylabel="relative energy error")
    middle.set(xlabel="cell size h", ylabel="error of the end of contact")
    right.set(xlabel="wall time (s)", ylabel="relative energy error")
    for axes in (left, middle, right):
        axes.legend()
        axes.grid(True, which="both", alpha=0.2)
    figure.savefig(path, dpi=150)
    print(f"drawn in {path}")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=existing_program, help="build/crevasse")
    parser.add_argument("--output", type=pathlib.Path,
                        default=pathlib.Path("results/signorini_rates"))
    parser.add_argument("--levels", type=int, default=6,
                        help="numbers of meshes of each degree (6)")
    return parser.parse_args()


def main():
    options = arguments()
    options.output.mkdir(parents=True, exist_ok=True)
    runs = [Run(options.program.resolve(), degree, level, options.output)
            for degree in (1, 2) for level in range(options.levels)]
    finest = Run(options.program.resolve(), 2, options.levels + 1,
                 options.output)
    print_table(runs, finest)
    draw(runs, finest, options.output / "signorini_rates.png")


if __name__ == "__main__":
    main()
