# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Writes advised.prm, advice.md and advice.json."""

import itertools
import json
import math
import os
import textwrap

from crevasse.command import write_file


def write(directory, advice):
    """Writes advised.prm, advice.md and advice.json, each as a whole."""
    for name, text in (("advised.prm", scene(advice)), ("advice.md", markdown(advice)),
                       ("advice.json", json.dumps(data(advice), indent=2) + "\n")):
        write_file(directory / name, text)


def changes(advice):
    """Rows (parameter, value before, value now) for each changed parameter."""
    for name, now in advice.advised.items():
        before = advice.scene.get(name, "")
        if before != now and "/" in name:
            section, parameter = name.rsplit("/", 1)
            yield f"[{section}] {parameter}", before, now


def measured(advice):
    best = advice.best
    if best.reference is None:
        return (f"Its error is estimated as {best.error:.2g}: there is no finer run to "
                "compare with.")
    return (f"Its error, measured against {best.reference.name}, is {best.error:.2g}"
            + ("." if advice.reached else ", more than requested."))


def scene(advice):
    """Text of advised.prm: it includes the original scene, sets what differs, and says
    in a comment how it came about."""
    words = [f"{advice.scene_file.name} with the settings that crevasse advise has "
             f"found for an error of {advice.target:g} in "
             f"{', '.join(advice.errors.quantities)}: {advice.choice}.",
             measured(advice), "Body and loads are unchanged."]
    lines = [f"# {line}" for text in words for line in textwrap.wrap(text, 77)]
    path = os.path.relpath(advice.scene_file, advice.directory)
    # Statements have single blanks, and a .prm file cannot include a .json file.
    if not path.endswith(".prm") or "#" in path or path != " ".join(path.split()):
        return "\n".join(lines) + "\n\n" + advice.used
    return "\n".join([*lines, "", f"include {path}", *own_lines(advice)]) + "\n"


def own_lines(advice):
    """Lines of advised.prm that differ from the scene, each with the reason."""
    for section, group in itertools.groupby(
            own_settings(advice), lambda setting: setting[0].rpartition("/")[0]):
        blanks = "  " if section else ""
        yield ""
        if section:
            yield f"subsection {section}"
        for name, value, why in group:
            yield f"{blanks}set {name.rpartition('/')[2]} = {value}  # {why}"
        if section:
            yield "end"


def own_settings(advice):
    """Settings (parameter, value, reason) of advised.prm, in the order of the sections.
    Files that lie beside the original scene get a path from advised.prm."""
    given = {"/".join(" ".join(part.split()) for part in name.split("/"))
             for name in advice.overrides}
    for name, now in advice.advised.items():
        before = advice.scene.get(name, "")
        if before != now:
            yield name, now, f"was {before or 'empty'}"
        elif os.path.isabs(now) and os.path.isfile(now):
            yield name, os.path.relpath(now, advice.directory), "the file of the scene"
        elif name in given:
            yield name, now, "--set of the command line"


def conclusion(advice):
    """Last lines of the log: the advice, its error and its costs."""
    yield ("Advice: " if advice.reached else "Nearest: ") + advice.choice
    yield "  " + measured(advice)
    text = f"  It takes {advice.best.run.seconds:.2g} s of CPU time."
    own, error = advice.own, advice.own_error
    if own.has_results:
        text += f" The scene's own settings take {own.seconds:.2g} s"
        if error is not None and math.isfinite(error):
            text += f" and have an error of {error:.2g}"
        text += "." if own.usable else f" ({own.status})."
    yield text
    if not own.has_results:
        yield f"  The scene with its own settings: {own.status}: {own.message}"
    for name in advice.errors.left_out:
        yield f"  {name} does not count: it does not converge (advice.md)."
    yield (f"  scene: {advice.directory}/advised.prm; evidence: advice.md and "
           "advice.json there")


def table(header, rows):
    lines = [header, ["---"] * len(header), *rows]
    return "".join("| " + " | ".join(map(str, line)) + " |\n" for line in lines)


