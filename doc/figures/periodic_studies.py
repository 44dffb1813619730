#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The studies of the methods that find the periodic state, on the scenes
prm/studies/periodic_*.prm: periods and seconds to a true error of the stress of
1e-6 by method, load, relaxation time, mesh and scheme; what the estimated error
is worth. Prints the tables and draws the figures of doc/periodic_state.md. Runs
that are finished are not computed again."""

import csv
import json
import os
import shutil
import subprocess
import sys

import numpy

from study import ROOT, print_table, study_options  # first: finds the package

from crevasse.plotting import BLUE, GREEN, GREY, INK, VERMILION, pyplot, save

STUDIES = ROOT / "prm" / "studies"
PERIOD, STEPS = 600, 40
TOLERANCE = 1e-6
GOOD_REFERENCE = 0.2  # of the tolerance is its error at most
FAR_TOO_SMALL = 3  # an estimate is, when the error is more than this many times it
COMPONENTS = ("s_11", "s_22", "s_12")
RATIOS = (0.1, 1, 10, 100)  # tau / T
MESHES = ("14 × 4", "28 × 8", "56 × 16")  # by refinements
# Scene and relaxation time of each case.
CASES = {"a": ("periodic_zero_mean", "{0:g}"),
         "b": ("periodic_compressive", "{0:g}"),
         "c": ("periodic_two_materials", "if(x < 0.5, {0:g}, {1:g})")}
NAMES = {"a": "a: without mean load", "b": "b: compressive mean load",
         "c": "c: two materials"}
STYLES = {"march": (GREY, "o"), "anderson": (BLUE, "s"), "averaged": (GREEN, "D"),
          "fourier": (VERMILION, "*")}
ANDERSON_PERIODS = 200
AVERAGED_PERIODS = 20


def march_periods(ratio, refinements):
    """Where the march is cut."""
    return 3000 if ratio in (1, 10) and refinements == 0 else 300


class Run:
    """Periods of one method: stresses at the probes and the program's table."""

    def __init__(self, directory):
        with open(directory / "run.json") as file:
            about = json.load(file)
        self.scale, self.seconds = about["scale"], about["seconds"]
        self.stress = numpy.load(directory / "stress.npy")
        self.table = {name: numpy.array(values)
                      for name, values in about["periods"].items()}

    def errors(self, reference):
        """Of each period, over all its samples and probes."""
        last = reference.stress[-1]
        return (numpy.abs(self.stress - last).max(axis=(1, 2))
                / reference.scale)

    def first_below(self, errors):
        """The number of the first period from which on errors stay below the
        tolerance; None: there is none."""
        above = numpy.flatnonzero(errors > TOLERANCE)
        first = above[-1] + 2 if len(above) else 1
        return first if first <= len(errors) else None

    def first_judged(self):
        """That of the first period with an estimate within the tolerance."""
        good = numpy.flatnonzero(
            self.table["stress_error_estimate"] <= TOLERANCE)
        return good[0] + 1 if len(good) else None


