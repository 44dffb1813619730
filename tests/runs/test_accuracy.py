"""crevasse SCENE --accuracy: true errors are below what is asked, tries are predicted and
not merely refined, and what cannot be reached is said."""

import os
import pathlib
import shutil

from crevasse_run import (PROGRAM, SOURCE, check, check_below, execute, execute_on, full,
                          overrides, tier)

os.environ["CREVASSE_PROGRAM"] = str(PROGRAM)
import crevasse  # noqa: E402

ELASTIC = SOURCE / "prm/studies/crack_tip_elastic.prm"
K_I, OPENING = 35.41196, 3.805445e-3  # doc/crack_tip.md
COARSE = ["Discretisation/Degree=1", "Discretisation/Singular functions=0",
          "Geometry/Subdivisions=8, 8"]
PRESSED = ["Loads/Traction=0; 10*sin(2*pi*t/600) - 3", "Periodic state/Tolerance=1e-4",
           "Contact/Solver=automatic", "Crack tip/Stress intensity=true",
           "Geometry/Subdivisions=8, 8", "Output/Fields=none",
           "Time integration/Scheme=sdirk2", "Time integration/Steps per period=20"]


def accurate(name, scene, wish, settings=(), *words, status=0, fresh=True, run=execute):
    directory = pathlib.Path("results") / name
    if fresh:
        shutil.rmtree(directory, ignore_errors=True)
    code, output, error = run(scene, "--accuracy", wish, "--output", directory,
                              *overrides(settings), *words)
    print(output + error)
    check(code == status, f"{name}: exit status {code}, not {status}")
    there = status == 0 or "The last try" in error
    return crevasse.read(directory) if there else None, output + error


def test_elastic():
    """From a coarse mesh without singular functions, and with a repeated command."""
    for wish in tier([1e-4], [1e-2, 1e-3, 1e-4, 1e-5]):
        for name, exact in (("K_I_largest", K_I), ("opening", OPENING)):
            results, _ = accurate("elastic", ELASTIC, wish, COARSE, "--for", name)
            bar = results.bars[name]
            check_below(bar["bar"] / exact, wish, "the bar")
            check_below(abs(bar["value"] / exact - 1.), 1.2 * wish, "the true error")
            tries = results.summary["accuracy"]["tries"]
            check(len(tries) <= 3 and tries[-1]["bar"] <= wish, f"{tries}")
            check(len(tries) == 1 or tries[-1]["bar"] > .2 * wish, f"too fine: {tries}")
            check(results.summary["unknowns"] == tries[-1]["unknowns"], "the last try")
    computed = {path: path.stat().st_mtime_ns
                for path in pathlib.Path("results/elastic/runs").glob("*/finished.json")}
    _, output = accurate("elastic", ELASTIC, wish, COARSE, "--for", "opening",
                         fresh=False)
    check(computed == {path: path.stat().st_mtime_ns for path in computed}, output)


@full
def test_corner():
    """A stress at a free corner vanishes, but not in elements: it is 0 within its bar."""
    results, output = accurate(
        "corner", ELASTIC, 1e-3, [*COARSE, "Output/Probes=C: 1, 0"],
        "--for", "probe C s", status=3)
    check("is not reached" in output and "0 within its bar" in
          results.summary["accuracy"]["why_not_reached"], output)


def test_oblong():
    """Companions of a scene with 14 times 4 cells have other proportions."""
    results, _ = accurate("oblong", SOURCE / "prm/raous1980.prm", 1.5e-3, [
        "Crack tip/Stress intensity=true", "Output/Fields=none"], "--for", "K_I")
    check_below(abs(results.bars["K_I_largest"]["value"] / K_I - 1.), 1.5e-3,
                "the true error")


@full
def test_steps():
    """Lists of steps and tolerances of steps are refined, as numbers of steps are."""
    exact, openings = 1.4305e-2, {}  # by an accuracy of 2e-4
    for name, settings in {
            "uniform": ["Time integration/Steps per period=20"],
            "list": ["Time integration/Step control=list", "Time integration/Steps="
                     + ", ".join(str(30 * k) for k in range(1, 20))],
            "adaptive": ["Time integration/Step control=adaptive",
                         "Time integration/Relative tolerance=0.05"]}.items():
        results, _ = accurate("steps_" + name, SOURCE / "prm/raous1980.prm", 1e-3, [
            "Output/Fields=none", "Geometry/Subdivisions=8, 8", *settings],
            "--for", "opening")
        openings[name] = results.bars["opening"]["value"]
    for name, value in openings.items():
        check_below(abs(value / exact - 1.), 1.2e-3, f"the true error, {name}")


def test_refusals():
    _, output = accurate("tip", ELASTIC, 1e-2, [*COARSE, "Output/Probes=tip: 0.5, 0"],
                         "--for", "probe tip s", status=3)
    check("no limit: beside a crack tip. Name other quantities" in output, output)
    for words, text in ((["--accuracy", "2"], "less than 1"),
                        (["--for", "K_I"], "--accuracy"),
                        (["--accuracy", "1e-2", "--resume"], "--resume"),
                        (["--accuracy", "1e-2", "--for", "K_J"], "but K_I_largest")):
        code, _, error = execute(ELASTIC, *words, "--output", "results/wrong")
        check(code == 2 and text in error, f"{words}: {code} {error}")


@full
def test_periodic():
    """Against a finer run: with contact, in time as well as in space."""
    results, _ = accurate("pressed", SOURCE / "prm/raous1980.prm", 1e-3, PRESSED)
    fine, _ = accurate("pressed_fine", SOURCE / "prm/raous1980.prm", 2e-5, PRESSED)
    parallel, _ = accurate("ranks", SOURCE / "prm/raous1980.prm", 1e-3, PRESSED,
                           run=lambda *words: execute_on(2, *words))
    exact, *found = (one.bars["K_I_largest"]["value"]
                     for one in (fine, results, parallel))
    for value in found:
        check_below(abs(value / exact - 1.), 1.2e-3, "the true error")


test_elastic()
test_oblong()
test_steps()
test_refusals()
test_corner()
test_periodic()
