// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_tests_distorted_cube_h
#define crevasse_tests_distorted_cube_h

#include <crevasse/discretisation/space.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <memory>

/** The unit square (cube) with n cells a side and boundary ids 0, 1, ... on its
 * sides, its inner vertices moved at random (seeded), two corners refined for
 * hanging nodes; sheared so that cells are parallelograms, if not distorted. */
template <int dim>
std::shared_ptr<const Crevasse::Mesh<dim>>
distorted_cube_with_hanging_nodes(const unsigned int n,
                                  const double       distortion,
                                  const double       shear = 0.)
{
  auto mesh = std::make_shared<Crevasse::Mesh<dim>>(MPI_COMM_WORLD);
  dealii::GridGenerator::subdivided_hyper_cube(*mesh, n, 0., 1., true);
  if (distortion > 0.)
    dealii::GridTools::distort_random(distortion, *mesh, true, 42);
  if (shear != 0.)
    dealii::GridTools::transform(
      [&](dealii::Point<dim> x) {
        x[0] += shear * x[1];
        return x;
      },
      *mesh);
  for (const auto &cell : mesh->active_cell_iterators())
    if (cell->is_locally_owned())
      {
        double mean = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          mean += cell->center()[d] / dim;
        if (mean < 0.3 || mean > 0.8)
          cell->set_refine_flag();
      }
  mesh->execute_coarsening_and_refinement();
  return mesh;
}

#endif
