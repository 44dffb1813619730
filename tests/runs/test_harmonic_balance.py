"""The periodic state found by harmonic balance: against the trapezoidal rule, whose
state it is, against closed forms; what it does not compute, and what it refuses."""

import math
import re

from crevasse_run import (check, check_below, execute, full, overrides,
                          run_on, tier)
from periodic_scenes import (ALTERNATING, BODY, COMMON, FOURIER, LIP, MIXED, PERIOD,
                             TWO_HARMONICS, case, compute, difference, log, method,
                             period, relaxation, steps, traction)

CASES = [(name, ratio) for name in "abc"
         for ratio in tier((1,), (0.1, 1, 10))]


def test_is_the_trapezoidal_state():
    """Averaged steps of the trapezoidal rule end at the same state, also where
    relaxation times span eight decades, which no march would see the end of."""
    worst = 0.
    decades = ["Material/Relaxation time=60*10^(8*(1 - x^2))"]
    hot = [(name, [traction(formula)] + decades + more) for name, formula, more in (
        ("alternating", ALTERNATING, []), ("two harmonics", TWO_HARMONICS, []),
        ("flows open", "0; 10*sin(2*pi*t/600) + 3", []),
        ("closed", "0; 10*sin(2*pi*t/600) - 20", []),
        ("gap", "0; 10*sin(2*pi*t/600) - 2", ["Boundary/Gap=-0.0003"]),
        ("chain", ALTERNATING, ["Material/Viscosity=chain", "Material/Chain="
                                "0.6: 60*10^(8*(1 - x^2)); 0.4: 300"]))]
    for degree in tier((1,), (1, 2)):
        for name, settings in [(f"({name}), tau/T = {ratio}", case(name, ratio))
                               for name, ratio in CASES] + hot:
            settings = settings + [f"Discretisation/Degree={degree}"]
            found = compute("fourier", settings + FOURIER)
            averaged = compute("averaged", settings + method("averaged"))
            here = difference(found, averaged)
            print(f"{name}, Q{degree}: fourier and {averaged.summary['periods']} "
                  f"averaged periods differ by {here:.1e}")
            worst = max(worst, here)
    check_below(worst, 1e-9, "worst")


def test_mean_pressure():
    """That of the secular problem is the mean of the samples."""
    for name, settings in (("b", case("b", 1)), ("c", case("c", 1)),
                           ("mixed", [traction(MIXED)] + relaxation(1, 0.6))):
        for degree in tier((1,), (1, 2)):
            found = compute("mean", settings + FOURIER + [
                f"Discretisation/Degree={degree}"])
            secular = found.summary["secular"]["per_probe"]
            expected = [secular[p]["mean_pressure"] for p in LIP]
            means = []
            for probe in LIP:
                samples = period(found, f"probe_{probe}.csv", "pressure")
                means.append(sum(samples) / len(samples))
            size = max(map(abs, expected))
            check(size > 0.1, "a mean pressure")
            print(f"({name}), Q{degree}: mean pressures {expected}, rates of "
                  f"opening {[secular[p]['beta'][1] for p in LIP]}")
            check_below(max(abs(a - b) for a, b in zip(means, expected))
                        / size, 1e-10, "mean of the samples")


def test_closed_forms():
    """s = F(t) s_el: no force on the lip, or no opening of it."""
    F = "10*(1 + 0.3*x)*"
    for name, comparison, load in (
            ("alternating", "open", "10*sin(2*pi*t/600)"),
            ("not a sine", "open", F + "(sin(2*pi*t/600) + cos(6*pi*t/600))"),
            ("tensile", "open", F + "(1 + sin(2*pi*t/600))"),
            ("compressive", "closed", F + "(-1.2 + sin(2*pi*t/600)^3)")):
        for ratio in tier((10,), (0.1, 10)):
            for n in tier((7,), (40, 7)):
                found = compute("closed_form", [
                    traction("0; " + load),
                    f"Output/Elastic comparison={comparison}"]
                    + relaxation(ratio) + steps(n) + FOURIER)
                result = found.summary["elastic_comparison"]
                check_below(result["stress_difference"], 1e-10,
                            f"{name}, tau/T = {ratio}, {n} steps: stress")


