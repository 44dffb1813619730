// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// The parts of StressIntensity for tips between two materials.

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/postprocess/stress_intensity.h>

namespace Crevasse
{
  using namespace dealii;

  std::optional<InterfaceTip::Sides>
  StressIntensity::limits_at(const Property<VoigtMatrix<2>> &property,
                             const double                    t,
                             const bool                      by_side) const
  {
    const auto of = [&](const double side) {
      return limit_at(
        region.tip, body.space.mesh(), property, body.temperature, t, side);
    };
    const auto above = of(by_side ? 1. : 0.), below = by_side ? of(-1.) : above;
    if (!above || !below)
      return {};
    return InterfaceTip::Sides{{*above, *below}};
  }



  std::optional<InterfaceTip>
  StressIntensity::find_interface(const double t) const
  {
    const Property<VoigtMatrix<2>> &stiffness = body.law.stiffness;
    if (!region.tip.two_lips || body.space.roles.has_axis ||
        limits_at(stiffness, t, false))
      return {};
    const auto sides = limits_at(stiffness, t, true);
    if (!sides || !PlaneElasticity::is_isotropic((*sides)[0]) ||
        !PlaneElasticity::is_isotropic((*sides)[1]))
      return {};
    const auto refuse = [&](const std::string &what) {
      throw SceneError(setting(scene) + ": the crack tip " +
                       Text::from_point(region.tip.position) +
                       " is between two materials, where K is not known " +
                       what + ". Set Stress intensity = false.");
    };
    if (body.friction && !region.tip.is_open)
      refuse("with friction");
    if (body.effects.viscosity.on && !region.tip.is_open)
      refuse(
        "of lips that touch in a body that creeps ([Boundary] Open crack is of "
        "lips that never do)");
    if (region.path.is_curved())
      for (const auto &[is_so, what] :
           {std::pair(body.space.finite_element.degree < 2,
                      "along an arc with [Discretisation] Degree = 1"),
            std::pair(body.lip.has_gap, "along an arc with a [Boundary] Gap"),
            std::pair(body.space.roles.has_loaded_lip(),
                      "along an arc with loads on lips")})
        if (is_so)
          refuse(what);
    return InterfaceTip(*sides, region.path.length());
  }



  double
  StressIntensity::square_on_arc() const
  {
    if (uniform.stiffness == 0.)
      throw SceneError(setting(scene) + ": the crack tip " +
                       Text::from_point(region.tip.position) +
                       " is on an arc between two materials, where K is known "
                       "if the moduli of each are uniform, but in the cells at "
                       "the tip they vary. Set Stress intensity = false.");
    // The fields of unit intensities are singular in the centre of the circle.
    constexpr double part = 0.7;
    return region.square(scene.crack_tip.radius,
                         std::min(uniform.stiffness,
                                  part / std::abs(region.tip.curvature)));
  }



  std::string
  StressIntensity::describe_interface() const
  {
    const auto &interface = first_elasticity.interface;
    return interface ? Text::format(
                         ", between two materials with epsilon = "
                         "%.4g, at the distance %.4g",
                         interface->epsilon(),
                         interface->length)
                     : "";
  }
} // namespace Crevasse
