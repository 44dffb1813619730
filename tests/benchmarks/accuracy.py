"""What `crevasse SCENE --accuracy` reaches and costs in ten small scenes, beside the best
setting of a full sweep over meshes, also coarser than the scene's, and steps at least as
fine as the scene's: the table of doc/accuracy.md.

    OMP_NUM_THREADS=1 /usr/bin/python3 tests/benchmarks/accuracy.py PROGRAM [SCENE ...]

True errors come from runs with cells of a sixth of the size and six times the steps (24
where steps matter); of a twelfth in the plate without a tip. Seconds are CPU time; those
of --accuracy are of all tries with their companions. --advise compares with `crevasse advise` instead of a sweep.
Points of sweeps stay in results/accuracy and are not repeated; a scene takes a minute or
two."""

import json
import os
import pathlib
import shutil
import sys

from error_bars import OTHERS, PRESSED, ROOT, SCENES, STEPS, sdirk2

WISHES = (1e-2, 1e-3, 1e-4)
TIMES_CELLS, TIMES_STEPS = (.5, 1, 1.5, 2, 3, 4, 6, 8), (1, 2, 4, 8)
FINEST_CELLS, FINEST_STEPS = 6, 6
OF_STEPS = {"square, fourier", "bent", "graded material"}  # whose error is that of steps
MOST_SECONDS = 5.  # of a point of the sweep, predicted from the one before
TIP = {"Discretisation/Degree": 2, "Discretisation/Singular functions": 2}
K = "K_I_largest"
CLOSE = {"Periodic state/Tolerance": 1e-5, "Periodic state/Maximum periods": 200}


def small(name, *more):
    scene, settings = (SCENES | OTHERS)[name][:2]
    for other in more:
        settings = settings | other
    return scene, settings


# Scene, settings, quantities, whether K and openings need elements for a tip.
CASES = {
    "square, pressed, sdirk2": (
        *small("square, pressed, sdirk2", sdirk2(20), CLOSE), K, True),
    "square, rk4 with events": (
        *small("square, rk4 with events", PRESSED, CLOSE), K, True),
    "square, fourier": (*small("square, trapezoid, fourier"), K + ", opening", True),
    "two materials": (
        *small("two materials", CLOSE, {"Crack tip/Stress intensity": "true"}), K, True),
    "graded material": (*small("graded material"), "opening", True),
    "crack growth": (
        *small("crack growth", {"Geometry/Subdivisions": "5, 10"}), K + ", C_star", True),
    "centre crack": (*small("centre crack"), K, True),
    "ageing": (*small("ageing"), K, True),
    "bent": (*small("bent"), "opening", True),
    "creeping plate": (
        *small("creeping plate", {"Discretisation/Degree": 2}), "probe inside u", False),
}


# For --advise: the same quantity, as advise names it.
ADVISED = {"two materials": "crack_tip/K_I", "centre crack": "crack_tip/K_I",
           "creeping plate": "probe_inside/u", "bent": "probe_mouth/opening"}


