// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_sweep_h
#define crevasse_contact_sweep_h

#include <crevasse/contact/signorini_problem.h>

#include <memory>
#include <vector>

namespace Crevasse
{
  /** Groups of at most three unknowns that are relaxed together: those of a
   * node. Each unknown is in one group. */
  using UnknownBlocks =
    std::vector<std::vector<dealii::types::global_dof_index>>;

  /** How far some sweeps have come. */
  struct SweepCount
  {
    unsigned int sweeps           = 0;
    double       largest_residual = 0.; ///< see Sweep
  };

  /** One sweep of successive overrelaxation in natural order, with projection
   * on the bounds. */
  class Sweep
  {
  public:
    virtual ~Sweep() = default;

    /**
     * Overwrites @p solution by the next iterate and returns the largest
     * residual of a row when its turn came (a force; infinity if the iterate is
     * not finite). Rows that the projection holds at their bound count by what
     * they still move. It is cheap and close to, but not, the certificate.
     */
    virtual double
    operator()(const Vector &right_hand_side,
               Vector       &solution,
               const double  relaxation_factor) const = 0;

    /** Sweeps until that residual is at most @p target, or not finite, but no
     * more often than @p maximum_sweeps. */
    virtual SweepCount
    sweep_until(const Vector      &right_hand_side,
                Vector            &solution,
                const double       relaxation_factor,
                const double       target,
                const unsigned int maximum_sweeps) const;
  };

  /** Unknown by unknown, or block by block if there are any on any rank.
   * Collective. @param blocks of this rank. */
  std::unique_ptr<const Sweep>
  make_sweep(const SignoriniProblem &problem, const UnknownBlocks &blocks);

  /** The same for a problem that is on one rank as a whole. */
  std::unique_ptr<const Sweep>
  make_local_sweep(const SignoriniProblem &problem,
                   const UnknownBlocks    &blocks);
} // namespace Crevasse

#endif
