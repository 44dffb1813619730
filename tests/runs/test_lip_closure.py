"""How long the lip is closed, and at which intensity it opens: against closed forms
of elastic bodies, on two ranks, resumed, and for each of several cracks."""

import math
import pathlib
import re

from cracked import BOTTOM, CRACK, LEFT, PLATE, TOP, steps, write_block
from crevasse_run import check, check_below, check_close, full, run, run_on, tier
from interrupted_runs import SCENE as RAOUS
from interrupted_runs import (COMMON, REDISTRIBUTES, finish, fresh, interrupt,
                              reference)

import crevasse
from crevasse import report

ELASTIC = """
subsection Material
  set Viscosity = none
end
subsection Crack tip
  set Stress intensity = true
end
"""
ONE_CRACK = PLATE + ELASTIC + """
subsection Geometry
  set Subdivisions = 8, 4
end
subsection Loads
  set Traction = 0; 10*(sin(2*pi*t/600) + 0.3)
end
subsection Time integration
  set Steps per period = 50
end
subsection Output
  set Probes = mouth: 1, 0
end
"""
# A crack in a body that creeps, in a period of which all is found at once.
CREEPING = ONE_CRACK.replace("set Viscosity = none", "")
# The first scene of doc/scenes.md under a mean load that closes its crack for a while.
CLOSES = PLATE + """
subsection Geometry
  set Shape        = edge crack
  set Crack length = 0.5
end
subsection Loads
  set Traction = 0; 10*sin(2*pi*t/600) - 2
end
"""
TWO_CRACKS = ELASTIC + f"""
subsection Geometry
  set Shape     = mesh file
  set Mesh file = two.msh
end
subsection Boundary
  set Crack        = {CRACK}
  set Loaded       = {BOTTOM}, {TOP}
  set Fixed points = 0, -1; 2, -1: 2
end
subsection Loads
  set Period   = 600
  set Traction = 0; 10*(1 - x)*sin(2*pi*t/600)*if(y > 0, 1, -1)
end
"""


OPENS = """
subsection Geometry
  set Shape        = centre crack
  set Crack length = 0.375
  set Subdivisions = 8, 8
end
subsection Discretisation
  set Degree             = 1
  set Singular functions = 0
end
subsection Material
  set Plane state           = plane strain
  set Young modulus         = 428.22
  set Viscosity             = isotropic
  set Viscous modulus       = 320.744
  set Viscous Poisson ratio = 0.45
end
subsection Loads
  set Traction = 0; 0.42822*(0.17425 + cos(2*pi*t+3.7174) + 0.1351*cos(4*pi*t+0.81314))
end
subsection Time integration
  set Scheme           = trapezoid
  set Steps per period = 20
end
subsection Periodic state
  set Method    = anderson
  set Tolerance = 1e-6
end
subsection Crack tip
  set Stress intensity = true
end
subsection Output
  set Fields = none
end
"""


def test_uniform():
    """Uniform traction closes all of the lip at once, where it is negative."""
    results = run(ONE_CRACK, "uniform")
    tip, lip = results.summary["crack_tip"], results.table("lip.csv")
    expected = math.acos(0.3) / math.pi
    check_close(tip["closed_part"]["wholly"], expected, 1e-7, "closed part")
    check_below(tip["closed_part"]["partly"], 1e-6, "partly")
    check(results.summary["closed_part"] == tip["closed_part"], "of all lips")
    check(lip["x"] == [0.625, 0.75, 0.875, 1] and set(lip["y"]) == {0}
          and set(lip["lip"]) == {1}, f"nodes of the lip: {lip}")
    for part, pressure in zip(lip["closed_part"], lip["largest_pressure"]):
        check_close(part, expected, 1e-7, "closed part of a node")
        check_close(pressure, 7, 0.03, "largest pressure")
    check_close(lip["largest_opening"][-1],
                results.summary["probes"]["mouth"]["opening"]["largest"], 1e-14, "opening")
    largest = tip["K_I"]["largest"]
    check_below(abs(tip["K_opening"]) / largest, 1e-5, "K_op")
    check_close(tip["Delta_K_eff"], largest - tip["K_opening"], 1e-9, "Delta K_eff")
    check_close(tip["Delta_K"], largest - tip["K_I"]["smallest"], 1e-9, "Delta K")


