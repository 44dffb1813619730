"""Sweeps as parameter studies, without a reference: ranges of values, K_I over the crack
length against a handbook, mesh files, several tips, the closed part of the period; that
results do not depend on the number of jobs, and what an interruption leaves."""

import json
import math
import os
import pathlib
import pty
import re
import shutil
import signal
import subprocess
import sys
import time

from bars import BAR
from crevasse_run import (PROGRAM, SOURCE, check, check_below, check_close, execute,
                          execute_on, full, overrides, rows_of_sweep, sweep, tier,
                          wait_until)
from mpi_environment import ENVIRONMENT

from crevasse.results import shortest
from crevasse.sweep_plan import expand

sys.path.insert(0, str(SOURCE / "doc/figures"))
from crack_tip_handbook import edge_crack  # noqa: E402

HANDBOOK = SOURCE / "prm/studies/crack_tip_handbook.prm"
LENGTH = "Geometry/Crack length"
STEPS = "Time integration/Steps per period"
CRACK = pathlib.Path("crack.prm")
CRACK.write_text(BAR.replace("rectangle", "edge crack").replace("2, 2", "4, 2"))
TIMES = ("seconds", "seconds_time_stepping", "processor_seconds", "peak_memory_bytes",
         "jobs")


def test_ranges():
    for text, values in (
            ("0.1:0.6:11", "0.1 0.15 0.2 0.25 0.3 0.35 0.4 0.45 0.5 0.55 0.6"),
            ("0.6 : 0.1 : 6", "0.6 0.5 0.4 0.3 0.2 0.1"), ("20:80:4", "20 40 60 80"),
            ("1000000:3000000:3", "1000000 2000000 3000000"),
            ("1e-6:4e-6:4", "1e-06 2e-06 3e-06 4e-06"), ("-1:1:5", "-1 -0.5 0 0.5 1"),
            ("0:1:4", "0 0.3333333333333333 0.6666666666666666 1")):
        check(expand(text) == values.split(), f"{text}: {expand(text)}")
    for text in ("0.3", "top: 0.5", "crack:1", "a.msh", "t>0 ? 1 : 2"):
        check(expand(text) == [text], f"{text} is no range")
    words = []
    mistakes = {"0.1:0.6": "lacks the number of values", "0.1:0.6:1": "has 1 values",
                "0.1:0.6:0": "has 0 values", "0.1:0.6:2.5": "whole number",
                "0.1:x:11": "not a finite number", "0.3:0.3:3": "where it ends"}
    for text in mistakes:
        words += ["--vary", f"{LENGTH}={text}"]
    _, error = sweep("mistakes", HANDBOOK, *words, status=2)
    print(error)
    for text, message in mistakes.items():
        check(re.search(f"the range {text} of {LENGTH} .*{message}.*0.1:0.6:11", error),
              f"{text}: {message}?\n{error}")
    for jobs in ("0", "-1", "many", "1.5"):
        _, error = sweep("mistakes", HANDBOOK, "--vary", f"{LENGTH}=0.1:0.6:6",
                         "--jobs", jobs, status=2)
        check("--jobs" in error and "integer" in error, error)


def test_numbers():
    class Number(float):
        """Of NumPy 2, as its repr says."""
        def __repr__(self):
            return f"np.float64({float(self)!r})"

    for value, text in ((Number(0.25), "0.25"), (Number(1e-12), "1e-12"), (1774, "1774"),
                        (3e8, "3e+08"), (None, "")):
        check(shortest(value) == text, f"{text}: {shortest(value)}")


