// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_lip_shift_h
#define crevasse_contact_lip_shift_h

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <map>
#include <vector>

namespace Crevasse
{
  /**
   * Shift c of a lip, the same at all instants of a period, with which the lip
   * has given mean contact forces. At the instant j the lip would be open by dⱼ
   * without contact forces; these are those of the complementarity problem
   *
   *     0 ≤ gⱼ ⟂ dⱼ + c + S gⱼ ≥ 0
   *
   * with the compliance S of the lip, and their mean is Σⱼ wⱼ gⱼ with weights
   * of each node. The mean falls as c grows. A semismooth Newton method finds
   * c; where it does not converge at once, the forces are changed step by step
   * from those of the lip as it is. All vectors have an entry for each lip node
   * of all ranks.
   */
  class LipShift
  {
  public:
    using LipVector = dealii::Vector<double>;

    /** @param stiffness Σ of the lip; S is its inverse.
     * @param weights w of each instant, by node; their sum is 1. */
    LipShift(const dealii::LAPACKFullMatrix<double> &stiffness,
             const std::vector<LipVector>           &weights);

    /** Mean of a force on each node over the period. */
    LipVector
    mean(const std::vector<LipVector> &forces) const;

    /**
     * Finds the shift.
     *
     * @param openings dⱼ of each instant.
     * @param target mean contact forces, none negative; where it is 0, the lip
     * is shifted as little as opens it.
     * @return c; if it was not found, the one of forces as close to the target
     * as was found.
     */
    LipVector
    solve(const std::vector<LipVector> &openings,
          const LipVector              &target) const;

    /**
     * Finds the shift of a lip that yields to its mean contact forces,
     *
     *     c = position + B (Σⱼ wⱼ gⱼ − force)
     *
     * by a semismooth Newton method with line search.
     *
     * @param B symmetric positive semidefinite.
     * @param[in,out] force of the position; on return, the mean.
     * @return c, or the best of what was found. */
    LipVector
    follow(const std::vector<LipVector>     &openings,
           const dealii::FullMatrix<double> &B,
           const LipVector                  &position,
           LipVector                        &force) const;

    /** Mean contact forces of lips with these openings without contact. */
    LipVector
    mean_force(const std::vector<LipVector> &openings) const;

    /** S */
    const dealii::LAPACKFullMatrix<double> &
    compliance() const
    {
      return inverse;
    }

    /** Number of calls of solve() and follow() that found no shift. */
    unsigned int
    n_unsolved() const
    {
      return unsolved;
    }

  private:
    using Set = std::vector<bool>;

    /** Solutions of all instants for openings dⱼ + c. */
    struct Response
    {
      LipVector                  mean;     ///< mean contact force
      dealii::FullMatrix<double> slope;    ///< minus its derivative by c
      std::vector<Set>           pressed;  ///< nodes that bear a force
      std::vector<LipVector>     openings; ///< dⱼ + c + S gⱼ
    };

    Response
    respond(const std::vector<LipVector> &openings, const LipVector &c) const;

    /** Adds factor × w × (S on the set)⁻¹ to a matrix. */
    void
    add_inverse(const Set                  &set,
                const LipVector            &weight,
                const double                factor,
                dealii::FullMatrix<double> &sum) const;

    /** Takes nodes that ought to bear a force, but do not touch, as touching
     * at the instant of their least opening: adds what this changes in the
     * slope and in the excess of the mean force. */
    void
    let_touch(const std::vector<LipVector> &openings,
              const LipVector              &c,
              const Set                    &idle,
              Response                     &response,
              LipVector                    &excess) const;

    /** Improves @p c by Newton's method.
     * @param small_force below which forces need no relative accuracy.
     * @return whether its mean forces are those of the target. */
    bool
    approach(const std::vector<LipVector> &openings,
             const LipVector              &target,
             const double                  small_force,
             LipVector                    &c) const;

    /** How far each node moves within the period, which bounds a step. */
    LipVector
    reach_of(const std::vector<LipVector> &openings) const;

    /** Solves for the step of Newton's method.
     * @param[in,out] excess of the mean force; then the step. */
    void
    find_correction(const Response &response, LipVector &excess) const;


    const unsigned int               n;
    const std::vector<LipVector>     weights;
    dealii::LAPACKFullMatrix<double> inverse;  ///< S
    LipVector                        diagonal; ///< of Σ
    mutable unsigned int             unsolved = 0;
  };
} // namespace Crevasse

#endif
