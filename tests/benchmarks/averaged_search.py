"""Periods that averaged steps take for random bodies with relaxation times over 0 to
12 decades: python3 averaged_search.py PROGRAM SOURCE [FIRST LAST]. The true error is
that of stresses at probes against the same method to 1e-11; a body counts the periods
after which it stays below 1e-6."""

import pathlib
import statistics
import sys

sys.path.insert(0, str(pathlib.Path(sys.argv[2]) / "tests/runs"))

from averaged_scenes import probes_of, scene  # noqa: E402
from periodic_scenes import compute, difference, method  # noqa: E402


def periods_to(tolerance, seed):
    """Periods after which the true error stays below the tolerance, and those after
    which the search would have ended, with the true error then."""
    exact = compute(f"exact_{seed % 2}", scene(seed) + method(
        "averaged", "sdirk2", 1e-11, 60))
    found = compute(f"found_{seed % 2}", scene(seed) + method(
        "averaged", "sdirk2", 0.01 * tolerance, 60))
    estimates = found.summary["stress_error_estimate"]
    errors = [difference(exact, found, which=k, probes=probes_of(seed))
              for k in range(len(estimates))]
    late = [k for k, error in enumerate(errors) if error > tolerance]
    end = next(k for k, estimate in enumerate(estimates)
               if estimate is not None and estimate <= tolerance)
    return (late[-1] + 2 if late else 1), end + 1, errors[end]


def main():
    first, last = map(int, sys.argv[3:5]) if len(sys.argv) > 4 else (0, 99)
    counts = []
    for seed in range(first, last + 1):
        true, taken, error = periods_to(1e-6, seed)
        counts.append(true)
        print(f"{seed}: below 1e-6 after {true} periods; the search ends after {taken}, "
              f"with a true error of {error:.1e}", flush=True)
    print(f"{len(counts)} bodies: median {statistics.median(counts)}, "
          f"most {max(counts)}")


main()
