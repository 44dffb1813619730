"""How runs scale with processes, for doc/scaling.md. Tables: the seconds of each phase
on one and two processes. Figures: what depends on no machine, iterations, messages,
bytes and work of a process on up to 16 of them.

    /usr/bin/python3 doc/figures/scaling_studies.py build/crevasse

Messages are counted by tests/benchmarks/mpi_counter.c in multigrid_study
("ninja multigrid_study"). Finished runs in the
output directory are not repeated."""

import csv
import json
import shutil
import statistics
import subprocess
import sys

import numpy

from study import ROOT, print_table, study_options  # first: finds the package

from crevasse.plotting import BLUE, GREY, VERMILION, pyplot, save

sys.path.insert(0, str(ROOT / "tests/runs"))

from mpi_environment import ENVIRONMENT

COMMON = {"Contact/Solver": "automatic", "Periodic state/Method": "march",
          "Periodic state/Maximum periods": 1, "Periodic state/Tolerance": 0,
          "Output/Fields": "none"}
PLATE, BOX = "raous1980.prm", "cracked_box.prm"
# Name, scene, settings of the problems whose seconds are compared.
TIMED = (
    ("plate, degree 1, amg", PLATE, {"Geometry/Subdivisions": "448, 128",
                                     "Linear solver/Type": "amg"}),
    ("plate, degree 1, mumps", PLATE, {"Geometry/Subdivisions": "896, 256",
                                       "Linear solver/Type": "mumps"}),
    ("box, degree 1, amg", BOX, {"Geometry/Subdivisions": "48, 24, 24",
                                 "Linear solver/Type": "amg"}),
    ("box, degree 2, gmg", BOX, {"Geometry/Subdivisions": "8, 4, 4",
                                 "Geometry/Refinements": 2,
                                 "Discretisation/Degree": 2,
                                 "Linear solver/Type": "gmg"}),
)
REPETITIONS = 3
LARGE_PART = 0.05  # of the seconds: phases that are compared
# Blocks in space of degree 2: refinements of the whole, and more at the tip. 15
# thousand, 108 thousand and 0.8 million unknowns; (5, 7), 10.4 million, adds a line
# that cannot be told from the ideal one.
COUNTED = ((2, 0), (3, 0), (4, 0))
WORK_OF = COUNTED[-1]  # the least for an unknown: messages weigh most
RANKS = (1, 2, 4, 8, 16)
# By which the residual is reduced: their difference are some iterations.
ACCURACIES = (1e-1, 1e-4)
LATENCY, BANDWIDTH = 2e-6, 10e9  # seconds, bytes per second: a usual network


class Studies:
    def __init__(self, program, output):
        self.program, self.output = program, output
        output.mkdir(parents=True, exist_ok=True)
        self.counter = output.resolve() / "libmpi_counter.so"
        subprocess.run(["mpicc", "-shared", "-fPIC", "-O1", "-o", self.counter,
                        *(ROOT / "tests/benchmarks").glob("mpi_*.c")],
                       check=True)

    def run(self, scene, settings, n_ranks, number=0):
        """The summary of a run, with the rows of the counter."""
        words = [scene.split(".")[0], str(n_ranks), str(number)]
        words += [f"{name.split('/')[1]}={value}"
                  for name, value in settings.items()]
        stem = self.output.resolve() / "_".join(words).replace(" ", "")
        path = stem.with_name(stem.name + ".json")
        if path.exists():
            return json.loads(path.read_text())
        print(stem.name, file=sys.stderr, flush=True)
        raw, counts = self.output / "raw", stem.with_name(stem.name + ".csv")
        shutil.rmtree(raw, ignore_errors=True)
        command = ["mpirun", "-np", str(n_ranks), "-x",
                   f"LD_PRELOAD={self.counter}", "-x",
                   f"MPI_COUNTER_FILE={counts}", self.program,
                   ROOT / "prm" / scene, "--quiet", "--output", raw]
        for name, value in {**COMMON, **settings}.items():
            command += ["--set", f"{name}={value}"]
        result = subprocess.run(command, env=ENVIRONMENT, text=True,
                                stderr=subprocess.PIPE)
        if result.returncode != 0:
            sys.exit(result.stderr)
        summary = json.loads((raw / "summary.json").read_text())
        with open(counts, newline="") as file:
            summary["messages"] = [
                {name: float(value) for name, value in row.items()}
                for row in csv.DictReader(file)]
        path.write_text(json.dumps(summary))
        return summary

    def seconds(self, scene, settings, n_ranks):
        """The median of each phase."""
        runs = [self.run(scene, {"Time integration/Steps per period": 10,
                                 **settings}, n_ranks, k)["seconds"]
                for k in range(REPETITIONS)]
        return {phase: statistics.median(run.get(phase, 0.) for run in runs)
                for phase in runs[0]}

    def solve(self, block, n_ranks, accuracy):
        """One solve with gmg: what multigrid_study prints, and the rows of the
        counter."""
        uniform, tip = block
        stem = self.output.resolve() / f"{uniform}_{tip}_{n_ranks}_{accuracy}"
        path = stem.with_name(stem.name + ".json")
        if path.exists():
            return json.loads(path.read_text())
        print(stem.name, file=sys.stderr, flush=True)
        counts = stem.with_name(stem.name + ".csv")
        study = self.program.parent / "tests/benchmarks/multigrid_study"
        line = subprocess.run(
            ["mpirun", "-np", str(n_ranks), "-x", f"LD_PRELOAD={self.counter}",
             "-x", f"MPI_COUNTER_FILE={counts}", study, "3", "2", str(uniform),
             str(tip), "1", "gmg", str(accuracy)],
            env=ENVIRONMENT, text=True, check=True, stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE).stdout
        words = [word.strip() for word in line.split("|")]
        with open(counts, newline="") as file:
            messages = [{name: float(value) for name, value in row.items()}
                        for row in csv.DictReader(file)]
        result = {"unknowns": int(words[2]), "iterations": int(words[5]),
                  "seconds": float(words[6]), "bytes": float(words[7]),
                  "imbalance": float(words[9]), "messages": messages}
        path.write_text(json.dumps(result))
        return result

    def counts(self, block, n_ranks):
        """Of one iteration: messages, bytes and calls that involve all ranks,
        on the rank with most of each."""
        few, many = [self.solve(block, n_ranks, accuracy)
                     for accuracy in ACCURACIES]
        iterations = many["iterations"] - few["iterations"]

        def largest(name):
            return max(b[name] - a[name] for a, b in
                       zip(few["messages"], many["messages"])) / iterations
        return {"unknowns": many["unknowns"], "iterations": many["iterations"],
                "messages": largest("messages"), "bytes": largest("bytes"),
                "collectives": largest("collectives"),
                "imbalance": many["imbalance"],
                "seconds": (many["seconds"] - few["seconds"]) / iterations,
                "memory": many["bytes"]}


