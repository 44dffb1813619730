// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_range_h
#define crevasse_base_range_h

#include <crevasse/base/text.h>

#include <deal.II/base/patterns.h>

#include <limits>
#include <memory>

namespace Crevasse
{
  /** Interval of allowed values of a quantity, with its description. */
  struct Range
  {
    double      least, most;
    const char *words; ///< words, "greater than 0"

    /** Whether the value is in the range; false for NaN. */
    constexpr bool
    contains(const double value) const
    {
      return value >= least && value <= most;
    }

    std::string
    text() const
    {
      return std::string("must be ") + words;
    }
  };

  namespace Ranges
  {
    /** Bounds of the size of a quantity: products of four quantities, as in
     * squares of norms, must not overflow or underflow. */
    constexpr double smallest = 1e-70, largest = 1e70;
    /** Closest numbers to the excluded bounds 0 and 1. */
    constexpr double above_0 = std::numeric_limits<double>::min();
    constexpr double below_1 = 1. - std::numeric_limits<double>::epsilon();

    constexpr Range size     = {smallest, largest, "from 1e-70 to 1e70"};
    constexpr Range positive = {smallest,
                                largest,
                                "greater than 0, from 1e-70 to 1e70"};
    // Creep coefficients have the unit of stress to the power -n.
    constexpr Range coefficient  = {1e-300,
                                    1e300,
                                    "greater than 0, from 1e-300 to 1e300"};
    constexpr Range not_negative = {0.,
                                    std::numeric_limits<double>::max(),
                                    "of at least 0"};
    constexpr Range any_number   = {-largest, largest, "from -1e70 to 1e70"};
    constexpr Range fraction     = {0., below_1, "of at least 0, less than 1"};

    // Close to -1 the bulk modulus vanishes against the shear modulus and is
    // lost to rounding.
    constexpr double least_ratio    = -0.999;
    constexpr Range  elastic_ratio  = {least_ratio,
                                       0.5 - 1e-15,
                                       "at least -0.999 and less than 0.5"};
    constexpr Range  viscous_ratio  = {least_ratio,
                                       0.5,
                                       "at least -0.999 and at most 0.5"};
    constexpr Range  creep_exponent = {1., 50., "at least 1 and at most 50"};
  } // namespace Ranges

  /** Pattern of ParameterHandler for a number in a range, described by its
   * bounds and in words. */
  class NumberPattern : public dealii::Patterns::PatternBase
  {
  public:
    NumberPattern(const Range &range)
      : range(range)
    {
    }

    bool
    match(const std::string &text) const override
    {
      const auto number = Text::to_number(text);
      return number && range.contains(*number);
    }

    std::string
    description(const OutputStyle = Machine) const override
    {
      return "[Number range " + Text::from_number(range.least) + "..." +
             Text::from_number(range.most) + " (" + range.words + ")]";
    }

    std::unique_ptr<PatternBase>
    clone() const override
    {
      return std::make_unique<NumberPattern>(*this);
    }

  private:
    const Range range;
  };
} // namespace Crevasse

#endif
