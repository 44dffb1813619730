"""K_I along crack fronts in space: a penny-shaped crack against its closed form, a
slice against the plane, creep and closed lips by what must not change, two fronts,
ranks, hanging nodes, and what is refused."""

import math
import pathlib
import re

from crevasse_run import (check, check_below, check_close, execute, full, overrides,
                          plain, run, run_on, tier)
from fronts import ONE_STEP, PENNY, front, penny_mesh

PLATE = """\
set Dimension = 3
subsection Geometry
  set Shape        = edge crack
  set Thickness    = 0.5
  set Subdivisions = 8, 4, 3
end
subsection Boundary
  set Symmetry = 2, 5, 6
end
subsection Material
  set Young modulus = 13000
  set Poisson ratio = 0.3
  set Viscosity     = none
end
subsection Loads
  set Period   = 600
  set Traction = 0; 10; 0
end
""" + ONE_STEP
PLANE = PLATE.replace("Dimension = 3", "Dimension = 2").replace(
    "8, 4, 3", "8, 4").replace("0; 10; 0", "0; 10").replace(
    "2, 5, 6", "automatic").replace(
    "set Viscosity ", "set Plane state   = plane strain\n  set Viscosity ")

SIGMA, RADIUS, E, NU = 1e6, 2., 2e11, 0.3


def test_penny():
    """Code_Aster's SSLV134: G = 11.58648 N/m at every point."""
    mesh = penny_mesh("penny.msh")
    results = run(PENNY, "penny", [mesh])
    rows = front(results)
    exact = 11.58648
    check_close((2 * SIGMA * math.sqrt(RADIUS / math.pi))**2 * (1 - NU**2) / E,
                exact, 1e-5, "the closed form is the published number")
    G = [row["energy_release_rate"] for row in rows]
    print("G:", G, "errors of K_I:", [row["K_I_error"] / row["K_I"] for row in rows])
    check(len(rows) == 9, "vertices on the front")
    check_close(rows[-1]["s"], math.pi / 2 * RADIUS, 1e-6, "length of the front")
    for row in rows:
        check_close(math.hypot(row["x"], row["y"]), RADIUS, 1e-9, "on the circle")
        check_close(row["energy_release_rate"] / exact, 1, 0.01, "G at a vertex")
    check_close(sum(G) / len(G) / exact, 1, 0.003, "mean of G")
    largest = results.summary["crack_front"]["K_I"]["largest"]
    check(largest["value"] == max(row["K_I"] for row in rows), "largest K_I")

    # A uniform pressure closes the lip, and is borne without any K_I.
    pressed = run(PENNY, "pressed", [mesh, "Loads/Traction=0; 0; -1e6"])
    check(all(row["K_I"] == 0. for row in front(pressed)), "a closed front has no K_I")

    both = run_on(2, PENNY, "penny_on_two_ranks", [mesh])
    check_below(max(abs(a["K_I"] / b["K_I"] - 1)
                    for a, b in zip(front(both), rows, strict=True)), 1e-9,
                "two ranks")


def test_ellipse():
    """Irwin's ellipse of 2 : 1 (J. Appl. Mech. 29, 1962), with 24 cells around it: without
    angles between their edges, which leave 1.8 %. E(k) by the mean of its integrand, which
    is exact for periodic functions."""
    for cells in tier((6,), (6, 12)):
        compare_with_ellipse(cells)