def test_handbook():
    """An edge crack in a long strip under a stress of 1; the formula is good to 0.5 %."""
    rows, output = sweep("handbook", HANDBOOK, "--vary", f"{LENGTH}=0.1:0.6:6",
                         "--set", "Refinement/Target unknowns=3000")
    print(output)
    check([row[LENGTH] for row in rows] == ["0.1", "0.2", "0.3", "0.4", "0.5", "0.6"],
          "the texts of the values")
    for row in rows:
        a, found = float(row[LENGTH]), float(row["K_I_largest"])
        check_below(abs(found / math.sqrt(math.pi * a) / edge_crack(a) - 1), 8e-3,
                    f"a = {a}: K_I against the formula")
        check_close(float(row["energy_release_rate"]), found**2 / 2e5, 1e-12 * found**2,
                    "energy release rate")
        check(row["Delta_K"] == "0" and row["K_I_smallest"] == row["K_I_largest"],
              "constant load")
        folder = pathlib.Path("results/handbook") / row["point"]
        summary = json.loads((folder / "summary.json").read_text())
        check(found == summary["crack_tip"]["K_I"]["largest"]
              and float(row["opening"]) == summary["extremes"]["opening"], "as in summary")
        check(not (folder / "stress_samples.bin").exists(), "no stress for errors")
    absent = re.compile("(?<!K_I_)error|order|instants|reference")
    check(not absent.search(",".join(rows[0]) + output), "nothing about errors")
    check(not pathlib.Path("results/handbook/reference").exists(), "no reference run")
    text = pathlib.Path("results/handbook/sweep.md").read_text()
    check("K_I_largest" in text and not absent.search(text), text)
    kept = json.loads(pathlib.Path("results/handbook/sweep.json").read_text())
    check(kept["points"][0]["results"]["K_I_largest"]
          == float(rows[0]["K_I_largest"]), "sweep.json")
    check_shown("handbook", "Crack length", "largest K_I",
                [[float(row[LENGTH]), float(row["K_I_largest"])] for row in rows])


def check_shown(name, x, title, points, column=None):
    """In the report, and as figures or one of them."""
    directory = pathlib.Path("results") / name
    status, _, error = execute("report", directory)
    check(status == 0, error)
    data = re.search(r'id="data">(.*?)</script>',
                     (directory / "report.html").read_text(), re.S)[1]
    charts = {chart["title"]: chart for chart in json.loads(data)["charts"]}
    check(title in charts and not any("Error" in name for name in charts), charts.keys())
    check(charts[title]["x"] == x and [point[:2] for point in
          charts[title]["series"][0]["points"]] == points, charts[title])
    status, output, error = execute("figures", directory,
                                    *["--quantity", column] * bool(column))
    check(status == 0 and "work_precision" not in output
          and output.count(".png") == (1 if column else len(charts)), output + error)
    return charts[title]


def test_mesh_files():
    """Relative to the scene; four tips, each with columns of its own."""
    pathlib.Path("meshes").mkdir(exist_ok=True)
    for name in ("two_cracks.msh", "again.msh"):
        shutil.copy(SOURCE / "prm/two_cracks.msh", pathlib.Path("meshes") / name)
    scene = shutil.copy(SOURCE / "prm/two_cracks.prm", "meshes")
    rows, _ = sweep("meshes", scene, "--vary",
                    "Geometry/Mesh file=two_cracks.msh,again.msh", "--vary",
                    "Loads/Traction=0; y | 0; 2*y", *overrides([
                        STEPS + "=2", "Periodic state/Maximum periods=1",
                        "Periodic state/Tolerance=0"]))
    check([row["Geometry/Mesh file"] for row in rows]
          == 2 * ["two_cracks.msh"] + 2 * ["again.msh"], "mesh files")
    for tip in range(1, 5):
        values = [float(row[f"K_I_largest_{tip}"]) for row in rows]
        check_below(abs(values[1] / values[0] - 2), 1e-9, f"tip {tip}: twice the load")
        check(values[:2] == values[2:], "the same mesh")
        for row in rows:
            check(row[f"Delta_K_eff_{tip}"] == row[f"Delta_K_{tip}"], "open cracks")
    chart = check_shown("meshes", "Mesh file", "largest K_I at tip 2", [
        [row["Geometry/Mesh file"], float(row["K_I_largest_2"])] for row in rows[::2]],
        "K_I_largest_2")
    check(chart["categories"] == ["two_cracks.msh", "again.msh"]
          and len(chart["series"]) == 2, chart)


def test_no_mesh():
    """A file that is not there is blamed on the option that names it."""
    _, error = sweep("no_mesh", CRACK, "--set", "Geometry/Shape=mesh file", "--vary",
                     "Geometry/Mesh file=nowhere.msh,neither.msh", status=4)
    check('--vary "Geometry/Mesh file=nowhere.msh"' in error, error)


