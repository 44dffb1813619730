// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_conjugate_gradients_h
#define crevasse_linear_conjugate_gradients_h

#include <crevasse/linear/linear_solver.h>

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_control.h>

namespace Crevasse
{
  /** Base class of solvers by conjugate gradients, which differ in A and its
   * preconditioner. */
  class ConjugateGradients : public LinearSolver
  {
  public:
    /** Runs at most 1000 iterations of conjugate gradients; the caller judges
     * the result. Collective.
     *
     * @param A @p B Operator and preconditioner: f(product, v).
     * @param[in,out] solution Initial guess, then result.
     * @param residual_norm l₂ norm at which iterations end. */
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
    /** Multiplies by the operator: result = A v. */
    virtual void
    multiply(Vector &result, const Vector &v) const = 0;

    unsigned int
    apply_inverse(Vector       &solution,
                  const Vector &right_hand_side,
                  const double  residual_norm) override;

  private:
    /** Adapter that gives a function the interface of deal.II's operators. */
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
