"""The periodic state by the averaged body: bodies whose relaxation times lie many
decades apart, with and without contact, against marches and against themselves."""

from averaged_scenes import LOAD, MESH, OPEN, WARM, probes_of, relaxation, scene
from crevasse_run import (SOURCE, check, check_below, execute, full, overrides, run,
                          run_on, tier)
from periodic_scenes import (BODY, COMMON, PROBES, compute, difference,
                             largest_stress, method, period, steps, traction)

def averaged(poles=2, tolerance=1e-9, periods=40, depth=15):
    return method("averaged", "sdirk2", tolerance, periods) + [
        f"Periodic state/Averaged poles={poles}",
        f"Periodic state/Anderson depth={depth}"]


def bodies(decades):
    """Loads and materials by name."""
    return {
        "presses": LOAD + relaxation(decades),
        "varies": LOAD + WARM + relaxation(decades, 0.3),
        "opens": [traction("0; 10*sin(2*pi*t/600) + 3")] + relaxation(decades),
        "closed": [traction("0; 10*sin(2*pi*t/600) - 20")]
        + relaxation(decades, 0.3),
        "gap": LOAD + relaxation(decades) + ["Boundary/Gap=-0.0003"],
        "chain": LOAD + [
            "Material/Viscosity=chain",
            f"Material/Chain=0.6: 30*10^({decades}*(1-x^2)); 0.4: 300"],
        "spring": LOAD + WARM + [
            "Material/Viscosity=chain",
            f"Material/Chain=0.5: 30*10^({decades}*(1-x^2)); 0.3: 300"],
        "stiffness": LOAD + WARM + relaxation(decades, 0.3) + [
            "Material/Young modulus=13000*(1 - 0.004*theta)"],
        "factors": LOAD + relaxation(decades) + [
            "Material/Stiffness time factor=1 + 0.3*sin(2*pi*t/600)",
            "Material/Viscosity time factor=1 + 0.5*cos(2*pi*t/600)"]}


def test_contraction():
    """Without contact and without acceleration the error shrinks in each period
    by what the poles promise."""
    for poles, bound in ((1, 0.30), (2, 0.03)):
        for decades in tier((0, 5, 10), range(11)):
            for hot in (30., 3000.):
                found = compute("contraction", MESH + OPEN + steps(40) + WARM + [
                    traction("0; 10*sin(2*pi*t/600)*x")] + relaxation(
                        decades, hot=hot) + averaged(poles, 1e-9, depth=0))
                errors = found.summary["stress_error_estimate"]
                check_below((errors[-1] / errors[1])**(1 / (len(errors) - 2)), bound,
                            f"{poles} poles, {decades} decades from {hot} s: "
                            f"{len(errors)} periods, contraction")


@full
def test_march():
    """The stress of a march, to 1e-8."""
    for name, body in bodies(tier(2, 3)).items():
        settings = MESH + steps(20) + body
        marched = compute("marched", settings + method(
            "march", "sdirk2", 1e-10, 5000))
        found = compute("averaged", settings + averaged(2, 1e-10))
        print(f"{found.summary['periods']} periods, march "
              f"{marched.summary['periods']}")
        check_below(difference(marched, found), 1e-8, f"{name}: difference")


def test_fixed_points():
    """One pole, two poles, with and without acceleration end at the same stress,
    of bodies of which most never comes to rest in a march."""
    for name, body in list(bodies(8).items())[::tier(3, 1)]:
        ways = {"two poles": averaged(2, 1e-10), "one pole": averaged(1, 1e-10),
                "two poles alone": averaged(2, 1e-10, depth=0)}
        found = {way: compute("_".join([name, way]).replace(" ", "_"),
                              MESH + steps(20) + body + words)
                 for way, words in ways.items()}
        print(name, {way: f.summary["periods"] for way, f in found.items()})
        for way in list(ways)[1:]:
            check_below(difference(found["two poles"], found[way]), 1e-8,
                        f"{name}, {way}: difference")
        check(found["two poles"].summary["periods"] <= 15, "a few periods")


def test_error_estimate():
    """What is estimated is the error of each period, not only of the last one."""
    found = compute("found", MESH + steps(20) + LOAD + relaxation(6, 0.3)
                    + averaged(2, 1e-10))
    for k, estimate in enumerate(found.summary["stress_error_estimate"]):
        error = max(
            abs(a - b) for probe in PROBES for column in ("s_11", "s_22", "s_12")
            for a, b in zip(period(found, f"probe_{probe}.csv", column),
                            period(found, f"probe_{probe}.csv", column, k))
        ) / largest_stress(found)
        print(f"period {k + 1}: error {error:.1e}, estimated {estimate:.1e}")
        check(k < 2 or estimate < 1e-7 or 0.58 * estimate < error < 1.5 * estimate,
              "as large as estimated")