BOX = """\
set Dimension = 3
subsection Geometry
  set Shape        = edge crack
  set Thickness    = 0.3
  set Subdivisions = 4, 3, 2
end
subsection Material
  set Young modulus   = 13000
  set Poisson ratio   = 0.3
  set Relaxation time = if(z < 0.15, 300, 1200)
end
subsection Loads
  set Period   = 600
  set Traction = 0; 10*sin(2*pi*t/600)*(1 + z) - 2; 0
end
subsection Time integration
  set Steps per period = 14
end
"""
BOX_PROBES = ["Output/Probes=mouth: 1, 0, 0; inside: 0.75, 0, 0.15; "
              "body: 0.3, 0.6, 0.1"]


@full
def test_everything_else():
    """Whatever the method takes besides: against the trapezoidal rule, from
    rest. (From there the lip keeps openings that are not needed.)"""
    base = case("c", 1)
    thermal = ["Material/Thermal expansion=1e-5",
               "Loads/Temperature=40*x*sin(2*pi*t/600 + 1) - 30*y + 7"]
    alternatives = {
        "chain": ["Material/Viscosity=chain",
                  "Material/Chain=0.5: 100; 0.3: 600; 0.2: 4000"],
        "chain that differs": ["Material/Viscosity=chain",
                               "Material/Chain=0.6: if(x < 0.7, 100, 900); "
                               "0.4: 2000"],
        "thermal strain": thermal,
        "thermal strain, uniform tau": thermal + relaxation(1),
        "body force": ["Loads/Body force=3*cos(4*pi*t/600); "
                       "-2 + 8*x*sin(2*pi*t/600)"],
        "gap below zero": ["Boundary/Gap=-1e-4*x"],
        "plane strain": ["Material/Plane state=plane strain"],
        "viscosity not in proportion": [
            "Material/Viscosity=isotropic",
            "Material/Viscous modulus=13000*400",
            "Material/Viscous Poisson ratio=0.4"],
        "odd number of steps": steps(41),
        "three steps": steps(3),
        "quadratic, with all": steps(21) + [
            "Discretisation/Degree=2", "Loads/Body force=0; -2",
            "Boundary/Gap=-1e-4*x", "Material/Plane state=plane strain"],
    }
    for name, settings in alternatives.items():
        settings = base + settings
        found = compute("other_fourier", settings + FOURIER)
        marched = compute("other", settings + (
            method("anderson") if name != "three steps" else
            method("march", tolerance=0, periods=800, split="on")))
        check(marched.summary["converged"] or name == "three steps",
              name + ": anderson converges")
        pressure = period(found, "probe_mouth.csv", "pressure") + period(
            found, "probe_near.csv", "pressure")
        check(max(pressure) > 0.1, name + ": there is contact")
        check_below(difference(found, marched), 1e-8, name)
    for degree in (1, 2):
        settings = BOX_PROBES + [f"Discretisation/Degree={degree}"] + (
            ["Geometry/Subdivisions=2, 2, 1"] if degree == 2 else [])
        found = compute("box_fourier", settings + FOURIER, BOX)
        marched = compute("box_anderson", settings + method("anderson"), BOX)
        check_below(difference(found, marched,
                               probes=("mouth", "inside", "body")), 1e-8,
                    f"box, Q{degree}")


def test_thermal_strain():
    """A stiffness that answers heat with shear, a temperature that vanishes at
    an instant, beside two materials, and quadratic elements."""
    base = case("c", 1) + ["Material/Thermal expansion=1e-5"]
    cases = (
        ("shear", ["Material/Stiffness matrix=14000, 4000, 2000; "
                   "4000, 9000, 1000; 2000, 1000, 5000",
                   "Loads/Temperature=40*x*sin(2*pi*t/600 + 1)"]),
        ("sine", ["Loads/Temperature=40*sin(2*pi*t/600)"]),
        ("cosine", ["Loads/Temperature=40*cos(2*pi*t/600)"]),
        ("quadratic", ["Discretisation/Degree=2", "Loads/Temperature="
                       "40*x*sin(2*pi*t/600 + 1) - 30*y + 7"]))
    for name, settings in tier(cases[:1], cases):
        marched = compute("heated", base + settings + method("anderson"))
        found = compute("heated_fourier", base + settings + FOURIER)
        check_below(difference(found, marched), 1e-8, name)


