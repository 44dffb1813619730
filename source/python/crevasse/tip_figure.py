# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Figures of the stress across the crack plane ahead of each tip, over the distance
in logarithms, with the singular stress of K_I or of C(t) there; and of K_I along a
front in space, of two lips also K_II and K_III, or of C(t), over arc length and time;
of C* over arc length."""

import math

from matplotlib import pyplot
import numpy

from crevasse.plotting import BLUE, GREY, INK, VERMILION
from crevasse.quantities import SAME_INSTANT
from crevasse.results import number

# The exponent, I_n and the hoop stress ahead of the singular field of Hutchinson,
# Rice and Rosengren, J. Mech. Phys. Solids 16, 1968: its boundary value problem
# solved; two or three digits are in Shih's tables (Brown University, 1983).
SINGULAR = {"plane strain": ((1, 6.2832, 1.1547), (1.2, 6.2641, 1.2936),
                             (1.5, 6.1764, 1.4646), (2, 5.9388, 1.6758),
                             (3, 5.5075, 1.9407), (4, 5.2213, 2.1041),
                             (5, 5.0235, 2.2171), (7, 4.7656, 2.3658),
                             (10, 4.5399, 2.4969), (20, 4.2151, 2.6841),
                             (50, 3.9512, 2.8296)),
            "plane stress": ((1, 4.7124, 0.8660), (1.2, 4.6063, 0.9283),
                             (1.5, 4.4522, 0.9920), (2, 4.2227, 1.0536),
                             (3, 3.8550, 1.1061), (4, 3.5931, 1.1258),
                             (5, 3.4077, 1.1349), (7, 3.1711, 1.1429),
                             (10, 2.9790, 1.1473), (20, 2.7419, 1.1512),
                             (50, 2.5922, 1.1533))}


def tips_of(run):
    """Pairs (entry of summary.json, table) of the tips."""
    tips = [(run.summary.get("crack_tip", {}), "crack_tip.csv")]
    for name in ("crack_tip", "creep_integral"):
        for k, tip in enumerate(run.summary.get(f"{name}s", ()), 1):
            table = f"{name}_{k}.csv"
            tips.append((tip, table if table in run.tables else f"{name}.csv"))
    return [(tip, table) for tip, table in tips if table in run.tables
            and len(tip.get("position", ())) == len(tip.get("direction", ())) == 2]


def stress_ahead(run, fields, t):
    """Figure of the stress ahead of tips; None without singular stress in tension."""
    drawn = []
    for tip, table in tips_of(run):
        r, stress = line_ahead(fields, tip)
        name, singular = singular_stress(run, run.tables[table], t)
        if singular is not None and (stress > 0).sum() > 2:
            drawn.append((tip, r, stress, name, singular))
    if not drawn:
        return None
    figure, panels = pyplot.subplots(1, len(drawn), figsize=(5.4 * len(drawn), 4),
                                     squeeze=False, layout="constrained")
    for axes, (tip, r, stress, name, singular) in zip(panels[0], drawn):
        pulls = stress > 0
        axes.loglog(r[pulls], stress[pulls], ".", color=BLUE, label="at nodes")
        axes.loglog(r, singular(r), color=VERMILION, linewidth=1, label=name)
        place = ", ".join(f"{x:.4g}" for x in tip["position"])
        axes.set(xlabel=run.in_units("distance from the tip (length)"),
                 ylabel=run.in_units("stress across the crack plane (stress)"),
                 title=f"ahead of ({place})" if len(drawn) > 1 else "")
        axes.tick_params(which="both", color=INK)
        axes.legend()
    figure.supxlabel(f"$t$ = {t:g}", fontsize=9)
    return figure


def line_ahead(fields, tip):
    """Distances of the nodes straight ahead, and the stress across the line."""
    a, b = tip["direction"]
    x, y = (fields.points[:, :2] - tip["position"]).T
    along, across = a * x + b * y, a * y - b * x
    size = numpy.ptp(fields.points, axis=0).max()
    on = numpy.flatnonzero((abs(across) < 1e-6 * size) & (along > 1e-6 * size))
    on = on[along[on].argsort()]
    s_11, s_22, s_12 = (fields[f"stress_{name}"][on] for name in ("11", "22", "12"))
    return along[on], b * b * s_11 + a * a * s_22 - 2 * a * b * s_12


def singular_stress(run, table, t):
    """Name and function of distance of the singular stress; None if compressive."""
    column = "C_t" if "C_t" in table else "K_I"
    row = abs(table["t"] - t).argmin()
    value = table[column][row]
    if abs(table["t"][row] - t) > SAME_INSTANT * run.period or not value > 0:
        return "", None
    if column == "K_I":
        return (f"K$_I$/√(2πr), K$_I$ = {value:.4g}",
                lambda r: value / numpy.sqrt(2 * math.pi * r))
    n, A = (number(run.parameter(f"Material/Creep {name}"))
            for name in ("exponent", "coefficient"))
    ages = run.parameter("Material/Viscosity time factor") not in ("", "1")
    is_power = run.parameter("Material/Viscosity") == "power law"
    if n is None or A is None or not A > 0 or ages or not is_power:
        return "", None
    I, hoop = singular_field(run.parameter("Material/Plane state"), n)
    return (f"(C/(A I$_n$ r))$^{{1/(n+1)}}$ σ$_n$, C(t) = {value:.4g}",
            lambda r: hoop * (value / (A * I * r)) ** (1 / (n + 1)))


def singular_field(state, n):
    """I_n and the hoop stress of the singular field, interpolated in the table."""
    exponents, *columns = zip(*SINGULAR[state])
    return [numpy.interp(-1 / n, [-1 / m for m in exponents], values)
            for values in columns]


def along_front(run):
    """A figure of crack_front.csv; a row of axes for each front and mode: K at the
    instants of its extremes, and over arc length and time; C(t) at its last instant,
    and its extremes along the front over time; C*."""
    table = run.tables["crack_front.csv"]
    fronts = numpy.unique(table["front"])
    rows = [(front, name) for front in fronts
            for name in ("K_I", "K_II", "K_III", "C_t", "C_star") if name in table]
    figure, all_axes = pyplot.subplots(len(rows), 2, figsize=(9, 3.2 * len(rows)),
                                       squeeze=False, layout="constrained")
    for (front, name), axes in zip(rows, all_axes):
        own = table["front"] == front
        t, s = numpy.unique(table["t"][own]), numpy.unique(table["s"][own])
        K, error = (table[column][own].reshape(len(t), len(s))
                    for column in (name, name + "_error"))
        if name == "C_t":
            draw_creep(axes, t, s, K, error, run)
            continue
        label = run.in_units("C* (stress × length / time)" if name == "C_star" else
                             "K$_{" + name[2:] + "}$ (stress × √length)")
        if name == "C_star":  # is the same at all instants
            t, K, error = t[:1], K[:1], error[:1]
        bar = run.summary.get("bars", {}).get(f"{name}_largest", {}).get("bar")
        draw_lines(axes[0], t, s, K, error if bar is None else 0. * K + bar, label)
        if name == "C_star":
            axes[0].get_legend().remove()
        draw_map(axes[1], t, s, K, label)
        for panel in axes:
            panel.set_xlabel(run.in_units("s along the front (length)"))
        axes[1].set_ylabel(run.in_units("t (time)"))
        if len(fronts) > 1:
            axes[0].set_title(f"front {front:g}")
    return figure


def draw_creep(axes, t, s, C, error, run):
    label = run.in_units("C(t) (stress × length / time)")
    draw_lines(axes[0], t[-1:], s, C[-1:], error[-1:], label)
    axes[1].plot(t, C.max(axis=1), color=VERMILION, label="largest along the front")
    axes[1].plot(t, C.min(axis=1), color=BLUE, label="smallest")
    if C.min() > 0 and t[0] > 0:
        axes[1].set(xscale="log", yscale="log")
    axes[0].set_xlabel(run.in_units("s along the front (length)"))
    axes[1].set(xlabel=run.in_units("t (time)"), ylabel=label)
    axes[1].legend()


def draw_lines(axes, t, s, K, error, label):
    """Draws K along the front at some instants, with a band of the estimated error."""
    instants = {K.max(axis=1).argmax(): VERMILION, K.min(axis=1).argmin(): BLUE}
    for k, colour in instants.items():
        axes.fill_between(s, K[k] - error[k], K[k] + error[k], color=colour,
                          alpha=0.25, linewidth=0)
        axes.plot(s, K[k], color=colour, marker=".", label=f"t = {t[k]:g}")
    axes.axhline(0, color=GREY, linewidth=0.6)
    axes.set_ylabel(label)
    axes.legend()


def draw_map(axes, t, s, K, label):
    if len(t) < 2 or len(s) < 2:
        axes.axis("off")
        return
    size = abs(K).max() or 1.
    shades = axes.pcolormesh(s, t, K, shading="gouraud", cmap="RdBu_r", vmin=-size,
                             vmax=size)
    axes.figure.colorbar(shades, ax=axes, label=label).outline.set_edgecolor(INK)
