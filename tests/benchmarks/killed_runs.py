"""Fifty runs, each killed (SIGKILL) at a random moment, some of them again after
they were resumed, and resumed to the end: all must end like the one that was not,
byte for byte.

    /usr/bin/python3 tests/benchmarks/killed_runs.py build/crevasse . [TRIES]

Works in the folder killed_runs of the working directory. Prints for each try where
it was killed, and in the end how many had a checkpoint to go on from."""

import argparse
import os
import pathlib
import random
import sys
import time

PARSER = argparse.ArgumentParser()
PARSER.add_argument("program")  # These two are what crevasse_run reads.
PARSER.add_argument("source")
PARSER.add_argument("tries", type=int, nargs="?", default=50)
TRIES = PARSER.parse_args().tries

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "runs"))

from interrupted_runs import (CASES, COMMON, check_same_bytes, finish, fresh,
                              has_checkpoint, interrupt, reference)

NAMES = ["march", "anderson", "adaptive steps", "readapted", "crack tip",
         "two lips"]


def main():
    os.makedirs("killed_runs", exist_ok=True)
    os.chdir("killed_runs")
    begin = time.time()
    wholes = {}
    for name in NAMES:
        settings = COMMON + CASES[name] + ["Output/Checkpoint every=1"]
        wholes[name] = (settings, *reference(
            f"{name} whole".replace(" ", "_"), settings))
    resumed = kills = 0
    for seed in range(TRIES):
        dice = random.Random(seed)
        name = NAMES[seed % len(NAMES)]
        settings, whole, seconds = wholes[name]
        directory = fresh(f"try_{seed}")
        moments = []
        for _ in range(dice.choice((1, 1, 2, 3))):
            goes_on = has_checkpoint(directory)
            moment = dice.uniform(0., 1.) * seconds
            code, _ = interrupt(directory, settings, "SIGKILL", moment)
            resumed += goes_on
            kills += code == -9
            moments.append(f"{moment:.2f}")
        resumed += has_checkpoint(directory)
        check_same_bytes(whole, finish(directory, settings),
                         f"try {seed}, {name}, killed after "
                         f"{' and '.join(moments)} of {seconds:.2f} s")
    print(f"{TRIES} runs, {kills} kills, {resumed} times resumed, "
          f"{time.time() - begin:.0f} s")


main()
