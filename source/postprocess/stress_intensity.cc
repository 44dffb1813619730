// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/crack_tip/known_fields.h>
#include <crevasse/postprocess/stress_intensity.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Instants at which moduli that may vary in time are checked. */
    std::vector<double>
    instants_of_variation(const bool varies, const StepList &steps)
    {
      std::vector<double> instants = {0.};
      if (varies)
        for (unsigned int k = 1; k < steps.n_steps(); ++k)
          instants.push_back(steps.instant(k));
      return instants;
    }



    /** @throw SceneError if K of a tip in a body of revolution is not known. */
    void
    require_ring(const CrackTip &tip, const std::string &setting)
    {
      if (!tip.two_lips && std::abs(tip.ahead[1]) > 1e-8)
        throw SceneError("[Material] Plane state = axisymmetric, " + setting +
                         ": the crack at " + Text::from_point(tip.position) +
                         " has one lip, and is not in a plane perpendicular to "
                         "the axis, which alone can be a plane of symmetry. "
                         "Model both lips ([Boundary] Crack), or set Stress "
                         "intensity = false.");
    }
  } // namespace



  StressIntensity::StressIntensity(
    const Scene                                &scene,
    const Body<2>                              &body,
    const CrackTip                             &tip,
    const StepList                             &steps,
    const std::shared_ptr<const PointGeometry> &geometry)
    : scene(scene)
    , body(body)
    , geometry(geometry)
    , points(*geometry)
    , region(body.space, tip, !body.effects.viscosity.on && !body.friction)
    , first_elasticity(find_elasticity(0.))
    , uniform(find_uniform_radii(steps))
    , uses_fit(scene.crack_tip.method == StressIntensityMethod::williams_fit)
    , why(find_reason(steps))
    , square(choose_square())
  {
    for (const double t :
         instants_of_variation(body.material.stiffness_varies, steps))
      elasticity(t);
    if (is_on_arc())
      {
        on_arc.emplace(body,
                       points,
                       region,
                       *first_elasticity.interface,
                       scene.loads,
                       std::array<double, 2>{{square.size, smaller_square()}});
        for (const double t :
             instants_of_variation(body.material.thermal_strain_varies, steps))
          on_arc->require_uniform(body.material.at(t));
        return;
      }
    for (const CrackMode mode : modes())
      integrals.emplace_back(mode, integrate(mode, false));
    if (first_elasticity.interface && !tip.is_open)
      of_closed_lips.emplace(integrate(CrackMode::sliding, true));
    if (!can_fit())
      return;
    fit_radius = choose_fit_radius();
    fits.emplace(
      points, body.lip, region, fit_radius, body.space.communicator());
  }



  StressIntensity::Integrals
  StressIntensity::integrate(const CrackMode mode, const bool is_closed) const
  {
    // The squares differ in cells at the tip, so that the difference of the
    // integrals shows the error of these cells.
    const auto over_square = [&](const double size, const unsigned int cells) {
      return InteractionIntegral(
        body,
        points,
        region,
        mode,
        scene.loads,
        {size,
         creep_square(size, cells),
         uniform.creep == 0.,
         body.space.roles.has_axis ? first_elasticity.kappa() : 0.,
         first_elasticity.anisotropic ? &*first_elasticity.anisotropic
                                      : nullptr,
         first_elasticity.interface ? &*first_elasticity.interface : nullptr,
         is_closed});
    };
    return {over_square(square.size, 2), over_square(smaller_square(), 3)};
  }



  TipElasticity
  StressIntensity::find_elasticity(const double t) const
  {
    const auto          interface = find_interface(t);
    const TipElasticity now =
      interface ? TipElasticity(*interface)
                : TipElasticity(stiffness_at(region.tip,
                                             body.space.mesh(),
                                             body.law,
                                             body.temperature,
                                             t,
                                             setting(scene)),
                                region.tip);
    const auto refuse = [&](const std::string &what) {
      throw SceneError(setting(scene) + ": at the crack tip " +
                       Text::from_point(region.tip.position) + ' ' + what +
                       ". Set Stress intensity = false.");
    };
    if (now.anisotropic && body.space.roles.has_axis)
      refuse(
        "the stiffness is not isotropic: the fields around the tip of a "
        "ring are known for isotropic bodies only");
    if (now.anisotropic && !region.tip.two_lips &&
        !now.anisotropic->is_symmetric())
      refuse(
        "the stiffness is not symmetric about the line of the crack, so "
        "that this line is no plane of symmetry. Model both lips");
    if (t == 0.)
      return now; // first_elasticity is being made
    const bool is_other =
      now.has_only_release_rate() || first_elasticity.has_only_release_rate()
        ? !now.is_same_as(first_elasticity)
        : body.space.roles.has_axis &&
            std::abs(now.kappa() - first_elasticity.kappa()) > 1e-8;
    if (is_other)
      refuse((now.has_only_release_rate()
                ? "the stiffness, which is not isotropic, or not the same on "
                  "both sides"
                : "Poisson's ratio, with [Material] Plane state = "
                  "axisymmetric") +
             std::string(", must not vary in time, and does at t = ") +
             Text::from_number(t));
    return now;
  }



  StressIntensity::UniformRadii
  StressIntensity::find_uniform_radii(const StepList &steps) const
  {
    UniformRadii radii{region.largest_radius(), region.largest_radius()};
    const bool   by_side = first_elasticity.interface.has_value();
    const bool   varies =
      body.material.stiffness_varies || body.material.fluidity_varies;
    for (const double t : instants_of_variation(varies, steps))
      {
        if (radii.stiffness == 0.)
          break;
        const MaterialState<2> material = body.material.at(t);
        radii.stiffness =
          std::min(radii.stiffness,
                   region.uniform(points, *material.stiffness, by_side).radius);
        for (const auto &fluidity : material.fluidity)
          {
            const auto [above, radius, below] =
              region.uniform(points, *fluidity, by_side);
            const bool is_known = first_elasticity.leaves_stress(above, below);
            radii.creep         = std::min(radii.creep, is_known ? radius : 0.);
          }
      }
    radii.creep = std::min(radii.creep, radii.stiffness);
    return radii;
  }



  std::string
  StressIntensity::find_reason(const StepList &steps) const
  {
    const std::string setting =
      "[Crack tip] Method = " + name_of(scene.crack_tip.method);
    if (uses_fit && (region.tip.two_lips || first_elasticity.anisotropic))
      throw SceneError(setting +
                       ": is for cracks with one lip, on a plane of symmetry, "
                       "in isotropic bodies. Set it to automatic.");
    if (body.space.roles.has_axis)
      require_ring(region.tip, StressIntensity::setting(scene));
    if (uses_fit)
      return setting;
    for (const double t :
         instants_of_variation(body.material.fluidity_varies, steps))
      for (const auto &branch : body.law.branches)
        {
          const bool by_side = first_elasticity.interface.has_value();
          const auto limits  = limits_at(branch.fluidity, t, by_side);
          if (limits &&
              first_elasticity.leaves_stress((*limits)[0], (*limits)[1]))
            continue;
          const std::string reason =
            first_elasticity.anisotropic
              ? "the stiffness at the crack tip is anisotropic and the "
                "viscosity not proportional to it"
            : by_side
              ? "the materials at the crack tip do not have the same "
                "relaxation time"
              : "the viscosity at the crack tip is anisotropic in the plane, "
                "or differs between its sides";
          if (!can_fit())
            throw SceneError(setting + ": " + reason +
                             ", so that the field there is not known. Set "
                             "[Crack tip] Stress intensity = false.");
          return reason;
        }
    return "";
  }



  StressIntensity::Square
  StressIntensity::choose_square() const
  {
    constexpr double least = 0.25;
    const double     end   = region.largest_radius();
    const double     wish  = scene.crack_tip.radius;
    if (is_on_arc())
      return {square_on_arc(), 0.};
    // Viscous strain does not enter where creep is uniform.
    const double most = uniform.creep >= least * end ? uniform.creep : end;
    // Fields of known K are those of straight lips in the plane.
    if (uses_fit || region.has_bends())
      return {region.square(wish, wish > 0. || uses_fit ? end : most), 0.};
    const KnownFields fields(body, region);
    const auto        error = [&](const double size, const CrackMode mode) {
      const InteractionIntegral integral(
        body, points, region, mode, scene.loads, {size, size, false});
      return fields.error_of(integral, mode);
    };
    const auto over = [&](const double size) {
      return Square{size, error(size, CrackMode::opening)};
    };
    const auto with_T = [&](Square square) {
      if (has_t_stress())
        square.error_of_T = error(square.size, CrackMode::constant);
      return square;
    };
    if (wish > 0.)
      return with_T(over(region.square(wish, end)));
    Square best = over(region.aligned_radius(most));
    double last = best.size;
    for (double part = 1.; part >= least; part *= std::sqrt(0.5))
      if (const double size = region.aligned_radius(part * most);
          size < 0.99 * last && size >= region.cell_radius)
        {
          const Square next = over(last = size);
          // Smaller squares see more of the errors outside of them.
          if (next.error / next.size < best.error / best.size)
            best = next;
        }
    return with_T(best);
  }



  double
  StressIntensity::creep_square(const double       size,
                                const unsigned int cells) const
  {
    if (!body.effects.viscosity.on)
      return size;
    const double several = cells * region.cell_radius;
    if (uniform.creep == 0.)
      return region.aligned_radius(std::min(0.5 * size, several));
    const double most = std::min(uniform.creep, size);
    // The error is of the order of a^(5/2).
    constexpr double part = 0.25;
    return is_disturbed() ? region.aligned_radius(
                              std::min(most, std::max(part * size, several)))
                          : most;
  }



  double
  StressIntensity::choose_fit_radius() const
  {
    if (scene.crack_tip.radius > 0. && uses_fit)
      return scene.crack_tip.radius;
    // The smaller disc, of half this radius, must contain enough points.
    const double least =
      2. * WilliamsFit::least_radius(points, region, body.space.communicator());
    constexpr double part = 0.5;
    return std::min(uniform_radius(),
                    std::max({least,
                              2. * region.cell_radius,
                              is_disturbed() ? 0. : part * uniform.creep}));
  }



  StressIntensity::Estimate
  StressIntensity::evaluate(const double            t,
                            const Sample           &sample,
                            const MaterialState<2> &material,
                            const TipElasticity    &at_tip) const
  {
    Estimate   all{};
    const auto integrate = [&](const CrackMode      mode,
                               const Integrals     &squares,
                               const ContactForces &lips) {
      const auto &[large, small] = squares;
      const double value = large.value(t, sample, lips, material, at_tip),
                   check = small.value(t, sample, lips, material, at_tip);
      const bool is_T    = mode == CrackMode::constant;
      (is_T ? all.t_stress : all.intensity[unsigned(mode)]) = value;
      (is_T ? all.t_stress_error : all.error[unsigned(mode)]) =
        std::abs(value - check);
      if (mode == CrackMode::opening)
        all.of_stress = check;
    };
    const ContactForces &lips = sample.state.contact_forces;
    if (first_elasticity.interface)
      {
        if (!region.tip.is_open)
          all.contact_zone =
            std::min(contact_zone(body.lip, region.tip, sample.state),
                     first_elasticity.interface->length);
        if (on_arc)
          {
            const auto [K, errors] = on_arc->evaluate(
              t, sample, material, all.contact_zone, is_wide(all.contact_zone));
            all.intensity = K;
            all.error     = errors;
            all.of_stress = K[0];
            return all;
          }
        if (is_wide(all.contact_zone))
          {
            integrate(CrackMode::sliding, *of_closed_lips, lips);
            return all;
          }
        const ContactForces beyond =
          forces_beyond(all.contact_zone, body.lip, region.tip, lips);
        for (const auto &[mode, squares] : integrals)
          integrate(mode, squares, beyond);
        return all;
      }
    const double open = open_length(body.lip, region.tip, sample.state);
    // After creep a closed tip may have singular stress.
    const bool is_closed =
      open == 0. && !region.tip.is_open && !body.effects.viscosity.on;
    for (const auto &[mode, squares] : integrals)
      if (!uses_fit && (mode != CrackMode::opening || !is_closed))
        integrate(mode, squares, lips);
    if (const double wrong = 0.5 * region.path.first_bend(); wrong > 0.)
      {
        // What a turn of the tip changes (Cotterell and Rice 1980).
        all.error[0] += std::abs(1.5 * wrong * all.intensity[1]);
        all.error[1] += std::abs(0.5 * wrong * all.intensity[0]);
      }
    if (!fits || is_closed)
      return all;
    const Vector        &stress = sample.state.stress;
    const ContactForces &g      = sample.state.contact_forces;
    const WilliamsFit   &fit    = fits->within(open);
    all.of_stress               = fit.value(stress, g);
    if (uses_fit)
      {
        all.intensity[0] = all.of_stress;
        all.error[0]     = std::abs(fit.correction(stress, g));
      }
    else if (!why.empty())
      all.error[0] =
        std::max(all.error[0], std::abs(all.intensity[0] - all.of_stress));
    return all;
  }
} // namespace Crevasse
