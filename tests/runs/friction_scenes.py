"""Seeded scenes of a straight or kinked crack whose lips bear friction: random loads that
press, shear and open it, coefficients, materials, schemes; and what must not change their
results: ranks, an end by SIGKILL, units, a rotation."""

import math
import random
import subprocess

import cracked
from crevasse_run import Results, check, check_below, run, run_on, wait_until
from interrupted_runs import check_same_bytes, checkpoints, command, fresh
from mpi_environment import ENVIRONMENT

HALF = 4.  # of the side of the plate; that of the crack is 1
MATERIALS = {"elastic": "none", "Maxwell": "chain\n  set Chain = 1: 0.4",
             "spring": "chain\n  set Chain = 0.6: 0.5"}
# Largest difference, relative to the largest value of the kind, of solutions with other
# rounding, whose instants of slip are found to 1e-8 of a step or so.
ALLOWED = 1e-6


def grid(n):
    positions = cracked.steps(0, 1, n)
    while positions[-1] < HALF:
        positions.append(min(HALF, positions[-1] + 1.6 * (positions[-1] - positions[-2])))
    return [-x for x in positions[:0:-1]] + positions


class Scene:
    """A random scene, however it is turned or scaled."""

    def __init__(self, seed):
        dice = random.Random(seed)
        self.name = f"friction_{seed}"
        self.kink = dice.choice((0., dice.uniform(-0.5, 0.5)))
        self.n = dice.randint(4, 8)
        self.degree = dice.choice((1, 2))
        self.angle = dice.uniform(10, 50)
        self.mu = dice.choice(("0.1", "0.4", "1", "0.4 + 0.3*sin(2*pi*t)"))
        self.material = dice.choice(tuple(MATERIALS))
        self.scheme = ("automatic" if self.material == "elastic" else
                       dice.choice(("automatic", "heun", "sdirk2", "exponential")))
        self.steps = dice.randint(10, 20)
        mean = dice.uniform(-1.2, 0.3)  # of the stress across the crack
        xx, yy, xy = (
            f"{a!r} + {b!r}*sin(2*pi*t + {phase!r})" for a, b, phase in
            ((dice.uniform(-1, 1), dice.uniform(0, 0.5), dice.uniform(0, 6)),
             (mean, dice.uniform(0.2, 1), dice.uniform(0, 6)),
             (dice.uniform(-0.4, 0.4), dice.uniform(0.2, 1), dice.uniform(0, 6))))
        self.tractions = {cracked.LEFT: (f"-({xx})", f"-({xy})"), cracked.RIGHT: (xx, xy),
                          cracked.BOTTOM: (f"-({xy})", f"-({yy})"), cracked.TOP: (xy, yy)}

    def __str__(self):
        return (f"{self.name}: kink {self.kink:.2f}, {self.n} cells of degree "
                f"{self.degree}, mu {self.mu}, {self.material}, {self.scheme}, "
                f"{self.steps} steps")

    def write(self, name, angle=0., length=1., stress=1.):
        """The mesh and the text of the scene, turned and in other units."""
        turn = cracked.turned(angle)

        def place(point):
            x, y = point
            return tuple(length * value for value in turn(
                (x, y + self.kink * min(max(x, 0.), 1.) * (1 - abs(y) / HALF))))
        cracked.write_block(
            f"{name}.msh", (grid(self.n), grid(self.n)),
            lambda middle, normal: normal == 1 and middle[1] == 0 and abs(middle[0]) < 1,
            place)
        c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        traction = " | ".join(
            f"{side}: {stress!r}*({c!r}*({x}) - {s!r}*({y})); "
            f"{stress!r}*({s!r}*({x}) + {c!r}*({y}))"
            for side, (x, y) in self.tractions.items())
        left, right = (", ".join(map(repr, place((x, -HALF)))) for x in (-HALF, HALF))
        return f"""
subsection Geometry
  set Shape     = mesh file
  set Mesh file = {name}.msh
end
subsection Boundary
  set Crack        = {cracked.CRACK}
  set Loaded       = {", ".join(map(str, self.tractions))}
  set Fixed points = {left}; {right}: 2
  set Friction coefficient = {self.mu}
end
subsection Discretisation
  set Degree = {self.degree}
end
subsection Material
  set Plane state   = plane strain
  set Young modulus = {stress!r}
  set Poisson ratio = 0.3
  set Viscosity     = {MATERIALS[self.material]}
end
subsection Loads
  set Period   = 1
  set Traction = {traction}
end
subsection Time integration
  set Scheme           = {self.scheme}
  set Steps per period = {self.steps}
end
subsection Periodic state
  set Maximum periods = 3
  set Tolerance       = 0
end
subsection Crack tip
  set Stress intensity = true
end
subsection Output
  set Fields = none
end
"""

    def run(self, variant="", **how):
        name = self.name + variant
        return run(self.write(name, **how), name)


