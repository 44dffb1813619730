// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/lip/friction.h>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  Friction<dim>::Friction(const ContactBoundary<dim> &lip,
                          const Temperature<dim>     &temperature,
                          const Expression           &coefficient)
    : lip(lip)
    , temperature(temperature)
    , coefficient(coefficient)
    , varies(coefficient.depends_on("t") ||
             (coefficient.depends_on("theta") && temperature.depends_on_time()))
  {
  }



  template <int dim>
  void
  Friction<dim>::evaluate(const double t, FrictionState &state) const
  {
    if (!varies && !state.coefficients.empty())
      return;
    const bool by_temperature = coefficient.depends_on("theta");
    state.coefficients.resize(lip.nodes.size());
    for (unsigned int k = 0; k < lip.nodes.size(); ++k)
      {
        const Point<dim> &point = lip.nodes[k].point;
        const double      mu    = coefficient.value(Place<dim>{
                  point, t, by_temperature ? temperature.value(point, t) : 0.});
        if (mu < 0.)
          throw SceneError(
            "[Boundary] Friction coefficient = " + coefficient.formula() +
            ": is " + Text::from_number(mu, 6) + " at " +
            Text::from_point(point) + " and t = " + Text::from_number(t, 6) +
            "; it must be at least 0.");
        state.coefficients[k] = mu;
      }
  }



  template <int dim>
  void
  Friction<dim>::commit(const Vector &displacement, FrictionState &state) const
  {
    for (unsigned int c = 0; c < dim - 1; ++c)
      for (unsigned int k = 0; k < lip.nodes.size(); ++k)
        if (const auto unknown = lip.nodes[k].sliding[c];
            unknown != numbers::invalid_dof_index)
          state.reference[c][k] = displacement(unknown);
  }



  template <int dim>
  FrictionState
  Friction<dim>::at_rest() const
  {
    FrictionState state;
    state.reference.assign(dim - 1, std::vector<double>(lip.nodes.size()));
    return state;
  }



  template class Friction<2>;
  template class Friction<3>;
} // namespace Crevasse
