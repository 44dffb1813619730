"""Runs the program and reads what it wrote. A test is a Python program called
with the paths of the program and of the source tree; it asserts, and prints
the figures on which it judges.

Runs are requests to a server that has loaded the program and forks (crevasse
serve); start() starts the program itself, for tests of the command line,
signals, pipes and of the environment."""

import atexit
import contextlib
import csv
import functools
import json
import math
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import time

from mpi_environment import ENVIRONMENT

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
SOURCE = pathlib.Path(sys.argv[2]).resolve()

sys.path.insert(0, str(SOURCE / "source/python"))
from crevasse.program import Server  # noqa: E402: where it is, is known now

SECONDS = [0.]  # CPU time, of the server's runs
PATIENCE = 1800  # seconds for any run: a busy machine takes ten times as long

# The tier: the preset "full" sets this.
FULL = os.environ.get("CREVASSE_TESTS") == "full"


def full(test):
    """Marks a test that the preset "full" runs and the default tier does not."""
    return test if FULL else lambda: print(f"{test.__name__}: in preset full")


def tier(default, all_of_them):
    """What a test goes through in the default tier, and in the preset "full"."""
    return all_of_them if FULL else default


class Failure(AssertionError):
    pass


class Results:
    """The output directory of one run."""

    def __init__(self, directory):
        self.directory = pathlib.Path(directory)

    @property
    def summary(self):
        return json.loads((self.directory / "summary.json").read_text())

    def table(self, name):
        """A table as a dictionary of columns."""
        with open(self.directory / name) as file:
            rows = list(csv.reader(file))
        return {column: [float(row[i]) for row in rows[1:]]
                for i, column in enumerate(rows[0])}


@functools.cache
def server():
    """The server of this test, which ends with it."""
    return Server(PROGRAM, ENVIRONMENT)


@atexit.register
def print_cost():
    n_runs = server().n_calls if server.cache_info().currsize else 0
    used = [resource.getrusage(who)
            for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    print(f"{n_runs} runs of the server, in all "
          f"{SECONDS[0] + sum(u.ru_utime + u.ru_stime for u in used):.1f} s of CPU time")


def execute(*arguments, cwd=".", seconds=PATIENCE):
    """Runs the program; returns exit status (or minus the signal that ended it),
    standard output and error."""
    call = server().start(arguments, directory=os.path.abspath(cwd), seconds=seconds)
    server().wait(call)
    SECONDS[0] += call.seconds
    return call.status, call.output, call.error


def start(*arguments, **options):
    """As execute(), by a start of the program."""
    process = subprocess.run(
        [str(PROGRAM), *map(str, arguments)], text=True, capture_output=True,
        stdin=subprocess.DEVNULL, timeout=PATIENCE, **{"env": ENVIRONMENT, **options})
    return process.returncode, process.stdout, process.stderr


def wait_until(condition, process):
    """Until a condition has a value, which is returned, or the program has ended. Files
    that it looks at may come and go."""
    while process.poll() is None:
        with contextlib.suppress(FileNotFoundError):
            if value := condition():
                return value
        time.sleep(2e-3)
    return None


def overrides(settings):
    """The words of the command line for "Section/Name=value" settings."""
    return [word for setting in settings for word in ("--set", setting)]


def settings_of(scene):
    """The text of a scene as (section, name): value."""
    section, settings = "", {}
    for line in scene.splitlines():
        words = line.split("#")[0].split(None, 1)
        if words[:1] == ["subsection"]:
            section = words[1].strip()
        elif words[:1] == ["set"]:
            name, value = words[1].split("=", 1)
            settings[section, name.strip()] = value.strip()
    return settings


def plain(scene):
    """The text of a scene, and after it those settings of plain.prm that it does
    not have."""
    own = settings_of(scene)
    usual = settings_of((SOURCE / "tests/runs/plain.prm").read_text())
    return scene + "".join(
        f"subsection {section}\n  set {name} = {value}\nend\n"
        for (section, name), value in usual.items() if (section, name) not in own)


def run(scene, name, settings=(), status=0):
    """Runs a scene (a path, or the text of a .prm file) with "Section/Name=value"
    settings into the fresh directory results/<name>."""
    directory = pathlib.Path("results") / name
    shutil.rmtree(directory, ignore_errors=True)
    if "\n" in str(scene):
        path = pathlib.Path(name + ".prm")
        path.write_text(plain(scene))
        scene = path
    code, _, error = execute(scene, "--output", directory,
                             *overrides(settings))
    check(code == status, f"{name}: exit status {code} instead of {status}\n"
                          + error)
    return Results(directory)


def execute_on(n_ranks, *arguments):
    """Runs the program on several processes, as execute() does on one."""
    process = subprocess.run(
        ["mpirun", "-np", str(n_ranks), PROGRAM, *map(str, arguments)],
        text=True, capture_output=True, stdin=subprocess.DEVNULL, timeout=PATIENCE,
        env=ENVIRONMENT)
    return process.returncode, process.stdout, process.stderr


def run_on(n_ranks, scene, name, settings=()):
    """Runs a scene file on several processes into results/<name>."""
    directory = pathlib.Path("results") / name
    code, _, error = execute_on(n_ranks, scene, "--output", directory,
                                "--quiet", *overrides(settings))
    check(code == 0, f"{name}: exit status {code}\n{error}")
    return Results(directory)


def sweep(name, scene, *arguments, status=0, fresh=True, run=execute):
    """Sweeps over a scene file into results/<name>; the rows of its table, and what
    was said, or (None, standard error) where it fails. One that is not fresh goes on
    with what is there."""
    directory = pathlib.Path("results") / name
    if fresh:
        shutil.rmtree(directory, ignore_errors=True)
    code, output, error = run("sweep", scene, "--output", directory, *arguments)
    check(code == status, f"{name}: exit status {code} instead of {status}\n"
                          + output + error)
    return (None, error) if status else (rows_of_sweep(directory), output)


def rows_of_sweep(directory):
    with open(pathlib.Path(directory) / "sweep.csv", newline="") as file:
        return list(csv.DictReader(file))


def probe_difference(one, other):
    """The largest difference of lengths and of stresses at the probes "mouth"
    and "inside" of two runs, relative to the largest of its kind."""
    worst = 0.
    for probe in ("mouth", "inside"):
        mine = one.table(f"probe_{probe}.csv")
        theirs = other.table(f"probe_{probe}.csv")
        for kind in (("u_1", "u_2", "opening"),
                     ("s_11", "s_22", "s_12", "pressure")):
            columns = [column for column in kind if column in mine]
            size = max(abs(x) for column in columns for x in mine[column])
            worst = max(worst, *(abs(a - b) / size for column in columns
                                 for a, b in zip(mine[column], theirs[column],
                                                 strict=True)))
    return worst


def check(condition, message):
    if not condition:
        raise Failure(message)


def check_close(value, expected, tolerance, what):
    """Prints and asserts |value - expected| <= tolerance (absolute)."""
    difference = abs(value - expected)
    print(f"{what}: {value:.10g}, expected {expected:.10g}, "
          f"difference {difference:.1e} (allowed {tolerance:.1e})")
    check(math.isfinite(value) and difference <= tolerance, what)


def check_below(value, bound, what):
    print(f"{what}: {value:.2e} (allowed {bound:.0e})")
    check(math.isfinite(value) and value <= bound, what)
