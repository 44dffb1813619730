// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_study_history_h
#define crevasse_study_history_h

#include <crevasse/study/measured_error.h>
#include <crevasse/study/quantity.h>

#include <string>
#include <vector>

namespace Crevasse
{
  /** A table that a run has written, read again. */
  class History
  {
  public:
    /** @throw FileError if the file cannot be read or is no table of numbers:
     * it was damaged. */
    explicit History(const std::string &file_name);

    const std::vector<std::string> &
    columns() const;

    /** nullptr: there is no such column. */
    const std::vector<double> *
    find(const std::string &column) const;

    /** The end of a period in periods.csv, t elsewhere. */
    const std::vector<double> &
    instants() const;

    /** Forgets all rows but those of the last period; a periods.csv is left as
     * it is. */
    void
    keep_last_period(const double period);

    /** Makes the first instant t = 0. */
    void
    begin_at_zero();

  private:
    void
    read_row(const std::string &line);

    const std::string                file_name;
    std::vector<std::string>         names;
    std::vector<std::vector<double>> values; ///< of each column
  };

  /** What of two histories is compared. */
  enum class Compared
  {
    whole_run,  ///< both march from the same rest
    last_period ///< the periods before are steps of a search
  };

  /**
   * The error of a quantity that is a column over time: the largest difference
   * over the largest value of the reference, at all instants compared that both
   * have, over all columns that the quantity stands for.
   *
   * @param reference folder; not used if the quantity has a closed form.
   * @param period of the loads.
   * @throw FileError for a damaged table.
   */
  MeasuredError
  history_error(const Quantity    &quantity,
                const std::string &folder,
                const std::string &reference,
                const double       period,
                const Compared     compared);
} // namespace Crevasse

#endif
