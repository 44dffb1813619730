"""Hard cases of long times: relaxation times of ten thousand periods, and a
thousand periods."""

import math

from hard_case import (MODULUS, PERIOD, check, check_below, column, compute,
                       largest_difference)


def test_slow_relaxation():
    """The periodic state is s = F(t) s_el with a lip that bears nothing. From
    rest a hundred periods do not come near it, though the stress hardly
    changes from one to the next; the other methods find it."""
    marched = compute("slow_relaxation", ["Periodic state/Tolerance=1e-4"], 3)
    change = marched.summary["stress_change"][-1]
    estimate = marched.summary["stress_error_estimate"][-1]
    print(f"slow: after {marched.summary['periods']} periods change "
          f"{change:.1e}, estimate {estimate:.2g}")
    check(change < 1e-4, "the change alone would have ended the march")
    least = max(column(marched, "mouth", "pressure")[-40:]) / 10
    check(estimate > 0.1 and least > 0.1, "and the state is far away")

    for method in ("fourier", "anderson"):
        results = compute("slow_relaxation", [
            f"Periodic state/Method={method}"])
        check_below(max(column(results, "mouth", "pressure")[-40:]) / 10, 1e-6,
                    f"slow, {method}: pressure")
        stress = column(results, "tip", "s_22")[-41:]
        check_below(largest_difference(
            stress, [stress[10] * math.sin(2 * math.pi * k / 40)
                     for k in range(41)]), 1e-6,
            f"slow, {method}: stress at the tip - F(t) s_el")


def test_thousand_periods():
    """Period 20 and period 1000 have the same stress, and the body has flown by
    980 periods' flow of its mean load, which is that of a closed crack."""
    results = compute("thousand_periods")
    for probe, name in (("mouth", "s_22"), ("mouth", "pressure"),
                        ("mouth", "opening"), ("top", "s_11")):
        values = column(results, probe, name)
        check_below(largest_difference(values[9990:10000], values[190:200]),
                    1e-9, f"a thousand periods: {name} at {probe}")
    u = column(results, "top", "u_2")
    flow = -1 / (MODULUS * 60)
    check_below(abs((u[10000] - u[200]) / (980 * PERIOD * flow) - 1), 1e-10,
                "a thousand periods: flow")


test_slow_relaxation()
test_thousand_periods()
