"""Reports of runs and sweeps (crevasse report): what they say, what they say
of runs that are not whole, and how a browser shows them."""

import base64
import contextlib
import fcntl
import html
import io
import json
import os
import pathlib
import re
import shutil
import socket
import subprocess
import sys
import time
import types

import numpy

from browser import WIDTHS, in_browser
import crevasse_run
from crevasse_run import PROGRAM, SOURCE, Results, check, check_close, execute, full, run

sys.path.insert(0, str(SOURCE / "source" / "python"))
from crevasse import figures as make_figures, report as make_report  # noqa: E402
from crevasse import findings, histories, run_reader, sweep_figures, wording  # noqa: E402

PAPER = SOURCE / "prm" / "raous1980.prm"


def report(directory, status=0):
    """Its text, and what is said on stderr. Made in this process: each start of
    Python with matplotlib takes longer than most reports."""
    begin = time.monotonic()
    with (contextlib.redirect_stdout(io.StringIO()),
          contextlib.redirect_stderr(io.StringIO()) as stderr):
        found = make_report.main([str(directory)])
    said = stderr.getvalue()
    print(f"report of {directory}: {time.monotonic() - begin:.1f} s\n{said}",
          end="")
    check(found == status,
          f"{directory}: status {found} instead of {status}: {said}")
    check(len(said.splitlines()) <= 2,
          f"{directory}: no message of one or two lines:\n{said}")
    path = pathlib.Path(directory) / "report.html"
    return (path.read_text() if path.exists() else ""), said


@full
def command_line():
    """As a user calls it."""
    output = pathlib.Path("results") / "elsewhere.html"
    for directory, file, status in (("results/bare", output, 0),
                                    ("results/nowhere", output, 2),
                                    ("results/bare", "results/no/report.html", 4)):
        process = subprocess.run([PROGRAM, "report", directory, "--output", file],
                                 text=True, capture_output=True, timeout=1200)
        check(process.returncode == status and "Traceback" not in process.stderr,
              f"status {process.returncode}: {process.stderr}")
    check(output.read_text() == report("results/bare")[0], "another page")
    for words in (["report", "results/bare", "--output", output], ["report", "--help"]):
        with open("/dev/full", "w") as full:
            process = subprocess.run([PROGRAM, *words], text=True, stdout=full,
                                     stderr=subprocess.PIPE, timeout=1200)
        check(process.returncode == 4 and process.stderr.splitlines() == [
            "crevasse report: cannot write to the standard output (No space left on "
            "device)."], f"{words}: {process.returncode} {process.stderr}")


def figures(directory, count, status=0):
    """How many are drawn."""
    with (contextlib.redirect_stdout(io.StringIO()) as said,
          contextlib.redirect_stderr(io.StringIO()) as errors):
        found = make_figures.main([str(directory), "--format", "png"])
    files = [line for line in said.getvalue().splitlines() if line.endswith(".png")]
    check(found == status and len(files) == count,
          f"figures of {directory}: {found} {files} {errors.getvalue()}")
    for file in files:
        check(pathlib.Path(file).read_bytes().startswith(b"\x89PNG"), file)
    return errors.getvalue()


def words_of(page):
    """What a reader sees, without library and data."""
    page = re.sub(r"<(script|style)\b.*?</\1>", " ", page, flags=re.S)
    return re.sub(r"\s+", " ", html.unescape(re.sub(r"<[^>]+>", " ", page)))


def data_of(page):
    text = re.search(r'<script type="application/json" id="data">(.*?)</script>',
                     page, re.S)[1]
    return json.loads(text)


def titles(page):
    return [chart["title"] for chart in data_of(page)["charts"]]


def check_says(page, *texts):
    words = words_of(page)
    for text in texts:
        check(text in words, f"the report does not say: {text}")


def check_self_contained(page):
    for match in re.findall(r'(?:src|href)="([^"]*)"', re.sub(
            r"<script>.*?</script>", "", page, flags=re.S)):
        check(match.startswith(("#", "data:")), f"not in the page: {match[:80]}")


def check_pictures(page, count):
    pictures = re.findall(r'src="data:image/png;base64,([^"]+)"', page)
    check(len(pictures) == count, f"{len(pictures)} pictures instead of {count}")
    for picture in pictures:
        check(base64.b64decode(picture).startswith(b"\x89PNG"), "no picture")


