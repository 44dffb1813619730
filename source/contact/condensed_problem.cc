// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/contact/condensed_problem.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    bool
    contains(const std::vector<unsigned int> &set, const unsigned int i)
    {
      return std::binary_search(set.begin(), set.end(), i);
    }



    void
    insert(std::vector<unsigned int> &set, const unsigned int i)
    {
      set.insert(std::lower_bound(set.begin(), set.end(), i), i);
    }
  } // namespace



  CondensedProblem::CondensedProblem(const unsigned int       n_nodes,
                                     const ComplianceColumns &columns,
                                     const Extrapolation     &extrapolation)
    : n(n_nodes)
    , compute_columns(columns)
    , extrapolation(extrapolation)
    , columns(n_nodes)
  {
  }



  unsigned int
  CondensedProblem::solve(const dealii::Vector<double> &w_0,
                          dealii::Vector<double>       &forces)
  {
    dealii::Vector<double> w(n);
    std::set<Set>          seen;
    for (unsigned int n_sets = 1;; ++n_sets)
      {
        solve_on(active, w_0, forces);
        opening(w_0, active, forces, w);
        Set next = next_set(forces, w);
        if (next == active)
          return n_sets;
        if (!seen.insert(active).second)
          return n_sets + solve_by_lawson_hanson(w_0, forces);
        if (extrapolation)
          {
            Set further = extrapolated(next);
            if (seen.count(further) == 0)
              next = std::move(further);
          }
        active = std::move(next);
      }
  }



  void
  CondensedProblem::start_from(const std::vector<bool> &closed_nodes)
  {
    active.clear();
    factored_set.clear(); // columns may be other ones now
    for (unsigned int i = 0; i < n; ++i)
      if (closed_nodes[i])
        active.push_back(i);
  }



  void
  CondensedProblem::forces_that_close(const dealii::Vector<double> &opening,
                                      dealii::Vector<double>       &forces)
  {
    solve_on(active, opening, forces);
  }



  std::size_t
  CondensedProblem::memory_consumption() const
  {
    std::size_t bytes = factor.memory_consumption();
    for (const dealii::Vector<double> &column : columns)
      bytes += column.memory_consumption();
    return bytes;
  }



  void
  CondensedProblem::require_columns(const Set &set)
  {
    Set missing;
    for (const unsigned int i : set)
      if (columns[i].size() == 0)
        missing.push_back(i);
    if (missing.empty())
      return;
    const auto computed = compute_columns(missing);
    for (unsigned int k = 0; k < missing.size(); ++k)
      columns[missing[k]] = computed[k];
  }



  void
  CondensedProblem::solve_on(const Set                    &set,
                             const dealii::Vector<double> &w_0,
                             dealii::Vector<double>       &forces)
  {
    forces = 0.;
    if (set.empty())
      return;

    const unsigned int m = set.size();
    if (set != factored_set)
      {
        require_columns(set);
        factor.reinit(m);
        factor.set_property(LAPACKSupport::symmetric);
        for (unsigned int i = 0; i < m; ++i)
          for (unsigned int j = 0; j < m; ++j)
            factor(i, j) =
              0.5 * (columns[set[j]](set[i]) + columns[set[i]](set[j]));
        try
          {
            factor.compute_cholesky_factorization();
          }
        catch (const std::exception &)
          {
            factored_set.clear();
            throw NumericalError(
              "The compliance of the crack lip is not positive definite for " +
              std::to_string(m) +
              " closed nodes: the stiffness is too ill-conditioned for a "
              "direct solver. Check the moduli of [Material] for extreme "
              "contrasts and the mesh for degenerate cells.");
          }
        factored_set = set;
      }

    dealii::Vector<double> right(m);
    for (unsigned int i = 0; i < m; ++i)
      right(i) = -w_0(set[i]);
    factor.solve(right);
    for (unsigned int i = 0; i < m; ++i)
      forces(set[i]) = right(i);
  }



  void
  CondensedProblem::opening(const dealii::Vector<double> &w_0,
                            const Set                    &set,
                            const dealii::Vector<double> &forces,
                            dealii::Vector<double>       &result) const
  {
    result = w_0;
    for (const unsigned int j : set)
      result.add(forces(j), columns[j]);
  }



  CondensedProblem::Set
  CondensedProblem::next_set(const dealii::Vector<double> &forces,
                             const dealii::Vector<double> &w) const
  {
    Set          next;
    unsigned int k = 0; // walks along the active set
    for (unsigned int i = 0; i < n; ++i)
      {
        const bool is_active = k < active.size() && active[k] == i;
        k += is_active ? 1 : 0;
        // On the set w vanishes but for rounding, off it g is zero: the sign
        // of one number decides. A node with both zero stays where it is.
        if (is_active ? forces(i) >= 0. : w(i) < 0.)
          next.push_back(i);
      }
    return next;
  }



  CondensedProblem::Set
  CondensedProblem::extrapolated(const Set &next) const
  {
    std::vector<bool> is_active(n, false), is_next(n, false);
    for (const unsigned int i : active)
      is_active[i] = true;
    for (const unsigned int i : next)
      is_next[i] = true;
    extrapolation(is_active, is_next);

    Set result;
    for (unsigned int i = 0; i < n; ++i)
      if (is_next[i])
        result.push_back(i);
    return result;
  }



  unsigned int
  CondensedProblem::solve_by_lawson_hanson(const dealii::Vector<double> &w_0,
                                           dealii::Vector<double>       &forces)
  {
    ++rescues;
    // Openings that are negative by rounding only must not enter the set: the
    // gain they promise could not be realised.
    const double noise =
      100. * std::numeric_limits<double>::epsilon() * w_0.linfty_norm();

    dealii::Vector<double> trial(n), w(n);
    active.clear();
    forces                = 0.;
    unsigned int n_solves = 0;
    // Nodes whose force came out negative although their opening was: they are
    // degenerate to rounding, and wait until something else has moved.
    Set waiting;
    while (true)
      {
        opening(w_0, active, forces, w);
        int entering = -1;
        for (unsigned int i = 0; i < n; ++i)
          if (w(i) < -noise && !contains(active, i) && !contains(waiting, i) &&
              (entering < 0 || w(i) < w(entering)))
            entering = i;
        if (entering < 0)
          return n_solves;
        insert(active, entering);

        // Towards the solution on the set, as far as no force becomes
        // negative; what reaches zero leaves the set.
        bool moved = false;
        while (true)
          {
            solve_on(active, w_0, trial);
            ++n_solves;
            double step     = 1.;
            int    limiting = -1;
            for (const unsigned int i : active)
              if (trial(i) < 0. &&
                  (limiting < 0 || forces(i) / (forces(i) - trial(i)) < step))
                {
                  limiting = i;
                  step     = forces(i) / (forces(i) - trial(i));
                }
            // With the entering node gone again, and nothing moved, the step to
            // the old solution would be no movement either.
            const bool in_vain = step == 0. && limiting == entering;
            moved              = moved || step > 0.;
            forces.sadd(1. - step, step, trial);
            if (limiting >= 0)
              {
                forces(limiting) = 0.;
                active.erase(std::find(active.begin(), active.end(), limiting));
              }
            if (limiting < 0 || in_vain)
              break;
          }
        if (n_solves > 100 * (n + 10))
          throw NumericalError(
            "The contact problem of " + std::to_string(n) +
            " lip nodes did not end in " + std::to_string(n_solves) +
            " sets: its compliance is too ill-conditioned. Check the moduli of "
            "[Material] and the mesh, or try [Contact] Solver = active set.");
        if (moved)
          waiting.clear();
        else
          insert(waiting, entering);
      }
  }
} // namespace Crevasse
