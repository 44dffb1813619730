// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/simulation/conclusion.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** How many periods more a march takes if the error goes on to shrink as
     * its estimate supposes, in brackets; nothing as long as this cannot be
     * told.
     *
     * @param is_iterative whether contact problems are solved to their
     * tolerance only. */
    std::string
    periods_to_go(const PeriodicResult &result,
                  const double          tolerance,
                  const bool            is_iterative)
    {
      constexpr double small  = 1e-8; // direct solvers stay far below it
      const double     change = result.stress_change.back();
      const double     error  = result.stress_error_estimate.back();
      // What the strain still lacks does not fall with the changes.
      if (result.periods < 3 || result.return_defect >= error)
        return "";
      std::ostringstream text;
      if (std::isfinite(error))
        text << " (about "
             << std::ceil(std::log(tolerance / error) /
                          std::log(error / (change + error)))
             << " more at the current rate)";
      else if (is_iterative && change <= small)
        text << " (the changes do not shrink at present; so small, they may be "
                "those of the solutions: lower [Contact] Tolerance, or set "
                "Solver = automatic)";
      else
        text << " (the changes do not shrink steadily at present)";
      return text.str();
    }



    /** The first period after which the change of stress was within the
     * tolerance, as the paper asks; 0: none. */
    unsigned int
    end_by_change(const PeriodicResult &result, const double tolerance)
    {
      for (unsigned int k = 1; k < result.stress_change.size(); ++k)
        if (result.stress_change[k] <= tolerance)
          return k + 1;
      return 0;
    }



    void
    report_end_by_change(const PeriodicResult &result,
                         const double          tolerance,
                         Log                  &log)
    {
      const unsigned int early = end_by_change(result, tolerance);
      if (tolerance == 0. || early == 0 || early == result.periods)
        return;
      std::ostringstream text;
      text
        << "  The change of stress alone (the paper's test) would have ended "
           "the march after "
        << early << " periods";
      if (const double error = result.stress_error_estimate[early - 1];
          std::isfinite(error))
        text << ", with an estimated error of " << error;
      log.line(text.str() + '.');
    }



    void
    require_meaning(const double stress_rounding, const bool is_split, Log &log)
    {
      constexpr double   doubtful = 1e-6, worthless = 1e-2;
      std::ostringstream rounding;
      rounding
        << "Rounding leaves errors of " << stress_rounding
        << " of its maximum in the stress, which is the difference of total "
           "and "
           "viscous strain times the stiffness: the body has flown too far, or "
           "is too stiff against changes of volume (Poisson ratio near 0.5). "
        << (is_split
              ? "Look"
              : "Split off the mean flow ([Periodic state] Secular split = "
                "on), or look")
        << " at the relaxation times, whether they are many orders below the "
           "period, and at the Poisson ratios.";
      if (stress_rounding > worthless)
        throw NumericalError(rounding.str());
      if (stress_rounding > doubtful)
        log.line("  Beware: " + rounding.str());
    }



    template <int dim>
    void
    require_contact_forces(const RunSetup<dim> &setup,
                           const PeriodicStart &start,
                           const Summary       &summary)
    {
      const auto &secular = summary["secular"];
      if (!start.flow || !setup.body.effects.contact.on || //
          setup.body.effects.varying_viscosity.on ||
          !secular.contains("mean_contact_force_of_last_period"))
        return;
      // Much more than the error of any reasonable steps, and not that small
      // part of the load that a scheme's quadrature may miss.
      constexpr double far = 0.5, part_of_load = 0.05;
      const double     measured = secular["mean_contact_force_of_last_period"];
      double           expected = 0.;
      for (unsigned int k = 0; k < setup.body.lip.nodes().size(); ++k)
        expected += start.flow->contact_forces[k];
      expected = Utilities::MPI::sum(expected, setup.body.space.communicator());
      const double difference = std::abs(measured - expected);
      // As exactly as the solver finds them.
      constexpr double rounding = 1e-10;
      const double     error_of_forces =
        std::max(rounding, setup.scene.contact.tolerance) *
        setup.largest_nodal_force *
        Utilities::MPI::sum(setup.body.lip.nodes().size(),
                            setup.body.space.communicator());
      if (difference <= far * std::max(measured, expected) ||
          difference <= part_of_load * start.split.mean_load.l1_norm() ||
          difference <= error_of_forces)
        return;
      std::ostringstream message;
      message
        << "The stress repeats, but it is not the periodic one: the lip bears "
        << measured << " in the mean of the last period, and " << expected
        << " once its flow has become steady (mean contact force of the "
           "secular problem). It still approaches contact, or leaves it, "
           "or touches within a step only. All results so far are written. "
           "Raise [Time integration] Steps per period, use [Periodic state] "
           "Method = fourier with Scheme = trapezoid, or march with "
           "Tolerance = 0 over more periods.";
      throw NotPeriodicError(message.str());
    }



    void
    require_lip_at_rest(const Scene &scene, const Summary &summary)
    {
      if (!summary.contains("drift") ||
          !summary["drift"].contains("largest_closing_rate"))
        return;
      // What is left of the way to the periodic state closes the lip by as much
      // as the tolerance lets the stress be wrong, times a few.
      constexpr double many = 100., least_tolerance = 1e-8;
      const double     part =
        many * std::max(scene.periodic_state.tolerance, least_tolerance);
      const double rate    = summary["drift"]["largest_closing_rate"];
      const double opening = summary["extremes"]["opening"];
      if (rate * scene.loads.period <= part * opening)
        return;
      std::ostringstream message;
      message
        << "The stress repeats, but it is not the periodic one: the lip goes "
           "on to close, by up to "
        << rate * scene.loads.period << " in the last period, of an opening of "
        << opening
        << " at most. It will touch some time, and then the stress changes. "
           "All results so far are written. Use [Periodic state] Method = "
           "march with Tolerance = 0 over more periods, or, if nothing but "
           "the loads depends on time, fourier with Scheme = trapezoid.";
      throw NotPeriodicError(message.str());
    }



    /** What a run that is not periodic yet has come to, and what to do. */
    template <int dim>
    std::string
    message_of_failure(const RunSetup<dim>  &setup,
                       const PeriodicChoice &choice,
                       const PeriodicResult &result,
                       const bool            can_resume)
    {
      const bool         marches = choice.method == PeriodicMethodType::march;
      const double       error   = result.stress_error_estimate.back();
      std::ostringstream message;
      message << "The stress is not yet periodic: after " << result.periods
              << " period" << (result.periods == 1 ? "" : "s");
      if (!result.steps_repeat)
        message << " its change cannot be told, for the adaptive steps of the "
                   "last period are not those of the one before";
      else
        {
          message << " it still changes by " << result.stress_change.back()
                  << " of its maximum, and its error is ";
          if (std::isfinite(error))
            message << "estimated as " << error << ", more than ";
          else
            message << "not known to be within ";
          message << "[Periodic state] Tolerance = "
                  << setup.scene.periodic_state.tolerance;
          if (result.periods > 1 &&
              result.return_defect > setup.scene.periodic_state.tolerance)
            message
              << ", for the viscous strain does not yet come back after a "
                 "period";
        }
      message << ". All results so far are written. Raise \"Maximum periods\"";
      if (marches && result.steps_repeat)
        message << periods_to_go(result,
                                 setup.scene.periodic_state.tolerance,
                                 setup.body.effects.contact.on &&
                                   traits(setup.scene.contact.solver).relaxes);
      message << " or \"Tolerance\"";
      if (can_resume)
        message << " and continue by --resume";
      if (setup.scene.periodic_state.method == PeriodicMethodType::march)
        message
          << ", set Method = automatic, which mostly needs fewer periods,";
      else if (choice.method == PeriodicMethodType::anderson)
        message
          << ", set Method = fourier with Scheme = trapezoid if nothing but "
             "the loads depends on time,";
      message << " or set Tolerance = 0 to compute a fixed number of periods.";
      return message.str();
    }
  } // namespace



  template <int dim>
  void
  conclude(const RunSetup<dim>  &setup,
           const PeriodicStart  &start,
           const PeriodicResult &result,
           const Summary        &summary,
           const bool            can_resume,
           Log                  &log)
  {
    const double tolerance = setup.scene.periodic_state.tolerance;
    if (setup.body.effects.viscosity.on && result.periods > 0)
      require_meaning(summary["certificate"]["stress_rounding"],
                      start.split.is_split,
                      log);
    if (start.choice.method == PeriodicMethodType::march)
      report_end_by_change(result, tolerance, log);
    if (!result.converged && tolerance > 0. && result.periods > 0)
      throw NotPeriodicError(
        message_of_failure(setup, start.choice, result, can_resume));
    if (!result.converged)
      return;
    require_contact_forces(setup, start, summary);
    require_lip_at_rest(setup.scene, summary);
  }



  template void
  conclude<2>(const RunSetup<2> &,
              const PeriodicStart &,
              const PeriodicResult &,
              const Summary &,
              const bool,
              Log &);
  template void
  conclude<3>(const RunSetup<3> &,
              const PeriodicStart &,
              const PeriodicResult &,
              const Summary &,
              const bool,
              Log &);
} // namespace Crevasse
