// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_root_sweep_h
#define crevasse_contact_root_sweep_h

#include <crevasse/contact/sweep.h>

#include <Epetra_Import.h>
#include <Epetra_Map.h>
#include <memory>

namespace Crevasse
{
  /**
   * A sweep in natural order through a problem on several ranks: the first rank
   * has a copy of the whole problem and sweeps, the others wait. That is no
   * way to solve large problems, but the paper's method on as many ranks as
   * there are.
   */
  class RootSweep : public Sweep
  {
  public:
    /** @param blocks of this rank. Collective. */
    RootSweep(const SignoriniProblem &problem, const UnknownBlocks &blocks);

    double
    operator()(const Vector &right_hand_side,
               Vector       &solution,
               const double  relaxation_factor) const override;

    SweepCount
    sweep_until(const Vector      &right_hand_side,
                Vector            &solution,
                const double       relaxation_factor,
                const double       target,
                const unsigned int maximum_sweeps) const override;

  private:
    /** Into the layout with all entries on the first rank. */
    Vector
    at_root(const Vector &distributed) const;

    void
    from_root(const Vector &all, Vector &distributed) const;

    const Epetra_Map                   rows;
    const Epetra_Map                   rows_at_root;
    const Epetra_Import                importer;
    const SparseMatrix                 matrix;
    const UnilateralBounds             bounds;
    const SignoriniProblem             problem;
    const std::unique_ptr<const Sweep> sweep;
  };
} // namespace Crevasse

#endif
