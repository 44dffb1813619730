# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Figures 2 and 3: stress and opening at a probe over one period."""

import string

import numpy
from matplotlib.ticker import FuncFormatter, MultipleLocator

from crevasse.plotting import BLUE, GREEN, GREY, INK, SHADE, VERMILION, pyplot

COMPONENTS = ("11", "22", "12")


def largest(history, prefix):
    """The largest component of displacement, "u_", or of stress, "s_", at a probe."""
    return max((abs(values).max() for name, values in history.items()
                if name.startswith(prefix)), default=0)


def closed_intervals(history):
    """Intervals [b, c] in which the lip is closed at the probe. Between samples the end
    is where the opening, continued from the open side, vanishes."""
    t, opening = history["t"], history["opening"]
    pressure = history["pressure"]
    closed = opening <= 1e-9 * largest(history, "u_")
    stress = largest(history, "s_")
    edges = numpy.flatnonzero(numpy.diff(closed.astype(int), prepend=0,
                                         append=0))
    intervals = []
    for first, after in zip(edges[::2], edges[1::2]):
        if after - first == 1 and pressure[first] <= 1e-6 * stress:
            continue  # touches without pressing
        begin, end = t[first], t[after - 1]
        if first > 1:
            begin = crossing(t, opening, first - 2, first - 1, first)
        if after + 1 < len(t):
            end = crossing(t, opening, after + 1, after, after - 1)
        intervals.append((begin, end))
    return intervals


def crossing(t, opening, far, near, closed):
    """Instant at which the line through two open samples vanishes, but not beyond the
    closed sample."""
    slope = opening[near] - opening[far]
    if slope >= 0:
        return (t[near] + t[closed]) / 2
    zero = t[near] - opening[near] * (t[near] - t[far]) / slope
    return numpy.clip(zero, *sorted((t[near], t[closed])))


def lip_states(history, period):
    """Consecutive intervals (begin, end, is closed) that fill the period."""
    states, last = [], period.begin
    for begin, end in closed_intervals(history):
        if begin > last:
            states.append((last, begin, False))
        states.append((begin, end, True))
        last = end
    if period.end > last:
        states.append((last, period.end, False))
    return states


def time_axis(axes, period, run):
    """Draws ticks at quarters of the period, and shades the intervals of contact."""
    axes.set_xlim(period.begin, period.end)
    axes.xaxis.set_major_locator(MultipleLocator((period.end - period.begin) / 4))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda t, _: f"{t:g}"))
    axes.set_xlabel(run.in_units("time $t$ (time)"))


def shade_closed(axes, states):
    for begin, end, closed in states:
        if closed:
            axes.axvspan(begin, end, color=SHADE, linewidth=0, zorder=0)


def label_states(axes, states, period):
    """Writes above each interval whether the lip is open or closed."""
    for begin, end, closed in states:
        wide = end - begin > 0.1 * (period.end - period.begin)
        axes.annotate("closed" if closed else "open",
                      ((begin + end) / 2, 1), (0, 4),
                      xycoords=("data", "axes fraction"),
                      textcoords="offset points", ha="center", va="bottom",
                      rotation=0 if wide else 90, color=INK)


def stress_history(run, probe, wanted=None):
    """Figure 2: the stress at the probe over a period."""
    history, period = run.history(probe, wanted)
    figure, axes = pyplot.subplots(figsize=(6.4, 3.8))
    for name, colour, style in zip(COMPONENTS, (BLUE, VERMILION, GREEN),
                                   ("-", "-", (0, (5, 2)))):
        axes.plot(history["t"], history[f"s_{name}"], color=colour,
                  linestyle=style, label=f"$s_{{{name}}}$")
        if not wanted:
            draw_band(axes, run, f"probe {probe} s", history["t"], history[f"s_{name}"],
                      colour)
    axes.axhline(0, color=GREY, linewidth=0.7, zorder=1)
    if "opening" in history:
        states = lip_states(history, period)
        shade_closed(axes, states)
        label_states(axes, states, period)
    time_axis(axes, period, run)
    axes.set_ylabel(run.in_units(f"stress at {probe} (stress)"))
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
    return figure


def draw_band(axes, run, quantity, t, values, colour):
    """Draws the error bar of a quantity around a history of the last period."""
    bar = run.summary.get("bars", {}).get(quantity, {}).get("bar") or 0.
    axes.fill_between(t, values - bar, values + bar, color=colour, alpha=0.2, linewidth=0)


def letters_in_words(count, states):
    """The meanings of the letters of figure 3."""
    ends = [f"{letter}: the lip {'closes' if after[2] else 'opens'}"
            for letter, after in zip(string.ascii_lowercase[1:], states[1:])]
    last = string.ascii_lowercase[count - 1]
    return ";  ".join(["a: the period begins", *ends,
                       f"{last}: the period ends"])


def opening_history(run, probe, wanted=None):
    """Figure 3: the opening at the probe over a period; None away from the lip."""
    history, period = run.history(probe, wanted)
    if "opening" not in history:
        return None
    t, opening = history["t"], history["opening"]
    states = lip_states(history, period)
    contact = [end for begin, end, _ in states[:-1]]  # u_N = g = 0
    figure, panels = pyplot.subplots(
        2, 1, sharex=True, figsize=(6.4, 4.6),
        gridspec_kw={"height_ratios": [3, 1], "hspace": 0.1})
    for panel, name, colour in zip(panels, ("opening", "pressure"),
                                   (BLUE, VERMILION)):
        where = numpy.searchsorted(t, contact)
        panel.plot(numpy.insert(t, where, contact),
                   numpy.insert(history[name], where, 0), color=colour)
        panel.plot(t, history[name], ".", color=colour, markersize=4)
        if not wanted:
            draw_band(panel, run, f"probe {probe} {name}", t, history[name], colour)
        shade_closed(panel, states)
    axes, below = panels
    label_states(axes, states, period)
    ends = [(period.begin, opening[0])] + [(end, 0) for end in contact] + [
        (period.end, opening[-1])]
    for letter, end in zip(string.ascii_lowercase, ends):
        inward = 7 if letter == "a" else 0
        axes.plot(*end, "o", color=INK, markersize=4, clip_on=False, zorder=5)
        axes.annotate(letter, end, (inward, -9), textcoords="offset points",
                      ha="center", va="center", fontsize=11)
    for panel, name, prefix, below_zero in (
            (axes, "opening", "u_", 0.12), (below, "pressure", "s_", 0.05)):
        top = max(history[name].max(), 0)
        scale = largest(history, prefix)
        if top <= 1e-6 * scale:
            top = scale or 1  # zero but for rounding: a straight line
        panel.set_ylim(-below_zero * top, 1.08 * top)
    axes.set_ylabel(run.in_units(f"opening $u_N$ at {probe} (length)"))
    below.set_ylabel(run.in_units("pressure $g$\n(stress)"))
    time_axis(below, period, run)
    figure.align_ylabels()
    figure.text(0.5, -0.01, letters_in_words(len(ends), states), ha="center",
                va="top", fontsize=9)
    return figure
