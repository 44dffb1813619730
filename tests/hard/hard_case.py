"""What the hard cases share: their scenes, and how they are run."""

import itertools
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "runs"))

from crevasse_run import (check, check_below, check_close, execute,  # noqa: E402
                          overrides, run)

__all__ = ["HERE", "MODULUS", "PERIOD", "accuracy", "check", "check_below",
           "check_close", "column", "compute", "largest_difference", "refuse"]

PERIOD = 600.
MODULUS = 13000.


RUNS = itertools.count(1)


def compute(case, settings=(), status=0):
    """Runs the scene of a hard case into a directory of its own."""
    return run(HERE / f"{case}.prm", f"{case}_{next(RUNS)}", settings, status)


def refuse(case, settings, status, *words):
    """The scene is refused before anything is computed, with these words."""
    code, _, message = execute(HERE / f"{case}.prm", "--output",
                               "results/refused", *overrides(settings))
    check(code == status, f"{case}: exit status {code} instead of {status}\n"
                          + message)
    for word in words:
        check(word in message, f"{case}: no \"{word}\" in: {message}")
    check(not (pathlib.Path("results/refused") / "periods.csv").exists(),
          f"{case}: was computed")
    return message


def largest_difference(values, expected):
    """Relative to the largest expected value."""
    size = max(map(abs, expected))
    return max(abs(a - b) for a, b in zip(values, expected, strict=True)) / size


def column(results, probe, name):
    return results.table(f"probe_{probe}.csv")[name]


def accuracy(results):
    """What the certificate of the run accepted."""
    return results.summary["certificate"]["accuracy"]