def whole_run():
    """Everything on: mean load, crack tip, growth, fields, probes."""
    results = run(PAPER, "whole", [
        "Contact/Solver=automatic", "Geometry/Subdivisions=16, 8",
        "Title=A <b>plate</b> & more", "Output/Load work=true",
        "Loads/Traction=0; 10*(sin(2*pi*t/600) - 0.1)",
        "Material/Viscosity=isotropic", "Material/Viscous Poisson ratio=0.4",
        "Material/Viscous modulus=780000*if(x<0.3,0.2,1)",
        "Crack tip/Stress intensity=true", "Crack tip/Crack growth law=paris",
        "Crack tip/Paris factor=1e-7"])
    page, said = report(results.directory)
    check(said == "", f"a converged run: {said}")
    check_self_contained(page)
    check_pictures(page, 7)
    check(titles(page)[0] == "Stress intensity over the last period"
          and min(data_of(page)["charts"][0]["views"]["whole"]["t"]) == 1200,
          f"the first chart is {titles(page)[0]}")
    summary = results.summary
    check_says(page, "A <b>plate</b> & more", "the stress is periodic after 3 periods",
               "Edge crack of length 0.5", "viscous modulus 780000*if(x<0.3,0.2,1)",
               "Relaxation time = 60 is not used", "Scheme heun",
               f"{summary['cells']} cells", "da/dN", "ΔK I , largest",
               summary["effects"]["contact"]["why"], "condensed active set",
               "complementarity")
    check("Probe C (1, 0)" in words_of(page), "no probe C")
    for title in ("C: displacement", "C: stress", "C: opening",
                  "C: contact pressure", "Contact force on the lip",
                  "Stress intensity", "Way to the periodic state"):
        check(title in titles(page), f"no chart {title}: {titles(page)}")
    check_states(results, data_of(page))
    check_values(results, data_of(page))
    figures(results.directory, 6)
    return results


def first_numbers():
    """K of the leading tip with its errors before all else, and pictures of the instant
    at which it is largest: half a period after T/4, when the cracks are closed."""
    results = run(SOURCE / "prm" / "two_cracks.prm", "tips", [
        "Refinement/Cycles=1", "Loads/Traction=0; -100*sin(2*pi*t/10)",
        "Output/Field times=automatic", "Discretisation/Degree=1"])
    with contextlib.redirect_stdout(io.StringIO()) as said:
        make_report.main([str(results.directory)])
    page = (results.directory / "report.html").read_text()
    first = words_of(page).split("Scene Results")[0]
    tips = results.summary["crack_tips"]
    k = max(range(4), key=lambda k: tips[k]["equivalent_intensity"]["largest"])
    check(f"Tip {k + 1} of 4" in first, f"another tip: {first}")
    numbers = [(tips[k]["K_I"]["largest"], 4), (tips[k]["K_I"]["smallest"], 4),
               (tips[k]["K_I_error"], 2), (tips[k]["K_opening"], 4),
               (tips[k]["K_II_error"], 2), (tips[k]["Delta_K"], 4),
               (results.summary["extremes"]["opening"], 4)]
    for value, digits in numbers:
        text = wording.significant(value, digits)
        check(text in first and text in said.getvalue(), f"{text} is not in {first}")
    found = findings.read(results.directory)
    for number, tip in enumerate(tips, 1):
        check_says(page, f"± {wording.significant(tip['K_II_error'], 2)}")
        for name in ("K_opening", "Delta_K_eff"):
            check(found[f"{name}_{number}"] == tip[name], f"{name} of tip {number}")
    check_says(page, "K II of largest magnitude")
    with_reasons = shutil.copytree(results.directory, pathlib.Path("results/reasons"),
                                   dirs_exist_ok=True)
    for tip, why in zip(tips, ("one", "one", "other", "other"), strict=True):
        tip.update(K_opening=None, no_K_opening=f"{why} reason")
    (with_reasons / "summary.json").write_text(
        json.dumps({**results.summary, "crack_tips": tips}))
    check_says(report(with_reasons)[0], "No opening intensity K op at (−0.5, −0.1), "
               "(0.1, −0.1): one reason.", "(0.5, 0.1): other reason.")
    chart = data_of(page)["charts"][0]
    table = results.table(f"crack_tip_{k + 1}.csv")
    K, t = max((K, t) for K, t in zip(table["equivalent_intensity"], table["t"])
               if t >= table["t"][-1] - 10)
    check_close(max(chart["views"]["whole"]["values"][k]), K, 1e-5 * K, "first chart: K")
    check(t % 10 == 7.5, f"K is largest at t = {t}")
    check_says(page, f"Stress at t = {t:g}", f"Principal stresses at t = {t:g}")


