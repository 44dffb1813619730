"""Sweeps of parameters: orders in the table against a reference run and against
a closed form, parameters that change together, what an interrupted sweep goes on
with, what becomes of points that are refused, and that ranks do not matter."""

import json
import math
import pathlib
import re
import shutil
import signal
import subprocess
import time

from bars import BAR, RELAXING
import crevasse_run
from crevasse_run import (PROGRAM, check, check_below, execute, execute_on,
                          full, overrides, rows_of_sweep, tier, wait_until)

SCENE = "bar.prm"
CRACK = "crack.prm"
pathlib.Path(SCENE).write_text(BAR)
pathlib.Path(CRACK).write_text(BAR.replace("rectangle", "edge crack")
                               .replace("2, 2", "4, 2"))
SETTINGS = overrides(RELAXING)
STEPS = "Time integration/Steps per period"
SECONDS = ("seconds", "seconds_time_stepping", "processor_seconds", "peak_memory_bytes",
           "jobs")


def sweep(name, *arguments, scene=SCENE, **options):
    """Of the bar, or of another scene; the rows of the table, and what was said."""
    return crevasse_run.sweep(name, scene, *SETTINGS, *arguments, **options)


def without_seconds(rows):
    return [{name: value for name, value in row.items() if name not in SECONDS}
            for row in rows]


def finished_at(directory):
    """When each finished folder was computed."""
    return {path.parent.name: (path.parent / "summary.json").stat().st_mtime_ns
            for path in pathlib.Path(directory).glob("*/finished.json")}


def check_order(rows, quantity, order):
    print([row["error:" + quantity] for row in rows],
          [row["order:" + quantity] for row in rows])
    check(rows[0]["order:" + quantity] == "", "the first has no predecessor")
    for coarse, fine in zip(rows, rows[1:]):
        rate = math.log2(float(coarse["error:" + quantity])
                         / float(fine["error:" + quantity]))
        check(abs(rate - float(fine["order:" + quantity])) < 1e-3,
              "the order is that of the errors")
        check(abs(rate - order) < 0.1, f"{quantity}: order {rate}")


VARY = ("--vary", STEPS + "=80,160,320")
REFERENCE = ("--reference", STEPS + "=2560")


def test_order_against_reference():
    """Every step of the coarse runs is one of the fine run."""
    rows, output = sweep("order", *VARY, *REFERENCE)
    print(output)
    for quantity in ("stress", "probe_top/u", "probe_top/s"):
        check_order(rows, quantity, 2)
        for row in rows:
            check(row["instants:" + quantity] == str(int(row[STEPS]) + 1),
                  "instants in common")
    for row in rows:
        check(row["linear_solves"] == str(2 * int(row[STEPS]) + 1),
              "linear solves as in summary.json")
    check("contact/force" not in "".join(rows[0]), "there is no contact")
    markdown = pathlib.Path("results/order/sweep.md").read_text()
    check(len(re.findall(r"\| +(?:1\.9\d|2\.0\d) \|", markdown)) == 6,
          "sweep.md has the orders\n" + markdown)
    folder = pathlib.Path("results/order/steps_per_period_80")
    for name in ("used.prm", "summary.json", "probe_top.csv", "log.txt"):
        check((folder / name).exists(), f"{name} is missing")


@full
def test_order_against_closed_form():
    """The creeping bar: no reference run is needed. E u / F = sin wt +
    (1 - cos wt) / (w tau)."""
    formula = ("(sin(2*pi*t/600) + (1 - cos(2*pi*t/600))/(2*pi*60/600))"
               "*10/13000")
    rows, output = sweep("exact", *VARY, "--exact", "probe_top/u_2=" + formula,
                         "--set", "Material/Plane state=plane stress",
                         "--set", "Time integration/Heun weight=0.5",
                         "--set", "Material/Viscosity=relaxation time")
    print(output)
    check_order(rows, "probe_top/u_2", 2)
    check(not pathlib.Path("results/exact/reference").exists(),
          "the reference is not needed")


def test_zipped():
    rows, _ = sweep("zipped", "--vary", "Time integration/Scheme=euler,heun & "
                    + STEPS + "=160,80", "--vary", "Loads/Traction=0; t | 0; 2*t",
                    "--reference", STEPS + "=320", "--error", "probe_top/u")
    values = [(row["Time integration/Scheme"], row[STEPS],
               row["Loads/Traction"]) for row in rows]
    check(len(values) == 4 and {value[:2] for value in values}
          == {("euler", "160"), ("heun", "80")}, f"zipped: {values}")


