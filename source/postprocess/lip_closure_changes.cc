// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/postprocess/lip_closure.h>

#include <boost/math/tools/toms748_solve.hpp>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    constexpr double       one_instant  = 1e-6;  // part of a step
    constexpr double       no_step      = 2e-11; // part of the period
    constexpr unsigned int most_trials  = 60;    // for one instant
    constexpr double       most_of_mean = 2.;    // change of the rate in a step
  }                                              // namespace



  template <int dim>
  void
  LipClosure<dim>::find_rates(Change &step)
  {
    Vector mean = step.strain_at_end;
    mean.sadd(1. / (step.end - step.begin),
              -1. / (step.end - step.begin),
              step.strain_at_begin);
    step.rate_at_begin = step.rate_at_end = mean;
    evolution.rate(step.begin, step.strain_at_begin, step.rate_at_begin);
    evolution.rate(step.end, step.strain_at_end, step.rate_at_end);
    for (Vector *const rate : {&step.rate_at_begin, &step.rate_at_end})
      *rate -= mean;
    const double most = most_of_mean * mean.l2_norm();
    if (!(step.rate_at_begin.l2_norm() <= most &&
          step.rate_at_end.l2_norm() <= most))
      step.rate_at_begin = step.rate_at_end = 0.;
  }



  template <int dim>
  Sample
  LipClosure<dim>::sample_at(const double instant)
  {
    const auto step =
      std::find_if(changes.begin(), changes.end(), [=](const Change &change) {
        return change.begin <= instant && instant <= change.end;
      });
    AssertThrow(step != changes.end(), ExcInternalError());
    evolution.begin_step(step->begin);
    evolution.return_to(step->committed);
    if (step->strain_at_begin.size() == 0)
      evolution.elastic_state(instant);
    else
      {
        if (step->rate_at_begin.size() == 0)
          find_rates(*step);
        const double length = step->end - step->begin;
        const double part   = (instant - step->begin) / length;
        Vector       rate(step->strain_at_begin);
        strain = step->strain_at_begin;
        strain.sadd(1. - part, part, step->strain_at_end);
        strain.add(length * part * (1. - part) * (1. - part),
                   step->rate_at_begin,
                   -length * part * part * (1. - part),
                   step->rate_at_end);
        evolution.rate(instant, strain, rate);
      }
    return {step->period,
            0,
            step->begin_of_period + instant,
            instant,
            evolution.state(),
            strain,
            evolution.right_hand_side(),
            evolution.secular_flow()};
  }



  template <int dim>
  void
  LipClosure<dim>::locate(const Change &step, const unsigned int lip)
  {
    for (const bool closes : {false, true})
      {
        // The value is negative if a node is closed, or if all are.
        const auto value = [&](const Moment &moment) {
          const auto [least, most] = range(lip, moment);
          return closes ? most : least;
        };
        const auto begin = std::adjacent_find(
          period.begin(), period.end(), [&](const Moment &a, const Moment &b) {
            return a.instant >= step.begin && b.instant <= step.end &&
                   (value(a) < 0.) != (value(b) < 0.);
          });
        if (begin == period.end())
          continue;
        // Pressures and openings have different scales; 0 is open.
        const double before = value(begin[0]), after = value(begin[1]);
        const auto   scaled =
          [low  = -std::min(before, after),
           high = std::max({before, after, 1e-300})](const double v) {
            return v < 0. ? v / low : std::max(v / high, 1e-12);
          };
        std::map<double, std::vector<double>> tried;
        std::uintmax_t                        trials = most_trials;
        const auto [last, next] = boost::math::tools::toms748_solve(
          [&](const double t) {
            tried[t] = openings(sample_at(t));
            return scaled(value({t, tried[t]}));
          },
          begin[0].instant,
          begin[1].instant,
          scaled(before),
          scaled(after),
          [&step](const double a, const double b) {
            return b - a <= one_instant * (step.end - step.begin);
          },
          trials);
        std::vector<Moment> found;
        for (const double t : {last, next})
          if (tried.count(t) > 0)
            found.push_back({t, tried[t]});
        period.insert(begin + 1, found.begin(), found.end());
      }
  }



  template <int dim>
  void
  LipClosure<dim>::find_changes(
    const std::vector<std::unique_ptr<Observer>> &observers)
  {
    const std::vector<Moment> samples = period;
    try
      {
        for (const Change &change : changes)
          if (change.end - change.begin > no_step * period.back().instant)
            for (unsigned int lip = 0; lip < n_lips; ++lip)
              locate(change, lip);
      }
    catch (const std::runtime_error &error)
      {
        failure =
          "the instant at which a lip changes within a step was not found: ";
        failure += error.what();
        return;
      }
    auto sample = samples.begin();
    for (const Moment &moment : period)
      if (sample != samples.end() && moment.instant == sample->instant)
        ++sample;
      else
        {
          const Sample here = sample_at(moment.instant);
          for (const auto &observer : observers)
            observer->between(here);
        }
  }



  template Sample
  LipClosure<2>::sample_at(const double);
  template Sample
  LipClosure<3>::sample_at(const double);
  template void
  LipClosure<2>::find_changes(const std::vector<std::unique_ptr<Observer>> &);
  template void
  LipClosure<3>::find_changes(const std::vector<std::unique_ptr<Observer>> &);
} // namespace Crevasse
