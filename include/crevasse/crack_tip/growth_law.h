// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_growth_law_h
#define crevasse_crack_tip_growth_law_h

#include <crevasse/parameters/parameters.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace Crevasse
{
  /** What the tip of a crack has seen in the last period. */
  struct TipHistory
  {
    std::vector<double>   instants;  ///< from 0 to the period
    std::vector<double>   intensity; ///< K_I at these
    std::optional<double> c_star;    ///< C* of the steady flow, if it is known

    double
    period() const;
    double
    largest() const;
    double
    least() const;
  };

  /** How far a crack grows: something that depends on what its tip sees. */
  class GrowthLaw
  {
  public:
    virtual ~GrowthLaw() = default;

    /** Length by which the crack grows over the period; nan if the history
     * lacks what the law needs. A crack that is pressed together has K_I = 0.
     */
    virtual double
    per_cycle(const TipHistory &history) const = 0;

    /** For the log and the summary. */
    virtual std::string
    description() const = 0;
  };

  /** da/dN = C (ΔK − ΔK_th)^m above the threshold (Paris, Erdogan, J. Basic
   * Eng. 85, 1963; with a threshold: Donahue et al., Int. J. Fract. Mech. 8,
   * 1972), ΔK = K_max − K_min. */
  class ParisLaw : public GrowthLaw
  {
  public:
    ParisLaw(const double factor,
             const double exponent,
             const double threshold);

    double
    per_cycle(const TipHistory &history) const override;

    std::string
    description() const override;

  private:
    const double factor, exponent, threshold;
  };

  /** da/dt = D C*^φ, over the whole period. */
  class CreepLaw : public GrowthLaw
  {
  public:
    CreepLaw(const double factor, const double exponent);

    double
    per_cycle(const TipHistory &history) const override;

    std::string
    description() const override;

  private:
    const double factor, exponent;
  };

  /** da/dt = D K_I(t)^φ, by the trapezoidal rule over the steps. */
  class IntensityCreepLaw : public GrowthLaw
  {
  public:
    IntensityCreepLaw(const double factor, const double exponent);

    double
    per_cycle(const TipHistory &history) const override;

    std::string
    description() const override;

  private:
    const double factor, exponent;
  };

  /** Both grow the crack. */
  class SumOfLaws : public GrowthLaw
  {
  public:
    SumOfLaws(std::unique_ptr<const GrowthLaw> &&one,
              std::unique_ptr<const GrowthLaw> &&other);

    double
    per_cycle(const TipHistory &history) const override;

    std::string
    description() const override;

  private:
    const std::unique_ptr<const GrowthLaw> one, other;
  };

  /** The scene's law; null: none. */
  std::unique_ptr<const GrowthLaw>
  make_growth_law(const CrackTipParameters &parameters);

  /** Whether it is driven by C*. */
  bool
  needs_c_star(const CrackTipParameters &parameters);
} // namespace Crevasse

#endif
