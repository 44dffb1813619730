"""Hundreds of seeded hostile runs: derived numbers (K_op, closed parts, Delta K, da/dN,
pressures, C(t)) by two ways or a closed form, and a table by family.

    OMP_NUM_THREADS=1 /usr/bin/python3 tests/benchmarks/derived_numbers.py \\
        build/crevasse . [--count 300] [--seed 1] [--family NAME]

Works in the folder derived of the working directory, and keeps the scenes of all
instances but those that agree."""

import argparse
import pathlib
import sys

PARSER = argparse.ArgumentParser()
PARSER.add_argument("program")  # These two are what crevasse_run reads.
PARSER.add_argument("source")
PARSER.add_argument("--count", type=int, default=300)
PARSER.add_argument("--seed", type=int, default=1)
PARSER.add_argument("--family", help="only this one")
ARGUMENTS = PARSER.parse_args()

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "runs"))

from derived_families import FAMILIES  # noqa: E402
from derived_numbers import judge_all, table  # noqa: E402


def show(outcome):
    if outcome.kind != "agreed":
        print(f"{outcome.family} {outcome.seed}: {outcome.kind}, "
              f"{outcome.ratio:.2g} of the bound: {outcome.note}", flush=True)


def main():
    families = {name: draw for name, draw in FAMILIES.items()
                if ARGUMENTS.family in (None, name)}
    outcomes = judge_all(families, ARGUMENTS.count, ARGUMENTS.seed, show)
    print(table(outcomes))
    return any(one.kind == "WRONG" for one in outcomes)


sys.exit(main())