def test_on_axis():
    """With quadratic elements a uniform pressure p puts no force on a node on the axis
    of a body of revolution: it is closed, and has the pressure p, as its neighbours.
    Of two lips, too."""
    load = "1e-3*sin(2*pi*t)"
    write_block("axis.msh", (steps(0, 2, 8), steps(-1, 1, 8)),
                lambda middle, normal: normal == 1 and middle[1] == 0 and middle[0] < 1)
    for name, more in (("one", ["Geometry/Shape=centre crack",
                                f"Loads/Traction=0; {load}"]),
                       ("two", ["Geometry/Shape=mesh file", "Geometry/Mesh file=axis.msh",
                                f"Boundary/Crack={CRACK}",
                                f"Boundary/Loaded={BOTTOM}, {TOP}",
                                f"Boundary/Symmetry={LEFT}",
                                "Boundary/Fixed points=2, -1: 2",
                                f"Loads/Traction=0; y*{load}"])):
        for degree in (1, 2):
            results = run(ELASTIC, f"axis_{name}_{degree}", [
                "Material/Plane state=axisymmetric", f"Discretisation/Degree={degree}",
                "Crack tip/Stress intensity=false",
                "Time integration/Steps per period=20", "Output/Probes=axis: 0, 0", *more])
            what = f"{name}, degree {degree}: "
            check_close(results.summary["closed_part"]["wholly"], 0.5, 1e-6,
                        what + "wholly closed")
            check_below(results.summary["closed_part"]["partly"], 1e-6, what + "partly")
            lip, contact = results.table("lip.csv"), results.table("contact.csv")
            check(lip["x"][0] == 0, "a contact node on the axis")
            check(min(lip["largest_opening"]) > 0, "all open")
            for part, pressure in zip(lip["closed_part"], lip["largest_pressure"]):
                check_close(part, 0.5, 1e-6, what + "closed part of a node")
                check_close(pressure / 1e-3, 1, 1e-9, what + "pressure of a node")
            for t, closed, pressure, of_probe in zip(
                    contact["t"], contact["closed_nodes"], contact["largest_pressure"],
                    results.table("probe_axis.csv")["pressure"], strict=True):
                expected = max(0, -1e-3 * math.sin(2 * math.pi * t))
                check(closed == (len(lip["x"]) if expected > 1e-9 else 0),
                      f"{what}{closed} closed nodes at {t}")
                check_below(abs(pressure - expected) / 1e-3, 1e-9, what + "largest pressure")
                check_below(abs(of_probe - expected) / 1e-3, 1e-9, what + "at the probe")


def test_axis_first():
    """A gap that vanishes on the axis alone: there the lip touches first, and opens last,
    at load 0."""
    for degree in (1, 2):
        results = run(ELASTIC, f"axis_first_{degree}", [
            "Material/Plane state=axisymmetric", "Geometry/Shape=centre crack",
            "Geometry/Subdivisions=8, 8", f"Discretisation/Degree={degree}",
            "Discretisation/Singular functions=0", "Material/Young modulus=1e5",
            "Boundary/Gap=-3e-6*x", "Loads/Traction=0; sin(2*pi*t)"])
        tip = results.summary["crack_tip"]
        check_below(abs(tip["K_opening"]) / tip["K_I"]["largest"], 1e-5, "K_op")
        check_close(sum(tip["closed_part"].values()), 0.5, 1e-5, "closed at all")


