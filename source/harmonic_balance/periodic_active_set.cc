// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/harmonic_balance/periodic_active_set.h>

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

namespace Crevasse
{
  using namespace dealii;

  PeriodicActiveSet::PeriodicActiveSet(const PeriodicComplementarity &problem,
                                       PeriodicSystem                &system,
                                       const double                   tolerance)
    : problem(problem)
    , system(system)
    , tolerance(tolerance)
    , no_diagonal(problem.openings_without_contact.size())
  {
  }



  PeriodicActiveSet::Set
  PeriodicActiveSet::first_set() const
  {
    const unsigned int p = problem.convolution.n_nodes();
    const unsigned int N = problem.convolution.n_instants();

    Set                 set(p * N, false);
    std::vector<double> w_0(N);
    for (unsigned int i = 0; i < p; ++i)
      {
        for (unsigned int j = 0; j < N; ++j)
          w_0[j] = problem.openings_without_contact(j * p + i);
        std::sort(w_0.begin(), w_0.end());

        // Closing the m lowest instants to a level takes the sum of what they
        // are below it.
        const double to_close = N * problem.mean_forces(i) *
                                problem.convolution.elastic_compliance()(i, i);
        double       taken  = 0.;
        unsigned int lowest = 1;
        for (; lowest < N; ++lowest)
          {
            taken += lowest * (w_0[lowest] - w_0[lowest - 1]);
            if (taken > to_close)
              break;
          }
        for (unsigned int j = 0; j < N; ++j)
          set[j * p + i] =
            problem.openings_without_contact(j * p + i) <= w_0[lowest - 1];
      }
    return set;
  }



  PeriodicActiveSet::Set
  PeriodicActiveSet::set_of(const PeriodicState &state) const
  {
    const double force  = problem.force_scale(state);
    const double length = problem.opening_scale(state);
    Set          set(state.forces.size());
    for (unsigned int k = 0; k < set.size(); ++k)
      set[k] = state.forces(k) / force > state.openings(k) / length;
    keep_one_instant(set, state);
    return set;
  }



  bool
  PeriodicActiveSet::solve(Set                set,
                           const unsigned int most_sets,
                           PeriodicState     &state)
  {
    // Most sets are not the last: they are solved on less accurately.
    constexpr double rough_margin = 1e-7, margin = 1e-12;

    std::set<Set> seen;
    Set           best;
    double        least = std::numeric_limits<double>::infinity();
    for (unsigned int n = 0; n < most_sets; ++n)
      {
        solve_on(set, state);
        Set next = next_set(set, state, rough_margin);
        if (next == set)
          {
            refine(set, state);
            next = next_set(set, state, margin);
            if (next == set)
              return true;
          }
        const double violated = violation(set, state);
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
    solve_on(best, state);
    refine(best, state);
    return violation(best, state) <= tolerance;
  }



  void
  PeriodicActiveSet::solve_on(const Set &set, PeriodicState &state)
  {
    ++sets;
    if (state.forces.size() != set.size())
      {
        state.forces.reinit(set.size());
        state.offsets.reinit(problem.mean_forces.size());
      }
    for (unsigned int k = 0; k < set.size(); ++k)
      if (!set[k])
        state.forces(k) = 0.;
    problem.compute_openings(state);
    system.reinit(set, no_diagonal);
    constexpr double accuracy = 1e-8;
    correct(state, accuracy);
  }



  void
  PeriodicActiveSet::correct(PeriodicState &state, const double accuracy)
  {
    const unsigned int     p = problem.convolution.n_nodes();
    const unsigned int     N = problem.convolution.n_instants();
    dealii::Vector<double> right(state.openings), x, offsets;
    right *= -1.;
    dealii::Vector<double> missing(problem.mean_forces);
    for (unsigned int k = 0; k < p * N; ++k)
      missing(k % p) -= state.forces(k) / N;
    system.solve(
      right, missing, accuracy * problem.opening_scale(state), x, offsets);
    state.forces += x;
    state.offsets += offsets;
    problem.compute_openings(state);
  }



  void
  PeriodicActiveSet::refine(const Set &set, PeriodicState &state)
  {
    constexpr double accuracy = 1e-14;
    correct(state, accuracy);
    for (unsigned int k = 0; k < set.size(); ++k)
      if (set[k])
        state.openings(k) = 0.;
  }



  PeriodicActiveSet::Set
  PeriodicActiveSet::next_set(const Set           &set,
                              const PeriodicState &state,
                              const double         margin) const
  {
    const double tension     = margin * problem.force_scale(state);
    const double penetration = margin * problem.opening_scale(state);
    Set          next(set.size());
    for (unsigned int k = 0; k < set.size(); ++k)
      next[k] =
        set[k] ? state.forces(k) >= -tension : state.openings(k) < -penetration;
    keep_one_instant(next, state);
    return next;
  }



  double
  PeriodicActiveSet::violation(const Set &set, const PeriodicState &state) const
  {
    const double force  = problem.force_scale(state);
    const double length = problem.opening_scale(state);
    double       worst  = 0.;
    for (unsigned int k = 0; k < set.size(); ++k)
      worst = std::max(worst,
                       set[k] ? -state.forces(k) / force
                              : -state.openings(k) / length);
    return worst;
  }



  void
  PeriodicActiveSet::keep_one_instant(Set                 &set,
                                      const PeriodicState &state) const
  {
    const unsigned int p          = problem.convolution.n_nodes();
    const double       force      = problem.force_scale(state);
    const double       length     = problem.opening_scale(state);
    const auto         preference = [&](const unsigned int k) {
      return state.forces(k) / force - state.openings(k) / length;
    };
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
} // namespace Crevasse
