// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_projected_sor_h
#define crevasse_contact_projected_sor_h

#include <crevasse/contact/contact_solver.h>
#include <crevasse/contact/sweep.h>

namespace Crevasse
{
  /** The paper's solver: projected successive overrelaxation, started from the
   * last solution. On one process only. */
  class ProjectedSor : public ContactSolver
  {
  public:
    /** @param relaxation_factor In ]0,2[, where the method converges. */
    ProjectedSor(const SignoriniProblem &problem,
                 const double            relaxation_factor,
                 const double            tolerance,
                 const unsigned int      maximum_iterations);

    std::string
    description() const override;

  protected:
    std::size_t
    iterate(const Vector &right_hand_side, Vector &solution) override;

  private:
    const Sweep        sweep;
    const double       relaxation_factor;
    const unsigned int maximum_iterations;
  };
} // namespace Crevasse

#endif
