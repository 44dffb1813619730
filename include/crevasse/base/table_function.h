// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_table_function_h
#define crevasse_base_table_function_h

#include <functional>
#include <limits>
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
  class TableFunction
  {
  public:
    /** @param quantity name of x: t, theta, x, y or z.
     * @param is_monotone_cubic whether values between rows follow a monotone
     * cubic (PCHIP; Fritsch and Butland, SIAM J. Sci. Stat. Comput. 5, 1984),
     * for at least four rows without jumps; otherwise they are linear. */
    TableFunction(const std::string         &file,
                  const std::string         &quantity,
                  const std::vector<double> &x,
                  const std::vector<double> &y,
                  const bool                 is_monotone_cubic);

    const std::string         file, quantity;
    const std::vector<double> x, y;
    const double              least, largest; ///< of y

    /** Whether the scene calls the function. */
    bool is_called = false;

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
     * the straight line between them, relative to the range of the values. */
    struct Miss
    {
      double x          = 0.;
      double difference = 0.;
    };

    /** Row with the largest difference. @param end Just before a jump there. */
    Miss
    missed_between(const double begin, const double end) const;

    /** Least and largest x at which there was a value so far. */
    mutable double least_seen   = std::numeric_limits<double>::infinity();
    mutable double largest_seen = -std::numeric_limits<double>::infinity();

  private:
    /** Interpolation between the rows; empty: linear. */
    std::function<double(double)> cubic;
  };

  /** Functions of tables by their names. The formulas of a scene and its copies
   * share one object: TableParameters fills it before they are parsed, and
   * notes their calls; evaluation notes the x seen. */
  using TableFunctions = std::map<std::string, TableFunction>;
  using Tables         = std::shared_ptr<const TableFunctions>;
} // namespace Crevasse

#endif
