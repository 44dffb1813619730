# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""What import crevasse offers: scenes run from Python, tables as DataFrames."""

import collections
import pathlib
import subprocess
import sys
import warnings

from crevasse.command import CommandError
from crevasse.program import (Call, assignments, find_program, message_of, mpirun,
                              options)
from crevasse.results import ResultsError, parse_parameters
from crevasse.run_reader import Run


def run(scene, parameters=None, *, output=None, force=False, resume=False,
        processes=1, quiet=True):
    """Runs a scene with {"Section/Name": value} in place of its own values, and returns
    its Results. The options are those of the command line; without output the results
    go to results/<scene name>. Raises CommandError with the program's message and exit
    status."""
    program = find_program()
    settings = {name: as_text(value) for name, value in (parameters or {}).items()}
    words = [scene, *options(assignments(settings))]
    if output is None:
        output = default_directory(program, words, scene)
    words += ["--output", output]
    words += [f"--{name}" for name, wanted in (
        ("force", force), ("resume", resume), ("quiet", quiet)) if wanted]
    call = execute([*mpirun(processes), program, *words])
    sys.stderr.write(call.error)  # warnings of what happened on the way
    results = Results(output)
    for text in results.summary.get("warnings", ()) if quiet else ():  # not printed yet
        warnings.warn(text, stacklevel=2)
    return results


def life(scene, start=None, end=None, parameters=None, *, error=1e-2, path=False,
         step=None, output=None, processes=1, quiet=True):
    """The Life of a crack that grows from one length to another, by crevasse life, with
    parameters as in run(); with path along a curve, by steps. Without output the results go to results/<scene name>_life."""
    program = find_program()
    settings = {name: as_text(value) for name, value in (parameters or {}).items()}
    words = [scene, *options(assignments(settings))]
    if output is None:
        output = f"{default_directory(program, words, scene)}_life"
    words += ["--error", error, "--output", output, *["--quiet"] * quiet,
              *["--path"] * path]
    for option, value in (("--from", start), ("--to", end), ("--step", step)):
        words += [] if value is None else [option, value]
    execute([*mpirun(processes), program, "life", *words])
    return Life(output)


def read(directory):
    """The Results in the output directory of a run, finished or not, or the Life in
    that of crevasse life."""
    is_life = (pathlib.Path(directory) / "life.json").exists()
    return (Life if is_life else Results)(directory)


class Life:
    """What crevasse life has written: summary is life.json, table life.csv."""

    def __init__(self, directory):
        from crevasse.life_output import read as read_life
        self.directory = pathlib.Path(directory)
        self.summary, self.columns = read_life(self.directory)

    def __repr__(self):
        return f"<crevasse.Life of {self.directory}>"

    @property
    def table(self):
        import pandas
        return pandas.DataFrame(self.columns)


class Results(Run):
    """What a run has written. Its tables are DataFrames of pandas with the columns of
    the files; parameters, summary and probes are dictionaries, and damages are sentences
    about files that cannot be read."""

    def __repr__(self):
        return f"<crevasse.Results of {self.directory}>"

    def table(self, name):
        """The table of a file, such as "load_work.csv"."""
        if name not in self.tables:
            damages = [text for text in self.damages if text.startswith(name + ":")]
            raise ResultsError(" ".join(
                [f"{self.directory}: there is no table {name} with rows. Tables: "
                 f"{', '.join(self.tables) or 'none'}.", *damages]))
        try:
            import pandas
        except ImportError:
            raise ImportError("crevasse gives tables as DataFrames: install Debian's "
                              "package python3-pandas.") from None
        return pandas.DataFrame(self.tables[name])

    def probe(self, name):
        return self.table(f"probe_{name}.csv")

    def crack_tip(self, number=None):
        return self.numbered_table("crack_tip", number)

    def creep_integral(self, number=None):
        return self.numbered_table("creep_integral", number)

    def numbered_table(self, kind, number):
        """The table of a tip, which needs no number if there is one tip. The only tip
        of a body with one lip has no number in its file."""
        tips = [name for name in self.tables if name.startswith(f"{kind}_")]
        if number is None and len(tips) > 1:
            places = self.summary.get(f"{kind}s", ())
            raise ResultsError(
                f"{self.directory}: there are {len(tips)} tables {kind}_N.csv; choose "
                f"one by its number, as {kind}(1)." + "".join(
                    f" {k}: tip at {tuple(tip['position'])}."
                    for k, tip in enumerate(places, 1) if f"{kind}_{k}.csv" in tips))
        single = f"{kind}.csv"
        is_single = number in (None, 1) and (self.directory / single).exists()
        return self.table(single if is_single else f"{kind}_{number or 1}.csv")

    @property
    def bars(self):
        """Error bars {quantity: {value, bar, mesh, time, period}} of a run with --bars;
        a bar of None has a "why"."""
        return self.summary.get("bars", {})

    @property
    def contact(self):
        return self.table("contact.csv")

    @property
    def periods(self):
        return self.table("periods.csv")

    @property
    def fields(self):
        """The fields of each stored instant, in the order of writing."""
        return [Field(*instant) for instant in self.instants()]


class Field(collections.namedtuple("Field", "t, path")):
    """An instant, and the file that ParaView opens."""

    def mesh(self):
        """The fields as a mesh of meshio's, with the arrays in its point_data."""
        from crevasse.fields import read_whole
        return read_whole(self.path)


def as_text(value):
    """The text of a value in a scene file."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, (list, tuple)):
        return ", ".join(map(as_text, value))
    return str(value)


def default_directory(program, words, scene):
    """Default output directory of the program, which it prints only while it runs."""
    call = execute([program, *words, "--print-parameters", "prm"], shows_output=False)
    values, _ = parse_parameters(call.output)
    return values["Output directory"] or f"results/{pathlib.Path(scene).stem}"


def execute(words, shows_output=True):
    """Runs the program with a command line. Its output is printed as it comes: a
    notebook shows what Python prints, and not what other processes do."""
    call = Call()
    try:
        process = subprocess.Popen(
            list(map(str, words)), stdin=subprocess.DEVNULL, stderr=call.files[1],
            stdout=subprocess.PIPE if shows_output else call.files[0])
    except OSError as error:
        raise CommandError(f"{words[0]} cannot be started ({error.strerror}).",
                           4) from None
    with process:
        try:
            for line in process.stdout or ():
                print(line.decode(errors="replace"), end="", flush=True)
            call.status = process.wait()
        except BaseException:  # an interrupt: the run ends after its step
            process.terminate()
            process.communicate()
            raise
    if call.status:
        raise CommandError(message_of(call) or "stopped on request; resume=True "
                           "continues from the checkpoint.", call.status)
    return call
