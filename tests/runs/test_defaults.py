"""The defaults: a scene of ten lines is accurate, and each choice that they make
is made where it applies, with its reason in the summary."""

import pathlib
import re
import sys

from crevasse_run import (SOURCE, check, check_below, check_close, execute, overrides,
                          run, sweep)

sys.path.insert(0, str(SOURCE / "source" / "python"))
from crevasse import report  # noqa: E402
from crevasse.advise_errors import choose_quantities  # noqa: E402
from crevasse.results import read_parameters  # noqa: E402
from crevasse.run_reader import Run  # noqa: E402

SCENE = """subsection Geometry
  set Shape        = edge crack
  set Crack length = 0.5
end
subsection Material
  set Young modulus   = 13000
  set Poisson ratio   = 0.2
  set Relaxation time = 60
end
subsection Loads
  set Period   = 600
  set Traction = 0; 10*sin(2*pi*t/600)
end
"""

# The same on 56 x 56 cells with 1280 steps: the largest opening of the mouth and
# K_I.
OPENING, INTENSITY = 1.430566e-02, 35.41195


def run_defaults(name, settings=(), status=0):
    path = pathlib.Path(name + ".prm")
    path.write_text(SCENE)
    return run(path, name, settings, status)


def test_ten_lines():
    """0.1 % of the opening and of K_I, and which method finds the periodic
    state."""
    results = run_defaults("ten_lines")
    summary = results.summary
    opening = max(results.table("probe_mouth.csv")["opening"])
    check_below(abs(opening / OPENING - 1.), 1e-3, "error of the opening")
    intensity = summary["crack_tip"]["K_I"]["largest"]
    check_below(abs(intensity / INTENSITY - 1.), 1e-3, "error of K_I")
    check(summary["periodic_method"].startswith("fourier (automatic"),
          summary["periodic_method"])
    check(summary["converged"], "periodic")


# Settings; whether there are singular functions and K_I; a word of the reason of
# the first.
CHOICES = {
    "centre": (["Geometry/Shape=centre crack"], True, True, "built-in"),
    "tip": (["Refinement/Strategy=tip", "Refinement/Cycles=2"], True, True,
            "built-in"),
    "no crack": (["Geometry/Shape=rectangle"], False, False, "no built-in crack"),
    "two materials": (["Material/Young modulus=13000*if(x<0.5,1,2)"], False,
                      False, "depends on x"),
    "gap": (["Boundary/Gap=-0.001"], False, True, "Gap"),
    "mean": (["Material/Plane state=plane strain",
              "Discretisation/Volumetric strain=mean", "Discretisation/Degree=1"],
             False, True, "Volumetric strain = mean"),
    "multigrid": (["Linear solver/Type=gmg", "Geometry/Subdivisions=4, 4",
                   "Geometry/Refinements=2"], False, True, "Type = gmg"),
    "creep": (["Material/Viscosity=power law", "Material/Creep coefficient=1e-9",
               "Material/Creep exponent=3"], False, False, "nonlinear"),
    "revolution": (["Material/Plane state=axisymmetric",
                    "Geometry/Shape=centre crack"], False, True, "axisymmetric"),
    "open lip": (["Boundary/Contact=none"], True, True, "built-in"),
    "no lip": (["Boundary/Contact=none", "Boundary/Open crack=none"], False, False,
               "Contact"),
    "space": (["Dimension=3", "Loads/Traction=0; 10*sin(2*pi*t/600); 0",
               "Geometry/Subdivisions=4, 2, 1"], False, False, "Dimension = 3"),
    "asked for": (["Discretisation/Singular functions=3"], True, True, "= 3"),
}


def test_choices():
    for name, (settings, singular, intensity, reason) in CHOICES.items():
        results = run_defaults(name.replace(" ", "_"), settings + [
            "Periodic state/Maximum periods=1", "Periodic state/Tolerance=0",
            "Time integration/Steps per period=10"])
        effects = results.summary["effects"]
        why = effects["singular functions"]["why"]
        print(f"{name}: {effects['singular functions']['on']}, {why}; "
              f"{effects['stress intensity']}")
        check(effects["singular functions"]["on"] == singular and reason in why,
              f"{name}: singular functions {effects['singular functions']}")
        check(effects["stress intensity"]["on"] == intensity
              and ("a crack in the plane" in effects["stress intensity"]["why"]
                   ) == intensity,
              f"{name}: stress intensity {effects['stress intensity']}")
        tables = (results.directory / "crack_tip.csv").exists()
        check(tables == intensity, f"{name}: crack_tip.csv")
        read = Run(results.directory)
        probes = {path.name for path in results.directory.glob("probe_*.csv")}
        check({f"probe_{probe}.csv" for probe in read.probes} == probes
              and not read.damages, f"{name}: {read.probes}, {read.damages}")


