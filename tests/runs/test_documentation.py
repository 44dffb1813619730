"""What the documentation tells a newcomer to type works as it stands there, and
prints what is shown: every command of README.md, doc/getting_started.md and
doc/tutorial.md, and the scenes of doc/scenes.md. doc/parameters.md is what the program prints, and
doc/output.md speaks of every column, key and array that runs write. The scripts that
draw the pictures find what they import."""

import functools
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

from crevasse_run import SOURCE, check, execute, full, run


def page(name):
    return (SOURCE / name).read_text()


SCENES = page("doc/scenes.md")
OUTPUT = page("doc/output.md")


def blocks(text, language):
    return re.findall(rf"^```{language}\n(.*?)^```$", text, re.M | re.S)


FIRST_SCENE, *_, OWN_MESH = blocks(SCENES, "prm")


def program_commands(text):
    """The arguments of each "build/crevasse ..." in blocks of shell commands
    and between backticks, with its exit status: that of a comment "status N",
    else 0."""
    lines = "".join(blocks(text, "sh")).splitlines()
    lines += re.findall(r"`([^`\n]+)`", re.sub(r"^```.*?^```$", "", text,
                                               flags=re.M | re.S))
    for line in lines:
        words = shlex.split(line, comments=True)
        if words and words[0] == "build/crevasse":
            status = re.search(r"# status (\d)", line)
            yield tuple(words[1:]), int(status[1]) if status else 0


@functools.lru_cache(maxsize=None)
def output_of(arguments, status):
    """Pages may have commands in common, which are run once."""
    code, output, error = execute(*arguments)
    print(*arguments, f": exit status {code}")
    check(code == status and (error == "" or status > 0),
          f"{arguments}: exit status {code} instead of {status}\n{error}")
    return output + error


def without_measurements(line):
    """Seconds and megabytes differ from run to run."""
    line = re.sub(r"memory: .*", "memory", line)
    return re.sub(r"[\d.e+-]+ s\b", "# s", line).strip()


def test_readme():
    """In a folder that has what the source tree has."""
    shutil.copytree(SOURCE / "prm", "prm", dirs_exist_ok=True)
    shutil.rmtree("results", ignore_errors=True)
    commands = list(program_commands(page("README.md")))
    check(len(commands) >= 6, f"README.md: only {len(commands)} commands found")
    for arguments, status in commands:
        output_of(arguments, status)
    for name in ("raous1980", "short_crack"):
        check((pathlib.Path("results") / name / "summary.json").exists(),
              f"there are no results of {name}")


def check_shown(name, least):
    """What the page shows is what is printed by its commands; at least so many
    lines."""
    text = page(name)
    printed = set()
    for arguments, status in program_commands(text):
        output = output_of(arguments, status)
        printed.update(map(without_measurements, output.splitlines()))
    shown = [line for block in blocks(text, "text")
             for line in map(without_measurements, block.splitlines())
             if line not in ("", "…")]
    check(len(shown) > least, f"{name}: lines of output are found")
    for line in shown:
        check(line in printed, f"{name}: not printed: {line}")


def test_getting_started():
    pathlib.Path("first.prm").write_text(FIRST_SCENE)
    check_shown("doc/getting_started.md", 30)


@full
def test_tutorial():
    """After test_readme, which copies prm/."""
    check_shown("doc/tutorial.md", 15)


def test_parameters():
    printed = execute("--print-parameters", "markdown")[1]
    check(printed == page("doc/parameters.md"),
          "doc/parameters.md is not what the program prints: build/crevasse "
          "--print-parameters markdown > doc/parameters.md")


def test_scenes_named():
    """Each scene file that the page names is there, and each one that is there
    is named."""
    named = set(re.findall(r"\bprm/[\w/]+\.prm", SCENES))
    there = {str(path.relative_to(SOURCE))
             for path in (SOURCE / "prm").rglob("*.prm")}
    check(named == there, f"doc/scenes.md and prm/ differ: {named ^ there}")


def test_first_scene():
    json, = blocks(SCENES, "json")
    pathlib.Path("first.prm").write_text(FIRST_SCENE)
    results = run(pathlib.Path("first.prm"), "first_prm")
    check(results.summary["converged"], "the first scene becomes periodic")
    pathlib.Path("first.json").write_text(json)
    others = run("first.json", "first_json")
    for name in ("probe_mouth.csv", "contact.csv"):
        check((results.directory / name).read_bytes()
              == (others.directory / name).read_bytes(),
              f"the scene and its JSON differ: {name}")
    pathlib.Path("first.prm").write_text(FIRST_SCENE)
    for arguments, status in program_commands(SCENES):
        output_of(arguments, status)
    check_described(results)


def test_own_mesh():
    """With material, load and output of the first scene the lip stays open in the
    periodic state, for the mean load is zero. Another load presses it."""
    mesh = pathlib.Path("tests/meshes/edge_crack_4.msh")
    mesh.parent.mkdir(parents=True, exist_ok=True)
    shutil.copy(SOURCE / mesh, mesh)
    scene = pathlib.Path("own_mesh.prm")
    scene.write_text(OWN_MESH + FIRST_SCENE[FIRST_SCENE.index("subsection Material"):])
    for settings, is_pressed in ((), False), (
            ["Loads/Traction=0; 10*sin(2*pi*t/600) - 3"], True):
        results = run(scene, "own_mesh", settings)
        n_closed = max(results.table("contact.csv")["closed_nodes"])
        check(n_closed == is_pressed * results.summary["contact_nodes"],
              f"{settings}: {n_closed} closed nodes")
    check(results.summary["contact_nodes"] > 0, "there is a lip")


