// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/discretisation/rigid_modes.h>
#include <crevasse/discretisation/stress_estimator.h>
#include <crevasse/model/elastic_displacement.h>
#include <crevasse/model/largest_load.h>
#include <crevasse/postprocess/crack_tip_analysis.h>

#include <deal.II/grid/grid_tools.h>

#include <cstdio>

namespace Crevasse
{
  using namespace dealii;

  CrackTipAnalysis::CrackTipAnalysis(const Scene        &scene,
                                     const Body<2>      &body,
                                     const SecularSplit &split,
                                     const StepList     &steps)
    : scene(scene)
    , body(body)
    , intensity(scene, body, steps)
    , energy(body.material, intensity.points)
    , growth_law(describe_growth_law(scene.crack_tip))
    , no_c_star(find_viscous_region(split))
    , mean_load_vanishes(split.mean_load.size() > 0 && !split.effect.on)
  {
    if (needs_c_star(scene.crack_tip) && !no_c_star.empty() &&
        !mean_load_vanishes)
      throw SceneError(
        "[Crack tip] Creep growth parameter = C star: there is no C*, for " +
        no_c_star + ". Set it to stress intensity.");
    require_no_force_at_tip(steps);
  }



  std::string
  CrackTipAnalysis::find_viscous_region(const SecularSplit &split)
  {
    if (!split.effect.on)
      return split.effect.why;
    if (const auto force = Effects::first_on(body.effects.volume_forces))
      return "there is a " + force->name + ", which the integral does not know";
    const MaterialState<2> material = body.material.at(0.);
    viscosity.emplace(body, material);
    viscous_region = intensity.region.uniform(intensity.points, viscosity->sum);
    return viscous_region->radius > 0.
             ? ""
             : "the viscosity is not isotropic and the same in all cells at "
               "the crack tip";
  }



  std::string
  CrackTipAnalysis::describe() const
  {
    const std::string &why = intensity.why_no_integral();
    return "  crack tip: " + Text::from_point(intensity.region.tip.position) +
           ", K_I by " + intensity.method() +
           (why.empty() ? "" : " (" + why + ")") +
           (growth_law.empty() ? "" : "; " + growth_law);
  }



  double
  CrackTipAnalysis::relative_energy_error(ContactSystemCache<2> &systems,
                                          const StepList        &steps) const
  {
    StressEstimator<2> estimator(body.space,
                                 body.points,
                                 body.lip,
                                 scene.loads);
    look_at_elastic_states(body,
                           systems,
                           instants_of_extreme_loads(body, steps),
                           estimator);
    const dealii::Vector<float> squares = estimator.squares();
    double                      sum     = 0.;
    for (const auto &cell : owned_cells(body.space.mesh()))
      {
        const unsigned int i            = cell->active_cell_index();
        const auto [begin, end_of_cell] = intensity.region.reach(i);
        if (begin == 0. || end_of_cell < intensity.largest_radius())
          sum += squares(i);
      }
    return Utilities::MPI::sum(sum, body.space.communicator());
  }



  void
  CrackTipAnalysis::require_no_force_at_tip(const StepList &steps) const
  {
    const CrackTip &tip                 = intensity.region.tip;
    bool            is_held_along_crack = false;
    for (const FixedPoint<2> &fixed : fixed_points<2>(scene))
      for (unsigned int d = 0; d < 2; ++d)
        is_held_along_crack =
          is_held_along_crack ||
          (fixed.components[d] && std::abs(tip.ahead[d]) > 0.5 &&
           fixed.point.distance(tip.position) <
             1e-6 * intensity.region.cell_radius);
    if (!is_held_along_crack)
      return;
    const unsigned int axis       = std::abs(tip.ahead[0]) > 0.5 ? 0 : 1;
    const Vector       along      = rigid_modes(body.space)[axis];
    constexpr double   negligible = 1e-6;
    for (const double t : instants_of_extreme_loads(body, steps))
      {
        const Vector loads = loads_at(body, t);
        double       force = 0.;
        for (std::size_t i = 0; i < along.locally_owned_size(); ++i)
          force += along.local_element(i) * loads.local_element(i);
        force = Utilities::MPI::sum(force, body.space.communicator());
        if (std::abs(force) > negligible * loads.l1_norm())
          throw SceneError(
            "[Crack tip] Stress intensity = true: at t = " +
            Text::from_number(t) +
            " the loads push the body along the crack "
            "with the force " +
            Text::from_number(force) + ", which the support at the crack tip " +
            Text::from_point(tip.position) +
            " would bear: its stress has a singularity of its own there. Hold "
            "the body elsewhere ([Boundary] Clamped or Fixed points).");
      }
  }



