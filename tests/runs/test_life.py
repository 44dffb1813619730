"""crevasse life: N of a strip against accurate values, with its error; laws against
their formulas; what ends the growth; interrupted, parallel and wrong commands."""

import json
import math
import os
import pathlib
import shutil
import signal
import subprocess
import types

import numpy
from scipy.integrate import trapezoid

from crevasse_run import (PROGRAM, SOURCE, check, check_below, check_close, execute,
                          execute_on, full, tier, wait_until)
from mpi_environment import ENVIRONMENT

os.environ["CREVASSE_PROGRAM"] = str(PROGRAM)
from crevasse.life_growth import Growth, Node, Reader, edges_of  # noqa: E402
from crevasse.life_lengths import Lengths  # noqa: E402
from crevasse.life_output import page, read  # noqa: E402
from crevasse.program import Program  # noqa: E402
from crevasse.results import parse_parameters  # noqa: E402
import crevasse  # noqa: E402

STRIP = pathlib.Path("strip.prm")
STRIP.write_text("""
subsection Geometry
  set Width        = 1
  set Height       = 1.5
  set Subdivisions = 40, 60
end
subsection Material
  set Young modulus = 1000
  set Viscosity     = none
end
subsection Loads
  set Period   = 2
  set Traction = 0; 0.5*(1 - cos(pi*t))
end
subsection Time integration
  set Steps per period = 2
end
subsection Crack tip
  set Crack growth law = paris
  set Paris factor     = 1
  set Paris exponent   = 3
end
""")
COARSE = ["--set", "Geometry/Subdivisions=10, 15", "--set", "Discretisation/Degree=1"]
EXACT = {3: 0.2354408, 4: 0.2561189}  # a/W from 0.1 to 0.6


def of_law(*settings):
    return [word for text in settings for word in ("--set", "Crack tip/" + text)]


def life(name, *words, scene=STRIP, status=0, fresh=True, run=execute):
    """life.json, the columns of life.csv, and what was printed; or the error."""
    directory = pathlib.Path("results") / name
    if fresh:
        shutil.rmtree(directory, ignore_errors=True)
    code, output, error = run("life", scene, "--output", directory, *words)
    check(code == status, f"{name}: exit status {code}, not {status}\n{output}{error}")
    print(output + error)
    if status == 2:
        return error
    return *read(directory), output + error


def test_strip():
    """Other constants and errors need no new run."""
    for m, exact in EXACT.items():
        for k, asked in enumerate(tier(("1e-3",), ("1e-2", "1e-3"))):
            first = m == 3 and k == 0
            found, table, _ = life(
                "strip", "--from", "0.1", "--to", "0.6", "--error", asked,
                *of_law(f"Paris exponent={m}"), fresh=first)
            check((found["new_runs"] > 0) == first and found["runs"] <= 7, f"{found}")
            difference = abs(found["N"] - exact)
            check_below(difference / exact, 5e-4, f"N, m = {m}, {asked}")
            check(difference / 2 <= found["N_error"] <= 5 * difference,
                  f"error {found['N_error']}, true {difference}")
            check_close(table["t"][-1] / table["N"][-1], 2, 1e-12, "time")
            check(found["stopped_by"] == "--to", "stopped by")
            check_close(table["x"][0] + table["a"][0], 1, 1e-12, "place of the tip")
    text = page(pathlib.Path("results/strip"))[0]
    check("periods from a = 0.1 to 0.6" in text, "the page")
    code, output, error = execute("figures", "results/strip")
    names = sorted(path.stem for path in pathlib.Path("results/strip/figures").iterdir())
    check(code == 0 and names == ["crack_length", "growth", "stress_intensity"],
          f"figures: {names}\n{output}{error}")
    from_python = crevasse.read("results/strip")
    check(from_python.summary["N"] == found["N"], "read from Python")
    check_close(from_python.table["a"].iloc[-1], 0.6, 1e-12, "table in Python")