def test_closed_part():
    """An elastic crack is closed in the half of the period that presses."""
    rows, _ = sweep("closed", CRACK, "--vary", "Loads/Traction=0; sin(2*pi*t/600) | "
                    "0; sin(2*pi*t/600)+2 | 0; sin(2*pi*t/600)-2", *overrides(
                        ["Material/Viscosity=none", STEPS + "=200"]))
    for row, part in zip(rows, (0.5, 0, 1)):
        check_close(float(row["closed_part"]), part, 1.01 / 200, "closed part")


def test_orders():
    """Only where settings are halved or doubled."""
    for values, has_orders in (("20,40,80", True), ("80,40", True), ("20,40,60", False)):
        rows, _ = sweep("orders", CRACK, "--vary", f"{STEPS}={values}",
                        "--reference", f"{STEPS}=240", "--error", "probe_top/u")
        check(("order:probe_top/u" in rows[0]) == has_orders, f"{values}: orders")
        check(float(rows[0]["opening"]) > 0, "results beside errors")
    rows, _ = sweep("orders", CRACK, "--vary", "Material/Young modulus=13000,26000",
                    "--exact", "probe_top/u_1=t")
    check("error:probe_top/u_1" in rows[0] and "order:probe_top/u_1" not in rows[0],
          "another problem is no refinement")


def values_of(rows):
    return [[text for column, text in row.items() if column not in TIMES] for row in rows]


def lines_without_times(text):
    return [line.split(";")[0] for line in text.splitlines() if "table in" not in line]


@full
def test_jobs():
    """Points of very different costs, one refused, one that fails, in one process after
    the other or two at a time: the same, but for times."""
    for name, more in (("study", ()), ("errors", (
            "--reference", STEPS + "=320", "--error", "contact/force,stress")))[:tier(1, 2)]:
        kept = {}
        for jobs in ("1", "2"):
            rows, output = sweep(
                f"{name}_{jobs}", CRACK, "--vary", STEPS + "=160,5,20,80,40",
                "--vary", "Contact/Maximum iterations=10000,1", "--jobs", jobs,
                "--set", "Contact/Solver=projected sor", *more)
            check({row["status"] for row in rows} == {"done", "failed", "refused"},
                  [row["status"] for row in rows])
            check({row["jobs"] for row in rows if row["seconds"]} == {jobs}, "jobs")
            directory = pathlib.Path("results") / f"{name}_{jobs}"
            markdown = (directory / "sweep.md").read_text()
            check(("Several points were computed at a time" in markdown) == (jobs == "2"),
                  markdown)
            files = {str(path.relative_to(directory)): path.read_bytes()
                     for path in directory.glob("*/*") if path.name != "log.txt"
                     and path.suffix not in (".json", ".prm")
                     and path.name != "periods.csv"}
            kept[jobs] = values_of(rows), lines_without_times(output), files
        for one, two, what in zip(*kept.values(), ("tables", "lines", "files")):
            check(one and one == two, f"{name}: {what} differ:\n{one}\n{two}")
    rows, _ = sweep("default", CRACK, "--vary", STEPS + "=20,40")
    check({row["jobs"] for row in rows} == {str(len(os.sched_getaffinity(0)))},
          "as many jobs as cores")
    rows, _ = sweep("default", CRACK, "--vary", STEPS + "=20,40", "--reference",
                    STEPS + "=80")
    check({row["jobs"] for row in rows} == {"1"}, "one where costs are compared")


@full
def test_jobs_with_mpirun():
    def on_two(*words):
        return execute_on(2, *words)
    _, error = sweep("ranks", CRACK, "--vary", STEPS + "=20,40", "--jobs", "2", status=2,
                     run=on_two)
    check("--jobs 2" in error and "one point at a time" in error, error)
    rows, _ = sweep("ranks", CRACK, "--vary", STEPS + "=20,40", run=on_two)
    check([row["jobs"] for row in rows] == ["1", "1"], "one at a time")


LONG = ("--vary", STEPS + "=1600,20,40,800,80", "--jobs", "2", "--set",
        "Periodic state/Maximum periods=8")


