// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/meters.h>
#include <crevasse/base/state_archive.h>
#include <crevasse/base/text_file.h>
#include <crevasse/postprocess/field_writer.h>
#include <crevasse/postprocess/paraview_script.h>
#include <crevasse/postprocess/principal_stresses.h>
#include <crevasse/time/inelastic_strain.h>

#include <deal.II/base/data_out_base.h>

#include <sstream>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Adds functions of the recovered stress: principal stresses in the plane
     * (space) of the mesh, the largest first, with their unit vectors, and J₂ =
     * ½ s′:s′ with the deviator s′ of the three-dimensional stress. */
    template <int dim>
    void
    add_invariants(const FieldGrid<dim>                &grid,
                   const std::vector<VoigtVector<dim>> &stresses,
                   std::vector<PointArray>             &arrays)
    {
      std::vector<PrincipalStresses<dim>> principal;
      for (const VoigtVector<dim> &stress : stresses)
        principal.push_back(
          principal_stresses<dim>(stress_tensor<dim>(stress)));
      for (unsigned int d = 0; d < dim; ++d)
        {
          const unsigned int ascending = dim - 1 - d;
          const std::string  number    = std::to_string(d + 1);
          arrays.push_back(
            grid.array("principal_stress_" + number, 1, [&](auto p, auto) {
              return principal[p].first[ascending];
            }));
          arrays.push_back(
            grid.array("principal_direction_" + number, 3, [&](auto p, auto c) {
              return c < dim ? principal[p].second[ascending * dim + c] : 0.;
            }));
        }
      const auto J_2 = [&stresses](const std::size_t p, const unsigned int) {
        const SymmetricTensor<2, 3> s =
          deviator(stress_tensor<dim>(stresses[p]));
        return 0.5 * (s * s);
      };
      arrays.push_back(grid.array("second_deviator_invariant", 1, J_2));
      arrays.push_back(
        grid.array("von_mises_stress", 1, [&](const auto p, const auto c) {
          return std::sqrt(3. * J_2(p, c));
        }));
    }
  } // namespace



  template <int dim>
  bool
  FieldWriter<dim>::follow(const Sample &sample)
  {
    if (sample.step == 0)
      extremes.assign(wanted.followed.size(), {});
    // If the values at two instants differ by rounding, the first is kept.
    for (unsigned int i = 0; i < extremes.size(); ++i)
      {
        auto &[most, size, instant] = extremes[i];
        const double value          = wanted.followed[i](sample);
        size                        = std::max(size, std::abs(value));
        if (value > most + 1e-9 * size)
          {
            most    = value;
            instant = sample.instant;
          }
      }
    const auto is_kept = [this](const double instant) {
      bool is = wanted.chosen.count(instant) == 1;
      for (const Extreme &extreme : extremes)
        is = is || extreme.instant == instant;
      return is;
    };
    // If all steps are kept, the last period may have had other instants.
    if (!wanted.all || sample.step == 0)
      for (auto entry = snapshots.begin(); entry != snapshots.end();)
        entry =
          is_kept(entry->first) ? std::next(entry) : snapshots.erase(entry);
    return wanted.all || is_kept(sample.instant);
  }



  template <int dim>
  void
  FieldWriter<dim>::observe(const Sample &sample)
  {
    if (!follow(sample))
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
    archive.common(wanted.chosen);
    archive.common_list(extremes);
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
  FieldWriter<dim>::finish()
  {
    const Stopwatch      watch("fields", snapshots.size());
    const MPI_Comm       communicator = body.space.communicator();
    const unsigned int   rank = Utilities::MPI::this_mpi_process(communicator);
    const FieldGrid<dim> grid(body.space, recovery);
    const VtuGrid        file = grid.file();
    std::vector<std::pair<double, std::string>> records;
    for (const auto &entry : snapshots)
      {
        const Snapshot   &snapshot = entry.second;
        const std::string name =
          "solution_" + Utilities::int_to_string(records.size(), 4);
        const auto arrays = arrays_of(entry.first, snapshot, grid);
        collectively(communicator, [&]() {
          const auto piece = [&name](const unsigned int of_rank) {
            return name + '.' + std::to_string(of_rank) + ".vtu";
          };
          file.write(directory + '/' + piece(rank), snapshot.time, arrays);
          if (rank > 0)
            return;
          std::vector<std::string> pieces;
          for (unsigned int of_rank = 0;
               of_rank < Utilities::MPI::n_mpi_processes(communicator);
               ++of_rank)
            pieces.push_back(piece(of_rank));
          write_pvtu(directory + '/' + name + ".pvtu", pieces, arrays);
        });
        records.emplace_back(snapshot.time, name + ".pvtu");
      }
    const std::string file_name   = directory + "/solution.pvd";
    const std::string script_name = directory + "/show_in_paraview.py";
    collectively(communicator, [&]() {
      if (rank > 0)
        return;
      std::ostringstream text;
      DataOutBase::write_pvd_record(text, records);
      write_atomically(text.str(), file_name);
      write_atomically(paraview_script, script_name);
    });
    log.line("  fields of " + std::to_string(records.size()) +
             (records.size() == 1 ? " instant in " : " instants in ") +
             file_name +
             "; to see them, run there: paraview --script=show_in_paraview.py");
  }



  template <int dim>
  std::vector<PointArray>
  FieldWriter<dim>::arrays_of(const double          instant,
                              const Snapshot       &snapshot,
                              const FieldGrid<dim> &grid) const
  {
    const Space<dim>       &space = body.space;
    std::vector<PointArray> arrays;
    const Vector            displacement =
      body.nodal_displacement(snapshot.state.displacement,
                              snapshot.state.instant,
                              snapshot.time);
    arrays.push_back(
      grid.nodal("displacement", 3, space.dof_handler, displacement));
    const auto stress = grid.recovered(snapshot.state.stress);
    arrays.push_back(grid.tensor("stress", stress));
    const MaterialState<dim>   material = body.material.at(instant);
    const InelasticStrain<dim> inelastic(material, snapshot.viscous_strain);
    for (unsigned int i = 0; i < inelastic.n_branches; ++i)
      {
        Vector branch = snapshot.state.stress; // for its layout
        for (std::size_t offset = 0; offset < branch.locally_owned_size();
             offset += inelastic.n)
          {
            VoigtVector<dim> r = inelastic.branch(offset, i);
            for (unsigned int k = 3; k < inelastic.n; ++k)
              r[k] *= 0.5; // tensors have half the engineering shears
            QuadratureField<dim>::set(branch, offset, r);
          }
        arrays.push_back(
          grid.tensor(inelastic.n_branches == 1
                        ? "viscous_strain"
                        : "viscous_strain_branch_" + std::to_string(i + 1),
                      grid.recovered(branch)));
      }
    add_invariants(grid, stress, arrays);

    arrays.push_back(
      grid.nodal("contact_pressure",
                 1,
                 space.dof_handler,
                 body.lip.pressure(snapshot.state.contact_forces)));
    arrays.push_back(grid.nodal(
      "opening", 1, space.dof_handler, body.lip.opening(displacement)));
    if (!body.temperature.is_zero())
      {
        const auto theta =
          grid.recovered(temperature(steps.within_period(instant)));
        arrays.push_back(grid.array("temperature", 1, [&theta](auto p, auto) {
          return theta[p][0];
        }));
      }
    return arrays;
  }



  template <int dim>
  Vector
  FieldWriter<dim>::temperature(const double t) const
  {
    Vector theta;
    body.points.initialize(theta);
    for (const auto &cell : owned_cells(body.space.mesh()))
      {
        std::size_t place = body.points.offset(cell);
        for (const Point<dim> &point : body.space.quadrature(cell).get_points())
          {
            theta.local_element(place) = body.temperature.value(
              body.space.mapping.transform_unit_to_real_cell(cell, point), t);
            place += n_stress_components<dim>;
          }
      }
    return theta;
  }



  template class FieldWriter<2>;
  template class FieldWriter<3>;
} // namespace Crevasse
