// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/harmonic_balance/periodic_state.h>
#include <crevasse/harmonic_balance/periodic_system.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Active set: whether each entry is closed, for p nodes at N instants, all
     * nodes of the first instant first. */
    using Set = std::vector<bool>;



    /** Initial active set, from the solution in which nodes are uncoupled and
     * elastic: g_i = max(0, −(w⁰_i + c_i)) / S_ii with the given mean. */
    Set
    first_set(const PeriodicState &state)
    {
      const unsigned int  p = state.convolution.n_nodes;
      const unsigned int  N = state.convolution.n_instants;
      const LipVector    &w = state.without_contact;
      Set                 set(p * N, false);
      std::vector<double> sorted(N);
      for (unsigned int i = 0; i < p; ++i)
        {
          if (state.convolution.has_mean)
            {
              for (unsigned int k = i; k < p * N; k += p)
                set[k] = w(k) < 0.;
              continue;
            }
          for (unsigned int j = 0; j < N; ++j)
            sorted[j] = w(j * p + i);
          std::sort(sorted.begin(), sorted.end());

          // To close the m lowest instants up to a level takes the sum of their
          // depths below it.
          const double to_close = N * state.mean_forces(i) *
                                  state.convolution.elastic_compliance(i, i);
          double       taken  = 0.;
          unsigned int lowest = 1;
          for (; lowest < N; ++lowest)
            {
              taken += lowest * (sorted[lowest] - sorted[lowest - 1]);
              if (taken > to_close)
                break;
            }
          for (unsigned int k = i; k < p * N; k += p)
            set[k] = w(k) <= sorted[lowest - 1];
        }
      return set;
    }



    /** Corrects a state by solving for the residual of its equations on the
     * system's set, to an accuracy relative to the scale of openings. */
    void
    correct(PeriodicState &state, PeriodicSystem &system, const double accuracy)
    {
      LipVector right(state.openings), x, offsets;
      right *= -1.;
      system.solve(right,
                   state.missing_means(),
                   accuracy * state.opening_scale(),
                   x,
                   offsets);
      state.forces += x;
      state.offsets += offsets;
      state.compute_openings();
    }



    /** Solves the equations on an active set, starting from the state. */
    void
    solve_on(const Set &set, PeriodicSystem &system, PeriodicState &state)
    {
      constexpr double accuracy = 1e-8;
      for (unsigned int k = 0; k < set.size(); ++k)
        if (!set[k])
          state.forces(k) = 0.;
      state.compute_openings();
      system.reinit(set, state.shift);
      correct(state, system, accuracy);
    }



    /** Makes one step of iterative refinement. */
    void
    refine(PeriodicSystem &system, PeriodicState &state)
    {
      constexpr double accuracy = 1e-14;
      correct(state, system, accuracy);
    }



    /** Tension of closed entries and penetration of open ones, relative to the
     * scales. */
    LipVector
    violations(const Set &set, const PeriodicState &state)
    {
      const double force = state.force_scale(), length = state.opening_scale();
      LipVector    all(set.size());
      for (unsigned int k = 0; k < set.size(); ++k)
        all(k) =
          set[k] ? -state.forces(k) / force : -state.openings(k) / length;
      return all;
    }



    /** Adds to the set, for each node without one, the instant nearest to
     * contact. */
    void
    keep_one_instant(Set &set, const PeriodicState &state)
    {
      const double force = state.force_scale(), length = state.opening_scale();
      const auto   preference = [&](const unsigned int k) {
        return state.forces(k) / force - state.openings(k) / length;
      };
      const unsigned int p = state.convolution.n_nodes;
      for (unsigned int i = 0; i < p; ++i)
        {
          unsigned int preferred = i;
          bool         closes    = false;
          for (unsigned int k = i; k < set.size(); k += p)
            {
              closes = closes || set[k];
              if (preference(k) > preference(preferred))
                preferred = k;
            }
          if (!closes)
            set[preferred] = true;
        }
    }



    /** Next active set: entries with a larger violation change their state. */
    Set
    next_set(const Set &set, const PeriodicState &state, const double margin)
    {
      const LipVector wrong = violations(set, state);
      Set             next(set);
      for (unsigned int k = 0; k < set.size(); ++k)
        if (wrong(k) > margin)
          next[k] = !set[k];
      if (!state.convolution.has_mean)
        keep_one_instant(next, state);
      return next;
    }



    double
    largest(const LipVector &values)
    {
      return *std::max_element(values.begin(), values.end());
    }



    /** Iterates primal–dual active sets from @p set. @return whether the last
     * one solves the problem. */
    bool
    find_set(const unsigned int most_sets,
             const double       tolerance,
             PeriodicSystem    &system,
             PeriodicState     &state,
             Set               &set,
             unsigned int      &n_sets)
    {
      // Sets before the last are solved less accurately.
      constexpr double rough_margin = 1e-7, margin = 1e-12;
      std::set<Set>    seen;
      Set              best;
      double           least = std::numeric_limits<double>::infinity();
      for (unsigned int n = 0; n < most_sets; ++n)
        {
          ++n_sets;
          solve_on(set, system, state);
          Set next = next_set(set, state, rough_margin);
          if (next == set)
            {
              refine(system, state);
              next = next_set(set, state, margin);
              if (next == set)
                return true;
            }
          const double violated = largest(violations(set, state));
          if (violated < least)
            {
              least = violated;
              best  = set;
            }
          if (!seen.insert(set).second)
            break;
          set = std::move(next);
        }
      if (best.empty())
        return false;
      set = std::move(best);
      solve_on(set, system, state);
      refine(system, state);
      return largest(violations(set, state)) <= tolerance;
    }



    /** Approaches the solution by proximal points g_k, where w = w⁰ + S ∗ g + c
     * + D (g − g_{k−1}) with a number D that falls, or rises if sets recur, so
     * that their sets lead to the set of the solution.
     * @return whether this set was found. */
    bool
    approach(const double             tolerance,
             PeriodicSystem          &system,
             PeriodicState           &state,
             PeriodicContactSolution &statistics)
    {
      constexpr double       first_shift = 0.1, factor = 0.1;
      constexpr unsigned int most_steps = 100, most_sets = 15, most_at_end = 5,
                             most_sets_in_all = 300;
      double shift = first_shift * state.convolution.largest_compliance;
      Set    set   = first_set(state);
      for (unsigned int k = 0; k < state.forces.size(); ++k)
        state.centre(k) = state.mean_forces(k % state.offsets.size());
      const auto solves = [&](const double       with,
                              const unsigned int sets,
                              Set               &set) {
        state.shift = with;
        return find_set(sets, tolerance, system, state, set, statistics.n_sets);
      };
      while (statistics.n_proximal_steps < most_steps &&
             statistics.n_sets < most_sets_in_all)
        {
          ++statistics.n_proximal_steps;
          Set next = set;
          if (solves(shift, most_sets, next))
            {
              state.centre = state.forces;
              shift *= factor;
              set = next;
            }
          else
            {
              shift /= factor;
              next = set;
            }
          if (solves(0., most_at_end, next))
            return true;
          state.forces = state.centre;
        }
      return false;
    }



    /** @throw NumericalError if a number of the problem is not finite. */
    void
    require_finite(const PeriodicContactProblem &problem)
    {
      double     sum         = 0.;
      const auto compliances = [&problem]() {
        auto all = problem.compliances;
        if (problem.mean_compliance)
          all.push_back(*problem.mean_compliance);
        return all;
      }();
      for (const auto &[matrix, factor] : compliances)
        sum += std::abs(factor) * matrix->frobenius_norm();
      for (const LipVector &opening : problem.openings_without_contact)
        sum += opening.l1_norm();
      if (!std::isfinite(sum))
        throw NumericalError(
          "The openings and compliances of the crack lip under harmonics are "
          "not finite. Check for moduli or relaxation times that differ by "
          "many orders of magnitude, or use [Periodic state] Method = "
          "anderson.");
    }
  } // namespace



  std::string
  PeriodicContactSolution::describe() const
  {
    return std::string(n_sets == 0 ? "one instant" : "active set") +
           (n_proximal_steps > 0 ? " after proximal points" : "") +
           (n_sets == 0              ? ""
            : n_gmres_iterations > 0 ? ", GMRES"
                                     : ", factored") +
           ", " + certificate.describe();
  }



  PeriodicContactSolution
  solve_periodic_contact(const PeriodicContactProblem &problem,
                         const PeriodicContactOptions &options)
  {
    require_finite(problem);
    const unsigned int        p = problem.mean_forces.size();
    const unsigned int        N = problem.openings_without_contact.size();
    const PeriodicConvolution convolution(problem, p, N);
    PeriodicSystem            system(convolution, options);
    PeriodicState             state(problem, convolution);
    PeriodicContactSolution   solution;
    bool                      is_solved = true;
    if (N == 1 && !convolution.has_mean)
      {
        // A constant solution: mean forces, and all nodes closed.
        state.forces = problem.mean_forces;
        state.offsets -= state.without_contact;
        state.compute_openings();
      }
    else
      {
        constexpr unsigned int most_sets = 15;
        Set                    set       = first_set(state);
        is_solved                        = find_set(most_sets,
                             options.tolerance,
                             system,
                             state,
                             set,
                             solution.n_sets) ||
                    approach(options.tolerance, system, state, solution);
      }
    solution.n_gmres_iterations = system.n_iterations;
    solution.certificate        = state.certify();
    if (!is_solved || solution.certificate.worst() > options.tolerance)
      throw NumericalError(
        Text::Message()
        << "The contact problem of the periodic motion was not solved to "
        << options.tolerance << " by " << solution.n_sets
        << " active sets: " << solution.certificate.describe()
        << ". Check the moduli of [Material] for extreme contrasts, or "
           "try [Periodic state] Method = anderson.");
    solution.forces.resize(N, LipVector(p));
    for (unsigned int j = 0; j < N; ++j)
      std::copy_n(state.forces.begin() + j * p, p, solution.forces[j].begin());
    solution.offsets = state.offsets;
    return solution;
  }
} // namespace Crevasse
