// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_contraction_h
#define crevasse_periodic_contraction_h

#include <crevasse/base/state_archive.h>

#include <optional>
#include <vector>

namespace Crevasse
{
  /**
   * Tells from the changes of a sequence how far it still is from its limit:
   * if they continue to shrink by λ the rest of them sums up to
   *
   *     change × λ / (1 − λ)       (Aitken)
   *
   * with the largest of the last four ratios for λ: where contact ceases at a
   * node or two the changes fall once or twice, and then continue as slowly as
   * before. A change alone says little: a slow approach makes small changes far
   * from its limit.
   *
   * What relaxes by a power n of itself decays like (n−1)th roots do, with
   * ratios that tend to 1: the k-th change is k^(−n/(n−1)), and the rest of
   * them is n times that sum in the limit.
   */
  class Contraction
  {
  public:
    /** @param exponent n; 1: what relaxes is linear. */
    explicit Contraction(const double exponent = 1.)
      : exponent(exponent)
    {
    }

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
    factor() const
    {
      return ratios.empty() ? std::numeric_limits<double>::quiet_NaN()
                            : *std::max_element(ratios.begin(), ratios.end());
    }

    void
    serialize(StateArchive &archive)
    {
      archive.common(last_change);
      archive.common(ratios);
    }

  private:
    static constexpr unsigned int n_ratios = 4;

    const double exponent;

    std::optional<double> last_change;
    std::vector<double>   ratios; ///< of the last changes, the newest last
  };

  /** 1/(1−λ) of what relaxes by itself, λ = exp(−T/τ): how many times the next
   * change it is from its limit.
   *
   * @param relaxed T/τ; less than 1e-4 counts as that: runs are much shorter.
   */
  double
  slowness_of_relaxation(const double relaxed);
} // namespace Crevasse

#endif