NO_CONTACT = ["Geometry/Shape=rectangle", "Boundary/Fixed points=automatic",
              "Output/Probes=top: 0.25, 1; body: 0.3, 0.6"]


def test_exact_harmonics():
    """u = u_el (F + int F/tau), less its mean, with five steps. The rule of
    the trapezoidal one divides by 2/dt tan(omega dt/2) instead of omega."""
    omega, n = 2 * math.pi / PERIOD, 5
    for ratio in tier((1,), (0.1, 1, 10)):
        tau = ratio * PERIOD
        elastic = compute("elastic", NO_CONTACT + [
            traction("0; 1 + x"), "Material/Viscosity=none"])
        for rule in ("exact", "trapezoid"):
            rate = (omega if rule == "exact" else
                    2 * n / PERIOD * math.tan(omega * PERIOD / n / 2))
            found = compute("exact", NO_CONTACT + relaxation(ratio) + steps(n)
                            + FOURIER + [
                traction("0; 10*(1 + x)*sin(2*pi*t/600)"),
                f"Periodic state/Harmonics={rule}"])
            worst = {"u": 0., "s": 0.}
            size = {"u": 0., "s": 0.}
            for probe in ("top", "body"):
                table = f"probe_{probe}.csv"
                for column in ("u_1", "u_2", "s_11", "s_22", "s_12"):
                    amplitude = 10 * elastic.table(table)[column][-1]
                    values = period(found, table, column)
                    mean = sum(values) / n if column[0] == "u" else 0.
                    lag = column[0] == "u"
                    for k, value in enumerate(values):
                        phase = 2 * math.pi * k / n
                        expected = amplitude * (math.sin(phase) - lag
                                                * math.cos(phase) / rate / tau)
                        size[column[0]] = max(size[column[0]], abs(expected))
                        worst[column[0]] = max(worst[column[0]],
                                               abs(value - mean - expected))
            for kind in "us":
                check_below(worst[kind] / size[kind], 1e-10,
                            f"{rule}, tau/T = {ratio}: {kind}")


def counts(results):
    found = re.search(r"loaded harmonics: (\d+), complex factorisations: (\d+)",
                      log(results))
    check(found, "the log tells what was computed")
    return int(found[1]), int(found[2])


def test_counters():
    for name, ratio in CASES:
        for n in (40, 41) if ratio == 1 else (80,):
            found = compute("counted", case(name, ratio) + steps(n) + FOURIER)
            loaded, factors = counts(found)
            counters = found.summary["counters"]
            print(f"({name}), tau/T = {ratio}, {n} steps: {loaded} loaded "
                  f"harmonics, {factors} complex factorisations; {counters}")
            check(loaded == (2 if name == "c" else 1), "loaded harmonics")
            check(factors == 0 if name != "c" else 2 <= factors <= n // 2,
                  "complex factorisations")
            check(counters["vi_solves"] <= n + 3,
                  "an inequality an instant, to show it, and beta's")
    found = compute("counted", [traction("0; 10*sin(2*pi*t/600)")]
                    + relaxation(1, 0.5) + FOURIER)
    print("alternating, two materials:", counts(found))
    check(counts(found)[1] <= 20, "N/2 at most")
    found = compute("counted", NO_CONTACT + relaxation(1, 0.5) + FOURIER + [
        traction("0; 10*sin(2*pi*t/600)")])
    check(counts(found) == (1, 1), "without contact only what is loaded")