def costs(run):
    return (f"{run.unknowns:.0f}", f"{run.costs.get('vi_solves', 0):.0f}",
            f"{run.seconds:.2g}")


def markdown(advice):
    best, errors = advice.best, advice.errors
    parts = [f"# Settings of {advice.scene_file.name} for an error of "
             f"{advice.target:g}\n"]
    if not advice.reached:
        parts.append("**The error is not reached.** These settings come nearest:\n")
    parts += [advice.choice + "\n", measured(advice) + "\n",
              table(["parameter", "was", "is"], changes(advice))]
    if best.reference:
        differences = errors.differences(best.run, best.reference)
        parts.append(table(
            ["quantity", "difference from the reference"],
            [(name, "left out" if name in errors.left_out
              else f"{differences[name]:.2g}") for name in errors.quantities]))
    if best.shared:
        parts.append(f"To the largest of these {best.shared:.2g} is added, the "
                     "estimated error that the settings and the reference share.\n")
    parts.append("Differences are relative to the largest value of the quantity, over "
                 + ("the last period. Displacements and openings are compared without "
                    "their mean values: a constant depends on how the periodic state is "
                    "found.\n"
                    if errors.periodic else "all instants that two runs share.\n")
                 + "Seconds are CPU time.\n")
    rows = [(finalist.run.name + " (chosen)" * (finalist.run is best.run),
             f"{finalist.error:.2g}", *costs(finalist.run))
            for finalist in advice.pairs.finalists]
    if advice.own:
        error = advice.own_error
        rows.append(("the scene as it was", advice.own.status, "", "", "")
                    if not advice.own.has_results else
                    ("the scene as it was", "" if error is None else
                     f"{error:.2g}" if math.isfinite(error) else
                     "no instants in common", *costs(advice.own)))
    parts += ["## Runs of both parts together\n",
              table(["run", "error", "unknowns", "VIs", "seconds"], rows)]
    for heading, search in (("Errors in time, on a coarse mesh", advice.time),
                            ("Errors in space, with the same steps", advice.space)):
        parts += [f"## {heading}\n", table(
            ["candidate", "estimated error", "unknowns", "VIs", "seconds"],
            [(point.candidate.text + " (reference)" * (point is search.reference),
              f"{point.error:.2g}", *costs(point.run)) for point in search.points])]
    notes = advice.time.notes + advice.space.notes
    if notes:
        parts.append("## Notes\n\n" + "".join(f"- {note}\n" for note in notes))
    return "\n".join(parts)


def known(number):
    """A number for JSON, which has no infinity: None if it is not finite."""
    return number if number is not None and math.isfinite(number) else None


def data(advice):
    best, errors = advice.best, advice.errors
    found = {
        "scene": str(advice.scene_file), "target": advice.target,
        "reached": advice.reached, "choice": advice.choice,
        "error": known(best.error), "seconds": best.run.seconds, "run": best.run.name,
        "errors": {name: known(value) for name, value in errors.differences(
            best.run, best.reference).items()} if best.reference else {},
        "reference": best.reference.name if best.reference else None,
        "changes": {name: {"was": before, "is": now}
                    for name, before, now in changes(advice)},
        "periodic_state": errors.periodic, "counts": errors.counting(),
        "left_out": sorted(errors.left_out),
        "finalists": [{"run": finalist.run.name, "error": known(finalist.error),
                       "reference": finalist.reference.name if finalist.reference
                       else None, "costs": finalist.run.costs}
                      for finalist in advice.pairs.finalists],
        "notes": advice.time.notes + advice.space.notes}
    for part in ("time", "space"):
        found[part] = [{"candidate": point.candidate.text, "run": point.run.name,
                        "estimated_error": known(point.error),
                        "costs": point.run.costs}
                       for point in getattr(advice, part).points]
    if advice.own:
        found["original"] = {"status": advice.own.status,
                             "error": known(advice.own_error),
                             "costs": advice.own.costs}
    return found
