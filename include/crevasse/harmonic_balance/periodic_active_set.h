// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_harmonic_balance_periodic_active_set_h
#define crevasse_harmonic_balance_periodic_active_set_h

#include <crevasse/harmonic_balance/periodic_complementarity.h>
#include <crevasse/harmonic_balance/periodic_system.h>

#include <vector>

namespace Crevasse
{
  /**
   * Primal–dual active set for PeriodicContactProblem: with w = 0 at the nodes
   * and instants of the set, g = 0 at the others and the mean of g given, g and
   * c follow from one linear system; what then has tension leaves the set, what
   * penetrates enters it (Hintermüller, Ito and Kunisch, SIAM J. Optim. 13,
   * 2002). It mostly ends after a few sets, but need not.
   */
  class PeriodicActiveSet
  {
  public:
    /** For each of the p N entries, whether it is in the set. */
    using Set = std::vector<bool>;

    /** Keeps references.
     *
     * @param tolerance what is accepted of a set that does not settle, relative
     * to the scales of the problem: there, forces and openings both vanish but
     * for rounding.
     */
    PeriodicActiveSet(const PeriodicComplementarity &problem,
                      PeriodicSystem                &system,
                      const double                   tolerance);

    /** The set of the solution in which every node is by itself and elastic:
     * g_i = max(0, −(w⁰_i + c_i)) / S_ii with the mean asked for. */
    Set
    first_set() const;

    /** Where forces prevail over openings, both relative to their scales; at
     * least one instant for each node. */
    Set
    set_of(const PeriodicState &state) const;

    /**
     * @param set the first one tried
     * @param[in,out] state an approximation, if there is one; then the
     * solution, if found: refined by its residual.
     * @return whether it was found within so many sets, before one came back.
     * @throw NumericalError from PeriodicSystem.
     */
    bool
    solve(Set set, const unsigned int most_sets, PeriodicState &state);

    /** How many sets were tried in all. */
    unsigned int
    n_sets() const
    {
      return sets;
    }

  private:
    /** Solves on a set, starting from a state. */
    void
    solve_on(const Set &set, PeriodicState &state);

    /** Adds the solution for what a state leaves of the equations on the
     * system's set, to an accuracy relative to the scale of openings. */
    void
    correct(PeriodicState &state, const double accuracy);

    /** One step of iterative refinement; openings on the set become 0. */
    void
    refine(const Set &set, PeriodicState &state);

    /** The set that a state calls for; less than the margin calls for
     * nothing. */
    Set
    next_set(const Set           &set,
             const PeriodicState &state,
             const double         margin) const;

    /** The largest tension and penetration, relative to the scales. */
    double
    violation(const Set &set, const PeriodicState &state) const;

    /** Gives each node without an instant the one that prefers contact most. */
    void
    keep_one_instant(Set &set, const PeriodicState &state) const;

    const PeriodicComplementarity &problem;
    PeriodicSystem                &system;
    const double                   tolerance;
    const dealii::Vector<double>   no_diagonal;
    unsigned int                   sets = 0;
  };
} // namespace Crevasse

#endif