def test_walker_and_toughness():
    """Between 0.1 and K_c, with R = 1/3; N is finite, and that of another quadrature."""
    found, table, _ = life(
        "walker", "--from", "0.2", "--to", "0.6", *COARSE, "--error", "0.2",
        "--set", "Loads/Traction=0; 2 - cos(pi*t)", *of_law(
            "Walker exponent=0.6", "Fracture toughness=6", "Paris threshold=0.1"),
        "--law", "walker")
    K, span = table["K_max"], table["Delta_K"]
    check_below(abs(span / K - 2 / 3).max(), 1e-6, "R")
    rates = span**3 * (2 / 3)**(-0.4 * 3) / (1 - K / 6)
    inner = slice(0, -1)
    check_below(abs(table["da_dN_fatigue"] / rates - 1)[inner].max(), 1e-9, "rates")
    check(found["stopped_by"] == "K_c" and found["to"] < 0.6, f"{found['stopped_by']}")
    check_close(K[-1], 6, 1e-6, "K at the end")
    a = numpy.concatenate([table["a"][inner], table["a"][-1:]])
    periods = numpy.concatenate([1 / rates[inner], [0.]])
    sum_of_trapezoids = (periods[1:] + periods[:-1]) @ numpy.diff(a) / 2
    check_close(found["N"] / sum_of_trapezoids, 1, 0.02, "N")


@full
def test_ends():
    """Threshold, table, ligament."""
    common = ["--from", "0.2", *COARSE, "--error", "0.5"]
    found, _, text = life("arrest", *common, "--to", "0.6", *of_law("Paris threshold=2"))
    check(found["infinite"] and found["N"] is None and found["to"] == 0.2
          and found["stopped_by"] == "arrest", f"{found}")
    check("no end" in text, text)
    pathlib.Path("law.csv").write_text("Delta_K,R,da_dN\n0.1,0,0.001\n3,0,27\n")
    found, table, _ = life("table", *common, "--to", "0.6", "--law", "table", *of_law(
        "Growth table=law.csv"))
    check(found["stopped_by"] == "law" and found["runs"] == 5, f"{found}")
    check_close(table["Delta_K"][-1], 3, 1e-6, "the table's end")
    check_below(abs(table["da_dN_fatigue"] / table["Delta_K"]**3 - 1).max(), 1e-9,
                "a straight line in logarithms")
    found, _, _ = life("ligament", *common)
    check(found["stopped_by"] == "ligament" and found["to"] == 0.8, f"{found}")


@full
def test_values_and_blocks():
    """Lengths given with values, as of mesh files; a scene and itself as a block."""
    lengths = "0.2,0.3,0.4,0.5,0.6"
    words = ["--vary", f"Geometry/Crack length={lengths}", *COARSE, "--error", "0.5"]
    one, table, _ = life("values", *words, "--lengths", lengths)
    check(one["from"] == 0.2 and one["to"] == 0.6 and one["runs"] == 5, f"{one}")
    two, blocks, _ = life("blocks", *words, "--block", f"{STRIP}=3")
    check_close(two["N"] / one["N"], 0.25, 1e-12, "N of four periods at once")
    check_close(two["t"] / one["t"], 1, 1e-12, "their time")


GEOMETRY = """
DefineConstant[ a = {0.2, Name "Parameters/Crack length"} ];
Point(1) = {0, 0, 0, 0.1}; Point(2) = {a, 0, 0, 0.05}; Point(3) = {1, 0, 0, 0.1};
Point(4) = {1, 1.5, 0, 0.1}; Point(5) = {0, 1.5, 0, 0.1};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 1};
Curve Loop(1) = {1:5};
Plane Surface(1) = {1};
Physical Curve("lip") = {1};
Physical Curve("ligament") = {2};
Physical Curve("top") = {4};
Physical Surface("strip") = {1};
"""


