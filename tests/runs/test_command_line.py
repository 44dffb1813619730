"""What can be asked on the command line, and that every way to write a scene
gives the same run."""

import fcntl
import json
import os
import pathlib
import re
import shutil
import subprocess
import time

import jsonschema

from crevasse_run import (PATIENCE, PROGRAM, SOURCE, check, execute, plain, run, server,
                          start, tier)

from crevasse.results import parse_parameters

SCENE = """\
set Title = A = b, c
subsection Geometry
  set Subdivisions = 4, 2
end
subsection Material
  set Relaxation time = 60
end
subsection Loads
  set Period   = 600
  set Traction = 0; if(t < 300, 0.1, 1)*sin(2*pi*t/600)
end
subsection Time integration
  set Steps per period = 10
end
subsection Periodic state
  set Maximum periods = 2
  set Tolerance       = 0
end
subsection Output
  set Probes      = A: 1, 0; B: 0.3, 0.6
  set Field times = 150
end
"""

JSON_SCENE = {
    "Title": "A = b, c",
    "Geometry": {"Subdivisions": [4, 2]},
    "Material": {"Relaxation time": 60},
    "Loads": {"Period": 600,
              "Traction": "0; if(t < 300, 0.1, 1)*sin(2*pi*t/600)"},
    "Time integration": {"Steps per period": 10},
    "Periodic state": {"Maximum periods": 2, "Tolerance": 0},
    "Output": {"Probes": "A: 1, 0; B: 0.3, 0.6", "Field times": [150]},
}

PROBES = ("probe_A.csv", "probe_B.csv", "contact.csv")


def succeed(*arguments):
    """Runs the program, which must have nothing to complain about."""
    status, output, error = execute(*arguments)
    check(status == 0, f"{arguments}: exit status {status}\n{error}")
    check(error == "", f"{arguments}: standard error:\n{error}")
    return output


def write_scene(name, text=SCENE):
    path = pathlib.Path(name)
    path.write_text(plain(text) if path.suffix == ".prm" else text)
    return path


def remove(directory):
    shutil.rmtree(directory, ignore_errors=True)
    return pathlib.Path(directory)


def check_same_tables(results, others, what):
    for name in PROBES:
        check((results.directory / name).read_bytes()
              == (others.directory / name).read_bytes(),
              f"{what}: {name} differs")


def test_questions():
    output = succeed("--help")
    for text in ("scene", "--set", "--output", "--check", "--quiet", "--verbose",
                 "--print-parameters", "--version", "--set ASSIGNMENT",
                 "--output DIR", "crevasse prm/raous1980.prm",
                 "4  cannot read or write a file"):
        check(text in output, f"--help does not speak of {text}")
    status, output, error = start("--version")
    check(status == 0 and error == ""
          and re.match(r"crevasse \d+\.\d+\.\d+\n", output)
          and "deal.II 9." in output and "BLAS: " in output, "--version")


def test_mistakes():
    for arguments, message in (
            ((), "crevasse --print-parameters "),
            (("--frobnicate",), "not expected: --frobnicate"),
            (("a.prm", "--ouput", "x"), 'did you mean "--output"?'),
            (("a.prm", "--error=1e-3"), "not expected: --error=1e-3"),
            (("--quiet", "report", "x"), '"report" must be the first'),
            (("sweep", "--hepl"), 'did you mean "--help"?'),
            (("swep", "a.prm"), 'did you mean "sweep"?'),
            (("a.prm", "b.prm"), "b.prm"),
            (("a.prm", "--set"), "--set"),
            (("a.prm", "--output"), "--output"),
            (("--print-parameters", "--set", "Loads/Period=3"),
             "A scene file for --set is required"),
            (("--print-parameters", "xml"), "{prm,json,markdown,schema}"),
            (("--print-parameters", "a.prm"), "{prm,json,markdown,schema}"),
            (("a.prm", "--wall-time", "12:00"), "is not a time"),
            (("a.prm", "--wall-time", "1:60:00"), "is not a time"),
            (("a.prm", "--wall-time", "24:00:00:00"), "is not a time"),
            (("a.prm", "--wall-time", "0"), "is not a time")):
        status, output, error = execute(*arguments)
        check(status == 2, f"{arguments}: exit status {status}")
        check(output == "", f"{arguments}: standard output:\n{output}")
        check(message in error, f"{arguments}: standard error:\n{error}")


