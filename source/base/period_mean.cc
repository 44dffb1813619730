// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/period_mean.h>

#include <algorithm>
#include <cmath>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <limits>
#include <memory>

namespace Crevasse
{
  namespace
  {
    using Function = std::function<double(const double t)>;



    double
    call(const double t, void *function)
    {
      return (*static_cast<const Function *>(function))(t);
    }



    /** Mean over a period of a function with kinks and jumps: bisects where the
     * error is largest until only rounding is left, or nothing more is gained.
     *
     * @param size Magnitude of the values of @p f. */
    double
    adaptive_mean(const Function &f, const double period, const double size)
    {
      constexpr unsigned int n_parts = 128; // fewer parts may miss a pulse
      constexpr std::size_t  most_intervals = 200;
      constexpr double relative = 2e-14; // least tolerance that GSL accepts
      constexpr double rounding = std::numeric_limits<double>::epsilon();
      gsl_set_error_handler_off(); // any reached accuracy is enough
      const std::unique_ptr<gsl_integration_workspace,
                            void (*)(gsl_integration_workspace *)>
                   workspace(gsl_integration_workspace_alloc(most_intervals),
                  gsl_integration_workspace_free);
      gsl_function integrand{call, const_cast<Function *>(&f)};
      double       sum = 0.;
      for (unsigned int k = 0; k < n_parts; ++k)
        {
          double integral, error;
          gsl_integration_qag(&integrand,
                              period * k / n_parts,
                              period * (k + 1) / n_parts,
                              rounding * size * period / n_parts,
                              relative,
                              most_intervals,
                              GSL_INTEG_GAUSS15,
                              workspace.get(),
                              &integral,
                              &error);
          sum += integral;
        }
      return sum / period;
    }
  } // namespace



  double
  period_mean(const std::function<double(const double t)> &f,
              const double                                 period)
  {
    constexpr unsigned int coarsest = 128, finest = 8192;
    constexpr double rounding = 8. * std::numeric_limits<double>::epsilon();

    // Offset that avoids instants where formulas jump, such as fractions of T.
    constexpr double offset = 0.309016994374947;

    double sum = 0., largest = 0.;
    for (unsigned int k = 0; k < coarsest; ++k)
      {
        const double value = f(period * (k + offset) / coarsest);
        sum += value;
        largest = std::max(largest, std::abs(value));
      }
    // Equal steps miss harmonics that are multiples of their number: two
    // refinements have to agree, so that only multiples of 512 remain.
    unsigned int agreements = 0;
    double       mean       = sum / coarsest;
    for (unsigned int n = coarsest; n < finest; n *= 2)
      {
        for (unsigned int k = 0; k < n; ++k)
          {
            const double x     = (k + 0.5) / n + offset / coarsest;
            const double value = f(period * (x < 1. ? x : x - 1.));
            sum += value;
            largest = std::max(largest, std::abs(value));
          }
        const double finer = sum / (2. * n);
        agreements =
          std::abs(finer - mean) <= rounding * largest ? agreements + 1 : 0;
        mean = finer;
        if (agreements == 2)
          return mean;
      }
    return adaptive_mean(f, period, largest);
  }
} // namespace Crevasse
