// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/discretisation/rigid_modes.h>
#include <crevasse/model/largest_load.h>
#include <crevasse/postprocess/crack_tip_analysis.h>

namespace Crevasse
{
  using namespace dealii;

  CrackTipAnalysis::CrackTipAnalysis(
    const Scene                                &scene,
    const Body<2>                              &body,
    const CrackTip                             &tip,
    const SecularSplit                         &split,
    const StepList                             &steps,
    const std::shared_ptr<const PointGeometry> &geometry)
    : scene(scene)
    , body(body)
    , intensity(scene, body, tip, steps, geometry)
    , energy(body.material, intensity.points)
    , has_temperature(!body.temperature.is_zero())
    , has_singular_functions(body.space.singular_shapes() != nullptr &&
                             !body.effects.viscosity.on &&
                             !body.material.stiffness_varies)
    , creep(body, split)
  {
    if (creep.no_c_star.empty())
      find_viscous_region();
    if (needs_c_star(scene.crack_tip) && !creep.no_c_star.empty() &&
        !creep.mean_load_vanishes)
      throw SceneError(
        "[Crack tip] Creep growth parameter = C star: there is no C*: " +
        creep.no_c_star + ". Set Creep growth parameter = stress intensity.");
    require_no_force_at_tip(scene, body, intensity.region, steps);
    require_growth_constants(scene.crack_tip,
                             body.temperature,
                             tip.position,
                             steps);
  }



  void
  CrackTipAnalysis::find_viscous_region()
  {
    viscous_region =
      intensity.region.uniform(intensity.points, creep.viscosity->sum);
    if (viscous_region->radius <= 0. ||
        !PlaneElasticity::is_isotropic(viscous_region->matrix))
      creep.no_c_star =
        "the viscosity is anisotropic, or not the same in all cells at the "
        "crack tip";
  }



  std::string
  CrackTipAnalysis::describe() const
  {
    const std::string &why = intensity.why;
    const std::string  law = describe_growth_law(scene.crack_tip);
    return "  crack tip: " + Text::from_point(intensity.region.tip.position) +
           ", K_I" +
           (intensity.region.tip.two_lips ? " and K_II by " : " by ") +
           intensity.method() + intensity.describe_interface() +
           (why.empty() ? "" : " (" + why + ")") +
           (law.empty() ? "" : "; " + law);
  }



  void
  require_no_force_at_tip(const Scene     &scene,
                          const Body<2>   &body,
                          const TipRegion &region,
                          const StepList  &steps)
  {
    const CrackTip &tip     = region.tip;
    bool            is_held = false;
    for (const FixedPoint<2> &fixed : fixed_points<2>(scene))
      for (unsigned int d = 0; d < 2; ++d)
        is_held =
          is_held ||
          (fixed.components[d] &&
           (tip.two_lips || std::abs(tip.ahead[d]) > 1e-10) &&
           fixed.point.distance(tip.position) < 1e-6 * region.cell_radius);
    if (!is_held)
      return;
    // The plane of symmetry bears forces across the crack; without it there
    // must be no force and no moment.
    using Motion = std::array<double, 3>;
    const std::vector<Motion> motions =
      tip.two_lips
        ? std::vector<Motion>{{{1., 0., 0.}}, {{0., 1., 0.}}, {{0., 0., 1.}}}
        : std::vector<Motion>{{{tip.ahead[0], tip.ahead[1], 0.}}};
    const std::vector<Vector> modes      = rigid_modes(body.space);
    constexpr double          negligible = 1e-6;
    for (const double t : instants_of_extreme_loads(body, steps))
      for (const Motion &motion : motions)
        {
          const Vector loads = loads_at(body, t);
          double       force = 0.;
          for (unsigned int m = 0; m < modes.size(); ++m)
            // modes may lack singular unknowns: they move nothing
            for (std::size_t i = 0; i < modes[m].locally_owned_size(); ++i)
              force +=
                motion[m] * modes[m].local_element(i) * loads.local_element(i);
          force = Utilities::MPI::sum(force, body.space.communicator());
          if (std::abs(force) > negligible * loads.l1_norm())
            throw SceneError(
              "[Crack tip]: at t = " + Text::from_number(t, 6) + " the loads " +
              (tip.two_lips ? "are not in equilibrium"
                            : "push the body along the crack") +
              ", with the resultant " + Text::from_number(force, 3) +
              ", which the support at the crack tip " +
              Text::from_point(tip.position) +
              " would bear: its stress has a singularity of its own there. "
              "Hold the body elsewhere ([Boundary] Clamped or Fixed points).");
        }
  }



