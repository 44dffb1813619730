#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The built-in shapes with the ids of their boundaries and their default roles."""

import argparse
import pathlib

import numpy

from study import ROOT  # first: finds the package

from crevasse.plotting import BLUE, GREEN, GREY, INK, SHADE, VERMILION, pyplot, save

COLOURS = {"Symmetry": BLUE, "Loaded": VERMILION, "Contact": GREEN, "free": GREY}
ROLES = {0: "free", 1: "free", 2: "Symmetry", 3: "Loaded", 4: "Contact", 5: "free",
         6: "free"}
TILT = numpy.array([-0.4, -0.3])  # of the z axis in the plane


def label(axes, place, number, roles, hidden=False):
    colour = COLOURS[roles[number]]
    axes.text(*place, str(number), ha="center", va="center", fontsize=10, zorder=5,
              color=colour if hidden else "white",
              bbox=dict(boxstyle="circle,pad=0.25", edgecolor=colour,
                        facecolor="white" if hidden else colour))


def draw_side(axes, begin, end, place, number, roles):
    role = roles[number]
    axes.plot(*zip(begin, end), color=COLOURS[role], solid_capstyle="butt", zorder=3,
              linewidth=1.5 if role == "free" else 4)
    label(axes, place, number, roles)


def draw_arrows(axes, begins, direction, colour):
    axes.quiver(*numpy.transpose(begins), *direction, color=colour, angles="xy",
                scale_units="xy", scale=1, width=0.008, zorder=4)


def draw_plate(axes, title, lip, fixed, roles=None):
    """The lip is from its first to its second x, the ligament the rest; fixed is
    what is written at the point x."""
    roles = roles or ROLES
    axes.fill([0, 1, 1, 0], [0, 0, 1, 1], color=SHADE)
    axes.plot([0, 0, 1, 1], [0, -0.3, -0.3, 0], color=GREY, linewidth=0.8,
              linestyle=(0, (4, 3)))
    if roles[0] == "Symmetry":
        axes.plot([0, -0.3, -0.3, 0], [1, 1, 0, 0], color=GREY, linewidth=0.8,
                  linestyle=(0, (4, 3)))
    rest = (0, 1)
    if lip:
        rest = (0, lip[0]) if lip[0] > 0 else (lip[1], 1)
        draw_side(axes, (lip[0], 0), (lip[1], 0), (sum(lip) / 2, 0.13), 4, roles)
    draw_side(axes, (rest[0], 0), (rest[1], 0), (sum(rest) / 2, 0.13), 2, roles)
    draw_side(axes, (0, 0), (0, 1), (0.1, 0.5), 0, roles)
    draw_side(axes, (1, 0), (1, 1), (0.9, 0.5), 1, roles)
    draw_side(axes, (0, 1), (1, 1), (0.5, 0.88), 3, roles)
    axes.plot(fixed[0], 0, "o", color=INK, markersize=5, zorder=4)
    axes.text(fixed[0] or 0.04, -0.12, fixed[1], ha="center" if fixed[0] else "left",
              va="center", fontsize=9)
    draw_arrows(axes, [(x, 1.03) for x in numpy.linspace(0.06, 0.94, 5)], (0, 0.2),
                VERMILION)
    axes.set_title(title)


def draw_box(axes):
    def corner(x, y, z):
        return numpy.array([x, y]) + z * TILT

    for face in ([(0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)],
                 [(1, 0, 0), (1, 0, 1), (1, 1, 1), (1, 1, 0)],
                 [(0, 1, 0), (1, 1, 0), (1, 1, 1), (0, 1, 1)]):
        axes.add_patch(pyplot.Polygon([corner(*p) for p in face], facecolor=SHADE,
                                      edgecolor=INK, linewidth=1))
    for end in ((0, 0, 1), (0, 1, 0), (1, 0, 0)):
        axes.plot(*zip(corner(0, 0, 0), corner(*end)), color=GREY, linewidth=0.8,
                  linestyle=(0, (4, 3)))
    for number, place in ((0, (0, 0.5, 0.5)), (2, (0.65, 0, 0.5)),
                          (5, (0.4, 0.62, 0))):
        label(axes, corner(*place), number, ROLES, hidden=True)
    for number, place in ((1, (1, 0.5, 0.5)), (3, (0.5, 1, 0.5)), (6, (0.5, 0.5, 1))):
        label(axes, corner(*place), number, ROLES)
    for name, end in zip("xyz", numpy.eye(3)):
        direction = 0.2 * corner(*end)
        draw_arrows(axes, [(0.88, -0.44)], direction, INK)
        axes.text(*(numpy.array([0.88, -0.44]) + 1.35 * direction), name, ha="center",
                  va="center", fontsize=9)
    axes.set_title("box; hollow: hidden sides")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--figures", type=pathlib.Path,
                        default=ROOT / "doc/figures",
                        help="where the figure goes")
    options = parser.parse_args()
    figure, panels = pyplot.subplots(1, 4, figsize=(10, 3.1))
    figure.subplots_adjust(0.01, 0.1, 0.99, 0.92, wspace=0.05)
    draw_plate(panels[0], "edge crack", (0.5, 1), (0.5, "tip, x fixed"))
    draw_plate(panels[1], "centre crack", (0, 0.5), (0.5, "tip"),
               {**ROLES, 0: "Symmetry"})
    draw_plate(panels[2], "rectangle", None, (0, "x fixed"))
    draw_box(panels[3])
    for axes in panels:
        axes.axis("off")
        axes.set(aspect="equal", xlim=(-0.45, 1.2), ylim=(-0.5, 1.3))
    figure.legend(handles=[pyplot.Line2D([], [], color=colour, linewidth=4, label=role)
                           for role, colour in COLOURS.items()],
                  loc="lower center", ncol=4)
    save(figure, "boundaries", options.figures, ["png"])


main()