def compare_with_ellipse(cells):
    b, a = RADIUS, 2 * RADIUS
    mesh = penny_mesh("ellipse.msh", str(cells), "0.05")
    lines = pathlib.Path("ellipse.msh").read_text().split("\n")
    for i in range(lines.index("$Nodes") + 2, lines.index("$EndNodes")):
        number, x, *rest = lines[i].split()
        lines[i] = " ".join([number, repr(2 * float(x)), *rest])
    pathlib.Path("ellipse.msh").write_text("\n".join(lines))

    E_of_k = math.pi / 2 * sum(math.sqrt(math.sin(angle)**2 + (b / a)**2 * math.cos(
        angle)**2) for angle in (math.pi * i / 64 for i in range(64))) / 64
    for row in front(run(PENNY, "ellipse", [mesh])):
        angle = math.atan2(row["y"] / b, row["x"] / a)
        exact = SIGMA * math.sqrt(math.pi * b) / E_of_k * (
            math.sin(angle)**2 + (b / a)**2 * math.cos(angle)**2)**0.25
        check_close(row["K_I"] / exact, 1, 3.5e-3, f"ellipse, {math.degrees(angle):.1f} "
                    f"degrees, printed {row['K_I_error'] / exact:.1e}")


def beside_its_image(path, other, width):
    """The mesh of a block and that beside it, moved by the width along x."""
    lines = open(path).read().split("\n")
    begin, end = lines.index("$Nodes") + 2, lines.index("$EndNodes")
    n = end - begin
    points = [tuple(map(float, line.split()[1:])) for line in lines[begin:end]]
    at_side = {(y, z): i + 1 for i, (x, y, z) in enumerate(points) if x == width / 2}
    numbers = [at_side[y, z] if x == -width / 2 else i + 1 + n
               for i, (x, y, z) in enumerate(points)]
    elements = [list(map(int, line.split()[1:])) for line in
                lines[lines.index("$Elements") + 2:lines.index("$EndElements")]]

    def is_shared(element, side):
        return element[0] == 16 and all(
            points[node - 1][0] == side for node in element[4:])
    body = [e for e in elements if not is_shared(e, width / 2)]
    body += [e[:4] + [numbers[node - 1] for node in e[4:]] for e in elements
             if not is_shared(e, -width / 2)]
    with open(other, "w") as file:
        print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n", 2 * n, file=file)
        for i, (x, y, z) in enumerate(points):
            print(f"{i + 1} {x!r} {y!r} {z!r}\n{i + 1 + n} {x + width!r} {y!r} {z!r}",
                  file=file)
        print("$EndNodes\n$Elements\n", len(body), file=file)
        for i, element in enumerate(body):
            print(i + 1, *element, file=file)
        print("$EndElements", file=file)


@full
def test_two_pennies():
    """Two half discs in one block have K_I of one, mirrored; a whole disc, whose
    front is closed, has that of its quarter."""
    penny_mesh("half.msh", "4", "0.1", "x")
    beside_its_image("half.msh", "two.msh", 40.)
    rows = front(run(PENNY, "two", [
        "Geometry/Mesh file=two.msh", "Boundary/Symmetry=1, 5",
        "Boundary/Fixed points=20, 0, 0: 1"]))
    one, two = ([row for row in rows if row["front"] == k] for k in (1, 2))
    check(len(one) == len(two) == 9, "two fronts")
    closed_form = 2 * SIGMA * math.sqrt(RADIUS / math.pi)
    for a, b in zip(one, reversed(two), strict=True):
        check_close(a["x"] + b["x"], 40, 1e-9, "mirrored")
        check_below(abs(a["K_I"] / b["K_I"] - 1), 1e-9, "K_I of both fronts")
        check_close(a["K_I"] / closed_form, 1, 0.02, "closed form")

    quarter = front(run(PENNY, "quarter", [penny_mesh("quarter.msh", "4", "0.1")]))
    whole = front(run(PENNY, "whole", [
        penny_mesh("whole.msh", "4", "0.1", "xy"), "Boundary/Symmetry=1",
        "Boundary/Fixed points=20, 0, 0: 1, 2; -20, 0, 0: 2"]))
    check(len(whole) == 16, f"{len(whole)} vertices of a closed front")
    expected = {round(row["x"], 6): row["K_I"] for row in quarter}
    for row in whole:
        check_below(abs(row["K_I"] / expected[round(abs(row["x"]), 6)] - 1), 1e-9,
                    "K_I of a closed front")


