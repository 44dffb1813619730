// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_unconstrained_h
#define crevasse_contact_unconstrained_h

#include <crevasse/contact/contact_solver.h>
#include <crevasse/linear/linear_solver.h>

namespace Crevasse
{
  /** A problem without bounds: one linear solve, certified like any other. */
  class Unconstrained : public ContactSolver
  {
  public:
    Unconstrained(const SignoriniProblem &problem,
                  LinearSolver           &linear_solver,
                  const double            tolerance);

    std::string
    description() const override;

  protected:
    std::size_t
    iterate(const Vector &right_hand_side, Vector &solution) override;

    bool
    can_refine() const override;

  private:
    LinearSolver &linear_solver;
  };
} // namespace Crevasse

#endif
