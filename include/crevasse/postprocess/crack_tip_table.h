// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_crack_tip_table_h
#define crevasse_postprocess_crack_tip_table_h

#include <crevasse/base/format.h>
#include <crevasse/postprocess/tip_uncertainty.h>

namespace Crevasse
{
  /**
   * crack_tip.csv: what is read off at the crack tip at each accepted step.
   *
   * See StressIntensity::Estimate for K_I and K_I_stress. K_I_singular is the
   * coefficient of the singular function that opens the crack, of an elastic
   * body. K_I_error is the error there, or |K_I| times the relative error of
   * the elastic energy as StressEstimator has it in the cells around the tip,
   * if that is larger; where integral and fit differ by more, up to four times
   * this. It is no bound.
   */
  class CrackTipTable : public TipTable
  {
  public:
    /** The numbers of a step. */
    struct Values : StressIntensity::Estimate
    {
      double of_singular_function, release_rate, energy;
    };

    using TipTable::TipTable;

    static std::vector<std::string>
    columns(const CrackTipAnalysis &analysis)
    {
      std::vector<std::string> columns = {"t", "K_I", "K_I_stress"};
      if (analysis.has_singular_functions)
        columns.push_back("K_I_singular");
      columns.insert(columns.end(),
                     {"K_I_error", "energy_release_rate", "strain_energy"});
      return columns;
    }

    void
    observe(const Sample &sample) override
    {
      const Values values = evaluate(sample);
      if (sample.step == 0)
        {
          history.instants.clear();
          history.intensity.clear();
          of_last_period.clear();
        }
      history.instants.push_back(sample.instant);
      history.intensity.push_back(values.intensity);
      of_last_period.push_back(values);
      std::vector<double> row = {sample.time,
                                 values.intensity,
                                 values.of_stress};
      if (analysis.has_singular_functions)
        row.push_back(values.of_singular_function);
      row.insert(row.end(), {values.error, values.release_rate, values.energy});
      table.add_row(row);
    }

    void
    serialize(StateArchive &archive) override
    {
      archive.section("crack tip");
      archive.common(history.instants);
      archive.common(history.intensity);
      archive.common_list(of_last_period);
    }

    /** Adds "crack_tip" to the summary and prints a few lines. */
    void
    summarise(Summary &summary) override
    {
      history.c_star = analysis.c_star(flow ? &*flow : nullptr);
      if (history.instants.empty())
        return;
      double least_release = of_last_period.front().release_rate;
      double most_release = least_release, error = 0., energy = 0.;
      for (const Values &values : of_last_period)
        {
          least_release = std::min(least_release, values.release_rate);
          most_release  = std::max(most_release, values.release_rate);
          error         = std::max(error, values.error);
          energy        = std::max(energy, values.energy);
        }

      auto &tip                  = summary["crack_tip"];
      tip["method"]              = analysis.intensity.method();
      tip["why"]                 = analysis.intensity.why_no_integral();
      tip["position"]            = {analysis.intensity.region.tip.position[0],
                                    analysis.intensity.region.tip.position[1]};
      tip["direction"]           = {analysis.intensity.region.tip.ahead[0],
                                    analysis.intensity.region.tip.ahead[1]};
      tip["radius"]              = analysis.intensity.radius();
      tip["K_I"]                 = {{"largest", history.largest()},
                                    {"smallest", history.least()}};
      tip["K_I_error"]           = error;
      tip["energy_release_rate"] = {{"largest", most_release},
                                    {"smallest", least_release}};
      tip["strain_energy"]       = {{"largest", energy}};
      log_intensity("  crack tip: K_I",
                    CrackMode::opening,
                    history.least(),
                    history.largest(),
                    error,
                    log);
      warn_of_uncertainty(analysis,
                          "K_I",
                          {std::max(std::abs(history.largest()),
                                    std::abs(history.least())),
                           error},
                          energy,
                          summary,
                          log);
      summarise_closure(history, "  crack tip: ", tip);
      analysis.summarise_growth(history, "  crack tip: ", tip, log);
    }

  private:
    Values
    evaluate(const Sample &sample)
    {
      const double           t        = steps.within_period(sample.instant);
      const MaterialState<2> material = analysis.body.material.at(t);
      const PlaneElasticity  at_tip   = analysis.intensity.elasticity(t);
      Values values{analysis.intensity.evaluate(t, sample, material, at_tip),
                    analysis.of_singular_function(CrackMode::opening,
                                                  sample.state.displacement,
                                                  material),
                    0.,
                    0.};
      values.error =
        std::max(values.error, relative_error * std::abs(values.intensity));
      // The fit may be far less accurate than the integral.
      constexpr double most = 4.;
      values.error =
        std::max(values.error,
                 std::min(most * values.error,
                          std::abs(values.intensity - values.of_stress)));
      values.release_rate = values.intensity * values.intensity /
                            (material.stiffness_factor * at_tip.modulus());
      values.energy = analysis.energy.value(material,
                                            sample.state.stress,
                                            sample.viscous_strain);
      return values;
    }

    TipHistory          history; ///< of the last period
    std::vector<Values> of_last_period;
  };
} // namespace Crevasse

#endif
