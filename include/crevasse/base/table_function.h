// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_table_function_h
#define crevasse_base_table_function_h

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace Crevasse
{
  /**
   * A function given by rows of a table that ascend in x. An x given twice is a
   * jump; there the later row counts. The function repeats itself with the span
   * of the rows if x is the time t; otherwise the first and the last value are
   * held beyond the rows.
   */
  struct TableFunction
  {
    std::string         file;
    std::string         quantity; ///< name of x: t, theta, x, y or z
    std::vector<double> x, y;
    /** Interpolation between the rows; empty: linear. */
    std::function<double(double)> cubic;

    /** Interpolates by a monotone cubic (PCHIP; Fritsch and Butland, SIAM J.
     * Sci. Stat. Comput. 5, 1984), for at least four rows without jumps. */
    void
    make_monotone_cubic();

    /** Value at @p at; NaN unless it is finite. */
    double
    operator()(double at) const;

    bool
    is_of_time() const
    {
      return quantity == "t";
    }

    /** Whether an x is given twice. */
    bool
    can_jump() const;

    /** A row between the ends of a step, and the difference of its value from
     * the straight line between them. */
    struct Miss
    {
      double x          = 0.;
      double difference = 0.;
    };

    /** Row with the largest difference. @param end Just before a jump there. */
    Miss
    missed_between(const double begin, const double end) const;
  };

  /** Functions of tables by their names, which formulas share. */
  using TableFunctions = std::map<std::string, TableFunction>;
  using Tables         = std::shared_ptr<const TableFunctions>;
} // namespace Crevasse

#endif
