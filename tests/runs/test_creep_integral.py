"""C(t) of a crack in a body that creeps by a power of the stress: against energies
of neighbouring crack lengths, the singular stress at the tip, and what must not
change it."""

from cracked import BOTTOM, CRACK, STEADY_CREEP, TOP, square, square_scene, write_rings
import numpy
from crevasse_run import (FULL, check, check_below, check_close, execute, full, overrides,
                          plain, run, run_on, tier)
from singular_field import SingularField

from crevasse import run_page, tip_figure
from crevasse.fields import Fields
from crevasse.run_reader import Run

E, A = 1000., 2e-3

SCENE = f"""
subsection Geometry
  set Shape = edge crack
  set Subdivisions = 20, 20
end
subsection Refinement
  set Strategy = tip
  set Cycles = 4
end
subsection Material
  set Plane state = plane strain
  set Young modulus = {E}
  set Poisson ratio = 0.3
  set Viscosity = power law
  set Creep exponent = 3
  set Creep coefficient = {A}
end
""" + STEADY_CREEP


def C_of(results, name="creep_integral.csv"):
    return results.table(name)["C_t"]


def law(n):
    """A coefficient by which the exponents creep about alike here."""
    return [f"Material/Creep exponent={n}",
            f"Material/Creep coefficient={A * 10 ** (-(n - 3) / 2)!r}"]


def potential(results, n):
    """Of both halves, which the crack's length changes by C*: the power of the
    loads over n + 1."""
    table = results.table("load_work.csv")
    t, work = table["t"], table["load_work"]
    return 2 / (n + 1) * (work[-1] - work[-2]) / (t[-1] - t[-2])


def test_energies_of_crack_lengths():
    for n, state in tier([(3, "strain")],
                         [(n, state) for n in (3, 5)
                          for state in ("strain", "stress")]):
        settings = [*law(n), f"Material/Plane state=plane {state}"]
        shorter, here, longer = (
            run(SCENE, f"length_{a}", [*settings, f"Geometry/Crack length={a}"])
            for a in (0.495, 0.5, 0.505))
        expected = (potential(longer, n) - potential(shorter, n)) / 0.01
        table = here.table("creep_integral.csv")
        check_close(table["C_t"][-1] / expected, 1, 5e-3,
                    f"C* over that of the energies, n = {n}, plane {state}")
        check_below(table["C_t_error"][-1] / expected, 2e-2, "its estimated error")


def elastic_K(scene, settings):
    return run(scene, "elastic", [
        *settings, "Material/Viscosity=none", "Crack tip/Creep integral=false",
        "Crack tip/Stress intensity=true"]).table("crack_tip.csv")["K_I"][-1]


def test_linear():
    """The stress of a linear flow is elastic: with the exponent 1 C* is K² A in
    plane stress, as J is K²/E."""
    plane_stress = ["Material/Plane state=plane stress"]
    C = C_of(run(SCENE, "exponent_1", [*law(1), *plane_stress]))[-1]
    check_close(C / (A * 10 * elastic_K(SCENE, plane_stress) ** 2), 1, 2e-3,
                "C* of the exponent 1 over its closed form")


def rings(m, ratio, smallest=1e-5):
    write_rings("rings.msh", m, ratio, smallest)
    return SCENE.replace("Shape = edge crack", "Shape = mesh file\n"
                         "  set Mesh file = rings.msh") + f"""
subsection Boundary
  set Symmetry = {BOTTOM}
  set Contact = {CRACK}
  set Loaded = {TOP}
  set Fixed points = 0, 0: 1
end
"""


# I_n and the hoop stress ahead of the singular field of Hutchinson, Rice and
# Rosengren in plane strain (Shih, Tables of Hutchinson-Rice-Rosengren singular field
# quantities, Brown University, 1983).
SINGULAR = {3: (5.51, 1.94), 5: (5.02, 2.22)}