REFUSED = {
    "K(t)": (["Material/Young modulus=13000*(1 + 0.3*sin(2*pi*t/600))",
              "Material/Viscosity=isotropic",
              "Material/Viscous modulus=13000*600"],
             ["stiffness varies", "Young modulus", "anderson"]),
    "k(t)": (["Material/Stiffness time factor=1 + 0.3*sin(2*pi*t/600)"],
             ["Stiffness time factor", "anderson"]),
    "eta_0(t)": (["Material/Viscosity time factor=1 + 0.3*sin(2*pi*t/600)"],
                 ["Viscosity time factor", "anderson"]),
    "a list of steps": (["Time integration/Step control=list",
                         "Time integration/Steps=0, 100, 300, 600"],
                        ["Step control", "uniform", "anderson"]),
    "adaptive steps": (["Time integration/Step control=adaptive",
                        "Time integration/Scheme=heun"],
                       ["Step control", "uniform", "anderson"]),
    "incompressible": (["Material/Plane state=plane strain",
                        "Material/Viscosity=isotropic",
                        "Material/Viscous modulus=13000*600",
                        "Material/Viscous Poisson ratio=0.5"],
                       ["singular", "march"]),
}


def refused(name, settings, words):
    arguments = [BODY, "--output", "results/refused"] + overrides(
        COMMON + settings)
    for check_only in ([], ["--check"])[:1 + (name == "a list of steps")]:
        code, output, message = execute(*check_only, *arguments)
        check(code == 2, f"{name} {check_only}: exit status {code}\n" + message)
        check("period  " not in output, f"{name}: nothing was computed")
        for word in words:
            check(word in message, f"{name}: the message lacks '{word}':\n"
                                   + message)
    print(f"{name}: {message.strip()}")


def test_refusals():
    for name, (settings, words) in REFUSED.items():
        refused(name, case("b", 1) + FOURIER + settings,
                words + ["Periodic state", "fourier"])
    # r is periodic only without the flow.
    for name in ("anderson", "fourier"):
        refused(name + ", split off", case("b", 1) + method(name, split="off"),
                ["Secular split", "Method"])


def test_warnings():
    """In the log and in the summary."""
    for name, settings, text in (
            ("long steps", case("b", 0.01),
             "longer than twice the smallest relaxation time"),
            ("few instants of contact", case("c", 1) + steps(12),
             "closed at fewer than")):
        found = compute("warned", settings + FOURIER)
        lines = [line for line in log(found).splitlines() if text in line]
        print(f"{name}: {lines}")
        check(len(lines) == 1 and "warning" in lines[0], name + ": in the log")
        check(any(text in line for line in found.summary["warnings"]),
              name + ": in the summary")


def test_solvers():
    """Without a factor of the lip each of its nodes is solved for; two processes of
    multigrid lay their vectors out in another way than harmonic balance does."""
    settings = case("c", 1) + FOURIER
    condensed = compute("condensed", settings)
    for solver in ("cholesky", "gmg"):
        words = {w.split("=")[0]: w for w in COMMON + settings + [
            "Contact/Solver=active set", f"Linear solver/Type={solver}",
            "Linear solver/Tolerance=1e-12"]}
        found = run_on(1 if solver == "cholesky" else 2, BODY, solver, words.values())
        check("active set" in found.summary["contact_solver"]["description"], solver)
        check_below(difference(condensed, found, True), 1e-9, f"{solver}, active set")


def test_ranks():
    for name in tier(("fourier",), ("fourier", "anderson")):
        settings = ["Contact/Solver=automatic"] + case("c", 1) + method(name)
        alone = compute("one_rank", settings)
        words = {w.split("=")[0]: w for w in COMMON + settings}
        both = run_on(2, BODY, "two_ranks", words.values())
        check_below(difference(alone, both, True), 1e-9, f"{name}: two ranks")


if __name__ == "__main__":
    test_is_the_trapezoidal_state()
    test_mean_pressure()
    test_closed_forms()
    test_everything_else()
    test_exact_harmonics()
    test_counters()
    test_solvers()
    test_ranks()
    test_thermal_strain()
    test_refusals()
    test_warnings()
