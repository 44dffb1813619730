"""Interrupted runs that are resumed end like uninterrupted ones: byte for byte on
as many ranks, else to 1e-10. Damaged checkpoints are recognised, scenes that differ
are refused."""

import functools
import json
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import zlib

from crevasse_run import (PATIENCE, Results, check, check_below, full, overrides, tier,
                          wait_until)
from crevasse_run import execute as served
from interrupted_runs import (CASES, COMMON, REDISTRIBUTES, SCENE, check_same_bytes,
                              command, execute, finish, checkpoints, fresh,
                              interrupt, largest_difference, periods,
                              reference, times_resumed, wait_for)
from mpi_environment import ENVIRONMENT

WAYS = ["SIGTERM", "SIGINT", "SIGHUP", "SIGTERM twice", "stop file", "wall time",
        "checkpoint and kill"]
DICE = random.Random(1980)


def newest(directory):
    return directory / "checkpoint" / str(max(checkpoints(directory)))


def copy(directory, name):
    """A copy of results, into the folder results/<name>."""
    return pathlib.Path(shutil.copytree(directory, fresh(name)))


@functools.cache
def kept_march():
    """Settings with checkpoints, and a whole run with them, to be copied."""
    settings = COMMON + CASES["march"] + ["Output/Checkpoint every=2"]
    return settings, reference("kept_march", settings)[0]


def rows(results):
    return len(results.table("probe_mouth.csv")["t"])


def test_interruptions():
    """Each way does what it is there for in some of the cases at least: in the
    others the run may end before."""
    has_worked = set()
    for number, (name, extra) in enumerate(
            list(CASES.items())[:tier(4, None)]):
        settings = COMMON + extra
        whole, seconds = reference(f"{name} whole".replace(" ", "_"), settings)
        directory = fresh(name.replace(" ", "_"))
        codes = []
        for leg in range(2):
            way = WAYS[(2 * number + leg) % len(WAYS)]
            moment = (DICE.uniform(0.2, 0.5) * seconds if way == "wall time" else
                      int((leg + DICE.uniform(0.1, 0.9)) / 2 * rows(whole)))
            code, error = interrupt(directory, settings, way, moment)
            stopped = -9 if way == "checkpoint and kill" else 5
            check(code in (0, 3, stopped), f"{name}: {way}: {code} {error}")
            if code == stopped and (stopped == 5 or checkpoints(directory)):
                has_worked.add(way)
            codes.append(f"{way} at {moment}: {code}")
            if (directory / "summary.json").exists():
                break
        check_same_bytes(whole, finish(directory, settings), f"{name}, {codes}")
    check(len(has_worked) >= tier(4, len(WAYS)), f"never: {set(WAYS) - has_worked}")


def test_signals():
    """What was ignored when the program began is ignored."""
    settings, whole = kept_march()
    moment = rows(whole) // 3
    code, error = interrupt(fresh("ignored"), settings, "SIGHUP", moment,
                            ignored=["SIGHUP"])
    check(code in (0, 3), f"SIGHUP under nohup: {code} {error}")


@full
def test_kills():
    """A run that is killed writes the same bytes once it is resumed. What adaptive
    steps have found in a period decides on those of the next."""
    for name in tier(("adaptive steps",), ("adaptive steps", "anderson")):
        n_kills = n_resumed = 0
        settings = COMMON + CASES[name] + ["Output/Checkpoint every=1"]
        whole, _ = reference("kills_whole", settings)
        for share in tier((0.4, 0.8), (0.05, 0.4, 0.8)):  # 0.05: no checkpoint yet
            directory = fresh(f"kill_at_{share}")
            code, _ = interrupt(directory, settings, "SIGKILL",
                                int(share * rows(whole)))
            n_kills += code == -9
            check_same_bytes(whole, finish(directory, settings),
                             f"{name}, killed at {share}")
            n_resumed += times_resumed(directory)
        check(n_kills > 0 and n_resumed > 0,
              f"{name}: killed {n_kills} times, resumed {n_resumed} times")


