"""Nothing depends on the choice of units: stresses scaled by 1e6 and lengths by
1e-3, or time by 1e4, change no result beyond rounding."""

from crevasse_run import SOURCE, check, check_below, run

COMMON = ["Output/Fields=none", "Contact/Tolerance=1e-14",
          "Contact/Relaxation factor=1.94"]


def compare(base, other, factors, what, bound=1e-10):
    """Columns of one kind (displacements, stresses) share one scale."""
    for columns, factor in factors:
        size = factor * max(abs(x) for column in columns for x in base[column])
        for column in columns:
            difference = max(abs(a * factor - b) for a, b in
                             zip(base[column], other[column]))
            check_below(difference / size, bound, f"{what}: {column}")


DISPLACEMENTS = ["u_1", "u_2", "opening"]
STRESSES = ["s_11", "s_22", "s_33", "s_12", "pressure"]

scene = SOURCE / "prm/raous1980.prm"
base = run(scene, "base", COMMON)
probe = base.table("probe_C.csv")

length, stress = 1e-3, 1e6
scaled = run(scene, "scaled", COMMON + [
    f"Geometry/Width={length}", f"Geometry/Height={length}",
    f"Geometry/Crack length={0.5 * length}",
    f"Boundary/Fixed points={0.5 * length}, 0",
    f"Output/Probes=C: {length}, 0",
    f"Material/Young modulus={13000 * stress}",
    f"Loads/Traction=0; {10 * stress}*sin(2*pi*t/600)"])
compare(probe, scaled.table("probe_C.csv"),
        [(["t"], 1.), (DISPLACEMENTS, length), (STRESSES, stress)],
        "stress 1e6, length 1e-3")
changes = zip(base.summary["stress_change"], scaled.summary["stress_change"])
check_below(max(abs(a - b) for a, b in changes), 1e-10, "changes of stress")
iterations = [results.summary["counters"]["vi_iterations"]
              for results in (base, scaled)]
check(abs(iterations[0] - iterations[1]) <= 1e-2 * iterations[0],
      f"as many iterations: {iterations}")

time = 1e4
slow = run(scene, "slow", COMMON + [
    f"Loads/Period={600 * time}", f"Material/Relaxation time={60 * time}",
    f"Loads/Traction=0; 10*sin(2*pi*t/{600 * time})",
    f"Output/Field times={150 * time}"])
compare(probe, slow.table("probe_C.csv"),
        [(["t"], time), (DISPLACEMENTS, 1.), (STRESSES, 1.)],
        "time 1e4")
