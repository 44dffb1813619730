// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/state_archive.h>
#include <crevasse/postprocess/field_writer.h>
#include <crevasse/postprocess/nodal_fields.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/numerics/data_out.h>

#include <fstream>
#include <sstream>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** The strains of one branch of all, in the layout of the stress. */
    template <int dim>
    Vector
    branch_of(const Vector      &strains,
              const unsigned int branch,
              const unsigned int n_branches,
              const Vector      &stress)
    {
      if (n_branches == 1)
        return strains;
      Vector                 result(stress);
      constexpr unsigned int n = n_stress_components<dim>;
      for (unsigned int k = 0; k < stress.locally_owned_size(); ++k)
        result.local_element(k) =
          strains.local_element((k / n * n_branches + branch) * n + k % n);
      return result;
    }
  } // namespace



  template <int dim>
  FieldWriter<dim>::FieldWriter(const Space<dim>           &space,
                                const StressRecovery<dim>  &recovery,
                                const ContactBoundary<dim> &lip,
                                const FieldTimes           &times,
                                const std::string          &directory,
                                Log                        &log)
    : space(space)
    , recovery(recovery)
    , lip(lip)
    , directory(directory)
    , log(log)
    , wanted{times.steps.period()} // the end of the run
  {
    for (const double t : times.times)
      wanted.insert(times.steps.instant(times.steps.nearest(t)));
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
    const unsigned int n = write();
    log.line("  fields of " + std::to_string(n) +
             (n == 1 ? " instant in " : " instants in ") + directory +
             "/solution.pvd");
  }



  template <int dim>
  unsigned int
  FieldWriter<dim>::write() const
  {
    std::vector<std::pair<double, std::string>> records;
    for (const auto &[instant, snapshot] : snapshots)
      {
        (void)instant;
        const unsigned int number = records.size();
        write(snapshot, number);
        records.emplace_back(snapshot.time,
                             "solution_" + Utilities::int_to_string(number, 4) +
                               ".pvtu");
      }

    if (Utilities::MPI::this_mpi_process(space.communicator()) == 0)
      {
        const std::string  file_name = directory + "/solution.pvd";
        std::ostringstream text;
        DataOutBase::write_pvd_record(text, records);
        std::ofstream file(file_name);
        file << text.str() << std::flush;
        if (!file)
          throw FileError("Cannot write " + file_name + ".");
      }
    return records.size();
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

    const Vector displacement = space.nodal_values(snapshot.state.displacement);
    add_vector(displacement, "displacement");

    const auto add_components = [&](const std::vector<Vector> &components,
                                    const std::string         &name) {
      for (unsigned int c = 0; c < components.size(); ++c)
        add_scalar(components[c], name + '_' + voigt_name<dim>(c));
    };
    const std::vector<Vector> stress = recovery.recover(snapshot.state.stress);
    add_components(stress, "stress");
    const unsigned int n_branches = // 0 in an elastic body
      snapshot.viscous_strain.size() / snapshot.state.stress.size();
    for (unsigned int i = 0; i < n_branches; ++i)
      {
        std::vector<Vector> strain = recovery.recover(branch_of<dim>(
          snapshot.viscous_strain, i, n_branches, snapshot.state.stress));
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
        const std::string suffix = std::to_string(d + 1);
        add_scalar(invariants.principal_stress[d],
                   "principal_stress_" + suffix);
        add_vector(invariants.principal_direction[d],
                   "principal_direction_" + suffix);
      }
    add_scalar(invariants.second_deviator_invariant,
               "second_deviator_invariant");

    const Vector pressure =
      contact_pressure(space, recovery, lip, snapshot.state.contact_forces);
    add_scalar(pressure, "contact_pressure");

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



  template class FieldWriter<2>;
  template class FieldWriter<3>;
} // namespace Crevasse
