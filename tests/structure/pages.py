"""The pages of the documentation, without the program: each is reachable from
README.md, links lead somewhere, pictures are shown and small, sources that are named
exist, the walk-throughs are patches that fit the source, nothing misleads Doxygen, and
messages that doc/troubleshooting.md quotes are the program's, and all name one
version."""

import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(sys.argv[1]).resolve()
LARGEST_PICTURE = 200_000  # bytes
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md",
         *sorted((ROOT / "doc").glob("*.md"))]


def prose(path):
    return re.sub(r"^```.*?^```$", "", path.read_text(), flags=re.M | re.S)


def links(path):
    for target in re.findall(r"\]\(([^)\s]+)\)", prose(path)):
        if "://" not in target:
            yield (path.parent / target.split("#")[0]).resolve()


def broken_links():
    for path in PAGES:
        for target in links(path):
            if not target.exists():
                yield f"{path.name}: there is no {target}"


def unused_or_large_pictures():
    shown = {target for path in PAGES for target in links(path)}
    for path in sorted((ROOT / "doc").rglob("*.png")):
        if path not in shown:
            yield f"{path.name}: no page shows it"
        if path.stat().st_size > LARGEST_PICTURE:
            yield f"{path.name}: has more than {LARGEST_PICTURE // 1000} kB"


def missing_sources():
    """Named with their folder, as time/heun.cc or tests/runs/bars.py."""
    there = {"/" + path.relative_to(ROOT).as_posix()
             for folder in ("source", "include", "tests", "doc", "prm")
             for path in (ROOT / folder).rglob("*")}
    for path in PAGES:
        named = {name for words in re.findall(r"`([^`]+)`", prose(path))
                 for name in re.findall(r"[\w./-]+/\w+\.(?:cc|h|py|prm)\b", words)}
        for name in sorted(named):
            made_up = re.search("NAME|/X/y|^DIR/|^results/", name)
            if not made_up and not any(file.endswith("/" + name) for file in there):
                yield f"{path.name}: there is no {name}"


def unreachable_pages():
    reached, to_do = set(), [PAGES[0]]
    while to_do:
        path = to_do.pop()
        reached.add(path)
        to_do += set(links(path)) & set(PAGES) - reached
    for path in set(PAGES) - reached:
        yield f"{path.name} is not reachable from README.md"


def patches_that_do_not_fit():
    for path in PAGES:
        if path.name.startswith("extend_"):
            result = subprocess.run(["git", "apply", "--check", path], cwd=ROOT,
                                    capture_output=True, text=True)
            if result.returncode != 0:
                yield f"{path.name}: {result.stderr}"


def graphs_for_doxygen():
    """It takes the dot over a symbol for the beginning of a graph, even in
    code, and what follows up to the end of the page for its text."""
    for path in PAGES:
        if re.search(r"\\dot\b", path.read_text()):
            yield f"{path.name}: has the command \\dot"


def texts_of_program():
    """The string literals of the sources, neighbours joined, with something
    unlike any text between them."""
    for path in (*(ROOT / "source").rglob("*.cc"),
                 *(ROOT / "include").rglob("*.h")):
        literals = re.findall(r'((?:"(?:[^"\\\n]|\\.)*"\s*)+)',
                              path.read_text())
        for literal in literals:
            yield re.sub(r'"\s*"', "", literal).strip()[1:-1]


def unknown_messages():
    """In the first columns of the tables, and what is long in the second ones."""
    texts = "\n".join(texts_of_program()).replace('\\"', '"')
    path = ROOT / "doc/troubleshooting.md"
    quotes = [quote for row in prose(path).splitlines() if row.startswith("|")
              for column, cell in enumerate(row.split("|")[1:3])
              for quote in re.findall(r"`([^`]+)`", cell)
              if column == 0 or len(quote.split()) > 4]
    if len(quotes) < 30:
        yield f"{path.name}: only {len(quotes)} messages found"
    for quote in quotes:
        if quote not in texts:
            yield f"{path.name}: the program does not say: {quote}"


def other_versions():
    """CMake's is that of --version, the packages and the library."""
    def found(name, pattern):
        return re.findall(pattern, (ROOT / name).read_text(), flags=re.M)

    version, = found("CMakeLists.txt", r"project\(crevasse VERSION ([\d.]+)")
    minor = version.rpartition(".")[0]
    named = {"CITATION.cff": found("CITATION.cff", r"^version: ([\d.]+)"),
             "CHANGELOG.md": found("CHANGELOG.md", r"^## ([\d.]+)")[:1]}
    for path in PAGES:
        named[path.name] = found(path, r"^Crevasse ([\d.]+): |crevasse_([\d.]+)_amd64")
        libraries = found(path, r"find_package\(crevasse ([\d.]+)")
        named[f"library of {path.name}"] = [
            version if library == minor else library for library in libraries]
    for name, versions in named.items():
        for other in {"".join(other) for other in versions} - {version}:
            yield f"{name}: version {other}, which is {version} in CMakeLists.txt"


found = [*broken_links(), *unused_or_large_pictures(), *missing_sources(),
         *unreachable_pages(), *patches_that_do_not_fit(), *graphs_for_doxygen(),
         *unknown_messages(), *other_versions()]
print("\n".join(found) or "All pages are in order.")
sys.exit(1 if found else 0)
