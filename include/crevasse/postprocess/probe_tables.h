// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_probe_tables_h
#define crevasse_postprocess_probe_tables_h

#include <crevasse/base/csv_table.h>
#include <crevasse/base/series_extremes.h>
#include <crevasse/postprocess/probe.h>
#include <crevasse/time/period_observer.h>

namespace Crevasse
{
  /** Writes the tables of all probes. Ranks sum all probes in one message: one
   * message for each probe would take longer than the step. */
  template <int dim>
  class ProbeTables : public PeriodObserver
  {
  public:
    /** @param probes must outlive the ProbeTables.
     * @param tables one for each probe, with its columns. */
    ProbeTables(const std::vector<ProbeEvaluator<dim>> &probes,
                std::vector<CsvTable>                 &&tables,
                const MPI_Comm                          communicator)
      : probes(probes)
      , tables(std::move(tables))
      , communicator(communicator)
    {
    }

    void
    observe(const Sample &sample) override
    {
      PeriodObserver::observe(sample);
      for (unsigned int k = 0; k < tables.size(); ++k)
        tables[k].add_row(rows.back()[k]);
    }

    void
    serialize(StateArchive &archive) override
    {
      archive.section("probes");
      PeriodObserver::serialize(archive);
      rows.resize(instants.size());
      for (auto &row : rows)
        {
          row.resize(probes.size());
          for (auto &of_probe : row)
            archive.common(of_probe);
        }
    }

    /** Adds "probes" to the summary: the extremes of their columns in the last
     * period, and their side of a crack with two lips. */
    void
    summarise(Summary &summary) override
    {
      for (unsigned int k = 0; k < probes.size(); ++k)
        {
          Summary &probe = summary["probes"][probes[k].name];
          if (const auto &side = probes[k].side_of_crack)
            for (unsigned int d = 0; d < dim; ++d)
              probe["body_of_lip"].push_back((*side)[d]);
          const auto columns = probes[k].columns();
          for (unsigned int i = 1; i < columns.size() && !rows.empty(); ++i)
            {
              std::vector<double> series;
              for (const auto &row : rows)
                series.push_back(row[k][i]);
              const SeriesExtremes extremes(instants, series);
              probe[columns[i]] = {{"largest", extremes.largest.value},
                                   {"smallest", extremes.least.value}};
            }
        }
    }

  private:
    void
    clear() override
    {
      rows.clear();
    }

    void
    insert(const Sample &sample, const std::size_t i) override
    {
      std::vector<typename ProbeEvaluator<dim>::Values> values;
      for (const ProbeEvaluator<dim> &probe : probes)
        values.push_back(probe.local_values(sample));
      const dealii::ArrayView<double> all(values.front().data(),
                                          values.size() * values[0].size());
      dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(all),
                                  communicator,
                                  all);
      std::vector<std::vector<double>> row;
      for (unsigned int k = 0; k < tables.size(); ++k)
        row.push_back(probes[k].row(sample.time, values[k]));
      rows.insert(rows.begin() + i, row);
    }

    const std::vector<ProbeEvaluator<dim>> &probes;
    std::vector<CsvTable>                   tables;
    const MPI_Comm                          communicator;

    std::vector<std::vector<std::vector<double>>> rows; ///< by instant, probe
  };
} // namespace Crevasse

#endif
