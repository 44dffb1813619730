# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Runs a scene for all combinations of some parameters, and tabulates the results of
each point; errors beside costs, if there is a reference or a closed form. Finished
points stay on disk and are not computed again."""

import os

from crevasse.command import CommandError, Log, Parser, Stop, count, taken
from crevasse.program import Program
from crevasse.results import ResultsError
from crevasse.sweep_run import Sweep

EPILOG = """Quantities, for --error and --exact:
  probe_NAME/COLUMN     a column of a probe's table: u_1, s_22, opening, ...
  probe_NAME/u, .../s   all its displacements, all its stresses
  contact/COLUMN        of the lip's table: force, largest_pressure, closed_nodes
  crack_tip/COLUMN      K_I, K_I_stress, K_I_error, T_stress, energy_release_rate,
                        strain_energy
  crack_tip_N/COLUMN    of tip N between two lips: K_I, K_II, T_stress, ...
  creep_integral/C_t    of creep by a power law, or creep_integral_N/C_t
  periods/stress_change, load_work/load_work
  stress                at all quadrature points, in the last period
With --reference and without --error: stress, u and s of every probe, contact/force.

Examples:
  crevasse sweep prm/studies/crack_tip_handbook.prm \\
    --vary "Geometry/Crack length=0.1:0.6:11"
  crevasse sweep prm/raous1980.prm --set "Contact/Solver=automatic" \\
    --vary "Time integration/Scheme=heun,sdirk2" \\
    --vary "Time integration/Steps per period=20,40,80" \\
    --reference "Time integration/Steps per period=1280"

Finished points are not computed again: after an interruption, repeat the command.
doc/sweep.md explains errors, tables and folders.

Exit status: as that of a run. The table says which points are refused or fail; the
status is 3 only if no point has results."""


def arguments(words):
    parser = Parser("sweep", description=__doc__, epilog=EPILOG)
    parser.add_common("results/<scene name>_sweep")
    parser.add_list("--vary", "LIST", "\"Section/Name=a,b,c\": values of a parameter, "
                    "separated by \";\" if they contain commas, by \" | \" if they "
                    "contain both; \"S/N=0.1:0.6:11\": 11 equally spaced values from "
                    "0.1 to 0.6; \"S/N=a,b & S/M=c,d\" varies two parameters together. "
                    "The sweep computes all combinations")
    parser.add_list("--reference", "ASSIGNMENT", "\"Section/Name=value\": errors are "
                    "measured against a run of the scene with this value")
    parser.add_list("--exact", "FORMULA", "\"QUANTITY=formula of t\": errors of a "
                    "quantity are measured against this closed form")
    parser.add_argument("--error", default="", metavar="LIST", help="quantities whose "
                        "errors are measured, separated by commas: stress, or "
                        "TABLE/COLUMN such as crack_tip/K_I")
    parser.add_argument("--jobs", type=count, metavar="N", help="number of points that "
                        "run at the same time, each on one core (the number of cores; "
                        "1 if errors are measured beside costs, because such points "
                        "slow each other down; 1 with mpirun)")
    parser.add_argument("--bars", action="store_true", help="give the results error "
                        "bars, by companion runs of each point")
    parser.add_argument("--repeat", type=count, default=1, metavar="N", help="compute "
                        "each point N times, one at a time, and keep its least times")
    parser.add_argument("--columns", default="", metavar="LIST", help="columns of "
                        "sweep.md and sweep.tex, separated by commas, such as "
                        "K_I_largest,order,seconds (all); sweep.csv has every column")
    return parser.parse(words)


def one_thread_each():
    """Environment of the server: one thread for each run, unless the user has chosen;
    libraries read it when they are loaded."""
    if "OMP_NUM_THREADS" in os.environ:
        return None
    os.environ["OMP_NUM_THREADS"] = "1"
    return os.environ


def make_runs(series, options, log_file, what_is_kept):
    """Makes the runs of a series, such as a Sweep; returns the exit status."""
    log = Log(options.quiet)
    try:
        stop = Stop(options.wall_time, what_is_kept)
        run = series(options, Program(stop, one_thread_each()), log)
        with taken(run.directory):
            log.open(run.directory / log_file)
            stop.look_in(run.directory)
            run.run()
    except (CommandError, ResultsError, OSError) as error:
        status = getattr(error, "status", 4)
        if status == 5:
            log(f"crevasse: {error}")
        else:
            log.error(f"crevasse: {error}")
        return status
    return 0


def main(words):
    return make_runs(Sweep, arguments(words), "sweep.log", "The finished points are kept: "
                     "repeat the command to continue.")
