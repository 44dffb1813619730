"""Makes ring_1.msh and ring_2.msh by Gmsh (Debian: python3-gmsh): the upper half
of a ring from radius 1 to 2, of quadrilaterals in no order. Its ends on y = 0
are a plane of symmetry (id 1, left) and a crack lip (id 2, right); the outer arc
has the id 3, the inner one 4. Arcs have edges of equal length.

    /usr/bin/python3 make_ring.py"""

import pathlib

import gmsh

HERE = pathlib.Path(__file__).resolve().parent


def make(level):
    """All edges are halved once more by the recombination."""
    n_outer, n_inner, n_ends = 12 * level, 8 * level, 2 * level
    gmsh.clear()
    geo = gmsh.model.geo
    centre = geo.addPoint(0, 0, 0)
    right, far_right, far_top, far_left, left, top = (
        geo.addPoint(x, y, 0)
        for x, y in ((1, 0), (2, 0), (0, 2), (-2, 0), (-1, 0), (0, 1)))
    lip, ligament = geo.addLine(right, far_right), geo.addLine(far_left, left)
    outer = [geo.addCircleArc(far_right, centre, far_top),
             geo.addCircleArc(far_top, centre, far_left)]
    inner = [geo.addCircleArc(left, centre, top),
             geo.addCircleArc(top, centre, right)]
    body = geo.addPlaneSurface([geo.addCurveLoop([lip, *outer, ligament,
                                                  *inner])])
    geo.synchronize()
    for number, curves, n in ((1, [ligament], n_ends), (2, [lip], n_ends),
                              (3, outer, n_outer), (4, inner, n_inner)):
        gmsh.model.addPhysicalGroup(1, curves, number)
        for curve in curves:
            gmsh.model.mesh.setTransfiniteCurve(curve, n // len(curves) + 1)
    gmsh.model.addPhysicalGroup(2, [body], 10)
    gmsh.model.mesh.generate(2)
    gmsh.write(str(HERE / f"ring_{level}.msh"))


gmsh.initialize()
for name, value in (("General.Verbosity", 2), ("Mesh.Algorithm", 6),
                    ("Mesh.RecombineAll", 1), ("Mesh.SubdivisionAlgorithm", 1),
                    ("Mesh.MshFileVersion", 2.2), ("General.NumThreads", 1)):
    gmsh.option.setNumber(name, value)
for refinement in (1, 2):
    make(refinement)
gmsh.finalize()
