"""Hard cases of the load: none at all; one that leaves every node of the lip
with neither force nor opening; a mean within 1e-12 of zero."""

from hard_case import check, check_below, check_close, column, compute

PROBES = ("mouth", "inside", "tip", "body", "top")


def test_zero():
    """All results are zero, not nearly so, and the state is periodic."""
    for method in ("march", "anderson", "fourier"):
        results = compute("zero_load", [f"Periodic state/Method={method}",
                                        "Time integration/Scheme=trapezoid"])
        check(results.summary["converged"], f"no load, {method}: converged")
        for probe in PROBES:
            table = results.table(f"probe_{probe}.csv")
            del table["t"]
            check(all(value == 0 for values in table.values()
                      for value in values), f"no load, {method}: zero at {probe}")


def test_degenerate():
    """The bar's closed form, s_11 = F(t): the lip neither opens nor bears. What
    rounding moves its nodes by is not taken for a lip that goes on to close."""
    for solver in ("condensed active set", "active set", "projected sor"):
        results = compute("degenerate_lip", [f"Contact/Solver={solver}",
                                             "Contact/Relaxation factor=1.9",
                                             "Periodic state/Tolerance=1e-4"])
        stress = column(results, "body", "s_11")
        strain = max(stress) / 13000
        check_close(max(stress), 10, 1e-10, f"degenerate, {solver}: stress")
        for probe in ("mouth", "inside", "tip"):
            check_below(max(map(abs, column(results, probe, "pressure"))) / 10,
                        1e-10, f"degenerate, {solver}: pressure at {probe}")
            check_below(max(map(abs, column(results, probe, "opening"))) / strain,
                        1e-10, f"degenerate, {solver}: opening at {probe}")


def test_mean_near_zero():
    """The secular problem is homogeneous of degree one, on either side of a
    mean of zero, and what is marched does not see where it lies."""
    rates = {}
    for mean in (1, 1e-9, -1, -1e-9):
        secular = compute("mean_near_zero", [
            f"Loads/Traction=0; 10*sin(2*pi*t/600) + ({mean})",
            "Periodic state/Maximum periods=1"]).summary["secular"]
        check(secular["on"], f"a mean of {mean} flows")
        rates[mean] = secular["largest_rate"] / abs(mean)
    for sign in (1, -1):
        check_below(abs(rates[sign * 1e-9] / rates[sign] - 1), 1e-5,
                    f"flow of a mean of {sign * 1e-9}, relative to it")
    check_close(rates[-1] * 60 * 13000, 1, 1e-9, "flow of a closed crack")

    positive, negative = (compute("mean_near_zero", [
        f"Loads/Traction=0; 10*sin(2*pi*t/600) {sign} 1e-11"])
                          for sign in ("+", "-"))
    closed = negative.table("contact.csv")["closed_nodes"]
    check(min(closed) == 0 < max(closed), "the lip opens and closes")
    for probe in PROBES:
        table, other = (results.table(f"probe_{probe}.csv")
                        for results in (positive, negative))
        for names, size in ((("u_1", "u_2"), 10 / 13000),
                            (("s_11", "s_22", "s_12"), 10)):
            check_below(max(abs(a - b) for name in names
                            for a, b in zip(table[name], other[name])) / size,
                        1e-9, f"mean of 1e-11 and of -1e-11 at {probe}")


test_zero()
test_degenerate()
test_mean_near_zero()
