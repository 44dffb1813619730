// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/time/predictor_corrector.h>

namespace Crevasse
{
  void
  PredictorCorrector::advance(RateEquation &f,
                              const double  t,
                              const double  time_step,
                              const Vector &rate,
                              Vector       &r,
                              Vector *)
  {
    last_rate.reinit(r, true);
    predicted = r;
    predicted.add(time_step, rate);
    const double half = 0.5 * time_step;
    r.add(half, rate);
    f.semi_implicit_rate(t + time_step, predicted, r, half, last_rate);
    r.add(half, last_rate);
  }



  double
  PredictorCorrector::stability_limit() const
  {
    return 6.;
  }



  TimeQuadrature
  PredictorCorrector::quadrature() const
  {
    // How the two rates are weighted depends on the relaxation.
    return {{0., 1.}, {}};
  }



  std::string
  PredictorCorrector::description() const
  {
    return "predictor corrector";
  }
} // namespace Crevasse
