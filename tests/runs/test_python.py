"""import crevasse: runs and their results from Python, what goes wrong, and the notebook
of the paper's example."""

import contextlib
import csv
import io
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import warnings

import numpy

from bars import BAR
from crevasse_run import PROGRAM, SOURCE, check, check_below, full, tier, wait_until
from mpi_environment import ENVIRONMENT

import crevasse

warnings.simplefilter("ignore")  # BAR has values that only other viscosities use
os.environ.update(ENVIRONMENT, CREVASSE_PROGRAM=str(PROGRAM), MPLBACKEND="agg")
CRACK = SOURCE / "prm/raous1980.prm"
FAST = {"Contact/Solver": "automatic", "Periodic state/Tolerance": 0}


def fails(kind, function, *arguments, **options):
    try:
        function(*arguments, **options)
    except kind as error:
        return error
    raise AssertionError(f"no {kind.__name__}")


def values_in(path):
    """Names of the columns, and the numbers, read apart from the package."""
    with open(path, newline="") as file:
        header, *rows = csv.reader(file)
    return header, numpy.array(rows, dtype=float)


def test_tables():
    """Every table is that of the file, and parameters take numbers, lists and truths.
    """
    run = crevasse.run(CRACK, FAST | {
        "Geometry/Subdivisions": [20, 6], "Geometry/Crack length": numpy.float64(0.3),
        "Crack tip/Stress intensity": True}, output="results/tables", force=True)
    for frame, name in ((run.probe("C"), "probe_C"), (run.contact, "contact"),
                        (run.periods, "periods"), (run.crack_tip(), "crack_tip"),
                        (run.table("lip.csv"), "lip"),
                        (run.table("probe_C.csv"), "probe_C")):
        header, values = values_in(f"results/tables/{name}.csv")
        check(list(frame.columns) == header, f"{name}: {list(frame.columns)}")
        check(numpy.array_equal(frame.to_numpy(), values, equal_nan=True),
              f"{name}: other values")
    check(run.parameters["Geometry/Subdivisions"] == "20, 6"
          and run.parameters["Crack tip/Stress intensity"] == "true"
          and float(run.parameters["Geometry/Crack length"]) == 0.3, "parameters")
    file = pathlib.Path("results/tables/summary.json")
    check(run.summary == json.loads(file.read_text()), "summary")
    check(run.probes == {"C": (1., 0.)} and not run.damages, "probes")
    again = crevasse.read("results/tables")
    check(again.probe("C").equals(run.probe("C")), "read later")
    for word in ("probe_D.csv", "crack_tip_2.csv", "creep_integral_1.csv"):
        kind, _, number = word.removesuffix(".csv").rpartition("_")
        get = getattr(run, kind)
        error = fails(crevasse.ResultsError, get, int(number) if number != "D" else "D")
        check(word in str(error) and "probe_C.csv" in str(error), f"{error}")
    (file.parent / "contact.csv").write_text("t,closed_nodes\n0,x\n")
    damaged = crevasse.read("results/tables")
    error = fails(crevasse.ResultsError, lambda: damaged.contact)
    check("could not convert" in str(error), f"damaged: {error}")


def test_fields():
    """The displacement of the mouth, as a probe has it, from one process and from two;
    files have seven digits."""
    for processes in (1, 2):
        run = crevasse.run(CRACK, FAST | {"Periodic state/Maximum periods": 1,
                                          "Time integration/Steps per period": 20},
                           output=f"results/on_{processes}", force=True,
                           processes=processes)
        check([field.t for field in run.fields] == [150., 600.], f"{run.fields}")
        mesh, mouth = run.fields[0].mesh(), run.probe("C")
        check(len(mesh.cells) == 1 and mesh.cells[0].data.shape == (56, 4)
              and mesh.cells[0].data.max() == len(mesh.points) - 1, f"{mesh}")
        at = numpy.flatnonzero((mesh.points == [1, 0, 0]).all(axis=1))
        u = mesh.point_data["displacement"][at, :2]
        expected = mouth.loc[mouth.t == 150., ["u_1", "u_2"]].to_numpy()
        check_below(abs(u - expected).max() / abs(expected).max(), 1e-6,
                    f"mouth in the fields of {processes}")
    runs = [crevasse.read(f"results/on_{n}").probe("C") for n in (1, 2)]
    check_below(abs(runs[0] - runs[1]).to_numpy().max(), 1e-8, "on two processes")


def test_directories():
    """As the program chooses them; earlier results are kept or replaced."""
    shutil.rmtree("results/bar", ignore_errors=True)
    pathlib.Path("bar.prm").write_text(BAR)
    run = crevasse.run("bar.prm")
    check(run.directory == pathlib.Path("results/bar"), f"{run}")
    crevasse.run("bar.prm", force=True)
    check(not pathlib.Path("results/bar/earlier_1").exists(), "kept in spite of force")
    crevasse.run("bar.prm")
    check(pathlib.Path("results/bar/earlier_1").exists(), "not kept")
    run = crevasse.run("bar.prm", {"Output directory": "results/named"}, force=True)
    check(run.directory == pathlib.Path("results/named"), f"{run}")


def test_output():
    """The log if it is wanted, without it its warnings."""
    for quiet in (True, False):
        with (contextlib.redirect_stdout(io.StringIO()) as out,
              warnings.catch_warnings(record=True) as warned):
            warnings.simplefilter("always")
            crevasse.run("bar.prm", {"Material/Viscous modulus": 3}, force=True,
                         output="results/output", quiet=quiet)
        texts = [str(one.message) for one in warned] + out.getvalue().splitlines()
        check(sum("Viscous modulus = 3 is not used" in text for text in texts) == 1,
              f"{texts}")
        check(("  results in results/output" in texts) != quiet, f"{texts}")