  std::optional<double>
  CrackTipAnalysis::c_star(const std::optional<SecularFlow> &flow) const
  {
    if (creep.mean_load_vanishes)
      return 0.;
    if (!creep.no_c_star.empty() || !flow)
      return {};
    const Vector          stress = creep.stress(*flow);
    const PlaneElasticity viscous(viscous_region->matrix);
    const double size = intensity.region.aligned_radius(viscous_region->radius);
    double       c_star = 0.;
    for (const CrackMode mode : intensity.modes())
      if (mode != CrackMode::constant)
        {
          const double K =
            InteractionIntegral(body,
                                intensity.points,
                                intensity.region,
                                mode,
                                scene.loads,
                                {size,
                                 size,
                                 false,
                                 body.space.roles.has_axis ? viscous.kappa()
                                                           : 0.})
              .of_uniform_body(stress, flow->contact_forces, viscous.kappa());
          c_star += K * K / (creep.factor() * viscous.modulus());
        }
    return c_star;
  }



  double
  CrackTipAnalysis::of_singular_function(const CrackMode         mode,
                                         const Vector           &displacement,
                                         const MaterialState<2> &material) const
  {
    double sum = 0.;
    if (has_singular_functions)
      for (unsigned int k = 0; k < body.space.singular_shapes()->size(); ++k)
        {
          const auto &function = body.space.singular_shapes()->functions[k];
          const auto  unknown  = body.space.singular_unknown(k);
          if (function.mode == mode &&
              function.tip.position == intensity.region.tip.position &&
              displacement.in_local_range(unknown))
            sum += function.stress_intensity * displacement(unknown);
        }
    return material.stiffness_factor *
           Utilities::MPI::sum(sum, body.space.communicator());
  }



  std::vector<std::unique_ptr<const CrackTipAnalysis>>
  analyse_crack_tips(const Scene          &scene,
                     const Body<2>        &body,
                     const SecularSplit   &split,
                     const StepList       &steps,
                     std::vector<Summary> &without)
  {
    const auto geometry =
      std::make_shared<const PointGeometry>(body.space, body.points);
    std::vector<std::unique_ptr<const CrackTipAnalysis>> all;
    for (const CrackTip &tip : crack_tips(body.space.mesh(),
                                          body.space.roles,
                                          StressIntensity::setting(scene)))
      try
        {
          all.push_back(std::make_unique<const CrackTipAnalysis>(
            scene, body, tip, split, steps, geometry));
        }
      catch (const SceneError &error)
        {
          if (scene.crack_tip.demands_stress_intensity())
            throw;
          without.push_back(place_of(tip));
          without.back()["no_K"] = error.what();
        }
    return all;
  }



  void
  CrackTipAnalysis::summarise_growth(const TipHistory  &history,
                                     const std::string &title,
                                     Summary           &tip,
                                     Log               &log) const
  {
    tip["C_star"] = history.c_star ? Summary(*history.c_star) : Summary();
    if (!history.c_star)
      tip["no_C_star"] =
        creep.no_c_star.empty() ? "the flow was not found" : creep.no_c_star;
    if (history.c_star && *history.c_star > 0.)
      log.line(title + "C* = " + Text::from_number(*history.c_star, 5));
    Crevasse::summarise_growth(scene.crack_tip, history, title, tip, log);
  }
} // namespace Crevasse
