#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""What accuracy costs in Crevasse, CalculiX and PETSc's SNESVI: error against CPU
seconds of the whole process for the paper's square, opened and pressed, a creeping
body with contact, and a creeping tube. Prints the tables and draws the figures of
doc/comparison.md. Runs that are finished are not computed again; a program that is
not installed is left out. SNESVI is the program tests/benchmarks/snesvi.cc."""

import csv
import json
import math
import os
import re
import shutil
import sys

from study import ROOT, print_table, study_options  # first: finds the package

sys.path[1:1] = [str(ROOT / "tests/benchmarks"), str(ROOT / "tests/runs")]
import calculix  # noqa: E402
import tubes  # noqa: E402
from calculix_decks import (  # noqa: E402
    Mesh, fan, square_deck, tube_deck, uniform)
from crevasse.plotting import (  # noqa: E402
    BLUE, GREEN, MARKERS, VERMILION, name_numbers, pyplot, save)

SQUARE = ROOT / "prm/studies/crack_tip_elastic.prm"
# Traction 10 − c x³ on the top, and the energy that is approached: by an hp quadtree
# (validation.md), and by the finest meshes of Crevasse (comparison.md).
LOADS = {"opened": (0, 9.71931251e-3), "pressed": (26, 2.3510065e-3)}
CREVASSE, CCX, SNESVI = BLUE, VERMILION, GREEN


def tube_error(table):
    """SSNA104: largest error of the outer displacement by times and values."""
    return max(abs(u / (2e-3 / 3 * (1.9 - 0.08 * math.exp(-t) + 1.5 * t)) - 1)
               for t, u in table)


class Runs:
    """Of each program; a run's numbers are kept in a file of its name."""

    def __init__(self, options):
        self.program, self.output = options.program.resolve(), options.output.resolve()
        self.output.mkdir(parents=True, exist_ok=True)
        beside = self.program.parent / "tests/benchmarks/snesvi"
        self.snesvi = beside if beside.exists() else None
        self.ccx = shutil.which("ccx")
        for name, there in (("ninja snesvi", self.snesvi), ("calculix-ccx", self.ccx)):
            if not there:
                print(f"Without {name}: its curves are left out, and the figures "
                      f"go to {self.output}.", file=sys.stderr)

    def kept(self, name, run):
        """What run(folder) returns, with the CPU seconds; the shortest of three
        short runs counts."""
        folder = self.output / name.replace(" ", "_").replace(",", "")
        path = folder / "kept.json"
        if not path.exists():
            print(name, file=sys.stderr, flush=True)
            folder.mkdir(parents=True, exist_ok=True)
            found = run(folder)
            if not found["rows"]:
                sys.exit(f"{name} had no result: see {folder}.")
            for _ in range(2 if found["seconds"] < 3 else 0):
                found["seconds"] = min(found["seconds"], run(folder)["seconds"])
            path.write_text(json.dumps(found))
        return json.loads(path.read_text())

    def crevasse(self, name, scene, settings, table, columns):
        def run(folder):
            seconds = calculix.cpu_seconds(
                [self.program, scene, "--quiet", "--force", "--output", "raw",
                 *(word for one in settings for word in ("--set", one))], folder)
            with open(folder / "raw" / table, newline="") as file:
                rows = [[float(row[name]) for name in columns]
                        for row in csv.DictReader(file)]
            summary = json.loads((folder / "raw/summary.json").read_text())
            shutil.rmtree(folder / "raw")
            return dict(seconds=seconds, unknowns=summary["unknowns"], rows=rows)
        return self.kept(f"Crevasse {name}", run)

    def calculix(self, name, deck, unknowns, pattern):
        def run(folder):
            (folder / "deck.inp").write_text("\n".join(deck()) + "\n")
            seconds = calculix.cpu_seconds(["ccx", "deck"], folder)
            rows = [[float(value) for value in row] for row in
                    re.findall(pattern, (folder / "deck.dat").read_text())]
            for path in folder.glob("deck.*") if rows else ():
                path.unlink()
            return dict(seconds=seconds, unknowns=unknowns, rows=rows)
        return self.kept(f"CalculiX {name}", run)

    def reduced_space(self, name, settings):
        def run(folder):
            printed = folder / "printed.txt"
            with open(printed, "w") as file:
                seconds = calculix.cpu_seconds([self.snesvi, SQUARE, *settings],
                                               folder, file)
            rows = re.findall(r"unknowns (\d+) .*energy (\S+)", printed.read_text())
            return dict(seconds=seconds, unknowns=int(rows[0][0]) if rows else 0,
                        rows=[[float(energy)] for _, energy in rows])
        return self.kept(f"SNESVI {name}", run)


