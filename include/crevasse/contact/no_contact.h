// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_no_contact_h
#define crevasse_contact_no_contact_h

#include <crevasse/contact/contact_solver.h>

namespace Crevasse
{
  /** ContactSolver without bounds: A q = b is one linear solve, certified as
   * all others. */
  class NoContact : public ContactSolver
  {
  public:
    NoContact(const SignoriniProblem &problem,
              LinearSolver           &linear_solver,
              const double            tolerance)
      : ContactSolver(problem, tolerance)
      , linear_solver(linear_solver)
    {
    }

    std::string
    description() const override
    {
      return "no contact; " + linear_solver.description();
    }

  protected:
    std::size_t
    iterate(const Vector &right_hand_side, Vector &solution) override
    {
      solve_linear(linear_solver, right_hand_side, solution);
      return 1;
    }

  private:
    LinearSolver &linear_solver;
  };
} // namespace Crevasse

#endif
