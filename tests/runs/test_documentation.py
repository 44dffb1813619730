"""What the documentation tells a newcomer to type works as it stands there:
every command of README.md, and the scenes of doc/scenes.md."""

import pathlib
import re
import shlex
import shutil

from crevasse_run import SOURCE, check, execute, run

README = (SOURCE / "README.md").read_text()
SCENES = (SOURCE / "doc" / "scenes.md").read_text()
OUTPUT = (SOURCE / "doc" / "output.md").read_text()


def blocks(text, language):
    return re.findall(rf"^```{language}\n(.*?)^```$", text, re.M | re.S)


def program_commands(text):
    """The arguments of each "build/crevasse ..." in blocks of shell commands
    and between backticks."""
    lines = "".join(blocks(text, "sh")).splitlines()
    lines += re.findall(r"`([^`\n]+)`", re.sub(r"^```.*?^```$", "", text,
                                               flags=re.M | re.S))
    for line in lines:
        words = shlex.split(line, comments=True)
        if words and words[0] == "build/crevasse":
            yield words[1:]


def test_readme():
    """In a folder that has what the source tree has."""
    shutil.copytree(SOURCE / "prm", "prm", dirs_exist_ok=True)
    shutil.rmtree("results", ignore_errors=True)
    commands = list(program_commands(README))
    check(len(commands) >= 6, f"README.md: only {len(commands)} commands found")
    for arguments in commands:
        status, _, error = execute(*arguments)
        print(*arguments, f": exit status {status}")
        check(status == 0 and error == "", f"{arguments}:\n{error}")
    for name in ("raous1980", "short_crack"):
        check((pathlib.Path("results") / name / "summary.json").exists(),
              f"there are no results of {name}")


def test_scenes_named():
    """Each scene file that the pages speak of is there, and each one that is
    there is spoken of."""
    named = set(re.findall(r"prm/[\w/]+\.prm", README))
    there = {str(path.relative_to(SOURCE))
             for path in (SOURCE / "prm").rglob("*.prm")}
    check(named == there, f"README.md and prm/ differ: {named ^ there}")


def test_first_scene():
    (prm,), (json,) = blocks(SCENES, "prm"), blocks(SCENES, "json")
    results = run(prm, "first_prm")
    check(results.summary["converged"], "the first scene becomes periodic")
    pathlib.Path("first.json").write_text(json)
    others = run("first.json", "first_json")
    for name in ("probe_mouth.csv", "contact.csv"):
        check((results.directory / name).read_bytes()
              == (others.directory / name).read_bytes(),
              f"the scene and its JSON differ: {name}")
    pathlib.Path("first.prm").write_text(prm)
    for arguments in program_commands(SCENES):
        status, _, error = execute(*arguments)
        check(status == 0, f"{arguments}:\n{error}")
    check_described(results)


def check_described(results):
    """doc/output.md speaks of every column and key."""
    for path in results.directory.glob("*.csv"):
        for column in path.read_text().splitlines()[0].split(","):
            check(f"`{column}`" in OUTPUT, f"{path.name}: {column}?")
    for key in results.summary:
        check(re.search(rf"`{key}[`.]", OUTPUT), f"summary.json: {key}?")
    for name in ("solution.pvd", "used.prm", "log.txt"):
        check(f"`{name}`" in OUTPUT, f"{name}?")


test_scenes_named()
test_readme()
test_first_scene()
