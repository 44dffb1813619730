// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/discretisation/rigid_modes.h>
#include <crevasse/model/largest_load.h>
#include <crevasse/postprocess/crack_front_analysis.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    const std::string setting = "[Crack tip] Stress intensity = true";

    constexpr double rounding = 1e-8;
  } // namespace



  CrackFrontAnalysis::CrackFrontAnalysis(const Scene        &scene,
                                         const Body<3>      &body,
                                         const SecularSplit &split,
                                         const StepList     &steps)
    : body(body)
    , region(body.space, setting)
    , radius(region.tube(scene.crack_tip.radius, region.largest_radius()))
    , elasticity(find_elasticity())
    , creep(body, split)
  {
    require_no_force_at_front(scene, body, region, steps, setting);
    const auto &vertices = region.vertices;
    for (std::size_t v = 0; v < vertices.size(); ++v)
      if (region.curve.two_lips && vertices[v].before == 0. &&
          vertices[v + 1].after == 0.)
        throw SceneError(setting + ": the crack front at " +
                         Text::from_point(vertices[v].point) +
                         " has one element, but K_III needs two. Use a finer "
                         "mesh.");
    const bool two_lips = region.curve.two_lips;
    for (const CrackMode mode :
         {CrackMode::opening, CrackMode::sliding, CrackMode::tearing})
      if (two_lips || mode == CrackMode::opening)
        {
          const auto within = [&](const double size) {
            return FrontIntegral(body,
                                 region,
                                 scene.loads,
                                 {mode, two_lips, elasticity, {size, 4}});
          };
          // Cells at the front may fill the tube: a part of them tells more of
          // the error than the same tube would.
          integrals.emplace_back(within(radius),
                                 within(std::max(0.5 * radius,
                                                 std::min(region.cell_radius,
                                                          0.7 * radius))));
        }
  }



  std::optional<VoigtMatrix<3>>
  CrackFrontAnalysis::uniform_in_tube(
    const PointValues<VoigtMatrix<3>> &matrices) const
  {
    const MPI_Comm              communicator = body.space.communicator();
    std::set<std::size_t>       seen;
    std::vector<VoigtMatrix<3>> own;
    for (const auto &cell : owned_cells(body.space.mesh()))
      if (region.is_near(cell, radius))
        for (unsigned int p = 0; p < body.space.quadrature(cell).size(); ++p)
          if (const std::size_t point = body.points.first_point(cell) + p;
              seen.insert(matrices.index(point)).second)
            if (own.empty() || (matrices[point] - own.front()).norm() >
                                 rounding * own.front().norm())
              own.push_back(matrices[point]);
    const std::vector<VoigtMatrix<3>> all = of_all_ranks(communicator, own);
    for (const VoigtMatrix<3> &matrix : all)
      if ((matrix - all.front()).norm() > rounding * all.front().norm())
        return {};
    return all.front();
  }



  FrontElasticity
  CrackFrontAnalysis::find_elasticity() const
  {
    if (body.material.stiffness_varies)
      throw SceneError(setting +
                       ": in three dimensions the stiffness may depend on time "
                       "only by [Material] Stiffness time factor.");
    const auto stiffness = uniform_in_tube(*body.material.at(0.).stiffness);
    if (!stiffness)
      throw SceneError(
        setting +
        ": in space the stiffness must be the same at all points within " +
        Text::from_number(radius) +
        " of the crack front; lower [Crack tip] Radius, or turn this off.");
    const double mu = (*stiffness)[3][3], lambda = (*stiffness)[0][1];
    const double nu = lambda / (2. * (lambda + mu)), E = 2. * mu * (1. + nu);
    if ((isotropic_stiffness<3>(E, nu, false) - *stiffness).norm() >
        rounding * stiffness->norm())
      throw SceneError(setting +
                       ": the stiffness at the crack front is not isotropic "
                       "([Material] Stiffness), but this program knows the "
                       "fields there for isotropic bodies only.");
    if (body.effects.viscosity.on)
      require_compatible_creep(*stiffness);
    return {E, nu};
  }



  void
  CrackFrontAnalysis::require_compatible_creep(
    const VoigtMatrix<3> &stiffness) const
  {
    if (const auto strain = Effects::first_on(body.effects.free_strains))
      throw SceneError(setting +
                       ": in space K_I of a body with viscosity and " +
                       strain->name +
                       " is not known to this program. Set [Material] "
                       "Viscosity = none, or turn this off.");
    const MaterialState<3> material = body.material.at(0.);
    for (const auto &fluidity : material.fluidity)
      {
        const auto     H = uniform_in_tube(*fluidity);
        VoigtMatrix<3> rest;
        if (H)
          {
            rest           = *H * stiffness;
            const double c = trace(rest) / 6.;
            for (unsigned int i = 0; i < 6; ++i)
              rest[i][i] -= c;
          }
        if (body.material.fluidity_varies || !H ||
            rest.norm() > rounding * H->norm() * stiffness.norm())
          throw SceneError(
            setting +
            ": in space K_I is known only where viscosity is proportional to "
            "stiffness, the same at all points within " +
            Text::from_number(radius) +
            " of the crack front and at all times: set [Material] Relaxation "
            "time or Chain to numbers, and leave Viscous Poisson ratio as it "
            "is; or turn this off.");
      }
  }



  std::vector<bool>
  CrackFrontAnalysis::stay_closed(const State &state) const
  {
    const auto       &vertices = region.vertices;
    std::vector<bool> closed(vertices.size());
    if (body.effects.viscosity.on || !body.space.roles.open.empty())
      return closed;
    // Distances to the nearest closed nodes and to the nearest open nodes.
    std::vector<double> least(2 * closed.size(),
                              std::numeric_limits<double>::max());
    const auto          states =
      body.lip.states(state.displacement, state.contact_forces);
    for (std::size_t i = 0; i < states.size(); ++i)
      if (const auto &node = body.space.lip.nodes[i]; node.has_unknown())
        for (std::size_t v = 0; v < closed.size(); ++v)
          {
            double &near = least[v + (states[i].is_closed ? 0 : closed.size())];
            near = std::min(near, node.point.distance(vertices[v].point));
          }
    for (std::size_t v = 0; v < closed.size(); ++v)
      closed[v] = least[v] < (1. - rounding) * least[closed.size() + v];
    return closed;
  }



  std::string
  CrackFrontAnalysis::describe() const
  {
    double length = 0.;
    for (const auto &chain : region.curve.chains())
      length += chain.length();
    return "  crack front: length " + Text::from_number(length, 5) + ", " +
           std::to_string(region.vertices.size()) + " vertices, " +
           Text::join(names(), ", ") + " by interaction integral up to " +
           Text::from_number(radius, 5) + " from it";
  }



  std::vector<CrackFrontAnalysis::Estimate>
  CrackFrontAnalysis::evaluate(const double t, const Sample &sample) const
  {
    const MaterialState<3> material = body.material.at(t);
    std::vector<Estimate>  all(region.vertices.size());
    const auto             closed = stay_closed(sample.state);
    for (unsigned int m = 0; m < integrals.size(); ++m)
      {
        const auto &[large, small] = integrals[m];
        const auto   K             = large.values(t, sample, material);
        const auto   check         = small.values(t, sample, material);
        const double modulus =
          material.stiffness_factor * elasticity.modulus(large.fields.mode);
        for (std::size_t v = 0; v < K.size(); ++v)
          {
            if (closed[v] && large.fields.mode == CrackMode::opening)
              continue;
            all[v].intensity[m] = K[v];
            all[v].error[m]     = std::abs(K[v] - check[v]);
            all[v].release_rate += K[v] * K[v] / modulus;
          }
      }
    return all;
  }



  std::vector<CrackFrontAnalysis::Value>
  CrackFrontAnalysis::c_star(const std::optional<SecularFlow> &flow) const
  {
    if (creep.mean_load_vanishes)
      return std::vector<Value>(region.vertices.size());
    if (!creep.no_c_star.empty() || !flow)
      return {};
    const Vector stress = creep.stress(*flow);
    // require_compatible_creep() has made sure that this is a time.
    const double time = 2. * creep.factor() *
                        (*uniform_in_tube(creep.viscosity->sum))[3][3] /
                        elasticity.modulus(CrackMode::tearing);
    std::vector<Value> all(region.vertices.size());
    for (const auto &[large, small] : integrals)
      {
        const auto   K       = large.values(stress, flow->contact_forces);
        const auto   check   = small.values(stress, flow->contact_forces);
        const double modulus = time * elasticity.modulus(large.fields.mode);
        for (std::size_t v = 0; v < K.size(); ++v)
          {
            all[v].value += K[v] * K[v] / modulus;
            all[v].error += (K[v] * K[v] - check[v] * check[v]) / modulus;
          }
      }
    for (Value &value : all)
      value.error = std::abs(value.error);
    return all;
  }



  void
  require_no_force_at_front(const Scene       &scene,
                            const Body<3>     &body,
                            const FrontRegion &region,
                            const StepList    &steps,
                            const std::string &wanted_by)
  {
    const auto points = fixed_points<3>(scene);
    const auto held =
      std::find_if(points.begin(), points.end(), [&](const auto &fixed) {
        return region.curve.frame(fixed.point).distance() <
               0.5 * region.cell_radius;
      });
    if (held == points.end())
      return;
    const auto       modes      = rigid_modes(body.space);
    constexpr double negligible = 1e-6;
    for (const double t : instants_of_extreme_loads(body, steps))
      {
        const Vector loads = loads_at(body, t);
        // Force along the axes, and moment in the planes 12, 13 and 23.
        Tensor<1, 3> force, moment;
        for (unsigned int m = 0; m < 6; ++m)
          {
            double work = 0.;
            for (std::size_t i = 0; i < loads.locally_owned_size(); ++i)
              work += modes[m].local_element(i) * loads.local_element(i);
            (m < 3 ? force[m] : moment[5 - m]) =
              (m == 4 ? -1. : 1.) *
              Utilities::MPI::sum(work, body.space.communicator());
          }
        if (!region.curve.two_lips)
          { // others: plane of symmetry
            const Tensor<1, 3> n = region.curve.chains().front().inward;
            force -= (force * n) * n;
            moment = (moment * n) * n;
          }
        if (std::max(force.norm(), moment.norm()) >
            negligible * loads.l1_norm())
          throw SceneError(wanted_by + ": at t = " + Text::from_number(t) +
                           " the support at " + Text::from_point(held->point) +
                           " on the crack front has to bear loads: its stress "
                           "has a singularity of its own there. Hold the body "
                           "elsewhere ([Boundary] Clamped or Fixed points).");
      }
  }
} // namespace Crevasse
