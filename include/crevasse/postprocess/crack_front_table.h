// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_crack_front_table_h
#define crevasse_postprocess_crack_front_table_h

#include <crevasse/base/csv_table.h>
#include <crevasse/base/log.h>
#include <crevasse/base/series_extremes.h>
#include <crevasse/base/text.h>
#include <crevasse/postprocess/crack_front_analysis.h>
#include <crevasse/postprocess/mission_table.h>
#include <crevasse/time/period_observer.h>

#include <algorithm>

namespace Crevasse
{
  /** crack_front.csv: K_I, with two lips also K_II and K_III, at the vertices
   * of the front at each step of the last period, and C* if there is one,
   * written when the run ends. Errors are differences between two sizes of the
   * tube, not bounds. */
  class CrackFrontTable : public PeriodObserver
  {
  public:
    /** References must outlive the CrackFrontTable.
     * @param file_name empty on ranks that do not write. */
    CrackFrontTable(const CrackFrontAnalysis         &analysis,
                    const StepList                   &steps,
                    const std::optional<SecularFlow> &flow,
                    const std::string                &file_name,
                    Log                              &log)
      : analysis(analysis)
      , steps(steps)
      , flow(flow)
      , file_name(file_name)
      , log(log)
    {
    }

    void
    observe(const Sample &sample) override
    {
      PeriodObserver::observe(sample);
      has_row.back() = 1;
    }

    void
    serialize(StateArchive &archive) override
    {
      archive.section("crack front");
      PeriodObserver::serialize(archive);
      archive.common(times);
      archive.common_list(values);
      archive.common(has_row);
    }

    /** Largest and smallest K_I of the last period along the front. */
    std::vector<PeriodNumber>
    period_numbers() const
    {
      return {{"K_I_largest", [this] { return range(0).second.value; }},
              {"K_I_smallest", [this] { return range(0).first.value; }}};
    }

    /** K_I at the vertices of the front at the last sample. */
    std::vector<double>
    latest() const
    {
      std::vector<double> all;
      for (auto value = values.end() - n_vertices(); value != values.end();
           ++value)
        all.push_back(value->intensity[0]);
      return all;
    }

    /** Writes the table, adds "crack_front" to the summary and lines to the
     * log. */
    void
    summarise(Summary &summary) override
    {
      if (values.empty())
        return;
      const auto c_star = analysis.c_star(flow);
      write(c_star);
      auto &front       = summary["crack_front"];
      front["radius"]   = analysis.radius;
      front["vertices"] = n_vertices();
      const auto names  = analysis.names();
      for (unsigned int m = 0; m < names.size(); ++m)
        {
          const auto [smallest, largest] = range(m);
          double error                   = 0.;
          for (const auto &value : values)
            error = std::max(error, value.error[m]);
          front[names[m]]["largest"]  = place(largest);
          front[names[m]]["smallest"] = place(smallest);
          front[names[m] + "_error"]  = error;
          log.line("  crack front: " + names[m] +
                   Text::format(" from %.6g to %.6g in the last "
                                "period, estimated error %.1e; largest at ",
                                smallest.value,
                                largest.value,
                                error) +
                   Text::from_point(vertex(largest.vertex).point));
        }
      summarise(c_star, front);
    }

  private:
    using Values = std::vector<CrackFrontAnalysis::Estimate>;
    using CStar  = std::vector<CrackFrontAnalysis::Value>;

    /** Extreme of K at a vertex. */
    struct Extreme : SeriesExtremes::Extreme
    {
      std::size_t vertex;
    };

    void
    clear() override
    {
      times.clear();
      values.clear();
      has_row.clear();
    }

    void
    insert(const Sample &sample, const std::size_t k) override
    {
      has_row.insert(has_row.begin() + k, 0);
      times.insert(times.begin() + k, sample.time);
      const auto now =
        analysis.evaluate(steps.within_period(sample.instant), sample);
      values.insert(values.begin() + k * n_vertices(), now.begin(), now.end());
    }

    std::size_t
    n_vertices() const
    {
      return analysis.region.vertices.size();
    }

