# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Draws changes of single lines of the numerics, for mutation.py."""

import collections
import random
import re

FOLDERS = ("material", "kernels", "discretisation", "model", "linear", "contact",
           "time", "periodic", "harmonic_balance", "crack_tip")

# What is no numerics: declarations, messages, checks, tolerances, memory.
SKIPPED = re.compile(
    r"\"|<<|\d[eE]-\d|\b(template|using|operator|throw|static_assert|Assert\w*|Exc\w*|"
    r"reserve|sizeof|memory_\w+|bytes\w*|\w*tolerance|epsilon)\b")
# Operators have blanks around them, or end the line: the code is formatted. Arguments
# of templates, before a > without a blank, are declarations.
END = r"(?= |$)(?! \w+>)"
MUTATIONS = [(kind, re.compile(pattern), after) for kind, pattern, after in (
    *(("operator", rf"(?<=[^ =(,] ){re.escape(one)}{END}", other) for one, other in (
        ("+", "-"), ("-", "+"), ("/", "*"), ("+=", "-="), ("-=", "+="), ("*=", "/="),
        ("/=", "*="), ("&&", "||"), ("||", "&&"), ("==", "!="), ("!=", "=="),
        ("<=", ">"), (">", "<="), (">=", "<"))),
    ("operator", r"(?<=[\w)\]] )\*(?= )|(?<=[)\]] )\*$", "/"),
    ("factor", r"(?<=[\w)\]] )\*(?= )|(?<=[)\]] )\*$", "* 2 *"),
    ("factor", r"(?<![\w.])(0\.5|2\.)(?![\w.])", "1."),
    # The first or the last pass of a loop; a loop that never runs is too simple.
    ("operator", rf"^(?!.*\bfor \().*?(?<=[^ =(,] )\K<{END}", ">="),
    ("loop", r"\bfor \(.* = \K0(?=;)", "1"),
    ("loop", r"\bfor \(.*; \w+\K <(?= )", " + 1 <"),
    ("sign", r"(?:(?<=[=,?:] )|(?<=\()|(?<=return ))-(?=[\w(])", ""),
    ("negation", r"(?:(?<= )|(?<=\())!(?=[\w(])", ""),
    ("negation", r"\bif \(\K(?=[\w.>:-]+(\([\w., ]*\))?\)$)", "!"),
    ("index", r"\[\K0(?=\])", "1"), ("index", r"\[\K[12](?=\])", "0"),
    ("value", r"\btrue\b", "false"), ("value", r"\bfalse\b", "true"),
    ("extremum", r"(?<=::)max(?=\()", "min"), ("extremum", r"(?<=::)min(?=\()", "max"),
    ("call", r"^ +\K(?!return|[A-Z]{5})[\w.:>\[\]()-]+\(.*\);$", ";"),
) for pattern in [pattern.replace(r"\K", "(?P<mutated>", 1) + ")"
                  if r"\K" in pattern else f"(?P<mutated>{pattern})"]]

Mutant = collections.namedtuple("Mutant", "file line kind before after")


def blank(match):
    return re.sub(r"[^\n]", " ", match[0])


def code(text):
    """The same lines and columns without what is not mutated."""
    text = re.sub(r"/\*.*?\*/|//[^\n]*|^ *#(\\\n|[^\n])*", blank, text,
                  flags=re.DOTALL | re.MULTILINE)
    return re.sub(r"[^;{}]+[;{}]?", lambda statement: blank(statement)
                  if SKIPPED.search(statement[0]) else statement[0], text)


def mutants_of(line, follows_statement):
    """(kind, the line after it) for each change of a line."""
    for kind, pattern, after in MUTATIONS:
        if kind == "call" and not follows_statement:
            continue  # may be the second line of a declaration
        for match in pattern.finditer(line):
            begin, end = match.span("mutated")
            yield kind, begin, end, after


def draw(tree, seed):
    """All lines that can be changed, one change of each, in random order."""
    dice, mutants = random.Random(seed), []
    for folder in FOLDERS:
        for path in sorted(p for part in ("source", "include/crevasse")
                           for p in (tree / part / folder).glob("*.*")):
            text = path.read_text()
            follows_statement = False
            for number, (line, own) in enumerate(
                    zip(text.splitlines(), code(text).splitlines()), 1):
                choices = list(mutants_of(own.rstrip(), follows_statement))
                if own.strip():
                    follows_statement = own.rstrip().endswith((";", "{", "}", ")", "else"))
                if choices:
                    kind, begin, end, after = dice.choice(choices)
                    mutants.append(Mutant(path.relative_to(tree).as_posix(), number, kind,
                                          line, line[:begin] + after + line[end:]))
    dice.shuffle(mutants)
    return mutants