def test_check():
    scene = write_scene("checked.prm")
    succeed("--check", scene, "--wall-time", "1-00:30:00")
    directory = remove("results/checked")
    before = sorted(pathlib.Path().rglob("*"))
    output = succeed("--check", "--verbose", scene)
    after = sorted(pathlib.Path().rglob("*"))
    check(after == before, "--check wrote something")
    check(not directory.exists(), "--check made an output directory")
    print(output)
    for pattern in ("A = b, c", "8 cells, 30 unknowns, 32 quadrature points, 2 "
                    "contact nodes", r"memory: about \d+ MB",
                    r"contact +on +\(", r"viscosity +on +\(",
                    r"body force +off +\(", r"field output +on +\(",
                    "boundaries: symmetry 2; loaded 3; contact 4; fixed "
                    r"\(0.5, 0\): 1\n", "output directory: results/checked\n",
                    "10 steps a period", r"linear solver: cholesky \(automatic",
                    r"contact solver: condensed active set \(automatic",
                    "nothing was computed"):
        check(re.search(pattern, output), f"--check does not print {pattern}")


def test_predicted_memory():
    """21 instants of 57344 points (two tensors of 4) and 29250 unknowns, of which a
    checkpoint collects the points, and 8 displacements and forces of each cell."""
    scene = SOURCE / "prm/raous1980.prm"
    sizes = []
    for times in ("", ", ".join(str(30 * k) for k in range(20))):
        output = succeed("--check", scene, "--set", "Geometry/Refinements=4",
                         "--set", f"Output/Field times={times}")
        sizes.append(float(re.search(r"about (\d+) MB", output)[1]))
    print(f"memory without and with field times: {sizes} MB")
    points, cells = 2 * 4 * 57344, 57344 / 4
    expected = 20 * 8e-6 * (points + 29250 + 2.4 * (points + 2 * 8 * cells))
    check(abs(sizes[1] - sizes[0] - expected) <= 1.01, f"not {expected} MB more")


def test_quiet_and_output():
    scene = write_scene("quiet.prm")
    elsewhere = remove("deep/in/elsewhere")
    default = remove("results/quiet")
    output = succeed("--quiet", scene, "--output", elsewhere)
    check(output == "", f"--quiet prints:\n{output}")
    for name in PROBES + ("used.prm", "summary.json", "log.txt",
                          "periods.csv", "solution.pvd"):
        check((elsewhere / name).stat().st_size > 0, f"{name} is empty")
    check(not default.exists(), "--output does not replace the default")


def test_progress():
    """On a terminal a line moves, and is gone where another one begins; it shows the
    period and the instant of the step that is under way."""
    begin, scene = time.monotonic(), write_scene("progress.prm")
    terminal, program = os.openpty()
    process = subprocess.Popen(
        [PROGRAM, scene, "--output", "results/progress",
         "--set", "Periodic state/Maximum periods=400",
         "--set", "Geometry/Subdivisions=16, 8", "--set", "Output/Fields=none"],
        stdin=program, stdout=program, stderr=program)
    os.close(program)
    shown = b""
    while True:
        try:
            shown += os.read(terminal, 65536)
        except OSError:  # the program has ended
            break
    os.close(terminal)
    check(process.wait(timeout=PATIENCE) == 0, "exit status")
    seconds = time.monotonic() - begin  # a period takes less
    lines = re.findall(
        r"\r  period (\d+) of at most 400, step (\d+) at t = (\S+), (\d+) of the lip's "
        r"nodes closed, at most (\d+) s left\x1b\[K\r(?:\x1b\[K|  period)", shown.decode())
    check(len(lines) > 0, f"no such line: {shown[:1000]}")
    for period, step, t, closed, left in lines:
        start = 600. * (int(period) - 1) + 60. * (int(step) - 1)
        check(float(t) == start and 1 <= int(step) <= 10, f"{period}, {step}: {t}")
        check(int(closed) <= 9 and int(left) <= 400 * seconds,
              f"closed {closed}, left {left}")


