"""The numbers of the paper's example (model, section 5): changes of stress from
period to period and openings of the crack mouth to 4 digits, and the periodic
stress against F(t) s_el."""

from crevasse_run import SOURCE, check, check_below, check_close, run

CHANGES = [1.00e-1, 3.60e-2, 1.37e-2, 7.88e-3, 4.69e-3, 2.79e-3, 2.05e-3, 6.1e-4]
OPENINGS = {60: 2.56588e-3, 180: 8.73108e-3, 240: 9.97550e-3, 480: 4.27714e-4,
            540: 0., 600: 5.13674e-4, 1200: 6.71544e-4}

results = run(SOURCE / "prm/raous1980_asymptotic.prm", "asymptotic")
summary = results.summary

check(summary["contact_nodes"] == 7 and summary["unknowns"] == 150,
      "the mesh is that of 75 nodes")
check(summary["stress_change"][0] == 1., "before the first period is no stress")
for period, expected in enumerate(CHANGES, 2):
    check_close(summary["stress_change"][period - 1], expected,
                5.1e-3 * expected, f"change of stress in period {period}")
check_below(summary["stress_change"][9], 1e-12, "change of stress in period 10")
check(summary["converged"] and summary["periods"] == 10, "10 periods")

probe = results.table("probe_C.csv")
opening = dict(zip(probe["t"], probe["opening"]))
for instant, expected in OPENINGS.items():
    check_close(opening[instant], expected, 5e-9, f"opening at t = {instant}")

check_below(summary["elastic_comparison"]["stress_difference"], 1e-10,
            "periodic stress against F(t) s_el")
# Relative to nodal forces of the load; those that cancel in it are 500 times as
# large, and rounding leaves this much.
check_below(max(summary["certificate"].values()), 2e-11, "certificate")
check(summary["counters"]["vi_solves"] == 10 * 80 + 1, "2 VIs a step")
check(summary["counters"]["assemblies"] == 1, "one assembly")

# What the paper ran: three periods, the change of the last one about 3 %.
three = run(SOURCE / "prm/raous1980.prm", "three_periods").summary
check(three["converged"] and three["periods"] == 3, "three periods")
check_close(three["stress_change"][2], 3.60e-2, 5e-5, "change in period 3")

# Contact as the paper describes it: pressure only where closed, and
# open-closed-open in each period.
pressure = probe["pressure"]
check(all(p <= 1e-9 for p, u in zip(pressure, probe["opening"]) if u > 1e-6),
      "an open lip bears no pressure")
closed = [u <= 0. for u in probe["opening"][:41]]
switches = sum(a != b for a, b in zip(closed[1:], closed[2:]))
check(switches == 2, "open, closed, open in the first period")