def test_ranks():
    for name in tier(("readapted",), ("anderson", "readapted", "crack tip")):
        # Processes that share busy cores wait for each other at each solve.
        settings = COMMON + CASES[name] + [
            "Contact/Tolerance=1e-13", "Time integration/Scheme=sdirk2",
            "Time integration/Steps per period=10"]
        whole, _ = reference("ranks_whole", settings)
        for _ in range(3):  # on a busy machine the run may end before
            directory = fresh("ranks")
            codes = [interrupt(directory, settings, "stop file",
                               int(share * rows(whole)), n_ranks)[0]
                     for n_ranks, share in ((1, 0.3), (2, 0.6))]
            if 5 in codes:
                break
        check(5 in codes, f"{name}: {codes}")
        resumed = finish(directory, settings, 1 if name == "anderson" else tier(1, 3))
        check_below(largest_difference(whole, resumed), 1e-10,
                    f"{name}: ranks 1, 2 and others, {codes}")


def test_damage():
    settings, whole = kept_march()
    check([path.name for path in sorted(
        (whole.directory / "checkpoint").iterdir())] == ["3", "4"],
        "the last two checkpoints are kept")
    # As if it had been killed at its end, while it wrote its summary.
    interrupted = copy(whole.directory, "damage")
    (interrupted / "summary.json").write_text('{\n  "version": ')
    files = {path.name for path in newest(interrupted).iterdir()}
    check(files == {"manifest.json", "common.bin", "mesh", "mesh.info",
                    "mesh_fixed.data", "mesh_variable.data"}, str(files))
    for number, (damage, name) in enumerate((
            ("truncated", "mesh_variable.data"), ("flipped", "mesh_variable.data"),
            ("flipped", "mesh"), ("flipped", "common.bin"),
            ("flipped", "manifest.json"), ("missing", "mesh.info"))):
        directory = copy(interrupted, f"damage_{number}")
        victim = newest(directory) / name
        content = bytearray(victim.read_bytes())
        damage = f"{name} {damage}"
        if damage.endswith("truncated"):
            victim.write_bytes(content[:-100])
        elif damage.endswith("missing"):
            victim.unlink()
        else:
            place = random.Random(number).randrange(len(content))
            content[place] ^= 1 << random.Random(number).randrange(8)
            victim.write_bytes(content)
        code, error = execute(directory, settings, more=["--resume"])
        check(code in (0, 3) and "damaged" in error
              and f"checkpoint/{newest(interrupted).name}" in error,
              f"{damage}: {code} {error}")
        check(times_resumed(directory) == 1, damage)
        check(newest(interrupted).name + ".damaged" in
              {path.name for path in (directory / "checkpoint").iterdir()},
              f"{damage}: it is set aside")
        check_same_bytes(whole, Results(directory), damage)
    directory = copy(interrupted, "damage_all")
    for path in (directory / "checkpoint").iterdir():
        (path / "common.bin").write_bytes(b"nothing")
    code, error = execute(directory, settings, more=["--resume"])
    check(code == 4 and "no checkpoint" in error and error.count("damaged") == 2,
          f"nothing left: {code} {error}")
    check(len(checkpoints(directory)) == 2, "nothing is renamed in vain")


def test_edited_table():
    """Rows behind the checkpoint are cut off, others must be those of the run."""
    settings, whole = kept_march()
    interrupted = copy(whole.directory, "edited")
    (interrupted / "summary.json").unlink()
    # lip.csv is written anew, when a run ends.
    before = {path.name: path.read_bytes() for path in interrupted.glob("*.csv")
              if path.name != "lip.csv"}
    for table, content in before.items():
        place = len(content) // 2
        changed = content[:place] + bytes([content[place] ^ 1]) + content[place + 1:]
        (interrupted / table).write_bytes(changed)
        code, error = execute(interrupted, settings, more=["--resume"])
        check(code == 4 and f"/{table} was changed since checkpoint" in error
              and "Restore it" in error, f"{table}: {code} {error}")
        check((interrupted / table).read_bytes() == changed, f"{table} is left alone")
        (interrupted / table).write_bytes(content[:place])
        code, error = execute(interrupted, settings, more=["--resume"])
        check(code == 4 and f"/{table} has lost rows since checkpoint" in error
              and f"it has {place} bytes instead of" in error, f"{table}: {code} {error}")
        (interrupted / table).write_bytes(content)
    with open(interrupted / "periods.csv", "a") as file:
        file.write("a note\n")
    check_same_bytes(whole, finish(interrupted, settings), "restored")


