"""Debonds of circular inclusions, where two materials meet along an arc: the infinite plate
of England (1966) and Toya (1974), energies of neighbouring debonds with open and closed
lips and with temperatures, curved cracks in one material, straight interfaces, bodies
that are turned, mirrored, in other units and on two processes."""

import math
import pathlib

from crevasse_run import (check, check_below, execute, full, overrides, plain, run, run_on,
                          tier)
from inclusions import K_of, PLATE, bent_plate, debond, exact

CLOSES = ["Boundary/Crack=7", "Boundary/Open crack=none"]
LOADS = (0., 7., 2.)


def tips_of(scene, name, settings=()):
    """Tips in the order of the angles of a debond above the middle."""
    tips = run(scene, name, list(settings)).summary["crack_tips"]
    return sorted(tips, key=lambda tip: -tip["position"][0])


def error_of(tip):
    return abs(complex(tip["K_I_error"], tip["K_II_error"]))


def test_infinite_plate():
    """K of the infinite plate, extrapolated from two plates."""
    for state, crack in tier((("stress", (60, 120)),),
                             (("stress", (60, 120)), ("strain", (20, 100)))):
        found = []
        for width in (10., 20.):
            tips = tips_of(debond(f"plate_{width}", crack, width, LOADS, state=state),
                           "plate", ["Geometry/Refinements=1"])
            found.append([K_of(tip) for tip in tips])
        for tip, K, narrow, wide in zip(tips, exact(crack, LOADS, state=state), *found):
            length = math.radians(crack[1] - crack[0])
            check_below(abs(tip["interface"]["length"] / length - 1), 1e-6, "length")
            error = abs((4 * wide - narrow) / 3 / K - 1)
            print(f"{state}: {narrow}, {wide}, exact {K}, printed {error_of(tip) / abs(K)}")
            check_below(error, 2e-3, f"{state}: K")


def release(name, crack, settings=(), step=0.5, allowed=1e-3, **shape):
    """The tip on the left of a debond, whose G is the derivative of the energy, half the
    work of the loads, by its place."""
    work = {}
    for k in (-1, 0, 1):
        results = run(debond(f"{name}_{k}", (crack[0], crack[1] + k * step), 4., **shape),
                      name, ["Geometry/Refinements=1", *settings])
        work[k] = results.table("load_work.csv")["load_work"][-1] / 2
        if k == 0:
            tip = min(results.summary["crack_tips"], key=lambda tip: tip["position"][0])
    slope = (work[1] - work[-1]) / (2 * math.radians(step))
    G = tip["energy_release_rate"]["largest"]
    print(f"{name}: K {K_of(tip)}, zone {tip['interface']['contact_zone']}, "
          f"G {G}, -dU/da {slope}, {G / slope - 1:.2e}")
    check_below(abs(G / slope - 1), allowed, f"{name}: -dU/da")
    return tip


@full
def test_energy():
    """G of open lips is the derivative of the energy."""
    for crack, state in (((70, 110), "strain"), ((45, 135), "stress")):
        release(f"open_{crack[1]}", crack, state=state, cycles=11, far=(0., 7., 0.))


def test_contact():
    """G of debonds so long that their lips touch at the tips, over 3 and 0.2 % of them."""
    for name, crack, far in tier(
            (("long", (15, 165), (0., 7., 0.)),),
            (("long", (15, 165), (0., 7., 0.)), ("middle", (30, 150), (0., 7., 0.)))):
        tip = release(name, crack, CLOSES, allowed=2e-3, cycles=11, far=far)
        zone = tip["interface"]["contact_zone"] / tip["interface"]["length"]
        is_wide = zone >= 0.01
        check(zone > 0. and is_wide == (name != "middle"), f"{name}: zone {zone}")
        check((tip["K_I"]["largest"] == 0.) == is_wide, f"{name}: K_I of closed lips")


HEATS = ["Loads/Temperature=1", "Material/Thermal expansion=if(material < 1.5, {}, {})"]


@full
def test_heated():
    """The work of loads on the displacement of a heated inclusion changes with the length
    as G of both together does, less G of each: for tension and shear, which see all of
    K of the heat."""
    step, crack, heats = 0.5, (60, 120), [HEATS[0], HEATS[1].format(0.3, 0.1)]
    for name, far in (("tension", (0., 7., 0.)), ("shear", (2., 5., 4.))):
        work, G = {}, {}
        for k in (-1, 0, 1):
            for what, load, settings in (
                    ("load", far, []), ("heat", (0., 0., 0.), heats), ("both", far, heats)):
                results = run(debond(f"heated_{k}", (crack[0], crack[1] + k * step), 4.,
                                     load, cycles=11),
                              "heated", ["Geometry/Refinements=1", *settings])
                work[what, k] = results.table("load_work.csv")["load_work"][-1]
                G[what, k] = min(results.summary["crack_tips"], key=lambda tip:
                                 tip["position"][0])["energy_release_rate"]["largest"]
        slope = ((work["both", 1] - work["load", 1]) - (work["both", -1] - work["load", -1])
                 ) / (2 * math.radians(step))
        mixed = G["both", 0] - G["load", 0] - G["heat", 0]
        print(f"{name}: G {G}, mixed {mixed}, derivative {slope}")
        check_below(abs(mixed - slope) / G["both", 0], 1e-3, f"{name}: G of heat and load")


