// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/model/jumps.h>
#include <crevasse/model/largest_load.h>
#include <crevasse/parameters/effects.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  namespace
  {
    // What is continuous changes by about 1e-10 of itself within the period;
    // from its end to its begin by more, where a formula has a rounded π.
    constexpr double negligible_within    = 1e-6;
    constexpr double negligible_at_border = 1e-4;



    bool
    differ(const double a, const double b, const double negligible)
    {
      return std::abs(a - b) > negligible * std::max(std::abs(a), std::abs(b));
    }



    /** At any of the points of this rank.
     *
     * @param scale of what may vanish for an instant. */
    template <typename Value>
    bool
    differ(const PointValues<Value> &a,
           const PointValues<Value> &b,
           const std::size_t         n_points,
           const double              negligible,
           const double              scale = 0.)
    {
      for (std::size_t p = 0; p < n_points; ++p)
        if ((a[p] - b[p]).norm() >
            negligible * std::max({a[p].norm(), b[p].norm(), scale}))
          return true;
      return false;
    }



    template <int dim>
    bool
    materials_differ(const Body<dim> &body,
                     const double     t,
                     const double     before,
                     const double     thermal_strain,
                     const double     negligible)
    {
      const MaterialState<dim> a = body.material.at(t);
      const MaterialState<dim> b = body.material.at(before);
      if (differ(a.stiffness_factor, b.stiffness_factor, negligible) ||
          differ(a.viscosity_factor, b.viscosity_factor, negligible))
        return true;
      const std::size_t n_points = body.points.n_local_points();
      bool              jumps    = false;
      if (body.material.stiffness_varies())
        jumps = differ(*a.stiffness, *b.stiffness, n_points, negligible);
      if (body.material.fluidity_varies())
        for (std::size_t i = 0; i < a.fluidity.size(); ++i)
          jumps = jumps ||
                  differ(*a.fluidity[i], *b.fluidity[i], n_points, negligible);
      if (body.material.thermal_strain_varies())
        jumps = jumps || differ(*a.thermal_strain,
                                *b.thermal_strain,
                                n_points,
                                negligible,
                                thermal_strain);
      return dealii::Utilities::MPI::max(jumps ? 1 : 0,
                                         body.space.communicator()) == 1;
    }
  } // namespace



  template <int dim>
  std::vector<double>
  find_jumps(const Scene     &scene,
             const Body<dim> &body,
             const StepList  &steps,
             const double     largest_load)
  {
    std::vector<double> jumps;
    const double        thermal_strain =
      body.material.largest_thermal_strain(steps.survey_instants({}));
    // A period ends where t begins anew: any formula can jump there.
    const bool within = formulas_can_jump(scene);
    for (unsigned int k = within ? 1 : steps.n_steps(); k <= steps.n_steps();
         ++k)
      {
        const double end    = steps.instant(k);
        const double t      = steps.within_period(end);
        const double before = steps.just_before(end);
        const double least  = within ? negligible_within : negligible_at_border;
        Vector       change = loads_at(body, t);
        change -= loads_at(body, before);
        if (change.linfty_norm() > least * largest_load ||
            materials_differ(body, t, before, thermal_strain, least))
          jumps.push_back(end);
      }
    return jumps;
  }



  template std::vector<double>
  find_jumps<2>(const Scene &, const Body<2> &, const StepList &, double);
  template std::vector<double>
  find_jumps<3>(const Scene &, const Body<3> &, const StepList &, double);
} // namespace Crevasse