def check_states(results, data):
    """At each row of contact.csv with pressure the lip is shaded."""
    table, nodes = results.table("contact.csv"), results.summary["contact_nodes"]
    noise = 1e-6 * results.summary["extremes"]["stress"]
    count = [0, 0, 0]
    for t, closed, pressure in zip(table["t"], table["closed_nodes"],
                                   table["largest_pressure"]):
        expected = 0 if pressure <= noise else 2 if closed == nodes else 1
        found = [state for begin, end, state in data["shades"] if begin <= t <= end]
        check(found == ([expected] if expected else []),
              f"t = {t}: state {found} instead of {expected}")
        count[expected] += 1
    print("rows open, partly closed, closed:", *count)
    check(min(count) > 0, "the run does not have all states")


def check_values(results, data):
    """The charts have the numbers of the tables."""
    chart, = (chart for chart in data["charts"] if chart["title"] == "C: opening")
    table = results.table("probe_C.csv")
    for name, first in (("whole", 0.), ("last", 1200.)):
        view = chart["views"][name]
        check(view["t"] == [t for t in table["t"] if t >= first], f"{name}: instants")
        expected = [u for t, u in zip(table["t"], table["opening"]) if t >= first]
        check(max(abs(a - b) for a, b in zip(view["values"][0], expected, strict=True))
              <= 1e-5 * max(expected), f"{name}: openings")


def long_run():
    """Of which a view of the whole is thinned, with its extremes."""
    results = run(PAPER, "long", [
        "Contact/Solver=automatic", "Geometry/Subdivisions=4, 2",
        "Output/Fields=none", "Periodic state/Tolerance=0", "Periodic state/Maximum periods=60"])
    page, said = report(results.directory)
    check("60 periods computed" in said, f"nothing demanded: {said}")
    chart, = (chart for chart in data_of(page)["charts"]
              if chart["title"] == "C: stress")
    whole = chart["views"]["whole"]
    check(len(whole["t"]) < 2300 < len(results.table("probe_C.csv")["t"]),
          "not thinned")
    check_close(max(whole["values"][1]), max(results.table("probe_C.csv")["s_22"]),
                1e-4, "largest s_22 of the thinned history")


def other_runs():
    box = run(SOURCE / "prm" / "cracked_box.prm", "box",
              ["Geometry/Subdivisions=4, 2, 2", "Periodic state/Maximum periods=2",
               "Title="], status=3)
    page, said = report(box.directory)
    check("Not converged" in said, f"box: {said}")
    check_pictures(page, 2)
    check("three-dimensional" in figures(box.directory, 0, 2), "box: figures")
    check_says(page, "Not converged: the stress is not periodic after 2 periods",
               "thickness 0.5", "for plane bodies", "Probe front (1, 0, 0)")
    bare = run(PAPER, "bare", ["Contact/Solver=automatic", "Output/Probes=",
                               "Output/Fields=none", "Geometry/Subdivisions=4, 2"])
    page, _ = report(bare.directory)
    check_pictures(page, 0)
    check_says(page, "[Output] Probes = automatic",
               "[Output] Fields = vtu gives", "No probes")
    check(titles(page)[0] == "Contact force on the lip", f"bare: {titles(page)}")
    table = run(SOURCE / "prm" / "raous1980_table1.prm", "table",
                ["Contact/Relaxation table=1.8, 1.9"])
    page, _ = report(table.directory)
    check_says(page, "no period was requested", "There is no computed period")
    check(len(data_of(page)["charts"][0]["series"][0]["points"]) == 3, "Table 1")
    # The square of its stress is too large for the files of fields.
    huge = run(PAPER, "huge", ["Boundary/Contact=none", "Boundary/Open crack=none",
                               "Crack tip/Stress intensity=automatic",
                               "Loads/Traction=0; 1e30*sin(2*pi*t/600)"])
    page, said = report(huge.directory, 4)
    check("second_deviator_invariant is beyond" in said, f"huge: {said}")
    check_says(page, "No stress intensity: automatic: no boundary has the role Contact")
    status, _, error = execute(PAPER, "--output", "results/refused", "--set",
                               "Contact/Maximum iterations=2", "--set",
                               "Contact/Relaxation factor=1")
    check(status == 3, f"a contact problem that is not solved: {error}")
    page, said = report("results/refused")
    check("Failed" in said, f"refused: {said}")
    check_says(page, "Failed: the run ended with an error", "was not solved to the", "There is no checkpoint",
               "No period was completed")


