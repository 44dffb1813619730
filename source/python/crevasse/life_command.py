# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Computes how a crack grows: runs a scene at some crack lengths, interpolates what
drives the growth between them, applies the scene's growth law, and integrates dN =
da/(da/dN). Lengths are added until the estimated error of N is below --error. Another
law or other constants need no new runs."""

import argparse
import pathlib

from crevasse.advise import target_error
from crevasse.command import Parser, count
from crevasse.life_path import PathLife
from crevasse.life_run import Life
from crevasse.results import number
from crevasse.sweep import make_runs

EPILOG = """Files in DIR:
  life.csv      a(N): periods, crack length, K, C*, growth by each part, error of N
  life.json     N, its error, what ended the growth
  a_LENGTH/     the runs

Examples:
  crevasse life prm/crack_growth.prm --from 5 --to 35 --error 1e-3
  crevasse life plate.prm --to 5    with a .geo file that has the crack length as constant
  crevasse life plate.prm --vary "Geometry/Mesh file=a1.msh,a2.msh,a3.msh" \\
    --lengths 1,2,3

Finished runs are not computed again: after an interruption, repeat the command.
doc/life.md explains lengths, laws and errors.

Exit status: as that of a run; 3 if the error is not reached: all results are
written then."""


def length(text):
    value = number(text)
    if value is None or not 0. < value < float("inf"):
        raise argparse.ArgumentTypeError(f"\"{text}\" is not a length: must be a number "
                                         "greater than 0.")
    return value


def list_of_lengths(text):
    return list(map(length, text.split(",")))


def share(text):
    """Parses --block "SCENE=SHARE"."""
    scene, _, value = text.rpartition("=")
    part = number(value)
    if not scene or part is None or not 0. < part < float("inf"):
        raise argparse.ArgumentTypeError(f"\"{text}\" must be \"SCENE=number\", such as "
                                         "flight.prm=0.01.")
    return pathlib.Path(scene), part


def arguments(words):
    parser = Parser("life", description=__doc__, epilog=EPILOG)
    parser.add_argument("--from", dest="start", type=length, metavar="LENGTH",
                        help="crack length at N = 0 (that of the scene or of its .geo "
                        "file, or the first of --lengths)")
    parser.add_argument("--to", dest="end", type=length, metavar="LENGTH",
                        help="crack length at the end (until two cells are left of the "
                        "ligament, or the last of --lengths)")
    parser.add_argument("--error", type=target_error, default=1e-2, metavar="NUMBER",
                        help="relative error of N (1e-2)")
    parser.add_argument("--law", help="growth law in place of the scene's: [Crack tip] "
                        "Crack growth law")
    parser.add_argument("--tip", type=count, metavar="N",
                        help="number of the crack tip, where there are several")
    parser.add_list("--vary", "LIST", "\"Section/Name=a,b,c\": values of a parameter, such "
                    "as mesh files, that stand for the --lengths")
    parser.add_argument("--lengths", type=list_of_lengths, metavar="LIST",
                        help="crack lengths of the values of --vary")
    parser.add_argument("--block", action="append", default=[], type=share,
                        metavar="SCENE=SHARE", help="another scene that a period of the "
                        "first is followed by so many periods of; may be repeated")
    parser.add_argument("--path", action="store_true", help="let the crack turn: the "
                        "body, a .geo file, is meshed anew after each step")
    parser.add_argument("--step", type=length, metavar="LENGTH", help="steps of --path (a "
                        "tenth of the first crack length)")
    parser.add_argument("--bars", action="store_true", help="take the error of K from "
                        "error bars, by companion runs at each length")
    parser.add_argument("--trust-mesh", action="store_true", help="let a .geo file start "
                        "programs, and read and write files")
    parser.add_argument("--jobs", type=count, metavar="N", help="number of runs at the "
                        "same time (the number of cores; 1 with mpirun)")
    parser.add_common("results/<scene name>_life")
    options = parser.parse(words)
    if options.law:
        options.set.append(f"Crack tip/Crack growth law={options.law}")
    return options


def main(words):
    options = arguments(words)
    return make_runs(PathLife if options.path else Life, options, "life.log",
                     "The finished runs are kept: repeat the command to continue.")
