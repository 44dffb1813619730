# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The results folder of one run of a sweep. finished.json is written last, and is what
an interrupted sweep goes by: it holds the result and the sizes of all files, so that a
damaged folder counts as unfinished."""

import dataclasses
import itertools
import json
import shutil
import time

from crevasse.command import CommandError, write_file
from crevasse.program import Outcome
from crevasse.results import ResultsError, checksums, read_summary, same_scenes
from crevasse.sweep_errors import STRESS_FILE
from crevasse.wording import plural

# What a run cannot do without. The stress is only needed to compare with another
# reference, and its file knows its own size.
NEEDED = ("*.csv", "summary.json", "used.prm")
RESULTS = (*NEEDED, "solution*", "log.txt", "report.html", "checkpoint")


@dataclasses.dataclass
class Result(Outcome):
    findings: dict = dataclasses.field(default_factory=dict)  # read from its files
    bars: dict = dataclasses.field(default_factory=dict)  # likewise
    errors: dict = dataclasses.field(default_factory=dict)  # by quantities
    basis: str = ""  # what errors were measured against; if it changes, so do they

    @property
    def has_periods(self):
        """Whether a run has computed a period: only then it has tables."""
        return self.costs.get("periods", 0) > 0

    def as_json(self):
        return {"status": self.status, "message": self.message,
                "warnings": self.warnings,
                "errors": dict(sorted(self.errors.items())), "costs": self.costs,
                "compared with": self.basis}


class Folder:
    """Folder of a run, whose parameters show whether it is that of the point."""

    def __init__(self, path, used):
        self.path, self.used, self.begin_time = path, used, 0.
        self.inputs = checksums(used)

    def has_same_scene(self):
        try:
            return same_scenes((self.path / "used.prm").read_text(), self.used)
        except (OSError, ValueError, ResultsError):
            return False

    def finished(self, with_bars=False):
        """The result of this very run; None if it is missing or damaged, if a file that
        the scene names has changed, or if error bars that are wanted are missing."""
        if not self.has_same_scene():
            return None
        try:
            kept = json.loads((self.path / "finished.json").read_text())
            if kept.get("inputs", {}) != self.inputs or any(
                    (self.path / name).stat().st_size != size
                    for name, size in kept["files"].items()):
                return None
            result = Result(kept["status"], kept["message"], kept["costs"],
                            warnings=kept.get("warnings", []), errors=kept["errors"],
                            basis=kept["compared with"])
            lacks_bars = (with_bars and result.has_results and
                          not read_summary(self.path / "summary.json")[0].get("bars"))
            return None if lacks_bars else result
        except (OSError, ValueError, KeyError, AttributeError):
            return None

    def prepare(self):
        """Empties the folder, but keeps the results of another scene in a folder beside
        them."""
        self.path.mkdir(parents=True, exist_ok=True)
        # First: from now on the folder is not finished.
        for name in ("finished.json", STRESS_FILE):
            (self.path / name).unlink(missing_ok=True)
        if not (self.path / "used.prm").exists():
            return  # what is there is no run's
        results = {path for pattern in RESULTS for path in self.path.glob(pattern)}
        is_kept = not self.has_same_scene() and any(
            path.name not in ("log.txt", "used.prm") for path in results)
        if is_kept:
            kept = next(kept for number in itertools.count(1) if not
                        (kept := self.path / f"earlier_{number}").exists())
            kept.mkdir()
        for path in results:
            if is_kept:
                path.rename(kept / path.name)
            elif path.is_dir():
                shutil.rmtree(path)
            else:
                path.unlink()

    def begin(self, program, scene, settings, *words):
        self.prepare()
        self.begin_time = time.monotonic()
        return program.begin(scene, settings, self.path, *words)

    def progress(self):
        """Progress of the run, such as "12 s, 3 periods"."""
        try:
            periods = (self.path / "periods.csv").read_text().count("\n") - 1
        except OSError:
            periods = 0
        return (f"{time.monotonic() - self.begin_time:.0f} s"
                + (f", {plural(periods, 'period')}" if periods > 0 else ""))

    def result(self, outcome):
        if not (self.path / "used.prm").exists():  # refused, or ended by a signal
            write_file(self.path / "used.prm", self.used)
        elif not self.has_same_scene():
            raise CommandError(f"{self.path}/used.prm differs from the scene: did the "
                               "scene change? Repeat the command.", 4)
        return Result(**vars(outcome))

    def finish(self, result):
        files = sorted({path for pattern in NEEDED for path in self.path.glob(pattern)})
        write_file(self.path / "finished.json", json.dumps(
            result.as_json() | {"inputs": self.inputs, "files": {path.name: path.stat().st_size
                                          for path in files}},
            indent=2, ensure_ascii=False) + "\n")
