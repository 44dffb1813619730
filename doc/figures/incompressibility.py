#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The study of prm/studies/incompressibility.prm: what linear elements with the
full and with the mean volumetric strain and quadratic elements cost and give as
the Poisson ratio approaches 1/2. Prints the table of doc/material.md.
"""

import argparse
import csv
import json
import pathlib
import subprocess

from study import ROOT, existing_program  # first: finds the package

COARSE_CELLS = 16  # along each side
POISSON_RATIOS = (0.3, 0.49, 0.4999)
ELEMENTS = ((1, "full"), (1, "mean"), (2, "full"))


class Run:
    """One point of the study."""

    def __init__(self, program, poisson_ratio, element, refinements, directory):
        degree, volume = element
        self.name = f"Q{degree} {volume}"
        self.cells = COARSE_CELLS * 2**refinements
        results = directory / (f"{poisson_ratio}_{self.name}_{self.cells}"
                               .replace(" ", "_"))
        subprocess.run(
            [program, ROOT / "prm/studies/incompressibility.prm", "--quiet",
             "--output", results,
             "--set", f"Material/Poisson ratio={poisson_ratio}",
             "--set", f"Discretisation/Degree={degree}",
             "--set", f"Discretisation/Volumetric strain={volume}",
             "--set", f"Geometry/Refinements={refinements}"], check=True)
        summary = json.loads((results / "summary.json").read_text())
        self.unknowns = summary["unknowns"]
        self.back_solve = summary["seconds"]["back_solve_mean"]
        with open(results / "load_work.csv") as file:
            self.work = float(list(csv.DictReader(file))[-1]["load_work"])

    def error(self, exact_work):
        """Of the work of the loads: twice the strain energy, and the load
        times the mean displacement of the loaded side."""
        return abs(self.work / exact_work - 1)


def extrapolated_work(coarse, fine):
    """At a crack tip the error of the work falls like the mesh size."""
    return 2 * fine.work - coarse.work


def print_table(program, levels, directory):
    print("| ν | element | cells | unknowns | error of the work of the loads "
          "| back-solve |\n|---|---|---|---|---|---|")
    for poisson_ratio in POISSON_RATIOS:
        exact = extrapolated_work(
            *(Run(program, poisson_ratio, (2, "full"), level, directory)
              for level in (levels - 1, levels)))
        for element in ELEMENTS:
            for level in range(levels):
                run = Run(program, poisson_ratio, element, level, directory)
                print(f"| {poisson_ratio} | {run.name} "
                      f"| {run.cells} × {run.cells} | {run.unknowns} "
                      f"| {100 * run.error(exact):.1f} % "
                      f"| {1e3 * run.back_solve:.2f} ms |")
    print("against Q2 on the finest mesh and on one finer than that, "
          "extrapolated")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=existing_program, help="build/crevasse")
    parser.add_argument("--output", type=pathlib.Path,
                        default=pathlib.Path("results/incompressibility"))
    parser.add_argument("--levels", type=int, default=3,
                        help="numbers of meshes (3)")
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    print_table(options.program.resolve(), options.levels, options.output)


if __name__ == "__main__":
    main()
