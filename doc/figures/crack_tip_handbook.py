#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""K_I against handbooks, on the scene prm/studies/crack_tip_handbook.prm: edge and
centre cracks in a long strip, and the geometry SSLP101 of Code_Aster's validation
manual, each on two meshes. Prints the table of doc/crack_tip.md."""

import argparse
import csv
import math
import os
import pathlib
import subprocess
import sys

from study import ROOT, existing_program  # first: finds the package

SCENE = ROOT / "prm" / "studies" / "crack_tip_handbook.prm"
LENGTHS = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6)
MESHES = (4000, 8000)  # target unknowns
SSLP101 = ("Geometry/Width=100", "Geometry/Height=250",
           "Geometry/Crack length=37.5", "Geometry/Subdivisions=8, 20")


def edge_crack(alpha):
    """K_I / (stress √(πa)) of Tada, Paris, Irwin, The Stress Analysis of Cracks
    Handbook; better than 0.5 %."""
    x = math.pi * alpha / 2
    return (math.sqrt(math.tan(x) / x) / math.cos(x)
            * (0.752 + 2.02 * alpha + 0.37 * (1 - math.sin(x)) ** 3))


def centre_crack(alpha):
    """The same for a crack of length 2a in a strip of width 2a/alpha: Feddersen's
    formula as modified by Tada; 0.1 %."""
    return ((1 - 0.025 * alpha ** 2 + 0.06 * alpha ** 4)
            / math.sqrt(math.cos(math.pi * alpha / 2)))


def cases():
    """Name, settings, crack length and formula."""
    for shape, formula in (("edge crack", edge_crack),
                           ("centre crack", centre_crack)):
        for a in LENGTHS:
            yield (f"{shape}, a/W = {a:g}",
                   [f"Geometry/Shape={shape}", f"Geometry/Crack length={a!r}"],
                   a, formula(a))
    yield "SSLP101", list(SSLP101), 37.5, edge_crack(0.375)


def intensity(program, settings, directory):
    words = [word for setting in settings for word in ("--set", setting)]
    result = subprocess.run(
        [program, SCENE, "--quiet", "--output", directory, *words],
        env=dict(os.environ, OMP_NUM_THREADS="1"), stderr=subprocess.PIPE,
        text=True)
    if result.returncode != 0:
        sys.exit(result.stderr)
    with open(directory / "crack_tip.csv", newline="") as file:
        return float(list(csv.DictReader(file))[-1]["K_I"])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=existing_program, help="build/crevasse")
    parser.add_argument("--output", type=pathlib.Path,
                        default=pathlib.Path("results/crack_tip_handbook"),
                        help="where the last run is kept")
    options = parser.parse_args()
    print("| | K_I | two meshes differ by | K_I / (σ√(πa)) | formula | "
          "difference |\n" + "|---" * 6 + "|")
    for name, settings, a, formula in cases():
        coarse, fine = (intensity(options.program.resolve(), settings + [
            f"Refinement/Target unknowns={n}"], options.output) for n in MESHES)
        factor = fine / math.sqrt(math.pi * a)
        print(f"| {name} | {fine:.5f} | {100 * abs(coarse / fine - 1):.4f} % | "
              f"{factor:.5f} | {formula:.4f} | {100 * (factor / formula - 1):+.2f} "
              "% |", flush=True)


if __name__ == "__main__":
    main()
