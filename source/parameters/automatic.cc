// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/parameters/automatic.h>
#include <crevasse/parameters/built_in_boundary.h>
#include <crevasse/parameters/effects.h>

#include <algorithm>

namespace Crevasse
{
  namespace
  {
    /** Why a scene has no tip of a built-in crack; empty if it has. */
    std::string
    reason_against_tip(const Scene &scene, const BoundaryRoles &roles)
    {
      if (!traits(scene.geometry.shape).has_crack)
        return "there is no built-in crack";
      if (roles.contact.count(BoundaryIds::lip) +
              roles.open.count(BoundaryIds::lip) ==
            0 ||
          roles.symmetry.count(BoundaryIds::ligament) == 0)
        return "[Boundary] Contact or Symmetry differs from the default of the "
               "shape";
      return "";
    }



    /** Why "automatic" does not use two singular functions, though they are
     * allowed; empty if it does. */
    std::string
    reason_against_singular_functions(const Scene &scene)
    {
      const std::string no_tip = reason_against_tip(
        scene, resolve_roles(scene.boundary, built_in_roles(scene.geometry)));
      if (!no_tip.empty())
        return no_tip;
      if (scene.material.creep_law() != nullptr)
        return "nonlinear creep changes the singularity";
      if (scene.refinement.readapt_every > 0)
        return "[Refinement] Readapt every = " +
               std::to_string(scene.refinement.readapt_every);
      if (!scene.geometry.crack_growth->empty())
        return "[Geometry] Crack growth is given";
      if (!scene.material.stiffness_matrix.text().empty())
        return "[Material] Stiffness matrix is given";
      for (const Expression &formula : stiffness_formulas(scene.material))
        for (const char *variable : {"x", "y", "material", "theta"})
          if (formula.depends_on(variable))
            return std::string("the stiffness depends on ") + variable;
      return "";
    }
  } // namespace



  std::vector<unsigned int>
  subdivisions(const GeometryParameters &geometry, const unsigned int dimension)
  {
    if (!geometry.subdivisions->empty())
      return *geometry.subdivisions;
    const bool            is_plane  = dimension == 2;
    const bool            has_crack = traits(geometry.shape).has_crack;
    std::array<double, 3> extents   = {
        {geometry.width, geometry.height, geometry.thickness}};
    const auto end    = extents.begin() + dimension;
    double     length = *std::min_element(extents.begin(), end);
    if (has_crack)
      length = std::min({geometry.crack_length,
                         geometry.width - geometry.crack_length,
                         geometry.height});
    const double size = std::max(length / (is_plane ? 7. : 4.),
                                 *std::max_element(extents.begin(), end) /
                                   (is_plane ? 64. : 24.));

    std::vector<unsigned int> n;
    for (auto extent = extents.begin(); extent != end; ++extent)
      n.push_back(std::max(1., std::round(*extent / size)));
    n[0] = std::max(n[0], has_crack ? 2u : 1u);
    return n;
  }



  SingularFunctionObstacle
  obstacle_to_singular_functions(const Scene &scene)
  {
    const char *const in_the_plane =
      ": these functions are for a crack tip in the plane; use [Refinement] "
      "Strategy = tip";
    if (scene.dimension == 3)
      return {"Dimension = 3", in_the_plane};
    if (scene.is_axisymmetric())
      return {"[Material] Plane state = axisymmetric", in_the_plane};
    if (scene.discretisation.volumetric_strain == VolumetricStrain::mean)
      return {"Volumetric strain = mean",
              "; use Degree = 2 instead of mean dilatations"};
    if (const auto type = scene.linear_solver.type;
        traits(type).has(Trait::is_multigrid))
      return {"[Linear solver] Type = " + name_of(type),
              ": these functions couple all unknowns; use automatic, cholesky "
              "or mumps"};
    if (const auto &gap = scene.boundary.gap; gap.is_valid() && !gap->is_zero())
      return {"[Boundary] Gap = " + gap.text(),
              ": a crack that is open without load may close at its tip, which "
              "the bound of the singular function forbids"};
    if (const auto &mu = scene.boundary.friction;
        mu.is_valid() && !are_zero(formulas_of(mu)))
      return {"[Boundary] Friction coefficient = " + mu.text(),
              ": these functions slide on the lips without friction"};
    return {};
  }



  SingularFunctionChoice
  singular_functions(const Scene &scene)
  {
    const SingularFunctionNumber chosen =
      scene.discretisation.singular_functions;
    if (chosen != SingularFunctionNumber::automatic)
      return {static_cast<unsigned int>(chosen),
              "[Discretisation] Singular functions = " + name_of(chosen)};
    std::string against = obstacle_to_singular_functions(scene).setting;
    if (against.empty())
      against = reason_against_singular_functions(scene);
    if (against.empty())
      return {2, "automatic: two at the tip of a built-in crack in the plane"};
    return {0, "automatic: " + against};
  }



  unsigned int
  automatic_cycles(const Scene &scene)
  {
    // As of singular functions, the cells of the scene do not decide.
    const bool is_chosen =
      scene.refinement.strategy != RefinementStrategy::none ||
      scene.discretisation.singular_functions !=
        SingularFunctionNumber::automatic;
    if (is_chosen || scene.dimension == 3 ||
        !scene.geometry.crack_growth->empty())
      return 0;
    const BoundaryRoles roles =
      resolve_roles(scene.boundary, built_in_roles(scene.geometry));
    constexpr unsigned int enough = 6; // K to 1 %, mostly 0.1 %
    return reason_against_tip(scene, roles).empty() &&
               stress_intensity_effect(scene, roles).on &&
               singular_functions(scene).n == 0
             ? enough
             : 0;
  }



  std::vector<NamedPoint>
  probes(const Scene &scene)
  {
    const Shape shape = scene.geometry.shape;
    if (scene.output.probes.text() != "automatic")
      return *scene.output.probes;
    if (!traits(shape).has_crack)
      return {};
    std::vector<double> mouth(scene.dimension);
    mouth[0] = shape == Shape::edge_crack ? scene.geometry.width : 0.;
    return {{"mouth", mouth}};
  }
} // namespace Crevasse
