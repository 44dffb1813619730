// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/state_archive.h>
#include <crevasse/postprocess/elastic_comparison.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace Crevasse
{
  ElasticComparison::ElasticComparison(Reference   &&reference,
                                       const Vector *drift,
                                       Log          &log)
    : reference(std::move(reference))
    , drift(drift)
    , log(log)
  {
  }



  void
  ElasticComparison::observe(const Sample &sample)
  {
    if (sample.step == reference.factor.size())
      return; // the end of the run is no sample of the last period
    difference = sample.state.stress;
    difference.add(-reference.factor[sample.step], reference.stress);
    largest_difference = std::max(largest_difference, difference.linfty_norm());
    largest_stress =
      std::max(largest_stress, sample.state.stress.linfty_norm());
  }



  void
  ElasticComparison::end_of_period(const PeriodReport &)
  {
    last_period =
      largest_stress > 0. ? largest_difference / largest_stress : 0.;
    largest_difference = 0.;
    largest_stress     = 0.;
  }



  void
  ElasticComparison::serialize(StateArchive &archive)
  {
    archive.section("elastic comparison");
    archive.common(largest_difference);
    archive.common(largest_stress);
    archive.common(last_period);
  }



  void
  ElasticComparison::summarise(Summary &summary)
  {
    const double stress                                = stress_difference();
    summary["elastic_comparison"]["stress_difference"] = stress;
    char text[120];
    std::snprintf(text,
                  sizeof(text),
                  "  periodic stress against F(t) s_el: difference %.2e of the "
                  "largest stress",
                  stress);
    log.line(text);
    if (drift == nullptr)
      return;

    const double of_drift                             = drift_difference();
    summary["elastic_comparison"]["drift_difference"] = of_drift;
    std::snprintf(text,
                  sizeof(text),
                  "  drift per period against T F_mean/tau u_el: difference "
                  "%.2e",
                  of_drift);
    log.line(text);
  }



  double
  ElasticComparison::drift_difference() const
  {
    const double factor         = reference.drift_factor;
    double       largest_factor = 0.;
    for (const double f : reference.factor)
      largest_factor = std::max(largest_factor, std::abs(f));

    Vector difference = *drift;
    difference.add(-factor, reference.displacement);
    const double size =
      (std::abs(factor) > 1e-10 * largest_factor ? std::abs(factor)
                                                 : largest_factor) *
      reference.displacement.linfty_norm();
    return size > 0. ? difference.linfty_norm() / size : 0.;
  }
} // namespace Crevasse
