// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Rigid motions that supports leave free are found and named.

#include <crevasse/discretisation/rigid_motions.h>
#include <crevasse/grid/geometry.h>
#include <crevasse/parameters/built_in_boundary.h>

#include <crevasse_tests/distorted_cube.h>
#include <crevasse_tests/tests.h>

using namespace Crevasse;

namespace
{
  template <int dim>
  void
  show(const std::string                          &name,
       const std::shared_ptr<const Mesh<dim>>     &mesh,
       const std::set<dealii::types::boundary_id> &symmetry,
       const std::vector<FixedPoint<dim>>         &supports)
  {
    BoundaryRoles roles;
    roles.symmetry = symmetry;
    const Space<dim> space(mesh, 1, roles, supports);
    std::cout << name << ": " << find_free_rigid_motions(space).size()
              << " free" << std::endl;
    for (const std::string &motion : find_free_rigid_motions(space))
      std::cout << name << ": " << motion << std::endl;
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

  /** What the automatic supports of the built-in shapes leave free: nothing,
   * with as many components as there are motions. */
  void
  show_automatic(const Shape shape, const std::string &symmetry)
  {
    GeometryParameters geometry;
    geometry.shape        = shape;
    geometry.thickness    = 0.3;
    geometry.subdivisions = "4, 2, 1";
    BoundaryParameters boundary;
    boundary.symmetry = symmetry;
    const BoundaryRoles roles =
      resolve_roles(boundary, built_in_roles(geometry));
    const auto supports = built_in_fixed_points<3>(geometry, roles);
    auto       mesh     = std::make_shared<Mesh<3>>(MPI_COMM_WORLD);
    make_mesh(geometry, *mesh);

    std::size_t n_held = 0, n_free;
    for (const auto &support : supports)
      n_held +=
        std::count(support.components.begin(), support.components.end(), true);
    {
      const Space<3> space(mesh, 1, roles, {});
      n_free = find_free_rigid_motions(space).size();
    }
    const Space<3> space(mesh, 1, roles, supports);
    check(name_of(shape) + ", symmetry " + symmetry + ": " +
            std::to_string(n_held) + " components hold " +
            std::to_string(n_free) + " motions",
          n_held == n_free && find_free_rigid_motions(space).empty());
  }



  void
  three_dimensions()
  {
    const auto          cube = distorted_cube_with_hanging_nodes<3>(2, 0.);
    const FixedPoint<3> corner{dealii::Point<3>(0., 0., 0.),
                               {{true, true, true}}};
    const FixedPoint<3> second{dealii::Point<3>(1., 0., 0.),
                               {{false, true, true}}};
    const FixedPoint<3> third{dealii::Point<3>(0., 1., 0.),
                              {{false, false, true}}};
    show<3>("in space, nothing held", cube, {}, {});
    show<3>("in space, bottom on rollers", cube, {2}, {});
    show<3>("in space, two planes of symmetry", cube, {0, 2}, {});
    show<3>("in space, three planes of symmetry", cube, {0, 2, 4}, {});
    show<3>("in space, two points", cube, {}, {corner, second});
    show<3>("in space, determinate", cube, {}, {corner, second, third});

    for (const Shape shape :
         {Shape::edge_crack, Shape::centre_crack, Shape::box})
      for (const char *symmetry : {"automatic", "0, 2", "2, 5", "0, 2, 6"})
        show_automatic(shape, symmetry);
  }
} // namespace

void
rigid_motions()
{
  const auto          square = distorted_cube_with_hanging_nodes<2>(4, 0.);
  const FixedPoint<2> corner{dealii::Point<2>(0., 0.), {{true, true}}};
  const FixedPoint<2> slide{dealii::Point<2>(1., 0.), {{true, false}}};
  const FixedPoint<2> hold{dealii::Point<2>(1., 0.), {{false, true}}};

  show<2>("nothing held", square, {}, {});
  show<2>("bottom on rollers", square, {2}, {});
  show<2>("two planes of symmetry", square, {0, 2}, {});
  show<2>("one point", square, {}, {corner});
  // Along the line between the two points: nothing against rotation.
  show<2>("a point and a slide along the line", square, {}, {corner, slide});
  show<2>("statically determinate", square, {}, {corner, hold});
  show<2>("two parts, one held", two_squares(), {}, {corner, hold});

  const auto          hinged = hinged_squares();
  const FixedPoint<2> far{dealii::Point<2>(2., 2.), {{true, false}}};
  const FixedPoint<2> far_away{dealii::Point<2>(2., 2.), {{true, true}}};
  show<2>("a hinge, one square free", hinged, {}, {corner, hold});
  show<2>("a hinge, statically determinate", hinged, {}, {corner, hold, far});
  show<2>("three hinges in line", hinged, {}, {corner, far_away});
  show<2>("a hinge, nothing held", hinged, {}, {});
  three_dimensions();
}
