"""Hard cases of the lip: a gap that closes late, a lip that closes from both
ends."""

import math

from hard_case import (MODULUS, check, check_below, column, compute,
                       largest_difference)
from mesh_writer import write

TAU, LOAD, RATIO = 60., 10., 0.2
GAP = 10.6 * RATIO * LOAD / MODULUS
TOUCHES = 9.6 * TAU


def gap_of(t):
    """The plate creeps down by nu F / E (1 + t/tau)."""
    return max(0., GAP - RATIO * LOAD / MODULUS * (1 + t / TAU))


def pressure_of(t):
    """From then on it is held: g' = (nu F - g) / tau."""
    return RATIO * LOAD * max(0., 1 - math.exp(-(t - TOUCHES) / TAU))


def test_late_closing():
    results = compute("late_closing")
    times = column(results, "end", "t")
    check_below(largest_difference(column(results, "end", "opening"),
                                   list(map(gap_of, times))), 1e-9,
                "late closing: opening")
    check_below(largest_difference(column(results, "end", "pressure"),
                                   list(map(pressure_of, times))), 1e-5,
                "late closing: pressure")


def test_not_periodic():
    """In the second period the stress repeats to the last digit: it must not be
    called periodic, for the lip is to touch in the tenth."""
    for settings, words in (
            ([], "the lip bears"),
            (["Periodic state/Secular split=off"], "continues to close"),
            (["Material/Viscosity time factor=if(t < 30, 1, 1.1)"],
             "continues to close"),
            (["Material/Relaxation time=if(t < 30, 60, 61)"],
             "continues to close")):
        results = compute("late_closing", ["Periodic state/Tolerance=1e-6",
                                           *settings], 3)
        check(results.summary["periods"] < 9, "it ends before it touches")
        log = (results.directory / "log.txt").read_text()
        check("not the periodic one" in log and words in log,
              f"{settings}: {log[-600:]}")
    results = compute("late_closing", [
        "Periodic state/Tolerance=1e-6", "Periodic state/Method=fourier",
        "Time integration/Scheme=trapezoid",
        "Time integration/Locate contact events=false"])
    check_below(abs(column(results, "end", "pressure")[0] / (RATIO * LOAD) - 1),
                1e-11, "late closing, harmonic balance: pressure")


def test_both_ends():
    """The mirror image is the same, the closed part is two ends that grow, and
    all solvers agree on it."""
    runs = [compute("both_ends", [f"Contact/Solver={solver}",
                                  "Contact/Relaxation factor=1.9"])
            for solver in ("condensed active set", "active set",
                           "projected sor")]
    for name in ("opening", "pressure", "s_22"):
        left, right = (column(runs[0], probe, name)
                       for probe in ("left", "right"))
        check_below(largest_difference(left, right), 1e-11,
                    f"both ends: {name} left - right")
        for results in runs[1:]:
            check_below(largest_difference(column(results, "left", name), left),
                        1e-10, f"both ends: {name} by another solver")
    closed = runs[0].table("contact.csv")["closed_nodes"]
    rising = closed[:-1]  # the temperature starts anew at the last instant
    check(rising == sorted(rising) and rising[:2] == [0, 2] and rising[-1] == 33,
          f"from two nodes to all, after rest: {rising}")
    first = {probe: next(i for i, p in enumerate(
        column(runs[0], probe, "pressure")) if p > 1e-9)
        for probe in ("left", "right", "middle")}
    check(first["left"] == first["right"] < first["middle"],
          f"from both ends: {first}")


def test_gap_at_the_tip():
    """0 there but for the rounding of the tip's coordinate: no mistake. Not
    loaded, the lip is open by the gap."""
    results = compute("zero_load", ["Geometry/Subdivisions=14, 4",
                                    "Boundary/Gap=-1e-4*(x-0.5)"])
    for probe, expected in (("mouth", 5e-5), ("tip", 0.)):
        check_below(max(abs(x - expected) for x in
                        column(results, probe, "opening")), 1e-15,
                    f"gap: opening at {probe} - gap")

    # At the origin a coordinate's own size says nothing of its rounding.
    write("tip.msh", lambda x, y: (x - 0.5 if x != 0.5 else -1e-17, y))
    compute("mesh_file", ["Geometry/Mesh file=tip.msh", "Loads/Traction=0; 0",
                          "Boundary/Fixed points=-0.5, 0: 1",
                          "Output/Probes=mouth: 0.5, 0", "Boundary/Gap=-1e-4*x"])


test_late_closing()
test_both_ends()
test_not_periodic()
test_gap_at_the_tip()
