// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_aligned_steps_h
#define crevasse_time_aligned_steps_h

namespace Crevasse
{
  /**
   * Steps that are a unit times a power of two, and that grow only at multiples
   * of themselves: few different ones, each of which costs an implicit method a
   * factorisation, and all multiples of the unit are met exactly.
   */
  class AlignedSteps
  {
  public:
    explicit AlignedSteps(const double unit);

    /** The largest such step of at most @p wish that may begin at @p t; off
     * the grid of steps of that size, the largest without regard to @p t.
     *
     * @param last the step before; the next is from 1/8 to 8 times as long. */
    double
    next(const double t, const double last, const double wish) const;

  private:
    const double unit;
  };
} // namespace Crevasse

#endif
