"""Missions: periods of the motion from rest that are reached by leaps over periods,
against marches; and searches that end on what is asked."""

from averaged_scenes import LOAD, MESH, WARM, box_scene, relaxation
from crevasse_run import check, check_below, execute, full, overrides, run, tier
from periodic_scenes import (BODY, COMMON, PROBES, compute, difference, log, method,
                             period, steps, traction)

# Bodies whose stress still changes between the hundredth and the thousandth period.
BODIES = {
    "varies": LOAD + WARM + relaxation(6, 0.5),
    "opens": [traction("0; 10*sin(2*pi*t/600) + 3")] + relaxation(8, 0.5),
    "chain": LOAD + ["Material/Viscosity=chain",
                     "Material/Chain=0.6: 30*10^(6*(1-x^2)); 0.3: 3000"]}


def missions(numbers, *more):
    return ["Time integration/Scheme=sdirk2", "Periodic state/Method=automatic",
            "Periodic state/Maximum periods=300",
            f"Periodic state/Missions={numbers}", *more]


def stress_difference(one, other):
    """Relative to the largest stress at the probes."""
    pairs = [(period(one, f"probe_{p}.csv", c), period(other, f"probe_{p}.csv", c))
             for p in PROBES for c in ("s_11", "s_22", "s_12")]
    return (max(abs(a - b) for pair in pairs for a, b in zip(*pair))
            / max(abs(a) for one, _ in pairs for a in one))


def test_missions():
    """As a march of so many periods, but with a few dozen evaluations."""
    for name, body in BODIES.items():
        settings = MESH + steps(20) + body
        for numbers, most in tier([("10", 10), ("10, 1000", 60)],
                                  [("10", 10), ("10, 100, 1000", 60),
                                   ("10, 100, 1000, 10000", 80)]):
            found = compute("found", settings + missions(numbers))
            n = int(numbers.split(",")[-1])
            marched = compute("marched", settings + method("march", "sdirk2", 0, n))
            factors = [r.summary["counters"]["factorisations"]
                       for r in (found, marched)]
            rows = found.table("missions.csv")
            evaluations = int(rows["evaluations"][-1])
            wanted = [int(x) for x in numbers.split(",")]
            check([int(x) for x in rows["mission"]] == wanted, "a row for each")
            check(found.summary["missions"] == wanted
                  and found.summary["converged"] is None, "no periodic state is sought")
            check(log(found).count("  mission ") == len(wanted)
                  and f"  mission {n}\n" in log(found), "the log marks missions")
            check(evaluations <= most, f"{name}: {evaluations} evaluations for {n}")
            if n > 10:
                check(factors[0] - factors[1] <= 0.8 * evaluations,
                      f"{factors[0]} factorisations, {factors[1]} for steps")
            what = f"{name}, period {n}, {evaluations} evaluations: "
            check_below(stress_difference(marched, found),
                        1e-10 if n == 10 else 1.5e-3, what + "stress")
            check_below(difference(marched, found), 1e-10 if n == 10 else 3e-3,
                        what + "stress, pressure and contact force")
            here = marched.summary["probes"]["mouth"]["opening"]["largest"]
            check_below(abs(rows["opening_largest"][-1] / here - 1),
                        1e-8 if n == 10 else 1e-2, "opening")


def test_numbers():
    """K and growth of a mission are those of its period; so are they along a front."""
    words = missions("5, 12", "Crack tip/Stress intensity=true",
                     "Crack tip/Crack growth law=paris", "Crack tip/Paris factor=1e-6",
                     "Crack tip/Paris exponent=2")
    found = compute("plane", MESH + steps(20) + LOAD + relaxation(3) + words)
    row = {name: values[-1] for name, values in found.table("missions.csv").items()}
    K = found.summary["crack_tip"]["K_I"]
    check_below(abs(row["K_I_largest"] / K["largest"] - 1), 1e-12, "largest K_I")
    # The summary alone has the states at which the lip changes.
    check_below(abs(row["K_I_smallest"] - K["smallest"]) / K["largest"], 2e-2,
                "smallest K_I")
    growth = found.summary["crack_tip"]["da_dN"]
    check_below(abs(row["da_dN"] / growth - 1), 1e-12, "growth")
    # K that is largest at the end of each period.
    late = MESH + steps(20) + [
        "Material/Relaxation time=1800", traction("0; 10*cos(2*pi*t/600)"),
        "Material/Thermal expansion=1e-5",
        "Loads/Temperature=-30*(1 - cos(2*pi*t/600))*x^2"]
    found = compute("late", late + missions("5, 12", *words[-4:]))
    for n, largest in zip((5, 12), found.table("missions.csv")["K_I_largest"]):
        marched = compute("marched", late + method("march", "sdirk2", 0, n)
                          + words[-4:])
        K = marched.table("crack_tip.csv")["K_I"]
        check(K[-1] > max(K[-21:-1]) * (1 + 1e-6), "K is largest at the end")
        check_below(abs(largest / K[-1] - 1), 1e-6, f"mission {n}: largest K_I")
    space = box_scene("10*sin(2*pi*t/600) - 2") + steps(10) + [
        "Material/Relaxation time=700", "Crack tip/Stress intensity=true"]
    found = run(BODY, "space", COMMON + space + missions("3") + [
        traction("0; 10*exp(t/600); 0")])  # largest before the jump at the end
    front = found.table("crack_front.csv")
    within = max(K for t, K in zip(front["t"], front["K_I"]) if t < max(front["t"]))
    rows = found.table("missions.csv")
    check(1.02 < rows["K_I_largest"][0] / within < 1.2, "K_I before the jump")
    check_below(rows["K_I_largest"][0]
                / found.summary["crack_front"]["K_I"]["largest"]["value"] - 1, 1e-12,
                "K_I of a front")
    ended = run(BODY, "front", COMMON + space + method("averaged", "sdirk2", 1e-4) + [
        "Periodic state/Converged quantity=K_I"])
    check(ended.summary["converged"], "K_I of the front ends the search")


