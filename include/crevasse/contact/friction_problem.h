// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_friction_problem_h
#define crevasse_contact_friction_problem_h

#include <crevasse/linear/principal_factor.h>

namespace Crevasse
{
  /** State of a pair of nodes on two lips: apart, or in contact without slip,
   * with slip along the tangent, or against it. */
  enum class SlipState : unsigned char
  {
    open,
    stick,
    forward,
    backward
  };

  /**
   * The problem of Coulomb's friction on the lip, for one increment,
   *
   *     g = Σ q − c,      0 ≤ g_N ⟂ q_N − gap ≥ 0,
   *     |g_T| ≤ μ g_N,    g_T = −μ g_N sign δ where δ = q_T − q_T^ref ≠ 0,
   *
   * with the stiffness Σ of the lip (symmetric, positive definite), the
   * openings q_N and the tangential jumps q_T of each pair, and the jumps
   * q_T^ref where the increment begins.
   *
   * An active set method on the states of pairs solves it, started from the
   * last states: a semismooth Newton method on the projections of Alart and
   * Curnier (Comput. Methods Appl. Mech. Engrg. 92, 1991), but for two rules. A
   * pair that slides back becomes stuck first, and never slides the other way
   * at once; what rounding alone would change stays as it is. If states recur,
   * Lemke's method finds a solution: see solve_by_lemke().
   */
  class FrictionProblem
  {
  public:
    using LipVector = dealii::Vector<double>;

    /** Where a pair has its unknowns in Σ. Without a tangent, as where supports
     * hold both sides, it never slides. */
    struct Pair
    {
      unsigned int normal, tangent;
      double       gap;

      bool
      may_slide() const
      {
        return tangent != dealii::numbers::invalid_unsigned_int;
      }
    };

    /** Of an increment: coefficients of friction and q_T^ref of each pair. */
    struct Increment
    {
      std::vector<double> coefficients, reference;
    };

    /** @param stiffness Σ, which must outlive this object.
     * @param pairs which have all unknowns of Σ. */
    FrictionProblem(const dealii::LAPACKFullMatrix<double> &stiffness,
                    const std::vector<Pair>                &pairs);

    /**
     * @param loads c
     * @param[out] jumps q, equal to the gap where closed, to q_T^ref where
     * stuck.
     * @return the number of sets of states tried.
     * @throw NumericalError if there is none that solves the problem.
     */
    unsigned int
    solve(const LipVector &loads, const Increment &increment, LipVector &jumps);

    /** Bytes, without Σ. */
    std::size_t
    memory_consumption() const
    {
      return factor.memory_consumption() + states.size() * sizeof(SlipState);
    }

    /** The largest violation of the conditions: forces relative to the largest
     * |c| or |Σ_ii q_i|, jumps to the largest |q_i| or |c_i / Σ_ii|. */
    double
    violation(const LipVector &loads,
              const Increment &increment,
              const LipVector &jumps) const;

    /** Of the last solution, or set by the caller for the next solve. */
    std::vector<SlipState> states;

    /** Number of solves that needed Lemke's method. */
    unsigned int
    n_rescues() const
    {
      return rescues;
    }

    PrincipalFactor factor; ///< of Σ for the free unknowns

  private:
    /** Finds the jumps for the states. */
    void
    solve_with_states(const LipVector &loads,
                      const Increment &increment,
                      LipVector       &jumps);

    /** The states that jumps and forces call for. */
    std::vector<SlipState>
    next_states(const LipVector &loads,
                const Increment &increment,
                const LipVector &jumps) const;

    /** Takes the states of a solution by Lemke's method on the complementarity
     * problem in g_N, the parts of g_T along and against the tangent, and the
     * size of the slip (Stewart and Trinkle, Int. J. Numer. Meth. Engng 39,
     * 1996). Its matrix is copositive for every μ ≥ 0, so that the method ends
     * with a solution (Cottle, Pang and Stone, theorem 4.4.13). */
    void
    solve_by_lemke(const LipVector &loads, const Increment &increment);

    const std::vector<Pair> pairs;
    LipVector               fixed, right_hand_side;
    unsigned int            rescues = 0;
  };
} // namespace Crevasse

#endif
