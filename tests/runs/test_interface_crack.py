"""Cracks between two isotropic materials: the infinite plate of Rice and Sih (1965),
energies of neighbouring crack lengths with open and closed lips, bodies that are
turned, mirrored, in other units and on two processes."""

import contextlib
import io
import math
import pathlib
import sys

import cracked
from crevasse_run import (SOURCE, check, check_below, execute, full, overrides, plain,
                          run, run_on, tier)
from inclusions import K_of, SCENE, axes, turned_scene

sys.path.insert(0, str(SOURCE / "source" / "python"))
from crevasse import report as make_report  # noqa: E402

# Above and below: E, nu.
ABOVE, BELOW = (10., 0.2), (1., 0.35)
SIDES = [0, 0.25, 0.5, 0.75, 1, 1.25, 1.5, 2, 3, 5, 9]
UP = [0, 0.25, 0.5, 0.75, 1, 1.5, 2, 3, 5, 9]


def plate(name, width=10., far=(2., 7., 4.), above=ABOVE, below=BELOW, crack=(-1, 1),
          state="stress", cycles=6, degrees=0., unit=(1., 1.)):
    """A plate |x|, |y| < width with a crack on its middle line, under the stress far
    away 22, 12 and 11 above; 11 below is that with the same strain. All is turned,
    and has units of length and stress."""
    across = [x for x in SIDES if x < width / 2] + [width / 2, width]
    across = [crack[0] if x == -1 else crack[1] if x == 1 else x
              for x in [-x for x in across[:0:-1]] + across]
    up = [y for y in UP if y < width / 2] + [width / 2, width]
    turn = cracked.turned(degrees)
    length, stress = unit

    def place(point):
        return tuple(length * x for x in turn(point))
    mesh = cracked.write_block(
        f"{name}.msh", (across, [-y for y in up[:0:-1]] + up),
        lambda middle, n: n == 1 and middle[1] == 0 and crack[0] < middle[0] < crack[1],
        place, lambda middle: 1 if middle[1] > 0 else 2)

    def plane(E, nu):
        return (E / (1 - nu**2), nu / (1 - nu)) if state == "strain" else (E, nu)
    (E_1, nu_1), (E_2, nu_2) = plane(*above), plane(*below)
    s_11, s_22, s_12 = far
    lower = E_2 * (s_11 - nu_1 * s_22) / E_1 + nu_2 * s_22
    _, _, x, y = axes(degrees)
    most = width * length * (1 - 1e-6)
    side = f"(if({x}>{most}, 1, 0)-if({x}<-{most}, 1, 0))"
    top = f"(if({y}>{most}, 1, 0)-if({y}<-{most}, 1, 0))"
    along = f"{stress}*({side}*if({y}>0, {s_11}, {lower!r}) + {top}*{s_12})"
    across = f"{stress}*({side}*{s_12} + {top}*{s_22})"
    return turned_scene(degrees, place, along, across, (above, below), stress, width,
                        "1, 2, 3, 4", mesh=mesh, state=state, cycles=cycles)


def tips_of(scene, name, settings=()):
    return run(scene, name, list(settings)).summary["crack_tips"]


def index(above, below, state):
    """The oscillating index by Dundurs' beta."""
    (mu_1, k_1), (mu_2, k_2) = (
        (E / (2 * (1 + nu)), 3 - 4 * nu if state == "strain" else (3 - nu) / (1 + nu))
        for E, nu in (above, below))
    beta = ((mu_1 * (k_2 - 1) - mu_2 * (k_1 - 1)) / (mu_1 * (k_2 + 1) + mu_2 * (k_1 + 1)))
    return math.log((1 - beta) / (1 + beta)) / (2 * math.pi), beta


