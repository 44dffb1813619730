// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_crack_front_table_h
#define crevasse_postprocess_crack_front_table_h

#include <crevasse/base/csv_table.h>
#include <crevasse/base/format.h>
#include <crevasse/base/log.h>
#include <crevasse/postprocess/crack_front_analysis.h>

#include <algorithm>

namespace Crevasse
{
  /** crack_front.csv: K_I at the vertices of the front at each step of the last
   * period, written when the run ends. K_I_error is the difference between two
   * sizes of the tube; it is no bound. */
  class CrackFrontTable : public Observer
  {
  public:
    /** References must outlive this object.
     * @param file_name empty on ranks that do not write. */
    CrackFrontTable(const CrackFrontAnalysis &analysis,
                    const StepList           &steps,
                    const std::string        &file_name,
                    Log                      &log)
      : analysis(analysis)
      , steps(steps)
      , file_name(file_name)
      , log(log)
    {
    }

    void
    observe(const Sample &sample) override
    {
      if (sample.step == 0)
        {
          times.clear();
          values.clear();
        }
      times.push_back(sample.time);
      const auto now =
        analysis.evaluate(steps.within_period(sample.instant), sample);
      values.insert(values.end(), now.begin(), now.end());
    }

    void
    serialize(StateArchive &archive) override
    {
      archive.section("crack front");
      archive.common(times);
      archive.common_list(values);
    }

    /** Writes the table, adds "crack_front" to the summary and a line to the
     * log. */
    void
    summarise(Summary &summary) override
    {
      if (values.empty())
        return;
      write();
      const auto less = [](const auto &a, const auto &b) {
        return a.intensity < b.intensity;
      };
      const auto [smallest, largest] =
        std::minmax_element(values.begin(), values.end(), less);
      double error = 0.;
      for (const auto &value : values)
        error = std::max(error, value.error);
      auto &front              = summary["crack_front"];
      front["radius"]          = analysis.radius;
      front["vertices"]        = n_vertices();
      front["K_I"]["largest"]  = place(largest - values.begin());
      front["K_I"]["smallest"] = place(smallest - values.begin());
      front["K_I_error"]       = error;
      const std::string position =
        Text::from_point(vertex(largest - values.begin()).point);
      log.line(Text::format("  crack front: K_I from %.6g to %.6g in the last "
                            "period, estimated error %.1e; largest at ",
                            smallest->intensity,
                            largest->intensity,
                            error) +
               position);
    }

  private:
    std::size_t
    n_vertices() const
    {
      return analysis.region.vertices.size();
    }

    const FrontRegion::Vertex &
    vertex(const std::size_t i) const
    {
      return analysis.region.vertices[i % n_vertices()];
    }

    Summary
    place(const std::size_t i) const
    {
      const auto &point = vertex(i).point;
      return {{"value", values[i].intensity},
              {"t", times[i / n_vertices()]},
              {"s", vertex(i).s},
              {"position", {point[0], point[1], point[2]}}};
    }

    void
    write() const
    {
      CsvTable table(file_name,
                     {"t",
                      "front",
                      "s",
                      "x",
                      "y",
                      "z",
                      "K_I",
                      "energy_release_rate",
                      "K_I_error"});
      for (std::size_t i = 0; i < values.size(); ++i)
        table.add_row({times[i / n_vertices()],
                       1. + vertex(i).chain,
                       vertex(i).s,
                       vertex(i).point[0],
                       vertex(i).point[1],
                       vertex(i).point[2],
                       values[i].intensity,
                       values[i].release_rate,
                       values[i].error});
    }

    const CrackFrontAnalysis &analysis;
    const StepList           &steps;
    const std::string         file_name;
    Log                      &log;

    // Of the last period, by vertex and then by step.
    std::vector<double>                       times;
    std::vector<CrackFrontAnalysis::Estimate> values;
  };
} // namespace Crevasse

#endif