def test_directories():
    scenes = pathlib.Path("scenes.of")
    scenes.mkdir(exist_ok=True)
    scene = write_scene(scenes / "a.scene.prm")
    directory = remove("results/a.scene")
    remove("chosen")
    arguments = ("--quiet", "--set", "Periodic state/Maximum periods=1")
    succeed(scene, *arguments)
    check((directory / "summary.json").exists(),
          "the default is not results/<scene name>")
    succeed(scene, *arguments, "--set", "Output directory=chosen")
    check((pathlib.Path("chosen") / "summary.json").exists(),
          "Output directory has no effect")


def test_earlier_results():
    """They make room, and are kept unless --force says otherwise; other
    people's files stay."""
    scene = write_scene("earlier.prm")
    directory = remove("results/earlier")
    directory.mkdir(parents=True)
    arguments = ("--quiet", scene, "--output", directory, "--set",
                 "Periodic state/Maximum periods=1")
    notes = directory / "notes.txt"
    theirs = directory / "probe_measured.csv"
    for path in (notes, theirs):
        path.write_text("1, 2, 3\n")
    succeed(*arguments)
    check(theirs.exists(), "removed a table where no run had been")

    (directory / "report.html").write_text("of these results")
    first = {path.name: path.read_bytes() for path in directory.iterdir()
             if path not in (notes, directory / "running")}
    other = (*arguments, "--set", "Output/Probes=other: 0.3, 0.6")
    for number, options in enumerate(((), ("--force",), ()), 1):
        succeed(*other, *options)
        for name in ("probe_A.csv", "probe_measured.csv", "report.html"):
            check(not (directory / name).exists(),
                  f"{name} could be taken for this run's")
        check((directory / "probe_other.csv").exists() and notes.exists(),
              "a file is missing")
        kept = directory / "earlier_1"
        check({path.name: path.read_bytes() for path in kept.iterdir()}
              == first, "the first run's results are kept")
        check((directory / "earlier_2").exists() == (number == 3),
              "--force keeps nothing")
    (directory / "earlier_3").write_text("somebody's notes\n")
    succeed(*other)
    check((directory / "earlier_4" / "used.prm").exists(), "not beside earlier_3")


def test_second_run():
    """A directory has one run at a time."""
    directory = pathlib.Path("two_runs")
    directory.mkdir(exist_ok=True)
    pathlib.Path("two_runs.prm").write_text(plain(SCENE))
    with open(directory / "running", "w") as file:
        file.write("the first run\n")
        file.flush()
        fcntl.flock(file, fcntl.LOCK_EX)
        status, _, error = execute("two_runs.prm", "--output", directory)
    check(status == 4 and "Another run writes to" in error
          and "the first run" in error, f"exit status {status}\n{error}")


def test_set():
    """Only the first "=" ends the name; commas do not end the value."""
    scene = write_scene("set.prm")
    settings = ["Title=x = y, z", "Geometry/Subdivisions=6, 3",
                "Loads/Traction=0; if(t <= 300, 1, 0)",
                "  Loads /  Period =600  ",
                "Material/Poisson ratio=0.1", "Material/Poisson ratio=0.2"]
    results = run(scene, "set", settings + ["Periodic state/Maximum periods=1"])
    used = (results.directory / "used.prm").read_text()
    for pattern in (r"set Title += x = y, z ", r"set Subdivisions += 6, 3 ",
                    r"set Traction += 0; if\(t <= 300, 1, 0\) ",
                    r"set Period += 600 ", r"set Poisson ratio += 0.2 "):
        check(re.search(pattern, used), f"used.prm lacks {pattern}")
    check(results.summary["cells"] == 18, "Subdivisions has no effect")


def test_blanks_in_formulas():
    """They do not divide a function from its bracket, and messages count them."""
    value = succeed("evaluate", "f", "2*sin  (pi*t) + max (1, (t)) * (2)", "0.5")
    check(value.split() == ["4"], value)
    status, _, error = execute("evaluate", "f", "2*sin  (pi*q)", "0.5")
    check(status == 2 and '"q"' in error and "position 11" in error, error)