def test_full_disk():
    """Without room for its checkpoints a run goes on, and says so."""
    settings, whole = kept_march()
    directory = fresh("full_disk")

    def limit_files():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (2 ** 20, 2 ** 20))

    process = subprocess.run(command(directory, settings), env=ENVIRONMENT,
                             stdin=subprocess.DEVNULL, capture_output=True,
                             text=True, timeout=PATIENCE, preexec_fn=limit_files)
    check(process.returncode in (0, 3)
          and "no checkpoint was written" in process.stderr,
          f"{process.returncode} {process.stderr}")
    check(not any((directory / "checkpoint").iterdir()), "nothing is left over")
    check_same_bytes(whole, Results(directory), "full disk")


def test_other_format():
    """Of another version of the program: told, and left alone."""
    settings, whole = kept_march()
    directory = copy(whole.directory, "format")
    (directory / "summary.json").unlink()
    manifest = newest(directory) / "manifest.json"
    content = re.sub(r'"format": \d+', '"format": 999',
                     manifest.read_text().split("\n", 1)[1])
    manifest.write_text(f"{zlib.crc32(content.encode())}\n{content}")
    before = checkpoints(directory)
    code, error = execute(directory, settings, more=["--resume"])
    check(code == 4 and "version" in error and "damaged" not in error,
          f"another format: {code} {error}")
    check(checkpoints(directory) == before, "left alone")


def check_refused(directory, settings, what, *lines):
    code, error = execute(directory, settings + [
        "Material/Poisson ratio=0.31", "Time integration/Scheme=euler",
        "Title=Another title", "Linear solver/Type=mumps"], more=["--resume"])
    check(code == 2, f"{what}: {code} {error}")
    for line in (*lines, '[Material] Poisson ratio: was "0.2", is "0.31"',
                 '[Time integration] Scheme: was "heun", is "euler"'):
        check(line in error, f"{what}: {line}\n{error}")
    check("Title" not in error and "Linear solver" not in error, error)


def test_other_scenes():
    """Of a run that has ended, with checkpoints or without, or that has not."""
    settings, whole = kept_march()
    directory = copy(whole.directory, "scenes")
    check_refused(directory, settings, "ended")
    (directory / "summary.json").unlink()
    check_refused(directory, settings, "not ended")
    directory = copy(whole.directory, "scenes_without_checkpoints")
    shutil.rmtree(directory / "checkpoint")
    check_refused(directory, settings, "ended, no checkpoint")
    code, error = execute(copy(whole.directory, "spelled"), settings + [
        "Geometry/Subdivisions=24,24", "Loads/Traction=0.0;10.*sin( 2*pi*t/6e2 )",
        "Output/Probes=mouth:1.0,0 ; inside: 75e-2, 0"], more=["--resume"])
    check(code == 0, f"numbers and blanks in another spelling: {code} {error}")
    check_refused(directory, settings + ["Output/Probes=mouth: 1, 0; inside: 0.7, 50"],
                  "another number", '[Output] Probes: was "mouth: 1, 0; inside: 0.75, 0"')


