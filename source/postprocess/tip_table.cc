// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/postprocess/tip_table.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/grid/grid_tools.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    const auto opening_of = [](const TipValues &v) { return v.intensity[0]; };
    const auto sliding_of = [](const TipValues &v) { return v.intensity[1]; };
    const auto energy_of  = [](const TipValues &v) { return v.energy; };
    const auto equivalent_of = [](const TipValues &v) { return v.equivalent; };



    /** Columns of the table after t, with their values. */
    std::vector<std::pair<std::string, double>>
    columns_of(const CrackTipAnalysis &analysis, const TipValues &v)
    {
      std::vector<std::pair<std::string, double>> all;
      const auto add_singular = [&](const char *name, const unsigned int mode) {
        if (analysis.has_singular_functions)
          all.emplace_back(name, v.of_singular_functions[mode]);
      };
      const auto with_last = [&] {
        if (analysis.intensity.has_t_stress())
          all.insert(all.end(),
                     {{"T_stress", v.t_stress},
                      {"T_stress_error", v.t_stress_error}});
        if (analysis.has_temperature)
          all.emplace_back("theta", v.temperature);
        return all;
      };
      if (analysis.intensity.region.tip.two_lips)
        {
          all = {{"K_I", v.intensity[0]},
                 {"K_II", v.intensity[1]},
                 {"K_I_error", v.error[0]},
                 {"K_II_error", v.error[1]},
                 {"energy_release_rate", v.release_rate},
                 {"growth_angle", v.growth_angle},
                 {"equivalent_intensity", v.equivalent},
                 {"growth_angle_G", v.angle_of_release}};
          add_singular("K_I_singular", 0);
          add_singular("K_II_singular", 1);
          return with_last();
        }
      all = {{"K_I", v.intensity[0]}, {"K_I_stress", v.of_stress}};
      add_singular("K_I_singular", 0);
      all.insert(all.end(),
                 {{"K_I_error", v.error[0]},
                  {"energy_release_rate", v.release_rate},
                  {"strain_energy", v.energy}});
      return with_last();
    }
  } // namespace



  TipTable::TipTable(const CrackTipAnalysis &analysis,
                     const MeshErrors       &mesh_errors,
                     const TipContext       &context,
                     CsvTable              &&table)
    : analysis(analysis)
    , context(context)
    , place(analysis.intensity.region.tip)
    , title("  crack tip" +
            (place.two_lips ? ' ' + Text::from_point(place.position) : "") +
            ": ")
    , mesh_errors(mesh_errors)
    , table(std::move(table))
  {
  }



  std::vector<std::string>
  TipTable::columns(const CrackTipAnalysis &analysis)
  {
    std::vector<std::string> names = {"t"};
    for (const auto &column : columns_of(analysis, {}))
      names.push_back(column.first);
    return names;
  }



  void
  TipTable::observe(const Sample &sample)
  {
    PeriodObserver::observe(sample);
    std::vector<double> row = {sample.time};
    for (const auto &column : columns_of(analysis, of_last_period.back()))
      row.push_back(column.second);
    table.add_row(row);
  }



  TipValues
  TipTable::evaluate(const Sample &sample) const
  {
    const double           t = context.steps.within_period(sample.instant);
    const MaterialState<2> material = analysis.body.material.at(t);
    const TipElasticity    at_tip   = analysis.intensity.elasticity(t);
    const auto             estimate =
      analysis.intensity.evaluate(t, sample, material, at_tip);
    const auto  &K    = estimate.intensity;
    const double size = std::hypot(K[0], K[1]);
    TipValues    values{};
    values.of_stress    = estimate.of_stress;
    values.contact_zone = estimate.contact_zone;
    values.t_stress     = estimate.t_stress;
    values.t_stress_error =
      std::max({estimate.t_stress_error,
                mesh_errors.of_T,
                analysis.intensity.t_stress_error_of_known_fields() * size});
    if (analysis.has_temperature)
      values.temperature = analysis.temperature(t);
    for (unsigned int mode = 0; mode < (place.two_lips ? 2 : 1); ++mode)
      {
        values.intensity[mode] = K[mode];
        // A closed tip has K = 0 exactly.
        values.error[mode] =
          K[mode] == 0. ? 0.
                        : std::max(estimate.error[mode],
                                   mesh_errors.of_intensity[mode] * size);
        values.of_singular_functions[mode] =
          analysis.of_singular_function(CrackMode(mode),
                                        sample.state.displacement,
                                        material);
      }
    // The fit may be far less accurate than the integral.
    constexpr double most = 4.;
    values.error[0]       = std::max(values.error[0],
                               std::min(most * values.error[0],
                                        std::abs(K[0] - values.of_stress)));
    values.release_rate =
      at_tip.release_rate(K[0], K[1]) / material.stiffness_factor;
    values.energy     = analysis.energy.value(material,
                                          sample.state.stress,
                                          sample.viscous_strain);
    values.equivalent = K[0];
    if (place.two_lips)
      {
        // Directions are known for isotropic bodies.
        const double degrees =
          at_tip.has_only_release_rate() ? NAN : 180. / numbers::PI;
        values.growth_angle = degrees * GrowthDirection(K[0], K[1]).angle;
        values.angle_of_release =
          degrees * angle_of_largest_release(K[0], K[1]);
        values.equivalent = at_tip.equivalent(K[0], K[1]);
      }
    return values;
  }



  void
  TipTable::between(const Sample &sample)
  {
    // A tip without K at all samples has only rounding in between.
    if (std::any_of(of_last_period.begin(),
                    of_last_period.end(),
                    equivalent_of))
      PeriodObserver::between(sample);
  }



  std::pair<double, double>
  TipTable::range(const Number &number) const
  {
    std::vector<double> all;
    for (const TipValues &values : of_last_period)
      all.push_back(number(values));
    const SeriesExtremes extremes(instants, all);
    return {extremes.least.value, extremes.largest.value};
  }



  double
  TipTable::largest_value(const Number &number) const
  {
    double largest = 0.;
    for (const TipValues &values : of_last_period)
      largest = std::max(largest, number(values));
    return largest;
  }



  void
  TipTable::summarise(Summary &summary)
  {
    if (instants.empty())
      return;
    Summary tip   = place_of(place);
    tip["method"] = analysis.intensity.method();
    tip["radius"] = analysis.intensity.radius();
    summarise_intensity(0, tip);
    if (place.two_lips)
      summarise_intensity(1, tip);
    tip["energy_release_rate"] =
      extremes([](const TipValues &v) { return v.release_rate; });
    if (analysis.intensity.has_t_stress())
      summarise_t_stress(tip);
    if (place.two_lips)
      {
        summarise_two_modes(tip);
        if (const auto at_tip = analysis.intensity.elasticity(0.);
            at_tip.interface)
          summarise_interface(*at_tip.interface, summary, tip);
        warn_of_turning(summary);
      }
    else
      {
        tip["why"]           = analysis.intensity.why;
        tip["strain_energy"] = {{"largest", largest(energy_of)}};
      }
    warn_of_uncertainty(summary);
    summarise_growth(summary, tip);
    if (place.two_lips)
      summary["crack_tips"].push_back(tip);
    else
      summary["crack_tip"] = tip;
  }



  void
  TipTable::summarise_intensity(const unsigned int mode, Summary &tip) const
  {
    const std::string name      = mode == 0 ? "K_I" : "K_II";
    const Number      intensity = [mode](const TipValues &v) {
      return v.intensity[mode];
    };
    const auto [least, most] = range(intensity);
    const double error =
      largest_value([mode](const TipValues &v) { return v.error[mode]; });
    const double size    = std::max(std::abs(least), std::abs(most));
    tip[name]            = extremes(intensity);
    tip[name + "_error"] = error;
    context.log.line(
      title + name + " from " + context.units.range_of_intensity(least, most) +
      Text::format(" in the last period, estimated error %.1g (%.2g %%)",
                   error,
                   size > 0. ? 100. * error / size : 0.));
    if (least < -10. * error && mode == 0 &&
        !analysis.intensity.elasticity(0.).interface)
      context.log.line(
        "    K_I < 0: the load, or residual stress from creep, compresses the "
        "body ahead of the tip");
  }



  void
  TipTable::summarise_t_stress(Summary &tip) const
  {
    tip["T_stress"] = extremes([](const TipValues &v) { return v.t_stress; });
    tip["T_stress_error"] =
      largest_value([](const TipValues &v) { return v.t_stress_error; });
  }



  void
  TipTable::summarise_two_modes(Summary &tip) const
  {
    const TipValues &worst =
      *std::max_element(of_last_period.begin(),
                        of_last_period.end(),
                        [](const TipValues &a, const TipValues &b) {
                          return a.equivalent < b.equivalent;
                        });
    tip["equivalent_intensity"] = {{"largest", largest(equivalent_of)}};
    tip["growth_angle"]         = worst.growth_angle;
    tip["growth_angle_G"]       = worst.angle_of_release;
    const auto [low, high]      = range(opening_of);
    const auto [left, right]    = range(sliding_of);
    tip["Delta_K_I"]            = high - low;
    tip["Delta_K_II"]           = right - left;
  }



  void
  TipTable::warn_of_uncertainty(Summary &summary) const
  {
    // A crack that stays closed has an intensity of rounding: the energy
    // density gives the usual intensity of cracks of its length.
    constexpr double        large = 0.1, negligible = 1e-3;
    const Triangulation<2> &mesh = analysis.body.space.mesh();
    const double density         = largest(energy_of) / GridTools::volume(mesh);
    const double usual =
      std::sqrt(analysis.body.law.stiffness_factor(0.) *
                analysis.intensity.elasticity(0.).modulus() * density *
                analysis.intensity.region.largest_radius());
    const double size  = largest([](const TipValues &v) {
      return std::hypot(v.intensity[0], v.intensity[1]);
    });
    const double error = largest_value(
      [](const TipValues &v) { return std::hypot(v.error[0], v.error[1]); });
    if (error <= large * size || size <= negligible * usual)
      return;
    warn("[Crack tip] Stress intensity: " +
           (place.two_lips ? "at " + Text::from_point(place.position) + " K"
                           : "K_I") +
           " is uncertain by about " +
           Text::from_number(std::round(100. * error / size)) +
           " %; refine the mesh ([Refinement])" +
           (place.two_lips ? ""
                           : " or use [Discretisation] Singular functions"),
         context.log,
         summary);
  }



  void
  TipTable::warn_of_turning(Summary &summary) const
  {
    // The principal axis of the moments is the mean direction of (K_I, K_II).
    SymmetricTensor<2, 2> moments;
    for (const TipValues &v : of_last_period)
      {
        const Tensor<1, 2> K({std::max(opening_of(v), 0.), sliding_of(v)});
        moments += symmetrize(outer_product(K, K));
      }
    const auto       sizes = eigenvalues(moments);
    constexpr double small = 0.1; // ratio of axes
    if (sizes[1] <= small * small * sizes[0])
      return;
    warn("[Crack tip]: at " + Text::from_point(place.position) +
           " K_II/K_I varies over the period, but Delta_K (equivalent to the "
           "ranges of K_I and K_II) and da_dN assume modes in phase. Judge "
           "growth by K_I and K_II in crack_tip_N.csv",
         context.log,
         summary);
  }
} // namespace Crevasse
