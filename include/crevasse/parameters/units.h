// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_units_h
#define crevasse_parameters_units_h

#include <crevasse/base/problems.h>

#include <string>
#include <vector>

namespace Crevasse
{
  /** Units in which a scene is written, for labels and warnings: the program
   * computes with numbers in any consistent units, and converts none. */
  class Units
  {
  public:
    /** A unit, and its size in SI units. */
    struct Unit
    {
      std::string name;
      double      size = 1.;
    };

    /** @param names of the units of length, stress, time and temperature, as in
     * "mm, MPa, h, K"; empty: not known. Names that are not known are added to
     * the problems. */
    explicit Units(const std::string &names, Problems *problems = nullptr);

    bool
    are_known() const
    {
      return !temperature.name.empty();
    }

    /** Both ends of a range of stress intensities as "2.1 to 7.2", followed by
     * their unit and, in brackets, the range in MPa sqrt(m). */
    std::string
    range_of_intensity(const double least, const double most) const;

    /** The units in words, for the log. */
    std::string
    describe() const;

    /** Sentences about sizes that no solid has in these units.
     *
     * @param diameter of the body
     * @param young_modulus the largest, in any direction
     * @param period of the loads */
    std::vector<std::string>
    doubts(const double diameter,
           const double young_modulus,
           const double period) const;

    /** MPa sqrt(m) in a unit of stress intensity. */
    double
    intensity_in_MPa() const;

    Unit length, stress, time, temperature;
  };
} // namespace Crevasse

#endif
