// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_growth_table_h
#define crevasse_parameters_growth_table_h

#include <map>
#include <string>
#include <vector>

namespace Crevasse
{
  /**
   * Measured growth da/dN(ΔK, R) of a crack: a curve for each ratio R. Between
   * the points of a curve ln(da/dN) is linear in ln(ΔK), between curves it is
   * linear in R. A curve may begin with da/dN = 0, its threshold; up to there
   * the crack does not grow.
   */
  class GrowthTable
  {
  public:
    /** @param file_name CSV file with the columns Delta_K,R,da_dN.
     * @throw SceneError with the file and what is wrong, FileError */
    explicit GrowthTable(const std::string &file_name);

    /** Growth over a period, in units of length; nan outside the table, which
     * a table with one R leaves for no R. */
    double
    growth(const double range, const double ratio) const;

  private:
    struct Curve
    {
      std::vector<double> ranges, growth; ///< ΔK, ascending, and da/dN

      double
      at(const double range) const;
    };

    std::map<double, Curve> curves; ///< by R
  };
} // namespace Crevasse

#endif
