// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/machine_memory.h>
#include <crevasse/base/problems.h>
#include <crevasse/model/linear_choice.h>
#include <crevasse/simulation/memory_report.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Bytes on this rank. */
    struct Part
    {
      const char *name;
      double      bytes;
      std::string advice; ///< if it is the largest
    };

    using Parts = std::array<Part, 4>;



    double
    total(const Parts &parts)
    {
      return std::accumulate(parts.begin(),
                             parts.end(),
                             0.,
                             [](const double sum, const Part &part) {
                               return sum + part.bytes;
                             });
    }



    /** What is kept at quadrature points and unknowns. */
    template <int dim>
    double
    bytes_of_fields(const Body<dim>      &body,
                    const StepList       &steps,
                    const Scene          &scene,
                    const PeriodicChoice &choice)
    {
      const double n_steps = steps.n_steps();
      const double vector  = body.space.locally_owned_unknowns().n_elements();
      const double stress =
        n_stress_components<dim> * double(body.points.n_local_points());
      const double strain =
        body.effects.viscosity.on ? body.law.branches().size() * stress : 0.;
      // The stress of all samples of a period, compared with the next; stages
      // and work space.
      double values = (n_steps + 8.) * stress + 5. * strain + 30. * vector;
      if (choice.method == PeriodicMethodType::anderson)
        values += 4. * (scene.periodic_state.anderson_depth + 2.) * strain;
      if (choice.uses_fourier())
        values += n_steps * (strain + 2. * vector);
      // Instants of the output, and one being written: patches and text.
      if (body.effects.field_output.on)
        values +=
          (1. + scene.output.field_times.size()) * (vector + stress + strain) +
          10. * stress;
      return sizeof(double) * values;
    }



    /** Of all stiffnesses that are kept: more than one if it varies. */
    template <int dim>
    double
    bytes_of_solvers(const Body<dim>          &body,
                     const StepList           &steps,
                     const Scene              &scene,
                     const LinearSolverChoice &solver)
    {
      const unsigned int n_ranks =
        Utilities::MPI::n_mpi_processes(body.space.communicator());
      const unsigned int degree = body.space.finite_element().degree;
      double             one    = bytes_of_solver<dim>(solver.type,
                                        body.space.n_unknowns(),
                                        n_unknowns_of_first_mesh(body),
                                        degree,
                                        n_ranks) /
                   n_ranks;
      // Without a matrix, K of each point.
      constexpr int n = n_stress_components<dim>;
      if (solver.type == LinearSolverType::gmg &&
          body.material.at(0.).stiffness->is_individual())
        one +=
          0.5 * n * (n + 1) * sizeof(double) * body.points.n_local_points();
      if (!body.material.stiffness_varies())
        return one;
      constexpr double mebibyte = 1024. * 1024.;
      return one + std::min(2. * steps.n_steps() * one,
                            scene.linear_solver.memory_for_instants * mebibyte);
    }



    std::string
    advice_on_solver(const LinearSolverChoice &solver,
                     const bool                varies,
                     const bool                has_gmg,
                     const bool                has_singular_functions)
    {
      std::string advice = "make the mesh coarser";
      if (varies)
        advice += ", lower [Linear solver] Memory for instants";
      if (has_singular_functions || solver.type == LinearSolverType::gmg)
        return advice;
      if (has_gmg)
        return advice + ", or take Type = gmg";
      return advice +
             (traits(solver.type).is_multigrid ? "" : ", or take Type = amg");
    }



    template <int dim>
    Parts
    estimate(const RunSetup<dim> &setup)
    {
      const Body<dim>          &body   = setup.body;
      const Scene              &scene  = setup.scene;
      const LinearSolverChoice &solver = setup.solvers.linear;
      // Of the smallest scene, measured.
      const bool is_alone =
        Utilities::MPI::n_mpi_processes(body.space.communicator()) == 1;
      return {
        {{"libraries", is_alone ? 180e6 : 195e6, "take fewer processes"},
         {"mesh",
          double(body.space.mesh().memory_consumption() +
                 body.space.dof_handler().memory_consumption()),
          "make it coarser"},
         {"fields",
          bytes_of_fields(body, setup.steps, scene, setup.periodic_choice),
          "make the mesh coarser, or lower [Time integration] Steps per "
          "period, [Periodic state] Anderson depth or the number of "
          "[Output] Field times"},
         {"solver",
          bytes_of_solvers(body, setup.steps, scene, solver),
          advice_on_solver(solver,
                           body.material.stiffness_varies(),
                           may_use_gmg(scene, body),
                           scene.discretisation.singular_functions > 0)}}};
    }



    /** Otherwise it would end without a message, or take the machine with it.
     */
    void
    require_enough(const Parts   &parts,
                   const double   n_unknowns,
                   const MPI_Comm communicator)
    {
      const double all   = sum_on_machine(total(parts), communicator);
      const double there = available_memory(communicator);
      if (Utilities::MPI::max(all / there, communicator) <= memory_uncertainty)
        return;
      const Part &largest = *std::max_element(parts.begin(),
                                              parts.end(),
                                              [](const Part &a, const Part &b) {
                                                return a.bytes < b.bytes;
                                              });
      // Factors shrink faster than the unknowns.
      const double libraries = sum_on_machine(parts[0].bytes, communicator);
      const double part      = Utilities::MPI::min(
        std::max(0., (there - libraries) / (all - libraries)), communicator);
      throw SceneError(
        "The run needs about " +
        gigabytes(Utilities::MPI::max(all, communicator)) +
        " of memory on a machine that has " +
        gigabytes(Utilities::MPI::min(there, communicator)) +
        " left, most of it for: " + largest.name + ". To change that, " +
        largest.advice +
        ", or use processes on more machines. With these settings about " +
        std::to_string(static_cast<unsigned long>(part * n_unknowns)) +
        " unknowns fit; the mesh has " +
        std::to_string(static_cast<unsigned long>(n_unknowns)) + ".");
    }
  } // namespace



  template <int dim>
  void
  report_memory(const RunSetup<dim> &setup, Log &log)
  {
    const MPI_Comm communicator = setup.body.space.communicator();
    const Parts    parts        = estimate(setup);
    const auto     megabytes    = [communicator](const double bytes) {
      return std::lround(1e-6 * Utilities::MPI::max(bytes, communicator));
    };
    std::string text =
      "  memory: about " + std::to_string(megabytes(total(parts))) + " MB";
    if (Utilities::MPI::n_mpi_processes(communicator) > 1)
      text += " on each process";
    const char *separator = ": ";
    for (const Part &part : parts)
      if (const long size = megabytes(part.bytes); size > 0)
        {
          text +=
            separator + std::string(part.name) + ' ' + std::to_string(size);
          separator = ", ";
        }
    log.line(text);
    require_enough(parts, setup.body.space.n_unknowns(), communicator);
  }



  template void
  report_memory<2>(const RunSetup<2> &, Log &);
  template void
  report_memory<3>(const RunSetup<3> &, Log &);
} // namespace Crevasse
