"""Runs that are interrupted and resumed, and how they compare with those that
were not."""

import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import time

from cracked import BOTTOM, CRACK, TOP, square, steps, write_block
from crevasse_run import (PATIENCE, PROGRAM, SOURCE, Results, check, overrides,
                          wait_until)
from mpi_environment import ENVIRONMENT

SCENE = SOURCE / "prm/raous1980.prm"
COMMON = ["Contact/Solver=automatic", "Periodic state/Tolerance=0",
          "Geometry/Subdivisions=24, 24",
          "Output/Probes=mouth: 1, 0; inside: 0.75, 0"]

# A mean load and a viscosity that redistributes the stress: contact opens and
# closes, and every period differs from the one before.
REDISTRIBUTES = ["Material/Viscosity=isotropic",
                 "Material/Viscous modulus=780000*if(x<0.3,0.2,1)",
                 "Material/Viscous Poisson ratio=0.4",
                 "Loads/Traction=0; 10*(sin(2*pi*t/600) - 0.1)"]


MESHES = tempfile.TemporaryDirectory()


def periods(number):
    return [f"Periodic state/Maximum periods={number}"]


def cracked_square():
    """Both halves of the scene's body, whose lips touch each other."""
    mesh = square(pathlib.Path(MESHES.name) / "square.msh")
    return ["Geometry/Shape=mesh file", f"Geometry/Mesh file={mesh}",
            f"Boundary/Crack={CRACK}", f"Boundary/Loaded={BOTTOM}, {TOP}",
            "Boundary/Fixed points=0.5, 0; 0, 0: 2",
            "Loads/Traction=0; 10*(sin(2*pi*t/600) - 0.1)*y"]


def cracked_block():
    return write_block(pathlib.Path(MESHES.name) / "block.msh",
                       [steps(-1, 1, 6), steps(-1, 1, 4), steps(-1, 1, 4)],
                       lambda middle, normal: (normal == 1 and middle[1] == 0
                                               and middle[0] > -0.5))


CASES = {
    "march": periods(8),
    "anderson": REDISTRIBUTES + periods(8) + ["Periodic state/Method=anderson"],
    "averaged": REDISTRIBUTES + periods(6) + [
        "Periodic state/Method=averaged", "Time integration/Scheme=sdirk2",
        "Contact/Solver=condensed active set"],
    "missions": REDISTRIBUTES + periods(60) + [
        "Periodic state/Missions=4, 40", "Periodic state/Method=automatic",
        "Time integration/Scheme=sdirk2",
        "Contact/Solver=condensed active set"],
    "opening": REDISTRIBUTES + periods(12) + [
        "Periodic state/Method=march", "Periodic state/Tolerance=1e-3",
        "Periodic state/Converged quantity=opening"],
    "adaptive steps": REDISTRIBUTES + periods(5) + [
        "Time integration/Step control=adaptive",
        "Time integration/Relative tolerance=1e-3"],
    "events": periods(5) + ["Time integration/Scheme=rk4",
                            "Time integration/Locate contact events=true"],
    "sdirk2": REDISTRIBUTES + periods(6) + ["Time integration/Scheme=sdirk2"],
    "harmonic balance": REDISTRIBUTES + periods(1) + [
        "Time integration/Scheme=trapezoid", "Periodic state/Method=fourier",
        "Material/Viscosity=relaxation time", "Material/Relaxation time=60",
        "Geometry/Subdivisions=24, 24"],
    "power law": periods(5) + [
        "Material/Viscosity=power law", "Material/Creep exponent=5",
        "Material/Creep coefficient=1e-11",
        "Time integration/Step control=adaptive",
        "Time integration/Relative tolerance=1e-3"],
    "power law, implicit": periods(5) + [
        "Material/Viscosity=power law", "Material/Creep exponent=5",
        "Material/Creep coefficient=1e-11", "Time integration/Scheme=sdirk2",
        "Time integration/Steps per period=8", "Crack tip/Creep integral=true",
        "Crack tip/Crack growth law=creep", "Crack tip/Creep factor=1",
        "Crack tip/Creep growth parameter=C(t)"],
    "two lips": REDISTRIBUTES + periods(6) + cracked_square(),
    "friction": periods(4) + cracked_square() + [
        "Boundary/Friction coefficient=0.3", "Time integration/Scheme=automatic",
        "Loads/Traction=4*cos(2*pi*t/600)*y; 10*(sin(2*pi*t/600) - 0.7)*y"],
    "friction in space": periods(3) + [
        "Dimension=3", "Geometry/Shape=mesh file",
        f"Geometry/Mesh file={cracked_block()}", f"Boundary/Crack={CRACK}",
        f"Boundary/Clamped={BOTTOM}", f"Boundary/Loaded={TOP}",
        "Boundary/Fixed points=none", "Boundary/Friction coefficient=0.3",
        "Time integration/Scheme=automatic", "Output/Probes=mouth: 1, 0.5, 0",
        "Loads/Traction=4*cos(2*pi*t/600); 6*sin(2*pi*t/600) - 9; 2*sin(2*pi*t/600)"],
    "readapted": REDISTRIBUTES + periods(6) + [
        "Refinement/Strategy=adaptive", "Refinement/Cycles=2",
        "Refinement/Readapt every=2", "Geometry/Subdivisions=8, 8"],
    "crack tip": REDISTRIBUTES + periods(4) + [
        "Crack tip/Stress intensity=true", "Output/Load work=true",
        "Refinement/Strategy=tip", "Refinement/Cycles=2",
        "Discretisation/Singular functions=1"],
    "stiffness varies": periods(4) + [
        "Material/Young modulus=13000*(1+0.1*if(x<0.5,1,0)*sin(2*pi*t/600))"],
    "arkode": periods(5) + ["Time integration/Scheme=arkode explicit"],
    "arkode adaptive": periods(5) + [
        "Time integration/Scheme=arkode implicit",
        "Time integration/Step control=adaptive",
        "Time integration/Relative tolerance=1e-3"],
    "active set": REDISTRIBUTES + periods(4) + ["Contact/Solver=active set",
                                                "Linear solver/Type=amg"],
    "multigrid": REDISTRIBUTES + periods(4) + [
        "Linear solver/Type=gmg", "Geometry/Subdivisions=12, 12",
        "Geometry/Refinements=1"],
    "adaptive events": REDISTRIBUTES + periods(5) + [
        "Time integration/Step control=adaptive",
        "Time integration/Relative tolerance=1e-3",
        "Time integration/Locate contact events=true"],
    "crack front": periods(3) + [
        "Dimension=3", "Geometry/Thickness=0.5", "Geometry/Subdivisions=6, 3, 2",
        "Boundary/Symmetry=2, 5, 6", "Boundary/Fixed points=automatic",
        "Loads/Traction=0; 10*sin(2*pi*t/600); 0",
        "Output/Probes=mouth: 1, 0, 0", "Crack tip/Stress intensity=true"],
}


