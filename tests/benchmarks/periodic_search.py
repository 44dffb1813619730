"""Periods that the methods take on a family of random problems, half of them with a
gap that closes late, a quarter with k(t) or eta(t, x): a table, what the automatic
choice takes beside the best of the others, and whether all end in the same state.

    OMP_NUM_THREADS=1 /usr/bin/python3 tests/benchmarks/periodic_search.py \\
        build/crevasse . [FIRST [LAST [MOST]]]

The seeds from FIRST (0) to LAST (99) are computed, at most MOST (300) periods each."""

import pathlib
import statistics
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "runs"))

from periodic_scenes import WAYS, ratio_to_best, search_by_all  # noqa: E402

first, last, most = (int(given) for given in
                     sys.argv[3:] + ["0", "99", "300"][len(sys.argv) - 3:])
ratios, failed, wrong = {}, [], []
print("seed " + "".join(f"{way:>14}" for way in WAYS) + "   difference/estimate")
for seed in range(first, last + 1):
    periods, apart = search_by_all(seed, most)
    print(f"{seed:4} " + "".join(f"{periods.get(way, '-'):>14}" for way in WAYS)
          + f"   {apart:.2g}", flush=True)
    if apart > 3:
        wrong.append(seed)
    if periods and "automatic" not in periods:
        failed.append(seed)
    elif len(periods) > 1:
        ratios[seed] = ratio_to_best(periods)
print(f"{len(ratios)} problems: the automatic choice takes "
      f"{statistics.mean(ratios.values()):.2f} times the periods of the best in the "
      f"mean, at most {max(ratios.values()):.2f} times, more than twice in "
      f"{[seed for seed, ratio in ratios.items() if ratio > 2]}; it fails where "
      f"another ends in {failed}; ends differ by more than three times the estimated "
      f"errors in {wrong}")
sys.exit(bool(failed or wrong))