def test_set_anywhere():
    """Each --set takes one value, so that the scene may stand anywhere."""
    scene = write_scene("anywhere.prm")
    one = ("--set", "Geometry/Subdivisions=6, 3")
    two = ("--set", "Material/Poisson ratio=0.1")
    for arguments in ((*one, *two, scene), (*one, scene, *two),
                      (scene, *one, *two), ("--check", *one, scene, *two)):
        output = succeed(*arguments, "--check")
        check("18 cells" in output, f"{arguments}: --set has no effect")
    status, _, error = execute(*one, "Material/Poisson ratio=0.1", scene)
    check(status == 2, f"two assignments after one --set: {status}\n{error}")


def test_told_where():
    """What becomes of earlier results is reported."""
    scene = write_scene("kept.prm")
    directory = remove("results/kept")
    arguments = (scene, "--set", "Periodic state/Maximum periods=1")
    told = "results of an earlier run are kept in results/kept/earlier_1"
    check(told not in succeed(*arguments), "nothing was there to keep")
    check(told in succeed(*arguments), "moved in silence")
    check(told in (directory / "log.txt").read_text(), "log.txt lacks it")


def test_nothing_marched():
    """What is not computed is not reported."""
    settings = ["Periodic state/Maximum periods=0",
                "Contact/Relaxation table=1.5"]
    results = run(SCENE, "table_only", settings)
    log = (results.directory / "log.txt").read_text()
    for text in ("certificate", "change of stress"):
        check(text not in log, f"nothing was marched, but log.txt has {text}")
    tables = sorted(path.name for path in results.directory.glob("*.csv"))
    check(tables == ["relaxation.csv"], f"tables: {tables}")
    check(results.summary["converged"] is None, "summary.json: converged")


def test_tables():
    """Numbers are as short as they can be without losing a digit."""
    results = run(SCENE, "tables", ["Periodic state/Maximum periods=1"])
    check(results.table("contact.csv")["t"] == [60. * k for k in range(11)],
          "the instants")
    for path in results.directory.glob("*.csv"):
        for line in path.read_text().splitlines()[1:]:
            for text in line.split(","):
                check(len(text) <= len(repr(float(text))),
                      f"{path.name}: {text} is longer than need be")


def test_print_parameters():
    prm = succeed("--print-parameters")
    check(prm == succeed("--print-parameters", "prm"), "prm is the default")
    printed_json = succeed("--print-parameters", "json")
    markdown = succeed("--print-parameters", "markdown")

    sections = [name for name, value in json.loads(printed_json).items()
                if isinstance(value, dict)]
    check({"Geometry", "Output"} < set(sections), "sections are missing")
    for section in sections:
        check(f"subsection {section}\n" in prm, f"prm lacks {section}")
        check(f"\n## {section}\n" in markdown, f"markdown lacks {section}")
    check("| Crack length | `0.5` |" in markdown, "markdown lacks a parameter")
    check("3 top; 4 crack lip" in markdown
          and '"automatic" is 3 for a built-in shape' in markdown,
          "markdown does not tell boundary ids")
    for line in markdown.splitlines():
        check(not line.startswith("|")
              or len(re.findall(r"(?<!\\)\|", line)) == 5,
              f"markdown: not four columns: {line}")

    # Both are scenes, and the same one.
    sizes = set()
    for scene in (write_scene("printed.prm", prm),
                  write_scene("printed.json", printed_json)):
        output = succeed("--check", scene)
        sizes.add(output.split("\n", 1)[1])
    check(len(sizes) == 1, f"the printed scenes differ: {sizes}")


def test_print_scene():
    """The values of a scene, as used.prm has them."""
    scene = write_scene("values.prm")
    words = (scene, "--set", "Title=other")
    prm = succeed(*words, "--print-parameters", "prm")
    check(re.search(r"set Title += other ", prm), "--set has no effect")
    values = json.loads(succeed(*words, "--print-parameters", "json"))
    check(values["Geometry"]["Subdivisions"] == "4, 2", f"{values['Geometry']}")
    results = run(scene, "values", ["Title=other", "Periodic state/Maximum periods=2"])
    check((results.directory / "used.prm").read_text() == prm, "used.prm differs")
    for form in ("markdown", "schema"):
        status, _, error = execute(*words, "--print-parameters", form)
        check(status == 2 and "prm or json" in error, f"{form}: {status} {error}")