def test_columns_and_repeats():
    """Tables for a paper have the columns that were named; times are the least ones,
    and results stay."""
    columns = f"{STEPS},error:probe_top/u,processor_seconds,nonsense"
    rows, output = sweep("repeated", *VARY, *REFERENCE, "--repeat", "2",
                         "--columns", columns)
    once, _ = sweep("order", *VARY, *REFERENCE, fresh=False)
    check(without_seconds(rows) == without_seconds(once), "other results")
    check("no run has nonsense" in output, output)
    latex = pathlib.Path("results/repeated/sweep.tex").read_text().splitlines()
    print(*latex, sep="\n")
    check(latex[2] == r"Steps per period & error of probe\_top/u & CPU (s) \\"
          and len(latex) == len(rows) + 6, "sweep.tex")
    check(float(rows[0]["peak_memory_bytes"]) > 1e7, "memory")
    status, _, error = execute("sweep", SCENE, *VARY, "--repeat", "2", "--jobs", "2")
    check(status == 2 and "one at a time" in error, error)


@full
def test_bars():
    """Error bars of each point are in all tables, and hold against a finer run; a sweep
    without them is computed again."""
    words = "--vary", "Geometry/Crack length=0.4,0.5", "--set", "Output/Fields=none"
    sweep("barred", *words, scene=CRACK)
    rows, output = sweep("barred", *words, "--bars", scene=CRACK)
    check("already there" not in output, "computed again")
    asked, output = sweep("asked", *words, "--set", "Output/Error bars=true", scene=CRACK)
    check([row["bar:opening"] for row in asked] == [row["bar:opening"] for row in rows],
          "[Output] Error bars is --bars")
    fine, _ = sweep("unbarred", *words, "--set", "Geometry/Subdivisions=40, 20",
                    "--set", STEPS + "=640", scene=CRACK)
    for row, best in zip(rows, fine):
        bar, error = float(row["bar:opening"]), abs(
            float(row["opening"]) / float(best["opening"]) - 1) * float(best["opening"])
        print(f"opening {row['opening']}, bar {bar:.2g}, error {error:.2g}")
        check(error / 5 < bar < 20 * error, "bar of the opening")
    check("bar of opening" in pathlib.Path("results/barred/sweep.md").read_text(), "sweep.md")


def test_warnings():
    """Each once, whatever its numbers, with its points, also when all is there; from a
    shell that has closed the standard streams. Brackets keep a formula together."""
    directory = pathlib.Path("results/warned")
    shutil.rmtree(directory, ignore_errors=True)
    words = ["sweep", SCENE, "--output", directory, *SETTINGS,
             "--set", "Loads/Traction=0; sin(2*pi*t/60)",
             "--set", "Output/Field times=150", "--set", "Geometry/Crack length=0.1",
             "--vary", STEPS + "=20,23,60",
             "--vary", "Material/Young modulus=max(1, 2),3",
             "--exact", "probe_top/u_1=t"]
    closed = subprocess.run(["sh", "-c", 'exec "$@" <&- >&-', "sh", PROGRAM,
                             *map(str, words)], capture_output=True, text=True,
                            timeout=1200)
    check(closed.returncode == 0 and not closed.stderr, f"closed: {closed.stderr}")
    status, output, error = execute(*words)
    check(status == 0 and output.count("already there") == 6, output + error)
    found = re.findall(r"^  warning: (.*)$", output, re.MULTILINE)
    print(*found, sep="\n")
    check(found == json.loads((directory / "sweep.json").read_text())["warnings"]
          and all(f"- {text}\n" in (directory / "sweep.md").read_text()
                  for text in found), "sweep.md and sweep.json have them")
    check(found[0] == "[Geometry] Crack length = 0.1 is not used: Shape = rectangle",
          "of all points")
    check(found[-2].startswith("[Time integration]: within a step")
          and found[-2].endswith(" (4 of 6 points, numbers of the first)"), "of steps")
    check("Field times" not in output, "what the sweep itself sets")


