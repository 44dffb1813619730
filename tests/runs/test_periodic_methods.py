"""Anderson's acceleration, marching and the automatic choice: how many periods
they take, that their estimates of the error are correct, and that they all end
in the same state."""

import math

from crevasse_run import Failure, check, check_below, full, tier
from periodic_scenes import (COMPRESSIVE, FOURIER, LIP,
                             PERIOD, TWO_HARMONICS, case, compute, difference,
                             error_estimate, largest_stress, log, method,
                             period, ratio_to_best, relaxation, search_by_all,
                             steps, stress_difference, traction)


def test_anderson():
    """Few periods, and the error is what it is said to be."""
    tolerance = 1e-6
    for name, most in (("a", 26), ("b", 12), ("c", 40)):
        for ratio in tier((1,), (1, 10)):
            for scheme in tier(("heun",), ("heun", "trapezoid")):
                settings = case(name, ratio)
                exact = compute("exact", settings + (
                    FOURIER if scheme == "trapezoid" else
                    method("anderson", scheme)))
                found = compute("found", settings + method(
                    "anderson", scheme, tolerance))
                n, error = found.summary["periods"], difference(exact, found)
                print(f"({name}), tau/T = {ratio}, {scheme}: {n} periods "
                      f"(allowed {most}), estimated error "
                      f"{error_estimate(found):.1e}, error {error:.1e}")
                check(found.summary["converged"] and n <= most,
                      "few periods")
                check(error <= 3 * tolerance, "a correct estimate")


@full
def test_few_steps():
    """With long steps: what counts as converged must be so. With the longest
    the search may end without, and says so."""
    for n in (3, 4, 5, 8):
        settings = case("c", 1) + steps(n)
        exact = compute("exact", settings + FOURIER)
        try:
            found = compute("found", settings + method("anderson"))
        except Failure as failure:
            check(n < 8 and "exit status 3" in str(failure), str(failure))
            print(f"{n} steps: not converged, and told")
            continue
        check_below(difference(exact, found), 1e-8,
                    f"{n} steps, {found.summary['periods']} periods, "
                    f"estimated error {error_estimate(found):.1e}")


@full
def test_march():
    """A change that is small says little, the estimate does: in slow
    relaxation."""
    for ratio, all_periods, factor in tier(((1, (60,), 10),), (
            (1, (60, 120, 200), 10), (10, (60, 100, 200), 3))):
        settings = case("c", ratio)
        exact = compute("exact", settings + method("anderson", "heun"))
        for n in all_periods:
            found = compute("found", settings + method(
                "march", "heun", tolerance=0, periods=n))
            change = found.summary["stress_change"][-1]
            error = difference(exact, found)
            print(f"(c), tau/T = {ratio}, march of {n} periods: change "
                  f"{change:.1e}, error {error:.1e}, estimated "
                  f"{error_estimate(found):.1e}")
            check(error > 20 * change, "the change is much less")
            check(1 / factor < error_estimate(found) / error < factor,
                  "a correct estimate")
    # Until it converges: the paper's test is reported.
    settings = case("b", 1)
    found = compute("found", settings + method("march", "heun", 1e-5))
    lines = [s for s in log(found).splitlines() if "the paper's test" in s]
    print(lines)
    check(len(lines) == 1, "the paper's test is reported")
    exact = compute("exact", settings + method("anderson", "heun"))
    check_below(difference(exact, found), 3e-5, "march to 1e-5")


CHAIN = ["Material/Viscosity=chain",
         "Material/Chain=0.4: 100; 0.3: if(x < 0.7, 300, 600)"]
VARYING = ["Material/Young modulus=13000*(1 + 0.5*x*sin(2*pi*t/600))",
           "Material/Viscosity=isotropic", "Material/Viscous modulus=13000*150",
           "Material/Viscous Poisson ratio=0.2"]


