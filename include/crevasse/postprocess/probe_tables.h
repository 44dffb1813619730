// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_probe_tables_h
#define crevasse_postprocess_probe_tables_h

#include <crevasse/base/csv_table.h>
#include <crevasse/postprocess/probe.h>

namespace Crevasse
{
  /** Writes the tables of all probes. Ranks sum all probes in one message: one
   * message for each probe would take longer than the step. */
  template <int dim>
  class ProbeTables : public Observer
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
      std::vector<typename ProbeEvaluator<dim>::Values> values;
      for (const ProbeEvaluator<dim> &probe : probes)
        values.push_back(probe.local_values(sample));
      const dealii::ArrayView<double> all(values.front().data(),
                                          values.size() * values[0].size());
      dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(all),
                                  communicator,
                                  all);
      for (unsigned int k = 0; k < tables.size(); ++k)
        tables[k].add_row(probes[k].row(sample.time, values[k]));
    }

    /** Adds "probes" to the summary: their side of a crack with two lips. */
    void
    summarise(Summary &summary) override
    {
      for (const ProbeEvaluator<dim> &probe : probes)
        if (const auto &side = probe.side_of_crack)
          for (unsigned int d = 0; d < dim; ++d)
            summary["probes"][probe.name]["body_of_lip"].push_back((*side)[d]);
    }

  private:
    const std::vector<ProbeEvaluator<dim>> &probes;
    std::vector<CsvTable>                   tables;
    const MPI_Comm                          communicator;
  };
} // namespace Crevasse

#endif
