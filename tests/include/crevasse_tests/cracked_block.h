// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_tests_cracked_block_h
#define crevasse_tests_cracked_block_h

#include <crevasse/discretisation/point_values.h>
#include <crevasse/material/voigt_matrix.h>

#include <deal.II/grid/grid_generator.h>

#include <algorithm>
#include <cmath>
#include <crevasse_tests/contact_body.h>
#include <memory>
#include <vector>

/** Which cracked block, how fine, of what. */
struct BlockKind
{
  unsigned int degree = 1;
  unsigned int n_uniform;  ///< refinements of the whole
  unsigned int n_tip = 0;  ///< further ones, of the cells at the tip
  double       jump  = 1.; ///< of the moduli, in cubes of 1/4
  Crevasse::VolumetricStrain volumetric_strain =
    Crevasse::VolumetricStrain::full;
};

/** Half of a cracked unit cube (or square): its lower face is a lip for x < 1/2
 * and a plane of symmetry beyond, so that the tip is the line x = 1/2. The
 * usual traction, on the top, closes a part of the lip. */
template <int dim>
class CrackedBlock : public ContactBody<dim>
{
public:
  CrackedBlock(const MPI_Comm communicator, const BlockKind &kind)
    : ContactBody<dim>(mesh(communicator, kind),
                       kind.degree,
                       roles(),
                       {fixed_point()},
                       kind.volumetric_strain,
                       dim == 2 ? "0; 40*x - 10" : "0; (40*x - 10)*(1 + z); 0")
    , stiffness(moduli(kind.jump))
  {
  }

  const Crevasse::PointValues<Crevasse::VoigtMatrix<dim>> stiffness;

private:
  static constexpr dealii::types::boundary_id behind_tip = 7;

  /** Against moving along the lip. */
  static Crevasse::FixedPoint<dim>
  fixed_point()
  {
    Crevasse::FixedPoint<dim> corner;
    corner.point         = dealii::Point<dim>();
    corner.point[0]      = 1.;
    corner.components    = {};
    corner.components[0] = true;
    return corner;
  }

  static Crevasse::BoundaryRoles
  roles()
  {
    Crevasse::BoundaryRoles roles;
    roles.symmetry = {behind_tip};
    if (dim == 3)
      roles.symmetry.insert(4);
    roles.contact = {2};
    roles.loaded  = {3};
    return roles;
  }

  static std::shared_ptr<const Crevasse::Mesh<dim>>
  mesh(const MPI_Comm communicator, const BlockKind &kind)
  {
    auto mesh = std::make_shared<Crevasse::Mesh<dim>>(communicator);
    dealii::GridGenerator::subdivided_hyper_cube(*mesh, 2, 0., 1., true);
    for (const auto &cell : mesh->active_cell_iterators())
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary() && face->boundary_id() == 2 &&
            face->center()[0] > 0.5)
          face->set_boundary_id(behind_tip);
    mesh->refine_global(kind.n_uniform);
    for (unsigned int n = 0; n < kind.n_tip; ++n)
      {
        for (const auto &cell : mesh->active_cell_iterators())
          if (cell->is_locally_owned())
            for (const unsigned int v : cell->vertex_indices())
              if (std::hypot(cell->vertex(v)[0] - 0.5, cell->vertex(v)[1]) <
                  1e-10)
                cell->set_refine_flag();
        mesh->execute_coarsening_and_refinement();
      }
    return mesh;
  }

  Crevasse::PointValues<Crevasse::VoigtMatrix<dim>>
  moduli(const double jump) const
  {
    using Matrix = Crevasse::VoigtMatrix<dim>;
    const Matrix soft =
      Crevasse::isotropic_stiffness<dim>(13000., 0.2, dim == 2);
    if (jump == 1.)
      return Crevasse::PointValues<Matrix>(soft);
    std::vector<std::uint32_t> which(this->points.n_local_points);
    for (const auto &cell : this->space.mesh().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          int sum = 0;
          for (unsigned int d = 0; d < dim; ++d)
            sum += static_cast<int>(4. * cell->center()[d]);
          const auto begin =
            which.begin() +
            this->points.offset(cell) / Crevasse::n_stress_components<dim>;
          std::fill(begin,
                    begin + this->space.quadrature(cell).size(),
                    sum % 2);
        }
    return Crevasse::PointValues<Matrix>({soft, jump * soft}, std::move(which));
  }
};

#endif
