"""A crack that grows in a creeping body: nodes are released, and the viscous strain
stays. Against the closed form of a body that creeps in proportion to its stiffness,
where the stress forgets the shorter crack at once and the displacement never does;
resumed runs; cracks that need other cells."""

import math

import numpy

from crevasse_run import SOURCE, check, check_below, execute, overrides, run, run_on

SCENE = SOURCE / "tests/runs/plain.prm"
TAU, PERIOD, GROWS = 60., 600., 3
SETTINGS = ["Geometry/Shape=edge crack", "Geometry/Subdivisions=20, 10",
            "Material/Young modulus=13000", "Material/Poisson ratio=0.2",
            "Discretisation/Singular functions=0", "Crack tip/Stress intensity=true",
            "Output/Probes=mouth: 1, 0; top: 0.5, 1", "Output/Fields=none",
            f"Loads/Period={PERIOD}", "Loads/Traction=0; 1",
            f"Material/Relaxation time={TAU}", "Periodic state/Method=march",
            "Periodic state/Tolerance=0", "Periodic state/Maximum periods=5"]
LENGTH, GROWTH = "Geometry/Crack length=", "Geometry/Crack growth="


def body(name, *settings, **options):
    return run(SCENE, name, [*SETTINGS, *settings], **options)


def test_closed_form():
    """u = u_2 + (t_1 u_1 + (t - t_1) u_2) / tau with the elastic displacements of both
    lengths, and K is that of the present length."""
    short, long = (body(f"fresh_{a}", f"{LENGTH}{a}", "Periodic state/Maximum periods=1")
                   for a in (0.5, 0.6))
    grown = body("grown", f"{LENGTH}0.5", f"{GROWTH}{GROWS}: 0.6")
    check(grown.summary["crack_growth"] == [{"after_period": GROWS, "crack_length": 0.6}],
          "summary")
    K_short, K_long = (fresh.table("crack_tip.csv")["K_I"][0] for fresh in (short, long))
    tip = grown.table("crack_tip.csv")
    grows = GROWS * PERIOD
    for t, K in zip(tip["t"], tip["K_I"]):
        if not math.isclose(t, grows):
            check_below(abs(K / (K_short if t < grows else K_long) - 1), 1e-9, f"K at {t}")
    for probe, column in (("mouth", "opening"), ("top", "u_2")):
        u_short, u_long = (fresh.table(f"probe_{probe}.csv")[column][0]
                           for fresh in (short, long))
        table = grown.table(f"probe_{probe}.csv")
        for t, u in zip(table["t"], table[column]):
            if t > grows * (1 + 1e-9):
                exact = u_long + (grows * u_short + (t - grows) * u_long) / TAU
                check_below(abs(u / exact - 1), 1e-9, f"{probe} {column} at {t}")


def test_resumed():
    """From before and after the growth, the tables are the same."""
    growth = ["Material/Chain=0.6: 60", "Material/Viscosity=chain",
              "Loads/Traction=0; sin(2*pi*t/600)",
              f"{LENGTH}0.5", f"{GROWTH}2: 0.55; 4: 0.6"]
    whole = body("whole", *growth)
    for first in (1, 2, 3):
        part = body("part", *growth, "Output/Checkpoint every=1",
                    f"Periodic state/Maximum periods={first}")
        status, _, error = execute(SCENE, "--output", part.directory, "--resume",
                                   *overrides([*SETTINGS, *growth, "Output/Checkpoint every=1"]))
        check(status == 0, error)
        for name in ("crack_tip.csv", "probe_mouth.csv", "contact.csv"):
            check((part.directory / name).read_bytes()
                  == (whole.directory / name).read_bytes(), f"{first}: {name}")


def test_ranks():
    """On two processes, where cells of the lip change their owners: the same tables."""
    growth = [*SETTINGS, "Loads/Traction=0; sin(2*pi*t/600)", f"{LENGTH}0.5",
              f"{GROWTH}2: 0.55; 4: 0.6"]
    one, two = run(SCENE, "one", growth), run_on(2, SCENE, "two", growth)
    for name in ("crack_tip.csv", "probe_mouth.csv", "probe_top.csv", "contact.csv"):
        for column, values in one.table(name).items():
            values = numpy.array(values)
            check_below(abs(two.table(name)[column] - values).max(),
                        1e-9 * max(abs(values).max(), 1e-9), f"{name}: {column}")


def test_refused():
    for words, message in (
            (["1: 0.61"], "needs other cells"), (["1: 0.4"], "must be greater than 0.5"),
            (["1: 0.6", "Periodic state/Tolerance=1e-6"], "Tolerance = 0"),
            (["1; 0.6"], "pairs of a number of periods and a length"),
            (["1: 0.6", "Discretisation/Singular functions=2"], "Singular functions")):
        status, _, error = execute(SCENE, "--output", "results/refused", *overrides(
            [*SETTINGS, f"{LENGTH}0.5", GROWTH + words[0], *words[1:]]))
        check(status == 2 and message in error, f"{words}: {status}, {error}")


for test in (test_closed_form, test_resumed, test_ranks, test_refused):
    test()
