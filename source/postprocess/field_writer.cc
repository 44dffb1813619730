// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/state_archive.h>
#include <crevasse/grid/curved_edges.h>
#include <crevasse/postprocess/field_writer.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/lac/lapack_support.h>
#include <deal.II/lac/lapack_templates.h>
#include <deal.II/numerics/data_out.h>
#include <deal.II/numerics/data_postprocessor.h>

#include <fstream>
#include <sstream>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
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



    /** What is derived from the recovered stress, node by node: principal
     * stresses in the plane (space) of the mesh, the largest first, each with
     * its unit vector, and J₂ = ½ s′:s′ with the deviator s′ of the
     * three-dimensional stress. */
    template <int dim>
    class StressInvariants : public DataPostprocessor<dim>
    {
    public:
      std::vector<std::string>
      get_names() const override
      {
        std::vector<std::string> names;
        for (unsigned int d = 1; d <= dim; ++d)
          {
            names.push_back("principal_stress_" + std::to_string(d));
            names.insert(names.end(),
                         dim,
                         "principal_direction_" + std::to_string(d));
          }
        names.push_back("second_deviator_invariant");
        return names;
      }

      std::vector<DataComponentInterpretation::DataComponentInterpretation>
      get_data_component_interpretation() const override
      {
        using namespace DataComponentInterpretation;
        std::vector<DataComponentInterpretation::DataComponentInterpretation>
          all(1 + dim * (1 + dim), component_is_part_of_vector);
        for (unsigned int d = 0; d <= dim; ++d)
          all[d * (1 + dim)] = component_is_scalar;
        return all;
      }

      UpdateFlags
      get_needed_update_flags() const override
      {
        return update_values;
      }

      void
      evaluate_vector_field(
        const DataPostprocessorInputs::Vector<dim> &inputs,
        std::vector<dealii::Vector<double>>        &results) const override
      {
        for (unsigned int q = 0; q < results.size(); ++q)
          {
            VoigtVector<dim> components;
            for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
              components[c] = inputs.solution_values[q](c);
            const SymmetricTensor<2, 3> stress = stress_tensor<dim>(components);
            const SymmetricTensor<2, 3> s      = deviator(stress);
            const auto [values, vectors] = principal_stresses<dim>(stress);
            unsigned int next            = 0;
            for (unsigned int d = 0; d < dim; ++d)
              {
                const unsigned int ascending = dim - 1 - d;
                results[q](next++)           = values[ascending];
                for (unsigned int c = 0; c < dim; ++c)
                  results[q](next++) = vectors[ascending * dim + c];
              }
            results[q](next) = 0.5 * (s * s);
          }
      }
    };
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

    Vector               pressure(recovery.dof_handler().locally_owned_dofs(),
                    space.communicator());
    const FESystem<dim> &fe = space.finite_element();
    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
    std::vector<types::global_dof_index> nodes(dofs.size() / dim);
    for (const auto &cell : owned_cells(recovery.dof_handler()))
      {
        cell->get_dof_indices(nodes);
        same_cell(cell->id(), space.dof_handler())->get_dof_indices(dofs);
        // Only the normal component of a lip node is not zero.
        for (unsigned int i = 0; i < dofs.size(); ++i)
          if (const auto node = nodes[fe.system_to_component_index(i).second];
              at_dofs(dofs[i]) != 0. && pressure.in_local_range(node))
            pressure(node) = at_dofs(dofs[i]);
      }
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
    const unsigned int degree = space.finite_element().degree;
    DoFHandler<dim>    cell_dofs(space.mesh());
    cell_dofs.distribute_dofs(
      FESystem<dim>(FE_DGQ<dim>(degree), n_stress_components<dim>));
    DataOut<dim>          data_out;
    DataOutBase::VtkFlags flags;
    flags.time                     = snapshot.time;
    flags.write_higher_order_cells = false;
    data_out.set_flags(flags);

    const auto add_components = [&](const Vector      &components,
                                    const std::string &name) {
      std::vector<std::string> names;
      for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
        names.push_back(name + '_' + voigt_name<dim>(c));
      data_out.add_data_vector(cell_dofs, components, names);
    };

    // DataOut copies these values, and those of ghosts from their owners.
    data_out.add_data_vector(
      space.dof_handler(),
      space.nodal_values(snapshot.state.displacement),
      std::vector<std::string>(dim, "displacement"),
      std::vector<DataComponentInterpretation::DataComponentInterpretation>(
        dim, DataComponentInterpretation::component_is_part_of_vector));
    const Vector stress = recovery.recover(snapshot.state.stress, cell_dofs);
    add_components(stress, "stress");
    const unsigned int n_branches = // 0 in an elastic body
      snapshot.viscous_strain.size() / snapshot.state.stress.size();
    constexpr unsigned int n = n_stress_components<dim>;
    for (unsigned int i = 0; i < n_branches; ++i)
      {
        Vector branch = snapshot.state.stress; // of its layout
        for (unsigned int k = 0; k < branch.locally_owned_size(); ++k)
          branch.local_element(k) =
            // From engineering shears to components of a tensor.
            (k % n < 3 ? 1. : 0.5) * snapshot.viscous_strain.local_element(
                                       (k / n * n_branches + i) * n + k % n);
        add_components(recovery.recover(branch, cell_dofs),
                       n_branches == 1
                         ? "viscous_strain"
                         : "viscous_strain_branch_" + std::to_string(i + 1));
      }
    const StressInvariants<dim> invariants;
    data_out.add_data_vector(cell_dofs, stress, invariants);
    data_out.add_data_vector(
      recovery.dof_handler(),
      contact_pressure(space, recovery, lip, snapshot.state.contact_forces),
      "contact_pressure");

    data_out.build_patches(space.mapping(),
                           degree,
                           has_curved_edges(space.mesh())
                             ? DataOut<dim>::curved_inner_cells
                             : DataOut<dim>::curved_boundary);
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