@full
def test_anderson_and_march():
    """Both end in the same state, whatever the problem and the scheme."""
    adaptive = ["Time integration/Step control=adaptive",
                "Time integration/Relative tolerance=1e-3"]
    for name, settings, scheme, tolerance, allowed in (
            ("adaptive steps", case("b", 0.25) + adaptive, "heun", 1e-7, 1e-5),
            ("arkode", case("b", 0.25), "arkode explicit", 1e-6, 1e-3),
            ("sdirk2", case("b", 0.25), "sdirk2", 1e-9, 1e-7),
            ("K(t, x)", [traction(COMPRESSIVE)] + VARYING, "heun", 1e-9, 1e-7),
            ("chain with a spring", [traction(TWO_HARMONICS)] + CHAIN, "heun",
             1e-9, 1e-7)):
        accelerated = compute("accelerated", settings + method(
            "anderson", scheme, tolerance))
        marched = compute("marched", settings + method(
            "march", scheme, tolerance))
        n = [r.summary["periods"] for r in (accelerated, marched)]
        apart = (difference(accelerated, marched) if name != "adaptive steps"
                 else last_samples_apart(accelerated, marched))
        print(f"{name}: {n[0]} periods instead of {n[1]}")
        check(n[0] <= n[1], name + ": no more periods")
        check_below(apart, allowed, f"{name}: anderson and march")


def last_samples_apart(one, other):
    """At the end of the last period, whatever the steps before."""
    worst = size = 0.
    for probe in LIP:
        for column in ("s_11", "s_22", "s_12", "pressure"):
            a, b = (r.table(f"probe_{probe}.csv")[column] for r in (one, other))
            worst = max(worst, abs(a[-1] - b[-1]))
            size = max(size, *map(abs, a))
    return worst / size


@full
def test_units():
    """Lengths in thousandths, stresses in millionths, times in 1e4ths."""
    length, stress, time = 1e-3, 1e6, 1e4
    scaled = [f"Geometry/Width={length}", f"Geometry/Height={length}",
              f"Geometry/Crack length={0.5 * length}",
              f"Material/Young modulus={13000 * stress}",
              f"Loads/Period={600 * time}",
              "Output/Probes=" + "; ".join(
                  f"{name}: {x * length}, 0" for name, x in
                  (("mouth", 1), ("inside", 0.75),
                   ("near", 0.5714285714285714)))
              + f"; top: {0.25 * length}, {length}"
              f"; body: {0.3 * length}, {0.6 * length}",
              "Material/Relaxation time="
              f"if(x < {0.5 * length}, {6e2 * time}, {6e3 * time})",
              f"Loads/Traction=0; {10 * stress}*(sin(2*pi*t/{600 * time})"
              f" + 0.5*cos(4*pi*t/{600 * time}) - 0.1)"]
    for name, scheme in (("anderson", "heun"), ("fourier", "trapezoid")):
        base = compute("base", case("c", 1) + method(name, scheme, 1e-9))
        other = compute("scaled", scaled + method(name, scheme, 1e-9))
        n = [r.summary["periods"] for r in (base, other)]
        changes = [max(abs(a - b) for a, b in zip(*(
            [x or 0. for x in r.summary["stress_change"]]
            for r in (base, other))))]
        worst = 0.
        for probe in LIP:
            for column in ("s_11", "s_22", "s_12", "pressure"):
                a, b = (period(r, f"probe_{probe}.csv", column)
                        for r in (base, other))
                worst = max(worst, max(abs(x - y / stress)
                                       for x, y in zip(a, b)))
        print(f"{name}: periods {n}, changes differ by {changes[0]:.1e}")
        check(n[0] == n[1], "as many periods")
        check_below(worst / largest_stress(base), 1e-8, name + ": stress")


AUTOMATIC = {
    "elastic": (["Material/Viscosity=none"], "heun",
                "march (without viscosity one period is enough)"),
    "heun": ([], "heun", "averaged (automatic: harmonic balance is for Scheme = "
                         "trapezoid"),
    "trapezoid": ([], "trapezoid",
                  "fourier (automatic: only the loads depend on time"),
    "K(t)": (["Material/Stiffness time factor=1 + 0.3*sin(2*pi*t/600)"],
             "heun", "averaged (automatic: no harmonic balance, because the stiffness "
                     "varies"),
    "eta(t, x)": (["Material/Viscosity=isotropic",
                   "Material/Viscous modulus="
                   "13000*600*(1 + 0.5*x*sin(2*pi*t/600))",
                   "Material/Viscous Poisson ratio=0.2"], "heun",
                  "averaged (automatic: no harmonic balance, because the viscosity varies"),
    "split off": (["Periodic state/Secular split=off"], "heun",
                  "march (automatic: Secular split = off"),
    "exponential": ([], "exponential",
                    "march (automatic: the steps of Scheme = exponential"),
    "predictor corrector": (
        [], "predictor corrector",
        "march (automatic: the steps of Scheme = predictor corrector"),
    "fast": (relaxation(0.05), "heun",
             "anderson (automatic: the stress is forgotten within a period"),
}