def sweep():
    rows, _ = crevasse_run.sweep(
        "sweep", PAPER, "--set", "Contact/Solver=automatic", "--vary",
        "Time integration/Scheme=heun,sdirk2", "--vary",
        "Time integration/Steps per period=4,20,40,80", "--reference",
        "Time integration/Steps per period=320")
    page, said = report("results/sweep")
    check(said == "", f"sweep: {said}")
    check_self_contained(page)
    check_says(page, "8 points: 1 refused, 7 done", "The time step 150 is too large",
               "heun , sdirk2")
    rows = [row for row in rows if row["error:stress"]]
    for title, cost in (("Error of stress against wall time (s)", "seconds"),
                        ("Error of stress against contact problems", "vi_solves")):
        chart, = (chart for chart in data_of(page)["charts"]
                  if chart["title"] == title)
        *lines, front = chart["series"]
        check([line["label"] for line in lines] == ["heun", "sdirk2"], "lines")
        points = [(float(row[cost]), float(row["error:stress"])) for row in rows]
        best = {(x, y) for x, y in points
                if not any(a <= x and b <= y and (a, b) != (x, y)
                           for a, b in points)}
        check({tuple(point) for point in front["points"]} == best,
              f"{title}: Pareto front {front['points']} instead of {best}")
        x, y, words = lines[0]["points"][0]
        check(words == ["Scheme = heun", "Steps per period = 20"]
              and (x, y) in points, f"{title}: {x}, {y}, {words}")
    figures("results/sweep", 1 + sum("what" in chart for chart in data_of(page)["charts"]))
    cut = copy("sweep", "sweep_cut")
    path = cut / "sweep.csv"
    path.write_text("".join(path.read_text().splitlines(True)[:4]))
    _, said = report(cut)
    check("3 of 8 points are done" in said, f"sweep that was stopped: {said}")
    path.write_text(path.read_text()[:-40])
    _, said = report(cut, 2)
    check("number of columns" in said, f"broken table: {said}")


def study():
    """A parameter study, of which two points are not converged and one is refused."""
    rows, _ = crevasse_run.sweep(
        "study", PAPER, "--set", "Contact/Solver=automatic", "--vary",
        "Time integration/Scheme=heun,sdirk2", "--vary",
        "Material/Relaxation time=1,60,120,300")
    page, said = report("results/study")
    check(said == "", f"study: {said}")
    check_self_contained(page)
    check_says(page, "Relaxation time is the horizontal axis; each combination",
               "Hollow points are not converged", "The same at all points")
    check("accura" not in words_of(page) and "error" not in "".join(titles(page)),
          "nothing about errors")
    chart, = (chart for chart in data_of(page)["charts"]
              if chart["title"] == "wall time")
    check([y for line in chart["series"] for _, y, *_ in line["points"]]
          == [float(row["seconds"]) for row in rows if row["seconds"]], f"{chart}")
    chart, = (chart for chart in data_of(page)["charts"]
              if chart["title"] == "largest opening")
    check([line["label"] for line in chart["series"]] == ["heun", "sdirk2"], chart)
    for line in chart["series"]:
        expected = [[float(row["Material/Relaxation time"]), float(row["opening"]),
                     row["status"] != "done"] for row in rows if row["opening"]
                    and row["Time integration/Scheme"] == line["label"]]
        check([[x, y, hollow] for x, y, _, hollow, _ in line["points"]] == expected
              and any(hollow for *_, hollow in expected), f"{line} {expected}")


def charts_of_many_lines():
    """Ten lines whose numbers span decades: a logarithmic axis, and a legend beside the
    axes."""
    rows = [{"point": f"{i}_{k}", "Geometry/Width": str(i), "Title": f"form {k}",
             "status": "done"} for i in (1, 2) for k in range(10)]
    numbers = {row["point"]: 10. ** (k % 10) for k, row in enumerate(rows)}
    axes, = sweep_figures.draw_results(rows, "opening", numbers, "Geometry/Width").axes
    check(axes.get_yscale() == "log", f"the axis is {axes.get_yscale()}")
    axes.figure.canvas.draw()
    legend = axes.get_legend().get_window_extent()
    check(len(axes.get_legend().get_texts()) == 10
          and legend.x0 >= axes.get_window_extent().x1, "the legend hides lines")
    for K, constant in (([3, 3 + 1e-9], True), ([3, 4], False)):
        chart = histories.chart(types.SimpleNamespace(period=1, in_units=str), {
            "t": numpy.array([0, 1]), "K_I": numpy.array(K)}, ["K_I"], "K", "K")
        check(chart["from_zero"] == constant, f"axis of {K} with equal ticks")


