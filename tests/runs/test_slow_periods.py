"""Periods of which the stress hardly changes, far from the periodic state: a
march must not take them for it. And ends that are the periodic state but for
rounding, which must be taken for it."""

from crevasse_run import check, check_below, full
from periodic_scenes import (FOURIER, compute, difference, error_estimate, log,
                             method, steps, traction)

COARSE = ["Geometry/Subdivisions=6, 3", "Contact/Tolerance=1e-13"]
TOLERANCE = 1e-6


def test_varying_viscosity():
    """A fast part comes to rest at once, slow ones hardly begin to: changes
    fall fast, whatever varies in time, and however it is written."""
    time = "Material/Relaxation time=if(y<0.35, 60, if(y<0.7, 6e5, 3e6))"
    bodies = {
        "viscosity": [time + "*(1 + 0.5*cos(2*pi*t/600))"],
        "factor of viscosity": [
            time, "Material/Viscosity time factor=1 + 0.5*cos(2*pi*t/600)"],
        "stiffness": [
            time, "Material/Young modulus=13000*(1 + 0.2*cos(2*pi*t/600))"]}
    for name, body in bodies.items():
        settings = COARSE + body + steps(20) + [
            traction("0; 10*sin(2*pi*t/600) + 5")]
        marched = compute("marched", settings + method(
            "march", "sdirk2", TOLERANCE, periods=20), status=3)
        estimate = error_estimate(marched)
        print(f"{name}: change {marched.summary['stress_change'][-1]:.1e}, "
              f"estimated error {estimate:.1e}")
        check(1e-2 < estimate < 1, "the slow part is known to be on its way")
        if name == "factor of viscosity":
            exact = compute("exact", settings + method(
                "anderson", "sdirk2", TOLERANCE))
            error = difference(exact, marched)
            print(f"error {error:.1e}")
            check(1e-2 < error < estimate * 10, "as it is")


@full
def test_viscosity_of_an_instant():
    """A body that flows a thousand times as fast for an instant of the period:
    what its strain lacks is measured by all of the period."""
    instants = [0.2 * k for k in range(4)] + [25. * k for k in range(1, 25)]
    settings = COARSE + [
        traction("0; if(t<0.6, -0.5, 10*sin(2*pi*t/600) - 0.5)"),
        "Boundary/Gap=-0.01*(x-0.5)", "Material/Relaxation time=600",
        "Material/Viscosity time factor=if(t<0.6, 1, 1e4)",
        "Time integration/Step control=list",
        "Time integration/Steps=" + ", ".join(map(str, instants))]
    exact = compute("exact", settings + method("averaged", "sdirk2", 1e-9))
    sinks = compute("sinks", settings + method(
        "anderson", "sdirk2", 1e-9, periods=20), status=3)
    check("set Method = averaged" in log(sinks), "anderson follows no drift")
    marched = compute("marched", settings + method(
        "march", "sdirk2", 1e-3, periods=20, split="on"), status=3)
    error, estimate = difference(exact, marched), error_estimate(marched)
    print(f"viscosity of an instant: error {error:.1e}, estimated "
          f"{estimate:.1e}")
    check(0.1 < error < 10 * estimate, "it is not yet periodic")


@full
def test_contact_that_ceases():
    """Where nodes come free for good the changes fall for a few periods, and
    then go on as slowly as before."""
    settings = COARSE + [
        "Geometry/Shape=centre crack", "Geometry/Subdivisions=7, 3",
        "Material/Plane state=plane strain", "Material/Poisson ratio=0.2",
        "Material/Young modulus=if(y<0.5, 10000.6, 35432.3)",
        "Material/Relaxation time=if(y<0.5, 1499.45, 568.748)",
        "Output/Probes=mouth: 0, 0; inside: 0.25, 0; near: 0.6, 0.1; "
        "top: 0.25, 1; body: 0.3, 0.6",
        traction("0.233795*sin(2*pi*t/600); 8.66389*cos(2*pi*t/600)*(1+x)")]
    exact = compute("exact", settings + method("anderson", "sdirk2", 1e-9))
    marched = compute("marched", settings + method(
        "march", "sdirk2", TOLERANCE))
    check_below(difference(exact, marched), 3 * TOLERANCE,
                f"contact ceases: {marched.summary['periods']} periods, "
                f"estimated error {error_estimate(marched):.1e}")


def test_forces_of_rounding():
    """A load with kinks and no mean, and a lip that is free in the mean: what
    it bears is rounding, and so is what it should."""
    settings = COARSE + [
        traction("0; 10*(abs(sin(2*pi*t/600+0.1)) - 2/pi)"),
        "Material/Relaxation time=if(y<0.5, 600, 3000)",
        "Boundary/Gap=-0.001*(x-0.5)"]
    found = compute("found", settings + FOURIER)
    check_below(abs(found.summary["secular"][
        "mean_contact_force_of_last_period"]), 1e-13, "force on the lip")


@full
def test_step_astray():
    """Steps of anderson that would go astray are taken with fewer periods."""
    settings = COARSE + steps(16) + [
        traction("0; -5.82939*cos(6*pi*t/600+2.76387)*(x-0.5)"
                 " + 8.89022*sin(6*pi*t/600+0.636939)*(0.3+x)"
                 " - 0.539808*sin(4*pi*t/600)*(0.3+x)"
                 " + if(t<210, -6.22995, -5.14907) - 1.03442*(1-2*x)"),
        "Geometry/Subdivisions=7, 3", "Material/Plane state=plane strain",
        "Material/Poisson ratio=0", "Material/Relaxation time=55003.7",
        "Boundary/Gap=-0.00770728*(x-0.5)"]
    found = compute("found", settings + method(
        "anderson", "sdirk2", TOLERANCE, periods=100))
    print(f"a step astray: {found.summary['periods']} periods")
    check("anderson combined fewer periods" in log(found),
          "there is such a step")


@full
def test_negative_weights():
    """Steps that weigh some of their stages negatively cause a warning, and
    only where it matters."""
    for load, kind, order, is_warned in (
            ("+ 5", "implicit", 2, False), ("+ 5", "implicit", 3, True),
            ("+ 5", "implicit", 4, True), ("+ 5", "implicit", 5, True),
            ("", "implicit", 4, False), ("+ 5", "explicit", 4, False),
            ("+ 5", "explicit", 5, True)):
        found = compute("found", COARSE + steps(40) + [
            traction("0; 10*sin(2*pi*t/600)" + load),
            f"Time integration/Order={order}"]
            + method("anderson", "arkode " + kind, 1e-3))
        check(("negative weight" in log(found)) == is_warned,
              f"mean load 0{load}, {kind}, order {order}: warned {is_warned}")


def test_rounding_that_repeats():
    """A body under a constant load that flows far in each period: each adds the same
    rounding of 1e-9 to the stress, which is that of the elastic body."""
    settings = [traction("0; 1"), "Material/Relaxation time=1",
                "Discretisation/Degree=2", "Geometry/Subdivisions=28, 8"]
    found = compute("rounding", settings + steps(80) + method(
        "march", "sdirk2", TOLERANCE, periods=20))
    error = found.summary["stress_change"][-1]
    check(found.summary["converged"] and 1e-10 < error, f"change {error}")
    check_below(error_estimate(found), 1e-8, "estimated error")


if __name__ == "__main__":
    test_varying_viscosity()
    test_viscosity_of_an_instant()
    test_contact_that_ceases()
    test_forces_of_rounding()
    test_step_astray()
    test_negative_weights()
    test_rounding_that_repeats()
