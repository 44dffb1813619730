// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/simulation/run.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** missions.csv: the largest and the smallest values of each mission. */
    class MissionTable : public Observer
    {
    public:
      using Number = std::function<double()>;

      /** A number at the last sample, and whether its smallest value counts. */
      struct Quantity
      {
        std::string name;
        Number      now;
        bool        has_smallest;
      };

      MissionTable(CsvTable &&table, const std::vector<Quantity> &quantities)
        : table(std::move(table))
        , quantities(quantities)
        , ranges(quantities.size())
      {
      }

      static std::vector<std::string>
      columns(const std::vector<Quantity> &quantities)
      {
        std::vector<std::string> names = {"mission", "evaluations"};
        for (const Quantity &quantity : quantities)
          {
            names.push_back(quantity.name + "_largest");
            if (quantity.has_smallest)
              names.push_back(quantity.name + "_smallest");
          }
        names.emplace_back("stress_largest");
        return names;
      }

      void
      observe(const Sample &sample) override
      {
        for (unsigned int i = 0; i < ranges.size(); ++i)
          {
            const double now    = quantities[i].now();
            auto &[least, most] = ranges[i];
            least               = sample.step == 0 ? now : std::min(least, now);
            most                = sample.step == 0 ? now : std::max(most, now);
          }
      }

      void
      before_jump(const Sample &sample) override
      {
        observe(sample);
      }

      void
      end_of_period(const PeriodReport &report) override
      {
        if (report.mission == 0)
          return;
        std::vector<double> row = {double(report.mission),
                                   double(report.period)};
        for (unsigned int i = 0; i < ranges.size(); ++i)
          {
            row.push_back(ranges[i].second);
            if (quantities[i].has_smallest)
              row.push_back(ranges[i].first);
          }
        row.push_back(report.largest_stress);
        table.add_row(row);
      }

      void
      serialize(StateArchive &archive) override
      {
        for (auto &[least, most] : ranges)
          {
            archive.common(least);
            archive.common(most);
          }
      }

    private:
      CsvTable                               table;
      const std::vector<Quantity>            quantities;
      std::vector<std::pair<double, double>> ranges; ///< of this period
    };
  } // namespace



  template <int dim>
  void
  Run<dim>::make_goal(
    const LipTotals                                                 &lip,
    const std::vector<const TipTable *>                             &tips,
    const std::function<CsvTable(const std::string &,
                                 const std::vector<std::string> &)> &table)
  {
    const PeriodicStateParameters &parameters = scene.periodic_state;
    const auto opening = [&lip] { return lip.largest_opening; };
    if (!parameters.missions.empty())
      {
        std::vector<MissionTable::Quantity> columns;
        for (unsigned int i = 0; i < tips.size(); ++i)
          columns.push_back(
            {"K_I" + (tips.size() > 1 ? "_" + std::to_string(i + 1) : ""),
             [tip = tips[i]] { return tip->latest().intensity[0]; },
             true});
        if (body.effects.contact.on)
          columns.push_back({"opening", opening, false});
        observers.push_back(std::make_unique<MissionTable>(
          table("missions.csv", MissionTable::columns(columns)), columns));
      }
    const std::string &name = parameters.converged_quantity;
    if (!parameters.missions.empty() || name == "stress")
      return;
    ConvergedQuantity::Values values = [opening](const Sample &) {
      return std::vector<double>{opening()};
    };
    if (name == "K_I")
      values = [tips](const Sample &) {
        std::vector<double> all;
        for (const TipTable *tip : tips)
          all.push_back(tip->latest().intensity[0]);
        return all;
      };
    for (const auto &probe : probes)
      if (name == "probe " + probe.name)
        values = [&probe, this](const Sample &sample) {
          const auto                local = probe.local_values(sample);
          const std::vector<double> stress(local.begin() + dim,
                                           local.end() - 2);
          std::vector<double>       all(stress.size());
          Utilities::MPI::sum(stress, body.space.communicator(), all);
          return all;
        };
    constexpr double rounding = 1e-12;
    auto             observer =
      std::make_unique<ConvergedQuantity>(values, rounding * steps.period());
    quantity = observer.get();
    observers.push_back(std::move(observer));
  }



  template void
  Run<2>::make_goal(
    const LipTotals &,
    const std::vector<const TipTable *> &,
    const std::function<CsvTable(const std::string &,
                                 const std::vector<std::string> &)> &);
  template void
  Run<3>::make_goal(
    const LipTotals &,
    const std::vector<const TipTable *> &,
    const std::function<CsvTable(const std::string &,
                                 const std::vector<std::string> &)> &);
} // namespace Crevasse