def test_changed_file():
    """Another file with the same name makes other results, not those already there."""
    words = ("--vary", STEPS + "=20,40", "--set", "Tables/Files=history.csv",
             "--set", "Loads/Traction=0; pull(t)")
    found = []
    for k, pull in enumerate((1, 2, 2)):
        pathlib.Path("history.csv").write_text(f"t,pull\n0,0\n300,{pull}\n600,0\n")
        rows, output = sweep("changed", *words, fresh=k == 0)
        check(output.count("already there") == (2 if k == 2 else 0), output)
        found.append(float(rows[0]["largest_stress"]))
    check_below(abs(found[1] / found[0] - 2), 1e-9, "the stress of twice the load")
    check(found[2] == found[1], "the same file")


@full
def test_resumption():
    """Killed in the middle: what is finished stays, the table is the same."""
    arguments = ("--vary", STEPS + "=20,40,80,6400,38400", "--reference",
                 STEPS + "=160", "--error", "probe_top/u,stress")
    whole, _ = sweep("whole", *arguments)
    directory = pathlib.Path("results/killed")
    shutil.rmtree(directory, ignore_errors=True)
    process = subprocess.Popen(
        [PROGRAM, "sweep", SCENE, "--output", directory, *SETTINGS, *arguments],
        stdout=subprocess.DEVNULL)
    wait_until(lambda: len(finished_at(directory)) >= 4, process)
    process.send_signal(signal.SIGKILL)
    check(process.wait() == -signal.SIGKILL, "was not killed in time")
    before = finished_at(directory)
    check(4 <= len(before) < 6, f"finished: {sorted(before)}")
    check(len(rows_of_sweep(directory)) >= 2, "the table of what was finished")

    rows, output = sweep("killed", *arguments, fresh=False)
    print(output)
    check(output.count("already there") == len(before), "points are resumed")
    after = finished_at(directory)
    check(len(after) == 6 and all(after[name] == before[name]
                                  for name in before), "computed again")
    check(without_seconds(rows) == without_seconds(whole), "another table")
    check(all(row["seconds"] for row in rows), "costs are kept")

    # Another reference: other errors of the same runs.
    other = arguments[:3] + (STEPS + "=320",) + arguments[4:]
    renewed, output = sweep("killed", *other, fresh=False)
    again = finished_at(directory)
    check(all(again[name] == after[name] for name in after
              if name != "reference"), "errors alone are renewed")
    check(all(float(a["error:stress"]) != float(b["error:stress"])
              for a, b in zip(rows, renewed)), "the old errors")

    # Damaged: computed again.
    victim = directory / "steps_per_period_40" / "probe_top.csv"
    victim.write_bytes(victim.read_bytes()[:-100])
    mended, _ = sweep("killed", *other, fresh=False)
    check(without_seconds(mended) == without_seconds(renewed), "not mended")
    # The stress is only missed when it is to be compared again.
    (directory / "steps_per_period_20" / "stress_samples.bin").write_bytes(b"x")
    rows, output = sweep("killed", *arguments, fresh=False)
    check(output.count("computed again") == 1, "tells that it computes\n"
          + output)
    check(without_seconds(rows) == without_seconds(whole), "not recomputed")


@full
def test_points_without_results():
    """5 steps of 120 are 2 tau; a probe may lie outside; a stress may not be
    periodic yet."""
    rows, output = sweep("refused", "--vary", STEPS + "=5,40",
                         *REFERENCE, "--error", "probe_top/s")
    print(output)
    check([row["status"] for row in rows] == ["refused", "done"], "status")
    check(STEPS.split("/")[1] in rows[0]["message"]
          and rows[0]["error:probe_top/s"] == "", "message")
    markdown = pathlib.Path("results/refused/sweep.md").read_text()
    check(rows[0]["message"] in markdown, "sweep.md lacks the message")
    check("(already there)" in sweep("refused", "--vary", STEPS + "=5,40",
          *REFERENCE, "--error", "probe_top/s", fresh=False)[1].splitlines()[3],
          "refused again")

    rows, _ = sweep("unconverged", "--vary", "Periodic state/Tolerance=0,1e-12",
                    *REFERENCE, "--set", STEPS + "=40", "--error", "probe_top/s")
    check([row["status"] for row in rows] == ["done", "not converged"],
          "status")
    check(rows[0]["error:probe_top/s"] == rows[1]["error:probe_top/s"] != "",
          "it has its error all the same")
    sweep("none", "--vary", STEPS + "=4,5", *REFERENCE, status=3)
    _, error = sweep("bad_reference", *VARY, "--reference", STEPS + "=5",
                     status=3)
    check("reference" in error, error)