@full
def test_random_bodies():
    """Ten random bodies of the benchmark: few periods to a true error of 1e-6."""
    for seed in range(10, 20):
        exact = compute("exact", scene(seed) + method("averaged", "sdirk2", 1e-11, 60))
        found = compute("found", scene(seed) + method("averaged", "sdirk2", 2e-7, 15))
        check_below(difference(exact, found, probes=probes_of(seed)), 1e-6,
                    f"body {seed}: {found.summary['periods']} periods, true error")


@full
def test_ranks():
    settings = (COMMON + MESH + steps(20) + LOAD + relaxation(6, 0.3)
                + averaged(2, 1e-9))
    one = run(BODY, "one", settings)
    two = run_on(2, BODY, "two", settings)
    check(one.summary["periods"] == two.summary["periods"], "periods")
    check_below(difference(one, two), 1e-9, "two ranks: difference")
    # A lip that moves with the flow, by the other direct solver.
    spring = ["Material/Viscosity=chain", "Material/Chain=0.5: 300; 0.3: 100"]
    missions = relaxation(6) + ["Periodic state/Missions=40"]
    bodies = [("spring", MESH + steps(20) + LOAD + spring + averaged(2, 1e-9)),
              ("missions", MESH + steps(20) + LOAD + averaged() + missions),
              ("long lip", ["Geometry/Subdivisions=300, 2", "Geometry/Height=0.2",
                            "Output/Probes=mouth: 1, 0"]
               + steps(20) + LOAD + averaged() + missions)]
    for name, settings in tier(bodies[:1], bodies):
        one = compute("one", settings)
        mumps = compute("mumps", settings + ["Linear solver/Type=mumps"])
        two = run_on(2, BODY, "two", COMMON + settings)
        for how, other in (("mumps", mumps), ("two ranks", two)):
            check_below(abs(one.summary["extremes"]["stress"]
                            / other.summary["extremes"]["stress"] - 1), 1e-9,
                        f"{name}, {how}: largest stress")


def power_law(n, decades, varying=0.5, mean=-2, state="plane stress"):
    """Creep that at 10 takes 0.3 periods in the hot place."""
    place = f"(1 - x^2*({1 - varying} + {varying}*0.5*(1 - cos(2*pi*t/600))))"
    return ["Material/Viscosity=power law", f"Material/Creep exponent={n}",
            f"Material/Plane state={state}",
            "Material/Creep coefficient="
            f"1/(13000*180*10^({n}-1))*10^(-{decades}*{place})",
            traction(f"0; 10*sin(2*pi*t/600) + {mean}")]


def test_power_law():
    """Creep whose fluidity depends on the stress, to 1e-6 in 20 periods, and the
    stress of a march."""
    for state in ("plane stress", "plane strain"):
        for n in tier((5,), (3, 5)):
            for decades, mean in tier(((8, -2),), ((4, -2), (8, -2), (8, 2))):
                found = compute("found", MESH + steps(40) + power_law(
                    n, decades, mean=mean, state=state) + averaged(tolerance=1e-6))
                check(found.summary["periods"] <= 20, "a few periods")
                print(f"n = {n}, {decades} decades, mean {mean}, {state}: "
                      f"{found.summary['periods']} periods")
    # Where hardly any stress is, a march in plane strain takes too long.
    for state, tolerance in tier([("plane stress", 1e-8)],
                                 [("plane stress", 1e-8), ("plane strain", 1e-4)]):
        settings = MESH + steps(20) + power_law(3, 1, state=state)
        marched = compute("marched", settings + method(
            "march", "sdirk2", tolerance, 5000))
        found = compute("found", settings + averaged(tolerance=1e-9))
        check_below(difference(marched, found), 10 * tolerance,
                    f"{state}: difference")


@full
def test_singular_fluidity():
    """Creep that keeps the volume."""
    settings = MESH + steps(20) + LOAD + [
        "Material/Plane state=plane strain", "Material/Viscosity=isotropic",
        "Material/Viscous Poisson ratio=0.5",
        "Material/Viscous modulus=13000*30*10^(1.5*(1-x^2))"]
    marched = compute("marched", settings + method("march", "sdirk2", 1e-9, 5000))
    found = compute("found", settings + averaged(tolerance=1e-10))
    print(f"{found.summary['periods']} periods, march {marched.summary['periods']}")
    check_below(difference(marched, found), 1e-8, "difference")