def test_schemes():
    """Trapezoid where all instants are solved for at once, else sdirk2."""
    for settings, scheme in (([], "trapezoid"),
                             (["Loads/Traction=0; if(t<300,10,-10)"], "sdirk2"),
                             (["Periodic state/Method=march"], "sdirk2"),
                             (["Material/Young modulus=13000*(1+0.1*sin(2*pi*t/600))"],
                              "sdirk2")):
        path = pathlib.Path("scheme.prm")
        path.write_text(SCENE)
        code, output, error = execute("--check", path, *overrides(settings))
        check(code == 0, error)
        line, = (line for line in output.splitlines() if "  time:" in line)
        check(scheme in line, f"{settings}: {line}")


def test_scripts():
    """Sweeps, pictures and advice know what automatic choices give."""
    scene, steps = pathlib.Path("probe.prm"), "Time integration/Steps per period="
    scene.write_text(SCENE)
    rows, _ = sweep("probe", scene, "--vary", steps + "10,20", "--reference", steps + "40")
    check("error:probe_mouth/u" in rows[0], rows[0])
    code, output, error = execute("figures", "results/probe/reference")
    check(code == 0 and "figure3_opening" in output, output + error)
    used, _ = read_parameters(pathlib.Path("results/probe/reference/used.prm"))
    check(choose_quantities("crack_tip/K_I", used, {}) == ["crack_tip/K_I"], "advice")


def test_asked_for_or_not():
    """K_I that is asked for is an error where it cannot be had."""
    settings = ["Material/Young modulus=13000*if(x<0.5,1,2)"]
    scene = pathlib.Path("asked_for.prm")
    scene.write_text(SCENE)
    paris = ["Crack tip/Crack growth law=paris", "Crack tip/Paris factor=1"]
    for more in (["Crack tip/Stress intensity=true"], paris,
                 ["Crack tip/Method=williams fit"]):
        code, _, error = execute("--check", scene, *overrides(settings + more))
        check(code == 2 and "is not the same on all sides" in error, error)
    for settings, reason in (
            (["Boundary/Contact=none", "Boundary/Open crack=none",
              *paris], "the mesh has no crack tip"),
            (["Material/Plane state=axisymmetric", "Material/Viscosity=isotropic",
              "Material/Viscous Poisson ratio=0.4", *paris], "its elastic Poisson"),
            (["Crack tip/Radius=0.9"], "[Crack tip] Radius = 0.9: must be at most")):
        code, _, error = execute("--check", scene, *overrides(settings))
        check(code == 2 and reason in error, f"{settings}: {error}")


def test_ratio_varies():
    """K of a ring is not known where Poisson's ratio varies in time: it is switched off
    before computing, unless it is asked for."""
    settings = ["Geometry/Shape=centre crack", "Material/Plane state=axisymmetric",
                "Material/Poisson ratio=0.2+0.001*theta", "Material/Viscosity=none",
                "Loads/Temperature=10*sin(2*pi*t/600)"]
    effect = run_defaults("ratio", settings).summary["effects"]["stress intensity"]
    check(not effect["on"] and "must not vary in time" in effect["why"], f"{effect}")
    code, output, error = execute("--check", "ratio.prm", *overrides(settings))
    check(code == 0 and "no K_I" in output and "must not vary" in output, error)
    code, _, error = execute("--check", "ratio.prm", *overrides(
        settings + ["Crack tip/Stress intensity=true"]))
    check(code == 2 and "must not vary in time" in error, error)


def test_not_used():
    """How K_I is found does not matter where none is looked for."""
    for setting in ("Radius=0.1", "Method=interaction integral"):
        results = run_defaults("not_used", ["Geometry/Shape=rectangle",
                                            f"Crack tip/{setting}"])
        name, value = setting.split("=")
        check(f"[Crack tip] {name} = {value} is not used: automatic: no boundary has the "
              "role Contact, Crack or Open crack" in results.summary["warnings"],
              f"{results.summary['warnings']}")