def command(directory, settings, n_ranks=1, scene=SCENE, more=()):
    prefix = [] if n_ranks == 1 else ["mpirun", "-np", str(n_ranks)]
    return [*prefix, str(PROGRAM), str(scene), "--quiet", "--output",
            str(directory), *overrides(settings), *map(str, more)]


def execute(directory, settings, n_ranks=1, more=(), **options):
    """Exit status and what was written to the standard error."""
    process = subprocess.run(
        command(directory, settings, n_ranks, more=more, **options), text=True,
        capture_output=True, stdin=subprocess.DEVNULL, timeout=PATIENCE,
        env=ENVIRONMENT)
    return process.returncode, process.stderr


def fresh(name):
    directory = pathlib.Path("results") / name
    shutil.rmtree(directory, ignore_errors=True)
    return directory


def reference(name, settings):
    """An uninterrupted run, and what it took."""
    directory = fresh(name)
    begin = time.time()
    code, error = execute(directory, settings)
    check(code in (0, 3), f"{name}: exit status {code}\n{error}")
    return Results(directory), time.time() - begin


def wait_for(directory, n_rows, process):
    """Until a table has so many rows, or the program has ended."""
    wait_until(lambda: (directory / "probe_mouth.csv").read_bytes().count(b"\n")
               >= n_rows, process)


def wait_for_checkpoint(before, directory, process):
    """Until there is a new one, or the program has ended."""
    wait_until(lambda: not checkpoints(directory) <= before, process)


def set_signals(ignored):
    """For a program that begins: whoever called this one may ignore some."""
    for name in ("SIGTERM", "SIGINT", "SIGHUP"):
        signal.signal(getattr(signal, name), signal.SIG_IGN if name in ignored
                      else signal.SIG_DFL)