def test_gap():
    """Until it touches at the mouth, all is proportional to the load."""
    gap = 1e-3
    results = run(ONE_CRACK, "gap", [f"Boundary/Gap=-{gap}"])
    tip, lip = results.summary["crack_tip"], results.table("lip.csv")
    mouth = results.summary["probes"]["mouth"]["opening"]["largest"]
    expected = -tip["K_I"]["largest"] * gap / (mouth - gap)
    largest = tip["K_I"]["largest"]
    check(expected < -0.1 * largest, "it opens under compression")
    check_close(tip["K_opening"] / largest, expected / largest, 1e-5, "K_op")
    check_close(tip["Delta_K_eff"], largest - tip["K_opening"], 1e-9, "Delta K_eff")
    check_close(tip["opening_ratio"], tip["K_opening"] / largest, 1e-12, "ratio")
    parts = lip["closed_part"]
    check(parts == sorted(parts) and 0 < parts[-1] < 0.5, f"the mouth first: {parts}")
    check_close(tip["closed_part"]["wholly"] + tip["closed_part"]["partly"],
                parts[-1], 1e-7, "closed at all")
    check_close(tip["closed_part"]["wholly"], parts[0], 1e-7, "wholly closed")


def test_phases():
    """The mouth of a lip whose gap closes there opens with the load: K_op is 0 and
    the lip is closed in part for the time of a negative load, whatever the steps and
    wherever they meet the load."""
    expected = 1 - math.acos(0.9) / math.pi
    for n, phases in ((20, (0, 0.5, 5)), (40, tier((7, 20.25), range(40))), (80, (13,))):
        for phase in phases:
            tip = run(ONE_CRACK, f"phase_{n}_{phase}", [
                f"Loads/Traction=0; 10*(sin(2*pi*(t/600 + {phase / n})) - 0.9)",
                f"Time integration/Steps per period={n}", "Geometry/Subdivisions=8, 8",
                "Boundary/Gap=-4e-3*(1-x)"]).summary["crack_tip"]
            what = f"{n} steps, phase {phase}"
            check_below(abs(tip["K_opening"]) / tip["K_I"]["largest"], 1e-4,
                        f"K_op, {what}")
            check_close(tip["Delta_K_eff"] / tip["K_I"]["largest"], 1, 1e-4, what)
            check_close(sum(tip["closed_part"].values()), expected, 1e-7, what)


@full
def test_creeping_phases():
    """With creep K_op, the closed part and K_min, at a kink where the lip closes,
    approach those of many steps by the second order."""
    def intensity(method, n, phase):
        tip = run(CREEPING, f"creeping_{method}_{n}", [
            f"Loads/Traction=0; 10*(sin(2*pi*(t/600 + {phase / n})) - 0.3)",
            f"Time integration/Steps per period={n}", "Material/Relaxation time=600",
            f"Periodic state/Method={method}"]).summary["crack_tip"]
        return (tip["K_opening"], tip["closed_part"]["wholly"],
                tip["K_I"]["smallest"], tip["K_I"]["largest"])
    opening, closed, smallest, largest = intensity("fourier", 320, 0)
    for method in ("fourier", "march"):
        for n in (20, 40, 80):
            for phase in (0, 0.5):
                values = intensity(method, n, phase)
                what = f"{method}, {n} steps, phase {phase}"
                check_below(abs(values[0] - opening) / largest, 5. / n**2, what)
                check_below(abs(values[1] - closed), 1. / n**2, f"closed, {what}")
                check_below(abs(values[2] - smallest) / largest, 5. / n**2,
                            f"smallest, {what}")


