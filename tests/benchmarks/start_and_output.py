"""What a run costs besides computing: its start, its files of fields and its
probes. Alternating runs, medians.

    OMP_NUM_THREADS=1 /usr/bin/python3 tests/benchmarks/start_and_output.py build/crevasse [OTHER_PROGRAM]

The start is the wall time of the paper's example less that of its computing, against
one with Debian's settings of Open MPI. Fields are those of 19 instants
and probes 300, on 240 x 240 cells, against a run without. Another program (an older
build) is measured beside it."""

import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

SCENE = pathlib.Path(__file__).resolve().parents[2] / "prm/raous1980.prm"
COMMON = ["Contact/Solver=automatic", "Periodic state/Maximum periods=1",
          "Periodic state/Tolerance=0", "Output/Fields=none", "Output/Probes="]
FINE = ["Geometry/Subdivisions=240, 240"]
FIELDS = ["Output/Fields=vtu",
          "Output/Field times=" + ", ".join(str(30 * k) for k in range(1, 19))]
PROBES = ["Output/Probes=" + "; ".join(
    f"P{k}: {(k % 20 + 0.5) / 20}, {(k // 20 + 0.5) / 15}" for k in range(300))]
ENVIRONMENT = {name: value for name, value in os.environ.items()
               if not name.startswith("OMPI_MCA_")}
# As Debian's /etc/openmpi has them.
DEBIAN = {"OMPI_MCA_ess_singleton_isolated": "0", "OMPI_MCA_pml": "^ucx",
          "OMPI_MCA_orte_create_session_dirs": "1",
          "OMPI_MCA_btl": "^uct,openib,ofi"}


def measure(program, settings, more=()):
    """Wall time, that of computing, and that of time stepping."""
    with tempfile.TemporaryDirectory() as directory:
        command = [program, SCENE, "--quiet", "--output", directory]
        for setting in COMMON + settings:
            command += ["--set", setting]
        begin = time.perf_counter()
        subprocess.run(command, check=True, env={**ENVIRONMENT, **dict(more)})
        wall = time.perf_counter() - begin
        seconds = json.loads(
            (pathlib.Path(directory) / "summary.json").read_text())["seconds"]
    return {"start": wall - seconds["total"], "wall": wall,
            "stepping": seconds["time stepping"]}


def compare(repetitions, quantity, cases):
    """One row a case: seconds, and how many times those of the first case."""
    values = {name: [] for name in cases}
    for _ in range(repetitions):
        for name, arguments in cases.items():
            values[name].append(measure(*arguments)[quantity])
    print(f"| {quantity} | seconds | ratio |\n|---|---|---|")
    first = statistics.median(values[next(iter(cases))])
    for name, numbers in values.items():
        median = statistics.median(numbers)
        print(f"| {name} | {median:.3f} | {median / first:.3f} |")
    print(flush=True)


def main():
    programs = {"": sys.argv[1]}
    if len(sys.argv) > 2:
        programs["other program, "] = sys.argv[2]
    starts = {"Debian's Open MPI": (sys.argv[1], [], DEBIAN)}
    starts.update({name + "as it is": (program, [], {})
                   for name, program in programs.items()})
    compare(11, "start", starts)
    for name, program in programs.items():
        compare(3, "wall", {f"{name}no fields": (program, FINE),
                            f"{name}19 field files": (program, FINE + FIELDS)})
        compare(3, "stepping", {f"{name}no probes": (program, FINE),
                                f"{name}300 probes": (program, FINE + PROBES)})


main()
