// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_creep_integral_table_h
#define crevasse_postprocess_creep_integral_table_h

#include <crevasse/base/csv_table.h>
#include <crevasse/base/series_extremes.h>
#include <crevasse/base/text.h>
#include <crevasse/crack_tip/creep_integral.h>
#include <crevasse/crack_tip/growth_law.h>
#include <crevasse/time/observer.h>
#include <crevasse/time/step_list.h>

namespace Crevasse
{
  /**
   * creep_integral.csv: C(t) at each accepted step, with the error that two
   * squares and two differences in time show.
   *
   * The velocity is the difference of second order over the last two steps;
   * there is no row before two steps are done after a jump. If the difference
   * of first order deviates by a part δ, the error is of order δ².
   */
  class CreepIntegralTable : public Observer
  {
  public:
    /** References must outlive the CreepIntegralTable. Collective.
     *
     * @param periods_are_iterates whether the state jumps between periods.
     * @param table with the columns(). */
    CreepIntegralTable(const Scene         &scene,
                       const CreepIntegral &integral,
                       const StepList      &steps,
                       const bool           periods_are_iterates,
                       CsvTable           &&table,
                       Log                 &log)
      : law(scene.crack_tip)
      , integral(integral)
      , steps(steps)
      , periods_are_iterates(periods_are_iterates)
      , log(log)
      , table(std::move(table))
    {
      require_growth_constants(law,
                               integral.body.temperature,
                               integral.region.tip.position,
                               steps);
      for (Vector &displacement : before)
        integral.body.strain_operator.initialize(displacement);
    }

    static std::vector<std::string>
    columns(const Body<2> &body)
    {
      std::vector<std::string> names = {"t", "C_t", "C_t_error"};
      if (has_temperature(body))
        names.emplace_back("theta");
      return names;
    }

    void
    observe(const Sample &sample) override
    {
      if (sample.step == 0)
        {
          history.instants.clear();
          history.creep_integral.clear();
          history.temperatures.clear();
          errors.clear();
        }
      if ((sample.step == 0 &&
           (periods_are_iterates || steps.jumps_at(steps.period()))) ||
          steps.jumps_at(sample.instant))
        n_before = 0;
      const auto [value, error] =
        n_before < 2 ? std::array<double, 2>{{not_known, not_known}}
                     : evaluate(sample);
      history.instants.push_back(sample.instant);
      history.creep_integral.push_back(value);
      errors.push_back(error);
      std::vector<double> row = {sample.time, value, error};
      if (has_temperature(integral.body))
        {
          row.push_back(integral.body.temperature.value(
            integral.region.tip.position, steps.within_period(sample.instant)));
          history.temperatures.push_back(row.back());
        }
      if (!std::isnan(value))
        table.add_row(row);

      before[0].swap(before[1]);
      times[1]  = times[0];
      before[0] = sample.state.displacement;
      times[0]  = sample.time;
      n_before  = std::min(n_before + 1, 2u);
    }

    void
    serialize(StateArchive &archive) override
    {
      archive.section("creep integral");
      archive.common(history.instants);
      archive.common(history.creep_integral);
      archive.common(history.temperatures);
      archive.common(errors);
      archive.common(n_before);
      for (const unsigned int k : {0, 1})
        {
          archive.nodal(before[k]);
          archive.common(times[k]);
        }
    }

    /** Adds "creep_integrals" to the summary, and a few lines to the log. */
    void
    summarise(Summary &summary) override
    {
      const std::vector<double> &C = history.creep_integral;
      const auto largest = SeriesExtremes(history.instants, C).largest;
      if (std::isnan(largest.value))
        return;
      const double error_of_largest =
        errors[std::lower_bound(history.instants.begin(),
                                history.instants.end(),
                                largest.instant) -
               history.instants.begin()];
      if (!history.temperatures.empty())
        history.temperature = history.temperatures.back();
      std::size_t last = C.size() - 1;
      while (std::isnan(C[last])) // no C after a jump
        --last;
      const std::string title =
        "  crack tip " + Text::from_point(integral.region.tip.position) + ": ";
      Summary tip = place_of(integral.region.tip);
      tip.update({{"radius", integral.radius()},
                  {"largest", largest.value},
                  {"error_of_largest", error_of_largest},
                  {"last", C[last]},
                  {"error_of_last", errors[last]}});
      log.line(title +
               Text::format("C(t) at most %.6g in the last period, %.6g at "
                            "its end, estimated errors %.1e and %.1e",
                            largest.value,
                            C[last],
                            error_of_largest,
                            errors[last]));
      summarise_growth(law, history, title, tip, log);
      summary["creep_integrals"].push_back(tip);
    }

  private:
    static bool
    has_temperature(const Body<2> &body)
    {
      return !body.temperature.is_zero();
    }

    /** Computes C(t) and its error. */
    std::array<double, 2>
    evaluate(const Sample &sample) const
    {
      const double h = sample.time - times[0], h_before = times[0] - times[1];
      const auto   over_squares = [&](const std::array<double, 3> &weights) {
        Vector velocity = sample.state.displacement;
        velocity *= weights[0];
        for (const unsigned int k : {0, 1})
          velocity.add(weights[k + 1], before[k]);
        return integral.evaluate(steps.within_period(sample.instant),
                                 sample.state.stress,
                                 velocity);
      };
      const double sum   = h + h_before;
      const auto   value = over_squares(
        {{1. / h + 1. / sum, -1. / h - 1. / h_before, h / (h_before * sum)}});
      const double change = over_squares({{1. / h, -1. / h, 0.}})[0] - value[0];
      constexpr double factor = 3.; // factor of δ², for powers of time
      return {
        {value[0],
         std::max(std::abs(value[1] - value[0]),
                  std::min(std::abs(change),
                           factor * change * change / std::abs(value[0])))}};
    }

    static constexpr double not_known =
      std::numeric_limits<double>::quiet_NaN();

    const CrackTipParameters &law;
    const CreepIntegral      &integral;
    const StepList           &steps;
    const bool                periods_are_iterates;
    Log                      &log;
    CsvTable                  table;
    TipHistory                history; ///< C(t) in the last period
    std::vector<double>       errors;
    unsigned int              n_before = 0;
    std::array<Vector, 2>     before; ///< displacements, newest first
    std::array<double, 2>     times{};
  };
} // namespace Crevasse

#endif