class Curve:
    """Of a way to compute: seconds, error and size of its runs."""

    def __init__(self, name, colour, runs, error, steps=()):
        self.name, self.colour = name, colour
        sizes = [f"{run['unknowns']} unknowns" for run in runs]
        if steps:
            sizes = [f"{size}, {n} steps" for size, n in zip(sizes, steps)]
        self.points = [(run["seconds"], error(run["rows"]), size)
                       for run, size in zip(runs, sizes)]


def square(runs, load):
    c, exact = LOADS[load]
    traction = f"Loads/Traction=0; 10-{c}*x^3"
    sizes = (8, 16, 32, 64)

    def error(rows):
        return abs(rows[-1][-1] / exact - 1)

    def settings(degree, functions, cells, **refinement):
        return [traction, f"Discretisation/Degree={degree}",
                f"Discretisation/Singular functions={functions}",
                f"Geometry/Subdivisions={cells}, {cells}",
                *(f"Refinement/{key.replace('_', ' ')}={value}"
                  for key, value in refinement.items())]

    def ours(name, *all_settings):
        return Curve(f"Crevasse, {name}", CREVASSE, [runs.crevasse(
            f"{load} {name} {k}", SQUARE, one, "crack_tip.csv", ["strain_energy"])
            for k, one in enumerate(all_settings)], error)

    def theirs(name, meshes):
        decks = [(mesh, lambda mesh=mesh: square_deck(
            mesh, 13000., 0.2, lambda x: 10 - c * x**3, contact=c > 0))
            for mesh in meshes]
        return Curve(f"CalculiX, {name}", CCX, [runs.calculix(
            f"{load} {name} {k}", deck, 2 * len(mesh.x), r"time +(\S+)\n\n +(\S+)")
            for k, (mesh, deck) in enumerate(decks)], error)

    def reduced_space(name, *all_settings):
        return Curve(f"SNESVI, {name}", SNESVI, [runs.reduced_space(
            f"{load} {name} {k}", one) for k, one in enumerate(all_settings)], error)

    yield ours("Q1", *(settings(1, 0, 2 * n) for n in sizes))
    yield ours("Q2", *(settings(2, 0, n) for n in sizes))
    yield ours("Q2 with 2 functions", *(settings(2, 2, n) for n in sizes))
    yield ours("Q2 with 2 functions, adaptive", *(settings(
        2, 2, 8, Strategy="adaptive", Target_unknowns=n) for n in (1500, 6000, 24000)))
    if runs.ccx:
        yield theirs("CPE4", [uniform(2 * n, 1) for n in sizes])
        yield theirs("CPE8R", [uniform(n, 2) for n in sizes])
        yield theirs("CPE8R, quarter points", [fan(m) for m in (4, 8, 16, 24)])
    if runs.snesvi:
        yield reduced_space("Q2", *(settings(2, 0, n) for n in sizes))
        yield reduced_space("Q2, graded", *(settings(
            2, 0, n, Strategy="tip", Cycles=cycles)
            for n, cycles in ((8, 6), (16, 8), (32, 10), (64, 12))))


def tube(runs):
    def ours(n, steps):
        mesh = runs.output / f"tube_{n}.msh"
        tubes.write(mesh, n, n)
        scene = runs.output / "tube.prm"
        scene.write_text(tubes.TUBE)
        return runs.crevasse(f"tube {n} {steps}", scene, [
            f"Geometry/Mesh file={mesh}", "Loads/Period=2",
            "Loads/Traction=1e-3*x/sqrt(x*x+y*y); 1e-3*y/sqrt(x*x+y*y)",
            "Material/Viscosity=isotropic", "Material/Viscous modulus=1",
            "Material/Viscous Poisson ratio=0.5", "Time integration/Scheme=rk4",
            f"Time integration/Steps per period={steps}"],
            "probe_outside.csv", ["t", "u_1"])

    def theirs(n, steps):
        mesh = Mesh(n, n, 2, lambda i, j: (
            (1 + i / (2 * n)) * math.cos(j / n * math.pi / 4),
            (1 + i / (2 * n)) * math.sin(j / n * math.pi / 4)))
        return runs.calculix(f"tube {n} {steps}", lambda: tube_deck(mesh, steps),
                             2 * len(mesh.x), r"time +(\S+)\n\n +\d+ +(\S+)")

    yield Curve("Crevasse, Q2, rk4", CREVASSE,
                [ours(n, 20) for n in (4, 8, 16, 32)], tube_error, [20] * 4)
    if runs.ccx:
        sizes, steps = (4, 4, 8, 8), (10, 40, 160, 640)
        yield Curve("CalculiX, CPE8R, implicit Euler", CCX,
                    list(map(theirs, sizes, steps)),
                    lambda rows: tube_error((t - 1, u) for t, u in rows), steps)


