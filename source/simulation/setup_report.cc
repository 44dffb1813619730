// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/machine_memory.h>
#include <crevasse/base/text.h>
#include <crevasse/model/mesh_materials.h>
#include <crevasse/parameters/units.h>
#include <crevasse/simulation/setup_report.h>

#include <deal.II/grid/grid_tools.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    double
    n_instants_of_fields(const Run<dim> &run)
    {
      const FieldTimes &times = *run.scene.output.field_times;
      return 1. + (times.of_extremes ? 3. + 2. * run.crack_tips.size() : 0.) +
             (times.all ? run.steps.n_steps()
                        : times.instants(run.steps.period()).size());
    }



    /** Memory for fields at quadrature points and unknowns, on this rank. */
    template <int dim>
    double
    bytes_of_fields(const Run<dim> &run)
    {
      const Body<dim>      &body    = run.body;
      const Scene          &scene   = run.scene;
      const PeriodicChoice &choice  = run.choice;
      const double          n_steps = run.steps.n_steps();
      const double vector = body.space.locally_owned_unknowns.n_elements();
      const double stress =
        n_stress_components<dim> * double(body.points.n_local_points);
      const double strain =
        body.effects.viscosity.on ? body.law.branches.size() * stress : 0.;
      // Stresses at all samples of a period, compared with the next; stages and
      // work space.
      double values = (n_steps + 8.) * stress + 5. * strain + 30. * vector;
      if (choice.periods_are_iterates())
        values += 4. * (scene.periodic_state.anderson_depth + 2.) * strain;
      if (choice.method == PeriodicMethodType::fourier)
        values += n_steps * (strain + 2. * vector);
      // A checkpoint collects data by cell and packs them (measured): the
      // stresses of a period that cannot be repeated exactly, and instants of
      // the output, of which one is being written: patches and text.
      constexpr double collected = 2.4;
      if (!traits(run.solvers.linear.type).has(Trait::is_direct) ||
          scene.material.creep_law() != nullptr ||
          choice.method == PeriodicMethodType::averaged)
        values += collected * n_steps * stress;
      if (body.effects.field_output.on)
        values +=
          n_instants_of_fields(run) *
            (vector + stress + strain +
             collected * (stress + strain +
                          2. * body.space.finite_element.n_dofs_per_cell() *
                            body.space.mesh().n_locally_owned_active_cells())) +
          10. * stress;
      return sizeof(double) * values;
    }



    /** Memory for all stored stiffnesses, on this rank: several if K varies. */
    template <int dim>
    double
    bytes_of_solvers(const Run<dim> &run, const unsigned int n_ranks)
    {
      const Body<dim>       &body = run.body;
      const LinearSolverType type = run.solvers.linear.type;
      double                 one  = bytes_of_solver<dim>(type,
                                        body.space.n_unknowns(),
                                        n_unknowns_of_first_mesh(body),
                                        body.space.finite_element.degree,
                                        n_ranks) /
                   n_ranks;
      // Matrix-free: K of each point in double and in single precision.
      constexpr int n = n_stress_components<dim>;
      if (type == LinearSolverType::gmg &&
          body.material.at(0.).stiffness->is_individual())
        one += 0.75 * n * (n + 1) * sizeof(double) * body.points.n_local_points;
      // Condensed compliance Σ; with MUMPS its factor, with CHOLMOD temporarily
      // its data instead; and the factor of the open nodes.
      if (run.solvers.contact.type == ContactSolverType::condensed_active_set)
        {
          const double n_lip = Utilities::MPI::sum(body.lip.nodes.size(),
                                                   body.space.communicator());
          one += 3. * sizeof(double) * n_lip * n_lip;
        }
      // Factors and matrices of the averaged body's points.
      double averaged = 0.;
      if (run.choice.method == PeriodicMethodType::averaged)
        averaged = (run.scene.periodic_state.averaged_poles + 1.) *
                   (one + sizeof(double) * n * n * body.law.branches.size() *
                            body.points.n_local_points);
      if (!body.material.stiffness_varies)
        return one + averaged;
      constexpr double mebibyte = 1024. * 1024.;
      return one + averaged +
             std::min(2. * run.steps.n_steps() * one,
                      run.scene.linear_solver.memory_for_instants * mebibyte);
    }



    /** Logs the peak memory of a run, on the process that needs most, by
     * purpose. Collective.
     * @throw SceneError if the processes on a machine need more than it has
     * left. */
    template <int dim>
    void
    report_memory(const Run<dim> &run)
    {
      const Space<dim>  &space        = run.body.space;
      const MPI_Comm     communicator = space.communicator();
      const unsigned int n_ranks =
        Utilities::MPI::n_mpi_processes(communicator);
      const std::pair<const char *, double> parts[] = {
        // The memory of libraries is measured with the smallest scene.
        {"libraries", n_ranks == 1 ? 180e6 : 195e6},
        {"mesh",
         double(space.mesh().memory_consumption() +
                space.dof_handler.memory_consumption())},
        {"fields", bytes_of_fields(run)},
        {"solver", bytes_of_solvers(run, n_ranks)}};
      const auto megabytes = [communicator](const double bytes) {
        return std::lround(1e-6 * Utilities::MPI::max(bytes, communicator));
      };
      double      total = 0.;
      std::string list;
      for (const auto &[name, bytes] : parts)
        {
          total += bytes;
          if (const long size = megabytes(bytes); size > 0)
            list += (list.empty() ? ": " : ", ") + std::string(name) + ' ' +
                    std::to_string(size);
        }
      list = std::to_string(megabytes(total)) + " MB" +
             (n_ranks > 1 ? " on each process" : "") + list;
      run.log.line("  memory: about " + list);
      require_memory(
        total,
        parts[0].second,
        space.n_unknowns(),
        communicator,
        "The run (" + list + ")",
        "Make the mesh coarser; lower [Time integration] Steps per period, "
        "[Periodic state] Anderson depth, [Linear solver] Memory for instants "
        "or the number of [Output] Field times; use Type = gmg or amg if they "
        "are allowed, or processes on more machines.");
    }



    /** Logs the ranges of tables that the scene calls, and names others. */
    void
    describe_tables(const TableFunctions &tables, Log &log)
    {
      std::vector<std::string> others;
      for (const auto &[name, table] : tables)
        if (table.is_called)
          log.line(Text::Message() << "  table " << name << '('
                                   << table.quantity << "): " << table.x.size()
                                   << " rows from " << table.x.front() << " to "
                                   << table.x.back() << ", values from "
                                   << table.least << " to " << table.largest);
        else
          others.push_back(name);
      if (!others.empty())
        log.line("  columns of tables that no formula calls: " +
                 Text::join(others, ", "));
    }



    template <int dim>
    std::string
    describe_time(const Run<dim> &run)
    {
      const TimeIntegrationParameters &time = run.scene.time_integration;
      const double                     step = run.steps.largest_step();
      Text::Message                    text;
      if (time.step_control == StepControlType::adaptive)
        text << "  time: adaptive steps, relative tolerance "
             << time.relative_tolerance << ", at least " << run.steps.n_steps()
             << " a period, initially at most " << step;
      else
        text << "  time: " << run.steps.n_steps()
             << " steps a period, the largest " << step;
      if (run.integrator == nullptr)
        return text;
      if (run.choice.method == PeriodicMethodType::fourier)
        return text << "; trapezoid, all instants at once";
      const IntegratorProperties &integrator = run.integrator->properties;
      const double                limit =
        integrator.stability_limit * run.magnitudes.relaxation_times.smallest;
      text << "; " << integrator.name << ", stable ";
      if (std::isfinite(integrator.stability_limit) &&
          run.body.law.creep != nullptr)
        return text << "with steps that depend on the stress";
      return std::isfinite(limit) ? text << "below " << limit
                                  : text << "with any step";
    }
  } // namespace



  template <int dim>
  Summary
  sizes_of(const Body<dim> &body)
  {
    const Mesh<dim> &mesh         = body.space.mesh();
    const MPI_Comm   communicator = body.space.communicator();
    return {{"cells", mesh.n_global_active_cells()},
            {"unknowns", body.space.n_independent_unknowns()},
            {"quadrature_points", body.points.n_points()},
            {"contact_nodes",
             Utilities::MPI::sum(body.lip.nodes.size(), communicator)},
            {"cells_of_ranks",
             Utilities::MPI::gather(communicator,
                                    mesh.n_locally_owned_active_cells())},
            {"levels", mesh.n_global_levels()},
            // Cell sizes are longest diagonals.
            {"smallest_cell", GridTools::minimal_cell_diameter(mesh)},
            {"largest_cell", GridTools::maximal_cell_diameter(mesh)}};
  }



  template <int dim>
  void
  describe(const Run<dim> &run)
  {
    const Scene &scene = run.scene;
    Log         &log   = run.log;
    if (!scene.title.empty())
      log.line(scene.title);
    if (const Units units(scene.units); units.are_known())
      log.line("  units: " + units.describe());
    const Summary sizes = sizes_of(run.body);
    log.line(Text::Message()
             << "  mesh: " << sizes["cells"] << " cells, " << sizes["unknowns"]
             << " unknowns, " << sizes["quadrature_points"]
             << " quadrature points, " << sizes["contact_nodes"]
             << " contact nodes");
    const bool is_automatic = automatic_cycles(scene) > 0;
    if (is_automatic || scene.refinement.strategy != RefinementStrategy::none)
      log.line(
        Text::format("  refinement: %s, %u levels, cells from %.3g to %.3g%s",
                     name_of(is_automatic ? RefinementStrategy::tip
                                          : scene.refinement.strategy)
                       .c_str(),
                     sizes["levels"].get<unsigned int>(),
                     sizes["smallest_cell"].get<double>(),
                     sizes["largest_cell"].get<double>(),
                     is_automatic ? " (automatic: K without singular functions)"
                                  : ""));
    report_memory(run);
    log.line("  boundaries: " + describe_boundaries<dim>(scene));
    for (const RigidMotion &motion : run.body.held_by_contact)
      log.line("  held by contact alone: " + motion.name);
    describe_tables(*scene.tables.functions, log);
    if (scene.geometry.shape == Shape::mesh_file)
      log.line("  materials: " +
               describe_materials(scene, run.body.space.mesh()));
    for (const Effects::Effect &effect : run.active_effects())
      if (effect.on || log.is_verbose)
        log.line(Text::format("  %-20s %-4s(%s)",
                              effect.name.c_str(),
                              effect.on ? "on" : "off",
                              Text::shorten(effect.why).c_str()));
    log.line(describe_time(run));
    if (run.steps.jumps_at(scene.loads.period) && formulas_can_jump(scene))
      log.line(
        Text::format("  end of the period: loads or material jump to their "
                     "values at t = 0, which the tables show at t = %g",
                     scene.loads.period));
    log.line("  periodic state: " + run.choice.describe());
    if (!traits(run.solvers.contact.type).has(Trait::relaxes))
      log.line("  linear solver: " + run.solvers.linear.describe());
    if (run.body.effects.contact.on)
      log.line("  contact solver: " + run.solvers.contact.describe());
    if (run.body.effects.stress_intensity.on && !run.stress_intensity.on)
      log.line("  crack tip: no K_I (" + run.stress_intensity.why + ")");
    for (const auto &tip : run.crack_tips)
      log.line(tip->describe());
    for (const Summary &tip : run.tips_without_intensity)
      log.line("  crack tip without K: " + tip["no_K"].get<std::string>());
    for (const auto &integral : run.creep_integrals)
      log.line("  " + integral->describe());
    if (run.crack_front != nullptr)
      log.line(run.crack_front->describe());
    for (const auto &probe : run.probes)
      {
        if (const auto &side = probe.side_of_interface)
          log.line(
            "  probe " + probe.name +
            ": lies between materials; its stress is that of the cell around " +
            Text::from_point(*side));
        if (const auto &side = probe.side_of_crack)
          log.line("  probe " + probe.name +
                   ": lies on a crack; its displacement and stress are those "
                   "of the lip on the side of " +
                   Text::from_point(dealii::Point<dim>(*side)));
      }
    for (const std::string &warning : warnings(run))
      log.line("  warning: " + warning);
    for (const std::string &warning : table_warnings(run))
      log.line("  warning: " + warning);
  }



  template decltype(sizes_of<2>) sizes_of<2>;
  template decltype(sizes_of<3>) sizes_of<3>;
  template void
  describe<2>(const Run<2> &);
  template void
  describe<3>(const Run<3> &);
} // namespace Crevasse
