// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/material/plane_elasticity.h>
#include <crevasse/material/voigt_matrix.h>
#include <crevasse/postprocess/crack_tip_choice.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    constexpr double rounding_of_lines = 1e-10;

    /** Whether all branches have H = (τᵢK)⁻¹: then a shape of the stress stays
     * what it is. Of uniform values only. */
    bool
    relaxes_in_proportion(const MaterialState<2> &material)
    {
      const VoigtMatrix<2> &K    = (*material.stiffness)[0];
      VoigtMatrix<2>        unit = K * inverse<2>(K);
      for (const auto &fluidity : material.fluidity)
        {
          const VoigtMatrix<2> product =
            K * (material.plane_stress ? in_plane<2>((*fluidity)[0])
                                       : (*fluidity)[0]);
          if ((product - product[3][3] * unit).norm() >
              rounding_of_lines * product.norm())
            return false;
        }
      return true;
    }



    /** Whether a body is the same everywhere and isotropic in the plane,
     * elastic and creeping. */
    bool
    is_homogeneous(const MaterialState<2> &material)
    {
      if (!material.stiffness->is_uniform() ||
          !PlaneElasticity::is_isotropic((*material.stiffness)[0]))
        return false;
      for (const auto &fluidity : material.fluidity)
        if (!fluidity->is_uniform() ||
            !PlaneElasticity::is_isotropic(
              PlaneElasticity::like_stiffness((*fluidity)[0])))
          return false;
      return true;
    }



    /** The lines that the planes of symmetry are, by normal and offset. */
    struct Line
    {
      Tensor<1, 2> normal;
      double       offset;
    };



    std::vector<Line>
    symmetry_lines(const Space<2> &space)
    {
      std::vector<Line> lines;
      for (const auto &cell : space.mesh().cell_iterators_on_level(0))
        for (const unsigned int f : cell->face_indices())
          if (const auto face = cell->face(f);
              face->at_boundary() &&
              space.roles().symmetry.count(face->boundary_id()) > 0)
            {
              Tensor<1, 2> normal =
                cross_product_2d(face->vertex(1) - face->vertex(0));
              normal /= normal.norm();
              lines.push_back({normal, normal * Tensor<1, 2>(face->vertex(0))});
            }
      return lines;
    }



    /** Whether the supports hinder a deformation, as two walls do between
     * which a body cannot grow. */
    bool
    is_hindered(const Scene &scene, const Body<2> &body)
    {
      if (!body.space.roles().clamped.empty())
        return true;
      const std::vector<Line> lines = symmetry_lines(body.space);
      const double            size  = GridTools::diameter(
        static_cast<const Triangulation<2> &>(body.space.mesh()));
      for (const Line &a : lines)
        for (const Line &b : lines)
          {
            const double cosine = a.normal * b.normal;
            if (std::abs(cosine) > rounding_of_lines && // parallel, or oblique
                std::abs(a.offset * (cosine > 0. ? 1. : -1.) - b.offset) >
                  rounding_of_lines * size)
              return true;
          }

      // A point on a plane of symmetry may be held along it, once.
      unsigned int extra = 0;
      for (const FixedPoint<2> &fixed : fixed_points<2>(scene))
        for (unsigned int d = 0; d < 2; ++d)
          if (fixed.components[d])
            {
              const auto holds = [&](const Line &line) {
                return std::abs(line.normal[d]) > 1. - rounding_of_lines &&
                       std::abs(line.normal * Tensor<1, 2>(fixed.point) -
                                line.offset) <= rounding_of_lines * size;
              };
              extra += std::none_of(lines.begin(), lines.end(), holds) ? 1 : 0;
            }
      const bool has_both =
        std::any_of(lines.begin(), lines.end(), [&lines](const Line &line) {
          return std::abs(line.normal * lines.front().normal) <
                 rounding_of_lines;
        });
      return extra > (lines.empty() ? 3u : (has_both ? 0u : 1u));
    }



    /** Why the integral is not right; empty if it is, and then why it is. */
    std::string
    obstacle(const Scene &scene, const Body<2> &body, std::string &reason)
    {
      const MaterialState<2> material = body.material.at(0.);
      if (const auto strain = Effects::first_on(body.effects.free_strains))
        return "there is " + strain->name;
      if (const auto force = Effects::first_on(body.effects.volume_forces))
        return "there is a " + force->name;
      if (body.material.stiffness_varies())
        return "the stiffness varies in time, and not by [Material] Stiffness "
               "time factor alone";
      reason = "nothing creeps";
      if (!body.effects.viscosity.on)
        return "";
      reason = "all points relax alike";
      if (body.law.uniform_relaxation_time())
        return "";
      if (!is_homogeneous(material))
        return "the body creeps, and is not homogeneous and isotropic";
      if (!body.material.fluidity_varies() && relaxes_in_proportion(material))
        return "";
      reason = "the body is homogeneous and isotropic";
      if (is_hindered(scene, body))
        return "the body creeps otherwise than it deforms elastically, and "
               "its supports hinder that";
      return "";
    }
  } // namespace



  CrackTipChoice
  choose_crack_tip_method(const Scene &scene, const Body<2> &body)
  {
    using Method              = StressIntensityMethod;
    const Method      wish    = scene.crack_tip.method;
    const std::string setting = "[Crack tip] Method = " + name_of(wish);
    if (wish == Method::williams_fit)
      return {false, setting};

    std::string       reason;
    const std::string why_not = obstacle(scene, body, reason);
    if (why_not.empty())
      return {true,
              wish == Method::automatic ? "automatic: " + reason : setting};
    if (wish == Method::interaction_integral)
      throw SceneError(setting + ": " + why_not +
                       ", so that the stress is not that of an elastic body "
                       "under the loads. Set it to automatic or williams fit.");
    return {false, "automatic: " + why_not};
  }
} // namespace Crevasse