@full
def test_geometry():
    """The strip as a geometry that is meshed at each length; the scene's tip cycles are
    what is refined. The file is not that of its last mesh."""
    pathlib.Path("strip.geo").write_text(GEOMETRY)
    pathlib.Path("meshed.prm").write_text(STRIP.read_text() + """
subsection Geometry
  set Shape     = mesh file
  set Mesh file = strip.geo
end
subsection Boundary
  set Symmetry     = ligament
  set Contact      = lip
  set Loaded       = top
  set Fixed points = 1, 0: 1
end
subsection Discretisation
  set Degree = 2
end
subsection Refinement
  set Strategy = tip
  set Cycles   = 2
end
""")
    words = ["--to", "0.6", "--error"]
    found, table, output = life("meshed", "--from", "0.1", *words, "3e-3",
                                scene="meshed.prm")
    difference = abs(found["N"] - EXACT[3])
    check_below(difference / EXACT[3], 5e-3, "N of a geometry")
    check(difference / 2 <= found["N_error"] <= 5 * difference, f"{found['N_error']}")
    check("halves the cells" in output and found["new_runs"] == found["runs"], output)
    check_below(abs(table["x"] - table["a"]).max(), 1e-12, "place of the tip")
    again, _, _ = life("meshed", "--from", "0.1", *words, "3e-3", scene="meshed.prm",
                       fresh=False)
    check(again["new_runs"] == 0, f"{again}")
    check_close(again["N"] / found["N"], 1, 1e-12, "the same life")
    for old, new, message in (
            ("Crack length", "depth", "there are 0 constants with the name"),
            ("Surface(1) = {1}", "Surface(1) = {a > 0.2 ? 9 : 1}", "Gmsh cannot mesh it"),
            ("{1, 2};", "{1, 2}; SystemCall \"touch there\";", "SystemCall"))[tier(2, 0):]:
        pathlib.Path("strip.geo").write_text(GEOMETRY.replace(old, new))
        error = life("wrong", *words, "0.1", scene="meshed.prm", status=2)
        check(message in error, error)


@full
def test_mixed():
    """An inclined crack, pulled and pressed: ranges are equivalents of two modes, of which
    no K_min follows, and the crack would turn. The units are those of the scene."""
    pathlib.Path("inclined.geo").write_text(
        (SOURCE / "prm/inclined_crack.geo").read_text().replace(
            "a = 0.25;", "DefineConstant[ a = {0.25, Name \"crack length\"} ];"))
    words = [word for text in (
        "Geometry/Mesh file=inclined.geo", "Geometry/Refinements=0", "Refinement/Cycles=1",
        "Material/Viscosity=none", "Crack tip/Crack growth law=paris",
        "Crack tip/Paris factor=1e-9", "Units=m, MPa, h, K") for word in ("--set", text)]
    scene = SOURCE / "prm/inclined_crack.prm"
    _, table, output = life("mixed", "--to", "0.4", "--tip", "2", "--error", "0.5", *words,
                            scene=scene)
    check((table["Delta_K"] > table["K_max"]).all(), "ranges of K_II from -K to K")
    check(numpy.isnan(table["K_min"]).all() and numpy.isnan(table["K_op"]).all(), "K_min")
    check("from a = 0.25 m on the crack would turn, there by 4" in output, output)
    text = page(pathlib.Path("results/mixed"))[0]
    check("crack length a (m)" in text and "to 0.4 m" in text, "units")


