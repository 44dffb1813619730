"""A crack along a quarter of a circle in a large plate under equal tension in all
directions (Muskhelishvili; Cotterell and Rice, Int. J. Fracture 16, 1980), curved by
elements of second order, and as a polygon, whose facets the printed error sees."""

import math
import pathlib

from crevasse_run import check, check_below, run

GEOMETRY = """
R = 1; L = 20; al = 45*Pi/180;
Point(1) = {{-L,-L,0,4}}; Point(2) = {{L,-L,0,4}}; Point(3) = {{L,L,0,4}}; Point(4) = {{-L,L,0,4}};
Point(9) = {{0,-R,0,1}}; Point(5) = {{-R*Sin(al),-R+R*Cos(al),0,{h}}};
Point(6) = {{R*Sin(al),-R+R*Cos(al),0,{h}}};
Line(1) = {{1,2}}; Line(2) = {{2,3}}; Line(3) = {{3,4}}; Line(4) = {{4,1}};
Circle(5) = {{5,9,6}};
Curve Loop(1) = {{1,2,3,4}}; Plane Surface(1) = {{1}}; Curve{{5}} In Surface{{1}};
Physical Curve("left", 1) = {{4}}; Physical Curve("bottom", 2) = {{1}};
Physical Curve("right", 3) = {{2}}; Physical Curve("top", 4) = {{3}};
Physical Curve("arc", 5) = {{5}}; Physical Surface("plate", 11) = {{1}};
Mesh.RecombineAll = 1; Mesh.SubdivisionAlgorithm = 1;
Mesh.ElementOrder = {order};
"""

SCENE = """
subsection Geometry
  set Shape = mesh file
end
subsection Boundary
  set Symmetry = left, bottom
  set Loaded   = right, top
  set Crack    = arc
end
subsection Material
  set Plane state = plane strain
  set Viscosity   = none
end
subsection Loads
  set Traction = if(x > 19.999, 0.01, 0); if(y > 19.999, 0.01, 0)
end
subsection Discretisation
  set Degree = 2
end
subsection Crack tip
  set Stress intensity = true
end
subsection Refinement
  set Strategy = tip
  set Cycles   = 5
end
subsection Time integration
  set Steps per period = 1
end
subsection Output
  set Fields = none
end
"""

# K of the infinite plate; one of half the width 20 has some 0.1 % more.
SIZE = 0.01 * math.sqrt(math.pi * math.sin(math.pi / 4)) / (
    1 + math.sin(math.pi / 8)**2)
EXACT = {"K_I": SIZE * math.cos(math.pi / 8), "K_II": SIZE * math.sin(math.pi / 8)}


def compute(name, settings=(), h=0.1, order=2):
    mesh = f"arc_{order}_{h}.geo"
    pathlib.Path(mesh).write_text(GEOMETRY.format(h=h, order=order))
    results = run(SCENE, name, [f"Geometry/Mesh file={mesh}", *settings])
    tips = []
    for i in (1, 2):
        row = {key: column[-1] for key, column in
               results.table(f"crack_tip_{i}.csv").items()}
        left = results.summary["crack_tips"][i - 1]["position"][0] < 0
        row["K_II"] *= 1 if left else -1
        tips.append(row)
    return tips


def worst(one, other):
    return max(abs(a[k] - b[k]) for a, b in zip(one, other) for k in EXACT) / SIZE


def test_arc():
    tips = compute("arc")
    for tip in tips:
        for K, exact in EXACT.items():
            error = abs(tip[K] / exact - 1)
            print(f"{K} = {tip[K]:.6f}, exact {exact:.6f}, "
                  f"printed error {tip[K + '_error'] / exact:.2%}")
            check_below(error, 3e-3, K)
    for radius in (0.1, 0.2):
        others = compute("arc_radius", [f"Crack tip/Radius={radius}"])
        check_below(worst(tips, others), 3e-3, f"radius {radius}")
        for tip, other in zip(tips, others):
            check(all(abs(tip[K] - other[K]) < tip[K + "_error"] + other[K + "_error"]
                      for K in EXACT), f"radius {radius}: within the printed errors")


def test_small_cells():
    """Lips are found, and K and T stay, where cells at the tips are 1e-5 of the arc: nodes
    of both lips differ by more than rounding there, and so do forces of 1/r^2."""
    coarse, fine = (compute("small", [f"Refinement/Cycles={n}"]) for n in (5, 11))
    check_below(worst(coarse, fine), 1e-3, "K with cells 64 times as small")
    check_below(max(abs(a["T_stress"] - b["T_stress"]) for a, b in zip(coarse, fine)),
                1e-3, "T, of 0.01 far away")


def test_loads_on_lips():
    """A pressure in the crack is the tension far away; lips that are pressed in all
    directions have no K."""
    tips = compute("arc")
    inside = compute("inside", [
        "Boundary/Loaded=arc", "Loads/Traction=0; 0", "Loads/Pressure=0.01"])
    check_below(worst(tips, inside), 2e-4, "pressure on curved lips")
    pressed = compute("pressed", [
        "Loads/Traction=if(x > 19.999, -0.01, 0); if(y > 19.999, -0.01, 0)"])
    check_below(max(abs(tip[K]) for tip in pressed for K in EXACT) / SIZE, 2e-4,
                "pressed lips")


def test_polygon():
    """Both tips have the same K, though the mesh is not symmetric: it is refined at the
    kinks, too."""
    for h in (0.2, 0.1):
        tips = compute("polygon", h=h, order=1)
        check_below(worst(*([tip] for tip in tips)), 5e-3, f"h = {h}: K of both tips")
        for tip in tips:
            for K, exact in EXACT.items():
                error = abs(tip[K] - exact)
                print(f"h = {h}, {K}: true error {error / exact:.2%}, printed "
                      f"{tip[K + '_error'] / exact:.2%}")
                check(0.5 * error < tip[K + "_error"] < 10 * error,
                      f"h = {h}, {K}: the printed error")


if __name__ == "__main__":
    test_arc()
    test_small_cells()
    test_loads_on_lips()
    test_polygon()
