// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_model_state_transfer_h
#define crevasse_model_state_transfer_h

#include <crevasse/discretisation/cell_polynomials.h>
#include <crevasse/discretisation/cell_values.h>

#include <deal.II/base/array_view.h>
#include <deal.II/distributed/solution_transfer.h>

namespace Crevasse
{
  /** What says whether a field at quadrature points has come over well. */
  template <int dim>
  struct FieldNorms
  {
    double           l2 = 0.;  ///< the root of ∫ |field|²
    VoigtVector<dim> integral; ///< of the sum over all branches
  };

  /** Collective. */
  template <int dim>
  FieldNorms<dim>
  field_norms(const Space<dim>  &space,
              const Vector      &field,
              const unsigned int n_branches)
  {
    constexpr unsigned int    n = n_stress_components<dim>;
    std::array<double, n + 1> sums{}; // the integral, then the square
    for_each_point(space,
                   dealii::update_JxW_values,
                   [&](const dealii::FEValues<dim> &values,
                       const unsigned int           q,
                       const std::size_t            point) {
                     for (unsigned int branch = 0; branch < n_branches;
                          ++branch)
                       {
                         const VoigtVector<dim> value =
                           QuadratureField<dim>::get(
                             field, (point * n_branches + branch) * n);
                         for (unsigned int c = 0; c < n; ++c)
                           sums[c] += value[c] * values.JxW(q);
                         sums[n] += value.norm_square() * values.JxW(q);
                       }
                   });
    dealii::Utilities::MPI::sum(
      dealii::ArrayView<const double>(sums.data(), sums.size()),
      space.communicator(),
      dealii::ArrayView<double>(sums.data(), sums.size()));
    FieldNorms<dim> norms;
    for (unsigned int c = 0; c < n; ++c)
      norms.integral[c] = sums[c];
    norms.l2 = std::sqrt(sums[n]);
    return norms;
  }

  /**
   * Takes displacement and viscous strain over to the mesh that another one
   * becomes. The viscous strain goes as the polynomials of its cells: divided
   * cells have the same one, joined cells the nearest one to those of their
   * parts, which conserves the integral over each cell. The displacement, from
   * which the next solution only starts, is that of the nodes; coefficients of
   * singular functions start at 0.
   */
  template <int dim>
  class StateTransfer
  {
  public:
    /** @param mesh of the space, which may be flagged already.
     * @param displacement zero in constrained entries, as everywhere.
     * @param viscous_strain of @p n_branches branches. */
    StateTransfer(Mesh<dim>                  &mesh,
                  const Space<dim>           &space,
                  const QuadratureField<dim> &points,
                  const Vector               &displacement,
                  const Vector               &viscous_strain,
                  const unsigned int          n_branches)
      : mesh(mesh)
      , polynomials(mesh, space.finite_element.degree)
      , displacement_dofs(mesh)
      , branches(n_branches, polynomials.coefficients())
    {
      // Numbered as the dofs of the space.
      displacement_dofs.distribute_dofs(space.finite_element);
      nodal = make_vector(displacement_dofs);
      nodal.copy_locally_owned_data_from(space.nodal_values(displacement));
      nodal.update_ghost_values();
      for (unsigned int branch = 0; branch < n_branches; ++branch)
        polynomials.fit(
          space, points, viscous_strain, branches[branch], n_branches, branch);
    }

    /** Changes the mesh as its flags say. Whatever else depends on it must be
     * gone by then. Collective. */
    void
    adapt()
    {
      using Transfer =
        dealii::parallel::distributed::SolutionTransfer<dim, Vector>;
      Transfer                    of_displacement(displacement_dofs);
      Transfer                    of_strain(polynomials.dof_handler);
      std::vector<const Vector *> before;
      for (const Vector &branch : branches)
        before.push_back(&branch);
      mesh.prepare_coarsening_and_refinement();
      of_displacement.prepare_for_coarsening_and_refinement(nodal);
      of_strain.prepare_for_coarsening_and_refinement(before);
      mesh.execute_coarsening_and_refinement();

      displacement_dofs.distribute_dofs(*displacement_dofs.get_fe().clone());
      polynomials.distribute();
      nodal = make_vector(displacement_dofs);
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

    /** The fields on the new mesh, or on another one with the same cells on
     * each rank; the displacement is zero in constrained entries. Both must be
     * zero, with the layouts of their spaces. */
    void
    take(const Space<dim>           &space,
         const QuadratureField<dim> &points,
         Vector                     &displacement,
         Vector                     &viscous_strain) const
    {
      const unsigned int n = space.finite_element.n_dofs_per_cell();
      std::vector<dealii::types::global_dof_index> from(n), to(n);
      for (const auto &cell : owned_cells(space.dof_handler))
        {
          same_cell(cell->id(), displacement_dofs)->get_dof_indices(from);
          cell->get_dof_indices(to);
          for (unsigned int i = 0; i < n; ++i)
            if (displacement.in_local_range(to[i]))
              displacement(to[i]) = nodal(from[i]);
        }
      displacement.copy_locally_owned_data_from(
        space.from_nodal_values(displacement));
      for (unsigned int branch = 0; branch < branches.size(); ++branch)
        polynomials.evaluate(space,
                             points,
                             branches[branch],
                             viscous_strain,
                             branches.size(),
                             branch);
    }

  private:
    Mesh<dim>              &mesh;
    CellPolynomials<dim>    polynomials;
    dealii::DoFHandler<dim> displacement_dofs;
    Vector                  nodal;
    std::vector<Vector>     branches; ///< coefficients
  };
} // namespace Crevasse

#endif