def test_finished():
    settings, kept = kept_march()
    whole = Results(copy(kept.directory, "finished"))
    scene = whole.summary["scene"]
    check(scene["Material"]["Poisson ratio"] == "0.2", json.dumps(scene))
    before = (whole.directory / "periods.csv").read_bytes()
    code, error = execute(whole.directory, settings, more=["--resume"])
    check(code == 0, f"nothing to do: {code} {error}")
    check((whole.directory / "periods.csv").read_bytes() == before, "untouched")
    # No table of the run, though it looks like one.
    (whole.directory / "notes.csv").write_text("mine\n")
    (whole.directory / "folder.csv").mkdir()
    longer = settings + ["Periodic state/Maximum periods=11"]
    code, error = execute(whole.directory, longer, more=["--resume"])
    check(code in (0, 3), f"longer: {code} {error}")
    at_once, _ = reference("longer", longer)
    check_same_bytes(at_once, whole, "more periods")
    check((whole.directory / "notes.csv").read_text() == "mine\n", "kept")
    tables = json.loads((newest(whole.directory) / "manifest.json")
                        .read_text().split("\n", 1)[1])["tables"]
    check(set(tables) == {"probe_mouth.csv", "probe_inside.csv", "contact.csv",
                          "periods.csv"}, str(tables))
    file = whole.directory / "summary.json"
    summary = json.loads(file.read_text())
    for name, value, words in (("periods", "many", "is not a summary that a run writes"),
                               ("scene", None, "does not hold the scene")):
        file.write_text(json.dumps({**summary, name: value}))
        code, error = execute(whole.directory, longer, more=["--resume"])
        check(code == 4 and words in error, f"{name}: {code} {error}")
    code, error = execute(fresh("nowhere"), settings, more=["--resume"])
    check(code == 4 and "--resume" in error, f"nothing there: {code} {error}")


@full
def test_other_solvers():
    """A run may go on with other solvers, which keep other things."""
    solvers = ("condensed active set", "active set", "projected sor")
    for first in solvers:
        for other in tier((solvers[0],), solvers):
            directory = fresh("solvers")
            for solver, n, more in ((first, 2, []), (other, 3, ["--resume"])):
                settings = [f"Contact/Solver={solver}", *periods(n),
                            "Geometry/Subdivisions=14, 4",
                            "Periodic state/Tolerance=1e-9"]
                code, error = execute(directory, settings, more=more)
                check(code == 3, f"{first} and {other}: {code} {error}")
            check(times_resumed(directory) == 1, f"{first} and {other}")
            if (first, other) == (solvers[0], solvers[0]):
                expected = Results(directory).table("contact.csv")["force"]
            found = Results(directory).table("contact.csv")["force"]
            check_below(max(abs(a - b) for a, b in zip(expected, found))
                        / max(expected), 1e-8, f"{first}, then {other}: force")


@full
def test_out_of_periods():
    """What ends without a periodic state can be gone on with."""
    for method in tier(("anderson",), ("march", "anderson")):
        settings = COMMON + REDISTRIBUTES + [
            f"Periodic state/Method={method}", "Periodic state/Tolerance=1e-12"]
        whole, _ = reference("periods_whole", settings + periods(6))
        directory = fresh("periods")
        code, error = execute(directory, settings + periods(4))
        check(code == 3 and "--resume" in error and len(checkpoints(directory)) == 1,
              f"{method}: {code} {error}")
        code, error = execute(directory, settings + periods(6),
                              more=["--resume"])
        check(code == 3 and times_resumed(directory) == 1,
              f"{method}, resumed: {code} {error}")
        check_same_bytes(whole, Results(directory), f"{method}, more periods")
    sizes = []
    for steps in (40, 80):
        directory = fresh("steps")
        execute(directory, COMMON + periods(1) + [
            "Periodic state/Tolerance=1e-12", f"Time integration/Steps per period={steps}",
            "Output/Fields=none"])
        sizes.append(sum(path.stat().st_size for path in newest(directory).iterdir()))
    check(sizes[1] < 1.05 * sizes[0], f"bytes with 40 and 80 steps: {sizes}")