@full
def test_missions():
    """With missions the state at a length is that of its age, as of a run."""
    words = [*COARSE, "--set", "Material/Viscosity=relaxation time", "--set",
             "Material/Relaxation time=0.1 + 1000*x^4", "--set",
             "Loads/Temperature=x*(1 - cos(pi*t))", "--set",
             "Material/Thermal expansion=1e-3", "--set", "Time integration/Steps per period=8"]
    K = []
    for missions in ("1", "1, 40"):
        ages = [*words, "--set", f"Periodic state/Missions={missions}"]
        found, _, _ = life("ages", "--from", "0.2", "--to", "0.6", "--error", "0.5", *ages)
        code, _, error = execute(STRIP, "--output", "results/age", "--force", "--quiet",
                                 "--set", "Geometry/Crack length=0.4", *ages)
        check(code == 0, error)
        tip = json.loads(pathlib.Path("results/age/summary.json").read_text())["crack_tip"]
        K += [node["K_max"] for node in found["lengths"] if abs(node["a"] - 0.4) < 1e-9]
        check_close(K[-1] / tip["K_I"]["largest"], 1, 1e-9, "K of a mission")
    check(abs(K[1] / K[0] - 1) > 0.01, f"the age does not count: {K}")


@full
def test_history():
    """Growth by C(t), which has no K, is that of a run with the law."""
    scene = SOURCE / "prm/power_law.prm"
    words = ["--set", "Geometry/Subdivisions=20, 20", "--set", "Refinement/Cycles=1",
             "--set", "Periodic state/Maximum periods=1"]
    _, table, _ = life("history", "--from", "10", "--to", "25", "--error", "0.5", *words,
                       scene=scene)
    code, _, error = execute(scene, "--output", "results/law", "--force", "--quiet", *words)
    check(code == 0, error)
    tip = json.loads(pathlib.Path("results/law/summary.json").read_text())
    check_close(table["da_dN_creep"][0] / tip["creep_integrals"][0]["da_dN"], 1, 1e-9,
                "growth by C(t)")
    check((table["da_dN_fatigue"] == 0).all(), "no fatigue")


def test_python():
    found = crevasse.life(STRIP, 0.2, 0.6, {"Geometry/Subdivisions": [10, 15],
                          "Discretisation/Degree": 1, "Output/Error bars": "true"},
                          error=0.5, output="results/python")
    check("bars" in crevasse.read("results/python/a_0.2").summary, "[Output] Error bars")
    check(found.summary["runs"] == 5 and found.table["N"].iloc[-1] == found.summary["N"],
          f"{found.summary}")


@full
def test_kink():
    """The tip of a short crack closes, that of a long one does not; N is that of more
    lengths and finer meshes, within the printed errors."""
    words = ["--set", "Loads/Traction=0; 1.2 - x*(1 - cos(pi*t))", "--set",
             "Geometry/Subdivisions=20, 30"]
    found, table, _ = life("kink", "--from", "0.1", "--to", "0.6", "--error", "2e-3", *words)
    check((table["K_min"] >= 0).all() and table["K_min"][0] == 0 < table["K_min"][-1],
          "K_min")
    lengths = ",".join(f"{0.05 * k:.2f}" for k in range(2, 13))
    every, _, _ = life("every", "--vary", f"Geometry/Crack length={lengths}", "--error",
                       "1e-6", *words, status=3)
    check(len(every["lengths"]) > len(found["lengths"]), f"{len(found['lengths'])}")
    check_close(found["N"], every["N"], 2 * found["N_error"], "N")


def reader(*settings):
    """Asks the program for the strip's law."""
    stop = types.SimpleNamespace(check=lambda: None, asked=lambda: "", end=math.inf)
    program = Program(stop)
    texts = [f"Crack tip/{text}" for text in settings]
    scene = parse_parameters(program.finish_parameters(
        program.start_parameters(STRIP, texts)))[0]
    return Reader(program, STRIP, texts, scene, None)


