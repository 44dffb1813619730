// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/range.h>
#include <crevasse/model/largest_load.h>
#include <crevasse/parameters/effects.h>

namespace Crevasse
{
  namespace
  {
    /** Nodal forces of the stress that thermal strain and imposed displacements
     * would cause in a body that is held everywhere. */
    template <int dim>
    Vector
    free_strain_load(const Body<dim> &body, const double t)
    {
      const MaterialState<dim> material = body.material.at(t);
      Vector                   forces;
      body.strain_operator.initialize(forces);
      body.strain_operator.add_transpose(forces, [&](const std::size_t offset) {
        const std::size_t point = offset / n_stress_components<dim>;
        return material.stiffness_factor *
               ((*material.stiffness)[point] * (*material.free_strain)[point]);
      });
      return forces;
    }



    /** Loads, and what imposed displacements load the body with. */
    template <int dim>
    Vector
    driving_loads(const Body<dim> &body, const double t)
    {
      Vector loads = loads_at(body, t);
      if (body.imposed.is_on)
        loads += free_strain_load(body, t);
      return loads;
    }
  } // namespace



  template <int dim>
  Vector
  loads_at(const Body<dim> &body, const double t)
  {
    Vector loads;
    body.strain_operator.initialize(loads);
    body.loads.evaluate(t, loads);
    return loads;
  }



  namespace
  {
    /** The first of these instants with the largest load vector. */
    template <int dim>
    double
    of_largest_load(const Body<dim> &body, const std::vector<double> &instants)
    {
      std::vector<double> norms;
      for (const double t : instants)
        norms.push_back(driving_loads(body, t).l2_norm());
      return instants[std::max_element(norms.begin(), norms.end()) -
                      norms.begin()];
    }
  } // namespace



  template <int dim>
  double
  instant_of_largest_load(const Body<dim> &body, const StepList &steps)
  {
    std::vector<double> begins;
    for (unsigned int k = 0; k < steps.n_steps(); ++k)
      begins.push_back(steps.instant(k));
    return of_largest_load(body, begins);
  }



  template <int dim>
  std::vector<double>
  instants_of_extreme_loads(const Body<dim> &body, const StepList &steps)
  {
    const double        largest  = instant_of_largest_load(body, steps);
    const Vector        loads    = driving_loads(body, largest);
    constexpr double    rounding = 1e-6;
    double              least    = -rounding * (loads * loads);
    std::vector<double> extremes = {largest};
    for (unsigned int k = 0; k < steps.n_steps(); ++k)
      if (const double product = driving_loads(body, steps.instant(k)) * loads;
          product < least)
        {
          least    = product;
          extremes = {largest, steps.instant(k)};
        }
    return extremes;
  }



  template <int dim>
  double
  largest_load(const Body<dim> &body, const StepList &steps)
  {
    // Loads count also between samples, at the stages of integrators.
    Vector loads;
    body.strain_operator.initialize(loads);
    double largest = 0.;
    for (unsigned int k = 0; k < steps.n_steps(); ++k)
      for (const double fraction : {0., 0.25, 0.5, 0.75})
        {
          body.loads.evaluate(steps.within_period(steps.instant(k) +
                                                  fraction * steps.step(k)),
                              loads);
          largest = std::max(largest, loads.linfty_norm());
        }
    if (body.material.has_free_strain())
      for (unsigned int k = 0; k < steps.n_steps(); ++k)
        largest =
          std::max(largest,
                   free_strain_load(body, steps.instant(k)).linfty_norm());
    if (largest != 0. && !Ranges::size.contains(largest))
      throw SceneError(
        "[Loads]: the largest force on a node over a period is " +
        Text::from_number(largest) + "; it " + Ranges::size.text() +
        ". Choose other units.");
    return largest;
  }



  template <int dim>
  double
  load_missed_by_steps(const Body<dim> &body, const StepList &steps)
  {
    // The fraction is irrational: the middle of a step may be a zero of loads.
    constexpr double fraction = 0.6180339887498949;
    double           missed = 0., largest = 0.;
    for (unsigned int k = 0; k < steps.n_steps(); ++k)
      {
        const double begin = steps.instant(k), end = begin + steps.step(k);
        Vector       line = driving_loads(body, begin);
        Vector within = driving_loads(body, begin + fraction * (end - begin));
        largest       = std::max({largest, line.l2_norm(), within.l2_norm()});
        // A jump at the end of a step does not belong to the step.
        line.sadd(1. - fraction,
                  fraction,
                  driving_loads(body, steps.just_before(end)));
        within -= line;
        missed = std::max(missed, within.l2_norm());
      }
    return largest > 0. ? missed / largest : 0.;
  }



