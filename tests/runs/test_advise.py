"""Advice: what it chooses has the error asked for, against a run that knows nothing
of it; the advised scene runs; nothing is computed twice; what cannot be done is reported;
ranks do not matter."""

import json
import pathlib
import re
import shutil

from bars import BAR
from crevasse_run import (SOURCE, check, check_below, execute, execute_on, full,
                          overrides, run, tier)

TARGET = 1e-2
SCENE = "plate.prm"
# A plate without a crack that bends and creeps, beside a side that is held.
pathlib.Path(SCENE).write_text(
    BAR.replace("0; 10*sin", "0; 10*x*sin")
    .replace("top: 0.5, 1", "top: 0.5, 1; inside: 0.5, 0.5"))
SETTINGS = overrides(["Material/Viscosity=relaxation time",
                      "Material/Relaxation time=200", "Boundary/Clamped=0",
                      "Boundary/Fixed points=none",
                      "Periodic state/Maximum periods=2"])


def advise(name, *arguments, status=0, scene=SCENE, fresh=True, ranks=0):
    directory = pathlib.Path("results") / name
    if fresh:
        shutil.rmtree(directory, ignore_errors=True)
    words = ("advise", scene, "--output", directory, *arguments)
    code, output, error = execute_on(ranks, *words) if ranks else execute(*words)
    check(code == status, f"{name}: exit status {code} instead of {status}\n"
                          + output + error)
    return directory, output, error


def largest_difference(one, other):
    """Of u and s of both probes at the instants of the first, relative."""
    worst = 0.
    for probe in ("top", "inside"):
        mine = one.table(f"probe_{probe}.csv")
        theirs = other.table(f"probe_{probe}.csv")
        rows = [min(range(len(theirs["t"])),
                    key=lambda j: abs(theirs["t"][j] - t)) for t in mine["t"]]
        check(all(abs(theirs["t"][j] - t) < 1e-6
                  for j, t in zip(rows, mine["t"])), "no common instants")
        for kind in "us":
            columns = [name for name in mine if name.startswith(kind + "_")]
            size = max(abs(x) for name in columns for x in theirs[name])
            worst = max(worst, *(abs(mine[name][i] - theirs[name][j]) / size
                                 for name in columns
                                 for i, j in enumerate(rows)))
    return worst


def test_target():
    directory, output, _ = advise("target", "--error", TARGET, *SETTINGS)
    print(output)
    advice = json.loads((directory / "advice.json").read_text())
    check(advice["reached"] and advice["error"] <= TARGET, "not reached")
    check(advice["counts"] and not advice["left_out"], "all probes count")

    advised = run(directory / "advised.prm", "advised")
    reference = run(SCENE, "reference", [
        *SETTINGS[1::2], "Geometry/Refinements=5", "Discretisation/Degree=2",
        "Time integration/Scheme=rk4", "Time integration/Steps per period=40"])
    check_below(largest_difference(advised, reference), TARGET,
                "error of the advised scene")
    original = json.loads((directory / "runs/original/finished.json").read_text())
    check(original["status"] == "done", "the scene as it was is run too")
    for changed in ("Geometry", "Material", "Loads", "Boundary", "Output"):
        check(not any(name.startswith(f"[{changed}]")
                      and name != "[Geometry] Refinements"
                      for name in advice["changes"]), f"{changed} was changed")
    text = (directory / "advised.prm").read_text()
    check(text.startswith("# plate.prm with the settings") and
          "advise" in text.splitlines()[0], text[:200])
    # It has nothing but what differs from the file, and is the same scene.
    check("include ../../plate.prm\n" in text and len(text.splitlines()) < 35
          and "set Relaxation time = 200  # --set of the command line" in text
          and re.search(r"set Steps per period = \d+  # was \d+", text), text)
    changes = [f"{name[1:].replace('] ', '/')}={change['is']}"
               for name, change in advice["changes"].items()]
    same = [execute(scene, *words, "--print-parameters", "prm")[:2]
            for scene, words in ((SCENE, SETTINGS + overrides(changes)),
                                 (directory / "advised.prm", ()))]
    check(same[0] == same[1] and same[0][0] == 0, "another scene is advised")
    check("(chosen)" in (directory / "advice.md").read_text(), "advice.md")


