// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_tables_h
#define crevasse_postprocess_tables_h

#include <crevasse/base/csv_table.h>
#include <crevasse/postprocess/lip_state.h>
#include <crevasse/postprocess/probe.h>
#include <crevasse/time/observer.h>

#include <memory>
#include <string>
#include <vector>

namespace Crevasse
{
  /** probe_<name>.csv: one row for each accepted step. */
  template <int dim>
  class ProbeTable : public Observer
  {
  public:
    /** @param file_name empty on ranks that do not write.
     * @param is_continuing see CsvTable. */
    ProbeTable(const ProbeEvaluator<dim> &probe,
               const std::string         &file_name,
               const bool                 is_continuing = false);

    void
    observe(const Sample &sample) override;

  private:
    const ProbeEvaluator<dim> &probe;
    std::unique_ptr<CsvTable>  table;
  };

  /** contact.csv: closed nodes, contact force and largest pressure. */
  template <int dim>
  class ContactTable : public Observer
  {
  public:
    /** @param of_last_period what the largest values are those of.
     * @param is_continuing see CsvTable.
     * @param opening_before the largest of the run on other meshes. */
    ContactTable(const ContactBoundary<dim> &lip,
                 const std::string          &file_name,
                 const bool                  of_last_period,
                 const bool                  is_continuing  = false,
                 const double                opening_before = 0.);

    void
    observe(const Sample &sample) override;

    void
    serialize(StateArchive &archive) override;

    /** summary.json "extremes": the largest opening. */
    void
    summarise(Summary &summary) override;

    /** The largest opening seen so far, or in the last period and on other
     * meshes. */
    double
    largest_opening() const;

    /** The largest displacement likewise, of the whole body. */
    double
    largest_displacement() const
    {
      return displacement;
    }

  private:
    const ContactBoundary<dim> &lip;
    const bool                  of_last_period;
    const double                opening_before;
    std::unique_ptr<CsvTable>   table;
    double                      opening      = 0.;
    double                      displacement = 0.;
  };

  /** periods.csv: how the run approached its periodic state, at which cost. */
  class PeriodTable : public Observer
  {
  public:
    explicit PeriodTable(const std::string &file_name,
                         const bool         is_continuing = false);

    void
    observe(const Sample &) override
    {
    }

    void
    end_of_period(const PeriodReport &report) override;

  private:
    std::unique_ptr<CsvTable> table;
  };
} // namespace Crevasse

#endif
