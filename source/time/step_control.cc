// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/format.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/state_archive.h>
#include <crevasse/time/step_control.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Crevasse
{
  namespace
  {
    constexpr unsigned int most_steps = TimeIntegrationParameters::most_steps;



    /**
     * Steps whose error of the stress is within a tolerance: a part of what an
     * embedded method of order 1 estimates.
     *
     * The first period finds them by a proportional–integral controller
     * (Gustafsson, ACM Trans. Math. Softw. 17, 1991; Hairer and Wanner, Solving
     * ODEs II, IV.2). Later periods use them again, as the paper proposes
     * (§6.2.1), so that samples, matrices and factorisations repeat: a step
     * that has become too long is divided for good. Where the state of the
     * first period has taken many more steps than a later one needs they are
     * found anew, at most three times.
     *
     * Where steps have matrices of their own, their lengths are those of the
     * intervals between the fixed instants divided by powers of 2, so that
     * there are few.
     */
    class AdaptiveSteps : public StepControl
    {
    public:
      /** @param fixed_instants where steps end in any case.
       * @param nodes at which the method evaluates. */
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
        // Not a fraction of the period, at which a load may have its zeros.
        , proposed(0.381966 * largest_step)
      {
      }

      void
      begin_period(StepList &steps) override
      {
        constexpr unsigned int most_searches = 3;
        // Steps are found anew if so many of them would do.
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

      /** Takes what a step that has looked at its end has found there. */
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

      /** @throw NumericalError if the tolerance takes too many steps. */
      void
      advance(const PeriodStep &period_step) override
      {
        auto &[integrator, f, steps, k, r, rate] = period_step;
        // The steps of a list are halved, so that its lengths stay few.
        const bool   has_matrix = integrator.properties.has_matrix_of_step;
        const bool   halves     = !is_free || has_matrix;
        const double t = steps.instant(k), left = steps.step(k);
        // Where the stress grows within the step the limit falls.
        const double longest = 0.9 * longest_stable(period_step);
        double       length  = first_trial(t, left, has_matrix);
        while (length > longest)
          length = halves ? 0.5 * length : longest;
        bool   was_rejected = false;
        double step_error;
        error.reinit(r, true);
        saved = r;
        while (true)
          {
            error = 0.;
            const TimeStep step{f, t, length, rate, r, &error};
            integrator.advance(step);
            step_error = relative_error(f, r);
            if (step_error <= 1. && !looks_at_end)
              step_error =
                std::max(step_error, relative_error_of_end(integrator, step));
            if (step_error <= 1.)
              break;
            if (length * most_steps < steps.period())
              {
                std::ostringstream message;
                message
                  << "the tolerance takes more than " << most_steps
                  << " steps a period: from t = " << t << " on a step of "
                  << length << " still has " << step_error
                  << " times the error that is allowed. Choose a larger [Time "
                     "integration] Relative tolerance; if a load or a material "
                     "jumps at an instant, name it in Steps, so that a step "
                     "ends there.";
                throw NumericalError(message.str());
              }
            ++rejected;
            was_rejected = true;
            r            = saved;
            if (known_end >= 0.)
              {
                // The method has started from the end already.
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
      static constexpr double safety = 0.9;

      /** The length of the first trial from t on, at most what is left. */
      double
      first_trial(const double t,
                  const double left,
                  const bool   has_matrix) const
      {
        if (!is_free)
          return left;
        const double longest = std::min(proposed, largest_step);
        if (has_matrix)
          return std::min(left, dyadic_step(t, longest));
        // Two steps of the same length instead of one and a short rest.
        return left <= longest ? left : std::min(longest, 0.5 * left);
      }

      /** The largest 2⁻ⁿ of the interval between fixed instants around t that
       * ends on a multiple of itself and is not longer than @p longest. */
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

      /** The error of a trial relative to the tolerance. */
      double
      relative_error(const RateEquation &f, const Vector &r)
      {
        // The error of the embedded method of order 1 is larger than that of
        // the method that goes on, of order 2, which falls in proportion to it.
        // With this part of it the error of a period comes close to the
        // tolerance (tests/runs/test_adaptive.py), and stays below.
        constexpr double part_of_estimate = 0.125;
        if (!scale.partitioners_are_compatible(*r.get_partitioner()) ||
            scale.size() == 0)
          f.strain_per_stress(r, scale);
        double largest = 0.;
        for (unsigned int i = 0; i < error.locally_owned_size(); ++i)
          {
            const double stress =
              std::abs(error.local_element(i)) / scale.local_element(i);
            largest =
              std::max(largest,
                       std::isfinite(stress) ? stress : no_stability_limit);
          }
        largest =
          dealii::Utilities::MPI::max(largest, r.get_mpi_communicator());
        const double allowed =
          parameters.relative_tolerance * f.stress_scale() +
          parameters.absolute_tolerance;
        return largest == 0. ? 0. : part_of_estimate * largest / allowed;
      }

      /** The same, if no stage of a method has looked at the end of the step,
       * of the difference to the trapezoidal rule: a jump behind the last stage
       * is seen by that alone. */
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

      /** The controller's next step. */
      void
      propose(const double length,
              const double step_error,
              const bool   was_rejected)
      {
        // The error of the embedded method is of the order 2 in the step.
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

      bool         is_free = true; ///< steps are being found
      unsigned int n_found = 0;    ///< how often they were
      double       proposed;
      double       last_error = 1.;

      // Of this period.
      double       needed = 0.; ///< the number of steps that would have done
      unsigned int taken  = 0;

      std::size_t accepted = 0, rejected = 0;

      Vector scale; ///< strain per stress
      Vector error, saved;

      // What is known of the end of the last step.
      double known_end = -1.; ///< negative: nothing
      Vector end_rate;
    };



    /** @throw NumericalError if the largest step is not below @p limit ×
     * @p smallest_relaxation_time, with both numbers and what to set. */
    void
    require_stability(const StepList &steps,
                      const bool      are_uniform,
                      const double    limit,
                      const double    smallest_relaxation_time)
    {
      const double bound   = limit * smallest_relaxation_time;
      const double largest = steps.largest_step();
      if (largest < bound)
        return;
      std::ostringstream message;
      message << "The time step " << largest
              << " is too large: this scheme is stable below " << limit
              << " times the smallest relaxation time "
              << smallest_relaxation_time << ", that is below " << bound
              << ", whatever the mesh. ";
      const double n_needed =
        std::floor(steps.period() / bound * (1 + 1e-12)) + 1.;
      if (!(n_needed <= most_steps))
        message
          << "No number of steps is enough, for a period has at most "
          << most_steps << " of them: that takes relaxation times above "
          << steps.period() / (limit * most_steps)
          << ". Look at the viscosity in [Material], at [Loads] Period and at "
             "their units";
      else if (are_uniform)
        message << "Use at least " << static_cast<unsigned int>(n_needed)
                << " steps: --set \"Time integration/Steps per period="
                << static_cast<unsigned int>(n_needed) << '"';
      else
        message << "Add instants to [Time integration] Steps";
      message << "; or choose Scheme = sdirk2, which is stable with any step.";
      throw NumericalError(message.str());
    }
  } // namespace



  double
  StepControl::longest_stable(const PeriodStep &step) const
  {
    if (stability_limit == no_stability_limit)
      return no_stability_limit;
    const double rate = step.f.relaxation_rate();
    if (!(stability_limit * most_steps < rate * step.steps.period()))
      return rate > 0. ? stability_limit / rate : no_stability_limit;
    throw NumericalError(
      Text::Message()
      << "The stress relaxes at the rate " << rate
      << " at t = " << step.steps.instant(step.k) << ": that takes more than "
      << most_steps << " steps of " << step.integrator.properties.name
      << " in a period. Look at [Material] Creep coefficient, at [Loads] and "
         "at their units.");
  }



  void
  StepControl::require_stability(const PeriodStep &step) const
  {
    const double longest = longest_stable(step),
                 length  = step.steps.step(step.k);
    if (length <= longest)
      return;
    throw NumericalError(
      Text::Message()
      << "The time step " << length
      << " from t = " << step.steps.instant(step.k) << " on is too large: "
      << step.integrator.properties.name << " is stable with steps of at most "
      << longest << " where the stress relaxes as fast as here. Use at least "
      << std::ceil(step.steps.period() / longest)
      << " steps: [Time integration] Steps per period; or Step control = "
         "adaptive.");
  }



  std::unique_ptr<StepControl>
  make_step_control(const TimeIntegrationParameters &parameters,
                    const StepList                  &steps,
                    const IntegratorProperties      &integrator,
                    const double                     smallest_relaxation_time)
  {
    const double limit = integrator.stability_limit;
    const double if_checked =
      parameters.check_stability ? limit : no_stability_limit;
    if (parameters.step_control != StepControlType::adaptive)
      {
        if (parameters.check_stability)
          require_stability(steps,
                            parameters.step_control == StepControlType::uniform,
                            limit,
                            smallest_relaxation_time);
        return std::make_unique<StepControl>(if_checked);
      }
    double longest = integrator.controls_steps
                       ? no_stability_limit
                       : steps.period() / parameters.steps_per_period;
    if (parameters.check_stability)
      {
        // Close to the limit errors hardly decay.
        const double part = integrator.controls_steps ? 1. : 0.9;
        longest = std::min(longest, part * limit * smallest_relaxation_time);
      }
    if (steps.period() > most_steps * longest)
      {
        std::ostringstream message;
        message << "The smallest relaxation time allows this scheme steps of "
                << longest << ", which are more than " << most_steps
                << " in a period. Choose Scheme = sdirk2, which is stable with "
                   "any step, or look at the viscosity in [Material], at "
                   "[Loads] Period and at their units.";
        throw NumericalError(message.str());
      }
    if (integrator.controls_steps)
      return std::make_unique<StepControl>(); // from sample to sample
    return std::make_unique<AdaptiveSteps>(parameters,
                                           longest,
                                           steps.fixed_instants(),
                                           integrator.quadrature.nodes,
                                           if_checked);
  }
} // namespace Crevasse
