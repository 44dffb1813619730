// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_conjugate_gradients_h
#define crevasse_linear_conjugate_gradients_h

#include <crevasse/linear/linear_solver.h>

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_control.h>

namespace Crevasse
{
  /** What all solvers by conjugate gradients have in common: they differ in A
   * and its preconditioner. */
  class ConjugateGradients : public LinearSolver
  {
  public:
    /** At most 1000 iterations; what they reached is judged by the caller.
     * Collective.
     *
     * @param A @p B the operator and its preconditioner: f(product, v).
     * @param[in,out] solution where they start and end.
     * @param residual_norm the l₂ norm at which they end. */
    template <typename Operator, typename Preconditioner>
    static dealii::SolverControl
    iterate(const Operator       &A,
            const Preconditioner &B,
            Vector               &solution,
            const Vector         &right_hand_side,
            const double          residual_norm)
    {
      dealii::SolverControl control(1000, residual_norm);
      try
        {
          dealii::SolverCG<Vector>(control).solve(Product<Operator>{A},
                                                  solution,
                                                  right_hand_side,
                                                  Product<Preconditioner>{B});
        }
      catch (const dealii::SolverControl::NoConvergence &)
        {
        }
      return control;
    }

    bool
    is_direct() const override
    {
      return false;
    }

    std::string
    description() const override
    {
      return "conjugate gradients with " + preconditioner_description();
    }

  protected:
    /** result = A v */
    virtual void
    multiply(Vector &result, const Vector &v) const = 0;

    unsigned int
    apply_inverse(Vector       &solution,
                  const Vector &right_hand_side,
                  const double  residual_norm) override;

  private:
    /** As deal.II wants it. */
    template <typename Function>
    struct Product
    {
      void
      vmult(Vector &result, const Vector &v) const
      {
        f(result, v);
      }

      const Function &f;
    };
  };
} // namespace Crevasse

#endif
