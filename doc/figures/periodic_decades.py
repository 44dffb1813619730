#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The figures of doc/periodic_state.md on bodies that are hot in one place and cold in
another: periods to a true error of the stress of 1e-6 against the decades of relaxation
times, and the state after N missions. What is done is not done again; the first time
takes some minutes."""

import csv
import json
import subprocess

import numpy
from study import ROOT, study_options  # first: finds the package

from crevasse.plotting import BLUE, GREY, VERMILION, pyplot, save

DECADES = (0, 0.5, 1, 2, 3, 6, 9, 12)
MOST = {"march": 300, "anderson": 300, "averaged": 40}
COLOURS = {"march": GREY, "anderson": BLUE, "averaged": VERMILION}
MISSIONS = (1, 3, 10, 30, 100, 300, 1000, 10000, 100000)
MARCH = 300


def run(options, name, scene, *settings):
    results = options.output / name
    if not (results / "summary.json").exists():
        words = [word for setting in settings for word in ("--set", setting)]
        status = subprocess.run([options.program, "--quiet", "--force", scene,
                                 "--output", results, *words],
                                stderr=subprocess.DEVNULL).returncode
        if status not in (0, 3):  # 3: not periodic yet, and all is written
            return None
    return results


def table(path):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: numpy.array([float(row[name]) for row in rows]) for name in rows[0]}


def stresses(results):
    """By period, at the probes and samples of each."""
    n = json.loads((results / "summary.json").read_text())["periods"]
    columns = []
    for path in sorted(results.glob("probe_*.csv")):
        values = table(path)
        for name in ("s_11", "s_22", "s_12"):
            columns.append(values[name][:-1].reshape(n, -1))
    return numpy.hstack(columns)


def plate(decades, varying):
    cycle = f"({1 - varying} + {varying}*0.5*(1 - cos(2*pi*t/600)))" if varying else "1"
    place = f"(1 - x^2*{cycle})"
    return ["Geometry/Subdivisions=8, 5", "Time integration/Scheme=sdirk2",
            "Time integration/Steps per period=24", "Output/Fields=none",
            "Output/Probes=a: 0.9, 0.1; b: 0.5, 0.5; c: 0.1, 0.3",
            "Loads/Traction=0; 10*sin(2*pi*t/600) - 2",
            f"Material/Relaxation time=30*10^({decades}*{place})"]


def periods(options, method, decades, varying):
    """Periods to the error, or NaN."""
    body, words = ROOT / "prm/raous1980_body.prm", plate(decades, varying)
    found = [run(options, f"{name}_{decades}_{varying}", body, *words,
                 f"Periodic state/Method={way}", f"Periodic state/Tolerance={tolerance}",
                 f"Periodic state/Maximum periods={most}")
             for name, way, tolerance, most in (("exact", "averaged", 1e-10, 60),
                                                (method, method, 1e-7, MOST[method]))]
    if found[1] is None:
        return numpy.nan
    exact = stresses(found[0])[-1]
    errors = numpy.abs(stresses(found[1]) - exact).max(axis=1) / numpy.abs(exact).max()
    bad = numpy.flatnonzero(errors > 1e-6)
    n = bad[-1] + 2 if len(bad) else 1
    return n if n <= len(errors) else numpy.nan


def draw_decades(options):
    figure, axes = pyplot.subplots(figsize=(5.6, 3.4), constrained_layout=True)
    for method, colour in COLOURS.items():
        for varying, line in ((0, "-"), (0.5, "--")):
            numbers = numpy.array([periods(options, method, d, varying)
                                   for d in DECADES])
            if method == "anderson" and varying:
                continue  # refused
            print(method, varying, numbers)
            axes.semilogy(DECADES, numbers, line, color=colour, marker="o", markersize=4,
                          label=method if varying == 0 else None)
            reached = numpy.isfinite(numbers).nonzero()[0].max()
            axes.semilogy(DECADES[reached:reached + 2],
                          [numbers[reached], MOST["march"]][:len(DECADES) - reached],
                          line, color=colour)
    axes.axhline(MOST["march"], color=GREY, linewidth=0.6)
    axes.set(xlabel="decades of relaxation times", ylabel="periods to 1e-6",
             ylim=(1, 400))
    axes.legend()
    axes.grid(True, which="major", alpha=0.25, linewidth=0.6)
    save(figure, "periodic_decades", options.figures, options.formats)


def draw_missions(options):
    scene = ROOT / "prm/thermal_fatigue.prm"
    leaps = run(options, "missions", scene, "Periodic state/Maximum periods=400",
                "Output/Fields=none",
                "Periodic state/Missions=" + ", ".join(map(str, MISSIONS)))
    march = run(options, "march", scene, "Periodic state/Method=march",
                "Periodic state/Tolerance=0", "Output/Fields=none",
                f"Periodic state/Maximum periods={MARCH}")
    found, marched = table(leaps / "missions.csv"), table(march / "probe_mouth.csv")
    opening = marched["opening"][:-1].reshape(MARCH, -1).max(axis=1)
    figure, axes = pyplot.subplots(figsize=(5.6, 3.), constrained_layout=True)
    axes.loglog(numpy.arange(1, MARCH + 1), 1e3 * opening, color=GREY, label="march")
    axes.loglog(found["mission"], 1e3 * found["opening_largest"], "o",
                  color=VERMILION, markersize=4, label="missions")
    axes.set(xlabel="mission", ylabel="largest opening, µm")
    axes.grid(True, which="major", alpha=0.25, linewidth=0.6)
    axes.legend()
    save(figure, "periodic_missions", options.figures, options.formats)
    print(found["mission"], found["evaluations"])


def main():
    options = study_options(__doc__, "periodic_decades")
    draw_decades(options)
    draw_missions(options)


if __name__ == "__main__":
    main()