def test_extremes():
    """Extremes are those of the motion, wherever the steps meet the load: of an elastic
    body in proportion to the load."""
    def extremes(name, load, *settings):
        summary = run(ONE_CRACK, name, [f"Loads/Traction=0; {load}", *settings]).summary
        tip, mouth, own = (summary["crack_tip"], summary["probes"]["mouth"],
                           summary["extremes"])
        return {"K_I": tip["K_I"]["largest"], "u_2": mouth["u_2"]["largest"],
                "G": tip["energy_release_rate"]["largest"]**0.5,
                "opening": own["opening"], "at the mouth": mouth["opening"]["largest"]}, {
                "force": own["contact_force"], "pressure": own["pressure"],
                "s_22": mouth["s_22"]["smallest"], "p": mouth["pressure"]["largest"],
                "lip.csv": max(crevasse.read(f"results/{name}").tables["lip.csv"][
                    "largest_pressure"])}
    opened, _ = extremes("opened", "10")
    _, closed = extremes("closed_by", "-10")
    for n, bound in ((20, 1e-3), (40, 1e-4)):
        for phase in (0, 0.1, 0.25, 0.4, 0.5):
            found = extremes(f"extremes_{n}", f"10*sin(2*pi*(t/600 + {phase / n}))",
                             f"Time integration/Steps per period={n}")
            for mine, theirs in zip(found, (opened, closed)):
                for name, value in mine.items():
                    check_close(value / theirs[name], 1, bound,
                                f"{name}, {n} steps, phase {phase}")


def test_creeping_extremes():
    """Those of a body that creeps, whose lip closes within a step, against values of
    1600 steps."""
    scene = pathlib.Path("closes.prm")  # with the program's defaults
    scene.write_text(CLOSES)
    exact = {"K": -38.1408, "force": 4.32233, "opening": 9.65931e-3, "s_11": -0.168405}
    for name, bound, settings in (
            ("trapezoid", 1e-3, ()),
            ("rk4", 1e-3, ("Time integration/Scheme=rk4",
                           "Time integration/Locate contact events=true",
                           "Periodic state/Method=anderson"))):
        summary = run(scene, f"closes_{name}", settings).summary
        tip, mouth = summary["crack_tip"], summary["probes"]["mouth"]
        for what, value in (("K", tip["K_I"]["smallest"]),
                            ("force", summary["extremes"]["contact_force"]),
                            ("opening", summary["extremes"]["opening"]),
                            ("s_11", mouth["s_11"]["smallest"])):
            check_close(value / exact[what], 1, bound, f"{name}: {what}")
        sample = min(crevasse.read(f"results/closes_{name}").tables["crack_tip.csv"]["K_I"])
        check(sample / exact["K"] < 0.98, "the lip closes between samples")


def test_no_opening():
    """Where there is no K_op the summary says why."""
    tip = run(ONE_CRACK, "open", ["Loads/Traction=0; 10*(sin(2*pi*t/600) + 1.5)"]
              ).summary["crack_tip"]
    check(tip["K_opening"] is None and "throughout" in tip["no_K_opening"], f"{tip}")
    check_close(tip["Delta_K_eff"], tip["Delta_K"], 0., "all is effective")
    check(tip["closed_part"] == {"wholly": 0, "partly": 0}, f"{tip}")
    tip = run(ONE_CRACK, "closed", ["Loads/Traction=0; 10*(sin(2*pi*t/600) - 1.5)"]
              ).summary["crack_tip"]
    check(tip["K_opening"] is None and "wholly open" in tip["no_K_opening"]
          and tip["Delta_K_eff"] is None, f"{tip}")
    check_close(tip["closed_part"]["wholly"], 1, 1e-12, "closed")


def test_failed_trial():
    """A load that has no value between two samples, where the lip opens: the run is
    summarised, without K_op."""
    opens = 600 - math.asin(0.3) * 600 / (2 * math.pi)
    results = run(ONE_CRACK, "no_value", [
        "Loads/Traction=0; 10*(sin(2*pi*t/600) + 0.3) "
        f"+ 0*sqrt(abs(t - {opens!r}) - 0.02)"])
    tip, warnings = results.summary["crack_tip"], results.summary["warnings"]
    check(tip["K_opening"] is None and tip["Delta_K_eff"] is None
          and "no finite value at" in tip["no_K_opening"], f"{tip}")
    check(any("no finite value at" in warning for warning in warnings), f"{warnings}")
    log = (results.directory / "log.txt").read_text()
    check("no K_op: the instant at which a lip changes" in log, "the log has the reason")
    check_close(tip["closed_part"]["wholly"], math.acos(0.3) / math.pi, 0.02, "closed")


