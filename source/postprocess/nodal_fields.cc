// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/postprocess/nodal_fields.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/lapack_support.h>
#include <deal.II/lac/lapack_templates.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Calls f(nodal dof, displacement dofs of that node) on each locally
     * owned cell. */
    template <int dim, typename Function>
    void
    for_each_node(const Space<dim>          &space,
                  const StressRecovery<dim> &recovery,
                  const Function            &f)
    {
      const FESystem<dim>                 &fe = space.finite_element();
      std::vector<types::global_dof_index> vector_dofs(fe.n_dofs_per_cell());
      std::vector<types::global_dof_index> nodal_dofs(
        recovery.dof_handler().get_fe().n_dofs_per_cell());
      for (const auto &cell : space.dof_handler().active_cell_iterators())
        if (cell->is_locally_owned())
          {
            cell->get_dof_indices(vector_dofs);
            const typename DoFHandler<dim>::active_cell_iterator nodal_cell(
              &space.mesh(),
              cell->level(),
              cell->index(),
              &recovery.dof_handler());
            nodal_cell->get_dof_indices(nodal_dofs);
            for (unsigned int i = 0; i < nodal_dofs.size(); ++i)
              {
                std::array<types::global_dof_index, dim> dofs;
                for (unsigned int d = 0; d < dim; ++d)
                  dofs[d] = vector_dofs[fe.component_to_system_index(d, i)];
                f(nodal_dofs[i], dofs);
              }
          }
    }



    template <int dim>
    SymmetricTensor<2, dim>
    components_in_plane(const SymmetricTensor<2, 3> &stress)
    {
      SymmetricTensor<2, dim> part;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j)
          part[i][j] = stress[i][j];
      return part;
    }



    /** A principal stress and its direction, of length 1. */
    template <int dim>
    using Principal = std::pair<double, Tensor<1, dim>>;

    /** The largest first. By LAPACK, for the name that deal.II's eigenvectors()
     * has in a library compiled by GCC is not the one that Clang looks for. */
    template <int dim>
    std::array<Principal<dim>, dim>
    principal_stresses(const SymmetricTensor<2, dim> &stress)
    {
      std::array<double, dim * dim> vectors;
      std::array<double, dim>       values;
      std::array<double, 16 * dim>  work;
      const types::blas_int         n = dim, n_work = work.size();
      types::blas_int               info = 0;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          vectors[i * dim + j] = stress[i][j];
      syev("V",
           "U",
           &n,
           vectors.data(),
           &n,
           values.data(),
           work.data(),
           &n_work,
           &info);
      AssertThrow(info == 0, LAPACKSupport::ExcErrorCode("syev", info));

      std::array<Principal<dim>, dim> principal;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const unsigned int ascending = dim - 1 - d;
          principal[d].first           = values[ascending];
          for (unsigned int c = 0; c < dim; ++c)
            principal[d].second[c] = vectors[ascending * dim + c];
        }
      return principal;
    }
  } // namespace



  template <int dim>
  StressInvariants<dim>
  stress_invariants(const Space<dim>          &space,
                    const StressRecovery<dim> &recovery,
                    const std::vector<Vector> &nodal_stress)
  {
    StressInvariants<dim> invariants;
    invariants.second_deviator_invariant.reinit(nodal_stress[0]);
    for (unsigned int d = 0; d < dim; ++d)
      {
        invariants.principal_stress[d].reinit(nodal_stress[0]);
        invariants.principal_direction[d] = make_vector(space.dof_handler());
      }

    const auto set = [&](const types::global_dof_index                   node,
                         const std::array<types::global_dof_index, dim> &dofs) {
      if (!nodal_stress[0].in_local_range(node))
        return;
      VoigtVector<dim> components;
      for (unsigned int c = 0; c < nodal_stress.size(); ++c)
        components[c] = nodal_stress[c](node);
      const SymmetricTensor<2, 3> stress = stress_tensor<dim>(components);

      const SymmetricTensor<2, 3> s              = deviator(stress);
      invariants.second_deviator_invariant(node) = 0.5 * (s * s);

      const auto pairs = principal_stresses(components_in_plane<dim>(stress));
      for (unsigned int d = 0; d < dim; ++d)
        {
          invariants.principal_stress[d](node) = pairs[d].first;
          for (unsigned int c = 0; c < dim; ++c)
            if (invariants.principal_direction[d].in_local_range(dofs[c]))
              invariants.principal_direction[d](dofs[c]) = pairs[d].second[c];
        }
    };
    for_each_node(space, recovery, set);

    invariants.second_deviator_invariant.update_ghost_values();
    for (unsigned int d = 0; d < dim; ++d)
      {
        invariants.principal_stress[d].update_ghost_values();
        invariants.principal_direction[d].update_ghost_values();
      }
    return invariants;
  }



  template <int dim>
  Vector
  contact_pressure(const Space<dim>           &space,
                   const StressRecovery<dim>  &recovery,
                   const ContactBoundary<dim> &lip,
                   const std::vector<double>  &contact_forces)
  {
    Vector at_dofs = space.ghosted_vector();
    for (unsigned int k = 0; k < lip.nodes().size(); ++k)
      at_dofs(lip.nodes()[k].dof) = contact_forces[k] / lip.nodes()[k].weight;
    lip.spread_to_held_nodes(at_dofs);

    IndexSet relevant;
    DoFTools::extract_locally_relevant_dofs(recovery.dof_handler(), relevant);
    Vector     pressure(recovery.dof_handler().locally_owned_dofs(),
                    relevant,
                    space.communicator());
    const auto set = [&](const types::global_dof_index                   node,
                         const std::array<types::global_dof_index, dim> &dofs) {
      if (pressure.in_local_range(node))
        // Only the normal component of a lip node is not zero.
        for (const auto dof : dofs)
          if (at_dofs(dof) != 0.)
            pressure(node) = at_dofs(dof);
    };
    for_each_node(space, recovery, set);
    pressure.update_ghost_values();
    return pressure;
  }



  template StressInvariants<2>
  stress_invariants<2>(const Space<2> &,
                       const StressRecovery<2> &,
                       const std::vector<Vector> &);
  template StressInvariants<3>
  stress_invariants<3>(const Space<3> &,
                       const StressRecovery<3> &,
                       const std::vector<Vector> &);
  template Vector
  contact_pressure<2>(const Space<2> &,
                      const StressRecovery<2> &,
                      const ContactBoundary<2> &,
                      const std::vector<double> &);
  template Vector
  contact_pressure<3>(const Space<3> &,
                      const StressRecovery<3> &,
                      const ContactBoundary<3> &,
                      const std::vector<double> &);
} // namespace Crevasse
