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
  /** Norms of a field at quadrature points, to check its transfer. */
  template <int dim>
  struct FieldNorms
  {
    double           l2 = 0.;  ///< L² norm: root of ∫ |field|²
    VoigtVector<dim> integral; ///< integral of the branches' sum
  };

  /** Computes the norms of a field. Collective. */
  template <int dim>
  FieldNorms<dim>
  field_norms(const Space<dim>  &space,
              const Vector      &field,
              const unsigned int n_branches)
  {
    constexpr unsigned int    n = n_stress_components<dim>;
    std::array<double, n + 1> sums{}; // integrals, then square
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
   * Transfers displacement and viscous strain to an adapted mesh. The viscous
   * strain is a polynomial in each cell: children have the polynomial of their
   * parent, joined cells the nearest one to those of their parts, which
   * conserves the integral over each cell. The displacement, only an initial
   * guess for the next solution, is interpolated at nodes; coefficients of
   * singular functions start at 0.
   */
  template <int dim>
  class StateTransfer
  {
  public:
    /** @param mesh of the space; it may be flagged already.
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
      // Degrees of freedom are numbered as in the space.
      displacement_dofs.distribute_dofs(space.finite_element);
      nodal = make_vector(displacement_dofs);
      nodal.copy_locally_owned_data_from(space.nodal_values(displacement));
      nodal.update_ghost_values();
      for (unsigned int branch = 0; branch < n_branches; ++branch)
        polynomials.fit(
          space, points, viscous_strain, branches[branch], n_branches, branch);
    }

    /** Changes the mesh as flagged. All other objects that depend on the mesh
     * must be destroyed before. Collective. */
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

    /** Sets the fields on the new mesh, or on another mesh with the same cells
     * on each rank; displacement is zero in constrained entries. Both fields
     * must be zero before, with the layouts of their spaces. */
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
    std::vector<Vector>     branches; ///< coefficients of the strain
  };
} // namespace Crevasse

#endif