def test_pressed_while_cold():
    """Under a mean tension the lip flows open until it is never pressed, also where it
    is so only while nothing flows: the stress is that with a wide gap."""
    for rate in tier((0.1, 0.4), (0.05, 0.1, 0.2, 0.4)):  # fluidity over 4 to 35 decades
        settings = MESH + steps(40) + averaged(tolerance=1e-6, periods=5) + [
            traction("0; 10*sin(2*pi*t/600) + 1"),
            "Loads/Temperature=100*sin(2*pi*t/600)",
            f"Material/Relaxation time=300*exp({rate}*(100 - theta))"]
        found = compute("cold", settings)
        opened = compute("wide", settings + ["Boundary/Gap=-1"])
        print(f"{found.summary['periods']} periods")
        check_below(difference(opened, found), 1e-8, f"rate {rate}: difference")


@full
def test_steps_and_solvers():
    """Steps that end where contact changes, adaptive steps, explicit steps, and
    contact solvers that do not condense."""
    settings = MESH + steps(20) + LOAD + relaxation(1.5, 0.3)
    explicit = ["Time integration/Scheme=heun", "Time integration/Steps per period=80"]
    ways = (("events", ["Time integration/Locate contact events=true"], 1e-7),
            ("active set", ["Contact/Solver=active set"], 1e-8),
            ("heun", explicit, 1e-8),
            ("sor", ["Contact/Solver=projected sor", "Contact/Tolerance=1e-12"], 1e-8))
    for name, more, allowed in tier(ways[:1], ways):
        marched = compute("marched", settings + method(
            "march", "sdirk2", 1e-9, 5000) + more)
        found = compute("found", settings + averaged(tolerance=1e-10) + more)
        print(f"{name}: {found.summary['periods']} periods, "
              f"march {marched.summary['periods']}")
        check_below(difference(marched, found), allowed, f"{name}: difference")
    more = ["Time integration/Step control=adaptive",
            "Time integration/Relative tolerance=1e-4"]
    ends = [compute(name, settings + way + more).table("probe_body.csv")["s_22"][-1]
            for name, way in (("marched", method("march", "sdirk2", 1e-7, 5000)),
                              ("found", averaged(tolerance=1e-8)))]
    check_below(abs(ends[0] - ends[1]) / abs(ends[0]), 1e-3, "adaptive: difference")
    hot = MESH + steps(20) + LOAD + relaxation(8, 0.3)
    for name, more in (("uniform", []), ("adaptive", more)):
        found = compute(name, hot + averaged(tolerance=1e-6) + more)
        print(f"{name} steps: {found.summary['periods']} periods")
        check(found.summary["periods"] <= 12, "a few periods")


def test_cost():
    """A period takes two back-solves with one pole, three with two, beside those of
    its steps, and each pole one factor once."""
    def counters(way):
        found = compute("cost", MESH + steps(20) + LOAD + relaxation(6) + way)
        return found.summary["counters"]

    for poles in (1, 2):
        few, many = (averaged(poles, 0, n) for n in (2, 6))
        march_few, march_many = (method("march", "sdirk2", 0, n) for n in (2, 6))
        solves = [counters(way)["linear_solves"]
                  for way in (few, many, march_few, march_many)]
        factors = [counters(way)["factorisations"] for way in (many, march_many)]
        check(solves[1] - solves[0] - (solves[3] - solves[2]) == 4 * (poles + 1),
              f"{poles} poles: back-solves {solves}")
        check(factors[0] - factors[1] <= poles + 1, f"factors {factors}")


def test_thermal_fatigue():
    """The shipped scene takes averaged steps by itself; with amg a lip marches."""
    plate = SOURCE / "prm/thermal_fatigue.prm"
    probes = ["Output/Probes=edge: 50, 25; inside: 30, 10; cold: 5, 30"]
    found = run(plate, "found", probes)
    exact = run(plate, "exact", probes + ["Periodic state/Tolerance=1e-11"])
    check(found.summary["converged"] and found.summary["periods"] <= 10,
          "a few periods")
    check_below(difference(exact, found, probes=("edge", "inside", "cold")), 1e-6,
                f"{found.summary['periods']} periods: true error")
    marched = run(plate, "marched", probes + ["Linear solver/Type=amg",
                                              "Contact/Solver=active set",
                                              "Periodic state/Maximum periods=2"], 3)
    check("no averaged body, because [Linear solver] Type = amg"
          in (marched.directory / "log.txt").read_text(),
          "a march without a direct solver")


