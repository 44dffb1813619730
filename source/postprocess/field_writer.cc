// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/state_archive.h>
#include <crevasse/postprocess/field_writer.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/lac/lapack_support.h>
#include <deal.II/lac/lapack_templates.h>
#include <deal.II/numerics/data_out.h>

#include <fstream>
#include <sstream>

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
      std::array<types::global_dof_index, dim> dofs;
      for (const auto &cell : recovery.dof_handler().active_cell_iterators())
        if (cell->is_locally_owned())
          {
            cell->get_dof_indices(nodal_dofs);
            typename DoFHandler<dim>::active_cell_iterator(&space.mesh(),
                                                           cell->level(),
                                                           cell->index(),
                                                           &space.dof_handler())
              ->get_dof_indices(vector_dofs);
            for (unsigned int i = 0; i < nodal_dofs.size(); ++i)
              {
                for (unsigned int d = 0; d < dim; ++d)
                  dofs[d] = vector_dofs[fe.component_to_system_index(d, i)];
                f(nodal_dofs[i], dofs);
              }
          }
    }



    /** What is derived from the recovered stress, node by node. */
    template <int dim>
    struct StressInvariants
    {
      /** In the plane (space) of the mesh, the largest first. */
      std::array<Vector, dim> principal_stress;
      /** Unit vectors, in the displacement space. */
      std::array<Vector, dim> principal_direction;
      /** J₂ = ½ s′:s′ with the deviator s′ of the three-dimensional stress. */
      Vector second_deviator_invariant;
    };



    /** Principal stresses in the plane (space) of the mesh in ascending order,
     * and rows of their directions. By LAPACK, for the name that deal.II's
     * eigenvectors() has in a library compiled by GCC is not the one that Clang
     * looks for. */
    template <int dim>
    std::pair<std::array<double, dim>, std::array<double, dim * dim>>
    principal_stresses(const SymmetricTensor<2, 3> &stress)
    {
      std::array<double, dim>       values;
      std::array<double, dim * dim> vectors;
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
      return {values, vectors};
    }



    template <int dim>
    StressInvariants<dim>
    stress_invariants(const Space<dim>          &space,
                      const StressRecovery<dim> &recovery,
                      const std::vector<Vector> &nodal_stress)
    {
      StressInvariants<dim> invariants;
      Vector               &J2 = invariants.second_deviator_invariant;
      J2.reinit(nodal_stress[0]);
      invariants.principal_stress.fill(J2);
      invariants.principal_direction.fill(make_vector(space.dof_handler()));
      for_each_node(space, recovery, [&](const auto node, const auto &dofs) {
        if (!J2.in_local_range(node))
          return;
        VoigtVector<dim> components;
        for (unsigned int c = 0; c < nodal_stress.size(); ++c)
          components[c] = nodal_stress[c](node);
        const SymmetricTensor<2, 3> stress = stress_tensor<dim>(components);
        const SymmetricTensor<2, 3> s      = deviator(stress);
        J2(node)                           = 0.5 * (s * s);

        const auto [values, vectors] = principal_stresses<dim>(stress);
        for (unsigned int d = 0; d < dim; ++d)
          {
            const unsigned int ascending         = dim - 1 - d;
            invariants.principal_stress[d](node) = values[ascending];
            Vector &direction = invariants.principal_direction[d];
            for (unsigned int c = 0; c < dim; ++c)
              if (direction.in_local_range(dofs[c]))
                direction(dofs[c]) = vectors[ascending * dim + c];
          }
      });
      return invariants;
    }
  } // namespace



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

    Vector pressure(recovery.dof_handler().locally_owned_dofs(),
                    space.communicator());
    for_each_node(space, recovery, [&](const auto node, const auto &dofs) {
      if (pressure.in_local_range(node))
        // Only the normal component of a lip node is not zero.
        for (const auto dof : dofs)
          if (at_dofs(dof) != 0.)
            pressure(node) = at_dofs(dof);
    });
    return pressure;
  }



  template <int dim>
  void
  FieldWriter<dim>::observe(const Sample &sample)
  {
    if (wanted.count(sample.instant) == 0)
      return;
    Snapshot &snapshot = snapshots[sample.instant];
    snapshot           = {sample.time, sample.state, sample.viscous_strain};
    if (sample.secular_flow != nullptr)
      {
        snapshot.state.displacement.add(sample.time,
                                        sample.secular_flow->velocity);
        snapshot.viscous_strain.add(sample.time,
                                    sample.secular_flow->strain_rate);
      }
  }



  template <int dim>
  void
  FieldWriter<dim>::serialize(StateArchive &archive)
  {
    archive.section("fields");
    archive.common(wanted);
    std::vector<double> instants;
    for (const auto &snapshot : snapshots)
      instants.push_back(snapshot.first);
    archive.common(instants);
    for (const double instant : instants)
      {
        Snapshot &snapshot = snapshots[instant];
        archive.common(snapshot.time);
        snapshot.state.serialize(archive);
        archive.at_points(snapshot.viscous_strain);
      }
  }



  template <int dim>
  void
  FieldWriter<dim>::summarise(Summary &)
  {
    std::vector<std::pair<double, std::string>> records;
    for (const auto &snapshot : snapshots)
      {
        const unsigned int number = records.size();
        write(snapshot.second, number);
        records.emplace_back(snapshot.second.time,
                             "solution_" + Utilities::int_to_string(number, 4) +
                               ".pvtu");
      }
    const std::string file_name = directory + "/solution.pvd";
    if (Utilities::MPI::this_mpi_process(space.communicator()) == 0)
      {
        std::ostringstream text;
        DataOutBase::write_pvd_record(text, records);
        std::ofstream file(file_name);
        if (!(file << text.str() << std::flush))
          throw FileError("Cannot write " + file_name + ".");
      }
    log.line("  fields of " + std::to_string(records.size()) +
             (records.size() == 1 ? " instant in " : " instants in ") +
             file_name);
  }



  template <int dim>
  void
  FieldWriter<dim>::write(const Snapshot    &snapshot,
                          const unsigned int number) const
  {
    DataOut<dim>          data_out;
    DataOutBase::VtkFlags flags;
    flags.time                     = snapshot.time;
    flags.write_higher_order_cells = false;
    data_out.set_flags(flags);

    const auto add_vector = [&](const Vector &values, const std::string &name) {
      data_out.add_data_vector(
        space.dof_handler(),
        values,
        std::vector<std::string>(dim, name),
        std::vector<DataComponentInterpretation::DataComponentInterpretation>(
          dim, DataComponentInterpretation::component_is_part_of_vector));
    };
    const auto add_scalar = [&](const Vector &values, const std::string &name) {
      data_out.add_data_vector(recovery.dof_handler(), values, name);
    };
    const auto add_components = [&](const std::vector<Vector> &components,
                                    const std::string         &name) {
      for (unsigned int c = 0; c < components.size(); ++c)
        add_scalar(components[c], name + '_' + voigt_name<dim>(c));
    };

    // DataOut copies these values, and those of ghosts from their owners.
    add_vector(space.nodal_values(snapshot.state.displacement), "displacement");
    const std::vector<Vector> stress = recovery.recover(snapshot.state.stress);
    add_components(stress, "stress");
    const unsigned int n_branches = // 0 in an elastic body
      snapshot.viscous_strain.size() / snapshot.state.stress.size();
    constexpr unsigned int n = n_stress_components<dim>;
    for (unsigned int i = 0; i < n_branches; ++i)
      {
        Vector branch = snapshot.state.stress; // of its layout
        for (unsigned int k = 0; k < branch.locally_owned_size(); ++k)
          branch.local_element(k) = snapshot.viscous_strain.local_element(
            (k / n * n_branches + i) * n + k % n);
        std::vector<Vector> strain = recovery.recover(branch);
        // From engineering shears to components of a tensor.
        for (unsigned int c = 3; c < strain.size(); ++c)
          strain[c] *= 0.5;
        add_components(strain,
                       n_branches == 1
                         ? "viscous_strain"
                         : "viscous_strain_branch_" + std::to_string(i + 1));
      }

    const StressInvariants<dim> invariants =
      stress_invariants(space, recovery, stress);
    for (unsigned int d = 0; d < dim; ++d)
      {
        const std::string suffix = '_' + std::to_string(d + 1);
        add_scalar(invariants.principal_stress[d], "principal_stress" + suffix);
        add_vector(invariants.principal_direction[d],
                   "principal_direction" + suffix);
      }
    add_scalar(invariants.second_deviator_invariant,
               "second_deviator_invariant");
    add_scalar(
      contact_pressure(space, recovery, lip, snapshot.state.contact_forces),
      "contact_pressure");

    data_out.build_patches(space.mapping(), space.finite_element().degree);
    try
      {
        data_out.write_vtu_with_pvtu_record(
          directory + '/', "solution", number, space.communicator(), 4);
      }
    catch (const ExceptionBase &)
      {
        throw FileError("Cannot write the fields in " + directory +
                        ": is the disk full?");
      }
  }



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
  template class FieldWriter<2>;
  template class FieldWriter<3>;
} // namespace Crevasse
