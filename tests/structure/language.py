# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Fails where pages, scenes, messages or comments use a turn of phrase or a name
for which the project has a better one: the table below, left for right."""

import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1]).resolve()

# A pattern, and what to write instead. Blanks stand for any white space.
PHRASES = [
    (r"integrates it how well", "how accurate each scheme is"),
    (r"when to believe it", "when to trust it"),
    (r"(goes|go) on where it (was|is)", "resumes"),
    (r"(takes|taken|take|took) up", "resumes, resumed"),
    (r"rigid motions?( is| are)? left free", "unconstrained rigid-body motion"),
    (r"leaves 2\^?[-−]p of the error", "divides the error by 2^p"),
    (r"what is not said", "boundaries without a role"),
    (r"but for the crack lip", "except the crack lip"),
    (r"go on to shrink", "at the current rate"),
    (r"levels? wider apart", "non-uniform levels"),
    (r"(scene|it) calls for, and why", "active effects"),
    (r"parameters? other than the default", "non-default parameters"),
    (r"here of the run reference", "settings of the reference run"),
    (r"of these time stepping", "stepping (s)"),
    (r"of the processor", "CPU"),
    (r"is had for", "500 unknowns give 0.1 %"),
    (r"honest", "correct; correctly reported as failed"),
    (r"volume hardly changes", "nearly incompressible"),
    (r"without a matrix", "matrix-free"),
    (r"(is|are|was) (told|warned)( of| that)?", "is reported; causes a warning"),
    (r"hardly meant", "probably a mistake"),
    (r"swings? on", "oscillates instead of decaying"),
    (r"direct (in time|method)", "harmonic balance"),
    (r"periods of anderson", "Anderson iterations"),
]

NAMES = {
    "KeptRun": "CheckpointWriter", "StatePart": "SerializationScope",
    "Leg": "MeshStage", "Solvers": "ContactSystemCache",
    "Instants": "InstantProvider", "take_up": "resume",
    "goes_on": "is_continuing", "hand_over": "export_state",
    "those_who_pause": "checkpointer",
    "before_what_is_not_computed": "at_end_of_search", "Speaker": "MasterNode",
    "GivenMotion": "PrescribedMotion", "RememberedRate": "CachedRate",
    "Ending": "ConvergenceStatus", "judge_by_load": "set_force_scale",
    "let_opening_excuse": "ignore_drift_while_opening",
    "is_warm": "has_temperature", "expands": "has_thermal_expansion",
    "StressRecord": "StressReader", "StressSamples": "StressWriter",
    "tell": "report_...", "look": "on_...", "refuse": "throw_error",
    "survey": "validate_and_bound"}


def files():
    yield from (ROOT / "README.md", ROOT / "CONTRIBUTING.md")
    for folder, ends in (("doc", (".md", ".py")), ("prm", (".prm",)),
                         ("source", (".cc", ".py")), ("include", (".h",)),
                         ("tests", (".cc", ".h", ".py", ".prm"))):
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix in ends and path != pathlib.Path(__file__).resolve():
                yield path


def joined(text):
    """Without what separates the words of a comment or of a string literal that
    goes over several lines; offsets stay."""
    return re.sub(r'("\s*\n\s*"|\n\s*(///?|\*|#)?\s*)',
                  lambda match: " " * len(match[0]), text)


def violations():
    phrases = [(re.compile(r"\b" + phrase.replace(" ", r"\s+") + r"\b"), better)
               for phrase, better in PHRASES]
    names = re.compile(r"\b(" + "|".join(NAMES) + r")(?=\(|<|\s+&|::)")
    for path in files():
        text = path.read_text()
        for pattern, better in phrases:
            for match in pattern.finditer(joined(text)):
                yield path, text, match, better
        if path.suffix in (".cc", ".h"):
            for match in names.finditer(text):
                yield path, text, match, NAMES[match[1]]


found = [f"{path.relative_to(ROOT)}:{text.count(chr(10), 0, match.start()) + 1}: "
         f"\"{' '.join(match[0].split())}\": better: {better}"
         for path, text, match, better in violations()]
print("\n".join(found) or "No phrase or name that has a better one.")
sys.exit(1 if found else 0)