def test_fast_bodies():
    """A body whose stress is periodic after a few periods, and one without stress,
    reach their missions all the same, in ever longer leaps."""
    for name, body in (("fast", LOAD + ["Material/Relaxation time=60"]),
                       ("no load", [traction("0; 0")] + relaxation(3))):
        found = compute("found", MESH + steps(20) + body + missions("100000"))
        rows = found.table("missions.csv")
        check(rows["mission"] == [100000.], "the mission")
        check(rows["evaluations"][0] <= 40, f"{name}: {rows['evaluations'][0]}")


def test_quantities():
    """The search ends on what is asked; the error is that of the quantity."""
    settings = MESH + steps(20) + relaxation(1.5) + [
        traction("0; 10*sin(2*pi*t/600)"), "Crack tip/Stress intensity=true"]
    for way in ("march", "averaged"):
        # K_I of the integral knows strain without stress, by the error of the mesh.
        exact = compute("exact", settings + method(way, "sdirk2", 1e-9, 5000))
        plain = compute("plain", settings + method(way, "sdirk2", 1e-4))
        for quantity in ("K_I", "opening", "probe body"):
            found = compute("found", settings + method(way, "sdirk2", 1e-4) + [
                f"Periodic state/Converged quantity={quantity}"])
            table, column = {
                "K_I": ("crack_tip.csv", "K_I"),
                "opening": ("probe_mouth.csv", "opening"),
                "probe body": ("probe_body.csv", "s_22")}[quantity]
            mine, right = (period(r, table, column) for r in (found, exact))
            mean = [sum(values) / len(values) if quantity == "opening" else 0.
                    for values in (mine, right)]
            error = max(abs((a - mean[0]) - (b - mean[1]))
                        for a, b in zip(mine, right)) / max(map(abs, right))
            check_below(error, 3e-4, f"{way}, {quantity}: "
                        f"{found.summary['periods']} periods, error")
            check(found.summary["periods"] <= plain.summary["periods"] + 2,
                  f"{plain.summary['periods']} for the stress")


    for body, words in (("600", "in each period, so that its opening is not periodic"),
                        ("600*(1 + 0.1*sin(t/95))", "has no periodic opening")):
        refused = compute("refused", MESH + steps(20) + [
            traction("0; 10*sin(2*pi*t/600) + 3"), f"Material/Relaxation time={body}",
            "Periodic state/Converged quantity=opening"], status=3)
        check(words in log(refused), "no opening that the mean load increases")


def test_place():
    """A search that ends too early tells where, and prints no error beyond 1."""
    settings = MESH + steps(20) + LOAD + relaxation(8)
    stopped = compute("stopped", settings + method("march", "sdirk2", 1e-6, 4),
                      status=3)
    text = log(stopped)
    check("not known to be within" in text, "no number beyond 1")
    check("in material" in text and "whose relaxation time is" in text, "the place")


def test_refusals():
    for settings, reason in (
            (["Periodic state/Missions=100, 10"], "must increase"),
            (["Periodic state/Missions=10", "Periodic state/Method=march"], "averaged body"),
            (["Periodic state/Missions=10", "Periodic state/Secular split=on"],
             "motion from rest"),
            (["Periodic state/Missions=10", "Material/Viscosity=none"],
             "without viscosity"),
            (["Periodic state/Converged quantity=K"], "must be stress"),
            (["Periodic state/Converged quantity=probe nowhere"], "mouth"),
            (["Periodic state/Missions=10", "Material/Viscosity=power law",
              "Material/Creep exponent=3", "Material/Creep coefficient=1e-11"],
             "linear creep")):
        code, _, error = execute(BODY, "--output", "results/refused", *overrides(
            COMMON + MESH + LOAD + ["Periodic state/Method=automatic"] + settings))
        check(code == 2 and reason in error, f"{reason}: {code}, {error}")


@full
def test_ten_thousand():
    """The number of evaluations grows with the logarithm of that of periods."""
    for name, body in BODIES.items():
        found = compute("far", MESH + steps(20) + body + missions("1000000"))
        rows = found.table("missions.csv")
        check(rows["evaluations"][-1] <= 120,
              f"{name}: {rows['evaluations'][-1]:.0f} evaluations")


if __name__ == "__main__":
    test_missions()
    test_numbers()
    test_fast_bodies()
    test_quantities()
    test_place()
    test_refusals()
    test_ten_thousand()