def strong_scaling(studies):
    print("Seconds of the phases on one and two processes\n")
    rows = []
    for name, scene, settings in TIMED:
        one, two = [studies.seconds(scene, settings, n) for n in (1, 2)]
        for phase, seconds in one.items():
            if (not phase.endswith("_mean")
                    and seconds > LARGE_PART * one["total"]):
                rows.append([name, phase, f"{seconds:.2f}", f"{two[phase]:.2f}",
                             f"{seconds / two[phase]:.2f}"])
    print_table(["", "phase", "1", "2", "ratio"], rows)


def counts(studies):
    print("One iteration of gmg, on the rank that has most\n")
    rows, points = [], {}
    for block in COUNTED:
        for n in RANKS:
            point = studies.counts(block, n)
            points[block, n] = point
            rows.append([str(point["unknowns"]), str(n),
                         str(point["iterations"]),
                         f"{point['messages']:.0f}",
                         f"{1e-3 * point['bytes']:.0f}",
                         f"{point['collectives']:.1f}",
                         f"{point['imbalance']:.3f}",
                         f"{point['memory']:.0f}"])
    print_table(["unknowns", "processes", f"iterations to {ACCURACIES[-1]:g}",
                 "messages", "kB", "calls of all", "work/equal share",
                 "bytes per unknown"], rows)
    return points


def seconds_of_iteration(point, n_ranks, work):
    """The model: work and messages of the rank that has most."""
    rounds = max(n_ranks - 1, 0).bit_length()  # of a call that involves all
    return (work * point["unknowns"] / n_ranks * point["imbalance"]
            + point["messages"] * LATENCY + point["bytes"] / BANDWIDTH
            + point["collectives"] * rounds * LATENCY)


def extrapolate(points, directory, formats):
    """The model with the seconds of one process of this machine."""
    alone = points[WORK_OF, 1]
    work = alone["seconds"] / alone["unknowns"]
    print(f"Seconds of an iteration for an unknown, here: {work:.2e}\n")
    rows = []
    figure, axes = pyplot.subplots(figsize=(4.6, 3.6), constrained_layout=True)
    for block, colour in zip(COUNTED, (GREY, BLUE, VERMILION)):
        alone = points[block, 1]
        speed = []
        for n in RANKS:
            point = points[block, n]
            speed.append(seconds_of_iteration(alone, 1, work)
                         / seconds_of_iteration(point, n, work))
            rows.append([str(point["unknowns"]), str(n), f"{speed[-1]:.1f}",
                         f"{speed[-1] / n:.2f}"])
        axes.semilogx(RANKS, numpy.divide(speed, RANKS), color=colour, marker="o",
                      markersize=4, label=f"{alone['unknowns']:,} unknowns".replace(
                          ",", " "), base=2)
    axes.set(xlabel="processes", ylabel="part of the ideal speed (model)",
             ylim=(0, 1.05))
    axes.xaxis.set_major_formatter("{x:.0f}")
    axes.legend(fontsize=8, loc="lower left")
    axes.grid(True, alpha=0.25, linewidth=0.6)
    print_table(["unknowns", "processes", "faster", "efficiency"], rows)
    save(figure, "scaling_model", directory, formats)


def main():
    options = study_options(__doc__, "scaling_studies",
                            studies=("tables", "figures"))
    studies = Studies(options.program.resolve(), options.output)
    if "tables" in options.studies:
        strong_scaling(studies)
    if "figures" in options.studies:
        extrapolate(counts(studies), options.figures, options.formats)


if __name__ == "__main__":
    main()