@full
def test_again():
    """The same answer from what is there, on two ranks too."""
    first = json.loads(pathlib.Path("results/target/advice.json").read_text())
    def times():
        return {path: path.stat().st_mtime_ns
                for path in pathlib.Path("results/target/runs").glob("*/*")}
    for ranks in (0, 2):
        before = times()
        directory, output, _ = advise("target", "--error", TARGET, *SETTINGS,
                                      fresh=False, ranks=ranks)
        check(times() == before, "computed again")
        check(json.loads((directory / "advice.json").read_text()) == first,
              "another answer")
        check("(already there)" in output, output)


@full
def test_files():
    """The mesh lies beside the scene, not beside advised.prm. A scene in JSON cannot be
    included."""
    shutil.copy(SOURCE / "tests/meshes/edge_crack_2.msh", "plate.msh")
    words = ("--error", "0.1", *SETTINGS, "--set", "Boundary/Clamped=1", "--set",
             "Boundary/Loaded=3", "--set", "Periodic state/Maximum periods=1")
    status, printed, error = execute(
        SCENE, *words[2:], "--set", "Geometry/Shape=mesh file", "--set",
        "Geometry/Mesh file=plate.msh", "--print-parameters", "json")
    check(status == 0, error)
    scene = json.loads(printed)
    scene["Geometry"]["Mesh file"] = "plate.msh"
    path = pathlib.Path("meshed.json")
    path.write_text(json.dumps(scene))
    directory, _, _ = advise("meshed", *words[:2], scene=path)
    check("include" not in (directory / "advised.prm").read_text(), "includes JSON")
    run(directory / "advised.prm", "advised_json")
    path = path.with_suffix(".prm")
    path.write_text("\n".join(
        line for section, values in scene.items() if isinstance(values, dict)
        for line in (f"subsection {section}", *(
            f"set {name} = {value}" for name, value in values.items()), "end")))
    directory, _, _ = advise("meshed", *words[:2], scene=path)
    check("set Mesh file = ../../plate.msh" in (directory / "advised.prm").read_text(),
          "the mesh")
    run(directory / "advised.prm", "advised_prm")


def test_stop():
    _, _, error = advise("stopped", "--error", TARGET, *SETTINGS, "--wall-time",
                         "0.001", status=5)
    check("repeat the command to continue" in error, error)
    seconds, finished = 0.01, []
    while not finished:
        seconds *= 2  # on any machine it stops between two of some thirty runs
        directory, _, error = advise("stopped", "--error", TARGET, *SETTINGS,
                                     "--wall-time", str(seconds), status=5)
        check("--wall-time" in error, error)
        finished = list(directory.glob("runs/*/finished.json"))


def test_refusals():
    for arguments, status, *messages in (
            (("--error", "2"), 2, "not an allowed relative error"),
            (("--error", "1e-14"), 2, "not an allowed relative error", "1e-8"),
            (("--error", "0.1", "--quantities", "probe_tap/u"), 2,
             "--quantities probe_tap/u", "probe_top"),
            (("--error", "0.1", "--quantities", "stress"), 2, "mesh to mesh"),
            (("--error", "0.1", "--quantities", "contact/closed_nodes"), 2,
             "mesh to mesh"),
            (("--error", "0.1", "--quantities", ","), 2, "is not a quantity"),
            (("--error", "0.1", "--quantities", "crack_tip/K_I"), 2,
             "Stress intensity"),
            ((), 2, "--error"),
            (("--error", "0.1", "--set", "Output/Probes="), 2, "Output/Probes",
             "no probes"),
            (("--error", "0.1", "--set", "Periodic state/Maximum periods=0"), 2,
             "Maximum periods = 0"),
            (("--error", "0.1", "--set", "Material/Youngs=3"), 2, "Young")):
        _, output, error = advise("refused", *arguments, status=status)
        for message in messages:
            check(message in output + error, f"{message}?\n{output}{error}")
    check(not pathlib.Path("results/refused").exists(), "computed something")
    code, output, _ = execute("advise", "--help")
    check(code == 0 and "advised.prm" in output and "--error" in output, output)


