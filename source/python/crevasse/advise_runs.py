# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The runs of an advice: each is computed once and stays on disk."""

import dataclasses
import hashlib
import json
import shutil

from crevasse.program import Outcome, assignments, without_numbers
from crevasse.results import checksums, normal_form

SOLVES_OF_A_FACTORISATION = 10


@dataclasses.dataclass
class Run(Outcome):
    name: str = ""  # its folder
    settings: dict = dataclasses.field(default_factory=dict)

    @property
    def usable(self):
        return self.status == "done"

    @property
    def unknowns(self):
        return self.costs.get("unknowns", 0)

    @property
    def seconds(self):
        """CPU time of a run, with the set-up of meshes: other work on the machine does
        not count."""
        return self.costs.get("processor_seconds", 0)

    @property
    def work(self):
        """Work of a run, in units of one solve, to compare steps on one mesh. Seconds
        of runs on coarse meshes are mostly set-up and noise."""
        return (self.costs.get("linear_solves", 0)
                + self.costs.get("rate_evaluations", 0)
                + SOLVES_OF_A_FACTORISATION * self.costs.get("factorisations", 0))


class Runs:
    """All runs of one scene, in their folders."""

    def __init__(self, program, scene, settings, directory, log, logs_warnings=True):
        self.program, self.scene, self.settings = program, scene, settings
        self.directory, self.log = directory, log
        self.logs_warnings = logs_warnings
        used = program.parameters(scene, settings)
        self.base = hashlib.sha256(
            f"{normal_form(used)}{checksums(used)}".encode()).hexdigest()
        self.known = {}
        self.warned = set()

    def folder(self, run):
        return self.directory / "runs" / run.name

    def run(self, name, settings):
        """The run with these settings, computed now unless its folder has it."""
        if name not in self.known:
            folder = self.directory / "runs" / name
            run = self.finished(folder, name, settings)
            there = " (already there)" if run else ""
            run = run or self.compute(folder, name, settings)
            self.known[name] = run
            costs = (f"{run.unknowns:8.0f} unknowns "
                     f"{run.costs.get('vi_solves', 0):7.0f} VIs {run.seconds:8.3f} s"
                     if run.usable else run.status)
            self.log(f"  {name:44} {costs}{there}")
            for warning in run.warnings if self.logs_warnings else ():
                if (kind := without_numbers(warning)) not in self.warned:
                    self.warned.add(kind)
                    self.log(f"  warning: {warning}")
        return self.known[name]

    def finished(self, folder, name, settings):
        """The run in a folder; None unless the folder has all results of this scene."""
        try:
            kept = json.loads((folder / "finished.json").read_text())
            if (kept["scene"], kept["settings"]) == (self.base, as_text(settings)):
                return Run(kept["status"], kept["message"], kept["costs"],
                           warnings=kept.get("warnings", []), name=name,
                           settings=settings)
        except (OSError, ValueError, KeyError):
            pass
        return None

    def compute(self, folder, name, settings):
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        run = Run(**vars(self.program.compute(
            self.scene, assignments(self.settings) + assignments(settings), folder)),
            name=name, settings=settings)
        (folder / "finished.json").write_text(json.dumps(
            {"scene": self.base, "settings": as_text(settings),
             "status": run.status, "message": run.message, "costs": run.costs,
             "warnings": run.warnings},
            indent=2) + "\n")
        return run


def as_text(settings):
    return {name: str(value) for name, value in settings.items()}