class Studies:
    def __init__(self, program, output):
        self.program, self.output = program, output

    def run(self, case, ratio, refinements, scheme, method, *, periods,
            tolerance=0):
        scene, relaxation_time = CASES[case]
        tau = ratio * PERIOD
        settings = {
            "Material/Relaxation time": relaxation_time.format(tau, 10 * tau),
            "Geometry/Refinements": refinements,
            "Time integration/Scheme": scheme,
            "Time integration/Steps per period": STEPS,
            "Periodic state/Method": method,
            "Periodic state/Maximum periods": periods,
            "Periodic state/Tolerance": f"{tolerance:g}"}
        directory = self.output / (f"{case}_{ratio:g}_{refinements}_{scheme}_"
                                   f"{method}_{periods}_{tolerance:g}"
                                   .replace(" ", "_"))
        if not (directory / "run.json").exists():
            self.compute(STUDIES / f"{scene}.prm", settings, directory)
        return Run(directory)

    def compute(self, scene, settings, directory):
        raw = directory / "raw"
        words = [word for name, value in settings.items()
                 for word in ("--set", f"{name}={value}")]
        print(directory.name, file=sys.stderr, flush=True)
        result = subprocess.run(
            [self.program, scene, "--quiet", "--output", raw, *words],
            env=dict(os.environ, OMP_NUM_THREADS="1"),
            stderr=subprocess.PIPE, text=True)
        # A march that is cut ends with status 3, and has written all.
        if result.returncode not in (0, 3):
            sys.exit(result.stderr)
        with open(raw / "summary.json") as file:
            summary = json.load(file)
        with open(raw / "periods.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        periods = {name: [float(row[name]) for row in rows]
                   for name in ("stress_change", "stress_error_estimate",
                                "vi_solves", "seconds")}
        numpy.save(directory / "stress.npy", stresses(raw, len(rows)))
        shutil.rmtree(raw)
        about = {"periods": periods, "scale": summary["extremes"]["stress"],
                 "seconds": {name: summary["seconds"].get(name, 0.)
                             for name in ("harmonic balance", "time stepping",
                                          "total")}}
        (directory / "run.json").write_text(json.dumps(about))

    def all_methods(self, case, ratio, refinements, scheme):
        """Run of each method, and the reference."""
        point = case, ratio, refinements, scheme
        runs = {}
        if scheme == "trapezoid" or refinements == 0:
            runs["march"] = self.run(*point, "march", periods=march_periods(
                ratio, refinements))
        runs["anderson"] = self.run(*point, "anderson",
                                    periods=ANDERSON_PERIODS)
        runs["averaged"] = self.run(*point, "averaged", periods=AVERAGED_PERIODS)
        if scheme == "trapezoid":
            runs["fourier"] = self.run(*point, "fourier", periods=1)
            return runs, runs["fourier"]
        return runs, self.run(*point, "averaged", periods=300, tolerance=1e-12)


def stresses(directory, n_periods):
    """At the probes: period, sample in it, component. What follows the last
    sample of a period belongs to the next one."""
    columns = []
    for path in sorted(directory.glob("probe_*.csv")):
        with open(path) as file:
            names = file.readline().strip().split(",")
        columns.append(numpy.loadtxt(
            path, delimiter=",", skiprows=1, max_rows=n_periods * STEPS,
            usecols=[names.index(name) for name in COMPONENTS]))
    stress = numpy.hstack(columns)
    return stress.reshape(n_periods, STEPS, stress.shape[1])


def short(seconds):
    return f"{seconds:.2g}" if seconds < 9.5 else f"{seconds:.0f}"


def cost(run, reference):
    """Periods, and seconds, to the true error; "?" where the reference is not
    good enough for it."""
    errors = run.errors(reference)
    n = run.first_below(errors)
    if n and not (reference.table["stress_error_estimate"][-1]
                  < GOOD_REFERENCE * TOLERANCE):
        return "?"
    seconds = run.seconds["harmonic balance"] + run.table["seconds"][:n].sum()
    return f"{n or f'> {len(errors)}'} ({short(seconds)})"


def periods_to_error(studies):
    print("Periods (seconds) to a true error of the stress of 1e-6; fourier: "
          "seconds\n")
    for columns in ((("heun", 0), ("trapezoid", 0)),
                    (("trapezoid", 1), ("trapezoid", 2), ("heun", 2))):
        header, rows = ["", "τ/T"], []
        for case in CASES:
            for ratio in RATIOS:
                row, names = [case, f"{ratio:g}"], []
                for scheme, refinements in columns:
                    runs, reference = studies.all_methods(
                        case, ratio, refinements, scheme)
                    where = f"{MESHES[refinements]}, {scheme}: "
                    for method, run in runs.items():
                        names.append(where + method)
                        where = ""
                        row.append(short(sum_of_direct(run))
                                   if method == "fourier"
                                   else cost(run, reference))
                rows.append(row)
        print_table(header + names, rows)


def sum_of_direct(run):
    return run.seconds["harmonic balance"] + run.seconds["time stepping"]