def copy(source, name):
    directory = pathlib.Path("results") / name
    shutil.rmtree(directory, ignore_errors=True)
    shutil.copytree(pathlib.Path("results") / source, directory)
    (directory / "report.html").unlink(missing_ok=True)
    return directory


def edit(path, pattern, replacement):
    text, count = re.subn(pattern, replacement, path.read_text(), count=1, flags=re.M)
    check(count == 1, f"{path}: there is nothing like {pattern}")
    path.write_text(text)


def unfinished_runs():
    """As a kill leaves them: half a row at the end, no summary, no message."""
    directory = copy("bare", "killed")
    (directory / "summary.json").unlink()
    log = directory / "log.txt"
    log.write_text(log.read_text().split("\n       3 ")[0] + "\n")
    path = directory / "contact.csv"
    path.write_text("\n".join(path.read_text().splitlines()[:100]) + "\n1485,3")
    page, said = report(directory)
    check("Interrupted" in said, f"killed: {said}")
    check_says(page, "The tables end at t =", "There is no checkpoint",
               "a boundary has the role Contact", "There is no summary yet")
    views = data_of(page)["charts"][0]["views"]
    check(len(views["whole"]["t"]) == 99, f"{len(views['whole']['t'])} whole rows")
    check(views["last"]["t"][0] == 1470 - 600, "a period, though within the third")
    running = directory / "running"
    running.write_text(f"process {os.getpid()} on {socket.gethostname()}\n")
    check_says(report(directory)[0], "Interrupted")  # the number is another's now
    with open(running) as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        check_says(report(directory)[0], "The run is still running")
    running.write_text(f"process {os.getpid()} on elsewhere\n")
    check_says(report(directory)[0], "The run may still be running")
    running.unlink()
    (directory / "checkpoint" / "3").mkdir(parents=True)
    (directory / "checkpoint" / "3" / "manifest.json").write_text(
        '123\n{"period": 2, "step": 7}')
    with open(log, "a") as file:
        file.write("crevasse: stopped on request (SIGTERM); --resume continues.\n")
    check_says(report(directory)[0], "Stopped before the end",
               "Checkpoint 3, before step 8 of period 2")


def moving_run():
    """One that is resumed and writes while it is read: files change just before they are
    opened. Nothing of it is damaged."""
    directory = copy("whole", "moving")
    table = directory / "probe_C.csv"
    shutil.copy(table, directory / "rows")
    (directory / "half a row").write_text(table.read_text()[:-30])
    next_of = {"summary.json": [None], "contact.csv": [None],
               table.name: ["half a row", "rows"]}

    def change(event, arguments):
        if event == "open" and isinstance(arguments[0], os.PathLike | str):
            path = pathlib.Path(arguments[0])
            if path.parent == directory and next_of.get(path.name):
                if name := next_of[path.name].pop(0):
                    os.replace(directory / name, path)
                else:
                    path.unlink()
    sys.addaudithook(change)
    moving = run_reader.Run(directory)
    check(not moving.damages and not moving.finished, f"{moving.damages}")
    check("contact.csv" not in moving.tables
          and len(moving.tables[table.name]["t"]) == 120, "whole rows")