def begin(name, *more, environment=ENVIRONMENT):
    directory = pathlib.Path("results") / name
    shutil.rmtree(directory, ignore_errors=True)
    process = subprocess.Popen(
        [PROGRAM, "sweep", CRACK, "--output", directory, *LONG, *more],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment)
    return directory, process


@full
def test_interruption():
    """The second and the third point end while the first one runs."""
    whole, _ = sweep("whole", CRACK, *LONG)
    for name in tier(("SIGTERM",), ("SIGTERM", "SIGINT", "SIGHUP")):
        directory, process = begin(name)
        wait_until((directory / "steps_per_period_40/finished.json").exists, process)
        process.send_signal(getattr(signal, name))
        output, error = process.communicate()
        check(process.returncode == 5 and name in output, output + error)
        finished = {path.parent.name for path in directory.glob("*/finished.json")}
        check({"steps_per_period_20", "steps_per_period_40"} <= finished
              and len(finished) < 5, finished)
        rows = rows_of_sweep(directory)
        check({row["point"] for row in rows} == finished, "rows of finished points")
        check(not list(directory.glob("*/checkpoint")), "checkpoints of points are left")
        rows, output = sweep(name, CRACK, *LONG, fresh=False)
        check(output.count("already there") == len(finished), output)
        check(values_of(rows) == values_of(whole), "another table")
    directory, process = begin("wall_time", "--wall-time", "0.2")
    output, error = process.communicate()
    check(process.returncode == 5 and "--wall-time" in output, output + error)
    rows, _ = sweep("wall_time", CRACK, *LONG, fresh=False)
    check(values_of(rows) == values_of(whole), "another table")


def test_crash():
    """Of one of two runs under way, each of which has one thread."""
    directory, process = begin("crash", environment={
        name: text for name, text in ENVIRONMENT.items() if name != "OMP_NUM_THREADS"})
    lock = directory / "steps_per_period_1600/running"
    number = int(wait_until(lambda: re.fullmatch(r"process (\d+) .*\n", lock.read_text()),
                            process)[1])
    check(b"\0OMP_NUM_THREADS=1\0" in b"\0" + pathlib.Path(
        f"/proc/{number}/environ").read_bytes(), "one thread")
    os.kill(number, signal.SIGKILL)
    output, error = process.communicate()
    check(process.returncode == 0, output + error)
    rows = rows_of_sweep(directory)
    check([row["status"] for row in rows] == ["failed"] + 4 * ["done"]
          and "SIGKILL" in rows[0]["message"], rows[0])


def on_terminal(*words):
    """What a run writes to a terminal of 60 columns."""
    main, of_run = pty.openpty()
    process = subprocess.Popen([PROGRAM, *words], stdout=of_run, stderr=of_run,
                               env={**ENVIRONMENT, "COLUMNS": "60"})
    os.close(of_run)
    text = b""
    try:
        while part := os.read(main, 1 << 16):
            text += part
    except OSError:
        pass  # the end of a terminal
    check(process.wait() == 0, text)
    return text.decode()


def test_progress():
    """Which run is going on and how far it is; a line in a file."""
    shutil.rmtree("results/progress", ignore_errors=True)
    words = ("sweep", CRACK, "--output", "results/progress", "--vary",
             STEPS + "=400,800", "--reference", STEPS + "=1600", "--set",
             "Periodic state/Maximum periods=8", "--error", "contact/force")
    text = on_terminal(*words)
    shown = re.findall(r"\r([^\r\n]*)\x1b\[K", text)
    check(any(re.fullmatch(r"  reference: \d+ s, \d periods?", line) for line in shown),
          shown)
    check(any(re.match(r"  1 of 2: Steps per period = 400: \d+ s", line)
              for line in shown), shown)
    check(max(map(len, shown)) < 60, "lines that wrap")
    log = pathlib.Path("results/progress/sweep.log").read_text()
    check("  reference: started\n  reference: computed\n" in log and " s, 1 period"
          not in log, log)


for test in (test_ranges, test_numbers, test_handbook, test_mesh_files,
             test_no_mesh, test_closed_part, test_orders, test_jobs,
             test_jobs_with_mpirun, test_interruption, test_crash, test_progress):
    start = time.time()
    test()
    print(f"{test.__name__}: {time.time() - start:.1f} s")