def estimates(studies):
    """A run with a tolerance is the beginning of that without."""
    print("With Tolerance = 1e-6: periods, estimated and true error\n")
    header, rows = ["", "τ/T"], []
    columns = (("march", "heun", 0), ("anderson", "heun", 0),
               ("averaged", "heun", 0),
               ("anderson", "trapezoid", 0), ("anderson", "trapezoid", 2),
               ("averaged", "heun", 2))
    for method, scheme, refinements in columns:
        header.append(f"{method}, {MESHES[refinements]}, {scheme}")
    for case in CASES:
        for ratio in RATIOS:
            rows.append([case, f"{ratio:g}"])
            for method, scheme, refinements in columns:
                runs, reference = studies.all_methods(case, ratio,
                                                      refinements, scheme)
                rows[-1].append(judgement(runs[method], reference))
    print_table(header, rows)


def judgement(run, reference):
    n = run.first_judged()
    if n is None:
        return f"> {len(run.stress)}"
    estimate = run.table["stress_error_estimate"][n - 1]
    error = run.errors(reference)[n - 1]
    doubt = "**" if error > max(FAR_TOO_SMALL * estimate, 1e-10) else ""
    return f"{n}: {rounded(estimate)}, {doubt}{rounded(error)}{doubt}"


def rounded(error):
    return f"{error:.1e}".replace("e-0", "e-") if error > 1e-10 else "0"


def draw_work(studies, directory, formats):
    """On the finest mesh, where seconds are those of solving."""
    figure, panels = pyplot.subplots(2, 3, figsize=(8.2, 5.2), sharex=True,
                                     sharey=True, constrained_layout=True)
    for row, ratio in zip(panels, (1, 10)):
        for axes, case in zip(row, CASES):
            runs, reference = studies.all_methods(case, ratio, 2, "trapezoid")
            for method, (colour, marker) in STYLES.items():
                run = runs[method]
                if method == "fourier":
                    axes.loglog([sum_of_direct(run)], [1e-11], marker,
                                color=colour, markersize=9, label=method)
                    continue
                errors = run.errors(reference)
                last = numpy.flatnonzero(errors > 1e-11)[-1] + 2
                axes.loglog(numpy.cumsum(run.table["seconds"])[:last],
                            numpy.maximum(errors[:last], 1e-11),
                            color=colour, label=method, linewidth=1.3,
                            marker=marker, markersize=3,
                            markevery=1 if method != "march" else [0])
            axes.set_title(rf"{NAMES[case]}, $\tau/T = {ratio}$", fontsize=9)
            axes.grid(True, which="major", alpha=0.25, linewidth=0.6)
    for axes in panels[1]:
        axes.set_xlabel("seconds")
    for axes in panels[:, 0]:
        axes.set_ylabel("true error of the stress")
    panels[0, 0].legend()
    save(figure, "periodic_work", directory, formats)


def draw_trap(studies, directory, formats):
    figure, panels = pyplot.subplots(1, 3, figsize=(8.2, 3.4), sharey=True,
                                     constrained_layout=True)
    for axes, (case, ratio, method, most) in zip(panels, (
            ("c", 10, "march", 3000), ("a", 1, "march", 3000),
            ("c", 10, "anderson", 40))):
        runs, reference = studies.all_methods(case, ratio, 0, "heun")
        run = runs[method]
        errors = run.errors(reference)
        k = numpy.arange(1, len(errors) + 1)
        draw = axes.semilogy if method == "anderson" else axes.loglog
        for values, colour, name, width in (
                (errors, INK, "true error", 2),
                (run.table["stress_error_estimate"], VERMILION,
                 "estimated error", 1.1),
                (run.table["stress_change"], BLUE, "change", 1.1)):
            shown = slice(1, most)
            draw(k[shown], values[shown], color=colour, linewidth=width,
                 label=name)
        axes.set(xlabel="period",
                 title=rf"{method}, case {case}, $\tau/T = {ratio}$")
        axes.grid(True, which="major", alpha=0.25, linewidth=0.6)
    panels[0].set_ylabel("relative to the largest stress")
    panels[0].set_ylim(1e-10, 2)
    panels[0].legend(loc="lower left")
    save(figure, "periodic_trap", directory, formats)


def main():
    options = study_options(__doc__, "periodic_studies")
    studies = Studies(options.program.resolve(), options.output)
    periods_to_error(studies)
    estimates(studies)
    for draw in (draw_work, draw_trap):
        draw(studies, options.figures, options.formats)


if __name__ == "__main__":
    main()