def test_failing_point():
    """One sweep of SOR is not enough; the point after it is computed."""
    rows, _ = sweep("failed", "--vary", "Contact/Maximum iterations=1,10000",
                    "--set", STEPS + "=20", "--set", "Contact/Solver=projected "
                    "sor", "--reference", STEPS + "=40", scene=CRACK)
    print(rows[0]["message"])
    check([row["status"] for row in rows] == ["failed", "done"],
          f"status of a point that fails: {[row['status'] for row in rows]}")
    check(float(rows[1]["error:contact/force"]) > 0, "the one after it")


def test_no_error():
    """Nothing in common, or another mesh: an empty cell, and why."""
    rows, _ = sweep("nothing", "--vary", "Geometry/Subdivisions=2,2; 3,3",
                    "--vary", "Loads/Period=601", "--reference", STEPS + "=40")
    markdown = pathlib.Path("results/nothing/sweep.md").read_text()
    check([row["instants:probe_top/u"] for row in rows] == ["1", "1"]
          and [row["error:probe_top/u"] for row in rows] == ["", ""]
          and rows[1]["error:stress"] == "", "t = 0 alone, and another mesh")
    check("only the instant t = 0 is common with the reference" in markdown and
          "different quadrature points" in markdown, markdown)


def test_numbers_are_no_texts():
    """A reference whose numbers are written otherwise is there already."""
    words = ("--vary", STEPS + "=20", "--set", "Material/Poisson ratio=0.3",
             "--reference", "Loads/Traction=0; 10*sin(2*pi*t/600)", "--error", "stress")
    sweep("numbers", *words)
    others = [word.replace("=0.3", "=0.30").replace("; 10*", ";10.0*") for word in words]
    _, output = sweep("numbers", *others, fresh=False)
    check(output.count("already there") == 2 and "anew" not in output, output)


def test_periodic_methods():
    """March and harmonic balance have the same periodic state, after other numbers of
    periods: what they may differ in, a constant of the displacement and what a secular
    flow has gained, is no error. That of the work of the loads cannot be told."""
    for mean in tier((2,), (2, 11)):  # the lip closes in each period; it opens ever further
        rows, output = sweep(
            f"periodic_{mean}", "--vary", "Periodic state/Method=march,fourier",
            "--reference", "Periodic state/Method=march", "--error",
            "stress,probe_mouth/u,probe_mouth/opening,load_work/load_work",
            *overrides(["Material/Plane state=plane stress",
                        "Material/Viscosity=relaxation time",
                        "Material/Relaxation time=600",
                        f"Loads/Traction=0; 10*sin(2*pi*t/600)+{mean}",
                        "Time integration/Scheme=trapezoid",
                        "Periodic state/Maximum periods=100",
                        "Periodic state/Tolerance=1e-6", "Output/Load work=true",
                        "Output/Probes=mouth: 1, 0"]), scene=CRACK)
        check([row["periods"] for row in rows] != ["1", "1"]
              and [row["instants:probe_mouth/u"] for row in rows] == ["41", "41"]
              and "without their mean values" in output, output)
        for quantity in ("stress", "probe_mouth/u", "probe_mouth/opening"):
            check_below(float(rows[1]["error:" + quantity]), 1e-9,
                        f"{quantity} of fourier under a mean load of {mean}")
        check(rows[1]["error:load_work/load_work"] == "", "error of the work")


@full
def test_too_few_instants():
    """Adaptive steps that divide 37 equal ones meet those of a reference at 0 and T
    alone, where the load is zero: that tells nothing, unless they end at instants
    given."""
    axes = ("--set", "Time integration/Step control=adaptive", "--set", STEPS + "=37",
            "--vary", "Time integration/Relative tolerance=1e-3,1e-4",
            "--reference", "Time integration/Step control=uniform", *REFERENCE)
    rows, _ = sweep("few", *axes)
    check(all(row["error:probe_top/s"] == row["error:stress"] == ""
              for row in rows), "no error at two instants")
    check("name instants" in pathlib.Path("results/few/sweep.md").read_text(),
          "what to do is reported")
    steps = ",".join(str(15 * k) for k in range(1, 40))
    rows, _ = sweep("named", *axes, "--set", f"Time integration/Steps={steps}")
    for row, tolerance in zip(rows, (1e-3, 1e-4)):
        print(row["error:probe_top/s"], row["instants:probe_top/s"])
        check(0 < float(row["error:probe_top/s"]) < tolerance
              and int(row["instants:probe_top/s"]) >= 41, "named instants")