def test_infinite_plate():
    """K = (s_22 + i s_12) (1 + 2i epsilon) sqrt(pi a) at the distance 2a (Rice and
    Sih, J. Appl. Mech. 32, 1965), and the conjugate at the other tip; plates of two
    sizes are extrapolated."""
    for state in tier(("stress",), ("stress", "strain")):
        epsilon, _ = index(ABOVE, BELOW, state)
        found = []
        for width in (10., 20.):
            tips = tips_of(plate(f"plate_{width}", width, state=state), "plate")
            found.append([K_of(tip) for tip in tips])
        for tip, narrow, wide in zip(tips, *found):
            own = epsilon if tip["direction"][0] > 0 else -epsilon
            check_below(abs(tip["interface"]["epsilon"] - own), 1e-12, "epsilon")
            check_below(abs(tip["interface"]["length"] - 2), 1e-12, "length")
            exact = complex(7., 4.) * (1 + 2j * own) * math.sqrt(math.pi)
            K = (4 * wide - narrow) / 3
            print(f"{state}: {narrow}, {wide}, {K}, exact {exact}, printed",
                  tip["K_I_error"], tip["K_II_error"])
            check_below(abs(K / exact - 1), 5e-3, f"{state}: K")
    with (contextlib.redirect_stdout(io.StringIO()),
          contextlib.redirect_stderr(io.StringIO()) as stderr):
        make_report.main(["results/plate"])
    check("damaged" not in stderr.getvalue(), stderr.getvalue())
    check("Crack tip 2" in pathlib.Path("results/plate/report.html").read_text(),
          "a report of tips without a direction of growth")


def release(name, far, settings=(), **shape):
    """The tip on the right of a crack, whose G is the derivative of the energy, half
    the work of the loads, by its place."""
    step = 0.02
    work = {}
    for k in (-1, 0, 1):
        results = run(plate(f"{name}_{k}", 4., far, crack=(-1, 1 + k * step), **shape),
                      name, ["Geometry/Refinements=1", *settings])
        work[k] = results.table("load_work.csv")["load_work"][-1] / 2
        if k == 0:
            tip = next(tip for tip in results.summary["crack_tips"]
                       if tip["direction"][0] > 0)
    slope = (work[1] - work[-1]) / (2 * step)
    G = tip["energy_release_rate"]["largest"]
    print(f"{name}: K {K_of(tip)}, zone {tip['interface']['contact_zone']}, "
          f"G {G}, -dU/da {slope}, {G / slope - 1:.2e}")
    check_below(abs(G / slope - 1), 1e-3, f"{name}: -dU/da")
    return tip


CLOSES = ["Boundary/Crack=7", "Boundary/Open crack=none"]


@full
def test_energy():
    """G of open lips is the derivative of the energy."""
    for state in ("strain", "stress"):
        release(state, (2., 7., 4.), state=state, cycles=9)


def test_contact():
    """K_II of lips that are closed next to the tip, and K around a small closed part:
    both have the G of the energy."""
    for name, far, cycles, is_wide in tier(
            (("wide", (0., 1., 8.), 8, True),),
            (("wide", (0., 1., 8.), 8, True), ("pressed", (0., -2., 4.), 8, True),
             ("small", (0., 7., 14.5), 9, False), ("opens", (0., 1., -8.), 8, False))):
        tip = release(name, far, CLOSES, cycles=cycles)
        zone = tip["interface"]["contact_zone"] / tip["interface"]["length"]
        check((zone >= 0.01) == is_wide, f"{name}: contact zone {zone}")
        check((tip["K_I"]["largest"] == 0.) == is_wide, f"{name}: K_I of closed lips")


@full
def test_layers():
    """Layers of the height 1 that moments M bend apart: G = 6 M^2 (1/E_1 + 1/E_2), the
    energy of both beams, as the rest of the strip has no load (Suo and Hutchinson,
    Int. J. Fracture 43, 1990)."""
    mesh = cracked.write_block(
        "layers.msh", ([0.25 * i for i in range(-32, 33)], cracked.steps(-1, 1, 8)),
        lambda middle, n: n == 1 and middle[1] == 0 and middle[0] < 0,
        material=lambda middle: 1 if middle[1] > 0 else 2)
    for E in ((10., 1.), (1., 10.)):
        scene = SCENE.format(
            mesh=mesh, points="8, 0: 1, 2; 7, 0: 2", state="stress", cycles=8, E=E,
            nu=(0.2, 0.35), loaded="1, 2, 3, 4",
            load="if(x < -7.9999, if(y > 0, 12*y - 6, -12*y - 6), 0); 0")
        tip, = tips_of(scene, "layers", ["Geometry/Refinements=1"])
        G = tip["energy_release_rate"]["largest"]
        print(f"layers: K {K_of(tip)}, G {G}")
        check_below(abs(G / (6 * (1 / E[0] + 1 / E[1])) - 1), 2e-3, "G of two layers")


@full
def test_pressed():
    """The lips of a crack that is pressed together by far slide as those of one body:
    K_II = s_12 sqrt(pi a), plates of two sizes being extrapolated."""
    narrow, wide = (
        [K_of(tip) for tip in tips_of(plate(f"pressed_{width}", width, (0., -40., 1.)),
                                      "pressed", CLOSES)] for width in (10., 20.))
    for a, b in zip(narrow, wide):
        check_below(abs((4 * b - a) / 3 / 1j / math.sqrt(math.pi) - 1), 2e-3,
                    "K_II of pressed lips")


