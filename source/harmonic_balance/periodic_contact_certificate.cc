// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/harmonic_balance/periodic_contact_certificate.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace Crevasse
{
  using namespace dealii;

  double
  PeriodicContactCertificate::worst() const
  {
    // Comparisons overlook nan, sums do not.
    if (std::isnan(penetration + tension + complementarity + mean_defect +
                   residual))
      return std::numeric_limits<double>::infinity();
    return std::max(
      {penetration, tension, complementarity, mean_defect, residual});
  }



  std::string
  PeriodicContactCertificate::describe() const
  {
    std::ostringstream text;
    text << "penetration " << penetration << ", tension " << tension
         << ", complementarity " << complementarity << ", defect of the mean "
         << mean_defect << ", residual " << residual;
    return text.str();
  }



  namespace
  {
    double
    larger(const double a, const double b)
    {
      return std::isnan(b) ? b : std::max(b, a);
    }
  } // namespace



  PeriodicContactCertificate
  certify(const PeriodicComplementarity &problem, const PeriodicState &state)
  {
    const unsigned int p       = problem.convolution.n_nodes();
    const unsigned int N       = problem.convolution.n_instants();
    const double       force   = problem.force_scale(state);
    const double       length  = problem.opening_scale(state);
    const double       opening = length > 0. ? length : 1.;

    PeriodicState exact = state;
    problem.compute_openings(exact);
    dealii::Vector<double>     means(p);
    PeriodicContactCertificate result;
    for (unsigned int k = 0; k < p * N; ++k)
      {
        const double g = state.forces(k) / force;
        const double w = state.openings(k) / opening;
        means(k % p) += g / N;
        result.tension     = larger(result.tension, -g);
        result.penetration = larger(result.penetration, -w);
        result.complementarity =
          larger(result.complementarity, std::abs(g * w));
        result.residual =
          larger(result.residual, std::abs(w - exact.openings(k) / opening));
      }
    for (unsigned int i = 0; i < p; ++i)
      result.mean_defect =
        larger(result.mean_defect,
               std::abs(means(i) - problem.mean_forces(i) / force));
    return result;
  }
} // namespace Crevasse
