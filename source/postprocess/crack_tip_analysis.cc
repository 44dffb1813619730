// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/discretisation/rigid_modes.h>
#include <crevasse/discretisation/stress_estimator.h>
#include <crevasse/model/elastic_displacement.h>
#include <crevasse/model/largest_load.h>
#include <crevasse/model/secular.h>
#include <crevasse/postprocess/crack_tip_analysis.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

namespace Crevasse
{
  using namespace dealii;

  CrackTipAnalysis::CrackTipAnalysis(const Scene        &scene,
                                     const Body<2>      &body,
                                     const SecularSplit &split,
                                     const StepList     &steps)
    : scene(scene)
    , body(body)
    , points(body.space, body.points)
    , choice(choose_crack_tip_method(scene, body))
    , region(body.space, points, *body.material.at(0.).stiffness, "stiffness")
    , radius(choose_radius())
    , fits(points,
           body.lip,
           region,
           choose_fit_radius(),
           body.space.communicator())
    , energy(body.material, points)
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



  double
  CrackTipAnalysis::choose_radius() const
  {
    const double wish = scene.crack_tip.radius;
    if (wish == 0.)
      return region.aligned_radius(region.largest_radius());
    constexpr double rounding = 1e-10;
    if (wish > region.largest_radius() * (1. + rounding) ||
        wish < region.cell_radius() * (1. - rounding))
      {
        std::ostringstream message;
        message << "[Crack tip] Radius = " << wish << ": must be at most "
                << region.largest_radius()
                << ", where another boundary or another stiffness begins, and "
                   "at least "
                << region.cell_radius()
                << ", where the cells at the tip end; or 0.";
        throw SceneError(message.str());
      }
    return wish;
  }



  double
  CrackTipAnalysis::choose_fit_radius() const
  {
    if (scene.crack_tip.radius > 0.)
      return scene.crack_tip.radius;
    // The smaller disc, of half this radius, needs data.
    const double least =
      2. * WilliamsFit::least_radius(points, region, body.space.communicator());
    constexpr double part = 0.5;
    return std::min(region.largest_radius(),
                    std::max({least,
                              2. * region.cell_radius(),
                              part * homogeneous_radius()}));
  }



  double
  CrackTipAnalysis::homogeneous_radius() const
  {
    double radius = region.largest_radius();
    for (const auto &fluidity : body.material.at(0.).fluidity)
      try
        {
          if (!fluidity->is_uniform())
            radius =
              std::min(radius,
                       TipRegion(body.space,
                                 points,
                                 transform(*fluidity,
                                           body.points.n_local_points(),
                                           PlaneElasticity::like_stiffness),
                                 "fluidity")
                         .largest_radius());
        }
      catch (const SceneError &)
        {
          return 0.; // It varies from the tip on.
        }
    return radius;
  }



  std::string
  CrackTipAnalysis::find_viscous_region(const SecularSplit &split)
  {
    if (!split.effect.on)
      return split.effect.why;
    if (const auto force = Effects::first_on(body.effects.volume_forces))
      return "there is a " + force->name + ", which the integral does not know";
    const MaterialState<2>      material = body.material.at(0.);
    std::optional<Viscosity<2>> viscosity;
    collectively(body.space.communicator(), [&]() {
      viscosity = viscosity_of<2>(material, body.points.n_local_points());
    });
    try
      {
        viscous_region.emplace(body.space, points, viscosity->sum, "viscosity");
      }
    catch (const SceneError &)
      {
        return "the viscosity is not isotropic and the same in all cells at "
               "the crack tip";
      }
    return "";
  }



  std::string
  CrackTipAnalysis::describe() const
  {
    return "  crack tip: " + Text::from_point(region.tip().position) +
           ", K_I by " + choice.name() + " (" + choice.why + ")" +
           (growth_law.empty() ? "" : "; " + growth_law);
  }



  double
  CrackTipAnalysis::modulus(const double t) const
  {
    const double k = body.law.stiffness_factor(t);
    if (!body.material.stiffness_varies())
      return k * region.elasticity().modulus();
    return k * elasticity_at(region.tip(),
                             body.space.mesh(),
                             body.law,
                             body.temperature,
                             t,
                             "[Crack tip] Stress intensity = true")
                 .modulus();
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
      if (region.is_of_tip(cell->active_cell_index()))
        sum += squares(cell->active_cell_index());
    return Utilities::MPI::sum(sum, body.space.communicator());
  }



  void
  CrackTipAnalysis::require_no_force_at_tip(const StepList &steps) const
  {
    const CrackTip &tip                 = region.tip();
    bool            is_held_along_crack = false;
    for (const FixedPoint<2> &fixed : fixed_points<2>(scene))
      for (unsigned int d = 0; d < 2; ++d)
        is_held_along_crack =
          is_held_along_crack ||
          (fixed.components[d] && std::abs(tip.ahead[d]) > 0.5 &&
           fixed.point.distance(tip.position) < 1e-6 * region.cell_radius());
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
    std::optional<CrackTipTable::Integrals> integrals;
    if (choice.integral)
      {
        const UnilateralBounds bounds = unilateral_bounds(body.lip, body.space);
        const auto             influence_on = [&](const Vector &functional) {
          return elastic_displacement<2>(
            scene, body, systems, functional, false);
        };
        const auto over_square = [&](const double size) {
          const IntensityFunctional integral =
            interaction_integral(body, region, size);
          return weight_function(influence_on(integral.of_vector),
                                 bounds,
                                 integral.of_contact_forces);
        };
        const double small =
          std::max(region.aligned_radius(0.5 * radius), region.cell_radius());
        integrals.emplace(CrackTipTable::Integrals{over_square(radius),
                                                   over_square(small),
                                                   {}});
        if (const SingularShapes *shapes = body.space.singular_shapes())
          {
            const auto first = body.space.singular_unknown(0);
            Vector     coefficient;
            body.strain_operator.initialize(coefficient);
            if (coefficient.in_local_range(first))
              coefficient(first) = shapes->functions().unit_stress_intensity;
            integrals->singular =
              weight_function(influence_on(coefficient), bounds, {});
          }
      }
    return std::make_unique<CrackTipTable>(*this,
                                           std::move(integrals),
                                           relative_energy_error(systems,
                                                                 steps),
                                           steps,
                                           flow,
                                           file,
                                           log);
  }



  std::optional<double>
  CrackTipAnalysis::c_star(const SecularFlow *flow) const
  {
    if (mean_load_vanishes)
      return 0.;
    if (!viscous_region || flow == nullptr)
      return {};
    const double K = interaction_integral(body,
                                          *viscous_region,
                                          viscous_region->aligned_radius(
                                            viscous_region->largest_radius()))
                       .value(flow->velocity, flow->contact_forces);
    return K * K / viscous_region->elasticity().modulus();
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

    auto &tip        = summary["crack_tip"];
    tip["method"]    = choice.name();
    tip["why"]       = choice.why;
    tip["position"]  = {region.tip().position[0], region.tip().position[1]};
    tip["radius"]    = choice.integral ? radius : choose_fit_radius();
    tip["K_I"]       = {{"largest", history.largest()},
                        {"smallest", history.least()}};
    tip["K_I_error"] = error;
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
    const double usual =
      std::sqrt(modulus(0.) * density * region.largest_radius());
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