def interrupt(directory, settings, way, moment, n_ranks=1, ignored=()):
    """Begins a run, or goes on with it if it has a checkpoint, and interrupts
    it at a moment: after so many rows of its tables if that is an integer, or
    after so many seconds. Returns its status and what it said. It is begun with
    the signals of these names ignored."""
    more = ["--resume"] if has_checkpoint(directory) else []
    if way == "wall time":
        more += ["--wall-time", max(moment, 1e-3)]
    process = subprocess.Popen(command(directory, settings, n_ranks, more=more),
                               stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True,
                               stdin=subprocess.DEVNULL, env=ENVIRONMENT,
                               preexec_fn=lambda: set_signals(ignored))
    if isinstance(moment, int):
        wait_for(directory, moment, process)
    elif way != "wall time":
        time.sleep(moment)
    if way not in ("SIGKILL", "wall time"):
        wait_until_it_listens(process)
    if way == "stop file" and directory.exists():
        (directory / "stop").touch()
    elif way == "checkpoint and kill":
        before = checkpoints(directory)
        process.send_signal(signal.SIGUSR1)
        wait_for_checkpoint(before, directory, process)
        process.kill()
    elif way == "SIGTERM twice":  # as timeout does
        process.send_signal(signal.SIGTERM)
        time.sleep(1e-3)
        process.send_signal(signal.SIGTERM)
    elif way in ("SIGTERM", "SIGINT", "SIGHUP", "SIGKILL"):
        process.send_signal(getattr(signal, way))
    error = process.communicate(timeout=PATIENCE)[1]
    return process.returncode, error


def wait_until_it_listens(process):
    """Until it handles signals itself, or has ended: the tables of an
    interrupted run are there before the program that goes on has begun."""
    status = pathlib.Path(f"/proc/{process.pid}/status")

    def listens():
        caught = re.search(r"SigCgt:\s*(\w+)", status.read_text())
        return caught and int(caught[1], 16) >> (signal.SIGUSR1 - 1) & 1
    wait_until(listens, process)


def checkpoints(directory):
    """Their numbers."""
    return {int(path.name) for path in (directory / "checkpoint").glob("*")
            if path.name.isdigit()}


def has_checkpoint(directory):
    return len(checkpoints(directory)) > 0


def times_resumed(directory):
    log = directory / "log.txt"
    return log.read_text().count("resumed from") if log.exists() else 0


def finish(directory, settings, n_ranks=1):
    """Goes on to the end."""
    goes_on = (has_checkpoint(directory)
               and not (directory / "summary.json").exists())
    before = times_resumed(directory)
    code, error = execute(directory, settings, n_ranks,
                          more=["--resume"] if has_checkpoint(directory) else [])
    check(code in (0, 3), f"{directory}: exit status {code}\n{error}")
    check(not goes_on or times_resumed(directory) == before + 1,
          f"{directory}: was not resumed")
    return Results(directory)


def content(path):
    """Of a file of results, without seconds and dates; a change of stress, which is
    relative to the largest stress, without what is rounding."""
    text = path.read_bytes()
    if path.name == "periods.csv":
        head, *rows = (line.split(b",")[:-1] for line in text.splitlines())
        change = head.index(b"stress_change")
        for row in rows:
            row[change] = b"%.14f" % float(row[change])
        text = b"\n".join(b",".join(row) for row in [head, *rows])
    return re.sub(rb"<!--.*?-->", b"", text, flags=re.DOTALL)


def check_same_bytes(one, other, what):
    """All tables and fields."""
    names = sorted(path.name for pattern in ("*.csv", "solution*")
                   for path in one.directory.glob(pattern))
    check(len(names) > 3, f"{what}: there are results: {names}")
    for name in names:
        check(content(one.directory / name) == content(other.directory / name),
              f"{what}: {other.directory / name} differs")
    print(f"{what}: {len(names)} files are the same byte for byte")


def largest_difference(one, other):
    """Of all columns of the probes' and the crack tip's tables, relative to
    the largest value of each kind; of stresses, to the largest of the body, for
    rounding in a displacement is a stress of that size everywhere."""
    worst = 0.
    stress = one.summary["extremes"]["stress"]
    for path in one.directory.glob("*.csv"):
        if not path.name.startswith(("probe_", "crack_tip")):
            continue
        mine, theirs = one.table(path.name), other.table(path.name)
        for kind in ("u_", "s_", "K_I", "opening", "pressure", "strain_energy"):
            columns = [column for column in mine if column.startswith(kind)]
            size = stress if kind in ("s_", "pressure") else max(
                [abs(x) for column in columns for x in mine[column]],
                default=0.)
            if size == 0.:
                continue
            for column in columns:
                check(len(mine[column]) == len(theirs[column]),
                      f"{path.name}: as many rows")
                worst = max(worst, *(abs(a - b) / size for a, b in
                                     zip(mine[column], theirs[column])))
    return worst