def test_certified_trials():
    """Problems that were solved for K_op are certified, too; the counters are those of
    the search."""
    results = run(ONE_CRACK, "certified")
    solved = re.search(r"certificate of (\d+) solves",
                       (results.directory / "log.txt").read_text())
    calls = results.summary["calls"]["contact problems"]
    check(int(solved[1]) == calls > results.summary["counters"]["vi_solves"] > 50,
          f"{solved[0]}, {calls} calls, {results.summary['counters']}")


def test_touching():
    """A lip that touches at an instant without pressing is always open: that of a
    periodic motion without mean load, and one that flows open."""
    for name, mean in (("touching", 0), ("flowing", 1.5)):
        results = run(CREEPING, name, [
            f"Loads/Traction=0; 10*(sin(2*pi*t/600) + {mean})",
            "Time integration/Steps per period=20", "Periodic state/Method=fourier",
            "Periodic state/Tolerance=1e-6"])
        tip = results.summary["crack_tip"]
        check(set(results.table("contact.csv")["closed_nodes"]) == {0}, "none presses")
        check(tip["K_opening"] is None and "throughout" in tip["no_K_opening"], f"{tip}")
        check_close(tip["Delta_K_eff"], tip["Delta_K"], 0., "all is effective")
        check(tip["closed_part"] == {"wholly": 0, "partly": 0}, f"{tip}")
        check(set(results.table("lip.csv")["closed_part"]) == {0}, "nodes")
    # A search ends with forces of its tolerance where the flow opens the lip.
    tip = run(OPENS, "tolerance").summary["crack_tip"]
    check(tip["K_opening"] is None and "throughout" in tip["no_K_opening"], f"{tip}")
    check_close(tip["Delta_K_eff"], tip["Delta_K"], 0., "all is effective")


def test_jumps():
    """A closed elastic crack has K_I = 0 until it opens, also within a jump or bend.
    """
    for name, load in (("square", "if(t < 300, 1, -1)"),
                       ("late_square", "if(t < 300, -1, 1)"),
                       ("ramp", "max(-1, min(1, (t - 300)/12))"),
                       ("bends", "if(t < 252, -1, if(t < 264, -0.5, 1))")):
        tip = run(ONE_CRACK, name, [f"Loads/Traction=0; 10*{load}"]).summary["crack_tip"]
        check_below(abs(tip["K_opening"]) / tip["Delta_K"], 1e-9, f"{name}: K_op")
        check_close(tip["Delta_K_eff"] / tip["Delta_K"], 1, 1e-9, f"{name}: effective")
    results = run(ONE_CRACK, "tooth", ["Loads/Traction=0; 10*if(t < 300, t/150 - 1, -1)"])
    tip, lip = results.summary["crack_tip"], results.table("lip.csv")
    whole = run(ONE_CRACK, "whole", ["Loads/Traction=0; 10"])
    largest = whole.summary["crack_tip"]["K_I"]["largest"]
    check_close(tip["K_I"]["largest"] / largest, 1, 1e-9, "tooth: K before the jump")
    check_below(abs(tip["K_opening"]) / largest, 1e-5, "tooth: K_op")
    check_close(tip["closed_part"]["wholly"], 0.75, 1e-6, "tooth: closed part")
    for node in lip["closed_part"]:
        check_close(node, 0.75, 1e-6, "tooth: closed part of a node")
    check_close(results.summary["extremes"]["opening"],
                whole.summary["extremes"]["opening"], 1e-9, "tooth: opening")
    lip = run(ONE_CRACK, "pressed_tooth", ["Loads/Traction=0; -10*t/600"]
              ).table("lip.csv")
    check_close(lip["largest_pressure"][1] / 10, 1, 0.01, "tooth: pressure")