def test_heated():
    """What a temperature does to two materials is what a tension does that strains the
    lower one as much less."""
    scene = plate("heated", 4., (0., 0., 0.), cycles=4)
    tension = 0.02 * BELOW[0]
    heated = tips_of(scene, "heated", [
        "Loads/Temperature=1", "Material/Thermal expansion=if(material < 1.5, 0.01, 0.03)"])
    pulled = tips_of(scene, "pulled", [
        f"Loads/Traction=if(y < 0, {tension}*(if(x > 3.99, 1, 0)-if(x < -3.99, 1, 0)), "
        "0); 0"])
    for tip, other in zip(heated, pulled):
        check_below(abs(K_of(tip) / K_of(other) - 1), 1e-3, "K of a heated plate")


@full
def test_invariances():
    """Bodies that change places have the conjugate K; turned, in other units and on
    two processes, with integrals over smaller squares."""
    far, settings = (2., 7., 4.), {"width": 4., "cycles": 3}
    text = plate("as_it_is", far=far, **settings)
    tips = tips_of(text, "as_it_is")
    size = abs(K_of(tips[0]))

    def compare(what, others, allowed, image=lambda K: K):
        for tip, other in zip(tips, others):
            check_below(abs(image(K_of(other)) - K_of(tip)) / size, allowed, what)
    s_11 = BELOW[0] * (2 - ABOVE[1] * 7) / ABOVE[0] + BELOW[1] * 7
    compare("mirrored",
            tips_of(plate("mirrored", far=(s_11, 7., -4.), above=BELOW, below=ABOVE,
                          **settings), "mirrored"), 1e-9, lambda K: K.conjugate())
    length, stress = 1e-3, 1e9
    for degrees in tier((33.,), (33., 90., 180.)):
        compare(f"turned by {degrees}, in other units",
                tips_of(plate("turned", far=far, degrees=degrees, unit=(length, stress),
                              **settings), "turned"), 1e-9,
                lambda K: K / stress / math.sqrt(length))
    compare("two processes", run_on(2, "as_it_is.prm", "shared").summary["crack_tips"],
            1e-9)


@full
def test_radii():
    """Two squares differ by less than the printed error."""
    text = plate("radii", 4., cycles=4)
    wide, narrow = (tips_of(text, "radii", [
        "Geometry/Refinements=1", "Crack tip/Radius=" + radius])
                    for radius in ("0", "0.5"))
    for tip, other in zip(wide, narrow):
        for K in ("K_I", "K_II"):
            check_below(abs(tip[K]["largest"] - other[K]["largest"]),
                        tip[K + "_error"], f"{K} of two radii")


def test_relaxation():
    """With one relaxation time the stress stays, and K with it; what changes it, and
    singular functions, are refused."""
    text = plate("relaxes", 4., cycles=2)
    K = K_of(tips_of(text, "relaxes")[0])
    march = ["Material/Viscosity=relaxation time", "Material/Relaxation time=1",
             "Time integration/Scheme=sdirk2", "Time integration/Steps per period=4",
             "Periodic state/Method=march", "Periodic state/Maximum periods=1",
             "Periodic state/Tolerance=0"]
    table = run(text, "crept", march).table("crack_tip_1.csv")
    worst = max(abs(complex(*pair) / K - 1)
                for pair in zip(table["K_I"], table["K_II"]))
    check_below(worst, 1e-6, "K of a body that creeps")
    pathlib.Path("refused.prm").write_text(plain(text))
    for settings, words in (
            ([*march, "Material/Relaxation time=material"], "same relaxation time"),
            ([*march, *CLOSES], "Open crack"),
            ([*CLOSES, "Boundary/Friction coefficient=0.2"], "with friction"),
            (["Material/Young modulus=if(y > 0.1*(x - 1), 10, 1)"], "other fields"),
            (["Discretisation/Singular functions=2", "Refinement/Strategy=none"],
             "other fields")):
        status, _, error = execute("--check", "refused.prm", *overrides(settings))
        check(status == 2 and words in error, f"{settings}: {error}")


TESTS = [test_infinite_plate, test_energy, test_contact, test_layers, test_pressed,
         test_heated, test_invariances, test_radii, test_relaxation]

if __name__ == "__main__":
    for test in TESTS:
        test()
