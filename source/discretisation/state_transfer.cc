// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/cell_values.h>
#include <crevasse/discretisation/state_transfer.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/mpi.h>
#include <deal.II/distributed/solution_transfer.h>
#include <deal.II/dofs/dof_tools.h>

#include <array>
#include <cmath>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  FieldNorms<dim>
  field_norms(const Space<dim>           &space,
              const QuadratureField<dim> &points,
              const Vector               &field,
              const unsigned int          n_branches)
  {
    constexpr unsigned int    n = n_stress_components<dim>;
    std::array<double, n + 1> sums{}; // the integral, then the square
    CellValues<dim>           cell_values(space, update_JxW_values);
    for (const auto &cell : space.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const FEValues<dim> &values = cell_values.reinit(cell);
          std::size_t          place  = n_branches * points.offset(cell);
          for (const unsigned int q : values.quadrature_point_indices())
            for (unsigned int branch = 0; branch < n_branches; ++branch)
              {
                const VoigtVector<dim> value =
                  QuadratureField<dim>::get(field, place);
                for (unsigned int c = 0; c < n; ++c)
                  sums[c] += value[c] * values.JxW(q);
                sums[n] += value.norm_square() * values.JxW(q);
                place += n;
              }
        }
    Utilities::MPI::sum(ArrayView<const double>(sums.data(), sums.size()),
                        space.communicator(),
                        ArrayView<double>(sums.data(), sums.size()));
    FieldNorms<dim> norms;
    for (unsigned int c = 0; c < n; ++c)
      norms.integral[c] = sums[c];
    norms.l2 = std::sqrt(sums[n]);
    return norms;
  }



  template <int dim>
  StateTransfer<dim>::StateTransfer(Mesh<dim>                  &mesh,
                                    const Space<dim>           &space,
                                    const QuadratureField<dim> &points,
                                    const Vector               &displacement,
                                    const Vector               &viscous_strain,
                                    const unsigned int          n_branches)
    : mesh(mesh)
    , polynomials(mesh, space.finite_element().degree)
    , displacement_dofs(mesh)
    , branches(n_branches, polynomials.coefficients())
  {
    // Numbered as the dofs of the space.
    displacement_dofs.distribute_dofs(space.finite_element());
    nodal = displacement_vector();
    nodal.copy_locally_owned_data_from(space.nodal_values(displacement));
    nodal.update_ghost_values();
    for (unsigned int branch = 0; branch < n_branches; ++branch)
      polynomials.fit(
        space, points, viscous_strain, branches[branch], n_branches, branch);
  }



  template <int dim>
  Vector
  StateTransfer<dim>::displacement_vector() const
  {
    IndexSet relevant;
    DoFTools::extract_locally_relevant_dofs(displacement_dofs, relevant);
    return Vector(displacement_dofs.locally_owned_dofs(),
                  relevant,
                  mesh.get_communicator());
  }



  template <int dim>
  void
  StateTransfer<dim>::adapt()
  {
    using Transfer = parallel::distributed::SolutionTransfer<dim, Vector>;
    Transfer                    of_displacement(displacement_dofs);
    Transfer                    of_strain(polynomials.dof_handler());
    std::vector<const Vector *> before;
    for (const Vector &branch : branches)
      before.push_back(&branch);
    mesh.prepare_coarsening_and_refinement();
    of_displacement.prepare_for_coarsening_and_refinement(nodal);
    of_strain.prepare_for_coarsening_and_refinement(before);
    mesh.execute_coarsening_and_refinement();

    displacement_dofs.distribute_dofs(*displacement_dofs.get_fe().clone());
    polynomials.distribute();
    nodal = displacement_vector();
    of_displacement.interpolate(nodal);
    nodal.update_ghost_values();
    std::vector<Vector *> after;
    for (Vector &branch : branches)
      {
        branch = polynomials.coefficients();
        after.push_back(&branch);
      }
    of_strain.interpolate(after);
    for (Vector &branch : branches)
      branch.update_ghost_values();
  }



  template <int dim>
  void
  StateTransfer<dim>::take(const Space<dim>           &space,
                           const QuadratureField<dim> &points,
                           Vector                     &displacement,
                           Vector                     &viscous_strain) const
  {
    const unsigned int n = space.finite_element().n_dofs_per_cell();
    std::vector<types::global_dof_index> from(n), to(n);
    for (const auto &cell : space.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          same_cell(cell->id(), displacement_dofs)->get_dof_indices(from);
          cell->get_dof_indices(to);
          for (unsigned int i = 0; i < n; ++i)
            if (displacement.in_local_range(to[i]))
              displacement(to[i]) = nodal(from[i]);
        }
    space.constraints().set_zero(displacement);
    for (unsigned int branch = 0; branch < branches.size(); ++branch)
      polynomials.evaluate(space,
                           points,
                           branches[branch],
                           viscous_strain,
                           branches.size(),
                           branch);
  }



#define INSTANTIATE(dim)                                                  \
  template FieldNorms<dim> field_norms<dim>(const Space<dim> &,           \
                                            const QuadratureField<dim> &, \
                                            const Vector &,               \
                                            const unsigned int);          \
  template class StateTransfer<dim>

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
