"""Thirty seeded instances of derived numbers: what tests/benchmarks/derived_numbers.py
runs by the hundred."""

from crevasse_run import check
from derived_families import FAMILIES
from derived_numbers import judge_all, table

outcomes = judge_all(FAMILIES, 30, 1)
print(table(outcomes))
for one in outcomes:
    if one.kind != "agreed":
        print(f"{one.family} {one.seed}: {one.kind}: {one.note}")
check(sum(one.kind == "agreed" for one in outcomes) >= 25, "most give numbers")
check(not [one for one in outcomes if one.kind == "WRONG"],
      "wrong numbers with status 0")
