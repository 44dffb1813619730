# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Changes one line of the numerics at a time and reports which changes (mutants)
no test of the default tier notices: doc/testing.md.

    python3 tests/mutation.py DIRECTORY [--count 100] [--seed 1] [--jobs 2]
    python3 tests/mutation.py DIRECTORY --table

DIRECTORY gets a clone of HEAD for each job, run.json (the commit and what each test
takes without a change) and mutants.jsonl (a line for each mutant that is done). The
same command resumes."""

import argparse
import collections
import concurrent.futures
import contextlib
import itertools
import json
import os
import pathlib
import queue
import re
import shutil
import signal
import subprocess

from mutants import FOLDERS, draw

SOURCE = pathlib.Path(__file__).resolve().parents[1]


class Copy:
    """A clone of the tree with a build directory, for one mutant at a time."""

    def __init__(self, tree, commit, n_cores):
        self.tree, self.process = tree, None
        self.build = ("cmake", "--build", "--preset", "test", "--parallel", str(n_cores))
        # The mutant before this one is undone at the cost of a look-up.
        self.environment = dict(
            os.environ, CCACHE_DIR=str(tree.parent / "ccache"), CCACHE_BASEDIR=str(tree),
            CCACHE_SLOPPINESS="pch_defines,time_macros")
        if shutil.which("ccache"):
            self.environment["CMAKE_CXX_COMPILER_LAUNCHER"] = "ccache"
        if shutil.which("mold"):  # all programs are linked for each mutant
            self.environment["LDFLAGS"] = "-fuse-ld=mold"
        tree.mkdir(parents=True, exist_ok=True)
        for command in (("init", "-q"), ("fetch", "-q", SOURCE, "HEAD"),
                        ("checkout", "-q", "--force", "-B", "mutants", commit)):
            subprocess.run(("git", *command), cwd=tree, check=True)

    def run(self, *command):
        """Exit status, CPU seconds with all processes, and what was printed."""
        with open(self.tree.with_suffix(".log"), "w+", errors="replace") as log:
            self.process = subprocess.Popen(
                command, cwd=self.tree, env=self.environment, stdin=subprocess.DEVNULL,
                stdout=log, stderr=log, start_new_session=True)
            _, status, usage = os.wait4(self.process.pid, 0)
            self.process.returncode = os.waitstatus_to_exitcode(status)
            self.end_processes()
            log.seek(0)
            return (self.process.returncode, usage.ru_utime + usage.ru_stime, log.read())

    def end_processes(self):
        """Of the last command; what it left behind in other sessions, too."""
        if self.process:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(self.process.pid, signal.SIGKILL)
        for link in pathlib.Path("/proc").glob("[0-9]*/exe"):
            with contextlib.suppress(OSError):
                if link.readlink().is_relative_to(self.tree / "build"):
                    os.kill(int(link.parent.name), signal.SIGKILL)

    def test(self, name, cpu_limit="unlimited"):
        """Under limits: a mutant may loop, or ask for all memory and disk space."""
        return self.run("prlimit", f"--cpu={cpu_limit}", "--data=6000000000",
                        "--fsize=1000000000", "--core=0", "ctest", "--test-dir", "build",
                        "--output-on-failure", "-R", f"^{re.escape(name)}$")

    def cost(self, name):
        """CPU seconds without a change; None for a test that fails twice."""
        trials = (self.test(name) for _ in range(2))
        return next((seconds for status, seconds, _ in trials if not status), None)

    def prepare(self):
        """The tree without a change."""
        self.end_processes()
        for command in (("cmake", "--preset", "default"), self.build):
            status, _, output = self.run(*command)
            if status:
                raise SystemExit(f"{self.tree} cannot be built:\n{output[-2000:]}")

    def names_of_tests(self):
        listed = self.run("ctest", "--test-dir", "build", "-LE", "full",
                          "-E", "^structure/", "--show-only=json-v1")[2]
        return [test["name"] for test in json.loads(listed)["tests"]]

    def judge(self, mutant, tests):
        """A record of what the tests make of a mutant: (name, CPU limit) in order."""
        path = self.tree / mutant.file
        text = path.read_text()
        lines = text.splitlines()
        lines[mutant.line - 1] = mutant.after
        record = dict(mutant._asdict(), outcome="survived", by="", seconds_tests=0.)
        path.write_text("\n".join(lines) + "\n")
        try:
            status, record["seconds_build"], output = self.run(*self.build)
            if status:
                return dict(record, outcome="does not compile", output=output[-1000:])
            for name, limit in tests:
                status, seconds, output = self.test(name, limit)
                record["seconds_tests"] += seconds
                if status:
                    return dict(record, outcome="killed", by=name,
                                timeout="***Timeout" in output, output=output[-3000:])
            return record
        finally:
            path.write_text(text)


def records(file):
    """Of the mutants that are done, one a line."""
    known = []
    for number, line in enumerate(file.read_text().splitlines()
                                  if file.exists() else (), 1):
        try:
            known.append(json.loads(line))
        except json.JSONDecodeError:
            raise SystemExit(f"{file}:{number} is cut off. Remove the line: its mutant "
                             "is judged again.") from None
    return known


class Run:
    """Copies that work side by side, and what is known so far."""

    def __init__(self, directory, seed):
        self.directory = directory.resolve()
        self.file, self.facts_file = (self.directory / name for name in (
            "mutants.jsonl", "run.json"))
        self.facts = (json.loads(self.facts_file.read_text())
                      if self.facts_file.exists() else
                      {"seed": seed, "tests": {}, "commit": subprocess.check_output(
                          ["git", "rev-parse", "HEAD"], cwd=SOURCE, text=True).strip()})
        self.records = records(self.file)
        self.copies, self.free = [], queue.Queue()

    def with_copy(self, function, *arguments):
        copy = self.free.get()
        try:
            return function(copy, *arguments)
        finally:
            self.free.put(copy)

    def measure(self, pool):
        names = self.copies[0].names_of_tests()
        self.facts["tests"] = dict(zip(names, pool.map(
            lambda name: self.with_copy(Copy.cost, name), names)))
        self.facts_file.write_text(json.dumps(self.facts, indent=1))

    def order(self, folder):
        """Tests with the CPU limit of their processes, likely killers first."""
        kills = collections.Counter()
        for record in self.records:
            kills[record["by"]] += 5 if f"/{folder}/" in record["file"] else 1
        tests = {name: s for name, s in self.facts["tests"].items() if s is not None}
        return [(name, int(20 + 8 * tests[name])) for name in sorted(
            tests, key=lambda name: (not name.startswith(f"unit/{folder}."),
                                     tests[name] / (1 + kills[name])))]

    def record(self, record):
        self.records.append(record)
        with open(self.file, "a") as file:
            file.write(json.dumps(record) + "\n")
        print(f"{len(self.records)} {record['file']}:{record['line']} {record['kind']}: "
              f"{record['outcome']} {record['by']} (build {record['seconds_build']:.0f} s, "
              f"tests {record['seconds_tests']:.0f} s)", flush=True)

    def prepare(self, jobs):
        """Copies of the tree without a change, built."""
        n_cores = max(1, os.cpu_count() // jobs)
        self.copies = [Copy(self.directory / f"copy_{i}", self.facts["commit"], n_cores)
                       for i in range(jobs)]
        for copy in self.copies:  # one by one: ccache may help the second
            copy.prepare()
            self.free.put(copy)

    def go(self, count, jobs):
        self.prepare(jobs)
        pool = concurrent.futures.ThreadPoolExecutor(jobs)
        if not self.facts["tests"]:
            self.measure(pool)
        done = {(record["file"], record["line"]) for record in self.records}
        mutants = iter([mutant for mutant in draw(self.copies[0].tree,
                                                  self.facts["seed"])
                        if (mutant.file, mutant.line) not in done])
        at_work = set()
        while True:
            counted = sum(record["outcome"] != "does not compile"
                          for record in self.records)
            n_free = min(len(self.copies), count - counted) - len(at_work)
            for mutant in itertools.islice(mutants, max(0, n_free)):
                at_work.add(pool.submit(
                    self.with_copy, Copy.judge, mutant,
                    self.order(mutant.file.split("/")[-2])))
            if not at_work:
                return
            ended, at_work = concurrent.futures.wait(
                at_work, return_when=concurrent.futures.FIRST_COMPLETED)
            for future in ended:
                self.record(future.result())


def as_code(line):
    return f"`{line.strip()}`".replace("|", "\\|")


def print_table(run):
    """As Markdown; survivors first, because they are what is to be read."""
    if not run.records:
        raise SystemExit(f"No mutant is done in {run.directory}.")
    mutants = [record for record in run.records if record["outcome"] != "does not compile"]
    print("| folder | mutants | killed | survived |\n|---|---|---|---|")
    for name in (*FOLDERS, "all"):
        outcomes = [record["outcome"] for record in mutants
                    if name in ("all", record["file"].split("/")[-2])]
        print("|", name, *(f"| {n}" for n in (len(outcomes), outcomes.count("killed"),
                                              outcomes.count("survived"))), "|")
    hours = sum(r["seconds_build"] + r["seconds_tests"] for r in run.records) / 3600
    failing = [name for name, seconds in run.facts["tests"].items() if seconds is None]
    print(f"\nCommit {run.facts['commit'][:9]}, seed {run.facts['seed']}; "
          f"{len(run.records) - len(mutants)} more do not compile; {hours:.1f} h of CPU "
          f"time. Failing without a change, left out: {', '.join(failing) or 'none'}.\n\n"
          "| line | before | after | outcome |\n|---|---|---|---|")
    for record in sorted(mutants, key=lambda r: (r["outcome"] != "survived", r["file"],
                                                 r["line"])):
        by = f" by `{record['by']}`" if record["by"] else ""
        late = ", ctest's time limit" if record.get("timeout") else ""
        print(f"| {record['file']}:{record['line']} | {as_code(record['before'])} | "
              f"{as_code(record['after'])} | {record['outcome']}{by}{late} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("directory", type=pathlib.Path)
    parser.add_argument("--count", type=int, default=100, help="mutants that compile")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2, help="clones side by side",
                        choices=range(1, max(2, os.cpu_count()) + 1))
    parser.add_argument("--table", action="store_true", help="print what is known")
    options = parser.parse_args()
    run = Run(options.directory, options.seed)
    if options.table:
        return print_table(run)
    if run.facts["seed"] != options.seed:
        parser.error(f"{run.facts_file} has the seed {run.facts['seed']}: give it, or "
                     "another directory.")
    print(f"Commit {run.facts['commit'][:9]}, {len(run.records)} mutants are done.",
          flush=True)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        run.go(options.count, options.jobs)
    except KeyboardInterrupt:
        for copy in run.copies:
            copy.end_processes()
        print("Stopped; the same command resumes.")
        os._exit(1)  # without the threads, which wait for processes


main()
