// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/harmonic_balance/periodic_contact.h>
#include <crevasse/harmonic_balance/periodic_interior_point.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <sstream>

namespace Crevasse
{
  using namespace dealii;

  PeriodicContact::PeriodicContact(const Options &options)
    : options(options)
  {
  }



  PeriodicContact::PeriodicContact()
    : PeriodicContact(Options())
  {
  }



  std::string
  PeriodicContact::Statistics::describe() const
  {
    if (n_linear_solves == 0)
      return "one instant";
    return std::string(n_interior_point_steps > 0
                         ? "active set after interior point"
                         : "active set") +
           (n_gmres_iterations > 0 ? ", GMRES" : ", factored");
  }



  PeriodicContactSolution
  PeriodicContact::solve(const PeriodicContactProblem &problem)
  {
    return solve_from(problem, nullptr);
  }



  PeriodicContactSolution
  PeriodicContact::solve(const PeriodicContactProblem  &problem,
                         const PeriodicContactSolution &start)
  {
    return solve_from(problem, &start);
  }



  PeriodicContactSolution
  PeriodicContact::solve_from(const PeriodicContactProblem  &given,
                              const PeriodicContactSolution *start)
  {
    last_statistics  = {};
    last_certificate = {};
    AssertThrow(given.mean_forces.size() > 0 &&
                  !given.openings_without_contact.empty(),
                ExcMessage("A contact problem without nodes or instants."));
    const PeriodicConvolution convolution(
      given.compliances,
      given.mean_forces.size(),
      given.openings_without_contact.size());
    const PeriodicComplementarity problem(given, convolution);

    PeriodicState state;
    if (convolution.n_instants() == 1)
      {
        // Nothing varies: the mean itself, and closed.
        state.forces = problem.mean_forces;
        state.openings.reinit(convolution.n_nodes());
        state.offsets.reinit(convolution.n_nodes());
      }
    else
      solve_with(problem, start, state);

    last_certificate = certify(problem, state);
    if (last_certificate.worst() > options.tolerance)
      {
        std::ostringstream message;
        message << "The contact problem of the periodic motion was not solved "
                   "to "
                << options.tolerance << ": " << last_certificate.describe()
                << ". Check the moduli of [Material] for extreme contrasts, or "
                   "try [Periodic state] Method = anderson.";
        throw NumericalError(message.str());
      }
    return problem.solution(state);
  }



  namespace
  {
    /** Its forces and openings as vectors, without offsets. */
    PeriodicState
    as_state(const PeriodicContactSolution &solution,
             const PeriodicConvolution     &convolution)
    {
      const unsigned int p = convolution.n_nodes();
      const unsigned int N = convolution.n_instants();
      AssertDimension(solution.forces.size(), N);
      AssertDimension(solution.openings.size(), N);
      PeriodicState state;
      state.forces.reinit(p * N);
      state.openings.reinit(p * N);
      for (unsigned int k = 0; k < p * N; ++k)
        {
          state.forces(k)   = solution.forces[k / p](k % p);
          state.openings(k) = solution.openings[k / p](k % p);
        }
      return state;
    }
  } // namespace



  void
  PeriodicContact::solve_with(const PeriodicComplementarity &problem,
                              const PeriodicContactSolution *start,
                              PeriodicState                 &state)
  {
    PeriodicSystem    system(problem.convolution, options.largest_dense_system);
    PeriodicActiveSet active_set(problem, system, options.tolerance);
    const auto        first =
      start == nullptr
               ? active_set.first_set()
               : active_set.set_of(as_state(*start, problem.convolution));

    const bool solved =
      active_set.solve(first, options.most_active_sets, state) ||
      solve_by_interior_point(problem, system, active_set, state);
    last_statistics.n_active_sets      = active_set.n_sets();
    last_statistics.n_linear_solves    = system.n_solves();
    last_statistics.n_gmres_iterations = system.n_iterations();
    last_statistics.largest_system     = system.largest_system();
    if (!solved)
      throw NumericalError(
        "The contact problem of the periodic motion was not solved by " +
        std::to_string(last_statistics.n_active_sets) + " active sets and " +
        std::to_string(last_statistics.n_interior_point_steps) +
        " steps of the interior point method. Check the moduli of [Material] "
        "for extreme contrasts, or try [Periodic state] Method = anderson.");
  }



  bool
  PeriodicContact::solve_by_interior_point(
    const PeriodicComplementarity &problem,
    PeriodicSystem                &system,
    PeriodicActiveSet             &active_set,
    PeriodicState                 &state)
  {
    // The sets are tried when the gap has fallen by so much again. At the last
    // gap rounding is all that is left.
    constexpr double       first_gap = 1e-4, factor = 1e-2, last_gap = 1e-15;
    constexpr unsigned int most_steps = 100, sets_at_a_time = 5;

    PeriodicInteriorPoint interior_point(problem, system);
    double                next_gap = first_gap;
    while (interior_point.gap() > last_gap &&
           interior_point.n_steps() < most_steps)
      {
        interior_point.step();
        last_statistics.n_interior_point_steps = interior_point.n_steps();
        if (interior_point.gap() > next_gap)
          continue;
        state = interior_point.state();
        if (active_set.solve(active_set.set_of(state), sets_at_a_time, state))
          return true;
        next_gap = std::min(next_gap, interior_point.gap()) * factor;
      }
    state = interior_point.state();
    return active_set.solve(active_set.set_of(state), sets_at_a_time, state);
  }
} // namespace Crevasse
