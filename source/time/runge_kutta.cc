// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/time/runge_kutta.h>

namespace Crevasse
{
  RungeKutta::RungeKutta(const ButcherTableau &tableau)
    : tableau(tableau)
    , rates(tableau.weights.size() - 1)
  {
  }



  void
  RungeKutta::advance(RateEquation &f,
                      const double  t,
                      const double  time_step,
                      const Vector &rate,
                      Vector       &r,
                      Vector       *error)
  {
    if (!stage.partitioners_are_compatible(*r.get_partitioner()))
      {
        stage.reinit(r, true);
        for (Vector &later_rate : rates)
          later_rate.reinit(r, true);
      }
    const auto rate_of = [&](const unsigned int s) -> const Vector & {
      return s == 0 ? rate : rates[s - 1];
    };
    const auto add = [&](Vector &to, const std::vector<double> &coefficients) {
      for (unsigned int s = 0; s < coefficients.size(); ++s)
        if (coefficients[s] != 0.)
          to.add(time_step * coefficients[s], rate_of(s));
    };

    for (unsigned int s = 1; s < tableau.weights.size(); ++s)
      {
        stage = r;
        add(stage, tableau.matrix[s]);
        f.rate(t + tableau.nodes[s] * time_step, stage, rates[s - 1]);
      }
    add(r, tableau.weights);
    if (error != nullptr)
      add(*error, tableau.error_weights);
  }



  bool
  RungeKutta::has_error_estimate() const
  {
    return !tableau.error_weights.empty();
  }



  TimeQuadrature
  RungeKutta::quadrature() const
  {
    return {tableau.nodes, tableau.weights};
  }
} // namespace Crevasse
