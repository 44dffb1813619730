// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/contact/condensed_problem.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <set>

namespace Crevasse
{
  using namespace dealii;

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
    // Nodes with neither force nor opening would never rest if what is negative
    // by rounding only changed them too.
    const double noise =
      100. * std::numeric_limits<double>::epsilon() * w_0.linfty_norm();
    std::set<Set> seen;
    bool          one_by_one = false;
    for (unsigned int n_sets = 1;; ++n_sets)
      {
        forces_that_close(w_0, forces);
        openings = w_0; // + S g
        for (const unsigned int j : active)
          openings.add(forces(j), columns[j]);
        Set next = next_set(forces, openings, one_by_one ? noise : 0.);
        if (next == active)
          return n_sets;
        if (n_sets > 100 * (n + 10))
          throw NumericalError(
            "The contact problem of " + std::to_string(n) +
            " lip nodes did not end in " + std::to_string(n_sets) +
            " sets: its compliance is too ill-conditioned. Check the moduli of "
            "[Material] and the mesh, or try [Contact] Solver = active set.");
        if (one_by_one)
          {
            Set wrong;
            std::set_symmetric_difference(active.begin(),
                                          active.end(),
                                          next.begin(),
                                          next.end(),
                                          std::back_inserter(wrong));
            const auto place =
              std::lower_bound(active.begin(), active.end(), wrong.back());
            if (place != active.end() && *place == wrong.back())
              active.erase(place);
            else
              active.insert(place, wrong.back());
            continue;
          }
        if (!seen.insert(active).second)
          {
            ++rescues;
            one_by_one = true;
            continue;
          }
        if (extrapolation)
          {
            Set further = extrapolated(next);
            if (seen.count(further) == 0)
              next = std::move(further);
          }
        active = std::move(next);
      }
  }



  namespace
  {
    std::vector<unsigned int>
    nodes_in(const std::vector<bool> &set)
    {
      std::vector<unsigned int> nodes;
      for (unsigned int i = 0; i < set.size(); ++i)
        if (set[i])
          nodes.push_back(i);
      return nodes;
    }
  } // namespace



  void
  CondensedProblem::start_from(const std::vector<bool> &closed_nodes)
  {
    factored_set.clear(); // columns may be other ones now
    active = nodes_in(closed_nodes);
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
  CondensedProblem::factorise()
  {
    Set missing;
    for (const unsigned int i : active)
      if (columns[i].size() == 0)
        missing.push_back(i);
    if (!missing.empty())
      {
        const auto computed = compute_columns(missing);
        for (unsigned int k = 0; k < missing.size(); ++k)
          columns[missing[k]] = computed[k];
      }

    const unsigned int m = active.size();
    factor.reinit(m);
    factor.set_property(LAPACKSupport::symmetric);
    for (unsigned int i = 0; i < m; ++i)
      for (unsigned int j = 0; j < m; ++j)
        factor(i, j) =
          0.5 * (columns[active[j]](active[i]) + columns[active[i]](active[j]));
    factored_set.clear();
    try
      {
        factor.compute_cholesky_factorization();
      }
    catch (const std::exception &)
      {
        throw NumericalError(
          "The compliance of the crack lip is not positive definite for " +
          std::to_string(m) +
          " closed nodes: the stiffness is too ill-conditioned for a direct "
          "solver. Check the moduli of [Material] for extreme contrasts and "
          "the mesh for degenerate cells.");
      }
    factored_set = active;
  }



  void
  CondensedProblem::forces_that_close(const dealii::Vector<double> &w_0,
                                      dealii::Vector<double>       &forces)
  {
    forces = 0.;
    if (active.empty())
      return;
    if (active != factored_set)
      factorise();
    on_set.reinit(active.size(), true);
    for (unsigned int i = 0; i < active.size(); ++i)
      on_set(i) = -w_0(active[i]);
    factor.solve(on_set);
    for (unsigned int i = 0; i < active.size(); ++i)
      forces(active[i]) = on_set(i);
  }



  CondensedProblem::Set
  CondensedProblem::next_set(const dealii::Vector<double> &forces,
                             const dealii::Vector<double> &w,
                             const double                  rounding) const
  {
    Set          next;
    unsigned int k = 0; // walks along the active set
    for (unsigned int i = 0; i < n; ++i)
      {
        const bool is_active = k < active.size() && active[k] == i;
        k += is_active ? 1 : 0;
        // On the set w vanishes but for rounding, off it g is zero: the sign
        // of one number decides. A node with both zero stays where it is.
        if (is_active ? forces(i) >= -rounding / columns[i](i)
                      : w(i) < -rounding)
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
    return nodes_in(is_next);
  }

} // namespace Crevasse