@full
def test_explicit_steps_fail_on_finer_meshes():
    """Creep by a power law: explicit steps that suit the coarsest mesh fail on all
    others, where the stress at the tip is larger. Other steps find an advice."""
    scene = pathlib.Path("creep.prm")
    scene.write_text(BAR.replace("rectangle", "edge crack").replace("2, 2", "14, 4")
                     .replace("top: 0.5, 1", "mouth: 1, 0"))
    error = tier(0.1, 0.05)
    directory, output, _ = advise(
        "creep", "--error", error, "--quantities", "probe_mouth/u", *overrides([
            "Material/Young modulus=1000", "Material/Viscosity=power law",
            "Material/Creep exponent=3", "Material/Creep coefficient=1e-6",
            "Loads/Period=1", "Loads/Traction=0; 10*sin(2*pi*t)+1"]), scene=scene)
    advice = json.loads((directory / "advice.json").read_text())
    check(advice["reached"] and advice["error"] <= error
          and not advice["choice"].partition("; ")[2].startswith(("heun", "rk4")),
          output)
    check("heun: on finer meshes it fails" in (directory / "advice.md").read_text(),
          "why there are no explicit steps")


@full
def test_first_is_refused():
    """Explicit steps of a tenth of the period are too long for this material."""
    directory, output, _ = advise("fast", "--error", TARGET, *SETTINGS, "--set",
                                  "Material/Relaxation time=10")
    check("refused" in output, output)
    check(json.loads((directory / "advice.json").read_text())["reached"], output)


def test_quantities():
    """Only what is named has to have the error."""
    directory, _, _ = advise("quantities", "--error", "0.05", "--quantities",
                             "probe_top/u", *SETTINGS)
    advice = json.loads((directory / "advice.json").read_text())
    check(advice["reached"] and advice["counts"] == ["probe_top/u"]
          and advice["errors"]["probe_top/u"] <= 0.05, f"{advice['errors']}")
    check("| probe_top/u |" in (directory / "advice.md").read_text(), "its error")
    check("0.05 in probe_top/u:" in (directory / "advised.prm").read_text(),
          "what it is good for")

    for name in ("probe_top/opening", "probe_inside/u_3"):
        _, _, error = advise("not_written", "--error", "0.05", "--quantities", name,
                             *SETTINGS, status=2)
        check(f"--quantities {name}: the scene does not write it" in error, error)
        runs = list(pathlib.Path("results/not_written/runs").iterdir())
        check(len(runs) <= 2, f"found out late, after {len(runs)} runs")


@full
def test_nothing_moves():
    _, output, error = advise("unloaded", "--error", "0.05", *SETTINGS, "--set",
                              "Loads/Traction=0; 0", status=3)
    check("0 at all instants" in error, output + error)


@full
def test_coarse_cells_are_refused():
    """Around the tip there is no room for the integral: finer meshes are tried."""
    scene = pathlib.Path("tip.prm")
    scene.write_text(BAR.replace("rectangle", "edge crack").replace("2, 2", "4, 2"))
    directory, output, _ = advise(
        "tip", "--error", 0.05, "--quantities", "crack_tip/K_I", "--set",
        "Crack tip/Stress intensity=true", "--set",
        "Geometry/Crack length=0.75", scene=scene)
    check("q1_0__sdirk2_10__one_period" in output and "refused" in output, output)
    check("The scene with its own settings: refused" in output, output)
    advice = json.loads((directory / "advice.json").read_text())
    check(advice["reached"] and advice["errors"]["crack_tip/K_I"] <= 0.05,
          f"{advice['errors']}")


@full
def test_crack_tip():
    """The stress at a tip has no error that could be reached. The periodic state is
    looked for by what finds it."""
    scene = pathlib.Path("crack.prm")
    scene.write_text(BAR.replace("rectangle", "edge crack")
                     .replace("2, 2", "4, 2")
                     .replace("top: 0.5, 1", "tip: 0.5, 0; top: 0.5, 1"))
    directory, output, _ = advise("crack", "--error", 0.05, "--set",
                                  "Periodic state/Tolerance=0.1", scene=scene)
    print(output)
    advice = json.loads((directory / "advice.json").read_text())
    check(advice["left_out"] == ["probe_tip/s"] and advice["reached"],
          f"left out: {advice['left_out']}")
    check("probe_tip/s does not converge" in output, output)
    check(advice["periodic_state"] and
          float(advice["changes"]["[Periodic state] Tolerance"]["is"]) <= 0.0125,
          f"a tolerance that fits: {advice['changes']}")
    advised = run(directory / "advised.prm", "advised_crack")
    check(advised.summary["converged"], "the advised scene is periodic")


for test in (test_target, test_again, test_files, test_stop, test_refusals,
             test_explicit_steps_fail_on_finer_meshes, test_first_is_refused,
             test_quantities, test_nothing_moves,
             test_coarse_cells_are_refused, test_crack_tip):
    test()
