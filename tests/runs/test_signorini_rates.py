"""Contact without a crack tip converges in the energy norm like h (Q1) and like
h^(3/2) (Q2): prm/studies/signorini_rates.prm."""

import math
import subprocess
import sys

from crevasse_run import PROGRAM, SOURCE, check, check_below

import pathlib

sys.path.insert(0, str(SOURCE / "doc/figures"))
from signorini_rates import Run  # noqa: E402

LEVELS = (1, 2, 3, 4)


def test_rates():
    directory = pathlib.Path("results")
    directory.mkdir(exist_ok=True)
    finest = Run(PROGRAM, 2, 6, directory)
    for degree, expected in ((1, 1.), (2, 1.5)):
        runs = [Run(PROGRAM, degree, level, directory) for level in LEVELS]
        errors = [run.error(finest.work) for run in runs]
        orders = [math.log2(a / b) for a, b in zip(errors, errors[1:])]
        mean = math.log2(errors[0] / errors[-1]) / (len(errors) - 1)
        print(f"Q{degree}: orders", *(f"{order:.2f}" for order in orders),
              f"mean {mean:.2f}")
        check(expected - 0.1 < mean < expected + 0.25, "order")
        for run in runs:
            check(0.2 < run.end < 0.9, "the closed part ends inside")
            check_below(abs(run.end - finest.end), 2 * run.spacing,
                        f"end of contact, {run.cells} cells")


def test_no_program():
    """Told, without a trace of Python."""
    script = SOURCE / "doc/figures/signorini_rates.py"
    process = subprocess.run([sys.executable, script, "nowhere"], text=True,
                             capture_output=True, timeout=1200)
    check(process.returncode == 2 and "nowhere is no program" in process.stderr
          and "Traceback" not in process.stderr, process.stderr)


test_rates()
test_no_program()
