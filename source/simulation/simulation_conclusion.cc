// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/simulation/simulation.h>

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
  } // namespace



  template <int dim>
  void
  Simulation<dim>::report_end_by_change(const PeriodicResult &result) const
  {
    const double       tolerance = scene.periodic_state.tolerance;
    const unsigned int early     = end_by_change(result, tolerance);
    if (tolerance == 0. || early == 0 || early == result.periods ||
        periodic_choice.method != "march")
      return;
    std::ostringstream text;
    text << "  The change of stress alone (the paper's test) would have ended "
            "the march after "
         << early << " periods";
    if (const double error = result.stress_error_estimate[early - 1];
        std::isfinite(error))
      text << ", with an estimated error of " << error;
    log.line(text.str() + '.');
  }



  template <int dim>
  void
  Simulation<dim>::require_meaning() const
  {
    constexpr double   doubtful = 1e-6, worthless = 1e-2;
    std::ostringstream rounding;
    rounding
      << "Rounding leaves errors of " << stress_rounding
      << " of its maximum in the stress, which is the difference of total and "
         "viscous strain times the stiffness: the body has flown too far, or "
         "is too stiff against changes of volume (Poisson ratio near 0.5). "
      << (secular_split.is_split
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
  Simulation<dim>::require_contact_forces(const Summary &summary) const
  {
    const auto &secular = summary["secular"];
    if (!secular_flow || !body.effects.contact.on || //
        body.effects.varying_viscosity.on ||
        !secular.contains("mean_contact_force_of_last_period"))
      return;
    // Much more than the error of any reasonable steps, and not that small part
    // of the load that a scheme's quadrature may miss.
    constexpr double far = 0.5, part_of_load = 0.05;
    const double     measured = secular["mean_contact_force_of_last_period"];
    double           expected = 0.;
    for (unsigned int k = 0; k < body.lip.nodes().size(); ++k)
      expected += secular_flow->contact_forces[k];
    expected                = Utilities::MPI::sum(expected, communicator);
    const double difference = std::abs(measured - expected);
    // As exactly as the solver finds them.
    constexpr double rounding = 1e-10;
    const double     error_of_forces =
      std::max(rounding, scene.contact.tolerance) * largest_nodal_force *
      Utilities::MPI::sum(body.lip.nodes().size(), communicator);
    if (difference <= far * std::max(measured, expected) ||
        difference <= part_of_load * secular_split.mean_load.l1_norm() ||
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



  template <int dim>
  void
  Simulation<dim>::require_lip_at_rest(const Summary &summary) const
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



  template <int dim>
  void
  Simulation<dim>::conclude(const PeriodicResult &result,
                            const bool            can_resume) const
  {
    require_meaning();
    report_end_by_change(result);
    if (result.converged || scene.periodic_state.tolerance == 0. ||
        result.periods == 0)
      return;

    const bool         marches = periodic_choice.method == "march";
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
                << scene.periodic_state.tolerance;
        if (result.periods > 1 &&
            result.return_defect > scene.periodic_state.tolerance)
          message << ", for the viscous strain does not yet come back after a "
                     "period";
      }
    message << ". All results so far are written. Raise \"Maximum periods\"";
    if (marches && result.steps_repeat)
      message << periods_to_go(result,
                               scene.periodic_state.tolerance,
                               body.effects.contact.on &&
                                 scene.contact.solver == "projected sor");
    message << " or \"Tolerance\"";
    if (can_resume)
      message << " and continue by --resume";
    if (scene.periodic_state.method == "march")
      message << ", set Method = automatic, which mostly needs fewer periods,";
    else if (periodic_choice.method == "anderson")
      message
        << ", set Method = fourier with Scheme = trapezoid if nothing but "
           "the loads depends on time,";
    message << " or set Tolerance = 0 to compute a fixed number of periods.";
    throw NotPeriodicError(message.str());
  }



#define INSTANTIATE(dim)                                                      \
  template void Simulation<dim>::report_end_by_change(const PeriodicResult &) \
    const;                                                                    \
  template void Simulation<dim>::require_contact_forces(const Summary &)      \
    const;                                                                    \
  template void Simulation<dim>::require_lip_at_rest(const Summary &) const;  \
  template void Simulation<dim>::require_meaning() const;                     \
  template void Simulation<dim>::conclude(const PeriodicResult &, const bool) \
    const

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
