// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_mixed_mode_table_h
#define crevasse_postprocess_mixed_mode_table_h

#include <crevasse/crack_tip/growth_direction.h>
#include <crevasse/postprocess/tip_table.h>

#include <deal.II/base/symmetric_tensor.h>

namespace Crevasse
{
  struct MixedModeValues
  {
    /** Values for modes I and II. */
    std::array<double, 2> intensity, error, of_singular_functions;
    double                release_rate;
    double                growth_angle; ///< growth direction in degrees
    double                equivalent;   ///< GrowthDirection::intensity
    double                t_stress;
    double                angle_of_release; ///< direction of largest G
    double                energy;           ///< strain energy of body
  };



  /**
   * crack_tip_N.csv: K_I, K_II and T of the N-th tip with two lips at each
   * accepted step, and quantities derived from them.
   *
   * The errors are those of StressIntensity::ModeEstimate, or √(K_I² + K_II²)
   * times the relative error of the elastic energy around the tip, if that is
   * larger. Errors are not bounds.
   */
  class MixedModeTable : public TipTable<MixedModeValues>
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

    /** Adds "crack_tips" to the summary, and a few lines to the log. */
    void
    summarise(Summary &summary) override
    {
      if (instants.empty())
        return;
      add_changes_of_lip();
      using Values = MixedModeValues;
      const std::string title =
        "  crack tip " +
        Text::from_point(analysis.intensity.region.tip.position) + ": ";
      Summary tip = place_and_method();
      for (const unsigned int mode : {0, 1})
        summarise_intensity(
          CrackMode(mode),
          title,
          [mode](const Values &v) { return v.intensity[mode]; },
          [mode](const Values &v) { return v.error[mode]; },
          tip);
      tip["energy_release_rate"] =
        extremes([](const Values &v) { return v.release_rate; });
      const Values &worst =
        *std::max_element(of_last_period.begin(),
                          of_last_period.end(),
                          [](const Values &a, const Values &b) {
                            return a.equivalent < b.equivalent;
                          });
      tip["T_stress"] = extremes([](const Values &v) { return v.t_stress; });
      tip["equivalent_intensity"] = {{"largest", worst.equivalent}};
      tip["growth_angle"]         = worst.growth_angle;
      tip["growth_angle_G"]       = worst.angle_of_release;
      const auto K_I           = [](const Values &v) { return v.intensity[0]; };
      const auto K_II          = [](const Values &v) { return v.intensity[1]; };
      const auto [low, high]   = range(K_I);
      const auto [left, right] = range(K_II);
      const double of_sliding  = right - left;
      tip["Delta_K_I"]         = high - low;
      tip["Delta_K_II"]        = of_sliding;
      summarise_growth(
        K_I,
        [](const Values &v) { return v.equivalent; },
        [of_sliding](const double of_opening) {
          return GrowthDirection(of_opening, of_sliding).intensity;
        },
        title,
        tip);
      summary["crack_tips"].push_back(tip);
      warn_of_turning(summary);
      const auto size = [](const std::array<double, 2> &of_modes) {
        return std::hypot(of_modes[0], of_modes[1]);
      };
      warn_of_uncertainty(
        "at " + Text::from_point(analysis.intensity.region.tip.position) + " K",
        [&size](const Values &v) { return size(v.intensity); },
        [&size](const Values &v) { return size(v.error); },
        summary);
    }

  private:
    /** Warns if K_II/K_I changes over the period: then the range of no single
     * intensity is equivalent. */
    void
    warn_of_turning(Summary &summary) const
    {
      // The principal axis of the moments is the mean direction of (K_I, K_II).
      dealii::SymmetricTensor<2, 2> moments;
      for (const MixedModeValues &v : of_last_period)
        {
          const dealii::Tensor<1, 2> K(
            {std::max(v.intensity[0], 0.), v.intensity[1]});
          moments += symmetrize(outer_product(K, K));
        }
      const auto       sizes = eigenvalues(moments);
      constexpr double small = 0.1; // ratio of axes
      if (sizes[1] <= small * small * sizes[0])
        return;
      warn("[Crack tip]: at " +
             Text::from_point(analysis.intensity.region.tip.position) +
             " K_II/K_I varies over the period, but Delta_K (equivalent to the "
             "ranges of K_I and K_II) and da_dN assume modes in phase. Judge "
             "growth by K_I and K_II in crack_tip_N.csv",
           summary);
    }

    std::vector<double>
    numbers_of(const MixedModeValues &v) const override
    {
      std::vector<double> row = {v.intensity[0],
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
      return row;
    }

    MixedModeValues
    evaluate(const Sample &sample) const override
    {
      const double           t = context.steps.within_period(sample.instant);
      const MaterialState<2> material = analysis.body.material.at(t);
      const PlaneElasticity  at_tip   = analysis.intensity.elasticity(t);
      const auto             modes =
        analysis.intensity.evaluate_modes(t, sample, material, at_tip);
      MixedModeValues values;
      const double    size = std::hypot(modes[0].intensity, modes[1].intensity);
      for (const unsigned int mode : {0, 1})
        {
          values.intensity[mode] = modes[mode].intensity;
          // A closed tip has K = 0 exactly.
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
  };
} // namespace Crevasse

#endif