def test_schema():
    """Every scene of the repository fits, as a person and as deal.II write JSON, and
    what the program refuses by its names, choices and ranges does not."""
    schema = json.loads(succeed("--print-parameters", "schema"))
    jsonschema.Draft7Validator.check_schema(schema)
    fits = jsonschema.Draft7Validator(schema).is_valid
    scenes = [*SOURCE.glob("prm/**/*.prm")]
    check(len(scenes) > 20, f"{scenes}")
    for path in scenes:
        scene = {}
        for name, value in parse_parameters(path.read_text())[0].items():
            section, _, parameter = name.rpartition("/")
            (scene.setdefault(section, {}) if section else scene)[parameter] = value
        error = jsonschema.exceptions.best_match(
            jsonschema.Draft7Validator(schema).iter_errors(scene))
        check(error is None, f"{path}: {error}")
    check(fits(json.loads(succeed("--print-parameters", "json"))), "defaults")
    named = {"$schema": "./crevasse.schema.json", **JSON_SCENE,
             "Crack tip": {"Stress intensity": True}}
    check(fits(named), "a scene by hand")
    succeed("--check", write_scene("named.json", json.dumps(named)))

    for section, values in {
            "Geometry": {"Crak length": 0.3, "Width": -1, "Shape": "edge",
                         "Refinements": 1.5},
            "Crack tip": {"Stress intensity": "yes"},
            "Periodic state": {"Method": "Anderson", "Tolerance": "small"},
            "Geometri": {"Width": 1}, "Dimension": {"": 4}}.items():
        for name, value in values.items():
            wrong = {section: {name: value} if name else value}
            check(not fits(wrong), f"fits the schema: {wrong}")
            status, _, error = execute("--check",
                                       write_scene("wrong.json", json.dumps(wrong)))
            check(status == 2 and section in error, f"{wrong}: {error}")

    geometry = schema["properties"]["Geometry"]["properties"]
    check(geometry["Crack length"]["default"] == 0.5
          and geometry["Subdivisions"]["default"] == "automatic"
          and geometry["Shape"]["default"] == "edge crack"
          and "mesh file" in geometry["Shape"]["enum"]
          and "less than Width" in geometry["Crack length"]["description"]
          and "maximum" not in geometry["Width"], f"{geometry}")


def test_scripts():
    """They are found beside the program, in an installation too, and without Python
    the message says what is missing."""
    for name in ("advise", "figures", "report"):
        check(name in succeed("--help") and "usage:" in succeed(name, "--help"), name)
    place = remove("installed")
    (place / "bin").mkdir(parents=True)
    program = place / "bin" / "crevasse"
    shutil.copy(PROGRAM, program)

    def call():
        process = subprocess.run([program, "report", "nowhere"], text=True,
                                 capture_output=True, timeout=PATIENCE)
        return process.returncode, process.stderr
    status, error = call()
    check(status == 4 and "package is missing" in error, f"no package: {error}")
    package = place / "share" / "crevasse" / "python" / "crevasse"
    shutil.copytree(SOURCE / "source" / "python" / "crevasse", package)
    status, error = call()
    check(status == 2 and "nowhere: no such directory" in error, f"installed: {error}")
    (package / "page.py").write_text("import a_package_that_is_not_there\n")
    status, error = call()
    check(status == 4 and "python3-jinja2" in error and "Traceback" not in error,
          f"no library: {error}")


def test_server():
    """Of crevasse serve: runs at the same time in directories of their own, and a
    signal that reaches one of them."""
    place = remove("served")
    place.mkdir()
    write_scene(place / "long.prm")
    long = server().start(("long.prm", "--set", "Periodic state/Maximum periods=100000"),
                          directory="served", seconds=PATIENCE)
    log = place / "results/long/log.txt"
    while not log.exists() and long.status is None:
        server().wait(long, seconds=0.01)
    short = server().start(("--version",), unset=["HOME"])
    server().wait(short)
    check(short.status == 0 and "crevasse" in short.output and long.status is None,
          f"beside a long run: {short.status} {short.output}{short.error}")
    long.terminate()
    server().wait(long)
    check(long.status == 5 and "SIGTERM" in log.read_text(), f"{long.status}")
    late = server().start(("long.prm",), directory="nowhere")
    server().wait(late)
    check(late.status == 4 and "nowhere" in late.error, f"{late.status} {late.error}")
    killed = server().start(
        ("served/long.prm", "--set", "Periodic state/Maximum periods=100000"), seconds=1)
    server().wait(killed)
    check(killed.status == -14, f"has had its second: {killed.status}")


