"""Judges seeded instances of derived numbers: each is a group of runs whose numbers
must agree with each other or with a closed form. derived_families.py draws them."""

import dataclasses
import math
import pathlib
import random
import shutil
import time

from crevasse_run import Failure, Results, execute, settings_of

PATIENCE = 600  # seconds a run, on a busy machine


class Refused(Exception):
    """Status 2."""


class Failed(Exception):
    """Status 3."""


@dataclasses.dataclass
class Outcome:
    family: str
    seed: int
    kind: str          # agreed, refused, failed, WRONG
    ratio: float = 0.  # largest deviation over its bound
    note: str = ""
    seconds: float = 0.


class Instance:
    """Random numbers, runs, and the deviations of their numbers."""

    def __init__(self, family, seed):
        self.dice = random.Random(f"{family} {seed}")
        self.folder = pathlib.Path("derived") / f"{family}_{seed}".replace(" ", "_")
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        self.ratio, self.note = 0., ""

    def path(self, name):
        return self.folder.resolve() / name

    def write(self, label, scene, settings):
        """A scene file with all settings: of a text, and those that replace them."""
        merged = {**settings_of(scene),
                  **{tuple(name.rpartition("/")[::2]): value
                     for name, value in settings.items()}}
        path = self.path(f"{label}.prm")
        path.write_text("".join(
            f"subsection {section}\n  set {name} = {value}\nend\n" if section
            else f"set {name} = {value}\n"
            for (section, name), value in merged.items()))
        return path

    def run(self, label, scene, settings, *words, allowed=(0,)):
        path = self.write(label, scene, settings)
        results = self.path(label)
        status, _, error = execute(path, "--quiet", "--output", results, *words,
                                   seconds=PATIENCE)
        if status in (2, 3):
            raise (Refused if status == 2 else Failed)(f"{label}: {error.strip()}")
        if status not in allowed:
            raise Failure(f"{label}: status {status}: {error}")
        return Results(results)

    def expect(self, what, value, expected, allowed):
        """The largest ratio of deviation and bound is kept."""
        known = value is not None and expected is not None and math.isfinite(value)
        deviation = abs(value - expected) if known else (
            0. if value is expected else math.inf)
        ratio = deviation / allowed if deviation else 0.
        if ratio >= self.ratio:
            self.ratio = ratio
            self.note = f"{what}: {value}, expected {expected}, allowed {allowed:.2g}"

    def expect_all(self, what, values, expected, relative, scale=None):
        """Columns, relative to the largest expected value, or to a scale."""
        if len(values) != len(expected):
            self.expect(f"{what}: rows", len(values), len(expected), 0.1)
            return
        scale = scale or max(map(abs, expected), default=0.) or 1.
        for k, (value, other) in enumerate(zip(values, expected)):
            self.expect(f"{what}[{k}]", value, other, relative * scale)


def judge(family, draw, seed):
    """Draws, runs and compares one instance; keeps its files if it is wrong."""
    instance, begin = Instance(family, seed), time.time()
    outcome = Outcome(family, seed, "agreed")
    try:
        draw(instance)
        outcome.ratio, outcome.note = instance.ratio, instance.note
        if not instance.ratio <= 1:
            outcome.kind = "WRONG"
    except Refused as refusal:
        outcome.kind, outcome.note = "refused", str(refusal)
    except Failed as failure:
        outcome.kind, outcome.note = "failed", str(failure)
    except Failure as failure:
        outcome.kind, outcome.note, outcome.ratio = "WRONG", str(failure), math.inf
    outcome.seconds = time.time() - begin
    if outcome.kind == "agreed":
        shutil.rmtree(instance.folder)
    return outcome


def judge_all(families, count, seed, show=lambda outcome: None):
    """As many of each family, from a seed on."""
    outcomes = []
    for k in range(count):
        family = list(families)[k % len(families)]
        outcomes.append(judge(family, families[family],
                              seed + k // len(families)))
        show(outcomes[-1])
    return outcomes


def table(outcomes):
    """By family: what became of the instances, and the largest deviation."""
    kinds = ("agreed", "refused", "failed", "WRONG")
    lines = [f"{'family':22}{'runs':>6}" + "".join(f"{kind:>9}" for kind in kinds)
             + f"{'deviation/bound':>17}{'seconds':>9}"]
    for family in [*dict.fromkeys(one.family for one in outcomes), "all"]:
        own = [one for one in outcomes if family in (one.family, "all")]
        counts = [sum(one.kind == kind for one in own) for kind in kinds]
        worst = max((one.ratio for one in own), default=0.)
        lines.append(f"{family:22}{len(own):6}" + "".join(f"{n:9}" for n in counts)
                     + f"{worst:17.2g}{sum(one.seconds for one in own):9.0f}")
    return "\n".join(lines)
