// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/state_archive.h>
#include <crevasse/base/text.h>
#include <crevasse/time/cached_rate.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  bool
  CachedRate::Evaluation::is_of(const double time, const Vector &strain) const
  {
    // The last stage of a step equals its end up to the order of summation.
    constexpr double rounding = 1e-13;
    if (!is_known || std::abs(time - t) > rounding * std::abs(time))
      return false;
    double difference = 0., size = 0.;
    for (std::size_t i = 0; i < r.locally_owned_size(); ++i)
      {
        const double known = r.local_element(i);
        difference =
          std::max(difference, std::abs(strain.local_element(i) - known));
        size = std::max(size, std::abs(known));
      }
    // Relative to the values of the rank: one reduction is enough.
    const int differs = difference > rounding * size ? 1 : 0;
    return dealii::Utilities::MPI::max(differs, r.get_mpi_communicator()) == 0;
  }



  void
  CachedRate::evaluate(Evaluation   &evaluation,
                       const double  t,
                       const Vector &known,
                       const double  c,
                       Vector       &rate)
  {
    evaluation.is_known = false;
    latest              = nullptr;
    if (c > 0.)
      equation->implicit_rate(t, known, c, rate);
    else
      equation->rate(t, known, rate);
    if (!std::isfinite(rate.l1_norm()))
      throw NumericalError(
        Text::Message()
        << "At t = " << t
        << " the rate of the viscous strain is not finite. Check the formulas "
           "of [Material] and [Loads] at this instant.");
    evaluation.t = t;
    evaluation.r = known;
    if (c > 0.)
      evaluation.r.add(c, rate);
    evaluation.rate     = rate;
    evaluation.is_known = true;
    latest              = &evaluation;
  }



  void
  CachedRate::rate(const double t, const Vector &r, Vector &rate)
  {
    for (const Evaluation *evaluation : {&of_method, &of_sample})
      if (evaluation->is_of(t, r))
        {
          rate = evaluation->rate;
          return;
        }
    evaluate(of_method, t, r, 0., rate);
  }



  void
  CachedRate::show(const double t, const Vector &r, Vector &rate)
  {
    if (latest != nullptr && latest->is_of(t, r))
      rate = latest->rate;
    else
      evaluate(of_sample, t, r, 0., rate);
  }



  void
  CachedRate::serialize(StateArchive &archive)
  {
    archive.section("remembered rates");
    for (Evaluation *evaluation : {&of_method, &of_sample})
      {
        bool is_latest = latest == evaluation;
        archive.common(evaluation->is_known);
        archive.common(evaluation->t);
        archive.at_points(evaluation->r);
        archive.at_points(evaluation->rate);
        archive.common(is_latest);
        if (archive.is_loading() && is_latest)
          latest = evaluation;
      }
  }
} // namespace Crevasse
