// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#include <crevasse/linear/solver_choice.h>
#include <crevasse/run/sizes.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Entries of the stiffness: on average 3 (Q1) or 4 (Q2) nodes along each
     * direction share a cell with a node, each with dim components. */
    template <int dim>
    double
    matrix_entries(const Sizes &sizes, const unsigned int degree)
    {
      return double(sizes.unknowns) * dim *
             Utilities::fixed_power<dim>(double(degree + 2));
    }



    /** What the program and its libraries need for the smallest scene. */
    constexpr double bytes_of_libraries = 180e6;



    /** Entries of the Cholesky factor with CHOLMOD's default ordering. In two
     * dimensions 5.3 n log₂ n, measured at 116 162 unknowns (Q1; Q2 has 4.4),
     * in three 19 n^(4/3), measured at 107 811 (Q1) and 73 167 (Q2). */
    template <int dim>
    double
    factor_entries(const Sizes &sizes)
    {
      const double n = sizes.unknowns;
      return dim == 2 ? 5.3 * n * std::log2(n) : 19. * std::pow(n, 4. / 3.);
    }



    /** Entries of the stiffness and of what solves with it: a factor, or
     * multigrid's coarser matrices and smoothers, as much again. */
    template <int dim>
    double
    solver_entries(const Sizes                  &sizes,
                   const Body<dim>              &body,
                   const LinearSolverParameters &linear_solver)
    {
      const double entries =
        matrix_entries<dim>(sizes, body.space.finite_element().degree);
      const LinearSolverChoice choice =
        choose_linear_solver(linear_solver,
                             dim,
                             sizes.unknowns,
                             Utilities::MPI::n_mpi_processes(
                               body.space.communicator()));
      return entries + (choice.type == LinearSolverChoice::amg
                          ? entries
                          : factor_entries<dim>(sizes));
    }



    /** Bytes of the instants that are kept for the fields of the last period,
     * and of writing one of them. */
    template <int dim>
    double
    bytes_of_field_output(const Sizes               &sizes,
                          const Body<dim>           &body,
                          const StepList            &steps,
                          const std::vector<double> &field_times)
    {
      if (!body.effects.field_output.on)
        return 0.;
      std::set<unsigned int> instants = {steps.n_steps()};
      for (const double t : field_times)
        instants.insert(steps.nearest(t));

      // Displacement, stress and, with viscosity, r of each.
      const double fields = body.effects.viscosity.on ? 2. : 1.;
      const double kept   = double(sizes.unknowns) + fields *
                                                     n_stress_components<dim> *
                                                     sizes.quadrature_points;
      // Two tensors, displacement, principal stresses with directions, J₂ and
      // pressure at the nodes of each cell, twice: as patches and as text.
      const double columns =
        2. * n_stress_components<dim> + dim * (2. + dim) + 2.;
      const double nodes =
        sizes.cells *
        Utilities::fixed_power<dim>(body.space.finite_element().degree + 1.);
      return sizeof(double) * (instants.size() * kept + 2. * columns * nodes);
    }



    /** Bytes of the stiffness and its factor, or of those of all instants that
     * are kept. */
    template <int dim>
    double
    bytes_of_solvers(const Sizes                  &sizes,
                     const Body<dim>              &body,
                     const StepList               &steps,
                     const LinearSolverParameters &parameters)
    {
      constexpr double bytes_per_entry = sizeof(double) + sizeof(int);
      constexpr double mebibyte        = 1024. * 1024.;
      const double     one =
        bytes_per_entry * solver_entries(sizes, body, parameters);
      if (!body.material.stiffness_varies())
        return one;
      // Two stages a step, of which one may be another step's.
      const double all = 2. * steps.n_steps() * one;
      return one + std::min(all, parameters.memory_for_instants * mebibyte);
    }



    /** Bytes of what the search for the periodic state keeps. */
    template <int dim>
    double
    bytes_of_search(const Sizes          &sizes,
                    const Body<dim>      &body,
                    const StepList       &steps,
                    const Scene          &scene,
                    const PeriodicChoice &choice)
    {
      const double strain = double(body.law.branches().size()) *
                            n_stress_components<dim> * sizes.quadrature_points;
      double values = 0.;
      // Images and residuals, and their differences while they are combined.
      if (choice.method == "anderson")
        values += 4. * (scene.periodic_state.anderson_depth + 1.) * strain;
      if (choice.uses_fourier())
        values += steps.n_steps() * (strain + 2. * sizes.unknowns);
      return sizeof(double) * values;
    }



    /** Bytes of these, and of what is stored per quadrature point and per
     * unknown while a period is computed. */
    template <int dim>
    double
    predicted_memory(const Sizes          &sizes,
                     const Body<dim>      &body,
                     const StepList       &steps,
                     const Scene          &scene,
                     const PeriodicChoice &choice)
    {
      // The stress of all samples of a period is kept to compare with the
      // next; the integrator keeps r, a stage and a rate for each stage. What
      // solvers and observers need besides is measured.
      const double n_branches = body.law.branches().size();
      const double fields =
        steps.n_steps() +
        (body.effects.viscosity.on ? 8. + 4. * n_branches : 2.);
      const double vectors = 30.;
      return bytes_of_libraries +
             sizeof(double) *
               (fields * n_stress_components<dim> * sizes.quadrature_points +
                vectors * sizes.unknowns) +
             bytes_of_solvers(sizes, body, steps, scene.linear_solver) +
             bytes_of_search(sizes, body, steps, scene, choice) +
             bytes_of_field_output(sizes,
                                   body,
                                   steps,
                                   scene.output.field_times) +
             body.space.mesh().memory_consumption() +
             body.space.dof_handler().memory_consumption();
    }
  } // namespace



  template <int dim>
  Sizes::Sizes(const Body<dim> &body)
    : cells(body.space.mesh().n_global_active_cells())
    , unknowns(body.space.n_unknowns())
    , quadrature_points(body.points.n_points())
    , contact_nodes(
        Utilities::MPI::sum(body.lip.nodes().size(), body.space.communicator()))
    , levels(body.space.mesh().n_global_levels())
    , smallest_cell(GridTools::minimal_cell_diameter(body.space.mesh()))
    , largest_cell(GridTools::maximal_cell_diameter(body.space.mesh()))
  {
  }



  void
  Sizes::add_to(Summary &summary) const
  {
    summary["cells"]             = cells;
    summary["unknowns"]          = unknowns;
    summary["quadrature_points"] = quadrature_points;
    summary["contact_nodes"]     = contact_nodes;
    summary["levels"]            = levels;
    summary["smallest_cell"]     = smallest_cell;
    summary["largest_cell"]      = largest_cell;
  }



  template <int dim>
  void
  describe_sizes(const Body<dim>      &body,
                 const StepList       &steps,
                 const Scene          &scene,
                 const PeriodicChoice &choice,
                 Log                  &log)
  {
    const Sizes sizes(body);
    log.line("  mesh: " + std::to_string(sizes.cells) + " cells, " +
             std::to_string(sizes.unknowns) + " unknowns, " +
             std::to_string(sizes.quadrature_points) + " quadrature points, " +
             std::to_string(sizes.contact_nodes) + " contact nodes");
    char text[120];
    if (scene.refinement.strategy != "none")
      {
        std::snprintf(text,
                      sizeof(text),
                      "  refinement: %s, %u levels, cells from %.3g to %.3g",
                      scene.refinement.strategy.c_str(),
                      sizes.levels,
                      sizes.smallest_cell,
                      sizes.largest_cell);
        log.line(text);
      }
    std::snprintf(text,
                  sizeof(text),
                  "  memory: about %.0f MB",
                  predicted_memory(sizes, body, steps, scene, choice) * 1e-6);
    log.line(text);
  }



  template Sizes::Sizes(const Body<2> &);
  template Sizes::Sizes(const Body<3> &);
  template void
  describe_sizes<2>(const Body<2> &,
                    const StepList &,
                    const Scene &,
                    const PeriodicChoice &,
                    Log &);
  template void
  describe_sizes<3>(const Body<3> &,
                    const StepList &,
                    const Scene &,
                    const PeriodicChoice &,
                    Log &);
} // namespace Crevasse
