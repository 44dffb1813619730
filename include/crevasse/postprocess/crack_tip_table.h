// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_crack_tip_table_h
#define crevasse_postprocess_crack_tip_table_h

#include <crevasse/postprocess/tip_table.h>

namespace Crevasse
{
  struct CrackTipValues : StressIntensity::Estimate
  {
    double of_singular_function, release_rate, energy;
  };



  /**
   * crack_tip.csv: results at the crack tip at each accepted step.
   *
   * See StressIntensity::Estimate for K_I and K_I_stress. K_I_singular is the
   * coefficient of the singular function that opens the crack, of an elastic
   * body. K_I_error is the error of the Estimate, or if larger |K_I| times the
   * relative error of the elastic energy that StressEstimator finds in the
   * cells around the tip; up to four times this if integral and fit differ by
   * more. It is not a bound.
   */
  class CrackTipTable : public TipTable<CrackTipValues>
  {
  public:
    using TipTable::TipTable;

    static std::vector<std::string>
    columns(const CrackTipAnalysis &analysis)
    {
      std::vector<std::string> columns = {"t", "K_I", "K_I_stress"};
      if (analysis.has_singular_functions)
        columns.emplace_back("K_I_singular");
      columns.insert(columns.end(),
                     {"K_I_error", "energy_release_rate", "strain_energy"});
      return columns;
    }

    /** Adds "crack_tip" to the summary, and a few lines to the log. */
    void
    summarise(Summary &summary) override
    {
      if (instants.empty())
        return;
      using Values         = CrackTipValues;
      const auto intensity = [](const Values &v) { return v.intensity; };
      // A lip without K at all samples has only rounding in between.
      if (std::any_of(of_last_period.begin(), of_last_period.end(), intensity))
        add_changes_of_lip();
      const auto error = [](const Values &v) { return v.error; };
      Summary    tip   = place_and_method();
      tip["why"]       = analysis.intensity.why_no_integral();
      summarise_intensity(
        CrackMode::opening, "  crack tip: ", intensity, error, tip);
      tip["energy_release_rate"] =
        extremes([](const Values &v) { return v.release_rate; });
      tip["strain_energy"] = {
        {"largest", largest([](const Values &v) { return v.energy; })}};
      warn_of_uncertainty(
        "K_I",
        [](const Values &v) { return std::abs(v.intensity); },
        error,
        summary);
      const auto itself = [](const double K) { return K; };
      summarise_growth(intensity, intensity, itself, "  crack tip: ", tip);
      summary["crack_tip"] = tip;
    }

  private:
    std::vector<double>
    numbers_of(const CrackTipValues &values) const override
    {
      std::vector<double> row = {values.intensity, values.of_stress};
      if (analysis.has_singular_functions)
        row.push_back(values.of_singular_function);
      row.insert(row.end(), {values.error, values.release_rate, values.energy});
      return row;
    }

    CrackTipValues
    evaluate(const Sample &sample) const override
    {
      const double           t = context.steps.within_period(sample.instant);
      const MaterialState<2> material = analysis.body.material.at(t);
      const PlaneElasticity  at_tip   = analysis.intensity.elasticity(t);
      CrackTipValues         values{
        analysis.intensity.evaluate(t, sample, material, at_tip),
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
  };
} // namespace Crevasse

#endif
