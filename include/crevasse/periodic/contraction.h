// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------


#ifndef crevasse_periodic_contraction_h
#define crevasse_periodic_contraction_h

#include <optional>

namespace Crevasse
{
  class StateArchive;

  /**
   * Tells from the changes of a sequence how far it still is from its limit:
   * if they go on to shrink by λ the rest of them sums up to
   *
   *     change × λ / (1 − λ)       (Aitken)
   *
   * with the larger one of the last two ratios for λ. A change alone says
   * little: a slow approach makes small changes far from its limit.
   */
  class Contraction
  {
  public:
    /** Takes the next change, relative to the size of what changes.
     *
     * @param counts whether it is one of the sequence: the first, from nothing
     * at all, is not.
     * @return the distance to the limit; nan while it cannot be told, because
     * there is no ratio yet or the changes do not shrink. */
    double
    add(const double change, const bool counts = true);

    /** λ; nan while it cannot be told. */
    double
    factor() const;

    void
    serialize(StateArchive &archive);

  private:
    std::optional<double> last_change;
    std::optional<double> ratio, ratio_before; ///< of the last changes
  };
} // namespace Crevasse

#endif