def test_failures():
    """The program's message and exit status."""
    error = fails(crevasse.CommandError, crevasse.run, CRACK, {"Geometry/Crak length": 1})
    check(error.status == 2 and 'did you mean "Crack length"?' in str(error), f"{error}")
    for options in ({}, {"output": "results/failed", "force": True}):
        error = fails(crevasse.CommandError, crevasse.run, "nowhere.prm", **options)
        check(error.status == 4 and "nowhere.prm" in str(error), f"{error}")
    error = fails(crevasse.CommandError, crevasse.run, CRACK, FAST | {
        "Periodic state/Tolerance": 1e-9}, output="results/failed", force=True)
    check(error.status == 3 and "not yet periodic" in str(error), f"{error}")
    run = crevasse.read("results/failed")
    check(len(run.periods) == 3 and run.summary["converged"] is False, "results")
    error = fails(crevasse.ResultsError, crevasse.read, "nowhere")
    check("nowhere: no such directory" in str(error), f"{error}")
    os.environ["CREVASSE_PROGRAM"] = "/nowhere/crevasse"
    error = fails(crevasse.CommandError, crevasse.run, CRACK)
    check(error.status == 4 and "/nowhere/crevasse" in str(error), f"{error}")
    os.environ["CREVASSE_PROGRAM"] = str(PROGRAM)


def python(text, **options):
    """Another Python, which has the package of the build and nothing else."""
    environment = {name: value for name, value in os.environ.items()
                   if name != "CREVASSE_PROGRAM"}
    environment["PYTHONPATH"] = str(PROGRAM.parent / "python")
    return subprocess.Popen([sys.executable, "-B", "-c", text], env=environment,
                            text=True, stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, **options)


def test_build():
    """In a build the program is beside the package."""
    process = python("from crevasse.program import find_program; import crevasse; "
                     "print(find_program(), *dir(crevasse))", cwd="/")
    output, error = process.communicate(timeout=1200)
    check(output.split() == [str(PROGRAM), "CommandError", "Life", "Results",
                             "ResultsError", "life", "read", "run"], output + error)


def test_interrupt():
    """Python alone gets the signal: the run ends with a checkpoint, from which it
    resumes."""
    directory = pathlib.Path("results/interrupted")
    shutil.rmtree(directory, ignore_errors=True)
    process = python("import crevasse; crevasse.run('bar.prm', {"
                     "'Periodic state/Maximum periods': 1000000},"
                     f"output='{directory}')")
    table = directory / "periods.csv"
    wait_until(lambda: table.read_text().count("\n") > 1, process)
    process.send_signal(signal.SIGINT)
    _, error = process.communicate(timeout=1200)
    check("KeyboardInterrupt" in error, error)
    check((directory / "checkpoint").is_dir()
          and "SIGTERM" in (directory / "log.txt").read_text(), "no checkpoint")
    n_periods = len(crevasse.read(directory).periods)
    run = crevasse.run("bar.prm", {"Periodic state/Maximum periods": n_periods + 3},
                       output=directory, resume=True)
    check(len(run.periods) == n_periods + 3, f"{n_periods}, then {len(run.periods)}")


@contextlib.contextmanager
def copy_of_source(folder):
    """Works in a folder that lies beside the scenes as that of the source does."""
    before = pathlib.Path.cwd()
    shutil.rmtree("source", ignore_errors=True)
    place = pathlib.Path("source") / folder
    place.mkdir(parents=True)
    pathlib.Path("source/prm").symlink_to(SOURCE / "prm")
    os.chdir(place)
    yield
    os.chdir(before)


@full
def test_page():
    """The code of doc/python.md."""
    blocks = re.findall(r"^```python\n(.*?)^```$",
                        (SOURCE / "doc/python.md").read_text(), re.M | re.S)
    names = {}
    with copy_of_source("."):
        crevasse.run("prm/raous1980.prm")
        exec("".join(blocks), names)
    check(len(blocks) == 2 and len(names["old"].periods) == len(names["runs"][1].periods),
          f"{names}")


@full
def test_notebook():
    """Its code; on fewer crack lengths in the default tier."""
    path = SOURCE / "doc/notebook/raous1980.ipynb"
    check_below(path.stat().st_size, 200e3, "bytes of the notebook")
    cells = [cell for cell in json.loads(path.read_text())["cells"]
             if cell["cell_type"] == "code"]
    code = "\n".join("".join(cell["source"]) for cell in cells)
    check(all(cell["execution_count"] for cell in cells)
          and "image/png" in path.read_text(), "outputs are not stored")
    lengths = "[0.2, 0.3, 0.4, 0.5, 0.6]"
    check(lengths in code, "other crack lengths")
    names = {}  # as Jupyter does, in one namespace
    with copy_of_source("doc/notebook"):
        exec(compile(code.replace(lengths, tier("[0.3, 0.5]", lengths)), path, "exec"),
             names)
    K = names["K"]
    print(K)
    check(K.K_I.is_monotonic_increasing, "K_I grows with the crack")
    check_below(abs(K.K_I / K.handbook - 1).max(), 0.03, "K_I, from the handbook")


test_tables()
test_fields()
test_directories()
test_output()
test_failures()
test_build()
test_interrupt()
test_page()
test_notebook()