def test_infinite_plate():
    """N of da/dN = C (s sqrt(pi a))^m, from K at a few lengths."""
    C, s = 2e-7, 3.
    for m in (2.5, 3., 4.):
        a = numpy.array([0.5, 1., 2., 4., 5.])
        K = s * numpy.sqrt(math.pi * a)
        nodes = [Node(x, {"K_max": k, "Delta_K": k, "Delta_K_eff": k, "C_star": math.nan},
                      (True, True), 0., (0., 0.), 0., math.nan, (math.nan, math.nan))
                 for x, k in zip(a, K)]
        growth = Growth([reader(f"Paris factor={C}", f"Paris exponent={m}")], [1.], [nodes])
        _, N = growth.integrate(edges_of(a, 0.5, 5.))
        power = 1 - m / 2
        exact = (5.**power - 0.5**power) / (power * C * (s * math.sqrt(math.pi))**m)
        check_below(abs(N[-1] / exact - 1), 1e-9, f"infinite plate, m = {m}")
    edges = edges_of([0.5, numpy.nextafter(5., 0.)], 0.5, 5.)
    check((numpy.diff(edges) > 0.01).all(), "a length beside the end but for rounding")


def growth(columns, *settings):
    """Fatigue and creep for rows of drivers."""
    return reader(*settings).ask(columns)


def test_laws():
    K, span = numpy.array([4., 8., 9.9, 10., 12.]), numpy.array([2., 4., 6., 6., 6.])
    columns = {"K_max": K, "Delta_K": span, "Delta_K_eff": span / 2,
               "C_star": numpy.array([1e-3, 2e-3, 3e-3, 4e-3, math.nan])}
    walker = ["Crack growth law=walker", "Paris factor=1e-3", "Paris exponent=2.5",
              "Paris threshold=3", "Walker exponent=0.5", "Fracture toughness=10"]
    with numpy.errstate(divide="ignore"):
        expected = 1e-3 * span**2.5 * (span / K)**(-0.5 * 2.5) / numpy.maximum(1 - K / 10, 0)
        expected[0] = 0.
        smooth = 1e-3 * span**2.5 * (span / K)**(-0.5 * 2.5) * (
            1 - numpy.exp(0.7 * (1 - span / 3))) / (1 - numpy.exp(2 * (K / 10 - 1)))
    numpy.testing.assert_allclose(growth(columns, *walker)[0], expected, rtol=1e-12)
    numpy.testing.assert_allclose(
        growth(columns, *walker, "Threshold exponent=0.7", "Toughness exponent=2")[0][1:3],
        smooth[1:3], rtol=1e-12)
    fatigue, creep = growth(
        columns, "Crack growth law=sum", "Paris factor=1e-3", "Paris exponent=2",
        "Growth range=Delta K eff", "Creep factor=5", "Creep exponent=0.8")
    numpy.testing.assert_allclose(fatigue, 1e-3 * (span / 2)**2, rtol=1e-12)
    numpy.testing.assert_allclose(creep, 2 * 5 * columns["C_star"]**0.8, rtol=1e-12)
    # Linear between two R; a threshold; nothing beyond.
    pathlib.Path("two.csv").write_text(
        "# measured\nDelta_K,R,da_dN\n1,0,0\n2,0,1e-3\n8,0,16e-3\n2,0.5,4e-3\n8,0.5,64e-3\n")
    columns = {"K_max": [8., 16 / 3, 2., 4., 4., 1.], "Delta_K": [4., 4., 2., 1., 3.9, 1.]}
    columns |= {"Delta_K_eff": columns["Delta_K"], "C_star": [math.nan] * 6}
    fatigue, _ = growth(columns, "Crack growth law=table", "Growth table=two.csv")
    numpy.testing.assert_allclose(
        fatigue, [16e-3, 10e-3, 1e-3, math.nan, 1e-3 * 1.95**2 * (0.95 + 0.05 * 4), 0.],
        rtol=1e-12)
    # The toughness comes before all else, also below a threshold and under a steady load.
    broken = {"K_max": [10., 10.1, 9.9], "Delta_K": [0., 1., 1.],
              "Delta_K_eff": [0., 1., 1.], "C_star": [math.nan] * 3}
    for law in ("paris", "walker", "table"):
        fatigue, _ = growth(broken, f"Crack growth law={law}", "Paris factor=1",
                            "Paris threshold=3", "Fracture toughness=10",
                            "Growth table=two.csv")
        numpy.testing.assert_equal(fatigue[:2], [math.inf, math.inf], law)
        check(not fatigue[2] > 0., law)
    # R of mixed modes, of which the range may exceed the largest K, is not below 0.
    mixed = {"K_max": [4.], "Delta_K": [4.1], "Delta_K_eff": [4.1], "C_star": [math.nan]}
    numpy.testing.assert_allclose(
        growth(mixed, "Crack growth law=table", "Growth table=two.csv")[0],
        1e-3 * 2.05**2, rtol=1e-12)
    # A closed crack, of which R is not known, does not grow.
    closed = {"K_max": [0.], "Delta_K": [0.], "Delta_K_eff": [0.], "C_star": [math.nan]}
    for law in (["table", "Growth table=two.csv"],
                ["walker", "Paris factor=1", "Paris exponent=2"]):
        check(growth(closed, f"Crack growth law={law[0]}", *law[1:])[0][0] == 0., law[0])