@full
def test_ends():
    """After every number of periods, and of periods between checkpoints, a run that
    has ended is resumed with more of them; so is one that ends where its mesh would be
    adapted next, or that converged and is to be more accurate. Without anything left
    to compute it writes its last rows again."""
    every = "Output/Checkpoint every={}".format
    tolerance = "Periodic state/Tolerance={}".format
    stages = ["Refinement/Readapt every=3"]
    ends = [(case, [every(n)], last, last + 2, []) for case, numbers in tier(
                {"march": (2,), "anderson": (1,)},
                {case: (1, 2, 3) for case in CASES if case not in (
                    "harmonic balance", "readapted")}).items()
            for n in numbers for last in tier((2,), (1, 2, 3))]
    ends += [("readapted", stages + [tolerance(1e-12)], 3, 6, []),
             ("readapted", stages + [every(3)], 6, 7, [])]
    ends += [(case, [every(3), tolerance(1e-2)], 8, 8, [tolerance(1e-5)])
             for case in tier(("march",), ("march", "anderson"))]
    # A body without a load, whose error is exactly 0, still has all its periods.
    ends += [("march", [every(3), "Loads/Traction=", tolerance(1e-2)], 6, 7, [tolerance(0)])]
    for case, settings, last, more, other in ends:
        what = f"{case}, {settings[-1]}, {last} and {more} periods"
        settings = COMMON + CASES[case] + settings
        whole = served_run(fresh("ends_whole"), settings + periods(more) + other)
        ended = served_run(fresh("ends"), settings + periods(last))
        n = ended.summary["periods"]
        for after in (f"{n} periods", "the end"):
            served_run(ended.directory, settings + periods(more) + other, "--resume")
            check_same_bytes(whole, ended, f"{what}, resumed after {after}")
            (ended.directory / "summary.json").unlink()


def served_run(directory, settings, *more):
    """Of the server, which takes less time to start."""
    before = times_resumed(directory)
    code, _, error = served(SCENE, "--quiet", "--output", directory, *more,
                            *overrides(settings))
    check(code in (0, 3) and times_resumed(directory) == before + len(more),
          f"{directory}: {code} {error}")
    return Results(directory)


def test_begun_anew():
    """Not by mistake where there is something to go on with."""
    settings, whole = kept_march()
    directory = copy(whole.directory, "anew")
    (directory / "summary.json").unlink()
    code, error = execute(directory, settings)
    check(code == 2 and "--resume" in error and str(directory) in error,
          f"the same scene: {code} {error}")
    check(checkpoints(directory) == checkpoints(whole.directory), "left alone")
    code, error = execute(directory, settings + periods(1))
    check(code in (0, 3) and checkpoints(directory) == {1}
          and checkpoints(directory / "earlier_1"),
          f"another scene: {code} {error}")


def begin_long(name):
    """A run of the march that will not end by itself, in its first steps."""
    settings = COMMON + periods(100000)
    directory = fresh(name)
    arguments = [word for word in command(directory, settings)
                 if word != "--quiet"]
    process = subprocess.Popen(arguments, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=True,
                               stdin=subprocess.DEVNULL, env=ENVIRONMENT)
    wait_for(directory, 5, process)
    return process, directory


def test_two_runs():
    """A directory is one run's as long as that goes on."""
    process, directory = begin_long("two_runs")
    code, error = execute(directory, COMMON + ["Title=Another"])
    check(code == 4 and "Another run" in error
          and f"process {process.pid}" in error, f"{code} {error}")
    (directory / "stop").touch()
    process.communicate(timeout=PATIENCE)
    check(process.returncode == 5, f"the first one: {process.returncode}")
    code, error = execute(directory, COMMON + periods(1))
    check(code in (0, 3), f"afterwards: {code} {error}")


def test_nobody_listens():
    """The run is worth more than the pipe that its log goes to."""
    process, directory = begin_long("pipe")
    process.stdout.close()
    log = directory / "log.txt"
    wait_until(lambda: "standard output" in log.read_text(), process)
    (directory / "stop").touch()
    process.wait(timeout=PATIENCE)
    log = log.read_text()
    check(process.returncode == 5 and "standard output" in log
          and "--resume continues" in log, f"{process.returncode}\n{log}")


for test in (test_two_runs, test_nobody_listens, test_out_of_periods, test_ends,
             test_begun_anew, test_interruptions, test_signals, test_kills, test_damage,
             test_edited_table, test_full_disk, test_other_format, test_other_scenes,
             test_other_solvers, test_finished, test_ranks):
    test()
