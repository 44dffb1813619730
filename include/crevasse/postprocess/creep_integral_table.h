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
   * creep_integral.csv, or in space crack_front.csv: C(t) at each accepted
   * step, with the error that two squares and two differences in time show.
   *
   * The velocity is the difference of second order over the last two steps;
   * there is no row before two steps are done after a jump. If the difference
   * of first order deviates by a part δ, the error is of order δ².
   */
  template <int dim>
  class CreepIntegralTable : public Observer
  {
  public:
    /** References must outlive the CreepIntegralTable. Collective.
     *
     * @param periods_are_iterates whether the state jumps between periods.
     * @param table with the columns(). */
    CreepIntegralTable(const Scene              &scene,
                       const CreepIntegral<dim> &integral,
                       const StepList           &steps,
                       const bool                periods_are_iterates,
                       CsvTable                &&table,
                       Log                      &log)
      : law(scene.crack_tip)
      , integral(integral)
      , steps(steps)
      , periods_are_iterates(periods_are_iterates)
      , n(integral.n_values())
      , log(log)
      , table(std::move(table))
    {
      if constexpr (dim == 2)
        require_growth_constants(law,
                                 integral.body.temperature,
                                 integral.region.tip.position,
                                 steps);
      for (Vector &displacement : before)
        integral.body.strain_operator.initialize(displacement);
    }

    static std::vector<std::string>
    columns(const Body<dim> &body)
    {
      std::vector<std::string> names = {"t"};
      if (dim == 3)
        names = {"t", "front", "s", "x", "y", "z"};
      names.insert(names.end(), {"C_t", "C_t_error"});
      if (has_temperature(body))
        names.emplace_back("theta");
      return names;
    }

    void
    observe(const Sample &sample) override
    {
      if (sample.step == 0)
        {
          instants.clear();
          temperatures.clear();
          estimates.clear();
        }
      if ((sample.step == 0 &&
           (periods_are_iterates || steps.jumps_at(steps.period()))) ||
          steps.jumps_at(sample.instant))
        n_before = 0;
      if (has_temperature(integral.body))
        temperatures.push_back(temperature(sample.instant));
      instants.push_back(sample.instant);
      const auto now = n_before < 2
                         ? std::vector<Estimate>(n, {not_known, not_known})
                         : evaluate(sample);
      estimates.insert(estimates.end(), now.begin(), now.end());
      if (n_before == 2)
        add_rows(sample.time, now);

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
      archive.common(instants);
      archive.common_list(estimates);
      archive.common(temperatures);
      archive.common(n_before);
      for (const unsigned int k : {0, 1})
        {
          archive.nodal(before[k]);
          archive.common(times[k]);
        }
    }

    /** Adds to "creep_integrals" in the summary, and a few lines to the log. */
    void
    summarise(Summary &summary) override
    {
      std::size_t end = instants.size();
      while (end > 0 && std::isnan(estimates[(end - 1) * n].value))
        --end; // no C after a jump
      if (end == 0)
        return;
      using Extreme = SeriesExtremes::Extreme;
      std::vector<Extreme> at_vertices;
      for (std::size_t v = 0; v < n; ++v)
        at_vertices.push_back(SeriesExtremes(instants, history_at(v)).largest);
      const auto less = [](const auto &a, const auto &b) {
        return a.value < b.value;
      };
      const auto largest =
        std::max_element(at_vertices.begin(), at_vertices.end(), less);
      const auto        first  = estimates.begin() + (end - 1) * n;
      const auto        last   = std::max_element(first, first + n, less);
      const std::size_t vertex = largest - at_vertices.begin();
      const double      error  = error_at(largest->instant, vertex);

      Summary tip = place(vertex);
      tip.update({{"radius", integral.radius()},
                  {"largest", largest->value},
                  {"error_of_largest", error},
                  {"last", last->value},
                  {"error_of_last", last->error}});
      const std::string title = "  " + integral.name() + ": ";
      log.line(title +
               Text::format("C(t) at most %.6g in the last period, %.6g at "
                            "its end, estimated errors %.1e and %.1e",
                            largest->value,
                            last->value,
                            error,
                            last->error));
      if constexpr (dim == 2)
        summarise_growth(title, tip);
      else
        tip["position_of_last"] = place(last - first)["position"];
      summary["creep_integrals"].push_back(tip);
    }

  private:
    /** C(t) at a tip or a vertex of a front. */
    struct Estimate
    {
      double value, error;
    };

    static bool
    has_temperature(const Body<dim> &body)
    {
      return dim == 2 && !body.temperature.is_zero();
    }

    double
    temperature(const double instant) const
    {
      if constexpr (dim == 2)
        return integral.body.temperature.value(integral.region.tip.position,
                                               steps.within_period(instant));
      return 0.;
    }

    void
    add_rows(const double time, const std::vector<Estimate> &now)
    {
      for (std::size_t v = 0; v < n; ++v)
        {
          std::vector<double> row = {time};
          if constexpr (dim == 3)
            {
              const FrontRegion::Vertex &vertex = integral.region.vertices[v];
              row.insert(row.end(), {1. + vertex.chain, vertex.s});
              row.insert(row.end(),
                         vertex.point.begin_raw(),
                         vertex.point.end_raw());
            }
          row.insert(row.end(), {now[v].value, now[v].error});
          if (has_temperature(integral.body))
            row.push_back(temperatures.back());
          table.add_row(row);
        }
    }

    /** C(t) at a vertex in the last period. */
    std::vector<double>
    history_at(const std::size_t v) const
    {
      std::vector<double> C;
      for (std::size_t i = v; i < estimates.size(); i += n)
        C.push_back(estimates[i].value);
      return C;
    }

    /** Error at the first instant of the table from a given one on. */
    double
    error_at(const double instant, const std::size_t v) const
    {
      const auto k =
        std::lower_bound(instants.begin(), instants.end(), instant) -
        instants.begin();
      return estimates[k * n + v].error;
    }

    Summary
    place(const std::size_t v) const
    {
      if constexpr (dim == 2)
        return place_of(integral.region.tip);
      else
        {
          const FrontRegion::Vertex &vertex = integral.region.vertices[v];
          const dealii::Point<3>    &x      = vertex.point;
          return {{"position", {x[0], x[1], x[2]}},
                  {"s", vertex.s},
                  {"vertices", n}};
        }
    }

    void
    summarise_growth(const std::string &title, Summary &tip) const
    {
      TipHistory history;
      history.instants       = instants;
      history.creep_integral = history_at(0);
      history.temperatures   = temperatures;
      if (!temperatures.empty())
        history.temperature = temperatures.back();
      Crevasse::summarise_growth(law, history, title, tip, log);
    }

    /** Computes C(t) and its error. */
    std::vector<Estimate>
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
      const double sum    = h + h_before;
      const auto   values = over_squares(
        {{1. / h + 1. / sum, -1. / h - 1. / h_before, h / (h_before * sum)}});
      const auto       of_first_order = over_squares({{1. / h, -1. / h, 0.}});
      constexpr double factor = 3.; // factor of δ², for powers of time
      std::vector<Estimate> all;
      for (std::size_t v = 0; v < n; ++v)
        {
          const auto [value, of_small] = values[v];
          const double change          = of_first_order[v][0] - value;
          all.push_back(
            {value,
             std::max(std::abs(of_small - value),
                      std::min(std::abs(change),
                               factor * change * change / std::abs(value)))});
        }
      return all;
    }

    static constexpr double not_known =
      std::numeric_limits<double>::quiet_NaN();

    const CrackTipParameters &law;
    const CreepIntegral<dim> &integral;
    const StepList           &steps;
    const bool                periods_are_iterates;
    const std::size_t         n; ///< number of estimates at an instant
    Log                      &log;
    CsvTable                  table;
    // Of the last period.
    std::vector<double>   instants, temperatures;
    std::vector<Estimate> estimates; ///< by instant, then by vertex
    unsigned int          n_before = 0;
    std::array<Vector, 2> before; ///< displacements, newest first
    std::array<double, 2> times{};
  };
} // namespace Crevasse

#endif
