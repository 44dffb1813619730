// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/state_archive.h>
#include <crevasse/time/contact_events.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int most_events = 100;  // largest number in a step
    constexpr unsigned int most_trials = 12;   // for one event
    constexpr double       one_instant = 1e-7; // relative to step
    // Rounding of switching functions, relative to the largest one.
    constexpr double rounding_of_functions = 1e-10;



    class ContactEvents : public Integrator
    {
    public:
      explicit ContactEvents(std::unique_ptr<Integrator> &&method)
        : Integrator(with_events(method->properties))
        , method(std::move(method))
      {
      }

      void
      restart() override
      {
        is_continuing = false;
        method->restart();
      }

      void
      start(RateEquation &f,
            const double  t,
            const Vector &r,
            Vector       &rate) override
      {
        if (is_continuing)
          std::swap(begin, to);
        else
          {
            communicator = r.get_mpi_communicator();
            begin.rate.reinit(r, true);
            method->start(f, t, r, begin.rate);
            f.commit();
            f.switching_functions(begin.functions);
          }
        is_continuing = false;
        rate          = begin.rate;
      }

      void
      advance(const TimeStep &step) override
      {
        const bool   estimates_error = step.error != nullptr;
        const double end             = step.t + step.length;
        const double shortest        = one_instant * step.length;
        from.t                       = step.t;
        from.r                       = step.r;
        from.rate                    = step.rate;
        from.functions               = begin.functions;
        for (unsigned int n = 0;; ++n)
          {
            trials += n > 0 ? 1 : 0;
            go_to(step.f, end, estimates_error);
            find_sides(shortest);
            const bool crosses = least_function(to) < 0.;
            if (crosses && n < most_events)
              {
                ++events;
                missed += locate(step.f, shortest, estimates_error) ? 0 : 1;
              }
            else if (crosses)
              ++given_up;
            if (estimates_error)
              *step.error += to.error;
            if (to.functions.size() > 1) // with friction
              {
                step.f.commit();
                step.f.switching_functions(to.functions);
              }
            if (to.t == end)
              break;
            std::swap(from, to);
          }
        step.r        = to.r;
        is_continuing = true;
      }

      IntegratorStatistics
      statistics() const override
      {
        IntegratorStatistics all = method->statistics();
        all.emplace_back("contact_events", events);
        all.emplace_back("steps_for_events", trials);
        all.emplace_back("events_found_roughly", missed);
        all.emplace_back("steps_with_too_many_events", given_up);
        return all;
      }

      void
      serialize(StateArchive &archive) override
      {
        archive.section("contact events");
        method->serialize(archive);
        archive.common(is_continuing);
        // State where the next step begins, as an adaptive step may have
        // started.
        archive.at_points(begin.rate);
        serialize(archive, begin.functions);
        archive.common(to.t);
        archive.at_points(to.r);
        archive.at_points(to.rate);
        serialize(archive, to.functions);
        archive.common(rounding);
        for (std::size_t *count : {&events, &trials, &missed, &given_up})
          archive.common(*count);
        communicator = archive.communicator();
      }

    private:
      using Functions = std::vector<std::vector<double>>;

      static void
      serialize(StateArchive &archive, Functions &functions)
      {
        std::size_t n_lists = functions.size();
        archive.common(n_lists);
        functions.resize(n_lists);
        for (std::vector<double> &list : functions)
          archive.on_bounds(list);
      }

      static IntegratorProperties
      with_events(IntegratorProperties properties)
      {
        properties.name += " with contact events";
        return properties;
      }

      /** State at the beginning or the end of a trial step. */
      struct Place
      {
        double    t = 0.;
        Vector    r, rate, error;
        Functions functions; ///< switching functions
      };

      /** Takes a trial step from `from` to the instant @p t; sets `to`. */
      void
      go_to(RateEquation &f, const double t, const bool estimates_error)
      {
        to.t = t;
        to.r = from.r;
        to.rate.reinit(from.r, true);
        if (estimates_error)
          to.error.reinit(from.r);
        method->advance({f,
                         from.t,
                         t - from.t,
                         from.rate,
                         to.r,
                         estimates_error ? &to.error : nullptr});
        method->start(f, t, to.r, to.rate);
        f.switching_functions(to.functions);
      }

      /** Sets the side of each function at `from`: 1 positive, −1 negative, 0
       * if it switches at `from` and is not watched on the way to `to`.
       *
       * @param shortest interval that counts as one instant. */
      void
      find_sides(const double shortest)
      {
        double largest = 0.;
        for (const Place *place : {&from, &to})
          for (const auto &list : place->functions)
            for (const double function : list)
              largest = std::max(largest, std::abs(function));
        rounding = std::max(rounding,
                            rounding_of_functions *
                              Utilities::MPI::max(largest, communicator));

        const double part = shortest / (to.t - from.t);
        sides.clear();
        for (std::size_t l = 0; l < from.functions.size(); ++l)
          for (std::size_t k = 0; k < from.functions[l].size(); ++k)
            {
              const double before = from.functions[l][k];
              const double after  = to.functions[l][k];
              const bool   switches_at_once =
                std::abs(before) <= part * std::abs(after - before);
              sides.push_back(switches_at_once || std::abs(before) <= rounding
                                ? 0
                                : (before > 0. ? 1 : -1));
            }
      }

      /** Least switching function of watched nodes, with the sign that makes it
       * positive until a node switches. Collective. */
      double
      least_function(const Place &place) const
      {
        double least = std::numeric_limits<double>::max();
        auto   side  = sides.begin();
        for (const auto &list : place.functions)
          for (const double function : list)
            if (const int s = *side++; s != 0)
              least = std::min(least, s * function + rounding);
        return Utilities::MPI::min(least, communicator);
      }

      /** Goes to the first event on the way to `to`. @return whether it was
       * found to @p shortest. */
      bool
      locate(RateEquation &f, const double shortest, const bool estimates_error)
      {
        struct End
        {
          double t, value;
          double weight = 1.;
        };
        const double end = to.t;
        End          left{from.t, least_function(from)};
        End          right{end, least_function(to)};
        const End   *last   = nullptr; // end moved last
        End          before = left;    // its last position
        for (unsigned int trial = 0; trial < most_trials; ++trial)
          {
            const double at_left  = left.weight * left.value;
            const double at_right = right.weight * right.value;
            double       t =
              left.t + (right.t - left.t) * at_left / (at_left - at_right);
            // The functions are smooth on either side: a secant through two
            // points of one side is better, if it stays between the ends.
            if (last != nullptr)
              {
                const double secant = last->t - last->value *
                                                  (last->t - before.t) /
                                                  (last->value - before.value);
                if (secant > left.t && secant < right.t)
                  t = secant;
              }
            if (trial == 0 && end - t <= shortest)
              return true; // event at the end
            go_to(f, t, estimates_error);
            ++trials;

            const double here = least_function(to);
            const double slope =
              (left.value - right.value) / (right.t - left.t);
            if (std::abs(here) <= shortest * slope ||
                right.t - left.t <= shortest)
              return true;
            End &moved = here > 0. ? left : right;
            End &stays = here > 0. ? right : left;
            // An end that stays again gets less weight, so that both ends
            // converge.
            const double ratio = 1. - here / moved.value;
            stays.weight *= last != &moved ? 1. : (ratio > 0. ? ratio : 0.5);
            before = moved;
            moved  = {t, here};
            last   = &moved;
          }
        return false;
      }

      const std::unique_ptr<Integrator> method;

      Place begin;    ///< state at the step's begin
      Place from, to; ///< states at ends of its parts

      std::vector<int> sides;
      MPI_Comm         communicator = MPI_COMM_SELF;
      double           rounding     = 0.; ///< of switching functions

      std::size_t events = 0, trials = 0, missed = 0, given_up = 0;
    };
  } // namespace



  std::unique_ptr<Integrator>
  locate_contact_events(std::unique_ptr<Integrator> &&method)
  {
    return std::make_unique<ContactEvents>(std::move(method));
  }
} // namespace Crevasse
