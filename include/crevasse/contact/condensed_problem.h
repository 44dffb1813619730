// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_condensed_problem_h
#define crevasse_contact_condensed_problem_h

#include <crevasse/contact/problem_on_lip.h>

#include <functional>

namespace Crevasse
{
  /**
   * The linear complementarity problem on the lip,
   *
   *     g = Σ q − c,      0 ≤ s g ⟂ s q − gap ≥ 0,
   *
   * with the stiffness Σ of the lip (symmetric, positive definite) and a sign s
   * for each node. A primal–dual active set method solves it, started from the
   * last set (Hintermüller, Ito and Kunisch, SIAM J. Optim. 13, 2002); if a set
   * recurs, only the last wrong node changes at a time, which ends for every
   * positive definite Σ (Murty, Opsearch 11, 1974).
   */
  class CondensedProblem : public ProblemOnLip
  {
  public:
    /** Function that improves the next set by knowledge of the nodes beyond Σ:
     * see LipGraph::extrapolate(). */
    using Extrapolation = std::function<void(const std::vector<bool> &closed,
                                             std::vector<bool>       &next)>;

    /** @param stiffness Σ, which must outlive this object.
     * @param sign s of each node, 1 or -1. */
    CondensedProblem(const dealii::LAPACKFullMatrix<double> &stiffness,
                     const LipVector                        &sign,
                     const LipVector                        &gap,
                     const Extrapolation &extrapolation = {});

    /** Solves the problem, as ProblemOnLip::solve() says. @param[out]
     * displacement q, equal to the gap where closed. */
    unsigned int
    solve(const LipVector &loads, LipVector &displacement) override;

    std::vector<bool>
    closed_pairs() const override
    {
      return closed;
    }

    void
    start_from(const std::vector<bool> &closed_pairs) override
    {
      closed = closed_pairs;
    }

    std::string
    rescue() const override
    {
      return "node by node";
    }

  private:
    using Set = std::vector<bool>;

    /** Solves with the current closed nodes, and returns the next ones.
     *
     * @param rounding Tolerated negative force and opening, relative to their
     * sizes. */
    Set
    next_set(const LipVector &loads,
             LipVector       &displacement,
             const double     rounding);

    /** Product Σ_ij v_j of one row i of Σ with a vector. */
    double
    product_in_row(const unsigned int i, const LipVector &v) const;

    Set                 closed; ///< nodes of the last set
    const unsigned int  n;
    const LipVector     sign, gap;
    const Extrapolation extrapolation;
    LipVector           on_open;
  };
} // namespace Crevasse

#endif