@full
def test_constants_of_temperature():
    """A constant that is a formula of theta is the number that it has there: of drivers,
    in a run, and over the lengths of a life whose tip moves to other temperatures."""
    columns = {"K_max": [2., 3.], "Delta_K": [1., 2.], "Delta_K_eff": [1., 2.],
               "C_star": [1e-3, 2e-3], "theta": [100., 50.]}
    law = ["Crack growth law=sum", "Paris factor=1e-3*(1 + 0.01*theta)",
           "Paris exponent=2 + theta/100", "Creep factor=exp(theta/100)",
           "Creep exponent=0.5"]
    fatigue, creep = growth(columns, *law)
    numpy.testing.assert_allclose(fatigue, [2e-3, 1.5e-3 * 2**2.5], rtol=1e-12)
    numpy.testing.assert_allclose(
        creep, 2 * numpy.exp([1., 0.5]) * numpy.sqrt(columns["C_star"]), rtol=1e-12)
    t, K, theta = numpy.array([0., 0.5, 2.]), numpy.array([0., 4., 1.]), [0., 100., 200.]
    _, creep = growth({"t": t, "driver": K, "theta": theta}, *law[:1], "Paris factor=1",
                      "Creep growth parameter=stress intensity", *law[3:])
    speed = numpy.exp(numpy.array(theta) / 100) * numpy.sqrt(K)
    numpy.testing.assert_allclose(creep, [trapezoid(speed, t)], rtol=1e-12)

    def summary(name, *words):
        directory = pathlib.Path("results") / name
        code, _, error = execute(STRIP, "--output", directory, "--force", "--quiet",
                                 *COARSE, *words)
        check(code == 0, error)
        return json.loads((directory / "summary.json").read_text())
    warm = "Paris factor=1 + 0.01*theta"
    plain = summary("plain")["crack_tip"]["da_dN"]
    for temperature, factor in (("100", 2), ("100*t", 2), ("200*x", 2), ("0", 1)):
        found = summary("warm", "--set", f"Loads/Temperature={temperature}", *of_law(warm))
        tip = found["crack_tip"]
        check_close(tip["da_dN"] / plain, factor, 1e-12, f"growth at {temperature}")
        check(temperature == "0" or not any("not used" in text for text in
                                            found["warnings"]), f"{found['warnings']}")
    _, table, _ = life("warm_life", "--from", "0.2", "--to", "0.6", *COARSE, "--error", "0.5",
                       "--set", "Loads/Temperature=100*x", *of_law(
                           warm, "Fracture toughness=6 - 0.05*theta"))
    check_below(abs(table["da_dN_fatigue"] / table["Delta_K"]**3 / (
        1 + table["x"]) - 1)[:-1].max(), 1e-9, "over the lengths")
    check_close(table["K_max"][-1] / (6 - 5 * table["x"][-1]), 1, 1e-9, "at the toughness")
    for text, message in (("theta - 100", "Paris exponent = theta - 100: is -100 at theta"),
                          ("theta*x", "Paris exponent")):
        code, _, error = execute(STRIP, "--output", "results/wrong", "--force", "--quiet",
                                 *COARSE, *of_law(f"Paris exponent={text}"))
        check(code == 2 and message in error, error)


