// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

// Rigid motions that supports leave free are found and named.

#include <crevasse/discretisation/rigid_motions.h>

#include <crevasse_tests/tests.h>

using namespace Crevasse;

namespace
{
  using Supports = std::vector<FixedPoint<2>>;

  void
  show(const std::string                          &name,
       const std::shared_ptr<const Mesh<2>>       &mesh,
       const std::set<dealii::types::boundary_id> &symmetry,
       const Supports                             &supports)
  {
    BoundaryRoles roles;
    roles.symmetry = symmetry;
    const Space<2> space(mesh, 1, roles, supports);
    std::cout << name << ":" << std::endl;
    for (const std::string &motion : find_free_rigid_motions(space))
      std::cout << "  " << motion << std::endl;
  }

  std::shared_ptr<const Mesh<2>>
  two_squares()
  {
    dealii::Triangulation<2> left, right, both;
    dealii::GridGenerator::subdivided_hyper_cube(left, 2, 0., 1.);
    dealii::GridGenerator::subdivided_hyper_cube(right, 2, 3., 4.);
    dealii::GridGenerator::merge_triangulations(left, right, both);
    auto mesh = std::make_shared<Mesh<2>>(MPI_COMM_WORLD);
    mesh->copy_triangulation(both);
    return mesh;
  }

  /** A clamped square and another one that touches it in the vertex (1,1). */
  std::shared_ptr<const Mesh<2>>
  hinged_squares()
  {
    dealii::Triangulation<2> left, right, both;
    dealii::GridGenerator::subdivided_hyper_cube(left, 2, 0., 1.);
    dealii::GridGenerator::subdivided_hyper_cube(right, 2, 1., 2.);
    dealii::GridGenerator::merge_triangulations(left, right, both);
    auto mesh = std::make_shared<Mesh<2>>(MPI_COMM_WORLD);
    mesh->copy_triangulation(both);
    return mesh;
  }
} // namespace

int
main(int argc, char **argv)
{
  return run_test(argc, argv, []() {
    const auto          square = distorted_square_with_hanging_nodes(4, 0.);
    const FixedPoint<2> corner{dealii::Point<2>(0., 0.), {{true, true}}};
    const FixedPoint<2> slide{dealii::Point<2>(1., 0.), {{true, false}}};
    const FixedPoint<2> hold{dealii::Point<2>(1., 0.), {{false, true}}};

    show("nothing held", square, {}, {});
    show("bottom on rollers", square, {2}, {});
    show("two planes of symmetry", square, {0, 2}, {});
    show("one point", square, {}, {corner});
    // Along the line between the two points: nothing against rotation.
    show("a point and a slide along the line", square, {}, {corner, slide});
    show("statically determinate", square, {}, {corner, hold});
    show("two parts, one held", two_squares(), {}, {corner, hold});

    const auto          hinged = hinged_squares();
    const FixedPoint<2> far{dealii::Point<2>(2., 2.), {{true, false}}};
    const FixedPoint<2> far_away{dealii::Point<2>(2., 2.), {{true, true}}};
    show("a hinge, one square free", hinged, {}, {corner, hold});
    show("a hinge, statically determinate", hinged, {}, {corner, hold, far});
    show("three hinges in line", hinged, {}, {corner, far_away});
    show("a hinge, nothing held", hinged, {}, {});
  });
}
