// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/state_archive.h>
#include <crevasse/base/text.h>
#include <crevasse/time/adaptive_steps.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  namespace
  {
    class AdaptiveSteps : public StepControl
    {
    public:
      AdaptiveSteps(std::unique_ptr<Integrator>    &&method,
                    const IntegratorProperties      &properties,
                    const TimeIntegrationParameters &parameters,
                    const double                     largest_step,
                    StepList                        &steps,
                    const double                     stability_limit)
        : StepControl(std::move(method), properties, steps, stability_limit)
        , parameters(parameters)
        , largest_step(largest_step)
        , fixed_instants(steps.fixed_instants())
        , looks_at_end(std::count(properties.quadrature.nodes.begin(),
                                  properties.quadrature.nodes.end(),
                                  1.) > 0)
        // Loads may vanish at simple fractions of the period.
        , proposed(0.381966 * largest_step)
      {
      }

      void
      restart() override
      {
        StepControl::restart();
        known_end   = -1.;
        begins_anew = true;
      }

      void
      begin_period() override
      {
        restart();
        constexpr unsigned int most_searches = 3;
        // Steps are searched anew if this fraction of them would suffice.
        constexpr double too_many = 0.5;
        is_free                   = n_found == 0 ||
                  (n_found < most_searches && needed < too_many * taken);
        if (is_free)
          {
            steps.reset(fixed_instants);
            ++n_found;
          }
        needed = 0.;
        taken  = 0;
      }

      /** Reuses the rate at the end of the last step if it is known. */
      void
      start(RateEquation &f,
            const double  t,
            const Vector &r,
            Vector       &rate) override
      {
        if (std::abs(known_end - t) <= 1e-12 * steps.period())
          rate = end_rate;
        else
          method->start(f, t, r, rate);
        known_end = -1.;
      }

      /** Takes a step. @throw NumericalError if the tolerance is too small. */
      void
      advance(const TimeStep &step) override
      {
        RateEquation &f = step.f;
        const double  t = step.t, left = step.length;
        Vector       &r = step.r;
        // Steps of a list are halved, so that few lengths occur.
        const bool halves = !is_free || properties.has_matrix_of_step;
        // If the stress grows within the step, the limit falls.
        const double longest = 0.9 * longest_stable(step);
        double       length  = first_trial(step);
        while (length > longest)
          length = halves ? 0.5 * length : longest;
        bool   was_rejected = false;
        double step_error;
        error.reinit(r, true);
        saved                = r;
        const auto committed = f.committed_jumps();
        while (true)
          {
            error = 0.;
            try
              {
                step_error = try_step({f, t, length, step.rate, r, &error});
              }
            catch (const NumericalError &)
              {
                if (length < shortest_step(f) * steps.period())
                  throw;
                step_error = no_stability_limit; // a shorter step may succeed
              }
            if (step_error <= 1.)
              break;
            if (length < shortest_step(f) * steps.period())
              throw NumericalError(
                Text::Message()
                << "the tolerance needs too many steps: from t = " << t
                << " on, a step of " << length << " still has " << step_error
                << " times the allowed error. Choose a larger [Time "
                   "integration] Relative tolerance; if a load or a material "
                   "jumps at an instant, name it in Steps, so that a step ends "
                   "there; replace a sudden load by a short ramp, or give "
                   "growing steps by Step control = list.");
            ++rejected;
            was_rejected = true;
            r            = saved;
            f.return_to(committed);
            if (known_end >= 0.)
              {
                // The method has already started at the end.
                method->restart();
                method->start(f, t, r, end_rate);
                known_end = -1.;
              }
            const double factor =
              std::isfinite(step_error) ? safety / std::sqrt(step_error) : 0.1;
            length *= halves ? 0.5 : std::clamp(factor, 0.1, 0.8);
          }
        propose(length, step_error, was_rejected);
        needed += std::max({std::sqrt(step_error) / safety,
                            length / largest_step,
                            length / longest});
        ++accepted;
        ++taken;
        if (left - length > 1e-12 * steps.period())
          steps.divide_at(t + length);
        begins_anew = false;
      }

      IntegratorStatistics
      statistics() const override
      {
        IntegratorStatistics all = method->statistics();
        all.emplace_back("accepted_steps", accepted);
        all.emplace_back("rejected_steps", rejected);
        all.emplace_back("steps_of_last_period", taken);
        all.emplace_back("searches_for_steps", n_found);
        return all;
      }

      void
      serialize(StateArchive &archive) override
      {
        archive.section("adaptive steps");
        archive.common(is_free);
        archive.common(n_found);
        archive.common(proposed);
        archive.common(last_error);
        archive.common(needed);
        archive.common(taken);
        archive.common(accepted);
        archive.common(rejected);
        archive.common(known_end);
        archive.at_points(end_rate);
        method->serialize(archive);
      }

    private:
      static constexpr double       safety = 0.9;
      static constexpr unsigned int most_steps =
        TimeIntegrationParameters::most_steps;

      /** Shortest trial step, as a fraction of the period. Power-law creep
       * takes many steps for each power of ten of the time since loading;
       * instants are distinct to 1e-12. */
      double
      shortest_step(const RateEquation &f) const
      {
        constexpr unsigned int most_of_growth = 10000;
        return f.relaxation_rate() > 0. && taken < most_of_growth
                 ? 1e-11
                 : 1. / most_steps;
      }

      /** Length of the first trial step, at most the rest of the step. */
      double
      first_trial(const TimeStep &step) const
      {
        const double left = step.length;
        if (!is_free)
          return left;
        double longest = std::min(proposed, largest_step);
        // Limit by the initial slope: later the stress relaxes more slowly.
        constexpr double part_of_relaxation = 0.1;
        if (const double rate = step.f.relaxation_rate();
            begins_anew && rate > 0.)
          longest = std::min(longest,
                             std::max(part_of_relaxation / rate,
                                      shortest_step(step.f) * steps.period()));
        if (properties.has_matrix_of_step)
          return std::min(left, dyadic_step(step.t, longest));
        // Takes two equal steps instead of one and a short rest.
        return left <= longest ? left : std::min(longest, 0.5 * left);
      }

      /** Longest step from t, at most @p longest, that is 2⁻ⁿ of the interval
       * between fixed instants around t and ends on a multiple of itself. */
      double
      dyadic_step(const double t, const double longest) const
      {
        const std::vector<double> &fixed = fixed_instants;
        const double rounding = 1e-12 * (fixed.back() - fixed.front());
        const auto   after =
          std::upper_bound(fixed.begin(), fixed.end() - 1, t + rounding);
        const double begin  = *(after - 1);
        double       length = *after - begin;
        const auto   fits   = [&]() {
          const double parts = (t - begin) / length;
          return length <= longest * (1. + 1e-12) &&
                 std::abs(parts - std::round(parts)) * length <= rounding;
        };
        while (!fits())
          length *= 0.5;
        return length;
      }

      /** Error of a trial step relative to the tolerance. */
      double
      relative_error(const RateEquation &f, const Vector &r)
      {
        // The embedded method of order 1 has a larger error than the method, of
        // order 2, in proportion to it. With this fraction the error of a
        // period is close to the tolerance and below it
        // (tests/runs/test_adaptive.py).
        constexpr double part_of_estimate = 1. / 6.;
        if (!scale.partitioners_are_compatible(*r.get_partitioner()) ||
            scale.size() == 0)
          f.strain_per_stress(r, scale);
        for (unsigned int i = 0; i < error.locally_owned_size(); ++i)
          error.local_element(i) /= scale.local_element(i);
        const double stress = error.l2_norm();
        const double allowed =
          parameters.relative_tolerance * f.stress_scale() +
          parameters.absolute_tolerance;
        return stress == 0.            ? 0.
               : std::isfinite(stress) ? part_of_estimate * stress / allowed
                                       : no_stability_limit;
      }

      /** Takes a trial step. @return its error relative to the tolerance. */
      double
      try_step(const TimeStep &step)
      {
        method->advance(step);
        const double step_error = relative_error(step.f, step.r);
        return step_error <= 1. && !looks_at_end
                 ? std::max(step_error, relative_error_of_end(step))
                 : step_error;
      }

      /** Error of a trial step from its difference to the trapezoidal rule, if
       * the method has no stage at the end of the step, and so misses a jump
       * there. */
      double
      relative_error_of_end(const TimeStep &step)
      {
        end_rate.reinit(step.r, true);
        known_end = step.t + step.length;
        method->start(step.f, known_end, step.r, end_rate);
        error = step.r;
        error -= saved;
        error.add(-0.5 * step.length, step.rate, -0.5 * step.length, end_rate);
        return relative_error(step.f, step.r);
      }

      /** Sets the next step by the controller. */
      void
      propose(const double length,
              const double step_error,
              const bool   was_rejected)
      {
        // The error of the embedded method is of order 2 in the step.
        const double now    = std::max(step_error, 1e-8);
        double       factor = safety * std::pow(now, -0.35) * //
                        std::pow(last_error, 0.2);
        factor     = std::clamp(factor, 0.2, was_rejected ? 1. : 4.);
        proposed   = std::min(length * factor, largest_step);
        last_error = now;
      }

      const TimeIntegrationParameters parameters;
      const double                    largest_step;
      const std::vector<double>       fixed_instants;
      const bool                      looks_at_end;

      bool         is_free = true; ///< steps are being searched
      unsigned int n_found = 0;    ///< number of searches
      double       proposed;
      double       last_error = 1.;

      // Numbers of steps in this period.
      double       needed = 0.; ///< sufficient number of steps
      unsigned int taken  = 0;

      std::size_t accepted = 0, rejected = 0;

      Vector scale; ///< strain per stress
      Vector error, saved;

      // Instant and rate at the end of the last step, if computed.
      double known_end   = -1.;   ///< negative: none
      bool   begins_anew = false; ///< the step begins with a jump of the stress
      Vector end_rate;
    };
  } // namespace



  std::unique_ptr<Integrator>
  make_adaptive_steps(std::unique_ptr<Integrator>    &&method,
                      const IntegratorProperties      &properties,
                      const TimeIntegrationParameters &parameters,
                      const double                     largest_step,
                      StepList                        &steps,
                      const double                     stability_limit)
  {
    return std::make_unique<AdaptiveSteps>(std::move(method),
                                           properties,
                                           parameters,
                                           largest_step,
                                           steps,
                                           stability_limit);
  }
} // namespace Crevasse