  template <int dim>
  std::vector<double>
  instants_of_scale(const Body<dim> &body, const StepList &steps)
  {
    // Steps may meet a load only at its zeros; multiples of the golden ratio do
    // not.
    constexpr double       golden    = 0.6180339887498949;
    constexpr unsigned int n_sampled = 200, n_chosen = 5;
    std::vector<double>    sampled;
    for (unsigned int i = 1; i <= n_sampled; ++i)
      sampled.push_back(steps.within_period(steps.period() * golden * i));
    std::vector<double> chosen(sampled.begin(), sampled.begin() + n_chosen);
    chosen.push_back(of_largest_load(body, sampled));
    chosen.push_back(instant_of_largest_load(body, steps));
    return chosen;
  }



  namespace
  {
    // Continuous values change by about 1e-10 within the period; by more from
    // its end to its begin if a formula has a rounded π.
    constexpr double negligible_within    = 1e-6;
    constexpr double negligible_at_border = 1e-4;



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
      const auto factors_differ  = [&](const double x, const double y) {
        return std::abs(x - y) >
               negligible * std::max(std::abs(x), std::abs(y));
      };
      if (factors_differ(a.stiffness_factor, b.stiffness_factor) ||
          factors_differ(a.viscosity_factor, b.viscosity_factor))
        return true;
      // Compares all points of this rank; values with a scale may vanish for an
      // instant.
      const auto differ =
        [&](const auto &x, const auto &y, const double scale) {
          for (std::size_t p = 0; p < body.points.n_local_points; ++p)
            if ((x[p] - y[p]).norm() >
                negligible * std::max({x[p].norm(), y[p].norm(), scale}))
              return true;
          return false;
        };
      bool jumps =
        (body.material.stiffness_varies &&
         differ(*a.stiffness, *b.stiffness, 0.)) ||
        (body.material.thermal_strain_varies &&
         differ(*a.thermal_strain, *b.thermal_strain, thermal_strain));
      if (body.material.fluidity_varies && a.creep == nullptr)
        for (std::size_t i = 0; i < a.fluidity.size(); ++i)
          jumps = jumps || differ(*a.fluidity[i], *b.fluidity[i], 0.);
      else if (body.material.fluidity_varies)
        for (std::size_t p = 0; p < body.points.n_local_points; ++p)
          for (std::size_t i = 0; i < std::size(CreepLaw::Constants()); ++i)
            jumps = jumps || factors_differ((*a.creep)[p].constants[i],
                                            (*b.creep)[p].constants[i]);
      if (body.friction)
        {
          FrictionState at_t, at_before;
          body.friction->evaluate(t, at_t);
          body.friction->evaluate(before, at_before);
          for (std::size_t k = 0; k < at_t.coefficients.size(); ++k)
            jumps = jumps || factors_differ(at_t.coefficients[k],
                                            at_before.coefficients[k]);
        }
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
    // A period ends where t restarts: any formula can jump there.
    const bool within = formulas_can_jump(scene);
    for (unsigned int k = within ? 1 : steps.n_steps(); k <= steps.n_steps();
         ++k)
      {
        const double end    = steps.instant(k);
        const double t      = steps.within_period(end);
        const double before = steps.just_before(end);
        const double least  = within ? negligible_within : negligible_at_border;
        Vector       change = driving_loads(body, t);
        change -= driving_loads(body, before);
        if (change.linfty_norm() > least * largest_load ||
            materials_differ(body, t, before, thermal_strain, least))
          jumps.push_back(end);
      }
    return jumps;
  }



  template <int dim>
  double
  least_temperature(const Body<dim> &body, const double period)
  {
    const auto &mesh  = body.space.mesh();
    double      least = std::numeric_limits<double>::infinity();
    collectively(mesh.get_communicator(), [&]() {
      for (const auto &cell : mesh.active_cell_iterators())
        for (unsigned int k = 0; k < 4 && cell->is_locally_owned(); ++k)
          least =
            std::min(least,
                     body.temperature.value(cell->center(), 0.25 * k * period));
    });
    return dealii::Utilities::MPI::min(least, mesh.get_communicator());
  }



#define INSTANTIATE(dim)                                                       \
  template decltype(loads_at<dim>) loads_at<dim>;                              \
  template decltype(instant_of_largest_load<dim>)                              \
    instant_of_largest_load<dim>;                                              \
  template decltype(instants_of_extreme_loads<dim>)                            \
                                               instants_of_extreme_loads<dim>; \
  template decltype(largest_load<dim>)         largest_load<dim>;              \
  template decltype(load_missed_by_steps<dim>) load_missed_by_steps<dim>;      \
  template decltype(instants_of_scale<dim>)    instants_of_scale<dim>;         \
  template decltype(find_jumps<dim>)           find_jumps<dim>;                \
  template decltype(least_temperature<dim>)    least_temperature<dim>
  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