  std::unique_ptr<CrackTipTable>
  CrackTipAnalysis::make_table(ContactSystemCache<2>            &systems,
                               const StepList                   &steps,
                               const std::optional<SecularFlow> &flow,
                               const CrackTipTable::File        &file,
                               Log                              &log) const
  {
    return std::make_unique<CrackTipTable>(
      *this, relative_energy_error(systems, steps), steps, flow, file, log);
  }



  std::optional<double>
  CrackTipAnalysis::c_star(const SecularFlow *flow) const
  {
    if (mean_load_vanishes)
      return 0.;
    if (!no_c_star.empty() || flow == nullptr)
      return {};
    Vector stress;
    body.points.initialize(stress);
    body.strain_operator.for_each_strain(
      flow->velocity,
      [&](const std::size_t offset, const VoigtVector<2> &strain_rate) {
        const std::size_t point = offset / QuadratureField<2>::n_components;
        QuadratureField<2>::set(stress,
                                offset,
                                viscosity->sum[point] * strain_rate);
      });
    const PlaneElasticity viscous(viscous_region->matrix);
    const double size = intensity.region.aligned_radius(viscous_region->radius);
    const double K =
      InteractionIntegral(body,
                          intensity.points,
                          intensity.region,
                          scene.loads,
                          {size, size, false})
        .of_uniform_body(stress, flow->contact_forces, viscous.kappa());
    return K * K / viscous.modulus();
  }



  void
  CrackTipAnalysis::summarise(const CrackTipTable &table,
                              const SecularFlow   *flow,
                              Summary             &summary,
                              Log                 &log) const
  {
    TipHistory history = table.last_period();
    history.c_star     = c_star(flow);
    if (history.instants.empty())
      return;
    double least_release = table.values().front().release_rate;
    double most_release = least_release, error = 0., energy = 0.;
    for (const CrackTipTable::Values &values : table.values())
      {
        least_release = std::min(least_release, values.release_rate);
        most_release  = std::max(most_release, values.release_rate);
        error         = std::max(error, values.error);
        energy        = std::max(energy, values.energy);
      }

    auto &tip                  = summary["crack_tip"];
    tip["method"]              = intensity.method();
    tip["why"]                 = intensity.why_no_integral();
    tip["position"]            = {intensity.region.tip.position[0],
                                  intensity.region.tip.position[1]};
    tip["radius"]              = intensity.radius();
    tip["K_I"]                 = {{"largest", history.largest()},
                                  {"smallest", history.least()}};
    tip["K_I_error"]           = error;
    tip["energy_release_rate"] = {{"largest", most_release},
                                  {"smallest", least_release}};
    tip["strain_energy"]       = {{"largest", energy}};
    tip["C_star"] = history.c_star ? Summary(*history.c_star) : Summary();
    if (!history.c_star)
      tip["no_C_star"] =
        no_c_star.empty() ? "the flow was not found" : no_c_star;
    char text[160];
    std::snprintf(text,
                  sizeof(text),
                  "  crack tip: K_I from %.6g to %.6g in the last period, "
                  "estimated error %.1e",
                  history.least(),
                  history.largest(),
                  error);
    log.line(text);
    warn_of_uncertainty(history, error, energy, summary, log);
    if (history.c_star && *history.c_star > 0.)
      log.line("  crack tip: C* = " + Text::from_number(*history.c_star));
    if (growth_law.empty())
      return;
    const double growth = growth_of_period(scene.crack_tip, history);
    tip["growth_law"]   = growth_law;
    tip["da_dN"]        = growth; // null if it is not finite
    if (!std::isfinite(growth))
      tip["no_da_dN"] = "the law gives no finite growth";
    tip["da_dt"] = growth / history.period();
    log.line("  crack tip: grows by " + Text::from_number(growth) +
             " a period (" + growth_law + ")");
  }



  void
  CrackTipAnalysis::warn_of_uncertainty(const TipHistory &history,
                                        const double      error,
                                        const double      energy,
                                        Summary          &summary,
                                        Log              &log) const
  {
    // A crack that stays closed has an intensity of rounding: the density of
    // the energy tells of which size others of its length would be.
    constexpr double large = 0.1, negligible = 1e-3;
    const double     density =
      energy / GridTools::volume(
                 static_cast<const Triangulation<2> &>(body.space.mesh()));
    const double usual = std::sqrt(body.law.stiffness_factor(0.) *
                                   intensity.elasticity(0.).modulus() *
                                   density * intensity.largest_radius());
    if (const double size =
          std::max(std::abs(history.largest()), std::abs(history.least()));
        error > large * size && size > negligible * usual)
      {
        const std::string warning =
          "[Crack tip] Stress intensity: K_I is uncertain by about " +
          Text::from_number(std::round(100. * error / size)) +
          " %; refine the mesh ([Refinement]) or use [Discretisation] "
          "Singular functions";
        summary["warnings"].push_back(warning);
        log.line("  warning: " + warning);
      }
  }
} // namespace Crevasse