# Runs that write all that there is to be written, all as small as can be.
SHORT = ["Periodic state/Maximum periods=2", "Periodic state/Tolerance=0",
         "Geometry/Subdivisions=8, 4"]
MEAN = ["Loads/Traction=0; 10*sin(2*pi*t/600)+1"]
KINDS = {
    "crack_tip": SHORT + MEAN + [
        "Geometry/Subdivisions=8, 8", "Discretisation/Degree=2",
        "Discretisation/Singular functions=2", "Output/Load work=true",
        "Crack tip/Stress intensity=true", "Crack tip/Crack growth law=sum",
        "Crack tip/Paris factor=1e-9", "Crack tip/Creep factor=1e-9"],
    "no_c_star": SHORT + [
        "Crack tip/Stress intensity=true", "Material/Viscosity=none"],
    "adaptive_mesh": [
        "Geometry/Subdivisions=4, 2", "Refinement/Strategy=adaptive",
        "Refinement/Target unknowns=300", "Refinement/Coarsen fraction=0.01",
        "Refinement/Readapt every=3", "Periodic state/Maximum periods=4",
        "Periodic state/Tolerance=0"],
    "harmonic_balance": MEAN + [
        "Geometry/Subdivisions=8, 4", "Periodic state/Method=fourier",
        "Time integration/Scheme=trapezoid"],
    "events": SHORT + [
        "Time integration/Step control=adaptive",
        "Time integration/Relative tolerance=1e-2",
        "Time integration/Locate contact events=true"],
    "arkode": SHORT + [
        "Time integration/Scheme=arkode explicit",
        "Time integration/Step control=adaptive",
        "Time integration/Relative tolerance=1e-2",
        "Time integration/Locate contact events=true"],
    "comparison": SHORT + [
        "Loads/Traction=0; -10*(1+sin(2*pi*t/600))",
        "Contact/Solver=projected sor", "Contact/Relaxation table=1.5, 1.8",
        "Output/Elastic comparison=closed"],
    "space": SHORT + [
        "Dimension=3", "Geometry/Subdivisions=4, 2, 2",
        "Loads/Traction=0; 10*sin(2*pi*t/600); 0",
        "Output/Probes=mouth: 1, 0, 0.5"],
    "multigrid": SHORT + [
        "Geometry/Subdivisions=2, 2", "Geometry/Refinements=2",
        "Linear solver/Type=gmg"]}


def test_all_kinds():
    output = "subsection Output\n  set Probes = mouth: 1, 0\nend\n"
    silent = {f"{item} ({name})" for name, settings in KINDS.items()
              for item in not_described(run(FIRST_SCENE + output, name, settings))}
    check(not silent, "doc/output.md does not explain\n"
          + "\n".join(sorted(silent)))


def keys_of(value, name=""):
    """The keys of a summary, at every depth; not the names of probes and of
    libraries, nor the parameters of the scene."""
    if isinstance(value, list):
        for item in value:
            yield from keys_of(item, name)
    elif isinstance(value, dict):
        for key, item in value.items():
            if name not in ("per_probe", "probes", "libraries"):
                yield key
            if key != "scene":
                yield from keys_of(item, key)


def array_name(name):
    """Components are named by their first one."""
    return re.sub(r"_(\d\d|[123])$", "", name)


# What doc/output.md has between backticks; lists are taken apart.
WORDS = {word for group in re.findall(r"`([^`]+)`", OUTPUT)
         for word in [group, *re.split(r"[,.]\s*", group)]}


def not_described(results):
    """The columns, keys, arrays and files of which doc/output.md is silent."""
    for path in results.directory.glob("*.csv"):
        for column in path.read_text().splitlines()[0].split(","):
            if column not in WORDS:
                yield f"{path.name}: {column}"
    yield from (f"summary.json: {key}" for key in keys_of(results.summary)
                if key not in WORDS)
    arrays = {array_name(word) for word in WORDS}
    for path in results.directory.glob("*.pvtu"):
        for name in re.findall(r'<PDataArray [^>]*Name="(\w+)"',
                               path.read_text()):
            if array_name(name) not in arrays:
                yield f"solution_<n>.pvtu: {name}"
    for path in results.directory.iterdir():
        name = re.sub(r"probe_\w+", "probe_<name>", path.name)
        name = re.sub(r"^solution_\d+(\.\d+)?\.",
                      lambda match: "solution_<n>." + ("<process>." if match[1]
                                                       else ""), name)
        if not WORDS & {name, name + "/"}:
            yield f"file {path.name}"


def check_described(results):
    silent = sorted(set(not_described(results)))
    check(not silent, f"doc/output.md does not explain {silent}")


def test_scripts_of_figures():
    scripts = [path for path in sorted((SOURCE / "doc/figures").glob("*.py"))
               if "def main" in path.read_text()]
    check(len(scripts) > 12, f"only {len(scripts)} scripts of figures found")
    for script in scripts:
        result = subprocess.run([sys.executable, script, "--help"], text=True,
                                capture_output=True)
        check(result.returncode == 0, f"{script.name}: {result.stderr}")


test_parameters()
test_scripts_of_figures()
test_scenes_named()
test_readme()
test_getting_started()
test_tutorial()
test_first_scene()
test_own_mesh()
test_all_kinds()