def test_many_starts():
    """Of processes without mpirun, all at once. They need no directory of Open MPI's,
    over which they would quarrel, nor its daemon; but what the user sets counts."""
    scene = write_scene("many.prm")
    own = {name: value for name, value in os.environ.items()
           if not re.match("OMPI_MCA|OMPI_COMM|PMIX_", name)}
    own.update(TMPDIR=str(scene.resolve()), OPAL_BINDIR="/nowhere")

    def begin(number, **more):
        return subprocess.Popen(
            [PROGRAM, scene, "--quiet", "--output", f"results/many_{number}", "--force",
             "--set", "Output/Checkpoint every=1"],
            env={**own, **more}, stdin=subprocess.DEVNULL, stderr=subprocess.PIPE,
            stdout=subprocess.DEVNULL)
    for process in [begin(number) for number in range(tier(10, 200))]:
        error = process.communicate(timeout=PATIENCE)[1]
        check(process.returncode == 0 and not error,
              f"at once: {process.returncode} {error}")
    for name in ("ess_singleton_isolated=0", "orte_create_session_dirs=1"):
        name, value = name.split("=")
        process = begin("other", **{"OMPI_MCA_" + name: value})
        error = process.communicate(timeout=PATIENCE)[1]
        check(process.returncode != 0 and error, f"{name} is overridden")


def test_round_trips():
    path = pathlib.Path("first.prm")
    path.write_text(SCENE)
    results = run(path, "first")
    again = run(results.directory / "used.prm", "again")
    check_same_tables(results, again, "used.prm")
    check((results.directory / "used.prm").read_bytes()
          == (again.directory / "used.prm").read_bytes(),
          "used.prm of used.prm differs")
    scene = write_scene("same.json", json.dumps(JSON_SCENE))
    check_same_tables(results, run(scene, "json"), "JSON")


# What bash does at a tabulator, for several lines; stops at the first error.
COMPLETE = r"""
set -eu
source "$1"
compopt() { :; }
answer() {
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
  _crevasse "$1" "${*: -1}" "${*: -2:1}"
  echo "$(IFS='|'; echo "${COMPREPLY[*]}")"
}
program=$2
answer "$program" my
answer "$program" x.prm --output my
answer "$program" adv
answer "$program" fig
answer "$program" x.prm --che
answer "$program" x.prm --set "\"Geometry/Crack l"
answer "$program" x.prm --set "'Geometry/Crack l"
program=gone
answer "$program" x.prm --vary Tit
answer "$program" x.prm --che
"""


def test_completion():
    """In the strictest shell. The parameters are asked for once: they are known when
    the program is gone."""
    directory = remove("completion")
    (directory / "my folder").mkdir(parents=True)
    for name in ("my scene.prm", "my.json", "my.txt"):
        (directory / name).touch()
    process = subprocess.run(
        ["bash", "-c", COMPLETE, "bash", SOURCE / "doc/completion.bash", PROGRAM],
        cwd=directory, text=True, capture_output=True, timeout=PATIENCE)
    check(process.returncode == 0 and not process.stderr,
          f"completion: {process.returncode} {process.stderr}")
    found = process.stdout.splitlines()
    check(found == ["my folder|my scene.prm|my.json", "my folder", "advise", "figures",
                    "--check", *(f"{name}=|{name}=..." for name in (
                        '"Geometry/Crack length', "'Geometry/Crack length",
                        '"Title')), ""], f"completion: {found}")


test_questions()
test_mistakes()
test_completion()
test_check()
test_predicted_memory()
test_quiet_and_output()
test_directories()
test_earlier_results()
test_second_run()
test_set()
test_blanks_in_formulas()
test_set_anywhere()
test_told_where()
test_nothing_marched()
test_tables()
test_progress()
test_print_parameters()
test_print_scene()
test_schema()
test_scripts()
test_server()
test_many_starts()
test_round_trips()