MARCHED = ("eta(t, x)", "exponential", "predictor corrector")  # anderson refuses them


def test_automatic():
    for name, (settings, scheme, why) in AUTOMATIC.items():
        settings = case("b", 1) + settings
        automatic = method("automatic", scheme, 1e-6)
        found = compute("automatic", settings + automatic + [
            s for s in settings if s.startswith("Periodic")])
        line = next(s for s in log(found).splitlines()
                    if "periodic state:" in s)
        print(f"{name}: {line.strip()}; {found.summary['periods']} periods")
        check(why in line, f"{name}: '{why}' is not what it says")
        check(found.summary["converged"], name + ": converged")
        # No worse than by the plain way.
        if name in ("elastic", "split off"):
            continue
        plain = compute("plain", settings + method(
            "march", scheme, 1e-9) if name in MARCHED else settings
            + method("anderson", scheme, 1e-11))
        check_below(difference(plain, found), 3e-6, name + ": stress")


@full
def test_mean_of_steps():
    """A load with a kink or a jump within a step, whose mean the steps miss by some
    per cent, opens a lip of one material for good: no method may press it."""
    for load, other in (("max(0, 10*sin(2*pi*t/600)) - 1", "fourier"),
                        ("if(t < 102.5, 12, -1)", "march")):
        settings = [traction("0; " + load)] + relaxation(0.1)
        exact = compute("exact", settings + method(other, tolerance=1e-9))
        found = compute("found", settings + method("anderson", tolerance=1e-9))
        check_below(difference(exact, found), 1e-8, f"{load}: {other} and anderson")
        forces = found.summary["secular"]
        check_below(abs(forces["mean_contact_force_of_last_period"]), 1e-7,
                    "mean force on the lip")
    for scheme in ("exponential", "predictor corrector"):
        try:
            compute("refused", [traction("0; 10*sin(2*pi*t/600) + 1")]
                    + method("anderson", scheme))
            check(False, scheme + " under a mean load is refused")
        except Failure as failure:
            check("exit status 2" in str(failure)
                  and "steady flow" in str(failure), str(failure))


COARSE = ["Geometry/Subdivisions=8, 4", "Contact/Tolerance=1e-12"]
PLANE_STRAIN = "Material/Plane state=plane strain"

# Lips that drift: as much period after period, without stress, until they touch.
DRIFTING = {
    "half sine": (COARSE + [
        traction("0; if(t<300, 10*sin(2*pi*t/300), 0) - 0.375389*x"),
        "Material/Relaxation time=if(y<0.5, 777.855, 3114.35)", PLANE_STRAIN,
        "Boundary/Gap=-0.00902007*(x-0.75)^2"], 40),
    "two moduli": (COARSE + [
        traction("0; 10*sin(2*pi*t/600) - 0.1"),
        "Material/Young modulus=if(y<0.5, 13000, 1438.18)",
        "Material/Relaxation time=105.677+95.5703*x",
        "Boundary/Gap=-0.00338128*(x-0.75)^2",
        "Discretisation/Degree=2", *steps(80)], 30),
    "fast": (COARSE + [
        traction("0; 10*sin(2*pi*t/600)*(0.3+x) + 4.44519*cos(10*pi*t/600)"
                 " - 0.0294359*(y-x)"),
        "Material/Relaxation time=if(y<0.5, 8.87439, 16.1858)", PLANE_STRAIN,
        "Boundary/Gap=-0.00222409*(x-0.5)",
        "Loads/Body force=0; 1.46353*cos(2*pi*t/600)"], 40)}


