// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_friction_problem_h
#define crevasse_contact_friction_problem_h

#include <crevasse/contact/problem_on_lip.h>
#include <crevasse/lip/contact_forces.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <tuple>

namespace Crevasse
{
  /** State of a pair of nodes on two lips: apart, or in contact without slip or
   * with it. */
  enum class SlipState : unsigned char
  {
    open,
    stick,
    slip
  };

  /**
   * The problem of Coulomb's friction on the lip, for one increment,
   *
   *     g = Σ q − c,      0 ≤ g_N ⟂ q_N − gap ≥ 0,
   *     |g_T| ≤ μ g_N,    g_T = −μ g_N δ/|δ| where δ = q_T − q_T^ref ≠ 0,
   *
   * with the stiffness Σ of the lip (symmetric, positive definite), the
   * openings q_N and the tangential jumps q_T of each pair, one in the plane
   * and two in space, and the jumps q_T^ref where the increment begins.
   *
   * An active set method on the states of pairs solves it, started from the
   * last states: a semismooth Newton method on the projections of Alart and
   * Curnier (Comput. Methods Appl. Mech. Engrg. 92, 1991), but for two rules. A
   * pair that slides back becomes stuck first, and never slides the other way
   * at once; what rounding alone would change stays as it is. In space a state
   * has the direction d of the slip: the force along it is −μ g_N, and that
   * across it −k δ, with a spring k that lets Newton's method turn d. If states
   * recur, Lemke's method finds states near a solution: see solve_by_lemke().
   */
  class FrictionProblem : public ProblemOnLip
  {
  public:
    /** Where a pair has its unknowns in Σ. A tangent is missing where supports
     * hold both sides. */
    struct Pair
    {
      unsigned int                normal;
      std::array<unsigned int, 2> tangents; ///< invalid_unsigned_int if missing
      double                      gap;

      bool
      has(const unsigned int tangent) const
      {
        return tangents[tangent] != dealii::numbers::invalid_unsigned_int;
      }

      unsigned int
      n_tangents() const
      {
        return (has(0) ? 1 : 0) + (has(1) ? 1 : 0);
      }
    };

    /** State of a pair, with what is known of its slip. */
    struct State
    {
      SlipState            kind = SlipState::stick;
      dealii::Tensor<1, 2> direction;   ///< along the slip
      double               spring = 0.; ///< spring k across it

      bool
      operator==(const State &other) const
      {
        return parts() == other.parts();
      }

      bool
      operator<(const State &other) const
      {
        return parts() < other.parts();
      }

      std::tuple<SlipState, double, double, double>
      parts() const
      {
        return {kind, direction[0], direction[1], spring};
      }
    };

    /** @param stiffness Σ, which must outlive this object.
     * @param pairs which have all unknowns of Σ. */
    FrictionProblem(const dealii::LAPACKFullMatrix<double> &stiffness,
                    const std::vector<Pair>                &pairs);

    /** Solves the problem, as ProblemOnLip::solve() says. @param[out] jumps q,
     * equal to the gap where closed, to q_T^ref where stuck. */
    unsigned int
    solve(const LipVector &loads, LipVector &jumps) override;

    std::vector<bool>
    closed_pairs() const override;

    /** Closed pairs stick in the first guess. */
    void
    start_from(const std::vector<bool> &closed_pairs) override;

    void
    serialize(StateArchive &archive) override;

    std::size_t
    memory_consumption() const override
    {
      return ProblemOnLip::memory_consumption() +
             states.size() * sizeof(State) +
             elimination.capacity() * sizeof(double);
    }

    std::string
    rescue() const override
    {
      return "by Lemke's method";
    }

    /**
     * Takes the states of a solution by Lemke's method with a polygon for the
     * limit of g_T: on the complementarity problem in g_N, the parts of g_T
     * along some directions, and the size of the slip (Stewart and Trinkle,
     * Int. J. Numer. Meth. Engng 39, 1996). Its matrix is copositive for every
     * μ ≥ 0, so that the method ends with a solution (Cottle, Pang and Stone,
     * theorem 4.4.13). In the plane, two directions are exact. The next solve
     * begins with these states.
     */
    void
    solve_by_lemke(const LipVector &loads, const unsigned int n_directions);

    const std::vector<Pair> pairs;

    /** Coefficient of friction of each pair and its q_T^ref along each tangent:
     * to be set. */
    FrictionState increment;

    /** States of the last solution, or the caller's first guess of the next. */
    std::vector<State> states;

  private:
    /** Finds the jumps for the states. */
    void
    solve_with_states(const LipVector &loads, LipVector &jumps);

    /** Fixes unknowns of closed pairs. @return whether friction acts on a pair
     * that slides. */
    bool
    fix_unknowns(std::vector<bool> &is_free);

    /** The states that jumps and forces call for. */
    std::vector<State>
    next_states(const LipVector &loads, const LipVector &jumps) const;

    const bool          in_plane; ///< whether only the first tangents exist
    LipVector           fixed, right_hand_side;
    std::vector<double> elimination; ///< work space in space
  };
} // namespace Crevasse

#endif