@full
def test_after_a_step_load():
    """The stress at the tip is the singular field of C(t), in steady creep and long
    before, when C(t) falls like 1/t. That C(t) is K²(1-nu²)/((n+1)Et) then (Riedel,
    Rice, ASTM STP 700, 1980) is an estimate: it takes J to be independent of its path
    in a body that does not deform in proportion."""
    scene = rings(*tier((6, 1.2), (8, 1.15)))
    steps = [10 ** (k / 16 - 6) for k in range(97)]
    r = 3e-5
    for n in tier([3], [3, 5]):
        settings = [
            *law(n), "Loads/Period=1", "Refinement/Strategy=none",
            "Time integration/Steps=" + ", ".join(map(repr, steps)),
            "Discretisation/Degree=1", "Discretisation/Volumetric strain=mean",
            f"Output/Probes=near: {-r}, 0"]
        results = run(scene, f"step_{n}", settings)
        small = C_of(run(scene, f"small_{n}", [*settings, "Crack tip/Radius=0.002"]))
        K = elastic_K(scene, settings)
        C, t = C_of(results), results.table("creep_integral.csv")["t"]
        stress = results.table("probe_near.csv")["s_22"][2:]
        estimate = K ** 2 * (1 - 0.3 ** 2) / ((n + 1) * E)
        transition = estimate / C[-1]
        I, hoop = SINGULAR[n]
        for at in (2e-3, 1e-2, 1.):
            k = min(range(len(t)), key=lambda k: abs(t[k] - at))
            by_stress = A * 10 ** (-(n - 3) / 2) * I * r * (stress[k] / hoop) ** (n + 1)
            check_close(C[k] / by_stress, 1, 0.05,
                        f"n = {n}: C(t) by the stress at the tip, t = {t[k]:.2g}, "
                        f"{t[k] / transition:.2g} of the transition time; over the "
                        f"estimate by K {C[k] / estimate * t[k]:.3f}")
            check_close(small[k] / C[k], 1, 0.02, "over a small square")


def test_what_varies():
    """Body force, temperature and a law that varies do not make it depend on the
    square."""
    scene = rings(4, 1.3, 1e-3)
    cases = {"force": ["Loads/Body force=0; 2"],
             "heated": ["Material/Thermal expansion=1e-3",
                        "Loads/Temperature=(x^2 + y)*t"],
             "graded": [f"Material/Creep coefficient={A}*exp(3*x)",
                        "Material/Young modulus=1000*(1 + 0.9*x)"],
             "exponents": ["Material/Creep exponent=3 + x"]}
    for name, settings in tier({"all at once": sum(cases.values(), [])},
                               cases).items():
        large, small = (
            C_of(run(scene, name, [
                *settings, "Refinement/Strategy=none",
                "Material/Plane state=plane stress", f"Crack tip/Radius={r}"]))
            for r in (0.5, 0.1))
        worst = max(abs(a / b - 1) for a, b in zip(large, small, strict=True))
        check_below(worst, 1e-2, f"{name}: squares of 0.5 and 0.1")


def test_two_lips():
    """Both halves, upright and turned, on one process and two. Rates are recovered
    from both sides of the ligament then, so that a half model is not the same."""
    settings = ["Material/Viscosity=power law", "Material/Creep exponent=3",
                "Material/Creep coefficient=3e-8", "Discretisation/Degree=2",
                "Time integration/Scheme=sdirk2", "Periodic state/Maximum periods=1",
                "Periodic state/Tolerance=0", "Crack tip/Creep integral=true",
                "Time integration/Newton tolerance=1e-10"]
    square("half.msh", half=True)
    square("both.msh")
    half = C_of(run(square_scene("half.msh", half=True), "half", settings))
    both = C_of(run(square_scene("both.msh"), "both", settings),
                "creep_integral_1.csv")
    square("turned.msh", degrees=17.)
    turned = C_of(run(square_scene("turned.msh", 17.), "turned", settings),
                  "creep_integral_1.csv")
    pairs = [(both, half, 0.02, "both halves"), (turned, both, 1e-6, "turned by 17 degrees")]
    if FULL:
        shared = C_of(run_on(2, "both.prm", "shared", settings), "creep_integral_1.csv")
        pairs.append((shared, both, 1e-6, "by two processes"))
    for C, expected, bound, what in pairs:
        largest = max(map(abs, expected))
        check_below(max(abs(a - b) for a, b in zip(C, expected, strict=True))
                    / largest, bound, what)