def creep(runs):
    """Each program against what its own steps tend to, on the same mesh."""
    cells, steps = 28, (40, 80, 160)

    def run(which, n):
        def found(folder):
            law = (cells, 5, n, 1)
            seconds, openings = (calculix.ours(runs.program, folder, law)
                                 if which == "Crevasse"
                                 else calculix.theirs(folder, law))
            return dict(seconds=seconds, unknowns=2 * (cells + 1)**2, rows=openings)
        return runs.kept(f"{which} creep {n}", found)

    def curve(name, colour, all_runs, limit):
        return Curve(name, colour, all_runs, lambda rows: calculix.differ(
            calculix.history(rows), limit), steps)

    exact = calculix.history(run("Crevasse", 960)["rows"])
    yield curve("Crevasse, Q1, sdirk2", CREVASSE,
                [run("Crevasse", n) for n in steps], exact)
    if runs.ccx:
        all_runs = [run("CalculiX", n) for n in steps]
        limit = calculix.extrapolate(*(calculix.history(one["rows"])
                                       for one in all_runs[:0:-1]))
        print(f"The limits differ by {calculix.differ(limit, exact):.1e}.\n")
        yield curve("CalculiX, C3D8I, implicit Euler", CCX, all_runs, limit)


CASES = {"square_opened": ("the square, opened: error of the energy",
                           lambda runs: square(runs, "opened")),
         "square_pressed": ("the square, partly pressed: error of the energy",
                            lambda runs: square(runs, "pressed")),
         "creep": ("creep with contact: error of the opening by the time steps", creep),
         "tube": ("a creeping tube: error of the displacement", tube)}


def draw(stem, title, curves, options):
    """Names are beside the last points, as far apart as they must be."""
    figure, axes = pyplot.subplots(figsize=(8.2, 4.2))
    for number, curve in enumerate(curves):
        seconds, errors, _ = zip(*curve.points)
        axes.loglog(seconds, errors, color=curve.colour, marker=(MARKERS + "x")[number],
                    markersize=5, linewidth=1.3)
    axes.set(title=title, xlabel="CPU seconds of the whole process", ylabel="error")
    axes.grid(True, which="major", alpha=0.25, linewidth=0.6)
    axes.margins(y=0.08)
    name_numbers(axes)
    height = None
    for curve in sorted(curves, key=lambda curve: -curve.points[-1][1]):
        place = curve.points[-1][:2]
        wanted = axes.transAxes.inverted().transform(axes.transData.transform(place))[1]
        height = wanted if height is None else min(wanted, height - 0.055)
        axes.annotate(curve.name, place, (1.03, height), textcoords="axes fraction",
                      color=curve.colour, va="center", fontsize=9,
                      arrowprops=dict(arrowstyle="-", color=curve.colour, alpha=0.4,
                                      linewidth=0.6, shrinkA=2, shrinkB=4,
                                      relpos=(0, 0.5)))
    save(figure, stem, options.figures, options.formats)


def main():
    options = study_options(__doc__, "compare", studies=CASES)
    os.environ["OMP_NUM_THREADS"] = "1"
    runs = Runs(options)
    if not (runs.snesvi and runs.ccx):
        options.figures = runs.output  # those of the page keep all curves
    for name in options.studies:
        title, curves_of = CASES[name]
        curves = list(curves_of(runs))
        print(f"{title}\n")
        print_table(["", "size", "error", "CPU seconds"], [
            [curve.name, size, f"{error:.1e}", f"{seconds:.2f}"]
            for curve in curves for seconds, error, size in curve.points])
        draw(f"compare_{name}", title[0].upper() + title[1:], curves, options)


if __name__ == "__main__":
    main()
