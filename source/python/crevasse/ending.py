# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""How a run ended, in words."""

import collections
import fcntl
import json
import re
import socket

from crevasse.results import number
from crevasse.wording import plural, significant

# good: periodic; plain: no tolerance, or still running; bad: all others.
Ending = collections.namedtuple("Ending", "kind, heading, sentences")


def ending_of(run):
    """How a run ended, judged by the last message of the log and by the summary."""
    message = last_message(run.log)
    if "stopped on request" in message:
        return stopped(run, message)
    if message:
        return failed(run, message)
    if not run.finished:
        return going_on(run) or killed(run)
    return finished(run)


def last_message(log):
    """The error with which the log ends; empty if it does not."""
    lines = log.rstrip().splitlines()
    for k in range(len(lines) - 1, -1, -1):
        if lines[k].startswith("crevasse: "):
            return "\n".join(lines[k:]).removeprefix("crevasse: ")
        if lines[k].startswith("  "):  # what a run prints on its way
            break
    return ""


def finished(run):
    converged = run.summary.get("converged")
    if "converged" not in run.summary:
        return Ending("bad", "The run has ended, but its summary cannot be read",
                      ["Whether the stress is periodic is not known. " + reached(run)])
    error = last_number(run.summary.get("stress_error_estimate"))
    change = last_number(run.summary.get("stress_change"))
    periods = plural(run.summary.get("periods", 0), "period")
    tolerance = run.parameter("Periodic state/Tolerance")
    if converged:
        effects = run.summary.get("effects", {})
        if not (effects.get("viscosity", {}).get("on", 1)
                or effects.get("friction", {}).get("on", 0)):
            return Ending("good", "Done: the body is elastic, one period is enough",
                          [])
        quantity = run.parameter("Periodic state/Converged quantity") or "stress"
        if quantity != "stress":
            return Ending("good", f"Done: {quantity} is periodic after {periods}", [
                f"Its estimated error is at most [Periodic state] Tolerance = "
                f"{tolerance} of its largest value."])
        return Ending("good", f"Done: the stress is periodic after {periods}", [
            f"Its estimated error is {significant(error, 3)} of the largest stress "
            f"component ([Periodic state] Tolerance = {tolerance})."])
    missions = run.parameter("Periodic state/Missions")
    if missions:
        return Ending("good", f"Done: missions {missions} are computed", [
            f"They took {periods}; missions.csv has a row for each. The other "
            "tables end with the last mission."])
    if converged is None:
        return Ending("plain", "Done: no period was requested", [])
    measured = (f"In the last period it changed by {significant(change, 3)} of the "
                "largest component; the estimated distance to the periodic stress "
                f"is {significant(error, 3)}." if error is not None else
                f"In the last period it changed by {significant(change, 3)} of the "
                "largest component; its distance from the periodic stress is "
                "unknown.")
    if number(tolerance) == 0:
        return Ending("plain", f"Done: {periods} computed, as requested", [
            "With [Periodic state] Tolerance = 0 the run does not check whether the "
            "stress is periodic. " + measured])
    return Ending("bad", f"Not converged: the stress is not periodic after {periods}",
                  [measured + f" [Periodic state] Tolerance = {tolerance}."])


def stopped(run, message):
    return Ending("bad", "Stopped before the end", [
        sentence(message), reached(run), checkpoint(run),
        "This report shows what the run had written by then."])


def failed(run, message):
    """The ending with status 3: with results if only the last judgement failed."""
    if not run.finished:
        return Ending("bad", "Failed: the run ended with an error", [
            sentence(message), reached(run), checkpoint(run),
            "This report shows what the run had written by then."])
    converged = run.summary.get("converged")
    periods = plural(run.summary.get("periods", 0), "period")
    heading = ("Done, but the result is in doubt" if converged else
               f"Ended after {periods}, before the last mission"
               if run.parameter("Periodic state/Missions") else
               f"Not converged: the stress is not periodic after {periods}")
    return Ending("bad", heading, [sentence(message)])


def going_on(run):
    """The ending of a run that may still be running; None if no process runs it."""
    path = run.directory / "running"
    try:
        words = path.read_text(errors="replace").split()
        process, host = words[1], words[3]
    except (OSError, IndexError):
        return None
    at_it = is_locked(path)
    if host != socket.gethostname() or at_it is None:
        return Ending("plain", "The run may still be running", [
            f"The file running names process {process} on {host}, another machine. If "
            "this process does not exist any more, the run was killed. "
            + reached(run), checkpoint(run)])
    if not at_it:
        return None
    return Ending("plain", "The run is still running", [
        f"Process {process} runs it. {reached(run)} Repeat the report when the run is "
        "done; a file named stop in the output directory stops it."])


def is_locked(path):
    """Whether a run holds its lock on this file, which a kill or the end of its machine
    releases; its process number may be another process's by now. None if that is
    unknown."""
    try:
        with open(path) as file:
            fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    except OSError:
        return None
    return False


def killed(run):
    return Ending("bad", "Interrupted: the run was killed, or the machine failed", [
        "There is no summary, no error message and no running process. "
        + reached(run), checkpoint(run),
        "This report shows what the run had written by then."])


def reached(run):
    """A sentence on the last instant of the tables."""
    ends = [table["t"][-1] for table in run.tables.values()
            if len(table.get("t", ()))]
    if not ends:
        return "No step was completed."
    return (f"The tables end at t = {significant(max(ends), 6)}, after "
            f"{significant(max(ends) / run.period, 3)} of at most "
            f"{run.parameter('Periodic state/Maximum periods')} periods.")


def checkpoint(run):
    """A sentence on the newest checkpoint and what to do with it."""
    numbers = [int(path.name) for path in (run.directory / "checkpoint").glob("*")
               if path.name.isdigit()]
    if not numbers:
        return "There is no checkpoint: start the run again."
    path = run.directory / "checkpoint" / str(max(numbers)) / "manifest.json"
    try:  # the first line is the checksum of the others
        manifest = json.loads(path.read_text(errors="replace").split("\n", 1)[1])
        place = f"before step {manifest['step'] + 1} of period {manifest['period']}"
    except (OSError, ValueError, IndexError, KeyError, TypeError):
        place = "which cannot be read"
    return (f"Checkpoint {max(numbers)}, {place}: repeat the command with "
            "--resume.")


def sentence(message):
    text = re.sub(r"\s+", " ", message).strip()
    text = text[:1].upper() + text[1:]
    return text if text.endswith((".", "!", "?")) else text + "."


def last_number(values):
    if isinstance(values, list) and values and isinstance(values[-1], (int, float)):
        return values[-1]
    return None
