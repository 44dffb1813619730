// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_tests_plate_on_plane_h
#define crevasse_tests_plate_on_plane_h

#include <crevasse/discretisation/stiffness.h>
#include <crevasse/material/voigt_matrix.h>

#include <deal.II/grid/grid_generator.h>

#include <crevasse_tests/contact_body.h>
#include <memory>
#include <vector>

/** A plate, in space a bar, five times as long as high, clamped at both ends,
 * its lower edge on a plane from which it may lift off, with the traction 10
 * cos 5πx on its top: parts of the lip are closed. */
template <int dim>
class PlateOnPlane : public ContactBody<dim>
{
public:
  /** @param n numbers of cells along the lip, a multiple of 5.
   * @param hanging_nodes whether cells at half of the lip are refined.
   * @param n_across cells across; 0: square ones. */
  PlateOnPlane(const MPI_Comm     communicator,
               const unsigned int n,
               const unsigned int degree,
               const bool         hanging_nodes = false,
               const unsigned int n_across      = 0)
    : ContactBody<dim>(
        mesh(communicator, n, hanging_nodes, n_across == 0 ? n / 5 : n_across),
        degree,
        roles(),
        {},
        Crevasse::VolumetricStrain::full,
        dim == 2 ? "0; 10*cos(5*pi*x)" : "0; (10 + 30*z)*cos(5*pi*x); 0")
  {
    const auto K = Crevasse::isotropic_stiffness<dim>(13000., 0.2, dim == 2);
    Crevasse::assemble_stiffness(
      this->space,
      this->points,
      Crevasse::PointValues<Crevasse::VoigtMatrix<dim>>(K),
      matrix);
  }

  Crevasse::SparseMatrix matrix;

private:
  static Crevasse::BoundaryRoles
  roles()
  {
    Crevasse::BoundaryRoles roles;
    roles.clamped = {0, 1};
    roles.contact = {2};
    roles.loaded  = {3};
    return roles;
  }

  static std::shared_ptr<const Crevasse::Mesh<dim>>
  mesh(const MPI_Comm     communicator,
       const unsigned int n,
       const bool         hanging_nodes,
       const unsigned int n_across)
  {
    auto mesh = std::make_shared<Crevasse::Mesh<dim>>(communicator);
    std::vector<unsigned int> subdivisions(dim, n_across);
    subdivisions[0] = n;
    dealii::Point<dim> corner;
    for (unsigned int d = 0; d < dim; ++d)
      corner[d] = d == 0 ? 1. : 0.2;
    dealii::GridGenerator::subdivided_hyper_rectangle(
      *mesh, subdivisions, {}, corner, true);
    for (const auto &cell : mesh->active_cell_iterators())
      if (hanging_nodes && cell->is_locally_owned() &&
          cell->center()[0] > 0.5 && cell->center()[1] < 0.1)
        cell->set_refine_flag();
    mesh->execute_coarsening_and_refinement();
    return mesh;
  }
};

#endif
