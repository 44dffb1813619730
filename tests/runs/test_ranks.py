"""The whole program on one, two and four ranks: the same tables and fields."""

import os
import shutil

import meshio

from crevasse_run import (SOURCE, check, check_below, execute_on, full, run,
                          run_on, tier)

SCENE = SOURCE / "prm/raous1980.prm"
COMMON = ["Contact/Solver=automatic", "Time integration/Steps per period=20",
          "Periodic state/Maximum periods=1", "Periodic state/Tolerance=0",
          "Output/Field times=150"]


def compare_tables(results, reference, name, bound=1e-9):
    columns, expected = results.table(name), reference.table(name)
    check(list(columns) == list(expected), f"columns of {name}")
    worst = 0.
    for column in expected:
        check(len(columns[column]) == len(expected[column]), "rows")
        # An error is as exact as what it is the error of.
        of = expected[column.removesuffix("_error")]
        size = max(map(abs, of)) or 1.
        worst = max(worst, max(abs(a - b) for a, b in
                               zip(columns[column], expected[column])) / size)
    check_below(worst, bound, name)


def largest_field_values(results):
    """The largest |value| of each field over the pieces of all ranks."""
    largest = {}
    for piece in results.directory.glob("**/*.vtu"):
        for name, values in meshio.read(piece).point_data.items():
            here = float(abs(values).max())
            largest[name] = max(largest.get(name, 0.), here)
    check("displacement" in largest, "fields")
    return largest


def compare(n_ranks, settings, reference, label):
    print(f"{label} on {n_ranks} ranks")
    results = run_on(n_ranks, SCENE, f"{label}_{n_ranks}".replace(" ", "_"),
                     settings)
    for table in ("probe_C.csv", "contact.csv"):
        compare_tables(results, reference, table)
    expected = largest_field_values(reference)
    for name, value in largest_field_values(results).items():
        # Where nothing touches, the pressure is rounding of stresses of size 10.
        size = max(expected[name], 10. if name == "contact_pressure" else 0.)
        # Files hold single precision; directions have no sign, and none at all
        # where the principal stresses are equal.
        check(abs(value - expected[name]) <= 1e-6 * size
              or "direction" in name,
              f"field {name}: {value} instead of {expected[name]}")


def test_same_results():
    for label, settings in {
            "condensed": ["Linear solver/Type=mumps"],
            "multigrid": ["Linear solver/Type=amg"],
            "second order": ["Discretisation/Degree=2"]}.items():
        reference = run(SCENE, label.replace(" ", "_"), COMMON + settings)
        for n_ranks in tier((2,), (2, 4)):
            compare(n_ranks, COMMON + settings, reference, label)


@full
def test_flat_cells():
    # MUMPS rounds more than the certificate allows: solutions are refined.
    for height in ("0.01", "0.001"):
        settings = ["Contact/Solver=condensed active set",
                    f"Geometry/Height={height}", "Geometry/Crack length=0.5",
                    "Periodic state/Maximum periods=1",
                    "Periodic state/Tolerance=0"]
        for n_ranks in (1, 2):
            results = run_on(n_ranks, SCENE, f"flat_{height}_{n_ranks}",
                             settings + ["Linear solver/Type=mumps"])
            certificate = results.summary["certificate"]
            print(f"height {height}, {n_ranks} ranks: {certificate}")
            check_below(certificate["residual"], certificate["accuracy"],
                        "residual of flat cells")


def test_more_ranks_than_cells():
    # A mesh that begins with four cells, of which some ranks have none.
    scene = SOURCE / "prm/studies/crack_tip_adaptive.prm"
    common = ["Crack tip/Stress intensity=true",
              "Periodic state/Maximum periods=1",
              "Time integration/Steps per period=20"]
    reference = run(scene, "few_cells", common)
    for n_ranks in tier((7,), (3, 7)):
        results = run_on(n_ranks, scene, f"few_cells_{n_ranks}", common)
        check(len(results.summary["peak_memory_bytes_of_ranks"]) == n_ranks,
              "memory of each rank")
        for table in ("probe_C.csv", "contact.csv", "crack_tip.csv"):
            # The pressure in the smallest cells has the rounding of factors.
            compare_tables(results, reference, table,
                           1e-8 if table == "contact.csv" else 1e-9)


def test_refusals():
    for settings, alternative in {
            ("Contact/Solver=automatic", "Linear solver/Type=cholesky"):
            "mumps",
            ("Contact/Solver=projected sor",): "Solver = automatic",
            ("Contact/Solver=automatic", "Contact/Relaxation table=1.5"):
            "Relaxation table"}.items():
        arguments = [SCENE, "--output", "results/refused"]
        for setting in settings:
            arguments += ["--set", setting]
        for before in (["--check"], []):
            code, _, error = execute_on(2, *before, *arguments)
            check(code == 2, f"{before} {settings}: exit status {code}")
            check(alternative in error and error.count("crevasse:") == 1, error)
        print(error.splitlines()[0])


def test_lone_failure():
    # Only the first rank writes the tables: the others must not wait for ever.
    if not os.path.exists("/dev/full"):
        return
    # Without used.prm nothing is an earlier run's, which would be removed.
    shutil.rmtree("results/full", ignore_errors=True)
    os.makedirs("results/full")
    link = "results/full/log.txt"
    os.symlink("/dev/full", link)
    code, _, error = execute_on(2, SCENE, "--output", "results/full",
                             "--set", "Contact/Solver=automatic")
    os.remove(link)
    check(code == 4, f"a full disk: exit status {code}\n{error}")
    check("log.txt" in error, error)


test_same_results()
test_flat_cells()
test_more_ranks_than_cells()
test_refusals()
test_lone_failure()