def test_singular_field():
    """The table of the report, at its exponents and between them."""
    for state, rows in tip_figure.SINGULAR.items():
        for n in tier((2.5, 10), (1, 1.4, 2, 2.5, 3, 4, 5, 7, 10, 15, 20, 50)):
            shown = tip_figure.singular_field(state, n)
            exact = SingularField(n, state == "plane stress").quantities()
            check_below(max(abs(a / b - 1) for a, b in zip(shown, exact, strict=True)),
                        2e-4 if n in [row[0] for row in rows] else 1e-2,
                        f"singular field, {state}, n = {n}")


def test_picture():
    """The stress ahead of the tip beside its singular field, in steady creep."""
    results = run(SCENE, "picture", [
        "Output/Fields=vtu", "Refinement/Cycles=9",
        "Discretisation/Degree=1", "Discretisation/Volumetric strain=mean"])
    seen = Run(results.directory)
    tip, table = tip_figure.tips_of(seen)[0]
    r, stress = tip_figure.line_ahead(Fields(seen.choose_instant(4.)[1]), tip)
    _, singular = tip_figure.singular_stress(seen, seen.tables[table], 4.)
    near = (1e-3 < r) & (r < 1e-2)
    check_below(numpy.abs(stress[near] / singular(r[near]) - 1).max(), 0.1,
                "stress ahead of the tip in the report")
    page, *_, damages = run_page.page(results.directory)
    for words in ("Stress ahead of the crack tip", "Creep at the crack",
                  "Creep integral C(t)"):
        check(words in page and not damages, f"{words} in the report: {damages}")


def test_growth():
    """da/dt = D C(t)^phi over a period in which the crack opens and is pressed
    together."""
    results = run(SCENE, "growth", [
        "Loads/Traction=0; sin(2*pi*t/4)", "Crack tip/Crack growth law=creep",
        "Crack tip/Creep growth parameter=C(t)", "Crack tip/Creep factor=2",
        "Crack tip/Creep exponent=0.75", "Time integration/Step control=uniform",
        "Periodic state/Maximum periods=3"])
    table = results.table("creep_integral.csv")
    t, C = table["t"][-41:], table["C_t"][-41:]
    speed = [2 * max(c, 0.) ** 0.75 for c in C]
    expected = sum((t[k + 1] - t[k]) * (speed[k] + speed[k + 1]) / 2
                   for k in range(40))
    tip = results.summary["creep_integrals"][0]
    check_close(tip["da_dN"] / expected, 1, 1e-12, "growth by C(t)")
    check(min(C) < 1e-3 * max(C) and 1 <= tip["largest"] / max(C[:-1]) < 1.01,
          "C(t) where the crack is pressed together")


@full
def test_jumps():
    """Of the load where the period ends, and within it: no row is a difference
    across them, and growth goes on beside them."""
    loads = (("0; if(t < 2, 1, 1.5)", [0.2, 4.2, 2.2, 6.2]), ("0; 1 + t/4", [0.2, 4.2]),
             ("0; if(t < 3.9, 1, 1.5)", [0.2, 4.2]))
    for load, first in loads[:tier(1, None)]:
        results = run(SCENE, "jumps", [
            f"Loads/Traction={load}", "Time integration/Step control=uniform",
            "Periodic state/Maximum periods=2", "Crack tip/Crack growth law=creep",
            "Crack tip/Creep growth parameter=C(t)", "Crack tip/Creep factor=1"])
        table = results.table("creep_integral.csv")
        t = table["t"]
        begins = [t[0]] + [b for a, b in zip(t, t[1:]) if b - a > 0.15]
        check(len(begins) == len(first) and max(
            abs(a - b) for a, b in zip(begins, sorted(first), strict=True)) < 1e-9,
              f"{load}: rows begin at {begins}")
        tip = results.summary["creep_integrals"][0]
        whole = (t[-1] - 4) * sum(table["C_t"][-20:]) / 20
        check(min(table["C_t"]) > 0 and 0.2 * whole < tip["da_dN"] < 5 * whole
              and tip["last"] == table["C_t"][-1], f"{load}: {tip}")


