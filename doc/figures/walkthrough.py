#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The pictures of doc/getting_started.md and doc/sweep.md that the subcommand figures
draws, by the commands of these pages. A run or sweep that is done is not done again."""

import shutil
import subprocess

from study import ROOT, run_once, study_options

FAST = "Contact/Solver=automatic"


def sweep_once(options, scene, name, words):
    results = options.output / name
    if not (results / "sweep.csv").exists():
        subprocess.run([options.program, "sweep", ROOT / "prm" / scene, *words,
                        "--output", results], check=True)
    return results


def draw(options, results, figure, picture, *words):
    """Copies one of the figures of these results."""
    subprocess.run([options.program, "figures", results, *words], check=True)
    path = options.figures / picture
    shutil.copy(results / "figures" / figure, path)
    print(path)


def main():
    options = study_options(__doc__, "walkthrough")
    paper = run_once(options, "raous1980")
    draw(options, paper, "figure3_opening.png", "raous1980_opening.png")
    draw(options, paper, "figure4_stress_levels.png", "raous1980_stress.png")
    short = run_once(options, "raous1980", "short_crack",
                     ("Geometry/Crack length=0.3", FAST))
    draw(options, short, "figure3_opening.png", "getting_started_opening.png")
    costs = sweep_once(options, "raous1980.prm", "costs", (
        "--set", FAST, "--vary", "Time integration/Scheme=heun,sdirk2",
        "--vary", "Time integration/Steps per period=20,40,80",
        "--reference", "Time integration/Steps per period=640"))
    draw(options, costs, "work_precision.png", "getting_started_work.png")
    lengths = sweep_once(options, "studies/crack_tip_handbook.prm", "crack_length", (
        "--vary", "Geometry/Crack length=0.1:0.6:11"))
    draw(options, lengths, "K_I_largest.png", "sweep_crack_length.png",
         "--quantity", "K_I_largest")


main()
