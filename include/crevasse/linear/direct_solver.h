// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_direct_solver_h
#define crevasse_linear_direct_solver_h

#include <crevasse/linear/linear_solver.h>

#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <functional>

namespace Crevasse
{
  /**
   * Base class of solvers by a factorisation: a solve is exact and costs a
   * back-solve. The unknowns of the lip are eliminated last. With all other
   * unknowns, I, eliminated, a problem on the lip alone remains,
   *
   *     Σ q_L = c,      Σ = A_LL − A_LI A_II⁻¹ A_IL,
   *                     c = b_L − A_LI A_II⁻¹ b_I,
   *
   * which may be solved under any constraints on the lip, between forward and
   * backward substitution.
   */
  class DirectSolver : public LinearSolver
  {
  public:
    using Indices   = std::vector<dealii::types::global_dof_index>;
    using LipVector = dealii::Vector<double>;

    /** Function that solves a problem on the lip: overwrites c by q_L. */
    using LipProblem = std::function<void(LipVector &on_lip)>;

    /** @param lip Unknowns of the lip on all ranks, the same list on each. */
    explicit DirectSolver(const Indices &lip)
      : lip(lip)
    {
    }

    /** Solves A q = b, where @p lip_problem solves for the lip, whose unknowns
     * have the order of the constructor's argument. Each rank solves the
     * problem on the lip. Counts as one solve. Collective. */
    virtual void
    solve_with_lip(Vector           &solution,
                   const Vector     &right_hand_side,
                   const LipProblem &lip_problem) = 0;

    /** Condensed stiffness Σ of the lip, on all ranks. */
    const dealii::LAPACKFullMatrix<double> &
    lip_stiffness() const
    {
      return schur_complement;
    }

    bool
    is_direct() const override
    {
      return true;
    }

    const Indices lip;

  protected:
    unsigned int
    apply_inverse(Vector       &solution,
                  const Vector &right_hand_side,
                  const double) override
    {
      precondition(solution, right_hand_side);
      return 0;
    }

    dealii::LAPACKFullMatrix<double> schur_complement; ///< Σ
  };
} // namespace Crevasse

#endif