def test_displacements():
    """Those of the nodes count, beside singular functions as without: the upper right
    corner moves most. A stress of the size of the modulus is noticed."""
    for functions in (0, 2):
        results = run_defaults("displacements", [
            "Material/Young modulus=10", "Output/Probes=corner: 1, 1",
            f"Discretisation/Singular functions={functions}"])
        corner = results.summary["probes"]["corner"]
        check_close(results.summary["extremes"]["displacement"],
                    max(abs(end) for name in ("u_1", "u_2")
                        for end in corner[name].values()), 1e-9, "largest")
        check(any(text.startswith("displacements reach")
                  for text in results.summary["warnings"]), "not noticed")


def test_singular_stress():
    """A largest stress that no mesh bounds is called that, with its place."""
    pathlib.Path("corner.msh").write_text("""$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
8
1 0 0 0
2 1 0 0
3 2 0 0
4 0 1 0
5 1 1 0
6 2 1 0
7 0 2 0
8 1 2 0
$EndNodes
$Elements
6
1 1 2 1 1 1 2
2 1 2 1 1 2 3
3 1 2 2 2 7 8
4 3 2 9 9 1 2 5 4
5 3 2 9 9 2 3 6 5
6 3 2 9 9 4 5 8 7
$EndElements
""")
    for name, place, settings in (
            ("tip", "crack tip (0.5, 0)", ()),
            ("rectangle", "", ("Geometry/Shape=rectangle",)),
            ("corner", "re-entrant corner (1, 1)", (
                "Geometry/Shape=mesh file", "Geometry/Mesh file=corner.msh",
                "Boundary/Symmetry=1", "Boundary/Loaded=2", "Boundary/Contact=none",
                "Boundary/Fixed points=0, 0: 1", "Geometry/Refinements=2"))):
        results = run_defaults(f"singular_{name}", settings)
        why = results.summary.get("no_largest_stress", "")
        check(place in why if place else not why, f"{name}: {why}")
        check(("no mesh bounds it" in (results.directory / "log.txt").read_text())
              == bool(place), "the log")
        text = (report.main([str(results.directory)]), (
            results.directory / "report.html").read_text())[1]
        check(("no mesh bounds" in text) == bool(place), "the report")


def test_field_times():
    """Of the last period: those of the extremes, all, or equally spaced ones."""
    short = ["Periodic state/Method=march", "Periodic state/Maximum periods=2",
             "Periodic state/Tolerance=0", "Time integration/Steps per period=16",
             "Loads/Traction=0; 10*sin(2*pi*t/600) - 3"]
    steps = [600 + 37.5 * k for k in range(17)]
    for name, settings, wanted in (
            ("automatic", [], None), ("all", ["Output/Field times=all"], steps),
            ("equal", ["Output/Field times=4 instants"], steps[::4]),
            ("listed", ["Output/Field times=150, 301"], [750, 900, 1200]),
            ("none", ["Output/Field times="], [1200])):
        results = run_defaults(f"field_times_{name}", short + settings)
        text = (results.directory / "solution.pvd").read_text()
        times = [float(t) for t in re.findall(r'timestep="([^"]*)"', text)]
        if wanted is None:
            lip, mouth = results.table("contact.csv"), results.table("probe_mouth.csv")
            last = [k for k, t in enumerate(lip["t"]) if t >= 600]
            K = results.table("crack_tip.csv")["K_I"]
            wanted = sorted({lip["t"][max(last, key=values.__getitem__)] for values in (
                lip["force"], mouth["opening"], K, [-x for x in K])} | {1200})
            check(len(wanted) > 3, f"extremes at {wanted}")
        check(times == wanted, f"{name}: fields at {times} instead of {wanted}")
    scene = pathlib.Path("field_times.prm")
    scene.write_text(SCENE)
    for value in ("often", "0 instants", "-1", "700"):
        code, _, error = execute("--check", scene, "--set",
                                 f"Output/Field times={value}")
        check(code == 2 and "[Output] Field times" in error, f"{value}: {error}")


test_field_times()
test_ten_lines()
test_choices()
test_scripts()
test_schemes()
test_asked_for_or_not()
test_ratio_varies()
test_not_used()
test_displacements()
test_singular_stress()