def test_transition():
    """A run, too, says how long creep needs to be steady, and how far the crack grows."""
    for length, warns in ((10, False), (30, True)):
        code, _, error = execute(
            SOURCE / "prm/crack_growth.prm", "--output", "results/transition", "--force",
            "--quiet", "--set", f"Geometry/Crack length={length}")
        check(code == 0, error)
        found = json.loads(pathlib.Path("results/transition/summary.json").read_text())
        check_close(found["crack_tip"]["transition_time"], 2e9 / 170000, 100, "G/C*")
        check(any("before creep is steady" in text for text in found["warnings"]) == warns,
              f"{found['warnings']}")
        check("creep is steady after" in pathlib.Path("results/transition/log.txt"
                                                      ).read_text(), "the log")


def test_next_length():
    """Lengths beyond the toughness, or where the law ends, do not take the weights from
    the others."""
    lengths = Lengths.__new__(Lengths)
    lengths.all = numpy.linspace(0.1, 0.9, 9)
    rates = numpy.exp(8 * lengths.all)
    first = lengths.next([0, 8], rates)
    check(first < 4, "the crack spends its time where it is short")
    for lost in (math.inf, math.nan):
        rates[7:] = lost
        check(lengths.next([0, 8], rates) == first, f"{lost}: another length")


def test_interrupted():
    """Killed and repeated: only what is missing is computed."""
    cells = ["--set", "Geometry/Subdivisions=20, 30"]
    words = ["life", STRIP, "--from", "0.1", "--to", "0.6", "--jobs", "1", "--output",
             "results/killed", *cells]
    directory = pathlib.Path("results/killed")
    shutil.rmtree(directory, ignore_errors=True)
    process = subprocess.Popen([PROGRAM, *map(str, words)], env=ENVIRONMENT,
                               stdout=subprocess.DEVNULL)
    wait_until(lambda: len([*directory.glob("a_*/finished.json")]) >= 2, process)
    process.send_signal(signal.SIGKILL)
    process.wait()
    kept = len([*directory.glob("a_*/finished.json")])
    check(2 <= kept < 6, f"{kept} runs before the end")
    found, table, output = life("killed", "--from", "0.1", "--to", "0.6", *cells, fresh=False)
    check(output.count("already there") == kept, output)
    check(found["new_runs"] == found["runs"] - kept, f"{found}")
    whole, other, _ = life("whole", "--from", "0.1", "--to", "0.6", *cells)
    check_below(abs(table["N"] - other["N"]).max() / whole["N"], 1e-9, "the same life")


@full
def test_parallel():
    words = ["--from", "0.2", "--to", "0.6", *COARSE, "--error", "0.5"]
    one, _, _ = life("one", *words)
    two, _, _ = life("two", *words, run=lambda *all_words: execute_on(2, *all_words))
    check_below(abs(two["N"] / one["N"] - 1), 1e-6, "on two processes")


def test_negative_K():
    """Delta_K and the law count K < 0 as 0: a load that presses for half of the period on
    a wide gap that stays open."""
    directory = pathlib.Path("results/pressed")
    code, _, error = execute(
        STRIP, "--output", directory, "--force", "--quiet", "--set",
        "Loads/Traction=0; cos(pi*t)", *COARSE, "--set", "Boundary/Gap=-1", "--set",
        "Discretisation/Singular functions=0")
    check(code == 0, error)
    tip = json.loads((directory / "summary.json").read_text())["crack_tip"]
    check_close(tip["K_I"]["smallest"] / tip["K_I"]["largest"], -1, 1e-9, "K_min")
    check_close(tip["Delta_K"], tip["K_I"]["largest"], 1e-12, "Delta_K")
    check_close(tip["da_dN"] / tip["Delta_K"]**3, 1, 1e-12, "the law")
    check(tip["da_dN_fatigue"] == tip["da_dN"] and tip["da_dN_creep"] == 0, "its parts")