def same(one, other, what):
    for key in ("Delta_K", "K_opening", "Delta_K_eff"):
        a, b = (r.summary["crack_tip"][key] for r in (one, other))
        check_below(abs(a - b) / abs(a), 1e-9, f"{what}: {key}")
    mine, theirs = one.table("lip.csv"), other.table("lip.csv")
    for column in mine:
        size = max(map(abs, mine[column])) or 1
        check_below(max(abs(a - b) for a, b in zip(mine[column], theirs[column],
                                                   strict=True)) / size,
                    1e-9, f"{what}: {column}")


@full
def test_ranks_and_resume():
    settings = REDISTRIBUTES + COMMON + [
        "Periodic state/Maximum periods=2", "Crack tip/Stress intensity=true",
        "Geometry/Subdivisions=14, 14", "Time integration/Steps per period=32"]
    alone, _ = reference("alone", settings)
    check(0 < alone.table("lip.csv")["closed_part"][-1] < 1, "it opens and closes")
    same(alone, run_on(2, RAOUS, "two_ranks", settings), "two ranks")
    directory = fresh("resumed")
    code, error = interrupt(directory, settings, "stop file", 32 + 15)
    check(code in (0, 5), error)
    same(alone, finish(directory, settings), "resumed")


def test_two_cracks():
    """Bent, one of two cracks opens where the other one closes."""
    axes = steps(0, 2, 32), steps(-1, 1, 32)

    def is_crack(middle, normal):
        return (normal == 1 and middle[1] == 0
                and (0.25 < middle[0] < 0.75 or 1.25 < middle[0] < 1.75))
    write_block("two.msh", axes, is_crack)
    results = run(TWO_CRACKS, "two")
    tips, lip = results.summary["crack_tips"], results.table("lip.csv")
    check(len(tips) == 4 and set(lip["lip"]) == {1, 2}, "two lips with four tips")
    together = results.summary["closed_part"]
    check_below(together["wholly"], 1e-6, "both closed")
    check_close(together["partly"], 1, 1e-6, "one of them closed")
    for tip in tips:
        check_close(tip["closed_part"]["wholly"], 0.5, 1e-7, "closed part")
        check_close(tip["Delta_K_eff"] / tip["equivalent_intensity"]["largest"], 1,
                    1e-4, "Delta K_eff")
    try:
        crevasse.read("results/two").crack_tip()
        check(False, "tables of four tips, and none is chosen")
    except crevasse.ResultsError as error:
        check("4 tables crack_tip_N.csv" in str(error), f"{error}")
    for number, begin in ((1, 0.25), (2, 1.25)):
        x = [x for lip_number, x in zip(lip["lip"], lip["x"]) if lip_number == number]
        check(x == sorted(x) and begin < x[0] and x[-1] < begin + 0.5, f"{x}")


def test_tip_without_intensity():
    """A tip between two materials has no K, and takes it from no other tip unless K is
    asked for."""
    jump = "Material/Young modulus=13000*if(x<0.75, 1, 2)"
    results = run(TWO_CRACKS, "jump", [jump, "Crack tip/Stress intensity=automatic"])
    *others, last = results.summary["crack_tips"]
    check(abs(last["position"][0] - 0.75) < 1e-12 and "all sides" in last["no_K"],
          f"{last}")
    check(len(others) == 3 and all(tip["Delta_K"] > 0 for tip in others)
          and results.table("crack_tip_3.csv"), "K of the other tips")
    check(not crevasse.read("results/jump").damages, "tables of the others are missed")
    check(report.main(["results/jump"]) == 0, "a report of it")
    run(TWO_CRACKS, "refused", [jump], status=2)


test_uniform()
test_on_axis()
test_axis_first()
test_gap()
test_phases()
test_creeping_phases()
test_extremes()
test_creeping_extremes()
test_no_opening()
test_failed_trial()
test_certified_trials()
test_touching()
test_jumps()
test_ranks_and_resume()
test_two_cracks()
test_tip_without_intensity()