@full
def test_one_material():
    """Inclusions that are stiffer and softer by 0.2 % have, on the mean, K of an arc in
    one material."""
    crack = (50, 120)
    one = tips_of(debond("one", crack, 4., LOADS, inclusion=PLATE), "one")
    both = [tips_of(debond("two", crack, 4., LOADS, inclusion=(factor, PLATE[1])), "two")
            for factor in (1.002, 1 / 1.002)]
    for tip, stiff, soft in zip(one, *both):
        check_below(abs((K_of(stiff) + K_of(soft)) / 2 / K_of(tip) - 1), 2e-3,
                    "K of nearly equal materials")


@full
def test_invariances():
    """Mirrored bodies have the conjugate K; turned, in other units and on two processes."""
    crack, settings = (50, 110), {"width": 4., "cycles": 3, "n": 16}
    tips = tips_of(debond("as_it_is", crack, far=LOADS, **settings), "as_it_is")

    def compare(what, others, image=lambda K: K, allowed=1e-8):
        for tip, other in zip(tips, others):
            check_below(abs(image(K_of(other)) - K_of(tip)) / abs(K_of(tip)), allowed, what)
    mirrored = tips_of(debond("mirrored", (180 - crack[1], 180 - crack[0]),
                              far=(LOADS[0], LOADS[1], -LOADS[2]), **settings), "mirrored")
    compare("mirrored", mirrored[::-1], lambda K: K.conjugate())
    length, stress = 1e-3, 1e9
    # Nodes of refined curved cells are found by iteration.
    for degrees, allowed in ((90., 1e-8), (-37., 2e-5)):
        compare(f"turned by {degrees}, in other units",
                tips_of(debond("turned", crack, far=LOADS, degrees=degrees,
                               unit=(length, stress), **settings), "turned"),
                lambda K: K / stress / math.sqrt(length), allowed)
    shared = run_on(2, "as_it_is.prm", "shared").summary["crack_tips"]
    compare("two processes", sorted(shared, key=lambda tip: -tip["position"][0]))


@full
def test_radii():
    """Two squares differ by less than the printed error."""
    text = debond("radii", (60, 120), 4., LOADS, cycles=5)
    wide, narrow = (
        tips_of(text, "radii", ["Geometry/Refinements=1", "Crack tip/Radius=" + radius])
        for radius in ("0", "0.3"))
    for tip, other in zip(wide, narrow):
        for K in ("K_I", "K_II"):
            check_below(abs(tip[K]["largest"] - other[K]["largest"]),
                        tip[K + "_error"] + other[K + "_error"], f"{K} of two radii")


@full
def test_straight():
    """An arc of 1000 crack lengths has K of a straight interface."""
    straight, bent = (tips_of(bent_plate(f"bent_{radius}", radius, 8), "bent",
                              ["Geometry/Refinements=1"])
                      for radius in (None, 2000.))
    for tip, other in zip(straight, bent):
        check_below(abs(K_of(other) / K_of(tip) - 1), 1e-3, "K of a large radius")


def test_refusals():
    """What K is not known of on arcs is refused, and why."""
    pathlib.Path("refused.prm").write_text(plain(debond("refused", (60, 120), 4., cycles=2)))
    march = ["Material/Viscosity=relaxation time", "Material/Relaxation time=1"]
    heats = [HEATS[0], HEATS[1].format("0.01", "0.02*(1 + x)")]
    for settings, words in (
            ([*CLOSES, "Boundary/Friction coefficient=0.2"], "no [Boundary] Friction"),
            (march, "Viscosity = none"),
            (["Discretisation/Degree=1"], "Degree = 1"),
            ([*CLOSES, "Boundary/Gap=-0.01"], "Gap"),
            (["Boundary/Loaded=1, 7"], "loads on lips"),
            (["Material/Young modulus=if(material < 1.5, 10, 1 + 0.1*x)"], "uniform"),
            (heats, "thermal strain")):
        status, _, error = execute("--check", "refused.prm", *overrides(settings))
        check(status == 2 and words in error, f"{settings}: {error}")
    for shape, words in (
            (lambda angle: 1 + 0.1 * math.cos(2 * angle), "other fields"),
            (lambda angle: 1 + 1e-3 * max(0., math.cos(angle) - 0.75), "not on the circle")):
        scene = debond("other", (60, 120), 4., cycles=2, shape=shape)
        pathlib.Path("other.prm").write_text(plain(scene))
        status, _, error = execute("--check", "other.prm")
        check(status == 2 and words in error, f"{words}: {error}")


TESTS = [test_infinite_plate, test_energy, test_contact, test_heated, test_one_material,
         test_invariances, test_radii, test_straight, test_refusals]

if __name__ == "__main__":
    for test in TESTS:
        test()
