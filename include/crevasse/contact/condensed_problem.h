// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_condensed_problem_h
#define crevasse_contact_condensed_problem_h

#include <crevasse/linear/principal_factor.h>

#include <functional>

namespace Crevasse
{
  /**
   * The linear complementarity problem on the lip,
   *
   *     g = Σ q − c,      0 ≤ s g ⟂ s q − gap ≥ 0,
   *
   * with the stiffness Σ of the lip (symmetric, positive definite) and a sign s
   * for each node. It is solved by a primal–dual active set, started from the
   * last set (Hintermüller, Ito and Kunisch, SIAM J. Optim. 13, 2002); if a set
   * comes back, one node at a time changes, the last one that is wrong, which
   * ends on every positive definite Σ (Murty, Opsearch 11, 1974).
   */
  class CondensedProblem
  {
  public:
    using LipVector = dealii::Vector<double>;

    /** Improves the set that follows on another one, where more is known about
     * the nodes than Σ: see LipGraph::extrapolate(). */
    using Extrapolation = std::function<void(const std::vector<bool> &closed,
                                             std::vector<bool>       &next)>;

    /** @param stiffness Σ, which must outlive this object.
     * @param sign s, 1 or -1. */
    CondensedProblem(const dealii::LAPACKFullMatrix<double> &stiffness,
                     const LipVector                        &sign,
                     const LipVector                        &gap,
                     const Extrapolation &extrapolation = {});

    /**
     * @param loads c
     * @param[out] displacement q, the gap where closed.
     * @return the number of sets tried.
     * @throw NumericalError if Σ is found not to be positive definite.
     */
    unsigned int
    solve(const LipVector &loads, LipVector &displacement);

    /** Which nodes are closed: in the last solution or, set from outside, in
     * the first guess for the next one. */
    std::vector<bool> closed;

    /** Of Σ, for the open nodes. */
    PrincipalFactor factor;

    /** How often sets came back. */
    unsigned int
    n_rescues() const
    {
      return rescues;
    }

  private:
    using Set = std::vector<bool>;

    /** Solves for the closed nodes as they are, and returns those that forces
     * and openings call for.
     *
     * @param rounding how negative both may be, relative to their sizes. */
    Set
    next_set(const LipVector &loads,
             LipVector       &displacement,
             const double     rounding);

    /** Σ_ij v_j, for one i. */
    double
    product_in_row(const unsigned int i, const LipVector &v) const;

    const unsigned int  n;
    const LipVector     sign, gap;
    const Extrapolation extrapolation;
    LipVector           on_open;
    unsigned int        rescues = 0;
  };
} // namespace Crevasse

#endif
