"""Chains with a spring, and chains that relax in shear alone: the viscoelastic tube
in an elastic casing, whose closed form Laplace's transform gives (Lee, Radok and
Woodward, Trans. Soc. Rheology 3, 1959), and harmonic balance with the mean load
that the spring bears."""

import cmath
import math

from crevasse_run import SOURCE, check, check_below, execute, overrides, run
from periodic_scenes import (ALTERNATING, BODY, COMMON, FOURIER, MIXED, PERIOD,
                             TWO_HARMONICS, compute, difference, method, traction)

CASING = SOURCE / "prm/casing.prm"
A, B, C = 1., 2., 2.05  # radii: bore, casing from inside, and from outside
G_0 = 100 / 2.8
BULK = 100 / 0.6
G_END = 0.1 * G_0
D = 1 / A**2 - 1 / B**2


def yielding(modulus, ratio):
    """Displacement of the casing by the pressure on it."""
    return (B * (1 + ratio) / modulus * ((1 - 2 * ratio) * B**2 + C**2)
            / (C**2 - B**2))


STIFF = yielding(2e5, 0.3)


def numerators(G, casing=STIFF):
    """Of the displacements of casing and bore."""
    M = BULK + G / 3
    return {"casing": casing * (G + M),
            "bore": A / B * casing * (G + M)
            + (1 / A - A / B**2) * B * (2 * M * casing + B) / 2}


def denominators(casing=STIFF):
    """Coefficients of their common polynomial of G."""
    return BULK, 4 / 3 + D * B * (2 * BULK * casing + B), 2 / 3 * D * B * casing


def response(G, casing=STIFF):
    q = denominators(casing)
    return {name: value / (q[0] + q[1] * G + q[2] * G**2)
            for name, value in numerators(G, casing).items()}


def after_step(t):
    """Response to a pressure of 1 from t = 0: the residues at the poles."""
    q = denominators()
    root = -q[1] - math.sqrt(q[1]**2 - 4 * q[0] * q[2])
    result = response(G_END)
    for G in (2 * q[0] / root, root / (2 * q[2])):
        s = (G - G_END) / (G_0 - G)
        weight = (math.exp(s * t) / s * (G_0 - G_END) / (G_0 - G)**2
                  / (q[1] + 2 * q[2] * G))
        for name, value in numerators(G).items():
            result[name] += weight * value
    return result


def worst_difference(results, expected, allowed):
    for name, bound in allowed.items():
        table = results.table(f"probe_{name}.csv")
        right = [expected(t)[name] for t in table["t"]]
        check_below(max(abs(a - b) for a, b in zip(table["u_1"], right))
                    / max(map(abs, right)), bound, f"displacement of the {name}")


BOUNDS = {"casing": 3e-5, "bore": 1e-3}


def test_casing():
    check(abs(after_step(0.)["bore"] - response(G_0)["bore"]) < 1e-14,
          "the closed form begins elastically")
    results = run(CASING, "casing", ["Output/Fields=none"])
    print("pressure on the casing from {0:.5f} to {1:.5f}".format(
        *(results.table("probe_casing.csv")["u_1"][k] / STIFF for k in (0, -1))))
    worst_difference(results, after_step, BOUNDS)


def test_casing_under_waves():
    """A sine and a mean by harmonic balance. The slow casing, whose shear has a spring
    of a tenth, too, ends with that under the mean."""
    omega = 2 * math.pi / 5
    bulk, shear = 2e5 / 1.2, 0.1 * 2e5 / 2.6
    weak = yielding(9 * bulk * shear / (3 * bulk + shear),
                    (3 * bulk - 2 * shear) / (6 * bulk + 2 * shear))

    def expected(t):
        s = 1j * omega
        wave = response((G_END + G_0 * s) / (1 + s))
        return {name: mean + (wave[name] * cmath.exp(s * t)).imag
                for name, mean in response(G_END, weak).items()}

    results = run(CASING, "waves", [
        "Loads/Period=5", "Loads/Pressure=1 + sin(2*pi*t/5)",
        "Time integration/Step control=uniform",
        "Time integration/Steps per period=8", "Time integration/Scheme=trapezoid",
        "Periodic state/Method=fourier", "Periodic state/Harmonics=exact",
        "Periodic state/Tolerance=1e-6", "Output/Field times=0",
        "Output/Fields=none"])
    worst_difference(results, expected, BOUNDS)


