// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_mixed_mode_table_h
#define crevasse_postprocess_mixed_mode_table_h

#include <crevasse/base/format.h>
#include <crevasse/crack_tip/growth_direction.h>
#include <crevasse/postprocess/tip_uncertainty.h>

namespace Crevasse
{
  /**
   * crack_tip_N.csv: K_I, K_II and T of the N-th tip with two lips at each
   * accepted step, and what follows from them.
   *
   * The errors are those of StressIntensity::ModeEstimate, or √(K_I² + K_II²)
   * times the relative error of the elastic energy around the tip, if that is
   * larger. They are no bounds.
   */
  class MixedModeTable : public TipTable
  {
  public:
    using TipTable::TipTable;

    static std::vector<std::string>
    columns(const CrackTipAnalysis &analysis)
    {
      std::vector<std::string> columns = {"t",
                                          "K_I",
                                          "K_II",
                                          "K_I_error",
                                          "K_II_error",
                                          "energy_release_rate",
                                          "growth_angle",
                                          "equivalent_intensity",
                                          "T_stress",
                                          "growth_angle_G"};
      if (analysis.has_singular_functions)
        columns.insert(columns.end(), {"K_I_singular", "K_II_singular"});
      return columns;
    }

    void
    observe(const Sample &sample) override
    {
      if (sample.step == 0)
        instants.clear(), of_last_period.clear();
      instants.push_back(sample.instant);
      of_last_period.push_back(evaluate(sample));
      const Values       &v   = of_last_period.back();
      std::vector<double> row = {sample.time,
                                 v.intensity[0],
                                 v.intensity[1],
                                 v.error[0],
                                 v.error[1],
                                 v.release_rate,
                                 v.growth_angle,
                                 v.equivalent,
                                 v.t_stress,
                                 v.angle_of_release};
      if (analysis.has_singular_functions)
        row.insert(row.end(),
                   v.of_singular_functions.begin(),
                   v.of_singular_functions.end());
      table.add_row(row);
    }

    void
    serialize(StateArchive &archive) override
    {
      archive.section("crack tip with two lips");
      archive.common(instants);
      archive.common_list(of_last_period);
    }

    /** Adds to "crack_tips" in the summary and prints a few lines. */
    void
    summarise(Summary &summary) override
    {
      if (instants.empty())
        return;
      const CrackTip   &place = analysis.intensity.region.tip;
      const std::string title =
        "  crack tip " + Text::from_point(place.position) + ": ";
      Summary tip;
      tip["method"]    = analysis.intensity.method();
      tip["position"]  = {place.position[0], place.position[1]};
      tip["direction"] = {place.ahead[0], place.ahead[1]};
      tip["radius"]    = analysis.intensity.radius();
      for (const unsigned int mode : {0, 1})
        {
          const std::string name = mode == 0 ? "K_I" : "K_II";
          const auto [least, most] =
            range([mode](const Values &v) { return v.intensity[mode]; });
          const double error =
            range([mode](const Values &v) { return v.error[mode]; }).second;
          tip[name]            = {{"largest", most}, {"smallest", least}};
          tip[name + "_error"] = error;
          log_intensity(title + name,
                        mode == 0 ? CrackMode::opening : CrackMode::sliding,
                        least,
                        most,
                        error,
                        log);
        }
      const auto [least_release, most_release] =
        range([](const Values &v) { return v.release_rate; });
      tip["energy_release_rate"] = {{"largest", most_release},
                                    {"smallest", least_release}};
      const Values &worst =
        *std::max_element(of_last_period.begin(),
                          of_last_period.end(),
                          [](const Values &a, const Values &b) {
                            return a.equivalent < b.equivalent;
                          });
      const auto [least_T, most_T] =
        range([](const Values &v) { return v.t_stress; });
      tip["T_stress"] = {{"largest", most_T}, {"smallest", least_T}};
      tip["equivalent_intensity"] = {{"largest", worst.equivalent}};
      tip["growth_angle"]         = worst.growth_angle;
      tip["growth_angle_G"]       = worst.angle_of_release;
      summarise_growth(tip, title);
      summary["crack_tips"].push_back(tip);
      warn(summary);
    }

  private:
    /** The numbers of a step. */
    struct Values
    {
      /** Of modes I and II. */
      std::array<double, 2> intensity, error, of_singular_functions;
      double                release_rate;
      double                growth_angle; ///< in degrees
      double                equivalent;   ///< GrowthDirection::intensity
      double                t_stress;
      double                angle_of_release; ///< in degrees
      double                energy;           ///< of the whole body
    };

    Values
    evaluate(const Sample &sample) const
    {
      const double           t        = steps.within_period(sample.instant);
      const MaterialState<2> material = analysis.body.material.at(t);
      const PlaneElasticity  at_tip   = analysis.intensity.elasticity(t);
      const auto             modes =
        analysis.intensity.evaluate_modes(t, sample, material, at_tip);
      Values       values;
      const double size = std::hypot(modes[0].intensity, modes[1].intensity);
      for (const unsigned int mode : {0, 1})
        {
          values.intensity[mode] = modes[mode].intensity;
          // 0 is exact, where the tip is closed.
          values.error[mode] =
            modes[mode].intensity == 0.
              ? 0.
              : std::max(modes[mode].error, relative_error * size);
          values.of_singular_functions[mode] =
            analysis.of_singular_function(CrackMode(mode),
                                          sample.state.displacement,
                                          material);
        }
      values.release_rate =
        size * size / (material.stiffness_factor * at_tip.modulus());
      constexpr double      degrees = 180. / dealii::numbers::PI;
      const GrowthDirection growth(values.intensity[0], values.intensity[1]);
      values.growth_angle = degrees * growth.angle;
      values.angle_of_release =
        degrees *
        angle_of_largest_release(values.intensity[0], values.intensity[1]);
      values.equivalent = growth.intensity;
      values.t_stress   = modes[2].intensity;
      values.energy     = analysis.energy.value(material,
                                            sample.state.stress,
                                            sample.viscous_strain);
      return values;
    }

    /** The least and the largest of the last period. */
    template <typename Function>
    std::pair<double, double>
    range(const Function &f) const
    {
      std::vector<double> all;
      for (const Values &values : of_last_period)
        all.push_back(f(values));
      const auto [least, most] = std::minmax_element(all.begin(), all.end());
      return {*least, *most};
    }

    /** What lives are computed from, C*, and what the law makes of the
     * equivalent intensity. */
    void
    summarise_growth(Summary &tip, const std::string &title)
    {
      TipHistory history;
      history.instants = instants;
      for (const Values &values : of_last_period)
        history.intensity.push_back(values.equivalent);
      summarise_closure(history, title, tip);
      history.c_star = analysis.c_star(flow ? &*flow : nullptr);
      analysis.summarise_growth(history, title, tip, log);
    }

    void
    warn(Summary &summary) const
    {
      StressIntensity::ModeEstimate largest{0., 0.};
      double                        energy = 0.;
      for (const Values &v : of_last_period)
        {
          largest.intensity =
            std::max(largest.intensity,
                     std::hypot(v.intensity[0], v.intensity[1]));
          largest.error =
            std::max(largest.error, std::hypot(v.error[0], v.error[1]));
          energy = std::max(energy, v.energy);
        }
      warn_of_uncertainty(
        analysis,
        "at " + Text::from_point(analysis.intensity.region.tip.position) + " K",
        largest,
        energy,
        summary,
        log);
    }

    std::vector<double> instants; ///< of the last period
    std::vector<Values> of_last_period;
  };
} // namespace Crevasse

#endif