@full
def test_two_middles():
    """Where the front meets a plane of symmetry a cell has a node of its own in the
    middle of an edge: at the same place it makes no difference."""
    mesh = penny_mesh("shared.msh", "4", "0.1")
    expected = [row["K_I"] for row in front(run(PENNY, "shared", [mesh]))]
    lines = open("shared.msh").read().split("\n")
    begin, end = lines.index("$Nodes") + 2, lines.index("$EndNodes")
    point = {int(n): tuple(map(float, x)) for n, *x in map(str.split, lines[begin:end])}
    # Gmsh's edges of a hexahedron.
    edges = ((0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5),
             (4, 7), (5, 6), (6, 7))

    def is_at_end(a, b):
        on_front = [math.isclose(math.hypot(*point[n][:2]), RADIUS) and point[n][2] == 0
                    for n in (a, b)]
        return all(on_front) and 0. in (point[a][1], point[b][1])
    i, k = next((i, k) for i, line in enumerate(lines) if line.split()[1:2] == ["17"]
                for k, (a, b) in enumerate(edges)
                if is_at_end(*(int(line.split()[5 + v]) for v in (a, b))))
    words = lines[i].split()
    place = point[int(words[13 + k])]
    words[13 + k] = str(max(point) + 1)
    lines[i] = " ".join(words)
    lines[begin - 1] = str(len(point) + 1)
    for name, shift in (("own", 0), ("other", 0.01)):
        x, y, z = place
        with open(f"{name}.msh", "w") as file:
            file.write("\n".join([*lines[:end], f"{words[13 + k]} {x!r} {y + shift!r} {z!r}",
                                  *lines[end:]]))
    rows = front(run(PENNY, "own", ["Geometry/Mesh file=own.msh"]))
    for row, K in zip(rows, expected, strict=True):
        check_below(abs(row["K_I"] / K - 1), 1e-9, "K_I with a node of its own")
    with open("refused.prm", "w") as file:
        file.write(plain(PENNY.read_text()))
    status, _, error = execute("refused.prm", "--output", "results/refused",
                               *overrides(["Geometry/Mesh file=other.msh"]))
    check(status == 2 and "another element has a different node, at (" in error, error)


def test_slice():
    """Between rigid planes a straight front is in plane strain."""
    for name, more, error, spread in (
            ("equal", [], 2e-3, 1e-9),
            # Hats bend within the larger cells further away.
            ("graded", ["Refinement/Strategy=tip", "Refinement/Cycles=2"], 1e-3,
             2e-5)):
        plane = run(PLANE, f"plane_{name}", more)
        expected = plane.table("crack_tip.csv")["K_I"][-1]
        rows = front(run(PLATE, f"slice_{name}", more))
        K = [row["K_I"] for row in rows]
        print(name, K, "plane:", expected, "error:", rows[0]["K_I_error"])
        for value in K:
            check_close(value / expected, 1, error, f"{name}: K_I of the slice")
        check_below((max(K) - min(K)) / expected, spread, f"{name}: the same along s")


def test_body_force():
    """Of a slice, around the front: as in the plane."""
    force = "300*y*exp(-20*((x-0.5)^2 + y^2))"
    plane = run(PLANE, "force_plane", [f"Loads/Body force=0; {force}",
                                       "Loads/Traction=0; 0", "Crack tip/Radius=0.5"])
    expected = plane.table("crack_tip.csv")["K_I"][-1]
    for row in front(run(PLATE, "force", [f"Loads/Body force=0; {force}; 0",
                                          "Loads/Traction=0; 0; 0", "Crack tip/Radius=0.5"])):
        check_close(row["K_I"] / expected, 1, 5e-3, "K_I of a body force")


