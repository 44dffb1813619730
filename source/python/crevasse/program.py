# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Runs scenes. The program is loaded once, as a server that forks for each run
(source/app/server.h has its language); several may be under way at a time."""

import contextlib
import dataclasses
import json
import math
import os
import pathlib
import re
import select
import shutil
import signal
import subprocess
import tempfile
import time

from crevasse.command import CommandError
from crevasse.results import at, read_summary

# mpirun starts the runs if it started this process. They must not inherit its
# variables.
OF_MPIRUN = re.compile(r"PMIX_|ORTE_|OMPI_(COMM|UNIVERSE|APP|FIRST|NUM|FILE|ARGV|"
                       r"COMMAND)|OMPI_MCA_(orte|ess|pmix|shmem|initial|mpi_)")
PACKAGE = pathlib.Path(__file__).absolute().parent
WARNING = re.compile(r"^crevasse: warning: .*\n?", re.M)
# Of the summary; the counters have names of their own.
COSTS = {"unknowns": ("unknowns",), "periods": ("periods",),
         **{name: ("counters", name) for name in (
             "vi_solves", "linear_solves", "factorisations", "rate_evaluations")},
         "seconds": ("seconds", "total"),
         "seconds_time_stepping": ("seconds", "time stepping"),
         "processor_seconds": ("processor_seconds",),
         "peak_memory_bytes": ("peak_memory_bytes",)}


class Call:
    """A run of the program with one command line, under way as long as it has no
    status: a negative status is minus the number of the signal that ended it."""

    def __init__(self):
        self.files = [tempfile.TemporaryFile() for _ in range(2)]
        self.status = self.process = self.folder = None
        self.seconds = 0.  # CPU time

    @property
    def output(self):
        return self.text(self.files[0])

    @property
    def error(self):
        return self.text(self.files[1])

    def text(self, file):
        file.seek(0)
        return file.read().decode(errors="replace")

    def terminate(self):
        if self.process and self.status is None:
            # It may have ended; the answer with its status is on the way.
            with contextlib.suppress(ProcessLookupError):
                os.kill(self.process, signal.SIGTERM)


class Server:
    """The server that forks the runs. It ends with this process, and so do its runs."""

    def __init__(self, program, environment=None):
        # Of this process; it knows no other environment.
        ends = os.environ.pop("CREVASSE_SERVER", "")
        if ends and environment is None:
            requests, self.answers = map(int, ends.split(","))
            self.requests = os.fdopen(requests, "wb")
            os.set_inheritable(requests, False)
            os.set_inheritable(self.answers, False)
        else:
            self.process = subprocess.Popen(
                [program, "serve"], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                env=environment)
            self.requests = self.process.stdin
            self.answers = self.process.stdout.fileno()
        self.calls, self.n_calls, self.rest = {}, 0, b""

    def start(self, words, **options):
        """Starts a run with these words; options are "directory", "seconds",
        "unset"."""
        call = Call()
        self.n_calls += 1
        self.calls[self.n_calls] = call
        output, error = (f"/proc/{os.getpid()}/fd/{file.fileno()}"
                         for file in call.files)
        self.requests.write(json.dumps(
            {"id": self.n_calls, "arguments": list(map(str, words)),
             "output": output, "error": error, **options}).encode() + b"\n")
        self.requests.flush()
        return call

    def wait(self, *calls, seconds=None):
        """Waits until one of the calls has ended, or for some seconds."""
        while all(call.status is None for call in calls):
            if not select.select([self.answers], [], [], seconds)[0]:
                return
            part = os.read(self.answers, 1 << 16)
            if not part:
                raise CommandError("the process that runs the scenes has ended.", 4)
            *lines, self.rest = (self.rest + part).split(b"\n")
            for answer in map(json.loads, lines):
                if answer["id"] is None:
                    raise CommandError("a request to run a scene cannot be read.", 2)
                if "process" in answer:
                    self.calls[answer["id"]].process = answer["process"]
                else:
                    ended = self.calls.pop(answer["id"])
                    ended.status, ended.seconds = answer["status"], answer["cpu"]


class Program:
    """Starts the program as often as necessary, and hands requests to stop on to it."""

    def __init__(self, stop, environment=None):
        self.stop = stop
        self.path = find_program()
        self.ranks = int(os.environ.get("OMPI_COMM_WORLD_SIZE", 1))
        self.of_mpirun = list(filter(OF_MPIRUN.match, os.environ))
        self.server = Server(self.path, environment)

    def start(self, *words):
        self.stop.check()
        return self.server.start(words, unset=self.of_mpirun)

    def finish(self, *calls, show_progress=lambda: None):
        """The first of the calls that ends; all end if a stop is requested."""
        while True:
            ended = [call for call in calls if call.status is not None]
            if any(call.status == 5 for call in ended) and not self.stop.asked():
                self.stop.name = "--wall-time"  # with some time left
            if len(ended) == len(calls) or ended and not self.stop.asked():
                break
            if self.stop.asked():
                for call in calls:
                    call.terminate()
            self.server.wait(*(call for call in calls if call.status is None),
                             seconds=0.2)
            show_progress()
        for call in ended:
            if call.folder:
                shutil.rmtree(call.folder / "checkpoint", ignore_errors=True)
        self.stop.check()
        return ended[0]

    def run_parallel(self, words):
        """Runs the program on as many processes as mpirun has started of this one."""
        self.stop.check()
        call = Call()
        process = subprocess.Popen(
            [*mpirun(self.ranks), self.path, *map(str, words)],
            stdin=subprocess.DEVNULL,
            stdout=call.files[0], stderr=call.files[1], start_new_session=True,
            env={name: value for name, value in os.environ.items()
                 if name not in self.of_mpirun})
        while call.status is None:
            try:
                call.status = process.wait(0.2)
            except subprocess.TimeoutExpired:
                if self.stop.asked():
                    process.terminate()
        return call

    def start_parameters(self, scene, texts):
        return self.start(scene, *options(texts), "--print-parameters", "prm")

    def finish_parameters(self, call):
        """The text of used.prm, if the scene is in order."""
        if self.finish(call).status:
            raise CommandError(message_of(call), max(call.status, 2))
        return call.output

    def parameters(self, scene, settings):
        return self.finish_parameters(
            self.start_parameters(scene, assignments(settings)))

    def compute(self, *arguments):
        """Result of a run, with the arguments of begin()."""
        return self.outcome(self.finish(self.begin(*arguments)))

    def begin(self, scene, texts, folder, *words):
        """Starts a run whose results replace those in the folder."""
        # A later --set replaces an earlier one; fields of many runs fill disks.
        words = (scene, *options(["Output/Fields=none", *texts]), "--output", folder,
                 "--force", "--quiet", *["--no-bars"] * ("--bars" not in words), *words)
        if self.stop.end < math.inf:
            words += "--wall-time", max(self.stop.end - time.monotonic(), 1e-3)
        call = self.start(*words) if self.ranks == 1 else self.run_parallel(words)
        call.folder = folder
        return call

    def outcome(self, call):
        message, folder = message_of(call), call.folder
        if call.status == 4:
            raise CommandError(message, 4)
        summary, _ = read_summary(folder / "summary.json")
        # A run writes used.prm when nothing is wrong with its scene and its step.
        status = ("done" if call.status == 0 else
                  "refused" if call.status > 0 and not (folder / "used.prm").exists() else
                  "not converged" if summary.get("converged") is False else "failed")
        return Outcome(status, message.replace(" and continue by --resume", ""),
                       costs_in(summary), call.status, warnings_in(summary))


@dataclasses.dataclass
class Outcome:
    status: str  # done, not converged, refused, failed
    message: str
    costs: dict
    exit_status: int = 0
    warnings: list = dataclasses.field(default_factory=list)

    @property
    def has_results(self):
        return self.status in ("done", "not converged")


def find_program():
    """Path of the program: from the environment, which the program sets for its
    scripts; beside this package in a build or an installation; or from PATH."""
    if named := os.environ.get("CREVASSE_PROGRAM"):
        return named
    for place in ("../../crevasse", "../../../../bin/crevasse"):
        # By the names: in a build the folder python is a link.
        path = os.path.normpath(PACKAGE / place)
        if os.path.isfile(path) and os.access(path, os.X_OK):
            return path
    if path := shutil.which("crevasse"):
        return path
    raise CommandError(f"The program crevasse is neither in a build or an installation "
                       f"around {PACKAGE} nor on PATH. Set the environment variable "
                       "CREVASSE_PROGRAM to its file.", 4)


def mpirun(processes):
    """The words before those of the program for a run on several processes."""
    return [] if processes == 1 else [
        "mpirun", "--oversubscribe", "--bind-to", "none", "--mca",
        "mpi_yield_when_idle", "1", "-np", str(processes)]


def assignments(settings):
    """Arguments --set for {"Section/Name": value}."""
    return [f"{name}={value}" for name, value in settings.items()]


def options(texts):
    return [word for text in texts for word in ("--set", text)]


def message_of(call):
    """The last message of a run, before those of mpirun."""
    message = WARNING.sub("", call.error).split("\n" + 20 * "-")[0].strip()
    if not message and call.status < 0:
        return f"ended by {signal.Signals(-call.status).name}"
    return message.removeprefix("crevasse: ")


def warnings_in(summary):
    """Warnings of a run, except that [Output] Field times is not used: the package
    itself sets Fields = none."""
    return [text for text in summary.get("warnings", ())
            if not text.startswith("[Output] Field times")]


def without_numbers(text):
    """A warning without its numbers, by which warnings of one kind are known."""
    return re.sub(r"\d+(\.\d*)?(e[-+]?\d+)?", "#", text)


def costs_in(summary):
    """Costs in a summary by their names in tables; missing ones are left out."""
    return {name: value for name, path in COSTS.items()
            if (value := at(summary, path)) is not None}
