"""Every scene on several numbers of ranks: the largest difference of each kind of
table from the run on one rank, relative to the largest value of the column.

    /usr/bin/python3 tests/benchmarks/ranks.py build/crevasse [RANKS...] [--scene NAME]"""

import argparse
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "runs"))

from mpi_environment import ENVIRONMENT

SCENES = pathlib.Path(__file__).resolve().parents[2] / "prm"
TABLES = ("probe_*.csv", "contact.csv", "crack_tip.csv", "periods.csv")
OF_COST = {"seconds", "vi_solves"}  # columns
BOUND = 1e-8


def run(program, scene, n_ranks, directory):
    subprocess.run(["mpirun", "-np", str(n_ranks), program, scene, "--quiet",
                    "--output", directory, "--set", "Output/Fields=none"],
                   env=ENVIRONMENT, check=True)


def read(path):
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    return {name: [float(row[i]) for row in rows[1:]]
            for i, name in enumerate(rows[0]) if name not in OF_COST}


def kind(name):
    """Quantities of a kind share a scale: displacements, stresses, ..."""
    return name.split("_")[0]


def difference(one, other):
    """The largest in the rows that both tables have: where Tolerance is of the
    size of rounding, rounding decides after how many periods a run ends. Where
    both have no value there is none. An open lip bears nothing but rounding."""
    if max(one.get("closed_nodes", [1.])) == 0.:
        one = {"closed_nodes": one["closed_nodes"]}
    scale = {}
    for name, values in one.items():
        finite = [abs(value) for value in values if value == value]
        scale[kind(name)] = max([scale.get(kind(name), 0.), *finite])
    worst = 0.
    for name, values in one.items():
        for a, b in zip(values, other[name]):
            if a != a and b != b:
                continue
            size = scale[kind(name)] or 1.
            worst = max(worst, abs(a - b) / size)
    return worst


def compare(program, scene, ranks):
    print(f"{scene.relative_to(SCENES)}", flush=True)
    good = True
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        run(program, scene, 1, folder / "1")
        for n in ranks:
            run(program, scene, n, folder / str(n))
            words = []
            for pattern in TABLES:
                differences = [difference(read(path),
                                          read(folder / str(n) / path.name))
                               for path in (folder / "1").glob(pattern)]
                if differences:
                    good = good and max(differences) <= BOUND
                    words.append(f"{pattern} {max(differences):.1e}")
            one, several = [
                json.loads((folder / str(k) / "summary.json").read_text())
                for k in (1, n)]
            if one["periods"] != several["periods"]:
                words.append(f"{one['periods']} and {several['periods']} periods")
            print(f"  {n} ranks, {one['unknowns']} unknowns: "
                  + ", ".join(words), flush=True)
    return good


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("ranks", type=int, nargs="*")
    parser.add_argument("--scene", default="")
    options = parser.parse_args()
    good = True
    for scene in sorted(SCENES.rglob(f"{options.scene or '*'}.prm")):
        good = compare(options.program.resolve(), scene,
                       options.ranks or [2, 3, 4, 7]) and good
    if not good:
        sys.exit(f"Some differences exceed {BOUND}.")


main()