    /** Smallest and largest K of a mode in the last period. */
    std::pair<Extreme, Extreme>
    range(const unsigned int mode) const
    {
      std::vector<Extreme> least, largest;
      for (std::size_t v = 0; v < n_vertices(); ++v)
        {
          std::vector<double> K;
          for (std::size_t i = v; i < values.size(); i += n_vertices())
            K.push_back(values[i].intensity[mode]);
          const SeriesExtremes extremes(times, K);
          least.push_back({extremes.least, v});
          largest.push_back({extremes.largest, v});
        }
      const auto less = [](const Extreme &a, const Extreme &b) {
        return a.value < b.value;
      };
      return {*std::min_element(least.begin(), least.end(), less),
              *std::max_element(largest.begin(), largest.end(), less)};
    }

    const FrontRegion::Vertex &
    vertex(const std::size_t i) const
    {
      return analysis.region.vertices[i % n_vertices()];
    }

    Summary
    place(const double value, const std::size_t v) const
    {
      const auto &point = vertex(v).point;
      return {{"value", value},
              {"s", vertex(v).s},
              {"position", {point[0], point[1], point[2]}}};
    }

    Summary
    place(const Extreme &extreme) const
    {
      Summary summary = place(extreme.value, extreme.vertex);
      summary["t"]    = extreme.instant;
      return summary;
    }

    /** Adds C* to the summary of the front and to the log. */
    void
    summarise(const CStar &c_star, Summary &front) const
    {
      front["C_star"] = Summary();
      if (c_star.empty())
        {
          const std::string &why = analysis.creep.no_c_star;
          front["no_C_star"]     = why.empty() ? "the flow was not found" : why;
          return;
        }
      const auto [smallest, largest] =
        std::minmax_element(c_star.begin(),
                            c_star.end(),
                            [](const auto &a, const auto &b) {
                              return a.value < b.value;
                            });
      double error = 0.;
      for (const auto &at_vertex : c_star)
        error = std::max(error, at_vertex.error);
      const std::size_t v        = largest - c_star.begin();
      front["C_star"]["largest"] = place(largest->value, v);
      front["C_star"]["smallest"] =
        place(smallest->value, smallest - c_star.begin());
      front["C_star_error"] = error;
      if (largest->value > 0.)
        log.line(Text::format("  crack front: C* from %.6g to %.6g, estimated "
                              "error %.1e; largest at ",
                              smallest->value,
                              largest->value,
                              error) +
                 Text::from_point(vertex(v).point));
    }

    void
    write(const CStar &c_star) const
    {
      std::vector<std::string> columns = {"t", "front", "s", "x", "y", "z"};
      const auto               names   = analysis.names();
      columns.insert(columns.end(), names.begin(), names.end());
      columns.emplace_back("energy_release_rate");
      for (const std::string &name : names)
        columns.push_back(name + "_error");
      if (!c_star.empty())
        columns.insert(columns.end(), {"C_star", "C_star_error"});
      CsvTable table(file_name, columns);
      for (std::size_t i = 0; i < values.size(); ++i)
        {
          const unsigned int k = i / n_vertices();
          if (has_row[k] == 0)
            continue;
          const auto         &value = values[i];
          const auto         &point = vertex(i).point;
          std::vector<double> row   = {times[k],
                                       1. + vertex(i).chain,
                                       vertex(i).s,
                                       point[0],
                                       point[1],
                                       point[2]};
          const auto          add = [&](const std::array<double, 3> &of_modes) {
            row.insert(row.end(),
                       of_modes.begin(),
                       of_modes.begin() + names.size());
          };
          add(value.intensity);
          row.push_back(value.release_rate);
          add(value.error);
          if (!c_star.empty())
            {
              const auto &[of_flow, error] = c_star[i % n_vertices()];
              row.insert(row.end(), {of_flow, error});
            }
          table.add_row(row);
        }
    }

    const CrackFrontAnalysis         &analysis;
    const StepList                   &steps;
    const std::optional<SecularFlow> &flow;
    const std::string                 file_name;
    Log                              &log;

    // Times and values in the last period; vertices vary before steps.
    std::vector<double> times;
    Values              values;
    /** 1 for each time with rows in the table, the end of a step. */
    std::vector<unsigned int> has_row;
  };
} // namespace Crevasse

#endif
