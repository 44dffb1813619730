// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#include <crevasse/time/runge_kutta.h>

namespace Crevasse
{
  RungeKutta::RungeKutta(const ButcherTableau &tableau)
    : tableau(tableau)
    , rates(tableau.weights.size())
  {
  }



  void
  RungeKutta::step(RateEquation                &f,
                   const double                 t,
                   const double                 time_step,
                   Vector                      &r,
                   const std::function<void()> &at_start)
  {
    if (!stage.partitioners_are_compatible(*r.get_partitioner()))
      {
        stage.reinit(r, true);
        for (Vector &rate : rates)
          rate.reinit(r, true);
      }

    f.rate(t, r, rates[0]);
    at_start();
    for (unsigned int s = 1; s < rates.size(); ++s)
      {
        stage = r;
        for (unsigned int i = 0; i < s; ++i)
          if (tableau.matrix[s][i] != 0.)
            stage.add(time_step * tableau.matrix[s][i], rates[i]);
        f.rate(t + tableau.nodes[s] * time_step, stage, rates[s]);
      }
    for (unsigned int s = 0; s < rates.size(); ++s)
      if (tableau.weights[s] != 0.)
        r.add(time_step * tableau.weights[s], rates[s]);
  }



  double
  RungeKutta::stability_limit() const
  {
    return tableau.real_stability_limit;
  }



  TimeQuadrature
  RungeKutta::quadrature() const
  {
    return {tableau.nodes, tableau.weights};
  }



  std::string
  RungeKutta::description() const
  {
    return tableau.name;
  }
} // namespace Crevasse