class Case:
    def __init__(self, name, program, log):
        prm, self.settings, self.names, tip = CASES[name]
        self.name = name
        self.scene, self.program, self.log = ROOT / f"prm/{prm}.prm", program, log
        self.elements = TIP if tip else {}
        self.folder = pathlib.Path("results/accuracy").absolute() / "".join(
            c if c.isalnum() else "_" for c in name)

    def accuracy(self, wish):
        from crevasse import accuracy
        from crevasse.command import CommandError, taken
        from crevasse.program import assignments
        folder = self.folder / f"{wish:g}"
        shutil.rmtree(folder, ignore_errors=True)
        options = accuracy.arguments([str(self.scene), "--accuracy", str(wish), "--for",
                                      self.names, "--output", str(folder), *(
            word for text in assignments(self.settings) for word in ("--set", text))])
        run = accuracy.Accuracy(options, self.program, self.log)
        with taken(run.directory):
            try:
                run.run()
            except CommandError as error:
                self.log(str(error))
        return run, folder

    def advised(self, wish):
        """CPU time of all runs of an advice and of the advised one, and its folder."""
        from crevasse import advise
        from crevasse.command import CommandError
        from crevasse.program import assignments
        folder = self.folder / f"advice_{wish:g}"
        options = advise.arguments([
            str(self.scene), "--error", str(wish), "--quantities", ADVISED[self.name],
            "--output", str(folder), *(word for text in assignments(self.settings)
                                       for word in ("--set", text))])
        try:
            advise.advise(options, self.program.stop, self.log)
        except CommandError as error:
            self.log(str(error))
        seconds = {path.parent.name: json.loads(path.read_text())["costs"].get(
            "processor_seconds", 0.) for path in folder.glob("runs/*/finished.json")}
        name = json.loads((folder / "advice.json").read_text())["run"]
        seconds.pop("original", None)
        return sum(seconds.values()), seconds[name], folder / "runs" / name

    def point(self, cells, steps):
        """Folder and CPU time of a run with cells and steps so many times as fine."""
        from crevasse.program import assignments
        from crevasse.run_reader import Run
        folder = self.folder / f"cells_{cells:g}_steps_{steps:g}"
        if not (folder / "summary.json").exists():
            n = [int(n) for n in self.parameters["Geometry/Subdivisions"].split(",")]
            settings = self.settings | self.elements | {
                "Contact/Solver": "automatic", "Output/Fields": "none",
                "Geometry/Subdivisions": ", ".join(str(round(k * cells)) for k in n),
                STEPS: int(self.parameters[STEPS]) * steps}
            end = self.program.compute(self.scene, assignments(settings), folder)
            if not end.has_results:
                return None, 0.
        return folder, Run(folder).summary["processor_seconds"]

    def values(self, folder):
        from crevasse.bars_compare import Histories, largest, quantities_of
        mine = Histories(folder, self.own.period)
        asked = [name.strip() for name in self.names.split(",")]
        return {q.name: largest(q, mine) for q in quantities_of(self.own.parameters, mine)
                if any(q.name == name or q.name.startswith(name + "_") for name in asked)}

    def error(self, folder):
        """The largest of the quantities, relative to the largest value of its kind."""
        mine, worst = self.values(folder), 0.
        for name in self.names.split(","):
            group = [n for n in self.truth if n.startswith(name.strip())]
            scale = max((abs(self.truth[n]) for n in group), default=0.)
            worst = max([worst, *(abs(mine[n] - self.truth[n]) / scale
                                  for n in group if scale)])
        return worst

    def sweep(self):
        """(CPU time, error) of all points."""
        found = []
        for cells in TIMES_CELLS:
            if cells >= FINEST_CELLS * (1 if self.elements else 2):
                break
            last = 0.
            for steps in TIMES_STEPS:
                if 2. * last > MOST_SECONDS:
                    break
                folder, last = self.point(cells, steps)
                if folder:
                    found.append((last, self.error(folder), cells, steps))
        return found

    def judge(self, name):
        from crevasse.run_reader import Run
        rows = []
        for wish in WISHES:
            run, folder = self.accuracy(wish)
            self.own = Run(folder)
            rows.append((wish, run, folder))
        self.parameters = run.scene
        self.truth = self.values(self.point(
            FINEST_CELLS * (1 if self.elements else 2),
            FINEST_STEPS * (4 if name in OF_STEPS else 1))[0])
        if "--advise" in sys.argv:
            for wish, run, folder in rows:
                total, own, advised = self.advised(wish)
                print(f"| {name} | {wish:g} | {self.error(folder):.1e} "
                      f"| {run.runs.seconds():.2g} | {self.error(advised):.1e} "
                      f"| {total:.2g} | {own:.2g} |", flush=True)
            return
        points = self.sweep()
        for wish, run, folder in rows:
            good = [point for point in points if point[1] <= wish]
            seconds, best = run.runs.seconds(), min(good, default=(0., 0., 0, 0))
            last = run.tries[-1]
            print(f"| {name} | {wish:g} | {last.parts['bar']:.1e} "
                  f"| {self.error(folder):.1e} | {len(run.tries)} | {seconds:.2g} "
                  f"| {last.run.seconds:.2g} "
                  f"| {best[0]:.2g} (x {best[2]:g}, {best[3]:g}) "
                  f"| {seconds / best[0] if good else 0.:.1f} |", flush=True)


def main():
    os.environ["CREVASSE_PROGRAM"] = str(pathlib.Path(sys.argv[1]).resolve())
    from crevasse.command import Log, Stop
    from crevasse.program import Program
    program, log = Program(Stop(None, "")), Log("--quiet" in sys.argv)
    advises = "--advise" in sys.argv
    columns = ["scene", "asked", *(
        ["true error", "seconds", "advised: true error", "seconds", "of the result"]
        if advises else ["bar", "true error", "tries", "seconds", "of the result",
                         "best of the sweep", "ratio"])]
    print("| " + " | ".join(columns) + " |\n|" + "---|" * len(columns))
    for name in [word for word in sys.argv[2:] if word[:2] != "--"] or (
            ADVISED if advises else CASES):
        Case(name, program, log).judge(name)


if __name__ == "__main__":
    main()