def damaged_runs():
    """The report has what is whole, and names what is not."""
    for name, file, pattern, replacement, message in (
            ("cut", "probe_C.csv", r"(^600,[^,]*),.*\n(.*\n)*", r"\1\n",
             "probe_C.csv: line 42 has 2 of"),
            ("short", "contact.csv", r"^615,.*\n(.*\n)*", "",
             "contact.csv: ends after 41 rows, others have 121"),
            ("nan", "probe_C.csv", "^75,[^,]*", "75,nan",
             "probe_C.csv: line 7: u_1 is nan"),
            ("back", "crack_tip.csv", "^75,", "15,", "crack_tip.csv: line 7: t goes"),
            ("word", "contact.csv", "^75,[^,]*", "75,x", "contact.csv: could not"),
            ("json", "summary.json", r'"cells": \d+,', '"cells" 12', "summary.json:"),
            ("shape", "summary.json", r'"on": true', '"on": [1, 2]',
             "effects is not what a run writes"),
            ("column", "contact.csv", "^t,closed_nodes", "t,closed", "no column closed_"),
            ("field", "solution_0000.0.vtu", r"<Points>(.*\n)*", "",
             "solution_0000.0.vtu: is incomplete"),
            ("pvd", "solution.pvd", r"<Collection>(.*\n)*", "",
             "solution.pvd: cannot be read")):
        directory = copy("whole", "damaged_" + name)
        edit(directory / file, pattern, replacement)
        if not file.startswith("solution"):  # figures of fields take their time
            (directory / "solution.pvd").unlink()
        page, said = report(directory, 4)
        check("damaged" in said and message in said, f"{name}: {said}")
        check_says(page, "Damaged files", "Way to the periodic state")
    directory = copy("bare", "damaged_missing")
    (directory / "contact.csv").unlink()
    check("contact.csv: is missing" in report(directory, 4)[1], "no contact.csv")
    for lost, message in ((r"^ *set Period .*\n", "Loads/Period"),
                          (r"^subsection Loads\n", "end without a subsection")):
        directory = copy("bare", "damaged_used")
        edit(directory / "used.prm", lost, "")
        check(message in report(directory, 2)[1], f"no {lost} in used.prm")
    directory = copy("bare", "latin_1")
    path = directory / "used.prm"
    path.write_bytes(path.read_bytes().replace(b"three periods", b"drei Zyklen \xfcber"))
    check_says(report(directory)[0], "drei Zyklen")


def odd_names():
    """Of directories: neither HTML nor UTF-8."""
    for name in ("<b>&amp; é", os.fsdecode(b"latin \xe9")):
        directory = copy("bare", name)
        page, _ = report(directory)
        check("<b>" not in page.split("<script>")[0], f"{name}: markup")
        shutil.rmtree(directory)


def folders_without_results():
    empty = pathlib.Path("results/empty")
    empty.mkdir(exist_ok=True)
    other = pathlib.Path("results/other")
    other.mkdir(exist_ok=True)
    (other / "notes.txt").write_text("nothing\n")
    advice = pathlib.Path("results/advice")
    advice.mkdir(exist_ok=True)
    (advice / "advice.json").write_text("{}")
    for directory, message in (("results/nowhere", "no such directory"),
                               (advice, "read its advice.md"),
                               (empty, "is empty"),
                               (other, "not the output directory of a run")):
        said = report(directory, 2)[1]
        check(message in said, f"{directory}: {said}")


# What is seen when hovering over a point, and where the last period begins.
SHOWN = {"whole": (["t = 1215 (period 3: 15), lip open"], 1200),
         "long": (None, 35400),
         "sweep": (["heun", "Scheme = heun", "Steps per period = 40"], None),
         "study": (["heun", "Scheme = heun", "Relaxation time = 120"], None)}


def shown_well(pages):
    found, console = in_browser({name: Results(directory).directory / "report.html"
                                 for name, directory in pages.items()})
    check(len(found) == len(WIDTHS) * (len(pages) + 1), f"frames: {found}")
    for frame in found:
        print(frame)
        if frame["page"] == "broken":
            check(frame["overflow"] > 0 and frame["blank"] == 1,
                  "what is broken is not seen")
            continue
        path = Results(pages[frame["page"]]).directory / "report.html"
        charts = len(data_of(path.read_text())["charts"])
        check(frame["overflow"] <= 0, f"wider than the page: {frame}")
        check(frame["charts"] == frame["canvases"] == charts > 0
              and frame["blank"] == 0, f"charts: {frame}")
        check(frame["pictures"] == path.read_text().count("data:image/png"),
              f"pictures: {frame}")
        words, begin = SHOWN.get(frame["page"], (None, frame["begin"]))
        check(words is None or set(words) <= set(frame["words"]),
              f"hovering does not show {words}: {frame}")
        check(begin == frame["begin"], f"the last period begins at {begin}: {frame}")
    errors = [line for line in console if "broken.html" not in line]
    check(len(console) > len(errors), "errors are not seen")
    check(not errors, "the browser complains:\n" + "\n".join(errors))


whole_run()
first_numbers()
long_run()
other_runs()
sweep()
study()
charts_of_many_lines()
unfinished_runs()
moving_run()
damaged_runs()
odd_names()
folders_without_results()
command_line()
shown_well({name: f"results/{name}" for name in
            ("whole", "long", "box", "bare", "sweep", "study", "killed")})
