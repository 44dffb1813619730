# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The runs of an advice: each is computed once and stays on disk."""

import dataclasses
import hashlib
import json
import math
import os
import re
import shutil
import signal
import subprocess
import time

# mpirun starts the runs if it started advise. They must not inherit its variables.
OF_MPIRUN = re.compile(r"PMIX_|ORTE_|OMPI_(COMM|UNIVERSE|APP|FIRST|NUM|FILE|ARGV|"
                       r"COMMAND)|OMPI_MCA_(orte|ess|pmix|shmem|initial|mpi_)")
ALONE = {"OMPI_MCA_ess_singleton_isolated": "1", "OMPI_MCA_pml": "ob1",
         "OMPI_MCA_btl": "self"}
SOLVES_OF_A_FACTORISATION = 10
COUNTERS = ("vi_solves", "linear_solves", "factorisations", "rate_evaluations")


class CommandError(Exception):
    """The message for the user and the exit status."""

    def __init__(self, message, status):
        super().__init__(message)
        self.status = status


class Stop:
    """A request to stop: a signal, a file "stop", or the end of the time."""

    def __init__(self, wall_time=None):
        self.end = time.monotonic() + wall_time if wall_time else math.inf
        self.file = None
        self.name = ""
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            if signal.getsignal(number) != signal.SIG_IGN:
                signal.signal(number, self.take)

    def take(self, number, _):
        self.name = signal.Signals(number).name

    def asked(self):
        if not self.name and time.monotonic() >= self.end:
            self.name = "--wall-time"
        if not self.name and self.file and self.file.exists():
            self.name = f"the file {self.file}"
            self.file.unlink()
        return self.name

    def check(self):
        if self.asked():
            raise CommandError(f"stopped on request ({self.name}). The finished runs "
                               "are kept: repeat the command to continue.", 5)


class Program:
    """Starts the program, on as many processes as advise was."""

    def __init__(self, path, stop):
        self.path, self.stop = path, stop
        self.ranks = int(os.environ.get("OMPI_COMM_WORLD_SIZE", 1))
        self.environment = {name: value for name, value in os.environ.items()
                            if not OF_MPIRUN.match(name)}
        if self.ranks == 1:
            self.environment = ALONE | self.environment

    def start(self, *words, ranks=1):
        """Exit status, standard output and error. A request to stop is handed on."""
        self.stop.check()
        parallel = ["mpirun", "--oversubscribe", "--bind-to", "none", "-np",
                    str(ranks)] if ranks > 1 else []
        process = subprocess.Popen(
            [*parallel, self.path, *map(str, words)], text=True, errors="replace",
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            env=self.environment, start_new_session=True)
        while True:
            try:
                output, error = process.communicate(timeout=0.2)
                break
            except subprocess.TimeoutExpired:
                if self.stop.asked():
                    process.terminate()
        self.stop.check()
        return process.returncode, output, error.strip().removeprefix("crevasse: ")

    def parameters(self, scene, settings):
        """The text of used.prm, if the scene is in order."""
        status, output, error = self.start(scene, *options(settings),
                                           "--print-parameters", "prm")
        if status:
            raise CommandError(error, status if status > 0 else 4)
        return output


def options(settings):
    return [word for name, value in settings.items()
            for word in ("--set", f"{name}={value}")]


@dataclasses.dataclass
class Run:
    name: str  # its folder
    settings: dict
    status: str  # done, not converged, refused, failed
    message: str
    costs: dict

    @property
    def usable(self):
        return self.status == "done"

    @property
    def has_results(self):
        return self.status in ("done", "not converged")

    @property
    def unknowns(self):
        return self.costs.get("unknowns", 0)

    @property
    def seconds(self):
        """CPU time with the set-up of meshes: other work on the machine does not
        count."""
        return self.costs.get("processor_seconds", 0)

    @property
    def work(self):
        """Compares steps on one mesh, in units of one solve. Seconds of runs on
        coarse meshes are mostly set-up and noise."""
        return (self.costs.get("linear_solves", 0)
                + self.costs.get("rate_evaluations", 0)
                + SOLVES_OF_A_FACTORISATION * self.costs.get("factorisations", 0))


class Runs:
    """All runs of one scene."""

    def __init__(self, program, scene, settings, directory, log):
        self.program, self.scene, self.settings = program, scene, settings
        self.directory, self.log = directory, log
        self.base = hashlib.sha256(
            program.parameters(scene, settings).encode()).hexdigest()
        self.known = {}

    def folder(self, run):
        return self.directory / "runs" / run.name

    def run(self, name, settings):
        """The run with these settings, computed now if it is not there yet."""
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
        return self.known[name]

    def finished(self, folder, name, settings):
        """None if the folder has not the whole results of this scene."""
        try:
            kept = json.loads((folder / "finished.json").read_text())
            if (kept["scene"], kept["settings"]) == (self.base, as_text(settings)):
                return Run(name, settings, kept["status"], kept["message"],
                           kept["costs"])
        except (OSError, ValueError, KeyError):
            pass
        return None

    def compute(self, folder, name, settings):
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        # A later --set replaces an earlier one; fields of many runs fill disks.
        status, _, error = self.program.start(
            self.scene, *options({"Output/Fields": "none"}), *options(self.settings),
            *options(settings), "--output", folder, "--force", "--quiet",
            ranks=self.program.ranks)
        if status == 4:
            raise CommandError(error, status)
        summary = read_summary(folder)
        # A run writes used.prm when nothing is wrong with its scene and its step.
        ending = ("done" if status == 0 else
                  "refused" if not (folder / "used.prm").exists() else
                  "not converged" if summary.get("converged") is False else "failed")
        run = Run(name, settings, ending, error, costs_in(summary))
        (folder / "finished.json").write_text(json.dumps(
            {"scene": self.base, "settings": as_text(settings),
             "status": run.status, "message": run.message, "costs": run.costs},
            indent=2) + "\n")
        return run


def as_text(settings):
    return {name: str(value) for name, value in settings.items()}


def read_summary(folder):
    try:
        return json.loads((folder / "summary.json").read_text())
    except (OSError, ValueError):
        return {}


def costs_in(summary):
    if not summary:
        return {}
    return {"unknowns": summary["unknowns"], "periods": summary["periods"],
            "processor_seconds": summary["processor_seconds"],
            "seconds": summary["seconds"]["total"],
            **{name: summary["counters"].get(name, 0) for name in COUNTERS}}
