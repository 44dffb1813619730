# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""What subcommands that run scenes have in common: options, the log, requests to
stop, the lock of their directory."""

import argparse
import contextlib
import difflib
import fcntl
import math
import os
import pathlib
import re
import shutil
import signal
import socket
import sys
import time

from crevasse.results import number


class CommandError(Exception):
    """An error, with the message for the user and the exit status."""

    def __init__(self, message, status):
        super().__init__(message)
        self.status = status


class Parser(argparse.ArgumentParser):
    """Parser of a subcommand, which suggests the option that may have been meant."""

    def __init__(self, name, **options):
        super().__init__(prog=f"crevasse {name}", allow_abbrev=False, **options,
                         formatter_class=argparse.RawDescriptionHelpFormatter)
        self.add_argument("scene", type=pathlib.Path,
                          help="the scene: a .prm or .json file")

    def add_list(self, name, metavar, text):
        self.add_argument(name, action="append", default=[], metavar=metavar,
                          help=text + "; may be repeated")

    def add_common(self, default_directory):
        self.add_list("--set", "ASSIGNMENT", "\"Section/Name=value\": overrides a "
                      "parameter of the scene")
        self.add_argument("--output", type=pathlib.Path, metavar="DIR",
                          help=f"({default_directory})")
        self.add_argument("--quiet", action="store_true",
                          help="print nothing but errors")
        self.add_argument("--wall-time", type=wall_time, metavar="TIME",
                          help="stop after this time: seconds, hours:minutes:seconds, "
                          "or days-hours:minutes:seconds")

    def parse(self, words):
        self.words = words
        for word in words:
            try:
                word.encode()
            except UnicodeEncodeError:
                self.error(f"{word!r} is not text in UTF-8")
        known, others = self.parse_known_args(words)
        if others:
            self.error("these arguments were not expected: " + " ".join(others))
        return known

    def error(self, message):
        options = [*self._option_string_actions]
        for word in self.words:
            near = difflib.get_close_matches(word.split("=")[0], options, 1)
            if word.startswith("--") and near and near[0] != word.split("=")[0]:
                message += f"; did you mean \"{near[0]}\"?"
        super().error(message)


def count(text):
    """Parses an integer of at least 1."""
    if not (text.isdecimal() and int(text) > 0):
        raise argparse.ArgumentTypeError(
            f"\"{text}\" must be an integer of at least 1.")
    return int(text)


def wall_time(text):
    """Parses a time, such as "3600", "1:00:00" or "2-12:00:00"; returns seconds."""
    clock = re.fullmatch(r"(?:(\d{1,4})-)?(\d{1,4}):([0-5]?\d):([0-5]?\d)", text)
    if clock:
        days, hours, minutes, seconds = (int(part or 0) for part in clock.groups())
        return ((24 * days + hours) * 60 + minutes) * 60 + seconds
    seconds = number(text)
    if not seconds or not seconds > 0:
        raise argparse.ArgumentTypeError(
            f"\"{text}\" is not a time: write seconds, hours:minutes:seconds, or "
            "days-hours:minutes:seconds, such as 3600, 1:00:00 or 2-12:00:00.")
    return seconds


class Stop:
    """A request to stop: a signal, a file "stop", or the end of the time."""

    def __init__(self, time_granted, what_is_kept):
        self.end = time.monotonic() + time_granted if time_granted else math.inf
        self.what_is_kept = what_is_kept
        self.file = None
        self.name = ""
        for signal_number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            if signal.getsignal(signal_number) != signal.SIG_IGN:
                signal.signal(signal_number, self.take)

    def take(self, signal_number, _):
        self.name = signal.Signals(signal_number).name

    def look_in(self, directory):
        """Sets the directory of the file "stop"; an old file was meant for others."""
        self.file = pathlib.Path(directory) / "stop"
        self.file.unlink(missing_ok=True)

    def asked(self):
        if not self.name and time.monotonic() >= self.end:
            self.name = "--wall-time"
        if not self.name and self.file and self.file.exists():
            self.name = f"the file {self.file}"
            self.file.unlink()
        return self.name

    def check(self):
        if self.asked():
            raise CommandError(f"stopped on request ({self.name}). "
                               + self.what_is_kept, 5)


class Log:
    """Lines on standard output and in a file, and on a terminal a line that is
    overwritten."""

    def __init__(self, quiet):
        self.quiet, self.file, self.lines = quiet, None, []
        self.shows_progress = (not quiet and sys.stdout.isatty()
                               and os.environ.get("OMPI_COMM_WORLD_SIZE", "1") == "1")

    def open(self, path):
        self.file = open(path, "w", encoding="utf-8", errors="surrogateescape")
        self.write("".join(self.lines))

    def __call__(self, line):
        if not self.quiet:
            self.say(("\r\033[K" if self.shows_progress else "") + line + "\n")
        self.write(line + "\n")

    def write(self, text):
        if not self.file:
            self.lines.append(text)
            return
        self.file.write(text)
        self.file.flush()

    def error(self, text):
        """Prints an error on standard error, even if quiet, and in the log file."""
        self.progress("")
        print(text, file=sys.stderr)
        self.write(text + "\n")

    def progress(self, text):
        if self.shows_progress:  # a line that wraps could not be overwritten
            width = shutil.get_terminal_size().columns - 1
            self.say(f"\r{text[:width]}\033[K")

    def say(self, text):
        """Prints a line, unless the reader has ended or the disk is full."""
        try:
            print(text, end="", flush=True)
        except OSError:
            self.quiet, self.shows_progress = True, False
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


@contextlib.contextmanager
def taken(directory):
    """Makes the directory and locks it against other processes."""
    path = directory / "running"
    try:
        directory.mkdir(parents=True, exist_ok=True)
        file = open(path, "a+")
    except OSError as error:
        raise CommandError(f"[Output directory] {directory}: cannot be written to "
                           f"({error.strerror}). Choose another one by --output DIR.",
                           4) from None
    with file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            file.seek(0)
            raise CommandError(f"Another run writes to {directory} "
                               f"({file.readline().strip()}). Choose another directory "
                               "by --output DIR, or wait.", 4) from None
        file.truncate(0)
        file.write(f"process {os.getpid()} on {socket.gethostname()}\n")
        file.flush()
        try:
            yield
        finally:
            path.unlink(missing_ok=True)


def write_file(path, text):
    """Writes a file as a whole or not at all."""
    part = path.with_name(path.name + ".part")
    part.write_text(text, encoding="utf-8", errors="surrogateescape")
    os.replace(part, path)
