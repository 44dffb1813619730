// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_secular_steady_creep_h
#define crevasse_secular_steady_creep_h

#include <crevasse/secular/secular_problem.h>
#include <crevasse/secular/viscosity.h>

#include <optional>

namespace Crevasse
{
  /** The secular flow of a body as an elastic problem with the viscosity as
   * stiffness: C* at cracks is its energy release rate. */
  template <int dim>
  class SteadyCreep
  {
  public:
    /** Collective. The body must outlive the SteadyCreep. */
    SteadyCreep(const Body<dim> &body, const SecularSplit &split)
      : no_c_star(obstacle(body, split))
      , mean_load_vanishes(split.mean_load.size() > 0 && !split.effect.on)
      , body(body)
    {
      if (no_c_star.empty())
        viscosity.emplace(body, body.material.at(0.));
    }

    /** Factor η₀ of the viscosity, which is constant in time. */
    double
    factor() const
    {
      return body.law.viscosity_factor(0.);
    }

    /** Stress η₀ η α of the flow, the mean stress. */
    Vector
    stress(const SecularFlow &flow) const
    {
      using Field = QuadratureField<dim>;
      Vector all;
      body.points.initialize(all);
      for (std::size_t p = 0; p < body.points.n_local_points; ++p)
        {
          const std::size_t offset = p * Field::n_components;
          // The rates of all branches are those of the body, in plane stress
          // those in the plane.
          Field::set(all,
                     offset,
                     factor() *
                       (viscosity->sum[p] *
                        Field::get(flow.strain_rate,
                                   offset * body.law.branches.size())));
        }
      return all;
    }

    std::string                   no_c_star; ///< reason for no C*, or empty
    const bool                    mean_load_vanishes; ///< so that C* = 0
    std::optional<Viscosity<dim>> viscosity; ///< without η₀; null without C*

  private:
    static std::string
    obstacle(const Body<dim> &body, const SecularSplit &split)
    {
      if (!split.effect.on)
        return split.effect.why;
      if (const auto force = Effects::first_on(body.effects.volume_forces))
        return "the integral does not include the " + force->name;
      if (body.space.roles.has_loaded_lip())
        return "the integral does not include loads on the lip";
      return body.effects.varying_viscosity.on ? "the viscosity varies in time"
                                               : "";
    }

    const Body<dim> &body;
  };
} // namespace Crevasse

#endif
