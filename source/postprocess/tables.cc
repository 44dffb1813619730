// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/state_archive.h>
#include <crevasse/postprocess/tables.h>

#include <algorithm>

namespace Crevasse
{
  namespace
  {
    std::unique_ptr<CsvTable>
    open_table(const std::string              &file_name,
               const std::vector<std::string> &header,
               const bool                      is_continuing)
    {
      return file_name.empty()
               ? nullptr
               : std::make_unique<CsvTable>(file_name, header, is_continuing);
    }
  } // namespace



  template <int dim>
  ProbeTable<dim>::ProbeTable(const ProbeEvaluator<dim> &probe,
                              const std::string         &file_name,
                              const bool                 is_continuing)
    : probe(probe)
  {
    std::vector<std::string> header = {"t"};
    for (unsigned int d = 0; d < dim; ++d)
      header.push_back("u_" + std::to_string(d + 1));
    for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
      header.push_back(std::string("s_") + voigt_name<dim>(c));
    if (probe.on_lip())
      header.insert(header.end(), {"opening", "pressure"});
    table = open_table(file_name, header, is_continuing);
  }



  template <int dim>
  void
  ProbeTable<dim>::observe(const Sample &sample)
  {
    // Collective, also on ranks that do not write.
    auto       u      = probe.displacement(sample.state.displacement);
    const auto stress = probe.stress(sample.state.stress);
    auto       lip    = probe.opening_and_pressure(sample.state);
    if (sample.secular_flow != nullptr)
      {
        const auto drift =
          sample.time * probe.displacement(sample.secular_flow->velocity);
        u += drift;
        lip[0] += probe.normal_component(drift);
      }
    if (table == nullptr)
      return;

    std::vector<double> row = {sample.time};
    row.insert(row.end(), u.begin_raw(), u.end_raw());
    row.insert(row.end(), stress.begin_raw(), stress.end_raw());
    if (probe.on_lip())
      row.insert(row.end(), lip.begin(), lip.end());
    table->add_row(row);
  }



  template <int dim>
  ContactTable<dim>::ContactTable(const ContactBoundary<dim> &lip,
                                  const std::string          &file_name,
                                  const bool                  of_last_period,
                                  const bool                  is_continuing,
                                  const double                opening_before)
    : lip(lip)
    , of_last_period(of_last_period)
    , opening_before(opening_before)
    , table(open_table(file_name,
                       {"t", "closed_nodes", "force", "largest_pressure"},
                       is_continuing))
  {
  }



  template <int dim>
  void
  ContactTable<dim>::observe(const Sample &sample)
  {
    const LipState now = lip_state(lip, sample.state);
    if (of_last_period && sample.step == 0)
      opening = displacement = 0.;
    opening      = std::max(opening, now.largest_opening);
    displacement = std::max(displacement, now.largest_displacement);
    if (table != nullptr)
      table->add_row({sample.time,
                      double(now.closed_nodes),
                      now.force,
                      now.largest_pressure});
  }



  template <int dim>
  void
  ContactTable<dim>::serialize(StateArchive &archive)
  {
    archive.section("contact table");
    archive.common(opening);
    archive.common(displacement);
  }



  template <int dim>
  void
  ContactTable<dim>::summarise(Summary &summary)
  {
    summary["extremes"]["opening"] = largest_opening();
  }



  template <int dim>
  double
  ContactTable<dim>::largest_opening() const
  {
    return std::max(opening_before, opening);
  }



  PeriodTable::PeriodTable(const std::string &file_name,
                           const bool         is_continuing)
    : table(open_table(file_name,
                       {"period",
                        "t_end",
                        "stress_change",
                        "stress_error_estimate",
                        "vi_solves",
                        "seconds"},
                       is_continuing))
  {
  }



  void
  PeriodTable::end_of_period(const PeriodReport &report)
  {
    if (table != nullptr)
      table->add_row({double(report.period),
                      report.end_time,
                      report.stress_change,
                      report.stress_error_estimate,
                      double(report.vi_solves),
                      report.seconds});
  }



  template class ProbeTable<2>;
  template class ProbeTable<3>;
  template class ContactTable<2>;
  template class ContactTable<3>;
} // namespace Crevasse