@full
def test_drift():
    """Neither a step that bears no stress nor a drift that makes none ends the
    search."""
    tolerance = 1e-6
    for name, (settings, most) in DRIFTING.items():
        exact = compute("exact", settings + FOURIER)
        for way in ("averaged", "march"):
            found = compute("found", settings + method(
                way, "trapezoid", tolerance))
            n, error = found.summary["periods"], difference(exact, found)
            check_below(error, 3 * tolerance,
                        f"drift, {name}: {way}, {n} periods, estimated error "
                        f"{error_estimate(found):.1e}")
            check(way == "march" or n <= most, f"at most {most} periods")
    # Rounding must not decide whether a drift is taken for one.
    settings, most = DRIFTING["fast"]
    for k in range(1, 5):
        found = compute("found", settings + method("averaged", tolerance=tolerance)
                        + [f"Material/Young modulus={13000 * (1 + k * 1e-11)!r}"])
        check_below(found.summary["periods"], most, "periods with another rounding")
    # The last steps are in directions without stress.
    settings = COARSE + [
        traction("0; 10*cos(2*pi*t/600)*(x-0.9) - 0.1"),
        "Material/Relaxation time=if(x<0.5, 21.2906, 3097.09)",
        "Boundary/Gap=-0.00173318*(x-0.5)", *steps(80)]
    exact = compute("exact", settings + method("anderson", "sdirk2", 1e-10))
    found = compute("found", settings + method("automatic", "sdirk2", tolerance))
    check_below(difference(exact, found), 3 * tolerance,
                f"drift, {found.summary['periods']} periods, "
                f"estimated error {error_estimate(found):.1e}")


@full
def test_spring():
    """What a spring lets flow comes to rest, but slowly: the stress of a lip
    that stands open is periodic at once, and the displacement is not."""
    settings = COARSE + [
        traction("0; 10*sin(2*pi*t/600) + 10.5"), "Material/Viscosity=chain",
        "Material/Chain=0.9: 2000; 0.05: 13"]
    opening = []
    for way, most in (("march", 3000), ("anderson", 12)):
        found = compute("found", settings + method(
            way, tolerance=1e-9, periods=3000))
        n = found.summary["periods"]
        opening.append(max(period(found, "probe_mouth.csv", "opening")))
        print(f"spring, {way}: {n} periods, opening {opening[-1]}")
        check(n <= most, f"at most {most} periods")
    check_below(abs(opening[0] / opening[1] - 1), 1e-6, "opening")
    stopped = compute("stopped", settings + method(
        "march", tolerance=1e-6, periods=5), status=3)
    check_below(stopped.summary["stress_change"][-1], 1e-9, "change of stress")


LATE = {  # k(t), eta_0(t) and a gap that closes after some ten periods
    "k(t)": ([traction("0; 0.14912*sin(2*pi*t/600)*(0.3+x) - 0.25471*x*x"
                       " + 0.07456*cos(4*pi*t/600+1)"),
              "Material/Relaxation time=if(x<0.7, 1595.59, 900.946)",
              "Material/Stiffness time factor=1+0.3*sin(2*pi*t/600)",
              "Material/Viscosity time factor=1+0.6*cos(2*pi*t/600)",
              "Boundary/Gap=-0.0001652"], "trapezoid", 95),
    "two materials": ([traction("0; 4.7927*sin(2*pi*t/600) - 2.2367*(x-0.3)"),
                       "Material/Relaxation time=if(x<0.7, 1129.75, 9998.98)",
                       "Boundary/Gap=-0.0004751", PLANE_STRAIN], "heun", 120)}


def test_late_closing():
    """Periods before and after a lip touches are of different branches of the map;
    anderson must not combine those that contradict each other. Where it needs more
    periods than it may take, only what the scene allows is proposed."""
    tolerance = 1e-6
    for name, (settings, scheme, most) in LATE.items():
        settings = settings + steps(24) + [
            "Geometry/Subdivisions=6, 3", "Material/Poisson ratio=0.45"]
        found, short = (compute("late", settings + method(
            "anderson", scheme, tolerance, n), status=status)
            for n, status in ((most, 0), (5, 3)))
        check("anderson combined fewer periods" in log(found),
              "periods contradict each other")
        print(f"{name}: anderson takes {found.summary['periods']} periods")
        text = log(short)
        check(("Method = fourier" in text) == (name != "k(t)"),
              name + ": fourier is proposed where it is possible")
        if name == "k(t)":
            marched = compute("marched", settings + method(
                "march", scheme, tolerance))
            check(found.summary["periods"] < marched.summary["periods"],
                  "fewer periods than march")
            estimates = sum(map(error_estimate, (found, marched)))
            check_below(stress_difference(found, marched), 3 * estimates,
                        "anderson and march")


@full
def test_family():
    """No method does worse than its parts, and all end in the same state; more of it
    by tests/benchmarks/periodic_search.py."""
    for seed in range(100, 112):
        periods, apart = search_by_all(seed, 300)
        print(f"problem {seed}: {periods}, differences of {apart:.2g} estimates")
        check(not periods or
              "automatic" in periods and ratio_to_best(periods) <= 2,
              "no other method is better")
        check_below(apart, 3, "difference by estimated errors")