BROKEN = (
    ("ends before it begins", ["--from", "0.6", "--to", "0.1"]),
    ("would leave the body, whose Width is 1", ["--from", "0.1", "--to", "1.5"]),
    ("Crack growth law = none: a life needs a law", ["--law", "none"]),
    ("Crack growth law", ["--law", "parris"]),
    ("Paris factor", of_law("Paris factor=0")),
    ("must be a file where", ["--law", "table"]),
    ("row 3: a row needs 3 numbers (Delta_K, R, da_dN), this one has 2", [
        "--law", "table", *of_law("Growth table=gaps.csv")]),
    ("there is one row for R = 0", ["--law", "table", *of_law("Growth table=row.csv")]),
    ("its crack is not known", ["--set", "Geometry/Shape=rectangle"]),
    ("2 lengths for the 3 values", [
        "--vary", "Geometry/Crack length=0.1,0.2,0.3", "--lengths", "0.1,0.2"]),
    ("must be at least 3 lengths that ascend", [
        "--vary", "Geometry/Crack length=0.1,0.3,0.2"]),
    ("at least 1e-8 and less than 1", ["--from", "0.1", "--to", "0.6", "--error", "0"]),
    ("is not a length", ["--from", "-1"]),
    ("SCENE=number", ["--block", "strip.prm"]),
    ("C* is not known: without viscosity nothing flows", [
        "--from", "0.2", "--to", "0.6", *COARSE, "--law", "creep",
        *of_law("Creep factor=1")]),
    ("is for Dimension = 2", ["--set", "Dimension=3"]),
    ("each run of a life has one crack length", [
        "--set", "Periodic state/Method=march", "--set", "Periodic state/Tolerance=0",
        "--set", "Material/Viscosity=relaxation time", "--set",
        "Material/Relaxation time=1", "--set", "Discretisation/Singular functions=0",
        "--set", "Geometry/Crack growth=1: 0.9"]),
    ("grows by 0.45, but the tip of the runs moves by 0.35", [
        "--vary", "Geometry/Crack length=0.15,0.3,0.5", "--lengths", "0.15,0.3,0.6",
        *COARSE]))


@full
def test_broken():
    pathlib.Path("gaps.csv").write_text("Delta_K,R,da_dN\n1,0,1e-3\n2,0,\n")
    pathlib.Path("row.csv").write_text("Delta_K,R,da_dN\n1,0,1e-3\n")
    for message, words in BROKEN:
        error = life("broken", *words, status=2)
        check(message in error, f"{message} is not in: {error}")
        check("Traceback" not in error, error)


@full
def test_crack_growth():
    """prm/crack_growth.prm: 14463.9 periods from 5 to 35 mm, of 21 lengths."""
    found, table, output = life("crack_growth", "--from", "5", "--to", "35", "--error",
                                "1e-3", scene=SOURCE / "prm/crack_growth.prm")
    check_close(found["N"], 14463.9, 7, "N")
    check(found["N_error"] < 1e-3 * found["N"], "its error")
    check("before creep is steady" in output and
          found["growth_before_creep_is_steady"] > 1.5, "the warning")
    check_close(found["lengths"][0]["transition_time"], 2e9 / 170000, 100, "G/C*")
    check((table["da_dN_creep"] > 0).all() and (table["da_dN_fatigue"] > 0).all(), "parts")


if __name__ == "__main__":
    for name, test in [*globals().items()]:
        if name.startswith("test_"):
            test()
