// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_tests_slit_square_h
#define crevasse_tests_slit_square_h

#include <crevasse/discretisation/space.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <memory>

/** The square |x|, |y| ≤ 1 with a crack from below to its centre, whose two
 * lips have the boundary id 1, turned by @p angle. */
inline std::shared_ptr<const Crevasse::Mesh<2>>
slit_square(const double angle, const unsigned int refinements)
{
  dealii::Triangulation<2> square;
  dealii::GridGenerator::hyper_cube_slit(square, -1., 1.);
  for (const auto &cell : square.active_cell_iterators())
    for (const auto &face : cell->face_iterators())
      if (face->at_boundary() && std::abs(face->center()[0]) < 1e-10)
        face->set_boundary_id(1);
  dealii::GridTools::rotate(angle, square);
  auto mesh = std::make_shared<Crevasse::Mesh<2>>(MPI_COMM_WORLD);
  mesh->copy_triangulation(square);
  mesh->refine_global(refinements);
  return mesh;
}

#endif