@full
def test_misleading_periods():
    """Far from periodic, some combinations of periods leap aside: none may end the
    search, or go on for ever."""
    settings = COARSE + [
        traction("0; 10*sin(2*pi*t/600)*(0.3+x) + 7.62215*cos(10*pi*t/600)"
                 " - 0.118222*(y-x)"),
        "Material/Relaxation time=if(x<0.5, 11.0228, 4747.97)",
        "Boundary/Gap=-0.000928362*(x-0.5)",
        "Loads/Body force=0; -3.89382*cos(2*pi*t/600)",
        "Material/Viscosity time factor=1 - 0.116017*cos(2*pi*t/600+1)",
        *steps(80)]
    found = compute("found", settings + method("automatic", "rk4", 1e-6, 80))
    exact = compute("exact", settings + method("automatic", "rk4", 1e-9, 200))
    check_below(stress_difference(exact, found), 3e-6,
                f"{found.summary['periods']} periods, stress")


@full
def test_without_contact():
    """What differs from the periodic stress does no work: its energy falls at least
    as fast as that of the slowest point, which tells how many periods are enough."""
    for tau, slowest in (("600", 600), ("if(x < 0.5, 300, 1800)", 1800)):
        settings = [
            "Geometry/Shape=rectangle", f"Material/Relaxation time={tau}",
            traction("0; 10*(1 + x)*sin(2*pi*t/600 + 1)"),
            "Output/Probes=top: 0.25, 1; body: 0.3, 0.6"]
        exact = compute("exact", settings + method("anderson", "heun"))
        for tolerance in (1e-3, 1e-6):
            periods = math.ceil(-math.log(tolerance) * slowest / PERIOD)
            enough = compute("enough", settings + method(
                "march", "heun", 0, periods=periods + 1))
            check_below(difference(exact, enough, probes=("top", "body")),
                        tolerance, f"tau = {tau}: after {periods} periods")


def test_onset():
    """Where the mean load opens the lip, t_0 is after its last contact."""
    onsets = []
    settings = [traction("0; 10*(0.5 - sin(2*pi*t/600))")] + relaxation(0.1)
    for split in ("on", "automatic"):
        found = compute("onset", settings + method(
            "march", "heun", 0, 60, split=split))
        secular = found.summary["secular"]
        print(f"split {split}: {secular['opening_nodes']} nodes open, t_0 = "
              f"{secular['onset']:.6g}")
        onsets.append(secular["onset"])
    check_below(abs(onsets[0] / onsets[1] - 1), 1e-6, "t_0 of both forms")
    # sin wt - cos(wt) / (w tau) and its mean, 5 t / tau
    omega, tau = 2 * math.pi / PERIOD, 0.1 * PERIOD
    check_below(abs(onsets[1] / (2 * math.hypot(tau, 1 / omega)) - 1), 5e-3,
                "t_0 = 2 tau sqrt(1 + 1/(omega tau)^2), to the order of Heun")
    # At the probes, whatever is more than rounding.
    pressed = [t for p in LIP for t, x in zip(
        *(found.table(f"probe_{p}.csv")[column] for column in
          ("t", "pressure"))) if x > 1e-6]
    last = secular["last_contact_of_opening_nodes"]
    print(f"last pressed at {max(pressed)}, told {last}")
    check(last <= onsets[1] + 15, "no contact after t_0, to a step")
    check(abs(last - max(pressed)) <= 15, "the last contact is reported")


@full
def test_march_with_split():
    """The split form's own contact fades; what is said to be converged must
    be."""
    settings = [traction("0; 10*(0.5 - sin(2*pi*t/600))")] + relaxation(0.1)
    exact = compute("exact", settings + method("march", "heun", 0, 60,
                                               split="automatic"))
    found = compute("found", settings + method("march", "heun", 1e-9, 2000,
                                               split="on"))
    check_below(difference(exact, found), 3e-9,
                f"{found.summary['periods']} periods, estimated error "
                f"{error_estimate(found):.1e}")


if __name__ == "__main__":
    test_anderson()
    test_march()
    test_anderson_and_march()
    test_units()
    test_automatic()
    test_without_contact()
    test_march_with_split()
    test_mean_of_steps()
    test_drift()
    test_spring()
    test_late_closing()
    test_family()
    test_misleading_periods()
    test_onset()
    test_few_steps()