def check_mistakes(arguments, *messages):
    _, error = sweep("mistakes", *arguments, status=2)
    print(error)
    for message in messages:
        check(message in error, f"{arguments}: {message}?\n{error}")


def test_mistakes():
    """All are found before anything is computed, and told at once."""
    check_mistakes(
        ("--vary", "Time integration/Stps=1,2", "--vary", STEPS + "=80,many",
         "--reference", "Material/Youngs=3"),
        "4 problems", 'did you mean "Steps"', '--vary "', "many",
        '--reference "Material/Youngs')
    check_mistakes((*VARY, *VARY, "--vary", "Title=1,2 & Dimension=1,2,3",
                    "--vary", STEPS, "--vary", "Title="),
                   "varied twice", "has 2 values", "has 3",
                   "must have the form", "lacks a value")
    check_mistakes(("--vary", STEPS + "=80,80", *REFERENCE), "listed once")
    check_mistakes(("--vary", "Material/Poisson ratio=0.3,0.30"), "listed once")
    check_mistakes((*VARY, "--error", "probe_top/u"), "compare probe_top/u",
                   "--reference", "--exact")
    check_mistakes(REFERENCE, "--vary")
    check_mistakes((*VARY, *REFERENCE, "--error", "probe_tip/u,probe_top/v",
                    "--exact", "probe_top/u=t", "--exact", "probe_top/u_1=q*t",
                    "--exact", "probe_top/u_1=x"),
                   "probe_top", "no column", "s_22", "one column", "q*t",
                   "x, y, z")
    check(not pathlib.Path("results/mistakes").exists(), "computed something")
    for arguments in (("sweep",), (SCENE, "sweep", SCENE, *VARY)):
        check(execute(*arguments)[0] == 2, f"{arguments}: status")
    check(execute("sweep", "none.prm", *VARY, *REFERENCE)[0] == 4, "no scene")
    status, output, _ = execute("sweep", "--help")
    check(status == 0 and "--vary" in output and "probe_NAME" in output, output)


@full
def test_ranks():
    """A crack with contact, on one and on two ranks, which also read what the
    other has left."""
    rows = []
    for ranks in (1, 2):
        shutil.rmtree(f"results/ranks_{ranks}", ignore_errors=True)
        words = ["sweep", CRACK, "--output", f"results/ranks_{ranks}",
                 "--vary", STEPS + "=20,40", "--reference", STEPS + "=80"]
        code, output, error = execute_on(ranks, *words)
        check(code == 0, output + error)
        rows.append(rows_of_sweep(f"results/ranks_{ranks}"))
    quantities = [name for name in rows[0][0] if name.startswith("error:")]
    check("error:contact/force" in quantities and "error:stress" in quantities,
          f"quantities: {quantities}")
    worst = max(abs(float(a[name]) - float(b[name]))
                for a, b in zip(*rows) for name in quantities)
    check_below(worst, 1e-8, "errors on two ranks")
    # Two ranks go on with what one has left, and compare with it.
    code, output, error = execute_on(
        2, *words[:3], "results/ranks_1", "--vary", STEPS + "=20,40,60",
        "--reference", STEPS + "=80")
    check(code == 0 and output.count("already there") == 3, output + error)
    crossed = rows_of_sweep("results/ranks_1")
    code, output, error = execute(
        *words[:3], "results/ranks_2", "--vary", STEPS + "=20,40,60",
        "--reference", STEPS + "=80")
    check(code == 0 and output.count("already there") == 3, output + error)
    worst = max(abs(float(a[name]) - float(b[name]))
                for a, b in zip(crossed, rows_of_sweep("results/ranks_2"))
                for name in quantities)
    check_below(worst, 1e-8, "errors against a reference of other ranks")


for test in (test_order_against_reference, test_order_against_closed_form,
             test_columns_and_repeats, test_bars, test_zipped, test_warnings, test_changed_file,
             test_resumption, test_points_without_results,
             test_failing_point, test_no_error, test_numbers_are_no_texts,
             test_periodic_methods,
             test_too_few_instants, test_mistakes, test_ranks):
    start = time.time()
    test()
    print(f"{test.__name__}: {time.time() - start:.1f} s")
json.loads(pathlib.Path("results/order/sweep.json").read_text())
