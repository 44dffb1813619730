// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/machine_memory.h>
#include <crevasse/base/problems.h>
#include <crevasse/model/linear_choice.h>
#include <crevasse/model/solver_memory.h>
#include <crevasse/simulation/memory_prediction.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** The part of the unknowns whose needs are so many bytes: a factor grows
     * faster than the rest. */
    template <int dim>
    double
    affordable_part(const MemoryPrediction &needed, const double bytes)
    {
      const double growth   = dim == 2 ? 1.1 : 4. / 3.;
      const double constant = needed.libraries;
      const double linear   = needed.total() - constant - needed.solver;
      double       low = 0., high = 1.;
      while (high - low > 1e-3)
        {
          const double part = 0.5 * (low + high);
          const double all =
            constant + part * linear + std::pow(part, growth) * needed.solver;
          (all > bytes ? high : low) = part;
        }
      return low;
    }



    /** What to do about the memory of what solves with the stiffness.
     *
     * @param are_several of these stiffnesses, of instants
     * @param has_gmg which needs a tenth of ML's in space. */
    std::string
    advice_on_solver(const LinearSolverChoice &solver,
                     const Scene              &scene,
                     const bool                are_several,
                     const bool                has_gmg)
    {
      const std::string type =
        std::string("take [Linear solver] Type = ") + (has_gmg ? "gmg" : "amg");
      if (!solver.is_multigrid())
        return "factors of the stiffness: " +
               (scene.discretisation.singular_functions > 0 ? ""
                                                            : type + ", ") +
               (are_several ? "lower Memory for instants, " : "") +
               "or make the mesh coarser";
      return "multigrid: " +
             (solver.type == LinearSolverType::amg && has_gmg ? type + ", or "
                                                              : "") +
             "make the mesh coarser";
    }



    /** What needs most, and what to do about it. */
    std::string
    largest_part(const MemoryPrediction   &needed,
                 const LinearSolverChoice &solver,
                 const Scene              &scene,
                 const bool                are_several,
                 const bool                has_gmg)
    {
      const std::vector<std::pair<double, std::string>> parts = {
        {needed.libraries, "the libraries of so many processes: take fewer"},
        {needed.mesh, "the mesh: make it coarser"},
        {needed.fields,
         "the stress at all steps of a period: lower [Time integration] Steps "
         "per period, or make the mesh coarser"},
        {needed.matrix,
         has_gmg
           ? "the stiffness: take [Linear solver] Type = gmg, which has no "
             "matrix, or make the mesh coarser"
           : "the stiffness: make the mesh coarser"},
        {needed.solver, advice_on_solver(solver, scene, are_several, has_gmg)},
        {needed.search,
         "the search of the periodic state: lower [Periodic state] Anderson "
         "depth, or take Method = march"},
        {needed.output,
         "fields of the last period: take [Output] Fields = none, or fewer "
         "Field times"}};
      return std::max_element(parts.begin(), parts.end())->second;
    }



    /** Where more is needed than there is nothing is begun: it would end
     * without a message, or take the machine with it. */
    template <int dim>
    void
    require_enough(const MemoryPrediction &needed,
                   const Body<dim>        &body,
                   const Scene            &scene)
    {
      const MPI_Comm communicator = body.space.communicator();
      const double   all   = sum_on_machine(needed.total(), communicator);
      const double   there = available_memory(communicator);
      if (Utilities::MPI::max(all / there, communicator) <= memory_uncertainty)
        return;

      const double part =
        Utilities::MPI::min(affordable_part<dim>(needed,
                                                 needed.total() * there / all),
                            communicator);
      const auto fit =
        static_cast<unsigned long>(part * body.space.n_unknowns());
      const LinearSolverChoice solver = choose_linear_solver(scene, body);
      throw SceneError("The run needs about " +
                       gigabytes(Utilities::MPI::max(all, communicator)) +
                       " of memory on a machine that has " +
                       gigabytes(Utilities::MPI::min(there, communicator)) +
                       " left, most of it for " +
                       largest_part(needed,
                                    solver,
                                    scene,
                                    body.material.stiffness_varies(),
                                    may_use_gmg(scene, body)) +
                       (solver.type == LinearSolverType::cholesky
                          ? ""
                          : "; or take processes on more machines") +
                       ". With these settings about " + std::to_string(fit) +
                       " unknowns fit; the mesh has " +
                       std::to_string(body.space.n_unknowns()) + ".");
    }



    /** "libraries 180, fields 12", in MB, of the rank that needs most of each
     * part; parts that need nothing are not named. */
    std::string
    list_of_parts(const MemoryPrediction   &needed,
                  const LinearSolverChoice &solver,
                  const MPI_Comm            communicator)
    {
      const std::vector<std::pair<const char *, double>> parts = {
        {"libraries", needed.libraries},
        {"mesh", needed.mesh},
        {"fields", needed.fields},
        {"matrix", needed.matrix},
        {solver.is_multigrid() ? "multigrid" : "factor", needed.solver},
        {"periodic state", needed.search},
        {"output", needed.output}};
      std::string list;
      for (const auto &[name, bytes] : parts)
        if (const long megabytes =
              std::lround(1e-6 * Utilities::MPI::max(bytes, communicator));
            megabytes > 0)
          list += (list.empty() ? "" : ", ") + std::string(name) + " " +
                  std::to_string(megabytes);
      return list;
    }
  } // namespace



  template <int dim>
  void
  describe_memory(const Body<dim>      &body,
                  const StepList       &steps,
                  const Scene          &scene,
                  const PeriodicChoice &choice,
                  Log                  &log)
  {
    const MPI_Comm         communicator = body.space.communicator();
    const MemoryPrediction needed = predict_memory(body, steps, scene, choice);
    const long             megabytes =
      std::lround(1e-6 * Utilities::MPI::max(needed.total(), communicator));
    const bool are_several = Utilities::MPI::n_mpi_processes(communicator) > 1;
    log.line(
      "  memory: about " + std::to_string(megabytes) + " MB" +
      (are_several ? " on each process" : "") + ": " +
      list_of_parts(needed, choose_linear_solver(scene, body), communicator));
    require_enough(needed, body, scene);
  }



  template void
  describe_memory<2>(const Body<2> &,
                     const StepList &,
                     const Scene &,
                     const PeriodicChoice &,
                     Log &);
  template void
  describe_memory<3>(const Body<3> &,
                     const StepList &,
                     const Scene &,
                     const PeriodicChoice &,
                     Log &);
} // namespace Crevasse