def difference(one, other, length=1., stress=1.):
    """Largest difference of K and of the pairs' slip and tractions, as a part of what is
    allowed; the other one in its own units."""
    kinds = ((("friction.csv",), ("slip",), length),
             (("friction.csv",), ("tangential_traction", "normal_pressure"), stress),
             (("crack_tip_1.csv", "crack_tip_2.csv"), ("K_I", "K_II"),
              stress * math.sqrt(length)))
    worst = 0.
    for tables, columns, unit in kinds:
        pairs = [(a, b / unit) for name in tables for column in columns
                 for a, b in zip(one.table(name)[column], other.table(name)[column],
                                 strict=True)]
        # Where all pairs stick, K and the slip are rounding alone; loads are about 1.
        size = max(0.01, *(abs(a) for a, _ in pairs))
        worst = max(worst, max(abs(a - b) for a, b in pairs) / size / ALLOWED)
    return worst


def kill_and_resume(scene, whole):
    """Whether a run was killed in its second period or later; it is resumed then."""
    name = scene.name + "_killed"
    directory = fresh(name)
    call = {"scene": f"{scene.name}.prm", "settings": ["Output/Checkpoint every=1"]}
    process = subprocess.Popen(command(directory, **call), stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL, env=ENVIRONMENT)
    wait_until(lambda: checkpoints(directory), process)
    process.kill()
    process.wait()
    if (directory / "summary.json").exists() or not checkpoints(directory):
        return False
    subprocess.run(command(directory, more=["--resume"], **call), check=True,
                   stdout=subprocess.DEVNULL, env=ENVIRONMENT)
    check_same_bytes(whole, Results(directory), f"{name}, resumed")
    return True


def check_scene(seed):
    """Checks one scene; returns its run, and whether it was killed and resumed."""
    scene = Scene(seed)
    print(scene, flush=True)
    whole = scene.run()
    certificate = whole.summary["certificate"]
    for part in ("penetration", "tension", "complementarity"):
        check_below(certificate[part], 1e-10, f"{scene.name}: certificate of {part}")
    # Missing where all pairs stick, or are open.
    check_below(certificate.get("friction", 0.), 1e-10, f"{scene.name}: friction")
    for name, other, units in (
            ("two ranks", run_on(2, f"{scene.name}.prm", scene.name + "_2"), {}),
            ("three ranks", run_on(3, f"{scene.name}.prm", scene.name + "_3"), {}),
            ("other units", scene.run("_units", length=1e3, stress=1e-6),
             {"length": 1e3, "stress": 1e-6}),
            (f"turned by {scene.angle:.0f} degrees",
             scene.run("_turned", angle=scene.angle), {})):
        check_below(difference(whole, other, **units), 1.,
                    f"{scene.name}: {name}, part of the allowed difference")
        check(whole.summary["friction"]["kind"] == other.summary["friction"]["kind"],
              f"{scene.name}: {name}: {other.summary['friction']}")
    return whole, kill_and_resume(scene, whole)


def check_scenes(seeds):
    """Checks scenes; some of them must be killed in time, slide, and open."""
    n_killed, kinds = 0, []
    for seed in seeds:
        results, was_killed = check_scene(seed)
        n_killed += was_killed
        kinds.append(results.summary["friction"]["kind"])
    print(f"{n_killed} of {len(kinds)} killed and resumed; "
          + ", ".join(f"{kinds.count(kind)} {kind}" for kind in sorted(set(kinds))))
    check(n_killed > 0, "some of the runs were killed")
    check(set(kinds) - {"open", "shakedown"}, "some of them slide")