@full
def test_blade():
    """The wedge of a coated blade, whose relaxation times span 14 decades."""
    blade = SOURCE / "prm/coated_blade.prm"
    found = run(blade, "blade", ["Output/Fields=none"])
    exact = run(blade, "exact", ["Output/Fields=none",
                                 "Periodic state/Tolerance=1e-11"])
    check(found.summary["periods"] <= 10, "a few periods")
    check_below(difference(exact, found, probes=("mouth", "coat", "inside", "root")),
                1e-6, f"{found.summary['periods']} periods: true error")


ASPHALT = """
subsection Geometry
  set Shape = edge crack
  set Width = 100
  set Height = 100
  set Crack length = 30
  set Subdivisions = 12, 6
end
subsection Boundary
  set Symmetry = 2, 3
  set Loaded = none
end
subsection Material
  set Young modulus = 20000
  set Viscosity = chain
  set Thermal expansion = 2.5e-5
end
subsection Loads
  set Period = 86400
  set Temperature = -5 - 15*exp(-(100-x)/60)*cos(2*pi*t/86400)
end
subsection Discretisation
  set Degree = 1
end
subsection Time integration
  set Scheme = sdirk2
  set Steps per period = 240
end
subsection Periodic state
  set Method = automatic
end
subsection Output
  set Fields = none
  set Probes = mouth: 100, 0; top: 50, 50
end
"""
TERMS = ((0.2, 1), (0.2, 10), (0.25, 100), (0.2, 1000), (0.1, 1e4), (0.045, 1e5))


@full
def test_asphalt():
    """Six Prony terms that the temperature of the day shifts, by one factor."""
    def run_with(name, terms, *more):
        return run(ASPHALT, name, ["Material/Chain=" + "; ".join(terms), *more])

    shift = "exp(-0.25*theta)"
    found = run_with("shifted", [f"{w}: {tau:g}" for w, tau in TERMS],
                     f"Material/Chain shift={shift}")
    written = run_with("written", [f"{w}: {tau:g}*{shift}" for w, tau in TERMS])
    check("averaged" in found.summary["periodic_method"]
          and found.summary["periods"] <= 15, f"{found.summary['periods']} periods")
    check_below(difference(written, found, probes=("mouth", "top")), 1e-12,
                "formulas written out: difference")


def test_trapezoid():
    """Steps far above relaxation times, with which stress oscillates, cause a warning."""
    found = compute("trapezoid", MESH + steps(20) + LOAD + relaxation(6) + averaged(
        tolerance=0, periods=2) + ["Time integration/Scheme=trapezoid",
                                   "Material/Relaxation time=0.3*10^(6*(1 - x^2))"])
    check(any("oscillates" in warning for warning in found.summary["warnings"]),
          "a warning of the trapezoidal rule")


def test_fallback():
    """Where averaged steps do not end, a march goes on."""
    found = compute("fallback", MESH + steps(20) + LOAD + relaxation(1) + method(
        "automatic", "sdirk2", 1e-15, 44), status=3)
    text = (found.directory / "log.txt").read_text()
    check("march takes over" in text, "another method")
    check(found.summary["periods"] == 44, "all periods")


def test_refusals():
    for setting, reason in (
            (["Material/Viscosity=strain hardening", "Material/Creep exponent=5",
              "Material/Hardening exponent=2", "Material/Creep coefficient=1e-11"],
             "hardens"),
            (["Contact/Solver=active set", "Linear solver/Type=amg"], "cholesky"),
            (["Time integration/Scheme=arkode implicit"], "does not provide its stages")):
        code, _, error = execute(BODY, "--output", "results/refused", *overrides(
            COMMON + MESH + LOAD + averaged() + setting))
        check(code == 2 and reason in error, f"{reason}: {code}, {error}")


if __name__ == "__main__":
    test_contraction()
    test_march()
    test_fixed_points()
    test_error_estimate()
    test_power_law()
    test_singular_fluidity()
    test_pressed_while_cold()
    test_steps_and_solvers()
    test_cost()
    test_random_bodies()
    test_ranks()
    test_thermal_fatigue()
    test_blade()
    test_asphalt()
    test_trapezoid()
    test_fallback()
    test_refusals()
