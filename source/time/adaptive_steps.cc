// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/format.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/state_archive.h>
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
      /** @param fixed_instants at which steps always end.
       * @param nodes at which the method evaluates f. */
      AdaptiveSteps(const TimeIntegrationParameters &parameters,
                    const double                     largest_step,
                    const std::vector<double>       &fixed_instants,
                    const std::vector<double>       &nodes,
                    const double                     stability_limit)
        : StepControl(stability_limit)
        , parameters(parameters)
        , largest_step(largest_step)
        , fixed_instants(fixed_instants)
        , looks_at_end(std::find(nodes.begin(), nodes.end(), 1.) != nodes.end())
        // Not a simple fraction of the period, where a load may have its zeros.
        , proposed(0.381966 * largest_step)
      {
      }

      void
      begin_period(StepList &steps) override
      {
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
      start(const PeriodStep &step) override
      {
        const double t = step.steps.instant(step.k);
        if (step.k > 0 &&
            std::abs(known_end - t) <= 1e-12 * step.steps.period() &&
            !step.steps.jumps_at(t))
          step.rate = end_rate;
        else
          StepControl::start(step);
        known_end = -1.;
      }

      /** Takes a step. @throw NumericalError if the tolerance is too small. */
      void
      advance(const PeriodStep &period_step) override
      {
        auto &[integrator, f, steps, k, r, rate] = period_step;
        // Steps of a list are halved, so that few lengths occur.
        const bool   has_matrix = integrator.properties.has_matrix_of_step;
        const bool   halves     = !is_free || has_matrix;
        const double t = steps.instant(k), left = steps.step(k);
        // If the stress grows within the step, the limit falls.
        const double longest = 0.9 * longest_stable(period_step);
        double       length  = first_trial(period_step);
        while (length > longest)
          length = halves ? 0.5 * length : longest;
        bool   was_rejected = false;
        double step_error;
        error.reinit(r, true);
        saved = r;
        while (true)
          {
            error = 0.;
            try
              {
                step_error =
                  try_step(integrator, {f, t, length, rate, r, &error});
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
            if (known_end >= 0.)
              {
                // The method has already started at the end.
                integrator.restart();
                integrator.start(f, t, r, end_rate);
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
          steps.divide(k, t + length);
      }

      bool
      repeats_steps() const override
      {
        return false;
      }

      IntegratorStatistics
      statistics() const override
      {
        return {{"accepted_steps", accepted},
                {"rejected_steps", rejected},
                {"steps_of_last_period", taken},
                {"searches_for_steps", n_found}};
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
      }

    private:
      static constexpr double       safety = 0.9;
      static constexpr unsigned int most_steps =
        TimeIntegrationParameters::most_steps;

      /** Whether a step begins with a jump of the stress. */
      static bool
      begins_anew(const PeriodStep &step)
      {
        return step.k == 0 || step.steps.jumps_at(step.steps.instant(step.k));
      }

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
      first_trial(const PeriodStep &step) const
      {
        const double t    = step.steps.instant(step.k),
                     left = step.steps.step(step.k);
        if (!is_free)
          return left;
        double longest = std::min(proposed, largest_step);
        // Limit by the initial slope: later the stress relaxes more slowly.
        constexpr double part_of_relaxation = 0.1;
        if (const double rate = step.f.relaxation_rate();
            begins_anew(step) && rate > 0.)
          longest =
            std::min(longest,
                     std::max(part_of_relaxation / rate,
                              shortest_step(step.f) * step.steps.period()));
        if (step.integrator.properties.has_matrix_of_step)
          return std::min(left, dyadic_step(t, longest));
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
      try_step(Integrator &integrator, const TimeStep &step)
      {
        integrator.advance(step);
        const double step_error = relative_error(step.f, step.r);
        return step_error <= 1. && !looks_at_end
                 ? std::max(step_error, relative_error_of_end(integrator, step))
                 : step_error;
      }

      /** Error of a trial step from its difference to the trapezoidal rule, if
       * the method has no stage at the end of the step, and so misses a jump
       * there. */
      double
      relative_error_of_end(Integrator &integrator, const TimeStep &step)
      {
        end_rate.reinit(step.r, true);
        known_end = step.t + step.length;
        integrator.start(step.f, known_end, step.r, end_rate);
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
      double       needed = 0.; ///< steps that would have sufficed
      unsigned int taken  = 0;

      std::size_t accepted = 0, rejected = 0;

      Vector scale; ///< strain per stress
      Vector error, saved;

      // Instant and rate at the end of the last step, if computed.
      double known_end = -1.; ///< negative: none
      Vector end_rate;
    };
  } // namespace



  std::unique_ptr<StepControl>
  make_adaptive_steps(const TimeIntegrationParameters &parameters,
                      const double                     largest_step,
                      const StepList                  &steps,
                      const IntegratorProperties      &integrator,
                      const double                     stability_limit)
  {
    return std::make_unique<AdaptiveSteps>(parameters,
                                           largest_step,
                                           steps.fixed_instants(),
                                           integrator.quadrature.nodes,
                                           stability_limit);
  }
} // namespace Crevasse
