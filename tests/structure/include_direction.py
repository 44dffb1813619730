"""Fails if a folder includes one that comes after it, or if a source file does
not mirror a header: doc/architecture.md has the order."""

import pathlib
import re
import sys

ORDER = ["base", "kernels", "temperature", "creep", "parameters", "material", "grid",
         "lip", "discretisation", "linear", "contact", "time", "model",
         "secular", "checkpoint", "harmonic_balance", "periodic", "crack_tip",
         "postprocess", "simulation", "app"]
INCLUDE = re.compile(r'#\s*include\s*[<"]crevasse/([^/>"]+)/')


def violations(root):
    files = sorted((root / "include" / "crevasse").rglob("*.h"))
    files += sorted((root / "source").rglob("*.cc"))
    if len(files) < 10:
        yield f"only {len(files)} files found under {root}: wrong folder?"
    for path in files:
        parts = path.relative_to(root).parts
        if parts == ("source", "main.cc"):
            continue  # knows everything
        folder = parts[-2]
        if folder not in ORDER:
            yield f"{path}: folder {folder} is not one of {', '.join(ORDER)}"
            continue
        for number, line in enumerate(path.read_text().splitlines(), 1):
            match = INCLUDE.match(line)
            if not match:
                continue
            if match[1] not in ORDER:
                yield f"{path}:{number}: unknown folder {match[1]}"
            elif ORDER.index(match[1]) > ORDER.index(folder):
                yield (f"{path}:{number}: {folder} must not include "
                       f"{match[1]}, which comes after it")
        if path.suffix == ".cc":
            # "parameters_check.cc" is a second part of "parameters.cc".
            names = (path.stem, path.stem.rsplit("_", 1)[0])
            folder_of_headers = root / "include" / "crevasse" / folder
            if not any((folder_of_headers / (name + ".h")).exists()
                       for name in names):
                yield f"{path}: mirrors no header in {folder_of_headers}"


found = list(violations(pathlib.Path(sys.argv[1])))
print("\n".join(found) or "All includes point in the allowed direction.")
sys.exit(1 if found else 0)
