// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/state_archive.h>
#include <crevasse/time/contact_events.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int most_events = 100;  // of a step
    constexpr unsigned int most_trials = 12;   // for one of them
    constexpr double       one_instant = 1e-7; // of a step
    // Of the largest switching function; solutions are certified to less.
    constexpr double rounding_of_functions = 1e-10;
  } // namespace



  ContactEvents::ContactEvents(std::unique_ptr<Integrator> &&method)
    : method(std::move(method))
  {
  }



  void
  ContactEvents::restart()
  {
    is_continuing = false;
    method->restart();
  }



  void
  ContactEvents::start(RateEquation &f,
                       const double  t,
                       const Vector &r,
                       Vector       &rate)
  {
    if (is_continuing)
      std::swap(begin, to);
    else
      {
        communicator = r.get_mpi_communicator();
        begin.rate.reinit(r, true);
        method->start(f, t, r, begin.rate);
        f.switching_functions(begin.functions);
      }
    is_continuing = false;
    rate          = begin.rate;
  }



  void
  ContactEvents::go_to(RateEquation &f,
                       const double  t,
                       const bool    estimates_error)
  {
    to.t = t;
    to.r = from.r;
    to.rate.reinit(from.r, true);
    if (estimates_error)
      to.error.reinit(from.r);
    method->advance(f,
                    from.t,
                    t - from.t,
                    from.rate,
                    to.r,
                    estimates_error ? &to.error : nullptr);
    method->start(f, t, to.r, to.rate);
    f.switching_functions(to.functions);
  }



  void
  ContactEvents::find_sides(const double shortest)
  {
    double largest = 0.;
    for (const Place *place : {&from, &to})
      for (const double function : place->functions)
        largest = std::max(largest, std::abs(function));
    rounding = std::max(rounding,
                        rounding_of_functions *
                          Utilities::MPI::max(largest, communicator));

    const double part = shortest / (to.t - from.t);
    sides.resize(from.functions.size());
    for (std::size_t k = 0; k < sides.size(); ++k)
      {
        const double before = from.functions[k], after = to.functions[k];
        const bool   switches_at_once =
          std::abs(before) <= part * std::abs(after - before);
        sides[k] = switches_at_once || std::abs(before) <= rounding
                     ? 0
                     : (before > 0. ? 1 : -1);
      }
  }



  double
  ContactEvents::least_function(const Place &place) const
  {
    double least = std::numeric_limits<double>::max();
    for (std::size_t k = 0; k < sides.size(); ++k)
      if (sides[k] != 0)
        least = std::min(least, sides[k] * place.functions[k] + rounding);
    return Utilities::MPI::min(least, communicator);
  }



  bool
  ContactEvents::locate(RateEquation &f,
                        const double  shortest,
                        const bool    estimates_error)
  {
    struct End
    {
      double t, value;
      double weight = 1.;
    };
    const double end = to.t;
    End          left{from.t, least_function(from)};
    End          right{end, least_function(to)};
    const End   *last   = nullptr; // the end that was moved last
    End          before = left;    // where it was
    for (unsigned int trial = 0; trial < most_trials; ++trial)
      {
        const double at_left  = left.weight * left.value;
        const double at_right = right.weight * right.value;
        double t = left.t + (right.t - left.t) * at_left / (at_left - at_right);
        // The functions are smooth on either side: the secant through two
        // points of one side is better, if it stays between the ends.
        if (last != nullptr)
          {
            const double secant = last->t - last->value * (last->t - before.t) /
                                              (last->value - before.value);
            if (secant > left.t && secant < right.t)
              t = secant;
          }
        if (trial == 0 && end - t <= shortest)
          return true; // the end is the event
        go_to(f, t, estimates_error);
        ++trials;

        const double here  = least_function(to);
        const double slope = (left.value - right.value) / (right.t - left.t);
        if (std::abs(here) <= shortest * slope || right.t - left.t <= shortest)
          return true;
        End &moved = here > 0. ? left : right;
        End &stays = here > 0. ? right : left;
        // One that stays again counts less, so that both ends come closer.
        const double ratio = 1. - here / moved.value;
        stays.weight *= last != &moved ? 1. : (ratio > 0. ? ratio : 0.5);
        before = moved;
        moved  = {t, here};
        last   = &moved;
      }
    return false;
  }



  void
  ContactEvents::advance(RateEquation &f,
                         const double  t,
                         const double  time_step,
                         const Vector &rate,
                         Vector       &r,
                         Vector       *error)
  {
    const double end      = t + time_step;
    const double shortest = one_instant * time_step;
    from.t                = t;
    from.r                = r;
    from.rate             = rate;
    from.functions        = begin.functions;
    for (unsigned int n = 0;; ++n)
      {
        trials += n > 0 ? 1 : 0;
        go_to(f, end, error != nullptr);
        find_sides(shortest);
        const bool crosses = least_function(to) < 0.;
        if (crosses && n < most_events)
          {
            const bool found = locate(f, shortest, error != nullptr);
            ++events;
            missed += found ? 0 : 1;
          }
        else if (crosses)
          ++given_up;
        if (error != nullptr)
          *error += to.error;
        if (to.t == end)
          break;
        std::swap(from, to);
      }
    r             = to.r;
    is_continuing = true;
  }



  bool
  ContactEvents::has_error_estimate() const
  {
    return method->has_error_estimate();
  }



  double
  ContactEvents::stability_limit() const
  {
    return method->stability_limit();
  }



  bool
  ContactEvents::has_matrix_of_step() const
  {
    return method->has_matrix_of_step();
  }



  TimeQuadrature
  ContactEvents::quadrature() const
  {
    return method->quadrature();
  }



  std::string
  ContactEvents::description() const
  {
    return method->description() + " with contact events";
  }



  IntegratorStatistics
  ContactEvents::statistics() const
  {
    IntegratorStatistics all = method->statistics();
    all.emplace_back("contact_events", events);
    all.emplace_back("steps_for_events", trials);
    all.emplace_back("events_found_roughly", missed);
    all.emplace_back("steps_with_too_many_events", given_up);
    return all;
  }



  bool
  ContactEvents::may_pause() const
  {
    return method->may_pause();
  }



  void
  ContactEvents::serialize(StateArchive &archive)
  {
    archive.section("contact events");
    method->serialize(archive);
    archive.common(is_continuing);
    // Where the next step begins: an adaptive one may have been started
    // already.
    archive.at_points(begin.rate);
    archive.on_bounds(begin.functions);
    archive.common(to.t);
    archive.at_points(to.r);
    archive.at_points(to.rate);
    archive.on_bounds(to.functions);
    archive.common(rounding);
    for (std::size_t *count : {&events, &trials, &missed, &given_up})
      archive.common(*count);
    communicator = archive.communicator();
  }
} // namespace Crevasse