def test_jump_between_steps():
    """Adaptive steps end at it, named or not; other steps cause a warning."""
    load = "Loads/Traction=0; if(t < 2.3, 1, 1.5)"
    found, named = (
        run(SCENE, f"jump_{steps}", [
            load, "Time integration/Step control=adaptive",
            "Time integration/Relative tolerance=1e-3", "Geometry/Subdivisions=8, 8",
            "Refinement/Strategy=none", "Crack tip/Radius=0.25",
            f"Time integration/Steps={steps}"])
        for steps in ("", "2.3"))
    for value in ("largest", "last"):
        one, other = (results.summary["creep_integrals"][0][value]
                      for results in (found, named))
        check_close(one / other, 1, 1e-3, f"{value} C(t) where no step is named")


CAUSES = [
    ("jump within a step", ["Loads/Traction=0; if(t < 2.3, 1, 3)"],
     ["Loads/Traction=0; if(t < 2, 1, 3)"]),
    ("so that elements lock", [],
     ["Discretisation/Degree=1", "Discretisation/Volumetric strain=mean"])]


def test_warnings():
    with open("warning.prm", "w") as file:
        file.write(plain(SCENE))
    for words, cause, mended in CAUSES:
        for settings in cause, mended:
            status, log, _ = execute("--check", "warning.prm", *overrides(settings))
            check(status == 0 and (words in " ".join(log.split()))
                  == (settings is cause), f"{words}: {settings}: {log}")


REFUSED = [
    ("maxwell", ["Material/Viscosity=relaxation time"], "Viscosity = power law"),
    ("singular", ["Discretisation/Singular functions=1"], "Singular functions = 0"),
    ("radius", ["Crack tip/Radius=0.6"], "must be at most 0.5"),
    ("cells", ["Crack tip/Radius=0.004"], "instead of twice as far"),
    ("force at the tip", ["Loads/Traction=1; 1"], "which the support at the crack"),
    ("without", ["Crack tip/Creep integral=false", "Crack tip/Crack growth law=creep",
                 "Crack tip/Creep factor=1",
                 "Crack tip/Creep growth parameter=C(t)"],
     "needs Creep integral = true"),
    ("sum", ["Crack tip/Crack growth law=sum", "Crack tip/Creep factor=1",
             "Crack tip/Paris factor=1", "Crack tip/Creep growth parameter=C(t)"],
     "Crack growth law = creep"),
    ("paris", ["Crack tip/Crack growth law=paris", "Crack tip/Paris factor=1"],
     "Creep growth parameter = C(t)"),
    ("by K", ["Crack tip/Crack growth law=creep", "Crack tip/Creep factor=1",
              "Crack tip/Creep growth parameter=stress intensity"],
     "Creep growth parameter = C(t)")]


def test_refusals():
    with open("refused.prm", "w") as file:
        file.write(plain(SCENE))
    for name, settings, words in REFUSED:
        status, _, error = execute("--check", "refused.prm", *overrides(settings))
        print(f"{name}: {status}: {error.strip()}")
        check(status == 2 and words in error, name + " is refused")


if __name__ == "__main__":
    test_energies_of_crack_lengths()
    test_linear()
    test_after_a_step_load()
    test_what_varies()
    test_two_lips()
    test_singular_field()
    test_picture()
    test_growth()
    test_jumps()
    test_jump_between_steps()
    test_warnings()
    test_refusals()