def test_free_strain():
    """A temperature that is linear ahead of the front bends the free plate without
    any stress."""
    free = run(PLATE, "linear_temperature", [
        "Boundary/Symmetry=2", "Loads/Traction=0; 0; 0", "Loads/Temperature=100*x",
        "Material/Thermal expansion=1e-5"])
    heated = ["Loads/Temperature=2000*sin(6*x)", "Material/Thermal expansion=1e-5",
              "Crack tip/Radius=0.25"]
    held = run(PLATE, "held", heated)
    plane = run(PLANE, "held_plane", heated).table("crack_tip.csv")["K_I"][-1]
    cold = run(PLANE, "cold_plane").table("crack_tip.csv")["K_I"][-1]
    check(abs(plane / cold - 1) > 0.05, f"the temperature matters: {plane}, {cold}")
    size = 13000 * 1e-5 * 100
    check_below(max(abs(row["K_I"]) for row in front(free)) / size, 1e-3,
                "K_I without stress")
    print("held between planes:", front(held)[0]["K_I"], "in the plane:", plane)
    check_below(max(abs(row["K_I"] / plane - 1) for row in front(held)), 5e-3,
                "thermal K_I of a slice")


def test_creep():
    """With viscosity proportional to stiffness the stress of a constant load is the
    elastic one."""
    elastic = front(run(PLATE, "elastic"))
    creeping = front(run(PLATE, "creeping", [
        "Material/Viscosity=relaxation time", "Material/Relaxation time=300",
        "Time integration/Steps per period=8", "Periodic state/Tolerance=0"]))
    for a, b in zip(elastic, creeping, strict=True):
        check_close(b["K_I"] / a["K_I"], 1, 1e-9, "K_I with creep")
        check(a["s"] == b["s"], "arc length")


def test_refusals():
    for name, settings, message in (
            ("fit", ["Crack tip/Method=williams fit"], "williams fit is for"),
            ("law", ["Crack tip/Crack growth law=paris", "Crack tip/Paris factor=1"],
             "Crack growth law = paris: is for Dimension = 2"),
            ("radius", ["Crack tip/Radius=2"], r"Radius = 2: must be at most 0\.5"),
            ("stiffness", ["Material/Young modulus=13000*(1 + x)"],
             "the stiffness must be the same"),
            ("instants", ["Material/Young modulus=13000*(1 + x*sin(2*pi*t/600)/9)"],
             "the stiffness may depend on time only by"),
            ("anisotropy", ["Material/Stiffness matrix=9, 2, 2, 0, 0, 0; 2, 9, 2, 0, 0, 0; "
                            "2, 2, 9, 0, 0, 0; 0, 0, 0, 3, 0, 0; 0, 0, 0, 0, 3, 0; "
                            "0, 0, 0, 0, 0, 3"], "at the crack front is not isotropic"),
            ("coarse mesh", ["Geometry/Subdivisions=8, 1, 3"],
             r"reach 1 from it, but another boundary, .* limits the tube to 0\.5"),
            ("loaded end", ["Boundary/Symmetry=2, 5", "Boundary/Loaded=3, 6"],
             "the crack front touches a boundary that is loaded"),
            ("creep", ["Material/Viscosity=isotropic", "Material/Viscous modulus=1e6",
                       "Material/Viscous Poisson ratio=0.45"],
             "viscosity is proportional to stiffness"),
            ("thermal", ["Material/Viscosity=relaxation time",
                         "Material/Thermal expansion=1e-5", "Loads/Temperature=x"],
             "body with viscosity and"),
            ("force", ["Loads/Traction=1; 10; 0"], "on the crack front has to bear"),
            ("no crack", ["Geometry/Shape=box", "Boundary/Symmetry=2"],
             "the mesh has no crack front")):
        with open("refused.prm", "w") as file:
            file.write(plain(PLATE))
        status, _, error = execute("refused.prm", "--output", "results/refused",
                                   *overrides(settings))
        check(status == 2, f"{name}: status {status}\n{error}")
        check(re.search(message, " ".join(error.split())),
              f"{name}: {error}")


test_slice()
test_body_force()
test_penny()
test_ellipse()
test_two_middles()
test_two_pennies()
test_free_strain()
test_creep()
test_refusals()