def test_one_body():
    """Alone it is the isotropic body that creeps at constant volume."""
    strain = ["Material/Plane state=plane strain", traction(ALTERNATING)]
    steps = method("march", tolerance=0, periods=2)
    chain = compute("chain", strain + steps + [
        "Material/Viscosity=chain", "Material/Chain=1: 300",
        "Material/Chain in shear only=true", "Material/Poisson ratio=0.2"])
    isotropic = compute("isotropic", strain + steps + [
        "Material/Viscosity=isotropic", "Material/Poisson ratio=0.2",
        "Material/Viscous modulus=3*13000/2.4*300",
        "Material/Viscous Poisson ratio=0.5"])
    check_below(difference(chain, isotropic, True), 1e-11, "one body")


def test_zener_body():
    """A bar of one body and a spring: u = F / E(i omega), with a mean."""
    omega, tau, w = 2 * math.pi / PERIOD, 90., 0.7
    modulus_of_wave = 13000 * (1 - w + w * 1j * omega * tau / (1 + 1j * omega * tau))
    found = compute("zener", FOURIER + [
        "Geometry/Shape=rectangle", "Boundary/Fixed points=automatic",
        "Output/Probes=top: 0.25, 1", traction("0; 3 + 10*sin(2*pi*t/600)"),
        "Material/Viscosity=chain", f"Material/Chain={w}: {tau}",
        "Time integration/Steps per period=6", "Periodic state/Harmonics=exact"])
    table = found.table("probe_top.csv")
    expected = [3 / 13000 / (1 - w)
                + (10 / modulus_of_wave * cmath.exp(1j * omega * t)).imag
                for t in table["t"]]
    check_below(max(abs(a - b) for a, b in zip(table["u_2"], expected))
                / max(expected), 1e-11, "displacement of Zener's body")


THERMAL = ["Material/Thermal expansion=1e-5", "Boundary/Gap=-1e-4*x",
           "Loads/Temperature=40*x*sin(2*pi*t/600 + 1) - 30*y + 7"]
SHEAR = ["Material/Plane state=plane strain", "Material/Chain in shear only=true"]
MOTIONS = {
    "alternating": [traction(ALTERNATING)],
    "opens in part": [traction(MIXED)],
    "always open": [traction("0; 10*sin(2*pi*t/600) + 20")],
    "always closed": [traction("0; 10*sin(2*pi*t/600) - 20")],
    "two materials": [traction(TWO_HARMONICS),
                      "Material/Chain=0.6: if(x < 0.7, 100, 900); 0.3: 2000"],
    "heat and gap": [traction(TWO_HARMONICS)] + THERMAL,
    "shear": [traction(TWO_HARMONICS)] + SHEAR,
    "shear and heat": [traction(MIXED), "Discretisation/Degree=2"] + SHEAR + THERMAL,
    "a single instant": [traction("0; -2"), "Time integration/Steps per period=1"]}


def test_with_contact():
    """Against the trapezoidal rule with periods one after the other."""
    for name, settings in MOTIONS.items():
        settings = ["Material/Viscosity=chain", "Material/Chain=0.5: 60; 0.3: 600",
                    *settings]
        found = compute("spring_fourier", settings + FOURIER)
        marched = compute("spring", settings + method("anderson"))
        closes = max(max(found.table(f"probe_{p}.csv")["opening"])
                     for p in ("mouth", "inside")) == 0.
        check_below(difference(found, marched, not closes), 1e-9, name)


def test_refusals():
    for settings, words in (
            (["Material/Chain in shear only=true"],
             ["Chain in shear only", "plane stress", "plane strain"]),
            (SHEAR + ["Material/Stiffness matrix=2,0,0,0; 0,2,0,0; 0,0,2,0; 0,0,0,1"],
             ["Chain in shear only", "Stiffness matrix"]),
            (SHEAR + ["Periodic state/Method=averaged"],
             ["Chain in shear only", "averaged"])):
        code, _, message = execute(BODY, "--output", "results/refused", *overrides(
            COMMON + ["Material/Viscosity=chain", "Material/Chain=0.5: 60"]
            + settings))
        check(code == 2, f"{settings}: exit status {code}\n{message}")
        for word in words:
            check(word in message, f"the message lacks '{word}':\n{message}")


if __name__ == "__main__":
    test_casing()
    test_casing_under_waves()
    test_one_body()
    test_zener_body()
    test_with_contact()
    test_refusals()
