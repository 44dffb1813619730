#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The studies of the time schemes, by sweeps over the scenes of prm/studies:
the paper's comparison at equal numbers of contact problems, relaxation times
from a hundredth of a period to ten, steps across the stability bound on three
meshes. Draws the figures of doc/time_schemes.md. What a sweep has computed is
not computed again."""

import csv
import subprocess

from study import ROOT, study_options  # first: finds the package

from crevasse.plotting import BLUE, GREEN, GREY, INK, VERMILION, pyplot, save

STUDIES = ROOT / "prm" / "studies"
SCHEME, STEPS = "Time integration/Scheme", "Time integration/Steps per period"
EVENTS = "Time integration/Locate contact events"
REFERENCE = [f"{SCHEME}=rk4", f"{EVENTS}=true", f"{STEPS}=2560"]
QUANTITY = "probe_C/s"

# Contact problems of a step and how the scheme is drawn.
STYLES = {"euler": (1, GREY, "o"), "heun": (2, BLUE, "s"),
          "predictor corrector": (2, GREEN, "D"),
          "exponential": (2, VERMILION, "^"), "sdirk2": (2, INK, "v"),
          "rk4": (4, "#CC79A7", "P"), "rk4 with events": (4, "#E69F00", "*")}
# Schemes of order 4 that choose their own steps, with events.
ADAPTIVE = {"arkode explicit": ("#56B4E9", "X"),
            "arkode implicit": ("#8C510A", "p")}
TOLERANCES = "1e-2,1e-3,1e-4,1e-5,1e-6,1e-7"
ZERO, COMPRESSIVE = ("0; 10*sin(2*pi*t/600)",
                     "0; 10*(sin(2*pi*t/600) - 0.1)")


class Studies:
    def __init__(self, program, output):
        self.program, self.output = program, output

    def sweep(self, name, scene, *options):
        """The rows of the table of one sweep."""
        directory = self.output / name
        subprocess.run([self.program, "sweep", STUDIES / scene, "--quiet",
                        "--output", directory, "--error", QUANTITY, *options],
                       check=True)
        with open(directory / "sweep.csv", newline="") as file:
            return list(csv.DictReader(file))

    def schemes(self, name, scene, works, settings):
        """Errors against contact problems a period, by scheme."""
        points = [(scheme, work // STYLES[scheme][0])
                  for scheme in STYLES for work in works]
        vary = (SCHEME + "=" + ",".join(scheme.split(" with")[0]
                                        for scheme, _ in points)
                + f" & {STEPS}=" + ",".join(str(steps) for _, steps in points)
                + f" & {EVENTS}=" + ",".join(
                    str("events" in scheme).lower() for scheme, _ in points))
        rows = self.sweep(name, scene, *both("--set", settings), "--vary", vary,
                          *both("--reference", REFERENCE))
        curves = {}
        for (scheme, _), row in zip(points, rows):
            error = row[f"error:{QUANTITY}"]
            if error and float(error) > 0:
                curves.setdefault(scheme, []).append(
                    (float(row["vi_solves"]) / 2, float(error)))
        curves.update(self.adaptive_schemes(name, scene, settings))
        return curves

    def adaptive_schemes(self, name, scene, settings):
        rows = self.sweep(
            name + "_adaptive", scene,
            *both("--set", settings + [f"{EVENTS}=true",
                                       "Time integration/Step control=adaptive"]),
            "--vary", f"{SCHEME}=" + ",".join(ADAPTIVE),
            "--vary", f"Time integration/Relative tolerance={TOLERANCES}",
            *both("--reference", REFERENCE
                  + ["Time integration/Step control=uniform"]))
        return {scheme: [(float(row["vi_solves"]) / 2,
                          float(row[f"error:{QUANTITY}"]))
                         for row in rows if row[SCHEME] == scheme
                         and row[f"error:{QUANTITY}"]]
                for scheme in ADAPTIVE}


def both(option, values):
    return [word for value in values for word in (option, value)]


def draw_curves(axes, curves, title):
    for scheme, points in curves.items():
        colour, marker = (ADAPTIVE.get(scheme) or STYLES[scheme][1:])
        axes.loglog(*zip(*points), color=colour, marker=marker, markersize=4.5,
                    label=scheme + (", adaptive" if scheme in ADAPTIVE else ""),
                    linewidth=1.3)
    axes.set_title(title, fontsize=9)
    axes.grid(True, which="major", alpha=0.25, linewidth=0.6)


def name_schemes(figure, axes):
    """Below the panels; what is saved grows by what lies outside."""
    figure.legend(*axes.get_legend_handles_labels(), loc="upper center",
                  bbox_to_anchor=(0.5, 0), ncols=5, fontsize=8)


def equal_work(studies, directory, formats):
    figure, panels = pyplot.subplots(1, 2, figsize=(8.2, 3.9), sharey=True,
                                     constrained_layout=True)
    for axes, (name, load, title) in zip(panels, (
            ("zero_mean", ZERO, "without mean load"),
            ("compressive", COMPRESSIVE, "with a compressive mean load"))):
        curves = studies.schemes(name, "time_schemes.prm",
                                 (80, 160, 320, 640, 1280),
                                 [f"Loads/Traction={load}"])
        draw_curves(axes, curves, title)
        axes.set_xlabel("contact problems a period")
    panels[0].set_ylabel("error of the stress at C, two periods")
    name_schemes(figure, panels[0])
    save(figure, "scheme_work", directory, formats)


def relaxation_times(studies, directory, formats):
    figure, panels = pyplot.subplots(2, 2, figsize=(8.2, 6.6), sharex=True,
                                     constrained_layout=True)
    for axes, ratio in zip(panels.flat, (0.01, 0.1, 1, 10)):
        curves = studies.schemes(
            f"tau_{ratio}", "relaxation_times.prm", (80, 160, 320, 640),
            [f"Material/Relaxation time={600 * ratio:g}"])
        draw_curves(axes, curves, rf"$\tau/T = {ratio}$")
    for axes in panels[1]:
        axes.set_xlabel("contact problems a period")
    for axes in panels[:, 0]:
        axes.set_ylabel("error of the stress at C")
    name_schemes(figure, panels[0, 0])
    save(figure, "relaxation_times", directory, formats)


def across_the_bound(studies, refinements):
    """The error of 40 steps by scheme and by their length over the bound 2 tau,
    against sdirk2 with steps half as long on the same mesh."""
    errors = {}
    for ratio in (0.85, 0.92, 0.98, 1.02, 1.08, 1.15):
        rows = studies.sweep(
            f"bound_{refinements}_{ratio}", "stability_bound.prm",
            *both("--set", [f"Geometry/Refinements={refinements}",
                            f"Material/Relaxation time={7.5 / ratio}"]),
            "--vary", f"{SCHEME}=euler,heun",
            *both("--reference", [f"{SCHEME}=sdirk2", f"{STEPS}=80"]))
        for row in rows:
            errors.setdefault(row[SCHEME], []).append(
                (ratio, float(row[f"error:{QUANTITY}"])))
    return errors


def stability_bound(studies, directory, formats):
    errors = {refinements: across_the_bound(studies, refinements)
              for refinements in (0, 2, 3)}
    figure, panels = pyplot.subplots(1, 2, figsize=(8.2, 3.6), sharey=True,
                                     constrained_layout=True)
    for axes, scheme in zip(panels, ("euler", "heun")):
        for refinements, colour, marker in ((0, BLUE, "o"), (2, GREEN, "s"),
                                            (3, VERMILION, "^")):
            points = errors[refinements][scheme]
            axes.semilogy(*zip(*points), color=colour, marker=marker,
                          markersize=4.5, linewidth=1.3,
                          label=f"h = 1/{14 * 2**refinements}")
        axes.axvline(1, color=INK, linewidth=0.8, linestyle=(0, (4, 3)))
        axes.set(xlabel=r"$\Delta t \,/\, (2\tau)$", title=scheme)
        axes.grid(True, which="major", alpha=0.25, linewidth=0.6)
    panels[0].set_ylabel("relative error of the stress at C,\nfive periods")
    panels[0].legend()
    save(figure, "stability_bound", directory, formats)


def main():
    options = study_options(__doc__, "time_studies", "sweeps are")
    studies = Studies(options.program.resolve(), options.output)
    for draw in (equal_work, relaxation_times, stability_bound):
        draw(studies, options.figures, options.formats)


if __name__ == "__main__":
    main()
