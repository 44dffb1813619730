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
   * Estimates the distance of a sequence to its limit from its changes: if
   * these continue to shrink by λ, the remaining changes add up to
   *
   *     change × λ / (1 − λ)       (Aitken).
   *
   * Here λ is the largest of the last four ratios of changes: where contact
   * ceases at a node or two, the changes drop once or twice, and then shrink as
   * slowly as before. A single change says little: a slow approach has small
   * changes far from its limit.
   *
   * Stress that relaxes by a power law of exponent n decays like k^(−1/(n−1)):
   * the k-th change is k^(−n/(n−1)), with ratios that tend to 1, and the
   * remaining changes add up to n times Aitken's value in the limit.
   */
  class Contraction
  {
  public:
    /** @param exponent of the creep law where the stress vanishes; 1:
     * relaxation is linear. */
    explicit Contraction(const double exponent = 1.)
      : exponent(exponent)
    {
    }

    /** Adds the next change, relative to the size of the sequence's terms.
     *
     * @param counts false for the first term itself, which enters no ratio.
     * @param accuracy what rounding may leave of the terms: changes below it
     * need not shrink, and ratios of them are meaningless.
     * @return the distance to the limit; nan if there is no ratio yet or the
     * changes do not shrink. */
    double
    add(const double change,
        const bool   counts   = true,
        const double accuracy = 0.);

    /** Contraction λ, the largest of the last ratios; nan without a ratio. */
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
    std::vector<double>   ratios; ///< ratios of successive changes, newest last
  };

  /** 1/(1−λ) with λ = exp(−T/τ): ratio of the distance to the limit to the next
   * change, for stress that relaxes by itself.
   *
   * @param relaxed T/τ, raised to 1e-4 if smaller: runs are much shorter. */
  double
  slowness_of_relaxation(const double relaxed);
} // namespace Crevasse

#endif
