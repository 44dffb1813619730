"""Periods that averaged steps take for random bodies with relaxation times over 0 to
12 decades: python3 averaged_search.py PROGRAM SOURCE [FIRST [LAST]]. The true error is
that of stresses at probes against the same method to 1e-11."""

import pathlib
import statistics
import sys

sys.path.insert(0, str(pathlib.Path(sys.argv[2]) / "tests/runs"))

from averaged_scenes import probes_of, scene  # noqa: E402
from periodic_scenes import compute, difference, method  # noqa: E402


def periods_to(tolerance, seed):
    """Periods after which the true error stays below the tolerance, and periods that
    the search takes for this tolerance."""
    exact = compute(f"exact_{seed % 2}", scene(seed) + method(
        "averaged", "sdirk2", 1e-11, 60))
    found = compute(f"found_{seed % 2}", scene(seed) + method(
        "averaged", "sdirk2", tolerance, 60))
    errors = [difference(exact, found, which=k, probes=probes_of(seed))
              for k in range(found.summary["periods"])]
    late = [k for k, error in enumerate(errors) if error > tolerance]
    return (late[-1] + 2 if late else 1), len(errors), errors[-1]


def main():
    first, last = (int(word) for word in (sys.argv[3:] + ["0", "99"])[:2]) \
        if len(sys.argv) > 4 else (0, 99)
    counts = []
    for seed in range(first, last + 1):
        true, taken, error = periods_to(1e-6, seed)
        counts.append(taken)
        print(f"{seed}: {taken} periods, true error {error:.1e}, "
              f"below 1e-6 from period {true} on", flush=True)
    print(f"{len(counts)} bodies: median {statistics.median(counts)}, "
          f"most {max(counts)}")


main()
