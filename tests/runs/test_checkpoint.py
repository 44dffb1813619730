"""Interrupted runs that are resumed end like uninterrupted ones: byte for byte on
as many ranks, else to 1e-10. Damaged checkpoints are recognised, scenes that differ
are refused."""

import random
import shutil

from crevasse_run import check, check_below
from interrupted_runs import (CASES, COMMON, check_same_bytes, execute, finish,
                              fresh, interrupt, largest_difference, reference)

WAYS = ["SIGTERM", "SIGINT", "stop file", "wall time", "checkpoint and kill"]
DICE = random.Random(1980)


def newest(directory):
    return max((path for path in (directory / "checkpoint").iterdir()
                if path.name.isdigit()), key=lambda path: int(path.name))


def rows(results):
    return len(results.table("probe_mouth.csv")["t"])


def test_interruptions():
    for number, (name, extra) in enumerate(CASES.items()):
        settings = COMMON + extra
        whole, seconds = reference(f"{name} whole".replace(" ", "_"), settings)
        directory = fresh(name.replace(" ", "_"))
        codes = []
        for leg in range(2):
            way = WAYS[(2 * number + leg) % len(WAYS)]
            moment = (DICE.uniform(0.2, 0.5) * seconds if way == "wall time" else
                      int((leg + DICE.uniform(0.1, 0.9)) / 2 * rows(whole)))
            code, error = interrupt(directory, settings, way, moment)
            check(code in (0, 3, 5, -9), f"{name}: {way}: {code} {error}")
            codes.append(f"{way} at {moment}: {code}")
            if (directory / "summary.json").exists():
                break
        check_same_bytes(whole, finish(directory, settings), f"{name}, {codes}")


def test_kills():
    settings = COMMON + CASES["anderson"] + ["Output/Checkpoint every=1"]
    whole, _ = reference("kills_whole", settings)
    for seed in range(3):
        directory = fresh(f"kill_{seed}")
        interrupt(directory, settings, "SIGKILL",
                  random.Random(seed).randrange(rows(whole)))
        check_same_bytes(whole, finish(directory, settings), f"kill {seed}")


def test_ranks():
    for name in ("anderson", "readapted", "crack tip"):
        settings = COMMON + CASES[name] + ["Contact/Tolerance=1e-13"]
        whole, _ = reference("ranks_whole", settings)
        other = finish(fresh("ranks_other"), settings, 2)
        directory = fresh("ranks")
        codes = [interrupt(directory, settings, "stop file",
                           int(share * rows(whole)), n_ranks)[0]
                 for n_ranks, share in ((1, 0.3), (2, 0.6))]
        check(5 in codes, f"{name}: {codes}")
        resumed = finish(directory, settings, 1 if name == "anderson" else 3)
        # Solves are accepted within what rounding leaves on any ranks.
        usual = largest_difference(whole, other)
        check_below(largest_difference(whole, resumed), max(1e-10, 3 * usual),
                    f"{name}: ranks 1, 2 and others, {codes}; "
                    f"without interruption {usual:.1e}")


def test_damage():
    settings = COMMON + CASES["march"] + ["Output/Checkpoint every=2"]
    whole, _ = reference("damage_whole", settings)
    check([path.name for path in sorted(
        (whole.directory / "checkpoint").iterdir())] == ["2", "3"],
        "the last two checkpoints are kept")
    # As if it had been killed in its last period.
    interrupted = fresh("damage")
    shutil.copytree(whole.directory, interrupted)
    (interrupted / "summary.json").unlink()
    for number, damage in enumerate(("truncated", "flipped", "manifest",
                                     "missing")):
        directory = fresh(f"damage_{damage}")
        shutil.copytree(interrupted, directory)
        victim = newest(directory) / ("manifest.json" if damage == "manifest"
                                      else "fields_0.bin")
        content = bytearray(victim.read_bytes())
        if damage == "truncated":
            victim.write_bytes(content[:-100])
        elif damage == "missing":
            victim.unlink()
        else:
            place = random.Random(number).randrange(len(content))
            content[place] ^= 1 << random.Random(number).randrange(8)
            victim.write_bytes(content)
        code, error = execute(directory, settings, more=["--resume"])
        check(code in (0, 3) and "damaged" in error
              and f"checkpoint/{newest(interrupted).name}" in error,
              f"{damage}: {code} {error}")
        check("resumed from" in (directory / "log.txt").read_text(), damage)
        check_same_bytes(whole, type(whole)(directory), damage)
    directory = fresh("damage_all")
    shutil.copytree(interrupted, directory)
    for path in (directory / "checkpoint").iterdir():
        (path / "common.bin").write_bytes(b"nothing")
    code, error = execute(directory, settings, more=["--resume"])
    check(code == 4 and "no checkpoint" in error and error.count("damaged") == 2,
          f"nothing left: {code} {error}")


def test_other_scenes():
    settings = COMMON + CASES["march"] + ["Output/Checkpoint every=2"]
    whole, _ = reference("scenes", settings)
    (whole.directory / "summary.json").unlink()
    code, error = execute(whole.directory, settings + [
        "Material/Poisson ratio=0.31", "Time integration/Scheme=euler",
        "Title=Another title", "Linear solver/Type=mumps"], more=["--resume"])
    check(code == 2, f"refused: {code} {error}")
    for line in ('[Material] Poisson ratio: was "0.2", is "0.31"',
                 '[Time integration] Scheme: was "heun", is "euler"'):
        check(line in error, f"{line}\n{error}")
    check("Title" not in error and "Linear solver" not in error, error)


def test_finished():
    settings = COMMON + CASES["march"] + ["Output/Checkpoint every=2"]
    whole, _ = reference("finished", settings)
    before = (whole.directory / "periods.csv").read_bytes()
    code, error = execute(whole.directory, settings, more=["--resume"])
    check(code == 0, f"nothing to do: {code} {error}")
    check((whole.directory / "periods.csv").read_bytes() == before, "untouched")
    longer = settings + ["Periodic state/Maximum periods=11"]
    code, error = execute(whole.directory, longer, more=["--resume"])
    check(code in (0, 3), f"longer: {code} {error}")
    at_once, _ = reference("longer", longer)
    check_same_bytes(at_once, whole, "more periods")
    code, error = execute(fresh("nowhere"), settings, more=["--resume"])
    check(code == 4 and "--resume" in error, f"nothing there: {code} {error}")


for test in (test_interruptions, test_kills, test_damage, test_other_scenes,
             test_finished, test_ranks):
    test()
