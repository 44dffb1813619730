"""What the scenes of tests/scenes compute, against independent values."""

import math
import pathlib

from crevasse_run import (SECONDS, SOURCE, check, check_below, check_close, full,
                          run)

SCENES = SOURCE / "tests/scenes"
PENNY = pathlib.Path("prm/penny_crack.prm")  # test_crack_front.py makes its mesh
BODY = pathlib.Path("prm/raous1980_body.prm")  # is not a scene by itself


def handbook_opening(a, width, stress, modulus):
    """Half the opening in the middle of a centre crack of half length a in a
    long strip of half width b (Tada, Paris and Irwin, within 0.6 %)."""
    x = a / width
    shape = (-0.071 - 0.535 * x + 0.169 * x**2 + 0.020 * x**3
             - 1.071 / x * math.log(1 - x))
    return 2 * stress * a / modulus * shape


def test_elastic_centre_crack():
    scene = SCENES / "elastic_centre_crack.prm"
    results = run(scene, "elastic_centre_crack")
    mouth = results.table("probe_mouth.csv")
    ahead = results.table("probe_ahead.csv")
    force = results.table("contact.csv")["force"]
    check(len(mouth["t"]) == 9, "eight steps")
    for k, t in enumerate(mouth["t"][:8]):
        load = 10 * math.sin(2 * math.pi * t)
        if load < -1:  # closed: as if there were no crack
            check_close(mouth["pressure"][k], -load, 1e-9, f"pressure, t = {t}")
            check_close(force[k], -load * 0.3, 1e-9, f"force, t = {t}")
            check_close(ahead["s_22"][k], load, 1e-9, f"stress, t = {t}")
            check_close(ahead["s_11"][k], 0, 1e-9, f"stress across, t = {t}")
        elif load > 1:
            check_close(mouth["pressure"][k], 0, 1e-9, "pressure when open")
            check_close(force[k], 0, 1e-9, "force when open")
            check(ahead["s_22"][k] > 1.5 * load, "stress concentration")
            check_close(mouth["opening"][k] / mouth["opening"][2], load / 10,
                        1e-10, f"opening in proportion to the load, t = {t}")

    # The handbook's strip is long; fine second-order elements.
    opening = run(scene, "long_strip", [
        "Geometry/Height=3", "Geometry/Subdivisions=10, 30",
        "Geometry/Refinements=2", "Discretisation/Degree=2",
        "Contact/Solver=condensed active set"]
        ).table("probe_mouth.csv")["opening"][2]
    expected = handbook_opening(0.3, 1, 10, 13000)
    check_close(opening / expected, 1, 0.01, "opening against the handbook")


def test_closing_gap():
    results = run(SCENES / "closing_gap.prm", "closing_gap")
    corner = results.table("probe_corner.csv")
    contact = results.table("contact.csv")
    largest = max(corner["opening"])
    check_close(corner["opening"][0] - corner["u_2"][0], 1e-4, 1e-16,
                "the gap at the corner")
    check(largest > 1e-4, "the corner opens further")
    check(min(contact["closed_nodes"]) == 0 < max(contact["closed_nodes"]) < 17,
          "the lip closes in part")
    for opening, pressure in zip(corner["opening"], corner["pressure"]):
        check(opening >= -1e-12 * largest, "penetration")
        check(abs(pressure) < 1e-9 or opening <= 1e-10 * largest,
              "pressure on an open lip")
    check(max(corner["pressure"]) > 1, "the corner is pressed")
    check(all((n == 0) == (abs(force) < 1e-9) for n, force in
              zip(contact["closed_nodes"], contact["force"])),
          "forces where the lip is closed")


def tables_of(scene, solver, names):
    name = f"{scene.stem}_{solver}".replace(" ", "_")
    results = run(scene, name, [f"Contact/Solver={solver}",
                                "Contact/Tolerance=1e-14",
                                "Output/Fields=none"])
    name = results.summary["contact_solver"]["name"]
    check(name == solver or solver == "automatic" and "SOR" not in name,
          f"{name} instead of {solver}")
    return [results.table(table) for table in names]


def test_solvers_agree():
    """The default solver, a condensed active set, and the paper's SOR."""
    for scene, names in (
            (SOURCE / "prm/raous1980_asymptotic.prm",
             ["probe_C.csv", "contact.csv"]),
            (SCENES / "closing_gap.prm",
             ["probe_corner.csv", "probe_top.csv", "contact.csv"])):
        for name, one, other in zip(
                names, tables_of(scene, "automatic", names),
                tables_of(scene, "projected sor", names)):
            check(one.keys() == other.keys(), f"{name}: columns")
            for column in one:
                # Components of a vector or tensor share one size.
                size = max(abs(x) for other_column in one
                           if other_column[:2] == column[:2]
                           for x in one[other_column])
                difference = max(abs(a - b) for a, b in
                                 zip(one[column], other[column]))
                check_below(difference / size, 1e-8,
                            f"{scene.stem}, {name}, {column}")


@full
def test_shipped_scenes():
    """Each ends with status 0."""
    scenes = {path.relative_to(SOURCE): path
              for path in sorted(SOURCE.glob("prm/**/*.prm"))}
    del scenes[BODY]
    del scenes[PENNY]
    for name, path in scenes.items():
        before = SECONDS[0]
        results = run(path, f"shipped_{path.stem}")
        print(f"{name}: {results.summary['periods']} periods, "
              f"{SECONDS[0] - before:.1f} s")


test_elastic_centre_crack()
test_closing_gap()
test_solvers_agree()
test_shipped_scenes()
